//! An octree whose leaves differ in size by a factor of two at most across faces and edges.

use rayon::prelude::*;

use super::field::{Field, Known};
use super::runs::map_in_runs;
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Aabb, Point};

/// A position on the finest grid. One unit is half the finest cell.
pub(super) type Grid = [i32; 3];

/// Size of the finest cell in units; even, so that centres fall on the grid.
pub(super) const FINEST_UNITS: i32 = 2;

/// Largest root, in units, that a packed grid position can name (21 bits an axis).
const ROOT_UNITS_MAX: i32 = 1 << 20;

/// Share of a cell's circumradius beyond which the cell is certainly free of the surface. Its
/// lattice points may be pushed off the surface, which must not depend on the last bit.
const FREE_RATIO: f64 = 1.0 + 1e-9;

/// Half a cube's diagonal over its side.
pub(super) const CIRCUMRADIUS: f64 = 0.866_025_403_784_438_6;

/// The twelve neighbours across edges and six across faces.
pub(super) const NEIGHBOURS: [Grid; 18] = [
    [-1, 0, 0],
    [1, 0, 0],
    [0, -1, 0],
    [0, 1, 0],
    [0, 0, -1],
    [0, 0, 1],
    [-1, -1, 0],
    [-1, 1, 0],
    [1, -1, 0],
    [1, 1, 0],
    [-1, 0, -1],
    [-1, 0, 1],
    [1, 0, -1],
    [1, 0, 1],
    [0, -1, -1],
    [0, -1, 1],
    [0, 1, -1],
    [0, 1, 1],
];

/// A cube of the tree.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell {
    /// Corner with the least coordinates.
    pub corner: Grid,
    /// Side, units.
    pub size: i32,
    /// True if the surface certainly does not enter the cell.
    pub is_free: bool,
    /// Sample of the function at the centre.
    pub center: Known,
}

impl Cell {
    /// Returns the grid position of the centre.
    #[inline]
    pub fn center_grid(&self) -> Grid {
        self.corner.map(|c| c + self.size / 2)
    }

    /// Returns the corner of the neighbour of the same size in a direction.
    #[inline]
    pub fn neighbour_corner(&self, direction: Grid) -> Grid {
        [0, 1, 2].map(|i| self.corner[i] + direction[i] * self.size)
    }
}

/// An octree with its place in space.
#[derive(Debug, Clone)]
pub(super) struct Octree {
    cells: Vec<Cell>,
    /// For each cell the first of its eight children, or 0 for a leaf; kept apart so that a descent
    /// stays in the cache.
    children: Vec<u32>,
    origin: Point,
    unit_mm: f64,
}

impl Octree {
    /// Returns an octree of one cell that holds `aabb`, for a finest cell of `finest_mm`. `None` if
    /// a grid position cannot count that many cells across.
    pub fn new(aabb: &Aabb, finest_mm: f64, field: &impl Field) -> Option<Self> {
        let unit_mm = finest_mm / f64::from(FINEST_UNITS);
        let needed = aabb.size().max() / unit_mm;
        let mut size = FINEST_UNITS;
        while f64::from(size) < needed {
            size = if size < ROOT_UNITS_MAX {
                size * 2
            } else {
                return None;
            };
        }
        let half_mm = f64::from(size) * unit_mm / 2.0;
        let at = aabb.center();
        let origin = at - crate::geom::Vector::repeat(half_mm);
        let center = Known {
            at,
            sample: field.sample(&at, &[]),
        };
        let root = Cell {
            corner: [0; 3],
            size,
            is_free: false,
            center,
        };
        Some(Self {
            cells: vec![root],
            children: vec![0],
            origin,
            unit_mm,
        })
    }

    /// Returns all cells, inner ones and leaves, parents before children.
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// Returns the cell of this number.
    #[inline]
    pub fn cell(&self, index: u32) -> &Cell {
        &self.cells[index as usize]
    }

    /// Returns the side of the root, units.
    #[inline]
    pub fn root_size(&self) -> i32 {
        self.cells[0].size
    }

    /// Returns a length given in units, mm.
    #[inline]
    pub fn length_mm(&self, units: i32) -> f64 {
        f64::from(units) * self.unit_mm
    }

    /// Returns the point at a grid position.
    #[inline]
    pub fn point(&self, grid: Grid) -> Point {
        self.origin + crate::geom::Vector::from(grid.map(f64::from)) * self.unit_mm
    }

    /// Returns the cell of this size at this corner, or the leaf that holds it. `None` outside the
    /// root.
    #[inline]
    pub fn at(&self, corner: Grid, size: i32) -> Option<u32> {
        let root = self.root_size();
        if corner.iter().any(|&c| c < 0 || c >= root) {
            return None;
        }
        let (mut index, mut half) = (0, root / 2);
        loop {
            let children = self.children[index as usize];
            if children == 0 || half < size {
                return Some(index);
            }
            let bit = |i: usize| u32::from(corner[i] & half != 0) << i;
            index = children + bit(0) + bit(1) + bit(2);
            half /= 2;
        }
    }

    /// Returns whether a cell has no children.
    #[inline]
    pub fn is_leaf(&self, index: u32) -> bool {
        self.children[index as usize] == 0
    }

    /// Returns whether the cell of this size at this corner is divided.
    #[inline]
    pub fn is_divided(&self, corner: Grid, size: i32) -> bool {
        self.at(corner, size)
            .is_some_and(|index| !self.is_leaf(index))
    }

