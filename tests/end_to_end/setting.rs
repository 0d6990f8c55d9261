//! `apprentice setting`: things placed one after another, interrupted, and gone on with.

use crate::recorded::Recorded;
use crate::suite::{Process, Turn, apprentice, fresh_domain, fresh_folder, now, run};
use apprentice_msgs::geometry_msgs::PoseStamped;
use apprentice_msgs::msg::{PlacementQuery, TableScene};
use rustix::process::{Signal, kill_process};
use serde_json::Value;
use std::path::Path;
use std::time::Duration;

const LIMIT: Duration = Duration::from_secs(240);

/// A saucer for the middle, and a cup for the saucer; the lessons are short, as little is asked of them.
const TEA: &str = "/**/setting:
  ros__parameters:
    object_ids: [pot]
    object_shapes: [cylinder]
    object_sizes_m: [0.16, 0.16, 0.2]
    object_positions_m: [0.25, 0.75]
    target_ids: [saucer, cup]
    target_labels: [saucer, tea cup]
    target_shapes: [cylinder, cylinder]
    target_sizes_m: [0.14, 0.14, 0.01, 0.07, 0.07, 0.08]
    target_homes: [table centre, pot]
/**/simulated_table:
  ros__parameters:
    target_position_m: [1.1, 0.1]
    gripper_joint: finger_left
    start_positions: [0.0, -0.6, 2.2, 0.0, 1.54, 0.0, 0.05]
/**/placement_planner:
  ros__parameters:
    gripper_joint: finger_left
    pick: true
/**/demonstrator:
  ros__parameters:
    noise: none
    response_delay_s: 0.5
/**/reward_posterior:
  ros__parameters:
    beta: 100.0
    n_draws: 4000
/**/active_query:
  ros__parameters:
    epsilon_m: 0.25
    n_candidates: 10
";

/// A setting that runs; dropping it ends it and what it started.
struct Setting(Process);

impl Setting {
    fn start(file: &Path, folder: &Path) -> Setting {
        let [file, folder] = [file, folder].map(|path| path.to_string_lossy().into_owned());
        let arguments = ["setting", &file, "--session", &folder, "--", "--port", "0"];
        Setting(Process::start(apprentice(fresh_domain(), &arguments), "setting"))
    }

