//! Lengths, masses and angles: mm, g and radians inside; parsing and text for people.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Standard gravity, m/s² (CGPM 1901, resolution 2).
pub const STANDARD_GRAVITY_M_S2: f64 = 9.806_65;

/// Standard gravity in the library's own units, mm/s².
pub const STANDARD_GRAVITY_MM_S2: f64 = STANDARD_GRAVITY_M_S2 * 1000.0;

/// Millimetres in an inch, exact by definition (1959).
pub const MM_PER_INCH: f64 = 25.4;

/// Square millimetres in a square centimetre.
pub const MM2_PER_CM2: f64 = 100.0;
/// Cubic millimetres in a cubic centimetre.
pub const MM3_PER_CM3: f64 = 1000.0;

/// The units of length with their values in mm; the default, `mm`, comes first.
const LENGTH_UNITS: [(&str, f64); 6] = [
    ("mm", 1.0),
    ("cm", 10.0),
    ("m", 1000.0),
    ("in", MM_PER_INCH),
    ("um", 1e-3),
    ("µm", 1e-3),
];

/// A positive, finite length as a person writes it: `100mm`, `4in`, `10cm`, `0.1m`, `42um`; without
/// a unit, mm.
///
/// In TOML and JSON it is written as a string with its unit. It is read from such a string, or from
/// a number of mm.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub struct Length {
    mm: f64,
}

/// Formats a count of things: `1 pin`, `3 pins`.
pub fn format_count(count: usize, thing: &str) -> String {
    if count == 1 {
        format!("1 {thing}")
    } else {
        format!("{count} {thing}s")
    }
}

/// The reason that a text or a number is not a length.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LengthError {
    /// No digits.
    #[error(
        "`{0}` is not a length; remedy: write a number and a unit, such as 100mm, 10cm, 0.1m or 4in"
    )]
    NotANumber(String),
    /// A unit that is not known.
    #[error("`{unit}` in `{text}` is not a unit of length; remedy: use mm, cm, m, in or um")]
    UnknownUnit {
        /// The whole text.
        text: String,
        /// The unit in it.
        unit: String,
    },
    /// Zero, negative, infinite or not a number.
    #[error("`{0}` is not a positive, finite length; remedy: give a length above zero")]
    NotPositive(String),
}

impl Length {
    /// Makes a length of `mm` millimetres. Fails unless it is positive and finite.
    pub fn from_mm(mm: f64) -> Result<Self, LengthError> {
        if mm.is_finite() && mm > 0.0 {
            Ok(Self { mm })
        } else {
            Err(LengthError::NotPositive(mm.to_string()))
        }
    }

    /// Returns the length in mm.
    pub fn mm(self) -> f64 {
        self.mm
    }
}

impl FromStr for Length {
    type Err = LengthError;

    fn from_str(text: &str) -> Result<Self, LengthError> {
        let lower = text.trim().to_lowercase();
        if let Ok(mm) = lower.parse::<f64>() {
            return Self::from_mm(mm).map_err(|_| LengthError::NotPositive(text.to_owned()));
        }
        let unit_at = lower
            .rfind(|c: char| c.is_ascii_digit() || c == '.')
            .map_or(0, |last| last + 1);
        let (number, unit) = (lower[..unit_at].trim(), lower[unit_at..].trim());
        let number: f64 = number
            .parse()
            .map_err(|_| LengthError::NotANumber(text.to_owned()))?;
        let factor = unit_in_mm(unit).ok_or_else(|| LengthError::UnknownUnit {
            text: text.to_owned(),
            unit: unit.to_owned(),
        })?;
        Self::from_mm(number * factor).map_err(|_| LengthError::NotPositive(text.to_owned()))
    }
}

/// Returns the length of the named unit, mm; `None` if it is unknown.
fn unit_in_mm(unit: &str) -> Option<f64> {
    LENGTH_UNITS
        .iter()
        .find(|(name, _)| *name == unit)
        .map(|&(_, mm)| mm)
}

/// Writes the shortest decimal that reads back as the same length, with its unit: `1.016mm`.
impl fmt::Display for Length {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}mm", self.mm)
    }
}

impl Serialize for Length {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Length {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(LengthVisitor)
    }
}

struct LengthVisitor;

impl serde::de::Visitor<'_> for LengthVisitor {
    type Value = Length;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a length: a number of mm, or a string such as \"100mm\" or \"4in\"")
    }

    fn visit_f64<E: serde::de::Error>(self, mm: f64) -> Result<Length, E> {
        Length::from_mm(mm).map_err(E::custom)
    }

    fn visit_i64<E: serde::de::Error>(self, mm: i64) -> Result<Length, E> {
        self.visit_f64(mm as f64)
    }

    fn visit_u64<E: serde::de::Error>(self, mm: u64) -> Result<Length, E> {
        self.visit_f64(mm as f64)
    }

    fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<Length, E> {
        text.parse().map_err(E::custom)
    }
}

