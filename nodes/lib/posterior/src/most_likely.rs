//! The most likely weights on the prior's sphere: with a uniform prior, its mode. A function of the evidence alone.
//!
//! The log-likelihood is concave, so its maximum over the ball inside the sphere is one convex problem. Where that lies on
//! the sphere (fewer demonstrations than weights, or placements better than β expects) it is the answer. Otherwise the
//! sphere is climbed from several starts around it.

use likelihood::placements::{PlacementLikelihood, Scratch};

use crate::Prior;
use crate::linear::{dot, largest_eigenvalue, times};
use crate::prior::{nearest_in_ball, nearest_on_sphere, norm};

/// Of equally likely weights the smaller are preferred by ½ this ‖w‖²: at most half a thousandth of a nat, enough to make
/// the answer unique, so that a little different evidence gives a little different answer.
const TIE_BREAK: f64 = 1e-3;
/// Climbs end where a step moves no weight by more than this.
const TOLERANCE: f64 = 1e-9;
const MAX_STEPS: usize = 60;
const MODEL_STEPS: usize = 400;
/// Starts on the sphere, at most.
const N_STARTS: usize = 5;

/// Where the climb may go.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Domain {
    Ball,
    Sphere,
}

/// The most likely weights on the prior's sphere at rationality `beta`, and their log-likelihood (`exact`). `coarse` is the
/// same likelihood on wider cells, used to get near.
///
/// Without placements all weights are as likely as any other; then they are all equal and positive.
pub(crate) fn most_likely(
    prior: Prior,
    beta: f64,
    exact: &PlacementLikelihood,
    coarse: &PlacementLikelihood,
) -> (Vec<f64>, f64) {
    let n = exact.n_features();
    if exact.n_placements() == 0 {
        return (nearest_on_sphere(prior, &vec![0.0; n]), 0.0);
    }
    let mut climber =
        Climber { prior, beta, coarse, exact, coarse_scratch: coarse.scratch(), exact_scratch: exact.scratch() };
    let (near, _) = climber.climb(vec![0.0; n], Domain::Ball, Cells::Wide);
    let (inner, _) = climber.climb(near, Domain::Ball, Cells::Exact);
    if norm(prior, &inner) > 1.0 - 1e-6 {
        let w = nearest_on_sphere(prior, &inner);
        let value = climber.value(&w, Cells::Exact);
        return (w, value);
    }
    let mut best: Option<(Vec<f64>, f64)> = None;
    for start in climber.starts(&inner) {
        let (near, value) = climber.climb(start, Domain::Sphere, Cells::Wide);
        if best.as_ref().is_none_or(|(_, top)| value > *top) {
            best = Some((near, value));
        }
    }
    let (near, _) = best.expect("there is at least one start");
    let (w, _) = climber.climb(near, Domain::Sphere, Cells::Exact);
    let value = climber.value(&w, Cells::Exact);
    (w, value)
}

/// On which cells the likelihood is taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Cells {
    Wide,
    Exact,
}

struct Climber<'a> {
    prior: Prior,
    beta: f64,
    coarse: &'a PlacementLikelihood,
    exact: &'a PlacementLikelihood,
    coarse_scratch: Scratch,
    exact_scratch: Scratch,
}

