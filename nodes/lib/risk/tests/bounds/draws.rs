//! Seeded draws of which everything is known.

use diagnostics::normal_quantile;

/// Numbers from SplitMix64.
pub struct Normal(pub u64);

impl Normal {
    /// Uniform on (0, 1).
    pub fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^= z >> 31;
        ((z >> 12) as f64 + 0.5) / (1_u64 << 52) as f64
    }

    /// Standard normal.
    pub fn next(&mut self) -> f64 {
        normal_quantile(self.uniform())
    }
}

/// Stationary autoregressive chains with standard normal marginals.
pub fn chains(seed: u64, n_chains: usize, per_chain: usize, rho: f64) -> Vec<f64> {
    let mut normal = Normal(seed << 20);
    let mut draws = Vec::with_capacity(n_chains * per_chain);
    for _ in 0..n_chains {
        let mut x = normal.next();
        for _ in 0..per_chain {
            draws.push(x);
            x = rho * x + (1.0 - rho * rho).sqrt() * normal.next();
        }
    }
    draws
}
