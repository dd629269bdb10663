//! Curves from files: points as text, `l` lines of OBJ, or edges of PLY.

use super::ply::PlyError;
use super::ply_edges::decode_edges;
use super::points::{PointsError, decode_points};
use super::sniff::{Format, sniff};
use super::stl::{is_ascii_stl, is_binary_stl};
use crate::geom::Point;

/// A reason why a file holds no curve. Points are counted from 1, as in OBJ.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LinesError {
    /// The points cannot be read.
    #[error(transparent)]
    Points(#[from] PointsError),
    /// The PLY file cannot be read.
    #[error("PLY: {0}")]
    Ply(Box<PlyError>),
    /// A line of an OBJ file cannot be read.
    #[error("OBJ: line {line}: {found:?} is no {expected}; remedy: export the curve again")]
    Obj {
        /// The line, from 1.
        line: usize,
        /// The thing expected there.
        expected: &'static str,
        /// The text found there.
        found: String,
    },
    /// There are no lines or edges.
    #[error(
        "it has {points} points and no lines between them; remedy: export the curve with its \
         lines, or as text with one x,y,z a line"
    )]
    NoLines {
        /// Number of points.
        points: usize,
    },
    /// An end of a line that is no point of the file.
    #[error("a line ends in point {point} of {points}; remedy: export the curve again")]
    NoPoint {
        /// The point.
        point: usize,
        /// Number of points.
        points: usize,
    },
    /// More than two lines meet.
    #[error(
        "{lines} lines meet in point {point}: that is a skeleton, no curve; remedy: leave one path \
         from end to end"
    )]
    Branch {
        /// The point.
        point: usize,
        /// Number of lines that meet.
        lines: usize,
    },
    /// The curve is closed.
    #[error("the curve is closed: it has no ends; remedy: take one line out, where it may begin")]
    Closed,
    /// There is more than one curve.
    #[error("it holds {pieces} curves; remedy: leave one of them, or join them")]
    Pieces {
        /// Number of curves.
        pieces: usize,
    },
    /// A model in place of a curve.
    #[error(
        "it is a model with faces, no curve; remedy: give a curve (text, OBJ lines, PLY edges, \
         arc:R,DEG or helix:R,PITCH,TURNS)"
    )]
    Model,
}

/// Points, and the links between two of them each.
pub type Lines = (Vec<Point>, Vec<[usize; 2]>);

/// Reads the lines of an OBJ file or the edges of a PLY file, whether they branch or not.
///
/// # Errors
/// The file holds no lines.
pub fn decode_lines(bytes: &[u8]) -> Result<Lines, LinesError> {
    let graph = decode_graph(bytes)?;
    let graph = graph.ok_or(LinesError::NoLines { points: 0 })?;
    let links = graph.meets.iter().enumerate();
    let links = links.flat_map(|(a, ends)| ends.iter().map(move |b| [a, *b]));
    let links = links.filter(|[a, b]| a < b).collect();
    Ok((graph.points, links))
}

/// Reads the points of a curve in their order, in the units of the file. The content decides the
/// format.
pub fn decode_curve(bytes: &[u8]) -> Result<Vec<Point>, LinesError> {
    match decode_graph(bytes)? {
        Some(graph) => graph.path(),
        None => Ok(decode_points(bytes)?),
    }
}

/// Reads the lines of a file; `None` if it is text with points alone.
fn decode_graph(bytes: &[u8]) -> Result<Option<Graph>, LinesError> {
    match (sniff(bytes), std::str::from_utf8(bytes)) {
        (Format::Ply, _) => {
            let read = decode_edges(bytes).map_err(|error| LinesError::Ply(Box::new(error)))?;
            Ok(Some(Graph::new(read.0, read.1)?))
        }
        (Format::Obj, Ok(text)) => Ok(Some(read_obj(text)?)),
        (Format::ThreeMf, _) => Err(LinesError::Model),
        (Format::Stl, _) if is_binary_stl(bytes) || is_ascii_stl(bytes) => Err(LinesError::Model),
        _ => Ok(None),
    }
}

fn read_obj(text: &str) -> Result<Graph, LinesError> {
    let (mut points, mut edges, mut faces) = (Vec::new(), Vec::new(), 0);
    for (index, line) in text.lines().enumerate() {
        let fault = |expected, found: &str| LinesError::Obj {
            line: index + 1,
            expected,
            found: found.chars().take(20).collect(),
        };
        let mut words = line.split_ascii_whitespace();
        match words.next() {
            Some("v") => {
                let numbers: Vec<f64> = words.filter_map(|word| word.parse().ok()).collect();
                let is_point = numbers.len() >= 3 && numbers.iter().all(|x| x.is_finite());
                if !is_point {
                    return Err(fault("point of three finite numbers", line));
                }
                points.push(Point::new(numbers[0], numbers[1], numbers[2]));
            }
            Some("l") => {
                let corner = |word: &str| {
                    corner_index(word, points.len()).ok_or_else(|| fault("point's number", word))
                };
                let corners: Vec<usize> = words.map(corner).collect::<Result<_, _>>()?;
                edges.extend(corners.windows(2).map(|pair| [pair[0], pair[1]]));
            }
            Some("f") => faces += 1,
            _ => {}
        }
    }
    if edges.is_empty() && faces > 0 {
        return Err(LinesError::Model);
    }
    Graph::new(points, edges)
}

