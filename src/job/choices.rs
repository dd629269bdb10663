//! The choices a job is made of: each reads from and prints as the word used on the command line.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use crate::{geom::Vector, toml_text::nearest};

/// A text that is none of the words, or not the numbers, that were asked for.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ChoiceError {
    /// An unknown word.
    #[error("`{text}` is not a {what}; remedy: {remedy}")]
    Unknown {
        /// What was asked for.
        what: &'static str,
        /// What was given.
        text: String,
        /// The nearest word, or all of them.
        remedy: String,
    },
    /// Three numbers that are not finite.
    #[error("`{0}` has a coordinate that is not finite; remedy: give three plain numbers X,Y,Z")]
    NotFinite(String),
    /// A direction of no length.
    #[error("`{0}` has no direction; remedy: give at least one coordinate that is not zero")]
    ZeroVector(String),
}

impl ChoiceError {
    fn unknown(what: &'static str, text: &str, known: &[&str]) -> Self {
        let remedy = match nearest(text, known.iter().copied()) {
            Some(word) => format!("did you mean `{word}`?"),
            None => format!("use {}", known.join(", ")),
        };
        Self::Unknown { what, text: text.to_owned(), remedy }
    }
}

/// An enum of which each value is one word.
macro_rules! choice {
    ($(#[$about:meta])* $name:ident, $what:literal { $($(#[$doc:meta])* $value:ident = $word:literal,)+ }) => {
        $(#[$about])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
        pub enum $name {
            $($(#[$doc])* #[serde(rename = $word)] $value,)+
        }

        impl $name {
            /// Every value's word, in the order of the values.
            pub const WORDS: &'static [&'static str] = &[$($word),+];

            /// The word it reads from and prints as.
            pub fn word(self) -> &'static str {
                match self { $(Self::$value => $word,)+ }
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(self.word())
            }
        }

        impl FromStr for $name {
            type Err = ChoiceError;

            fn from_str(text: &str) -> Result<Self, ChoiceError> {
                match text {
                    $($word => Ok(Self::$value),)+
                    _ => Err(ChoiceError::unknown($what, text, Self::WORDS)),
                }
            }
        }
    };
}

choice! {
    /// What the object is to do.
    GoalKind, "goal" {
        /// Spin on its contact point.
        Top = "top",
        /// Spin freely about a point inside.
        Yoyo = "yoyo",
        /// Stand on its support.
        Stand = "stand",
    }
}

choice! {
    /// What is made as good as it can be.
    Objective, "objective" {
        /// A top's least stable spin rate (Spin-It eq. 1).
        CriticalSpeed = "critical-speed",
        /// Spin-It's functional of a top (eq. 7) or a yo-yo (eq. 2).
        SpinIt = "spin-it",
        /// A yo-yo's largest lateral moment over its axial one: below 1 the axis is the dominant one.
        Dominance = "dominance",
        /// The tilt at which a standing object topples.
        TopplingAngle = "toppling-angle",
        /// The height of the centre of mass above the middle of the support.
        LowestCenter = "lowest-center",
    }
}

impl GoalKind {
    /// The objectives that make sense for the goal, the default first.
    pub fn objectives(self) -> &'static [Objective] {
        match self {
            Self::Top => &[Objective::CriticalSpeed, Objective::SpinIt],
            Self::Yoyo => &[Objective::SpinIt, Objective::Dominance],
            Self::Stand => &[Objective::TopplingAngle, Objective::LowestCenter],
        }
    }

    /// The objective where none is asked for.
    pub fn default_objective(self) -> Objective {
        self.objectives()[0]
    }
}

choice! {
    /// The unit the numbers of a model file are in.
    ModelUnit, "unit" {
        /// Millimetres.
        Mm = "mm",
        /// Centimetres.
        Cm = "cm",
        /// Metres.
        M = "m",
        /// Inches.
        In = "in",
    }
}

impl ModelUnit {
    /// The unit in mm.
    pub fn mm(self) -> f64 {
        match self {
            Self::Mm => 1.0,
            Self::Cm => 10.0,
            Self::M => 1000.0,
            Self::In => crate::units::MM_PER_INCH,
        }
    }
}

choice! {
    /// How the void is found.
    Solver, "solver" {
        /// The design region cut by the one best quadric.
        Quadric = "quadric",
    }
}

choice! {
    /// Whether the object is cut so that its voids can be cleaned.
    CutMode, "cut mode" {
        /// Wherever a void would stay closed.
        Auto = "auto",
        /// Not at all.
        Never = "never",
    }
}

choice! {
    /// The file format of the written parts.
    PartFormat, "format" {
        /// Binary STL.
        Stl = "stl",
    }
}

/// The direction of the spin axis, or of up, in the model's axes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Up {
    /// Along +x.
    X,
    /// Along +y.
    Y,
    /// Along +z.
    Z,
    /// Along −x.
    NegX,
    /// Along −y.
    NegY,
    /// Along −z.
    NegZ,
    /// Along any vector, of any length but zero.
    Along([f64; 3]),
    /// The solid's own axis of the largest moment of inertia, the easiest to spin about.
    Principal,
}

