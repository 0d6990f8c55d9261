//! Made-up preferences: features, a person's weights, and answers drawn from the model.

use likelihood::preferences::{Answer, AnswerModel, PreferenceError, PreferenceLikelihood, Verdict};
use mdp::random::{index, normal, uniform};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use serde_json::json;

/// Weights of every data set.
pub const N_FEATURES: usize = 64;

/// Which pairs are compared.
#[derive(Debug, Clone, Copy)]
pub enum Pairs {
    /// Every pair once.
    All,
    /// So many random pairs of different items.
    Random(usize),
}

/// What to make up.
#[derive(Debug, Clone, Copy)]
pub struct Case {
    /// As printed.
    pub name: &'static str,
    /// Number m of trajectories.
    pub n_items: usize,
    /// Compared pairs.
    pub pairs: Pairs,
    /// Standard deviation of the features.
    pub feature_sd: f64,
}

/// The data sets of issue 3.
pub const CASES: [Case; 3] = [
    Case { name: "m = 12, 66 pairs, features N(0, 1)", n_items: 12, pairs: Pairs::All, feature_sd: 1.0 },
    Case { name: "m = 12, 66 pairs, features N(0, 100)", n_items: 12, pairs: Pairs::All, feature_sd: 10.0 },
    Case { name: "m = 200, 1,937 pairs, features N(0, 1)", n_items: 200, pairs: Pairs::Random(1937), feature_sd: 1.0 },
];

/// One data set.
#[derive(Debug, Clone)]
pub struct PreferenceData {
    features: Vec<f64>,
    /// (less, more).
    pairs: Vec<(usize, usize)>,
}

impl PreferenceData {
    /// Features ~ N(0, sd²), a person's weights uniform on the sphere, their answers by Bradley–Terry with β = 1.
    pub fn draw(case: &Case, seed: u64) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let m = case.n_items;
        let features: Vec<f64> = (0..m * N_FEATURES).map(|_| case.feature_sd * normal(&mut rng)).collect();
        let w = on_sphere(N_FEATURES, &mut rng);
        let utility = |row: &[f64]| row.iter().zip(&w).map(|(feature, w)| feature * w).sum::<f64>();
        let returns: Vec<f64> = features.chunks_exact(N_FEATURES).map(utility).collect();
        let compared: Vec<(usize, usize)> = match case.pairs {
            Pairs::All => (0..m).flat_map(|a| (0..a).map(move |b| (a, b))).collect(),
            Pairs::Random(n) => (0..n)
                .map(|_| {
                    let a = index(m, &mut rng);
                    (a, (a + 1 + index(m - 1, &mut rng)) % m)
                })
                .collect(),
        };
        let answer = |(a, b): (usize, usize)| {
            let b_better = 1.0 / (1.0 + libm::exp(returns[a] - returns[b]));
            if uniform(&mut rng) < b_better { (a, b) } else { (b, a) }
        };
        let pairs = compared.into_iter().map(answer).collect();
        Self { features, pairs }
    }

    /// Its likelihood.
    pub fn likelihood(&self) -> Result<PreferenceLikelihood, PreferenceError> {
        let strict = |&(less, more): &(usize, usize)| Answer { less, more, factor: 1.0, verdict: Verdict::Strict };
        let answers = self.pairs.iter().map(strict).collect();
        PreferenceLikelihood::new(N_FEATURES, self.features.clone(), answers, AnswerModel::default())
    }

    /// As the Python side reads it.
    pub fn to_json(&self) -> String {
        let rows: Vec<&[f64]> = self.features.chunks_exact(N_FEATURES).collect();
        json!({ "features": rows, "pairs": self.pairs }).to_string()
    }
}

/// Uniform on the sphere ‖w‖₂ = 1.
pub fn on_sphere(k: usize, rng: &mut ChaCha8Rng) -> Vec<f64> {
    let mut w: Vec<f64> = (0..k).map(|_| normal(rng)).collect();
    let norm = libm::sqrt(w.iter().map(|w| w * w).sum());
    w.iter_mut().for_each(|w| *w /= norm);
    w
}

#[cfg(test)]
mod tests {
    use super::{CASES, N_FEATURES, PreferenceData};

    #[test]
    fn data_sets_have_the_sizes_of_the_issue_and_survive_json() {
        for (case, (n_items, n_pairs)) in CASES.iter().zip([(12, 66), (12, 66), (200, 1937)]) {
            let data = PreferenceData::draw(case, 3);
            let likelihood = data.likelihood().expect("good data");
            assert_eq!((likelihood.n_items(), likelihood.answers().len()), (n_items, n_pairs));
            let json: serde_json::Value = serde_json::from_str(&data.to_json()).expect("JSON");
            let first: Vec<f64> = serde_json::from_value(json["features"][0].clone()).expect("a row");
            assert_eq!(first, likelihood.items()[..N_FEATURES]);
        }
    }

    #[test]
    fn sharp_features_give_answers_that_agree_with_a_ranking() {
        let sharp = PreferenceData::draw(&CASES[1], 4).likelihood().expect("good data");
        let mut wins = [0; 12];
        sharp.answers().iter().for_each(|answer| wins[answer.more] += 1);
        assert!(*wins.iter().max().expect("twelve") >= 10 && *wins.iter().min().expect("twelve") <= 1, "{wins:?}");
    }
}
