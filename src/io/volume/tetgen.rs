//! Reads TetGen's pair of files: `.node` with the corners, `.ele` with the tetrahedra.

use super::error::{Place, VolumeError};
use super::raw::{Array, On, Raw};
use super::source::line_at;
use crate::geom::Point;

/// The names of the attributes in the two files, before their number from 1.
const NODE: &str = "node";
const ELE: &str = "ele";

/// A line of numbers, its comment cut off.
struct Row<'a> {
    offset: usize,
    words: Vec<&'a str>,
}

/// One of the two files.
pub(super) struct Table<'a> {
    bytes: &'a [u8],
    rows: std::vec::IntoIter<Row<'a>>,
}

impl<'a> Table<'a> {
    /// Splits a file into its lines of numbers.
    fn new(bytes: &'a [u8]) -> Self {
        let mut offset = 0;
        let mut rows = Vec::new();
        for line in bytes.split(|&byte| byte == b'\n') {
            let data = line.split(|&byte| byte == b'#').next().unwrap_or_default();
            // What is no text is no number either, and is refused as such.
            let words = data
                .split(u8::is_ascii_whitespace)
                .filter(|it| !it.is_empty());
            let words: Vec<&str> = words
                .map(|word| std::str::from_utf8(word).unwrap_or("\u{fffd}"))
                .collect();
            if !words.is_empty() {
                rows.push(Row { offset, words });
            }
            offset += line.len() + 1;
        }
        Self {
            bytes,
            rows: rows.into_iter(),
        }
    }

    fn place(&self, offset: usize) -> Place {
        line_at(self.bytes, offset)
    }

