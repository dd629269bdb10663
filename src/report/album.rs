//! The pictures of a kit: the model, the cut-away, the parts apart, and each part as it is printed.

use rayon::prelude::*;

use super::apart::{self, Apart, parts_in_model};
use super::figure::{Drawn, Picture, Role};
use super::halves;
use super::hardware::{drawn, drawn_lump};
use super::palette::{BALLAST, BODY, HARDWARE, SECTION, VOID, part_color};
use super::picture::{Camera, Color, Item, PictureError, Scene, render_seen};
use super::plate;
use super::projection::Projection;
use super::seen::Seen;
use super::svg::{Drawing, Mark};
use crate::geom::{Frame, Plane, Point, Vector};
use crate::goal::GoalKind;
use crate::mesh::TriMesh;
use crate::verify::{Aim, BallastOrder, Hardware, PartEvidence, Peg, PromisedPart, Shells};

/// Width and height of a picture, pixels: sharp at half the width of an A4 page, small enough to mail.
const SIZE_PX: [usize; 2] = [720, 560];
/// Height of the words on a picture of the whole, pixels: 7 points at half the width of an A4 page.
pub(super) const TEXT_PX: f64 = 22.0;
/// The share of a picture left free for words at its sides.
const LABEL_RATIO: f64 = 0.12;
/// How far the viewer stands to the right of the cut's normal and above the ground, radians: enough to tell depth
/// from shape, not so much that the cut is foreshortened.
const TURN: f64 = 0.45;
const LIFT: f64 = 0.35;

/// What the pictures are taken of.
#[derive(Debug, Clone, Copy)]
pub struct Sitting<'a> {
    /// The shells of the uncut result, model frame.
    pub shells: &'a Shells,
    /// The parts, print frame.
    pub parts: &'a [PartEvidence],
    /// What was promised of them, in the same order.
    pub promised: &'a [PromisedPart],
    /// The planes they were cut along, model frame.
    pub cuts: &'a [Plane],
    /// The goal: its axis points up in the pictures.
    pub aim: Aim,
    /// What is put in that is not printed, model frame.
    pub hardware: &'a [Hardware],
    /// The stock parts in their pockets, model frame.
    pub ballast: &'a [BallastOrder],
}

impl Sitting<'_> {
    /// The planes along which the parts are drawn apart: those of the cuts, and the one between the halves of a yo-yo.
    pub(super) fn partings(&self) -> Vec<Plane> {
        let frame = self.aim.frame();
        let has_halves = self.hardware.iter().any(|piece| piece.what == "axle");
        let between = has_halves.then(|| Plane::through(&frame.origin, &frame.axis()));
        self.cuts.iter().copied().chain(between).collect()
    }
}

/// The file of the picture of one part.
pub fn part_picture_file(id: &str) -> String {
    format!("pictures/{id}.svg")
}

/// Takes every picture; the same bytes on any number of threads.
pub fn album(sitting: &Sitting) -> Result<Vec<Picture>, PictureError> {
    let (outer, voids) = (sitting.shells.outer_mesh(), sitting.shells.inner_mesh());
    let view = View::of(&outer, &sitting.aim.frame());
    let in_place = parts_in_model(sitting.parts);
    let partings = sitting.partings();
    let apart = Apart::of(&in_place, &partings);
    let hardware: Vec<TriMesh> = sitting.hardware.iter().map(drawn).collect();
    let lumps: Vec<TriMesh> = sitting.ballast.iter().map(|order| drawn_lump(&order.lump)).collect();
    let plates: Vec<[TriMesh; 2]> =
        sitting.parts.iter().map(|part| plate::under(&part.mesh.aabb())).collect();
    let mut shots = vec![
        model_shot(&outer, &view, upright(sitting.aim.kind)),
        cut_away_shot([&outer, &voids], &view),
        apart.shot(&sitting.aim.frame(), sitting.promised),
    ];
    let whole = |mesh| Item { is_whole: true, ..still(mesh, HARDWARE) };
    shots.iter_mut().for_each(|shot| shot.scene.items.extend(hardware.iter().map(whole)));
    let count = sitting.parts.len();
    let names =
        sitting.hardware.iter().enumerate().map(|(index, piece)| Label::On(count + index, piece.id.clone()));
    shots[2].labels.extend(names);
    add_ballast(&mut shots[2], sitting, &lumps, &partings);
    shots.extend(halves::shot(sitting, &in_place, &hardware));
    let of_parts = sitting.parts.iter().zip(&plates).enumerate();
    shots.extend(of_parts.map(|(index, (part, plate))| plate::shot(part, plate, part_color(index))));
    shots.par_iter().map(Shot::take).collect()
}

