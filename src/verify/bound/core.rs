//! The inside that may be emptied, as cells with their volumes.

use crate::geom::{Bvh, Frame, Point};
use crate::mass::Moments;
use crate::verify::{BoundProof, KeptPlace};

/// The inside of a body beyond its wall and its kept places, in the goal frame.
pub(super) struct Core {
    cells: Vec<Cell>,
}

/// A cube, or the share of one that lies in the core.
#[derive(Debug, Clone, Copy)]
struct Cell {
    middle: Point,
    side_mm: f64,
    volume_mm3: f64,
}

/// A search for the cells of a core.
struct Finder<'a> {
    outside: &'a Bvh,
    proof: &'a BoundProof,
    /// Levels of the octree: of cells inside, and of those that meet the border.
    levels: [u32; 2],
}

impl Core {
    /// Finds the cells. `levels` are the halvings of the longest side, inside and where the wall
    /// begins.
    pub fn of(outside: &Bvh, proof: &BoundProof, frame: &Frame, levels: [u32; 2]) -> Self {
        let finder = Finder {
            outside,
            proof,
            levels,
        };
        let extent = outside.aabb();
        let size = extent.size();
        let side_mm = size.x.max(size.y).max(size.z);
        let mut cells = Vec::new();
        finder.visit(
            nalgebra::center(&extent.min, &extent.max),
            side_mm,
            0,
            &mut cells,
        );
        for cell in &mut cells {
            cell.middle = frame.to_local(&cell.middle);
        }
        Self { cells }
    }

    /// Returns the moments of the part of the core where a quadric is positive, and the integral of
    /// the quadric over that part. Both are in the goal frame.
    pub fn emptied(&self, quadric: &[f64; 10]) -> (Moments, f64) {
        let mut moments = [0.0; 10];
        let mut integral = 0.0;
        for cell in &self.cells {
            let monomials = cell.mean_monomials();
            let value: f64 = monomials.iter().zip(quadric).map(|(m, q)| m * q).sum();
            if value > 0.0 {
                integral += value * cell.volume_mm3;
                for (sum, monomial) in moments.iter_mut().zip(&monomials) {
                    *sum += monomial * cell.volume_mm3;
                }
            }
        }
        (Moments(moments), integral)
    }
}

impl Cell {
    /// Returns the means of the ten monomials over the cube.
    fn mean_monomials(&self) -> [f64; 10] {
        let mut means = Moments::monomials(self.middle.x, self.middle.y, self.middle.z);
        for square in &mut means[7..] {
            *square += self.side_mm * self.side_mm / 12.0;
        }
        means
    }
}

impl Finder<'_> {
    fn visit(&self, middle: Point, side_mm: f64, level: u32, cells: &mut Vec<Cell>) {
        let radius_mm = 0.5 * 3f64.sqrt() * side_mm;
        let [inside, border] = self.levels;
        let Some(depth_mm) = self.depth_mm(&middle, radius_mm) else {
            return;
        };
        let is_whole = depth_mm >= radius_mm;
        if is_whole && level >= inside || level >= border {
            let share = if is_whole {
                1.0
            } else {
                (0.5 + depth_mm / side_mm).clamp(0.0, 1.0)
            };
            if share > 0.0 {
                let volume_mm3 = share * side_mm.powi(3);
                cells.push(Cell {
                    middle,
                    side_mm,
                    volume_mm3,
                });
            }
            return;
        }
        for octant in 0..8 {
            let step = |axis: u32| {
                let sign = if octant >> axis & 1 == 0 { -0.25 } else { 0.25 };
                sign * side_mm
            };
            let child = Point::new(middle.x + step(0), middle.y + step(1), middle.z + step(2));
            self.visit(child, 0.5 * side_mm, level + 1, cells);
        }
    }

    /// Returns how far a point lies inside the core, negative outside, mm. It is exact near the
    /// border; farther than `radius_mm` inside it is some larger number. `None` if no point within
    /// the radius lies in the core.
    fn depth_mm(&self, p: &Point, radius_mm: f64) -> Option<f64> {
        let wall_mm = self.proof.wall_mm;
        let nearest = self.outside.closest(p, wall_mm + radius_mm, &[]);
        let is_inside = self.outside.winding(p) > 0;
        let under_wall = match nearest {
            Some(nearest) if is_inside => nearest.distance_squared.sqrt() - wall_mm,
            Some(nearest) => -nearest.distance_squared.sqrt() - wall_mm,
            None if is_inside => f64::INFINITY,
            None => return None,
        };
        let keeps = self.proof.keeps.iter().map(|keep| beyond_mm(keep, p));
        let depth_mm = keeps.fold(under_wall, f64::min);
        (depth_mm > -radius_mm).then_some(depth_mm)
    }
}

/// Returns the distance of a point from a kept place, negative in it, mm.
fn beyond_mm(keep: &KeptPlace, p: &Point) -> f64 {
    let [from, to] = [keep.from_mm, keep.to_mm].map(Point::from);
    let along = to - from;
    let length = along.norm_squared();
    let share = if length > 0.0 {
        ((p - from).dot(&along) / length).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (p - (from + along * share)).norm() - keep.radius_mm
}
