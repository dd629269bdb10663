//! Numbers that look random, the same in every run (Steele, Lea and Flood, 2014).

use equipoise::geom::Vector;

/// A source of numbers.
pub struct Dice(u64);

impl Dice {
    /// Makes the source of a throw.
    pub fn of(throw: usize) -> Self {
        let mut dice = Self(throw as u64);
        Self(dice.roll())
    }

    fn roll(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// Returns an index below `count`.
    pub fn pick(&mut self, count: usize) -> usize {
        (self.roll() % count as u64) as usize
    }

    /// Returns a number from 0 to 1.
    pub fn share(&mut self) -> f64 {
        (self.roll() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Returns 1 or −1.
    pub fn sign(&mut self) -> f64 {
        if self.share() < 0.5 { -1.0 } else { 1.0 }
    }

    /// Returns a unit vector.
    pub fn direction(&mut self) -> Vector {
        let [x, y, z] = [(); 3].map(|()| self.share() - 0.5);
        Vector::new(x, y, z).normalize()
    }
}