/// Adds the ballast to the parts drawn apart: between the parts whose cut opens its pocket.
fn add_ballast<'a>(shot: &mut Shot<'a>, sitting: &Sitting, lumps: &'a [TriMesh], partings: &[Plane]) {
    let apart_mm = apart::apart_mm(&shot.scene.items);
    for (order, mesh) in sitting.ballast.iter().zip(lumps) {
        let (center, reach_mm) = (Point::from(order.lump.center_mm), order.lump.shape.radius_mm());
        let away = partings.iter().filter(|plane| plane.distance(&center).abs() > reach_mm);
        let shift = away.map(|plane| apart::away(plane, &center, apart_mm)).sum();
        shot.labels.push(Label::On(shot.scene.items.len(), order.id.clone()));
        shot.scene.items.push(Item { shift, ..still(mesh, BALLAST) });
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

/// A picture before it is taken.
pub(super) struct Shot<'a> {
    pub file: String,
    pub role: Role,
    pub caption: String,
    pub alt: String,
    pub scene: Scene<'a>,
    pub camera: Camera,
    /// The height of words, pixels, and what names things.
    pub text_px: f64,
    pub labels: Vec<Label>,
}

/// Words on a picture.
pub(super) enum Label {
    /// At the side, with a line to this point of the scene.
    At(Point, String),
    /// At the side, with a line to where most of this item is seen.
    On(usize, String),
    /// A line between two points of the scene.
    Between([Point; 2]),
    /// A length between two points of the scene, drawn this many pixels aside.
    Length([Point; 2], [f64; 2], String),
}

impl Shot<'_> {
    fn take(&self) -> Result<Picture, PictureError> {
        let (image, seen) = render_seen(&self.scene, &self.camera);
        let png = image.to_png()?;
        let drawn =
            if self.labels.is_empty() { Drawn::Png(png) } else { Drawn::Svg(self.labelled(&png, &seen)) };
        let (file, caption, alt) = (self.file.clone(), self.caption.clone(), self.alt.clone());
        Ok(Picture { file, role: self.role, caption, alt, drawn })
    }

    /// The name of an item: at the middle of what is seen of it, or dashed at its own middle where it is hidden.
    fn named(&self, item: usize, words: &str, (projection, seen): (&Projection, &Seen)) -> Mark {
        let middle = || {
            let of = self.scene.items.get(item).map(|item| item.mesh.aabb().center() + item.shift);
            projection.at(&of.unwrap_or(Point::origin()))
        };
        let spot = seen.middle_of(item);
        Mark { is_hidden: spot.is_none(), ..Mark::new(spot.unwrap_or_else(middle), words.to_owned()) }
    }

    fn labelled(&self, png: &[u8], seen: &Seen) -> Drawing {
        let projection = Projection::of(&self.scene, &self.camera, 1);
        let mut drawing = Drawing::new(self.camera.size_px, self.text_px);
        drawing.picture(png, 1.0);
        let mut marks = Vec::new();
        for label in &self.labels {
            match label {
                Label::At(point, words) => {
                    let at = projection.at(point);
                    let is_hidden = !seen.shows(at, projection.nearness_mm(point));
                    marks.push(Mark { is_hidden, ..Mark::new(at, words.clone()) });
                }
                Label::On(item, words) => marks.push(self.named(*item, words, (&projection, seen))),
                Label::Between(ends) => drawing.dashed(ends.each_ref().map(|end| projection.at(end))),
                Label::Length(ends, aside, words) => {
                    drawing.dimension(ends.each_ref().map(|end| projection.at(end)), *aside, words);
                }
            }
        }
        drawing.callouts(&marks);
        drawing
    }
}

