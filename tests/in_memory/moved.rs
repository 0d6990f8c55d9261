//! Something on the table is moved during a lesson, over the graph: the bound is about the table as it is, and before that is good
//! enough the lesson is not over.

use crate::evidence::{table, volunteered};
use crate::graph::Lesson;
use apprentice_msgs::msg::TableScene;

/// The table with the cup where the person wanted the target: nothing that was shown says where that belongs now.
fn moved() -> TableScene {
    let mut scene = table();
    let at = &mut scene.objects[0].pose.position;
    (at.x, at.y) = (0.5, 0.45);
    scene
}

/// A lesson with one placement, after which the cup is moved. One table is imagined beside the real one; under this seed more is
/// known of it than of the real one.
fn with_a_moved_cup(namespace: &str, epsilon_m: f64) -> Lesson {
    let mut lesson = Lesson::new(namespace);
    lesson.start("reward_posterior", reward_posterior::run, &["n_draws:=2000", "threads:=1"]);
    lesson.start("performance_bounds", performance_bounds::run, &["threads:=1"]);
    let epsilon = format!("epsilon_m:={epsilon_m:?}");
    lesson.start("active_query", active_query::run, &["n_candidates:=1", "seed:=2", &epsilon]);
    lesson.scene.publish(&table()).expect("memory takes everything");
    lesson.query(0);
    lesson.show(&volunteered("a", 0.5, 0.45));
    lesson.bounds(1);
    lesson.scene.publish(&moved()).expect("memory takes everything");
    lesson
}

#[test]
fn the_lesson_goes_on_about_the_table_as_it_is() {
    let mut lesson = with_a_moved_cup("moved", 0.01);
    let after = lesson.posterior(2);
    assert_eq!(after.task.objects, moved().objects);
    assert_eq!(after.draws, lesson.posterior(1).draws, "where things stand says nothing about rewards");
    assert_eq!(lesson.evidence(2).task.objects, table().objects, "the log begins as the lesson did");
    let (before, bounds) = (lesson.bounds(1), lesson.bounds(2));
    assert_eq!(bounds.evidence_hash, before.evidence_hash);
    let [imagined_m, real_m] = [0, 1].map(|i| bounds.bounds[i].bound_m);
    assert!(real_m > before.bounds[1].bound_m, "less is known of the table as it is: {before:?}, {bounds:?}");
    assert_ne!(lesson.query(2).scene.objects, moved().objects, "imagined tables come first");

    // Where what is imagined is good enough and the real table is not, that very table is asked about.
    assert!(real_m > imagined_m, "{bounds:?}");
    let mut asked_on = with_a_moved_cup("moved_again", 0.5 * (imagined_m + real_m));
    assert_eq!(asked_on.query(2).scene.objects, moved().objects);
}
