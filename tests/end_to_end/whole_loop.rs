//! The main job: one command teaches a lesson, says so, and leaves a whole bag.

use crate::recorded::Recorded;
use crate::suite::Suite;
use crate::taught::{Taught, flowers, teach};
use apprentice_msgs::Message;
use apprentice_msgs::msg::{
    Candidates, EvidenceReceipt, LessonStatus, NodeSettings, PerformanceBounds, PlacementBound, PlacementDemonstration,
    PlacementPlan, PlacementQuery, Posterior, TableScene,
};
use apprentice_msgs::{builtin_interfaces::Time, std_msgs::Header, to_cdr};
use rustix::process::Signal;
use scene::Point;
use serde_json::Value;
use sha2::{Digest, Sha256};
use std::collections::BTreeSet;
use std::time::Duration;

#[test]
fn a_flowers_lesson_ends_taught_and_its_summary_says_how() {
    let lesson = flowers();
    let of =
        |name: &str| lesson.summary.get(name).unwrap_or_else(|| panic!("the summary lacks {name}: {}", lesson.summary));
    assert_eq!(of("taught"), &Value::Bool(true), "{}", lesson.summary);
    assert_eq!(of("state"), "taught");
    assert_eq!(of("seed"), 1);
    assert_eq!(of("scenario"), "flowers");
    assert_eq!(of("version"), env!("CARGO_PKG_VERSION"));
    let number = |name: &str| of(name).as_f64().unwrap_or_else(|| panic!("{name} is no number: {}", lesson.summary));
    assert!(number("last_bound_m") < number("epsilon_m"), "{}", lesson.summary);
    assert!(number("wall_time_s") > 0.0);
    let (asked, answered) = (number("questions_asked"), number("answers"));
    assert!((5.0..=30.0).contains(&asked) && answered == asked, "{asked} asked, {answered} answered");
    for name in ["why", "commit"] {
        assert!(of(name).as_str().is_some_and(|text| !text.is_empty()), "{name}: {}", lesson.summary);
    }
    assert_eq!(of("bag").as_str(), Some(lesson.bag.to_string_lossy().as_ref()));
    assert!(lesson.shown.to_lowercase().contains("taught"), "{}", lesson.shown);
}

/// Where the person puts the target on the table of the task, the subject of the first question, and where the robot
/// puts it in the end.
fn person_and_robot(lesson: &Taught) -> (Point, Point) {
    let bag = Recorded::read(&lesson.bag).expect("the bag opens");
    let first = bag.distinct::<PlacementDemonstration>("demonstration").remove(0);
    let placement = lesson.summary["placement_m"].as_array().expect("the robot has a placement");
    let metres = |i: usize| placement[i].as_f64().expect("a number of metres");
    (Point::new(first.placement.x, first.placement.y), Point::new(metres(0), metres(1)))
}

#[test]
fn what_the_robot_claims_about_flowers_is_true() {
    let lesson = flowers();
    let (person, robot) = person_and_robot(&lesson);
    let bound_m = lesson.summary["last_bound_m"].as_f64().expect("it is taught");
    assert!(person.distance(robot) <= bound_m, "{} m off, {bound_m} m claimed", person.distance(robot));
}

#[test]
fn a_spoon_lesson_ends_taught_with_the_spoon_on_the_bowl() {
    let lesson = teach("spoon", &["--scenario", "spoon", "--seed", "1"]);
    assert_eq!(lesson.summary["taught"], true, "{}", lesson.summary);
    let (_, robot) = person_and_robot(&lesson);
    let bowl = Point::new(0.62, 0.58);
    assert!(
        robot.distance(bowl) <= 0.07,
        "the spoon is {} m from the middle of a bowl of 0.14 m",
        robot.distance(bowl)
    );
}

#[test]
fn the_bag_of_a_lesson_is_whole_and_holds_every_step() {
    let lesson = flowers();
    let bag = Recorded::read(&lesson.bag).expect("the bag opens");
    assert!(bag.whole, "the bag is not finished");
    let posteriors = bag.distinct::<Posterior>("posterior");
    let n = u64::try_from(posteriors.len()).expect("few") - 1;
    let revisions: Vec<u64> = posteriors.iter().map(|p| p.revision).collect();
    assert_eq!(revisions, (0..=n).collect::<Vec<_>>(), "one posterior a revision");
    assert_eq!(bag.distinct::<PerformanceBounds>("bounds").len() as u64, n + 1, "one look a revision");
    assert_eq!(bag.distinct::<Candidates>("candidates").len() as u64, n + 1);
    assert_eq!(bag.distinct::<PlacementQuery>("query").len() as u64, n, "the last revision asks nothing");
    assert_eq!(bag.accepted().len() as u64, n);
    let mut accepted = bag.accepted();
    accepted.sort();
    assert_eq!(bag.answers(), accepted, "the person said nothing that was lost");
    let accepted = bag.distinct::<EvidenceReceipt>("receipt");
    assert!(accepted.iter().any(|r| r.outcome == EvidenceReceipt::ACCEPTED && r.revision == n));
    assert!(!bag.distinct::<TableScene>("scene").is_empty());
    assert!(!bag.distinct::<PlacementPlan>("plan").is_empty(), "the robot has a plan in the end");
    let nodes: BTreeSet<String> = bag.distinct::<NodeSettings>("settings").into_iter().map(|s| s.node).collect();
    for node in ["reward_posterior", "performance_bounds", "active_query", "placement_planner", "demonstrator"] {
        assert!(nodes.contains(node), "{node} did not publish its settings: {nodes:?}");
    }
}

