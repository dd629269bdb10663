//! Integrates over the columns between two level sets of a quadric.

use std::ops::Range;

use rayon::prelude::*;

use super::columns::Columns;
use super::integrate::{Matrix10, RootSums, Sums};
use super::section::Section;
use crate::geom::Quadric;
use crate::mass::Moments;

/// Columns summed as one unit of work; the bits do not depend on the number of threads.
const BLOCK_COLUMNS: usize = 640;
/// Nodes and weights of the three-point Gauss rule on [−1, 1]: exact to degree 5, where 4 is asked.
const GAUSS: [[f64; 2]; 3] = [
    [-0.774_596_669_241_483_4, 5.0 / 9.0],
    [0.0, 8.0 / 9.0],
    [0.774_596_669_241_483_4, 5.0 / 9.0],
];

/// Integrals over the columns below, between and above two level sets of a quadric q.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Between {
    /// Moments of { q < low }.
    pub below: Moments,
    /// Moments of { low ≤ q ≤ high }.
    pub inside: Moments,
    /// Moments of { q > high }.
    pub above: Moments,
    /// ∫ m mᵀ over { low ≤ q ≤ high }, symmetric and positive semidefinite.
    pub gram: Matrix10,
}

/// Returns the integrals between the level sets q = `levels[0]` and q = `levels[1]`, which must not
/// descend.
///
/// Exact in z. In x and y a column stands for its cell, as in
/// [`moments_where_positive`](super::moments_where_positive). There x² and y² enter by their cell
/// means, in the moments, in ∫ m mᵀ and in q alike. So ∫ q m over the inside is `gram` times q's
/// coefficients. Bitwise the same for any number of threads.
pub fn integrals_between(columns: &Columns, quadric: &Quadric, levels: [f64; 2]) -> Between {
    let blocks = columns.len().div_ceil(BLOCK_COLUMNS);
    let sum = |block: usize| {
        let first = block * BLOCK_COLUMNS;
        sum_block(
            columns,
            quadric,
            levels,
            first..columns.len().min(first + BLOCK_COLUMNS),
        )
    };
    let parts: Vec<[RootSums; 3]> = (0..blocks).into_par_iter().map(sum).collect();
    let mut total = [RootSums::default(); 3];
    for part in &parts {
        total
            .iter_mut()
            .zip(part)
            .for_each(|(total, part)| add(total, part));
    }
    let [below, inside, above] = total.map(Sums::of_powers);
    let pitch_mm = columns.pitch_mm;
    Between {
        below: below.moments(pitch_mm),
        inside: inside.moments(pitch_mm),
        above: above.moments(pitch_mm),
        gram: inside.derivative(pitch_mm),
    }
}

/// Adds sums of powers.
fn add(total: &mut RootSums, part: &RootSums) {
    let own = total.as_flattened_mut().as_flattened_mut();
    let terms = part.as_flattened().as_flattened();
    own.iter_mut()
        .zip(terms)
        .for_each(|(sum, term)| *sum += term);
}

/// Returns the sums of xⁱ yʲ ∫ zᵏ of a block, below, between and above.
fn sum_block(
    columns: &Columns,
    quadric: &Quadric,
    levels: [f64; 2],
    block: Range<usize>,
) -> [RootSums; 3] {
    let mut sums = [RootSums::default(); 3];
    for index in block {
        let [x, y] = columns.centers[index];
        let along = Section::new(quadric, columns.pitch_mm, y).at(x);
        let mut powers = [[0.0; 5]; 3];
        for &stretch in columns.intervals_of(index) {
            add_stretch(&along, levels, stretch, &mut powers);
        }
        for (sums, powers) in sums.iter_mut().zip(&powers) {
            add_column(sums, powers, [x, y]);
        }
    }
    sums
}

/// Adds xⁱ yʲ ∫ zᵏ for i + j + k ≤ 4.
fn add_column(sums: &mut RootSums, powers: &[f64; 5], [x, y]: [f64; 2]) {
    if powers[0] == 0.0 {
        return;
    }
    let mut at_x = 1.0;
    for (i, sums) in sums.iter_mut().enumerate() {
        let mut at_xy = at_x;
        for (j, sums) in sums.iter_mut().enumerate().take(5 - i) {
            for (sum, power) in sums.iter_mut().zip(powers).take(5 - i - j) {
                *sum += at_xy * power;
            }
            at_xy *= y;
        }
        at_x *= x;
    }
}

