//! The view of an object on a base: units that leave along the normals of their panels.

use serde::Serialize;

use super::pack::{Body, PackedBody, simplify_all};
use super::{
    Named, PLAYER, Packed, Player, STAGE, Stage, Step, Toggle, WAYS, Words, columns, corners,
    packed,
};
use crate::base::watch::Watch;
use crate::draw::{HARDWARE, Hatch, PictureError, part_color};
use crate::geom::{Aabb, Frame, Point};
use crate::mesh::TriMesh;
use crate::page::core_kit_album::{CoreView, way_mm};

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
    /// The way, mm.
    way: [f64; 3],
}

impl Stage {
    /// Packs the view of an object on a base. It is taken apart in the reverse of the order in
    /// which it is put together, so what closes it leaves first.
    ///
    /// # Errors
    /// [`PictureError::Cancelled`] if the watch was stopped.
    pub fn of_units(view: &CoreView, watch: &Watch) -> Result<Self, PictureError> {
        let meshes: Vec<&TriMesh> = view.things.iter().map(|thing| thing.mesh).collect();
        let simple = simplify_all(&meshes, watch)?;
        let bodies = view.things.iter().zip(simple).map(|(thing, mesh)| Body {
            name: thing.id.clone(),
            mesh,
            color: if thing.is_panel {
                HARDWARE
            } else {
                part_color(thing.unit)
            },
            hatch: if thing.is_panel {
                Hatch::RODS
            } else {
                Hatch::PRINTED
            },
        });
        let bodies: Vec<Body> = bodies.collect();
        let upright = Frame::with_axis(Point::origin(), &view.up);
        let seen = bodies
            .iter()
            .map(|body| body.mesh.in_frame(&upright).aabb());
        let bounds = seen.fold(Aabb::EMPTY, |all, one| all.union(&one));
        let steps = view.steps.iter().rev().enumerate();
        let steps: Vec<Step> = steps
            .map(|(place, step)| Step {
                name: step.name.clone(),
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
            }),
        })
    }
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
        Leaving {
            bodies: own.map(|(index, _)| index).collect(),
            way: (step.way * long_mm).into(),
        }
    });
    let far = view.apart.iter().map(|way| way.norm() * long_mm);
    PackedWays {
        far: far.fold(0.0, f64::max),
        leave: steps.collect(),
    }
}

/// Returns controls for the shell and the base, and one for each unit.
fn toggles(view: &CoreView) -> Vec<Toggle> {
    let of = |wanted: &dyn Fn(usize) -> bool| {
        let own = (0..view.things.len()).filter(|&thing| wanted(thing));
        own.collect::<Vec<usize>>()
    };
    let whole = [
        ("shell", of(&|thing| !view.things[thing].is_base())),
        ("base", of(&|thing| view.things[thing].is_base())),
    ];
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
    whole.into_iter().chain(units).collect()
}
