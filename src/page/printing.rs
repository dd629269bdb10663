//! The print step: the files to load, infill, support, and what to write on the parts.

use maud::{Markup, html};

use super::below;
use super::fields::{THIN_LAYER_MM, UM_PER_MM, file_name, half_name};
use super::figure::{Picture, Role, figures};
use super::hardware::{bar, word};
use super::infill;
use super::support;
use super::toolpaths::weighed;
use crate::base::numbers::{measured, measured_extent, quantity};
use crate::base::units::MM3_PER_CM3;
use crate::mesh::{BRIM_MM, GOOD_FOOT_MM2};
use crate::sheet::{Checklist, PartRow, Process};

/// Least volume of a cup that gets a warning, mm³: a smaller one, such as a socket or a letter,
/// drains and causes no suction.
const LEAST_CUP_MM3: f64 = 150.0;

/// Area of a foot that is hardly more than a point, mm²: a few lines of filament.
const POINT_MM2: f64 = 10.0;

/// The advice where the parts were not held against the machine.
const NO_ROOM_KNOWN: &str =
    "the build volume of this printer is not known; check by hand that every part fits.";

/// Returns the step in which the parts are printed, with a card for every part.
pub(super) fn print_step(sheet: &Checklist, pictures: &[Picture]) -> Markup {
    html! {
        div class="load" {
            ul class="plain" {
                li { strong { "Load: " } (load(sheet)) }
                @match &sheet.infill {
                    Some(infill) => (infill::orders(sheet, infill)),
                    None => li { strong { "Solid, 100 % infill: " } (solid(sheet)) }
                }
                li { strong { "Support: " } (support::of_all(sheet)) }
                @if sheet.printer.process == Process::Fdm {
                    li {
                        strong { "Brim: " }
                        "in the 3MF files, on the parts marked below. Add it if you load STL files. Cut it off flush."
                    }
                }
                @if sheet.printer.build_volume_mm.is_none() {
                    li { strong { "Room: " } (NO_ROOM_KNOWN) " In a profile of your own (" code { "equipoise printers new" } ") write it as " code { "build_volume_mm" } "." }
                }
                @if let Some(parts) = parts_without_id(sheet) {
                    li { strong { "Names: " } "write the id on these parts when they come off the plate: " strong { (parts) } "." }
                }
            }
            (figures(pictures, Role::Plate))
        }
        @if let Some(infill) = &sheet.infill {
            div class="beside" {
                (figures(pictures, Role::CutAway))
                (infill::levels(sheet, infill))
            }
            (infill::slicer_note(infill))
        }
        @if let Some(toolpaths) = &sheet.toolpaths { (weighed(sheet, toolpaths)) }
        div class="cards" { @for part in &sheet.parts { (card(sheet, part, pictures)) } }
        (jigs(sheet))
        (bought(sheet))
    }
}

/// Lists the jigs, which are printed as tools; empty if there are none.
fn jigs(sheet: &Checklist) -> Markup {
    html! {
        @if !sheet.jigs.is_empty() {
            p {
                "Tools to print as well, of any material. Each lies as in its file and needs no support; its mass does not matter."
                @if !sheet.plates.is_empty() && sheet.printer.process != Process::Fdm {
                    " They are on the plate too: delete them there if a cheaper printer makes them."
                }
            }
            ul class="ticks" {
                @for jig in &sheet.jigs {
                    li {
                        strong { (jig.order.id) } ", for joint " (jig.order.joint) ", "
                        (measured_extent(&jig.size_mm)) ", " (measured(jig.mass_g, "g")) ": "
                        (file_name(&jig.order.file))
                    }
                }
            }
        }
    }
}

/// Lists the hardware, which is bought and not printed; empty if there is none.
fn bought(sheet: &Checklist) -> Markup {
    html! {
        @if !sheet.hardware.is_empty() {
            p { "Buy or cut:" }
            ul class="ticks" {
                @for piece in &sheet.hardware {
                    li { strong { (piece.id) } ", " (word(&piece.kind)) ": " (bar(piece)) }
                }
            }
        }
    }
}

/// Returns what a part looks like on its plate, and what is set for it.
fn card(sheet: &Checklist, part: &PartRow, pictures: &[Picture]) -> Markup {
    let is_part = |picture: &&Picture| part.picture.as_ref() == Some(&picture.file);
    let below = below::picture_file(&part.id);
    let below = pictures.iter().find(|picture| picture.file == below);
    html! {
        div class="part" {
            div class="shots" {
                @if let Some(picture) = pictures.iter().find(is_part) { (picture.image()) }
                @if let Some(picture) = below { (picture.image()) }
            }
            div {
                (orders(sheet, part))
                @if let Some(picture) = below { p class="small" { (picture.caption) } }
            }
        }
    }
}

