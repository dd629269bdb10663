//! The words for the best that is possible, and for what a kit reaches of it.

use crate::base::numbers::measured;
use crate::goal::GoalKind;
use crate::sheet::Checklist;
use crate::verify::FigureName;

/// Changes of infill below this are rounding.
const SAME_RATIO: f64 = 1e-6;

/// Returns the best that is possible and what this kit reaches.
pub fn bound_words(checklist: &Checklist) -> String {
    let proof = &checklist.certificate;
    let unit = proof.figure.unit();
    let best = measured(proof.bound, unit);
    let infill = checklist.infill.as_ref();
    if let Some(field) = infill.and_then(|infill| infill.field.as_ref()) {
        let least = match proof.bound < SAME_RATIO {
            true => "the wished infill alone does what was asked".to_owned(),
            false => format!("no densities that do what was asked differ by less than {best}"),
        };
        return format!(
            "the field {field} differs from the wished infill by {} of solid print (root mean \
             square); {least}",
            measured(proof.value, unit)
        );
    }
    if proof.figure == FigureName::InfillChangeRatio && proof.value < SAME_RATIO {
        return format!(
            "the infill is the wished one: it does what was asked{}",
            kept_words(checklist)
        );
    }
    if proof.figure == FigureName::InfillChangeRatio {
        return format!(
            "the infill differs from the wished one by {} of solid print (root mean square); what \
             was asked needs {best}{}{}",
            measured(proof.value, unit),
            match checklist.goal.aim.kind {
                GoalKind::Top => " with the centre of mass at this height",
                _ => "",
            },
            kept_words(checklist)
        );
    }
    let is_cut = checklist.infill.is_none();
    let is_solid = is_cut && proof.kept_solid_mm3 + proof.bosses_mm3 > 0.0;
    let of_what = if is_solid {
        match checklist.cuts.is_empty() {
            true => " with what must stay solid",
            false => " with these cuts and pins",
        }
    } else {
        ""
    };
    let Some(written) = proof.written_value else {
        return format!("{} {best} is possible{of_what}", proof.figure.name());
    };
    let [name, written] = [proof.figure.name().to_owned(), measured(written, unit)];
    format!("{name} {written}; at best {best} is possible{of_what}")
}

/// Returns what a print near a wished infill keeps of the best figure; empty if that is not known.
fn kept_words(checklist: &Checklist) -> String {
    let course = checklist.certificate.course.as_ref();
    let trade = course.and_then(|course| course.trade.as_ref());
    let kept = trade.and_then(|trade| {
        let (name, unit) = (trade.figure.name(), trade.figure.unit());
        let own = measured(checklist.assembly.value_of(trade.figure)?, unit);
        Some(format!(
            "; its {name} is {own}, at any infill about {} is possible",
            measured(trade.best, unit)
        ))
    });
    kept.unwrap_or_default()
}
