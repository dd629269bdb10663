//! The sheet that goes with coupons: what to print, what to try and measure, and what to type then.

use maud::{Markup, html};

use super::{Coupon, CouponSet};
use crate::base::units::{MM3_PER_CM3, show_mm};
use crate::page::document;

/// The sheet as a page without anything from outside.
pub(super) fn page(set: &CouponSet, coupons: &[Coupon]) -> String {
    let body = html! {
        h1 { "Coupons for " (set.printer_name) ", " (set.material_name) }
        p { "Machine " (blank()) " Lot " (blank()) " Date " (blank()) " Name " (blank()) }
        (print(set, coupons))
        (weigh(set))
        (fits(set))
        (ladders(set))
        (then(set))
    };
    document(&format!("Coupons: {}", set.printer_name), &body)
}

fn print(set: &CouponSet, coupons: &[Coupon]) -> Markup {
    html! {
        h2 { "1. Print" }
        p {
            "As they lie, solid (100 % infill), not scaled, in layers of " (show_mm(set.layer_mm))
            ", with the settings and from the lot that the kits are printed with. Clean, cure and dry them like kits."
        }
        table {
            tr { th { "File" } th class="n" { "Print" } th { "What it is" } th { "Done" } }
            @for coupon in coupons {
                tr { td { code { (coupon.file) } } td class="n" { (coupon.count) } td { (coupon.purpose) } td { "☐" } }
            }
        }
        p class="small" { "A cut-off corner marks the end where the smallest stand." }
    }
}

fn weigh(set: &CouponSet) -> Markup {
    let [x, y, z] = set.density_size_mm;
    html! {
        h2 { "2. Weigh the density coupons" }
        p {
            "Each is drawn " (format!("{x:.3} × {y:.3} × {z:.3} mm = {:.2} mm³", set.density_volume_mm3))
            "; at the profile's density it weighs " (format!("{:.2} g", set.density_volume_mm3 / MM3_PER_CM3 * set.profile_density_g_cm3))
            ". Write down the masses, not their mean: how far they differ becomes the weighing window of kits. Two at least, better five."
        }
        p { @for _ in 0..5 { (blank()) " g  " } }
    }
}

fn fits(set: &CouponSet) -> Markup {
    html! {
        h2 { "3. Try the trial pin in the comb" }
        p { "The pin is " (show_mm(set.trial_pin_mm)) " across. Push it into every socket from the top." }
        table {
            tr { th { "Socket" } th class="n" { "Across" } th class="n" { "Clearance a side" } th { "Does not go in" } th { "Press fit, holds" } th { "Goes in by hand: glue" } th { "Falls out: loose" } }
            @for (index, hole) in set.holes.iter().enumerate() {
                tr {
                    td { (index + 1) } td class="n" { (show_mm(hole.diameter_mm)) } td class="n" { (show_mm(hole.clearance_mm)) }
                    @for _ in 0..4 { td { "☐" } }
                }
            }
        }
    }
}

fn ladders(set: &CouponSet) -> Markup {
    html! {
        h2 { "4. Look at the pins and the walls" }
        p { "Mark what stands whole and straight after cleaning." }
        table {
            (ladder("Pins, across", &set.pins_mm))
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

fn then(set: &CouponSet) -> Markup {
    html! {
        h2 { "5. Give it to the profile" }
        p { "Once for a shop's own profile of the machine:" }
        p { code { "equipoise printers new --from " (set.printer) " --id shop-" (set.printer) " --out shop-" (set.printer) ".toml" } }
        p { "Then, for every lot, with what was measured (leave out what was not):" }
        p {
            code {
                "equipoise printers calibrate shop-" (set.printer) ".toml --material " (set.material)
                " --lot LOT --weighed G --weighed G --weighed G --clearance MM --press MM --loose MM --pin MM --wall MM"
            }
        }
        p { "Kits are prepared with it by " code { "--printer shop-" (set.printer) ".toml" } ", or by " code { "equipoise.toml" } " beside the job." }
    }
}

/// A line to write on.
fn blank() -> Markup {
    html! { span class="fill" { "\u{a0}" } }
}
