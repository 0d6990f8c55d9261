//! Pareto smoothing against ArviZ 0.23.4, and the cases it leaves open.

mod common;

use common::Uniform;
use diagnostics::{WeightsError, khat_threshold, pareto_smooth, pareto_smooth_correlated};
use proptest::prelude::{prop_assert, proptest};

/// Log weights `spread` e³ for nearly normal e, cut to multiples of 1 / `cut` unless that is 0.
struct Case {
    seed: u64,
    n: usize,
    spread: f64,
    cut: f64,
    efficiency: f64,
    khat: f64,
    size: f64,
    /// The three largest smoothed log weights, ascending, and the first.
    largest: [f64; 3],
    first: f64,
}

impl Case {
    fn log_weights(&self) -> Vec<f64> {
        let mut uniform = Uniform::new(self.seed);
        (0..self.n)
            .map(|_| {
                let e = uniform.bell();
                let y = self.spread * e * e * e;
                if self.cut > 0.0 { (y * self.cut).trunc() } else { y }
            })
            .collect()
    }
}

#[rustfmt::skip]
const CASES: [Case; 8] = [
    Case { seed: 1, n: 1000, spread: 1.0, cut: 0.0, efficiency: 1.0, khat: 0.7518175092873809, size: 208.93341772316134, largest: [-3.8028977347325372, -3.42684828860233, -3.42684828860233], first: -7.253112960270826 },
    Case { seed: 2, n: 1001, spread: 3.0, cut: 0.0, efficiency: 1.0, khat: 2.4488844217009174, size: 1.2323492403550576, largest: [-4.048329282183805, -2.7973752093505277, -0.1070002563100374], first: -14.545317489077448 },
    Case { seed: 3, n: 4000, spread: 0.3, cut: 0.0, efficiency: 0.25, khat: 0.3478779618565253, size: 3813.5118908826544, largest: [-6.901144210130115, -6.793175311531407, -6.793175311531407], first: -8.425273377805624 },
    Case { seed: 4, n: 25, spread: 2.0, cut: 0.0, efficiency: 1.0, khat: 0.8061443205173001, size: 7.988539270893069, largest: [-2.591610340564566, -2.134420947166567, -1.198876869876678], first: -3.6780731112324814 },
    Case { seed: 5, n: 10000, spread: 8.0, cut: 0.0, efficiency: 0.1, khat: 5.938620237248849, size: 1.369071816240661, largest: [-4.929835711623223, -1.896236324621245, -0.17277649755657626], first: -42.917278464972625 },
    Case { seed: 6, n: 500, spread: 2.0, cut: 4.0, efficiency: 1.0, khat: 3.0335508433293414, size: 1.0999707815528903, largest: [-4.930687431184133, -3.3810214803642697, -0.048312132076378855], first: -17.267671533998215 },
    Case { seed: 7, n: 24, spread: 1.0, cut: 0.0, efficiency: 1.0, khat: 0.47379613406527255, size: 21.4648834727275, largest: [-2.8340586318950187, -2.7462343717421005, -2.5095044610931114], first: -2.9326006747609235 },
    Case { seed: 8, n: 777, spread: -2.0, cut: 0.0, efficiency: 1.0, khat: 1.612631870461774, size: 2.7392048012058203, largest: [-3.114836086068716, -2.293169325702083, -0.5228816149472175], first: -9.537407106794841 },
];

#[test]
fn agrees_with_arviz() {
    for case in CASES {
        let smoothed = pareto_smooth_correlated(&case.log_weights(), case.efficiency).expect("weights");
        let mut ascending = smoothed.log_weights.clone();
        ascending.sort_unstable_by(f64::total_cmp);
        let close = |got: f64, want: f64, what: &str| {
            assert!((got - want).abs() <= 1e-9 * want.abs(), "seed {}, {what}: {got} vs {want}", case.seed);
        };
        close(smoothed.khat, case.khat, "khat");
        close(smoothed.effective_size, case.size, "effective size");
        close(smoothed.log_weights[0], case.first, "first");
        for (got, want) in ascending[case.n - 3..].iter().zip(case.largest) {
            close(*got, want, "largest");
        }
    }
}

#[test]
fn knows_the_shape_of_pareto_weights() {
    // Weights U^(−k) have a Pareto tail of shape k. One estimate scatters by (1 + k)/√425, the mean of 30 by less than .02.
    for shape in [0.2, 0.5, 0.9] {
        let khat = |seed| {
            let mut uniform = Uniform::new(seed);
            let log_weights: Vec<f64> = (0..20_000).map(|_| -shape * (1.0 - uniform.next()).ln()).collect();
            pareto_smooth(&log_weights).expect("weights").khat
        };
        let mean = (0..30).map(|seed| khat(77 + seed)).sum::<f64>() / 30.0;
        assert!((mean - shape).abs() < 0.05, "{shape}: {mean}");
    }
}

