//! How rational a person is taken to be, as a flag says it: `5`, `learn`, `learn:10:2`.

use posterior::Rationality;

/// Median of the prior of a learned β where the flag names none: returns of the order of 1, β = 0.2 to 500 with 95 %.
pub const LEARNED_MEDIAN: f64 = 10.0;
/// Standard deviation of ln β where the flag names none.
pub const LEARNED_LOG_SD: f64 = 2.0;

/// Reads a β: a positive number, or `learn[:MEDIAN[:LOG_SD]]`.
///
/// # Errors
/// Anything else, in words.
pub fn parse_beta(text: &str) -> Result<Rationality, String> {
    let positive = |part: &str, what: &str| match part.trim().parse::<f64>() {
        Ok(value) if value > 0.0 && value.is_finite() => Ok(value),
        _ => {
            Err(format!("got {what} '{part}', expected a positive number, or learn, learn:MEDIAN, learn:MEDIAN:LOG_SD"))
        }
    };
    let mut parts = text.split(':');
    if parts.next().map(str::trim) != Some("learn") {
        return positive(text, "beta").map(Rationality::Fixed);
    }
    let median = parts.next().map_or(Ok(LEARNED_MEDIAN), |part| positive(part, "a median of beta"))?;
    let log_sd = parts.next().map_or(Ok(LEARNED_LOG_SD), |part| positive(part, "a standard deviation of ln beta"))?;
    match parts.next() {
        None => Ok(Rationality::Learned { median, log_sd }),
        Some(more) => Err(format!("got '{more}' after the standard deviation, expected nothing there")),
    }
}

#[cfg(test)]
mod tests {
    use super::{LEARNED_LOG_SD, LEARNED_MEDIAN, parse_beta};
    use posterior::Rationality;

    #[test]
    fn beta_is_a_number_or_learned() {
        assert_eq!(parse_beta("2.5"), Ok(Rationality::Fixed(2.5)));
        let learned = |median, log_sd| Ok(Rationality::Learned { median, log_sd });
        assert_eq!(parse_beta("learn"), learned(LEARNED_MEDIAN, LEARNED_LOG_SD));
        assert_eq!(parse_beta("learn:3"), learned(3.0, LEARNED_LOG_SD));
        assert_eq!(parse_beta("learn:3:0.5"), learned(3.0, 0.5));
        for bad in ["", "0", "-1", "nan", "inf", "learnt", "learn:", "learn:0", "learn:1:x", "learn:1:1:1"] {
            assert!(parse_beta(bad).is_err(), "{bad}");
        }
    }
}
