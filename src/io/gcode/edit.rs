//! Changes single words of a line, and leaves the rest as it is.

use super::words::split;

/// Decimals of a place of E: what slicers write.
const E_DECIMALS: usize = 5;
/// Steps of a written length, mm.
const LENGTH_STEPS: f64 = 1e4;

/// Returns the letter and the number of a line's command; `None` if it has none.
pub fn command_of(text: &[u8]) -> Option<(u8, u32)> {
    let (command, _) = split(text, 0)?;
    (command.after_dot == 0).then_some((command.letter, command.number))
}

/// Returns the number of a word of a line; `None` if it is not there.
pub fn word_of(text: &[u8], letter: u8) -> Option<f64> {
    let (_, line) = split(text, 0)?;
    let mut found = None;
    // A line that is no G-code was refused before.
    let _ = line.each_word(|own, value| {
        if own == letter {
            found = value;
        }
        Ok(())
    });
    found
}

/// Returns a length with the fewest decimals, up to four.
pub fn short(length_mm: f64) -> String {
    let rounded = (length_mm * LENGTH_STEPS).round() / LENGTH_STEPS;
    // Adding zero takes the sign off a negative one.
    format!("{}", rounded + 0.0)
}

/// Returns a line with another number in one of its words. A checksum would be wrong then, and is
/// left out.
pub fn replace_word(line: &[u8], letter: u8, value: f64) -> Vec<u8> {
    let comment = line.iter().position(|byte| *byte == b';');
    let (code, comment) = line.split_at(comment.unwrap_or(line.len()));
    let checksum = code.iter().position(|byte| *byte == b'*');
    let code = &code[..checksum.unwrap_or(code.len())];
    let mut is_remark = false;
    let start = code.iter().position(|byte| {
        is_remark = match byte {
            b'(' => true,
            b')' => false,
            _ => is_remark,
        };
        !is_remark && byte.to_ascii_uppercase() == letter
    });
    let Some(start) = start else {
        return line.to_owned();
    };
    let is_part = |byte: &u8| byte.is_ascii_digit() || b"+-.".contains(byte);
    let (head, rest) = code.split_at(start + 1);
    let rest = rest.trim_ascii_start();
    let end = rest.iter().position(|byte| !is_part(byte));
    let (number, tail) = rest.split_at(end.unwrap_or(rest.len()));
    let dot = number.iter().position(|byte| *byte == b'.');
    let own = dot.map_or(0, |dot| number.len() - dot - 1);
    let decimals = own.max(E_DECIMALS);
    let number = format!("{value:.decimals$}");
    [head, number.as_bytes(), tail, comment].concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_word_is_replaced_and_all_else_stays() {
        for (line, want) in [
            ("G1 X1 Y2 E3.5 F900 ; Edge", "G1 X1 Y2 E1.25000 F900 ; Edge"),
            ("g1x1e3.5f900", "g1x1e1.25000f900"),
            ("G1 (E7) E 3.1234567 F9", "G1 (E7) E1.2500000 F9"),
            ("N3 G1 E-2*71", "N3 G1 E1.25000"),
            ("G1 E3\r", "G1 E1.25000\r"),
            ("G1 X4", "G1 X4"),
        ] {
            let found = replace_word(line.as_bytes(), b'E', 1.25);
            assert_eq!(String::from_utf8(found).unwrap(), want);
        }
    }

    #[test]
    fn commands_and_words_are_found_in_a_line() {
        assert_eq!(command_of(b"N4 g01 X1"), Some((b'G', 1)));
        assert_eq!(command_of(b"G91.1"), None);
        assert_eq!(word_of(b"G1 X1 F1800 ; F3", b'F'), Some(1800.0));
        assert_eq!(word_of(b"G1 X1", b'F'), None);
    }

    #[test]
    fn lengths_have_no_needless_digits() {
        let found = [1.0, -0.000_01, 12.345_67, 0.1 + 0.2].map(short);
        assert_eq!(found, ["1", "0", "12.3457", "0.3"]);
    }
}
