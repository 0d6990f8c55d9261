//! Items and answers laid out for the inner loops: padded to whole vectors of eight, answers grouped by verdict.

use std::ops::Range;

use super::{Answer, Verdict};

/// Loops run over vectors of this many numbers, whatever the machine's width, so that sums have the same bits everywhere.
pub(super) const LANES: usize = 8;
pub(super) type Lanes = [f64; LANES];

/// Items and answers for the inner loops.
#[derive(Debug, Clone)]
pub(super) struct Layout {
    pub(super) n_items: usize,
    /// `by_feature[feature * item_chunks + chunk]`: features of eight items.
    pub(super) by_feature: Vec<Lanes>,
    /// Vectors that hold a number per item.
    pub(super) item_chunks: usize,
    /// `by_item[item * feature_chunks + chunk]`: eight features of an item.
    pub(super) by_item: Vec<Lanes>,
    /// Vectors that hold a number per feature.
    pub(super) feature_chunks: usize,
    /// Items (more, less) of each slot. Slots hold the answers by verdict and then by item, each verdict padded to whole vectors.
    pub(super) pairs: Vec<[u32; 2]>,
    /// Confidence of each slot; 0 in the padding.
    pub(super) factors: Vec<f64>,
    /// Slots of the verdicts strict, equal, can't tell: (answers and padding, answers).
    pub(super) groups: [(Range<usize>, Range<usize>); 3],
    /// Slots in which item i is the better one: `incidences[starts[2 i]..starts[2 i + 1]]`, the worse one: up to `starts[2 i + 2]`.
    pub(super) incidences: Vec<u32>,
    pub(super) starts: Vec<u32>,
}

impl Layout {
    pub(super) fn new(n_items: usize, n_features: usize, features: &[f64], answers: &[Answer]) -> Self {
        let (item_chunks, feature_chunks) = (n_items.div_ceil(LANES), n_features.div_ceil(LANES));
        let mut by_feature = vec![[0.0; LANES]; n_features * item_chunks];
        let mut by_item = vec![[0.0; LANES]; n_items * feature_chunks];
        for item in 0..n_items {
            for (feature, value) in features[item * n_features..][..n_features].iter().enumerate() {
                by_feature[feature * item_chunks + item / LANES][item % LANES] = *value;
                by_item[item * feature_chunks + feature / LANES][feature % LANES] = *value;
            }
        }
        let mut sorted = answers.to_vec();
        sorted.sort_by(|a, b| {
            let key = |answer: &Answer| (answer.verdict, answer.more, answer.less);
            key(a).cmp(&key(b)).then(a.factor.total_cmp(&b.factor))
        });
        let (mut pairs, mut factors) = (Vec::new(), Vec::new());
        let groups = [Verdict::Strict, Verdict::Equal, Verdict::CantTell].map(|verdict| {
            let first = pairs.len();
            for answer in sorted.iter().filter(|answer| answer.verdict == verdict) {
                pairs.push([index(answer.more), index(answer.less)]);
                factors.push(answer.factor);
            }
            let last = pairs.len();
            pairs.resize(last.next_multiple_of(LANES), [0, 0]);
            factors.resize(pairs.len(), 0.0);
            (first..pairs.len(), first..last)
        });
        let (incidences, starts) = incidences(n_items, &pairs, &groups);
        Self { n_items, by_feature, item_chunks, by_item, feature_chunks, pairs, factors, groups, incidences, starts }
    }
}

/// For each item the slots in which it is the better and in which it is the worse one, ascending.
fn incidences(n_items: usize, pairs: &[[u32; 2]], groups: &[(Range<usize>, Range<usize>); 3]) -> (Vec<u32>, Vec<u32>) {
    let ends = || {
        let slots = groups.iter().flat_map(|(_, answers)| answers.clone());
        slots.flat_map(|slot| [(2 * pairs[slot][0] as usize, slot), (2 * pairs[slot][1] as usize + 1, slot)])
    };
    let mut starts = vec![0_u32; 2 * n_items + 1];
    for (list, _) in ends() {
        starts[list + 1] += 1;
    }
    for list in 1..starts.len() {
        starts[list] += starts[list - 1];
    }
    let mut next = starts.clone();
    let mut incidences = vec![0; ends().count()];
    for (list, slot) in ends() {
        incidences[next[list] as usize] = index(slot);
        next[list] += 1;
    }
    (incidences, starts)
}

fn index(at: usize) -> u32 {
    u32::try_from(at).expect("items and answers are few enough for 32 bits")
}