/// Returns the name of a part, how it lies, its file, its support, and how it drains.
fn orders(sheet: &Checklist, part: &PartRow) -> Markup {
    html! {
        p class="tick" {
            strong class="part-id" { (part.id) }
            @if let Some(half) = part.half { ", half " (half_name(half)) }
            @if let Some(hole) = sheet.hole_of_plug(&part.id) { ", plug of " (hole.id) }
            ": " (part.lies) ". Part OK ☐"
        }
        p { (file_name(&part.file)) }
        @if let Some(words) = support::of_part(sheet, part) { p { (words) } }
        @if let Some(words) = brim_words(part) { p { (words) } }
        @if !part.drains_over.is_empty() {
            p { "Drain: hold cut face " (part.drains_over.join(" or ")) " down over the vat until no resin drips, then wash." }
        }
    }
}

/// Words the brim that holds a part on the plate; `None` if its foot is large enough, or if the
/// process has none.
fn brim_words(part: &PartRow) -> Option<String> {
    let foot_mm2 = part.support?.foot_mm2;
    let foot = measured(foot_mm2, "mm²");
    let brim = quantity(BRIM_MM, "mm");
    if foot_mm2 < POINT_MM2 {
        return Some(format!(
            "Brim {brim}: it stands on a point ({foot}) and on its support. Do not start without the brim."
        ));
    }
    (foot_mm2 < GOOD_FOOT_MM2).then(|| format!("Brim {brim}: it stands on {foot} only."))
}

/// Returns the files to load into the slicer.
fn load(sheet: &Checklist) -> Markup {
    let plates: Vec<&str> = sheet.plate_files().collect();
    html! {
        @if plates.is_empty() { "the part files below" }
        @else {
            @for (index, plate) in plates.iter().enumerate() { @if index > 0 { ", " } code { (plate) } }
            (all_that_is_on(plates.len()))
            @if sheet.infill.is_none() { ", or the part files below one by one" }
        }
        ". Lengths are in mm; every part lies as in its picture. " (handling(&sheet.printer.process))
    }
}

/// Words what lies on the plates.
fn all_that_is_on(plates: usize) -> &'static str {
    match plates {
        1 => " (everything on one plate)",
        _ => " (everything, a plate each)",
    }
}

/// Returns what the slicer may do with the parts.
fn handling(process: &Process) -> &'static str {
    match process {
        Process::Fdm => "Do not turn, scale or repair them.",
        Process::Sla => {
            "They lean so that no layer encloses resin. Keep their poses. If you must turn a part, keep every mouth on the platform's side, at least 10° off level, and never flat on the platform. Never scale or repair them."
        }
        _ => "You may turn a part. Never scale or repair it.",
    }
}

/// Returns the settings for solid material, on which every mass on the sheet depends.
fn solid(sheet: &Checklist) -> Markup {
    let printer = &sheet.printer;
    let how = match &printer.process {
        Process::Fdm => format!(
            "line width {}, layers of {}. Do not change them: the masses depend on them.",
            quantity(printer.pixel_mm[0], "mm"),
            layer(sheet)
        ),
        Process::Sla => format!(
            "no hollowing, no infill and no drain holes by the slicer, in layers of {}.",
            layer(sheet)
        ),
        Process::Polyjet | Process::Mjp => format!(
            "model material all through, no light or sparse filling, in layers of {}.",
            layer(sheet)
        ),
        _ => format!(
            "no hollowing and no lattice by the build software, in layers of {}.",
            layer(sheet)
        ),
    };
    html! {
        (how) " The voids are in the files: they stay empty."
    }
}

/// Words the height of a layer as machines name it: in micrometres if it is thin.
fn layer(sheet: &Checklist) -> String {
    let layer_mm = sheet.printer.layer_mm;
    if layer_mm < THIN_LAYER_MM {
        format!("{:.0}\u{a0}µm", layer_mm * UM_PER_MM)
    } else {
        quantity(layer_mm, "mm")
    }
}

/// Names the parts without an id in a cut face; `None` if there are none or only one part.
fn parts_without_id(sheet: &Checklist) -> Option<String> {
    // Plugs are told by their holes.
    let is_plug = |part: &PartRow| sheet.hole_of_plug(&part.id).is_some();
    let bodies = sheet.parts.iter().filter(|part| !is_plug(part));
    let bodies: Vec<&PartRow> = bodies.collect();
    let parts = bodies.iter().filter(|part| part.marks.is_empty());
    let ids: Vec<&str> = parts.map(|part| part.id.as_str()).collect();
    (bodies.len() > 1 && !ids.is_empty()).then(|| ids.join(", "))
}

