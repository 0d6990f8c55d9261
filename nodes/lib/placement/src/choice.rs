//! What makes a place good, and the search for the best one that can be used.

use crate::tail::cvar;
use scene::{Point, Rbf, Scene};
use std::str::FromStr;

/// Steps of the refinement, as shares of a cell.
const SHARES: [f64; 5] = [0.5, 0.25, 0.125, 0.0625, 0.03125];
const MOVES_PER_SHARE: usize = 8;
/// A place this near to a draw's own best counts as that, metres.
pub const NEAR_M: f64 = 0.03;

/// Which place is taken, of those that can be used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Choice {
    /// Largest reward under the MAP weights.
    Map,
    /// Largest reward under the mean of the draws.
    Mean,
    /// Smallest value at risk of the distance to each draw's own best place: no farther than that with probability α.
    Var,
    /// Smallest conditional value at risk of that distance: its mean in the worst share 1 − α.
    #[default]
    Cvar,
    /// The place that most draws have their own best within [`NEAR_M`] of.
    MostLikely,
}

impl Choice {
    /// All of them with their names.
    pub const ALL: [(&'static str, Choice); 5] = [
        ("map", Choice::Map),
        ("mean", Choice::Mean),
        ("var", Choice::Var),
        ("cvar", Choice::Cvar),
        ("most_likely", Choice::MostLikely),
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, choice)| *choice == self).map_or("", |(name, _)| name)
    }
}

impl FromStr for Choice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let found = Self::ALL.iter().find(|(name, _)| *name == text);
        found.map(|(_, choice)| *choice).ok_or_else(|| {
            let names: Vec<&str> = Self::ALL.iter().map(|(name, _)| *name).collect();
            format!("choice is '{text}'; one of {} is needed", names.join(", "))
        })
    }
}

/// What the draws say about places in one scene.
pub(crate) struct Judge<'a> {
    scene: &'a Scene,
    rbf: Rbf,
    optima_m: &'a [Point],
    map_weights: &'a [f64],
    mean_weights: Vec<f64>,
    alpha: f64,
}

/// The figures of one place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Figures {
    pub mean_reward: f64,
    pub probability_best: f64,
    pub var_m: f64,
    pub cvar_m: f64,
}

impl<'a> Judge<'a> {
    /// `optima_m` holds each draw's own best place, `mean_weights` the mean of the draws.
    pub fn new(
        scene: &'a Scene,
        optima_m: &'a [Point],
        map_weights: &'a [f64],
        mean_weights: Vec<f64>,
        alpha: f64,
    ) -> Self {
        Self { scene, rbf: Rbf::new(scene), optima_m, map_weights, mean_weights, alpha }
    }

    /// What `choice` makes as small as it can.
    pub fn cost(&self, choice: Choice, at_m: Point, room: &mut Vec<f64>) -> f64 {
        let reward = |w: &[f64]| self.rbf.reward(w, self.scene.normalised(at_m));
        match choice {
            Choice::Map => -reward(self.map_weights),
            Choice::Mean => -reward(&self.mean_weights),
            Choice::Var => self.var_m(at_m, room),
            Choice::Cvar => self.cvar_m(at_m, room),
            Choice::MostLikely => {
                // Among places of one share the nearest on average, so that a search sees a slope.
                let mean = self.optima_m.iter().map(|x| x.distance(at_m)).sum::<f64>() / self.optima_m.len() as f64;
                1e-6 * mean - self.probability_best(at_m)
            }
        }
    }

    /// CVaR_α of the distance from a point to each draw's best place, metres.
    pub fn cvar_m(&self, at_m: Point, room: &mut Vec<f64>) -> f64 {
        self.distances(at_m, room);
        cvar(room, self.alpha)
    }

    /// VaR_α of it: the smallest distance that a share α of the draws do not exceed.
    fn var_m(&self, at_m: Point, room: &mut Vec<f64>) -> f64 {
        self.distances(at_m, room);
        let n = room.len();
        // α n that is a whole number but for rounding is one.
        let rank = (self.alpha * n as f64 - 1e-9 * n as f64).ceil().clamp(1.0, n as f64) as usize;
        *room.select_nth_unstable_by(rank - 1, f64::total_cmp).1
    }

    fn probability_best(&self, at_m: Point) -> f64 {
        let near = self.optima_m.iter().filter(|x| x.distance(at_m) <= NEAR_M).count();
        near as f64 / self.optima_m.len() as f64
    }

    fn distances(&self, at_m: Point, room: &mut Vec<f64>) {
        room.clear();
        room.extend(self.optima_m.iter().map(|x| x.distance(at_m)));
    }

    /// All figures of a place.
    pub fn figures(&self, at_m: Point, room: &mut Vec<f64>) -> Figures {
        Figures {
            mean_reward: self.rbf.reward(&self.mean_weights, self.scene.normalised(at_m)),
            probability_best: self.probability_best(at_m),
            var_m: self.var_m(at_m, room),
            cvar_m: self.cvar_m(at_m, room),
        }
    }

    /// Candidates by cost, best first; the first of equals stays first.
    pub fn rank(&self, choice: Choice, candidates: impl Iterator<Item = Point>) -> Vec<Ranked> {
        let mut room = Vec::with_capacity(self.optima_m.len());
        let mut ranked: Vec<Ranked> =
            candidates.map(|at_m| Ranked { at_m, cost: self.cost(choice, at_m, &mut room) }).collect();
        ranked.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        ranked
    }

    /// Betters a place by moves in eight directions, shorter and shorter, that stay usable. For the CVaR, which is convex in
    /// the place, only the boundary of what is usable can stop it early; for the others it finds the top of a hill.
    pub fn refine(
        &self,
        choice: Choice,
        start: Ranked,
        cell_m: Point,
        mut usable: impl FnMut(Point) -> bool,
    ) -> Ranked {
        const AROUND: [(f64, f64); 8] =
            [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
        let mut best = start;
        for share in SHARES {
            for _ in 0..MOVES_PER_SHARE {
                let steps = AROUND.iter().map(|&(dx, dy)| {
                    Point::new(best.at_m.x + share * dx * cell_m.x, best.at_m.y + share * dy * cell_m.y)
                });
                let ranked = self.rank(choice, steps);
                let better = ranked.into_iter().find(|step| step.cost < best.cost && usable(step.at_m));
                let Some(step) = better else { break };
                best = step;
            }
        }
        best
    }
}

/// A place and what it costs.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ranked {
    pub at_m: Point,
    pub cost: f64,
}