/// Returns the place of a point by its number: from 1, or back from the last read one.
fn corner_index(word: &str, read: usize) -> Option<usize> {
    let number: i64 = word.split('/').next()?.parse().ok()?;
    let index = if number < 0 {
        read as i64 + number
    } else {
        number - 1
    };
    usize::try_from(index).ok()
}

/// Points and the lines between them.
struct Graph {
    points: Vec<Point>,
    /// The points at the other ends of the lines that meet in each point.
    meets: Vec<Vec<usize>>,
}

impl Graph {
    fn new(points: Vec<Point>, edges: Vec<[usize; 2]>) -> Result<Self, LinesError> {
        let count = points.len();
        if edges.is_empty() {
            return Err(LinesError::NoLines { points: count });
        }
        if let Some(far) = edges.iter().flatten().find(|end| **end >= count) {
            return Err(LinesError::NoPoint {
                point: far + 1,
                points: count,
            });
        }
        let mut meets = vec![Vec::new(); count];
        for [a, b] in edges.into_iter().filter(|[a, b]| a != b) {
            meets[a].push(b);
            meets[b].push(a);
        }
        for ends in &mut meets {
            ends.sort_unstable();
            ends.dedup();
        }
        Ok(Self { points, meets })
    }

    /// Returns the points from end to end, from the end that comes first in the file.
    fn path(&self) -> Result<Vec<Point>, LinesError> {
        let branch = self.meets.iter().position(|ends| ends.len() > 2);
        if let Some(point) = branch {
            return Err(LinesError::Branch {
                point: point + 1,
                lines: self.meets[point].len(),
            });
        }
        let ends = self.meets.iter().filter(|ends| ends.len() == 1).count();
        let Some(first) = self.meets.iter().position(|ends| ends.len() == 1) else {
            return Err(LinesError::Closed);
        };
        if ends > 2 {
            return Err(LinesError::Pieces { pieces: ends / 2 });
        }
        let mut path = vec![first];
        let mut before = None;
        let mut here = first;
        while let Some(next) = self.meets[here].iter().find(|next| Some(**next) != before) {
            path.push(*next);
            (before, here) = (Some(here), *next);
        }
        let used = self.meets.iter().filter(|ends| !ends.is_empty()).count();
        if used > path.len() {
            return Err(LinesError::Pieces { pieces: 2 });
        }
        Ok(path.into_iter().map(|point| self.points[point]).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const POINTS: &str = "v 0 0 0\nv 2 0 0\nv 1 0 0\nv 3 1 0\n";

    fn read(lines: &str) -> Result<Vec<Point>, LinesError> {
        decode_curve(format!("{POINTS}{lines}").as_bytes())
    }

    #[test]
    fn lines_of_an_obj_file_are_one_path_whatever_their_order() {
        let expected = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 1.0]];
        let expected = expected.map(|[x, y]| Point::new(x, y, 0.0));
        assert_eq!(read("l 1 3 2 4\n").unwrap(), expected);
        assert_eq!(read("l 2 4\nl 1 3\nl 3/1 2/2\n").unwrap(), expected);
        assert_eq!(read("l -4 -2 -3 -1\n").unwrap(), expected);
    }

    #[test]
    fn edges_of_a_ply_file_are_one_path() {
        let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
                   property float z\nelement edge 2\nproperty int vertex1\nproperty int vertex2\n\
                   end_header\n0 0 0\n5 0 0\n2 1 0\n0 2\n2 1\n";
        let xs: Vec<f64> = decode_curve(ply.as_bytes())
            .unwrap()
            .iter()
            .map(|p| p.x)
            .collect();
        assert_eq!(xs, [0.0, 2.0, 5.0]);
    }

    #[test]
    fn plain_points_are_read_too() {
        assert_eq!(decode_curve(b"0,0,0\n1,0,0\n2,1,0\n").unwrap().len(), 3);
    }

    #[test]
    fn what_is_no_single_path_is_refused_with_its_place() {
        let says = |lines: &str| read(lines).unwrap_err().to_string();
        assert!(says("").contains("4 points and no lines"));
        assert!(says("l 1 2\nl 1 3\nl 1 4\n").contains("3 lines meet in point 1"));
        assert!(says("l 1 2 3 1\n").contains("closed"));
        assert!(says("l 1 2\nl 3 4\n").contains("2 curves"));
        assert!(says("l 1 9\n").contains("point 9 of 4"));
        assert!(says("l 1 x\n").contains("line 5"));
        assert!(says("f 1 2 3\n").contains("model with faces"));
        assert!(
            decode_curve(b"v 1 nan 2\n")
                .unwrap_err()
                .to_string()
                .contains("line 1")
        );
    }

    proptest! {
        #[test]
        fn any_lines_are_read_or_refused(text in "[vl0-9 ./\\-\n]{0,80}") {
            let _ = decode_curve(text.as_bytes());
        }
    }
}
