//! Preferences over 64 features: smallest effective samples per CPU second of our sampler, NumPyro's NUTS and the
//! dissertation's walk, all on the same posterior and on one core.

use likelihood::preferences::PreferenceLikelihood;
use posterior::{Draws, EvidenceKind, Model, Prior, Rationality, Run, Term, TermLikelihood, draw};
use serde::Serialize;

use crate::clock::timed;
use crate::effective::{Effective, judge, mean_and_error};
use crate::error::PeersError;
use crate::l2_walk;
use crate::numpyro::{self, NutsRun};
use crate::preference_data::{CASES, Case, N_FEATURES, PreferenceData};

/// Draws of one ordinary job, on both sides.
const JOB_DRAWS: usize = 4000;
const CHAINS: usize = 4;
/// Most draws of the long run.
const MAX_DRAWS: usize = 400_000;
/// Steps of the walk that are timed first, per chain, to know how many fill the time.
const FIRST_STEPS: usize = 20_000;

/// How fast one program samples one data set.
#[derive(Debug, Clone, Serialize)]
pub struct Speed {
    program: String,
    /// Smallest effective samples per CPU second: warm-up, compilation and diagnostics left out.
    per_second: f64,
    /// The same of one job of 4,000 draws with its warm-up; none for the walk, which has none.
    job_per_second: Option<f64>,
    /// CPU seconds per draw, or per step of the walk.
    seconds_per_draw: f64,
    /// CPU seconds of compilation, which are not counted.
    compile_seconds: Option<f64>,
    /// Mean length of NUTS's trajectories.
    leapfrogs_per_draw: Option<f64>,
    effective: Effective,
    log_likelihood_mean: f64,
    log_likelihood_error: f64,
}

/// One data set.
#[derive(Debug, Clone, Serialize)]
pub struct Compared {
    case: &'static str,
    ours: Speed,
    nuts: Vec<Speed>,
    walk: Speed,
    /// Ours over the best configuration of NUTS.
    ratio: f64,
    /// The same of one job with its warm-up.
    job_ratio: f64,
    /// Ours over the walk.
    walk_ratio: f64,
    /// Difference of the posterior means of the log-likelihood, ours less those of all NUTS runs, in standard errors.
    mean_difference: f64,
    /// Largest relative difference between ArviZ's effective sample sizes and ours of the same draws.
    diagnostics_difference: f64,
}

/// Compares on every data set and prints a table.
pub fn compare(seconds: f64, seed: u64) -> Result<Vec<Compared>, PeersError> {
    let mut all = Vec::new();
    for case in &CASES {
        let compared = case_of(case, seconds, seed)?;
        print(&compared);
        all.push(compared);
    }
    Ok(all)
}

fn case_of(case: &Case, seconds: f64, seed: u64) -> Result<Compared, PeersError> {
    let data = PreferenceData::draw(case, seed);
    let likelihood = data.likelihood()?;
    let ours = ours(&likelihood, seconds, seed)?;
    let walk = walk(&likelihood, seconds, seed)?;
    let report = numpyro::run(&data.to_json(), seconds, seed)?;
    let mut diagnostics_difference = 0.0_f64;
    for run in &report.runs {
        let series = diagnostics::Series::new(&run.job_log_likelihood, report.chains)?;
        for (ours, theirs) in
            [(series.ess_bulk(), run.job.ess_bulk_log_likelihood), (series.ess_tail(), run.job.ess_tail_log_likelihood)]
        {
            diagnostics_difference = diagnostics_difference.max((ours / theirs - 1.0).abs());
        }
    }
    let nuts: Vec<Speed> = report.runs.iter().map(nuts_speed).collect();
    let best = |rate: &dyn Fn(&NutsRun) -> f64| report.runs.iter().map(rate).fold(0.0, f64::max);
    let (nuts_mean, nuts_error) = pooled(&nuts);
    let error = libm::hypot(ours.log_likelihood_error, nuts_error);
    println!("\n{}   (numpyro {}, jax {})", case.name, report.versions["numpyro"], report.versions["jax"]);
    Ok(Compared {
        case: case.name,
        ratio: ours.per_second / best(&NutsRun::rate),
        job_ratio: ours.job_per_second.unwrap_or(f64::NAN) / best(&NutsRun::job_rate),
        walk_ratio: ours.per_second / walk.per_second,
        mean_difference: (ours.log_likelihood_mean - nuts_mean) / error,
        diagnostics_difference,
        ours,
        nuts,
        walk,
    })
}