/// Adds ∫ zᵏ over the parts of a stretch where q is below, between and above the levels.
fn add_stretch(
    along: &[f64; 3],
    levels: [f64; 2],
    [bottom, top]: [f64; 2],
    powers: &mut [[f64; 5]; 3],
) {
    let mut places = [bottom, bottom, bottom, bottom, bottom, top];
    for (pair, level) in places[1..5].chunks_exact_mut(2).zip(levels) {
        let roots = crossings([along[0] - level, along[1], along[2]]);
        pair.copy_from_slice(&roots.map(|root| root.clamp(bottom, top)));
    }
    places.sort_by(f64::total_cmp);
    for ends in places.windows(2) {
        let (middle, half) = (0.5 * (ends[0] + ends[1]), 0.5 * (ends[1] - ends[0]));
        if half <= 0.0 {
            continue;
        }
        let value = along[0] + middle * (along[1] + middle * along[2]);
        let zone = usize::from(value >= levels[0]) + usize::from(value > levels[1]);
        for [node, weight] in GAUSS {
            let z = middle + half * node;
            let mut term = half * weight;
            for power in &mut powers[zone] {
                *power += term;
                term *= z;
            }
        }
    }
}

/// Returns the roots of a quadratic; far outside every stretch if there are none.
fn crossings([c0, c1, c2]: [f64; 3]) -> [f64; 2] {
    let discriminant = c1 * c1 - 4.0 * c2 * c0;
    if discriminant <= 0.0 {
        return [f64::MIN; 2];
    }
    let half = -0.5 * (c1 + discriminant.sqrt().copysign(c1));
    let root = |over: f64, under: f64| if under == 0.0 { f64::MIN } else { over / under };
    [root(half, c2), root(c0, half)]
}

#[cfg(test)]
mod tests {
    use super::super::moments_where_positive;
    use super::*;

    const QUADRIC: Quadric = Quadric([3.0, 0.2, -0.4, 0.5, 0.1, -0.2, 0.15, -0.12, 0.03, -0.3]);

    fn block() -> Columns {
        let mut columns = Columns {
            pitch_mm: [0.3; 2],
            starts: vec![0],
            ..Columns::default()
        };
        for j in 0..14 {
            for i in 0..20 {
                let place = |at: i32| (f64::from(at) + 0.5) * 0.3;
                columns.centers.push([place(i) - 3.0, place(j) + 1.0]);
                columns.intervals.extend([[-2.0, 0.5], [1.0, 3.0]]);
                columns.starts.push(columns.intervals.len() as u32);
            }
        }
        columns
    }

    fn assert_close(got: f64, want: f64, tolerance: f64) {
        assert!(
            (got - want).abs() <= tolerance * want.abs().max(1.0),
            "{got} {want}"
        );
    }

    fn shifted(level: f64) -> Quadric {
        let mut quadric = QUADRIC;
        quadric.0[0] -= level;
        quadric
    }

    #[test]
    fn the_zones_are_those_of_the_two_level_sets() {
        let (columns, levels) = (block(), [0.5, 2.0]);
        let got = integrals_between(&columns, &QUADRIC, levels);
        let above = moments_where_positive(&columns, &shifted(levels[1]));
        let from_low = moments_where_positive(&columns, &shifted(levels[0]));
        let all = columns.moments();
        for i in 0..10 {
            assert_close(got.above.0[i], above.0[i], 1e-11);
            assert_close(got.inside.0[i], (from_low - above).0[i], 1e-11);
            assert_close(got.below.0[i], (all - from_low).0[i], 1e-11);
        }
    }

    #[test]
    fn the_gram_matrix_agrees_with_the_moments_and_with_a_sum_over_slices() {
        let (columns, levels) = (block(), [0.5, 2.0]);
        let got = integrals_between(&columns, &QUADRIC, levels);
        for i in 0..10 {
            assert_close(got.gram[(0, i)], got.inside.0[i], 1e-12);
        }
        assert_eq!(got.gram, got.gram.transpose());
        // ∫ q z over slices of 0.5 µm, whose ends are wrong by half of one: at most 0.01 in all.
        let (mut sum, slices) = (0.0, 5000);
        for index in 0..columns.len() {
            let [x, y] = columns.centers[index];
            let along = Section::new(&QUADRIC, columns.pitch_mm, y).at(x);
            for &[bottom, top] in columns.intervals_of(index) {
                for slice in 0..slices {
                    let length = (top - bottom) / f64::from(slices);
                    let z = bottom + (f64::from(slice) + 0.5) * length;
                    let value = along[0] + z * (along[1] + z * along[2]);
                    if (levels[0]..=levels[1]).contains(&value) {
                        sum += value * z * length * 0.09;
                    }
                }
            }
        }
        let exact = (got.gram * nalgebra::SVector::<f64, 10>::from(QUADRIC.0))[3];
        assert!((exact - sum).abs() < 2e-3, "{exact} {sum}");
    }

    #[test]
    fn a_constant_lies_between_its_own_levels() {
        let columns = block();
        let zero = Quadric([0.0; 10]);
        let got = integrals_between(&columns, &zero, [0.0, 0.0]);
        assert_close(got.inside.volume(), columns.moments().volume(), 1e-13);
        assert_eq!(
            integrals_between(&columns, &zero, [0.5, 1.0]).inside,
            Moments::default()
        );
    }
}