/// The words for the axes, in the order of [`Up`]'s values.
const AXES: [(&str, Up); 7] = [
    ("x", Up::X),
    ("y", Up::Y),
    ("z", Up::Z),
    ("-x", Up::NegX),
    ("-y", Up::NegY),
    ("-z", Up::NegZ),
    ("principal", Up::Principal),
];

impl Up {
    /// The unit vector; none for the principal axis, which depends on the solid. A vector of no direction gives +z.
    pub fn direction(self) -> Option<Vector> {
        let [x, y, z] = [Vector::x(), Vector::y(), Vector::z()];
        Some(match self {
            Self::X => x,
            Self::Y => y,
            Self::Z => z,
            Self::NegX => -x,
            Self::NegY => -y,
            Self::NegZ => -z,
            Self::Along(along) => unit(along).unwrap_or(z),
            Self::Principal => return None,
        })
    }
}

/// The unit vector along `along`, whatever its length; none if it has no direction.
fn unit(along: [f64; 3]) -> Option<Vector> {
    let along = Vector::from(along);
    let largest = along.amax();
    (largest.is_finite() && largest > 0.0).then(|| (along / largest).normalize())
}

impl FromStr for Up {
    type Err = ChoiceError;

    fn from_str(text: &str) -> Result<Self, ChoiceError> {
        let lower = text.trim().to_lowercase();
        let word = lower.strip_prefix('+').unwrap_or(&lower);
        if let Some(&(_, up)) = AXES.iter().find(|(axis, _)| *axis == word) {
            return Ok(up);
        }
        let along = triple(&lower).ok_or_else(|| {
            ChoiceError::unknown("direction", text, &["x", "y", "z", "-x", "-y", "-z", "X,Y,Z", "principal"])
        })?;
        checked_direction(along, text)
    }
}

fn checked_direction(along: [f64; 3], text: &str) -> Result<Up, ChoiceError> {
    if along.iter().any(|number| !number.is_finite()) {
        return Err(ChoiceError::NotFinite(text.to_owned()));
    }
    unit(along).map(|_| Up::Along(along)).ok_or_else(|| ChoiceError::ZeroVector(text.to_owned()))
}

/// Three numbers with commas between them, finite or not.
fn triple(text: &str) -> Option<[f64; 3]> {
    let numbers: Vec<f64> =
        text.split(',').map(|number| number.trim().parse().ok()).collect::<Option<_>>()?;
    numbers.try_into().ok()
}

impl fmt::Display for Up {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self, AXES.iter().find(|(_, up)| up == self)) {
            (Self::Along([x, y, z]), _) => write!(f, "{x},{y},{z}"),
            (_, Some((word, _))) => f.write_str(word),
            (_, None) => Ok(()),
        }
    }
}

