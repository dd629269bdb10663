//! Drain holes: how the voids of an uncut piece are emptied.
//!
//! * `hole`: a hole, and what it takes away.
//! * `bore`: whether a hole can be bored at a place.
//! * `place`: which of these places is best.
//! * `plug`: the parts that close holes afterwards.

mod bore;
pub(crate) mod hole;
mod place;
mod plug;

#[cfg(test)]
mod tests;

use crate::{
    cut::{
        access::void_access::VoidAccess,
        drains::hole::{DrainHole, taken},
        error::CutError,
        hollowed::{Hollowed, Void},
        ids::VoidId,
        plan::CutPlan,
        request::PlanRequest,
    },
    geom::Point,
    mass::{Moments, moments_of_mesh},
    mesh::{Csg, TriMesh},
    printer::DrainNeed,
};

/// The plan of an uncut piece with drain holes.
#[derive(Debug, Clone)]
pub struct Drained {
    /// The plan.
    pub plan: CutPlan,
    /// The voids that have no place for their holes, and stay closed.
    pub closed: Vec<VoidId>,
}

/// Places the drain holes of every void of a body that stays in one piece.
///
/// A hole is bored along the normal of the outside, where the wall is thin and the outside about
/// flat. It keeps off the edge of the foot, the contact of a top, and balls that are to be kept
/// clear. Among such places the one that is seen least is taken. The holes of one void lie far
/// apart, so that air flows through. The same body gives the same holes.
///
/// # Errors
/// A boolean failed, or the watch was stopped.
pub fn drain(
    hollowed: &Hollowed,
    request: &PlanRequest,
    need: &DrainNeed,
) -> Result<Drained, CutError> {
    let (drains, closed) = place::place(hollowed, request, need)?;
    let plan = CutPlan {
        drains,
        ..CutPlan::uncut(hollowed)
    };
    Ok(Drained {
        plan: measure_drained(hollowed, plan)?,
        closed,
    })
}

/// Returns the plan with its holes and the access to each void measured in this body.
pub(crate) fn measure_drained(hollowed: &Hollowed, plan: CutPlan) -> Result<CutPlan, CutError> {
    let body = Csg::of_mesh(&hollowed.to_mesh())?;
    let measured = |drain: &DrainHole| {
        let volume_mm3 = taken(&body, drain)?.signed_volume_mm3();
        Ok(DrainHole {
            volume_mm3,
            ..*drain
        })
    };
    let drains = plan.drains.iter().map(measured);
    let drains = drains.collect::<Result<Vec<DrainHole>, CutError>>()?;
    let voids = hollowed.voids.iter().enumerate();
    let voids = voids.map(|(index, void)| access(VoidId::of(index), void, &drains));
    Ok(CutPlan {
        voids: voids.collect(),
        drains,
        ..plan
    })
}

/// Returns the access to a void through its holes.
fn access(id: VoidId, void: &Void, drains: &[DrainHole]) -> VoidAccess {
    let own: Vec<&DrainHole> = drains.iter().filter(|drain| drain.void == id).collect();
    let closed = VoidAccess::closed(id, void);
    if own.is_empty() {
        return closed;
    }
    let corners = void.mesh().vertices().iter();
    let depths = corners.map(|p| distance_mm(p, own.iter().copied()));
    VoidAccess {
        opening_mm: own
            .iter()
            .map(|drain| drain.diameter_mm)
            .fold(0.0, f64::max),
        depth_mm: depths.fold(0.0, f64::max),
        is_clean: true,
        ..closed
    }
}

/// Returns the distance of a point from the inner end of the nearest hole, mm.
fn distance_mm<'a>(p: &Point, drains: impl Iterator<Item = &'a DrainHole>) -> f64 {
    let distances = drains.map(|drain| (p - Point::from(drain.to_mm)).norm());
    distances.fold(f64::INFINITY, f64::min)
}

impl CutPlan {
    /// Returns the moments of the material that its drain holes take from a body, less those of
    /// their plugs, model frame.
    ///
    /// # Errors
    /// A boolean failed.
    pub fn drained(&self, hollowed: &Hollowed) -> Result<Moments, CutError> {
        if self.drains.is_empty() {
            return Ok(Moments::default());
        }
        let body = Csg::of_mesh(&hollowed.to_mesh())?;
        let bores = self.drains.iter();
        let moments = bores.map(|drain| Ok(moments_of_mesh(&taken(&body, drain)?)));
        let taken = moments.collect::<Result<Vec<Moments>, CutError>>()?;
        let taken = taken.into_iter().fold(Moments::default(), |sum, m| sum + m);
        let plugs = self.plug_bodies(&hollowed.outer)?;
        let less = |rest, body: &TriMesh| rest - moments_of_mesh(body);
        Ok(plugs.iter().fold(taken, less))
    }
}
