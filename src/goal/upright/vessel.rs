//! Vessels: the liquid that a model holds in a pose.

use super::shape::Shape;
use crate::geom::{Point, Vector, orthonormal_basis};

/// Cells along the longer side of the map. A wall of a thirtieth of the width is still seen.
const CELLS: usize = 48;

/// The heights of a model's upper side over the cells of a map, seen from above; −∞ beside it.
struct HeightMap {
    cells_mm: Vec<f64>,
    cell_mm: f64,
}

/// The side of the map in cells, with a border of air.
const SIDE: usize = CELLS + 2;

/// Returns the liquid that stays in a model when it rains on a pose, as a share of its convex hull.
///
/// The level in a cell is the lowest from which there is no way down to the border. Maps of terrain
/// are filled in the same way. The source is Planchon and Darboux, "A fast, simple and versatile
/// algorithm to fill the depressions of digital elevation models", Catena 46, 2002.
pub(super) fn held_ratio(shape: &Shape, up: &Vector) -> f64 {
    let map = HeightMap::of(shape, up);
    let levels = map.levels_mm();
    let depths = levels.iter().zip(&map.cells_mm);
    let depths = depths.filter(|(level, _)| level.is_finite());
    let held: f64 = depths.map(|(level, ground)| level - ground).sum();
    held * map.cell_mm * map.cell_mm / shape.hull_volume_mm3
}

impl HeightMap {
    fn of(shape: &Shape, up: &Vector) -> Self {
        let (u, v) = orthonormal_basis(up);
        let flat = |p: &Point| [p.coords.dot(&u), p.coords.dot(&v)];
        let ends = |axis: usize| {
            let along = shape.hull.iter().map(|corner| flat(corner)[axis]);
            along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| {
                [low.min(x), high.max(x)]
            })
        };
        let [across, along] = [ends(0), ends(1)];
        let cell_mm = (across[1] - across[0]).max(along[1] - along[0]) / CELLS as f64;
        let mut map = Self {
            cells_mm: vec![f64::NEG_INFINITY; SIDE * SIDE],
            cell_mm,
        };
        let place = |p: &Point| {
            let [x, y] = flat(p);
            // The middle of a cell has whole coordinates.
            Point::new(
                (x - across[0]) / cell_mm + 0.5,
                (y - along[0]) / cell_mm + 0.5,
                p.coords.dot(up),
            )
        };
        let faces = shape.mesh.iter_corners().zip(&shape.normals);
        for (corners, _) in faces.filter(|(_, normal)| normal.dot(up) > 0.0) {
            map.raise(&corners.map(|corner| place(&corner)));
        }
        map
    }

    /// Raises the cells whose middles lie under a triangle that looks up, in cells and mm.
    fn raise(&mut self, [a, b, c]: &[Point; 3]) {
        let range = |axis: usize| {
            let low = a[axis].min(b[axis]).min(c[axis]).ceil().max(0.0);
            let high = a[axis].max(b[axis]).max(c[axis]).floor();
            low as usize..=(high.max(-1.0) + 1.0) as usize
        };
        let cross =
            |p: &Point, q: &Point, r: &Point| (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
        let area = cross(a, b, c);
        for y in range(1) {
            for x in range(0) {
                let middle = Point::new(x as f64, y as f64, 0.0);
                let parts = [
                    cross(b, c, &middle),
                    cross(c, a, &middle),
                    cross(a, b, &middle),
                ];
                let is_under = area > 0.0 && parts.iter().all(|part| *part >= 0.0);
                if is_under && x < SIDE && y < SIDE {
                    let height = (parts[0] * a.z + parts[1] * b.z + parts[2] * c.z) / area;
                    let cell = &mut self.cells_mm[y * SIDE + x];
                    *cell = cell.max(height);
                }
            }
        }
    }

    /// Returns the level of the liquid in each cell. It drains where nothing is below: −∞.
    fn levels_mm(&self) -> Vec<f64> {
        let is_border = |i: usize| {
            [i % SIDE, i / SIDE]
                .iter()
                .any(|&at| at == 0 || at == SIDE - 1)
        };
        let start = |i: usize| {
            if is_border(i) || self.cells_mm[i] == f64::NEG_INFINITY {
                f64::NEG_INFINITY
            } else {
                f64::INFINITY
            }
        };
        let mut levels: Vec<f64> = (0..SIDE * SIDE).map(start).collect();
        let inner: Vec<usize> = (0..SIDE * SIDE).filter(|&i| !is_border(i)).collect();
        // Swept to and fro, a level runs down along most ways in one sweep.
        let mut has_sunk = true;
        while has_sunk {
            has_sunk = false;
            for i in inner.iter().chain(inner.iter().rev()).copied() {
                let beside = [i - 1, i + 1, i - SIDE, i + SIDE].map(|j| levels[j]);
                let way_out = beside.into_iter().fold(f64::INFINITY, f64::min);
                let level = way_out.max(self.cells_mm[i]);
                has_sunk |= level < levels[i];
                levels[i] = levels[i].min(level);
            }
        }
        levels
    }
}
