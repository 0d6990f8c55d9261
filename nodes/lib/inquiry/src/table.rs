//! Questions about tables: placement losses (section 8.2.4) and the answers to "where does it belong?" and "which of these two
//! places is better?".

use likelihood::preferences::AnswerModel;
use mdp::random::categorical;
use rand_chacha::ChaCha8Rng;
use scene::{Field, Grid, Point, Rbf, Scene, exp};

use crate::error::{check_length, check_numbers};
use crate::tabular::comparison_answers;
use crate::{Alternatives, Answers, Belief, InquiryError, Losses};

/// Cells a side that a coarse answer cell is divided into.
const FINER: usize = 2;

/// Draws of the weights of a table's reward.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TableDraws<'a> {
    /// n × k weights, row by row.
    pub weights: &'a [f64],
    /// k.
    pub n_features: usize,
    /// Rationality: one for all draws, or one a draw.
    pub betas: &'a [f64],
}

impl TableDraws<'_> {
    fn n(&self) -> Result<usize, InquiryError> {
        let k = self.n_features;
        if k == 0 || self.weights.is_empty() {
            return Err(InquiryError::Empty { what: "draws" });
        }
        let n = self.weights.len() / k;
        check_length("weights of draws", self.weights.len(), n * k)?;
        check_length("rationalities", self.betas.len(), if self.betas.len() == 1 { 1 } else { n })?;
        check_numbers("rationality", self.betas, "positive and finite", |beta| beta > 0.0 && beta.is_finite())?;
        Ok(n)
    }

    fn beta(&self, draw: usize) -> f64 {
        self.betas[if self.betas.len() == 1 { 0 } else { draw }]
    }
}

/// Losses from placements: `optima_m` has the best placement of every draw for each table, `current_m` where the robot would
/// put it.
///
/// # Errors
/// Tables with other numbers of draws, or none.
pub fn placement_losses(current_m: &[Point], optima_m: &[Vec<Point>]) -> Result<Losses, InquiryError> {
    check_length("placements", current_m.len(), optima_m.len())?;
    let n = optima_m.first().map_or(0, Vec::len);
    let mut values = Vec::with_capacity(n * optima_m.len());
    for (current, optima) in current_m.iter().zip(optima_m) {
        check_length("optima", optima.len(), n)?;
        values.extend(optima.iter().map(|best| best.distance(*current)));
    }
    Losses::new(n, values)
}

/// Losses of the ways to place that the robot could take up: `current_m`, then those of `n` draws evenly spaced among all. Under
/// each draw it is the mean over the tables.
///
/// # Errors
/// Tables with other numbers of draws, or none.
pub fn placement_alternatives(
    current_m: &[Point],
    optima_m: &[Vec<Point>],
    n: usize,
) -> Result<Alternatives, InquiryError> {
    check_length("placements", current_m.len(), optima_m.len())?;
    let n_draws = optima_m.first().map_or(0, Vec::len);
    for optima in optima_m {
        check_length("optima", optima.len(), n_draws)?;
    }
    let n = n.min(n_draws);
    let share = 1.0 / optima_m.len().max(1) as f64;
    let mut losses = vec![0.0; (n + 1) * n_draws];
    for (row, losses) in losses.chunks_exact_mut(n_draws.max(1)).enumerate() {
        for (current, optima) in current_m.iter().zip(optima_m) {
            let placed = if row == 0 { *current } else { optima[(row - 1) * n_draws / n] };
            losses.iter_mut().zip(optima).for_each(|(sum, best)| *sum += share * best.distance(placed));
        }
    }
    Alternatives::new(n_draws, losses)
}

/// "Where does it belong on this table?": an answer is one of `side` × `side` equal cells, row by row from the near left, and has the
/// probability exp(β R) there, normalised over what is free (equation of method notes section 5). `None` where nothing is.
///
/// # Errors
/// Draws of another number of features than the scene has; rationalities that do not fit; a side of 0.
pub fn placement_answers(scene: &Scene, draws: &TableDraws<'_>, side: usize) -> Result<Option<Answers>, InquiryError> {
    let n = draws.n()?;
    if side == 0 {
        return Err(InquiryError::Empty { what: "cells" });
    }
    let rbf = Rbf::new(scene);
    check_length("features of the scene", rbf.n(), draws.n_features)?;
    let fine = side * FINER;
    let field = Field::new(&rbf, &Grid::midpoints(fine), Some(scene));
    if field.n_free() == 0 {
        return Ok(None);
    }
    let mut rewards = vec![0.0; fine * fine];
    let mut probabilities = vec![0.0; side * side * n];
    for (draw, w) in draws.weights.chunks_exact(draws.n_features).enumerate() {
        let (_, total) = masses(&field, w, draws.beta(draw), &mut rewards);
        for (cell, mass) in rewards.iter().enumerate() {
            let answer = cell / fine / FINER * side + cell % fine / FINER;
            probabilities[answer * n + draw] += mass / total;
        }
    }
    Answers::table(n, probabilities).map(Some)
}

