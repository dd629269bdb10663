//! Tetrahedra split by planes. Every piece keeps the sign of the whole.

use super::tetrahedron::Tetrahedron;
use crate::geom::{CORNER_FIRST, PAIR_FIRST, Vector};

/// The pieces of a tetrahedron on either side of a plane: none, one or three on each side.
///
/// A wedge is cut into three along one fixed choice of diagonals. Its sides lie in the faces of the
/// tetrahedron, so the pieces fill it exactly, whichever diagonals are chosen.
#[derive(Debug, Clone, PartialEq)]
pub struct Split {
    below: Side,
    above: Side,
}

/// Up to three tetrahedra.
#[derive(Debug, Clone, PartialEq)]
struct Side {
    pieces: [Tetrahedron; 3],
    count: usize,
}

impl Split {
    /// Splits a tetrahedron at height zero, by the heights of its corners over a plane. Corners in
    /// the plane count as below.
    pub fn new(tetrahedron: &Tetrahedron, heights: [f64; 4]) -> Self {
        let is_above = heights.map(|height| height > 0.0);
        let count = is_above.iter().filter(|above| **above).count();
        let whole = Side::of(&[*tetrahedron]);
        let none = Side { count: 0, ..whole };
        match count {
            1 => {
                let order = CORNER_FIRST.into_iter().find(|order| is_above[order[0]]);
                let [tip, wedge] = split_lone(&Ordered::new(tetrahedron, heights, order));
                Self {
                    below: wedge,
                    above: tip,
                }
            }
            2 => {
                let is_pair = |order: &[usize; 4]| !is_above[order[0]] && !is_above[order[1]];
                let order = PAIR_FIRST.into_iter().find(is_pair);
                split_pair(&Ordered::new(tetrahedron, heights, order))
            }
            3 => {
                let order = CORNER_FIRST.into_iter().find(|order| !is_above[order[0]]);
                let [tip, wedge] = split_lone(&Ordered::new(tetrahedron, heights, order));
                Self {
                    below: tip,
                    above: wedge,
                }
            }
            0 => Self {
                below: whole,
                above: none,
            },
            _ => Self {
                below: none,
                above: whole,
            },
        }
    }

    /// Returns the pieces below the plane.
    pub fn below(&self) -> &[Tetrahedron] {
        &self.below.pieces[..self.below.count]
    }

    /// Returns the pieces above the plane.
    pub fn above(&self) -> &[Tetrahedron] {
        &self.above.pieces[..self.above.count]
    }

    /// Returns all pieces.
    pub fn pieces(&self) -> impl Iterator<Item = &Tetrahedron> {
        self.below().iter().chain(self.above())
    }
}

impl Side {
    fn of(found: &[Tetrahedron]) -> Self {
        let nothing = Tetrahedron([Vector::zeros(); 4]);
        let piece = |i: usize| found.get(i).copied().unwrap_or(nothing);
        Self {
            pieces: [0, 1, 2].map(piece),
            count: found.len(),
        }
    }

    /// Returns the three tetrahedra of a wedge between two triangles.
    fn of_wedge([p, q]: [[Vector; 3]; 2]) -> Self {
        Self::of(&[
            Tetrahedron([p[0], q[0], q[1], q[2]]),
            Tetrahedron([p[1], p[0], q[1], q[2]]),
            Tetrahedron([p[0], p[1], p[2], q[2]]),
        ])
    }
}

/// Corners in an even permutation, with their heights.
struct Ordered {
    corners: [Vector; 4],
    heights: [f64; 4],
}

impl Ordered {
    fn new(whole: &Tetrahedron, heights: [f64; 4], order: Option<[usize; 4]>) -> Self {
        let order = order.unwrap_or(CORNER_FIRST[0]);
        Self {
            corners: order.map(|corner| whole.0[corner]),
            heights: order.map(|corner| heights[corner]),
        }
    }

    /// Returns the point at height zero between two corners.
    fn cut(&self, from: usize, to: usize) -> Vector {
        let share = self.heights[from] / (self.heights[from] - self.heights[to]);
        self.corners[from] + (self.corners[to] - self.corners[from]) * share
    }
}

/// Returns the tip at the first corner and the wedge at the other three.
fn split_lone(ordered: &Ordered) -> [Side; 2] {
    let [tip, others @ ..] = ordered.corners;
    let cuts = [1, 2, 3].map(|corner| ordered.cut(0, corner));
    let tip = Tetrahedron([tip, cuts[0], cuts[1], cuts[2]]);
    [Side::of(&[tip]), Side::of_wedge([cuts, others])]
}

/// Returns the wedges at the first two corners, which are below, and at the last two.
fn split_pair(ordered: &Ordered) -> Split {
    let [a, b, c, d] = ordered.corners;
    let [ac, ad] = [2, 3].map(|corner| ordered.cut(0, corner));
    let [bc, bd] = [2, 3].map(|corner| ordered.cut(1, corner));
    Split {
        below: Side::of_wedge([[a, ac, ad], [b, bc, bd]]),
        above: Side::of_wedge([[c, ac, bc], [d, ad, bd]]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::random::Random;

    #[test]
    fn the_pieces_conserve_all_moments_and_keep_the_sign() {
        let mut random = Random::new(5);
        for round in 0..10_000 {
            let whole = Tetrahedron(
                [0; 4].map(|_| Vector::from_fn(|_, _| 10.0 * random.between(0.0, 1.0) - 5.0)),
            );
            let normal = Vector::from_fn(|_, _| random.between(0.0, 1.0) - 0.5).normalize();
            let offset = 6.0 * random.between(0.0, 1.0) - 3.0;
            let heights = whole.0.map(|corner| normal.dot(&corner) - offset);
            let split = Split::new(&whole, heights);
            let sum = split
                .pieces()
                .fold(crate::mass::Moments::default(), |sum, piece| {
                    sum + piece.linear([1.0; 4])
                });
            let volume = whole.volume_mm3();
            for (got, want) in sum.0.iter().zip(whole.linear([1.0; 4]).0) {
                assert!(
                    (got - want).abs() <= 1e-12 * volume.abs() * 25.0,
                    "{round}: {got} {want}"
                );
            }
            let tiny = 1e-13 * volume.abs();
            assert!(
                split
                    .pieces()
                    .all(|piece| piece.volume_mm3() * volume.signum() > -tiny)
            );
            let height = |corner: &Vector| normal.dot(corner) - offset;
            assert!(
                split
                    .below()
                    .iter()
                    .flat_map(|t| t.0)
                    .all(|c| height(&c) < 1e-12)
            );
            assert!(
                split
                    .above()
                    .iter()
                    .flat_map(|t| t.0)
                    .all(|c| height(&c) > -1e-12)
            );
        }
    }

    #[test]
    fn corners_in_the_plane_make_no_pieces_that_are_not_numbers() {
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let whole = Tetrahedron(corners.map(Vector::from));
        for heights in [
            [0.0; 4],
            [0.0, 0.0, 0.0, 1.0],
            [0.0, 1.0, -1.0, 0.0],
            [0.0, 1., 1., 1.],
        ] {
            let split = Split::new(&whole, heights);
            let volume: f64 = split.pieces().map(Tetrahedron::volume_mm3).sum();
            assert!((volume - 1.0 / 6.0).abs() < 1e-15, "{heights:?}: {volume}");
        }
    }
}
