//! How processes and lessons ended, in words.

use crate::{Exit, Summary};

/// How a process ended.
pub(crate) fn told(exit: &Exit) -> String {
    match exit {
        Exit::Code(code) => format!("exit code {code}"),
        Exit::Signal(signal) => match signal_hook::low_level::signal_name(*signal) {
            Some(name) => format!("killed by {name}, signal {signal}"),
            None => format!("killed by signal {signal}"),
        },
        Exit::NotStarted(reason) => format!("it cannot be started: {reason}"),
    }
}

/// The last lines that a person reads.
pub(crate) fn closing_words(summary: &Summary) -> Vec<String> {
    let centimetres = |m: Option<f64>| m.map_or("none".to_owned(), |m| format!("{:.1} cm", 100.0 * m));
    let milliseconds = |ms: Option<f64>| ms.map_or("none".to_owned(), |ms| format!("{ms:.0} ms"));
    let latency = summary.answer_to_next_question_ms;
    let state = format!("{}: {}", summary.state.replace('_', " "), summary.why);
    if let Some(policy) = &summary.policy {
        let percent = |share: Option<f64>| share.map_or("none".to_owned(), |share| format!("{:.1} %", 100.0 * share));
        let (bound, goal) = (percent(summary.last_bound_loss), percent(summary.epsilon_loss));
        let mut words = vec![
            state,
            format!(
                "{} pieces of evidence, last bound on the loss {bound} (\u{3b5} = {goal}), {:.1} s",
                summary.demonstrations, summary.wall_time_s
            ),
            policy.reason.clone(),
        ];
        words.extend(summary.bag.iter().map(|bag| format!("the bag is finished: {bag}")));
        return words;
    }
    let mut words = vec![
        state,
        format!(
            "{} questions, {} answers, last bound {} (\u{3b5} = {}), {:.1} s",
            summary.questions_asked,
            summary.answers,
            centimetres(summary.last_bound_m),
            centimetres(summary.epsilon_m),
            summary.wall_time_s
        ),
    ];
    if latency.n > 0 {
        let (p50, p99) = (milliseconds(latency.p50), milliseconds(latency.p99));
        words.push(format!("from an answer to the next question: median {p50}, 99th percentile {p99}"));
    }
    words.extend(summary.bag.iter().map(|bag| format!("the bag is finished: {bag}")));
    words
}
