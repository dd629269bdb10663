//! Joints, pins in bosses, dowels and ballast.

use serde::{Deserialize, Serialize};

use crate::verify::{BallastOrder, GlueFilm};

/// One glue joint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct JointRow {
    /// Its name on the sheet, such as `J1`.
    pub id: String,
    /// The cut it lies in.
    pub cut: String,
    /// The two parts it joins.
    pub parts: [String; 2],
    /// The area of glue, mm².
    pub area_mm2: f64,
    /// How many pins align it; zero where there was no room.
    pub pins: usize,
    /// The gap between pin and socket on each side, mm.
    pub clearance_mm: f64,
    /// The film of glue in it, which the figures of the assembly count; none where the printer's
    /// profile says nothing of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub glue: Option<GlueFilm>,
    /// What to mind, such as where a joint has no room for pins.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
}

/// A round in which material was kept solid around pins, and everything solved again.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RoundRow {
    /// Which round, from 1.
    pub round: usize,
    /// What was kept solid in it.
    pub bosses: Vec<BossRow>,
    /// The volume of what could have been emptied in all bosses up to this round, mm³.
    pub kept_solid_mm3: f64,
    /// The certificate's figure before the round, in its unit.
    pub before: f64,
    /// The same with the bosses kept solid.
    pub after: f64,
    /// How far `after` is from its proof, as a share.
    pub gap_ratio: f64,
}

/// A boss: material that is kept solid around a pin and its socket.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BossRow {
    /// The pin it is for.
    pub pin: String,
    /// The two parts it joins.
    pub parts: [String; 2],
    /// The middle of the pin's base on the cut, model frame, mm.
    pub center_mm: [f64; 3],
    /// The volume of the boss with what was solid anyway, mm³.
    pub volume_mm3: f64,
}

/// Dowels to be cut, all alike.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CutListRow {
    /// How many.
    pub count: usize,
    /// The rod they are cut from, such as `beech-4`.
    pub rod: String,
    /// What it is called in a shop.
    pub name: String,
    /// mm.
    pub diameter_mm: f64,
    /// How long they are cut, mm.
    pub length_mm: f64,
    /// What one of them weighs, g.
    pub mass_g: f64,
    /// What the diameter and the density rest on.
    pub sources: Vec<String>,
}

/// One stock part that is laid into its pocket.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BallastRow {
    /// Its name on the sheet, its shape, mass and place.
    #[serde(flatten)]
    pub order: BallastOrder,
    /// What it is ordered by, such as `ball-4`.
    pub part: String,
    /// What it is called in a shop.
    pub name: String,
    /// The void that is its pocket.
    pub void: String,
    /// The ids of the cuts that open the pocket.
    pub opened_by: Vec<String>,
    /// The gap around it, mm.
    pub clearance_mm: f64,
    /// By how much of it the mass of a good part may differ.
    pub mass_spread_ratio: f64,
    /// Where its sizes and its mass are from.
    pub sources: [String; 2],
}
