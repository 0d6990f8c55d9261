//! Policies that promise much on average and little for certain: how a policy looks that exploits what the posterior does not
//! know, like the no-op policies of the dissertation's Tables 6.7 and 6.8.

/// A gap between mean and floor is conspicuous from this multiple of the others' on.
const CONSPICUOUS: f64 = 2.0;

/// Why a policy deserves distrust, next to the others it was judged with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Warning {
    /// Median of the other policies' means; this one's is better.
    pub others_mean: f64,
    /// Median of the other policies' bounds (of their values at risk, when some have no bound); this one's is worse.
    pub others_floor: f64,
    /// Distance between this policy's mean and its bound, as a multiple of the others' median distance: above 2.
    pub gap_ratio: f64,
}

/// For each policy the warning that it deserves. `means` and `floors` are returns, a floor being a lower bound or a low
/// quantile; one each a policy.
///
/// A policy is warned of when, against the medians of the *other* policies, its mean is better, its floor is worse, and its
/// mean is more than twice as far from its floor. Adding a constant to all returns or scaling them changes nothing.
pub(crate) fn warnings(means: &[f64], floors: &[f64]) -> Vec<Option<Warning>> {
    let gaps: Vec<f64> = means.iter().zip(floors).map(|(mean, floor)| mean - floor).collect();
    let warning = |policy: usize| {
        let others_mean = median_without(means, policy)?;
        let others_floor = median_without(floors, policy)?;
        let gap_ratio = gaps[policy] / median_without(&gaps, policy)?.max(0.0);
        let conspicuous = means[policy] > others_mean && floors[policy] < others_floor && gap_ratio > CONSPICUOUS;
        conspicuous.then_some(Warning { others_mean, others_floor, gap_ratio })
    };
    (0..means.len()).map(warning).collect()
}

fn median_without(values: &[f64], left_out: usize) -> Option<f64> {
    let mut others: Vec<f64> = values[..left_out].iter().chain(&values[left_out + 1..]).copied().collect();
    others.sort_unstable_by(f64::total_cmp);
    let n = others.len();
    Some((others.get(n.checked_sub(1)? / 2)? + others[n / 2]) / 2.0)
}

#[cfg(test)]
mod tests {
    use super::warnings;
    use proptest::prelude::{prop_assert_eq, proptest};

    /// Name, mean and 0.05-VaR of each policy, and whether it is to be warned of.
    type Table = &'static [(&'static str, f64, f64, bool)];

    const TABLE_6_7: Table = &[
        ("A", 17.1, 7.9, false),
        ("B", 22.7, 11.9, false),
        ("C", 45.5, 24.9, false),
        ("D", 57.6, 31.5, false),
        ("No-Op", 102.5, -1557.1, true),
    ];
    const TABLE_6_8_BEFORE: Table = &[
        ("A", 1.5, 0.5, false),
        ("B", 6.3, 3.7, false),
        ("C", 10.6, 5.8, false),
        ("D", 13.9, 6.2, false),
        ("MAP", 98.2, -370.2, true),
        ("No-Op", 41.2, 1.0, true),
    ];
    const TABLE_6_8_AFTER: Table = &[
        ("A", 0.7, 0.3, false),
        ("B", 8.7, 5.5, false),
        ("C", 18.3, 12.1, false),
        ("D", 26.3, 17.1, false),
        ("MAP", 606.8, 289.1, false),
        ("No-Op", -5.0, -13.5, false),
    ];
    const TABLE_6_9: Table =
        &[("RL", 36.7, 19.5, false), ("Bayesian REX", 68.1, 38.1, false), ("Reward Hacking", 28.8, 10.2, false)];
    const TABLE_E_3: Table = &[
        ("A", 324.7, 48.2, false),
        ("B", 328.9, 52.0, false),
        ("C", 424.5, 135.8, false),
        ("D", 526.2, 192.9, false),
        ("Mean", 1206.9, 547.5, false),
        ("MAP", 395.2, 113.3, false),
        ("No-Op", 245.9, -31.7, false),
    ];
    /// Here the posterior is sure of the wrong thing, and no bound shows it: the dissertation asks for one more ranking.
    const TABLE_E_4_BEFORE: Table = &[
        ("A", 24.3, 10.8, false),
        ("B", 53.6, 24.1, false),
        ("C", 56.0, 25.4, false),
        ("D", 55.8, 25.3, false),
        ("No-Op", 2471.6, 842.5, false),
    ];

    #[test]
    fn flags_the_policies_that_the_dissertation_distrusts_and_no_other() {
        for table in [TABLE_6_7, TABLE_6_8_BEFORE, TABLE_6_8_AFTER, TABLE_6_9, TABLE_E_3, TABLE_E_4_BEFORE] {
            let means: Vec<f64> = table.iter().map(|row| row.1).collect();
            let floors: Vec<f64> = table.iter().map(|row| row.2).collect();
            for ((name, _, _, distrusted), warning) in table.iter().zip(warnings(&means, &floors)) {
                assert_eq!(warning.is_some(), *distrusted, "{name}: {warning:?}");
            }
        }
    }

    #[test]
    fn a_warning_says_what_it_was_measured_against() {
        let warning = warnings(&[10.0, 5.0], &[-100.0, 3.0])[0].expect("distrusted");
        assert_eq!((warning.others_mean, warning.others_floor, warning.gap_ratio), (5.0, 3.0, 55.0));
        // The only one that is certain makes every other conspicuous.
        assert_eq!(warnings(&[10.0, 5.0], &[-100.0, 5.0])[0].expect("distrusted").gap_ratio, f64::INFINITY);
    }

    #[test]
    fn near_ties_and_single_policies_are_no_reason() {
        assert_eq!(warnings(&[10.1, 10.0, 9.9], &[5.0, 5.1, 5.2]), [None, None, None]);
        assert_eq!(warnings(&[10.0], &[-1e9]), [None]);
        assert_eq!(warnings(&[], &[]), []);
        assert_eq!(warnings(&[1.0, 1.0], &[1.0, 1.0]), [None, None]);
    }

    proptest! {
        #[test]
        fn unit_and_origin_do_not_matter(
            policies in proptest::collection::vec((-9_i32..9, 0_i32..30), 1..9),
            power in -8_i32..8,
            shift in -64_i32..64,
        ) {
            let means: Vec<f64> = policies.iter().map(|p| f64::from(p.0)).collect();
            let floors: Vec<f64> = policies.iter().map(|p| f64::from(p.0 - p.1)).collect();
            // Powers of two and whole numbers: exact in binary.
            let map = |x: &f64| (x + f64::from(shift)) * 2.0_f64.powi(power);
            let (mapped_means, mapped_floors): (Vec<f64>, Vec<f64>) =
                (means.iter().map(map).collect(), floors.iter().map(map).collect());
            let flags = |warnings: Vec<Option<super::Warning>>| -> Vec<bool> {
                warnings.iter().map(Option::is_some).collect()
            };
            prop_assert_eq!(flags(warnings(&means, &floors)), flags(warnings(&mapped_means, &mapped_floors)));
        }
    }
}
