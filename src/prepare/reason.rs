//! The reason why a kit breaks a promise, in words.

use super::outcome::Prepared;
use crate::base::numbers::quantity;
use crate::sheet::Checklist;
use crate::verify::{Check, CheckKind, FigureName};

/// Explains what the goal could have reached, and what the parts keep of it.
pub fn reason(prepared: &Prepared, broken: &[&Check]) -> String {
    let proof = &prepared.checklist.certificate;
    let names: Vec<String> = broken.iter().map(|check| check.kind.to_string()).collect();
    let unit = proof.figure.unit();
    if let Some(check) = broken
        .iter()
        .find(|check| is_shaky(&prepared.checklist, check))
    {
        return format!(
            "it topples too early: no hollowing with this wall reaches more than {}, and {} are promised",
            quantity(proof.possible(), unit),
            quantity(check.limit, unit)
        );
    }
    let is_far = broken
        .iter()
        .any(|check| follows_from_hollowing(&check.kind));
    match proof.written_value.filter(|_| is_far) {
        Some(written) => format!(
            "{}. The best void reaches a {} of {}, and the parts that can be made keep {}. Pins, cuts and cleaning take too \
             much of it",
            broken_words(&names),
            proof.figure.name(),
            quantity(proof.possible(), unit),
            quantity(written, unit)
        ),
        None => broken_words(&names),
    }
}

/// Words which promises are broken: `Two promises are broken: contact, lean`.
fn broken_words(names: &[String]) -> String {
    let count = match names.len() {
        1 => "One promise is".to_owned(),
        2 => "Two promises are".to_owned(),
        3 => "Three promises are".to_owned(),
        more => format!("{more} promises are"),
    };
    format!("{count} broken: {}", names.join(", "))
}

/// Returns whether no hollowing stands as firmly as promised. Else another size or wall is no sure
/// help: what the cuts take decides.
pub fn is_out_of_reach(prepared: &Prepared, broken: &[&Check]) -> bool {
    let mut broken = broken.iter();
    broken.any(|check| is_shaky(&prepared.checklist, check))
}

/// Returns whether a check is broken because no hollowing stands as firmly as promised.
fn is_shaky(sheet: &Checklist, check: &Check) -> bool {
    let proof = &sheet.certificate;
    check.kind == CheckKind::Standing
        && proof.figure == FigureName::TopplesDeg
        && !check.comparison.holds(proof.possible(), check.limit)
}

/// Returns true if what pins, cuts and cleaning take can break this promise.
pub fn follows_from_hollowing(kind: &CheckKind) -> bool {
    matches!(
        kind,
        CheckKind::AxisOffset
            | CheckKind::AxisTilt
            | CheckKind::Dominance
            | CheckKind::Standing
            | CheckKind::Waterline
            | CheckKind::Upright
            | CheckKind::Stability
            | CheckKind::Righting
            | CheckKind::BalanceQuality
            | CheckKind::PromisedFigure { .. }
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn broken_promises_are_counted_and_named() {
        let words =
            |names: &[&str]| broken_words(&names.iter().map(|&n| n.into()).collect::<Vec<_>>());
        assert_eq!(
            words(&["contact", "lean"]),
            "Two promises are broken: contact, lean"
        );
        assert_eq!(words(&["wall"]), "One promise is broken: wall");
    }
    use crate::verify::Limit;

    #[test]
    fn a_thin_neck_is_not_laid_to_what_pins_and_cuts_take() {
        assert!(!follows_from_hollowing(&CheckKind::ThinNecks));
        assert!(!follows_from_hollowing(&CheckKind::VoidClean {
            void: "V1".into()
        }));
        assert!(follows_from_hollowing(&CheckKind::Standing));
    }

    #[test]
    fn only_an_angle_that_no_hollowing_reaches_is_laid_to_the_hollowing() {
        let mut sheet = crate::testing::sample().0;
        sheet.certificate.figure = FigureName::TopplesDeg;
        sheet.certificate.value_before_cleaning = None;
        let check = {
            let limit = Limit::at_least(5.0, "°");
            Check::new(CheckKind::Standing, "stands", Some(2.0), limit)
        };
        sheet.certificate.bound = 4.0;
        assert!(is_shaky(&sheet, &check));
        // What the cuts left solid is no proof that a larger size helps.
        sheet.certificate.bound = 14.0;
        assert!(!is_shaky(&sheet, &check));
    }
}
