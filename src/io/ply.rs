//! Reads PLY, the Stanford triangle format: text and both binary forms, with polygons cut into
//! triangles.

use super::values::{Form, Kind, Values};
use crate::geom::Point;
use crate::mesh::{TriMesh, ear_clip};

/// The reason that bytes are not a PLY mesh, with the place.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlyError {
    /// A line of the header cannot be understood.
    #[error(
        "line {line} of the header: expected {expected}, found {found:?}; export the model again"
    )]
    Header {
        /// The line, from 1.
        line: usize,
        /// The text expected there.
        expected: &'static str,
        /// The text found there.
        found: String,
    },
    /// The file ends before its last element.
    #[error(
        "the file ends in {element} {index} of the {count} it promises; it was cut off: copy or export it again"
    )]
    Cut {
        /// Name of the element.
        element: String,
        /// Index among the elements of that name, from 0.
        index: usize,
        /// Number of them that the header promises.
        count: usize,
    },
    /// A value is not a finite number, or not the index or count that it must be.
    #[error("{element} {index}: {found} cannot be its {property}; export the model again")]
    Value {
        /// Name of the element.
        element: String,
        /// Index among the elements of that name, from 0.
        index: usize,
        /// The property.
        property: String,
        /// The text found there.
        found: String,
    },
    /// There are no faces.
    #[error(
        "there are no faces in it ({vertices} vertices); export the model again with its faces"
    )]
    NoFaces {
        /// Number of vertices in the file.
        vertices: usize,
    },
}

/// The names of the number types, old and new.
const KINDS: [(&str, Kind); 16] = [
    ("char", Kind::I8),
    ("int8", Kind::I8),
    ("uchar", Kind::U8),
    ("uint8", Kind::U8),
    ("short", Kind::I16),
    ("int16", Kind::I16),
    ("ushort", Kind::U16),
    ("uint16", Kind::U16),
    ("int", Kind::I32),
    ("int32", Kind::I32),
    ("uint", Kind::U32),
    ("uint32", Kind::U32),
    ("float", Kind::F32),
    ("float32", Kind::F32),
    ("double", Kind::F64),
    ("float64", Kind::F64),
];
/// The names of the property that lists a face's corners.
const CORNERS: [&str; 2] = ["vertex_indices", "vertex_index"];

/// A property of an element: a number, or a list of them if it has a type for its length.
#[derive(Debug, Clone)]
pub(super) struct Property {
    pub name: String,
    kind: Kind,
    length: Option<Kind>,
}

/// A group of items with the same properties, as the header declares it.
#[derive(Debug, Clone)]
pub(super) struct Element {
    pub name: String,
    count: usize,
    pub properties: Vec<Property>,
}

/// Returns the triangles of a PLY file: at least one, with finite coordinates.
///
/// Faces with any number of corners are cut by [`ear_clip`]. All other elements and properties are
/// skipped.
pub(super) fn decode(bytes: &[u8]) -> Result<TriMesh, PlyError> {
    let (form, elements, body) = header(bytes)?;
    let mut body = Body(Values::new(body, form));
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for element in &elements {
        match element.name.as_str() {
            "vertex" => vertices = read_vertices(&mut body, element)?,
            "face" => faces = read_faces(&mut body, element)?,
            _ => body.for_each_item(element, |_, _| Ok(()))?,
        }
    }
    let mut triangles = Vec::with_capacity(faces.len());
    for (index, face) in faces.iter().enumerate() {
        check_face(face, index, vertices.len())?;
        triangles.extend(ear_clip(&vertices, face));
    }
    if triangles.is_empty() {
        return Err(PlyError::NoFaces {
            vertices: vertices.len(),
        });
    }
    Ok(TriMesh::from_parts(vertices, triangles))
}

