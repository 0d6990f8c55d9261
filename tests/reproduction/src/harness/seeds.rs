//! One generator per replicate and purpose, so that what one purpose draws never shifts another.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// The generator of a replicate for a purpose: a world, its demonstrations, a walk … Streams of one key never overlap.
pub fn generator(seed: u64, replicate: usize, purpose: u32) -> ChaCha8Rng {
    let mut key = [0; 32];
    key[..8].copy_from_slice(&seed.to_le_bytes());
    key[8..16].copy_from_slice(&(replicate as u64).to_le_bytes());
    let mut generator = ChaCha8Rng::from_seed(key);
    generator.set_stream(u64::from(purpose));
    generator
}
