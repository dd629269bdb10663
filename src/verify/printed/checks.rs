//! The checks of toolpaths: the parts as they are laid, and the goal of the whole.

use super::cause::{Cause, CauseKind};
use super::judgement::PrintedJudgement;
use super::limits::{
    CENTER_FROM_MM, CENTER_RATIO, INERTIA_RATIO, PRINTED_CENTER_LIMIT_MM, PRINTED_MASS_LIMIT_RATIO,
    PRINTED_MATCH_RATIO, PRINTED_SKIN_MM, PRINTED_TILT_LIMIT_DEG,
};
use super::part::PrintedPart;
use crate::geom::Vector;
use crate::goal::GoalKind;
use crate::mass::Moments;
use crate::verify::handling::{MatchLimits, Mismatch};
use crate::verify::{
    Afloat, Aim, Check, CheckKind, DOMINANCE_LIMIT_RATIO, FIGURE_SLACK_RATIO, FigureName, Figures,
    Limit, METACENTRIC_LIMIT_MM, PromisedFigure, RIGHTING_LIMIT_DEG, STANDING_LIMIT_DEG,
    WATERLINE_LIMIT_MM,
};

/// Checks all that was found. `heavier` are the figures of the written parts if every part had the
/// most mass that is accepted.
pub(super) fn printed_checks(aim: &Aim, found: &PrintedJudgement, heavier: &Figures) -> Vec<Check> {
    let mut checks = cause_checks(found).to_vec();
    checks.extend(weight_checks(found));
    if let Some(toolpaths) = &found.toolpaths {
        let whole = Whole {
            aim,
            written: &found.written,
            heavier,
            toolpaths,
        };
        checks.extend(whole.goal_checks());
        checks.extend(found.promise.map(|promised| whole.figure_check(promised)));
    }
    checks
}

/// Checks that no cause of a wrong print was found.
fn cause_checks(found: &PrintedJudgement) -> [Check; 3] {
    let check = |kind, promise: &str, kinds: &[CauseKind]| {
        let causes = found.causes.iter().filter(|cause| cause.is_wrong);
        let those: Vec<&Cause> = causes.filter(|cause| kinds.contains(&cause.kind)).collect();
        let say = |cause: &&Cause| format!("{}: {}", cause.kind.name(), cause.finding);
        let names: Vec<String> = those.iter().map(say).collect();
        let count = Some(those.len() as f64);
        Check::new(kind, promise, count, Limit::at_most(0.0, ""))
            .at((!names.is_empty()).then(|| names.join("; ")))
    };
    [
        check(
            CheckKind::PrintedParts,
            "every part is printed",
            &[CauseKind::Missing],
        ),
        check(
            CheckKind::PrintedShapes,
            "every part is printed in its size and not mirrored",
            &[CauseKind::Scale, CauseKind::Mirror],
        ),
        check(
            CheckKind::PrintedSettings,
            "the slicer's settings are those of the kit",
            &[
                CauseKind::Infill,
                CauseKind::LayerHeight,
                CauseKind::LineWidth,
                CauseKind::Density,
                CauseKind::Flow,
            ],
        ),
    ]
}

