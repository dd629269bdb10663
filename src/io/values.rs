//! Numbers as files hold them: words of text, or binary in either order of bytes.

/// The encoding of the numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    Text,
    LittleEndian,
    BigEndian,
}

/// The type of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

impl Kind {
    /// Returns the bytes of a binary number.
    pub fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }

    /// Returns true for the types of whole numbers.
    pub fn is_whole(self) -> bool {
        !matches!(self, Self::F32 | Self::F64)
    }
}

/// The bytes of a file, and how far they are read.
#[derive(Debug, Clone)]
pub(super) struct Values<'a> {
    rest: &'a [u8],
    whole: usize,
    pub form: Form,
}

impl<'a> Values<'a> {
    pub fn new(bytes: &'a [u8], form: Form) -> Self {
        Self {
            rest: bytes,
            whole: bytes.len(),
            form,
        }
    }

    /// Returns the bytes that are read.
    pub fn offset(&self) -> usize {
        self.whole - self.rest.len()
    }

    /// Returns the bytes that are left.
    pub fn left(&self) -> &'a [u8] {
        self.rest
    }

    /// Passes over bytes, at most to the end.
    pub fn skip(&mut self, bytes: usize) {
        self.rest = self.rest.get(bytes..).unwrap_or_default();
    }

    /// Passes over blanks and line breaks.
    pub fn skip_blanks(&mut self) {
        self.rest = self.rest.trim_ascii_start();
    }

    /// Reads the next word; `None` at the end.
    pub fn word(&mut self) -> Option<&'a [u8]> {
        let text = self.rest.trim_ascii_start();
        let end = text
            .iter()
            .position(u8::is_ascii_whitespace)
            .unwrap_or(text.len());
        let (word, rest) = text.split_at(end);
        self.rest = rest;
        (!word.is_empty()).then_some(word)
    }

    /// Reads the rest of the line and passes over its end.
    pub fn line(&mut self) -> &'a [u8] {
        let end = self.rest.iter().position(|&byte| byte == b'\n');
        let (line, rest) = match end {
            Some(end) => (&self.rest[..end], &self.rest[end + 1..]),
            None => (self.rest, &[][..]),
        };
        self.rest = rest;
        line.trim_ascii()
    }

    /// Reads the next number; NaN if a word is not a number, `None` at the end.
    pub fn number(&mut self, kind: Kind) -> Option<f64> {
        if self.form == Form::Text {
            let word = self.word()?;
            let number = || std::str::from_utf8(word).ok()?.parse().ok();
            return Some(number().unwrap_or(f64::NAN));
        }
        Some(match kind {
            Kind::I8 => f64::from(i8::from_le_bytes(self.bytes()?)),
            Kind::U8 => f64::from(u8::from_le_bytes(self.bytes()?)),
            Kind::I16 => f64::from(i16::from_le_bytes(self.bytes()?)),
            Kind::U16 => f64::from(u16::from_le_bytes(self.bytes()?)),
            Kind::I32 => f64::from(i32::from_le_bytes(self.bytes()?)),
            Kind::U32 => f64::from(u32::from_le_bytes(self.bytes()?)),
            Kind::I64 => i64::from_le_bytes(self.bytes()?) as f64,
            Kind::U64 => u64::from_le_bytes(self.bytes()?) as f64,
            Kind::F32 => f64::from(f32::from_le_bytes(self.bytes()?)),
            Kind::F64 => f64::from_le_bytes(self.bytes()?),
        })
    }

    /// Reads the next `N` bytes and returns them in little-endian order.
    fn bytes<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (bytes, rest) = self.rest.split_first_chunk::<N>()?;
        self.rest = rest;
        let mut bytes = *bytes;
        if self.form == Form::BigEndian {
            bytes.reverse();
        }
        Some(bytes)
    }
}
