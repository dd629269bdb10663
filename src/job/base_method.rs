//! The method by which the base of an object is looked for.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::base::words::as_text;
use crate::polyhedra::vertices::StartSolid;

/// The word for planes that move.
const PLANES: &str = "planes";
/// The word for vertices that move.
const VERTICES: &str = "vertices";

/// The method by which a base is looked for.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum BaseMethod {
    /// Planes move, and every step keeps the proof.
    #[default]
    Planes,
    /// The vertices of a regular polyhedron move, as in the paper, and the proof is made for what
    /// they yield. `None` tries all polyhedra with no more faces than asked for. It keeps the one
    /// with the largest proved volume, first of all of those that get panels.
    Vertices(Option<StartSolid>),
}

as_text!(BaseMethod);

/// A text that is no method.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{0}` is no method of making a base; remedy: give {PLANES}, {VERTICES}, or {VERTICES} with a \
     start such as {VERTICES}:icosahedron ({starts})", starts = StartSolid::WORDS.join(", ")
)]
pub struct BaseMethodError(String);

impl BaseMethod {
    /// Returns true if planes move.
    pub fn is_planes(&self) -> bool {
        *self == Self::Planes
    }

    /// Returns the polyhedra from which vertices start; none if planes move.
    pub fn starts(&self) -> Vec<StartSolid> {
        match self {
            Self::Planes => Vec::new(),
            Self::Vertices(None) => StartSolid::ALL.to_vec(),
            Self::Vertices(Some(start)) => vec![*start],
        }
    }

    /// Returns the most faces of a start; `None` if planes move, which have no start.
    pub fn most_faces(&self) -> Option<usize> {
        let faces = self.starts().into_iter();
        faces.map(StartSolid::face_count).max()
    }
}

impl FromStr for BaseMethod {
    type Err = BaseMethodError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let refused = || BaseMethodError(text.to_owned());
        match text.split_once(':') {
            None if text == PLANES => Ok(Self::Planes),
            None if text == VERTICES => Ok(Self::Vertices(None)),
            Some((VERTICES, start)) => match start.parse() {
                Ok(start) => Ok(Self::Vertices(Some(start))),
                Err(_) => Err(refused()),
            },
            _ => Err(refused()),
        }
    }
}

impl fmt::Display for BaseMethod {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Planes => f.write_str(PLANES),
            Self::Vertices(None) => f.write_str(VERTICES),
            Self::Vertices(Some(start)) => write!(f, "{VERTICES}:{start}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_method_reads_back_as_it_prints_and_others_are_refused() {
        let mut all = vec![BaseMethod::Planes, BaseMethod::Vertices(None)];
        let starts = StartSolid::ALL.iter();
        all.extend(starts.map(|start| BaseMethod::Vertices(Some(*start))));
        for method in all {
            assert_eq!(method.to_string().parse(), Ok(method));
        }
        for wrong in ["", "plane", "vertices:", "vertices:ball", "planes:cube"] {
            let refused = wrong.parse::<BaseMethod>().unwrap_err().to_string();
            assert!(refused.contains("vertices:icosahedron"), "{refused}");
        }
    }

    #[test]
    fn the_starts_of_a_method_have_their_faces() {
        assert_eq!(BaseMethod::Planes.most_faces(), None);
        assert_eq!(BaseMethod::Vertices(None).most_faces(), Some(20));
        let cube = BaseMethod::Vertices(Some(StartSolid::Cube));
        assert_eq!(cube.most_faces(), Some(6));
    }
}
