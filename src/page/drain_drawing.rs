//! The drain holes, each as whoever looks straight into it sees it.

use rayon::prelude::*;

use super::figure::{Draft, Picture, Role};
use super::subject::{Subject, parts_in_model};
use crate::base::watch::Watch;
use crate::draw::{Camera, Item, Label, PictureError, Scene, Shot, TEXT_PX, VOID, part_color};
use crate::geom::{Point, Vector, orthonormal_basis};
use crate::mesh::TriMesh;
use crate::mesh::primitives::cylinder;
use crate::sheet::Checklist;
use crate::verify::PromisedHole;

/// Width and height of a picture, pixels.
const SIZE_PX: [usize; 2] = [560, 420];
/// Cosine to up from which a hole looks up or down: the picture then has another side above.
const STEEP_COSINE: f64 = 0.95;
/// Sides of the disc that marks a hole.
const SIDES: u32 = 48;

/// Draws the object once for each hole; the same bytes on any number of threads.
///
/// # Errors
/// A picture cannot be encoded, or the watch was stopped.
pub(super) fn pictures(
    sheet: &Checklist,
    subject: &Subject,
    watch: &Watch,
) -> Result<Vec<Picture>, PictureError> {
    if sheet.drains.is_empty() {
        return Ok(Vec::new());
    }
    let parts = parts_in_model(subject.parts);
    let up = subject.aim.frame().axis();
    let draw = |hole: &PromisedHole| {
        watch.check()?;
        draft(hole, &parts, &mark(hole), &up).draw()
    };
    sheet.drains.par_iter().map(draw).collect()
}

/// Returns a body that fills a hole, to be seen in its mouth.
fn mark(hole: &PromisedHole) -> TriMesh {
    let (from, to) = (Point::from(hole.from_mm), Point::from(hole.to_mm));
    let along = to - from;
    let axis = along.normalize();
    let (u, v) = orthonormal_basis(&axis);
    let disc = cylinder(0.5 * hole.diameter_mm, along.norm(), SIDES);
    disc.map_vertices(|p| from + u * p.x + v * p.y + axis * p.z)
}

fn draft<'a>(
    hole: &PromisedHole,
    parts: &'a [TriMesh],
    mark: &'a TriMesh,
    up: &Vector,
) -> Draft<'a> {
    let from = Point::from(hole.from_mm);
    let way = (from - Point::from(hole.to_mm)).normalize();
    let above = if way.dot(up).abs() < STEEP_COSINE {
        *up
    } else {
        orthonormal_basis(up).0
    };
    let parts = parts.iter().enumerate();
    let mut items: Vec<Item> = parts
        .map(|(index, mesh)| Item::new(mesh, part_color(index)))
        .collect();
    items.push(Item::new(mark, VOID));
    Draft {
        file: format!("pictures/{}.svg", hole.id),
        role: Role::Drain,
        alt: format!(
            "The object, seen straight into drain hole {}, which is blue.",
            hole.id
        ),
        caption: format!("Blue: drain hole {}, seen straight into it.", hole.id),
        shot: Shot {
            scene: Scene { items, cut: None },
            camera: Camera {
                size_px: SIZE_PX,
                ..Camera::new(way, above).with_label_margins()
            },
            text_px: TEXT_PX,
            labels: vec![Label::At(from, hole.id.clone())],
            keys: Vec::new(),
        },
    }
}
