//! Reads the data of points and cells in a legacy VTK file.

use super::super::values::Kind;
use super::error::VolumeError;
use super::raw::{Array, On, VECTORS};
use super::vtk_file::{Vtk, kind_named};

/// Most components of a value that are passed over.
const MOST_COMPONENTS: u64 = 1000;

/// The head of an array: its name, the type of its numbers and its shape.
struct Head {
    name: String,
    kind: Kind,
    components: u64,
    count: u64,
}

impl Vtk<'_> {
    /// Reads one attribute; `word` is in capitals and stood at an offset.
    pub(super) fn attribute(&mut self, word: &str, at: usize) -> Result<(), VolumeError> {
        match word {
            "METADATA" => {
                self.pass_over_information();
                return Ok(());
            }
            "FIELD" => return self.field(),
            "SCALARS" => return self.scalars(),
            "LOOKUP_TABLE" => {
                let name = self.source.text_word("the name of a table")?;
                let count = self.source.text_whole("the size of a table")?;
                self.source.values.line();
                return self.array(Head {
                    name,
                    kind: Kind::U8,
                    components: 4,
                    count,
                });
            }
            _ => {}
        }
        let Some((_, count)) = self.on else {
            return Err(self.source.wrong(at, "a word such as POINTS"));
        };
        let count = count as u64;
        let components = match word {
            "VECTORS" | "NORMALS" => 3,
            "TENSORS" => 9,
            "TENSORS6" => 6,
            "GLOBAL_IDS" | "PEDIGREE_IDS" | "EDGE_FLAGS" => 1,
            "COLOR_SCALARS" | "TEXTURE_COORDINATES" => 0,
            _ => return Err(self.source.wrong(at, "a word such as SCALARS")),
        };
        let name = self.source.text_word("the name of data")?;
        let components = match components {
            0 => self.source.text_whole("the number of components")?,
            known => known,
        };
        let kind = match word {
            "COLOR_SCALARS" => Kind::U8,
            _ => self.kind()?,
        };
        self.source.values.line();
        // Ids and flags are no densities, whatever their type.
        if word.ends_with("_IDS") || word == "EDGE_FLAGS" {
            return self.pass_over(kind, count);
        }
        self.array(Head {
            name,
            kind,
            components,
            count,
        })
    }

    fn scalars(&mut self) -> Result<(), VolumeError> {
        let name = self.source.text_word("the name of scalars")?;
        let kind = self.kind()?;
        let rest = self.source.values.line();
        let components = std::str::from_utf8(rest).ok();
        let components = components.and_then(|text| text.parse().ok()).unwrap_or(1);
        if self.source.values.left().starts_with(b"LOOKUP_TABLE") {
            self.source.values.line();
        }
        let count = self.on.map_or(0, |(_, count)| count) as u64;
        self.array(Head {
            name,
            kind,
            components,
            count,
        })
    }

    fn field(&mut self) -> Result<(), VolumeError> {
        self.source.text_word("the name of a field")?;
        let arrays = self.source.text_whole("the number of arrays")?;
        self.source.values.line();
        for _ in 0..arrays {
            let mut name = self.source.text_word("the name of an array")?;
            // Information about an array follows it.
            while name == "METADATA" {
                self.pass_over_information();
                name = self.source.text_word("the name of an array")?;
            }
            let components = self.source.text_whole("the number of components")?;
            let count = self.source.text_whole("the number of values")?;
            let place = self.source.here();
            let kind = self.source.text_word("a type of numbers")?;
            let Some(kind) = kind_named(&kind) else {
                return Err(VolumeError::Unsupported {
                    place,
                    found: format!("an array of type {kind}"),
                    remedy: "leave it out, and export again",
                });
            };
            self.source.values.line();
            self.array(Head {
                name,
                kind,
                components,
                count,
            })?;
        }
        Ok(())
    }

    /// Reads the values of an array, and keeps those of scalars of points or cells.
    fn array(&mut self, head: Head) -> Result<(), VolumeError> {
        let Head {
            name,
            kind,
            components,
            count,
        } = head;
        let place = self.source.here();
        let all = components.min(MOST_COMPONENTS).saturating_mul(count);
        let kept = self
            .on
            .filter(|(_, items)| components == 1 && count == *items as u64);
        let Some((on, items)) = kept else {
            if self.on.is_some() && components > 1 {
                self.raw.ignore(VECTORS);
            }
            return self.pass_over(kind, all);
        };
        let mut array = Array {
            name,
            on,
            is_whole: kind.is_whole(),
            values: Vec::new(),
            offsets: Vec::new(),
        };
        for item in 0..items {
            let at = self.source.begin();
            let value = self.source.number(kind, "a value")?;
            if on == On::Corners || self.tetrahedron(item).is_some() {
                array.values.push(value);
                array.offsets.push(at);
            }
        }
        self.raw.add_array(array, place)
    }

    /// Passes over what follows METADATA, to an empty line.
    fn pass_over_information(&mut self) {
        self.source.values.line();
        while !self.source.values.line().is_empty() {}
    }

    fn pass_over(&mut self, kind: Kind, count: u64) -> Result<(), VolumeError> {
        for _ in 0..self.source.claim(count, &[kind], "values")? {
            self.source.number(kind, "a value")?;
        }
        Ok(())
    }
}
