//! The pictures of a kit: the model, the cut-away, the parts apart, and each part as it is printed.

use rayon::prelude::*;

use super::apart::{self, Apart, parts_in_model};
use super::figure::{Drawn, Picture, Role};
use super::halves;
use super::hardware::{drawn, drawn_lump};
use super::hatch::{Hatch, Key, legend};
use super::inserts::convex_section;
use super::palette::{BALLAST, BODY, HARDWARE, VOID, part_color};
use super::picture::{Camera, Color, Item, PictureError, Scene, render_seen};
use super::plate;
use super::projection::Projection;
use super::seen::Seen;
use super::svg::{Drawing, Mark};
use crate::geom::{Frame, Parting, Plane, Point, Vector};
use crate::goal::GoalKind;
use crate::mesh::TriMesh;
use crate::verify::{Aim, BallastOrder, Hardware, PartEvidence, Peg, PromisedPart, Shells};

/// Width and height of a picture, pixels: sharp at half the width of an A4 page, small enough to
/// mail.
const SIZE_PX: [usize; 2] = [720, 560];
/// Height of the words on a picture of the whole, pixels: 7 points at half the width of an A4 page.
pub(super) const TEXT_PX: f64 = 22.0;
/// The same on the cover, whose pictures are smaller, pixels: 7 points at 48 mm of height.
const COVER_TEXT_PX: f64 = 30.0;
/// The height of a legend, in heights of its words.
const LEGEND_TEXTS: f64 = 1.8;
/// How far from the left edge a legend begins, pixels.
const LEGEND_PX: f64 = 14.0;
/// The share of a picture left free for words at its sides.
const LABEL_RATIO: f64 = 0.12;
/// How far the viewer stands to the right of the cut's normal and above the ground, radians: enough
/// to tell depth from shape, not so much that the cut is foreshortened.
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
    /// The cuts between them, model frame.
    pub cuts: &'a [Parting],
    /// The goal: its axis points up in the pictures.
    pub aim: Aim,
    /// What is put in that is not printed, model frame.
    pub hardware: &'a [Hardware],
    /// The stock parts in their pockets, model frame.
    pub ballast: &'a [BallastOrder],
}

impl Sitting<'_> {
    /// The cuts along which the parts are drawn apart, and the plane between the halves of a yo-yo.
    pub(super) fn partings(&self) -> Vec<Parting> {
        let frame = self.aim.frame();
        let has_halves = self.hardware.iter().any(|piece| piece.what == "axle");
        let between = has_halves.then(|| Plane::through(&frame.origin, &frame.axis()));
        self.cuts
            .iter()
            .cloned()
            .chain(between.map(Parting::everywhere))
            .collect()
    }
}

/// The file of the picture of one part.
pub fn part_picture_file(id: &str) -> String {
    format!("pictures/{id}.svg")
}

/// Takes every picture; the same bytes on any number of threads.
pub fn album(sitting: &Sitting) -> Result<Vec<Picture>, PictureError> {
    let (outer, voids) = (sitting.shells.outer_mesh(), sitting.shells.inner_mesh());
    let view = View::of(&outer, &sitting.aim.frame()).through(sitting);
    let in_place = parts_in_model(sitting.parts);
    let partings = sitting.partings();
    let apart = Apart::of(&in_place, &partings);
    let hardware: Vec<TriMesh> = sitting.hardware.iter().map(drawn).collect();
    let lumps: Vec<TriMesh> = sitting
        .ballast
        .iter()
        .map(|order| drawn_lump(&order.lump))
        .collect();
    let plates: Vec<[TriMesh; 2]> = sitting
        .parts
        .iter()
        .map(|part| plate::under(&part.mesh.aabb()))
        .collect();
    let mut shots = vec![
        model_shot(&outer, &view, upright(sitting.aim.kind)),
        cut_away_shot([&outer, &voids], &view, sitting),
        apart.shot(&sitting.aim.frame(), sitting.promised),
    ];
    let rod = |mesh| Item {
        hatch: Hatch::RODS,
        ..still(mesh, HARDWARE)
    };
    shots
        .iter_mut()
        .for_each(|shot| shot.scene.items.extend(hardware.iter().map(rod)));
    let lump = |mesh| Item {
        hatch: Hatch::BALLAST,
        ..still(mesh, BALLAST)
    };
    shots[1].scene.items.extend(lumps.iter().map(lump));
    let count = sitting.parts.len();
    let names = sitting
        .hardware
        .iter()
        .enumerate()
        .map(|(index, piece)| Label::On(count + index, piece.id.clone()));
    shots[2].labels.extend(names);
    add_ballast(&mut shots[2], sitting, &lumps, &partings);
    shots.extend(halves::shot(sitting, &in_place, &hardware));
    let of_parts = sitting.parts.iter().zip(&plates).enumerate();
    shots
        .extend(of_parts.map(|(index, (part, plate))| plate::shot(part, plate, part_color(index))));
    shots.par_iter().map(Shot::take).collect()
}

