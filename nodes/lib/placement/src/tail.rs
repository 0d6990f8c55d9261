//! Conditional value at risk of many small samples, without sorting them.

/// Mean of the worst share 1 − α of the losses, the one at the edge counted in part (Rockafellar and Uryasev 2002);
/// the largest loss at α = 1, `NaN` without losses. Reorders `losses`.
pub fn cvar(losses: &mut [f64], alpha: f64) -> f64 {
    let n = losses.len();
    if n == 0 {
        return f64::NAN;
    }
    let share = ((1.0 - alpha) * n as f64).clamp(0.0, n as f64);
    // Rounded so that (1 − α) n that is a whole number but for rounding is one.
    let nearest = share.round();
    let share = if (share - nearest).abs() < 1e-9 * n as f64 { nearest } else { share };
    let beyond = (share.floor() as usize).min(n);
    if beyond == n {
        return losses.iter().sum::<f64>() / n as f64;
    }
    let (_, &mut edge, tail) = losses.select_nth_unstable_by(n - 1 - beyond, f64::total_cmp);
    if share == 0.0 {
        return edge;
    }
    // As a mean plus a correction, so that equal losses give exactly that loss.
    let excess: f64 = tail.iter().map(|x| x - edge).sum();
    edge + excess / share
}

#[cfg(test)]
mod tests {
    use super::cvar;

    #[test]
    fn equal_weights_average_the_worst() {
        // Method notes section 7: n = 2000, α = .99 is the mean of the worst 20; n = 300, α = .95 of the worst 15.
        let mut losses: Vec<f64> = (1..=2000).map(|i| f64::from((i * 7919) % 2003)).collect();
        let mut sorted = losses.clone();
        sorted.sort_by(f64::total_cmp);
        let worst = |n: usize| sorted[sorted.len() - n..].iter().sum::<f64>() / n as f64;
        assert!((cvar(&mut losses, 0.99) - worst(20)).abs() < 1e-9);
        assert!((cvar(&mut losses, 0.95) - worst(100)).abs() < 1e-9);
        assert!((cvar(&mut losses, 0.0) - worst(2000)).abs() < 1e-9);
        assert_eq!(cvar(&mut losses, 1.0), sorted[1999]);
    }

    #[test]
    fn the_edge_counts_in_part() {
        // Worst 1.5 of 3: (3 + 0.5 · 2) / 1.5.
        assert!((cvar(&mut [1.0, 3.0, 2.0], 0.5) - 4.0 / 1.5).abs() < 1e-12);
        assert_eq!(cvar(&mut [0.1; 7], 0.9), 0.1);
        assert!(cvar(&mut [], 0.9).is_nan());
    }
}