/// How the model is looked at: upright, from the side that shows most of it.
#[derive(Debug, Clone, Copy)]
pub(super) struct View {
    /// From a little to the right and above.
    pub camera: Camera,
    /// The plane of the cut-away, through the axis and the wider side.
    pub cut: Plane,
}

impl View {
    pub fn of(outer: &TriMesh, frame: &Frame) -> Self {
        let local = outer.in_frame(frame).aabb();
        let size = local.size();
        // The cut holds the axis and the wider side.
        let normal = if size.x < size.y { Vector::x() } else { -Vector::y() };
        let cut = Plane::through(&frame.to_model(&local.center()), &frame.direction_to_model(&normal));
        let toward = turned(&cut.normal, &frame.axis(), [TURN, LIFT]);
        Self { camera: camera(toward, frame.axis()), cut }
    }
}

/// A camera for pictures of the whole, without room for words.
pub(super) fn camera(toward_viewer: Vector, up: Vector) -> Camera {
    Camera { toward_viewer, up, size_px: SIZE_PX, margin_ratio: 0.0 }
}

/// The same with room for words at its sides.
pub(super) fn labelled_camera(toward_viewer: Vector, up: Vector) -> Camera {
    Camera { margin_ratio: LABEL_RATIO, ..camera(toward_viewer, up) }
}

/// The direction to a viewer who faces `normal` from `turn` radians to the right and `lift` radians above.
pub(super) fn turned(normal: &Vector, up: &Vector, [turn, lift]: [f64; 2]) -> Vector {
    let right = up.cross(normal);
    (normal * turn.cos() + right * turn.sin()) * lift.cos() + up * lift.sin()
}

pub(super) fn still(mesh: &TriMesh, color: Color) -> Item<'_> {
    Item { mesh, color, shift: Vector::zeros(), is_whole: false }
}

fn model_shot<'a>(outer: &'a TriMesh, view: &View, caption: &str) -> Shot<'a> {
    Shot {
        file: "pictures/model.png".to_owned(),
        role: Role::Cover,
        caption: caption.to_owned(),
        alt: format!("Shaded view from the side and a little above. {caption}"),
        scene: Scene { items: vec![still(outer, BODY)], cut: None },
        camera: view.camera,
        text_px: TEXT_PX,
        labels: Vec::new(),
    }
}

fn cut_away_shot<'a>([outer, voids]: [&'a TriMesh; 2], view: &View) -> Shot<'a> {
    Shot {
        file: "pictures/cut-away.png".to_owned(),
        role: Role::CutAway,
        caption: "Cut open from top to bottom: material orange and hatched, voids blue.".to_owned(),
        alt: "The object cut open along its axis, its front half taken away. What is cut is orange with stripes; the \
              surfaces of the voids inside are blue."
            .to_owned(),
        scene: Scene { items: vec![still(outer, BODY), still(voids, VOID)], cut: Some((view.cut, SECTION)) },
        camera: view.camera,
        text_px: TEXT_PX,
        labels: Vec::new(),
    }
}

/// The pins that stand out of a part, by the parts in the order of the sheet.
pub(super) fn pins(promised: &[PromisedPart]) -> impl Iterator<Item = (usize, &Peg)> {
    promised.iter().enumerate().flat_map(|(part, row)| row.pins.iter().map(move |pin| (part, pin)))
}
