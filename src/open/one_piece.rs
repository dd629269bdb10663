//! One piece: the voids are printed with sparse infill, so that nothing is cut or cleaned.

use super::request::request;
use super::resolve::Resolver;
use super::way::Candidate;
use crate::base::watch::Watch;
use crate::cut::{CutError, CutOrder, plan_by};
use crate::error::Error;
use crate::run::{Opened, Placed, Rung, Solved};

/// Draws the voids of a solution and leaves the body whole around them.
///
/// # Errors
/// The voids cannot be drawn, or the watch was stopped.
pub fn one_piece<'a>(
    placed: &'a Placed,
    solved: Solved,
    watch: &Watch,
) -> Result<Candidate<'a>, Error> {
    let request = request(placed, watch)?;
    let mut resolver = Resolver::new(placed, solved, watch)?;
    let voids = resolver.draw()?;
    let body = placed.printed(&voids.hollowed);
    let plan = plan_by(&body, &request, &CutOrder::default())?;
    Ok(Candidate {
        opened: Opened {
            plan: plan.or_error::<CutError>()?,
            voids,
            request,
            rung: Rung::Walls,
            remarks: Vec::new(),
            cleaning: Vec::new(),
            bosses: Vec::new(),
        },
        resolver,
    })
}
