//! TOML text read into plain data; every fault is told with its line, its column and the nearest
//! known name.

use std::{fmt, ops::Range};

use serde::de::DeserializeOwned;

/// Where in a text file something stands; lines and columns count from 1, columns in characters.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// The file, as the reader was told to call it.
    pub file: String,
    /// The line.
    pub line: usize,
    /// The column.
    pub column: usize,
}

impl Place {
    /// The place of the byte `offset` of `text`; past the end means the end.
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

/// A text that is not TOML, or not the TOML that was asked for.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{place}: {message}")]
pub struct TextFault {
    /// Where it went wrong.
    pub place: Place,
    /// What went wrong, and which known name comes nearest to a misspelt one.
    pub message: String,
}

/// The value described by the TOML `text`, which messages call `file`.
pub fn read<T: DeserializeOwned>(file: &str, text: &str) -> Result<T, TextFault> {
    toml::from_str(text).map_err(|error| TextFault {
        place: Place::of_byte(
            file,
            text,
            error.span().map_or(0, |Range { start, .. }| start),
        ),
        message: explained(error.message()),
    })
}

/// The parser's message on one line; for an unknown name, the nearest of the expected ones is
/// added.
fn explained(message: &str) -> String {
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
    match nearest(unknown, names) {
        Some(name) => format!("{one_line}; remedy: did you mean `{name}`?"),
        None => one_line,
    }
}

/// Share of a word's letters that may be wrong for a suggestion still to be likely.
///
/// Above it unrelated names are suggested; below it two letters swapped in a short id (`pegt`) are
/// missed.
const MISSPELT_RATIO: f64 = 0.5;

/// The one of `known` that `word` most likely stands for; none if nothing is near.
///
/// Nearness is the number of letters to insert, delete or change (Levenshtein 1966); a known name
/// that begins with the word counts as near. The first of equally near names wins.
pub fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let word = word.to_lowercase();
    known
        .into_iter()
        .map(|name| (edits(&word, name), name))
        .filter(|&(edits, name)| {
            (!word.is_empty() && name.starts_with(&word))
                || edits as f64 <= MISSPELT_RATIO * name.chars().count() as f64
        })
        .min_by_key(|&(edits, _)| edits)
        .map(|(_, name)| name)
}

/// The least number of letters to insert, delete or change that makes `a` into `b`.
fn edits(a: &str, b: &str) -> usize {
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
        assert_eq!(edits("kitten", "sitting"), 3);
        assert_eq!(edits("", "abc"), 3);
        assert_eq!(edits("abc", ""), 3);
        assert_eq!(edits("same", "same"), 0);
    }

    #[test]
    fn the_nearest_name_is_found_and_a_far_one_is_not_suggested() {
        let known = ["objet-connex350", "formlabs-form4", "prusa-mk4"];
        assert_eq!(nearest("objet-conex350", known), Some("objet-connex350"));
        assert_eq!(nearest("Prusa-MK3", known), Some("prusa-mk4"));
        assert_eq!(nearest("objet", known), Some("objet-connex350"));
        assert_eq!(nearest("ultimaker", known), None);
        assert_eq!(nearest("", known), None);
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
