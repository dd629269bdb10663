//! The request for a cut plan.

use serde::{Deserialize, Serialize};

use crate::{
    base::watch::Watch,
    cut::{
        joints::{rod::Rod, shelf::JigShelf},
        least_part::LeastPart,
        seam::rules::Seams,
    },
    geom::{Point, Vector},
    printer::Cleaning,
};

/// Requirements of the printer, the material and the goal for cuts, pins and parts.
#[derive(Debug, Clone)]
pub struct PlanRequest {
    /// Diameter of the disc that must pass through the opening of every void, mm.
    pub min_opening_mm: f64,
    /// The rule by which a void counts as clean, besides its opening.
    pub cleaning: Cleaning,
    /// Least share of all voids' walls that a cut for cleaning alone must bring into sight.
    /// Whatever only a cut with a smaller gain would open stays unclean, to be kept solid. With 0,
    /// every cut is worth its joint.
    pub worth_ratio: f64,
    /// Score of each part beyond two, against 3 for a seam as long as the circle about the model.
    pub part_weight: f64,
    /// `true` to rate the room for pins with the voids filled, so that bosses have room beside the
    /// opening. `false` rates the walls alone. Meant for a second plan, if the first leaves joints
    /// without pins.
    pub wants_wide_joints: bool,
    /// The build volume: x, y and z, mm. `None`: anything fits.
    pub build_volume_mm: Option<[f64; 3]>,
    /// Least thickness of material around a socket and under a pin, mm.
    pub wall_mm: f64,
    /// The sizes of pins and sockets.
    pub pins: PinSettings,
    /// The contact point and the spin axis (or up): cuts keep away from the point.
    pub axis: GoalAxis,
    /// Pin diameters are whole multiples of this, mm.
    pub pixel_mm: f64,
    /// Socket diameters are whole multiples of this, mm; 0 if holes are not made of steps, as with
    /// lines of filament.
    pub hole_step_mm: f64,
    /// Pin lengths, socket depths and the heights of upward faces are whole multiples of this, mm.
    pub layer_mm: f64,
    /// The preferred pose of parts in the printer.
    pub pose: PosePreference,
    /// The rods that dowels are cut from, in place of printed pins; empty for printed pins.
    pub rods: Vec<Rod>,
    /// The style in which part ids are sunk into cut faces; `None` for no ids.
    pub labels: Option<LabelStyle>,
    /// The rules for seams on the outside.
    pub seams: Seams,
    /// The least part that is worth its joint.
    pub least_part: LeastPart,
    /// The jigs that were found before.
    pub jigs: JigShelf,
    /// The watch over the run: it hears that planning and cutting go on, and may stop them.
    pub watch: Watch,
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
    /// Depth of a socket beyond the length of its pin, mm.
    pub bottom_relief_mm: f64,
    /// Least distance of a joint's farthest pins, as a share of the joint's longest diagonal.
    pub spread_ratio: f64,
    /// Gap between a jig and the parts that lie in it, mm. A cradle is open, so it may be snugger
    /// than a socket.
    pub snug_gap_mm: f64,
    /// The largest step at the rim of a joint that its pins may leave, mm; `None` for any.
    pub max_step_mm: Option<f64>,
}

/// The preferred pose of a part in the printer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PosePreference {
    /// The largest cut face without pins lies on the plate. If every cut face has pins, the largest
    /// faces up.
    CutFaceDown,
    /// The opened hollows face up, so that support can be washed out of them (PolyJet).
    OpenHollowUp,
    /// As little support as can be, in any direction, but not on pins (filament).
    LittleSupport,
    /// Tilted, so that no layer encloses resin (a vat, whose slicer adds raft and supports).
    Tilted,
}

/// The style in which ids are sunk into cut faces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LabelStyle {
    /// The width of a stroke, mm: the smallest detail that prints.
    pub stroke_mm: f64,
    /// The depth of a stroke, mm.
    pub depth_mm: f64,
    /// The number of parts that have ids already, where several bodies of a kit are cut.
    pub numbered: usize,
}
