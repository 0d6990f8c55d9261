//! What the draws say about one parameter, and how exactly.

use diagnostics::Series;
use posterior::Draws;

/// A number that every draw has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Parameter {
    /// The weight of a feature.
    Weight(usize),
    /// The rationality of a term, where it is learned.
    Beta(usize),
    /// The log-likelihood.
    LogLikelihood,
}

/// Mean and spread of one parameter over all draws, and how far they can be trusted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Summary {
    pub(crate) mean: f64,
    pub(crate) sd: f64,
    /// 5 % quantile.
    pub(crate) q05: f64,
    /// 95 % quantile.
    pub(crate) q95: f64,
    /// Monte Carlo standard error of the mean.
    pub(crate) mcse: f64,
    pub(crate) rhat: f64,
    pub(crate) ess_bulk: f64,
    pub(crate) ess_tail: f64,
}

/// A summary of every parameter, on some threads.
pub(crate) fn summaries(draws: &Draws, parameters: &[Parameter], threads: usize) -> Vec<Summary> {
    let one = |parameter: &Parameter| match parameter {
        Parameter::Weight(k) => summary(&draws.feature(*k), draws.n_chains),
        Parameter::Beta(term) => summary(&draws.betas[*term].values, draws.n_chains),
        Parameter::LogLikelihood => summary(&draws.log_likelihood, draws.n_chains),
    };
    let share = parameters.len().div_ceil(threads.max(1)).max(1);
    std::thread::scope(|scope| {
        let running: Vec<_> = parameters
            .chunks(share)
            .map(|part| scope.spawn(move || part.iter().map(one).collect::<Vec<_>>()))
            .collect();
        running.into_iter().flat_map(|part| part.join().expect("diagnostics do not panic")).collect()
    })
}

fn summary(values: &[f64], n_chains: usize) -> Summary {
    let series = Series::new(values, n_chains).expect("chains are equally long, draws finite");
    Summary {
        mean: series.mean(),
        sd: series.sd(),
        q05: series.quantile(0.05),
        q95: series.quantile(0.95),
        mcse: series.mcse_mean(),
        rhat: series.rhat(),
        ess_bulk: series.ess_bulk(),
        ess_tail: series.ess_tail(),
    }
}
