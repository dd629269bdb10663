//! Fields: a family fitted to the goal, or a field with its numbers, in the regions of a print.

use super::densities::{fill, nested};
use super::drawn::drawn;
use super::levels::{COARSE_COLUMNS, with_load};
use super::stock::Stock;
use crate::ballast::Load;
use crate::base::setting::{Key, Setting};
use crate::base::verdict::Verdict;
use crate::base::watch::{Phase, Watch};
use crate::error::{Error, GradedError};
use crate::hollow::{Family, NearWished, PrintField, Problem, Shape};
use crate::interior::Columns;
use crate::job::{FieldOrder, GivenField, Job};
use crate::run::{LaidField, Nested, Placed};
use crate::shell::Shell;

/// Returns a placed goal with the field that its job orders in its regions. Without one it stays as
/// it is.
///
/// What toolpaths lay beyond the parts is left out, so that all rounds have the same regions.
///
/// # Errors
/// The inside cannot be measured, or the watch was stopped.
pub fn with_field(placed: Placed, watch: &Watch) -> Result<Placed, Error> {
    let sparse = placed.sparse.as_ref();
    let near = sparse.and_then(|sparse| sparse.near.as_ref());
    let (Some(order), Some(sparse), Some(near)) = (&placed.job.field, sparse, near) else {
        return Ok(placed);
    };
    let (goal, wall_mm) = (placed.goal(), placed.shop.wall.wall_mm);
    watch.enter(Phase::Columns);
    let shell = Shell::new(
        placed.solid(),
        &goal.frame,
        wall_mm,
        &placed.placement.keeps,
    )?;
    let columns = Columns::of_shell(&shell, shell.coarse_pitch(COARSE_COLUMNS), watch)?;
    if let Some(nested) = drawn(&placed, &columns, watch)? {
        return Ok(laying(placed, nested));
    }
    watch.enter(Phase::Solve);
    let problem = Problem {
        goal,
        fixed: goal.solid,
        columns: &columns,
    };
    let field =
        print_field(order, near, &problem, watch).ok_or_else(|| GradedError::FieldTooFine {
            field: Box::new(order.clone()),
        })?;
    watch.check()?;
    let own = Stock {
        printer: &placed.shop.printer,
        sparse,
    };
    let levels = field.regions.iter().filter_map(|region| own.level(region));
    let nested = Nested {
        levels: levels.collect(),
        field: Some(LaidField::Shaped(field)),
        ..sparse.clone()
    };
    Ok(laying(placed, nested))
}

/// Returns a placed goal with these regions.
fn laying(placed: Placed, nested: Nested) -> Placed {
    Placed {
        fill: fill(&nested).unwrap_or(placed.fill),
        sparse: Some(nested),
        ..placed
    }
}

/// Returns the field of an order on the columns of a problem; `None` if it is too fine to print.
fn print_field(
    order: &FieldOrder,
    near: &NearWished,
    problem: &Problem,
    watch: &Watch,
) -> Option<PrintField> {
    let levels = &near.levels;
    let shape = |shape: Shape| {
        let local = shape.in_frame(&problem.goal.frame);
        PrintField::given(local, levels, problem)
    };
    match order {
        FieldOrder::FitRamp => Some(PrintField::fit(Family::Ramp, near, problem, watch)),
        FieldOrder::FitSine => Some(PrintField::fit(Family::Sine, near, problem, watch)),
        FieldOrder::Given { field, .. } | FieldOrder::File { field, .. } => match field {
            GivenField::Uniform(density) => Some(PrintField::uniform(*density, levels.range())),
            GivenField::Ramp(ramp) => shape(Shape::of_ramp(ramp)),
            GivenField::Sine(sine) => shape(Shape::of_sine(sine)),
            // Drawn before.
            GivenField::Skin(_) | GivenField::Drawn(_) => None,
        },
    }
}

/// Returns the hint that the best densities do what a field does not, if a solve confirms it.
pub fn field_hint(placed: &Placed, watch: &Watch) -> Result<Option<String>, Error> {
    let Some(field) = &placed.job.field else {
        return Ok(None);
    };
    let job = Job {
        field: None,
        levels: placed.job.levels.filter(|_| placed.job.infill.is_some()),
        ..placed.job.clone()
    };
    // What does not print is no remedy.
    let Ok(sparse) = nested(&job, &placed.shop.printer) else {
        return Ok(None);
    };
    let best = Placed {
        fill: fill(&sparse).unwrap_or(placed.fill),
        sparse: Some(sparse),
        job,
        ..placed.clone()
    };
    let found = with_load(&best, Load::default(), watch)?;
    let setting = Setting::new(Key::Field, field);
    let hint = format!("leave `{setting}` out: the best densities do it");
    Ok(matches!(found, Verdict::Found(_)).then_some(hint))
}
