//! The answer: a pose, and the reasons for it.

use crate::geom::Vector;

/// A pose in which a model may stand by nature.
#[derive(Debug, Clone, PartialEq)]
pub struct UprightPose {
    /// Up, a unit vector in the model's frame.
    pub up: Vector,
    /// The sum of what speaks for it: 0 to about 4. A flat foot or an upright mirror plane counts
    /// about 1.
    pub score: f64,
    /// The score over that of the best other pose; negative for all but the best.
    pub lead: f64,
    /// The reasons, the weightiest first.
    pub reasons: Vec<UprightReason>,
}

/// A reason to think that a pose is the natural one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum UprightReason {
    /// It stands on a surface that is flat.
    FlatFoot,
    /// It stands on separate feet that are level.
    Feet {
        /// Their number.
        count: usize,
    },
    /// Its mirror planes stand upright.
    MirrorPlane,
    /// Its top is unlike its bottom.
    TopUnlikeBottom,
    /// It rights itself when it is tilted.
    StableRest,
    /// It holds liquid, as a cup does.
    HoldsLiquid,
    /// It stands nowhere by itself, and its narrow end is below.
    NarrowBelow,
    /// Other poses are as good, and this one is nearest to the file's z.
    FileUp,
}
