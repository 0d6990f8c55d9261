//! Posteriors of two weights by quadrature, beside the sampler's: every prior, every kind of evidence but placements (whose
//! likelihood always has the nine fixed centres; `calibration.rs` weighs draws from the prior instead).

mod support;

use diagnostics::Series;
use likelihood::actions::{ActionLikelihood, Choice, without_duplicates};
use likelihood::preferences::{AnswerModel, PreferenceLikelihood};
use mdp::worlds::GridWorld;
use mdp::{Solver, rollout};
use posterior::{Draws, EvidenceKind, Model, Prior, Rationality, Run, Term, TermLikelihood, draw};
use support::{answers, generator, grid, judged, l1_sphere, l2_sphere, taken};

const BETA: f64 = 4.0;

/// Nodes and prior weights of a quadrature over (w, ln β − ln median in units of its standard deviation).
fn nodes(prior: Prior, learned: bool) -> Vec<([f64; 2], f64, f64)> {
    let around = |n: usize| (0..n).map(move |i| (i as f64 + 0.5) / n as f64);
    let weights: Vec<([f64; 2], f64)> = match prior {
        Prior::L2Sphere => around(2000)
            .map(|t| {
                let angle = std::f64::consts::TAU * t;
                ([angle.cos(), angle.sin()], 1.0)
            })
            .collect(),
        Prior::L1Sphere => around(2000)
            .map(|t| {
                let (side, along) = ((4.0 * t) as usize, (4.0 * t).fract());
                let signs = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)][side];
                ([signs.0 * along, signs.1 * (1.0 - along)], 1.0)
            })
            .collect(),
        Prior::Gaussian { scale } | Prior::Laplace { scale } => {
            let gaussian = matches!(prior, Prior::Gaussian { .. });
            let reach = if gaussian { 6.5 } else { 20.0 } * scale;
            let density =
                |w: f64| if gaussian { (-0.5 * w * w / scale / scale).exp() } else { (-w.abs() / scale).exp() };
            let axis: Vec<f64> = around(if learned { 200 } else { 600 }).map(|t| reach * (2.0 * t - 1.0)).collect();
            axis.iter().flat_map(|&a| axis.iter().map(move |&b| ([a, b], density(a) * density(b)))).collect()
        }
    };
    if !learned {
        return weights.into_iter().map(|(w, p)| (w, 0.0, p)).collect();
    }
    let axis: Vec<f64> = around(60).map(|t| 12.0 * t - 6.0).collect();
    weights.iter().flat_map(|&(w, p)| axis.iter().map(move |&z| (w, z, p * (-0.5 * z * z).exp()))).collect()
}

/// Means of w_0, w_1, w_0², w_0 w_1, β and the log-likelihood under the exact posterior of one term.
fn exact(model: &Model<'_>) -> [f64; 6] {
    let rationality = model.terms[0].rationality;
    let mut evaluator = model.evaluator();
    let mut rows = Vec::new();
    for (w, z, prior) in nodes(model.prior, rationality.is_learned()) {
        let beta = match rationality {
            Rationality::Fixed(beta) => beta,
            Rationality::Learned { median, log_sd } => median * (log_sd * z).exp(),
        };
        if model.nonnegative_return.as_ref().is_some_and(|phi| phi[0] * w[0] + phi[1] * w[1] < 0.0) {
            continue;
        }
        let value = evaluator.log_likelihood(&w, &[beta]);
        rows.push((prior.ln() + value, [w[0], w[1], w[0] * w[0], w[0] * w[1], beta, value]));
    }
    let top = rows.iter().fold(f64::NEG_INFINITY, |top, row| top.max(row.0));
    let mut sums = [0.0; 6];
    let mut total = 0.0;
    for (log_p, row) in rows {
        let p = (log_p - top).exp();
        total += p;
        for (sum, x) in sums.iter_mut().zip(row) {
            *sum += p * x;
        }
    }
    sums.map(|sum| sum / total)
}

/// The same of draws, each with its standard error.
fn sampled(draws: &Draws) -> [(f64, f64); 6] {
    let (first, second) = (draws.feature(0), draws.feature(1));
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).collect::<Vec<f64>>();
    let beta: Vec<f64> = (0..draws.n()).map(|i| draws.betas[0].at(i)).collect();
    let squares = product(&first, &first);
    let mixed = product(&first, &second);
    [first, second, squares, mixed, beta, draws.log_likelihood.clone()].map(|values| {
        let series = Series::new(&values, draws.n_chains).expect("finite draws");
        let mean = series.mean();
        let variance = values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / values.len() as f64;
        (mean, (variance / series.ess_bulk()).sqrt())
    })
}

