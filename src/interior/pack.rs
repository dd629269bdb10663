//! Stretches of one row of columns, worked on side by side: each step of the integration is one
//! plain loop over all of them.
//!
//! The loops have no branches and no sums across stretches but in fixed lanes, so that the compiler
//! makes vector instructions of them, and the bits are the same whatever those are.

use super::section::Section;

/// Stretches a pack holds: a row of a hundred columns fills two. Far fewer, and the loops'
/// beginnings and ends show; far more, and the pack no longer lies in the nearest cache.
const SIZE: usize = 64;
/// Terms added up side by side: two vectors of two.
const LANES: usize = 4;

/// A surface counts as upright in a cell when q changes along the column by less than this part of
/// what it changes across the cell. Much above 1, exact derivatives are replaced by means; much
/// below, upright planes are not seen.
const UPRIGHT_RATIO: f64 = 0.5;

/// 1/√3, the place of the two Gauss points as a part of half an interval.
const GAUSS_POINT: f64 = 0.577_350_269_189_625_8;

/// A product is several times as fast as a quotient.
const THIRD: f64 = 1.0 / 3.0;

/// One number a stretch.
type Numbers = [f64; SIZE];

/// Sums over the stretches of one row, per unit of a cell's area.
#[derive(Default)]
pub(super) struct RowSums {
    /// ∫1, x∫1, x²∫1, ∫z, x∫z, ∫z² over what is emptied.
    pub emptied: [f64; 6],
    /// xⁱ Σ zᵏ/|∂q/∂z| over the roots, at `[k][i]` for i + k ≤ 4.
    pub roots: [[f64; 5]; 5],
}

/// Stretches that may be emptied, of columns of one row, and what is known of each.
pub(super) struct Pack {
    count: usize,
    x: Numbers,
    bottom: Numbers,
    top: Numbers,
    /// The z where q changes sign, kept to the stretch: q > 0 between the two, or everywhere but
    /// between them.
    lower: Numbers,
    upper: Numbers,
    /// 1/|∂q/∂z| at either; zero where there is none inside.
    lower_weight: Numbers,
    upper_weight: Numbers,
    /// ∫1, ∫z and ∫z² over what is emptied.
    emptied: [Numbers; 3],
}

impl Pack {
    pub fn new() -> Self {
        let none = [0.0; SIZE];
        Self {
            count: 0,
            x: none,
            bottom: none,
            top: none,
            lower: none,
            upper: none,
            lower_weight: none,
            upper_weight: none,
            emptied: [none; 3],
        }
    }

    /// One more stretch; the pack must not be full.
    #[inline]
    pub fn push(&mut self, x: f64, [bottom, top]: [f64; 2]) {
        (
            self.x[self.count],
            self.bottom[self.count],
            self.top[self.count],
        ) = (x, bottom, top);
        self.count += 1;
    }

    #[inline]
    pub fn is_full(&self) -> bool {
        self.count == SIZE
    }

    /// Adds the stretches' part of the sums, and leaves the pack empty.
    pub fn empty_into<const DERIVATIVE: bool>(&mut self, section: &Section, sums: &mut RowSums) {
        let filled = self.fill_lanes();
        self.cross::<DERIVATIVE>(filled, section);
        self.add_emptied(filled, sums);
        if DERIVATIVE {
            self.put_walls(filled, section);
            self.add_roots(filled, sums);
        }
        self.count = 0;
    }

    /// Fills the last lanes with stretches of no length, which add nothing; how many there are
    /// then.
    fn fill_lanes(&mut self) -> usize {
        let filled = self.count.next_multiple_of(LANES).min(SIZE);
        for index in self.count..filled {
            (self.x[index], self.bottom[index], self.top[index]) = (0.0, 0.0, 0.0);
        }
        filled
    }

    /// Finds the roots of q and the integrals over what it empties.
    ///
    /// By the stable quadratic formula: no cancellation, and a vanishing leading term sends one
    /// root to infinity.
    fn cross<const DERIVATIVE: bool>(&mut self, filled: usize, section: &Section) {
        let Section { c0, c1, c2, .. } = *section;
        let (inverse, empties_outside, is_curved) = (c2.recip(), c2 >= 0.0, c2 != 0.0);
        let [one, z, zz] = &mut self.emptied;
        for i in 0..filled.min(SIZE) {
            let (x, bottom, top) = (self.x[i], self.bottom[i], self.top[i]);
            let value = c0[0] + x * (c0[1] + x * c0[2]);
            let slope = c1[0] + x * c1[1];
            let discriminant = slope * slope - 4.0 * c2 * value;
            let is_real = discriminant > 0.0;
            let steepness = either(is_real, discriminant, 0.0).sqrt();
            let half = -0.5 * (slope + steepness.copysign(slope));
            let (first, second) = (half * inverse, value / half);
            let is_ordered = first < second;
            let lower = either(is_real, either(is_ordered, first, second), bottom);
            let upper = either(is_real, either(is_ordered, second, first), bottom);
            let (lo, hi) = (clamped(lower, bottom, top), clamped(upper, bottom, top));
            let (inside, whole) = (powers_between(lo, hi), powers_between(bottom, top));
            // Without roots and without curvature q is the same everywhere.
            let is_outside =
                (empties_outside & (is_real | is_curved)) | (!is_real & !is_curved & (value > 0.0));
            one[i] = either(is_outside, whole[0] - inside[0], inside[0]);
            z[i] = either(is_outside, whole[1] - inside[1], inside[1]);
            zz[i] = either(is_outside, whole[2] - inside[2], inside[2]);
            if DERIVATIVE {
                let weight = steepness.recip();
                (self.lower[i], self.upper[i]) = (lo, hi);
                self.lower_weight[i] = either((bottom < lower) & (lower < top), weight, 0.0);
                self.upper_weight[i] = either((bottom < upper) & (upper < top), weight, 0.0);
            }
        }
    }

