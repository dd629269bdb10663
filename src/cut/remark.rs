//! Facts of a plan for the user, put into words only when they are shown.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::{
    base::units::format_count,
    cut::{
        ids::{CutId, PartId, VoidId},
        side::CutSide,
    },
};

/// Least value of a term of a score that is shown.
const LEAST_VISIBLE_PENALTY: f64 = 0.005;

/// A note on a plan of cuts and pins.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Remark {
    /// The number of cuts that open every void, and its proof.
    Fewest(Proof),
    /// An extra cut makes voids cleanable.
    CleaningCut {
        /// The cut.
        cut: CutId,
        /// The walls that it brings into sight.
        gains: Vec<SightGain>,
    },
    /// The score of a cut.
    Score {
        /// The cut.
        cut: CutId,
        /// The weighted terms, each 0 at best.
        terms: Vec<(Term, f64)>,
    },
    /// An extra cut makes parts fit the build volume.
    FittingCut(CutId),
    /// A cut is limited to sides of others.
    LimitedCut {
        /// The cut.
        cut: CutId,
        /// The sides.
        sides: Vec<CutSide>,
    },
    /// A joint lacks two pins that fit in one way only.
    LacksPins {
        /// The parts below and above the joint.
        parts: [PartId; 2],
        /// The reason.
        cause: PinLack,
    },
    /// A piece of a void has a narrow mouth, because two cuts leave a pocket behind one of them.
    NarrowPiece {
        /// The void.
        void: VoidId,
        /// Diameter of its narrowest mouth, mm.
        opening_mm: f64,
        /// Required diameter, mm.
        least_opening_mm: f64,
    },
    /// A part is smaller than the least, and no other plan was found.
    SmallPart {
        /// The part.
        part: PartId,
        /// Its share of the material.
        mass_ratio: f64,
    },
    /// A cut face has no room for the id of its part.
    NoRoomForLabel {
        /// The part.
        part: PartId,
        /// The cut.
        cut: CutId,
    },
}

impl Remark {
    /// Returns whether the remark says how the cuts were found, rather than what follows from them.
    pub fn is_proof(&self) -> bool {
        match self {
            Self::Fewest(_)
            | Self::CleaningCut { .. }
            | Self::Score { .. }
            | Self::FittingCut(_)
            | Self::LimitedCut { .. } => true,
            Self::LacksPins { .. }
            | Self::NarrowPiece { .. }
            | Self::SmallPart { .. }
            | Self::NoRoomForLabel { .. } => false,
        }
    }

    /// Returns the cuts that the remark names, to rename them.
    pub(crate) fn cuts_mut(&mut self) -> Vec<&mut CutId> {
        match self {
            Self::CleaningCut { cut, .. }
            | Self::Score { cut, .. }
            | Self::FittingCut(cut)
            | Self::NoRoomForLabel { cut, .. } => vec![cut],
            Self::LimitedCut { cut, sides } => {
                let sides = sides.iter_mut().map(|side| &mut side.cut);
                std::iter::once(cut).chain(sides).collect()
            }
            Self::Fewest(_)
            | Self::LacksPins { .. }
            | Self::NarrowPiece { .. }
            | Self::SmallPart { .. } => Vec::new(),
        }
    }
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fewest(proof) => proof.fmt(f),
            Self::CleaningCut { cut, gains } => {
                write!(
                    f,
                    "cut {cut}: so that voids can be cleaned ({})",
                    join(gains, "; ")
                )
            }
            Self::Score { cut, terms } => {
                let sum: f64 = terms.iter().map(|(_, value)| value).sum();
                let visible = terms
                    .iter()
                    .filter(|(_, value)| *value >= LEAST_VISIBLE_PENALTY);
                let visible: Vec<String> = visible
                    .map(|(term, value)| format!("{term} {value:.2}"))
                    .collect();
                write!(
                    f,
                    "cut {cut}: score {sum:.2}, 0 at best ({})",
                    visible.join(", ")
                )
            }
            Self::FittingCut(cut) => {
                write!(f, "cut {cut}: a part would not fit the build volume")
            }
            Self::LimitedCut { cut, sides } => {
                write!(
                    f,
                    "cut {cut}: only {}; beyond it nothing needs it",
                    join(sides, " and ")
                )
            }
            Self::LacksPins {
                parts: [below, above],
                cause,
            } => write!(f, "joint {below}–{above}: {cause}"),
            Self::NarrowPiece {
                void,
                opening_mm,
                least_opening_mm,
            } => write!(
                f,
                "void {void}: a piece of it opens by {opening_mm:.2} mm only, asked are {least_opening_mm:.2} mm"
            ),
            Self::SmallPart { part, mass_ratio } => write!(
                f,
                "part {part} is small, {:.1} % of the volume: no plan was found without it",
                100.0 * mass_ratio
            ),
            Self::NoRoomForLabel { part, cut } => write!(
                f,
                "no room for an id in the face of {part} in cut {cut}: write it on"
            ),
        }
    }
}

