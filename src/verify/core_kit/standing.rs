//! Mass, centre and toppling angle of the whole, from the files and the listed fasteners, rods and
//! glue.

use super::evidence::CoreEvidence;
use super::panels::panel_moments;
use crate::base::units::MM3_PER_CM3;
use crate::geom::{Frame, Point, Vector};
use crate::mass::moments_of_mesh;
use crate::verify::Support;

/// The mass of the whole and its balance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StandFacts {
    /// The mass, g.
    pub mass_g: f64,
    /// The centre of mass in the model frame, mm.
    pub centre: Point,
    /// The lean at which it topples, degrees; less than zero if it does not stand.
    pub toppling_deg: f64,
}

/// Weighs the whole, and finds the lean at which it topples.
pub fn measure_standing(evidence: &CoreEvidence) -> StandFacts {
    let promise = &evidence.promise;
    let print_g_mm3 = promise.material.density_g_cm3 / MM3_PER_CM3;
    let sheet_g_mm3 = promise.sheet.density_g_cm3 / MM3_PER_CM3;
    let parts = evidence.parts.iter().map(|mesh| {
        let moments = moments_of_mesh(mesh);
        (
            moments.volume() * print_g_mm3,
            moments.first() * print_g_mm3,
        )
    });
    let panels = (0..evidence.panels.panels.len()).map(|panel| {
        let (volume, first) = panel_moments(evidence, panel);
        (volume * sheet_g_mm3, first * sheet_g_mm3)
    });
    let held = promise
        .fasteners
        .iter()
        .map(|one| (one.mass_g, one.center_mm));
    let glued = promise
        .glue
        .iter()
        .map(|film| (film.mass_g, film.center_mm));
    let laid = promise.ballast.iter();
    let laid = laid.map(|piece| (piece.lump.mass_g, piece.lump.center_mm));
    let spanned = promise.rods.iter().map(|rod| (rod.mass_g, rod.center_mm));
    let points = held.chain(spanned).chain(glued).chain(laid);
    let points = points.map(|(mass_g, center)| (mass_g, Vector::from(center) * mass_g));
    let all = parts.chain(panels).chain(points);
    let (mass_g, first) = all.fold((0.0, Vector::zeros()), |(mass, first), (own, moment)| {
        (mass + own, first + moment)
    });
    let centre = Point::from(first / mass_g);
    let upright = Frame::with_axis(Point::origin(), &Vector::from(promise.up));
    // The model's own corners: those of cuts just above the floor carry nothing.
    let support = Support::of_mesh(&evidence.model, &upright);
    let lean_rad = support.toppling_angle(&upright.to_local(&centre));
    StandFacts {
        mass_g,
        centre,
        toppling_deg: lean_rad.to_degrees(),
    }
}