    /// Where q hardly changes along an interval but does across its cell, the surface stands
    /// upright in the cell and the column's own roots say nothing of it: there they are replaced by
    /// its density, as two Gauss points of the interval.
    fn put_walls(&mut self, filled: usize, section: &Section) {
        let Section {
            c0,
            c1,
            c2,
            across: [ax, ay],
        } = *section;
        for i in 0..filled.min(SIZE) {
            let (x, bottom, top) = (self.x[i], self.bottom[i], self.top[i]);
            let (middle, half) = (0.5 * (bottom + top), 0.5 * (top - bottom));
            let spread = (ax[0] + ax[1] * x + ax[2] * middle).abs()
                + (ay[0] + ay[1] * x + ay[2] * middle).abs();
            let slope = c1[0] + x * c1[1] + 2.0 * c2 * middle;
            let is_upright = half * slope.abs() + half * half * c2.abs() < UPRIGHT_RATIO * spread;
            let value = c0[0] + x * (c0[1] + x * c0[2]) + middle * (slope - middle * c2);
            let weight = either(value.abs() < spread, half / (2.0 * spread), 0.0);
            self.lower[i] = either(is_upright, middle - GAUSS_POINT * half, self.lower[i]);
            self.upper[i] = either(is_upright, middle + GAUSS_POINT * half, self.upper[i]);
            self.lower_weight[i] = either(is_upright, weight, self.lower_weight[i]);
            self.upper_weight[i] = either(is_upright, weight, self.upper_weight[i]);
        }
    }

    fn add_emptied(&self, filled: usize, sums: &mut RowSums) {
        let x = &self.x[..filled];
        let [one, z, zz] = &self.emptied;
        let [s, sx, sxx] = times_powers(&one[..filled], x);
        let [sz, sxz] = times_powers(&z[..filled], x);
        let [szz] = times_powers(&zz[..filled], x);
        add(&mut sums.emptied, &[s, sx, sxx, sz, sxz, szz]);
    }

    fn add_roots(&mut self, filled: usize, sums: &mut RowSums) {
        let [zero, one, two, three, four] = &mut sums.roots;
        add(zero, &self.next_power::<5>(filled));
        add(one, &self.next_power::<4>(filled));
        add(two, &self.next_power::<3>(filled));
        add(three, &self.next_power::<2>(filled));
        add(four, &self.next_power::<1>(filled));
    }

    /// Σ w xⁱ over all roots for i below T, and then multiplies the weights w by z: called again
    /// and again it gives Σ w xⁱ zᵏ.
    fn next_power<const T: usize>(&mut self, filled: usize) -> [f64; T] {
        let both = &mut self.emptied[0];
        for (i, both) in both.iter_mut().enumerate().take(filled) {
            *both = self.lower_weight[i] + self.upper_weight[i];
            self.lower_weight[i] *= self.lower[i];
            self.upper_weight[i] *= self.upper[i];
        }
        times_powers(&both[..filled], &self.x[..filled])
    }
}

/// A choice without a branch.
#[inline]
fn either(condition: bool, yes: f64, no: f64) -> f64 {
    if condition { yes } else { no }
}

/// Σ p xⁱ for i below T, in lanes.
#[inline]
fn times_powers<const T: usize>(p: &[f64], x: &[f64]) -> [f64; T] {
    let mut sums = [[0.0; LANES]; T];
    for (p, x) in p
        .as_chunks::<LANES>()
        .0
        .iter()
        .zip(x.as_chunks::<LANES>().0)
    {
        let mut term = *p;
        for sum in &mut sums {
            for lane in 0..LANES {
                sum[lane] += term[lane];
                term[lane] *= x[lane];
            }
        }
    }
    sums.map(|lanes| (lanes[0] + lanes[2]) + (lanes[1] + lanes[3]))
}

fn add(sums: &mut [f64], terms: &[f64]) {
    sums.iter_mut()
        .zip(terms)
        .for_each(|(sum, term)| *sum += term);
}

#[inline]
fn clamped(z: f64, low: f64, high: f64) -> f64 {
    let above = either(z > low, z, low);
    either(above < high, above, high)
}

/// ∫1, ∫z and ∫z² from `low` to `high`.
#[inline]
fn powers_between(low: f64, high: f64) -> [f64; 3] {
    let length = high - low;
    let sum = low + high;
    [
        length,
        0.5 * length * sum,
        length * (sum * sum - low * high) * THIRD,
    ]
}
