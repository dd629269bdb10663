//! The sheet of a slide coupon: how to print and try it, and what to type.

use maud::{Markup, html};

use super::set::SlideSet;
use crate::base::units::show_mm;
use crate::coupon::Coupon;
use crate::coupon::sheet::blank;
use crate::page::document;

/// The commands that the sheet names, in the words of the user interface.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SlideCommands {
    /// Makes the shop's own profile of the machine.
    pub make_profile: String,
    /// Enters the clearance into that profile.
    pub calibrate: String,
    /// Chooses that profile for a kit.
    pub choose_profile: String,
}

/// Writes the sheet as one self-contained page.
pub(super) fn page(set: &SlideSet, coupons: &[Coupon], commands: &SlideCommands) -> String {
    let body = html! {
        h1 { "Slide coupon for " (set.printer_name) ", " (set.material_name) }
        p { "Machine " (blank()) " Lot " (blank()) " Date " (blank()) " Name " (blank()) }
        (print(set, coupons))
        (try_out(set))
        (calibrate(commands))
    };
    document(&format!("Slide coupon: {}", set.printer_name), &body)
}

fn print(set: &SlideSet, coupons: &[Coupon]) -> Markup {
    html! {
        h2 { "1. Print" }
        p {
            "Print them in this orientation, solid (100 % infill), unscaled, without support, in layers of "
            (show_mm(set.layer_mm)) ". Use the settings and the lot of your telescopes. "
            "Wash, cure and clear them as you do shells: nothing may be left in a bore or on a flange."
        }
        table {
            tr { th { "File" } th { "What it is" } th { "Done" } }
            @for coupon in coupons {
                tr { td { code { (coupon.file) } } td { (coupon.purpose) } td { "☐" } }
            }
        }
        p class="small" { "The bar stands out beside the tightest sleeve, which is the first." }
    }
}

fn try_out(set: &SlideSet) -> Markup {
    html! {
        h2 { "2. Try every sleeve" }
        p {
            "Hold the row with its lips up. Put the plunger in from below, rim first, and let it go down again. "
            "A sleeve slides if the plunger moves by its own weight, all the way, however it is turned. "
            "It stops if the plunger, pulled by its rim, does not come out at the lip. "
            "Try the straight plunger in the straight sleeves, the bent one in the arcs, bend on bend."
        }
        table {
            tr {
                th { "Sleeve" } th class="n" { "Clearance per side" }
                th { "Straight: slides" } th { "stops" } th { "Arc: slides" } th { "stops" }
            }
            @for (index, sleeve) in set.sleeves.iter().enumerate() {
                tr {
                    td { (index + 1) } td class="n" { (show_mm(sleeve.clearance_mm)) }
                    @for _ in 0..4 { td { "☐" } }
                }
            }
        }
        p {
            "The clearance to type is that of the first sleeve with four ticks. "
            "The profile has " (show_mm(set.profile_clearance_mm)) ": " (set.profile_source) "."
        }
        p {
            "If no sleeve has four ticks, type nothing. Where all stick, clean better or print again with a larger clearance in the profile. "
            "Where a lip lets the plunger out, the machine prints holes too wide."
        }
    }
}

fn calibrate(commands: &SlideCommands) -> Markup {
    html! {
        h2 { "3. Enter the clearance into the profile" }
        p { "Make your own profile of the machine once:" }
        p { code { (commands.make_profile) } }
        p { "Then enter the clearance, which is that of this material:" }
        p { code { (commands.calibrate) } }
        p {
            "Telescopes for this profile (" code { (commands.choose_profile) }
            ") then slide with that clearance, and their sheets say that it was measured."
        }
    }
}
