//! The room that words take, without a font at hand.

/// Letters that are wider than others, in any common sans-serif font.
const WIDE: &str = "mwMW%@⌀±×≤≥—";
/// Letters that are about half as wide as others.
const NARROW: &str = " .,:;!'|()[]-/ijltfrI°\u{a0}";

/// Returns the width of words in heights of their letters. No common sans-serif font is wider:
/// the shares are those of DejaVu Sans, the widest of them, rounded up.
pub fn width_texts(words: &str) -> f64 {
    let letter = |letter: char| match letter {
        _ if WIDE.contains(letter) => 1.0,
        _ if NARROW.contains(letter) => 0.42,
        _ if letter.is_uppercase() => 0.79,
        _ => 0.64,
    };
    words.chars().map(letter).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_length_takes_no_less_room_than_in_a_wide_font() {
        // DejaVu Sans at 32 pixels, measured: 172.8 pixels.
        let wide_px = 32.0 * width_texts("y 99.4 mm");
        assert!((172.8..190.0).contains(&wide_px), "{wide_px}");
    }
}
