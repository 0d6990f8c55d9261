//! Numbers on an axis: round ones, as short as they get.

/// As many digits as numbers that lie `step` apart need.
pub(crate) fn number(x: f64, span: f64) -> String {
    let step = span / 10.0;
    if x.abs() < 1e-9 * span {
        return "0".to_owned();
    }
    if !(1e-5..1e7).contains(&x.abs()) {
        return format!("{x:.1e}");
    }
    let decimals = if step > 0.0 { (1 - libm::floor(libm::log10(step)) as i32).clamp(0, 8) as usize } else { 3 };
    let text = format!("{x:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    text.replace('-', "−")
}

/// A little more than from `low` to `high`; around a single number where they are the same.
pub(crate) fn widened(low: f64, high: f64) -> [f64; 2] {
    let margin = 0.05 * (high - low);
    // Below this an axis could not tell its numbers apart.
    let least = 1e-9 * low.abs().max(high.abs()).max(1e-200);
    let margin = if margin > least { margin } else { 0.05 * low.abs().max(high.abs()).max(1e-200) };
    [low - margin, high + margin]
}

#[cfg(test)]
mod tests {
    use super::{number, widened};

    #[test]
    fn numbers_are_as_short_as_they_get() {
        assert_eq!(number(0.25, 1.0), "0.25");
        assert_eq!(number(-1500.0, 3000.0), "−1500");
        assert_eq!(number(1e-18, 1.0), "0");
        assert_eq!(number(0.5, 5.0), "0.5");
        assert_eq!(number(3e9, 1e10), "3.0e9");
    }

    #[test]
    fn an_axis_has_a_length() {
        for (low, high) in [(0.0, 0.0), (3.0, 3.0), (-1e9, -1e9), (1.0, 1.0 + 1e-15), (-2.0, 5.0)] {
            let [left, right] = widened(low, high);
            assert!(left < low && right > high, "{low} {high}");
        }
    }
}
