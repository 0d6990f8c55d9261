//! One step of the search: what improves a vertex most, and how far that pays.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::{Game, Point, Prices, ROUNDING, Vertex};
use crate::scenarios::dot;

/// Directions below this share of their scale do not move.
const STILL: f64 = 1e-13;

/// What may improve a vertex.
#[derive(Debug, Clone, Copy)]
pub(super) enum Step {
    /// Mixes in another policy.
    Mix(usize),
    /// Lets the draw at this place of the edge rise above it.
    Rise(usize),
    /// Lets it fall below.
    Fall(usize),
}

/// What ends a step.
#[derive(Debug, Clone, Copy)]
enum End {
    /// The share of the policy at this place becomes 0.
    Policy(usize),
    /// This draw comes to the edge.
    Draw(usize),
}

/// A draw that comes to the edge; the greatest is the one that comes first.
#[derive(Debug, Clone, Copy)]
struct Crossing {
    /// Length of the step until then.
    at: f64,
    draw: usize,
    /// How fast its ψ − σ changes.
    speed: f64,
}

impl Ord for Crossing {
    fn cmp(&self, other: &Self) -> Ordering {
        other.at.total_cmp(&self.at).then(other.draw.cmp(&self.draw))
    }
}

impl PartialOrd for Crossing {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Crossing {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Crossing {}

/// How shares, σ and feature counts change per unit of a step.
struct Direction {
    shares: Vec<f64>,
    edge: f64,
    counts: Vec<f64>,
    /// How fast the objective grows at first.
    rate: f64,
}

impl Vertex {
    /// The step that promises most, if any does.
    pub(super) fn choose(&self, game: &Game<'_>, prices: &Prices) -> Option<Step> {
        let mut best = (ROUNDING * self.unit, None);
        for (j, counts) in game.columns.iter().enumerate() {
            let gain = dot(&prices.weights, counts) - prices.value;
            if gain > best.0 && !self.columns.contains(&j) {
                best = (gain, Some(Step::Mix(j)));
            }
        }
        for place in 0..self.edge.len() {
            for step in [Step::Rise(place), Step::Fall(place)] {
                let rate = self.edge_rate(game, prices, step);
                if rate > ROUNDING * game.level.risk() && rate * self.unit > best.0 {
                    best = (rate * self.unit, Some(step));
                }
            }
        }
        best.1
    }

    /// By how much the objective grows per ψ − σ of a draw that leaves the edge: its q is below 0, or more than it can hold.
    fn edge_rate(&self, game: &Game<'_>, prices: &Prices, step: Step) -> f64 {
        match step {
            Step::Mix(_) => 0.0,
            Step::Rise(place) => -prices.edge[place],
            Step::Fall(place) => {
                let mass = game.scenarios.masses[self.edge[place]];
                prices.edge[place] - game.level.risk() * game.level.held(mass)
            }
        }
    }

    fn direction(&self, game: &Game<'_>, point: &Point, prices: &Prices, step: Step) -> Direction {
        let m = self.columns.len();
        let mut right = vec![0.0; m + 1];
        match step {
            Step::Mix(j) => {
                for (x, &i) in right.iter_mut().zip(&self.edge) {
                    *x = -self.payoff(game, i, game.columns[j]) / self.unit;
                }
                right[m] = -1.0;
            }
            Step::Rise(place) => right[place] = 1.0,
            Step::Fall(place) => right[place] = -1.0,
        }
        let mut shares = point.factors.solve(&right);
        let edge = shares.pop().expect("the last unknown is σ") * self.unit;
        let mut counts = self.mixed(game, &shares);
        let mut rate = self.edge_rate(game, prices, step) * self.unit;
        if let Step::Mix(j) = step {
            counts.iter_mut().zip(game.columns[j]).for_each(|(sum, count)| *sum += count);
            rate = dot(&prices.weights, game.columns[j]) - prices.value;
        }
        Direction { shares, edge, counts, rate }
    }

    /// Goes as far as it pays; `None` where no end is in sight, which only rounding can bring about.
    pub(super) fn go(&mut self, game: &Game<'_>, point: &Point, prices: &Prices, step: Step) -> Option<()> {
        let direction = self.direction(game, point, prices, step);
        let end = self.pass(game, point, &direction)?;
        if let Step::Mix(j) = step {
            self.columns.push(j);
        }
        match end {
            End::Policy(place) => {
                self.columns.remove(place);
            }
            End::Draw(i) => self.edge.push(i),
        }
        if let Step::Rise(place) | Step::Fall(place) = step {
            let i = self.edge.remove(place);
            self.below[i] = matches!(step, Step::Fall(_));
        }
        self.edge.iter().for_each(|&i| self.below[i] = false);
        Some(())
    }

    /// Moves draws to the other side of the edge until the gain is used up, or the share of a policy.
    fn pass(&mut self, game: &Game<'_>, point: &Point, direction: &Direction) -> Option<End> {
        let (mut length, mut end) = (f64::INFINITY, None);
        for (place, (share, x)) in point.shares.iter().zip(&direction.shares).enumerate() {
            if *x < -STILL && share.max(0.0) / -x < length {
                (length, end) = (share.max(0.0) / -x, Some(End::Policy(place)));
            }
        }
        let still = STILL * self.unit;
        let mut crossings: Vec<Crossing> = vec![];
        let speeds = game.scenarios.products(&direction.counts);
        for (i, ((above, below), speed)) in point.above.iter().zip(&self.below).zip(speeds).enumerate() {
            let speed = speed - direction.edge;
            let comes = if *below { speed > still } else { speed < -still };
            if comes && above.abs() <= length * speed.abs() && !self.edge.contains(&i) {
                crossings.push(Crossing { at: above.abs() / speed.abs(), draw: i, speed: speed.abs() });
            }
        }
        // Few of them are ever passed.
        let mut crossings = BinaryHeap::from(crossings);
        let mut rate = direction.rate;
        while let Some(Crossing { draw: i, speed, .. }) = crossings.pop() {
            rate -= game.level.risk() * game.level.held(game.scenarios.masses[i]) * speed;
            if rate <= 0.0 {
                return Some(End::Draw(i));
            }
            self.below[i] = !self.below[i];
        }
        end
    }
}
