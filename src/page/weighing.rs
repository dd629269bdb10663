//! The two weighings: every part before gluing, and the whole at the end.

use maud::{Markup, html};

use super::fields::{blank, mass_of_parts_g, printed_mass_g, residue, spread_ratio};
use super::hardware::word;
use super::infill::wrong_weight;
use crate::base::numbers::measured;
use crate::base::units::MM3_PER_CM3;
use crate::sheet::{Checklist, PartRow};

/// Least difference that a scale in a shop shows, g.
const SCALE_G: f64 = 0.1;

/// Least distance of a share from its limits, in per cent: what rounding leaves.
const LEAST_SHARE_PERCENT: f64 = 0.1;

/// Returns the weighing of every part, while it can still be cleaned.
pub(super) fn weigh_parts(sheet: &Checklist) -> Markup {
    let by_share = is_by_share(sheet);
    html! {
        @if by_share {
            p {
                "The density was not measured here: target weights are approximate. Check the percentages. For exact weights, print and weigh the coupons ("
                code { "equipoise coupon" } ")."
            }
        }
        table class="stack" {
            thead {
                tr {
                    th scope="col" { "Part" }
                    th scope="col" class="n" { "Target" }
                    th scope="col" { "Weighed, g" }
                    @if by_share { th scope="col" { "Share of all parts, %" } }
                    th scope="col" class="n" { "Reject outside" }
                }
            }
            tbody {
                @for part in weighed(sheet) {
                    (weigh_line(sheet, &part.id, printed_mass_g(sheet, part)))
                }
                @if sheet.parts.len() > 1 { (weigh_line(sheet, "all parts", mass_of_parts_g(sheet))) }
            }
        }
        @if sheet.infill.is_some() { p { (wrong_weight()) } }
        @else { p { "Too heavy: it still holds " (residue(&sheet.printer.process)) ", clean it again. Too light: it was not printed solid." } }
    }
}

/// Returns the parts that are weighed: plugs are too light to tell anything.
fn weighed(sheet: &Checklist) -> impl Iterator<Item = &PartRow> {
    let parts = sheet.parts.iter();
    parts.filter(|part| sheet.hole_of_plug(&part.id).is_none())
}

/// Returns the line of a part, or of all parts, with the limits beyond which it is not used.
fn weigh_line(sheet: &Checklist, id: &str, mass_g: f64) -> Markup {
    let all_g = mass_of_parts_g(sheet);
    let is_all = mass_g >= all_g;
    let by_share = is_by_share(sheet);
    html! {
        tr {
            th scope="row" { (id) }
            td class="n" data-head="Target" {
                (measured(mass_g, "g"))
                @if by_share && !is_all { ", " (percent(mass_g / all_g)) }
            }
            td data-head="Weighed, g" { (blank()) }
            @if by_share { td data-head="Share, %" { @if is_all { "100 %" } @else { (blank()) } } }
            td class="n" data-head="Reject outside" {
                @if by_share && is_all { "—" }
                @else if by_share { (share_window(sheet, mass_g / all_g)) }
                @else { (window(mass_g, spread_ratio(sheet))) }
            }
        }
    }
}

/// Returns whether parts are judged by their shares: the density is not known, but several parts
/// have the same.
fn is_by_share(sheet: &Checklist) -> bool {
    sheet.material.density_spread_ratio.is_none() && weighed(sheet).nth(1).is_some()
}

/// Words the least and the greatest share of a sound part.
///
/// If part and rest deviate by the spread, one up and one down, the share p moves by 2 s p (1 − p).
fn share_window(sheet: &Checklist, share: f64) -> String {
    let away = 100.0 * 2.0 * spread_ratio(sheet) * share * (1.0 - share);
    let away = away.max(LEAST_SHARE_PERCENT);
    let [least, most] = [100.0 * share - away, 100.0 * share + away];
    format!("{least:.1}–{most:.1}\u{a0}%")
}

fn percent(share: f64) -> String {
    format!("{:.1}\u{a0}%", 100.0 * share)
}

