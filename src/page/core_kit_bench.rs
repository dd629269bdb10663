//! The pictures of what is done on the bench: parts that pins join, and ballast on its panel.

use super::core_kit_view::{CoreView, ThingKind};
use super::figure::{Draft, Role};
use crate::draw::{Camera, Item, Label, Shot, view_direction};
use crate::geom::{Frame, Point, Vector};

/// Angles of the viewer beside the way of a unit and above it, radians. Pins stand about square to
/// that way, so they are seen from the side.
const BESIDE_UNIT: [f64; 2] = [0.45, 0.5];
/// Angles of the viewer beside the object and above the ground for its ballast, radians: a floor
/// is seen from above.
const ABOVE_FLOOR: [f64; 2] = [0.25, 0.7];
/// A panel is left out that faces the viewer by more than this, as a cosine.
const FACING: f64 = 0.1;

/// Draws the parts of each unit that pins join on the bench, apart, with their pins.
pub(super) fn benches<'a>(view: &'a CoreView) -> Vec<Draft<'a>> {
    let units = (0..view.units.len()).filter(|&unit| {
        let mut own = view.things.iter().filter(|thing| thing.unit == unit);
        own.any(|thing| thing.bench != Vector::zeros())
    });
    units.map(|unit| bench(view, unit)).collect()
}

fn bench<'a>(view: &'a CoreView, unit: usize) -> Draft<'a> {
    let own = (0..view.things.len()).filter(|&at| {
        let thing = &view.things[at];
        thing.unit == unit && matches!(thing.kind, ThingKind::Part | ThingKind::Pin)
    });
    let own: Vec<usize> = own.collect();
    let items = own.iter().map(|&at| Item {
        shift: view.things[at].bench,
        ..view.item(at)
    });
    let names = own.iter().enumerate();
    let names = names.filter(|(_, at)| view.things[**at].kind == ThingKind::Part);
    let labels = names.map(|(item, &at)| Label::Seen(item, view.things[at].id.clone()));
    let labels: Vec<Label> = labels.collect();
    let name = &view.units[unit];
    let caption =
        format!("{name}: its parts on the bench. The pins, in red, point into the sockets.");
    let alt = format!("The parts of {name} drawn apart, with pins that point to their sockets.");
    let file = format!("pictures/bench-{:02}.svg", unit + 1);
    let draft = view.draft(file, items.collect(), [&caption, &alt]);
    let way = view.ways[unit].try_normalize(0.0).unwrap_or(view.up);
    Draft {
        role: Role::Bench,
        shot: Shot {
            camera: camera(view, &way),
            labels,
            ..draft.shot
        },
        ..draft
    }
}

/// Returns a camera that looks at a unit from outside, a little from the side.
fn camera(view: &CoreView, way: &Vector) -> Camera {
    let frame = Frame::with_axis(Point::origin(), way);
    let flat = view.up - way * way.dot(&view.up);
    let up = flat.try_normalize(1e-3);
    let up = up.unwrap_or_else(|| frame.axes.column(0).into_owned());
    Camera::new(view_direction(way, &up, BESIDE_UNIT), up).with_label_margins()
}

/// Draws the polyhedron with the ballast, open towards the viewer; `None` without any.
pub(super) fn ballast<'a>(view: &'a CoreView) -> Option<Draft<'a>> {
    let pieces = view.all(ThingKind::Ballast);
    let floor = view.things.get(*pieces.first()?)?.unit;
    let frame = Frame::with_axis(Point::origin(), &view.up);
    let front = -frame.axes.column(1).into_owned();
    let toward = view_direction(&front, &view.up, ABOVE_FLOOR);
    let shown = (0..view.things.len()).filter(|&at| {
        let (kind, unit) = (view.things[at].kind, view.things[at].unit);
        let is_beside = view.polyhedra[unit] == view.polyhedra[floor];
        let is_behind = view.ways[unit].dot(&toward) < FACING;
        let is_seen = unit == floor || is_behind;
        (kind.is_base() || kind == ThingKind::Ballast) && is_beside && is_seen
    });
    let shown: Vec<usize> = shown.collect();
    let items: Vec<Item> = shown.iter().map(|&at| view.item(at)).collect();
    let named = shown.iter().enumerate().filter_map(|(item, &at)| {
        let thing = &view.things[at];
        let name = match thing.kind {
            ThingKind::Ballast => pieces.iter().position(|&piece| piece == at)? + 1,
            ThingKind::Panel if thing.unit == floor => {
                return Some(Label::Seen(item, thing.id.clone()));
            }
            _ => return None,
        };
        Some(Label::Seen(item, name.to_string()))
    });
    let labels = named.collect();
    let words = [
        "The base, open towards you: the ballast lies on the lowest panel, inside.",
        "The base without its sides in front, with the pieces of ballast on its floor.",
    ];
    let draft = view.draft("pictures/ballast.svg".to_owned(), items, words);
    Some(Draft {
        role: Role::Ballast,
        shot: Shot {
            camera: Camera::new(toward, view.up).with_label_margins(),
            labels,
            ..draft.shot
        },
        ..draft
    })
}
