//! Graded: one piece whose voids are printed with sparse infill.

use crate::ballast::Load;
use crate::base::setting::{Key, Setting};
use crate::base::verdict::Verdict;
use crate::base::watch::Watch;
use crate::error::{DrainError, Error, GradedError, SlicedError};
use crate::goal::GoalKind;
use crate::hollow::Fill;
use crate::job::{DrainOrder, Interior, Job, PartFormat, SlicedRound};
use crate::mass::moments_of_mesh;
use crate::mesh::{TriMesh, shells};
use crate::printer::Printer;
use crate::run::{Nested, Placed};
use crate::verify::{beyond_ratio, infill_share};

use super::densities::nested;
use super::levels::with_load;

/// Returns the sparse print that a job orders; `None` for a hollow one.
///
/// # Errors
/// The printer has no infill, or the job orders what one closed piece cannot have.
pub fn sparse_print(job: &Job, printer: &Printer) -> Result<Option<Nested>, GradedError> {
    let is_graded = job.interior == Interior::Graded;
    if job.interior.is_hollow() && job.goal.kind == GoalKind::Match {
        return Err(GradedError::HollowMatch);
    }
    if !is_graded {
        return ordered_density(job)
            .map_or(Ok(None), |order| Err(GradedError::NotGraded { order }));
    }
    if let (Some(wished), GoalKind::Match) = (job.infill, job.goal.kind) {
        return Err(GradedError::WishedMatch { wished });
    }
    if let (Some(field), GoalKind::Match | GoalKind::Float) = (&job.field, job.goal.kind) {
        let field = Box::new(field.clone());
        return Err(GradedError::FieldOfGoal { field });
    }
    if job.plan.is_some() {
        return Err(GradedError::Cuts);
    }
    if let Some(fill) = job.fill {
        return Err(GradedError::Filling { fill });
    }
    if !job.ballast.is_none() {
        let order = job.ballast.clone();
        return Err(GradedError::Ballast { order });
    }
    if job.format == PartFormat::Stl {
        return Err(GradedError::OnlyStl);
    }
    nested(job, printer).map(Some)
}

/// Refuses drain holes for what floats, and an order of them for what is cut or has no voids.
///
/// # Errors
/// The job orders a diameter, and no hollow piece that stays whole; or one that floats.
pub fn refuse_holes(placed: &Placed) -> Result<(), DrainError> {
    let (job, order) = (&placed.job, placed.job.drain);
    if job.plugs && !placed.is_drained() {
        return Err(DrainError::PlugsOnly);
    }
    let printer = &placed.shop.printer;
    let floats = placed.is_drained() && placed.goal().kind == GoalKind::Float;
    if floats && !job.plugs && order != DrainOrder::Never {
        // Plugs are of no use where no hole empties a void.
        let need = printer.drain_need(order.asked_mm());
        need.map_err(|why| DrainError::of_printer(why, &printer.name, order))?;
        return Err(DrainError::Floats);
    }
    if placed.is_drained() && job.fill.is_some() {
        return Err(DrainError::Filling);
    }
    match order {
        DrainOrder::Diameter(_) if !placed.is_drained() => Err(DrainError::NotWhole { order }),
        DrainOrder::Diameter(_) => {
            // A width that was ordered is for this printer, whatever voids there will be.
            let need = printer.drain_need(order.asked_mm());
            need.map_err(|why| DrainError::of_printer(why, &printer.name, order))?;
            Ok(())
        }
        _ => Ok(()),
    }
}

/// Returns the first order of densities in a job; `None` without any.
fn ordered_density(job: &Job) -> Option<Setting> {
    let density = job.density.map(|order| Setting::new(Key::Density, order));
    let infill = job.infill.map(|wished| Setting::new(Key::Infill, wished));
    let levels = job.levels.map(|count| Setting::new(Key::Levels, count));
    let keep = job.keep.map(|share| Setting::new(Key::Keep, share));
    let field = job.field.as_ref();
    let field = field.map(|field| Setting::new(Key::Field, field));
    density.or(infill).or(levels).or(keep).or(field)
}

/// Refuses a placed goal that one closed piece cannot meet.
///
/// # Errors
/// The object is no single body, or it has cavities of its own.
pub fn refuse_pieces(placed: &Placed) -> Result<(), Error> {
    if placed.sparse.is_none() {
        return Ok(());
    }
    if placed.string_gap_mm().is_some() {
        return Err(GradedError::Halves.into());
    }
    let faces_inward = |shell: &TriMesh| shell.signed_volume_mm3() < 0.0;
    if shells(placed.solid().mesh()).iter().any(faces_inward) {
        return Err(GradedError::Cavities.into());
    }
    Ok(())
}

/// Refuses rounds of another print.
///
/// # Errors
/// They say that more was laid than slicers lay.
pub fn refuse_rounds(placed: &Placed) -> Result<(), SlicedError> {
    let solid = moments_of_mesh(placed.solid().mesh());
    let is_other = |round: &SlicedRound| {
        let infill = round.infill_ratio.map_or(0.0, infill_share);
        let has_no_infill = placed.sparse.is_none() && round.infill_ratio.is_some();
        has_no_infill || infill.max(beyond_ratio(&round.beyond, &solid)) > 1.0
    };
    let own = placed.job.toolpaths.as_ref();
    match placed.job.sliced.iter().any(is_other) || own.is_some_and(|own| !own.is_sound()) {
        true => Err(SlicedError::OtherRounds),
        false => Ok(()),
    }
}

/// Returns the hint that voids do what sparse infill or cells do not, if a solve confirms it.
pub fn hollow_hint(placed: &Placed, watch: &Watch) -> Result<Option<String>, Error> {
    let is_full = placed.sparse.is_some() || placed.cells.is_some();
    if !is_full || placed.goal().kind == GoalKind::Match {
        return Ok(None);
    }
    let what = match placed.cells {
        Some(_) => "cells",
        None => "sparse infill",
    };
    let hollow = Placed {
        fill: Fill::AIR,
        sparse: None,
        cells: None,
        ..placed.clone()
    };
    let found = with_load(&hollow, Load::default(), watch)?;
    let setting = Setting::new(Key::Interior, Interior::Hollow);
    let hint = format!("make voids in place of {what}, and cut them open (`{setting}`)");
    Ok(matches!(found, Verdict::Found(_)).then_some(hint))
}
