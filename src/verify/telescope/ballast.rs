//! Ballast in the foot of a telescope: parts of stock that have room in their pocket.

use super::contact::Body;
use super::promise::TelescopePromise;
use crate::geom::Point;
use crate::mass::{Moments, moments_of_mesh};
use crate::verify::stock::is_of_stock;

/// Room that ballast must have on every side, mm: the film of glue may be thinner than drawn.
const ROOM_MM: f64 = 0.02;

/// Returns the moments of every shell with its cap, those of the root with its ballast.
pub(super) fn weighed(promise: &TelescopePromise, bodies: &[Body]) -> Vec<Moments> {
    let density_g_mm3 = promise.material.density_g_cm3 / crate::base::units::MM3_PER_CM3;
    let moments = bodies.iter().map(|body| moments_of_mesh(&body.mesh));
    let mut moments: Vec<Moments> = moments.collect();
    for piece in &promise.ballast {
        if let Some(root) = moments.first_mut() {
            *root += piece.lump.moments(density_g_mm3);
        }
    }
    moments
}

/// Returns the faults of ballast: what is no stock part, and what has no room in the root.
pub(super) fn faults(promise: &TelescopePromise, root: &Body) -> Vec<String> {
    let pieces = promise.ballast.iter().enumerate();
    let faults = pieces.flat_map(|(index, piece)| {
        let lump = &piece.lump;
        let is_stock = is_of_stock(&piece.id, lump);
        let (outline, radius_mm) = lump.outline();
        let has_room = |p: &Point| root.outside_mm(p) >= radius_mm + ROOM_MM;
        let number = index + 1;
        let strange = (!is_stock).then(|| format!("piece {number}: {} is no stock part", piece.id));
        let tight = (!outline.iter().all(has_room))
            .then(|| format!("piece {number} has no room in its pocket"));
        strange.into_iter().chain(tight)
    });
    faults.collect()
}
