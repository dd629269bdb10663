//! The promises of a kit: the judge's own narrow view of `checklist.json`.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{
    BallastOrder, BoundProof, CellsOrder, Density, FillOrder, Fingerprint, Hardware, InfillOrder,
    LaidOrder, Pose, PrinterLimits, PromisedHole, PromisedPlate, RotorOrder, WaterOrder,
};
use crate::geom::{Frame, Point, Vector};
use crate::goal::{GoalKind, Target};
use crate::mass::FlatFace;

/// The schema of `checklist.json` this judge understands.
pub const SCHEMA: u32 = 1;

/// The promises of a kit, and the data needed to judge its files by them.
///
/// Every other key of the checklist is left unread, so that no intermediate result of the maker can
/// reach the verdict.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Promise {
    /// The version of the keys, [`SCHEMA`].
    pub schema: u32,
    /// The limits of the printer.
    pub printer: PrinterLimits,
    /// The material of the parts.
    pub material: Density,
    /// The goal of the assembly.
    pub goal: Aim,
    /// The figure promised to the buyer, if the goal has one.
    pub promise: Option<PromisedFigure>,
    /// The bound of the certificate; `None` in kits without one.
    #[serde(default)]
    pub certificate: Option<PromisedBound>,
    /// The wall that was ordered.
    pub wall: WallOrder,
    /// The parts, in the order of the checklist.
    pub parts: Vec<PromisedPart>,
    /// The cuts between them.
    #[serde(default)]
    pub cuts: Vec<PromisedCut>,
    /// The voids, in the order of the cavities of the uncut result.
    #[serde(default)]
    pub voids: Vec<PromisedVoid>,
    /// The drain holes of an uncut piece; empty for others.
    #[serde(default)]
    pub drains: Vec<PromisedHole>,
    /// The cells inside of an uncut piece; `None` for others.
    #[serde(default)]
    pub cells: Option<CellsOrder>,
    /// The hardware put into the parts.
    #[serde(default)]
    pub hardware: Vec<Hardware>,
    /// The dowels in its joints.
    #[serde(default)]
    pub dowels: Vec<Hardware>,
    /// The gap between the halves of a yo-yo, mm; `None` if there is one body.
    #[serde(default)]
    pub string_gap_mm: Option<f64>,
    /// The stock parts that are laid into its voids.
    #[serde(default)]
    pub ballast: Vec<BallastOrder>,
    /// The filling of the voids; `None` for air.
    #[serde(default)]
    pub fill: Option<FillOrder>,
    /// The regions of sparse infill; `None` for a print that is solid but for its voids.
    #[serde(default)]
    pub infill: Option<InfillOrder>,
    /// What a slicer lays beyond the written parts; `None` if nobody sliced a hollow kit.
    #[serde(default)]
    pub laid: Option<LaidOrder>,
    /// The joints between them.
    #[serde(default)]
    pub joints: Vec<PromisedJoint>,
    /// The jigs that hold parts while their glue sets.
    #[serde(default)]
    pub jigs: Vec<PromisedJig>,
    /// The plates, and what lies where on them.
    #[serde(default)]
    pub plates: Vec<PromisedPlate>,
    /// The SHA-256 of every other file of the kit, by path relative to its folder.
    #[serde(default)]
    pub files: BTreeMap<String, String>,
}

/// The part of the checklist's certificate that the judge reads.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct PromisedBound {
    /// The figure that is bounded.
    pub figure: FigureName,
    /// The proof; `None` in kits without one.
    #[serde(default)]
    pub proof: Option<BoundProof>,
}

/// The goal, as placed on the model.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Aim {
    /// The kind of goal.
    pub kind: GoalKind,
    /// The contact point, the spin point, or a point of the support plane; model frame, mm.
    pub origin_mm: [f64; 3],
    /// The spin axis or up, model frame; any length but zero.
    pub axis: [f64; 3],
    /// The order for a rotor; `None` for other goals.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotor: Option<RotorOrder>,
    /// The order for a floating object; `None` for other goals.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub water: Option<WaterOrder>,
    /// The mass, centre and inertia of a match; `None` for other goals.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wanted: Option<Target>,
    /// The lean that a top promises, degrees, zero if it is waived. `None` for other goals, and in
    /// kits of older versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub least_lean_deg: Option<f64>,
    /// The toppling angle that a standing object promises, degrees; `None` for other goals.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub least_angle_deg: Option<f64>,
}