    /// Divides cells until none that may hold the surface is too coarse, and balances the tree.
    /// Returns the new leaves.
    pub fn grow(&mut self, field: &impl Field, watch: &Watch) -> Result<Vec<u32>, Cancelled> {
        let mut latest = vec![0];
        let mut created = Vec::new();
        while !latest.is_empty() {
            watch.check()?;
            let coarse: Vec<u32> = latest
                .into_iter()
                .filter(|&i| self.is_too_coarse(i, field))
                .collect();
            latest = self.split(&coarse, field, watch)?;
            created.extend_from_slice(&latest);
        }
        let balanced = self.balance(created.clone(), field, watch)?;
        created.extend(balanced);
        Ok(self.leaves_of(created))
    }

    /// Divides these leaves, and others as balance requires. Returns the new leaves.
    pub fn refine(
        &mut self,
        leaves: &[u32],
        field: &impl Field,
        watch: &Watch,
    ) -> Result<Vec<u32>, Cancelled> {
        let mut created = self.split(leaves, field, watch)?;
        let balanced = self.balance(created.clone(), field, watch)?;
        created.extend(balanced);
        Ok(self.leaves_of(created))
    }

    fn leaves_of(&self, cells: Vec<u32>) -> Vec<u32> {
        cells.into_iter().filter(|&i| self.is_leaf(i)).collect()
    }

    fn is_too_coarse(&self, index: u32, field: &impl Field) -> bool {
        let cell = self.cell(index);
        !cell.is_free
            && cell.size > FINEST_UNITS
            && field.is_too_coarse(&cell.center, self.length_mm(cell.size))
    }

    /// Divides leaves that are more than twice as large as a neighbour across a face or an edge.
    /// Returns the new cells.
    fn balance(
        &mut self,
        mut latest: Vec<u32>,
        field: &impl Field,
        watch: &Watch,
    ) -> Result<Vec<u32>, Cancelled> {
        let mut created = Vec::new();
        while !latest.is_empty() {
            watch.check()?;
            let mut large: Vec<u32> = latest
                .par_iter()
                .flat_map_iter(|&i| self.too_large_beside(i))
                .collect();
            large.sort_unstable();
            large.dedup();
            latest = self.split(&large, field, watch)?;
            // A divided leaf's children may still be too large for the neighbour that asked.
            created.extend_from_slice(&latest);
            latest = self.widened(&latest);
        }
        Ok(created)
    }

    /// Returns these cells' leaves and the leaves around them, in ascending order.
    pub fn widened(&self, cells: &[u32]) -> Vec<u32> {
        let around = |&i: &u32| {
            let cell = *self.cell(i);
            NEIGHBOURS
                .iter()
                .flat_map(move |&direction| self.touching(&cell, direction))
                .chain([i])
        };
        let mut all: Vec<u32> = cells.par_iter().flat_map_iter(around).collect();
        all.sort_unstable();
        all.dedup();
        all.retain(|&i| self.is_leaf(i));
        all
    }

    /// Returns the leaves that touch a cell on the side of `direction`.
    fn touching(&self, cell: &Cell, direction: Grid) -> Vec<u32> {
        let mut stack: Vec<u32> = self
            .at(cell.neighbour_corner(direction), cell.size)
            .into_iter()
            .collect();
        let mut found = Vec::new();
        while let Some(index) = stack.pop() {
            let children = self.children[index as usize];
            if children == 0 {
                found.push(index);
            } else {
                stack.extend((children..children + 8).filter(|&c| touches(cell, self.cell(c))));
            }
        }
        found
    }

    /// Returns the neighbours that are more than twice as large as a leaf.
    fn too_large_beside(&self, index: u32) -> impl Iterator<Item = u32> + '_ {
        let cell = *self.cell(index);
        let neighbours = NEIGHBOURS.iter().filter(move |_| self.is_leaf(index));
        neighbours
            .filter_map(move |&direction| self.at(cell.neighbour_corner(direction), cell.size))
            .filter(move |&other| self.cell(other).size > 2 * cell.size)
    }

    /// Divides leaves into eight each and samples the centres. Returns the children.
    fn split(
        &mut self,
        leaves: &[u32],
        field: &impl Field,
        watch: &Watch,
    ) -> Result<Vec<u32>, Cancelled> {
        let first = self.cells.len() as u32;
        let child = |i: usize| self.child(leaves[i / 8], (i % 8) as i32, field);
        let children: Vec<Cell> = map_in_runs(8 * leaves.len(), watch, child)?;
        for (k, &leaf) in leaves.iter().enumerate() {
            self.children[leaf as usize] = first + 8 * k as u32;
        }
        self.cells.extend(children);
        self.children.resize(self.cells.len(), 0);
        Ok((first..self.cells.len() as u32).collect())
    }

    fn child(&self, parent: u32, number: i32, field: &impl Field) -> Cell {
        let parent = self.cell(parent);
        let size = parent.size / 2;
        let corner = [0, 1, 2].map(|i| parent.corner[i] + (number >> i & 1) * size);
        let at = self.point(corner.map(|c| c + size / 2));
        let center = Known {
            at,
            sample: field.sample(&at, &[parent.center]),
        };
        let radius_mm = self.length_mm(size) * CIRCUMRADIUS * FREE_RATIO;
        let is_free = parent.is_free || field.is_free(&center, radius_mm);
        Cell {
            corner,
            size,
            is_free,
            center,
        }
    }
}

/// Returns whether two closed cubes have a point in common.
fn touches(a: &Cell, b: &Cell) -> bool {
    (0..3).all(|i| a.corner[i] <= b.corner[i] + b.size && b.corner[i] <= a.corner[i] + a.size)
}