/// Words the least and the greatest mass of a sound print.
fn window(mass_g: f64, spread_ratio: f64) -> String {
    let [least, most] = [1.0 - spread_ratio, 1.0 + spread_ratio].map(|ratio| mass_g * ratio);
    format!(
        "{}–{}",
        measured(least, "g").replace("\u{a0}g", ""),
        measured(most, "g")
    )
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
    let glue = glue_mass_g(sheet);
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

/// Returns the weighing of the whole: what it must be, beside what its parts weighed.
pub(super) fn weigh_whole(sheet: &Checklist) -> Markup {
    let shares = shares(sheet);
    let added_g: f64 = shares.iter().skip(1).map(|share| share.mass_g).sum();
    let added: Vec<String> = shares
        .iter()
        .skip(1)
        .map(|share| format!("{} {}", share.what, measured(share.mass_g, "g")))
        .collect();
    html! {
        ul class="ticks" {
            li {
                "Weigh " (all_together(sheet)) ": target " strong { (whole_mass(sheet)) } ". Weighed, g " (blank())
                @if !added.is_empty() {
                    br;
                    "= weight of the parts + (calculated) " (added.join(", ")) "."
                }
                @if let Some(margin_g) = whole_margin_g(sheet) {
                    " Reject it if it weighs over "
                    (measured(added_g + margin_g, "g")) " more than the parts weighed: too much glue, or something is left inside."
                }
            }
        }
    }
}

/// Returns the mass that the whole may have beyond what is calculated, g. It is the mass of the
/// glue once more, and what a scale shows. `None` if nothing is added, or a filling, whose spread
/// is not known.
pub(super) fn whole_margin_g(sheet: &Checklist) -> Option<f64> {
    let is_added = shares(sheet).len() > 1 && sheet.fill.is_none();
    is_added.then(|| glue_mass_g(sheet) + SCALE_G)
}

/// Returns the mass of the glue, g.
fn glue_mass_g(sheet: &Checklist) -> f64 {
    let films = sheet.joints.iter().filter_map(|joint| joint.glue);
    films.map(|film| film.mass_g).sum()
}

fn all_together(sheet: &Checklist) -> &'static str {
    match (sheet.joints.is_empty(), sheet.hardware.is_empty()) {
        (true, true) => "the whole",
        (false, true) => "the whole, glued",
        (_, false) => "the whole, with the hardware",
    }
}

/// Words the mass of the whole, with the window due to the print's density and the ballast if the
/// density was measured. The spread of a filling is not known.
fn whole_mass(sheet: &Checklist) -> String {
    let ballast = sheet.ballast.iter();
    let spread_g: f64 = ballast
        .map(|row| row.order.lump.mass_g * row.mass_spread_ratio)
        .sum();
    let mass_g = sheet.assembly.mass_g;
    let target = measured(mass_g, "g");
    match sheet.material.density_spread_ratio {
        Some(ratio) => {
            let spread_ratio = (ratio * mass_of_parts_g(sheet) + spread_g) / mass_g;
            format!("{target}, reject outside {}", window(mass_g, spread_ratio))
        }
        None => target,
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

    #[test]
    fn every_weighing_has_a_limit_by_share_if_the_density_is_not_measured() {
        let mut sheet = sample().0;
        let page = weigh_parts(&sheet).into_string();
        assert!(!page.contains("Share of all parts"), "measured: by mass");
        assert_eq!(page.matches("–").count(), 3, "both parts and all of them");
        sheet.material.density_spread_ratio = None;
        let page = weigh_parts(&sheet).into_string();
        assert!(page.contains("Check the percentages") && page.contains("\u{a0}%</td>"));
        sheet.parts.truncate(1);
        let page = weigh_parts(&sheet).into_string();
        assert!(page.contains("–") && !page.contains("percentages"));
    }

    #[test]
    fn the_limit_of_a_share_is_that_of_two_masses_that_deviate_against_each_other() {
        let mut sheet = sample().0;
        sheet.material.density_spread_ratio = None;
        sheet.material.typical_spread_ratio = Some(0.02);
        let (part, rest): (f64, f64) = (30.0, 70.0);
        let exact = [
            part * 0.98 / (part * 0.98 + rest * 1.02),
            part * 1.02 / (part * 1.02 + rest * 0.98),
        ];
        let words = share_window(&sheet, 0.3);
        let said: Vec<f64> = words
            .trim_end_matches("\u{a0}%")
            .split('–')
            .map(|limit| limit.parse().unwrap())
            .collect();
        for (said, exact) in said.iter().zip(exact) {
            assert!((said - 100.0 * exact).abs() < 0.06, "{words} {exact}");
        }
    }
}
