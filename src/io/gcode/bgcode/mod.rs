//! Prusa's binary G-code: blocks of text, packed, each with a checksum.
//!
//! The format is libbgcode's, version 1. The blocks come back as one text: settings as comments,
//! then the program.

mod heatshrink;
mod meatpack;

use std::io::Read;

use super::error::{GcodeError, package_fault, through_io};

/// The first bytes of a file.
pub const MAGIC: &[u8] = b"GCDE";
/// The only version of the format.
const VERSION: u32 = 1;
/// Bytes of the file's header after the magic number.
const HEADER_BYTES: usize = 6;
/// Most bytes of a block, packed or not. Slicers write blocks of 64 KiB, and some MiB of pictures.
const MOST_BYTES: usize = 1 << 26;

/// The numbers of the kinds of blocks.
const PROGRAM: u16 = 1;
const THUMBNAIL: u16 = 5;

/// The text of a binary file.
pub struct Text<R> {
    input: R,
    has_checksums: bool,
    /// Number of blocks read, for messages.
    blocks: u64,
    text: Vec<u8>,
    at: usize,
}

/// The header of a block.
struct Header {
    bytes: Vec<u8>,
    kind: u16,
    packing: u16,
    unpacked_bytes: usize,
    packed_bytes: usize,
}

impl<R: Read> Text<R> {
    /// Reads the header of a file.
    ///
    /// # Errors
    /// If the file is of another kind or version, or is cut off.
    pub fn open(mut input: R) -> Result<Self, GcodeError> {
        let fault = |reason: &str| package_fault("the header", reason);
        let magic = take(&mut input, MAGIC.len()).map_err(|reason| fault(&reason))?;
        let header = take(&mut input, HEADER_BYTES).map_err(|reason| fault(&reason))?;
        if magic != MAGIC || u32_at(&header, 0) != VERSION {
            return Err(fault("it is no binary G-code of version 1"));
        }
        let has_checksums = match u16_at(&header, 4) {
            0 => false,
            1 => true,
            _ => return Err(fault("its kind of checksum is not known")),
        };
        Ok(Self {
            input,
            has_checksums,
            blocks: 0,
            text: Vec::new(),
            at: 0,
        })
    }

    /// Reads the next block; returns false at the end of the file.
    fn next_block(&mut self) -> Result<bool, String> {
        self.blocks += 1;
        let Some(header) = Header::read(&mut self.input)? else {
            return Ok(false);
        };
        let parameter_bytes = if header.kind == THUMBNAIL { 6 } else { 2 };
        let parameters = take(&mut self.input, parameter_bytes)?;
        let data = take(&mut self.input, header.packed_bytes)?;
        if self.has_checksums {
            let stated = u32_at(&take(&mut self.input, 4)?, 0);
            let mut sum = crc32fast::Hasher::new();
            for bytes in [&header.bytes, &parameters, &data] {
                sum.update(bytes);
            }
            if sum.finalize() != stated {
                return Err("its checksum is wrong".to_owned());
            }
        }
        let encoding = u16_at(&parameters, 0);
        (self.text, self.at) = (header.text(data, encoding)?, 0);
        Ok(true)
    }
}

impl<R: Read> Read for Text<R> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        while self.at == self.text.len() {
            let read = self.next_block();
            let part = format!("block {}", self.blocks);
            if !read.map_err(|reason| through_io(package_fault(&part, reason)))? {
                return Ok(0);
            }
        }
        let rest = &self.text[self.at..];
        let length = rest.len().min(buffer.len());
        buffer[..length].copy_from_slice(&rest[..length]);
        self.at += length;
        Ok(length)
    }
}

impl Header {
    /// Reads the header of a block; `None` at the end of the file.
    fn read(input: &mut impl Read) -> Result<Option<Self>, String> {
        let mut first = [0];
        if input.read(&mut first).map_err(|error| error.to_string())? == 0 {
            return Ok(None);
        }
        let mut bytes = first.to_vec();
        bytes.extend(take(input, 7)?);
        let packing = u16_at(&bytes, 2);
        if packing != 0 {
            bytes.extend(take(input, 4)?);
        }
        let unpacked_bytes = u32_at(&bytes, 4) as usize;
        let packed_bytes = match packing {
            0 => unpacked_bytes,
            _ => u32_at(&bytes, 8) as usize,
        };
        if unpacked_bytes.max(packed_bytes) > MOST_BYTES {
            return Err("it claims more than 64 MiB".to_owned());
        }
        Ok(Some(Self {
            kind: u16_at(&bytes, 0),
            packing,
            unpacked_bytes,
            packed_bytes,
            bytes,
        }))
    }

    /// Returns the text of a block: that of its program, or its settings as comments.
    fn text(&self, data: Vec<u8>, encoding: u16) -> Result<Vec<u8>, String> {
        if self.kind == THUMBNAIL {
            return Ok(Vec::new());
        }
        let data = self.unpack(data)?;
        match (self.kind, encoding) {
            (PROGRAM, 0) => Ok(data),
            (PROGRAM, 1 | 2) => Ok(meatpack::decode(&data)),
            (0 | 2..=4, 0) => {
                let lines = data.split(|byte| *byte == b'\n');
                let lines = lines.filter(|line| !line.is_empty());
                Ok(lines
                    .flat_map(|line| [b"; ", line, b"\n"].concat())
                    .collect())
            }
            (0..=4, _) => Err("its encoding is not known".to_owned()),
            _ => Err("its kind is not known".to_owned()),
        }
    }

    fn unpack(&self, data: Vec<u8>) -> Result<Vec<u8>, String> {
        let most = self.unpacked_bytes;
        let unpacked = match self.packing {
            0 => data,
            1 => {
                let mut unpacked = Vec::new();
                let inflated = flate2::read::ZlibDecoder::new(data.as_slice());
                let read = inflated.take(most as u64 + 1).read_to_end(&mut unpacked);
                read.map_err(|error| error.to_string())?;
                unpacked
            }
            2 => heatshrink::decode(&data, 11, most),
            3 => heatshrink::decode(&data, 12, most),
            _ => return Err("its packing is not known".to_owned()),
        };
        if unpacked.len() == most {
            Ok(unpacked)
        } else {
            Err("it does not unpack to its stated size".to_owned())
        }
    }
}

/// Reads this many bytes.
fn take(input: &mut impl Read, count: usize) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    let read = input.take(count as u64).read_to_end(&mut bytes);
    match read {
        Ok(read) if read == count => Ok(bytes),
        Ok(_) => Err("the file ends within it".to_owned()),
        Err(error) => Err(error.to_string()),
    }
}

fn u16_at(bytes: &[u8], at: usize) -> u16 {
    u16::from_le_bytes([bytes[at], bytes[at + 1]])
}

fn u32_at(bytes: &[u8], at: usize) -> u32 {
    u32::from(u16_at(bytes, at)) | u32::from(u16_at(bytes, at + 2)) << 16
}
