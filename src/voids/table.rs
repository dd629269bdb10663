//! A hash table from packed names to indices. It is only looked up, never iterated, so its order
//! cannot matter.

use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

/// A map from packed names to indices.
pub(super) type IndexMap = HashMap<u64, u32, BuildHasherDefault<MixHasher>>;

/// A fast mixer of one 64-bit word (the finalizer of SplitMix64: Steele, Lea & Flood, OOPSLA 2014).
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct MixHasher(u64);

impl Hasher for MixHasher {
    #[inline]
    fn finish(&self) -> u64 {
        self.0
    }

    fn write(&mut self, bytes: &[u8]) {
        bytes
            .iter()
            .for_each(|&byte| self.write_u64(u64::from(byte)));
    }

    #[inline]
    fn write_u64(&mut self, word: u64) {
        let mut z = (self.0 ^ word).wrapping_add(0x9e37_79b9_7f4a_7c15);
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        self.0 = z ^ (z >> 27);
    }
}