/// Joins words with a separator.
fn join<T: ToString>(things: &[T], separator: &str) -> String {
    let words: Vec<String> = things.iter().map(T::to_string).collect();
    words.join(separator)
}

/// A number of cuts, and the proof or search that fewer do not suffice.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Proof {
    /// Number of cuts.
    pub cuts: usize,
    /// Number of planes in the family that was searched.
    pub family: usize,
    /// Number of partial choices that were visited.
    pub nodes: u64,
    /// `true` if fewer cuts were proved impossible in that family.
    pub is_proved: bool,
}

impl fmt::Display for Proof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let cuts = format_count(self.cuts, "cut");
        let (family, nodes) = (self.family, self.nodes);
        if self.is_proved {
            write!(
                f,
                "{cuts}: fewer do not open every void (exact cover over {family} planes, {nodes} nodes)"
            )
        } else {
            write!(
                f,
                "{cuts}: fewer were not found, nor excluded, among {family} planes ({nodes} nodes)"
            )
        }
    }
}

/// The share of a void's wall that an extra cut brings into sight.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SightGain {
    /// The void.
    pub void: VoidId,
    /// Share in sight without the cut.
    pub before_ratio: f64,
    /// Share in sight with it.
    pub after_ratio: f64,
}

impl fmt::Display for SightGain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "void {}: {:.0} % of the wall in sight without it, {:.0} % with it",
            self.void,
            100.0 * self.before_ratio,
            100.0 * self.after_ratio
        )
    }
}

/// A term of a cut's score.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Term {
    /// Too little room for pins in the joint with least.
    RoomForPins,
    /// Too small a share of the smallest part.
    SmallestPart,
    /// The number of pieces beyond two.
    Parts,
    /// The distance from the contact point.
    Contact,
    /// The price of the seam: what is seen of it, or its length.
    Seam,
    /// The turning of the seam, beyond that of a convex one.
    Detail,
    /// The slant of the cut in the object's own frame.
    Slant,
    /// The area to be glued.
    Glue,
    /// The number of halves that do not fit the build volume.
    BuildVolume,
    /// The surface that hangs over the plate.
    Overhang,
}

impl fmt::Display for Term {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::RoomForPins => "room for pins",
            Self::SmallestPart => "smallest part",
            Self::Parts => "parts",
            Self::Contact => "contact",
            Self::Seam => "seam",
            Self::Detail => "detail",
            Self::Slant => "slant",
            Self::Glue => "glue",
            Self::BuildVolume => "build volume",
            Self::Overhang => "overhang",
        })
    }
}

/// The reason why a joint lacks two pins that fit in one way only.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PinLack {
    /// Its section is too narrow for any pin.
    TooNarrow {
        /// Diameter of the largest disc of material in it, mm.
        widest_mm: f64,
        /// Diameter that the thinnest pin needs, mm.
        needed_mm: f64,
    },
    /// The material behind the cut is too thin for any socket.
    TooThin,
    /// It has room for one pin only.
    OnePin,
    /// The pins fit in more than one way.
    Ambiguous,
    /// The pins are too close together, or leave too large a step at the rim.
    Loose,
}

