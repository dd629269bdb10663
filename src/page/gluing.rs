//! The dry fit and the gluing: the order of the joints, and what to watch at each.

use maud::{Markup, html};

use super::closing::{Closing, closings};
use super::fields::{blank, file_name};
use crate::base::numbers::{measured, quantity};
use crate::base::units::format_count;
use crate::goal::GoalKind;
use crate::sheet::{Checklist, GlueRow, JigRow, JointRow, ShaftKind};

/// Share of a wall that a filed step must leave. With less, a knock breaks the seam, in our
/// judgement.
const LEAST_FILED_RATIO: f64 = 0.6;

/// Returns how the joints are aligned: their pins, and their notes.
fn alignment(sheet: &Checklist, closing: &Closing) -> Markup {
    let is_one = closing.joints.len() == 1;
    html! {
        @for joint in &closing.joints {
            div {
                @if !is_one { (joint.id) ": " }
                @if joint.pins > 0 {
                    (format_count(joint.pins, "pin"))
                    ", " (quantity(joint.clearance_mm, "mm")) " of room on each side. "
                }
                @if let Some(jig) = jig_of(sheet, joint) { (jig_words(jig)) }
                @else if joint.pins == 0 && joint.note.is_none() { "No pins: match the outlines by eye. " }
                @if let Some(play) = joint.play {
                    "The step at the rim is at most " (measured(play.step_mm, "mm")) ". "
                }
                @if let Some(note) = &joint.note { strong { (capitalised(note)) "." } " " }
                @if let Some(other) = closing.guide_of(joint) { "The pins of " (other.id) " align it, as both close together." }
            }
        }
    }
}

/// Returns how everything is put together without glue.
pub(super) fn dry_fit(sheet: &Checklist) -> Markup {
    html! {
        (cut_list(sheet))
        p {
            "Put everything together without glue first. There must be no gap at a seam. "
            (of_steps(sheet))
        }
        ul class="ticks" {
            @for closing in closings(sheet) {
                li {
                    strong { (closing.name()) } ": " (closing.movement(sheet))
                    @if closing.joints.iter().any(|joint| joint.pins > 0) { ", every pin all the way in" }
                    ". "
                    (alignment(sheet, &closing))
                }
            }
        }
    }
}

/// Words what to do with a step at a seam. Filing it off takes as much of the wall.
fn of_steps(sheet: &Checklist) -> &'static str {
    let steps = sheet.joints.iter().filter_map(|joint| joint.play);
    let step_mm = steps.map(|play| play.step_mm).fold(0.0, f64::max);
    let wall_mm = sheet.wall.measured_min_mm.unwrap_or(f64::INFINITY);
    if wall_mm - step_mm >= LEAST_FILED_RATIO * wall_mm {
        "A step no larger than stated below may be filed off after gluing."
    } else {
        "Fill a step after gluing, and sand it smooth. Do not file it off: the wall is thin."
    }
}

/// Returns the jig that holds a joint; `None` if it has none.
fn jig_of<'a>(sheet: &'a Checklist, joint: &JointRow) -> Option<&'a JigRow> {
    sheet.jigs.iter().find(|jig| jig.order.joint == joint.id)
}

/// Words how a jig holds a joint.
fn jig_words(jig: &JigRow) -> Markup {
    html! { "Lay both parts in " strong { (jig.order.id) } " and press them together. " }
}

/// Returns a text with a large first letter, as it begins a sentence.
fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(char::to_uppercase);
    first.into_iter().flatten().chain(letters).collect()
}

/// Returns how jigs are used: one step for each; empty without jigs.
fn jig_steps(sheet: &Checklist) -> Markup {
    html! {
        @if !sheet.jigs.is_empty() {
            p { "Jigs are tools, no parts of the object. A jig cradles the outside on both sides of the seam and leaves the seam free." }
            ul class="ticks" {
                @for jig in &sheet.jigs {
                    li {
                        strong { (jig.order.id) } " (" (file_name(&jig.order.file)) "): lay both parts of "
                        (jig.order.joint) " in the jig and glue them. Press them down and together by hand until the glue holds: "
                        "the jig guides them, and does not carry them. Wipe the seam, and pull the jig off straight."
                    }
                }
            }
        }
    }
}

/// Mass of a drop of glue, g.
const DROP_G: f64 = 0.05;

