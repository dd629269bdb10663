//! How far a field that does not meet its goal is off.

use super::family::Family;
use crate::goal::{Goal, GoalKind, Objective};

/// How far a field is off that does not meet its goal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FieldMiss {
    /// The family of which the nearest field was fitted; `None` if the field was given.
    pub fitted: Option<Family>,
    /// Distance of the centre of mass from its place, mm.
    pub off_axis_mm: f64,
    /// Angle between the axis and the nearest principal axis, rad.
    pub tilt_rad: f64,
    /// Stand: the tilt at which it topples, rad.
    pub toppling_rad: Option<f64>,
    /// Stand: the tilt that it must bear, rad.
    pub wanted_rad: f64,
}

impl FieldMiss {
    /// Returns a sentence that says how near the field comes.
    pub fn explain(&self, goal: &Goal) -> String {
        let subject = match self.fitted {
            Some(Family::Ramp) => "Not met: no ramp that was fitted does it. The nearest",
            Some(Family::Sine) => "Not met: no wave that was fitted does it. The nearest",
            None => "Not met: the field does not do it. It",
        };
        let aside = format!("the centre of mass {:.3} mm", self.off_axis_mm);
        let tilt = format!(
            "a principal axis leans {:.2}° from the axis",
            self.tilt_rad.to_degrees()
        );
        let off = match (goal.kind, self.toppling_rad) {
            (GoalKind::Stand, Some(reached_rad)) if goal.objective != Objective::LowestCenter => {
                format!(
                    "bears a tilt of {:.2}°, and {:.2}° are asked",
                    reached_rad.to_degrees(),
                    self.wanted_rad.to_degrees()
                )
            }
            (GoalKind::Stand, _) => format!("leaves {aside} beside the middle of the support"),
            (GoalKind::Yoyo, _) => format!("leaves {aside} from the spin point, and {tilt}"),
            _ => format!("leaves {aside} beside the axis, and {tilt}"),
        };
        let figure = match goal.kind {
            GoalKind::Top | GoalKind::Yoyo => {
                ". It must also keep its share of the best spin that is possible"
            }
            _ => "",
        };
        format!("{subject} {off}{figure}.")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hollow::worlds;

    #[test]
    fn how_far_a_field_is_off_is_said_in_the_terms_of_its_goal() {
        let miss = |fitted| FieldMiss {
            fitted,
            off_axis_mm: 0.523,
            tilt_rad: 0.02,
            toppling_rad: None,
            wanted_rad: 0.0,
        };
        let mut goal = worlds::egg(Objective::Dominance).goal;
        goal.kind = GoalKind::Balance;
        let said = miss(Some(Family::Sine)).explain(&goal);
        assert!(
            said.contains("no wave") && said.contains("0.523 mm"),
            "{said}"
        );
        assert!(said.contains("leans 1.15°"), "{said}");
        let stand = worlds::blocks_on_a_slope().goal;
        let given = FieldMiss {
            toppling_rad: Some(0.05),
            wanted_rad: 0.1,
            ..miss(None)
        };
        let said = given.explain(&stand);
        assert!(said.contains("2.86°") && said.contains("5.73°"), "{said}");
    }
}
