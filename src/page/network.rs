//! The job sheet of several telescopes on junctures, in the order in which the shop works.

use maud::{Markup, html};

use super::closing::{Closing, closings_of};
use super::document::styled_document;
use super::fields::file_name;
use super::figure::{Picture, Role, figures};
use super::job_id::JobId;
use super::poses::poses;
use super::running::style;
use super::stage::{Stage, viewer};
use super::telescope::{
    DO_NOT_PRINT, FIELDS, STEPS, TelescopePage, assemble, clean, dry_fit, glue, joint_line,
    sign_off,
};
use super::wing_frame::{self as frame, Cover};
use crate::base::numbers::{measured, measured_extent, number};
use crate::base::units::format_count;
use crate::sheet::network::{JunctureJointRow, LimbRow, NetworkSheet};
use crate::sheet::telescope::JointRow;
use crate::verify::{JuncturePartPromise, JuncturePromise};

/// Everything the pages of several telescopes show.
#[derive(Debug, Clone, Copy)]
pub struct NetworkPage<'a> {
    /// The checklist.
    pub sheet: &'a NetworkSheet,
    /// SHA-256 of `checklist.json`, hexadecimal.
    pub sha256: &'a str,
    /// The pictures.
    pub pictures: &'a [Picture],
    /// The view for a screen; `None` for a page with pictures only.
    pub view: Option<&'a Stage>,
}

impl<'a> NetworkPage<'a> {
    pub(super) fn job_id(&self) -> JobId<'a> {
        JobId {
            name: &self.sheet.job,
            sha256: self.sha256,
        }
    }

    fn limb(&self, limb: &'a LimbRow) -> TelescopePage<'a> {
        TelescopePage {
            sheet: &limb.sheet,
            sha256: self.sha256,
            pictures: &[],
            view: None,
        }
    }
}

/// Returns the job sheet as a self-contained HTML page with its pictures.
pub fn network_job(page: &NetworkPage) -> String {
    let job = page.job_id();
    let steps = [print, wash, try_dry, put_together, open, test];
    let body = html! {
        (cover(page, &job))
        main {
            @if let Some(view) = page.view { (viewer(view)) }
            (frame::steps(STEPS.into_iter().zip(steps.map(|step| step(page)))))
            (sign_off(&STEPS))
        }
    };
    let title = format!("Job sheet: {}", page.sheet.job);
    styled_document(&title, &body, &style(&job))
}

/// Words what the figure does, in one sentence.
pub(super) fn promise(sheet: &NetworkSheet) -> String {
    let shells: usize = sheet.limbs.iter().map(|limb| limb.sheet.shells.len()).sum();
    let stands = sheet.least_angle_deg.map_or(String::new(), |least| {
        let least = measured(least, "°");
        format!(" It stands on its foot at every state until leaned by {least}.")
    });
    format!(
        "{} of {} on {}, which open from {} to {}.{stands}",
        format_count(sheet.limbs.len(), "limb"),
        format_count(shells, "shell"),
        format_count(sheet.junctures.len(), "juncture"),
        measured_extent(&sheet.collapsed_mm),
        measured_extent(&sheet.extended_mm),
    )
}

/// Returns the id of a juncture, from 1.
pub(super) fn juncture(sheet: &NetworkSheet, number: usize) -> &str {
    let own = sheet.junctures.get(number.saturating_sub(1));
    own.map_or("", |own| own.id.as_str())
}

fn cover(page: &NetworkPage, job: &JobId) -> Markup {
    let sheet = page.sheet;
    let content = html! {
        (figures(page.pictures, Role::State))
        (facts(sheet))
        (figures(page.pictures, Role::Exploded))
    };
    let cover = Cover {
        job,
        promise: promise(sheet),
        broken: DO_NOT_PRINT,
        fields: &FIELDS,
    };
    cover.draw(sheet, &content)
}

fn facts(sheet: &NetworkSheet) -> Markup {
    let parts: usize = sheet.limbs.iter().map(|limb| limb.sheet.parts.len()).sum();
    let parts = parts + sheet.juncture_rows.len();
    let rows: [(&str, String); 7] = [
        ("All in", measured_extent(&sheet.collapsed_mm)),
        ("All out", measured_extent(&sheet.extended_mm)),
        ("Printer", sheet.printer.name.clone()),
        ("Material", sheet.material.name.clone()),
        ("Mass", measured(sheet.mass_g, "g")),
        ("Kit", format_count(parts, "part")),
        ("Opens", format!("limb {}", sheet.order.join(", then "))),
    ];
    html! {
        table class="facts" {
            @for (name, words) in rows { tr { th scope="row" { (name) } td { (words) } } }
        }
        @if !sheet.solid.is_empty() { p class="small" { "Stays solid: " (sheet.solid.join("; ")) "." } }
    }
}

