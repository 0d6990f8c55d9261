//! The generator of the reference values.

/// Uniform numbers from a linear congruential generator: the same formula made the reference values.
pub struct Uniform(u64);

impl Uniform {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15).wrapping_add(0x0123_4567))
    }

    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Sum of four, less their mean: nearly normal, within ±2.
    pub fn bell(&mut self) -> f64 {
        self.next() + self.next() + self.next() + self.next() - 2.0
    }
}
