//! Damaged bytes on every topic that any node subscribes to: one clear line each, and the lesson goes on.

use crate::evidence::volunteered;
use crate::graph::Lesson;
use crate::log_lines::warnings;

/// Bytes that are no message of any type used here.
fn damaged() -> Vec<Vec<u8>> {
    let header = [0u8, 1, 0, 0];
    let with = |body: &[u8]| [&header[..], body].concat();
    vec![
        Vec::new(),
        vec![0, 1],
        with(&[]),
        // A length far beyond the bytes.
        with(&[0xff; 12]),
        with(&[0xff; 64]),
        // Parameter-list CDR, and a representation that does not exist.
        vec![0, 3, 0, 0, 1, 2, 3, 4],
        vec![0x7f, 0xff, 0, 0, 1, 2, 3, 4],
        with(&(0..=255).cycle().take(5000).collect::<Vec<u8>>()),
    ]
}

#[test]
fn damaged_bytes_on_every_subscribed_topic_are_told_once_and_survived() {
    let mut lesson = Lesson::new("malformed");
    lesson.start_all();
    let query = lesson.query(0);

    let mut subscribed = 0;
    for topic in lesson.topics() {
        let of = |name: &str| topic.subscriptions.iter().filter(|one| one.node.as_deref() == Some(name)).count();
        // The recorder takes any bytes, whatever they are, and the test's own ears are not under test.
        let ours = of("/malformed/test");
        let readers = topic.subscriptions.len() - of("/malformed/session_recorder") - ours;
        if readers == 0 {
            continue;
        }
        for bytes in damaged() {
            lesson.graph.inject_raw(&topic.name, &topic.type_name, &bytes);
        }
        let told = warnings(&format!("{}: message 1 ", topic.name));
        assert_eq!(told.len(), readers + ours, "{}: {told:#?}", topic.name);
        assert!(told.iter().all(|line| line.contains(&topic.type_name) && !line.contains('\n')), "{told:#?}");
        subscribed += readers;
    }
    assert!(subscribed >= 15, "only {subscribed} subscriptions were found");

    let mut shown = volunteered("after-all", 0.5, 0.5);
    shown.scene = query.scene;
    assert_eq!(lesson.show(&shown).revision, 1);
    assert_eq!(lesson.bounds(1).revision, 1);
    lesson.check_nodes();
}