/// A place named by a word, or given as a point of the model in mm.
macro_rules! place {
    ($(#[$about:meta])* $name:ident, $what:literal { $($(#[$doc:meta])* $value:ident = $word:literal,)+ }) => {
        $(#[$about])*
        #[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
        #[serde(try_from = "String", into = "String")]
        pub enum $name {
            $($(#[$doc])* $value,)+
            /// At a point of the model, in its own axes, mm after scaling.
            At([f64; 3]),
        }

        impl FromStr for $name {
            type Err = ChoiceError;

            fn from_str(text: &str) -> Result<Self, ChoiceError> {
                match (text.trim(), triple(text)) {
                    $(($word, _) => Ok(Self::$value),)+
                    (_, Some(at)) if at.iter().all(|number| number.is_finite()) => Ok(Self::At(at)),
                    (_, Some(_)) => Err(ChoiceError::NotFinite(text.to_owned())),
                    _ => Err(ChoiceError::unknown($what, text, &[$($word,)+ "X,Y,Z"])),
                }
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                match self {
                    $(Self::$value => f.write_str($word),)+
                    Self::At([x, y, z]) => write!(f, "{x},{y},{z}"),
                }
            }
        }
    };
}

place! {
    /// Where a top touches the ground.
    Contact, "contact point" {
        /// At its lowest point.
        Lowest = "lowest",
        /// Below the solid's centre of mass, at the lowest height.
        Center = "center",
    }
}

place! {
    /// The point a yo-yo spins about.
    SpinPoint, "spin point" {
        /// At the solid's centre of mass.
        Center = "center",
    }
}

/// Text in serde's files, through `FromStr` and `Display`.
macro_rules! as_text {
    ($($name:ident)+) => { $(
        impl TryFrom<String> for $name {
            type Error = ChoiceError;

            fn try_from(text: String) -> Result<Self, ChoiceError> {
                text.parse()
            }
        }

        impl From<$name> for String {
            fn from(value: $name) -> Self {
                value.to_string()
            }
        }
    )+ };
}

as_text!(Up Contact SpinPoint);

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn every_axis_word_reads_and_prints_as_itself() {
        for (word, up) in AXES {
            assert_eq!(word.parse::<Up>().unwrap(), up);
            assert_eq!(up.to_string(), word);
        }
        assert_eq!("+Y".parse::<Up>().unwrap(), Up::Y);
        assert_eq!("-0.1,-0.19, 0.98".parse::<Up>().unwrap(), Up::Along([-0.1, -0.19, 0.98]));
    }

    #[test]
    fn a_direction_is_a_unit_vector_however_long_the_one_given() {
        for scale in [1e-300, 1.0, 1e300] {
            let direction = Up::Along([0.0, -3.0 * scale, 4.0 * scale]).direction().unwrap();
            assert!((direction - Vector::new(0.0, -0.6, 0.8)).norm() < 1e-15, "{scale}");
        }
        assert_eq!(Up::NegY.direction().unwrap(), -Vector::y());
        assert_eq!(Up::Principal.direction(), None);
    }

    #[test]
    fn a_bad_direction_says_what_is_wrong_with_it() {
        let says = |text: &str| text.parse::<Up>().unwrap_err().to_string();
        assert!(says("0,0,-0").contains("no direction"));
        assert!(says("nan,0,1").contains("not finite"));
        assert!(says("1,2").contains("is not a direction"));
        assert!(says("principle").contains("did you mean `principal`"), "{}", says("principle"));
        assert!(says("--contact").contains("use x, y, z"), "{}", says("--contact"));
    }

    #[test]
    fn places_are_words_or_points() {
        assert_eq!("lowest".parse::<Contact>().unwrap(), Contact::Lowest);
        assert_eq!("1,-2.5,3".parse::<Contact>().unwrap(), Contact::At([1.0, -2.5, 3.0]));
        assert_eq!("center".parse::<SpinPoint>().unwrap(), SpinPoint::Center);
        let error = "centre".parse::<SpinPoint>().unwrap_err().to_string();
        assert!(error.contains("did you mean `center`"), "{error}");
        assert!("inf,0,0".parse::<Contact>().is_err());
    }

    #[test]
    fn every_goal_has_its_default_objective_first_and_none_is_shared_but_spin_it() {
        assert_eq!(GoalKind::Top.default_objective(), Objective::CriticalSpeed);
        assert_eq!(GoalKind::Yoyo.default_objective(), Objective::SpinIt);
        assert_eq!(GoalKind::Stand.default_objective(), Objective::TopplingAngle);
        for word in Objective::WORDS {
            let objective: Objective = word.parse().unwrap();
            let kinds = [GoalKind::Top, GoalKind::Yoyo, GoalKind::Stand];
            let uses = kinds.iter().filter(|kind| kind.objectives().contains(&objective)).count();
            assert_eq!(uses, if objective == Objective::SpinIt { 2 } else { 1 }, "{word}");
        }
    }

    proptest! {
        #[test]
        fn any_vector_reads_back_to_the_bit(x in -1e9..1e9_f64, y in -1e-9..1e-9_f64, z in proptest::num::f64::NORMAL) {
            let up = Up::Along([x, y, z]);
            prop_assert_eq!(up.to_string().parse::<Up>().unwrap(), up);
            let at = Contact::At([x, y, z]);
            prop_assert_eq!(at.to_string().parse::<Contact>().unwrap(), at);
        }
    }
}