fn print(page: &NetworkPage) -> Markup {
    let sheet = page.sheet;
    html! {
        p {
            "Layers of " (number(sheet.printer.layer_mm)) "\u{a0}mm, never scaled."
            @if sheet.printer.is_filament { " Solid shells and caps (100 % infill); junctures as you like." }
            " The parts lie in their files as they are printed; the plates hold all of them."
        }
        table class="stack" {
            thead {
                tr {
                    th scope="col" { "Part" } th scope="col" { "Lies" } th scope="col" { "Support" }
                    th scope="col" class="n" { "Size" } th scope="col" class="n" { "Mass" }
                }
            }
            tbody {
                @for (part, row) in pieces(sheet).zip(&sheet.juncture_rows) {
                    tr {
                        th scope="row" { "☐ " (row.id) " " (file_name(&part.file)) }
                        td data-head="Lies" { (row.lies) }
                        td data-head="Support" { @if row.is_free_of_support { "none" } @else { "as the slicer finds" } }
                        td class="n" data-head="Size" { (measured_extent(&row.size_mm)) }
                        td class="n" data-head="Mass" { (measured(row.mass_g, "g")) }
                    }
                }
                @for limb in &sheet.limbs {
                    @for (part, row) in limb.sheet.parts.iter().zip(&limb.sheet.part_rows) {
                        tr {
                            th scope="row" { "☐ " (row.id) " " (file_name(&part.file)) }
                            td data-head="Lies" { (row.lies) }
                            td data-head="Support" { (row.support) }
                            td class="n" data-head="Size" { (measured_extent(&row.size_mm)) }
                            td class="n" data-head="Mass" { (measured(row.mass_g, "g")) }
                        }
                    }
                }
            }
        }
    }
}

/// Returns the parts of all junctures.
fn pieces(sheet: &NetworkSheet) -> impl Iterator<Item = &JuncturePartPromise> {
    sheet.junctures.iter().flat_map(|own| &own.parts)
}

fn wash(page: &NetworkPage) -> Markup {
    let first = page.sheet.limbs.first();
    html! {
        @if let Some(limb) = first { (clean(&page.limb(limb))) }
        ul class="ticks" {
            li { "Clear the sockets of the junctures and the grooves beside them: the air leaves through them." }
        }
    }
}

fn try_dry(page: &NetworkPage) -> Markup {
    html! {
        @for limb in &page.sheet.limbs {
            h3 { "Limb " (limb.id) }
            (dry_fit(&page.limb(limb)))
        }
        ul class="ticks" {
            li { "Try every root in its socket and every peg in its mouth: flat on flat, slot on key, one way only." }
        }
    }
}

fn put_together(page: &NetworkPage) -> Markup {
    let sheet = page.sheet;
    html! {
        (glue_parts(sheet))
        p { "Limb by limb, those farthest from " (juncture(sheet, 1)) " first. Every limb is closed before it goes into its socket." }
        @for limb in sheet.limbs.iter().rev() {
            h3 { "Limb " (limb.id) }
            (assemble(&page.limb(limb)))
            ul class="ticks" {
                @if let Some(last) = limb.sheet.shells.last() {
                    li { "Glue the peg of " (juncture(sheet, limb.to)) " into the mouth of " (last.id) ", slot on key." }
                }
                @if let Some(root) = limb.sheet.shells.first() {
                    li { "Glue " (root.id) " into its socket in " (juncture(sheet, limb.from)) ", cap first, flat on flat. No glue in the groove, none near the mouth." }
                }
            }
        }
        (glue(&sheet.printer))
    }
}

/// Returns the gluing of junctures that are cut for the printer; nothing if none is.
fn glue_parts(sheet: &NetworkSheet) -> Markup {
    let divided = sheet.junctures.iter().filter(|own| own.parts.len() > 1);
    html! {
        @for own in divided {
            h3 { "Parts of " (own.id) }
            p {
                "Glue them before any limb goes in. Put all together dry first"
                @if fits_one_way(sheet, &own.id) { ": the pins fit one way only" }
                ". Wipe off what comes out at the seams, above all in the sockets."
            }
            ul class="ticks" {
                @for closing in gluing_steps(sheet, own) { li { (closing_words(&closing)) } }
            }
        }
    }
}

