//! Uniform and normal numbers from a generator, with the same bits on every machine.

use diagnostics::normal_quantile;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use sha2::{Digest, Sha256};

/// Uniform in the open unit interval.
pub(crate) fn uniform(generator: &mut ChaCha8Rng) -> f64 {
    ((generator.next_u64() >> 12) as f64 + 0.5) / (1_u64 << 52) as f64
}

/// Standard normal.
pub(crate) fn standard_normal(generator: &mut ChaCha8Rng) -> f64 {
    normal_quantile(uniform(generator))
}

/// The generator of one chain, a function of seed, evidence and chain.
pub(crate) fn chain_generator(seed: u64, evidence: &[u8; 32], chain: usize) -> ChaCha8Rng {
    let mut key = Sha256::new_with_prefix(b"apprentice chain 1");
    key.update(seed.to_le_bytes());
    key.update(evidence);
    key.update((chain as u64).to_le_bytes());
    ChaCha8Rng::from_seed(key.finalize().into())
}