impl Aim {
    /// Returns a goal with a place alone, without rotor, water and promised angles.
    pub fn new(kind: GoalKind, origin_mm: [f64; 3], axis: [f64; 3]) -> Self {
        Self {
            kind,
            origin_mm,
            axis,
            rotor: None,
            water: None,
            wanted: None,
            least_lean_deg: None,
            least_angle_deg: None,
        }
    }

    /// Returns the goal frame, with its origin at the contact and its z along the axis.
    pub fn frame(&self) -> Frame {
        Frame::with_axis(Point::from(self.origin_mm), &Vector::from(self.axis))
    }
}

/// The name of one of the [`super::Figures`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FigureName {
    /// The least speed at which a top stays up, rpm; less is better.
    CriticalSpeedRpm,
    /// The larger transverse moment over the axial one, I_b/I_c; less is better.
    DominanceRatio,
    /// Spin-It's squared ratio of transverse to axial inertia (eq. 6); less is better.
    SpinItRatio,
    /// The tilt at which it topples, degrees; more is better.
    TopplesDeg,
    /// The height of the centre of mass over the support plane or contact, mm; less is better.
    CenterHeightMm,
    /// The height of the metacentre over the centre of mass, mm; more is better.
    MetacentricHeightMm,
    /// The mass of a rotor, g; more is better, since less was removed to balance it.
    MassG,
    /// A rotor's balance quality grade at its speed, mm/s (ISO 21940-11); less is better.
    BalanceGradeMmS,
    /// The root mean square of what is changed of a wished infill, over solid print; less is
    /// better.
    InfillChangeRatio,
}

impl FigureName {
    /// Returns its name on the sheet.
    pub fn name(self) -> &'static str {
        match self {
            Self::CriticalSpeedRpm => "critical speed",
            Self::DominanceRatio => "dominance reached",
            Self::SpinItRatio => "Spin-It ratio",
            Self::TopplesDeg => "toppling angle",
            Self::CenterHeightMm => "height of the centre",
            Self::MetacentricHeightMm => "metacentric height",
            Self::MassG => "mass that stays",
            Self::BalanceGradeMmS => "balance grade",
            Self::InfillChangeRatio => "mean change of infill",
        }
    }

    /// Returns the words that promise it, before the value.
    pub fn promise(self) -> &'static str {
        match self {
            Self::CriticalSpeedRpm => "it spins upright from",
            Self::DominanceRatio => "its axis is dominant with I_b/I_c of",
            Self::SpinItRatio => "its squared ratio of transverse to axial inertia is",
            Self::TopplesDeg => "it stands until tilted by",
            Self::CenterHeightMm => "its centre of mass is no higher than",
            Self::MetacentricHeightMm => "it floats upright with a metacentric height of",
            Self::MassG => "it is balanced with a mass of",
            Self::BalanceGradeMmS => "it runs true to a balance grade of",
            Self::InfillChangeRatio => "its infill differs from the wished one by",
        }
    }

    /// Returns true if more of it is better.
    pub fn more_is_better(self) -> bool {
        matches!(
            self,
            Self::TopplesDeg | Self::MetacentricHeightMm | Self::MassG
        )
    }

    /// Returns the unit of its values; empty for a ratio.
    pub fn unit(self) -> &'static str {
        match self {
            Self::CriticalSpeedRpm => "rpm",
            Self::DominanceRatio | Self::SpinItRatio | Self::InfillChangeRatio => "",
            Self::TopplesDeg => "°",
            Self::CenterHeightMm | Self::MetacentricHeightMm => "mm",
            Self::MassG => "g",
            Self::BalanceGradeMmS => "mm/s",
        }
    }
}

/// One figure as it was promised.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PromisedFigure {
    /// The figure.
    pub figure: FigureName,
    /// Its promised value, in the unit its name ends in.
    pub value: f64,
}

/// The wall that was ordered.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WallOrder {
    /// The least wall, mm.
    pub required_mm: f64,
}

