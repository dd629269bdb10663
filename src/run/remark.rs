//! Facts of a run that are reported to a person, worded only when they are shown.

use std::fmt;

use super::Rung;
use super::natural::NaturalUp;
use crate::advice::{NearbyAxis, Reached};
use crate::base::setting::{Key, Setting};
use crate::base::units::format_count;
use crate::cut::{PartId, UncleanCause};
use crate::goal::{Request, ShaftAxis, Up};
use crate::hollow::Figure;
use crate::job::Effort;

/// A note for the job sheet.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Remark {
    /// A joint got no bosses around pins.
    NoBosses {
        /// The parts below and above the joint.
        parts: [PartId; 2],
        /// The reason.
        why: Refusal,
    },
    /// A rung beyond the usual plan gave joints their pins.
    Pins {
        /// The rung.
        rung: Rung,
        /// Number of joints that lack pins in the usual plan.
        lacking: usize,
        /// Number of joints in the usual plan.
        joints: usize,
        /// Share of itself by which the goal's figure is worse.
        loss_ratio: f64,
    },
    /// A higher rung broke a promise of the kit, so that this lower one was made.
    SteppedDown(Rung),
    /// A rung could not be tried to its end, by a fault of a program part.
    RungFailed {
        /// The rung.
        rung: Rung,
        /// The fault, in the words of its error.
        why: String,
    },
    /// A plan with fewer parts is possible, too.
    FewerParts {
        /// Numbers of parts: fewer, and in this kit.
        parts: [usize; 2],
        /// The figure of the certificate.
        figure: Figure,
        /// Its values in both, as planned with their pins.
        values: [f64; 2],
        /// The reason why it was not taken, besides the figure; `None` if that alone decided.
        fault: Option<FewerFault>,
    },
    /// Another plan hides its seams better, and was taken or not.
    Seams {
        /// Share of itself by which the goal's figure is worse in that plan; `None` if it cannot be
        /// made.
        loss_ratio: Option<f64>,
        /// True if it was taken.
        is_taken: bool,
    },
    /// Hidden seams were given up, as a joint would have been aligned by nothing.
    SeamsAligned,
    /// The solid regions of the ordered plan leave too little for the goal.
    OrderTooSolid,
    /// The search ended before everything was tried.
    Untried {
        /// What was not tried.
        untried: Vec<Untried>,
        /// The effort that tries more.
        next: Effort,
    },
}

/// A fault of a plan with fewer parts, besides its figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FewerFault {
    /// Its seams are seen more.
    Seen,
    /// More of its voids cannot be cleaned and stay solid.
    Unclean,
    /// So many of its joints get neither pins nor a jig.
    Loose(usize),
}

impl fmt::Display for FewerFault {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Seen => f.write_str("its seams are seen more"),
            Self::Unclean => f.write_str("not all of its voids can be cleaned"),
            Self::Loose(joints) => {
                let joints = format_count(*joints, "joint");
                write!(f, "neither pins nor a jig align {joints} of it")
            }
        }
    }
}

/// What a search did not try, as its work was spent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Untried {
    /// Cuts whose seams are seen less.
    HiddenSeams,
    /// Cuts whose seams are seen, where nothing else aligns a joint.
    SeenSeams,
    /// A plan with fewer parts.
    FewerParts,
    /// Other cuts and bosses that give joints their pins.
    MorePins,
}

impl fmt::Display for Untried {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Self::HiddenSeams => "seams that are seen less",
            Self::SeenSeams => "joints that are easier to align",
            Self::FewerParts => "fewer parts",
            Self::MorePins => "pins in more joints",
        })
    }
}

impl Remark {
    /// Returns whether it tells that hidden seams were taken.
    pub fn hides_seams(&self) -> bool {
        matches!(self, Self::Seams { is_taken: true, .. })
    }

