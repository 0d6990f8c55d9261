//! Something on the table is moved during a lesson, over the graph: the bound is about the table as it is, and so is the question.

use crate::evidence::{table, volunteered};
use crate::graph::Lesson;
use apprentice_msgs::msg::TableScene;

#[test]
fn the_table_as_it_is_is_judged_and_asked_about() {
    let mut lesson = Lesson::new("moved");
    lesson.start("reward_posterior", reward_posterior::run, &["n_draws:=2000", "threads:=1"]);
    lesson.start("performance_bounds", performance_bounds::run, &["threads:=1"]);
    // One imagined table beside the real one: what is asked about is one of the two.
    lesson.start("active_query", active_query::run, &["n_candidates:=1", "epsilon_m:=0.01"]);
    lesson.scene.publish(&table()).expect("memory takes everything");
    lesson.query(0);
    lesson.show(&volunteered("a", 0.5, 0.45));
    let before = lesson.bounds(1);
    let mut moved: TableScene = table();
    moved.objects[0].pose.position.y += 0.2;
    lesson.scene.publish(&moved).expect("memory takes everything");
    let after = lesson.posterior(2);
    assert_eq!(after.task.objects, moved.objects);
    assert_eq!(after.draws, lesson.posterior(1).draws);
    let bounds = lesson.bounds(2);
    let last =
        |bounds: &apprentice_msgs::msg::PerformanceBounds| bounds.bounds.last().map(|bound| bound.bound_m.to_bits());
    assert_eq!(bounds.evidence_hash, before.evidence_hash);
    assert_ne!(last(&bounds), last(&before), "the bound is about the table as it is");
    let query = lesson.query(2);
    assert_eq!(query.revision, 2);
    assert_eq!(lesson.evidence(2).task.objects, table().objects);
}
