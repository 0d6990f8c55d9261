//! The log is the truth: a recorded lesson is computed again to the bit, and a forged one is found out.

use crate::suite::{fresh_folder, run};
use crate::taught::flowers;
use apprentice_msgs::msg::{Posterior, TableReach};
use apprentice_msgs::{Message, from_cdr, to_cdr};
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::Output;

fn verify(bag: &Path, more: &[&str]) -> Output {
    let bag = bag.to_string_lossy().into_owned();
    let mut arguments = vec!["replay", "--verify", &bag];
    arguments.extend(more);
    run(&arguments)
}

fn words(output: &Output) -> String {
    format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr))
}

#[test]
fn a_recorded_lesson_is_recomputed_to_the_bit_by_one_thread_and_by_two() {
    let bag = flowers().bag;
    let [one, two] = ["1", "2"].map(|threads| verify(&bag, &["--threads", threads, "--json"]));
    assert!(one.status.success(), "{}", words(&one));
    assert!(two.status.success(), "{}", words(&two));
    assert_eq!(String::from_utf8_lossy(&one.stdout), String::from_utf8_lossy(&two.stdout));
    let told: serde_json::Value = serde_json::from_slice(&one.stdout).expect("--json gives JSON");
    let compared = &told["verification"];
    let revisions = told["revisions"].as_array().map_or(0, Vec::len);
    assert!(revisions >= 5, "{told}");
    for kind in ["posteriors", "candidates", "bounds", "lessons"] {
        assert!(compared[kind]["recorded"].as_u64() >= Some(revisions as u64), "{kind}: {compared}");
    }
    assert!(compared["plans"]["recorded"].as_u64() > Some(0), "{compared}");
    assert_eq!(
        (&compared["reaches"]["recorded"], &compared["reaches"]["revisions"]),
        (&1.into(), &1.into()),
        "{compared}"
    );
    assert!(compared["mismatch"].is_null(), "{compared}");
}

/// A copy of the lesson's bag in which `forge` has changed what it says it has of the messages of a topic.
fn forged<M: Message>(name: &str, of: &str, forge: impl Fn(&mut M) -> bool) -> PathBuf {
    let folder = fresh_folder(name);
    let path = folder.join("forged_0.mcap");
    let bag = bag_files::open_bag(&flowers().bag).expect("the bag opens");
    let file = File::create(&path).expect("a file can be made");
    let mut writer = bag::BagWriter::new(file, &bag::WriterOptions::default()).expect("a file can be written");
    for message in bag.messages() {
        let message = message.expect("the bag is whole");
        let topic = writer.add_topic(&message.topic).expect("a topic");
        let mut data = message.data;
        if message.topic.name == of {
            let mut content: M = from_cdr(&data).expect("a recorded message");
            if forge(&mut content) {
                data = to_cdr(&content);
            }
        }
        writer.write(topic, message.log_time, message.publish_time, &data).expect("a file can be written");
    }
    writer.finish().expect("a file can be finished");
    path
}

#[test]
fn one_bit_of_one_draw_is_found_out() {
    let path = forged("forged-draw", "/apprentice/posterior", |posterior: &mut Posterior| {
        let draw = &mut posterior.draws[41];
        *draw = f32::from_bits(draw.to_bits() ^ 1);
        posterior.revision == 3
    });
    let output = verify(&path, &[]);
    let told = words(&output);
    assert_eq!(output.status.code(), Some(1), "{told}");
    let difference = told.lines().find(|line| line.contains("DIFFERENT")).expect("the difference is told");
    for part in ["Posterior", "revision 3", "draws[41]"] {
        assert!(difference.contains(part), "{difference}");
    }
}

#[test]
fn a_forged_diagnostic_is_found_out() {
    let path = forged("forged-rhat", "/apprentice/posterior", |posterior: &mut Posterior| {
        posterior.rhat_max = 1.0;
        posterior.revision == 3
    });
    let output = verify(&path, &[]);
    let told = words(&output);
    assert_eq!(output.status.code(), Some(1), "{told}");
    assert!(told.contains("rhat_max") && told.contains("revision 3"), "{told}");
}

#[test]
fn a_longer_arm_than_there_was_is_found_out() {
    // A far corner, which the arm does not reach; no table of the lesson may have been imagined otherwise for it.
    let path = forged("forged-reach", "/apprentice/reach", |reach: &mut TableReach| {
        let corner = &mut reach.reachable[30 * 32 + 1];
        !std::mem::replace(corner, true)
    });
    let output = verify(&path, &[]);
    let told = words(&output);
    assert_eq!(output.status.code(), Some(1), "{told}");
    assert!(told.contains("TableReach") && told.contains("reachable[961]"), "{told}");
}
