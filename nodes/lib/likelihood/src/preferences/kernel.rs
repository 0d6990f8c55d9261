//! The inner loops: returns of all items, log-probabilities and slopes of all answers, and the gradient.
//!
//! Everything is `inline(always)` so that it is compiled anew inside each `pulp` dispatch for that machine's vectors.
//! Additions happen in the same order for every vector width.

use scene::exp;

use super::AnswerModel;
use super::layout::{LANES, Lanes, Layout};
use super::logarithm::log;

/// Vectors accumulated side by side, so that additions need not wait for each other.
const ABREAST: usize = 4;
/// Vectors of factors in [1, 2] that are multiplied before a logarithm is taken: their product stays below 2^960.
const CHUNKS_PER_PRODUCT: usize = 120;
/// A difference that makes a plain answer certain, for the padding: it adds exactly nothing.
const CERTAIN: f64 = 1e3;

/// Positions of the verdicts in [`Layout::groups`].
const STRICT: usize = 0;
const EQUAL: usize = 1;
const CANNOT_TELL: usize = 2;

/// Buffers of one thread of evaluation.
#[derive(Debug, Clone)]
pub(super) struct Scratch {
    /// ⟨θ, Φ⟩ per item.
    returns: Vec<Lanes>,
    /// d per slot.
    differences: Vec<f64>,
    /// Log-probability per slot, or 1 + e^−|d|.
    values: Vec<f64>,
    /// Derivative of the log-probability in the difference of the returns, per slot.
    slopes: Vec<f64>,
}

impl Scratch {
    pub(super) fn new(layout: &Layout) -> Self {
        let slots = vec![0.0; layout.pairs.len()];
        let returns = vec![[0.0; LANES]; layout.item_chunks];
        Self { returns, differences: vec![CERTAIN; slots.len()], values: slots.clone(), slopes: slots }
    }
}

/// What the answer model comes down to in the inner loops.
#[derive(Debug, Clone, Copy)]
pub(super) struct Constants {
    plain: bool,
    t: f64,
    /// 4 τ and 4 (1 − τ).
    four_tau: f64,
    four_rest: f64,
    /// log(4 τ).
    log_cannot_tell: f64,
    /// log(1 − e^{−2t}).
    log_equal: f64,
    /// log of the probability of one random click, and of 1 − ε; `None` without them.
    clicks: Option<Clicks>,
}

#[derive(Debug, Clone, Copy)]
struct Clicks {
    log_click: f64,
    log_meant: f64,
}

impl Constants {
    pub(super) fn new(model: &AnswerModel) -> Self {
        let clicks = (model.wrong_rate > 0.0).then(|| Clicks {
            log_click: libm::log(model.wrong_rate / model.n_offered() as f64),
            log_meant: libm::log1p(-model.wrong_rate),
        });
        Self {
            plain: model.is_plain(),
            t: model.equal_threshold,
            four_tau: 4.0 * model.cant_tell,
            four_rest: 4.0 * (1.0 - model.cant_tell),
            log_cannot_tell: libm::log(4.0 * model.cant_tell),
            log_equal: libm::log(-libm::expm1(-2.0 * model.equal_threshold)),
            clicks,
        }
    }
}

/// d of every slot that holds an answer.
#[inline(always)]
pub(super) fn differences(layout: &Layout, theta: &[f64], scratch: &mut Scratch) {
    let returns = &mut scratch.returns[..];
    combine(&layout.by_feature, layout.item_chunks, theta.iter(), |chunk, lanes| returns[chunk] = lanes);
    let returns = scratch.returns.as_flattened();
    for (_, answers) in &layout.groups {
        let pairs = layout.pairs[answers.clone()].iter().zip(&layout.factors[answers.clone()]);
        for (difference, ([more, less], factor)) in scratch.differences[answers.clone()].iter_mut().zip(pairs) {
            *difference = factor * (returns[*more as usize] - returns[*less as usize]);
        }
    }
}

/// Σ of the log-probabilities; the slopes stay in `scratch`.
#[inline(always)]
pub(super) fn answers(layout: &Layout, constants: &Constants, scratch: &mut Scratch) -> f64 {
    if constants.plain {
        return plain(layout, scratch);
    }
    match constants.clicks {
        None => {
            meant::<STRICT>(layout, constants, scratch)
                + meant::<EQUAL>(layout, constants, scratch)
                + meant::<CANNOT_TELL>(layout, constants, scratch)
        }
        Some(clicks) => {
            clicked::<STRICT>(layout, constants, &clicks, scratch)
                + clicked::<EQUAL>(layout, constants, &clicks, scratch)
                + clicked::<CANNOT_TELL>(layout, constants, &clicks, scratch)
        }
    }
}

