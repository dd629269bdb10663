//! Holes from voids to the outside.

use rayon::prelude::*;

use super::doors::Sizes;
use super::prism::{corner_mm, rims};
use super::rooms::{Void, Voids};
use crate::cells::{Beyond, Polytope};
use crate::geom::Point;
use crate::mesh::{MeshDistance, TriMesh};

/// Places along each side of a void's box from which a hole is tried.
const PLACES: usize = 12;
/// Places nearest to the outside that are tried at most.
const MOST_TRIED: usize = 60;
/// Holes that a void is asked for.
const HOLES: usize = 2;
/// Reach of a hole beyond the surface, in radii of its corners.
const BEYOND_RATIO: f64 = 1.0;
/// Room of a hole's inner end in its void, mm.
const ROOM_MM: f64 = 0.02;

/// A hole from a void to the outside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Escape {
    /// The number of the void.
    pub void: usize,
    /// The cell of the void.
    pub cell: usize,
    /// The inner end of its axis, in the void, mm.
    pub from: Point,
    /// The place where the axis meets the surface, mm.
    pub mouth: Point,
    /// The outer end of its axis, beyond the surface, mm.
    pub to: Point,
}

/// Returns the holes that each void could have: none, one, or two apart from each other.
pub(super) fn escapes(voids: &Voids, surface: &MeshDistance, sizes: Sizes) -> Vec<Vec<Escape>> {
    let found = voids.all.par_iter().enumerate().map(|(index, void)| {
        let one = Search {
            void,
            index,
            drawn_in: &voids.drawn_in[void.cell],
            surface,
            sizes,
        };
        one.holes()
    });
    found.collect()
}

struct Search<'a> {
    void: &'a Void,
    index: usize,
    drawn_in: &'a Polytope,
    surface: &'a MeshDistance,
    sizes: Sizes,
}

impl Search<'_> {
    fn holes(&self) -> Vec<Escape> {
        let corner_mm = corner_mm(self.sizes.opening_mm);
        let deep_mm = corner_mm + ROOM_MM;
        let bounds = self.void.mesh.aabb();
        if bounds.size().min() < 2.0 * deep_mm {
            return Vec::new();
        }
        let along = |axis: usize, k: usize| {
            let share = (k as f64 + 0.5) / PLACES as f64;
            bounds.min[axis] + share * bounds.size()[axis]
        };
        let places = (0..PLACES.pow(3)).map(|k| {
            let [i, j] = [k % PLACES, k / PLACES % PLACES];
            Point::new(along(0, i), along(1, j), along(2, k / PLACES / PLACES))
        });
        let inside = places.filter(|at| self.void.distance.signed(at) >= deep_mm);
        let mut near: Vec<(f64, Point)> = inside.map(|at| (self.surface.signed(&at), at)).collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut found: Vec<Escape> = Vec::new();
        for (_, from) in near.into_iter().take(MOST_TRIED) {
            let apart_mm = 2.0 * corner_mm + self.sizes.wall_mm;
            let is_apart =
                |hole: &Escape, other: &Escape| (hole.mouth - other.mouth).norm() >= apart_mm;
            if let Some(hole) = self.hole(from)
                && found.iter().all(|other| is_apart(&hole, other))
            {
                found.push(hole);
            }
            if found.len() == HOLES {
                break;
            }
        }
        found
    }

    /// Returns the hole from a place to the nearest place of the surface; `None` if it would come
    /// too near to another void, or does not reach the open.
    fn hole(&self, from: Point) -> Option<Escape> {
        let nearest = self.surface.bvh().closest(&from, f64::INFINITY, &[])?;
        let mouth = nearest.point;
        let out = (mouth - from).try_normalize(1e-6)?;
        let corner_mm = corner_mm(self.sizes.opening_mm);
        let to = mouth + out * (BEYOND_RATIO * corner_mm);
        // Half a wall and more from every side: other voids are another half beyond it.
        let is_clear = self.drawn_in.faces().iter().all(|face| {
            let is_near = |at: &Point| face.plane.distance(at) + corner_mm > 0.0;
            face.beyond == Beyond::Room || !(is_near(&from) || is_near(&mouth))
        });
        let [_, outer] = rims([from, to], self.sizes.opening_mm);
        let is_open = || outer.iter().all(|at| self.surface.signed(at) < 0.0);
        (is_clear && is_open()).then_some(Escape {
            void: self.index,
            cell: self.void.cell,
            from,
            mouth,
            to,
        })
    }
}

/// Returns the body of air of a hole.
pub(super) fn air(hole: &Escape, sizes: Sizes) -> TriMesh {
    super::prism::prism([hole.from, hole.to], sizes.opening_mm)
}
