//! Draws the part of a box in which a quadric is positive, as a closed surface.

use super::decimate::{Rules, Stray};
use super::density_field::{DensityField, DensityLevel};
use super::error::VoidError;
use super::extract::Extractor;
use super::field::{Field, Known, Resolution};
use super::octree::CIRCUMRADIUS;
use super::quadric_field::{CellSizes, QuadricField};
use super::simplify::simplify;
use crate::base::watch::Watch;
use crate::geom::{Aabb, Bvh, Frame, Quadric};
use crate::mesh::{Csg, Solid, TriMesh};

/// Coarsest cells, mm. Larger ones save nothing, as the quadrics' radii are of the model's size.
const COARSE_MM: f64 = 4.0;

/// Coarsest cells of a density, mm: what hides in them is too thin to print. Large bodies have as
/// many cells to a side as [`DENSITY_CELLS`].
const DENSITY_MM: f64 = 1.0;

/// Cells along the longest side of a large body.
const DENSITY_CELLS: f64 = 128.0;

/// Number of times such a cell may be halved, and at a crease.
const DENSITY_HALVINGS: [i32; 2] = [3, 1];

/// Number of times a coarse cell may be halved. The finest cells follow a radius of 0.4 mm within
/// 0.01 mm.
const HALVINGS: i32 = 5;

/// Largest cell near a singular point, mm. A detail that hides in it is too thin to print or to
/// clean.
const SINGULAR_MM: f64 = 0.5;

/// Margin of the region around the box, mm, so that its own faces stay clear of the box's contents.
const MARGIN_MM: f64 = 1.0;

/// Steps to which the region's box is rounded, mm, so that rounding errors of the body's surface
/// hardly ever move the lattice. They are far above these errors and far below the margin.
const SNAP_MM: f64 = 1.0 / 64.0;

/// Largest stray of the drawn triangles' sides from the quadric, as a share of the tolerance. With
/// the simplification it makes half the tolerance, as a triangle's middle strays 4/3 as far as its
/// sides.
const DRAW_RATIO: f64 = 0.25;

/// Largest stray of the simplified triangles from the drawn ones, as a share of the tolerance.
const SIMPLIFY_RATIO: f64 = 0.1;

/// The part of a box where a quadric is positive.
pub(super) enum Region {
    /// None of it.
    Nothing,
    /// All of it.
    Everything,
    /// Some of it. The body reaches beyond the box.
    Part(Box<Csg>),
}

/// What was drawn of a region in a solid.
#[derive(Debug, Clone, PartialEq)]
pub enum Drawn {
    /// None of the solid is in it.
    Nothing,
    /// All of the solid is in it.
    Everything,
    /// A closed surface, true inside the solid. Elsewhere it need not be.
    Body(TriMesh),
}

/// The body in which a region is drawn.
pub(super) struct Canvas<'a> {
    /// Surface of the body.
    pub body: &'a Bvh,
    /// Tolerance of the drawing, mm.
    pub tolerance_mm: f64,
    /// The watch over the run.
    pub watch: &'a Watch,
}

/// Draws the part of the body's box in which the quadric, given in `frame`, is positive. Inside the
/// body it is true within half of the tolerance; elsewhere it need not be.
pub(super) fn positive_region(
    quadric: &Quadric,
    frame: &Frame,
    canvas: Canvas,
) -> Result<Region, VoidError> {
    let cells = CellSizes {
        coarse_mm: COARSE_MM,
        singular_mm: SINGULAR_MM,
    };
    let field = QuadricField::new(quadric, frame, canvas.body, cells);
    let cells = [COARSE_MM / f64::from(1 << HALVINGS), SINGULAR_MM];
    Ok(match positive_mesh(&field, cells, &canvas)? {
        Drawn::Nothing => Region::Nothing,
        Drawn::Everything => Region::Everything,
        Drawn::Body(mesh) => Region::Part(Box::new(Csg::of_mesh(&mesh)?)),
    })
}

/// Draws the region of a solid in which a density is below a value, within half of the tolerance.
pub fn draw_below(
    solid: &Solid,
    level: &DensityLevel,
    tolerance_mm: f64,
    watch: &Watch,
) -> Result<Drawn, VoidError> {
    let body = Bvh::new(solid.mesh().iter_corners());
    let coarse_mm = DENSITY_MM.max(body.aabb().size().max() / DENSITY_CELLS);
    let field = DensityField::new(*level, &body, coarse_mm);
    let cells = DENSITY_HALVINGS.map(|halvings| coarse_mm / f64::from(1 << halvings));
    let canvas = Canvas {
        body: &body,
        tolerance_mm,
        watch,
    };
    positive_mesh(&field, cells, &canvas)
}

/// Draws the part of the body's box in which a function is positive. `cells_mm` are the finest
/// cells, and the finest at creases.
fn positive_mesh(
    field: &impl Field,
    cells_mm: [f64; 2],
    canvas: &Canvas,
) -> Result<Drawn, VoidError> {
    let aabb = canvas.body.aabb();
    let at = aabb.center();
    let center = Known {
        at,
        sample: field.sample(&at, &[]),
    };
    if aabb.is_empty() || field.is_free(&center, aabb.size().max() * CIRCUMRADIUS) {
        let is_all = !aabb.is_empty() && center.sample.is_positive();
        return Ok(if is_all {
            Drawn::Everything
        } else {
            Drawn::Nothing
        });
    }
    let room = snapped(&aabb.inflated(MARGIN_MM));
    let stray_mm = DRAW_RATIO * canvas.tolerance_mm;
    let resolution = Resolution {
        finest_mm: cells_mm[0],
        crease_mm: cells_mm[1],
        outside_mm: stray_mm,
        inside_mm: stray_mm,
    };
    let mut extractor = Extractor::new(field, &room, resolution, canvas.watch)?;
    let leaves = extractor.leaves();
    extractor.refine(leaves)?;
    let mesh = extractor.mesh()?;
    if mesh.triangles().is_empty() {
        return Ok(Drawn::Nothing);
    }
    let stray_mm = SIMPLIFY_RATIO * canvas.tolerance_mm;
    let stray = Stray {
        outside_mm: stray_mm,
        inside_mm: stray_mm,
    };
    let simple = simplify(
        mesh,
        Rules {
            stray,
            allows: &|_| true,
        },
        canvas.watch,
    )?;
    Ok(Drawn::Body(simple))
}

/// Returns the box with its sides rounded to [`SNAP_MM`].
fn snapped(aabb: &Aabb) -> Aabb {
    let snap = |x: f64| (x / SNAP_MM).round() * SNAP_MM;
    Aabb {
        min: aabb.min.map(snap),
        max: aabb.max.map(snap),
    }
}
