//! How many chains a file of draws holds, when nobody says so.

use super::{MIN_CHAINS, counted, quantile_needs};
use crate::OfflineError;
use crate::evidence::flag;

/// Chains in `n` draws: as given, else four. Where four do not fit and there are too few draws for a bound anyway: one.
///
/// # Errors
/// Draws that do not divide into the chains given; enough draws for a bound that do not divide into four.
pub(crate) fn n_chains(
    file: &str,
    n: usize,
    given: Option<usize>,
    alpha: f64,
    delta: f64,
) -> Result<usize, OfflineError> {
    let n_chains = given.unwrap_or(MIN_CHAINS);
    if n_chains > 0 && n.is_multiple_of(n_chains) {
        return Ok(n_chains);
    }
    if given.is_none() && n < quantile_needs(alpha, delta, MIN_CHAINS) {
        return Ok(1);
    }
    let what = if given.is_none() { "expected the number of chains" } else { "expected another number" };
    let problem = format!(
        "got {}, {what}: the {n} draws in {file} do not divide into {} of equal length",
        given.map_or_else(|| "none".to_owned(), |given| given.to_string()),
        counted(n_chains, "chain")
    );
    Err(flag("--chains", problem))
}

#[cfg(test)]
mod tests {
    use super::n_chains;

    #[test]
    fn four_chains_unless_told_otherwise() {
        let chains = |n, given| n_chains("f", n, given, 0.95, 0.05).map_err(|error| error.to_string());
        assert_eq!(chains(4000, None), Ok(4));
        assert_eq!(chains(4000, Some(8)), Ok(8));
        assert_eq!(chains(58, None), Ok(1));
        assert_eq!(chains(1, None), Ok(1));
        assert_eq!(
            chains(4001, None),
            Err("--chains: got none, expected the number of chains: the 4001 draws in f do not divide into 4 chains of \
                 equal length"
                .into())
        );
        assert!(chains(58, Some(4)).expect_err("refused").contains("got 4, expected another number: the 58 draws"));
        assert!(chains(58, Some(0)).is_err());
    }
}
