//! Loss as a share of what a reference policy loses: 0 is optimal, 1 no better than the reference.

use crate::error::{RiskError, check_finite, check_length};

/// The policy that a loss is measured against, by name, since the number means nothing without it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reference<'a> {
    /// What the policy is, say `uniform random`.
    pub name: &'a str,
    /// Its loss V* − V^ref under each draw.
    pub losses: &'a [f64],
}

/// Normalised losses, one a draw.
#[derive(Debug, Clone, PartialEq)]
pub struct NormalisedLosses {
    /// (V* − V^π) / max(V* − V^ref, floor).
    pub values: Vec<f64>,
    /// Name of the reference policy.
    pub reference: String,
    /// Draws under which the reference loses less than the floor, so that the floor divides.
    pub n_floored: usize,
}

/// (V* − V^π) / (V* − V^ref) under each draw (method notes 1.8): unlike the division by V* of the dissertation's eq. 8.5 it
/// has a sign of its own, and adding a constant to the reward changes nothing.
///
/// `losses` holds V* − V^π under each draw. A draw under which the reference is nearly optimal would divide by almost nothing:
/// `floor`, in the unit of the losses, is the least that divides.
///
/// # Errors
/// Unequally many losses, one that is not finite, or a floor that is not positive and finite.
pub fn normalised_losses(losses: &[f64], reference: &Reference<'_>, floor: f64) -> Result<NormalisedLosses, RiskError> {
    check_length("losses of the reference policy", reference.losses.len(), losses.len())?;
    check_finite("loss", losses)?;
    check_finite("loss of the reference policy", reference.losses)?;
    if !(floor > 0.0 && floor.is_finite()) {
        return Err(RiskError::Parameter { name: "the floor", got: floor, expected: "positive and finite" });
    }
    let values =
        losses.iter().zip(reference.losses).map(|(loss, of_reference)| loss / of_reference.max(floor)).collect();
    let n_floored = reference.losses.iter().filter(|&&loss| loss < floor).count();
    Ok(NormalisedLosses { values, reference: reference.name.to_owned(), n_floored })
}

#[cfg(test)]
mod tests {
    use super::{Reference, normalised_losses};
    use proptest::prelude::{prop_assert, proptest};

    #[test]
    fn is_a_share_of_the_references_loss() {
        let reference = Reference { name: "uniform random", losses: &[4.0, 2.0, 1e-9] };
        let normalised = normalised_losses(&[1.0, 2.0, 1e-3], &reference, 0.01).expect("finite losses");
        assert_eq!(normalised.values, [0.25, 1.0, 0.1]);
        assert_eq!((normalised.reference.as_str(), normalised.n_floored), ("uniform random", 1));
    }

    #[test]
    fn refuses_bad_input() {
        let reference = Reference { name: "uniform random", losses: &[4.0] };
        assert!(normalised_losses(&[1.0, 2.0], &reference, 0.01).is_err());
        assert!(normalised_losses(&[f64::NAN], &reference, 0.01).is_err());
        let error = normalised_losses(&[1.0], &reference, 0.0).expect_err("refused");
        assert_eq!(error.to_string(), "the floor is 0, but must be positive and finite");
    }

    proptest! {
        /// The optimal value may be negative or zero: only differences enter.
        #[test]
        fn the_sign_of_the_optimal_value_does_not_matter(optimal in -5.0..5.0_f64, own in 0.0..3.0_f64, other in 0.1..3.0_f64) {
            let losses = [optimal - (optimal - own)];
            let of_reference = [optimal - (optimal - other)];
            let reference = Reference { name: "uniform random", losses: &of_reference };
            let value = normalised_losses(&losses, &reference, 1e-6).expect("finite losses").values[0];
            prop_assert!((value - own / other).abs() < 1e-12);
        }
    }
}
