//! The posterior as we sample it, and the policies and bounds that follow from it.

use super::{ALPHAS, DELTA, Demonstration, Judged, Problem, Solved, choices, discounted_counts};
use crate::harness::{ReproductionError, extent};
use likelihood::actions::{ActionLikelihood, without_duplicates};
use mdp::Mdp;
use posterior::{Draws, EvidenceKind, Model, Prior, Rationality, Run, Term, TermLikelihood, draw};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::Rng;
use risk::{upper_bound, worst_case_feature_count_bound};
use serde::Serialize;

/// How demonstrations are taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Evidence {
    /// β, known or learned.
    pub rationality: Rationality,
    /// Whether pairs that repeat count again.
    pub repeats: bool,
    /// Share of actions at random.
    pub wrong_rate: f64,
}

/// For demonstrators who are as good as perfect. 95 % of the prior of β lies between 25 and 500, the values that section 4.5.2
/// names for experts. Repeated pairs count once: someone perfect does the same in the same state, which tells nothing new.
pub const PERFECT: Evidence =
    Evidence { rationality: Rationality::Learned { median: 112.0, log_sd: 0.75 }, repeats: false, wrong_rate: 0.0 };

/// Draws first asked for.
const DRAWS: usize = extent(4000, 1000);
/// Most draws, before there is no bound.
const MOST_DRAWS: usize = extent(16_000, DRAWS);
const N_CHAINS: usize = 4;

/// A posterior of chapter 4.
#[derive(Debug, Clone)]
pub struct Belief {
    /// Its draws.
    pub draws: Draws,
    solved: Solved,
    counts_shown: Vec<f64>,
}

/// What a posterior is worth.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Quality {
    /// Draws.
    pub n: usize,
    /// Largest R̂.
    pub rhat: f64,
    /// Smallest bulk effective sample size.
    pub ess: f64,
    /// Mean β.
    pub beta: f64,
}

impl Belief {
    /// How good the draws are.
    pub fn quality(&self) -> Quality {
        let draws = &self.draws;
        Quality { n: draws.n(), rhat: draws.rhat_max, ess: draws.ess_bulk_min, beta: draws.betas[0].mean() }
    }

    /// Losses of a policy with these feature counts under every draw.
    pub fn losses(&self, counts: &[f64]) -> Vec<f64> {
        self.solved.losses(counts)
    }

    /// Judges a policy that was not chosen by its losses under these draws.
    pub fn judge(&self, problem: &Problem, counts: &[f64]) -> Result<Judged, ReproductionError> {
        self.judge_by(problem, counts, &self.solved)
    }

    /// Chooses the policy of least .95-value at risk by the first halves of the chains and judges it by the second halves: the
    /// draws that chose it would flatter it.
    pub fn judge_least_risk(&self, problem: &Problem) -> Result<Judged, ReproductionError> {
        let [first, second] = self.halves();
        let counts = first.least_risk_counts(&problem.mdp, ALPHAS[1]);
        self.judge_by(problem, &counts, &second)
    }

    /// The same among a few policies, given by their feature counts.
    pub fn judge_safest(&self, problem: &Problem, candidates: &[Vec<f64>]) -> Result<Judged, ReproductionError> {
        let [first, second] = self.halves();
        self.judge_by(problem, first.safest_counts(ALPHAS[1], candidates), &second)
    }

    fn halves(&self) -> [Solved; 2] {
        self.solved.halves(self.draws.n_chains, self.draws.n_features)
    }

    fn judge_by(&self, problem: &Problem, counts: &[f64], solved: &Solved) -> Result<Judged, ReproductionError> {
        let losses = solved.losses(counts);
        let mut bounds = [None; 3];
        for (bound, alpha) in bounds.iter_mut().zip(ALPHAS) {
            *bound = upper_bound(&losses, self.draws.n_chains, alpha, DELTA)?.bound();
        }
        let worst_case = worst_case_feature_count_bound(&self.counts_shown, counts)?;
        Ok(Judged { loss: problem.loss(counts), bounds, worst_case })
    }
}

/// Samples the posterior of demonstrations, with more draws for as long as `judge` finds that some bound is missing; gives what
/// was judged at last.
pub fn believe<T>(
    mdp: &Mdp,
    demonstrations: &[Demonstration],
    evidence: Evidence,
    generator: &mut ChaCha8Rng,
    judge: impl Fn(&Belief) -> Result<(T, bool), ReproductionError>,
) -> Result<T, ReproductionError> {
    let all = choices(demonstrations);
    let taken = if evidence.repeats { all } else { without_duplicates(&all) };
    let likelihood = ActionLikelihood::new(mdp, taken)?.with_wrong_rate(evidence.wrong_rate)?;
    let term = Term {
        kind: EvidenceKind::Actions,
        rationality: evidence.rationality,
        likelihood: TermLikelihood::Actions(likelihood),
    };
    let model =
        Model { n_features: mdp.n_features(), prior: Prior::L1Sphere, nonnegative_return: None, terms: vec![term] };
    let counts_shown = discounted_counts(mdp, demonstrations);
    let mut n_draws = DRAWS;
    loop {
        let run = Run { n_draws, n_chains: N_CHAINS, warmup: n_draws / 10, threads: 1 };
        let mut key = [0; 32];
        generator.fill_bytes(&mut key);
        let draws = draw(&model, &run, generator.next_u64(), &key)?;
        let solved = Solved::new(mdp, &draws.values);
        let (judged, complete) = judge(&Belief { draws, solved, counts_shown: counts_shown.clone() })?;
        if complete || n_draws >= MOST_DRAWS {
            return Ok(judged);
        }
        n_draws *= 2;
    }
}

impl Judged {
    /// Whether no bound is missing.
    pub fn is_complete(&self) -> bool {
        self.bounds.iter().all(Option::is_some)
    }
}
