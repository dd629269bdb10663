//! The pictures of a kit: the model, the cut-away, the parts apart, and each part as it is printed.

use rayon::prelude::*;

use super::hardware::drawn;
use super::picture::{Camera, Color, Item, PictureError, Scene, render};
use crate::geom::{Aabb, Frame, Plane, Point, Vector};
use crate::goal::GoalKind;
use crate::mesh::TriMesh;
use crate::verify::{Aim, Hardware, PartEvidence, Shells};

/// Width and height of a picture, pixels: sharp at half the width of an A4 page, small enough to mail.
const SIZE_PX: [usize; 2] = [720, 560];
/// How far the viewer stands to the right of the cut's normal and above the ground, radians: enough to tell depth
/// from shape, not so much that the cut is foreshortened.
const TURN: f64 = 0.45;
const LIFT: f64 = 0.35;
/// How far above the plate the viewer of a part stands, radians: high enough to look into a hollow that is open upward.
const PART_LIFT: f64 = 0.7;
/// How far parts are drawn apart, as a share of the model's longest side.
const APART_RATIO: f64 = 0.3;

/// The surface of the model: grey.
const BODY: Color = [190, 194, 200];
/// The inside of a void: blue, light enough to show its shading.
const VOID: Color = [86, 180, 233];
/// Material seen where it is cut: vermilion. With blue it stays apart for every colour vision.
const SECTION: Color = [213, 94, 0];
/// Hardware: dark grey.
const HARDWARE: Color = [84, 88, 96];
/// Parts, in turn (Okabe and Ito, "Color universal design", 2008): told apart by every colour vision.
const PARTS: [Color; 6] =
    [[86, 180, 233], [230, 159, 0], [0, 158, 115], [240, 228, 66], [204, 121, 167], [0, 114, 178]];

/// A picture as a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Picture {
    /// Its path in the kit.
    pub file: String,
    /// What it shows, in a sentence.
    pub caption: String,
    /// The PNG file.
    pub png: Vec<u8>,
}

/// What the pictures are taken of.
#[derive(Debug, Clone, Copy)]
pub struct Sitting<'a> {
    /// The shells of the uncut result, model frame.
    pub shells: &'a Shells,
    /// The parts, print frame.
    pub parts: &'a [PartEvidence],
    /// The planes they were cut along, model frame.
    pub cuts: &'a [Plane],
    /// The goal: its axis points up in the pictures.
    pub aim: Aim,
    /// What is put in that is not printed, model frame.
    pub hardware: &'a [Hardware],
}

/// The file of the picture of one part.
pub fn part_picture_file(id: &str) -> String {
    format!("pictures/{id}.png")
}

/// Takes every picture; the same bytes on any number of threads.
pub fn album(sitting: &Sitting) -> Result<Vec<Picture>, PictureError> {
    let (outer, voids) = (sitting.shells.outer_mesh(), sitting.shells.inner_mesh());
    let view = View::of(&outer, &sitting.aim.frame());
    let upright = match sitting.aim.kind {
        GoalKind::Stand => "The model as it stands.",
        GoalKind::Float => "The model as it floats.",
        _ => "The model, its spin axis upright.",
    };
    let in_place = parts_in_model(sitting.parts);
    let mut shots = vec![
        model_shot(&outer, &view, upright),
        cut_away_shot(&outer, &voids, &view),
        exploded_shot(&in_place, &shifts(&in_place, sitting.cuts), &view),
    ];
    let hardware: Vec<TriMesh> = sitting.hardware.iter().map(drawn).collect();
    let whole = |mesh| Item { is_whole: true, ..still(mesh, HARDWARE) };
    shots.iter_mut().for_each(|shot| shot.scene.items.extend(hardware.iter().map(whole)));
    shots.extend(sitting.parts.iter().enumerate().map(|(index, part)| part_shot(index, part)));
    shots.par_iter().map(Shot::take).collect()
}

/// A picture before it is taken.
struct Shot<'a> {
    file: String,
    caption: String,
    scene: Scene<'a>,
    camera: Camera,
}

