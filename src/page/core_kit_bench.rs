//! The pictures of what is done on the bench: parts that pins join, and ballast on its panel.

use super::core_kit_view::{CoreView, ThingKind};
use super::figure::{Draft, Role};
use crate::draw::{Camera, Item, Label, Scene, Shot, view_direction};
use crate::geom::{Frame, Plane, Point, Vector};

/// Angles of the viewer beside the way of a unit and above it, radians. Pins stand about square to
/// that way, so they are seen from the side.
const BESIDE_UNIT: [f64; 2] = [0.45, 0.5];
/// Angles of the viewer beside the object and above the ground for its ballast, radians: a floor
/// is seen from above.
const ABOVE_FLOOR: [f64; 2] = [0.25, 0.7];
/// Distance of the cut from the nearest piece of ballast, mm, so that it stays whole.
const CUT_MM: f64 = 1.0;

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
    let way = view.apart[unit].try_normalize(0.0).unwrap_or(view.up);
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

/// Draws the base cut open in front of its ballast; `None` without any.
pub(super) fn ballast<'a>(view: &'a CoreView) -> Option<Draft<'a>> {
    let pieces = view.all(ThingKind::Ballast);
    let first = view.things.get(*pieces.first()?)?;
    let frame = Frame::with_axis(Point::origin(), &view.up);
    let front = -frame.axes.column(1).into_owned();
    let points = pieces
        .iter()
        .flat_map(|&at| view.things[at].mesh.vertices());
    let nearest_mm = points
        .map(|p| front.dot(&p.coords))
        .fold(f64::NEG_INFINITY, f64::max);
    let shown = (0..view.things.len()).filter(|&at| {
        let kind = view.things[at].kind;
        kind.is_base() || kind == ThingKind::Ballast
    });
    let shown: Vec<usize> = shown.collect();
    let items: Vec<Item> = shown.iter().map(|&at| view.item(at)).collect();
    let place = |at: usize| shown.iter().position(|&shown| shown == at);
    let named = pieces.iter().enumerate().filter_map(|(index, &at)| {
        let words = format!("{}", index + 1);
        Some(Label::Seen(place(at)?, words))
    });
    let panel = (0..view.things.len()).find(|&at| {
        let thing = &view.things[at];
        thing.kind == ThingKind::Panel && thing.unit == first.unit
    });
    let floor = panel.and_then(|at| Some(Label::Seen(place(at)?, view.things[at].id.clone())));
    let labels = named.chain(floor).collect();
    let words = [
        "The base cut open: the ballast lies on the lowest panel, inside.",
        "The base cut open, with the pieces of ballast on its floor.",
    ];
    let draft = view.draft("pictures/ballast.svg".to_owned(), items, words);
    let up = view.up;
    Some(Draft {
        role: Role::Ballast,
        shot: Shot {
            scene: Scene {
                cut: Some(Plane {
                    normal: front,
                    offset_mm: nearest_mm + CUT_MM,
                }),
                ..draft.shot.scene
            },
            camera: Camera::new(view_direction(&front, &up, ABOVE_FLOOR), up).with_label_margins(),
            labels,
            ..draft.shot
        },
        ..draft
    })
}
