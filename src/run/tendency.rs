//! The tendencies of plans that are put side by side.

use std::fmt;

/// The tendency by which a plan of cuts was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Tendency {
    /// Seams as the job orders them, each void open as far as it is worth its joint.
    Usual,
    /// No cut for cleaning alone: few parts, and more stays solid.
    FewerParts,
    /// Level cuts only.
    Level,
    /// Short seams and wide openings, wherever they are seen.
    Short,
}

impl Tendency {
    /// All tendencies, in the order in which they are tried.
    pub const ALL: [Self; 4] = [Self::Usual, Self::FewerParts, Self::Level, Self::Short];
}

impl fmt::Display for Tendency {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Self::Usual => "the usual plan",
            Self::FewerParts => "fewer parts",
            Self::Level => "level cuts only",
            Self::Short => "short seams, wherever they are seen",
        })
    }
}