/// One part as the kit names it.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct PromisedPart {
    /// The name on the sheet, such as `P01`.
    pub id: String,
    /// Its file, relative to the kit.
    pub file: String,
    /// The SHA-256 of that file, in hex.
    pub sha256: String,
    /// The fingerprint of its shape; `None` in kits made before there were fingerprints.
    #[serde(default)]
    pub fingerprint: Option<Fingerprint>,
    /// Model coordinates to print coordinates.
    pub print_from_model: Pose,
    /// The pins that stand out of the hollowed body.
    #[serde(default)]
    pub pins: Vec<Peg>,
    /// The sockets that are sunk into it.
    #[serde(default)]
    pub sockets: Vec<Peg>,
    /// The ids sunk into its cut faces.
    #[serde(default)]
    pub marks: Vec<Mark>,
}

/// An id sunk into a cut face, stroke by stroke.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Mark {
    /// The id.
    pub text: String,
    /// The cut that made the face.
    pub cut: String,
    /// The unit direction into the part, model frame.
    pub axis: [f64; 3],
    /// Its depth, mm.
    pub depth_mm: f64,
    /// The width of its strokes, mm.
    pub stroke_mm: f64,
    /// The middle of every stroke in the face, model frame, mm.
    pub strokes_mm: Vec<[f64; 3]>,
    /// The volume it removes, mm³.
    pub volume_mm3: f64,
}

/// A pin added to the hollowed body, or a socket taken from it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Peg {
    /// Its name; a pin and its socket share it.
    pub id: String,
    /// The joint it belongs to.
    pub joint: String,
    /// The middle of its base on the cut, model frame, mm.
    pub center_mm: [f64; 3],
    /// Its direction, model frame: out of the part with the pin, into the part with the socket.
    pub axis: [f64; 3],
    /// Its diameter, mm.
    pub diameter_mm: f64,
    /// The pin's length or the socket's depth, mm.
    pub length_mm: f64,
    /// The volume of its triangles as written, mm³.
    pub volume_mm3: f64,
}

/// The gap and the glue ordered for a joint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PromisedJoint {
    /// The name on the sheet, such as `J1`.
    pub id: String,
    /// The ids of the parts below and above it; empty in kits of older versions.
    #[serde(default)]
    pub parts: [String; 2],
    /// The gap between pin and socket on each side, mm.
    pub clearance_mm: f64,
    /// The way in which its parts are aligned; `None` in kits of older versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub held_by: Option<HeldBy>,
    /// The film of glue in it; `None` if it is not known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub glue: Option<GlueFilm>,
}

/// The way in which the parts of a joint are aligned while the glue sets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum HeldBy {
    /// Pins or dowels that fit one way only and leave no large step.
    Pins,
    /// A jig: a printed cradle of the outside.
    Jig,
    /// The eye of whoever glues it.
    Eye,
}

/// A jig as the kit names it: a printed cradle that holds the parts of a joint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PromisedJig {
    /// The name on the sheet, such as `jig-J1`.
    pub id: String,
    /// The joint.
    pub joint: String,
    /// Its file, relative to the kit.
    pub file: String,
    /// Model coordinates to print coordinates.
    pub print_from_model: Pose,
    /// The unit direction in which the object comes out of it, model frame.
    pub out: [f64; 3],
    /// A point of the joint's plane, model frame, mm.
    pub point_mm: [f64; 3],
    /// The unit normal of that plane.
    pub normal: [f64; 3],
    /// The gap between the jig and the outside, mm.
    pub gap_mm: f64,
    /// The distances of its ribs' faces from the plane on either side, mm.
    pub ribs_mm: [f64; 2],
    /// The depth to which a part is pressed into it, but for this, mm.
    pub pressed_mm: f64,
}

/// The film of glue in a joint.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct GlueFilm {
    /// Its thickness, mm.
    pub thickness_mm: f64,
    /// g/cm³.
    pub density_g_cm3: f64,
    /// Its mass, g.
    pub mass_g: f64,
    /// The face it covers.
    #[serde(flatten)]
    pub face: FlatFace,
}

/// A cut of the checklist.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PromisedCut {
    /// A point of its plane, model frame, mm.
    pub point_mm: [f64; 3],
    /// The normal of its plane, model frame.
    pub normal: [f64; 3],
}

/// A void of the checklist, in the order of the cavities of `hollowed.stl`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct PromisedVoid {
    /// The name on the sheet, such as `V1`.
    pub id: String,
    /// The share of its wall in sight of its openings, if it was measured.
    #[serde(default)]
    pub sight_ratio: Option<f64>,
    /// The least opening that was ordered for it, mm; the printer's if none is stated.
    #[serde(default)]
    pub least_opening_mm: Option<f64>,
}
