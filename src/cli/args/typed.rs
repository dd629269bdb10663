//! The words of a command line as a person types them, before they are parsed.

use std::ffi::{OsStr, OsString};
use std::path::Path;

/// The endings of model files.
const MODEL_ENDINGS: [&str; 4] = ["stl", "obj", "ply", "3mf"];
/// The units that a person may type apart from their number.
const UNITS: [&str; 11] = [
    "mm", "cm", "m", "in", "inch", "um", "µm", "rpm", "g", "deg", "°",
];
/// The global options that take the next word as their value.
const WITH_VALUE: [&str; 1] = ["--threads"];

/// A number and its unit typed as two words.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{before} {unit}` has a blank before its unit; remedy: write it as one word: {before}{unit}"
)]
pub struct SplitUnit {
    /// The option and its number, such as `--size 100`.
    before: String,
    /// The unit.
    unit: String,
}

/// Returns the words with `default` as the command, if they name a model and no command.
///
/// The first word is the program. A command is one of `commands`, and it comes before all other
/// words but options.
pub(super) fn with_command(
    mut words: Vec<OsString>,
    commands: &[&str],
    default: &str,
) -> Vec<OsString> {
    let mut typed = words.iter().skip(1);
    let mut first = None;
    while let Some(word) = typed.next() {
        if WITH_VALUE.iter().any(|option| word == option) {
            typed.next();
        } else if !is_option(word) {
            first = Some(word);
            break;
        }
    }
    let is_command = first.is_some_and(|word| commands.iter().any(|command| word == command));
    let is_model = first.is_some_and(|word| Path::new(word).is_file());
    let names_model = words.iter().skip(1).any(|word| has_model_ending(word));
    let is_misspelt = words.get(1).is_some_and(is_misspelt_command);
    if !is_command && (is_model || names_model && !is_misspelt) {
        words.insert(1, default.into());
    }
    words
}

/// Returns whether the first word can be neither a model nor an option.
fn is_misspelt_command(first: &OsString) -> bool {
    !is_option(first) && !has_model_ending(first) && !Path::new(first).is_file()
}

fn is_option(word: &OsStr) -> bool {
    word.as_encoded_bytes().starts_with(b"-")
}

/// Returns true if a word ends as the name of a model file does.
pub(super) fn has_model_ending(word: &OsStr) -> bool {
    let ending = Path::new(word).extension().and_then(OsStr::to_str);
    let is_it = |ending: &str| {
        MODEL_ENDINGS
            .iter()
            .any(|known| known.eq_ignore_ascii_case(ending))
    };
    !is_option(word) && ending.is_some_and(is_it)
}

/// Finds a number whose unit follows as a word of its own, such as `--size 100 mm`.
pub(super) fn find_split_unit(words: &[OsString]) -> Option<SplitUnit> {
    let words: Vec<&str> = words.iter().filter_map(|word| word.to_str()).collect();
    let is_number = |word: &str| word.parse::<f64>().is_ok();
    words.windows(3).find_map(|three| {
        let [option, number, unit] = [three[0], three[1], three[2]];
        let joined = number.split_once('=').map(|(_, value)| value);
        let is_joined = number.starts_with("--") && joined.is_some_and(is_number);
        let is_apart = option.starts_with("--") && !option.contains('=') && is_number(number);
        let before = match (is_joined, is_apart) {
            (true, _) => number.to_owned(),
            (_, true) => format!("{option} {number}"),
            _ => return None,
        };
        let unit = UNITS
            .iter()
            .find(|known| known.eq_ignore_ascii_case(unit))?;
        Some(SplitUnit {
            before,
            unit: (*unit).to_owned(),
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(line: &str) -> Vec<OsString> {
        line.split_whitespace().map(OsString::from).collect()
    }

    #[test]
    fn a_model_without_a_command_is_prepared() {
        let commands = ["prepare", "inspect"];
        for (line, command) in [
            ("equipoise a.stl", Some("prepare")),
            ("equipoise --threads 2 -q B.OBJ --goal top", Some("prepare")),
            ("equipoise --goal top a.3mf", Some("prepare")),
            ("equipoise inspect a.stl", None),
            ("equipoise -v inspect a.stl", None),
            ("equipoise frobnicate", None),
            ("equipoise", None),
            ("equipoise --job=a.stl", None),
            // A misspelt command: what is meant is told, and nothing is prepared.
            ("equipoise inspct a.stl", None),
        ] {
            let typed = with_command(words(line), &commands, "prepare");
            let added = typed.len() - words(line).len();
            assert_eq!(added, usize::from(command.is_some()), "{line}");
            if let Some(command) = command {
                assert_eq!(typed[1], command, "{line}");
            }
        }
    }

    #[test]
    fn a_unit_apart_from_its_number_is_found_and_joined() {
        for (line, joined) in [
            ("equipoise prepare a.stl --size 100 mm", "--size 100mm"),
            ("equipoise --size 100 MM a.stl", "--size 100mm"),
            ("equipoise --size=4 in a.stl", "--size=4in"),
            ("equipoise a.stl --speed 3000 rpm", "--speed 3000rpm"),
        ] {
            let split = find_split_unit(&words(line)).unwrap().to_string();
            assert!(split.ends_with(joined), "{line}: {split}");
        }
        for line in [
            "equipoise a.stl --size 100mm --wall 1",
            "equipoise --size 100 m.stl",
            "equipoise --up y m",
        ] {
            assert_eq!(find_split_unit(&words(line)), None, "{line}");
        }
    }
}
