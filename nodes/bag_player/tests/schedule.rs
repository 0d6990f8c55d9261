//! Which messages go out when, checked without a clock or a graph.

use std::sync::Arc;

use bag::{Message, Topic};
use bag_player::{Event, Output, PlayerNode, Settings, Source};

const S: u64 = 1_000_000_000;
/// Log time of the first message.
const START: u64 = 1_000 * S;

/// One message a second: on /a at even seconds, on /b at odd ones. The byte is the second.
fn messages(count: u8) -> Vec<Message> {
    let topics = ["/a", "/b"].map(|name| Arc::new(Topic::ros2(name, "std_msgs/msg/UInt8", "uint8 data\n", &[])));
    let message = |i: u8| Message {
        topic: Arc::clone(&topics[usize::from(i % 2)]),
        log_time: START + u64::from(i) * S,
        publish_time: 0,
        sequence: 0,
        data: vec![0, 1, 0, 0, i],
    };
    (0..count).map(message).collect()
}

fn source(messages: Vec<Message>) -> Source {
    Box::new(move || Box::new(messages.clone().into_iter().map(Ok)))
}

/// Runs for `seconds`, sleeping as the node asks; gives (time in s, byte) of everything published, and the rest.
fn play(
    settings: &Settings,
    messages: Vec<Message>,
    events: &[(u64, Event)],
    seconds: u64,
) -> (Vec<(f64, u8)>, Vec<Output>) {
    let mut node = PlayerNode::new(settings, START, source(messages), 0).expect("the settings are valid");
    let mut events = events.to_vec();
    let (mut played, mut others, mut now, mut event) = (Vec::new(), Vec::new(), 0, Event::Tick);
    loop {
        let mut wake = u64::MAX;
        for output in node.step(now, event) {
            match output {
                Output::Publish { cdr, .. } => played.push((now as f64 / 1e9, cdr[4])),
                Output::WakeAt(at) => wake = at,
                other => others.push(other),
            }
        }
        event = Event::Tick;
        if let Some((at, _)) = events.first()
            && *at <= wake
        {
            wake = *at;
            event = events.remove(0).1;
        }
        if wake > seconds * S {
            return (played, others);
        }
        now = wake.max(now);
    }
}

#[test]
fn messages_come_at_their_log_times_after_the_delay() {
    let (played, others) = play(&Settings::default(), messages(4), &[], 100);
    assert_eq!(played, [(1.0, 0), (2.0, 1), (3.0, 2), (4.0, 3)]);
    assert!(matches!(others[..], [Output::Finished(summary)] if summary.messages == 4 && summary.rounds == 1));
}

#[test]
fn rate_and_start_offset_scale_and_cut() {
    let settings = Settings { rate: 2.0, start_offset_s: 1.5, delay_s: 0.0, ..Settings::default() };
    let (played, _) = play(&settings, messages(4), &[], 100);
    assert_eq!(played, [(0.25, 2), (0.75, 3)]);
}

#[test]
fn topics_and_exclude_choose_by_whole_name() {
    let only = |topics: &[&str], exclude: &[&str]| {
        let strings = |list: &[&str]| list.iter().map(|text| (*text).to_owned()).collect();
        let settings = Settings { topics: strings(topics), exclude: strings(exclude), ..Settings::default() };
        play(&settings, messages(4), &[], 100).0.into_iter().map(|(_, byte)| byte).collect::<Vec<_>>()
    };
    assert_eq!(only(&["/a"], &[]), [0, 2]);
    assert_eq!(only(&[], &["/a"]), [1, 3]);
    assert_eq!(only(&["/."], &["/b"]), [0, 2]);
    assert_eq!(only(&["a"], &[]), [0_u8; 0]);
}

#[test]
fn a_pause_holds_messages_back_and_resuming_keeps_their_distances() {
    let events = [(2_500_000_000, Event::SetPaused(true)), (12_500_000_000, Event::SetPaused(false))];
    let (played, _) = play(&Settings::default(), messages(4), &events, 100);
    assert_eq!(played, [(1.0, 0), (2.0, 1), (13.0, 2), (14.0, 3)]);
}

