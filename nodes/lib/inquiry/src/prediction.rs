//! About how many more answers it will take, with how that was reckoned.

/// Looks that a trend is read from, at most: the last ones.
const LOOKS: usize = 8;
/// Fewer looks show no trend.
const MIN_LOOKS: usize = 3;
/// More answers than this are as good as never.
const MOST: f64 = 1000.0;

/// About how many more answers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prediction {
    /// Answers until the bound is below ε.
    pub answers: u32,
    /// The same by the quickest quarter of what was seen.
    pub least: u32,
    /// The same by the slowest quarter of what was seen; `None`: it may never get there.
    pub most: Option<u32>,
    /// How it was reckoned.
    pub method: PredictionMethod,
}

/// How a prediction was made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PredictionMethod {
    /// The bound shrinks by the same share with every answer, the median of what it did between any two of this many last
    /// looks (Theil and Sen's slope of ln bound).
    Trend {
        /// Looks with a bound that were used.
        looks: usize,
    },
    /// One step ahead: every answer makes the bound smaller by the same share as the next one is expected to.
    OneStep {
        /// Expected drop of the bound by the next answer.
        drop: f64,
    },
}

/// About how many answers more until a bound of the last of `bounds` is below `epsilon`. `bounds` are those of every look so far,
/// oldest first, `None` where there was none; `drop` is what the next answer is expected to take from the last one.
///
/// `None` when nothing points to an end: no bound yet, or one that neither shrank nor is expected to.
pub fn predict(bounds: &[Option<f64>], epsilon: f64, drop: Option<f64>) -> Option<Prediction> {
    let last = (*bounds.last()?)?;
    if last < epsilon {
        return Some(Prediction { answers: 0, least: 0, most: Some(0), method: PredictionMethod::Trend { looks: 1 } });
    }
    let ratio = libm::log(last / epsilon);
    if !(ratio.is_finite() && epsilon > 0.0) {
        return None;
    }
    let recent: Vec<(f64, f64)> = bounds
        .iter()
        .enumerate()
        .filter_map(|(look, bound)| bound.filter(|bound| *bound > 0.0).map(|bound| (look as f64, libm::log(bound))))
        .collect();
    let recent = &recent[recent.len().saturating_sub(LOOKS)..];
    let answers = |rate: f64| (rate > 0.0 && ratio / rate <= MOST).then(|| libm::ceil(ratio / rate).max(1.0) as u32);
    if recent.len() >= MIN_LOOKS {
        let mut rates: Vec<f64> = Vec::new();
        for (i, a) in recent.iter().enumerate() {
            rates.extend(recent[i + 1..].iter().map(|b| (a.1 - b.1) / (b.0 - a.0)));
        }
        rates.sort_unstable_by(f64::total_cmp);
        let quarter = |share: f64| rates[(share * (rates.len() - 1) as f64) as usize];
        if let (Some(middle), Some(least)) = (answers(quarter(0.5)), answers(quarter(0.75))) {
            let method = PredictionMethod::Trend { looks: recent.len() };
            return Some(Prediction { answers: middle, least, most: answers(quarter(0.25)), method });
        }
    }
    let drop = drop.filter(|drop| *drop > 0.0)?;
    let method = PredictionMethod::OneStep { drop };
    // A drop to below ε at once is one answer.
    let middle = if last - drop < epsilon { 1 } else { answers(-libm::log1p(-drop / last))? };
    Some(Prediction { answers: middle, least: middle.div_ceil(2), most: None, method })
}

#[cfg(test)]
mod tests {
    use super::{PredictionMethod, predict};

    #[test]
    fn a_bound_that_halves_each_time_takes_the_logarithm() {
        let bounds: Vec<Option<f64>> = [1.6, 0.8, 0.4].map(Some).to_vec();
        let prediction = predict(&bounds, 0.1001, None).expect("a trend");
        assert_eq!((prediction.answers, prediction.least, prediction.most), (2, 2, Some(2)));
        assert_eq!(prediction.method, PredictionMethod::Trend { looks: 3 });
        // Looks without a bound are gaps, not steps.
        let gaps = [Some(1.6), None, Some(0.4), None, Some(0.1)];
        assert_eq!(predict(&gaps, 0.0499, None).expect("a trend").answers, 2);
    }

    #[test]
    fn too_few_looks_use_the_next_answer() {
        let prediction = predict(&[Some(0.4)], 0.1001, Some(0.2)).expect("a drop");
        assert_eq!((prediction.answers, prediction.method), (2, PredictionMethod::OneStep { drop: 0.2 }));
        assert_eq!(predict(&[Some(0.4)], 0.3, Some(0.2)).expect("a drop").answers, 1);
        // A bound that grows shows no end; the next answer may.
        let growing = [0.2, 0.3, 0.4].map(Some);
        assert_eq!(predict(&growing, 0.1, None), None);
        assert!(predict(&growing, 0.1, Some(0.1)).is_some());
    }

    #[test]
    fn without_a_bound_nothing_is_predicted() {
        assert_eq!(predict(&[], 0.1, Some(1.0)), None);
        assert_eq!(predict(&[Some(0.4), None], 0.1, Some(0.1)), None);
        assert_eq!(predict(&[Some(0.4)], 0.0, Some(0.1)), None);
        assert_eq!(predict(&[Some(0.05)], 0.1, None).expect("below").answers, 0);
        assert_eq!(predict(&[Some(0.4)], 0.1, None), None);
    }
}
