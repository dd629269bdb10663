//! Packs of stretches of one row of columns, integrated side by side: each step of the integration
//! is one plain loop over the pack.
//!
//! The loops have no branches, and sum across stretches only in fixed lanes. So the compiler can
//! vectorise them, and the bits do not depend on the vector width.

use super::section::Section;

/// Stretches in a pack; a row of a hundred columns fills two. With far fewer, the loops' overhead
/// shows; with far more, the pack no longer fits the nearest cache.
const SIZE: usize = 64;
/// Terms added side by side: two vectors of two.
const LANES: usize = 4;

/// Change of q along the column, as a share of its change across the cell, below which the surface
/// counts as upright in the cell. With a ratio much above 1, exact derivatives are replaced by
/// means; much below, upright planes are missed.
const UPRIGHT_RATIO: f64 = 0.5;

/// Place of the two Gauss points as a share of half an interval: 1/√3.
const GAUSS_POINT: f64 = 0.577_350_269_189_625_8;

/// A third; a product is several times as fast as a quotient.
const THIRD: f64 = 1.0 / 3.0;

/// One number for each stretch.
type Numbers = [f64; SIZE];

/// Sums over the stretches of one row, per unit of a cell's area.
#[derive(Default)]
pub(super) struct RowSums {
    /// ∫1, x∫1, x²∫1, ∫z, x∫z, ∫z² over the void.
    pub emptied: [f64; 6],
    /// xⁱ Σ zᵏ/|∂q/∂z| over the roots, at `[k][i]` for i + k ≤ 4.
    pub roots: [[f64; 5]; 5],
}

/// Stretches of columns of one row, and the results for each.
pub(super) struct Pack {
    count: usize,
    /// True if the roots of upright surfaces are those of the columns, and not replaced.
    keeps_roots: bool,
    x: Numbers,
    bottom: Numbers,
    top: Numbers,
    /// Heights at which q changes sign, clamp to the stretch: q > 0 between the two, or
    /// everywhere except between them.
    lower: Numbers,
    upper: Numbers,
    /// 1/|∂q/∂z| at either; zero if it is not inside the stretch.
    lower_weight: Numbers,
    upper_weight: Numbers,
    /// ∫1, ∫z and ∫z² over the void.
    emptied: [Numbers; 3],
}

impl Pack {
    /// Returns an empty pack. If it keeps roots, the derivative is that of the columns' own sums,
    /// even where a surface is upright.
    pub fn new(keeps_roots: bool) -> Self {
        let none = [0.0; SIZE];
        Self {
            count: 0,
            keeps_roots,
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

    /// Adds a stretch; the pack must not be full.
    #[inline]
    pub fn push(&mut self, x: f64, [bottom, top]: [f64; 2]) {
        (
            self.x[self.count],
            self.bottom[self.count],
            self.top[self.count],
        ) = (x, bottom, top);
        self.count += 1;
    }

    /// Returns whether the pack must be emptied before the next stretch.
    #[inline]
    pub fn is_full(&self) -> bool {
        self.count == SIZE
    }

    /// Adds the stretches' contribution to the sums, and empties the pack.
    pub fn empty_into<const DERIVATIVE: bool>(&mut self, section: &Section, sums: &mut RowSums) {
        let filled = self.fill_lanes();
        self.cross::<DERIVATIVE>(filled, section);
        self.add_emptied(filled, sums);
        if DERIVATIVE {
            if !self.keeps_roots {
                self.replace_upright_roots(filled, section);
            }
            self.add_roots(filled, sums);
        }
        self.count = 0;
    }

    /// Fills the last lanes with stretches of no length, which add nothing. Returns the number of
    /// stretches after that.
    fn fill_lanes(&mut self) -> usize {
        let filled = self.count.next_multiple_of(LANES).min(SIZE);
        for index in self.count..filled {
            (self.x[index], self.bottom[index], self.top[index]) = (0.0, 0.0, 0.0);
        }
        filled
    }

    /// Finds the roots of q and the integrals over the void.
    ///
    /// The quadratic formula is the stable one: nothing cancels, and a vanishing leading term sends
    /// one root to infinity.
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
            let (lo, hi) = (clamp(lower, bottom, top), clamp(upper, bottom, top));
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

    /// Replaces the roots of upright surfaces.
    ///
    /// If q hardly changes along an interval but does across its cell, the surface is upright in
    /// the cell. The column's own roots then say nothing about it. They are replaced by the
    /// surface's density, as two Gauss points of the interval.
    fn replace_upright_roots(&mut self, filled: usize, section: &Section) {
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

    /// Adds the integrals over the void.
    fn add_emptied(&self, filled: usize, sums: &mut RowSums) {
        let x = &self.x[..filled];
        let [one, z, zz] = &self.emptied;
        let [s, sx, sxx] = times_powers(&one[..filled], x);
        let [sz, sxz] = times_powers(&z[..filled], x);
        let [szz] = times_powers(&zz[..filled], x);
        add(&mut sums.emptied, &[s, sx, sxx, sz, sxz, szz]);
    }

    /// Adds the sums over the roots.
    fn add_roots(&mut self, filled: usize, sums: &mut RowSums) {
        let [zero, one, two, three, four] = &mut sums.roots;
        add(zero, &self.next_power::<5>(filled));
        add(one, &self.next_power::<4>(filled));
        add(two, &self.next_power::<3>(filled));
        add(three, &self.next_power::<2>(filled));
        add(four, &self.next_power::<1>(filled));
    }

    /// Returns Σ w xⁱ over all roots for i below T, and then multiplies the weights w by z.
    /// Repeated calls give Σ w xⁱ zᵏ.
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

/// Returns `yes` or `no` without a branch.
#[inline]
fn either(condition: bool, yes: f64, no: f64) -> f64 {
    if condition { yes } else { no }
}

/// Returns Σ p xⁱ for i below T, summed in lanes.
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

/// Returns `z` kept to the interval, without a branch.
#[inline]
fn clamp(z: f64, low: f64, high: f64) -> f64 {
    let above = either(z > low, z, low);
    either(above < high, above, high)
}

/// Returns ∫1, ∫z and ∫z² from `low` to `high`.
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
