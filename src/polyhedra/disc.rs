//! Convex outlines in a plane: what two have in common, and the largest disc in one.

use super::programme::{Row, maximise};

/// A disc in the coordinates of a plane, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Disc {
    pub center: [f64; 2],
    pub radius_mm: f64,
}

/// Returns the largest disc inside all the convex outlines, which run counterclockwise; `None` if
/// they share no point.
///
/// Exact up to rounding: a linear programme in the centre and the radius.
pub(super) fn largest_common_disc(outlines: &[&[[f64; 2]]]) -> Option<Disc> {
    let corners = || outlines.iter().copied().flatten();
    let first = *corners().next()?;
    let reach = |p: &[f64; 2]| (p[0] - first[0]).abs().max((p[1] - first[1]).abs());
    let size = corners().map(reach).fold(0.0, f64::max);
    if size <= 0.0 {
        return None;
    }
    let scaled = |p: [f64; 2]| [(p[0] - first[0]) / size, (p[1] - first[1]) / size];
    let edges = outlines.iter().flat_map(|outline| {
        (0..outline.len()).map(|k| [outline[k], outline[(k + 1) % outline.len()]].map(scaled))
    });
    let rows: Vec<Row> = edges
        .filter_map(|[from, to]| inside_row(from, to))
        .collect();
    let bounds = [[-1.0, -1.0, 0.0], [1.0, 1.0, 1.0]];
    let [x, y, radius] = maximise([0.0, 0.0, 1.0], bounds, &rows)?;
    Some(Disc {
        center: [first[0] + x * size, first[1] + y * size],
        radius_mm: radius * size,
    })
}

/// Returns the row that keeps a disc on the left of an edge; `None` for an edge of no length.
fn inside_row(from: [f64; 2], to: [f64; 2]) -> Option<Row> {
    let along = [to[0] - from[0], to[1] - from[1]];
    let length = along[0].hypot(along[1]);
    let outward = [along[1] / length, -along[0] / length];
    (length > 0.0).then(|| Row {
        a: [outward[0], outward[1], 1.0],
        b: outward[0] * from[0] + outward[1] * from[1],
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_disc_of_a_triangle_is_its_incircle() {
        let triangle = [[100.0, 50.0], [103.0, 50.0], [100.0, 54.0]];
        let disc = largest_common_disc(&[&triangle]).unwrap();
        assert!((disc.radius_mm - 1.0).abs() < 1e-12);
        assert!((disc.center[0] - 101.0).abs() + (disc.center[1] - 51.0).abs() < 1e-11);
    }

    #[test]
    fn two_outlines_share_a_disc_or_nothing() {
        let square = |x: f64| [[x, 0.0], [x + 10.0, 0.0], [x + 10.0, 10.0], [x, 10.0]];
        let disc = largest_common_disc(&[&square(0.0), &square(6.0)]).unwrap();
        assert!((disc.radius_mm - 2.0).abs() < 1e-12);
        assert!((disc.center[0] - 8.0).abs() < 1e-12);
        assert_eq!(largest_common_disc(&[&square(0.0), &square(11.0)]), None);
        assert_eq!(largest_common_disc(&[]), None);
    }
}
