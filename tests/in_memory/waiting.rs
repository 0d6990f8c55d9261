//! A person who says more while the robot still learns from what they said is heard at once.

use crate::graph::{Heard, Lesson};
use crate::row::{LEFT, Person, RIGHT, acted, row};

#[test]
fn what_is_said_while_a_posterior_is_computed_is_acknowledged_and_what_is_outdated_is_not_waited_for() {
    let mut lesson = Lesson::new("busy");
    lesson.start("reward_posterior", reward_posterior::run, &["n_draws:=100000", "threads:=1", "preview_draws:=0"]);
    let person = Person::new(&mut lesson);
    person.world.publish(&row(9)).expect("memory takes everything");
    let said = [("a", (3, RIGHT)), ("b", (4, RIGHT)), ("c", (7, LEFT)), ("d", (2, RIGHT))];
    for (id, step) in said {
        person.actions.publish(&acted(id, &[step])).expect("memory takes everything");
        lesson.accepted(id);
        // The next is said when this one is being learned from.
        std::thread::sleep(std::time::Duration::from_millis(50));
    }
    let is_early = |heard: &Heard| matches!(heard, Heard::Posterior(posterior) if posterior.revision > 0);
    assert!(!lesson.heard().iter().any(is_early), "receipts waited for draws");
    let posterior = lesson.posterior(4);
    assert_eq!(posterior.n_draws, 100_000);
    let revision = |heard: &Heard| match heard {
        Heard::Posterior(posterior) => Some(posterior.revision),
        _ => None,
    };
    let revisions: Vec<u64> = lesson.heard().iter().filter_map(revision).collect();
    assert!(revisions.iter().all(|revision| [0, 4].contains(revision)), "an outdated one was finished: {revisions:?}");
}
