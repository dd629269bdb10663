//! Words of a command: a letter and a number each, as firmware reads them.

use super::error::GcodeError;

/// The greatest number of a word that counts, mm; a million metres of filament for E.
const MOST: f64 = 1e9;
/// Powers of ten that are exact.
const POWERS: [f64; 20] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19,
];
/// Whole numbers up to here are exact.
const EXACT: u64 = 1 << 53;
/// Bytes of a text that a message quotes.
const QUOTED: usize = 20;

/// The command that a line begins with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Command {
    /// Its letter, a capital.
    pub letter: u8,
    /// Its number.
    pub number: u32,
    /// The number after its dot; 0 for none.
    pub after_dot: u32,
}

/// A line of a program, without its number, comment and checksum.
#[derive(Debug, Clone, Copy)]
pub struct Line<'a> {
    /// The text after the command.
    pub rest: &'a [u8],
    /// The line, from 1.
    pub number: u64,
}

/// Splits the command off a line; `None` if there is none, as in a macro of the firmware.
///
/// Passes over a line number (`N12`). The text ends at a comment or a checksum.
pub fn split(text: &[u8], number: u64) -> Option<(Command, Line<'_>)> {
    let mut text = text.trim_ascii_start();
    if let [b'N' | b'n', b'0'..=b'9', ..] = text {
        let (_, after) = digits(&text[1..]);
        text = after.trim_ascii_start();
    }
    let (first, after) = text.split_first()?;
    let letter = first.to_ascii_uppercase();
    let (value, after) = digits(after);
    let value = value?;
    let (after_dot, after) = match after {
        [b'.', fraction @ ..] => digits(fraction),
        _ => (None, after),
    };
    let is_macro = after.first() == Some(&b'_');
    let command = Command {
        letter,
        number: u32::try_from(value).ok()?,
        after_dot: u32::try_from(after_dot.unwrap_or(0)).ok()?,
    };
    let line = Line {
        rest: after,
        number,
    };
    (letter.is_ascii_uppercase() && !is_macro).then_some((command, line))
}

/// Reads the digits that a text begins with; saturates far beyond every use.
fn digits(text: &[u8]) -> (Option<u64>, &[u8]) {
    let end = text.iter().position(|byte| !byte.is_ascii_digit());
    let (digits, rest) = text.split_at(end.unwrap_or(text.len()));
    let add = |sum: u64, digit: &u8| {
        sum.saturating_mul(10)
            .saturating_add(u64::from(digit - b'0'))
    };
    let value = (!digits.is_empty()).then(|| digits.iter().fold(0, add));
    (value, rest)
}

impl Line<'_> {
    /// Calls `take` with every letter and its number; a letter without a number has `None`.
    ///
    /// Numbers have no exponent: firmware takes `X1E5` for X1 and E5.
    pub fn each_word(
        &self,
        mut take: impl FnMut(u8, Option<f64>) -> Result<(), GcodeError>,
    ) -> Result<(), GcodeError> {
        let mut rest = self.rest;
        loop {
            rest = rest.trim_ascii_start();
            let Some((first, after)) = rest.split_first() else {
                return Ok(());
            };
            match first.to_ascii_uppercase() {
                b';' | b'*' => return Ok(()),
                b'(' => {
                    let end = after.iter().position(|byte| *byte == b')');
                    rest = end.map_or(&[][..], |end| &after[end + 1..]);
                }
                b'G' | b'M' => return Err(self.second_command(rest)),
                letter @ b'A'..=b'Z' => {
                    let (value, after) = self.number(letter, after)?;
                    take(letter, value)?;
                    rest = after;
                }
                _ => return Err(self.no_number(*first, rest)),
            }
        }
    }

    /// Reads the number of a word, and returns it with the text after it.
    fn number<'t>(
        &self,
        letter: u8,
        text: &'t [u8],
    ) -> Result<(Option<f64>, &'t [u8]), GcodeError> {
        let is_part = |byte: &u8| byte.is_ascii_digit() || matches!(byte, b'+' | b'-' | b'.');
        let is_end = |byte: &u8| byte.is_ascii_whitespace() || matches!(byte, b';' | b'*' | b'(');
        let ends = |text: &[u8]| text.first().is_none_or(is_end);
        let near = text.trim_ascii_start();
        let end = near.iter().position(|byte| !is_part(byte));
        let (digits, rest) = near.split_at(end.unwrap_or(near.len()));
        if digits.is_empty() && ends(text) {
            return Ok((None, rest));
        }
        let is_next = ends(rest) || rest.first().is_some_and(u8::is_ascii_alphabetic);
        let value = decimal(digits).filter(|_| is_next);
        let value = value.ok_or_else(|| self.no_number(letter, text))?;
        if value.abs() > MOST {
            return Err(GcodeError::TooFar {
                line: self.number,
                letter: char::from(letter),
                value,
            });
        }
        Ok((Some(value), rest))
    }

    fn no_number(&self, letter: u8, text: &[u8]) -> GcodeError {
        if !(b' '..0x7f).contains(&letter) || text.contains(&0) {
            return GcodeError::NotText { line: self.number };
        }
        GcodeError::Number {
            line: self.number,
            letter: char::from(letter),
            found: quoted(text)
                .split_whitespace()
                .next()
                .unwrap_or_default()
                .to_owned(),
        }
    }

    fn second_command(&self, text: &[u8]) -> GcodeError {
        GcodeError::TwoCommands {
            line: self.number,
            found: quoted(text),
        }
    }
}