/// The same with `n` places drawn instead of cells, for when answers lie closer together than cells: each is drawn from what
/// one of n evenly spaced draws expects on a grid of `side` × `side` points, which also normalises the densities. `None` where
/// nothing is free.
///
/// # Errors
/// As [`placement_answers`]; a belief about other draws.
pub fn sampled_placement_answers(
    scene: &Scene,
    draws: &TableDraws<'_>,
    belief: &Belief,
    n: usize,
    side: usize,
    rng: &mut ChaCha8Rng,
) -> Result<Option<Answers>, InquiryError> {
    let n_draws = draws.n()?;
    check_length("draws with weights", belief.n(), n_draws)?;
    if side == 0 || n == 0 {
        return Err(InquiryError::Empty { what: "places" });
    }
    let rbf = Rbf::new(scene);
    check_length("features of the scene", rbf.n(), draws.n_features)?;
    let field = Field::new(&rbf, &Grid::midpoints(side), Some(scene));
    if field.n_free() == 0 {
        return Ok(None);
    }
    // Which draws an answer is drawn from, in proportion to their weights, evenly.
    let mut sources = Vec::with_capacity(n);
    let (mut draw, mut passed) = (0, belief.weights()[0]);
    for answer in 0..n {
        let share = (answer as f64 + 0.5) / n as f64;
        while passed < share && draw + 1 < n_draws {
            draw += 1;
            passed += belief.weights()[draw];
        }
        sources.push(draw);
    }
    let mut rewards = vec![0.0; side * side];
    let mut normalisers = Vec::with_capacity(n_draws);
    let mut places = Vec::with_capacity(n);
    for (draw, w) in draws.weights.chunks_exact(draws.n_features).enumerate() {
        let (best, total) = masses(&field, w, draws.beta(draw), &mut rewards);
        normalisers.push((best, total));
        for _ in sources.iter().filter(|source| **source == draw) {
            places.push(field.grid().at(categorical(rewards.iter().copied(), total, rng)));
        }
    }
    let mut densities = Vec::with_capacity(n * n_draws);
    for place in places {
        let phi = rbf.features(place);
        densities.extend(draws.weights.chunks_exact(draws.n_features).zip(&normalisers).enumerate().map(
            |(draw, (w, (best, total)))| {
                let reward: f64 = w.iter().zip(&phi).map(|(w, phi)| w * phi).sum();
                exp(draws.beta(draw) * (reward - best)) / total
            },
        ));
    }
    Answers::sampled(belief, densities).map(Some)
}

/// exp(β (R − best)) at every free point of the grid, 0 at the others, into `rewards`; gives the best reward and their sum.
fn masses(field: &Field, w: &[f64], beta: f64, rewards: &mut [f64]) -> (f64, f64) {
    field.rewards(w, rewards);
    let free = rewards.iter().zip(field.free()).filter(|(_, free)| **free);
    let best = free.map(|(reward, _)| *reward).fold(f64::NEG_INFINITY, f64::max);
    let mut total = 0.0;
    for (mass, &free) in rewards.iter_mut().zip(field.free()) {
        *mass = if free { exp(beta * (*mass - best)) } else { 0.0 };
        total += *mass;
    }
    (best, total)
}

/// Which answer of [`placement_answers`] a placement is, in coordinates in which the table is the unit square.
pub fn placement_answer(at: Point, side: usize) -> usize {
    let cell = |x: f64| ((x * side as f64).max(0.0) as usize).min(side.saturating_sub(1));
    cell(at.y) * side + cell(at.x)
}

/// "Which of these two places is better?", normalised coordinates: first, second, then "about equal" and "can't tell" where they
/// are offered.
///
/// # Errors
/// Draws of another number of features than the scene has; a model that is none.
pub fn placement_comparison(
    scene: &Scene,
    draws: &TableDraws<'_>,
    first: Point,
    second: Point,
    model: &AnswerModel,
) -> Result<Answers, InquiryError> {
    draws.n()?;
    let rbf = Rbf::new(scene);
    check_length("features of the scene", rbf.n(), draws.n_features)?;
    let (a, b) = (rbf.features(first), rbf.features(second));
    let difference: Vec<f64> = a.iter().zip(&b).map(|(a, b)| b - a).collect();
    let of =
        |(draw, w): (usize, &[f64])| draws.beta(draw) * w.iter().zip(&difference).map(|(w, phi)| w * phi).sum::<f64>();
    comparison_answers(draws.weights.chunks_exact(draws.n_features).enumerate().map(of), model)
}