/// Checks what all parts weigh together, and their centre if none is missing.
fn weight_checks(found: &PrintedJudgement) -> Vec<Check> {
    let parts = &found.parts;
    let stated = match found.missing.is_empty() {
        true => found.stated_g,
        false => Moments::default(),
    };
    let written_g: f64 = parts.iter().map(|part| part.written_mass_g).sum();
    let written_g = written_g + stated.volume();
    let printed_g: f64 = parts.iter().map(|part| part.mass_g).sum();
    // A density has a cause of its own.
    let laid = |part: &PrintedPart| part.volume_ratio * part.nominal_mass_g;
    let laid_g: f64 = parts.iter().map(laid).sum();
    let written = |part: &PrintedPart| Vector::from(part.written_center_mm) * part.written_mass_g;
    let printed = |part: &PrintedPart| Vector::from(part.center_mm) * part.mass_g;
    let written = (parts.iter().map(written).sum::<Vector>() + stated.first()) / written_g;
    let printed = parts.iter().map(printed).sum::<Vector>() / printed_g;
    let surface = |part: &PrintedPart| part.surface_per_mm * part.written_mass_g;
    let surface_per_mm = parts.iter().map(surface).sum::<f64>() / written_g;
    let most_ratio = PRINTED_MASS_LIMIT_RATIO.max(PRINTED_SKIN_MM * surface_per_mm);
    let mass = Check::new(
        CheckKind::PrintedMass,
        "the toolpaths lay as much as the parts have, within",
        Some((laid_g / written_g - 1.0).abs() * 100.0),
        Limit::at_most(most_ratio * 100.0, "%"),
    );
    let edges_mm = parts.iter().flat_map(|part| part.edges_mm);
    let longest_mm = edges_mm.fold(0.0, f64::max);
    let center = found.missing.is_empty().then(|| {
        Check::new(
            CheckKind::PrintedCenters,
            "their centre of mass is that of the parts, within",
            Some((printed - written).norm()),
            Limit::at_most(
                PRINTED_CENTER_LIMIT_MM + CENTER_RATIO * (longest_mm - CENTER_FROM_MM).max(0.0),
                "mm",
            ),
        )
    });
    std::iter::once(mass).chain(center).collect()
}

/// The whole object, as written and as its toolpaths lay it.
struct Whole<'a> {
    aim: &'a Aim,
    written: &'a Figures,
    heavier: &'a Figures,
    toolpaths: &'a Figures,
}

