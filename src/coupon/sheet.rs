//! The sheet of the coupons: instructions for printing, measuring and calibrating.

use maud::{Markup, html};

use super::{CouponSet, bodies::Coupon};
use crate::base::units::{MM3_PER_CM3, show_mm};
use crate::page::document;

/// The commands that the sheet names, in the words of the user interface.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Commands {
    /// Makes the shop's own profile of the machine.
    pub make_profile: String,
    /// Enters the measurements into that profile.
    pub calibrate: String,
    /// Chooses that profile for a kit.
    pub choose_profile: String,
}

/// Writes the sheet as one self-contained page.
pub(super) fn page(set: &CouponSet, coupons: &[Coupon], commands: &Commands) -> String {
    let body = html! {
        h1 { "Coupons for " (set.printer_name) ", " (set.material_name) }
        p { "Machine " (blank()) " Lot " (blank()) " Date " (blank()) " Name " (blank()) }
        p { "Room: " (blank()) " °C, humidity " (blank()) " %" }
        (print(set, coupons))
        (weigh(set))
        (fits(set))
        (ladders(set))
        (calibrate(commands))
    };
    document(&format!("Coupons: {}", set.printer_name), &body)
}

fn print(set: &CouponSet, coupons: &[Coupon]) -> Markup {
    html! {
        h2 { "1. Print" }
        p {
            "Print them in this orientation, solid (100 % infill), unscaled, in layers of "
            (show_mm(set.layer_mm)) ". Use the settings and the lot of your kits. "
            "Clean, cure and dry them like kits. "
            "Spread copies over the plate: its corners and its middle do not print alike."
        }
        table {
            tr { th { "File" } th class="n" { "Print" } th { "What it is" } th { "Done" } }
            @for coupon in coupons {
                tr {
                    td { code { (coupon.file) } } td class="n" { (coupon.count) }
                    td { (coupon.purpose) } td { "☐" }
                }
            }
        }
        p class="small" { "A cut-off corner marks the end with the smallest samples." }
    }
}

fn weigh(set: &CouponSet) -> Markup {
    let [x, y, z] = set.density_size_mm;
    let size = format!(
        "{x:.3} × {y:.3} × {z:.3} mm = {:.2} mm³",
        set.density_volume_mm3
    );
    let mass_g = set.density_volume_mm3 / MM3_PER_CM3 * set.profile_density_g_cm3;
    html! {
        h2 { "2. Weigh the density coupons" }
        p {
            "The drawn size of each is " (size)
            "; at the profile's density it weighs " (format!("{mass_g:.2} g")) ". "
            "Write down each mass, not the mean: their spread becomes the weighing window of kits. "
            "Weigh at least two, better five."
        }
        p { @for _ in 0..5 { (blank()) " g  " } }
    }
}

fn fits(set: &CouponSet) -> Markup {
    html! {
        h2 { "3. Try the trial pin in the comb" }
        p {
            "The diameter of the pin is " (show_mm(set.trial_pin_mm)) ". "
            "Push it into every socket from the top."
        }
        table {
            tr {
                th { "Socket" } th class="n" { "Diameter" } th class="n" { "Clearance per side" }
                th { "Does not fit" } th { "Press fit, holds" }
                th { "Slides in by hand: glue" } th { "Falls out: loose" }
            }
            @for (index, hole) in set.holes.iter().enumerate() {
                tr {
                    td { (index + 1) } td class="n" { (show_mm(hole.diameter_mm)) }
                    td class="n" { (show_mm(hole.clearance_mm)) }
                    @for _ in 0..4 { td { "☐" } }
                }
            }
        }
    }
}

fn ladders(set: &CouponSet) -> Markup {
    html! {
        h2 { "4. Inspect the pins and the walls" }
        p { "Mark those that are whole and straight after cleaning." }
        table {
            (ladder("Pins, diameter", &set.pins_mm))
            (ladder("Walls, thick along x", &set.walls_x_mm))
            (ladder("Walls, thick along y", &set.walls_y_mm))
        }
    }
}

fn ladder(name: &str, sizes_mm: &[f64]) -> Markup {
    html! {
        tr { th { (name) } @for size_mm in sizes_mm { td { "☐ " (show_mm(*size_mm)) } } }
    }
}

fn calibrate(commands: &Commands) -> Markup {
    html! {
        h2 { "5. Enter the measurements into the profile" }
        p { "Make your own profile of the machine once:" }
        p { code { (commands.make_profile) } }
        p { "Then enter the measurements of every lot (omit those you did not make):" }
        p { code { (commands.calibrate) } }
        p {
            "To prepare kits with it, use " code { (commands.choose_profile) }
            ", or name it in " code { "equipoise.toml" } " in the job's folder."
        }
    }
}

/// A line to write on.
pub(super) fn blank() -> Markup {
    html! { span class="fill" { "\u{a0}" } }
}
