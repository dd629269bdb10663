//! Tetrahedra for a solid: a lattice cut at its surface.
//!
//! The lattice is body-centred cubic. Its corners near the surface are moved onto it, the others
//! are cut off (Labelle and Shewchuk, "Isosurface Stuffing", SIGGRAPH 2007). Sharp edges of the
//! solid come out blunt, so the mesh is an approximation.

use rayon::prelude::*;

use super::clip::{Clipper, Cut};
use super::parts::{Densities, TetsParts};
use crate::geom::{Point, Vector};
use crate::mesh::{MeshDistance, Solid};

/// Share of an edge, from a corner, within which a cut moves the corner. The first is for edges
/// along the axes, the second for those between, about as Labelle and Shewchuk have them. Far less
/// leaves flat tetrahedra, far more turns some over.
const NEAR: [f64; 2] = [0.214_49, 0.356_99];
/// Most corners of the lattice: about 2 GB of memory.
const MOST_CORNERS: f64 = 2e7;
/// Layers of cells around the solid's box.
const MARGIN: f64 = 1.0;

/// A reason why a solid is not filled with tetrahedra.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StuffingError {
    /// The edge is no length, or there would be too many cells.
    #[error(
        "edges of {edge_mm:.3} mm are too short for a solid of {size_mm:.0} mm; remedy: give at \
         least {least_mm:.2} mm"
    )]
    TooFine {
        /// The edge, mm.
        edge_mm: f64,
        /// The longest side of the solid, mm.
        size_mm: f64,
        /// The least edge, mm.
        least_mm: f64,
    },
    /// Nothing is left: the cells are larger than the solid.
    #[error("edges of {edge_mm:.3} mm miss the whole solid; remedy: give shorter ones")]
    TooCoarse {
        /// The edge, mm.
        edge_mm: f64,
    },
}

/// A lattice around a solid: corners of cubes, then their centres.
struct Lattice {
    origin: Point,
    edge_mm: f64,
    /// Cubes along each axis.
    counts: [usize; 3],
}

/// The number of a corner that is used by no tetrahedron.
const UNUSED: u32 = u32::MAX;

/// Fills a solid with tetrahedra whose longest edges are about this long, mm.
///
/// Bitwise the same on any number of threads.
///
/// # Errors
/// There would be too many, or none.
pub fn stuff(solid: &Solid, edge_mm: f64) -> Result<TetsParts, StuffingError> {
    let lattice = Lattice::around(solid, edge_mm)?;
    let surface = MeshDistance::new(solid.mesh());
    let mut vertices = lattice.vertices();
    let mut values: Vec<f64> = vertices.par_iter().map(|at| surface.signed(at)).collect();
    let mut cells = lattice.cells();
    cells.retain(|cell| cell.iter().any(|&vertex| values[vertex as usize] > 0.0));
    let mut cuts = cuts_between(&cells, &values, |inner, outer| {
        let ends = [inner, outer].map(|vertex| vertices[vertex as usize]);
        surface.bvh().first_crossing(&ends[0], &ends[1])
    });
    for (vertex, at) in lattice.moves(&cuts, &vertices) {
        vertices[vertex as usize] = at;
        values[vertex as usize] = 0.0;
    }
    cuts.retain(|cut| cut.ends().iter().all(|&end| values[end as usize] != 0.0));
    let first = vertices.len() as u32;
    vertices.extend(
        cuts.iter()
            .map(|cut| cut.place(&vertices))
            .collect::<Vec<_>>(),
    );
    let clipper = Clipper {
        values: &values,
        cuts: &cuts,
        first,
    };
    let inside = cells.par_iter().flat_map_iter(|cell| clipper.clip(cell));
    let cells: Vec<[u32; 4]> = inside.collect();
    if cells.is_empty() {
        return Err(StuffingError::TooCoarse { edge_mm });
    }
    Ok(compact(&vertices, cells))
}