    /// Returns whether it tells of another plan that a person may prefer.
    pub fn is_offer(&self) -> bool {
        match self {
            Self::FewerParts { .. } | Self::Untried { .. } => true,
            Self::Seams {
                loss_ratio,
                is_taken,
            } => !is_taken && loss_ratio.is_some(),
            _ => false,
        }
    }
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::NoBosses { parts, why } => {
                let [below, above] = parts;
                write!(
                    f,
                    "joint {below}–{above}: bosses around pins would {why}: it has none"
                )
            }
            Self::Pins {
                rung,
                lacking,
                joints,
                loss_ratio,
            } => write!(
                f,
                "pins: {rung}, because {lacking} of {} would lack them; the goal's figure is {:.1} % {} for it",
                format_count(*joints, "joint"),
                100.0 * loss_ratio.abs(),
                if *loss_ratio > 0.0 { "worse" } else { "better" },
            ),
            Self::SteppedDown(Rung::Walls) => {
                f.write_str("bosses around pins would break a promise of the kit: no joint has them")
            }
            Self::SteppedDown(_) => f.write_str(
                "pins in every joint would break a promise of the kit: some joints have none",
            ),
            Self::RungFailed { rung, why } => write!(f, "pins: {rung} could not be tried: {why}"),
            Self::FewerParts {
                parts: [fewer, parts],
                figure,
                values,
                fault,
            } => {
                let figure = *figure;
                let [then, now] = values.map(|value| Reached { figure, value });
                let fewer = format_count(*fewer, "part");
                write!(f, "with {fewer} in place of {parts} it {then}")?;
                fault.map_or(Ok(()), |fault| write!(f, ", but {fault}"))?;
                write!(f, "; this kit, as planned, {now}")
            }
            Self::Seams {
                loss_ratio,
                is_taken,
            } => f.write_str(&seam_words(*loss_ratio, *is_taken)),
            Self::SeamsAligned => f.write_str(
                "seams: one runs where it is seen; where it is hidden, neither pins nor a jig hold the joint",
            ),
            Self::OrderTooSolid => f.write_str(
                "what the plan keeps solid, or its whole faces would, leaves too little for the goal: it is not kept solid, and those faces may be cut",
            ),
            Self::Untried { untried, next } => {
                let untried: Vec<String> = untried.iter().map(Untried::to_string).collect();
                let next = Setting::new(Key::Effort, next);
                write!(f, "a longer search (`{next}`) also looks for {}", untried.join(", "))
            }
        }
    }
}

/// Returns the words on seams that another plan hides better.
fn seam_words(loss_ratio: Option<f64>, is_taken: bool) -> String {
    let Some(loss_ratio) = loss_ratio else {
        return "seams: one runs where it is seen, and no other plan was found".to_owned();
    };
    let percent = format!("{:.1} %", 100.0 * loss_ratio.max(0.0));
    let is_free = percent == "0.0 %";
    match (is_taken, is_free) {
        (true, true) => {
            "seams: they run where they are seen less, which costs nothing of the goal's figure"
                .to_owned()
        }
        (true, false) => format!(
            "seams: they run where they are seen less; the goal's figure is {percent} worse for it"
        ),
        (false, true) => {
            "seams: one runs where it is seen; the plans tried that hide it have other faults"
                .to_owned()
        }
        // A plan is given up as soon as it has lost too much.
        (false, false) => format!(
            "seams: one runs where it is seen; in the plans tried that hide it, the goal's figure \
             is at least {percent} worse"
        ),
    }
}

/// The reason against bosses around pins; reads after "bosses around pins would".
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Refusal {
    /// No hollowing meets the goal beside them.
    MakeGoalImpossible,
    /// They take too much of the voids.
    FillVoids {
        /// Share of the voids' volume.
        ratio: f64,
    },
    /// They take too much of the goal's figure.
    CostTooMuch {
        /// Share of the figure.
        loss_ratio: f64,
    },
    /// They close a void.
    CloseVoid,
    /// They move the joint away from the pins that they were made for.
    MoveJoint,
    /// They leave a void that cannot be cleaned.
    LeaveUncleanVoid,
}

