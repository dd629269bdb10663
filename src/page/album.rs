//! The pictures of a kit: the model, the cut-away, the parts apart, and each part as it is printed.

use rayon::prelude::*;

use super::apart::{self, Apart, halves};
use super::curves;
use super::cut_drawing::{self, CutFace};
use super::figure::{Draft, Picture, Role};
use super::inertia;
use super::inserts::{drawn, drawn_lump};
use super::plate;
use super::subject::{Subject, parts_in_model};
use super::viewpoint::Viewpoint;
use crate::draw::{
    BALLAST, BODY, HARDWARE, Hatch, Item, Key, Label, PictureError, Scene, Shot, TEXT_PX, VOID,
    convex_section, part_color, still,
};
use crate::geom::{Parting, Point};
use crate::goal::GoalKind;
use crate::mesh::TriMesh;
use crate::sheet::Checklist;

/// The same on the cover, whose pictures are smaller, pixels: 7 points at 48 mm of height.
const COVER_TEXT_PX: f64 = 30.0;

/// Takes every picture; the same bytes on any number of threads.
pub fn album(subject: &Subject) -> Result<Vec<Picture>, PictureError> {
    let (outer, voids) = (subject.shells.outer_mesh(), subject.shells.inner_mesh());
    let view = Viewpoint::of(&outer, &subject.aim.frame()).through(subject);
    let in_place = parts_in_model(subject.parts);
    let partings = subject.partings();
    let apart = Apart::of(&in_place, &partings);
    let hardware: Vec<TriMesh> = subject.hardware.iter().map(drawn).collect();
    let lumps: Vec<TriMesh> = subject
        .ballast
        .iter()
        .map(|order| drawn_lump(&order.lump))
        .collect();
    let plates: Vec<[TriMesh; 2]> = subject
        .parts
        .iter()
        .map(|part| plate::under(&part.mesh.aabb()))
        .collect();
    let mut drafts = vec![
        model(&outer, &view, upright(subject.aim.kind)),
        cut_away([&outer, &voids], &view, subject),
        apart.draft(&subject.aim.frame(), subject.promised),
    ];
    let rod = |mesh| Item {
        hatch: Hatch::RODS,
        ..still(mesh, HARDWARE)
    };
    drafts
        .iter_mut()
        .for_each(|draft| draft.shot.scene.items.extend(hardware.iter().map(rod)));
    let lump = |mesh| Item {
        hatch: Hatch::BALLAST,
        ..still(mesh, BALLAST)
    };
    drafts[1].shot.scene.items.extend(lumps.iter().map(lump));
    let count = subject.parts.len();
    let names = subject
        .hardware
        .iter()
        .enumerate()
        .map(|(index, piece)| Label::On(count + index, piece.id.clone()));
    drafts[2].shot.labels.extend(names);
    add_ballast(&mut drafts[2].shot, subject, &lumps, &partings);
    drafts.extend(halves(subject, &in_place, &hardware));
    let of_parts = subject.parts.iter().zip(&plates).enumerate();
    drafts.extend(
        of_parts.map(|(index, (part, plate))| plate::draft(part, plate, part_color(index))),
    );
    drafts.par_iter().map(Draft::draw).collect()
}

/// Draws them; the same bytes on any number of threads.
pub fn drawings(
    sheet: &Checklist,
    subject: &Subject,
    faces: &[CutFace],
) -> Result<Vec<Picture>, PictureError> {
    let mut drawings = cut_drawing::drawings(sheet, faces);
    drawings.extend(inertia::pictures(sheet, subject)?);
    drawings.extend(curves::plots(sheet));
    Ok(drawings)
}

/// Adds the ballast to the parts drawn apart: between the parts whose cut opens its pocket.
fn add_ballast<'a>(
    shot: &mut Shot<'a>,
    subject: &Subject,
    lumps: &'a [TriMesh],
    partings: &[Parting],
) {
    let apart_mm = apart::apart_mm(&shot.scene.items);
    for (order, mesh) in subject.ballast.iter().zip(lumps) {
        let shift = apart::lump_shift(&order.lump, partings, apart_mm);
        shot.labels
            .push(Label::On(shot.scene.items.len(), order.id.clone()));
        shot.scene.items.push(Item {
            shift,
            ..still(mesh, BALLAST)
        });
    }
}

/// What the picture of the whole is called.
fn upright(kind: GoalKind) -> &'static str {
    match kind {
        GoalKind::Stand => "The object as it stands.",
        GoalKind::Float => "The object as it floats.",
        _ => "The object, its spin axis upright.",
    }
}

fn model<'a>(outer: &'a TriMesh, view: &Viewpoint, caption: &str) -> Draft<'a> {
    Draft {
        file: "pictures/model.png".to_owned(),
        role: Role::Cover,
        caption: caption.to_owned(),
        alt: format!("Shaded view from the side and a little above. {caption}"),
        shot: Shot {
            scene: Scene {
                items: vec![still(outer, BODY)],
                cut: None,
            },
            camera: view.camera,
            text_px: TEXT_PX,
            labels: Vec::new(),
            keys: Vec::new(),
        },
    }
}

fn cut_away<'a>(
    [outer, voids]: [&'a TriMesh; 2],
    view: &Viewpoint,
    subject: &Subject,
) -> Draft<'a> {
    let keys = [
        (true, Key::Cut(Hatch::PRINTED), "material"),
        (true, Key::Void, "void"),
        (
            !subject.hardware.is_empty(),
            Key::Cut(Hatch::RODS),
            "hardware",
        ),
        (
            !subject.ballast.is_empty(),
            Key::Cut(Hatch::BALLAST),
            "ballast",
        ),
    ];
    Draft {
        file: "pictures/cut-away.svg".to_owned(),
        role: Role::CutAway,
        caption: "Cut open from top to bottom.".to_owned(),
        alt: "The object cut open, its front half taken away. What is cut is striped: material orange, hardware and ballast grey; the \
              surfaces of the voids inside are blue."
            .to_owned(),
        shot: Shot {
            scene: Scene { items: vec![still(outer, BODY), still(voids, VOID)], cut: Some(view.cut) },
            camera: view.camera,
            text_px: COVER_TEXT_PX,
            labels: cut_names(view, subject),
            keys: keys.into_iter().filter(|(is_there, ..)| *is_there).map(|(_, key, words)| (key, words)).collect(),
        },
    }
}

/// The names of the hardware and the ballast that the cut-away passes through.
fn cut_names(view: &Viewpoint, subject: &Subject) -> Vec<Label> {
    let rods = subject
        .hardware
        .iter()
        .map(|piece| (&piece.id, drawn(piece)));
    let lumps = subject
        .ballast
        .iter()
        .map(|order| (&order.id, drawn_lump(&order.lump)));
    let is_cut = |mesh: &TriMesh| !convex_section(mesh, &view.cut).is_empty();
    let cut = rods.chain(lumps).filter(|(_, mesh)| is_cut(mesh));
    let on_cut = |at: Point| at - view.cut.normal * view.cut.distance(&at);
    cut.map(|(id, mesh)| Label::At(on_cut(mesh.aabb().center()), id.clone()))
        .collect()
}
