//! The sentences a person reads when what was said speaks against the model, and when a question is not worth asking.

/// That what was said does not fit, by the posterior-predictive check.
pub(crate) fn misfit(p_value: f64, features: &[String]) -> String {
    let odds = if p_value > 0.0 { format!("1 in {:.0}", 1.0 / p_value) } else { "less than 1 in 2,000".to_owned() };
    format!(
        "what you said cannot all be explained with {}: under the rewards that fit best, answers as odd as yours come about in {odds} \
         lessons. Take back what you did not mean; if you meant all of it, I lack a feature that you go by",
        list(features)
    )
}

/// That too many answers were not expected.
pub(crate) fn surprised(surprises: u64, n: u64, features: &[String]) -> String {
    format!(
        "of {n} answers to questions that I drew at random, {surprises} were not what I expected, and 1 in 10 should be: what I learned \
         from you does not say what you do. Take back what you did not mean; if you meant all of it, {} are not all that you go by",
        list(features)
    )
}

/// That the bound is good, and still to be confirmed by `n` answers without a surprise.
pub(crate) fn unconfirmed(reason: &str, n: u32, most: f64, is_over: bool) -> String {
    let answers = if n == 1 { "1 answer".to_owned() } else { format!("{n} answers") };
    let end = if is_over { "; raise max_questions" } else { "" };
    format!(
        "{reason}, but about {answers} to questions drawn at random, as I expect them, are missing to show that no more than {:.0} % of \
         your answers would surprise me{end}",
        100.0 * most
    )
}

/// That no question is worth the person's time.
pub(crate) fn not_worth_it(gain_per_second: f64, least: f64) -> String {
    format!(
        "the best question I could ask is expected to tell {gain_per_second:.2e} nats for each second of your time, less than \
         least_gain_per_second = {least}, and the bound is not good yet"
    )
}

/// "path, lawn and mud".
fn list(names: &[String]) -> String {
    match names {
        [] => "nothing".to_owned(),
        [one] => one.clone(),
        [first @ .., last] if first.len() < 8 => format!("{} and {last}", first.join(", ")),
        many => format!("the {} features", many.len()),
    }
}
