//! Numbers rounded to whole steps, for figures that differ in their last digits from run to run.

/// Returns the power of ten at or below a positive number.
pub fn step(number: f64) -> f64 {
    10.0_f64.powf(number.log10().floor())
}

/// Rounds a number to whole steps.
pub fn to_steps(number: f64, step: f64) -> f64 {
    let steps = (number / step).round();
    // A division by a whole power of ten rounds to the fewest digits, a product does not.
    if step < 1.0 {
        steps / step.recip().round() + 0.0
    } else {
        steps * step + 0.0
    }
}
