//! The order for panels, and the joints along their edges.

use super::fingers::FingerJoint;
use crate::geom::Point;

/// The joints along edges.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointStyle {
    /// Fingers where they fit, brackets elsewhere.
    Auto,
    /// Fingers; edges that have no room for them are an error.
    Fingers,
    /// Brackets on all edges.
    Brackets,
}

/// Width of a bracket along the edge, in diameters of the screw's head; its two screws are half of
/// that apart.
const BRACKET_HEADS: f64 = 4.0;
/// Distance of a screw from the inner end of a plain edge beyond the thickness, in diameters of its
/// head.
const FLANGE_HEADS: f64 = 1.0;

/// Brackets and their screws, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BracketKind {
    /// Diameter of the hole in a panel, which the screw passes.
    pub hole_mm: f64,
    /// Diameter of the screw's head.
    pub head_mm: f64,
    /// Diameter of the hole in a flange, in which the screw or its insert holds.
    pub thread_mm: f64,
    /// Thickness of a flange.
    pub flange_mm: f64,
}

impl BracketKind {
    /// Returns the width of a bracket along its edge, mm.
    pub fn width_mm(&self) -> f64 {
        BRACKET_HEADS * self.head_mm
    }

    /// Returns the distance of a bracket's screws from its middle, along the edge, mm.
    pub fn aside_mm(&self) -> f64 {
        0.25 * self.width_mm()
    }
}

/// The order for panels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PanelRequest {
    /// The thickness of the sheet, mm.
    pub sheet_mm: f64,
    /// The joints.
    pub joints: JointStyle,
    /// By how much fingers are wider than their gaps, mm; less than zero for a loose fit.
    pub press_mm: f64,
    /// The width of the beam, which every gap must take, mm; 0 if the drawings are not offset.
    pub cut_mm: f64,
    /// The brackets.
    pub brackets: BracketKind,
}

impl PanelRequest {
    /// Returns the distance of a bracket's screws from the plain edge of a panel, mm.
    pub fn away_mm(&self) -> f64 {
        FLANGE_HEADS * self.brackets.head_mm + self.sheet_mm
    }

    /// Returns the length of a bracket's flange from the plain edge of a panel, mm.
    pub fn flange_mm(&self) -> f64 {
        self.away_mm() + self.brackets.head_mm
    }
}

/// The joint along an edge.
#[derive(Debug, Clone, PartialEq)]
pub enum EdgeJoint {
    /// Fingers.
    Fingers(FingerJoint),
    /// Brackets inside, each given by its middle along the edge, mm from the edge's start.
    Brackets(Vec<f64>),
}

/// An edge at which two panels meet.
#[derive(Debug, Clone, PartialEq)]
pub struct PanelEdge {
    /// The indices of both panels, the lower one first.
    pub panels: [usize; 2],
    /// The ends of the stretch that both share, in the line in which the outer sides meet.
    pub ends: [Point; 2],
    /// The inner angle between the panels, radians.
    pub angle_rad: f64,
    /// The depth to which the joint reaches into either panel from that line, mm.
    pub depth_mm: f64,
    /// The joint.
    pub joint: EdgeJoint,
}

impl PanelEdge {
    /// Returns the length of the shared stretch, mm.
    pub fn length_mm(&self) -> f64 {
        (self.ends[1] - self.ends[0]).norm()
    }
}

/// The reason that a polyhedron gets no panels.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PanelError {
    /// The sheet is too thick for a face.
    #[error(
        "the sheet of {sheet_mm} mm is too thick for face {} of a polyhedron: nothing of the panel \
         is left", .face + 1
    )]
    TooThick {
        /// The thickness, mm.
        sheet_mm: f64,
        /// The index of the face.
        face: usize,
    },
    /// An edge without room for fingers, where fingers were ordered.
    #[error(
        "the edge between faces {} and {} has no room for fingers: it is {length_mm:.1} mm long, \
         at {angle_deg:.0}°", .faces[0] + 1, .faces[1] + 1
    )]
    NoFingers {
        /// The indices of the faces.
        faces: [usize; 2],
        /// The length of the shared stretch, mm.
        length_mm: f64,
        /// The inner angle, degrees.
        angle_deg: f64,
    },
}
