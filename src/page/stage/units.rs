//! The view of an object on a base: units that leave along the normals of their panels.

use serde::Serialize;

use super::pack::{Body, PackedBody, simplify_all};
use super::{
    Named, PLAYER, Packed, Player, STAGE, Stage, Step, Toggle, WAYS, Words, columns, corners,
    packed,
};
use crate::base::watch::Watch;
use crate::draw::{PictureError, part_color};
use crate::geom::{Aabb, Frame, Point, Vector};
use crate::mesh::TriMesh;
use crate::page::core_kit_album::way_mm;
use crate::page::core_kit_view::{CoreView, ShownThing, ThingKind};

/// The motion that the script reads.
#[derive(Serialize)]
struct PackedWays {
    /// The steps in which all is taken apart.
    leave: Vec<Leaving>,
    /// The most by which units are moved out at the end, mm.
    far: f64,
}

/// A step: what leaves, and by which way.
#[derive(Serialize)]
struct Leaving {
    /// The indices of the bodies.
    bodies: Vec<usize>,
    /// The way of each body, in the same order, mm.
    ways: Vec<[f64; 3]>,
}

/// The name of the step in which the parts of each unit leave each other.
const ON_BENCH: &str = "parts of one panel, with their pins";

impl Stage {
    /// Packs the view of an object on a base. It is taken apart in the reverse of the order in
    /// which it is put together, so what closes it leaves first.
    ///
    /// # Errors
    /// [`PictureError::Cancelled`] if the watch was stopped.
    pub fn of_units(view: &CoreView, watch: &Watch) -> Result<Self, PictureError> {
        let meshes: Vec<&TriMesh> = view.things.iter().map(|thing| thing.mesh).collect();
        let simple = simplify_all(&meshes, watch)?;
        let bodies: Vec<Body> = view
            .things
            .iter()
            .zip(simple)
            .map(|(thing, mesh)| body(thing, mesh))
            .collect();
        let upright = Frame::with_axis(Point::origin(), &view.up);
        let seen = bodies
            .iter()
            .map(|body| body.mesh.in_frame(&upright).aabb());
        let bounds = seen.fold(Aabb::EMPTY, |all, one| all.union(&one));
        let names = view.steps.iter().rev().map(|step| step.name.clone());
        let names = names.chain(has_bench(view).then(|| ON_BENCH.to_owned()));
        let steps: Vec<Step> = names
            .enumerate()
            .map(|(place, name)| Step {
                name,
                to: place + 1,
            })
            .collect();
        let data = Packed {
            bounds: corners(&bounds),
            upright: columns(&upright.axes.transpose()),
            cuts_moved: false,
            items: bodies.iter().map(PackedBody::of).collect(),
            lines: Vec::new(),
            named: named(view),
            names_wait: true,
            steps: &steps,
            motion: ways(view),
        };
        Ok(Self {
            packed: packed(&data)?,
            toggles: toggles(view),
            scripts: &[STAGE, PLAYER, WAYS],
            words: Words {
                subject: "The object",
                slider: "Take apart",
                order: "Order in which it comes apart",
                line: None,
            },
            player: Some(Player {
                moves: steps.len(),
                steps,
                poses: Vec::new(),
            }),
        })
    }
}

fn body(thing: &ShownThing, mesh: TriMesh) -> Body {
    let (color, hatch) = thing.kind.look(thing.unit);
    Body {
        name: thing.id.clone(),
        mesh,
        color,
        hatch,
    }
}

/// Returns true if pins join parts of one unit, so that these leave each other last.
fn has_bench(view: &CoreView) -> bool {
    let mut things = view.things.iter();
    things.any(|thing| thing.bench != Vector::zeros())
}

/// Returns the name of each unit, beside its first part.
fn named(view: &CoreView) -> Vec<Named> {
    let units = view.units.iter().enumerate();
    let named = units.filter_map(|(unit, name)| {
        let body = view.first_of(unit)?;
        let words = name.clone();
        Some(Named { body, words })
    });
    named.collect()
}

fn ways(view: &CoreView) -> PackedWays {
    let long_mm = way_mm(view);
    let steps = view.steps.iter().rev().map(|step| {
        let things = view.things.iter().enumerate();
        let own = things.filter(|(_, thing)| step.moving.contains(&thing.unit));
        let bodies: Vec<usize> = own.map(|(index, _)| index).collect();
        Leaving {
            ways: vec![(step.way * long_mm).into(); bodies.len()],
            bodies,
        }
    });
    let bench = has_bench(view).then(|| Leaving {
        bodies: (0..view.things.len()).collect(),
        ways: view.things.iter().map(|thing| thing.bench.into()).collect(),
    });
    let most = |ways: &mut dyn Iterator<Item = f64>| ways.fold(0.0, f64::max);
    PackedWays {
        far: most(&mut view.apart.iter().map(|way| way.norm() * long_mm))
            + most(&mut view.things.iter().map(|thing| thing.bench.norm())),
        leave: steps.chain(bench).collect(),
    }
}

/// Returns controls for the shell and the base, and one for each unit.
fn toggles(view: &CoreView) -> Vec<Toggle> {
    let of = |wanted: &dyn Fn(usize) -> bool| {
        let own = (0..view.things.len()).filter(|&thing| wanted(thing));
        own.collect::<Vec<usize>>()
    };
    let kind = |thing: usize| view.things[thing].kind;
    let whole = [
        ("shell", of(&|thing| kind(thing) == ThingKind::Part)),
        ("base", of(&|thing| kind(thing).is_base())),
        ("rods", view.all(ThingKind::Rod)),
        ("pins", view.all(ThingKind::Pin)),
        ("ballast", view.all(ThingKind::Ballast)),
    ];
    let whole = whole.into_iter().filter(|(_, bodies)| !bodies.is_empty());
    let whole = whole.map(|(name, bodies)| Toggle {
        name: name.to_owned(),
        color: None,
        bodies,
    });
    let units = view.units.iter().enumerate().map(|(unit, name)| Toggle {
        name: name.clone(),
        color: Some(part_color(unit)),
        bodies: of(&|thing| view.things[thing].unit == unit),
    });
    whole.chain(units).collect()
}
