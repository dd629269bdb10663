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

/// The screws of brackets, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BracketKind {
    /// Diameter of the hole that the screw passes.
    pub hole_mm: f64,
    /// Diameter of the screw's head.
    pub head_mm: f64,
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
    /// The brackets.
    pub brackets: BracketKind,
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
        "the sheet of {sheet_mm} mm is too thick for face {face}: nothing of the panel is left"
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
         at {angle_deg:.0}°", .faces[0], .faces[1]
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
