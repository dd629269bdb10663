//! Reads `$Elements` of a `.msh` file.

use super::super::values::{Form, Kind};
use super::element_kinds::{CellKind, ElementKind, of_gmsh};
use super::error::VolumeError;
use super::msh_file::{Msh, Version};

/// A tetrahedron by the numbers of its nodes.
pub(super) struct Corners {
    numbers: [u64; 4],
    offset: usize,
}

impl Msh<'_> {
    /// Reads the elements; returns those that are tetrahedra.
    pub(super) fn section_elements(&mut self) -> Result<Vec<Corners>, VolumeError> {
        self.source.values.line();
        let corners = match self.version {
            Version::Two if self.source.values.form == Form::Text => self.elements_two()?,
            Version::Two => self.elements_two_binary()?,
            Version::Four => self.elements_four()?,
        };
        self.end("$EndElements")?;
        Ok(corners)
    }

    fn elements_two(&mut self) -> Result<Vec<Corners>, VolumeError> {
        let count = self.count("the number of elements")?;
        let least = [Kind::I32; 4];
        let mut corners = Vec::new();
        for _ in 0..self.source.claim(count, &least, "elements")? {
            let offset = self.source.begin();
            let number = self.source.whole(Kind::I32, "the number of an element")?;
            let kind = self.kind()?;
            let tags = self.source.whole(Kind::I32, "the number of tags")?;
            for _ in 0..self.source.claim(tags, &[Kind::I32], "tags")? {
                self.source.number(Kind::I32, "a tag")?;
            }
            corners.extend(self.element(offset, number, kind)?);
        }
        Ok(corners)
    }

    fn elements_two_binary(&mut self) -> Result<Vec<Corners>, VolumeError> {
        let count = self.count("the number of elements")?;
        let count = self.source.claim(count, &[Kind::I32; 2], "elements")? as u64;
        let mut corners = Vec::new();
        let mut read = 0;
        while read < count {
            let kind = self.kind()?;
            let follow = self.source.whole(Kind::I32, "the elements of a block")?;
            let tags = self.source.whole(Kind::I32, "the number of tags")?;
            let tags = self.source.claim(tags, &[Kind::I32], "tags")?;
            // An empty block would not bring the end nearer.
            for _ in 0..follow.max(1) {
                let offset = self.source.begin();
                let number = self.source.whole(Kind::I32, "the number of an element")?;
                for _ in 0..tags {
                    self.source.number(Kind::I32, "a tag")?;
                }
                corners.extend(self.element(offset, number, kind)?);
            }
            read += follow.max(1);
        }
        Ok(corners)
    }

    fn elements_four(&mut self) -> Result<Vec<Corners>, VolumeError> {
        let blocks = self.source.whole(Kind::U64, "the number of blocks")?;
        for _ in 0..3 {
            self.source.whole(Kind::U64, "the numbers of elements")?;
        }
        let head = [Kind::I32, Kind::I32, Kind::I32, Kind::U64];
        let mut corners = Vec::new();
        for _ in 0..self.source.claim(blocks, &head, "blocks of elements")? {
            self.source.number(Kind::I32, "the dimension of a block")?;
            self.source.number(Kind::I32, "the number of a block")?;
            let kind = self.kind()?;
            let count = self.source.whole(Kind::U64, "the elements of a block")?;
            for _ in 0..self.source.claim(count, &[Kind::U64; 2], "elements")? {
                let offset = self.source.begin();
                let number = self.source.whole(Kind::U64, "the number of an element")?;
                corners.extend(self.element(offset, number, kind)?);
            }
        }
        Ok(corners)
    }

    fn kind(&mut self) -> Result<ElementKind, VolumeError> {
        let at = self.source.begin();
        let number = self.source.whole(Kind::I32, "the kind of an element")?;
        of_gmsh(number).ok_or_else(|| self.source.wrong(at, "a known kind of element"))
    }

    /// Reads the nodes of an element; returns those of a tetrahedron.
    fn element(
        &mut self,
        offset: usize,
        number: u64,
        kind: ElementKind,
    ) -> Result<Option<Corners>, VolumeError> {
        let number_kind = match self.version {
            Version::Two => Kind::I32,
            Version::Four => Kind::U64,
        };
        let mut numbers = [0; 4];
        for index in 0..kind.nodes {
            let node = self.source.whole(number_kind, "the number of a node")?;
            if let Some(corner) = numbers.get_mut(index) {
                *corner = node;
            }
        }
        match kind.cell {
            CellKind::Tetrahedron => {
                self.cells.push(number);
                return Ok(Some(Corners { numbers, offset }));
            }
            CellKind::Solid(kind) => {
                if self.raw.other.is_none() {
                    self.raw.other = Some((self.source.place(offset), kind));
                }
                self.raw.other_count += 1;
            }
            CellKind::Flat(kind) => self.raw.ignore(kind),
        }
        Ok(None)
    }

    /// Finds the nodes of tetrahedra, which stand before or behind them in the file.
    pub(super) fn connect(&mut self, corners: Vec<Corners>) -> Result<(), VolumeError> {
        for Corners { numbers, offset } in corners {
            let mut cell = [0; 4];
            for (corner, number) in cell.iter_mut().zip(numbers) {
                let unknown = || VolumeError::Unknown {
                    place: self.source.place(offset),
                    thing: "node",
                    number,
                };
                *corner = self.nodes.index(number).ok_or_else(unknown)?;
            }
            self.raw.cells.push(cell);
            self.raw.cell_offsets.push(offset);
        }
        // Gmsh writes an element that is in two groups twice, with one number: the faces tell.
        self.cells.sort();
        Ok(())
    }
}
