//! Outputs are whole or not there: after Ctrl-C, on a full disk, where nobody may write.

use crate::command::{EXECUTABLE, Folder, errors};
use rustix::process::{Pid, Signal, kill_process};
use std::process::{Command, Stdio};
use std::time::Duration;

#[test]
fn ctrl_c_leaves_no_part_of_a_file() {
    let folder = Folder::new();
    let wide: String = (0..3).map(|row| format!("{}\n", vec![row.to_string(); 64].join(","))).collect();
    folder.write("features.csv", wide);
    folder.write("none.csv", "");
    folder.write("draws.csv", "kept\n");
    let before = folder.names();
    let mut n_caught = 0;
    for _ in 0..3 {
        let mut child = Command::new(EXECUTABLE)
            .args("infer --features features.csv --preferences none.csv --draws 20000 --out draws.csv".split(' '))
            .current_dir(folder.path("."))
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("it starts");
        // Until it writes, or ends because writing took no time at all.
        while child.try_wait().expect("it is there").is_none() && folder.names() == before {
            std::thread::sleep(Duration::from_millis(1));
        }
        let pid = Pid::from_child(&child);
        // It may be gone already.
        let _ = kill_process(pid, Signal::INT);
        let status = child.wait().expect("it ends");
        assert_eq!(folder.names(), before, "a part of a file is left");
        if status.code() == Some(130) {
            n_caught += 1;
            assert_eq!(folder.read("draws.csv"), "kept\n");
        } else {
            assert_eq!(status.code(), Some(0));
            assert_eq!(folder.read("draws.csv").lines().count(), 20_000);
            folder.write("draws.csv", "kept\n");
        }
    }
    assert!(n_caught > 0, "no run was interrupted while it wrote");
}

#[test]
fn what_cannot_be_written_is_a_failure() {
    let folder = Folder::new();
    let infer =
        "infer --features config/examples/trajectories.csv --preferences config/examples/preferences.csv --draws 400";
    for out in ["nowhere/draws.csv", "config", "/dev/full"] {
        let output = folder.run(&format!("{infer} --out {out}"));
        assert_eq!(output.status.code(), Some(1), "{out}: {}", errors(&output));
        assert!(errors(&output).contains(&format!("{out}: cannot be written")), "{}", errors(&output));
        assert!(output.stdout.is_empty(), "{out}: an answer beside a failure");
    }
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").expect("there is one");
    let status = Command::new(EXECUTABLE)
        .args(["bound", "--losses", "config/examples/losses.csv"])
        .current_dir(folder.path("."))
        .stdout(full)
        .stderr(Stdio::null())
        .status()
        .expect("it runs");
    assert_eq!(status.code(), Some(1));
    // A device and a pipe can be written to.
    let output = folder.run(&format!("{infer} --out /dev/stdout"));
    assert!(output.status.success() && String::from_utf8_lossy(&output.stdout).lines().count() > 400);
}

#[test]
fn a_link_stays_a_link() {
    let folder = Folder::new();
    folder.write("real.csv", "old\n");
    std::os::unix::fs::symlink("real.csv", folder.path("link.csv")).expect("a link");
    folder.json(
        "infer --features config/examples/trajectories.csv --preferences config/examples/preferences.csv --draws 400 --out \
         link.csv",
    );
    assert!(std::fs::symlink_metadata(folder.path("link.csv")).expect("it is there").file_type().is_symlink());
    assert_eq!(folder.read("real.csv").lines().count(), 400);
}