/// Finds where edges leave the solid, each once, in ascending order.
fn cuts_between(
    cells: &[[u32; 4]],
    values: &[f64],
    crossing: impl Fn(u32, u32) -> Option<f64> + Sync,
) -> Vec<Cut> {
    let value = |vertex: u32| values[vertex as usize];
    let mut edges: Vec<[u32; 2]> = Vec::new();
    for cell in cells {
        for (index, &one) in cell.iter().enumerate() {
            let others = cell[..index].iter();
            let crossed = others.filter(|&&other| value(one) * value(other) < 0.0);
            edges.extend(crossed.map(|&other| [one.min(other), one.max(other)]));
        }
    }
    edges.par_sort_unstable();
    edges.dedup();
    let cut = |&edge: &[u32; 2]| {
        let [inner, outer] = if value(edge[0]) > 0.0 {
            edge
        } else {
            [edge[1], edge[0]]
        };
        // The ends lie on either side. A crossing through a side of two triangles may be missed by
        // rounding, and then the distances tell.
        let by_distance = || value(inner) / (value(inner) - value(outer));
        let share = crossing(inner, outer).unwrap_or_else(by_distance);
        Cut {
            inner,
            outer,
            share: share.clamp(0.0, 1.0),
        }
    };
    edges.par_iter().map(cut).collect()
}

/// Leaves out the vertices that no cell names.
fn compact(vertices: &[Point], mut cells: Vec<[u32; 4]>) -> TetsParts {
    let mut numbers = vec![UNUSED; vertices.len()];
    let mut kept = Vec::new();
    for vertex in cells.iter_mut().flatten() {
        let number = &mut numbers[*vertex as usize];
        if *number == UNUSED {
            *number = kept.len() as u32;
            kept.push(vertices[*vertex as usize]);
        }
        *vertex = *number;
    }
    TetsParts {
        vertices: kept,
        cells,
        densities: Densities::Solid,
    }
}

impl Lattice {
    fn around(solid: &Solid, edge_mm: f64) -> Result<Self, StuffingError> {
        let aabb = solid.mesh().aabb();
        let size = aabb.size();
        let cubes = size.map(|side| (side / edge_mm).ceil() + 2.0 * MARGIN);
        if !(edge_mm > 0.0 && 2.0 * cubes.add_scalar(1.0).product() <= MOST_CORNERS) {
            return Err(StuffingError::TooFine {
                edge_mm,
                size_mm: size.max(),
                least_mm: (2.0 * size.add_scalar(size.max() * 0.1).product() / MOST_CORNERS).cbrt(),
            });
        }
        // The lattice stands even about the middle, so that a symmetric solid has a symmetric mesh.
        let origin = aabb.center() - cubes * (0.5 * edge_mm);
        Ok(Self {
            origin,
            edge_mm,
            counts: [cubes.x, cubes.y, cubes.z].map(|count| count as usize),
        })
    }

    /// Returns the number of corners along each axis.
    fn sides(&self) -> [usize; 3] {
        self.counts.map(|count| count + 1)
    }

    /// Returns the number of corners of cubes; the centres are numbered from it.
    fn corner_count(&self) -> usize {
        self.sides().iter().product()
    }

    fn corner(&self, [x, y, z]: [usize; 3]) -> u32 {
        let [nx, ny, _] = self.sides();
        (x + nx * (y + ny * z)) as u32
    }

    fn center(&self, [x, y, z]: [usize; 3]) -> u32 {
        let [nx, ny, _] = self.counts;
        (self.corner_count() + x + nx * (y + ny * z)) as u32
    }

    /// Returns the places of all corners, then of all centres.
    fn vertices(&self) -> Vec<Point> {
        let place = |[x, y, z]: [usize; 3], shift: f64| {
            let steps = Vector::new(x as f64, y as f64, z as f64).add_scalar(shift);
            self.origin + steps * self.edge_mm
        };
        let corners = grid(self.sides()).map(|at| place(at, 0.0));
        let centers = grid(self.counts).map(|at| place(at, 0.5));
        corners.chain(centers).collect()
    }

