//! The base as a file that a person may edit: planes in, proved polyhedra out.

use std::fmt::Write;

use serde::Deserialize;
use toml::Spanned;

use super::base_plan::{BasePlan, Child, Split, connected};
use super::connection::ConnectorRequest;
use super::ground::Ground;
use super::inscribe::Request;
use super::polyhedron::{NotInside, Polyhedron};
use super::side::Side;
use crate::base::toml_text::{self, Place, TextFault};
use crate::geom::{Plane, Vector};

/// A normal whose length differs from one by less than this is taken as it is.
const UNIT: f64 = 1e-12;
/// First letter of a polyhedron's name in the file.
const POLYHEDRON: char = 'Q';
/// First letter of a plane's name in the file.
const SPLIT: char = 'S';

/// A reason why a file describes no base of a model.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BaseFileError {
    /// Not TOML, or not the keys of a base.
    #[error(transparent)]
    Text(#[from] TextFault),
    /// A direction of no length, or numbers that are not finite.
    #[error("{place}: a plane needs a direction and finite numbers; remedy: correct its normal")]
    Plane {
        /// The place of the plane.
        place: Place,
    },
    /// Planes that bound no polyhedron inside the model.
    #[error(
        "{place}: {why}; remedy: move its faces inward, take the polyhedron out, or give the model \
         the size that the base was made for"
    )]
    NotInside {
        /// The place of the polyhedron.
        place: Place,
        /// The reason.
        why: NotInside,
    },
    /// A name that is not of the file.
    #[error("{place}: there is no `{name}`; remedy: name polyhedra Q1, Q2, … and planes S1, S2, …")]
    Unknown {
        /// The place of the name.
        place: Place,
        /// The name.
        name: String,
    },
    /// Planes and polyhedra that form no tree.
    #[error(
        "{place}: the planes and polyhedra form no tree; remedy: name each once, below or above a \
         plane, and S1 nowhere"
    )]
    NoTree {
        /// The place of the first plane, or the start of the file.
        place: Place,
    },
    /// A polyhedron that a plane cuts.
    #[error(
        "{place}: this plane does not part its polyhedra: one crosses it by {by_mm:.3} mm; remedy: \
         move the plane, or the faces that lie on it"
    )]
    Crossing {
        /// The place of the plane.
        place: Place,
        /// By how much, mm.
        by_mm: f64,
    },
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct BaseText {
    #[serde(default)]
    split: Vec<Spanned<SplitText>>,
    polyhedron: Vec<Spanned<PolyhedronText>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct SplitText {
    normal: [f64; 3],
    offset_mm: f64,
    below: Spanned<String>,
    above: Spanned<String>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct PolyhedronText {
    face: Vec<Spanned<FaceText>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct FaceText {
    normal: [f64; 3],
    offset_mm: f64,
    #[serde(default)]
    locked: bool,
}

impl BasePlan {
    /// Returns the file of the base, in the coordinates of the model. Read again, it gives the same
    /// base to the last bit.
    pub fn to_toml(&self) -> String {
        let mut text = String::from(
            "# The base: polyhedra Q1, Q2, … below planes, and the planes S1, S2, … between them.\n\
             # A polyhedron lies below all its faces: normal · x is at most offset_mm.\n",
        );
        for split in &self.splits {
            text += "\n[[split]]\n";
            text += &plane_lines(&split.plane);
            let [below, above] = [split.below, split.above].map(name_of);
            let _ = writeln!(text, "below = \"{below}\"\nabove = \"{above}\"");
        }
        for polyhedron in &self.polyhedra {
            text += "\n[[polyhedron]]\n";
            for face in polyhedron.faces() {
                text += "[[polyhedron.face]]\n";
                text += &plane_lines(&face.plane);
                if face.is_locked {
                    text += "locked = true\n";
                }
            }
        }
        text
    }

    /// Reads the file of a base for a model, and proves every polyhedron anew. Messages call the
    /// text `file`.
    pub fn from_toml(
        [file, text]: [&str; 2],
        ground: &Ground,
        request: &Request,
        connector: &ConnectorRequest,
    ) -> Result<Self, BaseFileError> {
        let source = SourceText { file, text };
        let base: BaseText = toml_text::read(file, text)?;
        let mut polyhedra = Vec::new();
        for polyhedron in &base.polyhedron {
            polyhedra.push(source.polyhedron(polyhedron, ground, request)?);
        }
        let mut splits = Vec::new();
        for split in &base.split {
            splits.push(source.split(split, &base)?);
        }
        if !is_tree(&splits, polyhedra.len()) {
            let at = base.split.first().map_or(0, |split| split.span().start);
            return Err(BaseFileError::NoTree {
                place: source.place(at),
            });
        }
        let plan = connected(ground, polyhedra, splits, connector);
        for (index, split) in base.split.iter().enumerate() {
            let by_mm = -plan.parted_by_mm(index);
            if by_mm >= 0.0 {
                let place = source.place(split.span().start);
                return Err(BaseFileError::Crossing { place, by_mm });
            }
        }
        Ok(plan)
    }
}

/// Formats a plane; numbers have all their digits.
fn plane_lines(plane: &Plane) -> String {
    let [x, y, z] = <[f64; 3]>::from(plane.normal);
    format!(
        "normal = [{x:?}, {y:?}, {z:?}]\noffset_mm = {:?}\n",
        plane.offset_mm
    )
}

fn name_of(child: Child) -> String {
    match child {
        Child::Polyhedron(index) => format!("{POLYHEDRON}{}", index + 1),
        Child::Split(index) => format!("{SPLIT}{}", index + 1),
    }
}

/// A text with the name of its file.
struct SourceText<'a> {
    file: &'a str,
    text: &'a str,
}

impl SourceText<'_> {
    fn place(&self, offset: usize) -> Place {
        Place::of_byte(self.file, self.text, offset)
    }

    fn plane(&self, at: usize, normal: [f64; 3], offset_mm: f64) -> Result<Plane, BaseFileError> {
        let normal = Vector::from(normal);
        let length = normal.norm();
        if !(length.is_finite() && length > 0.0 && offset_mm.is_finite()) {
            return Err(BaseFileError::Plane {
                place: self.place(at),
            });
        }
        let is_unit = (length - 1.0).abs() < UNIT;
        Ok(Plane {
            normal: if is_unit { normal } else { normal / length },
            offset_mm: if is_unit {
                offset_mm
            } else {
                offset_mm / length
            },
        })
    }

    fn polyhedron(
        &self,
        text: &Spanned<PolyhedronText>,
        ground: &Ground,
        request: &Request,
    ) -> Result<Polyhedron, BaseFileError> {
        let mut sides = Vec::new();
        for face in &text.get_ref().face {
            let (at, face) = (face.span().start, face.get_ref());
            sides.push(Side {
                plane: self.plane(at, face.normal, face.offset_mm)?,
                is_locked: face.locked,
            });
        }
        Polyhedron::new(ground, request.distance_mm, &sides, &request.limits).map_err(|why| {
            let place = self.place(text.span().start);
            BaseFileError::NotInside { place, why }
        })
    }

    fn split(&self, text: &Spanned<SplitText>, base: &BaseText) -> Result<Split, BaseFileError> {
        let (at, split) = (text.span().start, text.get_ref());
        Ok(Split {
            plane: self.plane(at, split.normal, split.offset_mm)?,
            below: self.child(&split.below, base)?,
            above: self.child(&split.above, base)?,
        })
    }

    fn child(&self, name: &Spanned<String>, base: &BaseText) -> Result<Child, BaseFileError> {
        let word = name.get_ref();
        let numbered = |letter: char, count: usize| {
            let number: usize = word.strip_prefix(letter)?.parse().ok()?;
            (1..=count).contains(&number).then(|| number - 1)
        };
        let polyhedron = numbered(POLYHEDRON, base.polyhedron.len()).map(Child::Polyhedron);
        let split = numbered(SPLIT, base.split.len()).map(Child::Split);
        polyhedron.or(split).ok_or_else(|| BaseFileError::Unknown {
            place: self.place(name.span().start),
            name: word.clone(),
        })
    }
}

/// Returns true if the first split is the root of a tree that has every other split and every
/// polyhedron once. Without splits there must be one polyhedron.
fn is_tree(splits: &[Split], polyhedra: usize) -> bool {
    let mut seen = vec![0_usize; splits.len() + polyhedra];
    let mut waiting = if splits.is_empty() {
        vec![Child::Polyhedron(0)]
    } else {
        vec![Child::Split(0)]
    };
    while let Some(child) = waiting.pop() {
        let at = match child {
            Child::Split(index) => index,
            Child::Polyhedron(index) => splits.len() + index,
        };
        seen[at] += 1;
        if seen[at] > 1 {
            return false;
        }
        if let Child::Split(index) = child {
            waiting.extend([splits[index].below, splits[index].above]);
        }
    }
    seen.iter().all(|&times| times == 1)
}