/// Adds the ballast to the parts drawn apart: between the parts whose cut opens its pocket.
fn add_ballast<'a>(
    shot: &mut Shot<'a>,
    sitting: &Sitting,
    lumps: &'a [TriMesh],
    partings: &[Parting],
) {
    let apart_mm = apart::apart_mm(&shot.scene.items);
    for (order, mesh) in sitting.ballast.iter().zip(lumps) {
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
    /// What the legend below the picture names; none without entries.
    pub keys: Vec<(Key, &'static str)>,
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
        let is_bare = self.labels.is_empty() && self.keys.is_empty();
        let drawn = if is_bare {
            Drawn::Png(png)
        } else {
            Drawn::Svg(self.labelled(&png, &seen))
        };
        let (file, caption, alt) = (self.file.clone(), self.caption.clone(), self.alt.clone());
        Ok(Picture {
            file,
            role: self.role,
            caption,
            alt,
            drawn,
        })
    }

    /// The name of an item: at the middle of what is seen of it, or dashed at its own middle where
    /// it is hidden.
    fn named(&self, item: usize, words: &str, (projection, seen): (&Projection, &Seen)) -> Mark {
        let middle = || {
            let of = self
                .scene
                .items
                .get(item)
                .map(|item| item.mesh.aabb().center() + item.shift);
            projection.at(&of.unwrap_or(Point::origin()))
        };
        let spot = seen.middle_of(item);
        Mark {
            is_hidden: spot.is_none(),
            ..Mark::new(spot.unwrap_or_else(middle), words.to_owned())
        }
    }

    fn labelled(&self, png: &[u8], seen: &Seen) -> Drawing {
        let projection = Projection::of(&self.scene, &self.camera, 1);
        let [width, height] = self.camera.size_px;
        let below_px = if self.keys.is_empty() {
            0.0
        } else {
            LEGEND_TEXTS * self.text_px
        };
        let mut drawing = Drawing::new([width, height + below_px as usize], self.text_px);
        drawing.picture(png, self.camera.size_px, 1.0);
        legend(
            &mut drawing,
            [LEGEND_PX, height as f64 + 0.5 * below_px],
            &self.keys,
        );
        let mut marks = Vec::new();
        for label in &self.labels {
            match label {
                Label::At(point, words) => {
                    let at = projection.at(point);
                    let is_hidden = !seen.shows(at, projection.nearness_mm(point));
                    marks.push(Mark {
                        is_hidden,
                        ..Mark::new(at, words.clone())
                    });
                }
                Label::On(item, words) => marks.push(self.named(*item, words, (&projection, seen))),
                Label::Between(ends) => {
                    drawing.dashed(ends.each_ref().map(|end| projection.at(end)))
                }
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
        let normal = if size.x < size.y {
            Vector::x()
        } else {
            -Vector::y()
        };
        let cut = Plane::through(
            &frame.to_model(&local.center()),
            &frame.direction_to_model(&normal),
        );
        let toward = turned(&cut.normal, &frame.axis(), [TURN, LIFT]);
        Self {
            camera: camera(toward, frame.axis()),
            cut,
        }
    }

    /// The same with its cut through what is not printed: through the axis where there is hardware
    /// on it, else through the first piece of ballast.
    fn through(self, sitting: &Sitting) -> Self {
        let rods = (!sitting.hardware.is_empty()).then(|| sitting.aim.frame().origin);
        let lump = sitting
            .ballast
            .first()
            .map(|order| Point::from(order.lump.center_mm));
        let cut = rods
            .or(lump)
            .map_or(self.cut, |at| Plane::through(&at, &self.cut.normal));
        let margin_ratio = [
            if rods.or(lump).is_some() {
                LABEL_RATIO
            } else {
                0.0
            },
            0.0,
        ];
        Self {
            camera: Camera {
                margin_ratio,
                ..self.camera
            },
            cut,
        }
    }
}

/// A camera for pictures of the whole, without room for words.
pub(super) fn camera(toward_viewer: Vector, up: Vector) -> Camera {
    Camera {
        toward_viewer,
        up,
        size_px: SIZE_PX,
        margin_ratio: [0.0; 2],
    }
}

/// The same with room for words at its sides.
pub(super) fn labelled_camera(toward_viewer: Vector, up: Vector) -> Camera {
    Camera {
        margin_ratio: [LABEL_RATIO, 0.0],
        ..camera(toward_viewer, up)
    }
}

/// The direction to a viewer who faces `normal` from `turn` radians to the right and `lift` radians
/// above.
pub(super) fn turned(normal: &Vector, up: &Vector, [turn, lift]: [f64; 2]) -> Vector {
    let right = up.cross(normal);
    (normal * turn.cos() + right * turn.sin()) * lift.cos() + up * lift.sin()
}

pub(super) fn still(mesh: &TriMesh, color: Color) -> Item<'_> {
    Item {
        mesh,
        color,
        shift: Vector::zeros(),
        hatch: Hatch::PRINTED,
    }
}

fn model_shot<'a>(outer: &'a TriMesh, view: &View, caption: &str) -> Shot<'a> {
    Shot {
        file: "pictures/model.png".to_owned(),
        role: Role::Cover,
        caption: caption.to_owned(),
        alt: format!("Shaded view from the side and a little above. {caption}"),
        scene: Scene {
            items: vec![still(outer, BODY)],
            cut: None,
        },
        camera: view.camera,
        text_px: TEXT_PX,
        labels: Vec::new(),
        keys: Vec::new(),
    }
}

