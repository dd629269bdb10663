//! What the formats of volume meshes have in common, before it is checked.

use super::error::{Place, VolumeError};
use crate::geom::Point;

/// Most kinds of data in a file: each has a value for every corner, however few the file gives.
const MOST_ARRAYS: usize = 64;

/// What has a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum On {
    /// The corners of tetrahedra.
    Corners,
    /// The tetrahedra.
    Cells,
}

/// One value for each corner or tetrahedron.
#[derive(Debug, Clone)]
pub(super) struct Array {
    pub name: String,
    pub on: On,
    /// True if the file says that they are whole numbers: such are labels more often.
    pub is_whole: bool,
    pub values: Vec<f64>,
    /// The offset of each value in the file.
    pub offsets: Vec<usize>,
}

/// Parts of a file that are passed over.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Ignored {
    /// Number of them.
    pub count: usize,
    /// Their kind, in plural.
    pub kind: String,
}

/// Data with more than one number for each corner or tetrahedron.
pub(super) const VECTORS: &str = "data of vectors";

/// A volume mesh as a file tells it.
#[derive(Debug, Default)]
pub(super) struct Raw {
    pub vertices: Vec<Point>,
    pub cells: Vec<[u32; 4]>,
    /// The offset of each cell in the file.
    pub cell_offsets: Vec<usize>,
    pub arrays: Vec<Array>,
    pub ignored: Vec<Ignored>,
    /// The first cell that fills space and is no tetrahedron, and its kind.
    pub other: Option<(Place, &'static str)>,
    pub other_count: usize,
}

impl Raw {
    /// Counts a part of the file that is passed over.
    pub fn ignore(&mut self, kind: &str) {
        match self.ignored.iter_mut().find(|known| known.kind == kind) {
            Some(known) => known.count += 1,
            None => self.ignored.push(Ignored {
                count: 1,
                kind: kind.to_owned(),
            }),
        }
    }

    /// Adds one array; there may be none of the same name and place yet.
    pub fn add_array(&mut self, array: Array, place: Place) -> Result<(), VolumeError> {
        if self.arrays.len() == MOST_ARRAYS {
            return Err(VolumeError::Unsupported {
                place,
                found: format!("more than {MOST_ARRAYS} kinds of data"),
                remedy: "write the density alone",
            });
        }
        let is_same = |known: &&Array| known.name == array.name && known.on == array.on;
        if self.arrays.iter().find(is_same).is_some() {
            let name = array.name;
            return Err(VolumeError::Twice { place, name });
        }
        self.arrays.push(array);
        Ok(())
    }
}
