//! MeatPack: two of the most frequent characters of G-code in one byte.

/// The characters of the codes 0 to 14; 15 means that the character follows as a whole byte.
const CHARACTERS: &[u8; 15] = b"0123456789. \nGX";
/// The code of a blank, which stands for `E` in text without blanks.
const BLANK: u8 = 11;
/// The code of a whole byte.
const WHOLE: u8 = 15;
/// Twice this byte announces a command.
const SIGNAL: u8 = 0xff;

/// Commands after two signals.
const PACK: u8 = 251;
const PLAIN: u8 = 250;
const RESET: u8 = 249;
const NO_BLANKS: u8 = 247;
const BLANKS: u8 = 246;

/// Unpacks a block of text.
pub fn decode(data: &[u8]) -> Vec<u8> {
    let mut decoder = Decoder::default();
    let mut signals = 0;
    for &byte in data {
        match (byte, signals) {
            (SIGNAL, 0 | 1) => signals += 1,
            (_, 2) => {
                decoder.command(byte);
                signals = 0;
            }
            _ => {
                if signals == 1 {
                    decoder.take(SIGNAL);
                }
                decoder.take(byte);
                signals = 0;
            }
        }
    }
    decoder.text
}

#[derive(Default)]
struct Decoder {
    text: Vec<u8>,
    is_packed: bool,
    has_no_blanks: bool,
    /// Whole bytes that follow.
    whole: u8,
    /// The second character of a pair whose first follows as a whole byte.
    second: Option<u8>,
}

impl Decoder {
    fn command(&mut self, command: u8) {
        match command {
            PACK => self.is_packed = true,
            PLAIN | RESET => self.is_packed = false,
            NO_BLANKS => self.has_no_blanks = true,
            BLANKS => self.has_no_blanks = false,
            _ => {}
        }
    }

    fn take(&mut self, byte: u8) {
        if !self.is_packed {
            self.text.push(byte);
        } else if self.whole > 0 {
            self.whole -= 1;
            self.text.push(byte);
            self.text.extend(self.second.take());
        } else {
            self.take_pair(byte & 0x0f, byte >> 4);
        }
    }

    /// Takes two codes. The second is void after the end of a line.
    fn take_pair(&mut self, first: u8, second: u8) {
        let later = (second != WHOLE).then(|| self.character(second));
        if first == WHOLE {
            (self.whole, self.second) = (1 + u8::from(later.is_none()), later);
            return;
        }
        let character = self.character(first);
        self.text.push(character);
        if character != b'\n' {
            self.text.extend(later);
            self.whole += u8::from(later.is_none());
        }
    }

    fn character(&self, code: u8) -> u8 {
        if code == BLANK && self.has_no_blanks {
            b'E'
        } else {
            CHARACTERS[usize::from(code)]
        }
    }
}
