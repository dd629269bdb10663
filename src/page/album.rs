//! The pictures of a kit: the model, the cut-away, the parts apart, and each part in print pose.

use rayon::prelude::*;

use super::apart::{self, Apart, halves};
use super::below;
use super::curves;
use super::cut_drawing::{self, CutFace};
use super::drain_drawing;
use super::figure::{Draft, Picture, Role};
use super::inertia;
use super::inserts::{lump_mesh, rod_mesh};
use super::jig_drawing;
use super::joint_drawing;
use super::plate;
use super::plate_map;
use super::subject::{Subject, parts_in_model};
use super::viewpoint::Viewpoint;
use crate::base::watch::Watch;
use crate::draw::{
    BALLAST, BODY, HARDWARE, Hatch, Item, Key, Label, PictureError, Scene, Shot, TEXT_PX, VOID,
    convex_section, part_color,
};
use crate::geom::{Parting, Point, Vector};
use crate::goal::GoalKind;
use crate::mesh::TriMesh;
use crate::sheet::Checklist;

/// Height of the words on the cover, whose pictures are smaller, pixels: 10 points at 60 mm of
/// height.
const COVER_TEXT_PX: f64 = 33.0;
/// Distance by which a region of infill is drawn inside of its cavity, mm: less than a pixel.
const INSET_MM: f64 = 0.05;

/// The meshes that are put into the parts, model frame.
struct Inserts {
    hardware: Vec<TriMesh>,
    lumps: Vec<TriMesh>,
}

impl Inserts {
    fn of(subject: &Subject) -> Self {
        let lumps = subject.ballast.iter();
        Self {
            hardware: subject.hardware.iter().map(rod_mesh).collect(),
            lumps: lumps.map(|order| lump_mesh(&order.lump)).collect(),
        }
    }

    fn rods(&self) -> impl Iterator<Item = Item<'_>> {
        self.hardware.iter().map(|mesh| Item {
            hatch: Hatch::RODS,
            ..Item::new(mesh, HARDWARE)
        })
    }

    fn lumps(&self) -> impl Iterator<Item = Item<'_>> {
        self.lumps.iter().map(|mesh| Item {
            hatch: Hatch::BALLAST,
            ..Item::new(mesh, BALLAST)
        })
    }
}

/// Draws the model, the cut-away, the parts apart, the halves of a yo-yo and each part; the same
/// bytes on any number of threads.
///
/// # Errors
/// A picture cannot be encoded, or the watch was stopped.
pub fn render_pictures(subject: &Subject, watch: &Watch) -> Result<Vec<Picture>, PictureError> {
    let (outer, voids) = (subject.shells.outer_mesh(), subject.shells.inner_mesh());
    let view = Viewpoint::of(&outer, &subject.aim.frame()).through_inserts(subject);
    let in_place = parts_in_model(subject.parts);
    let partings = subject.partings();
    let inserts = Inserts::of(subject);
    let part_boxes = subject.parts.iter().map(|part| part.mesh.aabb());
    let plates: Vec<[TriMesh; 2]> = part_boxes.map(|part| plate::squares_under(&part)).collect();

    let mut whole = model(&outer, &view, upright_caption(subject.aim.kind));
    whole.shot.scene.items.extend(inserts.rods());
    let mut cut_away = cut_away([&outer, &voids], &view, subject);
    let regions = infilled_regions(subject, &voids);
    cut_away
        .shot
        .scene
        .items
        .extend(regions.iter().map(Region::item));
    cut_away.shot.scene.items.extend(inserts.rods());
    cut_away.shot.scene.items.extend(inserts.lumps());
    let apart = Apart::of(&in_place, &partings);
    let mut exploded = apart.draft(&subject.aim.frame(), subject.promised);
    add_inserts(&mut exploded.shot, subject, &inserts, &partings);

    let mut drafts = vec![whole, cut_away, exploded];
    drafts.extend(halves(subject, &in_place, &inserts.hardware));
    let parts = subject.parts.iter().zip(&plates).enumerate();
    drafts.extend(parts.map(|(index, (part, plate))| plate::draft(part, plate, part_color(index))));
    let draw = |draft: &Draft| {
        watch.check()?;
        draft.draw()
    };
    drafts.par_iter().map(draw).collect()
}

/// Draws the pictures that show numbers of the sheet: the cuts with their lengths, the mass
/// properties and the plots of the proof. The same bytes on any number of threads.
///
/// # Errors
/// A picture cannot be encoded, or the watch was stopped.
pub fn draw_figures(
    sheet: &Checklist,
    subject: &Subject,
    faces: &[CutFace],
    watch: &Watch,
) -> Result<Vec<Picture>, PictureError> {
    let ((plates, below), inertia) = rayon::join(
        || {
            rayon::join(
                || plate_map::pictures(sheet, subject, watch),
                || below::pictures(sheet, subject, watch),
            )
        },
        || inertia::pictures(sheet, subject, watch),
    );
    let mut drawings = plates?;
    drawings.extend(below?);
    drawings.extend(drain_drawing::pictures(sheet, subject, watch)?);
    drawings.extend(jig_drawing::pictures(sheet, subject, watch)?);
    drawings.extend(joint_drawing::drawings(sheet, faces));
    drawings.extend(cut_drawing::drawings(sheet, faces));
    drawings.extend(inertia?);
    drawings.extend(curves::plots(sheet));
    Ok(drawings)
}

