//! Cups: resin that a part, the platform and the film enclose while a part is printed in a vat.

use rayon::prelude::*;

use super::{PartEvidence, Promise};
use crate::base::watch::{Cancelled, Watch};
use crate::geom::Point;
use crate::mesh::TriMesh;
use crate::mesh::union_find::UnionFind;

/// The process whose parts are printed against a film.
const VAT: &str = "sla";
/// Side of the cells, as a share of the thinnest wall: a wall then holds a cell at least, so that
/// nothing leaks through it.
const CELL_RATIO: f64 = 0.5;
/// Greatest number of cells of a part: 16 bytes each.
const MAX_CELLS: f64 = 6e6;
/// Share of a cell by which the cells are shifted, so that they keep off edges along the axes.
const SHIFT_RATIO: f64 = 0.413;

/// The resin that a part encloses.
#[derive(Debug, Clone, PartialEq)]
pub struct CupFacts {
    /// The part's name on the sheet.
    pub id: String,
    /// The volume that is enclosed at some layer, mm³.
    pub volume_mm3: f64,
}

/// Measures the cups of each part; empty for other processes than resin in a vat.
pub(super) fn measure_cups(
    promise: &Promise,
    parts: &[PartEvidence],
    watch: &Watch,
) -> Result<Vec<CupFacts>, Cancelled> {
    if promise.printer.process.as_deref() != Some(VAT) {
        return Ok(Vec::new());
    }
    let cell_mm = CELL_RATIO * promise.printer.minimum_wall_mm;
    let facts = |part: &PartEvidence| {
        Ok(CupFacts {
            id: part.id.clone(),
            volume_mm3: Layers::of(&part.mesh, cell_mm).enclosed_mm3(watch)?,
        })
    };
    parts.par_iter().map(facts).collect()
}

/// A part in print pose as layers of cells that are material or not.
struct Layers<'a> {
    mesh: &'a TriMesh,
    /// The triangles that cross each layer.
    crossing: Vec<Vec<u32>>,
    low: Point,
    /// Number of cells along x and y, with one beside the part on every side.
    shape: [usize; 2],
    cell_mm: f64,
}

impl<'a> Layers<'a> {
    /// Divides the part's box; cells are larger than asked if there would be too many.
    fn of(mesh: &'a TriMesh, cell_mm: f64) -> Self {
        let aabb = mesh.aabb();
        let size = aabb.size();
        let volume_mm3 = size.x * size.y * size.z;
        let cell_mm = cell_mm.max((volume_mm3 / MAX_CELLS).cbrt());
        let count = |mm: f64| (mm / cell_mm).ceil() as usize;
        let mut layers = Self {
            mesh,
            crossing: vec![Vec::new(); count(size.z)],
            low: aabb.min,
            shape: [count(size.x) + 2, count(size.y) + 2],
            cell_mm,
        };
        for (index, corners) in mesh.iter_corners().enumerate() {
            let heights = corners.map(|p| (p.z - aabb.min.z) / cell_mm - SHIFT_RATIO);
            let first = heights
                .into_iter()
                .fold(f64::INFINITY, f64::min)
                .ceil()
                .max(0.0);
            let last = heights
                .into_iter()
                .fold(f64::NEG_INFINITY, f64::max)
                .floor();
            for layer in first as usize..layers.crossing.len().min((last + 1.0).max(0.0) as usize) {
                layers.crossing[layer].push(index as u32);
            }
        }
        layers
    }

    /// Returns the volume of all cells that have no way outside when their layer is printed, mm³.
    fn enclosed_mm3(&self, watch: &Watch) -> Result<f64, Cancelled> {
        let [width, depth] = self.shape;
        let cells = width * depth;
        let mut sets = UnionFind::new(cells * self.crossing.len() + 1);
        // The outside is the last number, but the smallest member stands for a set.
        let outside = (cells * self.crossing.len()) as u32;
        let mut below = vec![false; cells];
        let mut enclosed = 0usize;
        for layer in 0..self.crossing.len() {
            watch.check()?;
            let solid = self.material(layer);
            let number = |cell: usize| (layer * cells + cell) as u32;
            for cell in (0..cells).filter(|cell| !solid[*cell]) {
                let (x, y) = (cell % width, cell / width);
                if x == 0 || y == 0 || x + 1 == width || y + 1 == depth {
                    sets.merge(outside, number(cell));
                }
                if x > 0 && !solid[cell - 1] {
                    sets.merge(number(cell - 1), number(cell));
                }
                if y > 0 && !solid[cell - width] {
                    sets.merge(number(cell - width), number(cell));
                }
                if below[cell] {
                    sets.merge(number(cell) - cells as u32, number(cell));
                }
            }
            let open = sets.root(outside);
            let shut = (0..cells).filter(|cell| !solid[*cell]);
            enclosed += shut.filter(|cell| sets.root(number(*cell)) != open).count();
            below = solid.iter().map(|is_solid| !is_solid).collect();
        }
        Ok(enclosed as f64 * self.cell_mm.powi(3))
    }

