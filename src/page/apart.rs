//! The parts drawn apart along the cuts, with their names, their pins and the lines along which
//! they come together.

use super::figure::{Draft, Role};
use super::subject::{Subject, pins};
use crate::draw::{
    HARDWARE, Hatch, Item, Label, Scene, Shot, TEXT_PX, labelled_camera, part_color, still, turned,
};
use crate::geom::{Aabb, Frame, Parting, Point, Vector};
use crate::mass::Lump;
use crate::mesh::TriMesh;
use crate::verify::{Peg, PromisedPart};

/// How far parts are drawn apart, as a share of the model's longest side.
const APART_RATIO: f64 = 0.35;

/// Directions around the axis that are tried for the viewer.
const AZIMUTHS: usize = 24;

/// How far above the ground the viewer stands, radians.
const LIFT: f64 = 0.35;

/// The best cosine between the view and a cut's normal: the parts are seen side by side, and their
/// cut faces too.
const FACE_COSINE: f64 = 0.4;

/// What counts as the same base of a pin, mm.
const SAME_MM: f64 = 1e-6;

/// How far either half is drawn from its place, as a share of the model's longest side: the axle is
/// seen between them.
const HALVES_APART_RATIO: f64 = 0.2;

/// Where the viewer stands: to the right and above, radians, so that both outlines are seen one
/// over the other.
const TURN_AND_LIFT: [f64; 2] = [0.45, 0.5];

/// The parts in the model frame and how far each is drawn from its place.
pub(super) struct Apart<'a> {
    parts: &'a [TriMesh],
    cuts: &'a [Parting],
    shifts: Vec<Vector>,
}

/// How far each part is drawn from its place: away from every cut that is made where it lies, to
/// its own side.
pub(super) fn shifts(parts: &[TriMesh], cuts: &[Parting]) -> Vec<Vector> {
    let apart_mm = of_longest_side_mm(parts.iter());
    parts
        .iter()
        .map(|part| {
            cuts.iter()
                .map(|cut| away(cut, &part.aabb().center(), apart_mm))
                .sum()
        })
        .collect()
}

/// How far what has its centre here is drawn from a cut that parts `apart_mm`.
fn away(cut: &Parting, center: &Point, apart_mm: f64) -> Vector {
    if cut.acts_at(center) {
        cut.plane.normal * (0.5 * apart_mm * cut.plane.distance(center).signum())
    } else {
        Vector::zeros()
    }
}

/// How far ballast is drawn from its place: between the parts whose cut opens its pocket.
pub(super) fn lump_shift(lump: &Lump, partings: &[Parting], apart_mm: f64) -> Vector {
    let (center, reach_mm) = (Point::from(lump.center_mm), lump.shape.radius_mm());
    let past = partings
        .iter()
        .filter(|cut| cut.plane.distance(&center).abs() > reach_mm);
    past.map(|cut| away(cut, &center, apart_mm)).sum()
}

/// How far the parts of a scene are drawn apart at a cut, mm.
pub(super) fn apart_mm(items: &[Item]) -> f64 {
    of_longest_side_mm(items.iter().map(|item| item.mesh))
}

/// The same for meshes in place.
pub(super) fn of_longest_side_mm<'a>(meshes: impl Iterator<Item = &'a TriMesh>) -> f64 {
    let all = meshes
        .map(TriMesh::aabb)
        .fold(Aabb::EMPTY, |all, part| all.union(&part));
    APART_RATIO * all.size().max()
}

impl<'a> Apart<'a> {
    pub fn of(parts: &'a [TriMesh], cuts: &'a [Parting]) -> Self {
        Self {
            parts,
            cuts,
            shifts: shifts(parts, cuts),
        }
    }

    /// The picture, with a name for every part and pin.
    pub fn draft(&self, frame: &Frame, promised: &[PromisedPart]) -> Draft<'a> {
        let item = |(index, (mesh, &shift)): (usize, (&'a TriMesh, &Vector))| Item {
            mesh,
            color: part_color(index),
            shift,
            hatch: Hatch::PRINTED,
        };
        Draft {
            file: "pictures/parts.svg".to_owned(),
            role: Role::Exploded,
            caption: "The parts drawn apart along the cuts. Dashed lines show where each pin goes; a dashed leader ends at something hidden. N: pins, H: hardware, B: ballast."
                .to_owned(),
            alt: alt(promised),
            shot: Shot {
                scene: Scene {
                    items: self.parts.iter().zip(&self.shifts).enumerate().map(item).collect(),
                    cut: None,
                },
                camera: labelled_camera(self.toward_viewer(frame), frame.axis()),
                text_px: TEXT_PX,
                labels: self.labels(promised),
                keys: Vec::new(),
            },
        }
    }

