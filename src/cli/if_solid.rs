//! The figure and the mass of the model if it were printed solid.

use crate::base::numbers::{measured, quantity, rough};
use crate::base::units::show_wobble;
use crate::goal::GoalKind;
use crate::page::mismatch;
use crate::sheet::Checklist;
use crate::verify::FigureName;

/// Returns what the model would do if it were printed solid, and its mass.
pub fn solid_words(checklist: &Checklist) -> String {
    let certified = checklist.certificate.figure;
    let promised = checklist.promise.map(|promise| promise.figure);
    // The certificate of infill near a wished one says nothing of solid print.
    let named = match certified {
        FigureName::InfillChangeRatio => promised.unwrap_or(certified),
        _ => certified,
    };
    let mass = measured(checklist.solid.mass_g, "g");
    let kind = checklist.goal.aim.kind;
    if let Some(wanted) = &checklist.goal.aim.wanted {
        return format!("{mass}, {}", mismatch(wanted, &checklist.solid));
    }
    let does = match (checklist.solid.value_of(named), kind) {
        (None, GoalKind::Top) => "falls over at any speed".to_owned(),
        (None, GoalKind::Float) => "sinks".to_owned(),
        (None, _) => format!("has no {}", named.name()),
        (Some(value), GoalKind::Stand) if value <= 0.0 => "falls over by itself".to_owned(),
        (Some(value), GoalKind::Balance) => {
            let grade = checklist
                .solid
                .unbalance
                .map(|unbalance| unbalance.grade_mm_s);
            grade.map_or(
                format!("{} {}", named.name(), measured(value, named.unit())),
                |grade| format!("G\u{a0}{}{}", rough(grade, ""), at_speed(checklist)),
            )
        }
        (Some(value), _) if named == FigureName::DominanceRatio => show_wobble(value),
        (Some(value), _) => format!("{} {}", named.name(), measured(value, named.unit())),
    };
    format!("{mass}, {does}")
}

/// Words the speed at which a rotor's grade holds; empty if none was ordered.
fn at_speed(checklist: &Checklist) -> String {
    let order = checklist.goal.aim.rotor;
    order.map_or(String::new(), |order| {
        format!(" at {}", quantity(order.speed_rpm, "rpm"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::sample;
    use crate::verify::{RotorOrder, Unbalance};

    #[test]
    fn a_solid_rotor_has_its_grade_with_two_digits_and_its_speed() {
        let mut sheet = sample().0;
        sheet.goal.aim.kind = GoalKind::Balance;
        sheet.goal.aim.rotor = Some(RotorOrder {
            speed_rpm: 3000.0,
            grade_mm_s: 6.3,
        });
        sheet.certificate.figure = FigureName::MassG;
        sheet.solid.unbalance = Some(Unbalance {
            static_g_mm: 50.0,
            couple_g_mm2: 0.0,
            end_plane_g_mm: 25.0,
            grade_mm_s: 2706.0,
        });
        let said = solid_words(&sheet).replace('\u{a0}', " ");
        assert!(said.ends_with(", G 2700 at 3000 rpm"), "{said}");
    }
}
