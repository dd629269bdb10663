//! The 3D view of a hollowed model: its parts in the goal's frame, taken apart along its cuts.

use maud::Markup;

use super::apart::{gap_for_mm, shift_of_lump, shifts};
use super::inserts::{lump_mesh, rod_mesh};
use super::stage::{self, Body, Stage, simplify_all};
use super::subject::{Subject, parts_in_model};
use crate::base::watch::{Cancelled, Watch};
use crate::draw::{BALLAST, HARDWARE, Hatch, PictureError, part_color};
use crate::geom::Vector;
use crate::mesh::TriMesh;

/// The 3D view of a kit, packed for the script of the page.
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    stage: Stage,
}

/// A body in the goal's frame, with the way by which it is drawn apart.
struct Item {
    body: Body,
    shift: Vector,
}

impl View {
    /// Packs the view of a kit; the same bytes on any number of threads. Takes about 10 µs per
    /// triangle of the parts.
    ///
    /// # Errors
    /// [`PictureError::Cancelled`] if the watch was stopped.
    pub fn of(subject: &Subject, watch: &Watch) -> Result<Self, PictureError> {
        let items = items(subject, watch)?;
        let shifts = items.iter().map(|item| item.shift.into()).collect();
        let bodies: Vec<Body> = items.into_iter().map(|item| item.body).collect();
        let stage = Stage::of_parts(&bodies, shifts)?;
        Ok(Self { stage })
    }
}

/// Returns the simplified parts, the hardware and the ballast in the goal's frame.
fn items(subject: &Subject, watch: &Watch) -> Result<Vec<Item>, Cancelled> {
    let in_place = parts_in_model(subject.parts);
    let shifts = shifts(&in_place, &subject.partings());
    let frame = subject.aim.frame();
    let simple = simplify_all(&in_place.iter().collect::<Vec<&TriMesh>>(), watch)?;
    let parts = subject.parts.iter().zip(simple).zip(&shifts).enumerate();
    let parts = parts.map(|(index, ((part, mesh), shift))| Item {
        body: Body {
            name: part.id.clone(),
            mesh: mesh.in_frame(&frame),
            color: part_color(index),
            hatch: Hatch::PRINTED,
        },
        shift: frame.direction_to_local(shift),
    });
    let mut items: Vec<Item> = parts.collect();
    items.extend(subject.hardware.iter().map(|piece| Item {
        body: Body {
            name: piece.id.clone(),
            mesh: rod_mesh(piece).in_frame(&frame),
            color: HARDWARE,
            hatch: Hatch::RODS,
        },
        shift: Vector::zeros(),
    }));
    let apart_mm = gap_for_mm(in_place.iter());
    items.extend(subject.ballast.iter().map(|order| Item {
        body: Body {
            name: order.id.clone(),
            mesh: lump_mesh(&order.lump).in_frame(&frame),
            color: BALLAST,
            hatch: Hatch::BALLAST,
        },
        shift: frame.direction_to_local(&shift_of_lump(&order.lump, &subject.partings(), apart_mm)),
    }));
    Ok(items)
}

/// Returns the view with its controls, hidden until the script finds that it can draw.
pub(super) fn viewer(view: &View) -> Markup {
    stage::viewer(&view.stage)
}
