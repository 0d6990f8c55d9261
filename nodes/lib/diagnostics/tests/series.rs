//! Diagnostics against ArviZ 0.23.4, and the cases it leaves open.

mod common;

use common::Uniform;
use diagnostics::{Series, SeriesError, ess_of_mean};
use proptest::prelude::{prop_assert, proptest};

/// m autoregressive chains, chain c shifted by `shift` c, cut to multiples of 1 / `cut` unless that is 0.
#[derive(Clone, Copy)]
struct Golden {
    seed: u64,
    m: usize,
    n: usize,
    rho: f64,
    shift: f64,
    cut: f64,
    /// R̂, bulk, tail and 0.9-quantile ESS, ESS of the mean, standard error of the mean.
    want: [f64; 6],
    /// ESS and standard error of the standard deviation, ESS of the quartile, standard errors of the 0.05, 0.5 and
    /// 0.9 quantiles.
    spread: [f64; 6],
}

impl Golden {
    fn draws(&self) -> Vec<f64> {
        let mut draws = Vec::new();
        for c in 0..self.m {
            let mut uniform = Uniform::new(self.seed * 100 + c as u64);
            let mut x = 0.0;
            for _ in 0..self.n {
                x = self.rho * x + uniform.bell();
                let y = x + self.shift * c as f64;
                draws.push(if self.cut > 0.0 { (y * self.cut).trunc() } else { y });
            }
        }
        draws
    }
}

#[rustfmt::skip]
const GOLDEN: [Golden; 12] = [
    Golden { seed: 1, m: 4, n: 1000, rho: 0.0, shift: 0.0, cut: 0.0,
        want: [1.0001593830910798, 3787.9605703684983, 4010.353682968722, 4124.027792934508, 3852.6774012795136, 0.009178734627260782],
        spread: [4056.669470536193, 0.00591314189344334, 3955.9572455918164, 0.02751084676189719, 0.012983178754334412, 0.014692772352509209] },
    Golden { seed: 2, m: 4, n: 1000, rho: 0.9, shift: 0.0, cut: 0.0,
        want: [1.0209669752436206, 192.19311127185586, 396.26033134745717, 269.39283074664417, 191.05639536269416, 0.09836228576746756],
        spread: [503.0001224438811, 0.04047865767895516, 407.46977598835804, 0.09478368565930939, 0.11496294311176286, 0.1448575348423763] },
    Golden { seed: 3, m: 4, n: 251, rho: 0.5, shift: 0.1, cut: 0.0,
        want: [1.037103289066103, 116.67591018637873, 455.23765116631847, 383.8528612101769, 119.48409926435718, 0.05999130782242453],
        spread: [565.465043495692, 0.018653806293103377, 387.26523406063956, 0.054893638135205536, 0.047158425309464874, 0.07134164853184155] },
    Golden { seed: 4, m: 6, n: 500, rho: -0.6, shift: 0.0, cut: 0.0,
        want: [1.002374059274677, 10431.363764158988, 2514.160066086752, 3362.711604489695, 10431.363764158988, 0.007070594338835166],
        spread: [1374.4106889696775, 0.01329565143706541, 4875.373703935978, 0.03361179034745032, 0.010022289355331566, 0.023044376447893256] },
    Golden { seed: 5, m: 4, n: 400, rho: 0.7, shift: 0.0, cut: 3.0,
        want: [1.018057473331096, 281.4887073517784, 456.0366682236026, 418.6275315333714, 284.1821092230613, 0.1227641733242529],
        spread: [478.2317473908447, 0.07750267293629808, 355.1197935324871, 0.5, 0.0, 0.5] },
    Golden { seed: 6, m: 4, n: 100, rho: 0.99, shift: 2.0, cut: 0.0,
        want: [1.8405906200799964, 6.177484439766211, 15.012711397959077, 10.972238458486116, 6.226008114651719, 1.0538724658174643],
        spread: [14.094306736356982, 0.41646114679725327, 10.003681865838436, 0.9636964542364144, 1.0425096983498228, 0.9763419443694001] },
    Golden { seed: 7, m: 4, n: 40, rho: 0.3, shift: 0.0, cut: 1.0,
        want: [1.013058811743707, 148.54919618978687, 125.92120207228713, 125.92120207228713, 148.5911850633465, 0.02506552066712499],
        spread: [177.12732057933948, 0.0352734309729489, 125.92120207228713, 0.5, 0.0, 0.0] },
    Golden { seed: 8, m: 3, n: 333, rho: 0.8, shift: 0.0, cut: 0.0,
        want: [1.0109466957637552, 100.52599668023302, 168.13359870819156, 158.31458053852333, 99.63380126683224, 0.10125573002963541],
        spread: [209.58814709300123, 0.04565809690074399, 130.60930515668153, 0.0987538517578943, 0.11554991904233369, 0.12351680351013361] },
    Golden { seed: 9, m: 5, n: 77, rho: 0.4, shift: 0.0, cut: 2.0,
        want: [0.9999709803949055, 220.55642909382004, 220.27957925294564, 291.8056021921261, 214.86475542879612, 0.06770814127246459],
        spread: [295.8000678792645, 0.05112452058387198, 315.1195072139317, 0.5, 0.0, 0.0] },
    Golden { seed: 10, m: 2, n: 999, rho: 0.95, shift: 0.0, cut: 0.0,
        want: [1.018393859496514, 60.95990264202803, 159.57031228563184, 123.23606127203831, 60.95858974278498, 0.24433377709035298],
        spread: [131.25458154918078, 0.10880549706864236, 103.02407719879955, 0.3032694207061113, 0.2825028648310953, 0.258560467636329] },
    Golden { seed: 11, m: 4, n: 2500, rho: 0.9, shift: 0.0, cut: 0.0,
        want: [1.0068458032061682, 557.6997283043056, 1260.5752364455434, 1049.0559699749, 555.2945114705085, 0.05571543658149947],
        spread: [1105.9579037611181, 0.028171874996718037, 901.0186793875984, 0.0726757371231912, 0.05875199063268188, 0.06367301450897789] },
    Golden { seed: 12, m: 2, n: 5, rho: 0.0, shift: 0.0, cut: 0.0,
        want: [0.9012144386980898, 7.224719895935548, 7.224719895935548, 7.224719895935548, 7.224719895935548, 0.24295558967200756],
        spread: [7.224719895935548, 0.1112416737940914, 7.224719895935548, 0.3243747871740572, 0.4076478459886943, 0.4328734410142281] },
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
        assert_eq!(ess_of_mean(&draws, golden.m), Ok(series.ess_mean()));
        let got = [
            series.ess_sd(),
            series.mcse_sd(),
            series.ess_quantile(0.25),
            series.mcse_quantile(0.05),
            series.mcse_quantile(0.5),
            series.mcse_quantile(0.9),
        ];
        for (got, want) in got.iter().zip(golden.spread) {
            assert!((got - want).abs() <= 1e-9 * want, "seed {}: {got:?} vs {want:?}", golden.seed);
        }
    }
}

