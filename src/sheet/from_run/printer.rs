//! The rows of the printer and its material, with the sources of their numbers.

use crate::printer::{Material, Printer, Quantity, Support, Unknown};
use crate::sheet::{GlueRow, MaterialRow, PrinterRow, SupportMethod};

/// Returns the printer as far as the shop and the judge need it, with the least wall of a model.
pub fn printer_row(printer: &Printer, minimum_wall_mm: f64) -> PrinterRow {
    let number = |quantity| printer.number(quantity).map(|number| number.value);
    PrinterRow {
        id: printer.id.clone(),
        profile_sha256: printer.profile_sha256.clone(),
        name: printer.name.clone(),
        process: printer.process.clone().unwrap_or_default().into(),
        pixel_mm: [printer.pixel_x_mm.value, printer.pixel_y_mm.value],
        layer_mm: printer.layer_mm.value,
        dialect: printer.dialect(),
        build_volume_mm: printer.usable_volume_mm(),
        print_scale_ratio: enlargement(printer.print_scale_ratio()),
        support: support_method(printer.support),
        minimum_wall_mm,
        minimum_opening_mm: printer.min_opening_mm.value,
        cleaning: printer.cleaning_rule(),
        least_pin_mm: Some(printer.pin_min_diameter_mm.value),
        seam_step_mm: number(Quantity::SeamStepMm),
        glue: glue_row(printer),
        sources: sources(printer),
    }
}

/// Returns the glue that the printer's profile names.
fn glue_row(printer: &Printer) -> Option<GlueRow> {
    let number = |quantity| printer.number(quantity).map(|number| number.value);
    Some(GlueRow {
        name: printer.glue.clone()?,
        hold_s: number(Quantity::GlueHoldS),
        cure_h: number(Quantity::GlueCureH),
        safety: printer.glue_safety.clone(),
    })
}

/// Returns the sources of the printer's numbers, a sentence each, and what is not known.
fn sources(printer: &Printer) -> Vec<String> {
    let words = |key: &str| key.trim_end_matches("_mm").replace('_', " ");
    let numbers = printer.numbers().into_iter();
    let numbers = numbers
        .filter(|(quantity, _)| !quantity.is_for_estimates())
        .map(|(quantity, number)| format!("{}: {}", words(quantity.key()), number.provenance()));
    let volume = printer
        .build_volume_mm
        .iter()
        .map(|volume| format!("build volume: {}", volume.provenance()));
    let none = printer.build_volume_mm.is_none();
    let unfit =
        none.then(|| "build volume: not known; check by hand that the parts fit".to_owned());
    let corners = printer.excluded_corners.iter().map(|corner| {
        let [x, y] = corner.size_mm.value;
        format!(
            "keep clear of a corner of {x} × {y} mm: {}",
            corner.size_mm.provenance()
        )
    });
    let unknown: Vec<String> = printer
        .unknown()
        .into_iter()
        .filter(|unknown| *unknown != Unknown::BuildVolume)
        .map(|unknown| words(unknown.key()))
        .collect();
    let unknown =
        (!unknown.is_empty()).then(|| format!("not known of this printer: {}", unknown.join(", ")));
    numbers
        .chain(volume)
        .chain(unfit)
        .chain(corners)
        .chain(unknown)
        .collect()
}

/// Returns the factors by which files are enlarged; `None` if they have nominal size.
pub fn enlargement(ratio: [f64; 3]) -> Option<[f64; 3]> {
    (ratio != [1.0; 3]).then_some(ratio)
}

/// Returns the material, with a weighing window if its density was measured.
pub fn material_row(material: &Material) -> MaterialRow {
    MaterialRow {
        id: material.id.clone(),
        name: material.name.clone(),
        density_g_cm3: material.density_g_cm3.value,
        density_source: material.density_g_cm3.source.clone(),
        density_sure: material.density_g_cm3.sure.to_string(),
        density_spread_ratio: material.measured_spread_ratio(),
        typical_spread_ratio: material
            .density_spread_ratio
            .as_ref()
            .map(|spread| spread.value),
    }
}

/// Returns the note on files that make up for shrinkage.
pub fn scale_note([x, y, z]: [f64; 3]) -> String {
    format!(
        "part files are larger than the parts by {x:.5}, {y:.5} and {z:.5} along x, y and z, as this machine does not make up for \
         shrinkage: do not scale them again"
    )
}

fn support_method(support: Support) -> SupportMethod {
    match support {
        Support::Soluble => SupportMethod::Soluble,
        Support::Breakaway => SupportMethod::Breakaway,
        Support::WaterJet => SupportMethod::WaterJet,
        Support::None => SupportMethod::None,
    }
}
