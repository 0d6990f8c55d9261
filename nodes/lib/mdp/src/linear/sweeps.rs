//! Gauss–Seidel sweeps for x = b + W x, states downstream first, with a bound on the error.

use crate::MdpError;
use crate::linear::conjugate::{History, Step};

/// Sweeps without a smaller change after which there is nothing to hope for.
const PATIENCE: usize = 50;
/// Sweeps after which those that would follow are taken together.
const ROUNDS: usize = 4;

/// Relative error that solutions have at most: 1e-13, or what rounding leaves at a long horizon.
pub(crate) fn precision(gamma: f64) -> f64 {
    1e-13_f64.max(16.0 * f64::EPSILON / (1.0 - gamma))
}

/// W laid out for sweeps. Each state comes after the one it most probably leads to, as far as there are no cycles: what is
/// known downstream reaches all states upstream in one sweep. Loops from a state to itself are solved for.
#[derive(Debug, Clone)]
pub(crate) struct Sweeps {
    gamma: f64,
    /// States in order.
    states: Vec<u32>,
    /// The place of each state in that order.
    places: Vec<u32>,
    /// 1 / (1 − W_ss) for each state.
    stay: Vec<f64>,
    /// Where the entries of each state start, in order.
    starts: Vec<u32>,
    targets: Vec<u32>,
    /// W_st / (1 − W_ss).
    weights: Vec<f64>,
}

