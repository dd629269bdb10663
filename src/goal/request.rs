//! What is asked for, in words: the kind of goal, what "best" means for it, and the request that
//! holds both.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use super::{Contact, Hardware, HardwareError, Rotor, SpinPoint, Up, Water};
use crate::base::words::{ChoiceError, as_text, choice, numbers};

choice! {
    /// What the object shall do.
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
    }
}

/// What "best" means.
///
/// Each reads from and prints as its word; `spin-it` has the weights of [`Objective::SPIN_IT`],
/// others are written behind it: `spin-it:0.5,1`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Objective {
    /// Top: the least speed at which it spins upright, ω² = g s_z/(I_zz − λ_max(I′)) (Spin-It eq.
    /// 1).
    CriticalSpeed,
    /// Spin-It's functional. Yo-yo: γ_I ((I_xx² + 2 I_xy² + I_yy²)/I_zz²) (eq. 2, 5, 6). Top: the
    /// same with I′, plus γ_c (s_z / s_z of the solid)² (eq. 3, 7, with s_z made free of units).
    SpinIt {
        /// The weight of a low, light body; a yo-yo has no use for it.
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
    /// Balance: the least unbalance in the two end planes per mass, where it cannot vanish.
    LeastUnbalance,
}

impl Objective {
    /// Spin-It's functional with its own weights: γ_c = γ_I = 1 for a top (its eq. 7), γ_I alone
    /// for a yo-yo.
    pub const SPIN_IT: Self = Self::SpinIt {
        gamma_c: 1.0,
        gamma_i: 1.0,
    };

    /// Every objective's word.
    pub const WORDS: &'static [&'static str] = &[
        "critical-speed",
        "spin-it",
        "dominance",
        "toppling-angle",
        "lowest-center",
        "metacentric-height",
        "least-removed",
        "least-unbalance",
    ];

    /// The word for it, without weights.
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
        }
    }

    /// What is optimised where nothing else is asked for.
    pub fn default_of(kind: GoalKind) -> Self {
        kind.objectives()[0]
    }

    /// Whether this objective is one for goals of this kind.
    pub fn suits(&self, kind: GoalKind) -> bool {
        kind.objectives()
            .iter()
            .any(|known| known.word() == self.word())
    }

    /// Whether its weights, if it has any, are finite, not negative, and γ_I positive.
    fn is_sound(&self) -> bool {
        match *self {
            Self::SpinIt { gamma_c, gamma_i } => {
                gamma_c >= 0.0 && gamma_i > 0.0 && (gamma_c + gamma_i).is_finite()
            }
            _ => true,
        }
    }
}

impl GoalKind {
    /// Whether the axis is told by a point it passes through.
    pub fn has_spin_point(self) -> bool {
        matches!(self, Self::Yoyo | Self::Balance)
    }

    /// The objectives that make sense for the goal, the default first.
    pub fn objectives(self) -> &'static [Objective] {
        match self {
            Self::Top => &[Objective::CriticalSpeed, Objective::SPIN_IT],
            Self::Yoyo => &[Objective::SPIN_IT, Objective::Dominance],
            Self::Stand => &[Objective::TopplingAngle, Objective::LowestCenter],
            Self::Float => &[Objective::MetacentricHeight],
            Self::Balance => &[Objective::LeastRemoved, Objective::LeastUnbalance],
        }
    }
}

impl FromStr for Objective {
    type Err = ChoiceError;

    fn from_str(text: &str) -> Result<Self, ChoiceError> {
        let weights = text.strip_prefix("spin-it:").and_then(numbers);
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

/// What is asked for, before it is known whether the model allows it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Request {
    /// What the object shall do.
    pub kind: GoalKind,
    /// The direction that becomes z: the spin axis or up.
    pub up: Up,
    /// Where a top touches the floor; none for the lowest point, and for other goals.
    pub contact: Option<Contact>,
    /// Where the axis of a yo-yo or of a balanced rotor passes; none for the centre of mass, and
    /// for other goals.
    pub spin_point: Option<SpinPoint>,
    /// What "best" means.
    pub objective: Objective,
    /// How a balanced rotor runs; none for the usual speed and grade, and for other goals.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotor: Option<Rotor>,
    /// How it floats; none for fresh water and the most stable line, and for other goals.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub water: Option<Water>,
    /// What is put into it that is not printed; none for nothing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hardware: Option<Hardware>,
}

/// A request whose parts do not go together.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RequestError {
    /// An objective of another goal.
    #[error("the objective {objective} does not go with the goal {kind}; remedy: use {known}")]
    Objective {
        /// The objective asked for.
        objective: Objective,
        /// The goal.
        kind: GoalKind,
        /// The goal's objectives.
        known: String,
    },
    /// Weights that give nothing to minimise.
    #[error(
        "the weights of {0} are no weights; remedy: give a finite one of a low centre, not below 0, and one of a flat tensor, above 0"
    )]
    Weights(Objective),
    /// A contact point for what is not a top.
    #[error("a contact point goes with the goal top, not with {0}; remedy: leave it out")]
    Contact(GoalKind),
    /// A spin point for what has no axis through one.
    #[error("a spin point goes with the goal yoyo or balance, not with {0}; remedy: leave it out")]
    SpinPoint(GoalKind),
    /// A speed, grade or bore for what is not a rotor.
    #[error(
        "a speed, grade or bore goes with the goal balance, not with {0}; remedy: leave it out"
    )]
    NoRotor(GoalKind),
    /// A liquid or waterline for what does not float.
    #[error("a liquid or waterline goes with the goal float, not with {0}; remedy: leave it out")]
    NoWater(GoalKind),
    /// Hardware that does not go together or with the goal.
    #[error(transparent)]
    Hardware(#[from] HardwareError),
    /// A speed or grade that is not positive and finite.
    #[error(
        "a grade of {grade_mm_s} mm/s at {speed_rpm} rpm is none; remedy: give a speed and a grade above zero"
    )]
    Rotor {
        /// The speed asked for.
        speed_rpm: f64,
        /// The grade asked for.
        grade_mm_s: f64,
    },
}

