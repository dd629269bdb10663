//! The certificate of several telescopes on junctures.

use maud::{Markup, html};

use super::document::styled_document;
use super::network::{NetworkPage, juncture, promise};
use super::proof;
use super::running::style;
use super::wing_frame as frame;
use crate::base::numbers::{extent, number, quantity};
use crate::sheet::network::{LimbRow, NetworkSheet};

/// Returns the certificate as a self-contained HTML page.
pub fn network_certificate(page: &NetworkPage) -> String {
    let (sheet, job) = (page.sheet, page.job_id());
    let body = html! {
        (frame::certificate_head(&job, &promise(sheet)))
        main {
            (facts(sheet))
            (proof::checks(&sheet.checks))
            (limbs(sheet))
            (centres(sheet))
            (frame::files(page.sha256, &sheet.files))
        }
    };
    styled_document(&format!("Certificate: {}", sheet.job), &body, &style(&job))
}

fn facts(sheet: &NetworkSheet) -> Markup {
    let rows: [(&str, String); 4] = [
        (
            "Input",
            format!(
                "{}, {} long",
                sheet.input.source,
                quantity(sheet.input.length_mm, "mm")
            ),
        ),
        ("Mass", quantity(sheet.mass_g, "g")),
        (
            "Boxes",
            format!(
                "all in {}, all out {}, along the axes of the model",
                extent(&sheet.collapsed_mm),
                extent(&sheet.extended_mm)
            ),
        ),
        (
            "Glue",
            format!("{} on each side", quantity(sheet.glue_mm, "mm")),
        ),
    ];
    html! {
        table class="facts" {
            @for (name, words) in rows { tr { th scope="row" { (name) } td { (words) } } }
        }
    }
}

fn limbs(sheet: &NetworkSheet) -> Markup {
    html! {
        section {
            h2 { "Limbs" }
            table class="stack" {
                thead {
                    tr {
                        th scope="col" { "Limb" } th scope="col" { "From and to" } th scope="col" class="n" { "Shells" }
                        th scope="col" class="n" { "Body radii" } th scope="col" class="n" { "Length" }
                        th scope="col" class="n" { "Deviation" } th scope="col" class="n" { "Tip plays by" }
                    }
                }
                tbody {
                    @for limb in &sheet.limbs {
                        @let own = &limb.sheet;
                        tr {
                            th scope="row" { (limb.id) }
                            td data-head="From and to" { (ends(sheet, limb)) }
                            td class="n" data-head="Shells" { (own.shells.len()) }
                            td class="n" data-head="Body radii" { (radii(own)) }
                            td class="n" data-head="Length" { (quantity(own.curve.length_mm, "mm")) }
                            td class="n" data-head="Deviation" { (quantity(own.deviation.max_mm, "mm")) }
                            td class="n" data-head="Tip plays by" { (quantity(own.tip_play_mm, "mm")) }
                        }
                    }
                }
            }
        }
    }
}

/// Names the junctures at both ends of a limb.
fn ends(sheet: &NetworkSheet, limb: &LimbRow) -> String {
    let [from, to] = [limb.from, limb.to].map(|number| juncture(sheet, number));
    format!("{from} to {to}")
}

fn radii(sheet: &crate::sheet::telescope::TelescopeSheet) -> String {
    let radii = sheet.shells.iter().map(|shell| number(shell.body_mm));
    radii.collect::<Vec<_>>().join(", ")
}

fn centres(sheet: &NetworkSheet) -> Markup {
    html! {
        section {
            h2 { "Centre of mass at every key" }
            table class="stack" {
                thead { tr { th scope="col" { "Key" } th scope="col" class="n" { "Centre of mass, mm" } } }
                tbody {
                    @for (index, centre) in sheet.centres_mm.iter().enumerate() {
                        tr {
                            th scope="row" { (index) }
                            td class="n" data-head="Centre of mass" { (centre.map(number).join(", ")) }
                        }
                    }
                }
            }
        }
    }
}
