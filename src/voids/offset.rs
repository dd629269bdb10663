//! The surface of the cavity: the inward offset surface of the model, checked so that it keeps the
//! wall.

use super::decimate::{Rules, Stray};
use super::error::VoidError;
use super::extract::Extractor;
use super::field::Resolution;
use super::simplify::simplify;
use super::wall_field::WallField;
use crate::base::watch::Watch;
use crate::geom::{Bvh, Point};
use crate::mesh::{Solid, TriMesh};
use crate::shell::Keep;

/// Extra depth at which the surface is drawn, mm, so that chords over inward curves may sag a
/// little. Less costs triangles along every inward edge; more is itself a deviation.
const BIAS_MM: f64 = 0.006;

/// Largest deficit of the wall on the unsimplified triangles, mm.
const DRAWN_LACK_MM: f64 = 0.008;

/// Largest deficit of the wall on the final triangles, mm. The promise is 0.01; the rest is for
/// rounding to `f32`.
const FINAL_LACK_MM: f64 = 0.009;

/// Largest error of a drawn corner towards the model, mm. A crossing at the very end of an edge is
/// moved by a thousandth of the edge.
const CORNER_ERROR_MM: f64 = 0.001;

/// Coarsest cell, as a share of the wall. The region nearer than the wall is two walls thick, so
/// cells below one wall cannot miss it.
const COARSE_RATIO: f64 = 0.8;

/// Number of times a coarse cell may be halved. In the finest cells an arc of the wall's radius
/// sags by (1/16)²/8 walls.
const HALVINGS: i32 = 3;

/// The same at sharp creases, where a chamfer is safe and only costs a little volume.
const CREASE_HALVINGS: i32 = 1;

/// Rounds of exact checks before the whole surface is drawn deeper.
const CHECK_ROUNDS: usize = 5;

/// Extra depth for each further attempt after the checks have failed, mm.
const DEEPER_MM: f64 = 0.01;

/// Attempts before the extraction gives up.
const ATTEMPTS: usize = 3;

/// Largest distance of the simplified surface from the drawn vertices, outward, mm.
const SIMPLE_OUTSIDE_MM: f64 = 0.02;

/// The same inward, in tolerances: the drawn triangles stray themselves.
const SIMPLE_INSIDE_RATIO: f64 = 0.35;

/// The parts of a model that must stay solid, and the accuracy of the cavity's surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CavitySpec<'a> {
    /// Thickness of the wall that stays under the model's surface, mm.
    pub wall_mm: f64,
    /// Largest distance between the drawn surface and the true one, mm, on flat and smoothly curved
    /// places.
    pub tolerance_mm: f64,
    /// Tolerance of voids' surfaces on quadrics, mm. They are true within half of it.
    pub quadric_tolerance_mm: f64,
    /// Other regions that stay solid.
    pub keeps: &'a [Keep],
    /// Diameter of the smallest ball that a void must hold, mm; smaller voids are left solid. This
    /// is the printer's minimum opening; 0 keeps all voids.
    pub min_void_mm: f64,
}

/// The model and the spec against which triangles are checked.
struct Limits<'a> {
    surface: &'a Bvh,
    spec: &'a CavitySpec<'a>,
}

impl Limits<'_> {
    /// Returns whether a triangle of the cavity keeps the wall and the keeps, with a deficit of
    /// `lack_mm` at most. Its corners lie `bias_mm` beyond the wall.
    fn allow(&self, corners: &[Point; 3], bias_mm: f64, lack_mm: f64) -> bool {
        let spare_mm = bias_mm - CORNER_ERROR_MM + lack_mm;
        if sag_squared(corners) <= spare_mm * (2.0 * self.smallest_radius_mm() - lack_mm) {
            return true;
        }
        let keeps_clear = |keep: &Keep| keep_distance(keep, corners) >= keep.radius_mm - lack_mm;
        !self
            .surface
            .is_triangle_within(corners, self.spec.wall_mm - lack_mm)
            && self.spec.keeps.iter().all(keeps_clear)
    }

    /// Returns the wall, or a keep's radius if it is smaller. The same sag lets a triangle deeper
    /// into a smaller ball.
    fn smallest_radius_mm(&self) -> f64 {
        self.spec
            .keeps
            .iter()
            .map(|keep| keep.radius_mm)
            .fold(self.spec.wall_mm, f64::min)
    }
}