impl fmt::Display for PinLack {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooNarrow {
                widest_mm,
                needed_mm,
            } => write!(
                f,
                "no room for pins: widest section {widest_mm:.1} mm, needs {needed_mm:.1} mm"
            ),
            Self::TooThin => f.write_str(
                "no room for pins: the material behind the cut is too thin for a socket",
            ),
            Self::OnePin => f.write_str("room for one pin only; do not turn it when gluing"),
            Self::Ambiguous => {
                f.write_str("the pins fit in more than one way; align the outlines when gluing")
            }
            Self::Loose => f.write_str("the pins leave too large a step at the rim"),
        }
    }
}

/// The reason why a void cannot be cleaned.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum UncleanCause {
    /// Too little of its wall is in sight.
    Hidden {
        /// Share in sight.
        sight_ratio: f64,
        /// Share that the planner requires.
        asked_ratio: f64,
    },
    /// It opens too narrowly.
    Narrow {
        /// Diameter of its opening, mm.
        opening_mm: f64,
        /// Required diameter, mm.
        least_opening_mm: f64,
    },
    /// No cut opens it.
    Closed,
}

impl fmt::Display for UncleanCause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Hidden {
                sight_ratio,
                asked_ratio,
            } => write!(
                f,
                "{:.1} % of its wall in sight, asked are {:.1} %, the planner's margin with it",
                100.0 * sight_ratio,
                100.0 * asked_ratio
            ),
            Self::Narrow {
                opening_mm,
                least_opening_mm,
            } => write!(
                f,
                "it opens by {opening_mm:.2} mm, asked are {least_opening_mm:.2} mm"
            ),
            Self::Closed => f.write_str("no cut opens it"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cut::{error::Obstacle, side::Side};

    #[test]
    fn a_score_shows_the_terms_that_matter_and_sums_all() {
        let remark = Remark::Score {
            cut: CutId::of(0),
            terms: vec![(Term::Seam, 0.123), (Term::Glue, 0.004), (Term::Parts, 0.2)],
        };
        let words = "cut C1: score 0.33, 0 at best (seam 0.12, parts 0.20)";
        assert_eq!(remark.to_string(), words);
    }

    #[test]
    fn remarks_on_how_cuts_were_found_are_told_from_consequences() {
        let side = CutSide {
            cut: CutId::of(0),
            side: Side::Below,
        };
        let limited = Remark::LimitedCut {
            cut: CutId::of(1),
            sides: vec![side],
        };
        assert!(limited.is_proof());
        assert_eq!(
            limited.to_string(),
            "cut C2: only below C1; beyond it nothing needs it"
        );
        let lacking = Remark::LacksPins {
            parts: [PartId::of(0), PartId::of(1)],
            cause: PinLack::OnePin,
        };
        assert!(!lacking.is_proof());
        assert_eq!(
            lacking.to_string(),
            "joint P01–P02: room for one pin only; do not turn it when gluing"
        );
    }

    #[test]
    fn voids_are_called_as_on_the_sheet() {
        let narrow = Remark::NarrowPiece {
            void: VoidId::of(0),
            opening_mm: 2.5,
            least_opening_mm: 4.0,
        };
        let words = "void V1: a piece of it opens by 2.50 mm only, asked are 4.00 mm";
        assert_eq!(narrow.to_string(), words);
        let closed = Obstacle::Unopenable {
            voids: vec![VoidId::of(0), VoidId::of(2)],
            widest_mm: 2.5,
            needed_mm: 4.0,
            is_free: true,
        };
        let words = "no plane opens void V1, V3 wide enough: the widest opening found is 2.50 mm";
        assert!(closed.to_string().starts_with(words), "{closed}");
    }
}
