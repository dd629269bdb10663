//! Tetrahedra that are proved to fill a solid once, with densities.

use super::boundary::Boundary;
use super::error::TetsError;
use super::faces::{FACES, Faces, middle};
use super::overlap;
use super::parts::{Densities, TetsParts};
use crate::field::Density;
use crate::geom::{Aabb, Point, Vector};
use crate::mass::{Moments, Tetrahedron, moments_of_tetrahedra};

/// Most tetrahedra: each has four faces, which are numbered in 32 bits.
const MOST_CELLS: usize = 1 << 30;
/// Excess of a density over 0 to 1 that is rounding, such as that of single precision.
const ROUNDING: f64 = 1e-6;
/// Rounding of a volume, in units of the last place of the products that make it.
const FLAT_ULPS: f64 = 16.0;

/// Tetrahedra of positive volume that fill a solid once, each inner face shared by two of them, and
/// a density from 0 to 1.
///
/// Corners with the same coordinates are one place: parts that were meshed together but numbered
/// apart share their faces, and may differ in density there.
#[derive(Debug, Clone)]
pub struct Tets {
    vertices: Vec<Point>,
    cells: Vec<[u32; 4]>,
    densities: Densities,
    boundary: Boundary,
    neighbours: Vec<[u32; 2]>,
    turned: usize,
}

impl Tets {
    /// Checks tetrahedra and their densities. Time n log n: about 1 s for 500 000.
    ///
    /// A tetrahedron that lists its corners in the other order of turning fills the same space. It
    /// is turned and counted, since formats differ in that order.
    ///
    /// # Errors
    /// The first fault, with its place.
    pub fn new(parts: TetsParts) -> Result<Self, TetsError> {
        let TetsParts {
            vertices,
            mut cells,
            densities,
        } = parts;
        check_cells(&cells, &vertices)?;
        check_densities(&densities, [vertices.len(), cells.len()])?;
        let turned = orient(&mut cells, &vertices)?;
        let (places, at) = places(&vertices);
        let by_place = |corners: &[u32; 4]| corners.map(|corner| places[corner as usize]);
        let by_place: Vec<[u32; 4]> = cells.iter().map(by_place).collect();
        let faces = Faces::of(&by_place, &at)?;
        let boundary = Boundary::new(&faces.outer, &at);
        overlap::check(&boundary, |cell| {
            cells[cell as usize].map(|corner| vertices[corner as usize])
        })?;
        Ok(Self {
            vertices,
            cells,
            densities,
            boundary,
            neighbours: faces.inner,
            turned,
        })
    }

    /// Returns the vertices, mm; some may be named by no tetrahedron.
    pub fn vertices(&self) -> &[Point] {
        &self.vertices
    }

    /// Returns the corners of each tetrahedron, of positive volume.
    pub fn cells(&self) -> &[[u32; 4]] {
        &self.cells
    }

    /// Returns the densities.
    pub fn densities(&self) -> &Densities {
        &self.densities
    }

    /// Returns the surface.
    pub fn boundary(&self) -> &Boundary {
        &self.boundary
    }

    /// Returns the number of tetrahedra that were listed in the other order of turning.
    pub fn turned(&self) -> usize {
        self.turned
    }

    /// Returns the number of vertices that tetrahedra name.
    pub fn corner_count(&self) -> usize {
        let mut is_used = vec![false; self.vertices.len()];
        let corners = self.cells.iter().flatten();
        corners.for_each(|&corner| is_used[corner as usize] = true);
        is_used.into_iter().filter(|&is_used| is_used).count()
    }

    /// Returns the pairs of tetrahedra that share a face.
    pub(super) fn neighbours(&self) -> &[[u32; 2]] {
        &self.neighbours
    }

    /// Returns the corners of a tetrahedron, mm.
    pub fn tetrahedron(&self, cell: usize) -> Tetrahedron {
        Tetrahedron(self.cells[cell].map(|corner| self.vertices[corner as usize].coords))
    }

    /// Returns the densities at the corners of a tetrahedron.
    pub fn densities_of(&self, cell: usize) -> [f64; 4] {
        match &self.densities {
            Densities::Solid => [1.0; 4],
            Densities::Corners(values) => self.cells[cell].map(|corner| values[corner as usize]),
            Densities::Cells(values) => [values[cell]; 4],
        }
    }

    /// Returns the moments of the densities, mm³ to mm⁵ of solid material: in closed form, with
    /// compensated sums.
    pub fn moments(&self) -> Moments {
        self.moments_with(|cell| self.densities_of(cell))
    }

    /// Returns the moments of the space that is filled, mm³ to mm⁵.
    pub fn solid_moments(&self) -> Moments {
        self.moments_with(|_| [1.0; 4])
    }

    /// Returns the moments with other densities at the corners of each tetrahedron.
    pub(super) fn moments_with(&self, densities: impl Fn(usize) -> [f64; 4]) -> Moments {
        let cells = (0..self.cells.len()).map(|cell| (self.tetrahedron(cell), densities(cell)));
        moments_of_tetrahedra(&self.middle(), cells)
    }

    /// Returns the middle of the box around the mesh, mm.
    pub(super) fn middle(&self) -> Point {
        self.aabb().center()
    }

    /// Returns the box around the mesh.
    pub fn aabb(&self) -> Aabb {
        self.boundary.mesh().aabb()
    }

