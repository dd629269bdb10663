//! The outline of a flat region, and the largest disc inside it.

use std::collections::BinaryHeap;

use crate::cut::geometry::chart::Point2;

/// The boundary of a flat region: segments that form closed rings, in any order. The even-odd rule
/// tells inside from outside.
#[derive(Debug, Clone, Default)]
pub(crate) struct Outline {
    segments: Vec<[Point2; 2]>,
}

/// A disc in the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Disc {
    pub(crate) center: Point2,
    pub(crate) radius_mm: f64,
}

/// Tolerance of the largest disc, relative to the size of the region. A tenth of it costs three
/// times the work; ten times it shows in the openings.
const DISC_PRECISION_RATIO: f64 = 2e-3;

/// Most cells visited for one disc: a limit on time for degenerate outlines, a hundred times the
/// usual number.
const MAX_CELLS: usize = 20_000;

impl Outline {
    pub(crate) fn new(segments: Vec<[Point2; 2]>) -> Self {
        Self { segments }
    }

    /// Returns the corners of its rings; each at least once.
    pub(crate) fn corners(&self) -> impl Iterator<Item = Point2> + '_ {
        self.segments.iter().flatten().copied()
    }

    /// Returns evenly spaced points along the boundary, each with the point 1 mm farther along its
    /// segment.
    pub(crate) fn walk(&self, count: usize) -> Vec<[Point2; 2]> {
        let lengths = self.segments.iter().map(|[a, b]| (b - a).norm());
        let spacing = lengths.sum::<f64>() / count.max(1) as f64;
        let (mut places, mut walked, mut next) = (Vec::new(), 0.0, 0.0);
        for [a, b] in &self.segments {
            let length = (b - a).norm();
            let along = (b - a) / length.max(f64::MIN_POSITIVE);
            while next < walked + length {
                let at = a + along * (next - walked);
                places.push([at, at + along]);
                next += spacing;
            }
            walked += length;
        }
        places
    }

    /// Returns the distance to the boundary, mm; negative outside.
    pub(crate) fn signed_distance(&self, p: &Point2) -> f64 {
        let (mut inside, mut least) = (false, f64::INFINITY);
        for [a, b] in &self.segments {
            if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y) {
                inside = !inside;
            }
            least = least.min(distance_squared(p, a, b));
        }
        if inside { least.sqrt() } else { -least.sqrt() }
    }

    pub(crate) fn holds(&self, p: &Point2) -> bool {
        self.signed_distance(p) > 0.0
    }

    /// Returns the point of the boundary nearest to `p`; `p` itself if there is no boundary.
    pub(crate) fn nearest(&self, p: &Point2) -> Point2 {
        let on = self.segments.iter().map(|[a, b]| nearest_on(p, a, b));
        on.min_by(|a, b| (a - p).norm_squared().total_cmp(&(b - p).norm_squared()))
            .unwrap_or(*p)
    }

    /// Returns the corners of the bounding box; `None` if there is no segment or a coordinate is
    /// not finite.
    pub(crate) fn bounds(&self) -> Option<(Point2, Point2)> {
        let points = || self.segments.iter().flatten();
        let first = points().next()?;
        let (min, max) = points().fold((*first, *first), |(min, max), p| (min.inf(p), max.sup(p)));
        (min.coords.sum().is_finite() && max.coords.sum().is_finite()).then_some((min, max))
    }

    /// Returns the largest disc in the region, to [`DISC_PRECISION_RATIO`] of the region's size;
    /// `None` if it is no larger than `floor_mm`.
    ///
    /// Best-first search over a quadtree (Agafonkin, "A new algorithm for finding a visual center
    /// of a polygon", 2016). A floor saves most of the work on thin rings.
    pub(crate) fn largest_disc(&self, floor_mm: f64) -> Option<Disc> {
        let (min, max) = self.bounds()?;
        let size = max - min;
        let precision_mm = DISC_PRECISION_RATIO * size.norm();
        let half = size.x.min(size.y).max(precision_mm) / 2.0;
        let mut cells = BinaryHeap::new();
        let (columns, rows) = (
            (size.x / half / 2.0).ceil() as usize,
            (size.y / half / 2.0).ceil() as usize,
        );
        for i in 0..columns.max(1) * rows.max(1) {
            let (column, row) = ((i % columns.max(1)) as f64, (i / columns.max(1)) as f64);
            let center = min + nalgebra::Vector2::new(2.0 * column + 1.0, 2.0 * row + 1.0) * half;
            cells.push(self.cell(center, half));
        }
        self.refine(cells, [floor_mm, precision_mm])
    }

    /// Splits the most promising cell until no cell can hold a disc better by `precision_mm`.
    fn refine(
        &self,
        mut cells: BinaryHeap<Cell>,
        [floor_mm, precision_mm]: [f64; 2],
    ) -> Option<Disc> {
        let mut best: Option<Disc> = None;
        for _ in 0..MAX_CELLS {
            let Some(cell) = cells.pop() else { break };
            let best_mm = best.map_or(floor_mm, |disc| disc.radius_mm);
            if cell.distance > best_mm {
                best = Some(Disc {
                    center: cell.center,
                    radius_mm: cell.distance,
                });
            }
            if cell.bound() <= best.map_or(floor_mm, |disc| disc.radius_mm) + precision_mm {
                break;
            }
            let half = cell.half / 2.0;
            for (x, y) in [(-half, -half), (half, -half), (-half, half), (half, half)] {
                cells.push(self.cell(cell.center + nalgebra::Vector2::new(x, y), half));
            }
        }
        best
    }

    fn cell(&self, center: Point2, half: f64) -> Cell {
        Cell {
            center,
            half,
            distance: self.signed_distance(&center),
        }
    }
}