/// Mean of the log-likelihood over all configurations, each weighted by what it knows, and its standard error.
fn pooled(runs: &[Speed]) -> (f64, f64) {
    let weight = |run: &Speed| 1.0 / (run.log_likelihood_error * run.log_likelihood_error);
    let total: f64 = runs.iter().map(weight).sum();
    let mean = runs.iter().map(|run| weight(run) * run.log_likelihood_mean).sum::<f64>() / total;
    (mean, libm::sqrt(1.0 / total))
}

/// Our sampler on one thread: a job, then as many draws as the time allows.
fn ours(likelihood: &PreferenceLikelihood, seconds: f64, seed: u64) -> Result<Speed, PeersError> {
    let term = Term {
        kind: EvidenceKind::Preferences,
        rationality: Rationality::Fixed(1.0),
        likelihood: TermLikelihood::Preferences(likelihood.clone()),
    };
    let model = Model { n_features: N_FEATURES, prior: Prior::L2Sphere, nonnegative_return: None, terms: vec![term] };
    let (_, least_seconds, _) = timed_draw(&model, 10 * CHAINS, seed)?;
    let (_, job_seconds, job_effective) = timed_draw(&model, JOB_DRAWS, seed)?;
    let per_draw = (job_seconds - least_seconds).max(1e-9) / JOB_DRAWS as f64;
    let n_draws = ((seconds / per_draw) as usize / CHAINS * CHAINS).clamp(JOB_DRAWS, MAX_DRAWS);
    let (draws, all_seconds, effective) = timed_draw(&model, n_draws, seed)?;
    let (log_likelihood_mean, log_likelihood_error) = mean_and_error(&draws.log_likelihood, CHAINS)?;
    Ok(Speed {
        program: "ours".into(),
        per_second: effective.ess_bulk_min / (all_seconds - least_seconds),
        job_per_second: Some(job_effective.ess_bulk_min / job_seconds),
        seconds_per_draw: (all_seconds - least_seconds) / n_draws as f64,
        compile_seconds: None,
        leapfrogs_per_draw: None,
        effective,
        log_likelihood_mean,
        log_likelihood_error,
    })
}

/// CPU seconds of `n_draws` draws, their diagnostics left out: those are done once more to know how long they took.
fn timed_draw(model: &Model<'_>, n_draws: usize, seed: u64) -> Result<(Draws, f64, Effective), PeersError> {
    let run = Run { n_draws, n_chains: CHAINS, threads: 1, ..Run::default() };
    let (draws, all) = timed(|| draw(model, &run, seed, &[0; 32]));
    let draws = draws?;
    let (effective, judging) = timed(|| judge(&draws.values, N_FEATURES, &draws.log_likelihood, CHAINS));
    Ok((draws, all - judging, effective?))
}

fn nuts_speed(run: &NutsRun) -> Speed {
    Speed {
        program: run.name(),
        per_second: run.rate(),
        job_per_second: Some(run.job_rate()),
        seconds_per_draw: run.sampling_seconds / run.n_draws as f64,
        compile_seconds: Some(run.compile_seconds),
        leapfrogs_per_draw: Some(run.leapfrogs_per_draw),
        effective: run.all,
        log_likelihood_mean: run.log_likelihood_mean,
        log_likelihood_error: run.log_likelihood_mcse,
    }
}

