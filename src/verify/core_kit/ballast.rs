//! Ballast on a panel: it lies flat on its inner side, within the base, and in nothing else.

use super::error::CoreVerifyError;
use super::evidence::CoreEvidence;
use super::flat::is_inside;
use super::panels::{panel_body, shared_mm3};
use super::promise::BallastPromise;
use crate::geom::{Frame, Point, Vector};
use crate::mass::rims;
use crate::mesh::{TriMesh, primitives};
use crate::repair::weld;
use crate::verify::stock::is_of_stock;

/// Number of sides of a piece's body.
const SIDES: u32 = 48;
/// By how much a place may be off, mm.
const NEAR_MM: f64 = 1e-3;
/// By how much the cosine of two axes may be off 1.
const AXIS_SLACK: f64 = 1e-9;
/// The greatest volume of a piece in anything else, mm³: faces that touch.
const SHARED_MM3: f64 = 0.05;
/// Returns the body of a piece.
pub fn ballast_body(piece: &BallastPromise) -> TriMesh {
    let [axis, middle] = [piece.lump.axis, piece.lump.center_mm].map(Vector::from);
    let half_mm = piece.lump.shape.half_height_mm();
    let frame = Frame::with_axis(Point::from(middle - axis * half_mm), &axis);
    let radius_mm = piece.lump.shape.radius_mm();
    primitives::cylinder(radius_mm, 2.0 * half_mm, SIDES).map_vertices(|p| frame.to_model(p))
}

/// Returns what is wrong with the ballast, in words.
///
/// # Errors
/// The boolean engine fails.
pub fn ballast_faults(evidence: &CoreEvidence) -> Result<Vec<String>, CoreVerifyError> {
    let all = &evidence.promise.ballast;
    let mut faults = Vec::new();
    let bodies: Vec<TriMesh> = all.iter().map(ballast_body).collect();
    let panels = (0..evidence.panels.panels.len()).map(|panel| panel_body(evidence, panel));
    let others: Vec<TriMesh> = evidence.parts.iter().map(weld).chain(panels).collect();
    for (index, (piece, body)) in all.iter().zip(&bodies).enumerate() {
        let name = || format!("piece {} of {}", index + 1, piece.id);
        faults.extend(misplaced(evidence, piece).map(|why| format!("{} {why}", name())));
        let mut shared = 0.0;
        for other in others.iter().chain(&bodies[..index]) {
            shared += shared_mm3(body, other)?;
        }
        if shared > SHARED_MM3 {
            faults.push(format!("{} shares {shared:.1} mm³ with others", name()));
        }
    }
    Ok(faults)
}

/// Returns the reason why a piece does not lie on its panel within the base; `None` if it does.
fn misplaced(evidence: &CoreEvidence, piece: &BallastPromise) -> Option<&'static str> {
    let index = piece.panel.wrapping_sub(1);
    let bases = evidence.bases();
    let Some((base, _)) = evidence.base_of(&bases, index) else {
        return Some("lies on no panel");
    };
    let (frame, lump) = (evidence.frame(index), &piece.lump);
    let [axis, middle] = [lump.axis, lump.center_mm].map(Vector::from);
    let is_flat = (axis - frame.axis()).norm() <= AXIS_SLACK;
    let local = frame.to_local(&Point::from(middle));
    let half_mm = lump.shape.half_height_mm();
    let lies_mm = local.z + half_mm + evidence.promise.sheet.thickness_mm;
    let aside_mm = (local.x - piece.at_mm[0]).hypot(local.y - piece.at_mm[1]);
    if !is_flat || lies_mm.abs() > NEAR_MM || aside_mm > NEAR_MM {
        return Some("does not lie flat in its place");
    }
    let rim = rims(
        &Point::from(middle),
        &axis,
        [lump.shape.radius_mm(), half_mm],
    );
    let outline = &evidence.panels.panels[index].outline_mm;
    let on_panel = |p: &Point| {
        let local = frame.to_local(p);
        is_inside([local.x, local.y], outline)
    };
    if !rim.iter().all(on_panel) {
        return Some("reaches beyond its panel");
    }
    let is_within = |p: &Point| base.planes.iter().all(|plane| plane.distance(p) <= 0.0);
    if !rim.iter().all(is_within) {
        return Some("reaches out of the base");
    }
    (!is_of_stock(&piece.id, lump)).then_some("is not the part of its name in the catalogue")
}