impl Sweeps {
    /// W = `factor` times the weights that row(s) gives for each of n states, targets in any order; no row of W sums to more
    /// than γ.
    pub(crate) fn new<'a>(n: usize, gamma: f64, factor: f64, row: impl Fn(usize) -> (&'a [u32], &'a [f64])) -> Self {
        let states = downstream_first(n, |state| most_probable(row(state)));
        let mut places = vec![0; n];
        states.iter().enumerate().for_each(|(place, &state)| places[state as usize] = place as u32);
        let mut sweeps = Self {
            gamma,
            states,
            places,
            stay: vec![1.0; n],
            starts: Vec::with_capacity(n + 1),
            targets: Vec::new(),
            weights: Vec::new(),
        };
        sweeps.starts.push(0);
        for &state in &sweeps.states {
            let (targets, weights) = row(state as usize);
            let entries = || targets.iter().zip(weights).filter(|(target, _)| **target != state);
            let stay = stay(state, factor, targets, weights);
            sweeps.stay[state as usize] = stay;
            sweeps.targets.extend(entries().map(|(target, _)| *target));
            sweeps.weights.extend(entries().map(|(_, weight)| factor * weight * stay));
            sweeps.starts.push(sweeps.targets.len() as u32);
        }
        sweeps
    }

    /// Replaces the row of one state, given as to [`Self::new`] with the same factor, and leaves the order as it is; whether there
    /// was room for it. Without, nothing is changed.
    pub(crate) fn replace(&mut self, state: usize, factor: f64, (targets, weights): (&[u32], &[f64])) -> bool {
        let place = self.places[state] as usize;
        let range = self.starts[place] as usize..self.starts[place + 1] as usize;
        let entries = || targets.iter().zip(weights).filter(|(target, _)| **target as usize != state);
        if entries().count() > range.len() {
            return false;
        }
        let stay = stay(state as u32, factor, targets, weights);
        self.stay[state] = stay;
        let nothing = (&(state as u32), &0.0);
        let slots = self.targets[range.clone()].iter_mut().zip(&mut self.weights[range]);
        for ((target, weight), new) in slots.zip(entries().chain(std::iter::repeat(nothing))) {
            (*target, *weight) = (*new.0, factor * new.1 * stay);
        }
        true
    }

    #[inline]
    fn row(&self, place: usize) -> impl Iterator<Item = (usize, &f64)> {
        let range = self.starts[place] as usize..self.starts[place + 1] as usize;
        self.targets[range.clone()].iter().map(|&target| target as usize).zip(&self.weights[range])
    }

    /// b in the order and scale that [`Sweeps::sweep`] needs: n × `width`.
    pub(crate) fn prepared(&self, b: &[f64], width: usize) -> Vec<f64> {
        let mut prepared = Vec::with_capacity(b.len());
        for &state in &self.states {
            let state = state as usize;
            prepared.extend(b[state * width..][..width].iter().map(|b| b * self.stay[state]));
        }
        prepared
    }

    /// One sweep of n values. The largest change: times γ/(1 − γ) it bounds the error that is left.
    pub(crate) fn sweep(&self, prepared: &[f64], x: &mut [f64]) -> f64 {
        let mut change = 0.0_f64;
        for (place, (&state, b)) in self.states.iter().zip(prepared).enumerate() {
            let mut sum = *b;
            for (target, weight) in self.row(place) {
                sum += weight * x[target];
            }
            let x = &mut x[state as usize];
            change = change.max((sum - *x).abs());
            *x = sum;
        }
        change
    }

    /// Sweeps n values until one changes them by at most `enough`, or `most` times; every few sweeps those that would follow are
    /// taken together (Aitken's extrapolation), since each changes the values nearly by the same share of the last.
    pub(crate) fn relax(&self, prepared: &[f64], x: &mut [f64], enough: f64, most: usize) {
        let mut changes = [vec![0.0; x.len()], vec![0.0; x.len()]];
        let (mut before, mut extrapolate) = (f64::INFINITY, true);
        for i in 0..most {
            let place = i % ROUNDS;
            let kept = (extrapolate && place + 2 >= ROUNDS).then(|| &mut changes[place + 2 - ROUNDS]);
            let change = match kept {
                None => self.sweep(prepared, x),
                Some(kept) => {
                    kept.copy_from_slice(x);
                    let change = self.sweep(prepared, x);
                    kept.iter_mut().zip(&*x).for_each(|(kept, x)| *kept = x - *kept);
                    change
                }
            };
            if change <= enough {
                break;
            }
            // It did not help.
            extrapolate &= place != 0 || change <= before;
            if extrapolate && place + 1 == ROUNDS {
                before = change;
                let [last_but_one, last] = &changes;
                let product = last.iter().zip(last_but_one).fold(0.0, |sum, (x, y)| sum + x * y);
                let square = last_but_one.iter().fold(0.0, |sum, x| sum + x * x);
                let ratio = product / square;
                if ratio > 0.0 && ratio < 1.0 {
                    let share = ratio / (1.0 - ratio);
                    x.iter_mut().zip(last).for_each(|(x, change)| *x += share * change);
                }
            }
        }
    }

    /// One sweep of n × `width` values.
    fn sweep_many(&self, prepared: &[f64], x: &mut [f64], sum: &mut [f64]) -> f64 {
        let width = sum.len();
        let mut change = 0.0_f64;
        for (place, (&state, b)) in self.states.iter().zip(prepared.chunks_exact(width)).enumerate() {
            sum.copy_from_slice(b);
            for (target, weight) in self.row(place) {
                for (sum, x) in sum.iter_mut().zip(&x[target * width..][..width]) {
                    *sum += weight * x;
                }
            }
            for (x, sum) in x[state as usize * width..][..width].iter_mut().zip(&*sum) {
                change = change.max((sum - *x).abs());
                *x = *sum;
            }
        }
        change
    }

    /// Replaces b, n × `width`, by the solution to within [`precision`] of the largest possible one, max|b| / (1 − γ).
    ///
    /// # Errors
    /// When sweeps stop helping before.
    pub(crate) fn solve(&self, x: &mut [f64], width: usize) -> Result<(), MdpError> {
        let scale = x.iter().fold(0.0_f64, |max, b| max.max(b.abs())) / (1.0 - self.gamma);
        let prepared = self.prepared(x, width);
        let wanted = precision(self.gamma);
        let (mut least, mut since, mut sweeps) = (f64::INFINITY, 0, 0);
        let mut sum = vec![0.0; width];
        loop {
            let change = if width == 1 { self.sweep(&prepared, x) } else { self.sweep_many(&prepared, x, &mut sum) };
            sweeps += 1;
            let error = self.gamma / (1.0 - self.gamma) * change;
            if error <= wanted * scale {
                return Ok(());
            }
            if change < least {
                (least, since) = (change, 0);
            } else {
                since += 1;
            }
            if since > PATIENCE {
                return Err(MdpError::NotConverged { got: error / scale, wanted, sweeps });
            }
        }
    }

    /// Replaces the visits that start in each state, of either sign, by all discounted visits, y = b + Wᵀ y: pushes
    /// downstream what is left to come, upstream first. Absolute errors sum to at most [`precision`] of Σ|b| / (1 − γ).
    pub(crate) fn visits(&self, b: &mut [f64]) {
        let negligible = self.negligible(b);
        let mut left = b.to_vec();
        b.fill(0.0);
        self.push(&mut left, b, negligible, PATIENCE);
        b.iter_mut().zip(&self.stay).for_each(|(visits, stay)| *visits *= stay);
    }

    /// What visits of one state are too few to follow, for visits that start as `b`.
    fn negligible(&self, b: &[f64]) -> f64 {
        precision(self.gamma) * b.iter().map(|x| x.abs()).sum::<f64>() / b.len() as f64
    }

    /// The same for visits `b` of no negative sign, beginning with `near`, the visits of another chain: where the chains differ
    /// little, little is left to come. Fewer visits of a state than are followed are none.
    pub(crate) fn visits_near(&self, b: &mut [f64], near: &[f64]) {
        let negligible = self.negligible(b);
        let mut left = b.to_vec();
        for (place, &state) in self.states.iter().enumerate() {
            // Visits are counted without those that stay, until the end.
            let visits = near[state as usize] / self.stay[state as usize];
            b[state as usize] = visits;
            left[state as usize] -= visits;
            for (target, weight) in self.row(place) {
                left[target] += visits * weight;
            }
        }
        self.push(&mut left, b, negligible, PATIENCE);
        for (visits, stay) in b.iter_mut().zip(&self.stay) {
            *visits = if *visits > negligible { *visits * stay } else { 0.0 };
        }
    }

    /// Adds to `b`, visits without those that stay, all that follow from `left`, of either sign: rounds of pushing, each with the
    /// share that leaves least in squares, after what the rounds before it already took is taken out (the generalised conjugate
    /// residual method, Eisenstat, Elman and Schultz 1983, whose preconditioner is a round).
    /// After `patience` rounds in which little became less, rounds are plain until it does.
    fn push(&self, left: &mut [f64], b: &mut [f64], negligible: f64, patience: usize) {
        let mut history = History::new(left.len());
        let mut before = vec![0.0; left.len()];
        let (mut least, mut since) = (f64::INFINITY, 0);
        loop {
            before.copy_from_slice(left);
            let step = history.next();
            if !self.push_once(left, step, negligible) {
                break;
            }
            let size: f64 = before.iter().map(|x| x.abs()).sum();
            (least, since) = if size < 0.9 * least { (size, 0) } else { (least, since + 1) };
            if since > patience {
                // Plain rounds leave at most γ of what was left each, so this ends.
                b.iter_mut().zip(&step.direction).for_each(|(visits, x)| *visits += x);
                history.clear();
                continue;
            }
            step.image.iter_mut().zip(&before).zip(&*left).for_each(|((image, before), after)| *image = before - after);
            let share = history.conjugate(&before);
            let step = history.last();
            for ((visits, left), (direction, (image, before))) in
                b.iter_mut().zip(&mut *left).zip(step.direction.iter().zip(step.image.iter().zip(&before)))
            {
                *visits += share * direction;
                *left = before - share * image;
            }
        }
    }

    /// Pushes what is left in each state on to those that follow; whether there was anything that counts.
    fn push_once(&self, left: &mut [f64], step: &mut Step, negligible: f64) -> bool {
        let mut pushed = false;
        for (place, &state) in self.states.iter().enumerate().rev() {
            let visits = left[state as usize];
            let counts = visits.abs() > negligible;
            step.direction[state as usize] = if counts { visits } else { 0.0 };
            if counts {
                pushed = true;
                left[state as usize] = 0.0;
                for (target, weight) in self.row(place) {
                    left[target] += visits * weight;
                }
            }
        }
        pushed
    }
}

