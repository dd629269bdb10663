//! The bytes of a volume mesh: numbers are read, and a wrong one is told with its place.

use super::super::values::{Form, Kind, Values};
use super::error::{Place, VolumeError};
use crate::geom::Point;

/// Most characters of a wrong text that are shown.
const SHOWN: usize = 20;
/// Greatest whole number that a double holds exactly.
const MOST_EXACT: f64 = 9_007_199_254_740_992.0;
/// Least bytes of a number in text: a digit and a blank.
const TEXT_BYTES: usize = 2;

/// A file that is being read.
pub(super) struct Source<'a> {
    bytes: &'a [u8],
    pub values: Values<'a>,
}

impl<'a> Source<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        let values = Values::new(bytes, Form::Text);
        Self { bytes, values }
    }

    /// Returns the place of an offset.
    pub fn place(&self, offset: usize) -> Place {
        if self.values.form != Form::Text {
            return Place::Byte(offset);
        }
        line_at(self.bytes, offset)
    }

    /// Returns the place of the next word.
    pub fn here(&mut self) -> Place {
        let offset = self.begin();
        self.place(offset)
    }

    /// Returns the offset of the next value.
    pub fn begin(&mut self) -> usize {
        if self.values.form == Form::Text {
            self.values.skip_blanks();
        }
        self.values.offset()
    }

    /// Returns the error of something else in the place of what is expected.
    pub fn wrong(&self, offset: usize, expected: &'static str) -> VolumeError {
        let place = self.place(offset);
        let rest = self.bytes.get(offset..).unwrap_or_default();
        if rest.is_empty() {
            return VolumeError::Cut { place, expected };
        }
        let line = rest.split(|&byte| byte == b'\n').next().unwrap_or_default();
        let text = String::from_utf8_lossy(&line[..line.len().min(4 * SHOWN)]);
        let found = text.chars().take(SHOWN).collect();
        VolumeError::Expected {
            place,
            expected,
            found,
        }
    }

    /// Reads a number that may be anything but absent.
    pub fn number(&mut self, kind: Kind, what: &'static str) -> Result<f64, VolumeError> {
        let at = self.begin();
        self.values.number(kind).ok_or_else(|| self.wrong(at, what))
    }

    /// Reads a whole number, not negative.
    pub fn whole(&mut self, kind: Kind, what: &'static str) -> Result<u64, VolumeError> {
        let at = self.begin();
        let number = self.number(kind, what)?;
        let is_whole = number.fract() == 0.0 && (0.0..MOST_EXACT).contains(&number);
        if !is_whole {
            return Err(self.wrong(at, what));
        }
        Ok(number as u64)
    }

    /// Reads a finite number.
    pub fn finite(&mut self, kind: Kind, what: &'static str) -> Result<f64, VolumeError> {
        let at = self.begin();
        let number = self.number(kind, what)?;
        if !number.is_finite() {
            return Err(self.wrong(at, what));
        }
        Ok(number)
    }

    /// Reads three finite coordinates.
    pub fn point(&mut self, kind: Kind) -> Result<Point, VolumeError> {
        let mut coordinate = || self.finite(kind, "three finite coordinates");
        Ok(Point::new(coordinate()?, coordinate()?, coordinate()?))
    }

    /// Reads a whole number that stands as text in a binary file too.
    pub fn text_whole(&mut self, what: &'static str) -> Result<u64, VolumeError> {
        self.values.skip_blanks();
        let at = self.values.offset();
        let word = self.values.word().unwrap_or_default();
        let text = std::str::from_utf8(word).ok();
        let number = text.and_then(|text| text.parse().ok());
        number.ok_or_else(|| self.wrong(at, what))
    }

    /// Reads a word that stands as text in a binary file too; lossy if it is no UTF-8.
    pub fn text_word(&mut self, what: &'static str) -> Result<String, VolumeError> {
        self.values.skip_blanks();
        let at = self.values.offset();
        let word = self.values.word().ok_or_else(|| self.wrong(at, what))?;
        Ok(String::from_utf8_lossy(word).into_owned())
    }

    /// Checks a count that the file claims against the bytes that are left for it.
    ///
    /// # Errors
    /// It cannot hold so many of these kinds.
    pub fn claim(
        &self,
        claimed: u64,
        each: &[Kind],
        what: &'static str,
    ) -> Result<usize, VolumeError> {
        let bytes = self.values.left().len();
        let least = match self.values.form {
            Form::Text => TEXT_BYTES * each.len(),
            _ => each.iter().map(|kind| kind.bytes()).sum(),
        };
        // The last number needs no blank behind it.
        let fits = u128::from(claimed) * least as u128 <= bytes as u128 + 1;
        if !fits {
            return Err(VolumeError::Claims {
                place: self.place(self.values.offset()),
                what,
                claimed,
                bytes,
            });
        }
        Ok(claimed as usize)
    }
}

/// Returns the line of an offset.
pub(super) fn line_at(bytes: &[u8], offset: usize) -> Place {
    let before = &bytes[..offset.min(bytes.len())];
    Place::Line(1 + before.iter().filter(|&&byte| byte == b'\n').count())
}