pub(super) fn read_vertices(body: &mut Body, element: &Element) -> Result<Vec<Point>, PlyError> {
    let axis = |name: &str| {
        element
            .properties
            .iter()
            .position(|property| property.name == name)
    };
    let axes = ["x", "y", "z"].map(axis);
    let mut vertices = Vec::new();
    body.for_each_item(element, |index, values| {
        let mut numbers = [f64::NAN; 3];
        for (number, axis) in numbers.iter_mut().zip(axes) {
            *number = axis
                .and_then(|axis| values[axis].first().copied())
                .unwrap_or(f64::NAN);
        }
        vertices.push(Point::from(numbers));
        let is_finite = numbers.iter().all(|x| x.is_finite());
        if is_finite {
            Ok(())
        } else {
            Err(fault(element, index, "place", format!("{numbers:?}")))
        }
    })?;
    Ok(vertices)
}

/// Returns the corners of each face.
fn read_faces(body: &mut Body, element: &Element) -> Result<Vec<Vec<u32>>, PlyError> {
    let is_corners = |property: &Property| {
        CORNERS.contains(&property.name.as_str()) && property.length.is_some()
    };
    let Some(corners) = element.properties.iter().position(is_corners) else {
        return Ok(Vec::new());
    };
    let mut faces = Vec::new();
    body.for_each_item(element, |index, values| {
        let whole = |x: &f64| {
            (x.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(x)).then_some(*x as u32)
        };
        let face: Option<Vec<u32>> = values[corners].iter().map(whole).collect();
        faces.push(
            face.ok_or_else(|| fault(element, index, "corners", format!("{:?}", values[corners])))?,
        );
        Ok(())
    })?;
    Ok(faces)
}

/// Refuses a face with fewer than three corners, or with a corner that is not a vertex.
fn check_face(face: &[u32], index: usize, vertices: usize) -> Result<(), PlyError> {
    if face.len() >= 3 && face.iter().all(|&corner| (corner as usize) < vertices) {
        return Ok(());
    }
    let found = format!("{face:?} of {vertices} vertices from 0 on");
    Err(PlyError::Value {
        element: "face".to_owned(),
        index,
        property: "corners".to_owned(),
        found,
    })
}

pub(super) fn fault(element: &Element, index: usize, property: &str, found: String) -> PlyError {
    PlyError::Value {
        element: element.name.clone(),
        index,
        property: property.to_owned(),
        found,
    }
}

/// Reads the header; returns the encoding, the elements, and the bytes after the header.
pub(super) fn header(bytes: &[u8]) -> Result<(Form, Vec<Element>, &[u8]), PlyError> {
    let (mut form, mut elements) = (None, Vec::<Element>::new());
    let (mut rest, mut line) = (bytes, 0);
    while !rest.is_empty() {
        let end = rest
            .iter()
            .position(|&byte| byte == b'\n' || byte == b'\r')
            .unwrap_or(rest.len());
        let is_pair = rest[end..].starts_with(b"\r\n");
        let text = String::from_utf8_lossy(&rest[..end]).into_owned();
        rest = &rest[(end + 1 + usize::from(is_pair)).min(rest.len())..];
        line += 1;
        let wrong = |expected| PlyError::Header {
            line,
            expected,
            found: text.clone(),
        };
        match text.split_ascii_whitespace().collect::<Vec<_>>().as_slice() {
            ["end_header"] => {
                let form = form.ok_or_else(|| wrong("a line with the format before it"))?;
                return Ok((form, elements, rest));
            }
            ["format", name, _] => {
                form = Some(form_of(name).ok_or_else(|| wrong("ascii or a binary format"))?)
            }
            ["element", name, count] => {
                let count = count
                    .parse()
                    .map_err(|_| wrong("how many elements there are"))?;
                elements.push(Element {
                    name: (*name).to_owned(),
                    count,
                    properties: Vec::new(),
                });
            }
            ["property", words @ ..] => {
                let property =
                    property(words).ok_or_else(|| wrong("a property: its type and its name"))?;
                elements
                    .last_mut()
                    .ok_or_else(|| wrong("an element before it"))?
                    .properties
                    .push(property);
            }
            ["ply"] if line == 1 => {}
            ["comment" | "obj_info", ..] => {}
            _ => return Err(wrong("a line of a PLY header")),
        }
    }
    Err(PlyError::Header {
        line,
        expected: "end_header",
        found: String::new(),
    })
}