    /// Waits until words are told after others.
    fn wait_for(&mut self, words: &str, after: &str) {
        let start = now();
        while !self.0.output().0.split_once(after).is_some_and(|(_, later)| later.contains(words)) {
            assert!(self.0.ended().is_none() && start.elapsed() < LIMIT, "no '{words}'\n{}", self.0.dump());
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    fn signal(&self, signal: Signal) {
        kill_process(self.0.pid(), signal).expect("it runs");
    }
}

impl Drop for Setting {
    fn drop(&mut self) {
        if self.0.ended().is_none() {
            self.signal(Signal::TERM);
            let start = now();
            while self.0.ended().is_none() && start.elapsed() < Duration::from_secs(15) {
                std::thread::sleep(Duration::from_millis(20));
            }
        }
    }
}

fn summary(folder: &Path, name: &str) -> Value {
    let text = std::fs::read_to_string(folder.join(name)).expect("a lesson that is over has a summary");
    serde_json::from_str(&text).expect("it is JSON")
}

#[test]
fn a_table_is_set_one_thing_after_another_and_an_interrupted_setting_goes_on() {
    let _turn = Turn::take();
    let folder = fresh_folder("setting");
    let (file, session) = (folder.join("tea.yaml"), folder.join("tea"));
    std::fs::write(&file, TEA).expect("the folder of the tests can be written");

    let mut first = Setting::start(&file, &session);
    first.wait_for("question  1", "== 2 of 2: tea cup");
    let token = std::fs::read_to_string(session.join("page-token")).expect("the page has a token");
    first.signal(Signal::INT);
    assert_eq!(first.0.wait(Duration::from_secs(30)).code(), Some(130), "{}", first.0.dump());
    let (shown, _) = first.0.output();
    assert!(shown.contains("to go on: apprentice setting") && shown.contains("--session"), "{shown}");
    let saucer = summary(&session, "1-saucer.json");
    assert_eq!((&saucer["state"], &summary(&session, "2-cup.json")["state"]), (&"taught".into(), &"asking".into()));

    // With other parameters it is another setting.
    let other = folder.join("other.yaml");
    std::fs::write(&other, TEA.replace("epsilon_m: 0.25", "epsilon_m: 0.3")).expect("a file");
    let [other, begun] = [&other, &session].map(|path| path.to_string_lossy().into_owned());
    let refused = run(&["setting", &other, "--session", &begun]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&refused.stderr).contains("was begun with other parameters"), "{refused:?}");

    let mut second = Setting::start(&file, &session);
    let status = second.0.wait(LIMIT);
    assert!(status.success(), "{status}\n{}", second.0.dump());
    let (shown, _) = second.0.output();
    assert!(!shown.contains("== 1 of 2") && shown.contains("== 2 of 2: tea cup"), "{shown}");
    assert!(shown.contains("== 2 of 2 have their place"), "{shown}");
    assert_eq!(summary(&session, "1-saucer.json"), saucer, "what is over stays as it is");
    assert_eq!(std::fs::read_to_string(session.join("page-token")).ok(), Some(token), "the page keeps its address");

    // What was placed is in the way from then on, just where the robot would put it.
    let bag = session.join("2-cup/bag");
    let recorded = Recorded::read(&bag).expect("the bag opens");
    let scene = recorded.distinct::<TableScene>("scene").pop().expect("there is a table");
    let standing: Vec<&str> = scene.objects.iter().map(|object| object.id.as_str()).collect();
    assert_eq!((standing.as_slice(), scene.target.id.as_str()), (["pot", "saucer"].as_slice(), "cup"));
    let at = &scene.objects[1].pose.position;
    assert_eq!(serde_json::json!([at.x, at.y]), saucer["placement_m"]);
    assert!(f64::hypot(at.x - 0.5, at.y - 0.5) < 0.2, "the saucer belongs in the middle: {at:?}");
    assert!(recorded.distinct::<PlacementQuery>("query").iter().all(|query| query.scene.objects.len() == 2));
    for (lesson, file) in [("1-saucer/bag", "1-saucer.json"), ("2-cup/bag", "2-cup.json")] {
        // The robot took it from beside the table, and there it stands now.
        let ended = summary(&session, file);
        assert_eq!(ended["placed"], serde_json::json!(true), "{ended}");
        let recorded = Recorded::read(&session.join(lesson)).expect("the bag opens");
        let poses = recorded.distinct::<PoseStamped>("target_pose");
        let place = |n: usize| ended["placement_m"][n].as_f64().expect("a place");
        let (first, last) = (poses.first().expect("it is seen"), poses.last().expect("it is seen"));
        assert_eq!((first.pose.position.x, first.pose.position.y), (1.1, 0.1));
        let at = &last.pose.position;
        assert!(f64::hypot(at.x - place(0), at.y - place(1)) < 0.005, "{at:?}: {ended}");
        let output = run(&["replay", "--verify", &session.join(lesson).to_string_lossy()]);
        let words = format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
        assert!(output.status.success() && words.contains("equal bit for bit"), "{lesson}: {words}");
    }
}

#[test]
fn a_setting_that_cannot_be_is_refused_before_anything_starts() {
    let folder = fresh_folder("bad-settings");
    let refused = |name: &str, text: &str, wanted: &str| {
        let file = folder.join(format!("{name}.yaml"));
        std::fs::write(&file, text).expect("the folder of the tests can be written");
        let session = folder.join(name).to_string_lossy().into_owned();
        let output = run(&["setting", &file.to_string_lossy(), "--session", &session]);
        let words = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{name}: {words}");
        assert!(words.contains(wanted), "{name}: {words}");
        assert_eq!(words.matches(&format!("{name}.yaml")).count(), 1, "the file is named once: {words}");
        assert!(!folder.join(name).exists(), "nothing was begun");
    };
    refused("nothing", "/**/setting:\n  ros__parameters:\n    table_width_m: 1.0\n", "names nothing to place");
    refused("flowers", "/**/simulated_table:\n  ros__parameters: {}\n", "names nothing to place");
    refused(
        "late",
        &TEA.replace("table centre, pot", "cup, pot"),
        "which does not stand on the table when its turn comes",
    );
    refused("short", &TEA.replace("[cylinder, cylinder]", "[cylinder]"), "target_shapes has 1 entries; 2 are needed");
    refused("typo", &TEA.replace("target_homes", "target_home"), "target_homes");
    refused("broken", "/**/setting: [", "broken.yaml");
    let unknown = run(&["setting", "lunch"]);
    assert_eq!(unknown.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&unknown.stderr).contains("there is no setting 'lunch'; known: breakfast"));
    let own = run(&["setting", "--", "--session", "x"]);
    assert_eq!(own.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&own.stderr).contains("leave it out after the --"));
}
