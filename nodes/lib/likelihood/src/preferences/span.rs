//! What comparisons can say anything about: the span of the feature differences of compared items, and the likelihood in it.

use super::PreferenceLikelihood;

/// Passes of Gram–Schmidt over one direction: the second removes what rounding left of the first.
const PASSES: usize = 2;

/// Directions shorter than this are rounding, whatever the tolerance.
const ROUNDING: f64 = 1e-13;

/// An orthonormal basis of a subspace of the weights.
#[derive(Debug, Clone, PartialEq)]
pub struct Basis {
    n_features: usize,
    rank: usize,
    rows: Vec<f64>,
}

impl Basis {
    /// Dimension r of the subspace.
    pub fn rank(&self) -> usize {
        self.rank
    }

    /// Dimension k of the weights.
    pub fn n_features(&self) -> usize {
        self.n_features
    }

    /// The orthonormal rows, r × k.
    pub fn rows(&self) -> &[f64] {
        &self.rows
    }

    /// The r coordinates of the orthogonal projection of `vector` (k numbers).
    pub fn coordinates(&self, vector: &[f64]) -> Vec<f64> {
        assert_eq!(vector.len(), self.n_features, "a number per feature");
        self.rows.chunks_exact(self.n_features).map(|row| inner(row, vector)).collect()
    }

    /// The k numbers of the vector with these r `coordinates`.
    pub fn vector(&self, coordinates: &[f64]) -> Vec<f64> {
        assert_eq!(coordinates.len(), self.rank, "a number per direction");
        let mut vector = vec![0.0; self.n_features];
        for (row, &c) in self.rows.chunks_exact(self.n_features).zip(coordinates) {
            add_scaled(&mut vector, c, row);
        }
        vector
    }
}

impl PreferenceLikelihood {
    /// The span of Φ_more − Φ_less over the answers and of the vectors `extra` (k numbers each): the likelihood depends on the
    /// projection of θ onto it alone.
    ///
    /// A direction counts where it is longer than `tolerance` (1e-10, say) relative to the largest difference within its connected
    /// component of compared items, or to the extra vector it is from.
    pub fn difference_span(&self, extra: &[&[f64]], tolerance: f64) -> Basis {
        let k = self.n_features;
        let mut candidates = self.centred_items();
        candidates.retain(|row| row.iter().any(|&value| value != 0.0));
        for vector in extra {
            assert_eq!(vector.len(), k, "a number per feature");
            let mut row = vector.to_vec();
            scale_to_one(&mut [&mut row]);
            if row.iter().any(|&value| value != 0.0) {
                candidates.push(row);
            }
        }
        orthonormal(candidates, k, tolerance.max(ROUNDING))
    }

    /// The same likelihood as a function of the coordinates of θ in `basis`, which must hold [`Self::difference_span`]: items become
    /// coordinates relative to the mean of their connected component, so that differences of compared items are right to
    /// rounding. Items that were not compared with each other keep no common origin.
    pub fn projected(&self, basis: &Basis) -> Self {
        assert_eq!(basis.n_features, self.n_features, "a basis of the same weights");
        let mut items: Vec<Vec<f64>> = self.rows().map(<[f64]>::to_vec).collect();
        for members in self.components() {
            centre(&mut items, &members);
        }
        let features = items.iter().flat_map(|item| basis.coordinates(item)).collect();
        Self::trusted(basis.rank, self.n_items(), features, self.answers.clone(), self.model)
    }

    fn rows(&self) -> impl Iterator<Item = &[f64]> {
        // Without features there is nothing to iterate over, and no chunk of 0 either.
        self.features.chunks_exact(self.n_features.max(1))
    }

    /// Compared items relative to the mean of their component, each component scaled so that its largest row has length 1.
    fn centred_items(&self) -> Vec<Vec<f64>> {
        let mut items: Vec<Vec<f64>> = self.rows().map(<[f64]>::to_vec).collect();
        let mut rows = Vec::new();
        for members in self.components().into_iter().filter(|members| members.len() > 1) {
            centre(&mut items, &members);
            let mut component: Vec<Vec<f64>> = members.iter().map(|&item| std::mem::take(&mut items[item])).collect();
            scale_to_one(&mut component.iter_mut().collect::<Vec<_>>());
            rows.append(&mut component);
        }
        rows
    }