fn cut_away_shot<'a>([outer, voids]: [&'a TriMesh; 2], view: &View, sitting: &Sitting) -> Shot<'a> {
    let keys = [
        (true, Key::Cut(Hatch::PRINTED), "material"),
        (true, Key::Void, "void"),
        (
            !sitting.hardware.is_empty(),
            Key::Cut(Hatch::RODS),
            "hardware",
        ),
        (
            !sitting.ballast.is_empty(),
            Key::Cut(Hatch::BALLAST),
            "ballast",
        ),
    ];
    Shot {
        file: "pictures/cut-away.svg".to_owned(),
        role: Role::CutAway,
        caption: "Cut open from top to bottom.".to_owned(),
        alt: "The object cut open, its front half taken away. What is cut is striped: material orange, hardware and ballast grey; the \
              surfaces of the voids inside are blue."
            .to_owned(),
        scene: Scene { items: vec![still(outer, BODY), still(voids, VOID)], cut: Some(view.cut) },
        camera: view.camera,
        text_px: COVER_TEXT_PX,
        labels: cut_names(view, sitting),
        keys: keys.into_iter().filter(|(is_there, ..)| *is_there).map(|(_, key, words)| (key, words)).collect(),
    }
}

/// The names of the hardware and the ballast that the cut-away passes through.
fn cut_names(view: &View, sitting: &Sitting) -> Vec<Label> {
    let rods = sitting
        .hardware
        .iter()
        .map(|piece| (&piece.id, drawn(piece)));
    let lumps = sitting
        .ballast
        .iter()
        .map(|order| (&order.id, drawn_lump(&order.lump)));
    let is_cut = |mesh: &TriMesh| !convex_section(mesh, &view.cut).is_empty();
    let cut = rods.chain(lumps).filter(|(_, mesh)| is_cut(mesh));
    let on_cut = |at: Point| at - view.cut.normal * view.cut.distance(&at);
    cut.map(|(id, mesh)| Label::At(on_cut(mesh.aabb().center()), id.clone()))
        .collect()
}

/// The pins that stand out of a part, by the parts in the order of the sheet.
pub(super) fn pins(promised: &[PromisedPart]) -> impl Iterator<Item = (usize, &Peg)> {
    promised
        .iter()
        .enumerate()
        .flat_map(|(part, row)| row.pins.iter().map(move |pin| (part, pin)))
}