    /// Returns the cells of a layer that are material: an odd number of walls is on their left.
    fn material(&self, layer: usize) -> Vec<bool> {
        let [width, depth] = self.shape;
        let z = self.low.z + (layer as f64 + SHIFT_RATIO) * self.cell_mm;
        let mut walls: Vec<Vec<f64>> = vec![Vec::new(); depth];
        for &index in &self.crossing[layer] {
            let Some([a, b]) = section(self.mesh.corners(index as usize), z) else {
                continue;
            };
            let row = |y: f64| (y - self.low.y) / self.cell_mm + 1.0 - SHIFT_RATIO;
            let (first, last) = (row(a[1].min(b[1])), row(a[1].max(b[1])));
            let [first, last] = [first, last].map(|row| row.ceil().max(0.0) as usize);
            let crossed = walls.iter_mut().enumerate().take(last).skip(first);
            for (line, walls) in crossed {
                let share = (line as f64 - row(a[1])) / (row(b[1]) - row(a[1]));
                walls.push(a[0] + (b[0] - a[0]) * share);
            }
        }
        let mut solid = vec![false; width * depth];
        for (line, mut walls) in walls.into_iter().enumerate() {
            walls.sort_by(f64::total_cmp);
            for pair in walls.chunks_exact(2) {
                let column = |x: f64| (x - self.low.x) / self.cell_mm + 1.0 - SHIFT_RATIO;
                let [first, last] = [pair[0], pair[1]].map(|x| column(x).ceil().max(0.0) as usize);
                for cell in first..last.min(width) {
                    solid[line * width + cell] = true;
                }
            }
        }
        solid
    }
}

/// Returns the ends of the section of a triangle at a height; `None` if it does not cross it.
fn section(corners: [Point; 3], z: f64) -> Option<[[f64; 2]; 2]> {
    let [a, b, c] = corners;
    let mut ends = [(a, b), (b, c), (c, a)].into_iter().filter_map(|(p, q)| {
        // The lower end comes first, so that both triangles of an edge find the same point.
        let (p, q) = if (p.z, p.x, p.y) <= (q.z, q.x, q.y) {
            (p, q)
        } else {
            (q, p)
        };
        let share = (z - p.z) / (q.z - p.z);
        (p.z < z && z <= q.z).then(|| [p.x + (q.x - p.x) * share, p.y + (q.y - p.y) * share])
    });
    Some([ends.next()?, ends.next()?])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Csg, primitives};

    /// Returns the volume that a block of 20 mm with these holes encloses.
    fn enclosed(holes: &[[[f64; 3]; 2]]) -> f64 {
        let block = |[low, high]: [[f64; 3]; 2]| {
            Csg::of_mesh(&primitives::cuboid(&low.into(), &high.into())).unwrap()
        };
        let body = holes
            .iter()
            .fold(block([[0.0; 3], [20.0; 3]]), |body, hole| {
                body.subtract(&block(*hole)).unwrap()
            });
        let mesh = body.to_mesh().unwrap();
        Layers::of(&mesh, 0.5)
            .enclosed_mm3(&Watch::silent())
            .unwrap()
    }

    #[test]
    fn a_hollow_open_toward_the_film_or_flat_on_the_platform_is_a_cup() {
        // Half a cell on every side of a hollow of 10 by 10 mm is not sure: 10 % of it.
        let up = enclosed(&[[[5.0, 5.0, 8.0], [15.0, 15.0, 25.0]]]);
        let down = enclosed(&[[[5.0, 5.0, -5.0], [15.0, 15.0, 12.0]]]);
        for volume_mm3 in [up, down] {
            assert!((volume_mm3 - 1200.0).abs() < 0.1 * 1200.0, "{volume_mm3}");
        }
    }

    #[test]
    fn a_hollow_with_a_way_out_at_its_first_layer_is_no_cup() {
        let hollow = [[5.0, 5.0, 8.0], [15.0, 15.0, 25.0]];
        // A vent beside its floor, and one 4 mm above: 4 mm of resin stand below that.
        let low = enclosed(&[hollow, [[9.0, -5.0, 8.0], [11.0, 6.0, 10.0]]]);
        let high = enclosed(&[hollow, [[9.0, -5.0, 12.0], [11.0, 6.0, 14.0]]]);
        assert!(low < 60.0, "{low}");
        assert!((high - 400.0).abs() < 60.0, "{high}");
    }
}
