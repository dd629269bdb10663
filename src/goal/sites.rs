//! The words that place a goal: the direction that becomes up, a top's contact, a yo-yo's spin
//! point.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use crate::base::words::{ChoiceError, as_text, parse_numbers};
use crate::geom::Vector;

/// The direction of the model that becomes the spin axis or up.
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
    /// The solid's own axis of the largest moment of inertia, the easiest to spin about. Of its two
    /// senses it is the one in which the centre of mass stands lower.
    Principal,
    /// The best of all directions. A run chooses it before it places the goal.
    Auto,
    /// The direction in which the model stands by nature. A run finds it before it places the goal.
    Natural,
}

/// The words for the axes, in the order of [`Up`]'s values.
const AXES: [(&str, Up); 9] = [
    ("x", Up::X),
    ("y", Up::Y),
    ("z", Up::Z),
    ("-x", Up::NegX),
    ("-y", Up::NegY),
    ("-z", Up::NegZ),
    ("principal", Up::Principal),
    ("auto", Up::Auto),
    ("natural", Up::Natural),
];

impl Up {
    /// Returns the unit vector. `None` for the principal, best and natural axes, which depend on
    /// the solid, and for a vector without a direction.
    pub fn direction(self) -> Option<Vector> {
        let [x, y, z] = [Vector::x(), Vector::y(), Vector::z()];
        match self {
            Self::X => Some(x),
            Self::Y => Some(y),
            Self::Z => Some(z),
            Self::NegX => Some(-x),
            Self::NegY => Some(-y),
            Self::NegZ => Some(-z),
            Self::Along(along) => unit(along),
            Self::Principal | Self::Auto | Self::Natural => None,
        }
    }

    /// Returns the word for a coordinate axis, or the vector.
    pub fn of(direction: &Vector) -> Self {
        let words = [
            Self::X,
            Self::Y,
            Self::Z,
            Self::NegX,
            Self::NegY,
            Self::NegZ,
        ];
        let is_it = |up: &Self| up.direction().is_some_and(|known| known == *direction);
        words
            .into_iter()
            .find(is_it)
            .unwrap_or(Self::Along((*direction).into()))
    }
}

/// Returns the unit vector along a vector of any length; `None` if it has no direction.
fn unit(along: [f64; 3]) -> Option<Vector> {
    let along = Vector::from(along);
    let largest = along.amax();
    let is_direction = largest > 0.0 && along.iter().all(|number| number.is_finite());
    is_direction.then(|| (along / largest).normalize())
}

impl FromStr for Up {
    type Err = ChoiceError;

    fn from_str(text: &str) -> Result<Self, ChoiceError> {
        let lower = text.trim().to_lowercase();
        let word = lower.strip_prefix('+').unwrap_or(&lower);
        if let Some(&(_, up)) = AXES.iter().find(|(axis, _)| *axis == word) {
            return Ok(up);
        }
        let along = parse_numbers(&lower).ok_or_else(|| {
            ChoiceError::unknown(
                "direction",
                text,
                &[
                    "x",
                    "y",
                    "z",
                    "-x",
                    "-y",
                    "-z",
                    "X,Y,Z",
                    "principal",
                    "auto",
                    "natural",
                ],
            )
        })?;
        check_direction(along, text)
    }
}

fn check_direction(along: [f64; 3], text: &str) -> Result<Up, ChoiceError> {
    if along.iter().any(|number| !number.is_finite()) {
        return Err(ChoiceError::NotFinite(text.to_owned()));
    }
    unit(along)
        .map(|_| Up::Along(along))
        .ok_or_else(|| ChoiceError::ZeroVector(text.to_owned()))
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

/// Defines a place that is named by a word or given as a point of the model in mm.
macro_rules! place {
    ($(#[$about:meta])* $name:ident, $what:literal {
        $($(#[$doc:meta])* $value:ident = $word:literal,)+
    }) => {
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
                match (text.trim(), parse_numbers::<3>(text)) {
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
    /// The point at which a top touches the floor.
    Contact, "contact point" {
        /// The lowest point if the top spins there, else below the solid's centre of mass.
        Auto = "auto",
        /// The lowest point of the model; the middle of the lowest edge or face.
        Lowest = "lowest",
        /// Vertically below the solid's centre of mass, at the height of the lowest point.
        Center = "center",
    }
}

place! {
    /// The point about which a yo-yo spins.
    SpinPoint, "spin point" {
        /// The solid's centre of mass.
        Center = "center",
    }
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
        assert_eq!(
            "-0.1,-0.19, 0.98".parse::<Up>().unwrap(),
            Up::Along([-0.1, -0.19, 0.98])
        );
    }

    #[test]
    fn a_direction_is_a_unit_vector_whatever_length_was_given() {
        for scale in [1e-300, 1.0, 1e300] {
            let direction = Up::Along([0.0, -3.0 * scale, 4.0 * scale])
                .direction()
                .unwrap();
            assert!(
                (direction - Vector::new(0.0, -0.6, 0.8)).norm() < 1e-15,
                "{scale}"
            );
        }
        assert_eq!(Up::NegY.direction().unwrap(), -Vector::y());
        assert_eq!(Up::Principal.direction(), None);
        assert_eq!(Up::Along([0.0, -0.0, 0.0]).direction(), None);
        assert_eq!(Up::Along([1.0, f64::NAN, 0.0]).direction(), None);
    }

    #[test]
    fn a_bad_direction_says_what_is_wrong_with_it() {
        let says = |text: &str| text.parse::<Up>().unwrap_err().to_string();
        assert!(says("0,0,-0").contains("no direction"));
        assert!(says("nan,0,1").contains("not finite"));
        assert!(says("1,2").contains("is not a direction"));
        assert!(
            says("principle").contains("did you mean `principal`"),
            "{}",
            says("principle")
        );
        assert!(
            says("--contact").contains("use x, y, z"),
            "{}",
            says("--contact")
        );
    }

    #[test]
    fn places_are_words_or_points() {
        assert_eq!("lowest".parse::<Contact>().unwrap(), Contact::Lowest);
        assert_eq!(
            "1,-2.5,3".parse::<Contact>().unwrap(),
            Contact::At([1.0, -2.5, 3.0])
        );
        assert_eq!("center".parse::<SpinPoint>().unwrap(), SpinPoint::Center);
        let error = "centre".parse::<SpinPoint>().unwrap_err().to_string();
        assert!(error.contains("did you mean `center`"), "{error}");
        assert!("inf,0,0".parse::<Contact>().is_err());
    }

    proptest! {
        #[test]
        fn any_vector_reads_back_to_the_bit(
            x in -1e9..1e9_f64,
            y in -1e-9..1e-9_f64,
            z in proptest::num::f64::NORMAL,
        ) {
            let up = Up::Along([x, y, z]);
            prop_assert_eq!(up.to_string().parse::<Up>().unwrap(), up);
            let at = Contact::At([x, y, z]);
            prop_assert_eq!(at.to_string().parse::<Contact>().unwrap(), at);
        }
    }
}
