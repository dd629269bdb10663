//! The rows of joints, of bosses around pins, of dowels and of ballast.

use serde::{Deserialize, Serialize};

use crate::geom::play::Play;
use crate::verify::{BallastOrder, GlueFilm, HeldBy, PromisedJig};

/// A glue joint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct JointRow {
    /// Name on the sheet, such as `J1`.
    pub id: String,
    /// Id of the cut it lies in.
    pub cut: String,
    /// Ids of the two parts it joins.
    pub parts: [String; 2],
    /// Area of glue, mm².
    pub area_mm2: f64,
    /// Number of pins that align it; zero if there was no room.
    pub pins: usize,
    /// Gap between pin and socket on each side, mm.
    pub clearance_mm: f64,
    /// Way in which its parts are aligned; `Eye` in kits of older versions.
    #[serde(default = "by_eye")]
    pub held_by: HeldBy,
    /// Play that its pins leave; `None` if they leave a turn free, or there are fewer than two.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub play: Option<Play>,
    /// Unbalance in an end plane of a rotor if the lighter side shifts by this play, g·mm. `None`
    /// for other goals, where other joints hold it, and in kits of older versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unbalance_g_mm: Option<f64>,
    /// Film of glue, which the figures of the assembly count; `None` if the printer's profile does
    /// not give it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub glue: Option<GlueFilm>,
    /// Warning for whoever glues it, such as that it has no room for pins.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
}

/// Returns the way in which nothing printed aligns a joint.
fn by_eye() -> HeldBy {
    HeldBy::Eye
}

/// A jig: a printed cradle that holds the parts of a joint while the glue sets. A tool, no part.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct JigRow {
    /// Name on the sheet, joint, file and place.
    #[serde(flatten)]
    pub order: PromisedJig,
    /// Extent on the plate, mm.
    pub size_mm: [f64; 3],
    /// Volume, mm³.
    pub volume_mm3: f64,
    /// Mass, g, which the assembly does not count.
    pub mass_g: f64,
}

/// A round in which material was kept solid around pins and everything was solved again.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RoundRow {
    /// Number of the round, from 1.
    pub round: usize,
    /// Bosses kept solid in it.
    pub bosses: Vec<BossRow>,
    /// Volume that could have been emptied in all bosses up to this round, mm³.
    pub kept_solid_mm3: f64,
    /// The certificate's figure before the round, in its unit.
    pub before: f64,
    /// The certificate's figure with the bosses kept solid.
    pub after: f64,
    /// Relative distance of `after` from its proved bound.
    pub gap_ratio: f64,
}

/// A boss: material kept solid around a pin and its socket.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BossRow {
    /// Id of the pin.
    pub pin: String,
    /// Ids of the two parts that the pin joins.
    pub parts: [String; 2],
    /// Middle of the pin's base on the cut, model frame, mm.
    pub center_mm: [f64; 3],
    /// Volume of the boss, including what was solid anyway, mm³.
    pub volume_mm3: f64,
}

/// Dowels to cut, all alike.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CutListRow {
    /// Number of dowels.
    pub count: usize,
    /// Id of the rod they are cut from, such as `beech-4`.
    pub rod: String,
    /// Name of the rod in a shop.
    pub name: String,
    /// Diameter, mm.
    pub diameter_mm: f64,
    /// Length, mm.
    pub length_mm: f64,
    /// Mass of one of them, g.
    pub mass_g: f64,
    /// Sources of the diameter and the density.
    pub sources: Vec<String>,
}

/// A stock part that is laid into its pocket.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BallastRow {
    /// Name on the sheet, shape, mass and place.
    #[serde(flatten)]
    pub order: BallastOrder,
    /// Id by which it is ordered, such as `ball-4`.
    pub part: String,
    /// Name in a shop.
    pub name: String,
    /// Id of the void that is its pocket.
    pub void: String,
    /// Ids of the cuts that open the pocket.
    pub opened_by: Vec<String>,
    /// Gap around it, mm.
    pub clearance_mm: f64,
    /// Allowed relative deviation of the mass of a good part.
    pub mass_spread_ratio: f64,
    /// Sources of its sizes and of its mass.
    pub sources: [String; 2],
}
