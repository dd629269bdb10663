//! Readers of single values, and the text that ends the help.

use std::ffi::OsStr;
use std::str::FromStr;
use std::time::Duration;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::error::ErrorKind;
use clap::{Arg, Command};

use crate::base::words::{ChoiceError, parse_numbers};
use crate::goal::GoalKind;

/// The commands that the list leaves out, for the long help.
pub(super) const ALSO: &str = "\
Also:
  equipoise core MODEL          puts a model larger than the printer on a base
  equipoise cells MODEL         divides a model into cells, near cubes or round ones
  equipoise completions SHELL   prints the completion script of a shell
  equipoise man [COMMAND]       prints the manual page of the program or of a command";

/// The examples in the help.
pub(super) const EXAMPLES: &str = "\
Examples:
  equipoise humpty.obj
  equipoise prepare humpty.obj --goal stand --printer prusa-mk4 --size 100mm
  equipoise inspect humpty.obj --printer prusa-mk4 --size 100mm";

/// The examples in the help of `prepare`.
pub(super) const PREPARE_EXAMPLES: &str = "\
Examples:
  equipoise prepare humpty.obj                  (asks for the rest)
  equipoise prepare humpty.obj --goal stand --printer prusa-mk4 --size 100mm
  equipoise prepare wheel.stl --goal balance --up x --printer eos-p396";

/// The text below the options in the help of a command.
pub(super) const EXIT_CODES: &str = "\
LENGTH takes a unit (100mm, 10cm, 0.1m, 4in, 42um); without one it is in mm.
Exit codes: 0 every promise is kept; 1 finished, but a promise is broken (by a missing or damaged \
file of a kit too) or the goal is impossible; 2 could not run: bad arguments, a model that is not \
one solid body, no kit; 130 or 143 stopped by Ctrl-C or a request to end, and nothing was written.";

/// Returns a reader of one of these words, which the help lists.
pub(super) fn words<T>(words: &'static [&'static str]) -> impl TypedValueParser<Value = T>
where
    T: FromStr<Err = ChoiceError> + Clone + Send + Sync + 'static,
{
    PossibleValuesParser::new(words).try_map(|word| word.parse::<T>())
}

/// A text that is not the expected number.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{text}` is not {what}; remedy: give {such_as}")]
pub struct NumberError {
    text: String,
    what: &'static str,
    such_as: &'static str,
}

/// A number with the units that a person may type after it.
struct Number {
    what: &'static str,
    such_as: &'static str,
    /// The units in small letters, each with its value in the first one.
    units: &'static [(&'static str, f64)],
    /// The least value; zero itself is a number if it is `Some(0.0)`.
    least: Option<f64>,
}

impl Number {
    /// Reads a finite number, with or without a unit. Without a least value it is above zero.
    fn read(&self, text: &str) -> Result<f64, NumberError> {
        let small = text.trim().to_lowercase();
        let with_unit = |(unit, value): &(&str, f64)| {
            let number = small.strip_suffix(unit)?.trim_end();
            Some(number.parse::<f64>().ok()? * value)
        };
        let read = small.parse().ok();
        let number = read.or_else(|| self.units.iter().find_map(with_unit));
        let is_sound = |number: &f64| {
            number.is_finite() && self.least.map_or(*number > 0.0, |least| *number >= least)
        };
        number.filter(is_sound).ok_or_else(|| NumberError {
            text: text.to_owned(),
            what: self.what,
            such_as: self.such_as,
        })
    }
}

/// Reads an angle in degrees.
pub(super) fn angle(text: &str) -> Result<f64, NumberError> {
    let angle = Number {
        what: "an angle of zero or more",
        such_as: "degrees, such as 5 or 5deg",
        units: &[("°", 1.0), ("degrees", 1.0), ("degree", 1.0), ("deg", 1.0)],
        least: Some(0.0),
    };
    angle.read(text)
}

/// Reads the factor from a file's numbers to mm.
pub(super) fn scale(text: &str) -> Result<f64, NumberError> {
    let factor = Number {
        what: "a positive, finite factor",
        such_as: "a number above zero, such as 2.5",
        units: &[("x", 1.0)],
        least: None,
    };
    factor.read(text)
}

/// Reads a speed in turns per minute.
pub(super) fn speed(text: &str) -> Result<f64, NumberError> {
    let speed = Number {
        what: "a speed above zero",
        such_as: "turns per minute, such as 3000 or 3000rpm",
        units: &[("rpm", 1.0), ("/min", 1.0), ("hz", 60.0), ("rps", 60.0)],
        least: None,
    };
    speed.read(text)
}

/// Reads a balance quality grade, mm/s, as `2.5` or `G2.5`.
pub(super) fn grade(text: &str) -> Result<f64, NumberError> {
    let grade = Number {
        what: "a balance grade above zero",
        such_as: "a number such as 2.5 or G2.5",
        units: &[("mm/s", 1.0)],
        least: None,
    };
    let number = text.trim().trim_start_matches(['g', 'G']);
    grade.read(number)
}

/// Reads a mass in g.
pub(super) fn mass(text: &str) -> Result<f64, NumberError> {
    let mass = Number {
        what: "a mass above zero",
        such_as: "grams, such as 2.5 or 2.5g",
        units: &[("kg", 1000.0), ("g", 1.0)],
        least: None,
    };
    mass.read(text)
}

/// Reads a time.
pub(super) fn time(text: &str) -> Result<Duration, NumberError> {
    let seconds = Number {
        what: "a time above zero",
        such_as: "one such as 90s, 10min or 2h",
        units: &[("min", 60.0), ("h", 3600.0), ("s", 1.0)],
        least: None,
    };
    // A clock that cannot count so far never strikes.
    let time = |seconds| Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX);
    seconds.read(text).map(time)
}

