//! Integrates what fades out toward a surface, over the cells of an octree.

use rayon::prelude::*;

use crate::geom::{Aabb, Point, Vector};
use crate::mass::{Estimate, Moments};

/// Cells along each side of the box to begin with.
const FIRST_CELLS: u32 = 12;
/// Halvings of a cell after which its error is accepted.
const MOST_HALVINGS: usize = 10;
/// Offset of the two Gauss points on a side of a cell, as a share of half the side: 1/√3.
const GAUSS_POINT: f64 = 0.577_350_269_189_625_8;

/// A function of the signed depth below a surface: zero at the surface and outside.
pub(super) struct Fading<'a> {
    /// The depth at a point, mm; negative outside. Its slope is at most 1.
    pub depth_mm: &'a (dyn Fn(&Point) -> f64 + Sync),
    /// The function of the depth.
    pub value: &'a (dyn Fn(f64) -> f64 + Sync),
    /// Depth from which the function is constant, mm; may be infinite.
    pub constant_from_mm: f64,
}

/// The end of the refinement.
pub(super) struct Limits {
    /// Largest error of a cell as a share of its volume.
    pub ratio: f64,
    /// Most points at which the depth is measured.
    pub most_points: usize,
}

/// A cubic cell.
#[derive(Clone, Copy)]
struct Cell {
    center: Point,
    half_mm: f64,
}

impl Cell {
    /// Returns the moments of the cell about a center, filled with a density.
    fn moments(&self, density: f64, about: &Point) -> Moments {
        let side = 2.0 * self.half_mm;
        let at = self.center - about;
        let mut moments = Moments(Moments::monomials(at.x, at.y, at.z));
        moments.0[7..]
            .iter_mut()
            .for_each(|square| *square += side * side / 12.0);
        moments * (density * side.powi(3))
    }

    fn eighths(&self) -> impl Iterator<Item = Self> {
        let (center, half_mm) = (self.center, 0.5 * self.half_mm);
        (0..8).map(move |corner| Self {
            center: center + corner_of(corner) * half_mm,
            half_mm,
        })
    }
}

/// Returns a corner of the cube from −1 to 1.
fn corner_of(corner: usize) -> Vector {
    Vector::from_fn(|axis, _| if corner >> axis & 1 == 0 { -1.0 } else { 1.0 })
}

/// Returns the integral over a box of a function that fades toward a surface.
///
/// Cells are halved until one and eight points agree. The depth bounds what a cell holds, so cells
/// outside, or deeper than where the function is constant, are done at once.
pub(super) fn over_cells(region: &Aabb, fading: &Fading, limits: &Limits) -> Estimate {
    let about = region.center();
    let half_mm = 0.5 * region.size().max() / f64::from(FIRST_CELLS);
    let mut cells = first_cells(region, half_mm);
    let mut left = limits.most_points;
    let mut total = Estimate::default();
    for halving in 0..=MOST_HALVINGS {
        let measured: Vec<(Estimate, bool)> = cells
            .par_iter()
            .map(|cell| measure(cell, fading, &about))
            .collect();
        left = left.saturating_sub(9 * cells.len());
        let mut open = Vec::new();
        for (cell, (estimate, is_done)) in cells.iter().zip(&measured) {
            let volume_mm3 = (2.0 * cell.half_mm).powi(3);
            let is_right = estimate.error.volume() <= limits.ratio * volume_mm3;
            let may_open = halving < MOST_HALVINGS && left >= 72 * (open.len() + 1);
            if *is_done || is_right || !may_open {
                total = total.plus(estimate);
            } else {
                open.push(*cell);
            }
        }
        cells = open.iter().flat_map(Cell::eighths).collect();
    }
    total.translated(&about.coords)
}

fn first_cells(region: &Aabb, half_mm: f64) -> Vec<Cell> {
    let counts = region
        .size()
        .map(|side| (side / (2.0 * half_mm) - 1e-9).ceil().max(1.0) as u32);
    let start = region.center() - counts.map(|count| f64::from(count) * half_mm);
    let mut cells = Vec::new();
    for k in 0..counts.z {
        for j in 0..counts.y {
            for i in 0..counts.x {
                let place = Vector::new(f64::from(i), f64::from(j), f64::from(k));
                let center = start + (place * 2.0).add_scalar(1.0) * half_mm;
                cells.push(Cell { center, half_mm });
            }
        }
    }
    cells
}

/// Returns the integral over a cell, and whether it needs no halving.
fn measure(cell: &Cell, fading: &Fading, about: &Point) -> (Estimate, bool) {
    let depth_mm = (fading.depth_mm)(&cell.center);
    let reach_mm = 3f64.sqrt() * cell.half_mm;
    if depth_mm <= -reach_mm {
        return (Estimate::default(), true);
    }
    let value = (fading.value)(depth_mm);
    let coarse = cell.moments(value, about);
    if depth_mm - reach_mm >= fading.constant_from_mm {
        return (Estimate::exact(coarse), true);
    }
    let mut fine = Moments::default();
    let weight = cell.half_mm.powi(3);
    for corner in 0..8 {
        let at = cell.center + corner_of(corner) * (GAUSS_POINT * cell.half_mm);
        let value = (fading.value)((fading.depth_mm)(&at));
        let from = at - about;
        fine += Moments(Moments::monomials(from.x, from.y, from.z)) * (value * weight);
    }
    let error = Moments((fine - coarse).0.map(f64::abs));
    (
        Estimate {
            moments: fine,
            error,
        },
        false,
    )
}