fn form_of(name: &str) -> Option<Form> {
    match name {
        "ascii" => Some(Form::Text),
        "binary_little_endian" => Some(Form::LittleEndian),
        "binary_big_endian" => Some(Form::BigEndian),
        _ => None,
    }
}

fn property(words: &[&str]) -> Option<Property> {
    let kind = |name: &str| {
        KINDS
            .iter()
            .find(|(known, _)| *known == name)
            .map(|(_, kind)| *kind)
    };
    match words {
        ["list", length, of, name] => Some(Property {
            name: (*name).to_owned(),
            kind: kind(of)?,
            length: Some(kind(length)?),
        }),
        [of, name] => Some(Property {
            name: (*name).to_owned(),
            kind: kind(of)?,
            length: None,
        }),
        _ => None,
    }
}

/// The part of the file after the header that is still to be read.
pub(super) struct Body<'a>(pub Values<'a>);

impl Body<'_> {
    /// Calls `take` with the index of each item and its values, one list for each property.
    pub fn for_each_item(
        &mut self,
        element: &Element,
        mut take: impl FnMut(usize, &[Vec<f64>]) -> Result<(), PlyError>,
    ) -> Result<(), PlyError> {
        let cut = |index| PlyError::Cut {
            element: element.name.clone(),
            index,
            count: element.count,
        };
        if element.properties.is_empty() {
            return Ok(());
        }
        let mut values = vec![Vec::new(); element.properties.len()];
        for index in 0..element.count {
            for (property, values) in element.properties.iter().zip(&mut values) {
                let length = match property.length {
                    Some(kind) => self.0.number(kind).ok_or_else(|| cut(index))?,
                    None => 1.0,
                };
                if !(length >= 0.0 && length.fract() == 0.0) {
                    return Err(fault(
                        element,
                        index,
                        "number of corners",
                        length.to_string(),
                    ));
                }
                values.clear();
                for _ in 0..length as u64 {
                    values.push(self.0.number(property.kind).ok_or_else(|| cut(index))?);
                }
            }
            take(index, &values)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Solid;

    /// A block of one by two by three with quads, and with properties to be skipped.
    const HEADER: &str = "element vertex 8\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n\
        element face 6\nproperty list uchar int vertex_indices\nelement edge 1\nproperty short a\nend_header\n";
    const PLACES: [[f32; 3]; 8] = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 2.0, 0.0],
        [0.0, 2.0, 0.0],
        [0.0, 0.0, 3.0],
        [1.0, 0.0, 3.0],
        [1.0, 2.0, 3.0],
        [0.0, 2.0, 3.0],
    ];
    const FACES: [[i32; 4]; 6] = [
        [3, 2, 1, 0],
        [4, 5, 6, 7],
        [0, 1, 5, 4],
        [1, 2, 6, 5],
        [2, 3, 7, 6],
        [3, 0, 4, 7],
    ];

    fn text() -> String {
        let places: String = PLACES
            .iter()
            .map(|[x, y, z]| format!("{x} {y} {z} 255\n"))
            .collect();
        let faces: String = FACES
            .iter()
            .map(|[a, b, c, d]| format!("4 {a} {b} {c} {d}\n"))
            .collect();
        format!("ply\nformat ascii 1.0\ncomment by hand\n{HEADER}{places}{faces}7\n")
    }

    fn binary(is_big: bool) -> Vec<u8> {
        let name = if is_big { "big" } else { "little" };
        let mut bytes = format!("ply\nformat binary_{name}_endian 1.0\n{HEADER}").into_bytes();
        let in_order = |mut number: [u8; 4]| {
            if is_big {
                number.reverse();
            }
            number
        };
        for place in PLACES {
            bytes.extend(place.iter().flat_map(|x| in_order(x.to_le_bytes())));
            bytes.push(255);
        }
        for face in FACES {
            bytes.push(4);
            bytes.extend(
                face.iter()
                    .flat_map(|corner| in_order(corner.to_le_bytes())),
            );
        }
        bytes.extend([0, 7]);
        bytes
    }

    fn volume(bytes: &[u8]) -> f64 {
        Solid::new(decode(bytes).unwrap())
            .unwrap()
            .mesh()
            .signed_volume_mm3()
    }

    #[test]
    fn text_is_read_with_any_line_breaks() {
        for text in [
            text(),
            text().replace('\n', "\r\n"),
            text().replace('\n', "\r"),
        ] {
            assert!((volume(text.as_bytes()) - 6.0).abs() < 1e-12);
        }
    }

    #[test]
    fn both_binary_kinds_are_read() {
        for is_big in [false, true] {
            assert!((volume(&binary(is_big)) - 6.0).abs() < 1e-12);
        }
    }

    #[test]
    fn every_bad_file_is_refused_in_words_that_name_the_place_and_the_remedy() {
        let with = |from: &str, to: &str| text().replacen(from, to, 1).into_bytes();
        let cases: Vec<(Vec<u8>, &str)> = vec![
            (b"ply\n".to_vec(), "expected end_header"),
            (
                with("format ascii 1.0\n", ""),
                "a line with the format before it",
            ),
            (
                with("ascii", "morse"),
                "line 2 of the header: expected ascii",
            ),
            (
                with("vertex 8", "vertex many"),
                "line 4 of the header: expected how many",
            ),
            (
                with("float x", "quad x"),
                "line 5 of the header: expected a property",
            ),
            (
                with("element vertex 8\n", ""),
                "expected an element before it",
            ),
            (with("comment", "remark"), "expected a line of a PLY header"),
            (
                with("vertex 8", "vertex 4294967295"),
                "of the 4294967295 it promises",
            ),
            (with("1 2 3 255", "1 nan 3 255"), "vertex 6: "),
            (with("1 2 3 255", "1 1e999 3 255"), "vertex 6: "),
            (with("property float z", "property float w"), "vertex 0: "),
            (
                with("4 3 2 1 0", "4 3 2 1 8"),
                "face 0: [3, 2, 1, 8] of 8 vertices",
            ),
            (with("4 3 2 1 0", "4 3 2 1 -1"), "face 0: "),
            (
                with("4 3 2 1 0", "-4 3 2 1 0"),
                "face 0: -4 cannot be its number of corners",
            ),
            (with("4 3 2 1 0", "2 3 2"), "face 0: "),
            (
                with("vertex_indices", "colours"),
                "no faces in it (8 vertices)",
            ),
            (with("face 6", "face 0"), "no faces in it (8 vertices)"),
            (binary(false)[..300].to_vec(), "the file ends in "),
        ];
        for (bytes, expected) in cases {
            let message = decode(&bytes).expect_err(expected).to_string();
            assert!(
                message.contains(expected) && message.contains("export"),
                "{message:?}, not {expected:?}"
            );
        }
    }

    #[test]
    fn an_element_without_properties_takes_no_time_however_often_it_is_there() {
        let text = text().replacen(
            "element edge 1\nproperty short a\n",
            "element edge 18446744073709551615\n",
            1,
        );
        assert!((volume(text.as_bytes()) - 6.0).abs() < 1e-12);
    }

    #[test]
    fn a_file_cut_off_anywhere_is_refused_or_says_no_less_than_it_did() {
        for whole in [text().into_bytes(), binary(false), binary(true)] {
            for end in 0..whole.len() {
                if let Ok(mesh) = decode(&whole[..end]) {
                    // Only the end of the last number, which belongs to a
                    // skipped element, may be missing.
                    assert_eq!(mesh.triangles().len(), 12, "cut at {end}");
                }
            }
        }
    }
}
