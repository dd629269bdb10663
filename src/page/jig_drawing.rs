//! The jigs, each with the parts that lie in it while their glue sets, in the parts' own colours.

use rayon::prelude::*;

use super::closing::{Closing, closings};
use super::figure::{Draft, Picture, Role};
use super::subject::{Subject, parts_in_model};
use super::viewpoint::Viewpoint;
use crate::base::watch::Watch;
use crate::draw::{HARDWARE, Item, Label, PictureError, Scene, Shot, part_color};
use crate::geom::{Frame, Vector};
use crate::mesh::TriMesh;
use crate::sheet::Checklist;
use crate::verify::PromisedJig;

/// Height of words, pixels: 10 points at half the width of an A4 page.
const TEXT_PX: f64 = 30.0;

/// Draws every jig with the bodies that meet in it; the same bytes on any number of threads.
///
/// # Errors
/// A picture cannot be encoded, or the watch was stopped.
pub(super) fn pictures(
    sheet: &Checklist,
    subject: &Subject,
    watch: &Watch,
) -> Result<Vec<Picture>, PictureError> {
    let jigs = parts_in_model(subject.jigs);
    let parts = parts_in_model(subject.parts);
    let closings = closings(sheet);
    let draw = |(promised, jig): (&PromisedJig, &TriMesh)| {
        watch.check()?;
        let ids = ids_in(&promised.joint, &closings);
        let held = subject.parts.iter().zip(&parts).enumerate();
        let held = held.filter(|(_, (part, _))| ids.contains(&part.id.as_str()));
        let held: Vec<(&str, Item)> = held
            .map(|(index, (part, mesh))| (part.id.as_str(), Item::new(mesh, part_color(index))))
            .collect();
        draft(promised, jig, held).draw()
    };
    let jigs = subject.promised_jigs.par_iter().zip(&jigs);
    jigs.map(draw).collect()
}

/// Returns the ids of the parts of both bodies that meet at a joint.
fn ids_in<'a>(joint: &str, closings: &[Closing<'a>]) -> Vec<&'a str> {
    let is_its = |closing: &&Closing| closing.joints.iter().any(|row| row.id == joint);
    let closing = closings.iter().find(is_its);
    closing.map_or_else(Vec::new, |closing| closing.sides.concat())
}

/// Returns the picture of parts in a jig, with the way out upward.
fn draft<'a>(promised: &PromisedJig, jig: &'a TriMesh, held: Vec<(&str, Item<'a>)>) -> Draft<'a> {
    let out = Vector::from(promised.out);
    let view = Viewpoint::of(jig, &Frame::with_axis(jig.aabb().center(), &out));
    let (id, joint) = (&promised.id, &promised.joint);
    let names = held.iter().map(|(id, _)| *id);
    let names: Vec<&str> = names.chain([id.as_str()]).collect();
    let items = held.iter().map(|(_, item)| *item);
    Draft {
        file: format!("pictures/{id}.svg"),
        role: Role::Jig,
        caption: format!("{id} holds the parts of {joint}: press them down and together."),
        alt: format!("Parts lie in {id}, a grey cradle under both sides of joint {joint}."),
        shot: Shot {
            scene: Scene {
                items: items.chain([Item::new(jig, HARDWARE)]).collect(),
                cut: None,
            },
            camera: view.camera.with_label_margins(),
            text_px: TEXT_PX,
            // A part behind another one would be named at a place where the other is seen.
            labels: names
                .into_iter()
                .enumerate()
                .map(|(index, name)| Label::Seen(index, name.to_owned()))
                .collect(),
            keys: Vec::new(),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_jig_is_drawn_with_both_bodies_of_its_joint_and_nothing_else() {
        let sheet = super::super::closing::tests::sheet(4, &[(1, 2, "C1"), (3, 4, "C2")]);
        assert_eq!(ids_in("J2", &closings(&sheet)), ["P03", "P04"]);
        assert!(ids_in("J9", &closings(&sheet)).is_empty());
    }

    #[test]
    fn a_body_glued_before_is_in_the_jig_whole() {
        let sheet = super::super::closing::tests::sheet(3, &[(1, 2, "C1"), (2, 3, "C2")]);
        assert_eq!(ids_in("J2", &closings(&sheet)), ["P01", "P02", "P03"]);
    }
}