#[test]
fn every_claim_carries_its_receipt() {
    let bag = Recorded::read(&flowers().bag).expect("the bag opens");
    let posteriors = bag.distinct::<Posterior>("posterior");
    for bounds in bag.distinct::<PerformanceBounds>("bounds") {
        let posterior = posteriors.iter().find(|p| p.revision == bounds.revision).expect("a bound is of a posterior");
        assert_eq!(bounds.evidence_hash, posterior.evidence_hash);
        assert_eq!((bounds.seed, bounds.beta, &bounds.prior), (posterior.seed, posterior.beta, &posterior.prior));
        assert_eq!((bounds.n, bounds.n_chains), (u64::from(posterior.n_draws), posterior.n_chains));
        assert!(posterior.n_chains >= 4, "at least four chains");
        assert!(!bounds.reason.is_empty() && !bounds.version.is_empty());
        if bounds.outcome == PlacementBound::BOUND {
            let worst = &bounds.bounds[bounds.worst as usize];
            assert_eq!(worst.bound_m, bounds.bound_m);
            assert!(bounds.bounds.iter().all(|b| b.outcome != PlacementBound::BOUND || b.bound_m <= bounds.bound_m));
            assert!(bounds.rhat_max <= 1.01 && bounds.ess_min > 0.0, "{bounds:?}");
        }
    }
    let lessons = bag.distinct::<LessonStatus>("lesson");
    let last = lessons.last().expect("a lesson has a state");
    assert_eq!((last.state, last.bound_m < last.epsilon_m), (LessonStatus::TAUGHT, true));
}

#[test]
fn the_same_seed_asks_the_same_and_gives_the_same_bounds_to_the_bit() {
    let [first, second] = [flowers(), teach("flowers-again", &["--seed", "1"])];
    let [a, b] = [&first, &second].map(|lesson| Recorded::read(&lesson.bag).expect("the bag opens"));
    assert_eq!(plain::<PlacementQuery>(&a, "query", bare_query), plain(&b, "query", bare_query), "questions");
    assert_eq!(
        plain::<PlacementDemonstration>(&a, "demonstration", bare_answer),
        plain(&b, "demonstration", bare_answer),
        "answers"
    );
    assert_eq!(
        plain::<Posterior>(&a, "posterior", bare_posterior),
        plain(&b, "posterior", bare_posterior),
        "posteriors"
    );
    assert_eq!(plain::<PerformanceBounds>(&a, "bounds", bare_bounds), plain(&b, "bounds", bare_bounds), "bounds");
    assert_eq!(first.summary["last_bound_m"], second.summary["last_bound_m"]);
}

/// A digest of each message of a topic, without the stamps, in which two lessons do differ.
fn plain<M: Message>(bag: &Recorded, topic: &str, bare: fn(M) -> M) -> Vec<String> {
    let digest = |message| Sha256::digest(to_cdr(&bare(message))).iter().map(|byte| format!("{byte:02x}")).collect();
    bag.distinct::<M>(topic).into_iter().map(digest).collect()
}

fn bare_scene(scene: TableScene) -> TableScene {
    TableScene { header: Header { stamp: Time::default(), ..scene.header }, ..scene }
}

fn bare_query(query: PlacementQuery) -> PlacementQuery {
    PlacementQuery { header: Header::default(), scene: bare_scene(query.scene), ..query }
}

fn bare_answer(answer: PlacementDemonstration) -> PlacementDemonstration {
    PlacementDemonstration { header: Header::default(), scene: bare_scene(answer.scene), ..answer }
}

fn bare_posterior(posterior: Posterior) -> Posterior {
    let (task, scene) = (bare_scene(posterior.task), bare_scene(posterior.scene));
    Posterior { header: Header::default(), task, scene, ..posterior }
}

fn bare_bounds(bounds: PerformanceBounds) -> PerformanceBounds {
    PerformanceBounds { header: Header::default(), ..bounds }
}

#[test]
fn ctrl_c_and_sigterm_leave_a_finished_bag() {
    for signal in [Signal::INT, Signal::TERM] {
        let mut suite = Suite::start(&format!("signal-{}", signal.as_raw()), &["--headless"]);
        suite.wait_for("the second question", Duration::from_secs(60), |suite| {
            Recorded::read(&suite.bag()).ok().filter(|bag| bag.distinct::<PlacementQuery>("query").len() >= 2)
        });
        let status = suite.stop(signal);
        assert!(status.success(), "{signal:?}: {status}\n{}", suite.dump());
        let bag = Recorded::read(&suite.bag()).expect("the bag opens");
        assert!(bag.whole, "{signal:?} left an unfinished bag");
        assert!(!bag.accepted().is_empty());
    }
}
