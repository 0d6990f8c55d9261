//! What a policy promises, in a sentence.

use crate::Settings;
use crate::settings::Objective;
use robust::{OutOfSample, Outcome, Solution};

/// The claim of a solution, with what is missing when it is not proved the best.
pub(crate) fn claim(settings: &Settings, solution: &Solution, held_out: Option<&OutOfSample>) -> String {
    let share = percent(1.0 - solution.alpha);
    let mean = number(solution.expected_return);
    let worst = solution.conditional_value_at_risk;
    let tail = match settings.objective {
        Objective::Robust => format!("the policy returns {} on average", number(worst)),
        Objective::Regret if worst >= 0.0 => {
            format!("the policy returns {} more on average than what was shown", number(worst))
        }
        Objective::Regret => format!("the policy returns {} less on average than what was shown", number(-worst)),
        Objective::Evd => format!("the policy loses {} on average against the best that can be done", number(-worst)),
    };
    let mut text = format!(
        "with λ = {:.2} the mean return is {mean}; in the worst {share} % of what the person may mean, {tail}",
        solution.lambda
    );
    if let Some(fresh) = held_out {
        let [low, high] = fresh.interval;
        text += &format!(
            " (on {} draws that did not choose it {}, {} % sure between {} and {})",
            fresh.n,
            number(fresh.conditional_value_at_risk),
            percent(settings.confidence),
            number(low),
            number(high)
        );
    }
    let gap = number(solution.gap());
    match solution.outcome {
        Outcome::Optimal => {}
        Outcome::IterationLimit => {
            text += &format!(
                "; not proved the best: the steps allowed did not suffice, and another policy may be better by up to {gap}; \
                 raise max_rounds or max_iterations"
            );
        }
        _ => text += &format!("; not proved the best: another policy may be better by up to {gap}"),
    }
    text
}

/// Why the policy of a solution cannot be given at all.
pub(crate) fn no_policy(outcome: Outcome) -> String {
    let what = match outcome {
        Outcome::Infeasible => "the solver takes the problem for infeasible",
        Outcome::Unbounded => "the solver takes the problem for unbounded",
        Outcome::TimedOut => "the solver ran out of time",
        _ => "what the solver gave is no policy of this world",
    };
    format!("no policy, because {what}; a larger tolerance or fewer draws may help")
}

/// A share as a percentage, without decimals that say nothing.
fn percent(share: f64) -> String {
    let tenths = (1000.0 * share).round() / 10.0;
    if tenths.fract() == 0.0 { format!("{tenths:.0}") } else { format!("{tenths:.1}") }
}

/// A return to three decimals, never −0.
fn number(value: f64) -> String {
    let rounded = (1000.0 * value).round() / 1000.0;
    format!("{:.3}", rounded + 0.0)
}

#[cfg(test)]
mod tests {
    use super::{number, percent};

    #[test]
    fn numbers_are_short_and_zero_has_no_sign() {
        assert_eq!((number(-0.00001), number(1.23456)), ("0.000".to_owned(), "1.235".to_owned()));
        let shares = [percent(1.0 - 0.95), percent(1.0 - 0.999), percent(0.5)];
        assert_eq!(shares, ["5", "0.1", "50"]);
    }
}