/// A square of the search, with the signed distance from its centre to the boundary.
struct Cell {
    center: Point2,
    half: f64,
    distance: f64,
}

impl Cell {
    /// Returns an upper bound of the signed distance over the square, mm.
    fn bound(&self) -> f64 {
        self.distance + self.half * std::f64::consts::SQRT_2
    }
}

impl PartialEq for Cell {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Cell {}

impl PartialOrd for Cell {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Cell {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        let place = |cell: &Self| (cell.center.x, cell.center.y);
        let ((x, y), (other_x, other_y)) = (place(self), place(other));
        let by_bound = self.bound().total_cmp(&other.bound());
        by_bound
            .then(x.total_cmp(&other_x))
            .then(y.total_cmp(&other_y))
    }
}

/// Returns the squared distance from a point to a segment.
fn distance_squared(p: &Point2, a: &Point2, b: &Point2) -> f64 {
    (p - nearest_on(p, a, b)).norm_squared()
}

/// Returns the point of a segment nearest to `p`.
fn nearest_on(p: &Point2, a: &Point2, b: &Point2) -> Point2 {
    let along = b - a;
    let length_squared = along.norm_squared();
    let t = if length_squared > 0.0 {
        ((p - a).dot(&along) / length_squared).clamp(0.0, 1.0)
    } else {
        0.0
    };
    a + along * t
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rectangle(x: [f64; 2], y: [f64; 2]) -> Vec<[Point2; 2]> {
        let corners = [(x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])]
            .map(|(x, y)| Point2::new(x, y));
        (0..4).map(|i| [corners[i], corners[(i + 1) % 4]]).collect()
    }

    #[test]
    fn the_largest_disc_of_a_long_rectangle_touches_its_long_sides() {
        let disc = Outline::new(rectangle([0.0, 10.0], [0.0, 2.0]))
            .largest_disc(0.0)
            .unwrap();
        assert!((disc.radius_mm - 1.0).abs() < DISC_PRECISION_RATIO * 10.2);
    }

    #[test]
    fn a_frame_holds_only_discs_of_its_width() {
        let frame = [
            rectangle([0.0, 10.0], [0.0, 10.0]),
            rectangle([1.0, 9.0], [1.0, 9.0]),
        ]
        .concat();
        let disc = Outline::new(frame).largest_disc(0.0).unwrap();
        // The disc in a corner touches both outer sides (r from each) and the inner corner. From
        // √2·(1 − r) = r follows r = 2 − √2. That is a little more than half the width.
        assert!((disc.radius_mm - (2.0 - 2f64.sqrt())).abs() < DISC_PRECISION_RATIO * 14.2);
    }

    #[test]
    fn a_walk_around_a_square_stops_evenly_on_all_its_sides() {
        let walk = Outline::new(rectangle([0.0, 4.0], [0.0, 4.0])).walk(16);
        assert_eq!(walk.len(), 16);
        assert!(walk.windows(2).all(|pair| {
            let distance = (pair[1][0] - pair[0][0]).norm();
            (distance - 1.0).abs() < 1e-9
        }));
        assert!(Outline::default().walk(16).is_empty());
    }

    #[test]
    fn an_empty_or_boundless_outline_holds_no_disc() {
        assert!(Outline::default().largest_disc(0.0).is_none());
        let nowhere = Point2::new(f64::NAN, 0.0);
        assert!(
            Outline::new(vec![[nowhere, nowhere]])
                .largest_disc(0.0)
                .is_none()
        );
        assert!(
            Outline::new(rectangle([1.0, 1.0], [2.0, 2.0]))
                .largest_disc(0.0)
                .is_none()
        );
    }
}
