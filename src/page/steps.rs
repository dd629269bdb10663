//! The steps of a job in their order, with boxes to tick and fields to fill in.

use maud::{Markup, html};

use super::cleaning::clean_one;
use super::fields::{blank, mass_window};
use super::figure::{Picture, Role, figures, figures_of};
use super::gluing::{dry_fit, glue};
use super::hardware::fit_hardware;
use super::plugging::close_holes;
use super::printing::print_step;
use super::trials::test_step;
use super::weighing::{weigh_parts, weigh_whole};
use crate::base::numbers::{coordinates, measured, quantity};
use crate::base::units::MM3_PER_CM3;
use crate::sheet::{BallastRow, Checklist};
use crate::verify::FillOrder;

/// A step: its name and what it shows.
struct Step {
    name: &'static str,
    body: Markup,
}

/// Returns the names of the steps in their order. Parts are weighed while they can still be
/// cleaned; filling, ballast and hardware are steps only if the job has them.
pub(super) fn step_names(sheet: &Checklist) -> Vec<&'static str> {
    let steps = all_steps(sheet, &[]);
    steps.into_iter().map(|step| step.name).collect()
}

/// Returns every step with its pictures.
pub(super) fn steps(sheet: &Checklist, pictures: &[Picture]) -> Markup {
    let steps = all_steps(sheet, pictures).into_iter();
    html! {
        @for (index, step) in steps.enumerate() {
            section class="step" {
                h2 id=(format!("step-{}", index + 1)) { (index + 1) ". " (step.name) }
                (step.body)
            }
        }
    }
}

fn all_steps(sheet: &Checklist, pictures: &[Picture]) -> Vec<Step> {
    let step = |name, body| Some(Step { name, body });
    let clean = html! { (clean(sheet, pictures)) (weigh_parts(sheet)) };
    let fit = html! { (dry_fit(sheet)) (figures(pictures, Role::Joint)) };
    let glued = html! {
        (glue(sheet))
        (put_together(pictures))
    };
    // What goes into the voids goes in between the dry fit and the glue.
    let between = [
        sheet
            .fill
            .and_then(|fill| step("Fill every void", filling(sheet, fill))),
        step("Lay in the ballast", ballast(sheet)).filter(|_| !sheet.ballast.is_empty()),
    ];
    let [fit, glued] = if between.iter().any(Option::is_some) {
        [step("Dry fit", fit), step("Glue", glued)]
    } else {
        [step("Join", html! { (fit) (glued) }), None]
    };
    let is_glued = !sheet.joints.is_empty();
    let hardware = step("Put in the hardware", fit_hardware(sheet, pictures));
    let last = html! { (weigh_whole(sheet)) (test_step(sheet, pictures)) };
    let first = [
        step("Print", print_step(sheet, pictures)),
        step("Clean and weigh", clean),
    ];
    let steps = first
        .into_iter()
        .chain([fit.filter(|_| is_glued)])
        .chain([close_holes(sheet).map(|body| Step {
            name: "Close the drain holes",
            body,
        })])
        .chain(between)
        .chain([glued.filter(|_| is_glued)])
        .chain([
            hardware.filter(|_| !sheet.hardware.is_empty()),
            step("Test", last),
        ]);
    steps.flatten().collect()
}

/// Returns the pictures of how parts come together: side by side if jigs hold them.
fn put_together(pictures: &[Picture]) -> Markup {
    if pictures.iter().any(|picture| picture.role == Role::Jig) {
        figures_of(pictures, &[Role::Jig, Role::Exploded])
    } else {
        figures(pictures, Role::Exploded)
    }
}

fn filling(sheet: &Checklist, fill: FillOrder) -> Markup {
    html! {
        p {
            "With the cut faces up and level, fill every piece of a void flush with its cut face with a material of "
            (quantity(fill.density_g_cm3, "g/cm³")) ", without bubbles, and let it set. Keep sockets and cut faces clean."
        }
        table class="stack" {
            thead { tr { th scope="col" { "Void" } th scope="col" class="n" { "Filling, in all its pieces" } th scope="col" { "Weighed, g" } } }
            tbody {
                @for void in &sheet.voids {
                    tr {
                        th scope="row" { "☐ " (void.id) }
                        td class="n" data-head="Filling" {
                            (measured(void.volume_mm3 / MM3_PER_CM3, "cm³")) ", "
                            (measured(void.volume_mm3 / MM3_PER_CM3 * fill.density_g_cm3, "g"))
                        }
                        td data-head="Weighed, g" { (blank()) }
                    }
                }
            }
        }
    }
}

fn ballast(sheet: &Checklist) -> Markup {
    html! {
        p { "Weigh each piece first: one outside its window spoils the balance. Glue it into its pocket so that it cannot rattle." }
        table class="stack" {
            thead {
                tr {
                    th scope="col" { "Piece" } th scope="col" class="n" { "Mass" } th scope="col" { "Weighed, g" }
                    th scope="col" { "Into" } th scope="col" { "Centre, model frame" }
                }
            }
            tbody { @for row in &sheet.ballast { (ballast_line(row)) } }
        }
        p class="small" { "Sources of the sizes and masses:" }
        @for source in ballast_sources(sheet) { p class="small" { (source) } }
    }
}

fn ballast_line(row: &BallastRow) -> Markup {
    let lump = &row.order.lump;
    html! {
        tr {
            th scope="row" { "☐ " (row.order.id) ": " (row.name) " (" code { (row.part) } ")" }
            td class="n" data-head="Mass" { (mass_window(lump.mass_g, row.mass_spread_ratio)) }
            td data-head="Weighed, g" { (blank()) }
            td data-head="Into" { "pocket " (row.void) ", open along " (row.opened_by.join(", ")) ", " (quantity(row.clearance_mm, "mm")) " of room all around" }
            td data-head="Centre, model frame" {
                (coordinates(&lump.center_mm))
                @if !lump.shape.is_ball() { ", axis " (coordinates(&lump.axis)) }
            }
        }
    }
}

/// Returns the sources of the ballast's numbers, each once.
fn ballast_sources(sheet: &Checklist) -> Vec<&String> {
    let mut sources: Vec<&String> = sheet.ballast.iter().flat_map(|row| &row.sources).collect();
    sources.sort();
    sources.dedup();
    sources
}

fn clean(sheet: &Checklist, pictures: &[Picture]) -> Markup {
    html! {
        @if sheet.voids.is_empty() { p { "There are no voids: nothing to clean." } }
        @else {
            div class="beside" {
                (figures_of(pictures, &[Role::CutAway, Role::Drain]))
                ul class="ticks" { @for void in &sheet.voids { (clean_one(sheet, void)) } }
            }
        }
    }
}