/// Adds the hardware in its place to the parts drawn apart, and the ballast between the parts whose
/// cut opens its pocket, with their names.
fn add_inserts<'a>(
    shot: &mut Shot<'a>,
    subject: &Subject,
    inserts: &'a Inserts,
    partings: &[Parting],
) {
    for (piece, rod) in subject.hardware.iter().zip(inserts.rods()) {
        add_named(shot, rod, &piece.id);
    }
    let apart_mm = apart::apart_mm(&shot.scene.items);
    for (order, mesh) in subject.ballast.iter().zip(&inserts.lumps) {
        let shift = apart::shift_of_lump(&order.lump, partings, apart_mm);
        let lump = Item {
            shift,
            ..Item::new(mesh, BALLAST)
        };
        add_named(shot, lump, &order.id);
    }
}

fn add_named<'a>(shot: &mut Shot<'a>, item: Item<'a>, id: &str) {
    let index = shot.scene.items.len();
    shot.labels.push(Label::On(index, id.to_owned()));
    shot.scene.items.push(item);
}

/// Returns the caption of the picture of the whole.
fn upright_caption(kind: GoalKind) -> &'static str {
    match kind {
        GoalKind::Stand => "The object as it stands.",
        GoalKind::Float => "The object as it floats.",
        GoalKind::Match => "The object, the z axis of its model upright.",
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
                items: vec![Item::new(outer, BODY)],
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
    let is_infilled = subject.infill.is_some();
    let inside = if is_infilled {
        "Sparse infill is pale blue, with crossed stripes; of several densities the denser is darker."
    } else {
        "The surfaces of the voids inside are blue."
    };
    let keys = [
        (true, Key::Cut(Hatch::PRINTED), "material"),
        (!is_infilled, Key::Void, "void"),
        (is_infilled, Key::Cut(Hatch::SPARSE), "sparse infill"),
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
        alt: format!(
            "The object cut open, its front half taken away. Cut faces are striped: material orange, hardware and ballast grey. {inside}"
        ),
        shot: Shot {
            scene: Scene {
                items: vec![Item::new(outer, BODY), Item::new(voids, VOID)],
                cut: Some(view.cut),
            },
            camera: view.camera,
            text_px: COVER_TEXT_PX,
            labels: names_on_cut(view, subject),
            keys: keys
                .into_iter()
                .filter(|(is_there, ..)| *is_there)
                .map(|(_, key, words)| (key, words))
                .collect(),
        },
    }
}

/// A region of infill as it is drawn.
struct Region {
    mesh: TriMesh,
    hatch: Hatch,
}

impl Region {
    fn item(&self) -> Item<'_> {
        Item {
            hatch: self.hatch,
            ..Item::new(&self.mesh, VOID)
        }
    }
}

/// Returns the regions of infill: each with the regions in it as cavities.
///
/// Where surfaces touch, either would be drawn by chance. So each lies a little inside of the one
/// around it.
fn infilled_regions(subject: &Subject, voids: &TriMesh) -> Vec<Region> {
    if subject.infill.is_none() {
        return Vec::new();
    }
    let inner = subject.parts.iter().flat_map(|part| {
        let place = |region: &TriMesh| region.map_vertices(|p| part.pose.to_model(p));
        part.inner.iter().map(place).collect::<Vec<_>>()
    });
    let meshes: Vec<TriMesh> = std::iter::once(voids.reversed()).chain(inner).collect();
    let last = meshes.len() - 1;
    let region = |(index, mesh): (usize, &TriMesh)| {
        let steps = 2 * index + 1;
        let own = inset(mesh, steps);
        let within = meshes.get(index + 1);
        Region {
            mesh: match within {
                Some(within) => own.joined(&inset(within, steps + 1).reversed()),
                None => own,
            },
            hatch: match last {
                0 => Hatch::SPARSE,
                _ => Hatch::infill((last - index) as f64 / last as f64),
            },
        }
    };
    meshes.iter().enumerate().map(region).collect()
}

/// Returns a region smaller than it is by some steps.
fn inset(region: &TriMesh, steps: usize) -> TriMesh {
    let mut normals = vec![Vector::zeros(); region.vertices().len()];
    for (triangle, [a, b, c]) in region.triangles().iter().zip(region.iter_corners()) {
        let normal = (b - a).cross(&(c - a));
        for corner in triangle {
            normals[*corner as usize] += normal;
        }
    }
    let by_mm = INSET_MM * steps as f64;
    let moved = region.vertices().iter().zip(normals);
    let moved = moved.map(|(p, normal)| match normal.try_normalize(0.0) {
        Some(normal) => p - normal * by_mm,
        None => *p,
    });
    TriMesh::new(moved.collect(), region.triangles().to_vec()).unwrap_or_default()
}

/// Returns the names of the hardware and the ballast that the cut-away passes through.
fn names_on_cut(view: &Viewpoint, subject: &Subject) -> Vec<Label> {
    let rods = subject
        .hardware
        .iter()
        .map(|piece| (&piece.id, rod_mesh(piece)));
    let lumps = subject
        .ballast
        .iter()
        .map(|order| (&order.id, lump_mesh(&order.lump)));
    let is_cut = |mesh: &TriMesh| !convex_section(mesh, &view.cut).is_empty();
    let cut = rods.chain(lumps).filter(|(_, mesh)| is_cut(mesh));
    let on_cut = |at: Point| at - view.cut.normal * view.cut.distance(&at);
    cut.map(|(id, mesh)| Label::At(on_cut(mesh.aabb().center()), id.clone()))
        .collect()
}
