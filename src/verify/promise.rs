//! What a kit promises: the judge's own narrow view of `checklist.json`.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{
    BallastOrder, Cleaning, FillOrder, Fingerprint, GlueFilm, Hardware, Pose, PromisedCut,
    PromisedVoid, RotorOrder, WaterOrder,
};
use crate::geom::{Frame, Point, Vector};
use crate::goal::GoalKind;

/// The schema of `checklist.json` this judge understands.
pub const SCHEMA: u32 = 1;

/// The promises of a kit, and what is needed to hold its files against them.
///
/// Every other key of the checklist is left unread, so that nothing the makers computed on the way
/// can reach the verdict.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Promise {
    /// The version of the keys, [`SCHEMA`].
    pub schema: u32,
    /// What must hold the parts.
    pub printer: PrinterLimits,
    /// What they are printed of.
    pub material: Density,
    /// What the assembly is for.
    pub goal: Aim,
    /// The figure the buyer was told, if the goal has one.
    pub promise: Option<PromisedFigure>,
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
    /// What is put into them that is not printed.
    #[serde(default)]
    pub hardware: Vec<Hardware>,
    /// The dowels in its joints.
    #[serde(default)]
    pub dowels: Vec<Hardware>,
    /// How far the halves of a yo-yo are to be apart, mm; none where there is one body.
    #[serde(default)]
    pub string_gap_mm: Option<f64>,
    /// The stock parts that are laid into its voids.
    #[serde(default)]
    pub ballast: Vec<BallastOrder>,
    /// What the voids are filled with; none for air.
    #[serde(default)]
    pub fill: Option<FillOrder>,
    /// The joints between them.
    #[serde(default)]
    pub joints: Vec<PromisedJoint>,
    /// The SHA-256 of every other file of the kit, by path relative to its folder.
    #[serde(default)]
    pub files: BTreeMap<String, String>,
}

/// The space a printer has.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PrinterLimits {
    /// The edges of the build volume along x, y and z, mm; unknown for some machines.
    pub build_volume_mm: Option<[f64; 3]>,
    /// What part files are multiplied by along x, y and z to make up for shrinkage; none where they
    /// are of nominal size.
    #[serde(default)]
    pub print_scale_ratio: Option<[f64; 3]>,
    /// The least wall the process prints, mm: what must stay around sockets.
    pub minimum_wall_mm: f64,
    /// The least opening through which a void can be cleaned, mm.
    #[serde(default)]
    pub minimum_opening_mm: Option<f64>,
    /// When a void counts as clean; none where that is not judged.
    #[serde(default)]
    pub cleaning: Option<Cleaning>,
}

/// The density the masses rest on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Density {
    /// g/cm³.
    pub density_g_cm3: f64,
}

/// The goal, as placed on the model.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Aim {
    /// What it must do.
    pub kind: GoalKind,
    /// The contact point, the spin point, or a point of the support plane; model frame, mm.
    pub origin_mm: [f64; 3],
    /// The spin axis or up, model frame; any length but zero.
    pub axis: [f64; 3],
    /// How a rotor runs; none for other goals.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotor: Option<RotorOrder>,
    /// How it floats; none for other goals.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub water: Option<WaterOrder>,
}

impl Aim {
    /// A goal that is told by its place alone.
    pub fn new(kind: GoalKind, origin_mm: [f64; 3], axis: [f64; 3]) -> Self {
        Self {
            kind,
            origin_mm,
            axis,
            rotor: None,
            water: None,
        }
    }

    /// The goal frame: its origin at the contact, its z along the axis.
    pub fn frame(&self) -> Frame {
        Frame::with_axis(Point::from(self.origin_mm), &Vector::from(self.axis))
    }
}

/// Which of the [`super::Figures`] was promised.
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
    /// What a rotor weighs, g; more is better: nothing was removed but what balances it.
    MassG,
    /// A rotor's balance quality grade at its speed, mm/s (ISO 21940-11); less is better.
    BalanceGradeMmS,
}

impl FigureName {
    /// What it is called on the sheet.
    pub fn name(self) -> &'static str {
        match self {
            Self::CriticalSpeedRpm => "critical speed",
            Self::DominanceRatio => "dominance reached",
            Self::SpinItRatio => "Spin-It ratio",
            Self::TopplesDeg => "toppling angle",
            Self::CenterHeightMm => "height of the centre",
            Self::MetacentricHeightMm => "metacentric height",
            Self::MassG => "balanced mass",
            Self::BalanceGradeMmS => "balance grade",
        }
    }

    /// What promising it says.
    pub fn promise(self) -> &'static str {
        match self {
            Self::CriticalSpeedRpm => "it spins upright from",
            Self::DominanceRatio => "its axis is dominant with I_b/I_c of",
            Self::SpinItRatio => "its squared ratio of transverse to axial inertia is",
            Self::TopplesDeg => "it stands until tilted by",
            Self::CenterHeightMm => "its centre of mass is no higher than",
            Self::MetacentricHeightMm => "it floats upright with a metacentric height of",
            Self::MassG => "it keeps, balanced, a mass of",
            Self::BalanceGradeMmS => "it runs true to a balance grade of",
        }
    }

    /// Whether more of it is better.
    pub fn more_is_better(self) -> bool {
        matches!(
            self,
            Self::TopplesDeg | Self::MetacentricHeightMm | Self::MassG
        )
    }

    /// The unit of its values; empty for a ratio.
    pub fn unit(self) -> &'static str {
        match self {
            Self::CriticalSpeedRpm => "rpm",
            Self::DominanceRatio | Self::SpinItRatio => "",
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
    /// Which figure.
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
    /// What its shape is known by; none in kits of before there were marks.
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
    /// What it says.
    pub text: String,
    /// The cut that made the face.
    pub cut: String,
    /// The unit direction into the part, model frame.
    pub axis: [f64; 3],
    /// How deep it is, mm.
    pub depth_mm: f64,
    /// How wide its strokes are, mm.
    pub stroke_mm: f64,
    /// The middle of every stroke in the face, model frame, mm.
    pub strokes_mm: Vec<[f64; 3]>,
    /// mm³, of what it takes away.
    pub volume_mm3: f64,
}

/// What a pin adds to the hollowed body, or a socket takes from it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Peg {
    /// Its name; a pin and its socket share it.
    pub id: String,
    /// The joint it belongs to.
    pub joint: String,
    /// The middle of its base on the cut, model frame, mm.
    pub center_mm: [f64; 3],
    /// Its direction: out of the part that has the pin, into the part that has the socket; model
    /// frame.
    pub axis: [f64; 3],
    /// mm.
    pub diameter_mm: f64,
    /// The pin's length or the socket's depth, mm.
    pub length_mm: f64,
    /// mm³, of the triangles as written.
    pub volume_mm3: f64,
}

/// What was ordered of the pins of a joint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PromisedJoint {
    /// The name on the sheet, such as `J1`.
    pub id: String,
    /// The gap between pin and socket on each side, mm.
    pub clearance_mm: f64,
    /// The film of glue in it; none where it is not known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub glue: Option<GlueFilm>,
}

impl Promise {
    /// The gap ordered between the pins and sockets of a joint, mm; 0 for a joint that is not in
    /// the list.
    pub(super) fn clearance_mm(&self, joint: &str) -> f64 {
        let found = self.joints.iter().find(|known| known.id == joint);
        found.map_or(0.0, |joint| joint.clearance_mm)
    }
}