    fn row(&mut self, expected: &'static str) -> Result<Row<'a>, VolumeError> {
        // The place is counted from the start of the file: only an error pays for that.
        self.rows.next().ok_or_else(|| VolumeError::Cut {
            place: line_at(self.bytes, self.bytes.len()),
            expected,
        })
    }

    /// Returns a number in a column of a row.
    fn number<T: std::str::FromStr>(
        &self,
        row: &Row,
        column: usize,
        expected: &'static str,
    ) -> Result<T, VolumeError> {
        let word = row.words.get(column).copied().unwrap_or_default();
        word.parse().map_err(|_| VolumeError::Expected {
            place: self.place(row.offset),
            expected,
            found: word.chars().take(20).collect(),
        })
    }

    /// Returns a number in a column of a row, or another one if the row is too short.
    fn number_or(&self, row: &Row, column: usize, or: usize) -> Result<usize, VolumeError> {
        if row.words.len() <= column {
            return Ok(or);
        }
        self.number(row, column, "a whole number")
    }

    /// Checks the number of rows that is claimed against those that are there.
    fn claim(&self, claimed: u64, what: &'static str) -> Result<usize, VolumeError> {
        let rows = self.rows.len();
        if claimed > rows as u64 {
            let expected = what;
            let place = self.place(self.bytes.len());
            return Err(VolumeError::Cut { place, expected });
        }
        Ok(claimed as usize)
    }
}

/// Returns the mesh of the two files, and the files to tell places in.
///
/// # Errors
/// The file at fault, 0 or 1, and the fault.
pub(super) fn decode<'a>(
    [nodes, cells]: [&'a [u8]; 2],
) -> Result<(Raw, [Table<'a>; 2]), (usize, VolumeError)> {
    let mut raw = Raw::default();
    let mut nodes = Table::new(nodes);
    let mut cells = Table::new(cells);
    let first = read_nodes(&mut nodes, &mut raw).map_err(|error| (0, error))?;
    read_cells(&mut cells, &mut raw, first).map_err(|error| (1, error))?;
    Ok((raw, [nodes, cells]))
}

/// Returns the place of an offset in one of the files.
pub(super) fn place(tables: &[Table; 2], offset: usize, on: Option<On>) -> Place {
    match on {
        Some(On::Corners) => tables[0].place(offset),
        _ => tables[1].place(offset),
    }
}

/// Reads the corners; returns the number of the first, 0 or 1.
fn read_nodes(table: &mut Table, raw: &mut Raw) -> Result<u64, VolumeError> {
    let head = table.row("the number of nodes")?;
    let count = table.number(&head, 0, "the number of nodes")?;
    let dimension = table.number_or(&head, 1, 3)?;
    if dimension != 3 {
        return Err(VolumeError::Unsupported {
            place: table.place(head.offset),
            found: format!("a mesh of dimension {dimension}"),
            remedy: "export nodes with three coordinates",
        });
    }
    let attributes = table.number_or(&head, 2, 0)?;
    let count = table.claim(count, "as many nodes as its first line claims")?;
    let mut arrays = arrays(On::Corners, attributes, &table.rows.as_slice()[..count]);
    let mut first = 0;
    for index in 0..count as u64 {
        let row = table.row("a node")?;
        let number: u64 = table.number(&row, 0, "the number of a node")?;
        if index == 0 {
            first = number;
        }
        if number != first + index || first > 1 {
            return Err(VolumeError::Expected {
                place: table.place(row.offset),
                expected: "nodes numbered one by one from 0 or 1",
                found: number.to_string(),
            });
        }
        let mut at = [0.0; 3];
        for (axis, x) in at.iter_mut().enumerate() {
            *x = table.number(&row, 1 + axis, "three coordinates")?;
        }
        if !at.iter().all(|x: &f64| x.is_finite()) {
            return Err(VolumeError::Expected {
                place: table.place(row.offset),
                expected: "three finite coordinates",
                found: row.words[1..4].join(" "),
            });
        }
        raw.vertices.push(Point::from(at));
        read_attributes(table, &row, &mut arrays)?;
    }
    raw.arrays.extend(arrays);
    Ok(first)
}

fn read_cells(table: &mut Table, raw: &mut Raw, first: u64) -> Result<(), VolumeError> {
    let head = table.row("the number of tetrahedra")?;
    let count = table.number(&head, 0, "the number of tetrahedra")?;
    let corners = table.number_or(&head, 1, 4)?;
    if corners != 4 {
        return Err(VolumeError::Unsupported {
            place: table.place(head.offset),
            found: format!("a mesh with {corners} nodes in each tetrahedron"),
            remedy: "mesh with 4 nodes in each, not in second order",
        });
    }
    let attributes = table.number_or(&head, 2, 0)?;
    let count = table.claim(count, "as many tetrahedra as its first line claims")?;
    let mut arrays = arrays(On::Cells, attributes, &table.rows.as_slice()[..count]);
    for _ in 0..count {
        let row = table.row("a tetrahedron")?;
        let mut cell = [0; 4];
        for (index, corner) in cell.iter_mut().enumerate() {
            let number: u64 = table.number(&row, 1 + index, "four numbers of nodes")?;
            let place = number.checked_sub(first);
            let known = place.filter(|&place| place < raw.vertices.len() as u64);
            let unknown = || VolumeError::Unknown {
                place: table.place(row.offset),
                thing: "node",
                number,
            };
            *corner = known.ok_or_else(unknown)? as u32;
        }
        raw.cells.push(cell);
        raw.cell_offsets.push(row.offset);
        read_attributes(table, &row, &mut arrays)?;
    }
    raw.arrays.extend(arrays);
    Ok(())
}

/// Returns empty data for so many attributes as the rows can hold.
fn arrays(on: On, claimed: usize, rows: &[Row]) -> Vec<Array> {
    let lead = lead(on);
    let most = rows
        .first()
        .map_or(0, |row| row.words.len().saturating_sub(lead));
    let name = match on {
        On::Corners => NODE,
        On::Cells => ELE,
    };
    // Regions are numbered from 1: attributes that are all whole label them.
    let is_whole = |column: usize| {
        let is_label = |row: &Row| {
            row.words
                .get(column)
                .is_some_and(|it| it.parse::<i64>().is_ok())
        };
        rows.iter().all(is_label) && on == On::Cells
    };
    let array = |index: usize| Array {
        name: format!("{name}{}", index + 1),
        on,
        is_whole: is_whole(lead + index),
        values: Vec::new(),
        offsets: Vec::new(),
    };
    (0..claimed.min(most)).map(array).collect()
}

/// Returns the columns of a row before its attributes.
fn lead(on: On) -> usize {
    match on {
        On::Corners => 4,
        On::Cells => 5,
    }
}

fn read_attributes(table: &Table, row: &Row, arrays: &mut [Array]) -> Result<(), VolumeError> {
    for (index, array) in arrays.iter_mut().enumerate() {
        let value = table.number(row, lead(array.on) + index, "an attribute")?;
        array.values.push(value);
        array.offsets.push(row.offset);
    }
    Ok(())
}