#[test]
fn equal_draws_count_in_full_and_stuck_chains_are_seen() {
    let zeros = [0.0; 400];
    let series = Series::new(&zeros, 4).expect("finite chains");
    assert_eq!((series.rhat(), series.ess_bulk(), series.ess_tail()), (1.0, 400.0, 400.0));
    assert_eq!((series.ess_sd(), series.sd(), series.quantile(0.3)), (400.0, 0.0, 0.0));
    assert_eq!((series.mcse_mean(), series.mcse_sd(), series.mcse_quantile(0.3)), (0.0, 0.0, 0.0));

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
    assert_eq!(ess_of_mean(&[0.0; 10], 4), Err(SeriesError::Ragged { n: 10, n_chains: 4 }));
    let mut draws = [0.0; 40];
    draws[7] = f64::NEG_INFINITY;
    assert_eq!(
        Series::new(&draws, 4).expect_err("refused"),
        SeriesError::NotFinite { index: 7, value: f64::NEG_INFINITY }
    );
}

/// The standard errors are what they say: over many series, estimates scatter by as much.
#[test]
fn standard_errors_match_the_scatter_of_the_estimates() {
    let worlds = 300_u32;
    let estimates: Vec<[(f64, f64); 3]> = (0..u64::from(worlds))
        .map(|seed| {
            let golden = Golden { seed: 1000 + seed, m: 4, n: 500, rho: 0.6, ..GOLDEN[0] };
            let draws = golden.draws();
            let series = Series::new(&draws, 4).expect("finite chains");
            [
                (series.mean(), series.mcse_mean()),
                (series.sd(), series.mcse_sd()),
                (series.quantile(0.9), series.mcse_quantile(0.9)),
            ]
        })
        .collect();
    for which in 0..3 {
        let values: Vec<f64> = estimates.iter().map(|e| e[which].0).collect();
        let claimed = estimates.iter().map(|e| e[which].1).sum::<f64>() / f64::from(worlds);
        let scatter = Series::new(&values, 1).expect("finite").sd();
        // The scatter itself is known to 1/√(2·300) = 4 %; the estimates of ESS add about as much.
        assert!((claimed / scatter - 1.0).abs() < 0.12, "statistic {which}: claimed {claimed}, scatter {scatter}");
    }
}

proptest! {
    #[test]
    fn ranks_ignore_monotone_maps(seed in 0_u64..1000) {
        let golden = Golden { seed, m: 4, n: 50, rho: 0.5, shift: 0.0, cut: 0.0, want: [0.0; 6], spread: [0.0; 6] };
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
        for ess in [series.ess_bulk(), series.ess_tail(), series.ess_mean(), series.ess_sd()] {
            prop_assert!(ess > 0.0 && ess <= 32.0 * 32.0_f64.log10() + 1e-9, "{ess}");
        }
        prop_assert!(series.rhat() >= 0.0);
        for error in [series.mcse_mean(), series.mcse_sd(), series.mcse_quantile(0.05), series.mcse_quantile(1.0)] {
            prop_assert!(error >= 0.0 && error.is_finite(), "{error}");
        }
    }
}
