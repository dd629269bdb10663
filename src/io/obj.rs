//! Reads Wavefront OBJ: the vertices and faces of all objects, with polygons cut into triangles.

use crate::geom::Point;
use crate::mesh::{TriMesh, ear_clip};

/// The reason that bytes are not an OBJ mesh, with the line.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ObjError {
    /// There are no faces.
    #[error(
        "there are no faces in it ({vertices} vertices); export the model again with its faces"
    )]
    NoFaces {
        /// Number of vertices in the file.
        vertices: usize,
    },
    /// A vertex that is not three numbers.
    #[error("line {line}: a vertex needs three numbers, found {found:?}; export the model again")]
    Vertex {
        /// The line, from 1.
        line: usize,
        /// The text found there.
        found: String,
    },
    /// A vertex coordinate is NaN or infinite.
    #[error("line {line}: a coordinate is not a finite number; export the model again")]
    NotFinite {
        /// The line, from 1.
        line: usize,
    },
    /// A face whose corners are not indices.
    #[error(
        "line {line}: a face needs three or more corners like 7, 7/1, 7//3 or 7/1/3, found {found:?}; export the model again"
    )]
    Face {
        /// The line, from 1.
        line: usize,
        /// The text found there.
        found: String,
    },
    /// A face names a vertex that does not exist.
    #[error(
        "line {line}: the face names vertex {index}, but the file has {vertices} vertices; export the model again"
    )]
    IndexOutOfRange {
        /// The line, from 1.
        line: usize,
        /// The index as it stands there.
        index: i64,
        /// Number of vertices in the file; for a negative index, those before the line.
        vertices: usize,
    },
    /// The parser refuses the file for another reason.
    #[error("{reason}; export the model again")]
    Refused {
        /// The message of the parser.
        reason: String,
    },
}

/// Returns the triangles of all objects and groups of an OBJ file, with finite coordinates.
///
/// Reads faces in every form (a, a/b, a//c, a/b/c, negative indices), lines continued with `\`, and
/// names in any encoding. Polygons, concave ones too, are cut by [`ear_clip`]. Ignores normals,
/// texture coordinates, colours and materials. Leaves out vertices that no face uses.
pub(super) fn decode(bytes: &[u8]) -> Result<TriMesh, ObjError> {
    let geometry = Geometry::of(&String::from_utf8_lossy(bytes));
    geometry.check()?;
    let options = tobj::LoadOptions::default();
    let (models, _) = tobj::load_obj_buf(&mut geometry.text.as_bytes(), &options, |_| {
        Ok(Default::default())
    })
    .map_err(|error| ObjError::Refused {
        reason: error.to_string(),
    })?;
    let whole = models.iter().fold(TriMesh::default(), |whole, model| {
        whole.joined(&triangulate(&model.mesh))
    });
    if whole.triangles().is_empty() {
        return Err(ObjError::NoFaces {
            vertices: geometry.vertices,
        });
    }
    Ok(whole)
}

/// Cuts the faces of one parsed object into triangles.
fn triangulate(mesh: &tobj::Mesh) -> TriMesh {
    let vertices: Vec<Point> = mesh
        .positions
        .chunks_exact(3)
        .map(|p| Point::new(p[0], p[1], p[2]))
        .collect();
    let mut rest = mesh.indices.as_slice();
    let mut triangles = Vec::with_capacity(mesh.indices.len() / 3);
    let arities = mesh
        .face_arities
        .iter()
        .map(|&n| n as usize)
        .chain(std::iter::repeat(3));
    for arity in arities {
        let Some((face, after)) = rest.split_at_checked(arity).filter(|_| !rest.is_empty()) else {
            break;
        };
        triangles.extend(ear_clip(&vertices, face));
        rest = after;
    }
    TriMesh::from_parts(vertices, triangles)
}

/// The vertex and face lines of a file, without comments, colours and line continuations.
struct Geometry {
    text: String,
    /// For each line of `text`, the line of the file on which it begins, from 1.
    lines: Vec<usize>,
    vertices: usize,
}

