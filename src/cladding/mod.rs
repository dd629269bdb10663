//! The shell of an object on a base: printed parts that leave along the normals of the panels.
//!
//! * [`cells()`] gives each face of the base its part of the space outside, by bisectors.
//! * [`Scene::divide`] cuts the model by the cells into [`Part`]s. A piece that reaches no panel
//!   grows on a neighbour as a [`Crumb`], or is pinned to a part, as its [`Holding`] says.
//! * [`barred_mm2`] tells if a body's way is free, from the triangles alone.
//!
//! * [`Scene::fit`] cuts parts for the printer's room by planes along the way of their cell, and
//!   [`Lie`] says how they lie in it.
//! * [`Scene::cup`] hollows a part from its panel's side.
//! * [`Scene::screws`] finds the places of screws, and [`PartScrews`] has their bosses, bores and
//!   holes.
//! * [`PartPins`] join parts of one panel, and limbs to what carries them.
//! * [`Scene::assembly`] gathers panels and parts in [`Unit`]s, and orders them. Where there is no
//!   order, the answer names the parts, and a [`FreeingCut`] that was tried.
//! * [`Scene::clad`] does all of it.
//! * [`Sides`] does it for a base of several polyhedra, each on its side of the planes between
//!   them.
//! * [`bolts`] finds the places of the bolts through their common panels, and [`rods()`] those of
//!   rods between panels over a gap. Each [`Rod`] has a [`RodBore`] in the parts.
//! * [`places_on`] finds those of ballast on a panel.
//!
//! All lengths are in mm, angles in radians.

mod bolts;
mod cells;
mod cups;
mod divide;
mod error;
mod floor;
mod joins;
mod knot;
mod lie;
mod ordering;
mod overlap;
mod part;
mod part_pins;
mod pins;
mod region;
mod rod_bore;
mod rods;
mod rooms;
mod screws;
mod shell;
mod sides;
mod spread;
mod units;

pub use bolts::{Bolt, BoltKit, bolts};
pub use cells::{Cell, cells};
pub use cups::{Cup, CupRequest, ShellStyle};
pub use divide::Scene;
pub use error::{CladdingError, FreeingCut, PartPlace, RodLack};
pub use floor::{FlatThing, places_on};
pub use lie::Lie;
pub use overlap::{barred_mm2, contact_mm2, face_mm2};
pub use part::{Crumb, Holding, Part};
pub use part_pins::{PartPins, PinRequest};
pub use region::{Bound, BoundKind, Region};
pub use rod_bore::RodBore;
pub use rods::{Rod, RodKit, RodRequest, STAND_MM, rods};
pub use rooms::Room;
pub use screws::{PartScrews, Screw, ScrewKit, ScrewRequest};
pub use shell::{CladShell, ShellRequest};
pub use sides::{HAND_MM2, Sides};
pub use units::{Assembly, Join, Unit};
