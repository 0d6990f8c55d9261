//! The best mixture of known policies, from vertex to vertex: a simplex method that knows the shape of a tail.
//!
//! A vertex is m policies that are mixed and m draws at the edge σ of the tail. Their ψ equals σ, which with shares that sum
//! to 1 says what the shares and σ are. Every other draw is in the tail with all the probability it can hold, or not at all.
//! So a basis has m + 1 rows however many draws there are, m is at most k + 1, and a step costs a few products of the draws
//! with one vector. Neither a new policy nor another λ spoils a vertex: the search goes on from where it was.

mod dense;
mod step;

use dense::Factors;

use crate::level::Level;
use crate::scenarios::{Scenarios, dot};

/// Violations below this share of their scale are rounding.
const ROUNDING: f64 = 1e-11;
/// Offsets are changed by up to this share of the unit, each by another, so that no two draws tie.
const PERTURBATION: f64 = 1e-11;
/// Shares further below 0 than this mean that rounding has won.
const NEGATIVE: f64 = -1e-8;
/// Most steps of one search.
const MAX_STEPS: usize = 10_000;

/// What is searched: mixtures of `columns`, the feature counts of policies.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Game<'a> {
    pub(crate) scenarios: &'a Scenarios,
    pub(crate) level: Level,
    pub(crate) columns: &'a [&'a [f64]],
}

/// Where a search is.
#[derive(Debug, Clone)]
pub(crate) struct Vertex {
    /// The policies that are mixed.
    columns: Vec<usize>,
    /// The draws with ψ = σ, as many.
    edge: Vec<usize>,
    /// Whether each draw's ψ is below σ.
    below: Vec<bool>,
    /// b, perturbed.
    offsets: Vec<f64>,
    /// Unit of returns.
    unit: f64,
}

/// The best mixture.
#[derive(Debug, Clone)]
pub(crate) struct Best {
    /// (column, share), shares above 0 and summing to 1.
    pub(crate) shares: Vec<(usize, f64)>,
    /// q, the distribution over draws that holds every mixture down to this one's objective: N numbers.
    pub(crate) tail: Vec<f64>,
    pub(crate) steps: usize,
}

/// The mixture at a vertex.
struct Point {
    factors: Factors,
    /// Of each policy that is mixed.
    shares: Vec<f64>,
    /// ψ − σ of every draw.
    above: Vec<f64>,
}

/// What a policy must be worth to improve a vertex: weightsᵀμ above `value`.
struct Prices {
    weights: Vec<f64>,
    value: f64,
    /// (1 − λ) q of each draw at the edge.
    edge: Vec<f64>,
}

impl Vertex {
    /// The vertex of one policy alone, whose ψ is `values`; returns are counted in `unit`.
    pub(crate) fn new(scenarios: &Scenarios, level: Level, column: usize, values: &[f64], unit: f64) -> Self {
        let noise = |index: usize| PERTURBATION * unit * hash(index as u64);
        let offsets = scenarios.offsets.iter().enumerate().map(|(i, b)| b + noise(i)).collect();
        let perturbed: Vec<f64> = values.iter().enumerate().map(|(i, x)| x - noise(i)).collect();
        let mut order: Vec<u32> = (0..values.len() as u32).collect();
        order.sort_unstable_by(|&i, &j| perturbed[i as usize].total_cmp(&perturbed[j as usize]).then(i.cmp(&j)));
        let (mut below, mut left, mut edge) = (vec![false; values.len()], 1.0, 0);
        for index in order {
            edge = index as usize;
            left -= level.held(scenarios.masses[edge]);
            if left <= 0.0 {
                break;
            }
            below[edge] = true;
        }
        below[edge] = false;
        Self { columns: vec![column], edge: vec![edge], below, offsets, unit }
    }

    /// Goes on to the best mixture; `None` where rounding is in the way. The level's α is that of the start, its λ below 1.
    pub(crate) fn best(&mut self, game: &Game<'_>) -> Option<Best> {
        for steps in 0..MAX_STEPS {
            let point = self.point(game)?;
            let prices = self.prices(game, &point);
            match self.choose(game, &prices) {
                Some(step) => self.go(game, &point, &prices, step)?,
                None => return Some(self.found(game, &point, &prices, steps)),
            }
        }
        None
    }

    /// ψ_i of a policy.
    fn payoff(&self, game: &Game<'_>, draw: usize, counts: &[f64]) -> f64 {
        dot(game.scenarios.draw(draw), counts) - self.offsets[draw]
    }

