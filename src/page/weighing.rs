//! The two weighings: every part before gluing, and the whole at the end.

use maud::{Markup, html};

use super::fields::{blank, mass_of_parts_g, mass_window, mass_with_window, residue};
use super::hardware::word;
use crate::base::numbers::{number, quantity};
use crate::base::units::MM3_PER_CM3;
use crate::sheet::Checklist;

/// Returns the weighing of every part, while it can still be cleaned.
pub(super) fn weigh_parts(sheet: &Checklist) -> Markup {
    let is_known = sheet.material.density_spread_ratio.is_some();
    html! {
        @if !is_known {
            p {
                "The density was not measured, so the masses are approximate. Check each part's share of all parts, which does not depend on the density. "
                "For weighing windows, print and weigh the coupons (" code { "equipoise coupon" } ") of " code { (sheet.printer.id) } "."
            }
        }
        table {
            thead {
                tr {
                    th scope="col" { "Part" }
                    th scope="col" class="n" { "Expected" }
                    th scope="col" { "Weighed, g" }
                    th scope="col" {
                        @if is_known { "In the window" } @else { "Share of all parts, %" }
                    }
                }
            }
            tbody {
                @for part in &sheet.parts {
                    tr {
                        td { (part.id) }
                        td class="n" { (mass_with_window(sheet, part.mass_g)) }
                        td { (blank()) }
                        td { (tick_or_blank(sheet)) }
                    }
                }
                tr {
                    td { strong { "all parts" } }
                    td class="n" { (mass_with_window(sheet, mass_of_parts_g(sheet))) }
                    td { (blank()) }
                    td { (tick_or_blank(sheet)) }
                }
            }
        }
        p class="small" { "A part too heavy still holds " (residue(&sheet.printer.process)) ": clean it again before gluing. A part too light was not printed solid." }
    }
}

/// Returns a box to tick if there is a window, else a line for the share.
fn tick_or_blank(sheet: &Checklist) -> Markup {
    if sheet.material.density_spread_ratio.is_some() {
        html! { "☐" }
    } else {
        blank()
    }
}

/// A component of the whole.
struct Share {
    what: String,
    mass_g: f64,
}

/// Returns the components of the whole; their masses add up to its mass.
fn shares(sheet: &Checklist) -> Vec<Share> {
    let parts = Share {
        what: "all parts".to_owned(),
        mass_g: mass_of_parts_g(sheet),
    };
    let hardware = sheet
        .hardware
        .iter()
        .map(|piece| (format!("{}, {}", piece.id, word(&piece.kind)), piece.mass_g));
    let ballast = sheet
        .ballast
        .iter()
        .map(|row| (row.order.id.clone(), row.order.lump.mass_g));
    let dowels = sheet.dowels.iter().map(|dowel| dowel.mass_g).sum();
    let glue = sheet
        .joints
        .iter()
        .filter_map(|joint| joint.glue)
        .map(|film| film.mass_g)
        .sum();
    let voids_cm3 = sheet
        .voids
        .iter()
        .map(|void| void.volume_mm3 / MM3_PER_CM3)
        .sum::<f64>();
    let filling = sheet
        .fill
        .map_or(0.0, |fill| fill.density_g_cm3 * voids_cm3);
    let lots = [("dowels", dowels), ("glue", glue), ("filling", filling)];
    let lots = lots
        .into_iter()
        .map(|(what, mass_g)| (what.to_owned(), mass_g));
    let more = hardware
        .chain(ballast)
        .chain(lots)
        .filter(|(_, mass_g)| *mass_g > 0.0);
    std::iter::once(parts)
        .chain(more.map(|(what, mass_g)| Share { what, mass_g }))
        .collect()
}

/// Returns the weighing of the whole, with its components.
pub(super) fn weigh_whole(sheet: &Checklist) -> Markup {
    let shares = shares(sheet);
    let whole_g = sheet.assembly.mass_g;
    html! {
        table {
            thead {
                tr {
                    th scope="col" { "What" }
                    th scope="col" class="n" { "Expected" }
                    th scope="col" class="n" { "Share of the whole" }
                    th scope="col" { "Weighed, g" }
                }
            }
            tbody {
                @for share in shares.iter().filter(|_| shares.len() > 1) {
                    tr {
                        td { (share.what) }
                        td class="n" { (quantity(share.mass_g, "g")) }
                        td class="n" { (number(100.0 * share.mass_g / whole_g)) " %" }
                        td { "as weighed before" }
                    }
                }
                tr {
                    td { strong { (all_together(sheet)) } }
                    td class="n" { (whole_mass(sheet)) }
                    td class="n" { "100 %" }
                    td { (blank()) }
                }
            }
        }
    }
}

fn all_together(sheet: &Checklist) -> &'static str {
    match (sheet.joints.is_empty(), sheet.hardware.is_empty()) {
        (true, true) => "the whole",
        (false, true) => "the whole, glued",
        (_, false) => "the whole, with the hardware",
    }
}

/// Returns the mass of the whole, with the window due to the print's density and the ballast.
fn whole_mass(sheet: &Checklist) -> Markup {
    let spread_g: f64 = sheet
        .ballast
        .iter()
        .map(|row| row.order.lump.mass_g * row.mass_spread_ratio)
        .sum();
    let mass_g = sheet.assembly.mass_g;
    match sheet.material.density_spread_ratio {
        // The spread of a filling is not known.
        Some(ratio) => mass_window(mass_g, (ratio * mass_of_parts_g(sheet) + spread_g) / mass_g),
        None => html! { (quantity(mass_g, "g")) },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::sample;
    use crate::verify::FillOrder;

    #[test]
    fn the_components_add_up_to_the_whole() {
        let mut sheet = sample().0;
        sheet.fill = Some(FillOrder { density_g_cm3: 2.0 });
        let filled_g = 2.0 * sheet.voids[0].volume_mm3 / MM3_PER_CM3;
        let sum: f64 = shares(&sheet).iter().map(|share| share.mass_g).sum();
        assert!((sum - sheet.assembly.mass_g - filled_g).abs() < 1e-9 * sum);
        assert_eq!(shares(&sheet).len(), 2);
    }
}
