//! An order of states in which those that lead to each other stand close together (Cuthill and McKee 1969, reversed).

use std::collections::VecDeque;

/// A permutation of states and how wide the band is in it.
#[derive(Debug, Clone)]
pub(crate) struct Order {
    /// State at each place.
    pub(crate) states: Vec<u32>,
    /// Place of each state.
    pub(crate) places: Vec<u32>,
    /// Largest distance between the places of two states of which one leads to the other.
    pub(crate) bandwidth: usize,
}

/// A narrow order for `n` states and the transitions between them, given as pairs any number of times.
pub(crate) fn narrow_order(n: usize, edges: impl Iterator<Item = (usize, usize)> + Clone) -> Order {
    let neighbours = Neighbours::new(n, edges);
    let mut states: Vec<u32> = Vec::with_capacity(n);
    let mut seen = vec![false; n];
    let mut marks = Marks { last: vec![0; n], search: 0 };
    let mut by_degree: Vec<u32> = (0..n as u32).collect();
    by_degree.sort_by_key(|&state| neighbours.of(state).len());
    for &seed in &by_degree {
        if !seen[seed as usize] {
            let start = neighbours.far_end(seed, &mut marks);
            neighbours.breadth_first(start, &mut seen, &mut states);
        }
    }
    states.reverse();
    let mut places = vec![0; n];
    for (place, &state) in states.iter().enumerate() {
        places[state as usize] = place as u32;
    }
    let mut bandwidth = 0;
    for state in 0..n {
        for &other in neighbours.of(state as u32) {
            bandwidth = bandwidth.max(places[state].abs_diff(places[other as usize]) as usize);
        }
    }
    Order { states, places, bandwidth }
}

/// Which states a search has met; as many searches as wanted without clearing anything.
struct Marks {
    /// The last search that met each state.
    last: Vec<usize>,
    search: usize,
}

impl Marks {
    fn begin(&mut self) {
        self.search += 1;
    }

    /// Whether this search meets `state` for the first time.
    fn is_new(&mut self, state: u32) -> bool {
        std::mem::replace(&mut self.last[state as usize], self.search) != self.search
    }
}

/// Who leads to whom, in either direction; each list ascending by the number of neighbours.
struct Neighbours {
    starts: Vec<usize>,
    others: Vec<u32>,
}

impl Neighbours {
    fn new(n: usize, edges: impl Iterator<Item = (usize, usize)>) -> Self {
        let mut pairs: Vec<(u32, u32)> = edges
            .filter(|(from, to)| from != to)
            .flat_map(|(from, to)| [(from as u32, to as u32), (to as u32, from as u32)])
            .collect();
        pairs.sort_unstable();
        pairs.dedup();
        let mut starts = vec![0; n + 1];
        for pair in &pairs {
            starts[pair.0 as usize + 1] += 1;
        }
        for state in 0..n {
            starts[state + 1] += starts[state];
        }
        let mut others: Vec<u32> = pairs.into_iter().map(|pair| pair.1).collect();
        let degree = |state: u32| starts[state as usize + 1] - starts[state as usize];
        for state in 0..n {
            others[starts[state]..starts[state + 1]].sort_by_key(|&other| (degree(other), other));
        }
        Self { starts, others }
    }

    fn of(&self, state: u32) -> &[u32] {
        &self.others[self.starts[state as usize]..self.starts[state as usize + 1]]
    }

    /// Appends the component of `start` to `states`, nearest first.
    fn breadth_first(&self, start: u32, seen: &mut [bool], states: &mut Vec<u32>) {
        let mut next = states.len();
        seen[start as usize] = true;
        states.push(start);
        while next < states.len() {
            for &other in self.of(states[next]) {
                if !seen[other as usize] {
                    seen[other as usize] = true;
                    states.push(other);
                }
            }
            next += 1;
        }
    }

    /// A state of the component of `seed` about as far from the others as any (George and Liu 1979).
    fn far_end(&self, seed: u32, marks: &mut Marks) -> u32 {
        let (mut start, mut reach) = self.farthest(seed, marks);
        loop {
            let (end, farther) = self.farthest(start, marks);
            if farther <= reach {
                return start;
            }
            (start, reach) = (end, farther);
        }
    }

    /// The last state reached from `start`, of fewest neighbours, and in how many steps.
    fn farthest(&self, start: u32, marks: &mut Marks) -> (u32, usize) {
        marks.begin();
        marks.is_new(start);
        let mut queue = VecDeque::from([(start, 0)]);
        let mut best = (start, 0);
        while let Some((state, reached)) = queue.pop_front() {
            if reached > best.1 || (reached == best.1 && self.of(state).len() < self.of(best.0).len()) {
                best = (state, reached);
            }
            for &other in self.of(state) {
                if marks.is_new(other) {
                    queue.push_back((other, reached + 1));
                }
            }
        }
        best
    }
}

#[cfg(test)]
mod tests {
    use super::narrow_order;

    #[test]
    fn a_shuffled_line_becomes_a_line_again() {
        let n = 101;
        // 37 is coprime to 101: neighbours on the line lie far apart in the numbering.
        let edges = (0..n - 1).map(|i| (i * 37 % n, (i + 1) * 37 % n));
        assert_eq!(narrow_order(n, edges).bandwidth, 1);
    }

    #[test]
    fn every_state_has_one_place() {
        let order = narrow_order(6, [(0, 3), (3, 5), (1, 1)].into_iter());
        let mut states = order.states.clone();
        states.sort_unstable();
        assert_eq!(states, [0, 1, 2, 3, 4, 5]);
        for (place, state) in order.states.iter().enumerate() {
            assert_eq!(order.places[*state as usize], place as u32);
        }
    }
}
