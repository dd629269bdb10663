//! Random numbers from a seed: the same on every machine and for any number of threads.

/// A linear congruential generator (Knuth, "The Art of Computer Programming" 2, 3.3.4, table 1,
/// line 26). Good enough to stir a search, and for nothing else.
#[derive(Debug, Clone)]
pub(crate) struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        let mut random = Self(seed ^ 0x9e37_79b9_7f4a_7c15);
        random.next();
        random
    }

    fn next(&mut self) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 33
    }

    /// Returns a number from 0 to `count` − 1.
    pub fn below(&mut self, count: usize) -> usize {
        self.next() as usize % count
    }

    /// Returns a number from `low` to `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        const STEPS: f64 = (1_u64 << 31) as f64;
        low + (high - low) * (self.next() as f64 / STEPS)
    }
}