    /// The mixture at this vertex, from M (shares, σ) = (0, …, 0, 1): rows are ψ_i − σ = 0 at the edge and the sum of shares.
    fn point(&mut self, game: &Game<'_>) -> Option<Point> {
        let m = self.columns.len();
        let mut matrix = Vec::with_capacity((m + 1) * (m + 1));
        for &i in &self.edge {
            matrix.extend(self.columns.iter().map(|&j| self.payoff(game, i, game.columns[j]) / self.unit));
            matrix.push(-1.0);
        }
        matrix.extend(std::iter::repeat_n(1.0, m));
        matrix.push(0.0);
        let factors = Factors::new(m + 1, matrix)?;
        let mut right = vec![0.0; m + 1];
        right[m] = 1.0;
        let mut shares = factors.solve(&right);
        let edge = shares.pop().expect("the last unknown is σ") * self.unit;
        if shares.iter().any(|share| share.is_nan() || *share < NEGATIVE) {
            return None;
        }
        let counts = self.mixed(game, &shares);
        let mut above = game.scenarios.products(&counts);
        above.iter_mut().zip(&self.offsets).for_each(|(above, b)| *above = *above - b - edge);
        self.edge.iter().for_each(|&i| above[i] = 0.0);
        for (below, above) in self.below.iter_mut().zip(&above) {
            if above.abs() > ROUNDING * self.unit {
                *below = *above < 0.0;
            }
        }
        Some(Point { factors, shares, above })
    }

    /// Σ x_j μ_j over the policies that are mixed.
    fn mixed(&self, game: &Game<'_>, x: &[f64]) -> Vec<f64> {
        let mut counts = vec![0.0; game.scenarios.n_features];
        for (&j, x) in self.columns.iter().zip(x) {
            counts.iter_mut().zip(game.columns[j]).for_each(|(sum, count)| *sum += x * count);
        }
        counts
    }

    /// The prices at which no policy that is mixed gains, from Mᵀ y = …
    fn prices(&self, game: &Game<'_>, point: &Point) -> Prices {
        let (scenarios, risk) = (game.scenarios, game.level.risk());
        let (mut held, mut weights, mut offset) = (0.0, vec![0.0; scenarios.n_features], 0.0);
        for i in (0..self.below.len()).filter(|&i| self.below[i]) {
            let share = game.level.held(scenarios.masses[i]);
            held += share;
            weights.iter_mut().zip(scenarios.draw(i)).for_each(|(sum, w)| *sum += share * w);
            offset += share * self.offsets[i];
        }
        for (w, mean) in weights.iter_mut().zip(&scenarios.mean) {
            *w = risk * *w + game.level.lambda * mean;
        }
        offset *= risk;
        let gain = |&j: &usize| -(dot(&weights, game.columns[j]) - offset) / self.unit;
        let right: Vec<f64> = self.columns.iter().map(gain).chain([-risk * (1.0 - held)]).collect();
        let mut edge = point.factors.solve_transposed(&right);
        let mut value = -edge.pop().expect("the last unknown is the value") * self.unit + offset;
        for (&i, y) in self.edge.iter().zip(&edge) {
            weights.iter_mut().zip(scenarios.draw(i)).for_each(|(sum, w)| *sum += y * w);
            value += y * self.offsets[i];
        }
        Prices { weights, value, edge }
    }

    /// The answer at the last vertex.
    fn found(&self, game: &Game<'_>, point: &Point, prices: &Prices, steps: usize) -> Best {
        let held = |i: usize| game.level.held(game.scenarios.masses[i]);
        let mut tail: Vec<f64> =
            self.below.iter().enumerate().map(|(i, below)| if *below { held(i) } else { 0.0 }).collect();
        for (&i, y) in self.edge.iter().zip(&prices.edge) {
            tail[i] = (y / game.level.risk()).clamp(0.0, held(i));
        }
        let positive = || self.columns.iter().zip(&point.shares).filter(|(_, share)| **share > 0.0);
        let total: f64 = positive().map(|(_, share)| share).sum();
        let shares = positive().map(|(&j, share)| (j, share / total)).collect();
        Best { shares, tail, steps }
    }
}

/// A number in [0, 1) that looks random (SplitMix64, Steele, Lea and Flood 2014).
fn hash(index: u64) -> f64 {
    let mut z = index.wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^= z >> 31;
    (z >> 11) as f64 / (1_u64 << 53) as f64
}
