//! A pin with the material that is kept solid around it, and what bosses are asked for.

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

/// What bosses are to be found for.
#[derive(Debug, Clone, Copy)]
pub struct BossOrder<'a> {
    /// The body as it is hollowed now.
    pub hollowed: &'a Hollowed,
    /// What the plan was asked for.
    pub request: &'a PlanRequest,
    /// The plan of its cuts and pins.
    pub plan: &'a CutPlan,
    /// The pins that a person ordered: they get bosses where they need them, and no other pins are
    /// looked for.
    pub ordered: Option<&'a [PinSite]>,
    /// Joints for which no bosses are looked for any more.
    pub given_up: &'a [JointName],
    /// Where bosses stood that cost too much, model frame, mm: none is looked for beside them.
    pub refused: &'a [[f64; 3]],
    /// The price of keeping material solid.
    pub price: MaterialPrice,
}

/// What keeping material solid costs: near an optimum the objective changes, to first order, by the
/// integral of the optimal quadric over what is filled.
#[derive(Debug, Clone, Copy)]
pub struct MaterialPrice {
    /// The quadric whose positive side is empty.
    pub quadric: Quadric,
    /// The frame that it is given in.
    pub frame: Frame,
}

/// A joint by the names of what meets there.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct JointName {
    /// The cut's id.
    pub cut: CutId,
    /// The ids of the parts below and above the cut.
    pub parts: [PartId; 2],
}

/// A pin with the material that is to be kept solid around it and its socket.
#[derive(Debug, Clone, PartialEq)]
pub struct Boss {
    /// The pin; its id is not settled yet.
    pub pin: PinSite,
    /// The ids of the parts it joins.
    pub parts: [PartId; 2],
    /// Closed, facing outward, model frame, mm; it reaches into the wall.
    pub body: TriMesh,
    /// Whether something of it is empty so far. A boss that is solid already is kept so when
    /// everything is solved again.
    pub is_new: bool,
}

impl Boss {
    /// The joint that its pin aligns.
    pub fn joint(&self) -> JointName {
        JointName {
            cut: self.pin.cut.clone(),
            parts: self.parts,
        }
    }
}