impl Whole<'_> {
    /// Checks that the toolpaths do what the goal demands, within the accuracy of slicers.
    fn goal_checks(&self) -> Vec<Check> {
        match self.aim.kind {
            GoalKind::Top | GoalKind::Yoyo => self.spinning_checks(),
            GoalKind::Stand => vec![self.standing_check()],
            GoalKind::Float => self.floating_checks(),
            GoalKind::Balance => self.grade_check().into_iter().collect(),
            GoalKind::Match => self.match_checks(),
        }
    }

    fn spinning_checks(&self) -> Vec<Check> {
        let found = self.toolpaths;
        vec![
            Check::new(
                CheckKind::AxisOffset,
                "the centre of mass of the toolpaths lies on the axis",
                found.axis_offset_mm,
                Limit::at_most(PRINTED_CENTER_LIMIT_MM, "mm"),
            ),
            Check::new(
                CheckKind::AxisTilt,
                "the spin axis is a principal axis of the toolpaths",
                found.axis_tilt_deg,
                Limit::at_most(PRINTED_TILT_LIMIT_DEG, "°"),
            ),
            Check::new(
                CheckKind::Dominance,
                "the moment of inertia is largest about the spin axis (I_b/I_c)",
                found.dominance_ratio,
                Limit::below(DOMINANCE_LIMIT_RATIO, ""),
            ),
        ]
    }

    fn standing_check(&self) -> Check {
        let limit = match self.aim.least_angle_deg {
            Some(least_deg) if least_deg > STANDING_LIMIT_DEG => Limit::at_least(least_deg, "°"),
            _ => Limit::above(STANDING_LIMIT_DEG, "°"),
        };
        Check::new(
            CheckKind::Standing,
            "it stands, and topples when tilted by",
            self.toolpaths.topples_deg,
            limit,
        )
    }

    fn floating_checks(&self) -> Vec<Check> {
        let value = |figures: &Figures, of: fn(&Afloat) -> f64| figures.afloat.as_ref().map(of);
        let waterline_mm = |figures: &Figures| value(figures, |afloat| afloat.waterline_mm);
        let written_mm = waterline_mm(self.written);
        let aside = |mm: Option<f64>| Some((mm? - written_mm?).abs());
        let limit_mm = aside(waterline_mm(self.heavier)).map_or(WATERLINE_LIMIT_MM, |band_mm| {
            band_mm.max(WATERLINE_LIMIT_MM)
        });
        let found = |of: fn(&Afloat) -> f64| value(self.toolpaths, of);
        vec![
            Check::new(
                CheckKind::Waterline,
                "it floats as deep as the written parts, within",
                aside(waterline_mm(self.toolpaths)),
                Limit::at_most(limit_mm, "mm"),
            ),
            Check::new(
                CheckKind::Upright,
                "its centre of mass is over its centre of buoyancy",
                found(|afloat| afloat.offset_mm),
                Limit::at_most(PRINTED_CENTER_LIMIT_MM, "mm"),
            ),
            Check::new(
                CheckKind::Stability,
                "its metacentre is above its centre of mass by",
                found(|afloat| afloat.metacentric_height_mm),
                Limit::above(METACENTRIC_LIMIT_MM, "mm"),
            ),
            Check::new(
                CheckKind::Righting,
                "it rights itself whichever way it is heeled, at least from",
                found(|afloat| afloat.rights_from_deg),
                Limit::at_least(RIGHTING_LIMIT_DEG, "°"),
            ),
        ]
    }

    /// Checks the grade of a rotor strictly: no slicer reaches a fine grade, and the print must be
    /// balanced afterwards.
    fn grade_check(&self) -> Option<Check> {
        let order = self.aim.rotor?;
        let promise = format!(
            "at {} rpm its balance quality grade (ISO 21940-11) is G",
            order.speed_rpm
        );
        Some(Check::new(
            CheckKind::BalanceQuality,
            &promise,
            self.toolpaths.value_of(FigureName::BalanceGradeMmS),
            Limit::at_most(order.grade_mm_s, "mm/s"),
        ))
    }

    /// Checks that the toolpaths handle like the wanted body, within the accuracy of slicers.
    fn match_checks(&self) -> Vec<Check> {
        let limits = MatchLimits {
            mass_ratio: PRINTED_MASS_LIMIT_RATIO,
            center_mm: PRINTED_CENTER_LIMIT_MM,
            inertia_ratio: PRINTED_MATCH_RATIO,
        };
        let wanted = self.aim.wanted.iter();
        wanted
            .flat_map(|wanted| Mismatch::of(wanted, self.toolpaths).checks(limits))
            .collect()
    }

    /// Checks the promised figure, with the slack that the accuracy of slicers gives it.
    fn figure_check(&self, promised: PromisedFigure) -> Check {
        let PromisedFigure { figure, value } = promised;
        let slack = self
            .slack(figure, value)
            .max(value.abs() * FIGURE_SLACK_RATIO);
        let limit = if figure.more_is_better() {
            Limit::at_least(value - slack, figure.unit())
        } else {
            Limit::at_most(value + slack, figure.unit())
        };
        Check::new(
            CheckKind::PromisedFigure { figure },
            figure.promise(),
            self.toolpaths.value_of(figure),
            limit,
        )
    }

    /// Returns by how much the accuracy of centres, masses and inertias moves a figure.
    fn slack(&self, figure: FigureName, value: f64) -> f64 {
        let height_mm = self.written.center_height_mm.abs();
        match figure {
            FigureName::TopplesDeg => (PRINTED_CENTER_LIMIT_MM / height_mm).atan().to_degrees(),
            FigureName::CenterHeightMm | FigureName::MetacentricHeightMm => PRINTED_CENTER_LIMIT_MM,
            FigureName::MassG => PRINTED_MASS_LIMIT_RATIO * value,
            FigureName::DominanceRatio => INERTIA_RATIO * value,
            FigureName::SpinItRatio => 2.0 * INERTIA_RATIO * value,
            FigureName::CriticalSpeedRpm => {
                // ω² = g M ℓ / (I_c − I_b): half of the sum of the relative errors.
                let [_, b, c] = self.written.principal_moments_g_mm2;
                let inertia_ratio = INERTIA_RATIO * (c + b) / (c - b);
                0.5 * (PRINTED_CENTER_LIMIT_MM / height_mm + inertia_ratio) * value
            }
            // Written parts are truer than any print: what counts is the grade that was asked.
            FigureName::BalanceGradeMmS => {
                let asked = self.aim.rotor.map(|order| order.grade_mm_s - value);
                asked.map_or(0.0, |coarser| coarser.max(0.0))
            }
            FigureName::InfillChangeRatio => 0.0,
        }
    }
}
