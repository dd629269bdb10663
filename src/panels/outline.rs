//! Closed lines in the plane of a sheet.

use super::rings;
use crate::geom::hull::turn;

/// A closed line of straight pieces, mm. It goes counterclockwise round material, and clockwise
/// round a hole: the material is on its left.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    corners: Vec<[f64; 2]>,
}

/// Corners nearer than this are one, mm.
const SAME_MM: f64 = 1e-9;

impl Outline {
    /// Returns the outline with these corners, without repeated ones; `None` with fewer than three,
    /// or if they enclose no area.
    pub fn new(corners: impl IntoIterator<Item = [f64; 2]>) -> Option<Self> {
        let mut distinct: Vec<[f64; 2]> = Vec::new();
        for corner in corners {
            if distinct.last().is_none_or(|last| !is_same(last, &corner)) {
                distinct.push(corner);
            }
        }
        while distinct.len() > 1 && is_same(&distinct[0], &distinct[distinct.len() - 1]) {
            distinct.pop();
        }
        let outline = Self { corners: distinct };
        let is_closed = outline.corners.len() > 2 && outline.area_mm2().abs() > 0.0;
        (is_closed && outline.corners.iter().flatten().all(|mm| mm.is_finite())).then_some(outline)
    }

    /// Returns a rectangle with its low corner and its size, mm.
    pub fn rectangle([x, y]: [f64; 2], [width, depth]: [f64; 2]) -> Self {
        let corners = vec![
            [x, y],
            [x + width, y],
            [x + width, y + depth],
            [x, y + depth],
        ];
        Self { corners }
    }

    /// Returns the corners in their order.
    pub fn corners(&self) -> &[[f64; 2]] {
        &self.corners
    }

    /// Returns the area inside, mm²; less than zero for a hole.
    pub fn area_mm2(&self) -> f64 {
        rings::area_mm2(&self.corners)
    }

    /// Returns its length, mm.
    pub fn length_mm(&self) -> f64 {
        self.edges()
            .map(|[a, b]| (b[0] - a[0]).hypot(b[1] - a[1]))
            .sum()
    }

    /// Returns its edges, from corner to corner.
    pub fn edges(&self) -> impl Iterator<Item = [[f64; 2]; 2]> + '_ {
        rings::edges(&self.corners)
    }

    /// Returns its low and its high corner, mm.
    pub fn bounds_mm(&self) -> [[f64; 2]; 2] {
        rings::bounds(&self.corners)
    }

    /// Returns a place where it crosses itself; `None` if it does not.
    pub fn crossing(&self) -> Option<[f64; 2]> {
        let edges: Vec<[[f64; 2]; 2]> = self.edges().collect();
        let side = |[a, b]: [[f64; 2]; 2], p: [f64; 2]| turn(a, b, p);
        let cross = |a: [[f64; 2]; 2], b: [[f64; 2]; 2]| {
            side(a, b[0]) * side(a, b[1]) < 0.0 && side(b, a[0]) * side(b, a[1]) < 0.0
        };
        let crossed = edges.iter().enumerate().find(|(index, edge)| {
            let later = edges.iter().skip(index + 1);
            later.clone().any(|other| cross(**edge, *other))
        });
        crossed.map(|(_, edge)| edge[0])
    }

    /// Returns the outline moved by a distance, mm.
    #[must_use]
    pub fn moved(&self, by: [f64; 2]) -> Self {
        let corners = self.corners.iter();
        Self {
            corners: corners.map(|at| [at[0] + by[0], at[1] + by[1]]).collect(),
        }
    }
}

fn is_same(a: &[f64; 2], b: &[f64; 2]) -> bool {
    (a[0] - b[0]).hypot(a[1] - b[1]) <= SAME_MM
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_outline_has_its_area_its_length_and_its_bounds() {
        let square = Outline::rectangle([1.0, 2.0], [30.0, 20.0]);
        assert_eq!(square.area_mm2(), 600.0);
        assert_eq!(square.length_mm(), 100.0);
        assert_eq!(
            square.moved([1.0, 0.0]).bounds_mm(),
            [[2.0, 2.0], [32.0, 22.0]]
        );
        let hole = Outline::new(square.corners().iter().rev().copied()).unwrap();
        assert_eq!(hole.area_mm2(), -600.0);
    }

    #[test]
    fn what_encloses_nothing_is_no_outline() {
        let line = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]];
        for corners in [&line[..], &line[..2], &[], &[[0.0, 0.0]; 5]] {
            assert_eq!(Outline::new(corners.iter().copied()), None);
        }
        assert_eq!(
            Outline::new([[0.0, 0.0], [1.0, 0.0], [0.0, f64::NAN]]),
            None
        );
        let repeated = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, 0.0]];
        assert_eq!(Outline::new(repeated).unwrap().corners().len(), 3);
    }
}