    /// Returns the mesh with every length multiplied by a factor, about the origin.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        Self {
            vertices: self.vertices.iter().map(|at| at * factor).collect(),
            boundary: self.boundary.scaled(factor),
            ..self
        }
    }

    /// Returns the mesh with other densities, which are known to be some.
    pub(super) fn with_densities(&self, densities: Densities) -> Self {
        Self {
            densities,
            ..self.clone()
        }
    }

    /// Returns the mesh with a field's values at its vertices as densities.
    ///
    /// # Errors
    /// A value that is no density.
    pub fn sampled(&self, field: &dyn Density) -> Result<Self, TetsError> {
        let values = self.vertices.iter().map(|at| field.at(at)).collect();
        let densities = Densities::Corners(values);
        check_densities(&densities, [self.vertices.len(), self.cells.len()])?;
        Ok(self.with_densities(densities))
    }
}

/// Checks that every tetrahedron has four corners of finite numbers.
fn check_cells(cells: &[[u32; 4]], vertices: &[Point]) -> Result<(), TetsError> {
    if cells.is_empty() {
        return Err(TetsError::Empty);
    }
    if cells.len() > MOST_CELLS {
        let count = cells.len();
        return Err(TetsError::TooMany { count });
    }
    for (cell, corners) in cells.iter().enumerate() {
        for (index, &corner) in corners.iter().enumerate() {
            let Some(at) = vertices.get(corner as usize) else {
                let corners = vertices.len();
                return Err(TetsError::NoCorner {
                    cell,
                    corner,
                    corners,
                });
            };
            if corners[..index].contains(&corner) {
                return Err(TetsError::RepeatedCorner { cell, corner });
            }
            if !at.iter().all(|x| x.is_finite()) {
                return Err(TetsError::NotFinite { cell, corner });
            }
        }
    }
    Ok(())
}

/// Checks that there is a density for everything that has one, and that each is one.
fn check_densities(densities: &Densities, counts: [usize; 2]) -> Result<(), TetsError> {
    let (values, wanted, [what, things]) = match densities {
        Densities::Solid => return Ok(()),
        Densities::Corners(values) => (values, counts[0], ["corner", "corners"]),
        Densities::Cells(values) => (values, counts[1], ["tetrahedron", "tetrahedra"]),
    };
    if values.len() != wanted {
        let found = values.len();
        return Err(TetsError::DensityCount {
            found,
            wanted,
            things,
        });
    }
    let is_density = |value: &f64| (-ROUNDING..=1.0 + ROUNDING).contains(value);
    match values.iter().position(|value| !is_density(value)) {
        Some(index) => Err(TetsError::Density {
            what,
            index,
            value: values[index],
        }),
        None => Ok(()),
    }
}

/// Turns tetrahedra of negative volume; returns their number.
fn orient(cells: &mut [[u32; 4]], vertices: &[Point]) -> Result<usize, TetsError> {
    let mut turned = 0;
    for (cell, corners) in cells.iter_mut().enumerate() {
        let at = corners.map(|corner| vertices[corner as usize]);
        let volume_mm3 = Tetrahedron(at.map(|at| at.coords)).volume_mm3();
        // Not a number, where coordinates are beyond all measure, is no volume either.
        let is_solid = volume_mm3.abs() > rounding_mm3(&at);
        if !is_solid {
            let at = middle(at);
            return Err(TetsError::Flat { cell, at });
        }
        if volume_mm3 < 0.0 {
            corners.swap(2, 3);
            turned += 1;
        }
    }
    Ok(turned)
}

/// Returns the volume that rounding can make of four points in a plane, mm³.
///
/// Coordinates are right to their last place, and a corner that moves changes the volume by the
/// area opposite. The products that make the volume are rounded too.
fn rounding_mm3(corners: &[Point; 4]) -> f64 {
    let farthest = corners.iter().map(|corner| corner.coords.amax());
    let farthest = farthest.fold(0.0, f64::max);
    let areas = FACES.map(|face| {
        let [a, b, c] = face.map(|corner| corners[corner]);
        0.5 * (b - a).cross(&(c - a)).norm()
    });
    let edges = [1, 2, 3].map(|corner: usize| (corners[corner] - corners[0]).norm());
    let products = edges.iter().product::<f64>() / 6.0;
    FLAT_ULPS * f64::EPSILON * (farthest * areas.iter().sum::<f64>() / 3.0 + products)
}

/// Numbers the places of the vertices: equal coordinates have one number. Returns the number of
/// each vertex, and the place of each number.
fn places(vertices: &[Point]) -> (Vec<u32>, Vec<Point>) {
    let key = |&vertex: &u32| {
        // −0.0 and 0.0 are one place.
        let at = vertices[vertex as usize].coords + Vector::zeros();
        [at.x, at.y, at.z].map(f64::to_bits)
    };
    let mut order: Vec<u32> = (0..vertices.len() as u32).collect();
    order.sort_unstable_by_key(|vertex| (key(vertex), *vertex));
    let mut numbers = vec![0; vertices.len()];
    let mut at = Vec::new();
    for same in order.chunk_by(|a, b| key(a) == key(b)) {
        for &vertex in same {
            numbers[vertex as usize] = at.len() as u32;
        }
        at.push(vertices[same[0] as usize]);
    }
    (numbers, at)
}
