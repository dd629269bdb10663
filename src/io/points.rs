//! Points as text: one a line, x, y and z between commas, semicolons or spaces.

use crate::geom::Point;

/// A value and the line on which it stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OnLine<T> {
    /// The line, from 1.
    pub line: usize,
    /// The value.
    pub value: T,
}

/// Coordinates of a point.
const COORDINATES: usize = 3;

/// The reason that a text is no list of points. Lines are counted from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PointsError {
    /// The bytes are no text.
    #[error("it is no UTF-8 text; remedy: save the points as text, one x,y,z a line")]
    NotText,
    /// A line with another number of values.
    #[error(
        "line {line}: {found} values in place of 3; remedy: write x,y,z with dots for decimals"
    )]
    Count {
        /// The line.
        line: usize,
        /// Number of values.
        found: usize,
    },
    /// A value that is no number.
    #[error("line {line}: `{text}` is no finite number; remedy: write it as 12.5")]
    Number {
        /// The line.
        line: usize,
        /// The value.
        text: String,
    },
    /// No points at all.
    #[error("it holds no points; remedy: write one x,y,z a line")]
    Empty,
}

/// Reads points (mm). Empty lines, lines after `#` and one line of titles at the top are passed
/// over.
pub fn decode_points(bytes: &[u8]) -> Result<Vec<Point>, PointsError> {
    let points = numbered_points(bytes)?;
    Ok(points.into_iter().map(|point| point.value).collect())
}

/// Reads points, each with its line.
pub(super) fn numbered_points(bytes: &[u8]) -> Result<Vec<OnLine<Point>>, PointsError> {
    let points = rows(bytes)?.into_iter();
    let points = points.map(|(line, values)| point(&values, line));
    points.collect()
}

/// A line and its values.
type Row<'a> = (usize, Vec<&'a str>);

/// Splits a text into rows of values, at least one.
pub(super) fn rows(bytes: &[u8]) -> Result<Vec<Row<'_>>, PointsError> {
    let text = std::str::from_utf8(bytes).map_err(|_| PointsError::NotText)?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let lines = text.lines().enumerate().map(|(i, line)| {
        let data = line.split('#').next().unwrap_or_default();
        (i + 1, data.trim())
    });
    let mut lines = lines.filter(|(_, data)| !data.is_empty()).peekable();
    lines.next_if(|(_, data)| is_title(data));
    let rows: Vec<Row<'_>> = lines.map(|(line, data)| (line, values(data))).collect();
    if rows.is_empty() {
        return Err(PointsError::Empty);
    }
    Ok(rows)
}

/// Returns true if no value of a line is a number.
fn is_title(data: &str) -> bool {
    values(data)
        .iter()
        .all(|value| value.parse::<f64>().is_err())
}

/// Splits a line at commas or semicolons if it has any, else at spaces.
fn values(data: &str) -> Vec<&str> {
    if data.contains([',', ';']) {
        data.split([',', ';']).map(str::trim).collect()
    } else {
        data.split_whitespace().collect()
    }
}

fn point(values: &[&str], line: usize) -> Result<OnLine<Point>, PointsError> {
    if values.len() != COORDINATES {
        let found = values.len();
        return Err(PointsError::Count { line, found });
    }
    let at = numbers(values, line)?;
    let value = Point::new(at[0], at[1], at[2]);
    Ok(OnLine { line, value })
}

/// Reads finite numbers of a line.
pub(super) fn numbers(values: &[&str], line: usize) -> Result<Vec<f64>, PointsError> {
    let number = |text: &&str| {
        let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
        number.ok_or_else(|| PointsError::Number {
            line,
            text: text.chars().take(20).collect(),
        })
    };
    values.iter().map(number).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn points_are_read_with_titles_comments_and_any_separator() {
        let expected = [Point::new(1.0, -2.5, 3e2), Point::new(0.0, 0.0, 1.0)];
        for text in [
            "1,-2.5,3e2\n0,0,1\n",
            "\u{feff}x,y,z\r\n1, -2.5, 300\r\n\r\n0,0,1",
            "# a hook\n1;-2.5;300 # first\n0;0;1",
            "x y z\n  1\t-2.5 300\n0 0 1",
        ] {
            assert_eq!(decode_points(text.as_bytes()).unwrap(), expected, "{text}");
        }
    }

    #[test]
    fn a_fault_is_told_with_its_line() {
        let says = |text: &str| decode_points(text.as_bytes()).unwrap_err().to_string();
        assert!(says("").contains("no points"));
        assert!(says("x,y,z\n").contains("no points"));
        assert!(says("1,2,3\n\n1,2\n").contains("line 3: 2 values"));
        assert!(says("1,2,3\n1,nan,2\n").contains("line 2: `nan`"));
        assert!(says("1,2,3\nx,y,z\n").contains("line 2: `x`"));
        assert!(says("1,2,,3").contains("4 values"));
        assert!(decode_points(&[0xff, 0xfe]).is_err());
    }

    proptest! {
        #[test]
        fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
            if let Ok(points) = decode_points(&bytes) {
                prop_assert!(points.iter().all(|p| p.iter().all(|x| x.is_finite())));
            }
        }

        #[test]
        fn any_text_of_numbers_is_read_or_refused(text in "[0-9e.,; #\\-\n]{0,80}") {
            let _ = decode_points(text.as_bytes());
        }
    }
}