impl Refusal {
    /// Returns the loss of the goal's figure, if nothing else stands against the bosses.
    pub fn loss_ratio(self) -> Option<f64> {
        match self {
            Self::CostTooMuch { loss_ratio } => Some(loss_ratio),
            _ => None,
        }
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::MakeGoalImpossible => f.write_str("make the goal impossible"),
            Self::FillVoids { ratio } => {
                write!(f, "make {:.0} % of the voids solid", 100.0 * ratio)
            }
            Self::CostTooMuch { loss_ratio } => {
                write!(
                    f,
                    "cost {:.0} % of what the kit reaches",
                    100.0 * loss_ratio
                )
            }
            Self::CloseVoid => f.write_str("close a void"),
            Self::MoveJoint => f.write_str("move the joint away from its pins"),
            Self::LeaveUncleanVoid => f.write_str("leave a void that cannot be cleaned"),
        }
    }
}

/// The reason to keep a part of a void solid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum KeptCause {
    /// It lies beyond a joint without room for pins.
    BeyondJoint,
    /// It lies in a part that would be smaller than the least.
    SmallPart,
    /// The ordered plan keeps it solid.
    Ordered,
    /// No cut opens the void.
    Unopenable,
    /// The void has no place for its drain holes.
    Undrainable,
    /// It cannot be cleaned.
    Uncleanable(UncleanCause),
    /// It encloses resin while its part is printed in a vat.
    Cup {
        /// Volume of that resin, mm³.
        volume_mm3: f64,
    },
}

impl fmt::Display for KeptCause {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::BeyondJoint => f.write_str("the end beyond a joint without room for pins"),
            Self::SmallPart => f.write_str("the end in a part that would be too small"),
            Self::Ordered => f.write_str("the plan keeps it solid"),
            Self::Unopenable => f.write_str("no cut opens it wide enough"),
            Self::Undrainable => f.write_str("no thin, flat wall has room for its drain holes"),
            Self::Uncleanable(cause) => cause.fmt(f),
            Self::Cup { volume_mm3 } => write!(
                f,
                "an end that would catch {volume_mm3:.0} mm³ of resin while it is printed, a suction cup"
            ),
        }
    }
}

/// The choice of the axis for a job that leaves it open.
#[derive(Debug, Clone, PartialEq)]
pub enum AxisChoice {
    /// The best of those tried.
    Best {
        /// The request with this axis, and the contact or face that goes with it.
        request: Box<Request>,
        /// Number of axes tried.
        tried: usize,
        /// Number of axes on which the goal is possible.
        possible: usize,
        /// The figure reached on it.
        reached: Reached,
    },
    /// The natural up of the model.
    Natural(NaturalUp),
    /// The axis nearest to the natural up on which the goal is possible.
    NearNatural {
        /// The natural up.
        natural: NaturalUp,
        /// The axis.
        nearby: Box<NearbyAxis>,
    },
    /// A bore or a shaft of the model, which the job leaves open or names.
    OnShaft(ShaftAxis),
    /// None of those tried allows the goal.
    NonePossible {
        /// The axis that the answer is for.
        up: Up,
    },
}

