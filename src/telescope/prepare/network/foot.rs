//! The foot under the first juncture of a figure, and the answers where none holds it.

use super::super::feet;
use super::made::Workshop;
use crate::base::setting::{Key, Setting};
use crate::curve::Helix;
use crate::geom::{Frame, Point};
use crate::job::telescope::{FootSize, Stance};
use crate::mesh::{ClipError, Csg};
use crate::telescope::balance::DiscFoot;
use crate::telescope::profile::Profile;
use crate::telescope::sweep::sweep_profile;
use crate::telescope::tube::TubeMass;
use crate::wing::{Impossible, Remedy};

/// A foot: a disc about the lowest point of the first juncture, its lower face on the table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Foot {
    pub disc: DiscFoot,
    pub chamfer_mm: f64,
    /// The middle of its lower face; the first axis points up.
    pub ground: Frame,
}

impl Foot {
    /// Returns its body.
    pub fn body(&self) -> Result<Csg, ClipError> {
        let disc = Profile::disc(
            [0.0, self.disc.height_mm],
            self.disc.radius_mm,
            self.chamfer_mm,
        );
        Csg::of_mesh(&sweep_profile(&self.ground, &Helix::LINE, &disc)?)
    }

    /// Returns the next wider foot, unless its radius was ordered or the printer has no room.
    pub fn wider(&self, workshop: &Workshop) -> Option<Self> {
        let radius_mm = self.disc.radius_mm + feet::STEP_MM;
        let most_mm = feet::most_mm(&workshop.shop.printer);
        let is_free = workshop.job.foot == FootSize::Auto && radius_mm <= most_mm;
        is_free.then_some(Self {
            disc: DiscFoot {
                radius_mm,
                ..self.disc
            },
            ..*self
        })
    }

    /// Returns its mass, without what lies in the juncture too.
    pub fn mass(&self) -> TubeMass {
        let (radius, height) = (self.disc.radius_mm, self.disc.height_mm);
        TubeMass {
            volume_mm3: std::f64::consts::PI * radius * radius * height,
            centre: self.ground.to_model(&Point::new(0.5 * height, 0.0, 0.0)),
        }
    }

    /// Returns the lean at which a centre of mass is over the edge on which it rests, rad;
    /// `sag_mm` is taken off.
    pub fn lean_rad(&self, centre: &Point, sag_mm: f64) -> f64 {
        let local = self.ground.to_local(centre);
        let edge_mm = self.disc.radius_mm - self.chamfer_mm;
        (edge_mm - local.y.hypot(local.z) - sag_mm).atan2(local.x)
    }
}

/// A foot with how the figure stands on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StoodFoot {
    pub foot: Foot,
    /// The lean at which it topples first over its opening, with all play taken up, degrees.
    pub worst_deg: f64,
}

/// A figure that does not stand as asked.
pub enum Falls {
    /// It topples on the greatest foot.
    Topples { angle_deg: f64, foot_mm: f64 },
    /// A body reaches below the foot.
    Low { body: String, below_mm: f64 },
    /// The foot is in the way of what opens.
    Barred { why: String },
}

impl Falls {
    /// Returns the answer.
    pub fn impossible<M: Default>(&self, least_deg: f64) -> Impossible<M> {
        let (reason, hint) = match self {
            Self::Topples { angle_deg, foot_mm } => (
                format!(
                    "the figure topples at {angle_deg:.1}° on a foot of {foot_mm:.0} mm in radius, \
                     where {least_deg:.1}° is asked"
                ),
                "take another root, lower and nearer to the middle, or a lesser angle",
            ),
            Self::Low { body, below_mm } => (
                format!(
                    "{body} reaches {below_mm:.1} mm below the foot, which is under the first \
                     juncture"
                ),
                "take the lowest node as the root",
            ),
            Self::Barred { why } => (
                format!("the foot is in the way: {why}"),
                "take another root, or a foot of your own radius",
            ),
        };
        let held = Remedy {
            words: "makes the figure without a promise to stand".to_owned(),
            settings: vec![Setting::new(Key::Goal, Stance::None)],
        };
        Impossible {
            remedies: vec![held],
            hints: vec![hint.to_owned()],
            ..Impossible::new(reason)
        }
    }
}
