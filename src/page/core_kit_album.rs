//! The pictures of an object on a base: the whole, its units apart, its base, and each unit.

use rayon::prelude::*;

use super::core_kit_bench::{ballast, benches};
use super::core_kit_view::{CoreView, ThingKind};
use super::figure::{Draft, Picture, Role};
use crate::draw::{
    Camera, Item, Label, PictureError, Scene, Shot, TEXT_PX, part_color, view_direction,
};
use crate::geom::{Aabb, Frame, Point, Vector};

/// Angles of the viewer to the right and above the ground, radians.
const TURN_AND_LIFT: [f64; 2] = [0.5, 0.35];
/// Way of units that are drawn apart, as a share of the longest side.
const APART_RATIO: f64 = 0.35;

/// Draws the pictures of an object on a base; the same bytes on any number of threads.
///
/// # Errors
/// A picture cannot be encoded.
pub fn draw_core(view: &CoreView) -> Result<Vec<Picture>, PictureError> {
    let mut drafts = vec![whole(view), apart(view), base(view)];
    drafts.extend(benches(view));
    drafts.extend(ballast(view));
    drafts.extend((0..view.steps.len()).map(|step| joined(view, step)));
    drafts.par_iter().map(Draft::draw).collect()
}

impl CoreView<'_> {
    /// Returns the direction to the viewer: from the side on which the object is widest.
    fn viewer(&self) -> Vector {
        let frame = Frame::with_axis(Point::origin(), &self.up);
        let points = self.things.iter().flat_map(|thing| thing.mesh.vertices());
        let points: Vec<Point> = points.map(|p| frame.to_local(p)).collect();
        let size = Aabb::of_points(&points).size();
        let side = if size.x < size.y {
            frame.axes.column(0).into_owned()
        } else {
            -frame.axes.column(1).into_owned()
        };
        view_direction(&side, &self.up, TURN_AND_LIFT)
    }

    pub(super) fn draft<'a>(
        &self,
        file: String,
        items: Vec<Item<'a>>,
        words: [&str; 2],
    ) -> Draft<'a> {
        let [caption, alt] = words.map(str::to_owned);
        Draft {
            file,
            role: Role::Cover,
            caption,
            alt,
            shot: Shot {
                scene: Scene { items, cut: None },
                camera: Camera::new(self.viewer(), self.up),
                text_px: TEXT_PX,
                labels: Vec::new(),
                keys: Vec::new(),
            },
        }
    }
}

fn whole<'a>(view: &'a CoreView) -> Draft<'a> {
    let printed = (0..view.things.len()).filter(|&at| view.things[at].kind.is_printed());
    let items = printed.map(|at| view.item(at)).collect();
    let words = ["The whole, its parts by unit.", "The object from the side."];
    view.draft("pictures/whole.png".to_owned(), items, words)
}

/// Returns the usual way of units that are drawn apart, mm.
pub(super) fn way_mm(view: &CoreView) -> f64 {
    let boxes = view.things.iter().map(|thing| thing.mesh.aabb());
    let size = boxes.fold(Aabb::EMPTY, |all, one| all.union(&one)).size();
    APART_RATIO * size.max()
}

/// Draws the units apart, each moved out along its way.
fn apart<'a>(view: &'a CoreView) -> Draft<'a> {
    let way_mm = way_mm(view);
    let items = (0..view.things.len()).map(|at| Item {
        shift: view.apart[view.things[at].unit] * way_mm,
        ..view.item(at)
    });
    let named = view.units.iter().enumerate().filter_map(|(unit, name)| {
        let at = view.first_of(unit)?;
        Some(Label::On(at, name.clone()))
    });
    let words = [
        "The units apart, each moved out the way it leaves.",
        "All units drawn apart, with their panels inside.",
    ];
    let draft = view.draft("pictures/apart.svg".to_owned(), items.collect(), words);
    Draft {
        role: Role::Exploded,
        shot: Shot {
            camera: Camera::new(view.viewer(), view.up).with_label_margins(),
            labels: named.collect(),
            ..draft.shot
        },
        ..draft
    }
}

/// Draws the panels and the rods together, each panel in a colour of its own.
fn base<'a>(view: &'a CoreView) -> Draft<'a> {
    let panels = (0..view.things.len()).filter(|&at| view.things[at].kind == ThingKind::Panel);
    let panels: Vec<usize> = panels.collect();
    let color = |&at: &usize| Item::new(view.things[at].mesh, part_color(view.things[at].unit));
    let names = panels.iter().enumerate();
    let labels = names.map(|(item, &at)| Label::On(item, view.things[at].id.clone()));
    let words = [
        "The base of panels.",
        "All panels together, with their names.",
    ];
    let rods = view.all(ThingKind::Rod);
    let items = panels.iter().chain(&rods).map(color).collect();
    let draft = view.draft("pictures/base.svg".to_owned(), items, words);
    Draft {
        role: Role::CutAway,
        shot: Shot {
            camera: Camera::new(view.viewer(), view.up).with_label_margins(),
            labels: labels.collect(),
            ..draft.shot
        },
        ..draft
    }
}

/// Draws what stands when something is joined, with that on its way in.
fn joined<'a>(view: &'a CoreView, index: usize) -> Draft<'a> {
    let step = &view.steps[index];
    let shift = step.way * way_mm(view);
    let items = (0..view.things.len()).filter_map(|at| {
        let unit = view.things[at].unit;
        let is_new = step.moving.contains(&unit);
        let item = Item {
            shift: if is_new { shift } else { Vector::zeros() },
            ..view.item(at)
        };
        (is_new || step.standing.contains(&unit)).then_some(item)
    });
    let name = &step.name;
    let caption = format!("{}. {name} comes in.", index + 1);
    let alt = format!("What stands, and {name} on its way in.");
    let file = format!("pictures/join-{:02}.png", index + 1);
    let draft = view.draft(file, items.collect(), [&caption, &alt]);
    Draft {
        role: Role::State,
        ..draft
    }
}