/// Reads an amount of memory, bytes.
pub(super) fn memory(text: &str) -> Result<u64, NumberError> {
    let bytes = Number {
        what: "an amount of memory of 10 MB or more",
        such_as: "one such as 800MB or 4GB",
        units: &[
            ("mb", 1e6),
            ("gb", 1e9),
            ("tb", 1e12),
            ("mib", 1_048_576.0),
            ("gib", 1_073_741_824.0),
        ],
        // With less no command could even begin, and `4` alone would be four bytes.
        least: Some(1e7),
    };
    // Too large a number becomes the largest, which no machine has.
    bytes.read(text).map(|bytes| bytes as u64)
}

/// Reads finite numbers between commas.
pub(super) fn numbers<const N: usize>(text: &str) -> Result<[f64; N], NumbersError> {
    let read =
        parse_numbers(text).filter(|numbers: &[f64; N]| numbers.iter().all(|n| n.is_finite()));
    read.ok_or_else(|| NumbersError {
        text: text.to_owned(),
        count: N,
    })
}

/// Reads three ratios of sides, above zero.
pub(super) fn sides(text: &str) -> Result<[f64; 3], NumberError> {
    let read = parse_numbers(text).filter(|sides: &[f64; 3]| {
        let range = LEAST_SIDE..=LEAST_SIDE.recip();
        sides.iter().all(|side| range.contains(side))
    });
    read.ok_or_else(|| NumberError {
        text: text.to_owned(),
        what: "three sides from 0.01 to 100",
        such_as: "their ratio, such as 1,1,2",
    })
}

/// The least ratio of a side. Beyond it cells are needles or sheets.
const LEAST_SIDE: f64 = 0.01;

/// A text that is not as many numbers as are needed.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{text}` is not {count} numbers; remedy: give {count} with commas between, and no blanks")]
pub struct NumbersError {
    text: String,
    count: usize,
}

/// Words that people say for a goal, and the goals they may mean.
const GOAL_HINTS: [(&str, &str); 14] = [
    ("dummy", "match"),
    ("like", "match"),
    ("spin", "top or yoyo"),
    ("spins", "top or yoyo"),
    ("spinner", "top or yoyo"),
    ("spinning", "top or yoyo"),
    ("spinning-top", "top"),
    ("stable", "stand"),
    ("upright", "stand"),
    ("boat", "float"),
    ("swim", "float"),
    ("rotor", "balance"),
    ("wheel", "balance"),
    ("runs-true", "balance"),
];

/// Reads a goal. For any other word it names those that may be meant.
#[derive(Debug, Clone, Copy)]
pub(super) struct GoalReader;

impl TypedValueParser for GoalReader {
    type Value = GoalKind;

    fn parse_ref(
        &self,
        command: &Command,
        _arg: Option<&Arg>,
        value: &OsStr,
    ) -> Result<GoalKind, clap::Error> {
        let text = value.to_string_lossy();
        let refused = |error: ChoiceError| {
            let known = GoalKind::WORDS.join(", ");
            let ask = ask_for_goal(&text).map_or(error.to_string(), |meant| {
                format!("`{text}` is not a goal; did you mean {meant}?")
            });
            let message = format!("{ask} [possible values: {known}]\n");
            clap::Error::raw(ErrorKind::InvalidValue, message).with_cmd(command)
        };
        text.parse().map_err(refused)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(GoalKind::WORDS.iter().map(PossibleValue::new)))
    }
}

/// A share that is not from 0 to 100 %.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is no share; remedy: give a percentage such as 15%, or a number from 0 to 1")]
pub struct ShareError(String);

/// Reads a share: `15%` or `0.15`.
pub(super) fn share(text: &str) -> Result<f64, ShareError> {
    let (number, unit) = match text.trim().strip_suffix('%') {
        Some(number) => (number, 0.01),
        None => (text, 1.0),
    };
    match number.trim().parse::<f64>().map(|value| unit * value) {
        Ok(share) if (0.0..=1.0).contains(&share) => Ok(share),
        _ => Err(ShareError(text.to_owned())),
    }
}

/// Returns the goals that a word may mean.
fn ask_for_goal(text: &str) -> Option<&'static str> {
    let meant = GOAL_HINTS
        .iter()
        .find(|(word, _)| word.eq_ignore_ascii_case(text));
    meant.map(|(_, goals)| *goals)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_with_the_units_that_people_type() {
        for (text, rpm) in [
            ("3000", 3000.0),
            ("3000rpm", 3000.0),
            ("3000 RPM", 3000.0),
            ("50Hz", 3000.0),
            ("1.2e3/min", 1200.0),
        ] {
            assert_eq!(speed(text), Ok(rpm), "{text}");
        }
        assert_eq!(grade("G2.5"), Ok(2.5));
        assert_eq!(mass("2.5 g"), Ok(2.5));
        assert_eq!(angle("0°"), Ok(0.0));
        assert_eq!(angle("5 deg"), Ok(5.0));
    }

    #[test]
    fn a_number_that_cannot_be_used_is_refused_with_an_example() {
        let said = speed("fast").unwrap_err().to_string();
        assert!(said.contains("such as 3000 or 3000rpm"), "{said}");
        for text in ["", "rpm", "0rpm", "-3rpm", "nan", "inf rpm", "3000mm"] {
            assert!(speed(text).is_err(), "{text}");
        }
    }
}
