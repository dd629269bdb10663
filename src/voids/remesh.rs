//! A new surface for triangles of any kind: the boundary of the space around which they wind.

use super::decimate::{Rules, Stray};
use super::error::VoidError;
use super::extract::Extractor;
use super::field::Resolution;
use super::simplify::simplify;
use super::soup_field::SoupField;
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Bvh, Point};
use crate::mesh::edges::EdgeTable;
use crate::mesh::{TriMesh, WindingNumbers};

/// Smallest cell where nothing is missing, in tolerances. The lattice cuts edges off by up to 0.87
/// cells along a bevel, which is half a cube's diagonal. Half a tolerance leaves room for what
/// simplifying adds.
const USUAL_RATIO: f64 = 0.5;

/// Largest cell that may hold the surface, in these. Larger cells are quicker, but miss more walls,
/// which then have to be found missing.
const COARSE_CELLS: f64 = 8.0;

/// Number of times that these cells may be halved where something is missing. What is thinner than
/// the smallest cell, 1/64 of the tolerance, is lost.
const FINER_HALVINGS: i32 = 5;

/// Largest number of triangles up to which cells are halved for what is missing. It bounds the
/// memory; how much that is was not measured.
const MOST_TRIANGLES: usize = 2_000_000;

/// Triangles that halving a cell of the surface adds: four of its eight parts hold surface, with
/// some eight triangles each in place of eight.
const TRIANGLES_PER_LEAF: usize = 24;

/// Largest stray of the drawn triangles' sides, and of the simplified triangles from the drawn
/// ones, in tolerances. A triangle's middle strays 4/3 as far as its sides.
const DRAW_RATIO: f64 = 0.25;
const SIMPLIFY_RATIO: f64 = 0.15;

/// Room around the triangles, in coarse cells, so that the surface stays clear of the box.
const ROOM_CELLS: f64 = 4.0;

/// A place of the triangles that a new surface lacks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Missing {
    /// The place.
    pub at: Point,
    /// Its distance from the new surface, mm.
    pub distance_mm: f64,
}

/// Triangles of any kind, ready to be asked where they separate inside from outside.
pub struct Soup {
    surface: Bvh,
    winding: WindingNumbers,
    is_closed: bool,
    /// The triangles in their order.
    corners: Vec<[Point; 3]>,
}

impl Soup {
    /// Makes the triangles of a mesh ready, in time n log n.
    pub fn of(mesh: &TriMesh) -> Self {
        let corners: Vec<[Point; 3]> = mesh.iter_corners().collect();
        Self {
            surface: Bvh::new(corners.iter().copied()),
            winding: WindingNumbers::new(corners.iter().copied()),
            is_closed: EdgeTable::of(mesh).bad_count() == 0,
            corners,
        }
    }

    /// Returns the generalised winding number of the triangles around a point: exact if they form a
    /// closed surface, else right to 0.015.
    pub fn winding_number(&self, p: &Point) -> f64 {
        if self.is_closed {
            f64::from(self.surface.winding(p))
        } else {
            self.winding.at(p)
        }
    }

    /// Returns the point of the triangles nearest to a point, and its triangle; `None` if there are
    /// no triangles.
    pub fn nearest(&self, p: &Point) -> Option<(Point, [Point; 3])> {
        let nearest = self.surface.closest(p, f64::INFINITY, &[])?;
        Some((nearest.point, self.corners[nearest.triangle as usize]))
    }

    /// Draws the boundary of the space in which the generalised winding number of the triangles is
    /// above one half. Empty if there is no such space.
    ///
    /// The surface is closed, 2-manifold and free of self-intersection. It strays from the true one
    /// by about the tolerance, mm; sharp edges are bevelled by as much. Thin walls and spikes are
    /// drawn with cells that are halved as long as `missing` finds something. Takes time and memory
    /// by the surface's area over the square of the tolerance.
    ///
    /// # Errors
    /// The tolerance is not positive or is too fine for the size, or the watch was stopped.
    pub fn remesh(
        &self,
        tolerance_mm: f64,
        missing: &dyn Fn(&TriMesh) -> Result<Vec<Missing>, Cancelled>,
        watch: &Watch,
    ) -> Result<TriMesh, VoidError> {
        if !(tolerance_mm > 0.0 && tolerance_mm.is_finite()) {
            let name = "the tolerance of the new surface";
            return Err(VoidError::NotPositive {
                name,
                value_mm: tolerance_mm,
            });
        }
        let stray_mm = SIMPLIFY_RATIO * tolerance_mm;
        let rules = Rules {
            stray: Stray {
                outside_mm: stray_mm,
                inside_mm: stray_mm,
            },
            allows: &|_| true,
        };
        simplify(self.draw(tolerance_mm, missing, watch)?, rules, watch)
    }