    /// Connected components of the graph of comparisons, items ascending, components by their smallest item.
    fn components(&self) -> Vec<Vec<usize>> {
        let n = self.n_items();
        let mut parents: Vec<usize> = (0..n).collect();
        for answer in &self.answers {
            let (a, b) = (root(&mut parents, answer.less), root(&mut parents, answer.more));
            parents[a.max(b)] = a.min(b);
        }
        let mut components: Vec<Vec<usize>> = vec![Vec::new(); n];
        for item in 0..n {
            // Roots are the smallest items, so that components come out in that order.
            components[root(&mut parents, item)].push(item);
        }
        components.retain(|members| !members.is_empty());
        components
    }
}

fn root(parents: &mut [usize], item: usize) -> usize {
    let mut node = item;
    while parents[node] != node {
        parents[node] = parents[parents[node]];
        node = parents[node];
    }
    node
}

/// Subtracts the mean of the members from each; a first shift to the first member keeps differences exact.
fn centre(items: &mut [Vec<f64>], members: &[usize]) {
    let origin = items[members[0]].clone();
    let mut mean = vec![0.0; origin.len()];
    for &item in members {
        for (value, origin) in items[item].iter_mut().zip(&origin) {
            *value -= origin;
        }
        add_scaled(&mut mean, 1.0 / members.len() as f64, &items[item]);
    }
    for &item in members {
        add_scaled(&mut items[item], -1.0, &mean);
    }
}

/// Divides all rows by the length of the longest; safe from overflow by first dividing by the largest number.
fn scale_to_one(rows: &mut [&mut Vec<f64>]) {
    let largest = rows.iter().flat_map(|row| row.iter()).fold(0.0_f64, |largest, value| largest.max(value.abs()));
    if largest > 0.0 {
        for value in rows.iter_mut().flat_map(|row| row.iter_mut()) {
            *value /= largest;
        }
        let longest = rows.iter().fold(0.0_f64, |longest, row| longest.max(inner(row, row)));
        for value in rows.iter_mut().flat_map(|row| row.iter_mut()) {
            *value /= longest.sqrt();
        }
    }
}

/// Gram–Schmidt, always with the longest of the remaining candidates (the first among equals), until none is longer than
/// `tolerance`.
fn orthonormal(mut candidates: Vec<Vec<f64>>, k: usize, tolerance: f64) -> Basis {
    let mut rows: Vec<f64> = Vec::new();
    let mut squares: Vec<f64> = candidates.iter().map(|row| inner(row, row)).collect();
    while rows.len() < k * k {
        let mut longest = 0;
        for (candidate, square) in squares.iter().enumerate() {
            if *square > squares[longest] {
                longest = candidate;
            }
        }
        if squares.get(longest).is_none_or(|square| square.sqrt() <= tolerance) {
            break;
        }
        let mut direction = std::mem::take(&mut candidates[longest]);
        squares[longest] = 0.0;
        normalise(&mut direction);
        for _ in 0..PASSES {
            for row in rows.chunks_exact(k) {
                let along = inner(row, &direction);
                add_scaled(&mut direction, -along, row);
            }
            normalise(&mut direction);
        }
        for (candidate, square) in candidates.iter_mut().zip(&mut squares).filter(|(_, square)| **square > 0.0) {
            let along = inner(&direction, candidate);
            add_scaled(candidate, -along, &direction);
            *square = inner(candidate, candidate);
        }
        rows.append(&mut direction);
    }
    Basis { n_features: k, rank: rows.len() / k.max(1), rows }
}

fn normalise(vector: &mut [f64]) {
    let length = inner(vector, vector).sqrt();
    vector.iter_mut().for_each(|value| *value /= length);
}

fn inner(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn add_scaled(sum: &mut [f64], c: f64, vector: &[f64]) {
    for (sum, value) in sum.iter_mut().zip(vector) {
        *sum += c * value;
    }
}
