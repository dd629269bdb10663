//! Given: the densities of infill of a field that is ordered with its numbers.

use crate::error::GradedError;
use crate::job::{DensityOrder, InfillDensity, Job};
use crate::printer::Printer;

/// Distance of two densities that are the same, as a share of solid print: the rounding of orders.
pub const SAME_RATIO: f64 = 1e-5;

/// The greatest density to set that is infill, over solid print.
const GREATEST_INFILL: f64 = 0.99;

/// Returns the densities of infill that a field with its numbers has; `None` if it leaves them
/// open. One that is the same everywhere has the printer's own around it. `inside` are the least
/// and the greatest density of a field that depends on the model, as far as they are known.
///
/// # Errors
/// The job orders other densities, or the printer does not lay these.
pub fn densities(
    job: &Job,
    printer: &Printer,
    usual: DensityOrder,
    inside: Option<[f64; 2]>,
) -> Result<Option<DensityOrder>, GradedError> {
    let (Some(field), Some(pattern)) = (&job.field, &printer.infill) else {
        return Ok(None);
    };
    let Some(given) = field.given() else {
        return Ok(None);
    };
    if let Some(order) = job.density {
        return Err(GradedError::FieldDensities {
            field: Box::new(field.clone()),
            order,
        });
    }
    let Some(densities) = given.densities().or(inside) else {
        return Ok(None);
    };
    let least = pattern.laid_ratio(usual.low().ratio());
    let most = pattern.laid_ratio(GREATEST_INFILL);
    let is_within = |density: &f64| {
        let is_infill = (least - SAME_RATIO..=most + SAME_RATIO).contains(density);
        // Solid print is no infill, but may lie around it.
        is_infill || *density == 1.0 && densities[0] < 1.0 && inside.is_none()
    };
    if !densities.iter().all(is_within) {
        let (field, printer) = (Box::new(field.clone()), printer.name.clone());
        return Err(match inside {
            Some(found) => GradedError::FieldBeyondInside {
                field,
                printer,
                found,
                lays: [least, most],
            },
            None => GradedError::FieldBeyond {
                field,
                printer,
                least,
                most,
            },
        });
    }
    let nominal = |density: f64| {
        let nominal = pattern.nominal_ratio(density);
        InfillDensity::of_ratio(nominal.max(usual.low().ratio())).unwrap_or(usual.low())
    };
    let [low, high] = densities.map(nominal);
    // The same everywhere is one region, and is compared with all that the printer lays.
    Ok(Some(DensityOrder::new(low, high).unwrap_or(usual)))
}