/// Σ over the answers of slope × (Φ_more − Φ_less).
#[inline(always)]
pub(super) fn gradient(layout: &Layout, scratch: &mut Scratch, gradient: &mut [f64]) {
    let slopes = &scratch.slopes[..];
    let lists = layout.starts.windows(2).map(|ends| &layout.incidences[ends[0] as usize..ends[1] as usize]);
    let mut sums = lists.map(|slots| sum_of(slots, slopes));
    // Returns are not needed any more.
    for item in scratch.returns.as_flattened_mut() {
        *item = match (sums.next(), sums.next()) {
            (Some(as_more), Some(as_less)) => as_more - as_less,
            _ => 0.0,
        };
    }
    let per_item = &scratch.returns.as_flattened()[..layout.n_items];
    combine(&layout.by_item, layout.feature_chunks, per_item.iter(), |chunk, lanes| {
        let out = &mut gradient[chunk * LANES..];
        let n = out.len().min(LANES);
        out[..n].copy_from_slice(&lanes[..n]);
    });
}

/// Σ_i coefficient_i × row_i of a matrix with rows of `n_chunks` vectors, chunk by chunk into `out`.
#[inline(always)]
fn combine<'a>(
    rows: &[Lanes],
    n_chunks: usize,
    coefficients: impl Iterator<Item = &'a f64> + Clone,
    mut out: impl FnMut(usize, Lanes),
) {
    let mut chunk = 0;
    while chunk + ABREAST <= n_chunks {
        let mut sums = [[0.0; LANES]; ABREAST];
        for (row, c) in rows.chunks_exact(n_chunks).zip(coefficients.clone()) {
            let row = &row[chunk..chunk + ABREAST];
            for (sum, row) in sums.iter_mut().zip(row) {
                for lane in 0..LANES {
                    sum[lane] += c * row[lane];
                }
            }
        }
        for (beside, sum) in sums.into_iter().enumerate() {
            out(chunk + beside, sum);
        }
        chunk += ABREAST;
    }
    while chunk < n_chunks {
        let mut sum = [0.0; LANES];
        for (row, c) in rows.chunks_exact(n_chunks).zip(coefficients.clone()) {
            for lane in 0..LANES {
                sum[lane] += c * row[chunk][lane];
            }
        }
        out(chunk, sum);
        chunk += 1;
    }
}

#[inline(always)]
fn sum_of(slots: &[u32], slopes: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let mut quads = slots.chunks_exact(4);
    for quad in &mut quads {
        for lane in 0..4 {
            sums[lane] += slopes[quad[lane] as usize];
        }
    }
    let rest: f64 = quads.remainder().iter().map(|&slot| slopes[slot as usize]).sum();
    ((sums[0] + sums[2]) + (sums[1] + sums[3])) + rest
}

/// Bradley–Terry: log s(d) = −max(−d, 0) − log(1 + e^−|d|), with one logarithm for the product of many answers.
#[inline(always)]
fn plain(layout: &Layout, scratch: &mut Scratch) -> f64 {
    let per_slot = scratch.slopes.iter_mut().zip(&mut scratch.values).zip(&layout.factors).zip(&scratch.differences);
    for (((slope, value), factor), &d) in per_slot {
        let e = exp(-d.abs());
        let q = 1.0 + e;
        *value = q;
        *slope = factor * (if d > 0.0 { e } else { 1.0 }) / q;
    }
    let mut shortfall = [0.0; LANES];
    for d in scratch.differences.chunks_exact(LANES) {
        for lane in 0..LANES {
            // Twice max(−d, 0); unlike a comparison it lets NaN through.
            shortfall[lane] += d[lane].abs() - d[lane];
        }
    }
    let mut value = -0.5 * sum_lanes(&shortfall);
    for block in scratch.values.chunks(CHUNKS_PER_PRODUCT * LANES) {
        let mut product = [1.0; LANES];
        for q in block.chunks_exact(LANES) {
            for lane in 0..LANES {
                product[lane] *= q[lane];
            }
        }
        let [a, b, c, d, e, f, g, h] = product;
        value -= libm::log(((a * e) * (c * g)) * ((b * f) * (d * h)));
    }
    value
}

/// Σ of the log-probabilities of the answers of one verdict, without random clicks.
#[inline(always)]
fn meant<const VERDICT: usize>(layout: &Layout, constants: &Constants, scratch: &mut Scratch) -> f64 {
    let slots = &layout.groups[VERDICT].0;
    let factors = &layout.factors[slots.clone()];
    let outputs = scratch.slopes[slots.clone()].iter_mut().zip(&mut scratch.values[slots.clone()]);
    for ((slope, value), (factor, &d)) in outputs.zip(factors.iter().zip(&scratch.differences[slots.clone()])) {
        let (log_probability, log_slope) = answer::<VERDICT>(d, constants);
        *value = log_probability;
        *slope = factor * log_slope;
    }
    sum_counted(&scratch.values[slots.clone()], factors)
}

