//! A top's tip and stem: rods in sockets along its axis.
//!
//! Mass on the axis adds to s_z and to the moments across the axis, but hardly to the moment about
//! it. So it raises the speed from which a top spins upright: ω² = g s_z/(I_c − I_b). Light and
//! thin rods cost least; their benefit is a contact that does not wear.

use super::bore::{Bore, prism};
use super::error::FitError;
use super::fitted::{Fitted, Kind, Piece};
use super::workshop::Workshop;
use crate::geom::Point;
use crate::goal::{Rod, height_over_origin};
use crate::mass::RoundBar;
use crate::mesh::{Csg, Solid};

/// The length by which a socket is bored beyond the outer end of its rod, mm. No face of it then
/// lies in the plane in which the model begins.
const BEYOND_MM: f64 = 1e-3;

/// A rod along the axis, by the heights of its ends in the goal frame.
struct Standing {
    kind: Kind,
    rod: Rod,
    inner_mm: f64,
    outer_mm: f64,
}

/// Bores the sockets of the tip and the stem. The tip ends in the goal's origin.
pub(super) fn fit(
    workshop: &Workshop,
    tip: Option<Rod>,
    stem: Option<Rod>,
) -> Result<Fitted, FitError> {
    let tip = tip.map(|rod| Standing {
        kind: Kind::Tip,
        rod,
        inner_mm: rod.length_mm(),
        outer_mm: 0.0,
    });
    let stem = stem.map(|rod| standing_stem(workshop, rod)).transpose()?;
    let rods: Vec<Standing> = tip.into_iter().chain(stem).collect();
    let mut body = Csg::of_solid(workshop.solid)?;
    for rod in &rods {
        body = bore_socket(workshop, &body, rod)?;
    }
    let solid = Solid::new(body.without_slivers().to_mesh()?)?;
    let pieces = rods.iter().map(|rod| piece(workshop, rod)).collect();
    Ok(Fitted {
        solid,
        pieces,
        gap_mm: 0.0,
    })
}

/// Returns the stem, put in at the highest point at which the axis leaves the model.
fn standing_stem(workshop: &Workshop, rod: Rod) -> Result<Standing, FitError> {
    let (mesh, frame) = (workshop.solid.mesh(), &workshop.goal.frame);
    let heights = mesh.iter_corners().filter_map(|corners| {
        height_over_origin(corners.map(|corner| frame.to_local(&corner).coords), 0.0)
    });
    let top_mm = heights
        .max_by(f64::total_cmp)
        .ok_or(FitError::NoAxis(Kind::Stem.word()))?;
    Ok(Standing {
        kind: Kind::Stem,
        rod,
        inner_mm: top_mm - rod.depth_mm(),
        outer_mm: top_mm + rod.out_mm(),
    })
}

fn bore_socket(workshop: &Workshop, body: &Csg, rod: &Standing) -> Result<Csg, FitError> {
    let (frame, allowances) = (&workshop.goal.frame, workshop.allowances);
    let radius_mm = workshop.bore_radius_mm(&rod.rod);
    let inward = (rod.inner_mm - rod.outer_mm).signum();
    let mouth_mm = rod.inner_mm - inward * rod.rod.depth_mm();
    let (wall_mm, bottom_mm) = (allowances.wall_mm, rod.inner_mm);
    Bore {
        rod: rod.kind,
        radius_mm,
        wall_mm,
        mouth_mm,
        bottom_mm,
    }
    .check(workshop.solid.mesh(), frame)?;
    let beyond_mm = rod.outer_mm - inward * BEYOND_MM;
    let ends_mm = [rod.inner_mm.min(beyond_mm), rod.inner_mm.max(beyond_mm)];
    Ok(body.subtract(&prism(frame, radius_mm, ends_mm)?)?)
}

/// Returns a rod as a piece of hardware. A tip's end is round, a stem's flat.
fn piece(workshop: &Workshop, rod: &Standing) -> Piece {
    let at = |z: f64| workshop.goal.frame.to_model(&Point::new(0.0, 0.0, z));
    let plain = RoundBar::plain(at(rod.inner_mm), at(rod.outer_mm), rod.rod.radius_mm());
    Piece {
        kind: rod.kind,
        bar: RoundBar {
            is_round: rod.kind == Kind::Tip,
            ..plain
        },
        density_g_cm3: rod.rod.density_g_cm3,
        depth_mm: rod.rod.depth_mm(),
        bore_mm: 2.0 * workshop.bore_radius_mm(&rod.rod),
    }
}