fn agree(what: &str, model: &Model<'_>) {
    let run = Run { n_draws: 20_000, warmup: 500, ..Run::default() };
    let draws = draw(model, &run, 11, &[5; 32]).expect("draws");
    assert!(draws.rhat_max < 1.01, "{what}: R-hat {}", draws.rhat_max);
    let names = ["w_0", "w_1", "w_0^2", "w_0 w_1", "beta", "log-likelihood"];
    for ((name, want), (got, error)) in names.iter().zip(exact(model)).zip(sampled(&draws)) {
        assert!(
            (got - want).abs() < 4.5 * error + 2e-3 * want.abs().min(0.1),
            "{what}, {name}: {got} ± {error} vs {want}"
        );
    }
    // No node of the quadrature is likelier than the mode where the prior is flat.
    if matches!(model.prior, Prior::L1Sphere | Prior::L2Sphere) && !model.terms[0].rationality.is_learned() {
        let mut evaluator = model.evaluator();
        let best = nodes(model.prior, false)
            .into_iter()
            .filter(|(w, ..)| model.nonnegative_return.as_ref().is_none_or(|phi| phi[0] * w[0] + phi[1] * w[1] >= 0.0))
            .map(|(w, ..)| evaluator.log_likelihood(&w, &model.median_betas()))
            .fold(f64::NEG_INFINITY, f64::max);
        assert!(draws.map_log_likelihood > best - 1e-3, "{what}: mode {} vs {best}", draws.map_log_likelihood);
    }
}

const PRIORS: [Prior; 4] =
    [Prior::L1Sphere, Prior::L2Sphere, Prior::Gaussian { scale: 0.8 }, Prior::Laplace { scale: 0.6 }];

fn one_term(kind: EvidenceKind, likelihood: TermLikelihood<'_>, rationality: Rationality, prior: Prior) -> Model<'_> {
    Model { n_features: 2, prior, nonnegative_return: None, terms: vec![Term { kind, rationality, likelihood }] }
}

fn rationalities() -> [Rationality; 2] {
    [Rationality::Fixed(BETA), Rationality::Learned { median: BETA, log_sd: 0.6 }]
}

#[test]
fn preferences() {
    let mut generator = generator(80, 0);
    let w = l2_sphere(2, &mut generator);
    let answer_model = AnswerModel { equal_threshold: 0.5, cant_tell: 0.3, wrong_rate: 0.05 };
    let (features, given) = answers(&w, BETA, &answer_model, (6, 12), &mut generator);
    for prior in PRIORS {
        for rationality in rationalities() {
            let preferences = PreferenceLikelihood::new(2, features.clone(), given.clone(), answer_model);
            let likelihood = TermLikelihood::Preferences(preferences.expect("good answers"));
            let mut model = one_term(EvidenceKind::Preferences, likelihood, rationality, prior);
            agree(&format!("{prior:?}, {rationality:?}"), &model);
            model.nonnegative_return = Some(vec![0.4, -1.0]);
            agree(&format!("{prior:?}, {rationality:?}, non-negative return"), &model);
        }
    }
}

#[test]
fn actions_and_critiques() {
    let mut generator = generator(81, 0);
    let mdp = grid(2, 0.8, &mut generator);
    let w = l2_sphere(2, &mut generator);
    let shown = taken(&mdp, &w, BETA, (10, 16), &mut generator);
    let called = judged(&mdp, &w, BETA, 12, &mut generator);
    for prior in [Prior::L1Sphere, Prior::L2Sphere] {
        for (kind, choices) in [(EvidenceKind::Actions, &shown), (EvidenceKind::Critiques, &called)] {
            for rationality in rationalities() {
                let likelihood = ActionLikelihood::new(&mdp, choices.clone()).expect("good choices");
                let model = one_term(kind, TermLikelihood::Actions(likelihood), rationality, prior);
                agree(&format!("{kind:?}, {prior:?}, {rationality:?}"), &model);
            }
        }
    }
}

/// Someone perfect shows a grid world of section 6.5, and nothing is known of how rational they are: the rationality grows until
/// the likelihood is a table with walls around it.
#[test]
fn perfect_demonstrations_by_someone_of_unknown_rationality() {
    for world in 0..3 {
        let mut generator = generator(82, world);
        let mdp = GridWorld::random(6, 6, 2, &mut generator).mdp().expect("a good world");
        let w = l1_sphere(2, &mut generator);
        let optimal = Solver::new(&mdp).solve(&w).indifferent_policy();
        let mut choices = Vec::new();
        for start in [0, 1] {
            let steps = rollout(&mdp, &optimal, start, 20, &mut generator).expect("a policy of this world");
            choices.extend(steps.into_iter().map(|(state, action)| Choice::taken(state, action)));
        }
        for shown in [choices.clone(), without_duplicates(&choices)] {
            let likelihood = TermLikelihood::Actions(ActionLikelihood::new(&mdp, shown).expect("good choices"));
            let unknown = Rationality::Learned { median: 50.0, log_sd: 2.0 };
            let model = one_term(EvidenceKind::Actions, likelihood, unknown, Prior::L1Sphere);
            agree(&format!("perfect demonstrations, world {world}"), &model);
        }
    }
}
