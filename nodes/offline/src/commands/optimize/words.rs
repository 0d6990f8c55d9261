//! The risk of a policy in words.

use robust::{Outcome, Risk, Solution};

use super::Arguments;
use super::arguments::ObjectiveName;
use crate::answer::{level, short};

/// What is known of the answer.
pub(super) fn reason(solution: &Solution) -> String {
    let gap = short(solution.gap());
    match solution.outcome {
        Outcome::Optimal => format!("no policy's objective is larger by more than {gap}"),
        Outcome::Inaccurate => format!(
            "rounding kept the search from coming closer: another policy's objective may be larger by up to {gap}"
        ),
        Outcome::IterationLimit => format!(
            "the rounds or iterations allowed did not suffice: another policy's objective may be larger by up to {gap}"
        ),
        Outcome::TimedOut => {
            format!("the solver ran out of time: another policy's objective may be larger by up to {gap}")
        }
        Outcome::Infeasible => {
            "the solver takes the problem for infeasible: its numbers may be too large or too small".into()
        }
        Outcome::Unbounded => {
            "the solver takes the problem for unbounded: its numbers may be too large or too small".into()
        }
        Outcome::ConstraintsViolated => format!(
            "the visits do not satisfy the constraints (flow off by {}): do not use this policy",
            short(solution.checks.flow_residual)
        ),
    }
}

/// `5 %` of the rewards.
fn percent(share: f64) -> String {
    format!("{} %", level(100.0 * share))
}

/// Two or three sentences: what the policy is worth on average and at the bad end, and what that costs against the policy that is best on
/// average.
pub(super) fn risk(arguments: &Arguments, solution: &Solution, neutral: &Risk) -> String {
    let alpha = arguments.alpha;
    let (tail, rest) = (percent(1.0 - alpha), percent(alpha));
    let (mean, var, cvar) = (solution.expected_return, solution.value_at_risk, solution.conditional_value_at_risk);
    let mut text = format!("On average over the rewards that fit, this policy returns {}. ", short(mean));
    text += &match arguments.objective {
        ObjectiveName::Robust if alpha == 0.0 => String::new(),
        ObjectiveName::Robust => {
            format!(
                "Under {rest} of them it returns {} or more; under the worst {tail} it returns {} on average. ",
                short(var),
                short(cvar)
            )
        }
        ObjectiveName::Regret if alpha == 0.0 => format!("That is {} than the expert's. ", apart(cvar)),
        ObjectiveName::Regret => format!(
            "Under {rest} of them that is at least {} than the expert's; under the worst {tail} it is {} on average. ",
            apart(var),
            apart(cvar)
        ),
        ObjectiveName::Evd if alpha == 0.0 => {
            format!("It loses {} on average against the best policy for each. ", short(loss(cvar)))
        }
        ObjectiveName::Evd => format!(
            "Under {rest} of them it loses at most {} against the best policy for that reward; under the worst {tail} it loses {} on \
             average. ",
            short(loss(var)),
            short(loss(cvar))
        ),
    };
    text + &against_neutral(&tail, solution, neutral)
}

/// `0.5 more`, `0.5 less`.
fn apart(difference: f64) -> String {
    format!("{} {}", short(difference.abs()), if difference < 0.0 { "less" } else { "more" })
}

/// A loss, which is never below zero but for rounding.
fn loss(value: f64) -> f64 {
    (-value).max(0.0)
}

fn against_neutral(tail: &str, solution: &Solution, neutral: &Risk) -> String {
    let given = neutral.expected_return - solution.expected_return;
    let gained = solution.conditional_value_at_risk - neutral.conditional_value_at_risk;
    // What is within the tolerance is no difference.
    let rounding = 1e-6 * solution.unit;
    if gained.abs() <= rounding && given.abs() <= rounding {
        return "No caution pays here: it is the policy that is best on average.".to_owned();
    }
    if given <= rounding {
        return format!("It gives up nothing on average and is {} better under the worst {tail}.", short(gained));
    }
    format!(
        "Against the policy that is best on average it gives up {} of the mean and gains {} under the worst {tail}.",
        short(given),
        short(gained)
    )
}