impl Shot<'_> {
    fn take(&self) -> Result<Picture, PictureError> {
        let png = render(&self.scene, &self.camera).to_png()?;
        Ok(Picture { file: self.file.clone(), caption: self.caption.clone(), png })
    }
}

/// How the model is looked at: upright, from the side that shows most of it.
struct View {
    camera: Camera,
    cut: Plane,
}

impl View {
    fn of(outer: &TriMesh, frame: &Frame) -> Self {
        let local = outer.in_frame(frame).aabb();
        let size = local.size();
        // The cut holds the axis and the wider side.
        let normal = if size.x < size.y { Vector::x() } else { -Vector::y() };
        let cut = Plane::through(&frame.to_model(&local.center()), &frame.direction_to_model(&normal));
        let toward = turned(&cut.normal, &frame.axis(), LIFT);
        Self { camera: Camera { toward_viewer: toward, up: frame.axis(), size_px: SIZE_PX }, cut }
    }
}

/// The direction to a viewer who faces `normal` from a little to the right and `lift` radians above.
fn turned(normal: &Vector, up: &Vector, lift: f64) -> Vector {
    let right = up.cross(normal);
    (normal * TURN.cos() + right * TURN.sin()) * lift.cos() + up * lift.sin()
}

fn still(mesh: &TriMesh, color: Color) -> Item<'_> {
    Item { mesh, color, shift: Vector::zeros(), is_whole: false }
}

fn model_shot<'a>(outer: &'a TriMesh, view: &View, caption: &str) -> Shot<'a> {
    Shot {
        file: "pictures/model.png".to_owned(),
        caption: caption.to_owned(),
        scene: Scene { items: vec![still(outer, BODY)], cut: None },
        camera: view.camera,
    }
}

fn cut_away_shot<'a>(outer: &'a TriMesh, voids: &'a TriMesh, view: &View) -> Shot<'a> {
    Shot {
        file: "pictures/cut-away.png".to_owned(),
        caption: "Cut open from top to bottom: material orange, voids blue.".to_owned(),
        scene: Scene { items: vec![still(outer, BODY), still(voids, VOID)], cut: Some((view.cut, SECTION)) },
        camera: view.camera,
    }
}

/// The parts' meshes in the model frame.
fn parts_in_model(parts: &[PartEvidence]) -> Vec<TriMesh> {
    parts.iter().map(|part| part.mesh.map_vertices(|p| part.pose.to_model(p))).collect()
}

/// How far each part is drawn from its place: away from every cut, to its own side.
fn shifts(parts: &[TriMesh], cuts: &[Plane]) -> Vec<Vector> {
    let all = parts.iter().map(TriMesh::aabb).fold(Aabb::EMPTY, |all, part| all.union(&part));
    let apart_mm = APART_RATIO * all.size().max();
    let side = |center: &Point, cut: &Plane| cut.normal * (0.5 * apart_mm * cut.distance(center).signum());
    parts.iter().map(|part| cuts.iter().map(|cut| side(&part.aabb().center(), cut)).sum()).collect()
}

fn exploded_shot<'a>(parts: &'a [TriMesh], shifts: &[Vector], view: &View) -> Shot<'a> {
    let item = |(index, (mesh, &shift)): (usize, (&'a TriMesh, &Vector))| Item {
        mesh,
        color: part_color(index),
        shift,
        is_whole: false,
    };
    Shot {
        file: "pictures/parts.png".to_owned(),
        caption: "The parts, drawn apart along the cuts.".to_owned(),
        scene: Scene { items: parts.iter().zip(shifts).enumerate().map(item).collect(), cut: None },
        camera: view.camera,
    }
}

fn part_shot(index: usize, part: &PartEvidence) -> Shot<'_> {
    Shot {
        file: part_picture_file(&part.id),
        caption: format!("{} as it lies on the plate.", part.id),
        scene: Scene { items: vec![still(&part.mesh, part_color(index))], cut: None },
        camera: Camera {
            toward_viewer: turned(&-Vector::y(), &Vector::z(), PART_LIFT),
            up: Vector::z(),
            size_px: SIZE_PX,
        },
    }
}

/// The colour of the part at that index, wherever it is drawn.
pub fn part_color(index: usize) -> Color {
    PARTS[index % PARTS.len()]
}
