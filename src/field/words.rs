//! Densities as a person writes them: `uniform:0.4`, `ramp:0,0,1@20mm..60mm:0.2..1`.

use std::str::FromStr;

use super::clamped::Clamped;
use super::order::{Order, SkinOrder};
use super::ramp::Ramp;
use super::range::{DensityRange, RangeError};
use super::sine::Sine;
use super::skin::Profile;
use super::uniform::Uniform;
use crate::base::toml_text::nearest_name;
use crate::base::units::{Length, LengthError};
use crate::geom::{Point, Quadric, Vector};

/// The names of the fields.
const NAMES: [&str; 4] = ["uniform", "ramp", "sine", "skin"];

/// A reason why words are no field.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WordsError {
    /// The name is not known.
    #[error(
        "`{name}` is not a field; remedy: {}, or name a file that ends in .toml",
        match nearest {
            Some(nearest) => format!("did you mean `{nearest}`?"),
            None => format!("write {}", NAMES.join(", ")),
        }
    )]
    Name {
        /// The name given.
        name: String,
        /// The nearest known one.
        nearest: Option<&'static str>,
    },
    /// The words after the name do not fit.
    #[error("`{text}` is not a {name} field; remedy: write it like {example}")]
    Shape {
        /// The name.
        name: &'static str,
        /// The whole text.
        text: String,
        /// A field of that name.
        example: &'static str,
    },
    /// A number is no density.
    #[error("`{0}` is not a density; remedy: {1}")]
    Density(String, String),
    /// Two densities are no range.
    #[error(transparent)]
    Range(#[from] RangeError),
    /// A place is not in order.
    #[error("`{0}` is not two places in rising order; remedy: write them like 20mm..60mm")]
    Places(String),
    /// A point or a direction is not three numbers.
    #[error("`{0}` is not three numbers; remedy: write them like 0,0,1")]
    Triple(String),
    /// The direction has no length.
    #[error("`{0}` is no direction; remedy: give one number other than zero, as in 0,0,1")]
    NoDirection(String),
    /// The fall is not known.
    #[error("`{0}` is not a way to fall; remedy: write gauss or linear")]
    Profile(String),
    /// A length cannot be read.
    #[error(transparent)]
    Length(#[from] LengthError),
}

impl FromStr for Order {
    type Err = WordsError;

    fn from_str(text: &str) -> Result<Self, WordsError> {
        let (name, rest) = text.split_once(':').unwrap_or((text, ""));
        match name.trim() {
            "uniform" => Ok(Self::Uniform(Uniform(density(rest)?))),
            "ramp" => ramp(text, rest),
            "sine" => sine(text, rest),
            "skin" => skin(text, rest),
            "clamped" => clamped(text, rest),
            name => Err(WordsError::Name {
                name: name.to_owned(),
                nearest: nearest_name(name, NAMES),
            }),
        }
    }
}

/// Reads `NX,NY,NZ@FROM..TO:LOW..HIGH`.
fn ramp(text: &str, rest: &str) -> Result<Order, WordsError> {
    let shape = || shape("ramp", text, "ramp:0,0,1@20mm..60mm:0.2..1");
    let (direction, rest) = rest.split_once('@').ok_or_else(shape)?;
    let (places, densities) = rest.split_once(':').ok_or_else(shape)?;
    let (from, to) = places.split_once("..").ok_or_else(shape)?;
    let vector = Vector::from(triple(direction)?);
    if vector.norm() == 0.0 {
        return Err(WordsError::NoDirection(direction.to_owned()));
    }
    let ends_mm = [place(from)?, place(to)?];
    let range = range(densities)?;
    let ramp = Ramp::new(&vector, ends_mm, [range.low(), range.high()]);
    Ok(Order::Ramp(
        ramp.ok_or_else(|| WordsError::Places(places.to_owned()))?,
    ))
}

/// Reads `X,Y,Z@WAVE:LOW..HIGH`.
fn sine(text: &str, rest: &str) -> Result<Order, WordsError> {
    let shape = || shape("sine", text, "sine:10,0,25@40mm:0.1..1");
    let (center, rest) = rest.split_once('@').ok_or_else(shape)?;
    let (wave, densities) = rest.split_once(':').ok_or_else(shape)?;
    let wave: Length = wave.parse()?;
    let range = range(densities)?;
    let center = Point::from(triple(center)?);
    let sine = Sine::new(center, wave.mm(), [range.low(), range.high()]);
    Ok(Order::Sine(sine.ok_or_else(shape)?))
}

/// Reads `DEPTH:gauss|linear:CORE..SURFACE`.
fn skin(text: &str, rest: &str) -> Result<Order, WordsError> {
    let shape = || shape("skin", text, "skin:4mm:gauss:0.2..1");
    let (depth, rest) = rest.split_once(':').ok_or_else(shape)?;
    let (profile, densities) = rest.split_once(':').ok_or_else(shape)?;
    let depth: Length = depth.parse()?;
    let profile = match profile.trim() {
        "gauss" => Profile::Gauss,
        "linear" => Profile::Linear,
        other => return Err(WordsError::Profile(other.to_owned())),
    };
    let range = range(densities)?;
    Ok(Order::Skin(SkinOrder {
        depth_mm: depth.mm(),
        profile,
        densities: [range.low(), range.high()],
    }))
}

/// Reads `Q,Q,Q,Q,Q,Q,Q,Q,Q,Q@WISHED:LOW..HIGH`: as kits state their smooth field.
fn clamped(text: &str, rest: &str) -> Result<Order, WordsError> {
    let shape = || shape("clamped", text, "clamped:0,0,0,0.01,0,0,0,0,0,0@0.4:0.2..1");
    let (quadric, rest) = rest.split_once('@').ok_or_else(shape)?;
    let (wished, densities) = rest.split_once(':').ok_or_else(shape)?;
    let quadric = numbers(quadric).ok_or_else(shape)?;
    let wished = density(wished)?;
    let field = Clamped::new(Quadric(quadric), wished, range(densities)?);
    Ok(Order::Clamped(field))
}

fn shape(name: &'static str, text: &str, example: &'static str) -> WordsError {
    WordsError::Shape {
        name,
        text: text.to_owned(),
        example,
    }
}

/// Reads a density: `0.4` or `40%`.
fn density(text: &str) -> Result<f64, WordsError> {
    let text = text.trim();
    let (number, is_percent) = match text.strip_suffix('%') {
        Some(number) => (number.trim_end(), true),
        None => (text, false),
    };
    let value: Option<f64> = number.parse().ok().filter(|value: &f64| value.is_finite());
    let refuse = |remedy: String| WordsError::Density(text.to_owned(), remedy);
    let usual = || "give a share from 0 to 1, such as 0.4 or 40%".to_owned();
    let value = value.ok_or_else(|| refuse(usual()))?;
    match (is_percent, value) {
        (true, value) if (0.0..=100.0).contains(&value) => Ok(value / 100.0),
        (false, value) if (0.0..=1.0).contains(&value) => Ok(value),
        (false, value) if value > 2.0 && value <= 100.0 => {
            Err(refuse(format!("write {number}% or {}", value / 100.0)))
        }
        _ => Err(refuse(usual())),
    }
}

/// Reads two densities, the lesser first.
fn range(text: &str) -> Result<DensityRange, WordsError> {
    let usual = "give two shares such as 0.2..1 or 20%..100%".to_owned();
    let refuse = || WordsError::Density(text.to_owned(), usual);
    let (low, high) = text.split_once("..").ok_or_else(refuse)?;
    Ok(DensityRange::new(density(low)?, density(high)?)?)
}

/// Reads three numbers.
fn triple(text: &str) -> Result<[f64; 3], WordsError> {
    numbers(text).ok_or_else(|| WordsError::Triple(text.to_owned()))
}

/// Reads a list of so many finite numbers.
fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let number = |part: &str| {
        part.trim()
            .parse()
            .ok()
            .filter(|value: &f64| value.is_finite())
    };
    let numbers: Option<Vec<f64>> = text.split(',').map(number).collect();
    numbers?.try_into().ok()
}

