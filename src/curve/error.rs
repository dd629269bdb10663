//! Errors of curves that are given as points or by name.

/// A reason why points are no curve for a telescope. Points are counted from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CurveError {
    /// Two points make a line without a plane, one makes nothing.
    #[error(
        "a curve of {points} points bends nowhere; remedy: give three points or more, such as the \
         ends and the middle of a line"
    )]
    TooFewPoints {
        /// Number of points.
        points: usize,
    },
    /// More points than can be meant.
    #[error(
        "a curve of {points} points is too long; remedy: give at most {most}, each n-th of them"
    )]
    TooManyPoints {
        /// Number of points.
        points: usize,
        /// The most that are read.
        most: usize,
    },
    /// A coordinate is infinite or not a number.
    #[error("point {point} of the curve is not finite; remedy: correct or remove it")]
    NotFinite {
        /// The point.
        point: usize,
    },
    /// A point is where the one before it is.
    #[error(
        "points {before} and {point} of the curve are the same; remedy: remove one of them",
        before = point - 1
    )]
    Repeated {
        /// The later of the two.
        point: usize,
    },
    /// The curve turns too much in one place.
    #[error(
        "the curve has a corner of {turn_deg:.0}° at {at_mm:.1} mm, near ({x:.1}, {y:.1}, {z:.1}); \
         remedy: round it with more points, or begin a second curve at a juncture there"
    )]
    Corner {
        /// Arc length from the start, mm.
        at_mm: f64,
        /// The turn, degrees.
        turn_deg: f64,
        /// The place, mm.
        x: f64,
        /// The place, mm.
        y: f64,
        /// The place, mm.
        z: f64,
    },
}

/// A reason why a text names no curve.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NameError {
    /// No known name before the colon.
    #[error("`{text}` names no curve; remedy: write arc:R,DEG or helix:R,PITCH,TURNS")]
    Unknown {
        /// The text.
        text: String,
    },
    /// Another number of measures than the curve has.
    #[error("`{text}` has {found} measures; remedy: write {form}")]
    Count {
        /// The text.
        text: String,
        /// Number of measures.
        found: usize,
        /// How it is written.
        form: &'static str,
    },
    /// A measure that cannot be read.
    #[error("{measure} in `{text}` cannot be read; remedy: write {form}, such as {example}")]
    Measure {
        /// The text.
        text: String,
        /// Which measure.
        measure: &'static str,
        /// How it is written.
        form: &'static str,
        /// An example.
        example: &'static str,
    },
    /// A measure out of its range.
    #[error("{measure} in `{text}` must be {range}")]
    Range {
        /// The text.
        text: String,
        /// Which measure.
        measure: &'static str,
        /// The range, in words.
        range: &'static str,
    },
}
