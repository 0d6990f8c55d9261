//! Simulation-based calibration of actions and critiques, and the planted bugs that it must catch.

mod support;

use likelihood::actions::{ActionLikelihood, Choice, without_duplicates};
use likelihood::preferences::{AnswerModel, PreferenceLikelihood};
use posterior::{EvidenceKind, Model, Prior, Rationality, Term, TermLikelihood, draw};
use support::{LIMIT, answers, chi_squared, generator, grid, judged, l1_sphere, normal, rank, ranks, short_run, taken};

/// Features, one in each cell.
const K: usize = 3;
const BETA: f64 = 12.0;
/// Actions shown, and in how many of the 16 states.
const SHOWN: (usize, usize) = (30, 16);

fn term(likelihood: ActionLikelihood<'_>, kind: EvidenceKind, beta: f64) -> Term<'_> {
    Term { kind, rationality: Rationality::Fixed(beta), likelihood: TermLikelihood::Actions(likelihood) }
}

/// χ² when choices (how many, in how many states) are drawn at β = 12 and read after `change`, at `assumed_beta`.
fn calibration(
    test: u64,
    worlds: u64,
    critiques: bool,
    shown: (usize, usize),
    gamma: f64,
    assumed_beta: f64,
    change: fn(&[Choice]) -> Vec<Choice>,
) -> [f64; 3] {
    chi_squared(worlds, |world| {
        let mut generator = generator(test, world);
        let mdp = grid(K, gamma, &mut generator);
        let w = l1_sphere(K, &mut generator);
        let choices = if critiques {
            judged(&mdp, &w, BETA, 30, &mut generator)
        } else {
            taken(&mdp, &w, BETA, shown, &mut generator)
        };
        let kind = if critiques { EvidenceKind::Critiques } else { EvidenceKind::Actions };
        let read = ActionLikelihood::new(&mdp, change(&choices)).expect("good choices");
        let terms = vec![term(read, kind, assumed_beta)];
        let model = Model { n_features: K, prior: Prior::L1Sphere, nonnegative_return: None, terms };
        let draws = draw(&model, &short_run(), world, &[3; 32]).expect("draws");
        ranks(&draws, &w, model.log_likelihood(&w, &[assumed_beta]))
    })
}

fn uniform_ranks(what: &str, chi_squared: [f64; 3]) {
    for (statistic, value) in ["w_0", "|w_0|", "log-likelihood"].iter().zip(chi_squared) {
        assert!(value < LIMIT, "{what}, {statistic}: {value}");
    }
}

#[test]
fn actions_and_critiques() {
    uniform_ranks("actions", calibration(70, 320, false, SHOWN, 0.9, BETA, <[Choice]>::to_vec));
    uniform_ranks("critiques", calibration(71, 320, true, SHOWN, 0.9, BETA, <[Choice]>::to_vec));
}

#[test]
fn a_doubled_beta_is_caught() {
    for critiques in [false, true] {
        let [_, _, log_likelihood] = calibration(72, 160, critiques, SHOWN, 0.9, 2.0 * BETA, <[Choice]>::to_vec);
        assert!(log_likelihood > LIMIT, "critiques {critiques}: {log_likelihood}");
    }
}

#[test]
fn a_missing_discount_is_caught() {
    // Rewards of states are the same for all actions, so Q* without its γ, R + Σ P V*, is as good as β divided by γ.
    let [_, _, log_likelihood] = calibration(73, 160, false, SHOWN, 0.5, BETA / 0.5, <[Choice]>::to_vec);
    assert!(log_likelihood > LIMIT, "{log_likelihood}");
    uniform_ranks("with the discount", calibration(73, 320, false, SHOWN, 0.5, BETA, <[Choice]>::to_vec));
}

#[test]
fn removed_duplicates_are_caught() {
    let chi_squared = calibration(74, 160, false, (80, 6), 0.9, BETA, without_duplicates);
    assert!(chi_squared.iter().any(|value| *value > LIMIT), "{chi_squared:?}");
}

/// Ranks of w_0, the log-likelihood and both βs, with actions and preferences in one posterior.
#[test]
fn two_kinds_of_evidence_each_with_its_own_learned_rationality() {
    let answer_model = AnswerModel::default();
    let chi_squared = chi_squared(320, |world| {
        let mut generator = generator(75, world);
        let mdp = grid(K, 0.9, &mut generator);
        let w = l1_sphere(K, &mut generator);
        let mut beta = |median: f64| median * (0.5 * normal(&mut generator)).exp();
        let (of_actions, of_preferences) = (beta(BETA), beta(4.0));
        let choices = taken(&mdp, &w, of_actions, (20, 16), &mut generator);
        let (features, given) = answers(&w, of_preferences, &answer_model, (6, 10), &mut generator);
        let actions = ActionLikelihood::new(&mdp, choices).expect("good choices");
        let preferences = PreferenceLikelihood::new(K, features, given, answer_model).expect("good answers");
        let learned = |median| Rationality::Learned { median, log_sd: 0.5 };
        let terms = vec![
            Term {
                kind: EvidenceKind::Actions,
                rationality: learned(BETA),
                likelihood: TermLikelihood::Actions(actions),
            },
            Term {
                kind: EvidenceKind::Preferences,
                rationality: learned(4.0),
                likelihood: TermLikelihood::Preferences(preferences),
            },
        ];
        let model = Model { n_features: K, prior: Prior::L1Sphere, nonnegative_return: None, terms };
        let draws = draw(&model, &short_run(), world, &[4; 32]).expect("draws");
        let truth = model.log_likelihood(&w, &[of_actions, of_preferences]);
        [
            rank(draws.feature(0).into_iter(), w[0]),
            rank(draws.log_likelihood.iter().copied(), truth),
            rank(draws.betas[0].values.iter().copied(), of_actions),
            rank(draws.betas[1].values.iter().copied(), of_preferences),
        ]
    });
    for (statistic, value) in
        ["w_0", "log-likelihood", "beta of actions", "beta of preferences"].iter().zip(chi_squared)
    {
        assert!(value < LIMIT, "{statistic}: {value}");
    }
}