/// Returns how the parts are glued, two bodies at a time.
pub(super) fn glue(sheet: &Checklist) -> Markup {
    html! {
        div class="lead" {
            @if let Some(glue) = &sheet.printer.glue { (glue_words(sheet, glue)) }
            p { (glue_advice(sheet.goal.aim.kind)) }
            @if let Some(advice) = shaft_advice(sheet) { p { (advice) } }
            @if closings(sheet).len() > 1 {
                p {
                    "Let each row harden before the next."
                    @if closings(sheet).iter().any(|closing| closing.joints.len() > 1) {
                        " Joints in the same row: put glue on all of them, then close them together."
                    }
                }
            }
        }
        (jig_steps(sheet))
        table class="stack" {
            thead {
                tr {
                    th scope="col" { "Joint" }
                    th scope="col" { "Movement" }
                    th scope="col" class="n" { "Area" }
                    th scope="col" class="n" { "Glue" }
                    th scope="col" { "Glued, clamped until" }
                }
            }
            tbody { @for closing in closings(sheet) { (line(sheet, &closing)) } }
        }
    }
}

/// Words the glue: its name, its amount, its times and its dangers.
fn glue_words(sheet: &Checklist, glue: &GlueRow) -> Markup {
    let rows_g: Vec<f64> = closings(sheet).iter().map(film_mass_g).collect();
    html! {
        p {
            strong { "Glue: " } (glue.name)
            @if let Some(all) = whole_amount(&rows_g) { ", " (all) " in all (calculated)" }
            "."
            @if let Some(seconds) = glue.hold_s { " Hold each joint for " (measured(seconds, "s")) "." }
            @if let Some(hours) = glue.cure_h { " Leave it for " (quantity(hours, "h")) " before the test." }
        }
        @if let Some(safety) = &glue.safety { p { strong { "Safety: " } (safety) } }
    }
}

/// Words an amount of glue as somebody can give it.
fn amount(mass_g: f64) -> String {
    if mass_g < DROP_G {
        "one drop".to_owned()
    } else {
        measured(mass_g, "g")
    }
}

/// Words the amount of glue of several rows as it is given row by row: the drops, and the rest by
/// mass. `None` if it is not known.
fn whole_amount(rows_g: &[f64]) -> Option<String> {
    let drops = rows_g
        .iter()
        .filter(|&&mass_g| 0.0 < mass_g && mass_g < DROP_G);
    let drops = drops.count();
    let by_mass_g: f64 = rows_g.iter().filter(|&&mass_g| mass_g >= DROP_G).sum();
    let by_mass = (by_mass_g > 0.0).then(|| measured(by_mass_g, "g"));
    let by_drop = match drops {
        0 => None,
        1 => Some("one drop".to_owned()),
        several => Some(format_count(several, "drop")),
    };
    let all: Vec<String> = by_mass.into_iter().chain(by_drop).collect();
    (!all.is_empty()).then(|| all.join(" and "))
}

/// Returns the mass of the glue in the joints that close in one movement, g.
fn film_mass_g(closing: &Closing) -> f64 {
    let films = closing.joints.iter().filter_map(|joint| joint.glue);
    films.map(|film| film.mass_g).sum()
}

fn line(sheet: &Checklist, closing: &Closing) -> Markup {
    let area_mm2 = closing.joints.iter().map(|joint| joint.area_mm2).sum();
    let mass_g = film_mass_g(closing);
    html! {
        tr {
            th scope="row" { "☐ " (closing.name()) }
            td data-head="Movement" { (closing.movement(sheet)) }
            td class="n" data-head="Area" { (measured(area_mm2, "mm²")) }
            td class="n" data-head="Glue" { @if mass_g > 0.0 { (amount(mass_g)) } @else { "a thin film" } }
            td data-head="Glued, clamped until" { (blank()) }
        }
    }
}

/// Returns how to apply the glue for a goal of this kind.
fn glue_advice(kind: GoalKind) -> &'static str {
    match kind {
        GoalKind::Float => {
            "Seal every joint all around: glue the faces, then run a bead of glue around the seam. A void that fills with water sinks it or turns it over."
        }
        GoalKind::Top | GoalKind::Yoyo | GoalKind::Balance => {
            "Use little glue, and keep it out of the voids: extra glue unbalances it. Wipe off what is pressed out."
        }
        GoalKind::Stand | GoalKind::Match => {
            "Use little glue, and keep it out of the voids. Wipe off what is pressed out."
        }
    }
}

/// Returns how the shaft of a rotor lines its parts up; `None` if the play of its joints costs less
/// than its grade, or if it has no bore.
fn shaft_advice(sheet: &Checklist) -> Option<String> {
    let allowed_g_mm = sheet.goal.aim.rotor?.allowed_g_mm(sheet.assembly.mass_g);
    let left = sheet.joints.iter().filter_map(|joint| joint.unbalance_g_mm);
    let turns_on = sheet.goal.turns_on.first()?;
    let is_needed = left.sum::<f64>() > allowed_g_mm;
    // A bore that is still to be made holds no shaft.
    (is_needed && turns_on.kind == ShaftKind::Bore).then(|| {
        format!(
            "Before the glue sets, push a straight shaft through the bore ({}) that just fits. \
             It lines up the parts that the bore runs through. Keep it free of glue.",
            measured(turns_on.diameter_mm, "mm")
        )
    })
}

