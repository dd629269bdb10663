//! Reads the cells of a legacy VTK file.

use super::super::values::Kind;
use super::element_kinds::{CellKind, corners_of_vtk, of_vtk};
use super::error::VolumeError;
use super::vtk_file::{Cells, Vtk};

impl Vtk<'_> {
    /// Reads the corners of the cells.
    pub(super) fn cells(&mut self) -> Result<(), VolumeError> {
        let count = self.source.text_whole("the number of cells")?;
        let size = self.source.text_whole("the size of the list of cells")?;
        self.source.values.line();
        let is_new = self.source.values.left().starts_with(b"OFFSETS");
        let count = self.source.claim(count, &[Kind::I8], "cells")?;
        self.cells = if is_new {
            self.cells_by_offsets(count, size)?
        } else {
            self.cells_by_counts(count)?
        };
        Ok(())
    }

    fn cells_by_counts(&mut self, count: usize) -> Result<Cells, VolumeError> {
        let mut cells = Cells::default();
        for _ in 0..count {
            let offset = self.source.begin();
            let corners = self.source.whole(Kind::I32, "the number of corners")?;
            for _ in 0..self.source.claim(corners, &[Kind::I32], "corners")? {
                let corner = self.corner(Kind::I32)?;
                cells.corners.push(corner);
            }
            cells.ends.push((offset, cells.corners.len()));
        }
        Ok(cells)
    }

    /// Reads cells as version 5.1 writes them: where each one begins, then the corners of all.
    fn cells_by_offsets(&mut self, count: usize, size: u64) -> Result<Cells, VolumeError> {
        let mut cells = Cells::default();
        self.source.text_word("OFFSETS")?;
        let kind = self.kind()?;
        self.source.values.line();
        let mut begins = Vec::new();
        for _ in 0..count {
            let at = self.source.begin();
            let begin = self.source.whole(kind, "where a cell begins")?;
            let is_next = begins.last().map_or(begin == 0, |last| *last <= begin);
            if !is_next || begin > size {
                return Err(self.source.wrong(at, "where a cell begins, in order"));
            }
            begins.push(begin);
        }
        self.source.values.skip_blanks();
        let at = self.source.values.offset();
        if self.source.text_word("CONNECTIVITY")? != "CONNECTIVITY" {
            return Err(self.source.wrong(at, "CONNECTIVITY"));
        }
        let kind = self.kind()?;
        self.source.values.line();
        self.source.claim(size, &[kind], "corners")?;
        for ends in begins.windows(2) {
            let offset = self.source.begin();
            for _ in ends[0]..ends[1] {
                let corner = self.corner(kind)?;
                cells.corners.push(corner);
            }
            cells.ends.push((offset, cells.corners.len()));
        }
        Ok(cells)
    }

    fn corner(&mut self, kind: Kind) -> Result<u32, VolumeError> {
        let place = self.source.begin();
        let number = self.source.whole(kind, "the number of a point")?;
        u32::try_from(number).map_err(|_| VolumeError::Unknown {
            place: self.source.place(place),
            thing: "point",
            number,
        })
    }

    /// Reads the types of the cells, and sorts out the tetrahedra.
    pub(super) fn cell_types(&mut self) -> Result<(), VolumeError> {
        let at = self.source.begin();
        let count = self.source.text_whole("the number of cells")?;
        self.source.values.line();
        let count = self.source.claim(count, &[Kind::I32], "cells")?;
        if count != self.cells.ends.len() {
            return Err(self.source.wrong(at, "as many types as cells"));
        }
        let mut begin = 0;
        for index in 0..count {
            let at = self.source.begin();
            let number = self.source.whole(Kind::I32, "the type of a cell")?;
            let unknown = || self.source.wrong(at, "a known type of cell");
            let kind = of_vtk(number).ok_or_else(unknown)?;
            let (offset, end) = self.cells.ends[index];
            let corners = self.cells.corners.get(begin..end).unwrap_or_default();
            begin = end;
            let is_fit = corners_of_vtk(number).is_none_or(|count| count == corners.len());
            if !is_fit {
                return Err(self.source.wrong(offset, "as many corners as its type has"));
            }
            let is_tetrahedron = kind == CellKind::Tetrahedron;
            let number = is_tetrahedron.then_some(self.raw.cells.len() as u32);
            self.tetrahedra.push(number);
            match kind {
                CellKind::Tetrahedron => {
                    let corners = corners.try_into();
                    let corners = corners.map_err(|_| self.source.wrong(offset, "four corners"))?;
                    self.raw.cells.push(corners);
                    self.raw.cell_offsets.push(offset);
                }
                CellKind::Solid(kind) => {
                    if self.raw.other.is_none() {
                        self.raw.other = Some((self.source.place(offset), kind));
                    }
                    self.raw.other_count += 1;
                }
                CellKind::Flat(kind) => self.raw.ignore(kind),
            }
        }
        Ok(())
    }
}
