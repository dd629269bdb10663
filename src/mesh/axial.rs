//! Lines along an axis: where they enter and leave the body that a mesh bounds.

use super::TriMesh;
use crate::geom::{Frame, Vector};

/// The triangles of a mesh near the z axis of a frame, in that frame, mm.
pub struct NearAxis {
    triangles: Vec<[Vector; 3]>,
}

impl NearAxis {
    /// Collects the triangles that come within `reach_mm` of the frame's z axis, measured along x
    /// and along y.
    pub fn new(mesh: &TriMesh, frame: &Frame, reach_mm: f64) -> Self {
        let local = mesh
            .iter_corners()
            .map(|corners| corners.map(|corner| frame.to_local(&corner).coords));
        let is_near = |corners: &[Vector; 3]| {
            (0..2).all(|axis| {
                let along = corners.map(|corner| corner[axis]);
                let most = along.into_iter().fold(f64::NEG_INFINITY, f64::max);
                let least = along.into_iter().fold(f64::INFINITY, f64::min);
                least <= reach_mm && most >= -reach_mm
            })
        };
        Self {
            triangles: local.filter(is_near).collect(),
        }
    }

    /// Returns the line along z through (x, y), mm, which must lie within reach.
    pub fn line(&self, [x, y]: [f64; 2]) -> AxialLine {
        let at = Vector::new(x, y, 0.0);
        let crossings = self.triangles.iter();
        AxialLine(
            crossings
                .filter_map(|corners| cross(&corners.map(|corner| corner - at)))
                .collect(),
        )
    }

    /// Returns lines evenly spread on a circle about the axis. The first stands at `turn_rad`.
    pub fn ring(&self, count: usize, radius_mm: f64, turn_rad: f64) -> Vec<AxialLine> {
        let angle = |i: usize| std::f64::consts::TAU * i as f64 / count as f64 + turn_rad;
        (0..count)
            .map(|i| {
                let (sin, cos) = angle(i).sin_cos();
                self.line([radius_mm * cos, radius_mm * sin])
            })
            .collect()
    }
}

/// A line along an axis, by its crossings with a surface.
pub struct AxialLine(Vec<Crossing>);

/// Returns the length between two heights over which all lines lie in the body, mm.
pub fn walled_mm(lines: &[AxialLine], [low_mm, high_mm]: [f64; 2]) -> f64 {
    let crossings = lines.iter().flat_map(|line| &line.0);
    let between = crossings
        .map(|crossing| crossing.height_mm)
        .filter(|height_mm| (low_mm..high_mm).contains(height_mm));
    let mut ends: Vec<f64> = between.chain([low_mm, high_mm]).collect();
    ends.sort_by(f64::total_cmp);
    let is_walled = |height_mm: f64| lines.iter().all(|line| line.is_inside(height_mm));
    let walled = ends
        .windows(2)
        .filter(|pair| is_walled(0.5 * (pair[0] + pair[1])));
    walled.map(|pair| pair[1] - pair[0]).sum()
}

/// A place at which a line enters or leaves the body.
#[derive(Debug, Clone, Copy)]
struct Crossing {
    height_mm: f64,
    enters: bool,
}

impl AxialLine {
    /// Returns true if this height on the line lies in the body.
    pub fn is_inside(&self, height_mm: f64) -> bool {
        let below = self.0.iter();
        let turns = below
            .filter(|crossing| crossing.height_mm < height_mm)
            .map(|crossing| if crossing.enters { 1 } else { -1 });
        turns.sum::<i32>() > 0
    }
}

/// Returns the crossing of the z axis with a triangle, if it passes through it.
///
/// An axis through an edge or a corner counts as moved by an infinitely small step. So it passes
/// through exactly one of the triangles around it.
fn cross([a, b, c]: &[Vector; 3]) -> Option<Crossing> {
    let sides = [side(b, c), side(c, a), side(a, b)];
    let enters = sides == [false; 3];
    if !(enters || sides == [true; 3]) {
        return None;
    }
    let weights = [turn(b, c), turn(c, a), turn(a, b)];
    let area: f64 = weights.iter().sum();
    let height_mm = if area == 0.0 {
        a.z
    } else {
        (weights[0] * a.z + weights[1] * b.z + weights[2] * c.z) / area
    };
    Some(Crossing { height_mm, enters })
}