    /// Where the parts are seen side by side, and the faces of the cuts a little.
    fn toward_viewer(&self, frame: &Frame) -> Vector {
        let direction = |index: usize| {
            let turn = std::f64::consts::TAU * index as f64 / AZIMUTHS as f64;
            turned(
                &frame.direction_to_model(&-Vector::y()),
                &frame.axis(),
                [turn, LIFT],
            )
        };
        let cost = |toward: &Vector| -> f64 {
            self.cuts
                .iter()
                .map(|cut| (cut.plane.normal.dot(toward).abs() - FACE_COSINE).powi(2))
                .sum()
        };
        let first = direction(0);
        let better = |best: Vector, next: Vector| {
            if cost(&next) < cost(&best) {
                next
            } else {
                best
            }
        };
        (1..AZIMUTHS).map(direction).fold(first, better)
    }

    fn labels(&self, promised: &[PromisedPart]) -> Vec<Label> {
        let name = |(index, part): (usize, &PromisedPart)| Label::On(index, part.id.clone());
        let names = promised.iter().enumerate().map(name);
        let pins = pins(promised)
            .filter_map(|(part, pin)| self.pin_labels(part, pin, promised))
            .flatten();
        names.chain(pins).collect()
    }

    /// The line from a pin to its socket, and the pin's name at its tip.
    fn pin_labels(&self, part: usize, pin: &Peg, promised: &[PromisedPart]) -> Option<[Label; 2]> {
        let center = Point::from(pin.center_mm);
        let is_mate = |socket: &Peg| {
            socket.id == pin.id && (Point::from(socket.center_mm) - center).norm() < SAME_MM
        };
        let mate = promised
            .iter()
            .position(|row| row.sockets.iter().any(is_mate))?;
        let tip = center + Vector::from(pin.axis) * pin.length_mm + self.shifts.get(part)?;
        Some([
            Label::Between([tip, center + self.shifts.get(mate)?]),
            Label::At(tip, pin.id.clone()),
        ])
    }
}

/// What is to be seen, in words.
fn alt(promised: &[PromisedPart]) -> String {
    let names: Vec<&str> = promised.iter().map(|part| part.id.as_str()).collect();
    let pins: Vec<&str> = pins(promised).map(|(_, pin)| pin.id.as_str()).collect();
    let pins = if pins.is_empty() {
        "no pins".to_owned()
    } else {
        format!("pins {}", pins.join(", "))
    };
    format!(
        "Exploded view of the parts {}, with {pins}.",
        names.join(", ")
    )
}

/// The picture; none where there are no halves on an axle.
pub(super) fn halves<'a>(
    subject: &Subject,
    parts: &'a [TriMesh],
    hardware: &'a [TriMesh],
) -> Option<Draft<'a>> {
    subject.hardware.iter().find(|piece| piece.what == "axle")?;
    let frame = subject.aim.frame();
    let apart_mm = HALVES_APART_RATIO
        * parts
            .iter()
            .map(TriMesh::longest_side_mm)
            .fold(0.0, f64::max);
    let height_mm = |part: &TriMesh| frame.to_local(&part.aabb().center()).z;
    let half = |(index, mesh): (usize, &'a TriMesh)| Item {
        shift: frame.axis() * (apart_mm * height_mm(mesh).signum()),
        ..still(mesh, part_color(index))
    };
    let items = parts
        .iter()
        .enumerate()
        .map(half)
        .chain(hardware.iter().map(|mesh| still(mesh, HARDWARE)));
    let name = |(index, mesh): (usize, &TriMesh)| {
        let id = subject
            .promised
            .get(index)
            .map_or("", |part| part.id.as_str());
        Label::On(
            index,
            format!("{} {id}", if height_mm(mesh) > 0.0 { "A:" } else { "B:" }),
        )
    };
    let rods = subject.hardware.iter().enumerate();
    let rods = rods.map(|(index, piece)| Label::On(parts.len() + index, piece.id.clone()));
    Some(Draft {
        file: "pictures/halves.svg".to_owned(),
        role: Role::Halves,
        caption: "Half A over half B on the axle, drawn apart, turned as they are to be glued: the outlines lie over each other.".to_owned(),
        alt: "The two halves of the yo-yo one above the other with the axle between them, their outlines turned alike.".to_owned(),
        shot: Shot {
            scene: Scene { items: items.collect(), cut: None },
            camera: labelled_camera(
                turned(&frame.direction_to_model(&-Vector::y()), &frame.axis(), TURN_AND_LIFT),
                frame.axis(),
            ),
            text_px: TEXT_PX,
            labels: parts.iter().enumerate().map(name).chain(rods).collect(),
            keys: Vec::new(),
        },
    })
}