/// The text shown for a number that is not finite.
const NO_NUMBER: &str = "—";

/// Formats a length for people: `1.016 mm` below 10 mm, `101.60 mm` from there.
pub fn show_mm(mm: f64) -> String {
    format_with_unit(mm, if mm.abs() < 10.0 { 3 } else { 2 }, "mm")
}

/// Formats a volume for people: `12.35 cm³` from 1 cm³, `12.3 mm³` below.
pub fn show_mm3(mm3: f64) -> String {
    if mm3.abs() < MM3_PER_CM3 {
        format_with_unit(mm3, 1, "mm³")
    } else {
        format_with_unit(mm3 / MM3_PER_CM3, 2, "cm³")
    }
}

/// Words the ratio of the moments of inertia across and about a spin axis for people:
/// `wobble 0.93 (below 1 it is steady)`. A value near 1 has four decimals, so that its side shows.
pub fn show_wobble(ratio: f64) -> String {
    let places = if (0.99..1.01).contains(&ratio) { 4 } else { 2 };
    format!("wobble {ratio:.places$} (below 1 it is steady)")
}

/// Formats a mass for people: `12.35 g`.
pub fn show_g(g: f64) -> String {
    format_with_unit(g, 2, "g")
}

/// Formats a rate of rotation for people: `255.6 rpm`.
pub fn show_rpm(rpm: f64) -> String {
    format_with_unit(rpm, 1, "rpm")
}

/// Formats an angle, given in radians, as degrees for people: `0.050°`.
pub fn show_deg(radians: f64) -> String {
    let text = format_decimals(radians.to_degrees(), 3);
    if text == NO_NUMBER { text } else { text + "°" }
}

/// Formats a ratio for people: `0.6485`.
pub fn show_ratio(ratio: f64) -> String {
    format_decimals(ratio, 4)
}

/// Formats a ratio as a percentage for people: `37.1 %`.
pub fn show_percent(ratio: f64) -> String {
    format_with_unit(100.0 * ratio, 1, "%")
}

/// Formats a number that may be very small, such as a certificate's gap: `3.1e-9`; `0` for zero.
pub fn show_small(value: f64) -> String {
    match value {
        v if !v.is_finite() => NO_NUMBER.to_owned(),
        0.0 => "0".to_owned(),
        v => format!("{v:.1e}"),
    }
}

/// Formats an amount of memory for people: `4.0 GB` from 1 GB, `800 MB` below.
pub fn show_bytes(bytes: u64) -> String {
    let megabytes = bytes as f64 / 1e6;
    if megabytes < 1e3 {
        format_with_unit(megabytes, 0, "MB")
    } else {
        format_with_unit(megabytes / 1e3, 1, "GB")
    }
}

fn format_with_unit(value: f64, places: usize, unit: &str) -> String {
    let text = format_decimals(value, places);
    if text == NO_NUMBER {
        text
    } else {
        format!("{text} {unit}")
    }
}

/// Formats `value` with `places` decimals; never `-0.00`, and a dash if it is not finite.
fn format_decimals(value: f64, places: usize) -> String {
    if !value.is_finite() {
        return NO_NUMBER.to_owned();
    }
    let text = format!("{value:.places$}");
    let is_zero = !text.bytes().any(|b| b.is_ascii_digit() && b != b'0');
    if is_zero {
        text.trim_start_matches('-').to_owned()
    } else {
        text
    }
}

/// Minutes in an hour.
const MIN_PER_H: u32 = 60;