    /// Draws the surface with the lattice's many triangles.
    fn draw(
        &self,
        tolerance_mm: f64,
        missing: &dyn Fn(&TriMesh) -> Result<Vec<Missing>, Cancelled>,
        watch: &Watch,
    ) -> Result<TriMesh, VoidError> {
        let usual_mm = USUAL_RATIO * tolerance_mm;
        let field = SoupField {
            surface: &self.surface,
            winding: &self.winding,
            is_closed: self.is_closed,
            coarse_mm: COARSE_CELLS * usual_mm,
            usual_mm,
        };
        let finest_mm = usual_mm * 0.5_f64.powi(FINER_HALVINGS);
        let resolution = Resolution {
            finest_mm,
            crease_mm: finest_mm,
            outside_mm: DRAW_RATIO * tolerance_mm,
            inside_mm: DRAW_RATIO * tolerance_mm,
        };
        let aabb = self.surface.aabb().inflated(ROOM_CELLS * field.coarse_mm);
        let mut extractor = Extractor::new(&field, &aabb, resolution, watch)?;
        let mut dirty = extractor.leaves();
        loop {
            extractor.refine(dirty)?;
            let drawn = extractor.mesh()?;
            let balls = missing(&drawn)?.into_iter();
            let balls: Vec<(Point, f64)> = balls
                .map(|lost| (lost.at, lost.distance_mm + tolerance_mm))
                .collect();
            let leaves = extractor.leaves_in(&balls);
            let triangles = drawn.triangles().len() + TRIANGLES_PER_LEAF * leaves.len();
            if leaves.is_empty() || triangles > MOST_TRIANGLES {
                return Ok(drawn);
            }
            dirty = extractor.divide(leaves)?;
            if dirty.is_empty() {
                return Ok(drawn);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Vector;
    use crate::mesh::primitives::{ball, cuboid};
    use crate::mesh::{Crossings, Solid};

    fn draw(soup: &TriMesh, tolerance_mm: f64) -> TriMesh {
        let mesh = Soup::of(soup)
            .remesh(tolerance_mm, &|_| Ok(Vec::new()), &Watch::silent())
            .unwrap();
        assert_eq!(Crossings::of(&mesh).pairs, 0);
        Solid::new(mesh).unwrap().into_mesh()
    }

    /// Every triangle apart, moved by up to a reach along each axis.
    fn scattered(mesh: &TriMesh, reach_mm: f64) -> TriMesh {
        let vertices = mesh.iter_corners().enumerate().flat_map(|(i, corners)| {
            let turn = 2.4 * i as f64;
            let by = Vector::new(turn.sin(), turn.cos(), (2.0 * turn).sin()) * reach_mm;
            corners.map(|p| p + by)
        });
        let count = mesh.triangles().len() as u32;
        let triangles = (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]);
        TriMesh::new(vertices.collect(), triangles.collect()).unwrap()
    }

    #[test]
    fn a_closed_box_keeps_its_volume_but_for_its_edges() {
        let cube = cuboid(&Point::origin(), &Point::new(10.0, 10.0, 10.0));
        let volume = draw(&cube, 0.2).signed_volume_mm3();
        // Bevels of 0.2 mm take at most 0.02 mm² along 120 mm of edges.
        assert!((volume - 1000.0).abs() < 2.4, "{volume}");
    }

    #[test]
    fn a_soup_of_single_triangles_becomes_a_solid() {
        let ball = ball(&Point::origin(), 10.0, 4);
        let soup = scattered(&ball, 0.02);
        let found = draw(&soup, 0.2);
        let ratio = found.signed_volume_mm3() / ball.signed_volume_mm3();
        // A shift of 0.05 mm in radius would be 1.5 %.
        assert!((ratio - 1.0).abs() < 0.01, "{ratio}");
    }

    #[test]
    fn a_hole_gets_the_membrane_of_the_winding_number() {
        let ball = ball(&Point::origin(), 10.0, 4);
        let is_kept = |t: &&[u32; 3]| ball.vertices()[t[0] as usize].z < 8.0;
        let kept: Vec<[u32; 3]> = ball.triangles().iter().filter(is_kept).copied().collect();
        let open = TriMesh::new(ball.vertices().to_vec(), kept).unwrap();
        let ratio = draw(&open, 0.2).signed_volume_mm3() / ball.signed_volume_mm3();
        // The cap above 8 mm has 2.8 % of the ball; the membrane bulges into it.
        assert!((0.965..1.0).contains(&ratio), "{ratio}");
    }

    #[test]
    fn too_fine_a_tolerance_is_refused_before_anything_is_made() {
        let cube = cuboid(&Point::origin(), &Point::new(10.0, 10.0, 10.0));
        for tolerance_mm in [0.0, f64::NAN, 1e-6] {
            assert!(
                Soup::of(&cube)
                    .remesh(tolerance_mm, &|_| Ok(Vec::new()), &Watch::silent())
                    .is_err()
            );
        }
    }
}