impl Geometry {
    fn of(file: &str) -> Self {
        let mut geometry = Self {
            text: String::with_capacity(file.len()),
            lines: Vec::new(),
            vertices: 0,
        };
        let mut lines = file
            .trim_start_matches('\u{feff}')
            .split(line_break(file))
            .zip(1..);
        while let Some((first, number)) = lines.next() {
            let mut line = first.trim_end_matches('\r').to_owned();
            while line.ends_with('\\') {
                line.pop();
                line.push(' ');
                line.push_str(
                    lines
                        .next()
                        .map_or("", |(next, _)| next.trim_end_matches('\r')),
                );
            }
            geometry.push_if_geometry(&line, number);
        }
        geometry
    }

    /// Appends the line if it is a vertex or a face.
    fn push_if_geometry(&mut self, line: &str, number: usize) {
        let line = line.split('#').next().unwrap_or_default();
        let words: Vec<&str> = line.split_whitespace().collect();
        let needed = match words.first() {
            Some(&"v") => &words[..coordinate_count(words.len() - 1) + 1],
            Some(&"f") => &words[..],
            _ => return,
        };
        self.vertices += usize::from(needed[0] == "v");
        self.lines.push(number);
        for word in needed {
            self.text.push_str(word);
            self.text.push(' ');
        }
        self.text.push('\n');
    }

    /// Reports the first unusable line. The parser would accept it, or refuse it without naming
    /// it.
    fn check(&self) -> Result<(), ObjError> {
        let mut vertices = 0;
        for (text, &line) in self.text.lines().zip(&self.lines) {
            let mut words = text.split_ascii_whitespace();
            if words.next() == Some("v") {
                vertices += 1;
                check_vertex(words, text, line)?;
            } else {
                check_face(words, line, vertices, self.vertices)?;
            }
        }
        Ok(())
    }
}

/// Returns the line separator of the file: a carriage return in old files that have no line feed.
fn line_break(file: &str) -> char {
    if file.contains('\n') { '\n' } else { '\r' }
}

/// Returns how many of a vertex's numbers are coordinates: three, or four with a weight. Further
/// numbers are its colour.
fn coordinate_count(count: usize) -> usize {
    if count > 4 { 3 } else { count }
}

fn check_vertex<'a>(
    words: impl Iterator<Item = &'a str>,
    text: &str,
    line: usize,
) -> Result<(), ObjError> {
    let numbers: Option<Vec<f64>> = words.map(|word| word.parse().ok()).collect();
    match numbers.as_deref() {
        Some([x, y, z]) if [x, y, z].iter().all(|x| x.is_finite()) => Ok(()),
        Some([x, y, z, w]) if [x, y, z].iter().all(|x| (*x / w).is_finite()) => Ok(()),
        Some([_, _, _] | [_, _, _, _]) => Err(ObjError::NotFinite { line }),
        _ => Err(ObjError::Vertex {
            line,
            found: excerpt(text),
        }),
    }
}

/// Checks that a face has at least three corners and that each names a vertex. `before` counts the
/// vertices up to this line, `all` those of the whole file.
fn check_face<'a>(
    corners: impl Iterator<Item = &'a str>,
    line: usize,
    before: usize,
    all: usize,
) -> Result<(), ObjError> {
    let mut count = 0;
    for corner in corners {
        let index = corner_index(corner).ok_or_else(|| ObjError::Face {
            line,
            found: excerpt(corner),
        })?;
        let vertices = if index < 0 { before } else { all };
        if index == 0 || index.unsigned_abs() > vertices as u64 {
            return Err(ObjError::IndexOutOfRange {
                line,
                index,
                vertices,
            });
        }
        count += 1;
    }
    if count < 3 {
        Err(ObjError::Face {
            line,
            found: format!("{count} corners"),
        })
    } else {
        Ok(())
    }
}

/// Returns the vertex index of a face corner; `None` unless all its parts are indices.
fn corner_index(corner: &str) -> Option<i64> {
    let mut parts = corner.split('/');
    let index = parts.next()?.parse().ok()?;
    let others: Vec<&str> = parts.collect();
    let sound = |part: &&str| part.is_empty() || part.parse::<i64>().is_ok();
    (others.len() <= 2 && others.iter().all(sound)).then_some(index)
}

/// Longest excerpt of a faulty line in a message, characters.
const MAX_QUOTED_CHARS: usize = 60;

fn excerpt(text: &str) -> String {
    text.trim_end().chars().take(MAX_QUOTED_CHARS).collect()
}
