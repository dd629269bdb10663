//! The exploded views: the parts drawn apart along the cuts with the lines along which they come
//! together. The halves of a yo-yo are drawn apart along their axle.

use super::figure::{Draft, Role};
use super::subject::{Subject, pins_by_part};
use crate::draw::{
    Camera, HARDWARE, Hatch, Item, Label, Scene, Shot, TEXT_PX, part_color, view_direction,
};
use crate::geom::{Aabb, Frame, Parting, Point, Vector};
use crate::mass::Lump;
use crate::mesh::TriMesh;
use crate::verify::{Peg, PromisedPart};

/// Distance by which parts are drawn apart, as a share of the model's longest side.
const APART_RATIO: f64 = 0.35;

/// Number of directions around the axis that are tried for the viewer.
const AZIMUTHS: usize = 24;

/// Angle of the viewer above the ground, radians.
const LIFT: f64 = 0.35;

/// Best cosine between the view and a cut's normal: it shows the parts side by side and their cut
/// faces too.
const FACE_COSINE: f64 = 0.4;

/// Distance up to which a pin and a socket count as mates, mm.
const SAME_MM: f64 = 1e-6;

/// Displacement of either half of a yo-yo, as a share of the model's longest side: it shows the
/// axle between them.
const HALVES_APART_RATIO: f64 = 0.2;

/// Angles of the viewer of the halves to the right and above, radians: both outlines are visible,
/// one over the other.
const HALVES_TURN_AND_LIFT: [f64; 2] = [0.45, 0.5];

/// The parts in the model frame, and their displacements.
pub(super) struct Apart<'a> {
    parts: &'a [TriMesh],
    cuts: &'a [Parting],
    shifts: Vec<Vector>,
}

/// Returns the displacement of each part: away from every cut that is made at its place, to its own
/// side.
pub(super) fn shifts(parts: &[TriMesh], cuts: &[Parting]) -> Vec<Vector> {
    let apart_mm = gap_for_mm(parts.iter());
    parts
        .iter()
        .map(|part| {
            cuts.iter()
                .map(|cut| shift_from(cut, &part.aabb().center(), apart_mm))
                .sum()
        })
        .collect()
}

/// Returns the displacement by one cut of a thing with this centre.
fn shift_from(cut: &Parting, center: &Point, apart_mm: f64) -> Vector {
    if cut.acts_at(center) {
        cut.plane.normal * (0.5 * apart_mm * cut.plane.distance(center).signum())
    } else {
        Vector::zeros()
    }
}

/// Returns the displacement of ballast, which is drawn between the parts whose cut opens its
/// pocket.
pub(super) fn shift_of_lump(lump: &Lump, partings: &[Parting], apart_mm: f64) -> Vector {
    let (center, reach_mm) = (Point::from(lump.center_mm), lump.shape.radius_mm());
    let past = partings
        .iter()
        .filter(|cut| cut.plane.distance(&center).abs() > reach_mm);
    past.map(|cut| shift_from(cut, &center, apart_mm)).sum()
}

/// Returns the gap that is drawn at each cut of a scene, mm.
pub(super) fn apart_mm(items: &[Item]) -> f64 {
    gap_for_mm(items.iter().map(|item| item.mesh))
}

/// Returns the gap that is drawn at each cut for meshes in place, mm.
pub(super) fn gap_for_mm<'a>(meshes: impl Iterator<Item = &'a TriMesh>) -> f64 {
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

    /// Returns the picture, with a name for every part and pin.
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
            caption: caption(promised),
            alt: alt_text(promised),
            shot: Shot {
                scene: Scene {
                    items: self
                        .parts
                        .iter()
                        .zip(&self.shifts)
                        .enumerate()
                        .map(item)
                        .collect(),
                    cut: None,
                },
                camera: Camera::new(self.toward_viewer(frame), frame.axis()).with_label_margins(),
                text_px: TEXT_PX,
                labels: self.labels(promised),
                keys: Vec::new(),
            },
        }
    }

    /// Returns the direction that shows the parts side by side and the cut faces a little.
    fn toward_viewer(&self, frame: &Frame) -> Vector {
        let direction = |index: usize| {
            let turn = std::f64::consts::TAU * index as f64 / AZIMUTHS as f64;
            view_direction(
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
        let pins = pins_by_part(promised)
            .filter_map(|(part, pin)| self.pin_labels(part, pin, promised))
            .flatten();
        names.chain(pins).collect()
    }

    /// Returns the line from a pin to its socket, and the pin's name at its tip. `None` if the pin
    /// has no socket.
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

/// Words what the picture shows.
fn caption(promised: &[PromisedPart]) -> String {
    let pins = if pins_by_part(promised).next().is_some() {
        " Dashed lines show where each pin (N) goes."
    } else {
        ""
    };
    format!("The parts drawn apart along the cuts.{pins}")
}

/// Describes the picture in words.
fn alt_text(promised: &[PromisedPart]) -> String {
    let names: Vec<&str> = promised.iter().map(|part| part.id.as_str()).collect();
    let pins: Vec<&str> = pins_by_part(promised)
        .map(|(_, pin)| pin.id.as_str())
        .collect();
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

/// Returns the picture of the halves of a yo-yo, turned as they are to be glued. `None` if there
/// are no halves on an axle.
pub(super) fn halves<'a>(
    subject: &Subject,
    parts: &'a [TriMesh],
    hardware: &'a [TriMesh],
) -> Option<Draft<'a>> {
    if !subject.has_halves() {
        return None;
    }
    let frame = subject.aim.frame();
    let apart_mm = HALVES_APART_RATIO
        * parts
            .iter()
            .map(TriMesh::longest_side_mm)
            .fold(0.0, f64::max);
    let height_mm = |part: &TriMesh| frame.to_local(&part.aabb().center()).z;
    let half = |(index, mesh): (usize, &'a TriMesh)| Item {
        shift: frame.axis() * (apart_mm * height_mm(mesh).signum()),
        ..Item::new(mesh, part_color(index))
    };
    let items = parts
        .iter()
        .enumerate()
        .map(half)
        .chain(hardware.iter().map(|mesh| Item::new(mesh, HARDWARE)));
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
    let front = frame.direction_to_model(&-Vector::y());
    let toward = view_direction(&front, &frame.axis(), HALVES_TURN_AND_LIFT);
    Some(Draft {
        file: "pictures/halves.svg".to_owned(),
        role: Role::Halves,
        caption: "Half A over half B on the axle, drawn apart, turned as they are to be glued: the outlines lie over each other.".to_owned(),
        alt: "The two halves of the yo-yo one above the other with the axle between them, their outlines turned alike.".to_owned(),
        shot: Shot {
            scene: Scene { items: items.collect(), cut: None },
            camera: Camera::new(toward, frame.axis()).with_label_margins(),
            text_px: TEXT_PX,
            labels: parts.iter().enumerate().map(name).chain(rods).collect(),
            keys: Vec::new(),
        },
    })
}
