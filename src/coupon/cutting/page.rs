//! The sheet of a cutter's coupons: instructions for cutting, measuring and calibrating.

use maud::{Markup, PreEscaped, html};

use super::super::sheet::blank;
use super::set::CutCouponSet;
use crate::base::units::{MM3_PER_CM3, show_mm};
use crate::page::document;

/// The commands that the sheet names, in the words of the user interface.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CutCommands {
    /// Makes the shop's own profiles of the cutter and of the sheet.
    pub make_profiles: [String; 2],
    /// Enters the measurements into them.
    pub calibrate: String,
}

/// Writes the sheet as one self-contained page.
pub(super) fn page(set: &CutCouponSet, svg: &str, commands: &CutCommands) -> String {
    let body = html! {
        h1 { "Coupons for " (set.cutter_name) ", " (set.sheet_name) }
        p { "Machine " (blank()) " Lot " (blank()) " Date " (blank()) " Name " (blank()) }
        (cut(set, svg))
        (measure(set))
        (fits(set))
        (joints(set))
        (calibrate(commands))
    };
    document(&format!("Coupons: {}", set.cutter_name), &body)
}

fn cut(set: &CutCouponSet, svg: &str) -> Markup {
    html! {
        h2 { "1. Cut" }
        p {
            "Open " code { "coupon.dxf" } " or " code { "coupon.svg" } " (both are the same, in mm). "
            "Check that a square measures " (show_mm(set.side_mm)) " on the screen. "
            "Engrave first, then cut. Use the speed and power of your jobs."
        }
        p {
            @if set.offset_kerf_mm > 0.0 {
                "Switch off the kerf offset of your software: slots and joints are offset already, for a cut "
                (show_mm(set.kerf_mm)) " wide (" (set.kerf_source) "). The squares are not."
            } @else {
                "Leave the kerf offset of your software as it is for your jobs. The squares then show "
                "what it misses."
            }
        }
        (PreEscaped(fitted(svg)))
    }
}

/// Returns the drawing as wide as the page.
fn fitted(svg: &str) -> String {
    let body = svg.split_once("viewBox=").map_or("", |(_, body)| body);
    format!(
        "<svg role=\"img\" aria-label=\"All coupons on the sheet\" style=\"width:100%\" viewBox={body}"
    )
}

fn measure(set: &CutCouponSet) -> Markup {
    let volume_cm3 =
        set.side_mm * set.side_mm * set.thickness_mm * set.squares as f64 / MM3_PER_CM3;
    html! {
        h2 { "2. Measure the squares" }
        p {
            "Push all " (set.squares) " squares together in a row, on a flat table and against a straight edge. "
            "Measure the length of the row: " (blank()) " mm. It would be "
            (show_mm(set.side_mm * set.squares as f64)) " if the cut had no width."
        }
        p {
            "Measure the thickness of the sheet at five places, in mm: "
            @for _ in 0..5 { (blank()) " " }
            ". The joints here are drawn for " (show_mm(set.thickness_mm)) "."
        }
        p {
            "Weigh all squares together: " (blank()) " g. They are about "
            (format!("{volume_cm3:.1} cm³")) " together."
        }
    }
}

fn fits(set: &CutCouponSet) -> Markup {
    html! {
        h2 { "3. Push a square into the slots" }
        table {
            tr {
                th { "Slot" } th class="n" { "Width" } th class="n" { "Wider than the sheet" }
                th { "Does not go in" } th { "Holds by itself" } th { "Slides" } th { "Falls out" }
            }
            @for slot in &set.slots {
                tr {
                    td { (slot.number) } td class="n" { (show_mm(slot.width_mm)) }
                    td class="n" { (format!("{:+.2} mm", slot.fit_mm)) }
                    @for _ in 0..4 { td { "☐" } }
                }
            }
        }
    }
}

fn joints(set: &CutCouponSet) -> Markup {
    html! {
        h2 { "4. Put the joints together" }
        p { "Both panels of a joint have the same name. Hold the angle with a protractor." }
        table {
            tr {
                th { "Joint" } th class="n" { "Inner angle" } th class="n" { "Fingers wider than gaps" }
                th { "Too tight" } th { "Holds by itself" } th { "Needs glue" } th { "Loose" }
            }
            @for joint in &set.joints {
                tr {
                    td { (joint.name) } td class="n" { (joint.angle_deg) "°" }
                    td class="n" { (format!("{:+.2} mm", joint.press_mm)) }
                    @for _ in 0..4 { td { "☐" } }
                }
            }
        }
    }
}

fn calibrate(commands: &CutCommands) -> Markup {
    html! {
        h2 { "5. Enter the measurements into your profiles" }
        p { "Make your own profiles of the cutter and the sheet once:" }
        @for command in &commands.make_profiles { p { code { (command) } } }
        p { "Then enter what you measured (leave out the mass if you did not weigh):" }
        p { code { (commands.calibrate) } }
    }
}