/// Returns true if the pins of all joints of a juncture fit one way only.
fn fits_one_way(sheet: &NetworkSheet, juncture: &str) -> bool {
    let joints = sheet.juncture_joints.iter();
    let mut own = joints.filter(|joint| joint.juncture == juncture);
    own.all(|joint| joint.is_aligned)
}

/// Returns the steps in which the parts of a juncture are glued.
fn gluing_steps<'a>(
    sheet: &'a NetworkSheet,
    own: &'a JuncturePromise,
) -> Vec<Closing<'a, JunctureJointRow>> {
    let joints = sheet.juncture_joints.iter();
    let joints = joints.filter(|joint| joint.juncture == own.id);
    let parts = own.parts.iter().map(|part| part.id.as_str());
    closings_of(parts, joints.collect())
}

fn closing_words(closing: &Closing<JunctureJointRow>) -> String {
    let [one, other] = closing.bodies();
    let joints = || closing.joints.iter();
    let area_mm2 = joints().map(|joint| joint.area_mm2).sum();
    // Pins that align one joint align all that close with it.
    let is_aligned = joints().any(|joint| joint.is_aligned);
    let mut notes: Vec<&str> = joints().filter_map(|joint| joint.note).collect();
    notes.dedup();
    let pins = match is_aligned {
        true => format_count(joints().map(|joint| joint.pins).sum(), "pin"),
        false => notes.join("; "),
    };
    format!(
        "Glue {one} to {other}, {}, {pins}.",
        measured(area_mm2, "mm²")
    )
}

fn open(page: &NetworkPage) -> Markup {
    let sheet = page.sheet;
    let limbs = sheet
        .order
        .iter()
        .filter_map(|id| sheet.limbs.iter().find(|limb| limb.id == *id));
    html! {
        p { "Open one limb after the other in this order, and each joint by joint as listed: other orders were not proved free. Close them the other way round." }
        @for limb in limbs {
            h3 { "Limb " (limb.id) }
            table class="stack" {
                thead {
                    tr {
                        th scope="col" { "Joint" } th scope="col" class="n" { "Comes out" }
                        th scope="col" { "Then turns" } th scope="col" { "Slides" }
                        th scope="col" { "Stops" } th scope="col" { "Holds" }
                    }
                }
                tbody { @for joint in joints(limb) { (joint_line(joint)) } }
            }
        }
        (poses(&sheet.poses, page.pictures))
    }
}

/// Returns the joints of a limb in the order in which they open.
fn joints(limb: &LimbRow) -> Vec<&JointRow> {
    let order = limb.sheet.order.iter().flatten();
    let row = |id: &String| limb.sheet.joint_rows.iter().find(|joint| joint.id == *id);
    order.filter_map(row).collect()
}

fn test(page: &NetworkPage) -> Markup {
    html! {
        ul class="ticks" {
            li { "Open and close it three times. No joint may jam, come apart, or need a tool." }
            @for limb in &page.sheet.limbs {
                li {
                    "All out, the tip of limb " (limb.id) " may be moved by "
                    (measured(limb.sheet.tip_play_mm, "mm")) " at most, by hand and without force."
                }
            }
            @if let Some(least) = page.sheet.least_angle_deg {
                li {
                    "Set it on a level table, all in, with each limb out in turn, and all out. Lean its foot by "
                    (measured(least, "°")) ": it must come back."
                    @if let Some(worst) = page.sheet.worst_toppling_deg {
                        " By calculation it topples at " (measured(worst, "°")) " where it is worst."
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joints_that_close_in_one_move_are_one_line_and_loose_ones_say_why() {
        let id = |part: usize| format!("N01-P0{part}");
        let row = |below: usize, above: usize, cut: &str| JunctureJointRow {
            juncture: "N01".to_owned(),
            cut: cut.to_owned(),
            parts: [id(below), id(above)],
            area_mm2: 100.0,
            pins: 2,
            is_aligned: true,
            note: None,
        };
        let loose = JunctureJointRow {
            pins: 1,
            is_aligned: false,
            note: Some("do not turn it"),
            ..row(1, 2, "C2")
        };
        let joints = [loose, row(1, 3, "C1"), row(2, 3, "C1")];
        let ids = [1, 2, 3].map(id);
        let steps = closings_of(ids.iter().map(String::as_str), joints.iter().collect());
        let said: Vec<String> = steps.iter().map(closing_words).collect();
        assert_eq!(said.len(), 2);
        assert!(said[0].contains("N01-P01 to N01-P02") && said[0].contains("do not turn it"));
        assert!(
            said[1].contains("N01-P01 + N01-P02 to N01-P03, 200"),
            "{}",
            said[1]
        );
        assert!(said[1].contains("4 pins"));
    }
}
