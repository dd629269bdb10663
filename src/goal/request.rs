//! The request for a goal, as a user writes it.

use serde::{Deserialize, Serialize};

use super::hardware::{Hardware, HardwareError, Rod};
use super::kind::{GoalKind, Objective};
use super::rotor::Rotor;
use super::sites::{Contact, SpinPoint, Up};
use super::target::Target;
use super::tip_choice::TipChoice;
use super::water::Water;
use crate::mass::ImpossibleBody;

/// The default of the least lean of a top, degrees. Thrown by hand, tops wobble by some degrees
/// before they sleep upright.
pub const LEAST_LEAN_DEG: f64 = 10.0;
/// The default of the least toppling angle of a standing object, degrees. Less does not survive a
/// nudge, or a table that is not level.
pub const LEAST_ANGLE_DEG: f64 = 5.0;
/// The greatest lean and toppling angle that may be promised, degrees.
const MOST_PROMISED_DEG: f64 = 60.0;

/// A goal as it was asked for, before it is known whether the model allows it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Request {
    /// The kind of goal.
    pub kind: GoalKind,
    /// The direction that becomes z: the spin axis or up.
    pub up: Up,
    /// The contact of a top; `None` for [`Contact::Auto`], and for other goals.
    pub contact: Option<Contact>,
    /// The point that the axis of a yo-yo or a rotor passes through; `None` for the centre of mass,
    /// and for other goals.
    pub spin_point: Option<SpinPoint>,
    /// The quantity to optimise.
    pub objective: Objective,
    /// The rotor's speed, grade and bore; `None` for the defaults, and for other goals.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotor: Option<Rotor>,
    /// The liquid and waterline; `None` for fresh water and the most stable line, and for other
    /// goals.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub water: Option<Water>,
    /// The mass properties of a match; `None` while they are to be taken from a file, and for other
    /// goals.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub target: Option<Target>,
    /// The parts put in that are not printed; `None` for none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hardware: Option<Hardware>,
    /// The tip of a top. A tip in `hardware` has precedence.
    #[serde(default, skip_serializing_if = "TipChoice::is_auto")]
    pub tip: TipChoice,
    /// Top: the least lean at which more than its tip or foot may touch the floor, degrees; zero
    /// for any.
    #[serde(default = "least_lean_deg", skip_serializing_if = "is_least_lean")]
    pub least_lean_deg: f64,
    /// Stand: the least tilt at which it may topple, degrees; zero for any.
    #[serde(default = "least_angle_deg", skip_serializing_if = "is_least_angle")]
    pub least_angle_deg: f64,
}

fn least_lean_deg() -> f64 {
    LEAST_LEAN_DEG
}

fn is_least_lean(angle_deg: &f64) -> bool {
    *angle_deg == LEAST_LEAN_DEG
}

fn least_angle_deg() -> f64 {
    LEAST_ANGLE_DEG
}

fn is_least_angle(angle_deg: &f64) -> bool {
    *angle_deg == LEAST_ANGLE_DEG
}

/// A contradiction within a request.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RequestError {
    /// The objective belongs to another goal.
    #[error("the objective {objective} does not go with the goal {kind}; remedy: use {known}")]
    Objective {
        /// The objective asked for.
        objective: Objective,
        /// The goal.
        kind: GoalKind,
        /// The goal's objectives.
        known: String,
    },
    /// The weights give nothing to minimise.
    #[error(
        "the weights of {0} cannot be used; remedy: give two finite numbers, the first (low \
         centre) not below 0, the second (flat tensor) above 0"
    )]
    Weights(Objective),
    /// A contact point was given for a goal other than a top.
    #[error("a contact point goes with the goal top, not with {0}; remedy: leave it out")]
    Contact(GoalKind),
    /// A spin point was given for a goal without one.
    #[error("a spin point goes with the goal yoyo or balance, not with {0}; remedy: leave it out")]
    SpinPoint(GoalKind),
    /// A speed, grade or bore was given for a goal other than a rotor.
    #[error(
        "a speed, grade or bore goes with the goal balance, not with {0}; remedy: leave it out"
    )]
    NoRotor(GoalKind),
    /// A liquid or waterline was given for a goal other than floating.
    #[error("a liquid or waterline goes with the goal float, not with {0}; remedy: leave it out")]
    NoWater(GoalKind),
    /// Mass properties were given for a goal other than a match.
    #[error(
        "a mass, centre and inertia to match go with the goal match, not with {0}; remedy: leave \
         them out"
    )]
    NoMatch(GoalKind),
    /// A direction was given for a match.
    #[error(
        "a match has the axes of its model, and up = {0} would turn nothing; remedy: leave it out"
    )]
    UpOfMatch(Up),
    /// No distribution of mass has the wanted properties.
    #[error(transparent)]
    ImpossibleBody(#[from] ImpossibleBody),
    /// A least lean or toppling angle that no object of the goal can promise.
    #[error(
        "a least {what} of {angle_deg}° cannot be promised with the goal {kind}; remedy: give 0 to \
         {MOST_PROMISED_DEG}°, and only with the goal {only}"
    )]
    Promise {
        /// The angle: lean or toppling angle.
        what: &'static str,
        /// The angle asked for, degrees.
        angle_deg: f64,
        /// The goal.
        kind: GoalKind,
        /// The goal that has such an angle.
        only: &'static str,
    },
    /// The hardware contradicts itself or the goal.
    #[error(transparent)]
    Hardware(#[from] HardwareError),
    /// The speed or grade is not positive and finite.
    #[error(
        "a grade of {grade_mm_s} mm/s at {speed_rpm} rpm cannot be met; remedy: give a speed and \
         a grade above zero"
    )]
    Rotor {
        /// The speed asked for.
        speed_rpm: f64,
        /// The grade asked for.
        grade_mm_s: f64,
    },
}

