//! The certificate of a telescope: what was promised, what was measured, and what was tried.

use maud::{Markup, html};

use super::document::styled_document;
use super::proof;
use super::running::style;
use super::telescope::{TelescopePage, promise};
use super::wing_frame as frame;
use crate::base::numbers::{extent, number, quantity, quantity_or_dash};
use crate::sheet::telescope::TelescopeSheet;

/// Returns the certificate of a telescope's kit as a self-contained HTML page.
pub fn telescope_certificate(page: &TelescopePage) -> String {
    let (sheet, job) = (page.sheet, page.job_id());
    let body = html! {
        (frame::certificate_head(&job, &promise(sheet)))
        main {
            (facts(sheet))
            (proof::checks(&sheet.checks))
            (shells(sheet))
            (balance(sheet))
            (trade(sheet))
            (frame::files(page.sha256, &sheet.files))
        }
    };
    styled_document(&format!("Certificate: {}", sheet.job), &body, &style(&job))
}

fn facts(sheet: &TelescopeSheet) -> Markup {
    let seat_mm = sheet.joint_sizes.seat_mm;
    let gap = sheet.least_gap_mm.map_or_else(
        || "all shells belong to one bend, in which tubes cannot meet".to_owned(),
        |gap| {
            format!(
                "{} between shells that are not of one bend",
                quantity(gap, "mm")
            )
        },
    );
    let paper = quantity(sheet.paper_rms_mm, "mm");
    let length = quantity(sheet.curve.length_mm, "mm");
    let slides = quantity(sheet.clearance_mm, "mm");
    let rows: [(&str, String); 8] = [
        ("Curve", format!("{}, {length} long", sheet.curve.source)),
        ("Deviation", deviation(sheet)),
        (
            "By the paper",
            format!("{paper} rms, by the method of Yu, Crane and Coros (2017) with as many shells"),
        ),
        ("Wall", quantity(sheet.wall_mm, "mm")),
        (
            "Clearance",
            format!("{slides} sliding, {} seated", quantity(seat_mm, "mm")),
        ),
        ("Joint", joint(sheet)),
        ("Least gap", gap),
        ("Boxes", boxes(sheet)),
    ];
    html! {
        table class="facts" {
            @for (name, words) in rows { tr { th scope="row" { (name) } td { (words) } } }
        }
    }
}

/// Words the deviation from the curve.
fn deviation(sheet: &TelescopeSheet) -> String {
    format!(
        "{} at most, {} rms, at equal shares of the length; Fréchet {}, Hausdorff {}",
        quantity(sheet.deviation.max_mm, "mm"),
        quantity(sheet.deviation.rms_mm, "mm"),
        quantity(sheet.frechet_mm, "mm"),
        quantity(sheet.hausdorff_mm, "mm")
    )
}

/// Words the measures of a joint.
fn joint(sheet: &TelescopeSheet) -> String {
    let sizes = &sheet.joint_sizes;
    format!(
        "engagement {}, flange {}, lip {}, overlap {}",
        quantity(sizes.engagement_mm, "mm"),
        quantity(sizes.flange_mm, "mm"),
        quantity(sizes.lip_mm, "mm"),
        quantity(sizes.overlap_mm, "mm")
    )
}

/// Words the boxes all in and all out.
fn boxes(sheet: &TelescopeSheet) -> String {
    format!(
        "all in {}, all out {}, along the root's axes; {} times as long",
        extent(&sheet.collapsed_mm),
        extent(&sheet.extended_mm),
        number(sheet.ratio)
    )
}

fn shells(sheet: &TelescopeSheet) -> Markup {
    html! {
        section {
            h2 { "Shells" }
            table class="stack" {
                thead {
                    tr {
                        th scope="col" { "Shell" } th scope="col" class="n" { "Curvature, 1/mm" } th scope="col" class="n" { "Torsion, 1/mm" }
                        th scope="col" class="n" { "Shows" } th scope="col" class="n" { "Body radius" } th scope="col" class="n" { "Bore radius" }
                    }
                }
                tbody {
                    @for shell in &sheet.shells {
                        tr {
                            th scope="row" { (shell.id) }
                            td class="n" data-head="Curvature" { (number(shell.curvature)) }
                            td class="n" data-head="Torsion" { (number(shell.torsion)) }
                            td class="n" data-head="Shows" { (quantity(shell.visible_mm, "mm")) }
                            td class="n" data-head="Body radius" { (quantity(shell.body_mm, "mm")) }
                            td class="n" data-head="Bore radius" { (quantity(shell.bore_mm, "mm")) }
                        }
                    }
                }
            }
        }
    }
}

fn balance(sheet: &TelescopeSheet) -> Markup {
    html! {
        section {
            h2 { "Balance at every key" }
            p {
                "Seen on the root's tail"
                @if let Some(foot) = &sheet.foot {
                    ", a foot of " (quantity(foot.radius_mm, "mm")) " in radius and "
                    (quantity(foot.height_mm, "mm")) " in height"
                }
                @match sheet.worst_toppling_deg {
                    Some(worst) => { ". With all play taken up it topples at " (quantity(worst, "°")) " where it is worst." }
                    None => { ". It reaches below the root's tail, so it cannot stand there: hold it or hang it." }
                }
            }
            table class="stack" {
                thead { tr { th scope="col" { "Key" } th scope="col" class="n" { "Centre of mass, mm" } th scope="col" class="n" { "Topples at" } } }
                tbody {
                    @for (index, row) in sheet.balance.iter().enumerate() {
                        tr {
                            th scope="row" { (index) }
                            td class="n" data-head="Centre of mass" { (row.centre_mm.map(number).join(", ")) }
                            td class="n" data-head="Topples at" { (lean(row.toppling_deg)) }
                        }
                    }
                }
            }
        }
    }
}

fn trade(sheet: &TelescopeSheet) -> Markup {
    html! {
        section {
            h2 { "Numbers of shells tried" }
            table class="stack" {
                thead {
                    tr {
                        th scope="col" { "Shells" } th scope="col" class="n" { "Deviation" } th scope="col" class="n" { "Root radius" }
                        th scope="col" class="n" { "Length, all in" } th scope="col" { "Why not" }
                    }
                }
                tbody {
                    @for row in &sheet.trade {
                        tr {
                            th scope="row" { (row.shells) }
                            td class="n" data-head="Deviation" { (quantity_or_dash(row.deviation_mm, "mm")) }
                            td class="n" data-head="Root radius" { (quantity_or_dash(row.root_mm, "mm")) }
                            td class="n" data-head="Length, all in" { (quantity_or_dash(row.collapsed_mm, "mm")) }
                            td data-head="Why not" { (row.why.as_deref().unwrap_or("–")) }
                        }
                    }
                }
            }
        }
    }
}

/// Returns the lean at which it topples, or a dash if it cannot stand there.
fn lean(toppling_deg: Option<f64>) -> String {
    toppling_deg.map_or_else(|| "–".to_owned(), |deg| quantity(deg, "°"))
}
