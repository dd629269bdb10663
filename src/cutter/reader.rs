//! The checks of a profile's values one by one; all faults are collected.

use std::ops::RangeInclusive;

use serde::Deserialize;
use toml::Spanned;

use super::error::{Fault, Faults, Problem, ProfileError, suggest};
use super::material::{SheetMaterial, has_chlorine};
use crate::base::sourced::{Sourced, Sure};
use crate::base::toml_text::{self, Place, TextFault};

/// A value with its source, as written.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ValueText<T> {
    pub value: T,
    pub source: Option<String>,
    pub sure: Option<Sure>,
}

/// A number's key and its plausible range.
#[derive(Debug, Clone)]
pub(super) struct Key {
    pub name: String,
    pub range: RangeInclusive<f64>,
}

impl Key {
    pub fn new(name: &str, range: RangeInclusive<f64>) -> Self {
        Self {
            name: name.to_owned(),
            range,
        }
    }
}

/// A value whose numbers are checked.
pub(super) trait Numbers: Clone {
    fn numbers(&self) -> Vec<f64>;
}

impl Numbers for f64 {
    fn numbers(&self) -> Vec<f64> {
        vec![*self]
    }
}

impl Numbers for [f64; 2] {
    fn numbers(&self) -> Vec<f64> {
        self.to_vec()
    }
}

impl Numbers for bool {
    fn numbers(&self) -> Vec<f64> {
        Vec::new()
    }
}

/// A file being checked: its name, its text, and the faults found so far.
pub(super) struct Reader<'a> {
    pub file: &'a str,
    text: &'a str,
    faults: Vec<Fault>,
}

impl<'a> Reader<'a> {
    pub fn new(file: &'a str, text: &'a str) -> Self {
        Self {
            file,
            text,
            faults: Vec::new(),
        }
    }

    pub fn parse<T: serde::de::DeserializeOwned>(&self) -> Result<T, TextFault> {
        toml_text::read(self.file, self.text)
    }

    /// Notes a problem with the value that begins at the byte `offset`.
    pub fn note(&mut self, offset: usize, problem: Problem) {
        self.faults.push(Fault {
            place: Place::of_byte(self.file, self.text, offset),
            problem,
        });
    }

    /// Takes over the faults of another file.
    pub fn take_faults(&mut self, other: Reader) {
        self.faults.extend(other.faults);
    }

    /// Fails with the noted faults, if there are any.
    pub fn refuse_faults(&mut self) -> Result<(), ProfileError> {
        if self.faults.is_empty() {
            Ok(())
        } else {
            Err(Faults(std::mem::take(&mut self.faults)).into())
        }
    }

    /// Returns a text for people; notes a blank one.
    pub fn words(&mut self, key: &'static str, text: &Spanned<String>) -> String {
        if text.get_ref().trim().is_empty() {
            self.note(text.span().start, Problem::Empty(key));
        }
        text.get_ref().clone()
    }

    /// Returns an id; notes one that is unfit for file names.
    pub fn id(&mut self, id: &Spanned<String>) -> String {
        let is_fit = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
        if id.get_ref().is_empty() || !id.get_ref().chars().all(is_fit) {
            self.note(id.span().start, Problem::BadId(id.get_ref().clone()));
        }
        id.get_ref().clone()
    }

    /// Returns a sheet material; notes one that is unknown or must not be cut.
    pub fn material(&mut self, text: &Spanned<String>) -> Option<SheetMaterial> {
        let (at, word) = (text.span().start, text.get_ref());
        if has_chlorine(word) {
            self.note(at, Problem::Chlorine(word.clone()));
            return None;
        }
        let found = word.parse().ok();
        if found.is_none() {
            let remedy = suggest(word, SheetMaterial::WORDS);
            let material = word.clone();
            self.note(at, Problem::UnknownMaterial { material, remedy });
        }
        found
    }

    /// Returns the value with its source; notes everything missing or implausible.
    pub fn value<T: Numbers>(
        &mut self,
        key: &Key,
        text: &Spanned<ValueText<T>>,
    ) -> Option<Sourced<T>> {
        let (at, text) = (text.span().start, text.get_ref());
        for number in text.value.numbers() {
            self.check_number(at, key, number);
        }
        let source = text.source.clone();
        let source = source.filter(|source| !source.trim().is_empty());
        if source.is_none() {
            self.note(at, Problem::NoSource(key.name.clone()));
        }
        if text.sure.is_none() {
            self.note(at, Problem::NotSure(key.name.clone()));
        }
        Some(Sourced {
            value: text.value.clone(),
            source: source?,
            sure: text.sure?,
            process_default_of: None,
        })
    }

    /// Notes a number that is not positive and finite, or not plausible.
    pub fn check_number(&mut self, at: usize, Key { name, range }: &Key, value: f64) {
        let key = name.clone();
        if !(value.is_finite() && value > 0.0) {
            self.note(at, Problem::NotPositive { key, value });
        } else if !range.contains(&value) {
            let (least, most) = (*range.start(), *range.end());
            self.note(
                at,
                Problem::Implausible {
                    key,
                    value,
                    least,
                    most,
                },
            );
        }
    }

    /// Returns a required value; notes a missing one.
    pub fn required<T>(&mut self, key: &'static str, value: Option<T>) -> Option<T> {
        if value.is_none() {
            self.note(0, Problem::Missing(key));
        }
        value
    }
}
