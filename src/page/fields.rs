//! Pieces that several sections of the page share: lines to write on, masses with their windows, file names.

use maud::{Markup, html};

use crate::base::numbers::{number, quantity};
use crate::sheet::Checklist;

/// A line to write on.
pub(super) fn blank() -> Markup {
    html! { span class="fill" { "\u{a0}" } }
}

/// The path of a file, which breaks behind `/`, `_` and `-` where the line is too short.
pub(super) fn file_name(path: &str) -> Markup {
    html! { code { @for piece in path.split_inclusive(['/', '_', '-']) { (piece) wbr; } } }
}

/// The mass of something printed, and what a sound print of it may weigh where the density was
/// measured; else its share of all parts, which no density changes.
pub(super) fn mass_with_window(sheet: &Checklist, mass_g: f64) -> Markup {
    html! {
        (quantity(mass_g, "g"))
        @if let Some(spread) = sheet.material.density_spread_ratio { (window(mass_g, spread)) }
        @else {
            br;
            span class="small" { (number(100.0 * mass_g / printed_g(sheet))) " % of all parts" }
        }
    }
}

/// A mass, and what a sound piece of it may weigh.
pub(super) fn mass_window(mass_g: f64, spread_ratio: f64) -> Markup {
    html! { (quantity(mass_g, "g")) (window(mass_g, spread_ratio)) }
}

fn window(mass_g: f64, spread_ratio: f64) -> Markup {
    html! {
        br;
        span class="small" { (number(mass_g * (1.0 - spread_ratio))) "–" (quantity(mass_g * (1.0 + spread_ratio), "g")) }
    }
}

/// What the parts weigh together, g.
pub(super) fn printed_g(sheet: &Checklist) -> f64 {
    sheet.parts.iter().map(|part| part.mass_g).sum()
}

/// What may be left in a void, by process.
pub(super) fn left_inside(process: &str) -> &'static str {
    match process {
        "sla" => "resin or support",
        "sls" | "mjf" => "powder",
        "mjp" => "wax",
        _ => "support",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_powder_processes_speak_of_powder_and_only_resin_of_resin() {
        for (process, left) in [
            ("fdm", "support"),
            ("sla", "resin or support"),
            ("sls", "powder"),
            ("polyjet", "support"),
        ] {
            assert_eq!(left_inside(process), left);
        }
    }
}
