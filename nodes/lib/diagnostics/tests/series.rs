//! Diagnostics against ArviZ 0.23.4, and the cases it leaves open.

use posterior::diagnostics::{Series, SeriesError};
use proptest::prelude::{prop_assert, proptest};

/// Uniform numbers from a linear congruential generator: the same formula made the reference values.
struct Uniform(u64);

impl Uniform {
    fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15).wrapping_add(0x0123_4567))
    }

    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// m autoregressive chains, chain c shifted by `shift` c, cut to multiples of 1 / `cut` unless that is 0.
struct Golden {
    seed: u64,
    m: usize,
    n: usize,
    rho: f64,
    shift: f64,
    cut: f64,
    /// R̂, bulk, tail and 0.9-quantile ESS, ESS of the mean, standard error of the mean.
    want: [f64; 6],
}

impl Golden {
    fn draws(&self) -> Vec<f64> {
        let mut draws = Vec::new();
        for c in 0..self.m {
            let mut uniform = Uniform::new(self.seed * 100 + c as u64);
            let mut x = 0.0;
            for _ in 0..self.n {
                let e = uniform.next() + uniform.next() + uniform.next() + uniform.next() - 2.0;
                x = self.rho * x + e;
                let y = x + self.shift * c as f64;
                draws.push(if self.cut > 0.0 { (y * self.cut).trunc() } else { y });
            }
        }
        draws
    }
}

#[rustfmt::skip]
const GOLDEN: [Golden; 7] = [
        Golden { seed: 1, m: 4, n: 1000, rho: 0.0, shift: 0.0, cut: 0.0, want: [1.0001593830910798, 3787.9605703684983, 4010.353682968722, 4124.027792934508, 3852.6774012795136, 0.009178734627260782] },
        Golden { seed: 2, m: 4, n: 1000, rho: 0.9, shift: 0.0, cut: 0.0, want: [1.0209669752436206, 192.19311127185586, 396.26033134745717, 269.39283074664417, 191.05639536269416, 0.09836228576746756] },
        Golden { seed: 3, m: 4, n: 251, rho: 0.5, shift: 0.1, cut: 0.0, want: [1.037103289066103, 116.67591018637873, 455.23765116631847, 383.8528612101769, 119.48409926435718, 0.05999130782242453] },
        Golden { seed: 4, m: 6, n: 500, rho: -0.6, shift: 0.0, cut: 0.0, want: [1.002374059274677, 10431.363764158988, 2514.160066086752, 3362.711604489695, 10431.363764158988, 0.007070594338835166] },
        Golden { seed: 5, m: 4, n: 400, rho: 0.7, shift: 0.0, cut: 3.0, want: [1.018057473331096, 281.4887073517784, 456.0366682236026, 418.6275315333714, 284.1821092230613, 0.1227641733242529] },
        Golden { seed: 6, m: 4, n: 100, rho: 0.99, shift: 2.0, cut: 0.0, want: [1.8405906200799964, 6.177484439766211, 15.012711397959077, 10.972238458486116, 6.226008114651719, 1.0538724658174643] },
        Golden { seed: 7, m: 4, n: 40, rho: 0.3, shift: 0.0, cut: 1.0, want: [1.013058811743707, 148.54919618978687, 125.92120207228713, 125.92120207228713, 148.5911850633465, 0.02506552066712499] },
];

#[test]
fn agrees_with_arviz() {
    for golden in GOLDEN {
        let draws = golden.draws();
        let series = Series::new(&draws, golden.m).expect("finite chains");
        let got = [
            series.rhat(),
            series.ess_bulk(),
            series.ess_tail(),
            series.ess_quantile(0.9),
            series.ess_mean(),
            series.mcse_mean(),
        ];
        for (got, want) in got.iter().zip(golden.want) {
            assert!((got / want - 1.0).abs() < 1e-9, "seed {}: {got:?} vs {want:?}", golden.seed);
        }
    }
}

#[test]
fn equal_draws_count_in_full_and_stuck_chains_are_seen() {
    let zeros = [0.0; 400];
    let series = Series::new(&zeros, 4).expect("finite chains");
    assert_eq!((series.rhat(), series.ess_bulk(), series.ess_tail()), (1.0, 400.0, 400.0));

    let stuck: Vec<f64> = (0..400).map(|i| f64::from(i / 100)).collect();
    assert!(Series::new(&stuck, 4).expect("finite chains").rhat().is_infinite());

    // Two modes, each visited by two chains that mix well within it.
    let mut uniform = Uniform::new(1);
    let two_modes: Vec<f64> = (0..4000).map(|i| uniform.next() + f64::from(i / 2000)).collect();
    assert!(Series::new(&two_modes, 4).expect("finite chains").rhat() > 1.5);
    // Chains of equal place but unequal scale: only folding sees it.
    let two_scales: Vec<f64> = (0..4000).map(|i| (uniform.next() - 0.5) * f64::from(1 + i / 2000)).collect();
    assert!(Series::new(&two_scales, 4).expect("finite chains").rhat() > 1.05);
}

#[test]
fn refuses_what_it_cannot_judge() {
    assert_eq!(Series::new(&[0.0; 10], 4).expect_err("refused"), SeriesError::Ragged { n: 10, n_chains: 4 });
    assert_eq!(Series::new(&[0.0; 10], 0).expect_err("refused"), SeriesError::Ragged { n: 10, n_chains: 0 });
    assert_eq!(Series::new(&[0.0; 12], 4).expect_err("refused"), SeriesError::TooShort { got: 3, needed: 4 });
    assert_eq!(Series::new(&[], 4).expect_err("refused"), SeriesError::TooShort { got: 0, needed: 4 });
    let mut draws = [0.0; 40];
    draws[7] = f64::NEG_INFINITY;
    assert_eq!(
        Series::new(&draws, 4).expect_err("refused"),
        SeriesError::NotFinite { index: 7, value: f64::NEG_INFINITY }
    );
}

proptest! {
    #[test]
    fn ranks_ignore_monotone_maps(seed in 0_u64..1000) {
        let golden = Golden { seed, m: 4, n: 50, rho: 0.5, shift: 0.0, cut: 0.0, want: [0.0; 6] };
        let draws = golden.draws();
        let cubes: Vec<f64> = draws.iter().map(|x| x * x * x).collect();
        let (a, b) = (Series::new(&draws, 4).expect("finite"), Series::new(&cubes, 4).expect("finite"));
        prop_assert!((a.ess_bulk() - b.ess_bulk()).abs() < 1e-9 * a.ess_bulk());
        prop_assert!((a.ess_indicator(0.3) - b.ess_indicator(0.3 * 0.3 * 0.3)).abs() < 1e-9 * a.ess_indicator(0.3));
    }

    #[test]
    fn effective_sizes_stay_in_range(draws in proptest::collection::vec(-3_i32..3, 32..33), chains in 1_usize..5) {
        let draws: Vec<f64> = draws.into_iter().map(f64::from).collect();
        let chains = [1, 2, 4, 8][chains - 1];
        let series = Series::new(&draws, chains).expect("finite");
        for ess in [series.ess_bulk(), series.ess_tail(), series.ess_mean()] {
            prop_assert!(ess > 0.0 && ess <= 32.0 * 32.0_f64.log10() + 1e-9, "{ess}");
        }
        prop_assert!(series.rhat() >= 0.0);
    }
}
