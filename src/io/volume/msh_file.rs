//! A `.msh` file that is being read: its header, its numbers of nodes and elements.

use super::super::values::{Form, Kind};
use super::error::VolumeError;
use super::raw::Raw;
use super::source::Source;

/// The two layouts that are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Version {
    Two,
    Four,
}

/// The bytes of a size in binary files of version 4.1, as their header says.
const SIZE_BYTES: u64 = 8;

/// A file of Gmsh that is being read.
pub(super) struct Msh<'a> {
    pub source: Source<'a>,
    pub version: Version,
    pub nodes: Numbers,
    pub cells: Numbers,
    pub raw: Raw,
}

/// Numbers of nodes or cells, which need not follow each other, in ascending order.
#[derive(Debug, Default)]
pub(super) struct Numbers {
    sorted: Vec<(u64, u32)>,
}

impl Numbers {
    /// Takes the number of the next item.
    pub fn push(&mut self, number: u64) {
        let index = self.sorted.len() as u32;
        self.sorted.push((number, index));
    }

    /// Sorts the numbers, once all are known; returns one that is there twice.
    pub fn sort(&mut self) -> Option<u64> {
        self.sorted.sort_unstable();
        let twice = self.sorted.windows(2).find(|pair| pair[0].0 == pair[1].0);
        twice.map(|pair| pair[0].0)
    }

    /// Returns the index of an item.
    pub fn index(&self, number: u64) -> Option<u32> {
        let at = self
            .sorted
            .binary_search_by_key(&number, |(number, _)| *number);
        at.ok().map(|at| self.sorted[at].1)
    }

    /// Returns the number of the item of an index.
    pub fn number(&self, index: usize) -> u64 {
        let mut all = self.sorted.iter();
        all.find(|(_, at)| *at as usize == index)
            .map_or(0, |it| it.0)
    }
}

impl<'a> Msh<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Self {
            source: Source::new(bytes),
            version: Version::Two,
            nodes: Numbers::default(),
            cells: Numbers::default(),
            raw: Raw::default(),
        }
    }

    pub fn header(&mut self) -> Result<(), VolumeError> {
        let source = &mut self.source;
        let place = source.here();
        let version = source.text_word("the version of the format")?;
        let is_binary = source.text_whole("0 for text or 1 for binary")? == 1;
        let size = source.text_whole("the bytes of a number")?;
        self.version = match version.as_str() {
            "2" | "2.0" | "2.1" | "2.2" => Version::Two,
            "4.1" => Version::Four,
            _ => {
                return Err(VolumeError::Unsupported {
                    place,
                    found: format!("Gmsh's format of version {version}"),
                    remedy: "export it as version 4.1 or 2.2",
                });
            }
        };
        if size != SIZE_BYTES {
            return Err(VolumeError::Unsupported {
                place,
                found: format!("a file with numbers of {size} bytes"),
                remedy: "export it with numbers of 8 bytes, or as text",
            });
        }
        if is_binary {
            source.values.line();
            source.values.form = Form::LittleEndian;
            let at = source.begin();
            let one = source.values.left().first_chunk::<4>().copied();
            source.values.skip(4);
            match one.map(i32::from_le_bytes) {
                Some(1) => {}
                Some(0x0100_0000) => source.values.form = Form::BigEndian,
                _ => return Err(source.wrong(at, "the number 1 in binary")),
            }
        }
        self.end("$EndMeshFormat")
    }

    /// Reads the end of a section.
    pub fn end(&mut self, name: &'static str) -> Result<(), VolumeError> {
        self.source.values.skip_blanks();
        let at = self.source.values.offset();
        if self.source.text_word(name)? != name {
            return Err(self.source.wrong(at, name));
        }
        Ok(())
    }

    /// Passes over a section that is not needed.
    pub fn skip_section(&mut self, name: &str) -> Result<(), VolumeError> {
        let place = self.source.here();
        let end = format!("$End{}", &name[1..]);
        let left = self.source.values.left();
        let found = left.windows(end.len()).position(|it| it == end.as_bytes());
        let Some(found) = found else {
            let expected = "the end of a section";
            return Err(VolumeError::Cut { place, expected });
        };
        self.source.values.skip(found + end.len());
        Ok(())
    }

    /// Returns the kind of counts: a size in version 4.1, an int in text before binary data.
    pub fn count(&mut self, what: &'static str) -> Result<u64, VolumeError> {
        match self.version {
            Version::Two => {
                let count = self.source.text_whole(what)?;
                self.source.values.line();
                Ok(count)
            }
            Version::Four => self.source.whole(Kind::U64, what),
        }
    }
}
