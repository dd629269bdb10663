//! The toolpaths that were weighed when the kit was made: plates, parts, and how they balance.

use maud::{Markup, html};

use super::fields::file_name;
use crate::base::numbers::{measured, quantity};
use crate::base::units::show_minutes;
use crate::sheet::{Checklist, ToolpathsRow};

/// Digits of a hash that tell one profile from another.
const SHOWN_HASH: usize = 12;

/// Returns what the toolpaths weigh and take, plate by plate and part by part.
pub(super) fn weighed(sheet: &Checklist, toolpaths: &ToolpathsRow) -> Markup {
    html! {
        p {
            strong { "Sliced and weighed: " }
            "this kit was sliced by " (toolpaths.slicer) " with the settings of its printer"
            @if let Some(sha256) = &toolpaths.profile_sha256 {
                ", and else those of the profile whose SHA-256 begins with "
                code { (sha256.chars().take(SHOWN_HASH).collect::<String>()) }
            }
            ". "
            (balance(toolpaths)) " " (rounds(sheet))
        }
        (plates(toolpaths))
        (parts(sheet, toolpaths))
    }
}

/// Words how the toolpaths balance, beside the promise.
fn balance(toolpaths: &ToolpathsRow) -> String {
    let tilt = toolpaths.tilt_deg.map_or(String::new(), |deg| {
        format!(", and its axis leans {:.3}° beyond it", deg.max(0.0))
    });
    format!(
        "The object that its toolpaths lay weighs {}. Its centre of mass is {:.4}\u{a0}mm from the \
         promised one{tilt}.",
        quantity(toolpaths.mass_g, "g"),
        toolpaths.miss_mm
    )
}

/// Words the rounds before, in which the kit was made again; empty if there were none.
fn rounds(sheet: &Checklist) -> String {
    let of_hollow = sheet.laid.as_ref().map(|laid| &laid.misses_mm);
    let of_infill = sheet.infill.as_ref().map(|infill| &infill.misses_mm);
    let misses_mm = of_hollow.or(of_infill).filter(|misses| !misses.is_empty());
    misses_mm.map_or(String::new(), |misses_mm| {
        let words: Vec<String> = misses_mm.iter().map(|mm| format!("{mm:.4}")).collect();
        format!(
            "Before the kit was made again with what they lay, it was {}\u{a0}mm.",
            words.join(", then ")
        )
    })
}

/// Returns the table of plates; their sum if there are several.
fn plates(toolpaths: &ToolpathsRow) -> Markup {
    let filament_g: Option<f64> = toolpaths.plates.iter().map(|plate| plate.filament_g).sum();
    let parts_g: f64 = toolpaths.plates.iter().map(|plate| plate.parts_g).sum();
    html! {
        table class="stack" {
            thead {
                tr {
                    th scope="col" { "Plate" } th scope="col" class="n" { "Time" }
                    th scope="col" class="n" { "Parts" }
                    th scope="col" class="n" { "Support, brim, skirt" }
                    th scope="col" class="n" { "Filament" }
                }
            }
            tbody {
                @for plate in &toolpaths.plates {
                    tr {
                        th scope="row" { (file_name(&plate.file)) }
                        td class="n" data-head="Time" { (show_minutes(plate.minutes)) }
                        td class="n" data-head="Parts" { (quantity(plate.parts_g, "g")) }
                        td class="n" data-head="Support, brim, skirt" { (quantity(plate.support_g, "g")) }
                        td class="n" data-head="Filament" { (filament(plate.filament_g)) }
                    }
                }
                @if toolpaths.plates.len() > 1 {
                    tr {
                        th scope="row" { "all plates" }
                        td class="n" data-head="Time" { (toolpaths.time()) }
                        td class="n" data-head="Parts" { (quantity(parts_g, "g")) }
                        td class="n" data-head="Support, brim, skirt" { (quantity(toolpaths.support_g(), "g")) }
                        td class="n" data-head="Filament" { (filament(filament_g)) }
                    }
                }
            }
        }
    }
}

fn filament(mass_g: Option<f64>) -> String {
    mass_g.map_or_else(|| "not stated".to_owned(), |mass_g| quantity(mass_g, "g"))
}

/// Returns the table of parts: as they were written, and as they are laid.
fn parts(sheet: &Checklist, toolpaths: &ToolpathsRow) -> Markup {
    let rows = sheet.parts.iter();
    let rows = rows.filter_map(|part| Some((part, toolpaths.mass_of(&part.id)?)));
    html! {
        table class="stack" {
            thead {
                tr {
                    th scope="col" { "Part" }
                    th scope="col" class="n" { "By its file" }
                    th scope="col" class="n" { "As it is laid" }
                }
            }
            tbody {
                @for (part, laid_g) in rows {
                    tr {
                        th scope="row" { (part.id) }
                        td class="n" data-head="By its file" { (measured(part.mass_g, "g")) }
                        td class="n" data-head="As it is laid" { (measured(laid_g, "g")) }
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sheet::{ToolpathPart, ToolpathPlate};
    use crate::testing::sample;
    use crate::verify::LaidOrder;

    #[test]
    fn the_sheet_says_what_the_toolpaths_weigh_take_and_miss_by() {
        let sheet = Checklist {
            laid: Some(LaidOrder {
                beyond: [0.0; 10],
                misses_mm: vec![0.1007, 0.0213],
            }),
            ..sample().0
        };
        let plate = ToolpathPlate {
            file: "plate_1.3mf".to_owned(),
            minutes: 185,
            parts_g: 40.0,
            support_g: 2.5,
            filament_g: None,
        };
        let toolpaths = ToolpathsRow {
            slicer: "PrusaSlicer 2.5.0".to_owned(),
            profile_sha256: Some("0123456789abcdef".repeat(4)),
            mass_g: 51.25,
            miss_mm: 0.0034,
            tilt_deg: Some(0.012),
            plates: vec![plate.clone(), plate],
            parts: vec![ToolpathPart {
                id: sheet.parts[0].id.clone(),
                mass_g: 20.89,
            }],
        };
        let words = weighed(&sheet, &toolpaths).into_string();
        let words = words.replace('\u{a0}', " ").replace("<wbr>", "");
        for said in [
            "PrusaSlicer 2.5.0",
            "begins with <code>0123456789ab</code>",
            "0.0034 mm",
            "0.012°",
            "0.1007, then 0.0213 mm",
            "3 h 5 min",
            "6 h 10 min",
            "not stated",
            "20.9 g",
        ] {
            assert!(words.contains(said), "{said}: {words}");
        }
        let alone = weighed(&sample().0, &toolpaths).into_string();
        assert!(!alone.contains("made again"), "{alone}");
    }
}
