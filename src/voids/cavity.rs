//! The whole region that may be emptied, as a closed surface that keeps the wall.

use super::decimate::{Rules, Stray};
use super::extract::Extractor;
use super::field::Resolution;
use super::simplify::simplified;
use super::wall_field::WallField;
use super::{CavitySpec, VoidError};
use crate::base::watch::Watch;
use crate::geom::{Bvh, Point};
use crate::mesh::{Solid, TriMesh};
use crate::shell::Keep;

/// The surface is drawn this much deeper than the wall, mm, so that chords over inward curves may
/// sag a little: less costs triangles along every inward edge, more is itself a deviation.
const BIAS_MM: f64 = 0.006;

/// What the wall may lack on the unsimplified triangles, mm.
const DRAWN_LACK_MM: f64 = 0.008;

/// What the wall may lack on the final triangles, mm; the promise is 0.01, the rest is for rounding
/// to `f32`.
const FINAL_LACK_MM: f64 = 0.009;

/// The corners may lie this much nearer than they were drawn, mm: a crossing at the very end of an
/// edge is moved by a thousandth of it.
const CORNER_ERROR_MM: f64 = 0.001;

/// Coarsest cell over the wall: the region nearer than the wall is two walls thick, so cells below
/// one wall see it.
const COARSE_RATIO: f64 = 0.8;

/// How often coarse cells may be halved; an arc of the wall's radius sags (1/16)²/8 walls in the
/// finest ones.
const HALVINGS: i32 = 3;

/// How often coarse cells are halved at sharp creases, where a chop is safe and only costs a little
/// volume.
const CREASE_HALVINGS: i32 = 1;

/// Rounds of exact checks before the whole surface is drawn deeper.
const CHECK_ROUNDS: usize = 5;

/// How much deeper the surface is drawn when the checks fail, mm, and how often that is tried.
const DEEPER_MM: f64 = 0.01;
const ATTEMPTS: usize = 3;

/// How far a simplification may stray from the drawn vertices, mm outward and in tolerances inward:
/// the drawn triangles stray themselves.
const SIMPLE_OUTSIDE_MM: f64 = 0.02;
const SIMPLE_INSIDE_RATIO: f64 = 0.35;

/// The model and what must stay solid: what the walls are measured against.
struct Limits<'a> {
    surface: &'a Bvh,
    spec: &'a CavitySpec<'a>,
}

impl Limits<'_> {
    /// Whether a triangle of the cavity, its corners `bias_mm` beyond the wall, leaves the wall and
    /// the keeps alone, but for `lack_mm`.
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

    /// The wall, or a smaller keep's radius: the same sag lets a triangle deeper into a smaller
    /// ball.
    fn smallest_radius_mm(&self) -> f64 {
        self.spec
            .keeps
            .iter()
            .map(|keep| keep.radius_mm)
            .fold(self.spec.wall_mm, f64::min)
    }
}

/// No point of a triangle is nearer to anything than √(D² − s²) if no corner is nearer to it than
/// D, where s² is this: Σ λᵢ |vᵢ − t|² = |x − t|² + Σ λᵢ |vᵢ − x|² for x = Σ λᵢ vᵢ, and the last
/// sum is at most the squared circumradius, or a quarter of the longest side's square where the
/// triangle is obtuse.
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

/// The distance from a keep's axis to a triangle.
fn keep_distance(keep: &Keep, corners: &[Point; 3]) -> f64 {
    crate::geom::triangle::segment_triangle_distance_squared(&keep.from, &keep.to, corners).sqrt()
}

/// The cavity's surface.
pub(super) fn extract(
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
            return Ok(simplified(
                drawn,
                Rules {
                    stray,
                    allows: &allows,
                },
            )?);
        }
    }
    Err(VoidError::WallNotKept {
        wall_mm: spec.wall_mm,
    })
}

/// The surface at the wall's distance plus the bias, refined until no triangle breaks the limits;
/// `None` if that cannot be had.
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
    let mut extractor = Extractor::new(&field, &aabb, resolution).ok_or(VoidError::TooFine {
        size_mm: aabb.size().max(),
        finest_mm: resolution.finest_mm,
    })?;
    let mut dirty = extractor.leaves();
    for round in 0..CHECK_ROUNDS {
        watch.advance(round as f64 / CHECK_ROUNDS as f64);
        stop_if_cancelled(watch)?;
        let drawn = extractor.settle(dirty);
        let refused = extractor.refused_leaves(&drawn, |corners| {
            limits.allow(corners, bias_mm, DRAWN_LACK_MM)
        });
        if refused.is_empty() {
            return Ok(Some(extractor.mesh()?));
        }
        dirty = extractor.divide(refused);
    }
    Ok(None)
}

fn stop_if_cancelled(watch: &Watch) -> Result<(), VoidError> {
    if watch.is_cancelled() {
        Err(VoidError::Cancelled)
    } else {
        Ok(())
    }
}
