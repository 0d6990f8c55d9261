//! tmp
use posterior::{Lesson, Settings, sample};
#[path = "../tests/common/mod.rs"]
mod common;
#[allow(clippy::disallowed_methods)]
fn main() {
    let w = common::flowers_weights();
    for (n, beta) in [(0, 100.0), (1, 100.0), (5, 100.0), (10, 100.0), (20, 100.0), (10, 400.0), (10, 1e4), (20, 1.0)] {
        let lesson = common::lesson(n, 4, &w, 1);
        let l = Lesson::new(&common::flowers());
        for threads in [1] {
            let settings = Settings { beta, threads, ..Settings::default() };
            let t = std::time::Instant::now();
            let d = sample(&settings, 1, &l, &lesson).expect("draws");
            println!(
                "n {n} beta {beta} threads {threads}: {:?} acc {:.3} rhat {:.4} bulk {:.0} tail {:.0} ll {:.2} map {:.3} max {:.3} map1 {:.6} {:?}",
                t.elapsed(),
                d.acceptance,
                d.rhat_max,
                d.ess_bulk_min,
                d.ess_tail_min,
                d.log_likelihood_mean(),
                d.map_log_likelihood, d.log_likelihood.iter().copied().fold(f64::MIN, f64::max), d.map_weights.iter().map(|w|w.abs()).sum::<f64>(), d.map_weights.iter().map(|w|(w*1e3).round()/1e3).collect::<Vec<_>>()
            );
        }
    }
}
