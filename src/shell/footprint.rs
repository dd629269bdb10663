//! The shadow of a convex piece on the x-y plane, and the stretch of a row that it covers.

use crate::geom::Point;
use crate::geom::hull::strict_hull;

/// Largest number of corners of a footprint. A hull with more is replaced by its bounding
/// rectangle, which is larger, never smaller.
const MAX_CORNERS: usize = 8;

/// A convex polygon in x and y, widened by a margin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Footprint {
    corners: [[f64; 2]; MAX_CORNERS],
    count: u8,
    y_range_mm: [f64; 2],
    margin_mm: f64,
}

impl Footprint {
    /// Returns the shadow of the convex hull of `points`, widened by `margin_mm` on all sides.
    pub fn of_points(points: &[Point], margin_mm: f64) -> Self {
        let mut hull = strict_hull(points.iter().map(|p| [p.x, p.y]).collect());
        if hull.len() > MAX_CORNERS {
            hull = bounding_rectangle(&hull);
        }
        let ys = || hull.iter().map(|corner| corner[1]);
        let y_range_mm = [
            ys().fold(f64::INFINITY, f64::min),
            ys().fold(f64::NEG_INFINITY, f64::max),
        ];
        let mut corners = [[0.0; 2]; MAX_CORNERS];
        corners[..hull.len()].copy_from_slice(&hull);
        Self {
            corners,
            count: hull.len() as u8,
            y_range_mm,
            margin_mm,
        }
    }

    /// Returns the y-range with the margin, mm.
    pub fn y_range_mm(&self) -> [f64; 2] {
        [
            self.y_range_mm[0] - self.margin_mm,
            self.y_range_mm[1] + self.margin_mm,
        ]
    }

    /// Returns the x-range, mm, over the row at `y_mm`, or `None` if the row misses the footprint.
    ///
    /// With a margin m this is the x-range over the strip y ± m, widened by m. It is no smaller
    /// than the widened polygon's.
    pub fn on_row(&self, y_mm: f64) -> Option<[f64; 2]> {
        let strip = [y_mm - self.margin_mm, y_mm + self.margin_mm];
        if strip[1] < self.y_range_mm[0] || strip[0] > self.y_range_mm[1] {
            return None;
        }
        let corners = &self.corners[..usize::from(self.count)];
        let mut previous = corners[corners.len() - 1];
        let mut x_range = [f64::INFINITY, f64::NEG_INFINITY];
        for &corner in corners {
            for x in edge_on_strip(previous, corner, strip).into_iter().flatten() {
                x_range = [x_range[0].min(x), x_range[1].max(x)];
            }
            previous = corner;
        }
        Some([x_range[0] - self.margin_mm, x_range[1] + self.margin_mm])
    }
}

/// Returns the x-coordinates of the ends of the part of a segment that lies in the strip of y;
/// `None` if no part does.
fn edge_on_strip(from: [f64; 2], to: [f64; 2], [below, above]: [f64; 2]) -> Option<[f64; 2]> {
    let (lower, upper) = if from[1] <= to[1] {
        (from, to)
    } else {
        (to, from)
    };
    if upper[1] < below || lower[1] > above {
        return None;
    }
    let slope = (upper[0] - lower[0]) / (upper[1] - lower[1]);
    let start = if lower[1] >= below {
        lower[0]
    } else {
        lower[0] + slope * (below - lower[1])
    };
    let end = if upper[1] <= above {
        upper[0]
    } else {
        lower[0] + slope * (above - lower[1])
    };
    Some([start, end])
}

/// Returns the corners of the bounding rectangle.
fn bounding_rectangle(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let fold = |axis: usize, start: f64, f: fn(f64, f64) -> f64| {
        points.iter().map(|p| p[axis]).fold(start, f)
    };
    let (x0, x1) = (
        fold(0, f64::INFINITY, f64::min),
        fold(0, f64::NEG_INFINITY, f64::max),
    );
    let (y0, y1) = (
        fold(1, f64::INFINITY, f64::min),
        fold(1, f64::NEG_INFINITY, f64::max),
    );
    vec![[x0, y0], [x1, y0], [x1, y1], [x0, y1]]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(xy: &[[f64; 2]]) -> Vec<Point> {
        xy.iter().map(|p| Point::new(p[0], p[1], 7.0)).collect()
    }

    #[test]
    fn the_row_through_a_square_with_a_point_inside_covers_the_square() {
        let square = points(&[[0.0, 0.0], [2.0, 0.0], [1.0, 1.0], [2.0, 2.0], [0.0, 2.0]]);
        let footprint = Footprint::of_points(&square, 0.0);
        assert_eq!(footprint.on_row(0.5), Some([0.0, 2.0]));
        assert_eq!(footprint.on_row(2.5), None);
        assert_eq!(footprint.y_range_mm(), [0.0, 2.0]);
    }

    #[test]
    fn a_row_across_a_triangle_covers_what_similar_triangles_say() {
        let triangle = points(&[[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]]);
        assert_eq!(
            Footprint::of_points(&triangle, 0.0).on_row(1.0),
            Some([0.0, 3.0])
        );
    }

    #[test]
    fn the_margin_is_kept_on_all_sides_of_a_point_and_of_a_segment() {
        let point = Footprint::of_points(&points(&[[1.0, 1.0]]), 0.5);
        assert_eq!(point.on_row(1.25), Some([0.5, 1.5]));
        assert_eq!(point.on_row(1.75), None);
        let flat = Footprint::of_points(&points(&[[0.0, 0.0], [4.0, 0.0]]), 0.5);
        assert_eq!(flat.on_row(-0.25), Some([-0.5, 4.5]));
    }

    #[test]
    fn a_polygon_of_too_many_corners_is_replaced_by_its_rectangle() {
        let circle: Vec<Point> = (0..12)
            .map(|i| f64::from(i) * 0.5)
            .map(|t| Point::new(t.cos(), t.sin(), 0.0))
            .collect();
        let footprint = Footprint::of_points(&circle, 0.0);
        let [low, high] = footprint.on_row(0.9).unwrap();
        assert!(
            low < -0.95 && high == 1.0,
            "the rectangle is as wide at the top as in the middle"
        );
    }
}
