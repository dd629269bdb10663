//! The bodies and ways in the pictures and the view of an object on a base.

use crate::draw::{BALLAST, Color, HARDWARE, Hatch, Item, PIN, part_color};
use crate::geom::Vector;
use crate::mesh::TriMesh;

/// A thing in its place in the model, as it is drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct ShownThing<'a> {
    /// Its id.
    pub id: String,
    /// Its mesh.
    pub mesh: &'a TriMesh,
    /// The index of its unit.
    pub unit: usize,
    /// The kind.
    pub kind: ThingKind,
    /// The way by which it is drawn off the first part of its unit where pins join parts of one
    /// unit, mm.
    pub bench: Vector,
}

/// The kind of a thing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ThingKind {
    /// A printed part of the shell.
    Part,
    /// A bracket, which is printed but belongs to the base.
    Bracket,
    /// A panel.
    Panel,
    /// A pin between two parts, with that on which it stands.
    Pin,
    /// A piece of ballast on a panel.
    Ballast,
    /// A rod between polyhedra.
    Rod,
}

impl ThingKind {
    /// Returns whether it is a printed piece of its own.
    pub fn is_printed(self) -> bool {
        matches!(self, Self::Part | Self::Bracket)
    }

    /// Returns whether it belongs to the base, and not to the shell.
    pub fn is_base(self) -> bool {
        matches!(self, Self::Panel | Self::Bracket | Self::Rod)
    }

    /// Returns its colour, and the filling of its cut faces, if it is of this unit.
    pub(super) fn look(self, unit: usize) -> (Color, Hatch) {
        match self {
            Self::Part | Self::Bracket => (part_color(unit), Hatch::PRINTED),
            Self::Panel => (HARDWARE, Hatch::RODS),
            Self::Pin => (PIN, Hatch::PRINTED),
            Self::Rod => (HARDWARE, Hatch::RODS),
            Self::Ballast => (BALLAST, Hatch::BALLAST),
        }
    }
}

/// A step of putting the object together.
#[derive(Debug, Clone, PartialEq)]
pub struct JoinStep {
    /// The name of what comes.
    pub name: String,
    /// The indices of the units that come.
    pub moving: Vec<usize>,
    /// The indices of the units that stand.
    pub standing: Vec<usize>,
    /// The direction in which it would leave again.
    pub way: Vector,
}

/// The bodies and ways in the pictures of an object on a base.
#[derive(Debug)]
pub struct CoreView<'a> {
    /// The parts and panels.
    pub things: &'a [ShownThing<'a>],
    /// The names of the units in the order in which they are joined.
    pub units: Vec<String>,
    /// The direction in which each unit leaves its own polyhedron, a unit vector.
    pub ways: Vec<Vector>,
    /// The ways by which units are drawn apart, each as a multiple of the usual one. They hold
    /// those of their polyhedra too.
    pub apart: Vec<Vector>,
    /// The number of each unit's polyhedron; `None` if there is one.
    pub polyhedra: Vec<Option<usize>>,
    /// The steps in which the object is put together.
    pub steps: Vec<JoinStep>,
    /// The direction that points up.
    pub up: Vector,
}

impl CoreView<'_> {
    /// Returns the index of a unit's first printed part.
    pub(super) fn first_of(&self, unit: usize) -> Option<usize> {
        let mut things = self.things.iter();
        things.position(|thing| thing.unit == unit && thing.kind.is_printed())
    }

    /// Returns a thing as it is drawn in its place.
    pub(super) fn item(&self, index: usize) -> Item<'_> {
        let thing = &self.things[index];
        let (color, hatch) = thing.kind.look(thing.unit);
        Item {
            hatch,
            ..Item::new(thing.mesh, color)
        }
    }

    /// Returns the indices of all things of a kind.
    pub(super) fn all(&self, kind: ThingKind) -> Vec<usize> {
        let own = self.things.iter().enumerate();
        let own = own.filter(|(_, thing)| thing.kind == kind);
        own.map(|(index, _)| index).collect()
    }
}
