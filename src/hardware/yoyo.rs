//! A yo-yo's halves on their axle.

use super::bore::{Bore, prism};
use super::error::FitError;
use super::fitted::{Fitted, Kind, Piece};
use super::halves::{Halves, split_halves};
use super::workshop::Workshop;
use crate::base::units::MM3_PER_CM3;
use crate::geom::Point;
use crate::goal::Rod;
use crate::mass::RoundBar;
use crate::mesh::{Csg, Solid};

/// The depths in each half that an axle without a length is tried at, in its diameters. Beyond two
/// diameters it only adds mass on the axis, where mass helps least. With less than one it tears
/// out at the first drop.
const DEPTHS_DIAMETERS: [f64; 5] = [2.0, 1.75, 1.5, 1.25, 1.0];
/// The least length over which each half must hold the axle, in its diameters.
const LEAST_GRIP_DIAMETERS: f64 = 1.0;
/// The diameters of stock rods that are tried in place of one that is not held, mm.
const THINNER_MM: [f64; 7] = [6.0, 5.0, 4.0, 3.0, 2.5, 2.0, 1.5];
/// A length that rounding alone may take from a grip, mm.
const ROUNDING_MM: f64 = 1e-9;

/// Cuts the model across the axis at the spin point, bores it for the axle and moves its halves
/// `gap_mm` apart. `ring_g` is the mass of the fittings on the axle in the gap.
pub(super) fn fit(
    workshop: &Workshop,
    axle: Rod,
    gap_mm: f64,
    ring_g: f64,
) -> Result<Fitted, FitError> {
    let frame = &workshop.goal.frame;
    let radius_mm = workshop.bore_radius_mm(&axle);
    let depth_mm = depth_mm(workshop, &axle, gap_mm)?;
    let Halves { upper, lower } = split_halves(workshop, radius_mm)?;
    let socket_prism = prism(frame, radius_mm, [-depth_mm, depth_mm])?;
    let apart = |half: &Csg, side: f64| -> Result<_, FitError> {
        let shift = frame.axis() * (0.5 * side * gap_mm);
        Ok(half
            .subtract(&socket_prism)?
            .without_slivers()
            .to_mesh()?
            .map_vertices(|p| p + shift))
    };
    let (upper, lower) = rayon::join(|| apart(&upper, 1.0), || apart(&lower, -1.0));
    let solid = Solid::new(upper?.joined(&lower?))?;
    let seated = SeatedAxle {
        axle,
        length_mm: gap_mm + 2.0 * depth_mm,
        gap_mm,
    };
    Ok(Fitted {
        solid,
        pieces: pieces(workshop, &seated, ring_g),
        gap_mm,
    })
}

/// Returns the depth of the axle in each half, mm. It follows from the axle's length, or is the
/// first depth at which both halves have a wall around it.
fn depth_mm(workshop: &Workshop, axle: &Rod, gap_mm: f64) -> Result<f64, FitError> {
    let (mesh, frame) = (workshop.solid.mesh(), &workshop.goal.frame);
    if let Some(length) = axle.length {
        let depth_mm = 0.5 * (length.mm() - gap_mm);
        let sockets = sockets(workshop, axle, depth_mm);
        let is_through = sockets
            .iter()
            .all(|socket| socket.passes_through(mesh, frame));
        if !is_through {
            sockets
                .iter()
                .try_for_each(|socket| socket.check(mesh, frame))?;
        }
        return Ok(depth_mm);
    }
    let thinner = |diameter_mm: &f64| {
        let thin = axle.of_diameter(*diameter_mm);
        *diameter_mm < axle.diameter.mm() && held_depth_mm(workshop, &thin).is_some()
    };
    held_depth_mm(workshop, axle).ok_or_else(|| FitError::Grip {
        axle: *axle,
        thinner: THINNER_MM
            .into_iter()
            .find(thinner)
            .map(|diameter_mm| axle.of_diameter(diameter_mm)),
    })
}

/// Returns the first depth at which both halves hold an axle, mm; `None` if they do at none.
fn held_depth_mm(workshop: &Workshop, axle: &Rod) -> Option<f64> {
    let (mesh, frame) = (workshop.solid.mesh(), &workshop.goal.frame);
    let diameter_mm = axle.diameter.mm();
    let least_mm = LEAST_GRIP_DIAMETERS * diameter_mm - ROUNDING_MM;
    let holds = |socket: &Bore| {
        socket.check(mesh, frame).is_ok() && socket.held_mm(mesh, frame) >= least_mm
    };
    let depths = DEPTHS_DIAMETERS.map(|depth| depth * diameter_mm);
    depths
        .into_iter()
        .find(|&depth_mm| sockets(workshop, axle, depth_mm).iter().all(holds))
}

/// Returns the axle's sockets in the upper and the lower half.
fn sockets(workshop: &Workshop, axle: &Rod, depth_mm: f64) -> [Bore; 2] {
    [depth_mm, -depth_mm].map(|bottom_mm| socket(workshop, axle, bottom_mm))
}

/// Returns the axle's socket from the cut to a height above or below it.
fn socket(workshop: &Workshop, axle: &Rod, bottom_mm: f64) -> Bore {
    Bore {
        rod: Kind::Axle,
        radius_mm: workshop.bore_radius_mm(axle),
        wall_mm: workshop.allowances.wall_mm,
        mouth_mm: 0.0,
        bottom_mm,
    }
}

/// An axle between two halves.
struct SeatedAxle {
    axle: Rod,
    length_mm: f64,
    gap_mm: f64,
}

/// Returns the axle through the spin point, and the ring that stands for its fittings.
fn pieces(workshop: &Workshop, seated: &SeatedAxle, ring_g: f64) -> Vec<Piece> {
    let SeatedAxle {
        axle,
        length_mm,
        gap_mm,
    } = *seated;
    let at = |z: f64| workshop.goal.frame.to_model(&Point::new(0.0, 0.0, z));
    let about_q = |length_mm: f64, radius_mm| {
        RoundBar::plain(at(-0.5 * length_mm), at(0.5 * length_mm), radius_mm)
    };
    let rod = Piece {
        kind: Kind::Axle,
        bar: about_q(length_mm, axle.radius_mm()),
        density_g_cm3: axle.density_g_cm3,
        depth_mm: 0.5 * (length_mm - gap_mm),
        bore_mm: 2.0 * workshop.bore_radius_mm(&axle),
    };
    let around = RoundBar {
        hole_mm: axle.radius_mm(),
        ..about_q(gap_mm, 0.5 * axle.fitting_diameter_mm())
    };
    let ring = Piece {
        kind: Kind::Ring,
        bar: around,
        density_g_cm3: ring_g / around.moments().volume() * MM3_PER_CM3,
        depth_mm: 0.0,
        bore_mm: 0.0,
    };
    std::iter::once(rod)
        .chain((ring_g > 0.0).then_some(ring))
        .collect()
}
