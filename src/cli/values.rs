//! The values of a printer's profile in words.

use serde::Serialize;

use crate::base::units::show_mm;
use crate::printer::{Printer, Quantity};

/// Returns the steps along x and y, once if they are equal.
pub(super) fn show_pixel(printer: &Printer) -> String {
    let (x, y) = (printer.pixel_x_mm.value, printer.pixel_y_mm.value);
    if x == y {
        show_step(x)
    } else {
        format!("{} × {}", show_step(x), show_step(y))
    }
}

/// Returns a number of a profile with its unit.
pub(super) fn show_number(quantity: Quantity, value: f64) -> String {
    match quantity {
        Quantity::LayerLeastMm | Quantity::LayerMostMm => show_step(value),
        _ if quantity.is_grid_step() => show_step(value),
        _ if quantity.is_ratio() => value.to_string(),
        _ if quantity.is_angle() => format!("{value}°"),
        Quantity::GlueDensityGCm3 => format!("{value} g/cm³"),
        Quantity::GlueHoldS => format!("{value} s"),
        Quantity::GlueCureH => format!("{value} h"),
        Quantity::WallFlowMm3S | Quantity::SolidFlowMm3S => format!("{value} mm³/s"),
        _ => show_mm(value),
    }
}

/// Returns a step of a grid, to a tenth of a micrometre.
pub(super) fn show_step(step_mm: f64) -> String {
    format!("{step_mm:.4} mm")
}

/// Returns the sides of a box, mm.
pub(super) fn show_box([x, y, z]: [f64; 3]) -> String {
    format!("{x} × {y} × {z} mm")
}

/// Returns the word that stands for an enum's variant in profiles.
pub(super) fn kebab(value: &impl Serialize) -> String {
    serde_json::to_value(value)
        .ok()
        .and_then(|word| word.as_str().map(str::to_owned))
        .unwrap_or_default()
}