/// Returns the squared sag s² of a triangle, mm². No point of the triangle is nearer to a thing
/// than √(D² − s²) if no corner is nearer to it than D.
///
/// For x = Σ λᵢ vᵢ, Σ λᵢ |vᵢ − t|² = |x − t|² + Σ λᵢ |vᵢ − x|². The last sum is at most the squared
/// circumradius. If the triangle is obtuse, it is at most a quarter of its longest side squared.
fn sag_squared([a, b, c]: &[Point; 3]) -> f64 {
    let mut sides = [
        (b - a).norm_squared(),
        (c - b).norm_squared(),
        (a - c).norm_squared(),
    ];
    sides.sort_by(f64::total_cmp);
    let [p, q, r] = sides;
    if p + q <= r {
        return r / 4.0;
    }
    // The circumradius is the product of the sides over four areas.
    p * q * r / (4.0 * (b - a).cross(&(c - a)).norm_squared())
}

/// Returns the distance from a keep's axis to a triangle, mm.
fn keep_distance(keep: &Keep, corners: &[Point; 3]) -> f64 {
    crate::geom::triangle::segment_triangle_distance_squared(&keep.from, &keep.to, corners).sqrt()
}

/// Returns the cavity's surface, simplified; it keeps the wall within [`FINAL_LACK_MM`].
pub(super) fn draw_offset_surface(
    solid: &Solid,
    spec: &CavitySpec,
    watch: &Watch,
) -> Result<TriMesh, VoidError> {
    let surface = Bvh::new(solid.mesh().iter_corners());
    let limits = Limits {
        surface: &surface,
        spec,
    };
    for attempt in 0..ATTEMPTS {
        let bias_mm = BIAS_MM + DEEPER_MM * attempt as f64;
        if let Some(drawn) = draw(&limits, bias_mm, watch)? {
            let stray = Stray {
                outside_mm: SIMPLE_OUTSIDE_MM,
                inside_mm: SIMPLE_INSIDE_RATIO * spec.tolerance_mm,
            };
            let allows = |corners: &[Point; 3]| limits.allow(corners, bias_mm, FINAL_LACK_MM);
            let rules = Rules {
                stray,
                allows: &allows,
            };
            return simplify(drawn, rules, watch);
        }
    }
    Err(VoidError::WallNotKept {
        wall_mm: spec.wall_mm,
    })
}

/// Draws the surface at the wall's distance plus the bias and refines it until no triangle breaks
/// the limits. `None` if some still do after the last round.
fn draw(limits: &Limits, bias_mm: f64, watch: &Watch) -> Result<Option<TriMesh>, VoidError> {
    let spec = limits.spec;
    let coarse_mm = COARSE_RATIO * spec.wall_mm;
    let field = WallField {
        surface: limits.surface,
        keeps: spec.keeps,
        iso_mm: spec.wall_mm + bias_mm,
        keep_margin_mm: bias_mm,
        coarse_mm,
    };
    let resolution = Resolution {
        finest_mm: coarse_mm / f64::from(1 << HALVINGS),
        crease_mm: coarse_mm / f64::from(1 << CREASE_HALVINGS),
        outside_mm: bias_mm + DRAWN_LACK_MM,
        inside_mm: (spec.tolerance_mm - BIAS_MM).max(BIAS_MM),
    };
    let aabb = limits.surface.aabb();
    let mut extractor = Extractor::new(&field, &aabb, resolution, watch)?;
    let mut dirty = extractor.leaves();
    for round in 0..CHECK_ROUNDS {
        watch.advance(round as f64 / CHECK_ROUNDS as f64);
        let drawn = extractor.refine(dirty)?;
        let refused = extractor.leaves_to_refine(&drawn, |corners| {
            limits.allow(corners, bias_mm, DRAWN_LACK_MM)
        })?;
        if refused.is_empty() {
            return Ok(Some(extractor.mesh()?));
        }
        watch.check()?;
        dirty = extractor.divide(refused)?;
    }
    Ok(None)
}
