//! Things on the table are moved during a lesson: the lesson goes on about the table as it is, with the same draws.

mod support;

use apprentice_msgs::msg::{EvidenceRecord, PlacementQuery, TableScene};
use reward_posterior::{Event, read_journal};
use support::{Bench, settings, shown, table};

/// The table with its cup elsewhere.
fn with_cup_at(x: f64, y: f64) -> TableScene {
    let mut scene = table();
    (scene.objects[0].pose.position.x, scene.objects[0].pose.position.y) = (x, y);
    scene
}

fn see(bench: &mut Bench, scene: &TableScene) {
    bench.step(Event::Scene(Box::new(scene.clone())));
}

/// A lesson about the table, in which a placement was shown.
fn begun() -> Bench {
    let mut bench = Bench::new(settings());
    see(&mut bench, &table());
    bench.take(Event::Demonstration(Box::new(shown("a", 0.5, 0.5))));
    bench
}

#[test]
fn a_moved_thing_counts_once_it_stands_still_and_changes_no_draw() {
    let mut bench = begun();
    let before = bench.posterior();
    let moved = with_cup_at(0.45, 0.2);
    see(&mut bench, &moved);
    bench.step(Event::Tick);
    // Perception says it again, a little differently.
    see(&mut bench, &with_cup_at(0.453, 0.2));
    assert_eq!(bench.node.evidence().revision(), 1, "it may still be in a hand");
    bench.step(Event::Tick);
    let after = bench.posterior();
    assert_eq!((after.revision, after.task.objects[0].pose.position.x), (2, 0.453));
    assert_eq!((&after.draws, &after.evidence_hash), (&before.draws, &before.evidence_hash));
    assert_eq!(after.scene, before.scene, "the newest placement was shown on the table as it was");
    let log = bench.node.evidence().log();
    assert_eq!((log.task, log.records[1].kind), (table(), EvidenceRecord::SCENE), "the log begins as the lesson did");
    // It is said once, and the same table again is no news.
    for _ in 0..5 {
        see(&mut bench, &with_cup_at(0.45, 0.2));
        bench.step(Event::Tick);
    }
    assert_eq!(bench.node.evidence().revision(), 2);

    let (entries, _) = read_journal(&bench.journal).expect("a whole journal");
    let mut restored = Bench::new(settings());
    restored.node.restore(entries).expect("what was accepted fits");
    assert_eq!(restored.posterior(), after, "a killed node comes back to the table as it is");
}

#[test]
fn what_is_put_back_or_still_moves_is_no_news() {
    let mut bench = begun();
    for x in [0.30, 0.35, 0.40, 0.45, 0.50] {
        see(&mut bench, &with_cup_at(x, 0.25));
        bench.step(Event::Tick);
    }
    see(&mut bench, &with_cup_at(0.255, 0.245));
    for _ in 0..3 {
        bench.step(Event::Tick);
    }
    assert_eq!((bench.node.evidence().revision(), bench.warnings.len()), (1, 0));
}

#[test]
fn another_set_of_things_is_another_lesson() {
    let mut bench = begun();
    let mut less = table();
    less.objects.pop();
    let mut other_target = table();
    other_target.target.id = "candle".into();
    for scene in [less, other_target] {
        bench.warnings.clear();
        for _ in 0..3 {
            see(&mut bench, &scene);
            bench.step(Event::Tick);
        }
        assert_eq!(bench.warnings.len(), 1, "it is said once: {:?}", bench.warnings);
        assert!(bench.warnings[0].starts_with("the table is not what the lesson is about"), "{:?}", bench.warnings);
    }
    assert_eq!(bench.node.evidence().revision(), 1);
}

#[test]
fn a_question_about_the_table_as_it_was_is_closed() {
    let mut bench = begun();
    let query = PlacementQuery { id: "q1-0".into(), revision: 1, scene: table(), ..PlacementQuery::default() };
    bench.step(Event::Query(Box::new(query)));
    see(&mut bench, &with_cup_at(0.45, 0.2));
    for _ in 0..2 {
        bench.step(Event::Tick);
    }
    let mut late = shown("late", 0.5, 0.5);
    late.query_id = "q1-0".into();
    let reason = bench.refused(Event::Demonstration(Box::new(late)));
    assert!(reason.contains("no longer open"), "{reason}");
}
