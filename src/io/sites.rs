//! Sites of cells from a file: points as text or the vertices of an OBJ file, each with its line.

use super::points::{OnLine, PointsError, numbered_points, numbers, rows};
use crate::geom::Point;

/// A reason why a file holds no sites. Lines are counted from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SitesFileError {
    /// The text holds no points.
    #[error(transparent)]
    Points(#[from] PointsError),
    /// A row of axes has another number of values.
    #[error(
        "line {line}: {found} values in place of 9; remedy: write the place, the first axis and a \
         direction toward the second: x,y,z,ax,ay,az,bx,by,bz"
    )]
    Axes {
        /// The line.
        line: usize,
        /// Number of values.
        found: usize,
    },
}

/// Reads sites: one x,y,z a line, or the vertices (`v`) of an OBJ file. All else of it is passed
/// over.
///
/// # Errors
/// The bytes are no text, a line holds no finite point, or there are none.
pub fn decode_sites(bytes: &[u8]) -> Result<Vec<OnLine<Point>>, SitesFileError> {
    let text = std::str::from_utf8(bytes).map_err(|_| PointsError::NotText)?;
    let is_vertex = |line: &str| line.trim_start().starts_with("v ");
    if !text.lines().any(is_vertex) {
        return Ok(numbered_points(bytes)?);
    }
    let lines = text.lines().enumerate();
    let vertices = lines.filter(|(_, line)| is_vertex(line));
    let vertices = vertices.map(|(index, text)| {
        let line = index + 1;
        let values: Vec<&str> = text.split_whitespace().skip(1).collect();
        // A fourth number is a weight, and colours may follow: neither moves a site.
        let first = values.get(..3).ok_or(PointsError::Count {
            line,
            found: values.len(),
        })?;
        let at = numbers(first, line)?;
        let value = Point::new(at[0], at[1], at[2]);
        Ok(OnLine { line, value })
    });
    vertices.collect()
}

/// Reads axes of cells: a place, the first axis and a direction toward the second, each of three
/// numbers, in a line.
///
/// # Errors
/// The bytes are no text, a line has other values than nine finite numbers, or there is none.
pub fn decode_axes(bytes: &[u8]) -> Result<Vec<OnLine<[f64; 9]>>, SitesFileError> {
    let read = rows(bytes)?.into_iter().map(|(line, values)| {
        let found = values.len();
        let read = numbers(&values, line)?;
        let value = <[f64; 9]>::try_from(read);
        let value = value.map_err(|_| SitesFileError::Axes { line, found })?;
        Ok(OnLine { line, value })
    });
    read.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn says(text: &str) -> String {
        decode_sites(text.as_bytes()).unwrap_err().to_string()
    }

    #[test]
    fn sites_are_read_from_a_table_and_from_an_obj_file() {
        let expected = [Point::new(1.0, 2.0, 3.0), Point::new(-4.0, 0.5, 6e1)];
        for (text, lines) in [
            ("x_mm,y_mm,z_mm\n1,2,3\n\n-4,0.5,60\n", [2, 4]),
            ("1 2 3\n-4 .5 6e1", [1, 2]),
            ("# sites\no a\nv 1 2 3\nv -4 0.5 60 1.0\nf 1 2 1\n", [3, 4]),
        ] {
            let read = decode_sites(text.as_bytes()).unwrap();
            let points: Vec<Point> = read.iter().map(|site| site.value).collect();
            let places: Vec<usize> = read.iter().map(|site| site.line).collect();
            assert_eq!(
                (points, places),
                (expected.to_vec(), lines.to_vec()),
                "{text}"
            );
        }
    }

    #[test]
    fn a_line_without_a_site_is_named() {
        assert!(says("").contains("no points"));
        assert!(says("1,2,3\n1,2\n").contains("line 2: 2 values"));
        assert!(says("1,2,3\n1,2,inf\n").contains("line 2: `inf`"));
        assert!(says("v 1 2 3\nv 1 2\n").contains("line 2: 2 values"));
        assert!(says("v 1 2 3\nv 1 nan 3\n").contains("line 2: `nan`"));
        assert!(decode_sites(&[0xff]).is_err());
    }

    #[test]
    fn axes_are_nine_numbers_a_line() {
        let read = decode_axes(b"x,y,z,ax,ay,az,bx,by,bz\n0,0,1,1,0,0,0,1,0\n").unwrap();
        assert_eq!(read[0].line, 2);
        assert_eq!(read[0].value, [0., 0., 1., 1., 0., 0., 0., 1., 0.]);
        let short = decode_axes(b"1,2,3\n").unwrap_err().to_string();
        assert!(short.contains("line 1: 3 values in place of 9"), "{short}");
    }

    proptest! {
        #[test]
        fn any_text_is_read_or_refused(text in "[v0-9e.,; #\\-\n]{0,80}") {
            if let Ok(sites) = decode_sites(text.as_bytes()) {
                prop_assert!(sites.iter().all(|site| site.value.iter().all(|x| x.is_finite())));
            }
            let _ = decode_axes(text.as_bytes());
        }
    }
}