/// Returns the dowels to cut; empty if pins are printed.
fn cut_list(sheet: &Checklist) -> Markup {
    html! {
        @if !sheet.cut_list.is_empty() {
            p { "Cut the dowels with square ends, free of burrs; half of each goes into either part." }
            ul class="ticks" {
                @for row in &sheet.cut_list {
                    li {
                        strong { (row.count) " × " (row.name) } " (" code { (row.rod) } "), "
                        (quantity(row.length_mm, "mm")) " long, "
                        (measured(row.mass_g, "g")) " each"
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::closing::tests::sheet;
    use super::*;
    use crate::sheet::ShaftRow;
    use crate::testing::sample;
    use crate::verify::RotorOrder;

    #[test]
    fn a_shaft_lines_up_a_rotor_whose_joints_have_too_much_play_and_whose_bore_is_there() {
        let mut rotor = sample().0;
        rotor.goal.aim.rotor = Some(RotorOrder {
            speed_rpm: 3000.0,
            grade_mm_s: 6.3,
        });
        rotor.assembly.mass_g = 100.0;
        let mut advice = |kind: ShaftKind, left_g_mm: f64| {
            rotor.joints[0].unbalance_g_mm = Some(left_g_mm);
            rotor.goal.turns_on = vec![ShaftRow {
                kind,
                diameter_mm: 8.0,
            }];
            shaft_advice(&rotor)
        };
        // Its grade allows 1.0027 g·mm in each plane.
        assert!(advice(ShaftKind::Bore, 1.1).is_some());
        assert_eq!(advice(ShaftKind::Bore, 0.9), None);
        assert_eq!(advice(ShaftKind::BoreToMake, 1.1), None);
        assert_eq!(advice(ShaftKind::ShaftEnd, 1.1), None);
    }

    #[test]
    fn a_joint_without_pins_is_aligned_by_one_that_closes_with_it() {
        let mut crossed = sheet(4, &[(1, 2, "C1"), (1, 3, "C2"), (3, 4, "C1"), (2, 4, "C2")]);
        for (index, pins) in [0, 0, 2, 2].into_iter().enumerate() {
            crossed.joints[index].pins = pins;
            crossed.joints[index].note = (pins == 0).then(|| "no room for pins".to_owned());
        }
        let words =
            |closing: usize| alignment(&crossed, &closings(&crossed)[closing]).into_string();
        // J1 closes alone; J2 closes with J4.
        assert!(!words(0).contains("align it"), "{}", words(0));
        assert!(
            words(2).contains("No room for pins.</strong> The pins of J4 align it"),
            "{}",
            words(2)
        );
        assert_eq!(words(2).matches("align it").count(), 1);
    }

    #[test]
    fn several_rows_of_one_drop_are_several_drops_in_all() {
        let all = |rows_g: &[f64]| whole_amount(rows_g).map(|all| all.replace('\u{a0}', " "));
        assert_eq!(all(&[0.01, 0.02, 0.01]).as_deref(), Some("3 drops"));
        assert_eq!(all(&[0.01]).as_deref(), Some("one drop"));
        assert_eq!(
            all(&[0.4, 0.3, 0.01]).as_deref(),
            Some("0.70 g and one drop")
        );
        assert_eq!(all(&[0.0]), None);
    }

    #[test]
    fn the_seam_of_what_floats_is_sealed() {
        assert!(glue_advice(GoalKind::Float).contains("a bead of glue around the seam"));
    }

    #[test]
    fn only_turning_objects_are_warned_of_unbalance() {
        assert!(
            glue_advice(GoalKind::Top).contains("unbalances")
                && !glue_advice(GoalKind::Stand).contains("unbalances")
        );
    }

    #[test]
    fn the_glue_is_named_with_its_amount_its_times_and_its_dangers() {
        let mut sheet = sample().0;
        let page = glue(&sheet).into_string().replace('\u{a0}', " ");
        for said in [
            "super glue",
            "for 60 s",
            "for 24 h",
            "Safety: </strong>The glue bonds skin",
        ] {
            assert!(page.contains(said), "{said}: {page}");
        }
        assert!(page.contains("push P02 onto P01") || page.contains("push P01 onto P02"));
        sheet.printer.glue = None;
        assert!(!glue(&sheet).into_string().contains("Safety"));
    }
}