/// Words a time: `59 min`, or `3 h 5 min`.
pub fn show_minutes(minutes: u32) -> String {
    match (minutes / MIN_PER_H, minutes % MIN_PER_H) {
        (0, rest) => format!("{rest}\u{a0}min"),
        (hours, rest) => format!("{hours}\u{a0}h {rest}\u{a0}min"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn mm(text: &str) -> f64 {
        text.parse::<Length>().unwrap().mm()
    }

    #[test]
    fn times_are_worded_in_hours_and_minutes() {
        assert_eq!(show_minutes(59), "59\u{a0}min");
        assert_eq!(show_minutes(185), "3\u{a0}h 5\u{a0}min");
    }

    #[test]
    fn memory_is_worded_in_megabytes_and_gigabytes() {
        assert_eq!(show_bytes(800_000_000), "800 MB");
        assert_eq!(show_bytes(4_000_000_000), "4.0 GB");
    }

    #[test]
    fn one_thing_is_singular_and_none_is_not() {
        assert_eq!(
            [0, 1, 3].map(|count| format_count(count, "pin")),
            ["0 pins", "1 pin", "3 pins"]
        );
    }

    #[test]
    fn a_length_is_read_in_every_unit_and_in_mm_without_one() {
        let same = [
            "101.6mm",
            "4in",
            "10.16cm",
            "0.1016m",
            "101600um",
            "101.6",
            " 101.6 MM ",
            "4 in",
            "1016e-1mm",
        ];
        for text in same {
            assert!((mm(text) - 101.6).abs() < 1e-12, "{text}");
        }
        assert_eq!(mm("1.5"), 1.5);
        assert_eq!(mm("0.1m"), 100.0);
        assert_eq!(mm("42µm"), 0.042);
    }

    #[test]
    fn a_bad_length_says_what_is_wrong_with_it() {
        let says = |text: &str| text.parse::<Length>().unwrap_err().to_string();
        for text in ["", "mm", "wide", "1,5mm", "--1", "1.2.3mm"] {
            assert!(
                says(text).contains("is not a length"),
                "{text}: {}",
                says(text)
            );
        }
        for text in ["10furlong", "3ft", "1mmm"] {
            assert!(
                says(text).contains("is not a unit of length"),
                "{text}: {}",
                says(text)
            );
        }
        for text in ["0", "-1mm", "0in", "nan", "inf", "-inf", "1e999mm"] {
            assert!(
                says(text).contains("positive, finite"),
                "{text}: {}",
                says(text)
            );
        }
    }

    #[derive(Debug, PartialEq, Serialize, Deserialize)]
    struct Sample {
        wall: Length,
    }

    #[test]
    fn a_length_in_a_file_may_be_a_string_or_a_number() {
        for text in [
            "wall = \"1mm\"",
            "wall = 1.0",
            "wall = 1",
            "wall = \"0.1cm\"",
        ] {
            assert_eq!(
                toml::from_str::<Sample>(text).unwrap().wall.mm(),
                1.0,
                "{text}"
            );
        }
        let error = toml::from_str::<Sample>("wall = -1.0").unwrap_err();
        assert!(error.message().contains("positive"), "{error}");
        assert!(toml::from_str::<Sample>("wall = true").is_err());
    }

    proptest! {
        #[test]
        fn a_written_length_reads_back_to_the_bit(value in 1e-9..1e9_f64) {
            let sample = Sample { wall: Length::from_mm(value).unwrap() };
            let text = toml::to_string(&sample).unwrap();
            prop_assert_eq!(toml::from_str::<Sample>(&text).unwrap(), sample);
        }
    }

    proptest! {
        #[test]
        fn any_text_is_read_or_refused_without_a_panic(text in "\\PC*|[0-9.eE+µminc -]{0,12}") {
            if let Ok(length) = text.parse::<Length>() {
                prop_assert!(length.mm() > 0.0 && length.mm().is_finite());
            }
        }
    }

    #[test]
    fn numbers_for_people_have_the_decimals_a_shop_can_use() {
        assert_eq!(show_mm(1.016), "1.016 mm");
        assert_eq!(show_mm(-12.3456), "-12.35 mm");
        assert_eq!(show_mm3(12345.6), "12.35 cm³");
        assert_eq!(show_mm3(12.34), "12.3 mm³");
        assert_eq!(show_g(12.346), "12.35 g");
        assert_eq!(show_wobble(0.926), "wobble 0.93 (below 1 it is steady)");
        assert_eq!(show_wobble(1.004), "wobble 1.0040 (below 1 it is steady)");
        assert_eq!(show_rpm(255.64), "255.6 rpm");
        assert_eq!(show_deg(std::f64::consts::PI), "180.000°");
        assert_eq!(show_ratio(0.64849), "0.6485");
        assert_eq!(show_percent(0.3715), "37.1 %");
        assert_eq!(show_small(3.14e-9), "3.1e-9");
        assert_eq!(show_small(0.0), "0");
    }

    #[test]
    fn nothing_is_shown_as_minus_zero_or_as_nan() {
        assert_eq!(show_mm(-0.0001), "0.000 mm");
        assert_eq!(show_rpm(f64::NAN), NO_NUMBER);
        assert_eq!(show_deg(f64::INFINITY), NO_NUMBER);
        assert_eq!(show_small(f64::NAN), NO_NUMBER);
    }
}