impl fmt::Display for AxisChoice {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Best {
                request,
                tried,
                possible,
                reached,
            } => write!(
                f,
                "`{}` was chosen: {possible} of {tried} axes tried allow the goal; on this one, the best near any of them, it {reached}",
                Setting::new(Key::Up, request.up)
            ),
            Self::Natural(natural) => natural.fmt(f),
            Self::NearNatural { natural, nearby } => write!(
                f,
                "`{}` was taken, {:.0}° off the natural up (`{}`), which does not allow the goal: \
                 it is the nearest of the axes tried that come within twice the best; before cuts \
                 and pins it {} there",
                Setting::new(Key::Up, nearby.request.up),
                nearby.off_deg,
                natural.setting(),
                nearby.reached
            ),
            Self::OnShaft(shaft) => {
                let [up, point] = shaft.settings();
                let surfaces = shaft.describe_surfaces();
                write!(f, "it turns on the axis `{up}` `{point}`: {surfaces}")
            }
            Self::NonePossible { up } => {
                write!(
                    f,
                    "none of the axes tried allows the goal; this answer is for axis {up}"
                )
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::goal::GoalKind;

    #[test]
    fn an_offer_of_fewer_parts_compares_both_plans() {
        let remark = Remark::FewerParts {
            parts: [4, 5],
            figure: Figure::TopplingAngleRad,
            values: [9.6_f64, 11.0].map(f64::to_radians),
            fault: Some(FewerFault::Loose(1)),
        };
        let words = remark.to_string();
        assert!(
            words.starts_with("with 4 parts in place of 5 it stands until tilted by 9.6°, but "),
            "{words}"
        );
        assert!(
            words.contains("neither pins nor a jig align 1 joint of it; this kit"),
            "{words}"
        );
        assert!(
            words.ends_with("this kit, as planned, stands until tilted by 11.0°"),
            "{words}"
        );
    }

    #[test]
    fn a_search_that_ended_early_says_what_a_longer_one_looks_for() {
        let remark = Remark::Untried {
            untried: vec![Untried::FewerParts, Untried::MorePins],
            next: Effort::Thorough,
        };
        assert!(remark.is_offer());
        assert_eq!(
            remark.to_string(),
            "a longer search (`effort = \"thorough\"`) also looks for fewer parts, pins in more joints"
        );
    }

    #[test]
    fn a_remark_says_which_joint_and_why() {
        let remark = Remark::NoBosses {
            parts: [PartId::of(0), PartId::of(1)],
            why: Refusal::FillVoids { ratio: 0.612 },
        };
        let words =
            "joint P01–P02: bosses around pins would make 61 % of the voids solid: it has none";
        assert_eq!(remark.to_string(), words);
    }

    #[test]
    fn the_figure_of_an_axis_off_the_natural_up_is_said_to_be_that_before_cuts() {
        let natural = NaturalUp {
            up: Up::Y,
            reasons: Vec::new(),
            next: None,
            is_clear: true,
        };
        let nearby = Box::new(NearbyAxis {
            request: Request {
                up: Up::Z,
                ..Request::new(GoalKind::Top)
            },
            reached: Reached {
                figure: Figure::CriticalSpeedRpm,
                value: 196.0,
            },
            off_deg: 76.2,
        });
        let words = AxisChoice::NearNatural { natural, nearby }.to_string();
        let figure = "before cuts and pins it spins upright from 196 rpm there";
        assert!(words.ends_with(figure), "{words}");
        assert!(words.contains("76° off the natural up"), "{words}");
    }

    #[test]
    fn a_price_is_told_as_a_gain_when_it_is_one() {
        let remark = |loss_ratio| Remark::Pins {
            rung: Rung::FewerCuts,
            lacking: 2,
            joints: 5,
            loss_ratio,
        };
        assert!(remark(0.058).to_string().contains("2 of 5 joints"));
        assert!(remark(0.058).to_string().ends_with("5.8 % worse for it"));
        assert!(remark(-0.01).to_string().ends_with("1.0 % better for it"));
    }

    #[test]
    fn hidden_seams_tell_their_price_or_that_there_is_none() {
        let words = |loss_ratio| seam_words(Some(loss_ratio), true);
        assert!(words(0.061).ends_with("6.1 % worse for it"));
        for gain in [0.0, 0.0004, -0.046] {
            assert!(words(gain).ends_with("costs nothing of the goal's figure"));
        }
    }

    #[test]
    fn only_a_price_can_be_paid() {
        let dear = Refusal::CostTooMuch { loss_ratio: 0.4 };
        assert_eq!(dear.loss_ratio(), Some(0.4));
        assert_eq!(Refusal::CloseVoid.loss_ratio(), None);
    }
}
