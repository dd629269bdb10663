//! A goal placed in a model, and the warnings that go with it.

use serde::{Deserialize, Serialize};

use super::hardware::Rod;
use super::kind::{GoalKind, Objective};
use super::lean::Lean;
use super::rotor::Spindle;
use super::target::Wanted;
use super::water::FloatConditions;
use crate::base::setting::{Key, Setting};
use crate::geom::Frame;
use crate::mass::Moments;
use crate::shell::Keep;

/// A goal placed in a model.
#[derive(Debug, Clone, PartialEq)]
pub struct Goal {
    /// The kind of goal.
    pub kind: GoalKind,
    /// The origin (contact, spin point, or the support's centroid) and z (spin axis, up) in model
    /// coordinates.
    pub frame: Frame,
    /// The objective; it suits the kind.
    pub objective: Objective,
    /// Stand: the convex support polygon, counterclockwise, goal frame, mm; empty for the others.
    pub support: Vec<[f64; 2]>,
    /// Balance: the rotor and its end planes; `None` for the others.
    pub spindle: Option<Spindle>,
    /// Float: the conditions for floating upright at the waterline; `None` for the others.
    pub afloat: Option<FloatConditions>,
    /// Match: the moments that it must have; `None` for the others.
    pub wanted: Option<Wanted>,
    /// The moments of the whole solid in the goal frame, mm.
    pub solid: Moments,
}

/// A goal, the regions that must stay solid for it, and warnings for the user.
#[derive(Debug, Clone, PartialEq)]
pub struct Placement {
    /// The goal.
    pub goal: Goal,
    /// The regions that must stay solid besides the wall, model coordinates.
    pub keeps: Vec<Keep>,
    /// Findings that do not stop the run.
    pub warnings: Vec<Warning>,
    /// Top: the part that touches the floor; `None` for the others, and if nothing is promised.
    pub footing: Option<Footing>,
}

/// The part of a top that touches the floor, and how far the top leans on it.
#[derive(Debug, Clone, PartialEq)]
pub enum Footing {
    /// A pin with a round end.
    Tip {
        /// The pin.
        rod: Rod,
        /// The lean on it.
        lean: Lean,
        /// Further pins, should this one not fit its socket; empty if it was ordered.
        spares: Vec<Rod>,
    },
    /// Its own foot.
    Foot {
        /// The lean on it.
        lean: Lean,
    },
}

impl Placement {
    /// Returns the air between the contact and the surface above it, mm; `None` if it touches.
    pub fn air_mm(&self) -> Option<f64> {
        self.warnings.iter().find_map(|warning| match warning {
            Warning::ContactInAir { missing_mm } => Some(*missing_mm),
            _ => None,
        })
    }
}

impl Footing {
    /// Returns how far the top leans.
    pub fn lean(&self) -> Lean {
        match self {
            Self::Tip { lean, .. } | Self::Foot { lean } => *lean,
        }
    }

    /// Returns the pin, `None` if the top spins on its own foot.
    pub fn tip(&self) -> Option<Rod> {
        match self {
            Self::Tip { rod, .. } => Some(*rod),
            Self::Foot { .. } => None,
        }
    }
}

/// A remark on the placement that the user should read.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, thiserror::Error)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub enum Warning {
    /// The contact point hangs below the surface.
    #[error(
        "the point it should spin on is {missing_mm:.1} mm below the model; add a tip (`{}`), or \
         give another contact (`{}`)",
        Setting::new(Key::Tip, "auto"),
        Setting::open(Key::Contact)
    )]
    ContactInAir {
        /// The distance from the contact up along the axis to the surface, mm.
        missing_mm: f64,
    },
    /// A top without a tip, as ordered, leans less than is promised with one.
    #[error(
        "it spins on its own foot, as ordered: more than the foot touches the floor when it leans \
         by {lean_deg:.1}°; for more put in a tip (`{}`)",
        Setting::new(Key::Tip, "auto")
    )]
    OnFoot {
        /// The lean at which more than the foot touches the floor, degrees.
        lean_deg: f64,
    },
    /// The contact needs a tip, and the model has no room for one.
    #[error(
        "the model does not hold a stock pin that is long enough for its lean at the contact, \
         and no longer than half of the model. Give \
         another contact (`{}`), another size (`{}`) or a tip of your own (`{}`)",
        Setting::open(Key::Contact),
        Setting::open(Key::Size),
        Setting::new(Key::Tip, "DIAMETERxLENGTHxDEPTH")
    )]
    NoTip,
    /// The top stands still on its foot instead of falling over. Its centre of mass is lower than
    /// the contact's radius of curvature.
    #[error(
        "it stands still on its foot without spinning, and rights itself when tilted by \
         {rights_to_deg:.0}°. Its contact moves as that of a ball of {radius_mm:.0} mm radius, and \
         its centre of mass is only {center_height_mm:.1} mm up. On such a foot it rubs, and does \
         not fall when it is slow. For a top that falls put in a tip piece (`{}`)",
        any_tip()
    )]
    FlatFoot {
        /// The radius of curvature of the contact over a tilt of a degree, mm.
        radius_mm: f64,
        /// The height of the centre of mass, mm.
        center_height_mm: f64,
        /// The tilt up to which it rights itself, degrees.
        rights_to_deg: f64,
    },
    /// The spin axis does not pass through the model above the contact.
    #[error(
        "the spin axis passes through no part of the model above the contact point; give another \
         contact"
    )]
    AxisMissesModel,
    /// A part of the model lies lower than the contact.
    #[error(
        "the model reaches {depth_mm:.1} mm below its contact point: it would touch the floor there \
         first"
    )]
    BelowContact {
        /// The depth of the lowest point below the contact, mm.
        depth_mm: f64,
    },
}

impl Warning {
    /// Returns true if the contact is not on the surface, or not the lowest point.
    pub fn is_off_contact(&self) -> bool {
        matches!(
            self,
            Self::ContactInAir { .. } | Self::AxisMissesModel | Self::BelowContact { .. }
        )
    }
}

/// Returns the setting that puts in a tip.
fn any_tip() -> Setting {
    Setting::new(Key::Tip, "DIAMETERxLENGTH")
}
