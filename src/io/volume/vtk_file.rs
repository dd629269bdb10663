//! A legacy VTK file that is being read: its header and its points.

use super::super::values::{Form, Kind};
use super::error::VolumeError;
use super::raw::{On, Raw};
use super::source::Source;

/// The names of the number types. Types of C are as wide as VTK writes them.
const KINDS: [(&str, Kind); 13] = [
    ("char", Kind::I8),
    ("signed_char", Kind::I8),
    ("unsigned_char", Kind::U8),
    ("short", Kind::I16),
    ("unsigned_short", Kind::U16),
    ("int", Kind::I32),
    ("vtkidtype", Kind::I32),
    ("unsigned_int", Kind::U32),
    ("long", Kind::I64),
    ("vtktypeint64", Kind::I64),
    ("unsigned_long", Kind::U64),
    ("float", Kind::F32),
    ("double", Kind::F64),
];

/// Returns the type of numbers of a name.
pub(super) fn kind_named(name: &str) -> Option<Kind> {
    let is_it = |(known, _): &&(&str, Kind)| known.eq_ignore_ascii_case(name);
    KINDS.iter().find(is_it).map(|(_, kind)| *kind)
}

/// A VTK file that is being read.
pub(super) struct Vtk<'a> {
    pub source: Source<'a>,
    pub raw: Raw,
    pub cells: Cells,
    /// For each cell of the file, the tetrahedron it is.
    pub tetrahedra: Vec<Option<u32>>,
    /// What the data that follows belongs to, and how many there are.
    pub on: Option<(On, usize)>,
}

/// The corners of all cells of a file.
#[derive(Debug, Default)]
pub(super) struct Cells {
    pub corners: Vec<u32>,
    /// The offset in the file, and the end of the corners.
    pub ends: Vec<(usize, usize)>,
}

impl<'a> Vtk<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Self {
            source: Source::new(bytes),
            raw: Raw::default(),
            cells: Cells::default(),
            tetrahedra: Vec::new(),
            on: None,
        }
    }

    pub fn header(&mut self) -> Result<(), VolumeError> {
        let source = &mut self.source;
        source.values.line();
        source.values.line();
        let at = source.begin();
        let form = source.values.line().to_ascii_uppercase();
        source.values.form = match form.as_slice() {
            b"ASCII" => Form::Text,
            b"BINARY" => Form::BigEndian,
            _ => return Err(source.wrong(at, "ASCII or BINARY")),
        };
        Ok(())
    }

    pub fn dataset(&mut self) -> Result<(), VolumeError> {
        let place = self.source.here();
        let found = self.source.text_word("the kind of data set")?;
        if found.eq_ignore_ascii_case("UNSTRUCTURED_GRID") {
            return Ok(());
        }
        Err(VolumeError::Unsupported {
            place,
            found: format!("a data set of kind {found}"),
            remedy: "export the tetrahedra as an UNSTRUCTURED_GRID",
        })
    }

    pub fn points(&mut self) -> Result<(), VolumeError> {
        let count = self.source.text_whole("the number of points")?;
        let kind = self.kind()?;
        self.source.values.line();
        for _ in 0..self.source.claim(count, &[kind; 3], "points")? {
            let point = self.source.point(kind)?;
            self.raw.vertices.push(point);
        }
        Ok(())
    }

    /// Reads the name of a type of numbers.
    pub fn kind(&mut self) -> Result<Kind, VolumeError> {
        self.source.values.skip_blanks();
        let at = self.source.values.offset();
        let name = self.source.text_word("a type of numbers")?;
        kind_named(&name).ok_or_else(|| self.source.wrong(at, "a type of numbers"))
    }

    pub fn data_of(&mut self, on: On) -> Result<(), VolumeError> {
        self.source.values.skip_blanks();
        let at = self.source.values.offset();
        let count = self.source.text_whole("the number of values")?;
        self.source.values.line();
        let (wanted, expected) = match on {
            On::Corners => (self.raw.vertices.len(), "as many values as points"),
            On::Cells => (self.tetrahedra.len(), "as many values as cells"),
        };
        if count != wanted as u64 {
            return Err(self.source.wrong(at, expected));
        }
        self.on = Some((on, wanted));
        Ok(())
    }

    /// Returns the tetrahedron that a cell of the file is.
    pub fn tetrahedron(&self, cell: usize) -> Option<u32> {
        self.tetrahedra.get(cell).copied().flatten()
    }
}
