//! What was found, to be read by a person.

use super::Arguments;
use super::arguments::ObjectiveName;
use super::found::{Found, first_few};
use super::inputs::Inputs;
use super::report::probabilities;
use super::words;
use crate::answer::{aligned, level, short};
use crate::judgement::counted;

/// More states than this are left to the JSON.
const SHOWN_STATES: usize = 40;
/// Width of text.
const WIDTH: usize = 100;

/// `robust`, `regret` or `evd`.
pub(super) fn kind(arguments: &Arguments) -> &'static str {
    match arguments.objective {
        ObjectiveName::Robust => "robust",
        ObjectiveName::Regret => "regret",
        ObjectiveName::Evd => "evd",
    }
}

/// Tables.
pub(super) fn text(arguments: &Arguments, inputs: &Inputs, found: &Found, seconds: f64) -> String {
    let solution = &found.solution;
    let n_draws = inputs.draws.n_rows();
    let mut text = format!(
        "Policy for {}, α = {}, λ = {}, {}: {}\n  {}\n\n{}\n\n",
        counted(n_draws, "draw"),
        level(solution.alpha),
        level(solution.lambda),
        kind(arguments),
        solution.outcome.name(),
        words::reason(solution),
        wrapped(&words::risk(arguments, solution, &found.neutral)),
    );
    let row = |name: &str, value: String| vec![name.to_owned(), value];
    let method = match solution.method {
        robust::Method::Direct => "linear program",
        robust::Method::ColumnGeneration => "column generation",
    };
    text += &aligned(&[
        row("objective, (1 − λ) CVaR + λ mean", short(solution.objective)),
        row("mean return", short(solution.expected_return)),
        row(&format!("VaR at {}", level(solution.alpha)), short(solution.value_at_risk)),
        row(&format!("CVaR at {}", level(solution.alpha)), short(solution.conditional_value_at_risk)),
        row("method", format!("{method}, {} in {seconds:.2} s", counted(solution.rounds, "round"))),
    ]);
    text += &baselines(found);
    text += &frontier(found);
    text += &fresh(arguments, found);
    text + &policy(inputs, found)
}

/// Lines of at most [`WIDTH`] characters, a little to the right.
fn wrapped(text: &str) -> String {
    let mut lines = vec![String::from(" ")];
    for word in text.split_whitespace() {
        let line = lines.last_mut().expect("there is a line");
        if line.chars().count() + 1 + word.chars().count() > WIDTH {
            lines.push(format!("  {word}"));
        } else {
            *line += &format!(" {word}");
        }
    }
    lines.join("\n")
}

fn baselines(found: &Found) -> String {
    let Some(baselines) = &found.baselines else { return String::new() };
    let heading = ["", "objective", "mean return", "VaR", "CVaR", "outcome"].map(str::to_owned).to_vec();
    let solution = &found.solution;
    let mut rows = vec![heading];
    let numbers = |title: &str, numbers: [f64; 4], outcome: &str| {
        let mut row = vec![title.to_owned()];
        row.extend(numbers.map(short));
        row.push(outcome.to_owned());
        row
    };
    let ours =
        [solution.objective, solution.expected_return, solution.value_at_risk, solution.conditional_value_at_risk];
    rows.push(numbers("this policy (BROIL)", ours, solution.outcome.name()));
    for baseline in baselines {
        let risk = &baseline.risk;
        let theirs = [risk.objective, risk.expected_return, risk.value_at_risk, risk.conditional_value_at_risk];
        rows.push(numbers(baseline.title, theirs, baseline.outcome));
    }
    format!("\nBeside others\n{}", aligned(&rows))
}

fn frontier(found: &Found) -> String {
    if found.frontier.is_empty() {
        return String::new();
    }
    let mut rows = vec![["λ", "mean return", "VaR", "CVaR", "outcome"].map(str::to_owned).to_vec()];
    for point in &found.frontier {
        rows.push(vec![
            level(point.lambda),
            short(point.expected_return),
            short(point.value_at_risk),
            short(point.conditional_value_at_risk),
            point.outcome.name().to_owned(),
        ]);
    }
    format!("\nFrontier: what caution costs\n{}", aligned(&rows))
}

fn fresh(arguments: &Arguments, found: &Found) -> String {
    let Some((fresh, _)) = &found.fresh else { return String::new() };
    let claimed = found.solution.conditional_value_at_risk;
    let [low, high] = fresh.interval;
    let verdict = if claimed > high {
        "the draws it was chosen by flatter it"
    } else if claimed < low {
        "it does better than on the draws it was chosen by"
    } else {
        "the draws it was chosen by agree"
    };
    format!(
        "\nOn {} other draws, worth {:.0} independent ones there: CVaR {} [{}, {}] at confidence {}; {verdict} ({})\n",
        fresh.n,
        fresh.effective_size,
        short(fresh.conditional_value_at_risk),
        short(low),
        short(high),
        level(arguments.confidence),
        short(claimed)
    )
}

fn policy(inputs: &Inputs, found: &Found) -> String {
    let mdp = &inputs.mdp;
    let (n_states, n_actions) = (mdp.n_states(), mdp.n_actions());
    let mut text = String::new();
    if n_states > SHOWN_STATES {
        text += &format!("\nThe policy in {n_states} states: with --json\n");
    } else {
        let mut rows = vec![["state", "visits", "what it does there"].map(str::to_owned).to_vec()];
        let policy = probabilities(&found.solution.policy, n_actions);
        for state in 0..n_states {
            let visits: f64 = found.solution.occupancy[state * n_actions..][..n_actions].iter().sum();
            let does = if mdp.is_terminal(state) {
                "end".to_owned()
            } else {
                actions(&policy[state * n_actions..][..n_actions], mdp.actions())
            };
            rows.push(vec![state.to_string(), format!("{visits:.3}"), does]);
        }
        text += &format!("\nPolicy, with discounted visits\n{}", aligned(&rows));
    }
    if !found.solution.unvisited.is_empty() {
        text += &format!(
            "  never visited: {} ({}), where it does what is best for the mean reward\n",
            counted(found.solution.unvisited.len(), "state"),
            first_few(&found.solution.unvisited)
        );
    }
    text
}

/// `right 0.83, down 0.17`, most often first.
pub(super) fn actions(row: &[f64], names: &[String]) -> String {
    let mut order: Vec<usize> = (0..row.len()).filter(|&action| row[action] > 5e-4).collect();
    order.sort_by(|&a, &b| row[b].total_cmp(&row[a]).then(a.cmp(&b)));
    let name = |action: usize| names.get(action).cloned().unwrap_or_else(|| format!("action {action}"));
    match order[..] {
        [only] => name(only),
        _ => order.iter().map(|&action| format!("{} {:.2}", name(action), row[action])).collect::<Vec<_>>().join(", "),
    }
}

#[cfg(test)]
mod tests {
    use super::{actions, wrapped};

    #[test]
    fn actions_are_told_most_often_first() {
        let names = ["up", "down"].map(str::to_owned);
        assert_eq!(actions(&[0.25, 0.75], &names), "down 0.75, up 0.25");
        assert_eq!(actions(&[1.0, 1e-9], &names), "up");
        assert_eq!(actions(&[0.5, 0.5, 0.0], &[]), "action 0 0.50, action 1 0.50");
    }

    #[test]
    fn lines_are_short() {
        let text = wrapped(&"many words ".repeat(60));
        assert!(text.lines().count() > 5 && text.lines().all(|line| line.chars().count() <= 100));
    }
}