/// 1 / (1 − W_ss).
fn stay(state: u32, factor: f64, targets: &[u32], weights: &[f64]) -> f64 {
    let loops = targets.iter().zip(weights).filter(|(target, _)| **target == state);
    1.0 / (1.0 - loops.map(|(_, weight)| factor * weight).sum::<f64>())
}

/// States by the number of most probable steps to where those end or meet themselves: states of the same number do not wait
/// for each other.
fn downstream_first(n: usize, next: impl Fn(usize) -> Option<usize>) -> Vec<u32> {
    const UNSEEN: u32 = u32::MAX;
    const ON_PATH: u32 = u32::MAX - 1;
    let mut depths = vec![UNSEEN; n];
    let mut path = Vec::new();
    let mut deepest = 0;
    for start in 0..n {
        let mut state = start;
        let mut depth = loop {
            if depths[state] == ON_PATH {
                break 0;
            }
            if depths[state] != UNSEEN {
                break depths[state] + 1;
            }
            depths[state] = ON_PATH;
            path.push(state);
            match next(state) {
                Some(next) => state = next,
                None => break 0,
            }
        };
        while let Some(state) = path.pop() {
            depths[state] = depth;
            deepest = deepest.max(depth as usize);
            depth += 1;
        }
    }
    let mut places = vec![0_u32; deepest + 2];
    for &depth in &depths {
        places[depth as usize + 1] += 1;
    }
    for depth in 0..=deepest {
        places[depth + 1] += places[depth];
    }
    let mut order = vec![0; n];
    for (state, &depth) in depths.iter().enumerate() {
        let place = &mut places[depth as usize];
        order[*place as usize] = state as u32;
        *place += 1;
    }
    order
}

