//! What the finished object does: how it floats, runs true, or handles like another body.

use maud::{Markup, html};

use crate::base::numbers::{coordinates, measured, number, quantity, rough};
use crate::base::units::MM3_PER_CM3;
use crate::goal::Target;
use crate::sheet::Checklist;
use crate::verify::{Figures, Mismatch};

/// Least distance in mm, and least share in per cent, that is told. Nobody prints so exactly.
const LEAST_TOLD: f64 = 0.001;

/// Words how it floats.
pub(super) fn floats(sheet: &Checklist) -> String {
    match sheet.assembly.afloat {
        Some(afloat) if afloat.metacentric_height_mm > 0.0 => format!(
            "Floats upright, {} deep, with a metacentric height of {}.",
            measured(afloat.waterline_mm, "mm"),
            measured(afloat.metacentric_height_mm, "mm")
        ),
        Some(_) => "Floats, but not upright.".to_owned(),
        None => "Sinks.".to_owned(),
    }
}

/// Words how well a rotor is balanced, before and after.
pub(super) fn runs_true(sheet: &Checklist) -> String {
    let grade = |body: &Figures| body.unbalance.map(|unbalance| unbalance.grade_mm_s);
    match (
        sheet.goal.aim.rotor,
        grade(&sheet.solid).map(|grade| rough(grade, "")),
        grade(&sheet.assembly).map(number),
    ) {
        (Some(order), Some(solid), Some(written)) => format!(
            "Runs true: balanced to G\u{a0}{written} at {}; solid it would be G\u{a0}{solid}.",
            quantity(order.speed_rpm, "rpm")
        ),
        _ => "Not known to run true.".to_owned(),
    }
}

/// Words how near it is to the body that it is to handle like.
pub(super) fn handles(sheet: &Checklist) -> String {
    let Some(wanted) = sheet.goal.aim.wanted else {
        return "Not known to handle like another body.".to_owned();
    };
    let near = Mismatch::of(&wanted, &sheet.assembly);
    format!(
        "Handles like the original: it weighs {}, its centre of mass is {} off, its moments of \
         inertia {}.",
        measured(sheet.assembly.mass_g, "g"),
        small(near.center_mm, "mm"),
        small(near.inertia_ratio * 100.0, "%")
    )
}

/// Words how far a body is from the one that is wanted.
pub fn mismatch(wanted: &Target, body: &Figures) -> String {
    let off = Mismatch::of(wanted, body);
    let heavier = off.mass_ratio * 100.0;
    let word = if heavier < 0.0 { "light" } else { "heavy" };
    format!(
        "{} too {word}, its centre of mass {} off, its moments of inertia {}",
        small(heavier.abs(), "%"),
        small(off.center_mm, "mm"),
        small(off.inertia_ratio * 100.0, "%")
    )
}

/// Returns a value that should be zero, no more exactly than it can be made.
fn small(value: f64, unit: &str) -> String {
    if value < LEAST_TOLD {
        format!("less than {}", quantity(LEAST_TOLD, unit))
    } else {
        rough(value, unit)
    }
}

/// Words the mass, centre and principal moments of a body.
pub fn properties(body: &Figures) -> String {
    let moments = body.principal_moments_g_mm2.map(number).join(", ");
    format!(
        "{}; centre {}\u{a0}mm; principal moments {moments}\u{a0}g·mm²",
        quantity(body.mass_g, "g"),
        coordinates(&body.center_mm)
    )
}

/// Returns the wanted mass properties as figures of a body of this material.
pub fn wanted_figures(sheet: &Checklist) -> Option<Figures> {
    let wanted = sheet.goal.aim.wanted?;
    let body = wanted.body();
    let density_g_mm3 = sheet.material.density_g_cm3 / MM3_PER_CM3;
    Some(Figures {
        mass_g: wanted.mass_g,
        volume_mm3: wanted.mass_g / density_g_mm3,
        center_mm: wanted.center_mm,
        principal_moments_g_mm2: body.principal().moments_g_mm2,
        inertia_g_mm2: [0, 1, 2].map(|row| [0, 1, 2].map(|at| body.inertia_g_mm2[(row, at)])),
        ..sheet.assembly.clone()
    })
}

/// Returns the table of what is wanted of a match, what solid print has and what is reached;
/// nothing for other goals.
pub(super) fn match_table(sheet: &Checklist) -> Markup {
    let wanted = wanted_figures(sheet);
    let moment = |body: &Figures, at: usize| quantity(body.principal_moments_g_mm2[at], "g·mm²");
    let bodies = wanted.iter().map(|wanted| ("wanted", wanted));
    let bodies = bodies.chain([("solid", &sheet.solid), ("reached", &sheet.assembly)]);
    html! {
        @if wanted.is_some() {
            h3 { "Wanted and reached" }
            table class="stack" {
                thead {
                    tr {
                        th scope="col" { "Body" } th scope="col" class="n" { "Mass" } th scope="col" { "Centre of mass, mm" }
                        @for name in MOMENTS { th scope="col" class="n" { (name) } }
                    }
                }
                tbody {
                    @for (name, body) in bodies {
                        tr {
                            th scope="row" { (name) }
                            td class="n" data-head="Mass" { (quantity(body.mass_g, "g")) }
                            td data-head="Centre of mass, mm" { (coordinates(&body.center_mm)) }
                            @for at in 0..3 {
                                td class="n" data-head=(MOMENTS[at]) { (moment(body, at)) }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// The names of the principal moments, ascending.
const MOMENTS: [&str; 3] = ["I_a", "I_b", "I_c"];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::goal::GoalKind;
    use crate::page::promise;
    use crate::testing::sample;

    #[test]
    fn a_match_says_what_is_wanted_and_how_near_it_comes() {
        let mut sheet = sample().0;
        sheet.goal.aim.kind = GoalKind::Match;
        let mass_g = sheet.assembly.mass_g;
        let inertia = sheet.assembly.inertia_g_mm2;
        sheet.goal.aim.wanted = Some(Target {
            mass_g: mass_g * 1.02,
            center_mm: sheet.assembly.center_mm,
            inertia_g_mm2: [
                inertia[0][0],
                inertia[1][1],
                inertia[2][2],
                inertia[0][1],
                inertia[0][2],
                inertia[1][2],
            ],
        });
        let said = promise(&sheet);
        assert!(
            said.starts_with("Handles like the original: it weighs"),
            "{said}"
        );
        let wanted = sheet.goal.aim.wanted.unwrap();
        let off = mismatch(&wanted, &sheet.assembly);
        assert!(
            off.contains("too light") && off.contains("less than"),
            "{off}"
        );
        let table = match_table(&sheet).into_string();
        for name in ["wanted", "solid", "reached"] {
            assert!(table.contains(name), "{name}");
        }
        sheet.goal.aim.wanted = None;
        assert!(match_table(&sheet).into_string().is_empty());
    }
}
