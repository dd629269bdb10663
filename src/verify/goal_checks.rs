//! The checks of the goal: the axis, the support, the water, the balance and the promised figure.

use super::handling::{MatchLimits, Mismatch};
use super::limits::{
    AXIS_OFFSET_LIMIT_MM, AXIS_TILT_LIMIT_DEG, CONTACT_LIMIT_MM, DOMINANCE_LIMIT_RATIO,
    FIGURE_SLACK_RATIO, METACENTRIC_LIMIT_MM, RIGHTING_LIMIT_DEG, STANDING_LIMIT_DEG,
    WATERLINE_LIMIT_MM,
};
use super::{
    Afloat, Aim, Check, CheckKind, FigureName, Figures, Judgement, Limit, PromisedFigure,
    RotorOrder, SpinFacts, WaterOrder,
};
use crate::goal::GoalKind;

/// Checks that the assembly does what its goal demands of any body.
pub(super) fn goal_checks(aim: &Aim, found: &Judgement) -> Vec<Check> {
    let assembly = &found.assembly;
    let offset = |promise| {
        Check::new(
            CheckKind::AxisOffset,
            promise,
            assembly.axis_offset_mm,
            Limit::at_most(AXIS_OFFSET_LIMIT_MM, "mm"),
        )
    };
    match aim.kind {
        GoalKind::Top => [
            vec![offset("the centre of mass lies on the spin axis")],
            spinning_checks(assembly),
            contact_checks(aim, found.spin.as_ref()),
        ]
        .concat(),
        GoalKind::Yoyo => [
            vec![offset("the centre of mass lies in the spin point")],
            spinning_checks(assembly),
        ]
        .concat(),
        GoalKind::Stand => vec![standing_check(aim, assembly)],
        GoalKind::Float => aim
            .water
            .iter()
            .flat_map(|order| floating_checks(order, assembly))
            .collect(),
        GoalKind::Balance => aim
            .rotor
            .iter()
            .map(|order| grade_check(order, assembly))
            .collect(),
        GoalKind::Match => aim
            .wanted
            .iter()
            .flat_map(|wanted| Mismatch::of(wanted, assembly).checks(MatchLimits::WRITTEN))
            .collect(),
    }
}

/// Checks that a standing object stands, and as firmly as it promises.
fn standing_check(aim: &Aim, assembly: &Figures) -> Check {
    let limit = match aim.least_angle_deg {
        Some(least_deg) if least_deg > STANDING_LIMIT_DEG => Limit::at_least(least_deg, "°"),
        _ => Limit::above(STANDING_LIMIT_DEG, "°"),
    };
    Check::new(
        CheckKind::Standing,
        "it stands, and topples when tilted by",
        assembly.topples_deg,
        limit,
    )
}

/// Checks that a top spins on its contact: nothing is lower, and it leans as far as it promises.
///
/// Kits of older versions promise nothing of the contact.
fn contact_checks(aim: &Aim, found: Option<&SpinFacts>) -> Vec<Check> {
    let Some(least_deg) = aim.least_lean_deg else {
        return Vec::new();
    };
    let is_waived = least_deg == 0.0;
    let contact = Check::new(
        CheckKind::Contact,
        "its contact is its lowest point",
        found.map(|spin| spin.below_mm.max(spin.gap_mm)),
        Limit::at_most(CONTACT_LIMIT_MM, "mm"),
    );
    let promise = if found.is_some_and(|spin| spin.has_tip) {
        "it leans before more than its tip touches the floor by"
    } else {
        "it leans before more than its foot touches the floor by"
    };
    let lean = (!is_waived).then(|| {
        let limit = Limit::at_least(least_deg, "°");
        let lean_deg = found.map(|spin| spin.lean_deg);
        Check::new(CheckKind::Lean, promise, lean_deg, limit)
    });
    std::iter::once(contact).chain(lean).collect()
}

/// Checks that the assembly floats at its waterline, upright, and rights itself. The outer surface
/// is assumed to be tight.
fn floating_checks(order: &WaterOrder, assembly: &Figures) -> Vec<Check> {
    let found = |value: fn(&Afloat) -> f64| assembly.afloat.as_ref().map(value);
    let aside = found(|afloat| afloat.waterline_mm).map(|mm| (mm - order.waterline_mm).abs());
    let depth = format!("it floats {:.2} mm deep, within", order.waterline_mm);
    let check = |kind, promise: &str, value, limit| Check::new(kind, promise, value, limit);
    vec![
        check(
            CheckKind::Waterline,
            &depth,
            aside,
            Limit::at_most(WATERLINE_LIMIT_MM, "mm"),
        ),
        check(
            CheckKind::Upright,
            "its centre of mass is over its centre of buoyancy",
            found(|afloat| afloat.offset_mm),
            Limit::at_most(AXIS_OFFSET_LIMIT_MM, "mm"),
        ),
        check(
            CheckKind::Stability,
            "its metacentre is above its centre of mass by",
            found(|afloat| afloat.metacentric_height_mm),
            Limit::above(METACENTRIC_LIMIT_MM, "mm"),
        ),
        check(
            CheckKind::Righting,
            "it rights itself whichever way it is heeled, at least from",
            found(|afloat| afloat.rights_from_deg),
            Limit::at_least(RIGHTING_LIMIT_DEG, "°"),
        ),
    ]
}

/// Checks that a rotor reaches the ordered balance quality grade.
fn grade_check(order: &RotorOrder, assembly: &Figures) -> Check {
    let promise = format!(
        "at {} rpm its balance quality grade (ISO 21940-11) is G",
        order.speed_rpm
    );
    let grade = assembly.value_of(FigureName::BalanceGradeMmS);
    Check::new(
        CheckKind::BalanceQuality,
        &promise,
        grade,
        Limit::at_most(order.grade_mm_s, "mm/s"),
    )
}

/// Checks for tops and yo-yos alike: the axis is a principal axis, and the stable one.
fn spinning_checks(assembly: &Figures) -> Vec<Check> {
    let tilt = Limit::at_most(AXIS_TILT_LIMIT_DEG, "°");
    let dominance = Limit::below(DOMINANCE_LIMIT_RATIO, "");
    vec![
        Check::new(
            CheckKind::AxisTilt,
            "the spin axis is a principal axis",
            assembly.axis_tilt_deg,
            tilt,
        ),
        Check::new(
            CheckKind::Dominance,
            "the moment of inertia is largest about the spin axis (I_b/I_c)",
            assembly.dominance_ratio,
            dominance,
        ),
    ]
}

/// Checks that the written assembly reaches the promised figure.
pub(super) fn figure_check(promised: PromisedFigure, assembly: &Figures) -> Check {
    let PromisedFigure { figure, value } = promised;
    let slack = value.abs() * FIGURE_SLACK_RATIO;
    let limit = if figure.more_is_better() {
        Limit::at_least(value - slack, figure.unit())
    } else {
        Limit::at_most(value + slack, figure.unit())
    };
    Check::new(
        CheckKind::PromisedFigure { figure },
        figure.promise(),
        assembly.value_of(figure),
        limit,
    )
}