/// Returns twice the signed area of the triangle of the axis and an edge, seen from above.
fn turn(p: &Vector, q: &Vector) -> f64 {
    p.x * q.y - p.y * q.x
}

/// Returns true if the axis, moved by (ε, ε²), lies to the left of an edge seen from above.
fn side(p: &Vector, q: &Vector) -> bool {
    let turn = turn(p, q);
    if turn != 0.0 {
        turn > 0.0
    } else if p.y != q.y {
        q.y < p.y
    } else {
        q.x > p.x
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::mesh::primitives;

    fn near(mesh: &TriMesh) -> NearAxis {
        NearAxis::new(mesh, &Frame::identity(), 20.0)
    }

    #[test]
    fn a_line_through_corners_and_edges_enters_and_leaves_a_block_once() {
        let block = primitives::cuboid(&Point::new(-4.0, -4.0, 1.0), &Point::new(4.0, 4.0, 9.0));
        let feel = near(&block);
        // The diagonals of the faces, a face's edge, its corner, and beside it.
        for at in [
            [0.0, 0.0],
            [1.0, 1.0],
            [1.0, -1.0],
            [-4.0, 0.0],
            [-4.0, -4.0],
        ] {
            let line = feel.line(at);
            assert_eq!(line.0.len() % 2, 0, "{at:?}");
            assert!(!line.is_inside(0.5) && !line.is_inside(9.5), "{at:?}");
        }
        assert!(feel.line([1.0, 1.0]).is_inside(5.0) && feel.line([0.0, 0.0]).is_inside(1.5));
        assert!(feel.line([4.5, 0.0]).0.is_empty());
    }

    #[test]
    fn the_wall_around_an_axis_is_as_long_as_all_its_lines_lie_in_the_body() {
        // Its slanted top is at 5 mm beside the axis on the left, at 7 mm on the right.
        let block = primitives::cuboid(&Point::new(-4.0, -4.0, 1.0), &Point::new(4.0, 4.0, 6.0));
        let slanted = block.map_vertices(|p| Point::new(p.x, p.y, p.z * (1.0 + p.x / 24.0)));
        let ring = near(&slanted).ring(4, 4.0 - 1e-9, 0.0);
        let walled = |ends_mm| walled_mm(&ring, ends_mm);
        assert!((walled([0.0, 9.0]) - (5.0 - 7.0 / 6.0)).abs() < 1e-6);
        assert!((walled([2.0, 3.0]) - 1.0).abs() < 1e-12 && walled([5.5, 9.0]) < 1e-9);
    }

    #[test]
    fn lines_agree_with_the_winding_number_in_and_around_a_ball() {
        let ball = primitives::ball(&Point::new(1.0, 2.0, 3.0), 8.0, 3);
        let feel = near(&ball);
        let places =
            [2.0, 5.0, 7.0, 9.0].map(|radius_mm| (radius_mm, feel.ring(7, radius_mm, 0.3)));
        for (radius_mm, i, line) in places.iter().flat_map(|(radius_mm, ring)| {
            ring.iter()
                .enumerate()
                .map(move |(i, l)| (*radius_mm, i, l))
        }) {
            let (sin, cos) = (std::f64::consts::TAU * i as f64 / 7.0 + 0.3).sin_cos();
            for z in [-6.0, -2.0, 3.1, 8.0, 12.0] {
                let point = Point::new(radius_mm * cos, radius_mm * sin, z);
                let is_inside = crate::mesh::winding_number(&ball, &point) > 0.5;
                assert_eq!(line.is_inside(z), is_inside, "{point}");
            }
        }
    }
}
