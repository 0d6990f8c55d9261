//! Numbers from a seeded generator, the same on every machine.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::Rng;

/// Uniform in the open unit interval.
pub fn uniform(rng: &mut ChaCha8Rng) -> f64 {
    ((rng.next_u64() >> 12) as f64 + 0.5) / (1_u64 << 52) as f64
}

/// Uniform in 0..n; n at least 1.
pub fn index(n: usize, rng: &mut ChaCha8Rng) -> usize {
    ((uniform(rng) * n as f64) as usize).min(n - 1)
}

/// Exponential of mean 1.
pub fn exponential(rng: &mut ChaCha8Rng) -> f64 {
    -libm::log(uniform(rng))
}

/// Standard normal (Box and Muller 1958).
pub fn normal(rng: &mut ChaCha8Rng) -> f64 {
    let radius = libm::sqrt(2.0 * exponential(rng));
    radius * libm::cos(std::f64::consts::TAU * uniform(rng))
}

/// `k` weights uniform on the L1 sphere ‖w‖₁ = 1.
pub fn l1_sphere(k: usize, rng: &mut ChaCha8Rng) -> Vec<f64> {
    let mut w: Vec<f64> = (0..k)
        .map(|_| {
            let size = exponential(rng);
            if rng.next_u64() & 1 == 0 { size } else { -size }
        })
        .collect();
    let norm: f64 = w.iter().map(|w| w.abs()).sum();
    w.iter_mut().for_each(|w| *w /= norm);
    w
}

/// Index drawn from `weights`, which sum to `total` > 0; rounding left over falls to the last positive one.
pub fn categorical(weights: impl Iterator<Item = f64>, total: f64, rng: &mut ChaCha8Rng) -> usize {
    let mut left = uniform(rng) * total;
    let mut last = 0;
    for (index, weight) in weights.enumerate() {
        if weight > 0.0 {
            last = index;
            if left < weight {
                break;
            }
            left -= weight;
        }
    }
    last
}
