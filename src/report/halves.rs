//! The halves of a yo-yo drawn apart along their axle, turned as they are to be glued.

use super::album::{Label, Shot, Sitting, TEXT_PX, labelled_camera, still, turned};
use super::figure::Role;
use super::palette::{HARDWARE, part_color};
use super::picture::{Item, Scene};
use crate::geom::Vector;
use crate::mesh::TriMesh;

/// How far either half is drawn from its place, as a share of the model's longest side: the axle is
/// seen between them.
const APART_RATIO: f64 = 0.2;
/// Where the viewer stands: to the right and above, radians, so that both outlines are seen one
/// over the other.
const TURN_AND_LIFT: [f64; 2] = [0.45, 0.5];

/// The picture; none where there are no halves on an axle.
pub(super) fn shot<'a>(
    sitting: &Sitting,
    parts: &'a [TriMesh],
    hardware: &'a [TriMesh],
) -> Option<Shot<'a>> {
    sitting.hardware.iter().find(|piece| piece.what == "axle")?;
    let frame = sitting.aim.frame();
    let apart_mm = APART_RATIO
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
        let id = sitting
            .promised
            .get(index)
            .map_or("", |part| part.id.as_str());
        Label::On(
            index,
            format!("{} {id}", if height_mm(mesh) > 0.0 { "A:" } else { "B:" }),
        )
    };
    let rods = sitting.hardware.iter().enumerate();
    let rods = rods.map(|(index, piece)| Label::On(parts.len() + index, piece.id.clone()));
    Some(Shot {
        file: "pictures/halves.svg".to_owned(),
        role: Role::Halves,
        caption: "Half A over half B on the axle, drawn apart, turned as they are to be glued: the outlines lie over each other.".to_owned(),
        alt: "The two halves of the yo-yo one above the other with the axle between them, their outlines turned alike.".to_owned(),
        scene: Scene { items: items.collect(), cut: None },
        camera: labelled_camera(
            turned(&frame.direction_to_model(&-Vector::y()), &frame.axis(), TURN_AND_LIFT),
            frame.axis(),
        ),
        text_px: TEXT_PX,
        labels: parts.iter().enumerate().map(name).chain(rods).collect(),
        keys: Vec::new(),
    })
}
