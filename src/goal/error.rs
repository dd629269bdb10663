//! The reasons why a goal cannot be placed in a model.

use super::hardware::Rod;
use super::request::RequestError;
use super::shafts::ShaftList;
use super::sites::Up;
use crate::base::setting::{Key, Setting};

/// The greatest distance of a point from the model, in lengths of the model. No tip reaches farther
/// than one length; beyond some thousands rounding would decide.
pub(super) const FAR_LENGTHS: f64 = 10.0;

/// A reason why a goal cannot be placed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GoalError {
    /// A vector without a direction.
    #[error("up = {0} is not a direction; give three finite numbers that are not all zero")]
    NoDirection(Up),
    /// The axis is still to be chosen.
    #[error("up = {0} is not a direction yet; choose one first")]
    NotChosen(Up),
    /// A point with a coordinate that is not a number.
    #[error("{name} = ({x}, {y}, {z}) is not a point; give three finite numbers in mm")]
    NotAPoint {
        /// The option's name.
        name: &'static str,
        /// Its x.
        x: f64,
        /// Its y.
        y: f64,
        /// Its z.
        z: f64,
    },
    /// A point far away from the model.
    #[error(
        "{name} lies more than {FAR_LENGTHS} times the model's length away from it; give a point \
         of the model, in mm of its \
         final size"
    )]
    FarAway {
        /// The option's name.
        name: &'static str,
    },
    /// The wall is zero, negative or not a number.
    #[error("a wall of {0} mm is not a wall; give a positive thickness")]
    NoWall(f64),
    /// The parts of the request do not go together.
    #[error(transparent)]
    Request(#[from] RequestError),
    /// A top that hangs from its contact.
    #[error(
        "the centre of mass lies {depth_mm:.3} mm below the contact point: that is a pendulum, \
         not a top; choose a contact below the centre, or turn the model over"
    )]
    ContactAboveCenter {
        /// The depth of the centre below the contact, mm.
        depth_mm: f64,
    },
    /// Nothing can hold the tip.
    #[error(
        "the spin axis passes through no part of the model above the contact point, so that no \
         tip can be put in; give another contact"
    )]
    NoSeat,
    /// A tip on which the top leans less than was asked for.
    #[error(
        "on this tip the top leans by {:.1}° before its body touches the floor, and {least_deg}° \
         are asked for; remedy: {}",
        rounded_down(*lean_deg),
        longer_tip(pin.as_ref(), *lean_deg)
    )]
    ShortTip {
        /// The lean on it, degrees.
        lean_deg: f64,
        /// The lean that was asked for, degrees.
        least_deg: f64,
        /// A stock pin that keeps it; `None` if none does.
        pin: Option<Rod>,
    },
    /// A top that was ordered without a tip, and whose contact hangs in the air.
    #[error(
        "the point it should spin on is {missing_mm:.1} mm below the model, and `{}` leaves the \
         tip out; remedy: type `{}`, or give another contact (`{}`)",
        Setting::new(Key::Tip, "none"),
        Setting::new(Key::Tip, "auto"),
        Setting::open(Key::Contact)
    )]
    NothingToSpinOn {
        /// The distance from the contact up along the axis to the surface, mm.
        missing_mm: f64,
    },
    /// A rotor without a bore, a shaft end or an order for a bore.
    #[error(
        "the model has no round bore and no shaft end to turn on; remedy: give the diameter of \
         the bore that will be made along the axis, such as `{}`",
        bore_to_make()
    )]
    NoShaft,
    /// A rotor that can turn on several axes.
    #[error(
        "the model can turn on {} axes, and only one can be balanced{found}",
        found.0.len()
    )]
    SeveralShafts {
        /// The axes.
        found: ShaftList,
    },
    /// No bore and no shaft end lies on the axis that was ordered.
    #[error(
        "no bore and no shaft end lies on the axis that was ordered{found}; remedy: `{}`, the \
         diameter of a bore that will be made there",
        bore_to_make()
    )]
    OffShaft {
        /// The axes that have one.
        found: ShaftList,
    },
    /// A support without area.
    #[error(
        "with {up} up it would stand on {}; which way is up? try `{instead}`, or give it a flat \
         foot",
        narrow_foot(*vertices)
    )]
    NoSupport {
        /// The direction that is up.
        up: Up,
        /// The number of vertices at the support plane.
        vertices: usize,
        /// The setting to try instead.
        instead: Setting,
    },
    /// A waterline above the model.
    #[error(
        "a waterline of {waterline_mm:.3} mm leaves nothing of {height_mm:.3} mm above the water; \
         give a lower one"
    )]
    UnderWater {
        /// The waterline asked for, mm above the lowest point.
        waterline_mm: f64,
        /// The height of the model, mm.
        height_mm: f64,
    },
    /// A match that is not told with what.
    #[error(
        "the goal match has no body to be like; remedy: give a file and its density (`{}`), or \
         its mass, centre of mass and inertia",
        Setting::new(Key::Like, "original.stl@2.70")
    )]
    NoTarget,
    /// The wanted centre of mass lies outside of the model.
    #[error(
        "the wanted centre of mass {} lies outside of the model, which reaches from {} to {} mm: \
         no infill brings it there; remedy: give it in mm of the model's final size",
        point(center_mm),
        point(low_mm),
        point(high_mm)
    )]
    CenterOutside {
        /// The wanted centre, mm.
        center_mm: [f64; 3],
        /// The lower corner of the model's box, mm.
        low_mm: [f64; 3],
        /// The upper corner of the model's box, mm.
        high_mm: [f64; 3],
    },
    /// The density is zero, negative or not a number.
    #[error("a density of {0} g/cm³ is not a density; give a positive one")]
    NoDensity(f64),
}

/// Words a point.
fn point([x, y, z]: &[f64; 3]) -> String {
    format!("({x:.2}, {y:.2}, {z:.2})")
}

/// Returns the setting that orders a bore where the model has none.
fn bore_to_make() -> Setting {
    Setting::new(Key::Bore, "6mm")
}

/// Words what to order in place of a tip that is too short. It is a stock pin that keeps the lean,
/// or the lean in whole degrees that the tip has.
fn longer_tip(pin: Option<&Rod>, lean_deg: f64) -> String {
    match pin {
        Some(pin) => format!("give `{}`", Setting::new(Key::Tip, pin)),
        None if lean_deg >= 1.0 => format!(
            "no stock pin does it; give `{}`, or another contact",
            Setting::new(Key::LeastLean, lean_deg.floor())
        ),
        None => "no stock pin does it; give another contact".to_owned(),
    }
}

/// Returns an angle in whole tenths of a degree, never more than it is.
fn rounded_down(deg: f64) -> f64 {
    (10.0 * deg).floor() / 10.0
}

/// Returns the words for the support of this many vertices, which has no area.
fn narrow_foot(vertices: usize) -> &'static str {
    if vertices == 1 {
        "one point"
    } else {
        "an edge"
    }
}
