//! The parts of a model in cells as bodies: polytopes in the inside, exact parts at the surface.
//!
//! A chain is all that integrals need, but its triangles overlap. Files and pictures need faces
//! that fit edge to edge. So a cell at the surface is put together from them, and held against the
//! chain's volume. Where a cut passes through corners, the cell is cut from the model plane after
//! plane. Such cells in one region share a part of the model, cut to a box around them.

use rayon::prelude::*;

use super::body::Body;
use super::chain::Chain;
use super::diagram::Cell;
use super::facets::{self, Surface};
use super::polytope::Beyond;
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Aabb, Plane, Point, Vector};
use crate::mesh::{ClipError, TriMesh};

/// The part of its volume that a cell may lack where it counts as wholly inside.
const WHOLE_RATIO: f64 = 1e-12;
/// The part of its volume by which a body that was put together from faces may be wrong.
const RIGHT_RATIO: f64 = 1e-10;
/// Cells that are cut from the same part of the model.
const FEW_CELLS: usize = 3;
/// Room around a group of cells, as a part of their size: no cut of a box is one of a cell.
const ROOM_RATIO: f64 = 0.0123;
/// Width below which a face is but a line, as a part of the cell's size.
const FLAT_RATIO: f64 = 1e-9;

/// A reason why a cell has no body.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BodyError {
    /// The model cannot be cut along the sides of a cell.
    #[error("cell {cell} cannot be cut from the model; remedy: move its site, or repair the model")]
    Cut {
        /// The cell, from 1.
        cell: usize,
        /// The fault of the cut.
        source: ClipError,
    },
    /// A stop was asked for.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Returns the bodies of cells of a solid with these triangles.
///
/// # Errors
/// A cut failed, or the watch was stopped.
pub fn bodies(cells: &[Cell], solid: &TriMesh, watch: &Watch) -> Result<Vec<Body>, BodyError> {
    let surface = Surface::new(solid);
    let inside = solid.iter_corners().collect();
    let inside = Chain::new(inside);
    let quick = cells.par_iter().map(|cell| {
        watch.check()?;
        Ok::<_, Cancelled>(quick_body(cell, &surface, &inside))
    });
    let quick: Vec<Option<Body>> = quick.collect::<Result<_, _>>()?;
    let hard: Vec<usize> = (0..cells.len())
        .filter(|&index| quick[index].is_none())
        .collect();
    let mut found: Vec<Body> = quick.into_iter().map(Option::unwrap_or_default).collect();
    let group = Group { cells, watch };
    for (index, body) in group.cut(hard, solid)? {
        found[index] = body;
    }
    Ok(found)
}

/// Returns the body of a cell if it is closed and has the volume of its exact part.
fn quick_body(cell: &Cell, surface: &Surface<'_>, solid: &Chain) -> Option<Body> {
    let whole_mm3 = cell.polytope.chain().volume_mm3();
    let part_mm3 = cell.part.volume_mm3();
    let is_whole = (part_mm3 - whole_mm3).abs() <= WHOLE_RATIO * whole_mm3;
    if let Some(body) = is_whole
        .then(|| Body::of_polytope(&cell.polytope))
        .flatten()
    {
        return Some(body);
    }
    let body = facets::cut(surface, &cell.polytope, |at| solid.holds(at))?;
    let is_right = (body.volume_mm3() - part_mm3).abs() <= RIGHT_RATIO * whole_mm3;
    (is_right && body.is_closed()).then_some(body)
}

/// Cells that are cut from the same mesh.
#[derive(Clone, Copy)]
struct Group<'a> {
    cells: &'a [Cell],
    watch: &'a Watch,
}

impl Group<'_> {
    /// Cuts the cells of a group from a mesh that holds them.
    fn cut(self, mut group: Vec<usize>, mesh: &TriMesh) -> Result<Vec<(usize, Body)>, BodyError> {
        self.watch.check()?;
        if group.len() <= FEW_CELLS {
            let cells = group.into_iter();
            return cells.map(|index| self.cut_one(index, mesh)).collect();
        }
        let around = |group: &[usize]| {
            let bounds = group
                .iter()
                .map(|&index| self.cells[index].polytope.bounds());
            let corners: Vec<Point> = bounds.flat_map(|bounds| [bounds.min, bounds.max]).collect();
            Aabb::of_points(&corners)
        };
        let axis = around(&group).size().imax();
        let middle = |index: usize| self.cells[index].polytope.bounds().center()[axis];
        group.sort_by(|&a, &b| middle(a).total_cmp(&middle(b)).then(a.cmp(&b)));
        let half = group.split_off(group.len() / 2);
        let run = |group: Vec<usize>| {
            let first = group.first().copied().unwrap_or_default();
            let mesh = within(mesh, &around(&group));
            let mesh = mesh.map_err(|source| failed(first, source))?;
            self.cut(group, &mesh)
        };
        let (one, other) = rayon::join(|| run(group), || run(half));
        let mut found = one?;
        found.extend(other?);
        Ok(found)
    }

    fn cut_one(self, index: usize, mesh: &TriMesh) -> Result<(usize, Body), BodyError> {
        let polytope = &self.cells[index].polytope;
        let near_mm = FLAT_RATIO * polytope.bounds().size().max();
        let mut part = mesh.clone();
        for face in polytope.faces() {
            // A face that is but a line or a point takes nothing away, nor does the box around.
            let is_flat = area_mm2(&face.ring) <= near_mm * polytope.bounds().size().max();
            if is_flat || face.beyond == Beyond::Room || part.is_empty() {
                continue;
            }
            let halves = part.split_by_plane(&face.plane);
            part = halves.map_err(|source| failed(index, source))?.1;
        }
        Ok((index, Body::of_mesh(&part)))
    }
}

fn failed(index: usize, source: ClipError) -> BodyError {
    BodyError::Cut {
        cell: index + 1,
        source,
    }
}

/// Returns the part of a mesh in a box that is a little larger.
fn within(mesh: &TriMesh, bounds: &Aabb) -> Result<TriMesh, ClipError> {
    let room_mm = ROOM_RATIO * bounds.size().max();
    let mut part = mesh.clone();
    for axis in 0..3 {
        for (sign, end) in [(1.0, bounds.max[axis]), (-1.0, bounds.min[axis])] {
            let mut normal = Vector::zeros();
            normal[axis] = sign;
            let plane = Plane {
                normal,
                offset_mm: sign * end + room_mm,
            };
            part = part.split_by_plane(&plane)?.1;
        }
    }
    Ok(part)
}

fn area_mm2(ring: &[Point]) -> f64 {
    let first = ring[0];
    let fans = ring[1..].windows(2);
    let sum = fans.fold(Vector::zeros(), |sum, pair| {
        sum + (pair[0] - first).cross(&(pair[1] - first))
    });
    0.5 * sum.norm()
}
