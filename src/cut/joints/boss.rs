//! A pin with the material kept solid around it, and the request for bosses.

use crate::{
    cut::{
        hollowed::Hollowed,
        ids::{CutId, PartId},
        joints::pin_shape::PinSite,
        plan::CutPlan,
        request::PlanRequest,
    },
    geom::{Frame, Quadric},
    mesh::TriMesh,
};

/// Request for bosses.
#[derive(Debug, Clone, Copy)]
pub struct BossRequest<'a> {
    /// The body with its current voids.
    pub hollowed: &'a Hollowed,
    /// The request that the plan answers.
    pub request: &'a PlanRequest,
    /// The plan with its cuts and pins.
    pub plan: &'a CutPlan,
    /// The pins the user ordered, if any. They get bosses where they need them, and no further pins
    /// are placed.
    pub ordered: Option<&'a [PinSite]>,
    /// Joints that get no more bosses.
    pub given_up: &'a [JointName],
    /// Places of bosses that cost too much, model frame, mm. No boss is placed near them.
    pub refused: &'a [[f64; 3]],
    /// Price of keeping material solid.
    pub price: MaterialPrice,
}

/// Price of keeping material solid. Near an optimum the objective changes, to first order, by the
/// integral of the optimal quadric over the material filled in.
#[derive(Debug, Clone, Copy)]
pub struct MaterialPrice {
    /// The optimal quadric; it is positive in the voids.
    pub quadric: Quadric,
    /// Frame of the quadric's coordinates.
    pub frame: Frame,
}

/// A joint, named by its cut and its two parts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct JointName {
    /// The cut's id.
    pub cut: CutId,
    /// The ids of the parts below and above the cut.
    pub parts: [PartId; 2],
}

/// A pin with the material kept solid around it and its socket.
#[derive(Debug, Clone, PartialEq)]
pub struct Boss {
    /// The pin; its id is assigned later.
    pub pin: PinSite,
    /// The ids of the parts it joins.
    pub parts: [PartId; 2],
    /// Closed mesh with outward normals, model frame, mm; it reaches into the wall.
    pub body: TriMesh,
    /// True if part of the body lies in a void so far. A boss that is solid already stays solid
    /// when the voids are solved again.
    pub is_new: bool,
}

impl Boss {
    /// Returns the joint that its pin aligns.
    pub fn joint(&self) -> JointName {
        JointName {
            cut: self.pin.cut.clone(),
            parts: self.parts,
        }
    }
}