/// Returns the parts that enclose resin in the pose of their files.
fn cups(sheet: &Checklist) -> Vec<&PartRow> {
    let is_cup =
        |part: &&PartRow| part.cup_mm3 >= LEAST_CUP_MM3 && sheet.printer.process == Process::Sla;
    sheet.parts.iter().filter(is_cup).collect()
}

/// Words a warning of parts that print as closed cups; `None` if there are none.
pub fn cup_warning(sheet: &Checklist) -> Option<String> {
    let cups = cups(sheet);
    let name = |part: &&PartRow| {
        format!(
            "{} ({})",
            part.id,
            quantity(part.cup_mm3 / MM3_PER_CM3, "cm³")
        )
    };
    let names: Vec<String> = cups.iter().map(name).collect();
    (!cups.is_empty()).then(|| {
        format!(
            "no pose was found in which {} encloses no resin: a cup, which the film sucks on at every layer; ask for another cut",
            names.join(", ")
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::Drawn;
    use crate::sheet::SupportRow;
    use crate::testing::sample;

    fn page_of(change: impl Fn(&mut Checklist)) -> String {
        let mut sheet = sample().0;
        change(&mut sheet);
        print_step(&sheet, &[]).into_string()
    }

    #[test]
    fn every_process_prints_solid_and_only_fdm_has_lines() {
        for process in ["fdm", "sla", "polyjet", "mjp", "sls", "mjf"] {
            let page = page_of(|sheet| sheet.printer.process = process.to_owned().into());
            assert!(
                page.contains("Solid, 100 % infill") && page.contains("layers of 16\u{a0}µm"),
                "{process}"
            );
            assert_eq!(
                page.contains("line width 0.0423"),
                process == "fdm",
                "{process}"
            );
        }
    }

    #[test]
    fn plates_and_an_unknown_build_volume_are_named() {
        let page = page_of(|sheet| {
            sheet.files.insert("plate_1.3mf".to_owned(), String::new());
            sheet.files.insert("plate_2.3mf".to_owned(), String::new());
        });
        assert!(
            page.contains("plate_1.3mf")
                && page.contains("plate_2.3mf")
                && !page.contains("not known")
        );
        let page = page_of(|sheet| sheet.printer.build_volume_mm = None);
        assert!(
            !page.contains("plate_")
                && page.contains("build volume of this printer is not known")
                && page.contains("equipoise printers new")
        );
    }

    #[test]
    fn a_part_on_a_small_foot_gets_a_brim_and_one_on_a_point_a_word_of_warning() {
        let mut part = sample().0.parts.remove(0);
        assert_eq!(brim_words(&part), None);
        let mut words = |foot_mm2: f64| {
            let foot = SupportRow {
                foot_mm2,
                ..SupportRow::default()
            };
            part.support = Some(foot);
            brim_words(&part)
        };
        assert_eq!(words(50.0), None);
        assert_eq!(
            words(20.0).unwrap(),
            "Brim 5\u{a0}mm: it stands on 20\u{a0}mm² only."
        );
        assert!(
            words(6.0)
                .unwrap()
                .contains("Do not start without the brim")
        );
    }

    #[test]
    fn a_picture_from_below_says_what_its_red_means() {
        let sheet = sample().0;
        let said = |file: String| {
            let picture = Picture {
                file,
                role: Role::Below,
                caption: below::CAPTION.to_owned(),
                alt: String::new(),
                drawn: Drawn::Png(Vec::new()),
            };
            print_step(&sheet, &[picture]).into_string()
        };
        let page = said(below::picture_file("P01"));
        assert_eq!(page.matches("Red: where support touches").count(), 1);
        assert!(!said(String::new()).contains("Red:"));
    }

    #[test]
    fn parts_without_an_id_are_named_once() {
        let page = page_of(|_| ());
        assert_eq!(page.matches("write the id on these parts").count(), 1);
        assert!(page.contains("<strong>P01, P02</strong>"));
        assert!(!page_of(|sheet| sheet.parts.truncate(1)).contains("write the id"));
    }

    #[test]
    fn parts_of_resin_keep_their_poses_and_no_mouth_lies_flat_on_the_platform() {
        let page = page_of(|sheet| sheet.printer.process = Process::Sla);
        assert!(page.contains("Keep their poses") && page.contains("never flat on the platform"));
        assert!(!page.contains("turn them as you like"));
    }

    #[test]
    fn only_resin_printers_are_warned_of_cups() {
        let mut sheet = sample().0;
        sheet.parts[1].cup_mm3 = 5000.0;
        assert_eq!(cup_warning(&sheet), None);
        sheet.printer.process = Process::Sla;
        let said = cup_warning(&sheet).unwrap();
        assert!(said.contains("P02 (5\u{a0}cm³)") && !said.contains("P01"));
    }
}