/// Returns the start of a text for a message.
fn quoted(text: &[u8]) -> String {
    let text = &text[..text.len().min(QUOTED)];
    String::from_utf8_lossy(text).trim().to_owned()
}

/// Returns a decimal number without an exponent, rounded correctly; `None` if it is none.
pub fn decimal(text: &[u8]) -> Option<f64> {
    let (is_negative, digits) = match text {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        _ => (false, text),
    };
    let (mut mantissa, mut places, mut has_dot, mut count) = (0u64, 0usize, false, 0usize);
    for byte in digits {
        match byte {
            b'0'..=b'9' if mantissa < EXACT / 16 => {
                mantissa = 10 * mantissa + u64::from(byte - b'0');
                places += usize::from(has_dot);
                count += 1;
            }
            b'.' if !has_dot => has_dot = true,
            b'0'..=b'9' => return std::str::from_utf8(text).ok()?.parse().ok(),
            _ => return None,
        }
    }
    let Some(scale) = POWERS.get(places) else {
        return std::str::from_utf8(text).ok()?.parse().ok();
    };
    let value = mantissa as f64 / scale;
    (count > 0).then_some(if is_negative { -value } else { value })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn words(text: &str) -> Result<Vec<(char, Option<f64>)>, GcodeError> {
        let (_, line) = split(text.as_bytes(), 7).unwrap();
        let mut all = Vec::new();
        line.each_word(|letter, value| {
            all.push((char::from(letter), value));
            Ok(())
        })?;
        Ok(all)
    }

    #[test]
    fn words_are_read_with_and_without_spaces_comments_and_checksums() {
        let want = vec![('X', Some(1.5)), ('Y', Some(-0.25)), ('E', Some(0.5))];
        for text in [
            "G1 X1.5 Y-.25 E.5",
            "g01x1.5y-.25e+.5",
            "N12 G1 X1.5Y-.25E0.50 ; X9",
            "  G1  X 1.5 (X8) Y -0.250 E .5*71",
            "G1 X1.5 Y-.25 E.5\r",
        ] {
            assert_eq!(words(text).unwrap(), want, "{text}");
        }
        assert_eq!(words("G28 X Y0").unwrap(), [('X', None), ('Y', Some(0.0))]);
    }

    #[test]
    fn a_number_has_no_exponent_as_in_firmware() {
        assert_eq!(
            words("G1 X1E5").unwrap(),
            [('X', Some(1.0)), ('E', Some(5.0))]
        );
    }

    #[test]
    fn a_command_is_split_off_and_macros_are_none() {
        let command =
            |text: &str| split(text.as_bytes(), 1).map(|(c, _)| (c.letter, c.number, c.after_dot));
        assert_eq!(command("M83"), Some((b'M', 83, 0)));
        assert_eq!(command("G90.1"), Some((b'G', 90, 1)));
        assert_eq!(command("T1 ; second"), Some((b'T', 1, 0)));
        assert_eq!(command("START_PRINT BED=60"), None);
        assert_eq!(command("G99999999999"), None);
        assert_eq!(command("; G1 X1"), None);
        assert_eq!(command(""), None);
    }

    #[test]
    fn faults_name_line_and_word() {
        let says = |text: &str| words(text).unwrap_err().to_string();
        assert!(
            says("G1 Xnan").contains("line 7: `X` is followed by \"nan\""),
            "{}",
            says("G1 Xnan")
        );
        assert!(says("G1 X1..5").contains("line 7: `X`"));
        assert!(says("G1 X--5").contains("line 7: `X`"));
        assert!(says(&format!("G1 X1{}", "0".repeat(308))).contains("beyond any printer"));
        assert!(says("G1 X1 G1 Y1").contains("second command follows at \"G1 Y1\""));
        assert!(says("G1 X1 \u{1}").contains("no text"));
    }

    proptest! {
        #[test]
        fn decimals_are_rounded_as_the_standard_library_does(text in "[+-]?[0-9]{0,20}(\\.[0-9]{0,20})?") {
            let want = text.parse::<f64>().ok();
            let got = decimal(text.as_bytes());
            prop_assert!(got == want, "{text} {got:?} {want:?}");
        }

        #[test]
        fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..60)) {
            if let Some((_, line)) = split(&bytes, 1) {
                let _ = line.each_word(|_, _| Ok(()));
            }
        }
    }
}
