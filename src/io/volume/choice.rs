//! Decides which of a file's data is the density.

use std::convert::Infallible;
use std::fmt;
use std::str::FromStr;

use super::error::VolumeError;
use super::raw::{Array, On};
use crate::tets::Densities;

/// The name of data that is the density without a word.
const DENSITY: &str = "density";
/// The word for a mesh that is solid, whatever data it has.
const NONE: &str = "none";

/// An order of the data that is to be the density.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub enum DataChoice {
    /// The data named density, or the only one.
    #[default]
    Auto,
    /// None: the mesh is solid.
    Solid,
    /// The data of this name.
    Named(String),
}

impl FromStr for DataChoice {
    type Err = Infallible;

    fn from_str(text: &str) -> Result<Self, Infallible> {
        Ok(match text {
            NONE => Self::Solid,
            _ => Self::Named(text.to_owned()),
        })
    }
}

/// The data that is the density.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DensitySource {
    /// Its name in the file.
    pub name: String,
    /// What has a value.
    pub on: On,
}

impl DensitySource {
    pub(super) fn of(array: &Array) -> Self {
        Self {
            name: array.name.clone(),
            on: array.on,
        }
    }

    /// Returns the densities of the data; solid without any.
    pub(super) fn densities(array: Option<&Array>) -> Densities {
        match array {
            None => Densities::Solid,
            Some(array) => match array.on {
                On::Corners => Densities::Corners(array.values.clone()),
                On::Cells => Densities::Cells(array.values.clone()),
            },
        }
    }
}

impl fmt::Display for DensitySource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let on = match self.on {
            On::Corners => "at each corner, linear between",
            On::Cells => "in each tetrahedron",
        };
        write!(f, "{} {on}", self.name)
    }
}

/// Returns the data that is the density; `None` for a solid mesh.
///
/// The data named density is, or the only one of numbers that need not be whole: whole ones label
/// regions.
pub(super) fn choose<'a>(
    arrays: &'a [Array],
    choice: &DataChoice,
) -> Result<Option<&'a Array>, VolumeError> {
    let named = |name: &str| -> Vec<&Array> {
        let is_it = |array: &&Array| array.name.eq_ignore_ascii_case(name);
        arrays.iter().filter(is_it).collect()
    };
    let candidates = match choice {
        DataChoice::Solid => return Ok(None),
        DataChoice::Named(name) => {
            let found = named(name);
            if found.is_empty() {
                return Err(VolumeError::NoData {
                    name: name.clone(),
                    names: arrays.iter().map(|array| array.name.clone()).collect(),
                });
            }
            found
        }
        DataChoice::Auto => {
            let found = named(DENSITY);
            if found.is_empty() {
                arrays.iter().filter(|array| !array.is_whole).collect()
            } else {
                found
            }
        }
    };
    match candidates[..] {
        [] => Ok(None),
        [one] => Ok(Some(one)),
        [one, other, ..] if one.name.eq_ignore_ascii_case(&other.name) => Err(both(one)),
        _ => Err(VolumeError::Ambiguous {
            names: candidates.iter().map(|array| array.name.clone()).collect(),
        }),
    }
}

/// Returns the error of data at corners and in cells with one name.
fn both(array: &Array) -> VolumeError {
    let name = array.name.clone();
    VolumeError::BothKinds { name }
}