#[test]
fn smoothing_makes_estimates_under_heavy_weights_steadier() {
    // Expectation 1 of the normaliser: E[(1 − k) U^(−k)] = 1 at k = 0.6.
    let (shape, worlds, n) = (0.6, 400_u64, 1000_usize);
    let (mut raw_error, mut smoothed_error) = (0.0, 0.0);
    for seed in 0..worlds {
        let mut uniform = Uniform::new(5000 + seed);
        let draws: Vec<f64> = (0..n).map(|_| 1.0 - uniform.next()).collect();
        let log_weights: Vec<f64> = draws.iter().map(|u: &f64| -shape * u.ln()).collect();
        // Under the weights u has the density (1 − k) u^(−k), so that its mean is (1 − k) / (2 − k).
        let truth = (1.0 - shape) / (2.0 - shape);
        let raw_total: f64 = log_weights.iter().map(|w| w.exp()).sum();
        let raw: f64 = log_weights.iter().zip(&draws).map(|(w, u)| w.exp() * u).sum::<f64>() / raw_total;
        let weights = pareto_smooth(&log_weights).expect("weights").weights();
        let smoothed: f64 = weights.iter().zip(&draws).map(|(w, u)| w * u).sum();
        raw_error += (raw - truth) * (raw - truth);
        smoothed_error += (smoothed - truth) * (smoothed - truth);
    }
    assert!(smoothed_error < 0.9 * raw_error, "smoothed {smoothed_error}, raw {raw_error}");
}

#[test]
fn equal_weights_have_no_tail() {
    let smoothed = pareto_smooth(&[-3.0; 1000]).expect("weights");
    assert_eq!(smoothed.khat, f64::NEG_INFINITY);
    assert!(smoothed.is_reliable() && (smoothed.effective_size - 1000.0).abs() < 1e-9);
    // Rounding noise does not make a tail.
    let noisy: Vec<f64> = (0..1000).map(|i| -3.0 + f64::from(i % 3) * 4e-16).collect();
    assert_eq!(pareto_smooth(&noisy).expect("weights").khat, f64::NEG_INFINITY);
}

#[test]
fn a_few_draws_that_carry_everything_are_not_trusted() {
    let mut log_weights = vec![f64::NEG_INFINITY; 1000];
    log_weights[17] = 2.0;
    let smoothed = pareto_smooth(&log_weights).expect("weights");
    assert_eq!((smoothed.khat, smoothed.is_reliable()), (f64::INFINITY, false));
    assert_eq!((smoothed.log_weights[17], smoothed.log_weights[0]), (0.0, f64::NEG_INFINITY));
    assert_eq!((smoothed.effective_size, smoothed.weights()[17]), (1.0, 1.0));
    assert!(!pareto_smooth(&[0.0]).expect("a weight").is_reliable());
}

#[test]
fn the_threshold_falls_with_fewer_draws() {
    assert_eq!((khat_threshold(10_000), khat_threshold(2200)), (0.7, 0.7));
    assert!((khat_threshold(100) - 0.5).abs() < 1e-15);
    assert!((khat_threshold(1000) - 2.0 / 3.0).abs() < 1e-15);
}

#[test]
fn refuses_what_are_no_weights() {
    assert_eq!(pareto_smooth(&[]), Err(WeightsError::Empty));
    assert_eq!(pareto_smooth(&[f64::NEG_INFINITY; 9]), Err(WeightsError::AllZero { n: 9 }));
    assert!(matches!(pareto_smooth(&[0.0, f64::NAN]), Err(WeightsError::NotAWeight { index: 1, .. })));
    assert_eq!(pareto_smooth(&[f64::INFINITY, 0.0]), Err(WeightsError::NotAWeight { index: 0, value: f64::INFINITY }));
    assert_eq!(pareto_smooth_correlated(&[0.0; 9], 0.0), Err(WeightsError::Efficiency { got: 0.0 }));
}

proptest! {
    #[test]
    fn weights_sum_to_one_and_never_pass_the_largest(
        log_weights in proptest::collection::vec(-50.0..50.0_f64, 1..300),
        efficiency in 0.01..2.0_f64,
    ) {
        let smoothed = pareto_smooth_correlated(&log_weights, efficiency).expect("weights");
        let total: f64 = smoothed.weights().iter().sum();
        prop_assert!((total - 1.0).abs() < 1e-9);
        prop_assert!(smoothed.effective_size >= 1.0 - 1e-9);
        prop_assert!(smoothed.effective_size <= log_weights.len() as f64 + 1e-9);
        prop_assert!(!smoothed.khat.is_nan());
    }

    #[test]
    fn a_constant_factor_changes_nothing(seed in 0_u64..200, factor in -300.0..300.0_f64) {
        let case = Case { seed, n: 200, ..CASES[0] };
        let (a, b) = (case.log_weights(), case.log_weights().iter().map(|w| w + factor).collect::<Vec<_>>());
        let (a, b) = (pareto_smooth(&a).expect("weights"), pareto_smooth(&b).expect("weights"));
        prop_assert!((a.khat - b.khat).abs() < 1e-6 && (a.effective_size - b.effective_size).abs() < 1e-6);
    }
}