    /// Returns the tetrahedra: each has two centres of neighbours, and an edge of their face.
    fn cells(&self) -> Vec<[u32; 4]> {
        let mut cells = Vec::new();
        for at in grid(self.counts) {
            for axis in 0..3 {
                let mut next = at;
                next[axis] += 1;
                if next[axis] == self.counts[axis] {
                    continue;
                }
                let [one, other] = [at, next].map(|at| self.center(at));
                let ring = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[u, v]| {
                    let mut corner = next;
                    corner[(axis + 1) % 3] += u;
                    corner[(axis + 2) % 3] += v;
                    self.corner(corner)
                });
                // The ring turns counterclockwise about the axis, so these have positive volume.
                cells.extend((0..4).map(|i| [one, other, ring[i], ring[(i + 1) % 4]]));
            }
        }
        cells
    }

    /// Returns the corners that cuts are near to, with the nearest cut of each, in ascending order.
    fn moves(&self, cuts: &[Cut], vertices: &[Point]) -> Vec<(u32, Point)> {
        let count = self.corner_count() as u32;
        let mut near: Vec<Option<(f64, Point)>> = vec![None; vertices.len()];
        for cut in cuts {
            let [inner, outer] = cut.ends();
            let is_along_axis = (inner < count) == (outer < count);
            let most = NEAR[usize::from(!is_along_axis)];
            let at = cut.place(vertices);
            for (vertex, share) in [(inner, cut.share), (outer, 1.0 - cut.share)] {
                let distance = (at - vertices[vertex as usize]).norm();
                let known = &mut near[vertex as usize];
                let is_nearer = known.is_none_or(|(known, _)| distance < known);
                if share < most && is_nearer {
                    *known = Some((distance, at));
                }
            }
        }
        let moved = (0..).zip(near);
        moved
            .filter_map(|(vertex, it)| Some((vertex, it?.1)))
            .collect()
    }
}

/// Returns the places of a grid, x fastest.
fn grid([nx, ny, nz]: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
    (0..nz).flat_map(move |z| (0..ny).flat_map(move |y| (0..nx).map(move |x| [x, y, z])))
}

#[cfg(test)]
mod tests {
    use super::super::{Quality, Tets};
    use super::*;
    use crate::mass::moments_of_mesh;
    use crate::mesh::primitives::{ball, cuboid};

    fn stuffed(solid: &Solid, edge_mm: f64) -> Tets {
        Tets::new(stuff(solid, edge_mm).unwrap()).unwrap()
    }

    #[test]
    fn a_ball_is_filled_once_with_good_shapes_and_its_volume_converges() {
        let solid = Solid::new(ball(&Point::new(1.0, 2.0, 3.0), 10.0, 4)).unwrap();
        let exact = moments_of_mesh(solid.mesh());
        let mut before = f64::INFINITY;
        for edge_mm in [4.0, 2.0, 1.0] {
            // Flat faces of this edge lie e²/(12 R) below a ball, in the mean.
            let most = edge_mm * edge_mm / (4.0 * 10.0 * 10.0);
            let tets = stuffed(&solid, edge_mm);
            assert_eq!(tets.turned(), 0);
            let moments = tets.moments();
            let off = (moments.volume() / exact.volume() - 1.0).abs();
            assert!(off < most && off < before, "{edge_mm}: {off}");
            assert!((moments.centroid() - exact.centroid()).norm() < 0.05 * edge_mm);
            before = off;
            let quality = Quality::of(&tets);
            assert!(
                quality.least_angle_deg > 5.0 && quality.slivers == 0,
                "{quality:?}"
            );
            assert!(tets.boundary().solid().is_some());
        }
    }

    #[test]
    fn a_box_between_the_lattice_has_its_volume_but_for_its_edges() {
        let solid = cuboid(&Point::new(0.1, 0.2, 0.3), &Point::new(20.3, 10.7, 15.1));
        let solid = Solid::new(solid).unwrap();
        let exact = 20.2 * 10.5 * 14.8;
        let volume = stuffed(&solid, 1.3).moments().volume();
        assert!((volume / exact - 1.0).abs() < 0.01, "{volume} {exact}");
    }

    #[test]
    fn edges_that_fill_the_memory_or_miss_the_solid_are_refused() {
        let solid = Solid::new(ball(&Point::origin(), 10.0, 2)).unwrap();
        for edge_mm in [0.01, 0.0, -1.0, f64::NAN] {
            let why = stuff(&solid, edge_mm).unwrap_err();
            assert!(matches!(why, StuffingError::TooFine { .. }), "{why}");
        }
        let Err(StuffingError::TooFine { least_mm, .. }) = stuff(&solid, 0.01) else {
            panic!("too fine");
        };
        assert!(Lattice::around(&solid, least_mm).is_ok());
    }

    #[test]
    fn the_same_solid_has_the_same_tetrahedra_on_any_number_of_threads() {
        let solid = Solid::new(ball(&Point::origin(), 10.0, 3)).unwrap();
        let on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            pool.unwrap().install(|| stuff(&solid, 1.5).unwrap())
        };
        assert_eq!(on(1), on(4));
    }
}
