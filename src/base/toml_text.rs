//! Reads TOML into plain data. Every fault names its line, its column and the nearest known name.

use std::{fmt, ops::Range};

use serde::de::DeserializeOwned;

/// A place in a text file. Lines and columns count from 1, columns in characters.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// The name of the file, as the caller gave it.
    pub file: String,
    /// The line.
    pub line: usize,
    /// The column.
    pub column: usize,
}

impl Place {
    /// Returns the place of the byte `offset` of `text`; past the end means the end.
    pub fn of_byte(file: &str, text: &str, offset: usize) -> Self {
        let before = text.get(..offset.min(text.len())).unwrap_or(text);
        let line = before.matches('\n').count() + 1;
        let column = before.chars().rev().take_while(|&c| c != '\n').count() + 1;
        Self {
            file: file.to_owned(),
            line,
            column,
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}", self.file, self.line, self.column)
    }
}

/// A text that is not TOML, or not the expected TOML.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{place}: {message}")]
pub struct TextFault {
    /// The place of the fault.
    pub place: Place,
    /// The fault and, for a misspelt name, the nearest known one.
    pub message: String,
}

/// Reads a value from the TOML `text`; messages call the text `file`.
pub fn read<T: DeserializeOwned>(file: &str, text: &str) -> Result<T, TextFault> {
    toml::from_str(text).map_err(|error| TextFault {
        place: Place::of_byte(
            file,
            text,
            error.span().map_or(0, |Range { start, .. }| start),
        ),
        message: explain(error.message()),
    })
}

/// Puts the parser's message on one line; for an unknown name, adds the nearest expected one.
fn explain(message: &str) -> String {
    let one_line = message
        .lines()
        .map(str::trim)
        .collect::<Vec<_>>()
        .join("; ");
    if !one_line.starts_with("unknown ") {
        return one_line;
    }
    let mut names = one_line.split('`').skip(1).step_by(2);
    let unknown = names.next().unwrap_or_default();
    match nearest_name(unknown, names) {
        Some(name) => format!("{one_line}; remedy: did you mean `{name}`?"),
        None => one_line,
    }
}

/// Largest share of a word's letters that may be wrong for a likely suggestion.
///
/// A larger share suggests unrelated names. A smaller one misses two swapped letters in a short id
/// (`pegt`).
const MISSPELT_RATIO: f64 = 0.5;

/// Returns the name in `known` that `word` most likely stands for; `None` if no name is near.
///
/// The distance is the number of letters to insert, delete or change (Levenshtein 1966). A known
/// name that begins with the word counts as near. The first of equally near names wins.
pub fn nearest_name<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let word = word.to_lowercase();
    known
        .into_iter()
        .map(|name| (edit_distance(&word, name), name))
        .filter(|&(edit_distance, name)| {
            (!word.is_empty() && name.starts_with(&word))
                || edit_distance as f64 <= MISSPELT_RATIO * name.chars().count() as f64
        })
        .min_by_key(|&(edit_distance, _)| edit_distance)
        .map(|(_, name)| name)
}

/// Returns the one name in `known` that contains `word`; `None` if none does, or several do.
pub fn only_name_with<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let word = word.to_lowercase();
    let mut names = known
        .into_iter()
        .filter(|name| !word.is_empty() && name.contains(&word));
    names.next().filter(|_| names.next().is_none())
}

/// Returns the edit distance: the least number of letters to insert, delete or change to turn `a`
/// into `b`.
fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, from) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, &to) in b.iter().enumerate() {
            let changed = diagonal + usize::from(from != to);
            diagonal = row[j + 1];
            row[j + 1] = changed.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, serde::Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Sample {
        #[allow(dead_code, reason = "only its presence in the text matters")]
        wall_mm: f64,
    }

    #[test]
    fn edit_distances_are_the_textbook_ones() {
        assert_eq!(edit_distance("kitten", "sitting"), 3);
        assert_eq!(edit_distance("", "abc"), 3);
        assert_eq!(edit_distance("abc", ""), 3);
        assert_eq!(edit_distance("same", "same"), 0);
    }

    #[test]
    fn the_nearest_name_is_found_and_a_far_one_is_not_suggested() {
        let known = ["objet-connex350", "formlabs-form4", "prusa-mk4"];
        assert_eq!(
            nearest_name("objet-conex350", known),
            Some("objet-connex350")
        );
        assert_eq!(nearest_name("Prusa-MK3", known), Some("prusa-mk4"));
        assert_eq!(nearest_name("objet", known), Some("objet-connex350"));
        assert_eq!(nearest_name("ultimaker", known), None);
        assert_eq!(nearest_name("", known), None);
    }

    #[test]
    fn a_part_of_a_name_stands_for_the_only_name_that_has_it() {
        let known = ["objet-connex350", "formlabs-form4", "prusa-mk4"];
        assert_eq!(only_name_with("MK4", known), Some("prusa-mk4"));
        assert_eq!(only_name_with("o", known), None);
        assert_eq!(only_name_with("", known), None);
    }

    #[test]
    fn an_unknown_key_is_told_with_its_place_and_the_key_meant() {
        let fault = read::<Sample>("x.toml", "wall_mm = 1.0\nwal_mm = 2.0\n").unwrap_err();
        assert_eq!((fault.place.line, fault.place.column), (2, 1));
        assert!(
            fault
                .to_string()
                .starts_with("x.toml:2:1: unknown field `wal_mm`"),
            "{fault}"
        );
        assert!(
            fault.to_string().contains("did you mean `wall_mm`"),
            "{fault}"
        );
    }

    #[test]
    fn columns_count_characters_not_bytes() {
        let fault = read::<Sample>("x.toml", "wall_mm = \"µµ\" x").unwrap_err();
        assert_eq!((fault.place.line, fault.place.column), (1, 16));
    }

    #[test]
    fn a_fault_past_the_end_lies_at_the_end() {
        assert_eq!(
            Place::of_byte("f", "ab\nc", 99),
            Place {
                file: "f".into(),
                line: 2,
                column: 2
            }
        );
    }
}