/// Reads a place along a direction, mm: a length, its negative, or zero.
fn place(text: &str) -> Result<f64, WordsError> {
    let text = text.trim();
    let (sign, size) = match text.strip_prefix('-') {
        Some(size) => (-1.0, size),
        None => (1.0, text),
    };
    let digits = size.trim_end_matches(|c: char| c.is_alphabetic() || c.is_whitespace());
    if digits.parse() == Ok(0.0) {
        return Ok(0.0);
    }
    Ok(sign * size.parse::<Length>()?.mm())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_words_of_the_manual_are_read() {
        for text in [
            "uniform:0.4",
            "uniform:40%",
            "ramp:0,0,1@20mm..60mm:0.2..1",
            "ramp:1,-2,0.5@-2cm..0mm:20%..100%",
            "sine:10,-5.5,0@40mm:0.1..1",
            "skin:4mm:gauss:0.2..1",
            "skin:4mm:linear:0.2..1",
            "clamped:1e-2,0,0,-0.5,0,0,0,0,0,3@0.4:0.142..1",
        ] {
            assert!(
                text.parse::<Order>().is_ok(),
                "{text}: {:?}",
                text.parse::<Order>()
            );
        }
        assert_eq!("uniform:40%".parse(), Ok(Order::Uniform(Uniform(0.4))));
    }

    #[test]
    fn wrong_words_are_refused_with_a_remedy() {
        for (text, part) in [
            ("unifrom:0.4", "did you mean `uniform`?"),
            ("gyroid", "write uniform, ramp, sine, skin"),
            ("uniform:15", "write 15% or 0.15"),
            ("uniform:1.5", "from 0 to 1"),
            ("uniform:-0.1", "from 0 to 1"),
            ("uniform:nan", "from 0 to 1"),
            ("uniform:inf", "from 0 to 1"),
            ("uniform:120%", "from 0 to 1"),
            ("uniform", "`` is not a density"),
            ("ramp:0,0,1@20mm..60mm:1..0.2", "1 is not below 0.2"),
            ("ramp:0,0,1@20mm..60mm:0.2..0.2", "is not below"),
            ("ramp:0,0,1@60mm..20mm:0.2..1", "rising order"),
            ("ramp:0,0,0@20mm..60mm:0.2..1", "no direction"),
            ("ramp:0,0@20mm..60mm:0.2..1", "three numbers"),
            (
                "ramp:0,0,1@20mm:0.2..1",
                "write it like ramp:0,0,1@20mm..60mm:0.2..1",
            ),
            ("sine:nan,0,0@40mm:0.1..1", "three numbers"),
            ("sine:0,0,0@0mm:0.1..1", "above zero"),
            ("sine:0,0,0@40mm:0.1", "such as 0.2..1"),
            ("clamped:1,2,3@0.4:0.2..1", "write it like clamped:"),
            ("clamped:0,0,0,0,0,0,0,0,0,nan@0.4:0.2..1", "write it like"),
            ("clamped:0,0,0,0,0,0,0,0,0,1@4:0.2..1", "write 4% or 0.04"),
            ("skin:4mm:cubic:0.2..1", "write gauss or linear"),
            ("skin:4parsec:gauss:0.2..1", "unit of length"),
        ] {
            let error = text.parse::<Order>().unwrap_err().to_string();
            assert!(
                error.contains(part) && error.contains("remedy: "),
                "{text}: {error}"
            );
        }
    }
}
