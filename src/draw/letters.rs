//! The room that words take, without a font at hand.

/// Widths of letters in heights of the words, and the letters of each. They are those of DejaVu
/// Sans, rounded up: it is wider than other common fonts.
const WIDTHS: [(f64, &str); 6] = [
    (0.28, "ijl'"),
    (0.34, " .,:;|I/\u{a0}"),
    (0.42, "tfr()[]-!"),
    (0.53, "sz°"),
    (0.62, "acekvxy"),
    (1.0, "mwMW%@⌀±×≤≥—"),
];
/// Width of any other capital letter, in heights of the words.
const CAPITAL_TEXTS: f64 = 0.79;
/// Width of any other letter or digit, in heights of the words.
const OTHER_TEXTS: f64 = 0.64;

/// Returns the width of words in heights of the words. No common sans-serif font is wider.
pub fn width_texts(words: &str) -> f64 {
    words.chars().map(letter_texts).sum()
}

fn letter_texts(letter: char) -> f64 {
    let known = WIDTHS.iter().find(|(_, letters)| letters.contains(letter));
    match known {
        Some((width, _)) => *width,
        None if letter.is_uppercase() => CAPITAL_TEXTS,
        None => OTHER_TEXTS,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_length_takes_no_less_room_than_in_a_wide_font() {
        // By the tables of DejaVu Sans: 5.402 heights.
        let wide = width_texts("y 99.4 mm");
        assert!((5.402..5.7).contains(&wide), "{wide}");
    }
}
