//! What a cut plan is asked for.

use serde::{Deserialize, Serialize};

use crate::{
    cut::joints::rod::Rod,
    geom::{Point, Vector},
    printer::Cleaning,
};

/// What the printer, the material and the goal ask of cuts, pins and parts.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanRequest {
    /// Diameter of the disc that must pass through the opening of every void, mm.
    pub min_opening_mm: f64,
    /// When a void counts as clean, besides its opening.
    pub cleaning: Cleaning,
    /// The least share of all voids' walls that a cut for their cleaning alone must bring into
    /// sight: what less would open is left unclean, to be kept solid. 0: any cut is worth its
    /// joint.
    pub worth_ratio: f64,
    /// Whether the room for pins counts as it is with the voids filled, so that bosses have it
    /// beside the opening, and not as the walls alone give it: for another plan, where the first
    /// leaves joints without pins.
    pub wants_wide_joints: bool,
    /// What fits into the printer: x, y and z, mm. Unset: anything fits.
    pub build_volume_mm: Option<[f64; 3]>,
    /// Least thickness of material around a socket and under a pin, mm.
    pub wall_mm: f64,
    /// How pins and sockets are made.
    pub pins: PinSettings,
    /// The contact point and the spin axis (or up): cuts keep away from the point.
    pub axis: GoalAxis,
    /// Pin diameters are whole multiples of this, mm.
    pub pixel_mm: f64,
    /// Socket diameters are whole multiples of this, mm; zero where holes are not made of steps, as
    /// with lines of filament.
    pub hole_step_mm: f64,
    /// Pin lengths, socket depths and the heights of faces that look up are whole multiples of
    /// this, mm.
    pub layer_mm: f64,
    /// How parts are laid in the printer.
    pub pose: PosePreference,
    /// The rods that dowels are cut from, in place of printed pins; none for printed ones.
    pub rods: Vec<Rod>,
    /// How part ids are sunk into cut faces; none where they are not.
    pub labels: Option<LabelStyle>,
}

/// The axis of the goal in the model frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GoalAxis {
    /// The contact point (or the spin point), mm.
    pub point: Point,
    /// The unit direction of the spin axis, or up.
    pub direction: Vector,
}

/// The sizes of alignment pins and their sockets, mm.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PinSettings {
    /// The thinnest pin the process prints well, mm.
    pub min_diameter_mm: f64,
    /// Length of a pin over its diameter; 1 to 1.5 is usual.
    pub length_ratio: f64,
    /// Gap between pin and socket on each side, mm.
    pub clearance_mm: f64,
    /// Height and width of the chamfers at the pin's tip and the socket's mouth, mm.
    pub chamfer_mm: f64,
    /// How much deeper a socket is than its pin is long, mm.
    pub bottom_relief_mm: f64,
}

/// Which way a cut part is laid in the printer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PosePreference {
    /// The largest cut face without pins on the plate; where every cut face has pins, the largest
    /// looks up.
    CutFaceDown,
    /// The opened hollows look up, so that support can be washed out of them (PolyJet).
    OpenHollowUp,
}

/// How ids are sunk into cut faces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LabelStyle {
    /// The width of a stroke, mm: the smallest detail that prints.
    pub stroke_mm: f64,
    /// How deep it is, mm.
    pub depth_mm: f64,
}