/// The target of largest weight.
fn most_probable((targets, weights): (&[u32], &[f64])) -> Option<usize> {
    let mut best = None;
    let mut most = 0.0;
    for (&target, &weight) in targets.iter().zip(weights) {
        if weight > most {
            (best, most) = (Some(target as usize), weight);
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::{Sweeps, downstream_first};

    #[test]
    fn a_path_is_known_from_its_end() {
        // 3 → 1 → 0 → 2, which is the end; 4 and 5 lead to each other.
        let next = [Some(2), Some(0), None, Some(1), Some(5), Some(4)];
        let order = downstream_first(6, |state| next[state]);
        let place = |state| order.iter().position(|s| *s == state).expect("every state has a place");
        assert!(place(2) < place(0) && place(0) < place(1) && place(1) < place(3));
        assert_eq!(order.len(), 6);
    }

    #[test]
    fn one_sweep_solves_a_path_with_loops() {
        // x_s = 1 + 0.3 x_s + 0.6 x_{s+1}, the last x = 1.
        let n = 50;
        let rows: Vec<(Vec<u32>, Vec<f64>)> =
            (0..n).map(|s| if s + 1 < n { (vec![s, s + 1], vec![0.3, 0.6]) } else { (vec![], vec![]) }).collect();
        let sweeps = Sweeps::new(n as usize, 0.9, 1.0, |s| (&rows[s].0[..], &rows[s].1[..]));
        let mut x = vec![0.0; n as usize];
        sweeps.sweep(&sweeps.prepared(&vec![1.0; n as usize], 1), &mut x);
        assert!(sweeps.sweep(&sweeps.prepared(&vec![1.0; n as usize], 1), &mut x) < 1e-15);
        let mut visits = vec![0.0; n as usize];
        visits[0] = 1.0;
        sweeps.visits(&mut visits);
        // Σ visits is the value of a reward of 1 everywhere.
        assert!((visits.iter().sum::<f64>() - x[0]).abs() < 1e-12);
    }

    #[test]
    fn rows_are_replaced_where_there_is_room() {
        let mut rows = jumble(50, 0.9);
        let mut sweeps = Sweeps::new(50, 0.9, 1.0, |s| (&rows[s].0[..], &rows[s].1[..]));
        rows[7] = (vec![7, 3, 9], vec![0.2, 0.3, 0.4]);
        rows[11] = (vec![], vec![]);
        for s in [7, 11] {
            assert!(sweeps.replace(s, 1.0, (&rows[s].0, &rows[s].1)));
        }
        assert!(!sweeps.replace(11, 1.0, (&[1, 2, 3, 4, 5], &[0.1; 5])), "there is room for four");
        let fresh = Sweeps::new(50, 0.9, 1.0, |s| (&rows[s].0[..], &rows[s].1[..]));
        let (mut old, mut new) = (vec![1.0; 50], vec![1.0; 50]);
        sweeps.solve(&mut old, 1).expect("a solution");
        fresh.solve(&mut new, 1).expect("a solution");
        assert!(old.iter().zip(&new).all(|(x, y)| (x - y).abs() < 1e-11));
        let (mut old, mut new) = (vec![1.0; 50], vec![1.0; 50]);
        sweeps.visits(&mut old);
        fresh.visits(&mut new);
        assert!(old.iter().zip(&new).all(|(x, y)| (x - y).abs() < 1e-11));
    }

    /// A chain without structure: each state leads to four others.
    fn jumble(n: u32, gamma: f64) -> Vec<(Vec<u32>, Vec<f64>)> {
        let shares = [0.4, 0.3, 0.2, 0.1].map(|share| gamma * share);
        (0..n).map(|s| ([7, 31, 113, 257].map(|stride| (s * stride + stride) % n).to_vec(), shares.to_vec())).collect()
    }

    #[test]
    fn long_horizons_are_solved_whatever_is_taken_together() {
        for gamma in [0.5, 0.95, 0.999] {
            let rows = jumble(300, gamma);
            let sweeps = Sweeps::new(300, gamma, 1.0, |s| (&rows[s].0[..], &rows[s].1[..]));
            let begin: Vec<f64> = (0..300).map(|s| f64::from(s % 7) - 2.0).collect();
            let mut visits = begin.clone();
            sweeps.visits(&mut visits);
            let mut balance = begin.clone();
            for (s, (targets, weights)) in rows.iter().enumerate() {
                balance[s] -= visits[s];
                targets
                    .iter()
                    .zip(weights)
                    .for_each(|(&target, weight)| balance[target as usize] += visits[s] * weight);
            }
            let left: f64 = balance.iter().map(|x| x.abs()).sum();
            assert!(left <= 1e-11 / (1.0 - gamma), "γ = {gamma}: {left:e} left of visits");

            // The same from the visits of a chain that differs in every tenth state.
            let starts = vec![1.0 / 300.0; 300];
            let (mut other, mut from_near, mut from_none) = (rows.clone(), starts.clone(), starts.clone());
            other.iter_mut().step_by(10).for_each(|row| row.1.reverse());
            let mut near = starts.clone();
            Sweeps::new(300, gamma, 1.0, |s| (&other[s].0[..], &other[s].1[..])).visits(&mut near);
            sweeps.visits_near(&mut from_near, &near);
            sweeps.visits(&mut from_none);
            let apart: f64 = from_near.iter().zip(&from_none).map(|(x, y)| (x - y).abs()).sum();
            assert!(apart <= 1e-12 / (1.0 - gamma), "γ = {gamma}: {apart:e} apart");

            // The same whenever rounds become plain, and conjugate again.
            for patience in [0, 1, 3] {
                let (mut left, mut pushed) = (starts.clone(), vec![0.0; 300]);
                sweeps.push(&mut left, &mut pushed, sweeps.negligible(&starts), patience);
                let visits = pushed.iter().zip(&sweeps.stay).map(|(visits, stay)| visits * stay);
                let apart: f64 = visits.zip(&from_none).map(|(x, y)| (x - y).abs()).sum();
                assert!(apart <= 1e-12 / (1.0 - gamma), "γ = {gamma}, patience {patience}: {apart:e} apart");
            }

            let mut x = vec![0.0; 300];
            sweeps.relax(&sweeps.prepared(&begin, 1), &mut x, 1e-12, 100_000);
            let residual = rows.iter().zip(&begin).zip(&x).fold(0.0_f64, |most, (((targets, weights), b), x_s)| {
                let ahead: f64 = targets.iter().zip(weights).map(|(&target, weight)| weight * x[target as usize]).sum();
                most.max((b + ahead - x_s).abs())
            });
            assert!(residual <= 1e-11, "γ = {gamma}: residual {residual:e}");
            // The same as the visits say: visitsᵀ 1 = Σ begin / (1 − γ) = beginᵀ(values of 1).
            let all: f64 = visits.iter().sum();
            let expected = begin.iter().sum::<f64>() / (1.0 - gamma);
            assert!((all - expected).abs() <= 1e-10 * expected.abs(), "γ = {gamma}: {all} and {expected}");
        }
    }
}