/// Σ of log((1 − ε) e^L + ε / n) of the answers of one verdict, L being their log-probabilities without random clicks.
#[inline(always)]
fn clicked<const VERDICT: usize>(
    layout: &Layout,
    constants: &Constants,
    clicks: &Clicks,
    scratch: &mut Scratch,
) -> f64 {
    let slots = &layout.groups[VERDICT].0;
    let factors = &layout.factors[slots.clone()];
    let outputs = scratch.slopes[slots.clone()].iter_mut().zip(&mut scratch.values[slots.clone()]);
    for ((slope, value), (factor, &d)) in outputs.zip(factors.iter().zip(&scratch.differences[slots.clone()])) {
        let (log_probability, log_slope) = answer::<VERDICT>(d, constants);
        let z = log_probability + clicks.log_meant - clicks.log_click;
        let e = exp(-z.abs());
        let q = 1.0 + e;
        *value = clicks.log_click + positive_part(z) + log(q);
        *slope = factor * log_slope * (if z > 0.0 { 1.0 } else { e }) / q;
    }
    sum_counted(&scratch.values[slots.clone()], factors)
}

/// Σ of `values` without the padding, which alone has the factor 0.
#[inline(always)]
fn sum_counted(values: &[f64], factors: &[f64]) -> f64 {
    let mut sum = [0.0; LANES];
    for (value, factor) in values.chunks_exact(LANES).zip(factors.chunks_exact(LANES)) {
        for lane in 0..LANES {
            sum[lane] += if factor[lane] > 0.0 { value[lane] } else { 0.0 };
        }
    }
    sum_lanes(&sum)
}

/// Log-probability of an answer at d, and its slope in d.
#[inline(always)]
fn answer<const VERDICT: usize>(d: f64, c: &Constants) -> (f64, f64) {
    match VERDICT {
        STRICT => strict_answer(d, c),
        EQUAL => equal_answer(d, c),
        _ => cannot_tell_answer(d, c),
    }
}

/// log(1 − 4 τ s(d) s(−d)) as the numerator over (1 + e)², e = e^−|d|, and its slope in d.
#[inline(always)]
fn can_tell(d: f64, e: f64, c: &Constants) -> (f64, f64) {
    let rest = 1.0 - e;
    let numerator = rest * rest + c.four_rest * e;
    let slope = c.four_tau * e * rest / ((1.0 + e) * numerator);
    (numerator, if d > 0.0 { slope } else { -slope })
}

/// log[(1 − 4 τ s(d) s(−d)) s(d − t)].
#[inline(always)]
fn strict_answer(d: f64, c: &Constants) -> (f64, f64) {
    let e = exp(-d.abs());
    let (numerator, slope) = can_tell(d, e, c);
    let x = c.t - d;
    let below = exp(-x.abs());
    let q = 1.0 + below;
    let share = (if x > 0.0 { 1.0 } else { below }) / q;
    (log(numerator / ((1.0 + e) * (1.0 + e) * q)) - positive_part(x), slope + share)
}

/// log[(1 − 4 τ s(d) s(−d)) (1 − e^{−2t}) s(t − d) s(t + d)], the last three factors being (e^{2t} − 1) s(d − t) s(−d − t).
#[inline(always)]
fn equal_answer(d: f64, c: &Constants) -> (f64, f64) {
    let e = exp(-d.abs());
    let (numerator, slope) = can_tell(d, e, c);
    let (x, y) = (d - c.t, -d - c.t);
    let (above, below) = (exp(-x.abs()), exp(-y.abs()));
    let (p, q) = (1.0 + above, 1.0 + below);
    let ratio = numerator / ((1.0 + e) * (1.0 + e) * (p * q));
    let pull = (if y > 0.0 { 1.0 } else { below }) / q - (if x > 0.0 { 1.0 } else { above }) / p;
    (c.log_equal + log(ratio) - positive_part(x) - positive_part(y), slope + pull)
}

/// log[4 τ s(d) s(−d)].
#[inline(always)]
fn cannot_tell_answer(d: f64, c: &Constants) -> (f64, f64) {
    let distance = d.abs();
    let e = exp(-distance);
    let q = 1.0 + e;
    let slope = (1.0 - e) / q;
    (c.log_cannot_tell - distance - 2.0 * log(q), if d > 0.0 { -slope } else { slope })
}

/// max(x, 0), but NaN of NaN.
#[inline(always)]
fn positive_part(x: f64) -> f64 {
    0.5 * (x.abs() + x)
}

#[inline(always)]
fn sum_lanes(lanes: &Lanes) -> f64 {
    let [a, b, c, d, e, f, g, h] = lanes;
    ((a + e) + (c + g)) + ((b + f) + (d + h))
}
