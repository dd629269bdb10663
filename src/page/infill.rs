//! The infill of a print in one piece: what to set, where, and what each density weighs.

use maud::{Markup, html};

use super::fields::file_name;
use crate::base::dialect::Dialect;
use crate::base::numbers::{measured, quantity};
use crate::base::units::MM3_PER_CM3;
use crate::sheet::Checklist;
use crate::verify::{InfillLevel, InfillOrder};

/// Returns the orders for the infill, in place of those for solid print.
pub(super) fn orders(sheet: &Checklist, infill: &InfillOrder) -> Markup {
    let printer = &sheet.printer;
    let regions = infill.levels();
    let (count, region) = match regions.as_slice() {
        [_] => ("two", "the region inside it is "),
        _ => ("several", "the regions inside it, one in the other, are "),
    };
    let percents: Vec<String> = regions.iter().map(|it| percent(it.nominal_ratio)).collect();
    html! {
        li {
            strong { "One piece, " (count) " infills: " }
            "the object is 100 % rectilinear infill; " (region) (percents.join(", then ")) " "
            (infill.pattern) ". The plate sets all. Line width "
            (quantity(printer.pixel_mm[0], "mm")) ", layers of " (quantity(printer.layer_mm, "mm"))
            ". Do not change them: the balance depends on them."
        }
        li {
            strong { (printer.dialect.slicers()) " only: " }
            (readers(printer.dialect)) " "
            @if infill.file.is_some() {
                "Not tried: load the part file, add "
                @for (index, file) in regions.iter().filter_map(|it| it.file.as_ref()).enumerate() {
                    @if index > 0 { ", then " }
                    (file_name(file))
                }
                @if regions.len() > 1 { " to it as modifiers" } @else { " to it as a modifier" }
                " without moving, and set the infills by hand."
            }
        }
    }
}

/// Words who reads the region as the plate orders it, and what was tried.
fn readers(dialect: Dialect) -> &'static str {
    match dialect {
        Dialect::Prusa => "other slicers do not read the region.",
        Dialect::Orca => {
            "the plate has the region as a modifier part in their words. No such program was tried \
             with it. Look at the preview: the infill must change inside."
        }
        Dialect::Cura => {
            "the plate has the region as an infill mesh, in one group with the part. Cura itself \
             was not tried with it, its engine was. Look at the preview: the infill must change \
             inside. Set the height of layers and the brim by hand."
        }
    }
}

/// Returns the table of densities: what to set, what is laid, and what it weighs.
pub(super) fn levels(sheet: &Checklist, infill: &InfillOrder) -> Markup {
    let all_mm3 = sheet.parts.iter().map(|part| part.volume_mm3).sum::<f64>();
    let all_g = sheet.parts.iter().map(|part| part.mass_g).sum::<f64>();
    let levels = infill.levels();
    let row = |(index, level): (usize, &InfillLevel)| {
        let within_mm3 = levels.get(index + 1).map_or(0.0, |next| next.volume_mm3);
        let volume_mm3 = level.volume_mm3 - within_mm3;
        let set = [level.nominal_ratio, level.laid_ratio];
        ("sparse", set, volume_mm3, level.mass_g)
    };
    let solid = ("solid", [1.0, 1.0], all_mm3, all_g - infill.infill_g());
    let rows = std::iter::once(solid).chain(levels.iter().enumerate().map(row));
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

/// Returns the note on a slicer that lays other infill than the printer's profile says; nothing for
/// one that does not.
pub(super) fn slicer_note(infill: &InfillOrder) -> Markup {
    html! {
        @if let Some(ratio) = infill.slicer_ratio {
            p {
                "The slicer lays " (percent(ratio)) " of the infill that the printer's profile says. \
                 The masses here count with it. Slice with no other slicer, or make the kit anew."
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
            slicer_ratio: None,
            beyond: None,
            misses_mm: Vec::new(),
            field: None,
            smooth: None,
            file: Some("modifiers/bunny_15percent.stl".to_owned()),
            inner: Vec::new(),
        };
        let sheet = Checklist {
            infill: Some(infill.clone()),
            ..sample().0
        };
        (sheet, infill)
    }

    #[test]
    fn the_sheet_says_that_the_slicer_lays_more_than_the_profile_says() {
        let (_, infill) = graded();
        assert_eq!(slicer_note(&infill).into_string(), "");
        let more = InfillOrder {
            slicer_ratio: Some(1.076),
            ..infill
        };
        let words = slicer_note(&more).into_string();
        assert!(words.contains("107.6"), "{words}");
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
    fn regions_in_regions_are_named_in_their_order_and_weighed_without_each_other() {
        let (sheet, mut infill) = graded();
        infill.inner = vec![InfillLevel {
            nominal_ratio: 0.1,
            laid_ratio: 0.093,
            regions: 1,
            volume_mm3: 500.0,
            mass_g: 0.05,
            file: Some("modifiers/bunny_10percent.stl".to_owned()),
        }];
        let words = orders(&sheet, &infill).into_string().replace("<wbr>", "");
        let [outer, inner] = ["15percent.stl", "10percent.stl"].map(|file| words.find(file));
        assert!(outer.is_some() && outer < inner, "{words}");
        // 2000 mm³ less the 500 mm³ inside.
        let table = levels(&sheet, &infill).into_string();
        assert!(table.contains("1.5") && table.contains("9.3"), "{table}");
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