#[test]
fn starting_paused_plays_nothing_until_resumed() {
    let settings = Settings { paused: true, ..Settings::default() };
    assert_eq!(play(&settings, messages(2), &[], 1_000).0, []);
    let (played, _) = play(&settings, messages(2), &[(30 * S, Event::SetPaused(false))], 1_000);
    assert_eq!(played, [(30.0, 0), (31.0, 1)]);
}

#[test]
fn a_loop_starts_over_at_once() {
    let settings = Settings { r#loop: true, delay_s: 0.0, ..Settings::default() };
    let (played, others) = play(&settings, messages(3), &[], 5);
    assert_eq!(played, [(0.0, 0), (1.0, 1), (2.0, 2), (2.0, 0), (3.0, 1), (4.0, 2), (4.0, 0), (5.0, 1)]);
    assert!(others.is_empty());
}

#[test]
fn a_loop_over_nothing_ends() {
    let settings = Settings { r#loop: true, topics: vec!["/none".to_owned()], ..Settings::default() };
    let (_, others) = play(&settings, messages(3), &[], 5);
    assert!(matches!(others[..], [Output::Finished(_)]));
}

#[test]
fn the_clock_ticks_with_the_bags_time_and_stands_in_a_pause() {
    let settings = Settings { clock_hz: 1.0, rate: 2.0, delay_s: 0.0, ..Settings::default() };
    let events = [(S / 2, Event::SetPaused(true)), (2 * S + S / 2, Event::SetPaused(false))];
    let (_, others) = play(&settings, messages(10), &events, 4);
    let clock: Vec<_> = others
        .iter()
        .filter_map(|output| match output {
            Output::Clock(ns) => Some((ns - START) as f64 / 1e9),
            _ => None,
        })
        .collect();
    assert_eq!(clock, [0.0, 1.0, 1.0, 2.0, 4.0]);
}

#[test]
fn the_bags_own_clock_is_left_out_only_when_the_player_makes_one() {
    let clock = Arc::new(Topic::ros2("/clock", "rosgraph_msgs/msg/Clock", "", &[]));
    let recorded: Vec<_> =
        messages(2).into_iter().map(|message| Message { topic: Arc::clone(&clock), ..message }).collect();
    let played = |clock_hz| play(&Settings { clock_hz, ..Settings::default() }, recorded.clone(), &[], 100).0.len();
    assert_eq!((played(0.0), played(0.5)), (2, 0));
}

#[test]
fn messages_that_are_no_cdr_are_counted_told_once_and_left_out() {
    let mut bad = messages(5);
    bad[1].data = vec![1, 2];
    bad[3].data = Vec::new();
    let (played, others) = play(&Settings::default(), bad, &[], 100);
    assert_eq!(played.len(), 3);
    assert!(matches!(&others[..], [Output::Warn(text), Output::Finished(summary)]
        if text.starts_with("/b: ") && summary.malformed == 2 && summary.messages == 3));
}

#[test]
fn a_bag_that_breaks_on_the_way_says_so_after_what_was_good() {
    let items = messages(2);
    let source: Source = Box::new(move || {
        let broken = Err("the chunk at byte 99 is damaged".to_owned());
        Box::new(items.clone().into_iter().map(Ok).chain([broken]))
    });
    let settings = Settings { delay_s: 0.0, ..Settings::default() };
    let mut node = PlayerNode::new(&settings, START, source, 0).expect("the settings are valid");
    let outputs = node.step(60 * S, Event::Tick);
    assert_eq!(outputs.len(), 3);
    assert!(matches!(&outputs[2], Output::Failed(text, summary)
        if text.contains("byte 99") && summary.messages == 2));
    assert_eq!(node.step(61 * S, Event::Tick), [], "nothing follows the end");
}

#[test]
fn a_burst_is_cut_so_that_a_pause_is_heard() {
    let mut many: Vec<_> = std::iter::repeat_with(|| messages(1)).take(2_000).flatten().collect();
    many.iter_mut().for_each(|message| message.log_time = START);
    let settings = Settings { delay_s: 0.0, ..Settings::default() };
    let mut node = PlayerNode::new(&settings, START, source(many), 0).expect("the settings are valid");
    let first = node.step(0, Event::Tick);
    assert!(first.len() < 2_000 && first.last() == Some(&Output::WakeAt(0)));
    let paused = node.step(0, Event::SetPaused(true));
    assert_eq!(paused, [], "nothing goes out and nothing is due");
}
