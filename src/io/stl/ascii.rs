//! Reads ASCII STL as programs write it: any case, any blanks, several solids, names in any
//! encoding.

use super::error::StlError;
use crate::geom::Point;

/// The mark that some editors put before UTF-8 text.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// Number of bytes searched to tell ASCII from a binary file whose header says "solid". Enough for
/// a long name and the first facet.
const PROBE_BYTES: usize = 4096;

/// Returns true if the content begins like an ASCII STL file: the word "solid" in any case, and no
/// zero byte nearby.
///
/// A truncated binary file may begin with the word too, but its numbers contain zero bytes.
pub(crate) fn is_ascii(bytes: &[u8]) -> bool {
    let text = bytes
        .strip_prefix(BYTE_ORDER_MARK)
        .unwrap_or(bytes)
        .trim_ascii_start();
    let begins = text
        .get(..5)
        .is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    let ends = text.get(5).is_none_or(u8::is_ascii_whitespace);
    begins && ends && !bytes[..bytes.len().min(PROBE_BYTES)].contains(&0)
}

/// Returns the corners of the facets of all solids, three for each facet.
pub(super) fn decode(bytes: &[u8]) -> Result<Vec<Point>, StlError> {
    let text = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
    let mut reader = Reader {
        rest: text,
        line: 1,
        facet: 0,
    };
    let mut corners = Vec::new();
    while let Some(word) = reader.word() {
        reader.must_be(word, "solid")?;
        reader.skip_line();
        reader.solid(&mut corners)?;
    }
    Ok(corners)
}

/// The text not yet read, with the current line and facet.
struct Reader<'a> {
    rest: &'a [u8],
    line: usize,
    facet: usize,
}

impl<'a> Reader<'a> {
    /// Reads the facets up to `endsolid`.
    fn solid(&mut self, corners: &mut Vec<Point>) -> Result<(), StlError> {
        loop {
            let word = self.word().ok_or_else(|| self.cut_off("endsolid"))?;
            if word.eq_ignore_ascii_case(b"endsolid") {
                self.skip_line();
                return Ok(());
            }
            self.facet += 1;
            self.must_be(word, "facet")?;
            self.facet(corners)?;
        }
    }

    /// Reads a facet after its first word.
    fn facet(&mut self, corners: &mut Vec<Point>) -> Result<(), StlError> {
        self.expect("normal")?;
        for _ in 0..3 {
            self.word().ok_or_else(|| self.cut_off("a facet normal"))?;
        }
        self.expect("outer")?;
        self.expect("loop")?;
        for _ in 0..3 {
            self.expect("vertex")?;
            corners.push(Point::new(self.number()?, self.number()?, self.number()?));
        }
        self.expect("endloop")?;
        self.expect("endfacet")
    }

    fn expect(&mut self, expected: &'static str) -> Result<(), StlError> {
        let word = self.word().ok_or_else(|| self.cut_off(expected))?;
        self.must_be(word, expected)
    }

    fn must_be(&self, word: &[u8], expected: &'static str) -> Result<(), StlError> {
        if word.eq_ignore_ascii_case(expected.as_bytes()) {
            Ok(())
        } else {
            Err(self.unexpected_word(word, expected))
        }
    }

    fn number(&mut self) -> Result<f64, StlError> {
        let expected = "a coordinate";
        let word = self.word().ok_or_else(|| self.cut_off(expected))?;
        let number = std::str::from_utf8(word)
            .ok()
            .and_then(|word| word.parse().ok());
        number.ok_or_else(|| self.unexpected_word(word, expected))
    }

    fn unexpected_word(&self, word: &[u8], expected: &'static str) -> StlError {
        let found = String::from_utf8_lossy(&word[..word.len().min(MAX_QUOTED_BYTES)]).into_owned();
        StlError::Unexpected {
            line: self.line,
            facet: self.facet,
            expected,
            found,
        }
    }

    fn cut_off(&self, expected: &'static str) -> StlError {
        StlError::Cut {
            line: self.line,
            facet: self.facet,
            expected,
        }
    }

    /// Reads the next word; `None` at the end.
    fn word(&mut self) -> Option<&'a [u8]> {
        let start = self
            .rest
            .iter()
            .position(|b| !is_blank(*b))
            .unwrap_or(self.rest.len());
        self.line += self.rest[..start].iter().filter(|&&b| b == b'\n').count();
        let rest = &self.rest[start..];
        let end = rest.iter().position(|b| is_blank(*b)).unwrap_or(rest.len());
        self.rest = &rest[end..];
        (end > 0).then(|| &rest[..end])
    }

    /// Skips the rest of the line: the name of a solid.
    fn skip_line(&mut self) {
        let end = self
            .rest
            .iter()
            .position(|&b| b == b'\n' || b == b'\r')
            .unwrap_or(self.rest.len());
        self.rest = &self.rest[end..];
    }
}

/// Longest excerpt of an unexpected word in a message, bytes.
const MAX_QUOTED_BYTES: usize = 40;

/// Returns true if the byte separates words.
fn is_blank(byte: u8) -> bool {
    byte.is_ascii_whitespace() || byte == 0x0b
}
