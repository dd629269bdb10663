//! Junctures on the checklist: their parts, their joints, and what the shop is told of them.

use super::divide::NO_CUT;
use super::ends::last;
use super::made::Workshop;
use super::tree::Tree;
use super::written::{Division, WrittenJuncture, WrittenPiece};
use crate::base::digest::sha256_hex;
use crate::base::numbers::measured_extent;
use crate::base::units::MM3_PER_CM3;
use crate::cut::{Cut, JointNote, PartId};
use crate::geom::Vector;
use crate::mass::moments_of_mesh;
use crate::printer::Support;
use crate::sheet::from_run::{mark, pin, pin_warning, socket};
use crate::sheet::network::{JunctureJointRow, JunctureRow};
use crate::verify::{DividedPromise, JuncturePartPromise, JuncturePromise, PromisedCut};

/// Returns what is promised of a juncture.
pub fn promise(workshop: &Workshop, own: &WrittenJuncture) -> JuncturePromise {
    let clearance_mm = workshop.shop.printer.clearance_per_side_mm.value;
    let division = own.division.as_ref();
    JuncturePromise {
        id: own.id.clone(),
        parts: own
            .parts
            .iter()
            .map(|part| promised_part(part, division))
            .collect(),
        divided: division.map(|division| DividedPromise {
            volume_mm3: division.volume_mm3,
            clearance_mm,
            cuts: division.plan.cuts.iter().map(promised_cut).collect(),
        }),
    }
}

fn promised_part(own: &WrittenPiece, division: Option<&Division>) -> JuncturePartPromise {
    let cut = own.cut.as_ref().zip(division);
    let mut promise = JuncturePartPromise {
        id: own.id.clone(),
        file: own.file.clone(),
        sha256: sha256_hex(&[&own.bytes]),
        print_from_model: own.pose,
        pins: Vec::new(),
        sockets: Vec::new(),
        marks: Vec::new(),
    };
    if let Some((part, Division { plan, .. })) = cut {
        promise.pins = part.pins.iter().map(|site| pin(site, plan)).collect();
        promise.sockets = part.sockets.iter().map(|site| socket(site, plan)).collect();
        promise.marks = part.labels.iter().map(mark).collect();
    }
    promise
}

fn promised_cut(cut: &Cut) -> PromisedCut {
    PromisedCut {
        point_mm: cut.point_mm,
        normal: cut.normal,
    }
}

/// Returns the rows of the parts of a juncture.
pub fn rows<'a>(
    workshop: &'a Workshop,
    own: &'a WrittenJuncture,
) -> impl Iterator<Item = JunctureRow> + 'a {
    own.parts.iter().map(|part| JunctureRow {
        id: part.id.clone(),
        lies: part.lies.clone(),
        size_mm: part.read_back.aabb().size().into(),
        mass_g: moments_of_mesh(&part.read_back).volume() / MM3_PER_CM3
            * workshop.shop.material.density_g_cm3.value,
        is_free_of_support: workshop.shop.printer.support != Support::Breakaway,
    })
}

/// Returns the rows of the joints of a juncture, in the order in which they are glued.
pub fn joint_rows(own: &WrittenJuncture) -> impl Iterator<Item = JunctureJointRow> + '_ {
    let notes = own.division.iter().flat_map(|own| &own.plan.joints);
    notes.map(|note| JunctureJointRow {
        juncture: own.id.clone(),
        cut: note.cut.to_string(),
        parts: note.parts.map(|part| part_id(own, part)),
        area_mm2: note.area_mm2,
        pins: note.pins.len(),
        is_aligned: note.is_aligned(),
        note: pin_warning(note),
    })
}

fn part_id(own: &WrittenJuncture, part: PartId) -> String {
    let own = own.parts.get(part.index());
    own.map_or_else(|| part.to_string(), |own| own.id.clone())
}

/// Returns a warning for every juncture that the printer has no room for, and for every joint that
/// its pins do not align.
pub fn warnings(workshop: &Workshop, own: &WrittenJuncture) -> Vec<String> {
    let mut warnings = Vec::new();
    for part in &own.parts {
        let size_mm: [f64; 3] = part.read_back.aabb().size().into();
        if workshop.shop.printer.fits(size_mm) == Some(false) {
            warnings.push(format!(
                "{} is {}, larger than the printer's room, and stays whole: {}. Order a smaller \
                 size, balls as junctures, or a larger printer.",
                part.id,
                measured_extent(&size_mm),
                own.undivided.as_deref().unwrap_or(NO_CUT)
            ));
        }
    }
    let notes = own.division.iter().flat_map(|own| &own.plan.joints);
    let warn = |note: &JointNote| {
        let [below, above] = note.parts.map(|part| part_id(own, part));
        pin_warning(note).map(|why| format!("{below} and {above}: {why}."))
    };
    warnings.extend(notes.filter_map(warn));
    warnings
}

/// Returns a warning for the part of a cut juncture, counted from 0, that has its peg. It lies as
/// its cuts ask, so that the slicer may put supports there.
pub fn peg_warning(
    workshop: &Workshop,
    tree: &Tree,
    juncture: usize,
    own: &WrittenJuncture,
) -> Option<String> {
    own.division.as_ref()?;
    let is_free = workshop.shop.printer.support != Support::Breakaway;
    let mut limbs = tree.network.limbs.iter();
    let carrier = limbs
        .find(|limb| limb.to == juncture)
        .filter(|_| !is_free)?;
    let (_, mouth) = last(&carrier.telescope);
    let along: Vector = mouth.axes.column(0).into();
    let tip = mouth.origin - along * carrier.telescope.sizes.spigot_mm;
    let away_mm = |part: &WrittenPiece| {
        let mesh = part.in_model();
        let points = mesh.vertices().iter().map(|p| (p - tip).norm());
        points.fold(f64::INFINITY, f64::min)
    };
    let parts = own.parts.iter();
    let part = parts.min_by(|a, b| away_mm(a).total_cmp(&away_mm(b)))?;
    Some(format!(
        "{} has the peg for limb {}: keep supports off the peg.",
        part.id, carrier.id
    ))
}
