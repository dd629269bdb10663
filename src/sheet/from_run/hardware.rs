//! Hardware and dowels on the sheet, and the halves of a yo-yo.

use crate::base::units::{MM3_PER_CM3, show_mm};
use crate::cut::{CutPlan, PinSite};
use crate::hardware::{Kind, Piece};
use crate::mass::moments_of_mesh;
use crate::mesh::{TriMesh, bodies, winding_number};
use crate::run::{Placed, WrittenPart};
use crate::sheet::Half;
use crate::verify::{Hardware, HardwareKind};

/// Number of vertices of a part that are sampled to find its half.
const SAMPLED_VERTICES: usize = 8;

/// Returns the hardware as the judge reads it.
pub fn hardware(placed: &Placed) -> Vec<Hardware> {
    let pieces = placed.fitted.iter().flat_map(|fitted| &fitted.pieces);
    let numbered = pieces.enumerate();
    numbered.map(|(index, piece)| order(index, piece)).collect()
}

/// Warns of an axle that goes in by less than its diameter because the model is thin.
pub fn shallow_axle(placed: &Placed) -> Option<String> {
    let pieces = placed.fitted.iter().flat_map(|fitted| &fitted.pieces);
    let axle = pieces.into_iter().find(|piece| piece.kind == Kind::Axle)?;
    let (depth_mm, diameter_mm) = (axle.depth_mm, 2.0 * axle.bar.radius_mm);
    let words = || {
        let depth = show_mm(depth_mm);
        format!(
            "the axle goes {depth} deep into each half, less than its diameter: the model is thin at the spin point; glue it well, or take a thinner axle"
        )
    };
    (depth_mm < diameter_mm).then(words)
}

/// Returns the halves of a yo-yo, the one above the spin point first; empty for a single body.
pub fn halves(placed: &Placed) -> Vec<TriMesh> {
    if placed.string_gap_mm().is_none() {
        return Vec::new();
    }
    let axis = placed.goal().frame.axis();
    let height = |half: &TriMesh| axis.dot(&moments_of_mesh(half).centroid().coords);
    let mut halves = bodies(placed.solid().mesh());
    halves.sort_by(|a, b| height(b).total_cmp(&height(a)));
    halves
}

/// Returns the half of which a part is made: its winding numbers at the part's vertices are
/// greater. `None` if there are no halves.
pub fn half_of(written: &WrittenPart, halves: &[TriMesh]) -> Option<Half> {
    let corners = written.part.solid.mesh().vertices();
    let samples = || {
        corners
            .iter()
            .step_by(corners.len().div_ceil(SAMPLED_VERTICES).max(1))
    };
    let share = |half: &TriMesh| samples().map(|p| winding_number(half, p)).sum::<f64>();
    let shares = halves.iter().map(share).zip([Half::A, Half::B]);
    shares
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, half)| half)
}

fn order(index: usize, piece: &Piece) -> Hardware {
    let bar = &piece.bar;
    Hardware {
        id: format!("H{}", index + 1),
        kind: match piece.kind {
            Kind::Axle => HardwareKind::Axle,
            Kind::Ring => HardwareKind::Ring,
            Kind::Tip => HardwareKind::Tip,
            Kind::Stem => HardwareKind::Stem,
        },
        from_mm: bar.from.into(),
        to_mm: bar.to.into(),
        diameter_mm: 2.0 * bar.radius_mm,
        hole_mm: 2.0 * bar.hole_mm,
        round_end: bar.is_round,
        density_g_cm3: piece.density_g_cm3,
        mass_g: bar.moments().volume() * piece.density_g_cm3 / MM3_PER_CM3,
        depth_mm: piece.depth_mm,
        socket_mm: piece.bore_mm,
    }
}

/// Returns the dowels as the judge reads them.
pub fn dowels(plan: &CutPlan) -> Vec<Hardware> {
    plan.pins.iter().filter_map(dowel).collect()
}

fn dowel(pin: &PinSite) -> Option<Hardware> {
    let (dowel, bar) = (pin.dowel.as_ref()?, pin.dowel_bar()?);
    Some(Hardware {
        id: pin.id.to_string(),
        kind: HardwareKind::Dowel(dowel.rod.clone()),
        from_mm: bar.from.into(),
        to_mm: bar.to.into(),
        diameter_mm: pin.diameter_mm,
        hole_mm: 0.0,
        round_end: false,
        density_g_cm3: dowel.density_g_cm3,
        mass_g: bar.moments().volume() * dowel.density_g_cm3 / MM3_PER_CM3,
        depth_mm: dowel.length_mm / 2.0,
        socket_mm: pin.socket_diameter_mm,
    })
}