impl Climber<'_> {
    /// Points of the sphere around a point inside it: straight out, then along the axes, most likely first.
    fn starts(&mut self, inner: &[f64]) -> Vec<Vec<f64>> {
        let mut along_axes = Vec::new();
        for k in 0..inner.len() {
            for sign in [1.0, -1.0] {
                // ‖inner + t e_k‖ grows with t: bisection finds where it is 1.
                let (mut low, mut high) = (0.0, 2.0);
                let mut start = inner.to_vec();
                for _ in 0..40 {
                    let middle = 0.5 * (low + high);
                    start[k] = inner[k] + sign * middle;
                    if norm(self.prior, &start) < 1.0 { low = middle } else { high = middle }
                }
                let start = nearest_on_sphere(self.prior, &start);
                along_axes.push((self.value(&start, Cells::Wide), start));
            }
        }
        along_axes.sort_by(|a, b| b.0.total_cmp(&a.0));
        let outward = nearest_on_sphere(self.prior, inner);
        std::iter::once(outward).chain(along_axes.into_iter().map(|(_, w)| w)).take(N_STARTS).collect()
    }

    /// Climbs `likelihood` by steps that maximise a quadratic model over the domain, its curvature taken from the coarse
    /// likelihood and raised until the step is uphill. Returns the top and the objective there.
    fn climb(&mut self, start: Vec<f64>, domain: Domain, cells: Cells) -> (Vec<f64>, f64) {
        let n = start.len();
        let mut w = start;
        let mut gradient = vec![0.0; n];
        let mut objective = self.objective(cells, &w, &mut gradient);
        let mut damping = 0.0;
        for _ in 0..MAX_STEPS {
            let mut curvature = self.coarse.information(&self.theta(&w), &mut self.coarse_scratch);
            curvature.iter_mut().for_each(|c| *c *= self.beta * self.beta);
            for i in 0..n {
                curvature[i * n + i] += TIE_BREAK + damping;
            }
            let step = maximise_model(self.prior, domain, &w, &gradient, &curvature);
            let moved = step.iter().zip(&w).fold(0.0_f64, |moved, (a, b)| moved.max((a - b).abs()));
            if moved <= TOLERANCE {
                break;
            }
            let mut there = vec![0.0; n];
            let value = self.objective(cells, &step, &mut there);
            if value > objective {
                (w, gradient, objective) = (step, there, value);
                damping = if damping < 1e-3 { 0.0 } else { damping / 8.0 };
            } else {
                damping = (4.0 * damping).max(1e-3 * largest_eigenvalue(&curvature, n));
            }
        }
        (w, objective)
    }

    fn theta(&self, w: &[f64]) -> Vec<f64> {
        w.iter().map(|w| self.beta * w).collect()
    }

    fn value(&mut self, w: &[f64], cells: Cells) -> f64 {
        let theta = self.theta(w);
        match cells {
            Cells::Wide => self.coarse.value_with(&theta, &mut self.coarse_scratch),
            Cells::Exact => self.exact.value_with(&theta, &mut self.exact_scratch),
        }
    }

    fn objective(&mut self, cells: Cells, w: &[f64], gradient: &mut [f64]) -> f64 {
        let theta = self.theta(w);
        let (likelihood, scratch) = match cells {
            Cells::Wide => (self.coarse, &mut self.coarse_scratch),
            Cells::Exact => (self.exact, &mut self.exact_scratch),
        };
        let value = likelihood.value_and_gradient_with(&theta, gradient, scratch);
        for (g, w) in gradient.iter_mut().zip(w) {
            *g = self.beta * *g - TIE_BREAK * w;
        }
        value - 0.5 * TIE_BREAK * dot(w, w)
    }
}

/// Maximises gᵀ(v − w) − ½(v − w)ᵀH(v − w) over the domain by projected gradient steps, on the ball with momentum.
fn maximise_model(prior: Prior, domain: Domain, w: &[f64], gradient: &[f64], curvature: &[f64]) -> Vec<f64> {
    let n = w.len();
    let rate = 1.0 / largest_eigenvalue(curvature, n);
    let mut v = w.to_vec();
    let mut from = v.clone();
    let mut momentum = 1.0;
    let (mut offset, mut slope) = (vec![0.0; n], vec![0.0; n]);
    for _ in 0..MODEL_STEPS {
        for (offset, (from, w)) in offset.iter_mut().zip(from.iter().zip(w)) {
            *offset = from - w;
        }
        times(curvature, &offset, &mut slope);
        for (offset, (from, (g, slope))) in offset.iter_mut().zip(from.iter().zip(gradient.iter().zip(&slope))) {
            *offset = from + rate * (g - slope);
        }
        let next = match domain {
            Domain::Ball => nearest_in_ball(prior, &offset),
            Domain::Sphere => nearest_on_sphere(prior, &offset),
        };
        let moved = next.iter().zip(&v).fold(0.0_f64, |moved, (a, b)| moved.max((a - b).abs()));
        let backwards: f64 = (0..n).map(|i| (from[i] - next[i]) * (next[i] - v[i])).sum();
        let grown = if domain == Domain::Sphere || backwards > 0.0 {
            1.0
        } else {
            0.5 * (1.0 + libm::sqrt(1.0 + 4.0 * momentum * momentum))
        };
        let carry = if grown == 1.0 { 0.0 } else { (momentum - 1.0) / grown };
        for i in 0..n {
            from[i] = next[i] + carry * (next[i] - v[i]);
        }
        (v, momentum) = (next, grown);
        if moved < 0.01 * TOLERANCE {
            break;
        }
    }
    v
}
