//! The kinds of goal, and the objectives that say what "best" means for each.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use crate::base::words::{ChoiceError, as_text, choice, parse_numbers};

choice! {
    /// The kind of goal.
    GoalKind, "goal" {
        /// Spin on a contact point.
        Top = "top",
        /// Spin freely about an axis through a point inside.
        Yoyo = "yoyo",
        /// Stand on its lowest points.
        Stand = "stand",
        /// Float upright.
        Float = "float",
        /// Turn about a given axis without shaking it.
        Balance = "balance",
        /// Have the mass, centre and inertia of another body.
        Match = "match",
    }
}

/// The quantity to optimise.
///
/// Each is read and printed as its word. `spin-it` has the weights of [`Objective::SPIN_IT`]; other
/// weights follow it, as in `spin-it:0.5,1`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Objective {
    /// Top: the least speed at which it spins upright, ω² = g s_z/(I_zz − λ_max(I′)) (Spin-It eq.
    /// 1).
    CriticalSpeed,
    /// Spin-It's functional. Yo-yo: γ_I ((I_xx² + 2 I_xy² + I_yy²)/I_zz²) (eq. 2, 5, 6). Top: the
    /// same with I′, plus γ_c (s_z / s_z of the solid)² (eq. 3, 7). The ratio frees s_z of units.
    SpinIt {
        /// The weight of a low, light body; yo-yos ignore it.
        gamma_c: f64,
        /// The weight of a flat inertia tensor.
        gamma_i: f64,
    },
    /// Yo-yo: the largest moment across the axis over the moment about it, I_b/I_c; below 1 it
    /// spins stably.
    Dominance,
    /// Stand: the largest tilt before it topples.
    TopplingAngle,
    /// Stand: the lowest centre of mass above the middle of the support.
    LowestCenter,
    /// Float: the greatest metacentric height GM, which is the lowest centre of mass (Wu et al.
    /// §3.3).
    MetacentricHeight,
    /// Balance: the least material removed for static and couple unbalance to vanish.
    LeastRemoved,
    /// Balance: the least unbalance in the two end planes per mass, if it cannot vanish.
    LeastUnbalance,
    /// Match: the least change of infill from a wished one.
    LeastChange,
}

impl Objective {
    /// Spin-It's functional with its own weights: γ_c = γ_I = 1 for a top (its eq. 7), γ_I alone
    /// for a yo-yo.
    pub const SPIN_IT: Self = Self::SpinIt {
        gamma_c: 1.0,
        gamma_i: 1.0,
    };

    /// The words of all objectives.
    pub const WORDS: &'static [&'static str] = &[
        "critical-speed",
        "spin-it",
        "dominance",
        "toppling-angle",
        "lowest-center",
        "metacentric-height",
        "least-removed",
        "least-unbalance",
        "least-change",
    ];

    /// Returns its word, without weights.
    pub fn word(self) -> &'static str {
        match self {
            Self::CriticalSpeed => "critical-speed",
            Self::SpinIt { .. } => "spin-it",
            Self::Dominance => "dominance",
            Self::TopplingAngle => "toppling-angle",
            Self::LowestCenter => "lowest-center",
            Self::MetacentricHeight => "metacentric-height",
            Self::LeastRemoved => "least-removed",
            Self::LeastUnbalance => "least-unbalance",
            Self::LeastChange => "least-change",
        }
    }

    /// Returns the objective of a request that names none.
    pub fn default_for(kind: GoalKind) -> Self {
        kind.objectives()[0]
    }

    /// Returns true if this objective is one for goals of this kind.
    pub fn suits(&self, kind: GoalKind) -> bool {
        kind.objectives()
            .iter()
            .any(|known| known.word() == self.word())
    }

    /// Returns true if its weights, if any, are finite and not negative, and γ_I is positive.
    pub(super) fn is_sound(&self) -> bool {
        match *self {
            Self::SpinIt { gamma_c, gamma_i } => {
                gamma_c >= 0.0 && gamma_i > 0.0 && (gamma_c + gamma_i).is_finite()
            }
            _ => true,
        }
    }
}

impl GoalKind {
    /// Returns true if the request gives a point that the axis passes through.
    pub fn has_spin_point(self) -> bool {
        matches!(self, Self::Yoyo | Self::Balance)
    }

    /// Returns true if a model alone can be asked for it. A match needs the body it is like.
    pub fn is_asked_of_a_model(self) -> bool {
        self != Self::Match
    }

    /// Returns the objectives for goals of this kind, the default first.
    pub fn objectives(self) -> &'static [Objective] {
        match self {
            Self::Top => &[Objective::CriticalSpeed, Objective::SPIN_IT],
            Self::Yoyo => &[Objective::SPIN_IT, Objective::Dominance],
            Self::Stand => &[Objective::TopplingAngle, Objective::LowestCenter],
            Self::Float => &[Objective::MetacentricHeight],
            Self::Balance => &[Objective::LeastRemoved, Objective::LeastUnbalance],
            Self::Match => &[Objective::LeastChange],
        }
    }
}

impl FromStr for Objective {
    type Err = ChoiceError;

    fn from_str(text: &str) -> Result<Self, ChoiceError> {
        let weights = text.strip_prefix("spin-it:").and_then(parse_numbers);
        Ok(match (text, weights) {
            ("critical-speed", _) => Self::CriticalSpeed,
            ("spin-it", _) => Self::SPIN_IT,
            (_, Some([gamma_c, gamma_i])) => Self::SpinIt { gamma_c, gamma_i },
            ("dominance", _) => Self::Dominance,
            ("toppling-angle", _) => Self::TopplingAngle,
            ("lowest-center", _) => Self::LowestCenter,
            ("metacentric-height", _) => Self::MetacentricHeight,
            ("least-removed", _) => Self::LeastRemoved,
            ("least-unbalance", _) => Self::LeastUnbalance,
            ("least-change", _) => Self::LeastChange,
            _ => return Err(ChoiceError::unknown("known objective", text, Self::WORDS)),
        })
    }
}

impl fmt::Display for Objective {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::SpinIt { gamma_c, gamma_i } if *self != Self::SPIN_IT => {
                write!(f, "spin-it:{gamma_c},{gamma_i}")
            }
            _ => f.write_str(self.word()),
        }
    }
}

as_text!(Objective);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_goal_lists_its_default_first_and_shares_only_spin_it() {
        let defaults = [
            Objective::CriticalSpeed,
            Objective::SPIN_IT,
            Objective::TopplingAngle,
            Objective::MetacentricHeight,
            Objective::LeastRemoved,
            Objective::LeastChange,
        ];
        let found: Vec<Objective> = GoalKind::ALL
            .iter()
            .copied()
            .map(Objective::default_for)
            .collect();
        assert_eq!(found, defaults);
        for word in Objective::WORDS {
            let objective: Objective = word.parse().unwrap();
            assert_eq!(
                (objective.word(), objective.to_string().as_str()),
                (*word, *word)
            );
            let uses = GoalKind::ALL
                .iter()
                .filter(|kind| objective.suits(**kind))
                .count();
            assert_eq!(uses, if *word == "spin-it" { 2 } else { 1 }, "{word}");
        }
    }

    #[test]
    fn an_unknown_objective_is_answered_with_the_nearest() {
        for (text, says) in [
            ("spinit", "did you mean `spin-it`"),
            ("spin-it:1", "spin-it"),
            ("fast", "use "),
        ] {
            let error = text.parse::<Objective>().unwrap_err().to_string();
            assert!(error.contains(says), "{error}");
        }
    }
}
