//! Mean: the infill about which a match has its levels.
//!
//! Level sets of one quadric do not reach everything. Let K be all that two neighbouring levels
//! reach together. What lies inside of K needs a mixture of the two everywhere, and no level set is
//! one. A body of nearly uniform infill between two levels lies there.
//!
//! If the mean of what is wanted is itself a level, this cannot be. Then what is wanted has as much
//! above that level as below, and K has only more or only less. So the mean is taken.

use super::densities::{fill, nested};
use crate::base::watch::{Phase, Watch};
use crate::error::Error;
use crate::interior::Columns;
use crate::job::{InfillDensity, Job};
use crate::run::{Extent, Placed};
use crate::shell::Shell;

/// Share of the range of densities that the mean keeps from its ends.
const MARGIN_RATIO: f64 = 0.01;

/// Returns a placed match with its levels about the mean infill that it needs. Other goals stay as
/// they are.
///
/// What toolpaths lay beyond the parts is left out, so that all rounds have the same levels.
///
/// # Errors
/// The inside cannot be measured, or the densities are too near to each other.
pub fn with_levels(placed: Placed, watch: &Watch) -> Result<Placed, Error> {
    let Some(infill) = mean_infill(&placed, watch)? else {
        return Ok(placed);
    };
    let job = Job {
        infill: Some(infill),
        ..placed.job.clone()
    };
    let sparse = nested(&job, &placed.shop.printer)?;
    let laid = fill(&sparse);
    Ok(Placed {
        fill: laid.unwrap_or(placed.fill),
        sparse: Some(sparse),
        ..placed
    })
}

/// Returns the mean infill of a match, within its densities; `None` for other goals.
fn mean_infill(placed: &Placed, watch: &Watch) -> Result<Option<InfillDensity>, Error> {
    let (goal, shop) = (placed.goal(), &placed.shop);
    let known = (goal.wanted, &shop.printer.infill, ends(placed));
    let (Some(wanted), Some(pattern), Some([low, high])) = known else {
        return Ok(None);
    };
    watch.enter(Phase::Columns);
    let keeps = &placed.placement.keeps;
    let shell = Shell::new(placed.solid(), &goal.frame, shop.wall.wall_mm, keeps)?;
    let interior_mm3 = Columns::of_shell(&shell, shop.pitch_mm, watch)?
        .moments()
        .volume();
    let inside_mm3 = wanted.moments.volume() - (goal.solid.volume() - interior_mm3);
    let nominal = pattern.nominal_ratio(inside_mm3 / interior_mm3);
    let margin = MARGIN_RATIO * (high - low);
    Ok(InfillDensity::of_ratio(
        nominal.clamp(low + margin, high - margin),
    ))
}

/// Returns the least and the greatest nominal density of a print whose interior has the greatest.
fn ends(placed: &Placed) -> Option<[f64; 2]> {
    let levels = &placed.sparse.as_ref()?.levels;
    let (outermost, sparsest) = (levels.first()?, levels.last()?);
    let is_filled = outermost.extent == Extent::Interior;
    is_filled.then_some([sparsest.nominal_ratio, outermost.nominal_ratio])
}
