//! Heatshrink: literals and references to earlier text, as bits from the highest on.

/// Bits of the length of a reference, in every file of Prusa's.
const LENGTH_BITS: u32 = 4;
/// Bits of a literal.
const LITERAL_BITS: u32 = 8;

/// Unpacks up to `most` bytes; stops early at the end of the data.
///
/// A reference has `window_bits` bits for its distance. One that leads before the start finds
/// zeros, as in the original.
pub fn decode(data: &[u8], window_bits: u32, most: usize) -> Vec<u8> {
    let mut bits = Bits { data, at: 0 };
    let mut text: Vec<u8> = Vec::new();
    while text.len() < most {
        let Some(read) = bits.take(1) else {
            break;
        };
        if read == 1 {
            let Some(literal) = bits.take(LITERAL_BITS) else {
                break;
            };
            text.push(literal as u8);
            continue;
        }
        let (Some(distance), Some(length)) = (bits.take(window_bits), bits.take(LENGTH_BITS))
        else {
            break;
        };
        for _ in 0..(length + 1).min(most - text.len()) {
            let from = text.len().checked_sub(distance + 1);
            text.push(from.map_or(0, |from| text[from]));
        }
    }
    text
}

/// The bits not yet read.
struct Bits<'a> {
    data: &'a [u8],
    at: usize,
}

impl Bits<'_> {
    /// Reads a number of some bits; `None` if the data end before.
    fn take(&mut self, count: u32) -> Option<usize> {
        let mut value = 0;
        for _ in 0..count {
            let byte = self.data.get(self.at / 8)?;
            let bit = byte >> (7 - self.at % 8) & 1;
            value = value << 1 | usize::from(bit);
            self.at += 1;
        }
        Some(value)
    }
}
