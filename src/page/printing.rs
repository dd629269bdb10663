//! The print step: what to load, how solid, on what support, and what to write on the parts.

use maud::{Markup, html};

use super::fields::file_name;
use super::support;
use crate::base::numbers::quantity;
use crate::base::units::MM3_PER_CM3;
use crate::sheet::{Checklist, PartRow};

/// What the names of the packages of whole plates begin with.
const PLATE: &str = "plate";

/// The least cup that is warned of, mm³: a socket or a letter that holds less drips empty and sucks
/// at nothing.
const LEAST_CUP_MM3: f64 = 150.0;

/// The step in which the parts are printed.
pub(super) fn print(sheet: &Checklist) -> Markup {
    html! {
        ul class="plain" {
            li { strong { "Load: " } (load(sheet)) }
            li { strong { "Solid, 100 % infill: " } (solid(sheet)) }
            li { strong { "Support: " } (support::of_all(sheet)) }
            @if sheet.printer.build_volume_mm.is_none() {
                li { strong { "Room: " } "the build volume of this printer is not known; check by hand that every part fits." }
            }
            @if let Some(cups) = cup_warning(sheet) { li { strong { "Mind: " } (cups) "." } }
            @if let Some(parts) = unmarked(sheet) {
                li { strong { "Names: " } "write the id on these parts as they come off the plate, as it has no room in their cut faces: " strong { (parts) } "." }
            }
        }
        ul class="ticks" {
            @for part in &sheet.parts {
                li {
                    strong { (part.id) } ": " (file_name(&part.file)) ", " (part.lies) ". Printed, and looks as in the table of parts."
                    @if let Some(told) = support::of_part(part) { br; (told) }
                }
            }
        }
    }
}

/// Which files go to the slicer.
fn load(sheet: &Checklist) -> Markup {
    let plates: Vec<&String> = sheet
        .files
        .keys()
        .filter(|file| file.starts_with(PLATE))
        .collect();
    html! {
        @if plates.is_empty() { "the part files below" }
        @else {
            @for (index, plate) in plates.iter().enumerate() { @if index > 0 { ", " } code { (plate) } }
            " (all parts laid out on the plate), or the part files below one by one"
        }
        ". They are in mm, each part in its print pose, resting on z = 0. Do not turn, scale or repair them."
    }
}

/// How the printer is set so that material is solid; every mass on the sheet rests on it.
fn solid(sheet: &Checklist) -> Markup {
    let printer = &sheet.printer;
    let how = match printer.process.as_str() {
        "fdm" => format!(
            "perimeters all around, everything between them filled, in lines of {} and layers of {}; both are counted on.",
            quantity(printer.pixel_mm[0], "mm"),
            quantity(printer.layer_mm, "mm")
        ),
        "sla" => format!(
            "no hollowing, no infill and no drain holes by the slicer, in layers of {}.",
            quantity(printer.layer_mm, "mm")
        ),
        "polyjet" | "mjp" => format!(
            "model material all through, no light or sparse filling, in layers of {}.",
            quantity(printer.layer_mm, "mm")
        ),
        _ => format!(
            "no hollowing and no lattice by the build software, in layers of {}.",
            quantity(printer.layer_mm, "mm")
        ),
    };
    html! {
        (how) " The voids are in the files and stay empty: the slicer must neither fill nor add any. "
        "With walls that are not solid every mass on this sheet is wrong, and so is the balance."
    }
}

/// The parts that bear their id in no cut face, where there are several to be told apart.
fn unmarked(sheet: &Checklist) -> Option<String> {
    let parts = sheet.parts.iter().filter(|part| part.marks.is_empty());
    let ids: Vec<&str> = parts.map(|part| part.id.as_str()).collect();
    (sheet.parts.len() > 1 && !ids.is_empty()).then(|| ids.join(", "))
}

/// The parts whose open hollow lies mouth down on the plate of a printer that stands in resin.
fn cups(sheet: &Checklist) -> Vec<&PartRow> {
    let is_cup = |part: &&PartRow| part.cup_mm3 >= LEAST_CUP_MM3 && sheet.printer.process == "sla";
    sheet.parts.iter().filter(is_cup).collect()
}

/// What to do about parts that print as closed cups; none where there are none.
pub fn cup_warning(sheet: &Checklist) -> Option<String> {
    let cups = cups(sheet);
    let told = |part: &&PartRow| {
        format!(
            "{} ({})",
            part.id,
            quantity(part.cup_mm3 / MM3_PER_CM3, "cm³")
        )
    };
    let told: Vec<String> = cups.iter().map(told).collect();
    (!cups.is_empty()).then(|| {
        format!(
            "the mouth of an open hollow lies flat on the platform in {}: a closed cup, which traps resin and sucks at every layer; lean these \
             parts on support, or turn their mouths away from the platform (masses and balance stay as they are)",
            told.join(", ")
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::sample;

    fn told(change: impl Fn(&mut Checklist)) -> String {
        let mut sheet = sample().0;
        change(&mut sheet);
        print(&sheet).into_string()
    }

    #[test]
    fn every_process_is_told_to_print_solid_and_lines_only_where_there_are_lines() {
        for process in ["fdm", "sla", "polyjet", "mjp", "sls", "mjf"] {
            let page = told(|sheet| sheet.printer.process = process.to_owned());
            assert!(
                page.contains("Solid, 100 % infill") && page.contains("layers of 0.016"),
                "{process}"
            );
            assert_eq!(
                page.contains("lines of 0.0423"),
                process == "fdm",
                "{process}"
            );
        }
    }

    #[test]
    fn the_plates_are_named_where_there_are_any_and_the_unknown_build_volume_is_told() {
        let page = told(|sheet| {
            sheet.files.insert("plate_1.3mf".to_owned(), String::new());
            sheet.files.insert("plate_2.3mf".to_owned(), String::new());
        });
        assert!(
            page.contains("plate_1.3mf")
                && page.contains("plate_2.3mf")
                && !page.contains("not known")
        );
        let page = told(|sheet| sheet.printer.build_volume_mm = None);
        assert!(
            !page.contains("plate_") && page.contains("build volume of this printer is not known")
        );
    }

    #[test]
    fn parts_without_an_id_are_named_once() {
        let page = told(|_| ());
        assert_eq!(page.matches("write the id on these parts").count(), 1);
        assert!(page.contains("<strong>P01, P02</strong>"));
        assert!(!told(|sheet| sheet.parts.truncate(1)).contains("write the id"));
    }

    #[test]
    fn only_resin_minds_a_cup() {
        let mut sheet = sample().0;
        sheet.parts[1].cup_mm3 = 5000.0;
        assert_eq!(cup_warning(&sheet), None);
        sheet.printer.process = "sla".to_owned();
        let said = cup_warning(&sheet).unwrap();
        assert!(said.contains("P02 (5\u{a0}cm³)") && !said.contains("P01"));
    }
}
