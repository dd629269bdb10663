//! The sheet of a density coupon: how to print and weigh its blocks, and what to type.

use maud::{Markup, html};

use super::plates::BlockPlate;
use super::set::{DensitySet, SOLID_PERCENT};
use crate::base::units::{show_g, show_mm};
use crate::coupon::sheet::blank;
use crate::page::document;

/// The commands that the sheet names, in the words of the user interface.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DensityCommands {
    /// Makes the shop's own profile of the machine.
    pub make_profile: String,
    /// Enters the masses into that profile.
    pub calibrate: String,
}

/// Writes the sheet as one self-contained page.
pub(super) fn page(set: &DensitySet, plates: &[BlockPlate], commands: &DensityCommands) -> String {
    let body = html! {
        h1 { "Density coupon for " (set.printer_name) ", " (set.material_name) }
        p { "Machine " (blank()) " Lot " (blank()) " Date " (blank()) " Name " (blank()) }
        (print(set, plates))
        (weigh(set))
        (calibrate(commands))
    };
    document(&format!("Density coupon: {}", set.printer_name), &body)
}

fn print(set: &DensitySet, plates: &[BlockPlate]) -> Markup {
    let all_g: f64 = set.blocks.iter().map(|block| block.expected_g).sum();
    html! {
        h2 { "1. Print" }
        p {
            "Open each plate as a project, and slice it with the settings and the lot of your kits, "
            "in layers of " (show_mm(set.layer_mm)) ". Change no infill: each block has its own "
            (set.pattern) " infill. The blocks have no lids, so that their infill shows. "
            "All of them weigh some " (format!("{all_g:.0} g")) "."
        }
        p {
            "Write its infill on every block before you take it off the plate. "
            "Places are those of its middle, from the front left corner."
        }
        table {
            tr { th { "File" } th { "Block" } th class="n" { "Right" } th class="n" { "Back" } }
            @for plate in plates { @for (name, middle_mm) in &plate.spots {
                tr {
                    td { code { (plate.file) } } td { (name) }
                    @for mm in middle_mm { td class="n" { (format!("{mm:.0} mm")) } }
                }
            } }
        }
    }
}

fn weigh(set: &DensitySet) -> Markup {
    let [small_mm, large_mm] = set.diameters_mm.map(|mm| format!("{mm:.0} mm"));
    html! {
        h2 { "2. Weigh" }
        p {
            "Take off strings and brims, and weigh each block to 0.01 g. "
            "Denser blocks are heavier: blocks without a name can be sorted by their mass. "
            "Walls and the ends of lines drop out, since each infill has two sizes."
        }
        table {
            tr {
                th class="n" { "Infill" }
                th class="n" { "Large, Ø " (large_mm) } th class="n" { "by the profile" }
                th class="n" { "Small, Ø " (small_mm) } th class="n" { "by the profile" }
            }
            @for percent in set.percents() {
                tr {
                    td class="n" { (percent) " %" }
                    (mass(set, percent, set.diameters_mm[1]))
                    (mass(set, percent, set.diameters_mm[0]))
                }
            }
        }
        p class="small" {
            "There is one solid block, of " (SOLID_PERCENT) " %. It says what solid print weighs."
        }
    }
}

/// Returns the cells for a block: a line to write on, and its mass by the profile.
fn mass(set: &DensitySet, percent: f64, diameter_mm: f64) -> Markup {
    let mut blocks = set.blocks.iter();
    let block = blocks.find(|it| it.percent == percent && it.diameter_mm == diameter_mm);
    html! {
        @match block {
            Some(block) => {
                td class="n" { (blank()) " g" } td class="n" { (show_g(block.expected_g)) }
            }
            None => { td class="n" { "none" } td {} }
        }
    }
}

fn calibrate(commands: &DensityCommands) -> Markup {
    html! {
        h2 { "3. Enter the masses into the profile" }
        p { "Make your own profile of the machine once:" }
        p { code { (commands.make_profile) } }
        p { "Then enter the masses, of each infill the large block first:" }
        p { code { (commands.calibrate) } }
        p { "Graded kits for this profile then have the densities that your machine lays." }
    }
}