impl Request {
    /// Returns the request with all defaults: up is z, the objective is the kind's first. A top
    /// spins on its lowest point or on a tip; a yo-yo or rotor turns about its centre of mass.
    pub fn new(kind: GoalKind) -> Self {
        Self {
            kind,
            up: Up::Z,
            contact: (kind == GoalKind::Top).then_some(Contact::Auto),
            spin_point: kind.has_spin_point().then_some(SpinPoint::Center),
            objective: Objective::default_for(kind),
            rotor: (kind == GoalKind::Balance).then(Rotor::default),
            water: (kind == GoalKind::Float).then(Water::default),
            target: None,
            hardware: None,
            tip: TipChoice::Auto,
            least_lean_deg: LEAST_LEAN_DEG,
            least_angle_deg: LEAST_ANGLE_DEG,
        }
    }

    /// Returns the request without its promises of lean and toppling angle, and without a tip that
    /// only they would call for. Placing it is quick: a trial asks no more.
    pub fn unpromised(self) -> Self {
        let tip = match self.ordered_tip() {
            TipChoice::Auto if self.kind == GoalKind::Top => TipChoice::None,
            ordered => ordered,
        };
        Self {
            tip,
            least_lean_deg: 0.0,
            least_angle_deg: 0.0,
            ..self
        }
    }

    /// Returns the tip that was ordered, in the hardware or beside it.
    pub fn ordered_tip(&self) -> TipChoice {
        let rod = self.hardware.and_then(|hardware| hardware.tip);
        rod.map_or(self.tip, TipChoice::Rod)
    }

    /// Returns the hardware with this tip in it.
    pub fn hardware_with(&self, tip: Option<Rod>) -> Hardware {
        Hardware {
            tip,
            ..self.hardware.unwrap_or_default()
        }
    }

    /// Returns the lean that is promised, degrees; zero if it is waived, `None` for other goals.
    pub fn promised_lean_deg(&self) -> Option<f64> {
        let is_waived = self.ordered_tip() == TipChoice::None;
        let lean_deg = if is_waived { 0.0 } else { self.least_lean_deg };
        (self.kind == GoalKind::Top).then_some(lean_deg)
    }

    /// Returns the toppling angle that is promised, degrees; `None` for other goals.
    pub fn promised_angle_deg(&self) -> Option<f64> {
        (self.kind == GoalKind::Stand).then_some(self.least_angle_deg)
    }

    /// Returns the request itself if its parts are consistent.
    pub fn validate(self) -> Result<Self, RequestError> {
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
        self.check_target()?;
        self.hardware_with(self.ordered_tip().rod()).check(kind)?;
        self.check_promises()?;
        Ok(self)
    }

    fn check_promises(&self) -> Result<(), RequestError> {
        let Self { kind, tip, .. } = *self;
        if tip == TipChoice::None && kind != GoalKind::Top {
            return Err(HardwareError::NotATop(kind).into());
        }
        let promises = [
            ("lean", self.least_lean_deg, LEAST_LEAN_DEG, GoalKind::Top),
            (
                "toppling angle",
                self.least_angle_deg,
                LEAST_ANGLE_DEG,
                GoalKind::Stand,
            ),
        ];
        for (what, angle_deg, default_deg, only) in promises {
            let is_sound = (0.0..=MOST_PROMISED_DEG).contains(&angle_deg);
            let is_its_own = kind == only || [0.0, default_deg].contains(&angle_deg);
            if !(is_sound && is_its_own) {
                let only = only.word();
                return Err(RequestError::Promise {
                    what,
                    angle_deg,
                    kind,
                    only,
                });
            }
        }
        Ok(())
    }

    fn check_target(&self) -> Result<(), RequestError> {
        let is_match = self.kind == GoalKind::Match;
        if is_match && self.up != Up::Z {
            return Err(RequestError::UpOfMatch(self.up));
        }
        match self.target {
            Some(_) if !is_match => Err(RequestError::NoMatch(self.kind)),
            Some(target) => Ok(target.check()?),
            None => Ok(()),
        }
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
    fn unusable_weights_are_refused() {
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
            .validate();
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
            .validate()
            .is_ok()
        );
    }

    #[test]
    fn every_default_request_is_consistent_with_its_promises_and_without() {
        for &kind in GoalKind::ALL {
            for request in [Request::new(kind), Request::new(kind).unpromised()] {
                assert_eq!(request.validate(), Ok(request));
            }
        }
    }

    proptest! {
        #[test]
        fn a_request_reads_back_from_its_own_words(
            x in -1e3..1e3_f64,
            gamma_c in 0.0..9.0_f64,
            gamma_i in 1e-9..9.0_f64,
        ) {
            let request = Request {
                up: Up::NegY,
                contact: Some(Contact::At([x, 2.0, gamma_c])),
                objective: Objective::SpinIt { gamma_c, gamma_i },
                ..Request::new(GoalKind::Top)
            };
            let text = serde_json::to_string(&request).unwrap();
            prop_assert!(text.contains("\"up\":\"-y\"") && text.contains("\"spin_point\":null"), "{}", text);
            prop_assert_eq!(serde_json::from_str::<Request>(&text).unwrap(), request);
        }
    }
}