/// The dissertation's walk, four chains, the first tenth left out.
fn walk(likelihood: &PreferenceLikelihood, seconds: f64, seed: u64) -> Result<Speed, PeersError> {
    let (_, first) = timed(|| l2_walk::walk(likelihood, FIRST_STEPS, seed));
    let per_step = first / FIRST_STEPS as f64;
    let n_steps = ((seconds / per_step) as usize / CHAINS).max(FIRST_STEPS);
    let (chains, all) =
        timed(|| (0..CHAINS as u64).map(|chain| l2_walk::walk(likelihood, n_steps, seed + chain)).collect::<Vec<_>>());
    let burn = chains[0].log_likelihood.len() / 10;
    let values: Vec<f64> = chains.iter().flat_map(|walk| &walk.values[burn * N_FEATURES..]).copied().collect();
    let heights: Vec<f64> = chains.iter().flat_map(|walk| &walk.log_likelihood[burn..]).copied().collect();
    let effective = judge(&values, N_FEATURES, &heights, CHAINS)?;
    let (log_likelihood_mean, log_likelihood_error) = mean_and_error(&heights, CHAINS)?;
    Ok(Speed {
        program: "the dissertation's walk".into(),
        per_second: effective.ess_bulk_min / (0.9 * all),
        job_per_second: None,
        seconds_per_draw: all / (n_steps * CHAINS) as f64,
        compile_seconds: None,
        leapfrogs_per_draw: None,
        effective,
        log_likelihood_mean,
        log_likelihood_error,
    })
}

fn print(compared: &Compared) {
    println!(
        "{:<42} {:>12} {:>12} {:>10} {:>9} {:>18}",
        "program", "ESS/CPU-s", "with warm-up", "us/draw", "R-hat", "mean log-lik."
    );
    for speed in std::iter::once(&compared.ours).chain(&compared.nuts).chain([&compared.walk]) {
        let job = speed.job_per_second.map_or_else(|| "-".into(), |rate| format!("{rate:.0}"));
        println!(
            "{:<42} {:>12.0} {:>12} {:>10.2} {:>9.4} {:>10.3} ± {:.3}",
            speed.program,
            speed.per_second,
            job,
            1e6 * speed.seconds_per_draw,
            speed.effective.rhat_max,
            speed.log_likelihood_mean,
            speed.log_likelihood_error
        );
    }
    println!(
        "ours / best NUTS: {:.1} (one job with warm-up: {:.1}); ours / walk: {:.0}",
        compared.ratio, compared.job_ratio, compared.walk_ratio
    );
    println!(
        "same posterior: mean log-likelihoods of ours and all NUTS runs differ by {:.1} standard errors; the effective sample sizes of ArviZ and ours of the same draws differ by {:.0e} at most",
        compared.mean_difference, compared.diagnostics_difference
    );
}

#[cfg(test)]
mod tests {
    use super::{ours, pooled, walk};
    use crate::preference_data::{CASES, PreferenceData};

    #[test]
    fn tiny_runs_agree_on_the_posterior_and_survive_json() {
        let likelihood = PreferenceData::draw(&CASES[0], 2).likelihood().expect("good data");
        let (ours, walk) = (ours(&likelihood, 1e-3, 1).expect("draws"), walk(&likelihood, 0.4, 1).expect("a walk"));
        let error = ours.log_likelihood_error.hypot(walk.log_likelihood_error);
        let difference = (ours.log_likelihood_mean - walk.log_likelihood_mean) / error;
        // A walk this short knows its own error badly.
        assert!(difference.abs() < 6.0, "{difference}");
        assert!(ours.per_second > 10.0 * walk.per_second, "{} vs {}", ours.per_second, walk.per_second);
        let json = serde_json::to_value(&ours).expect("JSON");
        assert_eq!(json["program"], "ours");
        assert!(json["effective"]["ess_bulk_min"].as_f64().is_some_and(|ess| ess > 1000.0));
        let (mean, error) = pooled(&[ours.clone(), ours.clone()]);
        assert!((mean - ours.log_likelihood_mean).abs() < 1e-9);
        assert!((error - ours.log_likelihood_error / 2_f64.sqrt()).abs() < 1e-12);
    }
}
