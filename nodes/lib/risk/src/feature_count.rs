//! The worst-case feature count bound of the dissertation's section 4.3: a baseline that knows only feature counts.

use crate::error::{RiskError, check_finite, check_length};

/// ‖Φ_expert − Φ_policy‖_∞ (eq. 4.16): no reward with ‖w‖₁ ≤ 1 loses more by following the policy instead of the expert.
///
/// `expert` and `policy` are discounted feature counts of equal length. It bounds the loss against the *optimal* policy only
/// if the expert is optimal and `expert` are its true counts; counts estimated from a few or from partial demonstrations
/// carry no such promise.
///
/// # Errors
/// No features, unequal numbers of them, or a count that is not finite.
pub fn worst_case_feature_count_bound(expert: &[f64], policy: &[f64]) -> Result<f64, RiskError> {
    if expert.is_empty() {
        return Err(RiskError::Empty { what: "expert feature counts" });
    }
    check_length("feature counts of the policy", policy.len(), expert.len())?;
    check_finite("feature count of the expert", expert)?;
    check_finite("feature count of the policy", policy)?;
    Ok(expert.iter().zip(policy).map(|(e, p)| (e - p).abs()).fold(0.0, f64::max))
}

#[cfg(test)]
mod tests {
    use super::worst_case_feature_count_bound;
    use crate::error::RiskError;
    use proptest::prelude::{prop_assert, proptest};

    #[test]
    fn is_the_largest_difference() {
        assert_eq!(worst_case_feature_count_bound(&[1.0, 5.0, 2.0], &[1.5, 2.0, 4.0]), Ok(3.0));
        assert_eq!(worst_case_feature_count_bound(&[1.0], &[1.0]), Ok(0.0));
    }

    #[test]
    fn refuses_bad_input() {
        assert!(matches!(worst_case_feature_count_bound(&[], &[]), Err(RiskError::Empty { .. })));
        let error = worst_case_feature_count_bound(&[1.0, 2.0], &[1.0]).expect_err("refused");
        assert_eq!(error.to_string(), "1 feature counts of the policy, but 2 are needed");
        let error = worst_case_feature_count_bound(&[1.0, f64::NAN], &[1.0, 2.0]).expect_err("refused");
        assert_eq!(error.to_string(), "feature count of the expert 1 is NaN, not a finite number");
    }

    proptest! {
        #[test]
        fn no_reward_on_the_l1_ball_loses_more_and_a_vertex_loses_it_all(
            counts in proptest::collection::vec((-5.0..5.0_f64, -5.0..5.0_f64, -1.0..1.0_f64), 1..9),
        ) {
            let expert: Vec<f64> = counts.iter().map(|c| c.0).collect();
            let policy: Vec<f64> = counts.iter().map(|c| c.1).collect();
            let bound = worst_case_feature_count_bound(&expert, &policy).expect("finite counts");
            let norm: f64 = counts.iter().map(|c| c.2.abs()).sum();
            let loss: f64 = counts.iter().map(|c| c.2 / norm.max(1e-9) * (c.0 - c.1)).sum();
            prop_assert!(loss <= bound + 1e-9);
            prop_assert!(counts.iter().any(|c| (c.0 - c.1).abs() == bound));
        }
    }
}
