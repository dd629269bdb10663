//! The tendencies of plans that are put side by side.

use std::fmt;

/// The tendency by which a plan of cuts was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Tendency {
    /// Seams as the job orders them, each void open as far as it is worth its joint.
    Usual,
    /// Seams that are seen less, with walls out of sight. Only a kit says if they hold support.
    UnseenWalls,
    /// No cut for cleaning alone: few parts, and more stays solid.
    FewerParts,
    /// Level cuts only.
    Level,
    /// Short seams and wide openings, wherever they are seen.
    Short,
}

impl Tendency {
    /// The tendencies that are tried, in their order. What has walls out of sight comes with the
    /// usual plan.
    pub const TRIED: [Self; 4] = [Self::Usual, Self::FewerParts, Self::Level, Self::Short];
}

impl fmt::Display for Tendency {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Self::Usual => "the usual plan",
            Self::UnseenWalls => "hidden seams, if walls out of sight print without support",
            Self::FewerParts => "fewer parts",
            Self::Level => "level cuts only",
            Self::Short => "short seams, wherever they are seen",
        })
    }
}
