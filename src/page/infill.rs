//! The infill of a print in one piece: what to set, where, and what each density weighs.

use maud::{Markup, html};

use super::fields::file_name;
use crate::base::numbers::{measured, quantity};
use crate::base::units::MM3_PER_CM3;
use crate::sheet::Checklist;
use crate::verify::InfillOrder;

/// Returns the orders for the infill, in place of those for solid print.
pub(super) fn orders(sheet: &Checklist, infill: &InfillOrder) -> Markup {
    let printer = &sheet.printer;
    let percent = percent(infill.nominal_ratio);
    html! {
        li {
            strong { "One piece, two infills: " }
            "the object is 100 % rectilinear infill; the region inside it is " (percent) " "
            (infill.pattern) ". The plate sets both. Line width "
            (quantity(printer.pixel_mm[0], "mm")) ", layers of " (quantity(printer.layer_mm, "mm"))
            ". Do not change them: the balance depends on them."
        }
        li {
            strong { "PrusaSlicer only: " }
            "other slicers do not read the region. "
            @if let Some(file) = &infill.file {
                "Not tried: load the part file, add " (file_name(file))
                " to it as a modifier without moving it, and set the infills by hand."
            }
        }
    }
}

/// Returns the table of densities: what to set, what is laid, and what it weighs.
pub(super) fn levels(sheet: &Checklist, infill: &InfillOrder) -> Markup {
    let all_mm3 = sheet.parts.iter().map(|part| part.volume_mm3).sum::<f64>();
    let all_g = sheet.parts.iter().map(|part| part.mass_g).sum::<f64>();
    let rows = [
        ("solid", [1.0, 1.0], all_mm3, all_g - infill.mass_g),
        (
            "sparse",
            [infill.nominal_ratio, infill.laid_ratio],
            infill.volume_mm3,
            infill.mass_g,
        ),
    ];
    html! {
        table class="stack" {
            thead {
                tr {
                    th scope="col" { "Print" } th scope="col" class="n" { "Infill to set" }
                    th scope="col" class="n" { "Laid" } th scope="col" class="n" { "Volume" }
                    th scope="col" class="n" { "Mass" }
                }
            }
            tbody {
                @for (name, [set, laid], volume_mm3, mass_g) in rows {
                    tr {
                        th scope="row" { (name) }
                        td class="n" data-head="Infill to set" { (percent(set)) }
                        td class="n" data-head="Laid" { (percent(laid)) }
                        td class="n" data-head="Volume" { (measured(volume_mm3 / MM3_PER_CM3, "cm³")) }
                        td class="n" data-head="Mass" { (measured(mass_g, "g")) }
                    }
                }
            }
        }
    }
}

/// Returns the words for a part whose weight is wrong.
pub(super) fn wrong_weight() -> &'static str {
    "Too heavy: the region inside was printed solid. Too light: the rest was not."
}

fn percent(ratio: f64) -> String {
    measured(100.0 * ratio, "%")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::sample;

    fn graded() -> (Checklist, InfillOrder) {
        let infill = InfillOrder {
            pattern: "gyroid".to_owned(),
            nominal_ratio: 0.15,
            laid_ratio: 0.142,
            regions: 1,
            volume_mm3: 2000.0,
            mass_g: 0.35,
            beyond: None,
            misses_mm: Vec::new(),
            file: Some("modifiers/bunny_15percent.stl".to_owned()),
        };
        let sheet = Checklist {
            infill: Some(infill.clone()),
            ..sample().0
        };
        (sheet, infill)
    }

    #[test]
    fn the_orders_name_the_pattern_the_density_and_the_file_of_the_region() {
        let (sheet, infill) = graded();
        let words = orders(&sheet, &infill).into_string().replace("<wbr>", "");
        for said in [
            "15",
            "gyroid",
            "bunny_15percent.stl",
            "PrusaSlicer",
            "Not tried",
        ] {
            assert!(words.contains(said), "{said}: {words}");
        }
    }

    #[test]
    fn the_densities_are_listed_with_what_is_laid_and_what_it_weighs() {
        let (sheet, infill) = graded();
        let table = levels(&sheet, &infill).into_string();
        for said in ["solid", "sparse", "14.2", "0.35"] {
            assert!(table.contains(said), "{said}: {table}");
        }
    }
}
