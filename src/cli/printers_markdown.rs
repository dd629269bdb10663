//! The table of printers in README, made from the profiles.

use std::collections::BTreeSet;

use super::flags::TABLE_BEGIN;
use super::values::show_pixel;
use crate::base::units::show_mm;
use crate::printer::{Printer, Sourced, Sure};

/// The mark after the table of printers in README.
pub const END: &str = "<!-- end of the table -->";

/// Returns the table of these printers, between its two marks.
pub fn markdown(printers: &[Printer]) -> String {
    let head = "| printer | process | pixel or line | layer | least wall | clearance a side | materials | its own numbers are from |";
    let rule = "|---|---|---|---|---|---|---|---|";
    let rows: Vec<String> = printers.iter().map(row).collect();
    format!(
        "{TABLE_BEGIN}\n{head}\n{rule}\n{}\n{END}\n",
        rows.join("\n")
    )
}

fn row(printer: &Printer) -> String {
    let own_mark = |number: &Sourced<f64>| {
        if number.process_default_of.is_some() {
            "*"
        } else {
            ""
        }
    };
    let materials: Vec<String> = printer
        .materials
        .iter()
        .map(|material| format!("{} {}", material.id, material.density_g_cm3.value))
        .collect();
    let cells = [
        format!("`{}`", printer.id),
        printer.process.clone().unwrap_or_default(),
        show_pixel(printer) + own_mark(&printer.pixel_x_mm),
        show_mm(printer.layer_mm.value) + own_mark(&printer.layer_mm),
        walls(printer),
        show_mm(printer.clearance_per_side_mm.value) + own_mark(&printer.clearance_per_side_mm),
        materials.join(", "),
        sources(printer),
    ];
    format!("| {} |", cells.join(" | "))
}

/// Returns the minimum wall, by part size if it depends on that.
fn walls(printer: &Printer) -> String {
    let sized = printer.walls_by_part_size.iter();
    let sized =
        sized.map(|wall| format!("{} (≤ {} mm)", show_mm(wall.wall_mm.value), wall.up_to_mm));
    let mark = if printer.min_wall_mm.process_default_of.is_some() {
        "*"
    } else {
        ""
    };
    let last = show_mm(printer.min_wall_mm.value) + mark;
    sized.chain([last]).collect::<Vec<_>>().join(", ")
}

/// Returns the sources of the numbers that are neither process defaults nor chosen: the first words
/// of each source, once.
fn sources(printer: &Printer) -> String {
    let numbers = printer
        .numbers()
        .into_iter()
        .map(|(_, number)| own_source(number));
    let volumes = [&printer.build_volume_mm, &printer.largest_part_mm]
        .into_iter()
        .flatten()
        .map(own_source);
    let names: BTreeSet<&str> = numbers.chain(volumes).flatten().collect();
    if names.is_empty() {
        "none was found".to_owned()
    } else {
        names.into_iter().collect::<Vec<_>>().join("; ")
    }
}

/// Returns the name of a number's source; `None` if it is a process default or chosen.
fn own_source<T>(number: &Sourced<T>) -> Option<&str> {
    let is_own = number.process_default_of.is_none() && number.sure != Sure::OwnChoice;
    is_own.then(|| name_of(&number.source))
}

/// Returns the words of a source before its details.
fn name_of(source: &str) -> &str {
    source.split([',', ';', ':']).next().unwrap_or(source)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_in_readme_is_the_one_the_profiles_give() {
        let readme = include_str!("../../README.md");
        let table = markdown(&Printer::all().unwrap());
        assert!(
            readme.contains(&table),
            "README is not up to date; replace the lines between the marks by those of\n\
             cargo run -- printers list --markdown\n{table}"
        );
    }

    #[test]
    fn every_printer_has_a_row_and_every_default_of_a_process_a_star() {
        let printers = Printer::all().unwrap();
        let table = markdown(&printers);
        assert_eq!(table.lines().count(), printers.len() + 4);
        let row = |id: &str| {
            table
                .lines()
                .find(|line| line.contains(&format!("`{id}`")))
                .unwrap()
        };
        assert!(row("elegoo-saturn-4-ultra").contains("0.0190 mm × 0.0240 mm"));
        assert!(
            row("eos-p396").contains("0.2500 mm*")
                && row("eos-p396").contains("0.700 mm (≤ 100 mm)")
        );
        assert!(
            row("prusa-mk4").contains("0.4500 mm |"),
            "{}",
            row("prusa-mk4")
        );
    }
}