impl Request {
    /// The request with every choice left at its default: up z, a top on its lowest point, a yo-yo
    /// or a rotor about its centre of mass, the kind's first objective.
    pub fn new(kind: GoalKind) -> Self {
        Self {
            kind,
            up: Up::Z,
            contact: (kind == GoalKind::Top).then_some(Contact::Lowest),
            spin_point: kind.has_spin_point().then_some(SpinPoint::Center),
            objective: Objective::default_of(kind),
            rotor: (kind == GoalKind::Balance).then(Rotor::default),
            water: (kind == GoalKind::Float).then(Water::default),
            hardware: None,
        }
    }

    /// The same, if its parts go together.
    pub fn checked(self) -> Result<Self, RequestError> {
        let Self {
            kind, objective, ..
        } = self;
        if !objective.suits(kind) {
            let known = kind
                .objectives()
                .iter()
                .map(|known| known.word())
                .collect::<Vec<_>>()
                .join(" or ");
            return Err(RequestError::Objective {
                objective,
                kind,
                known,
            });
        }
        if !objective.is_sound() {
            return Err(RequestError::Weights(objective));
        }
        if self.contact.is_some() && kind != GoalKind::Top {
            return Err(RequestError::Contact(kind));
        }
        if self.spin_point.is_some() && !kind.has_spin_point() {
            return Err(RequestError::SpinPoint(kind));
        }
        self.check_rotor()?;
        if self.water.is_some() && kind != GoalKind::Float {
            return Err(RequestError::NoWater(kind));
        }
        self.hardware
            .map_or(Ok(()), |hardware| hardware.check(kind))?;
        Ok(self)
    }

    fn check_rotor(&self) -> Result<(), RequestError> {
        match self.rotor {
            Some(_) if self.kind != GoalKind::Balance => Err(RequestError::NoRotor(self.kind)),
            Some(rotor) if !rotor.is_sound() => {
                let Rotor {
                    speed_rpm,
                    grade_mm_s,
                    ..
                } = rotor;
                Err(RequestError::Rotor {
                    speed_rpm,
                    grade_mm_s,
                })
            }
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn every_goal_has_its_default_objective_first_and_none_is_shared_but_spin_it() {
        let defaults = [
            Objective::CriticalSpeed,
            Objective::SPIN_IT,
            Objective::TopplingAngle,
            Objective::MetacentricHeight,
            Objective::LeastRemoved,
        ];
        let found: Vec<Objective> = GoalKind::ALL
            .iter()
            .copied()
            .map(Objective::default_of)
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
    fn an_unknown_objective_is_told_the_nearest() {
        for (text, says) in [
            ("spinit", "did you mean `spin-it`"),
            ("spin-it:1", "spin-it"),
            ("fast", "use "),
        ] {
            let error = text.parse::<Objective>().unwrap_err().to_string();
            assert!(error.contains(says), "{error}");
        }
    }

    #[test]
    fn weights_that_weigh_nothing_are_refused() {
        for text in [
            "spin-it:0,0",
            "spin-it:-1,1",
            "spin-it:1,inf",
            "spin-it:nan,1",
        ] {
            let objective = text.parse().unwrap();
            let refused = Request {
                objective,
                ..Request::new(GoalKind::Top)
            }
            .checked();
            assert!(matches!(refused, Err(RequestError::Weights(_))), "{text}");
        }
        let only_flat = Objective::SpinIt {
            gamma_c: 0.0,
            gamma_i: 1.0,
        };
        assert!(
            Request {
                objective: only_flat,
                ..Request::new(GoalKind::Top)
            }
            .checked()
            .is_ok()
        );
    }

    #[test]
    fn the_parts_of_every_default_go_together() {
        for &kind in GoalKind::ALL {
            assert_eq!(Request::new(kind).checked(), Ok(Request::new(kind)));
        }
    }

    proptest! {
        #[test]
        fn a_request_reads_back_from_its_own_words(x in -1e3..1e3_f64, gamma_c in 0.0..9.0_f64, gamma_i in 1e-9..9.0_f64) {
            let wish = Request {
                up: Up::NegY,
                contact: Some(Contact::At([x, 2.0, gamma_c])),
                objective: Objective::SpinIt { gamma_c, gamma_i },
                ..Request::new(GoalKind::Top)
            };
            let text = serde_json::to_string(&wish).unwrap();
            prop_assert!(text.contains("\"up\":\"-y\"") && text.contains("\"spin_point\":null"), "{}", text);
            prop_assert_eq!(serde_json::from_str::<Request>(&text).unwrap(), wish);
        }
    }
}
