//! The distance between two curves: at equal shares of the length, and by shape alone.

use crate::geom::{Point, Vector};

/// Bisections of the Fréchet distance: after 40 the interval is 1e-12 of the first.
const BISECTIONS: usize = 40;

/// The distance between points at equal shares of the length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviation {
    /// The greatest distance, mm.
    pub max_mm: f64,
    /// The root of the mean square, mm.
    pub rms_mm: f64,
}

impl Deviation {
    /// Compares samples in pairs.
    pub fn between(a: &[Point], b: &[Point]) -> Self {
        let squares = a.iter().zip(b).map(|(a, b)| (a - b).norm_squared());
        let (sum, most) = squares.fold((0.0, 0.0f64), |(sum, most), square| {
            (sum + square, most.max(square))
        });
        Self {
            max_mm: most.sqrt(),
            rms_mm: (sum / a.len().min(b.len()).max(1) as f64).sqrt(),
        }
    }
}

/// Returns the greatest distance of a point of one polyline from the other, both ways, mm. Points
/// are taken at the vertices, so the error is at most the sagitta between them.
pub fn hausdorff_mm(a: &[Point], b: &[Point]) -> f64 {
    let farthest = |from: &[Point], to: &[Point]| {
        let distances = from.iter().map(|p| distance_to_polyline(p, to));
        distances.fold(0.0, f64::max)
    };
    farthest(a, b).max(farthest(b, a))
}

/// Returns the Fréchet distance of two polylines, mm: the shortest leash with which two walkers
/// pass over them, neither going back.
///
/// Exact to 1e-9 mm or so, by bisection over the free-space diagram (Alt and Godau, "Computing the
/// Fréchet distance between two polygonal curves", 1995). Takes n·m steps for each bisection.
pub fn frechet_mm(a: &[Point], b: &[Point]) -> f64 {
    let ([first_a, .., last_a], [first_b, .., last_b]) = (a, b) else {
        return f64::INFINITY;
    };
    let ends = (first_a - first_b).norm().max((last_a - last_b).norm());
    let (mut low, mut high) = (ends, coupling_mm(a, b));
    if is_within(a, b, low) {
        return low;
    }
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if is_within(a, b, middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}

/// Returns the Fréchet distance over vertices alone, which is not less than that of the polylines.
fn coupling_mm(a: &[Point], b: &[Point]) -> f64 {
    let mut row = vec![f64::INFINITY; b.len()];
    for (i, p) in a.iter().enumerate() {
        let mut diagonal = f64::INFINITY;
        for (j, q) in b.iter().enumerate() {
            let left = if j > 0 { row[j - 1] } else { f64::INFINITY };
            let before = diagonal.min(row[j]).min(left);
            let before = if i + j == 0 { 0.0 } else { before };
            diagonal = row[j];
            row[j] = before.max((p - q).norm());
        }
    }
    row.last().copied().unwrap_or(f64::INFINITY)
}

/// A stretch of an edge of the diagram, as shares; empty if `from > to`.
#[derive(Clone, Copy)]
struct Reach {
    from: f64,
    to: f64,
}

impl Reach {
    const EMPTY: Self = Self { from: 1.0, to: 0.0 };
    const START: Self = Self { from: 0.0, to: 0.0 };

    fn is_empty(&self) -> bool {
        self.from > self.to
    }

    /// Returns what of an edge is reached from its opposite edge, or from the edge beside it.
    fn onwards(free: Self, opposite: Self, beside: Self) -> Self {
        if !beside.is_empty() {
            return free;
        }
        if opposite.is_empty() {
            return Self::EMPTY;
        }
        Self {
            from: free.from.max(opposite.from),
            to: free.to,
        }
    }
}

/// Returns true if a leash of this length does.
fn is_within(a: &[Point], b: &[Point], leash_mm: f64) -> bool {
    let near = |p: &Point, from: &Point, to: &Point| free_stretch(p, from, to, leash_mm);
    let cells = b.len() - 1;
    // Where each vertex of `b` is reached along the current edge of `a`, from its start.
    let mut below = vec![Reach::EMPTY; cells];
    let mut corner = Reach::START;
    for (i, edge) in a.windows(2).enumerate() {
        let mut left = near(&b[0], &edge[0], &edge[1]);
        let starts = !corner.is_empty() && left.from <= 0.0;
        left = if starts { left } else { Reach::EMPTY };
        corner = if left.to >= 1.0 {
            Reach::START
        } else {
            Reach::EMPTY
        };
        for j in 0..cells {
            if i == 0 {
                let free = near(&a[0], &b[j], &b[j + 1]);
                let is_open = free.from <= 0.0 && (j == 0 || below[j - 1].to >= 1.0);
                below[j] = if is_open { free } else { Reach::EMPTY };
            }
        }
        for j in 0..cells {
            let right = near(&b[j + 1], &edge[0], &edge[1]);
            let top = near(&edge[1], &b[j], &b[j + 1]);
            let onto_right = Reach::onwards(right, left, below[j]);
            below[j] = Reach::onwards(top, below[j], left);
            left = onto_right;
        }
    }
    below
        .last()
        .is_some_and(|top| top.to >= 1.0 && !top.is_empty())
}

/// Returns the stretch of the segment within a distance of a point, as shares of it.
fn free_stretch(p: &Point, from: &Point, to: &Point, within_mm: f64) -> Reach {
    let (along, off): (Vector, Vector) = (to - from, p - from);
    let square = along.norm_squared();
    let middle = along.dot(&off) / square;
    let beside = (off - along * middle).norm_squared();
    let half_square = (within_mm * within_mm - beside) / square;
    if half_square < 0.0 {
        return Reach::EMPTY;
    }
    let half = half_square.sqrt();
    let reach = Reach {
        from: (middle - half).max(0.0),
        to: (middle + half).min(1.0),
    };
    if reach.from > 1.0 || reach.to < 0.0 {
        return Reach::EMPTY;
    }
    reach
}

/// Returns the distance from a point to a polyline, mm.
fn distance_to_polyline(p: &Point, polyline: &[Point]) -> f64 {
    let to_edge = |edge: &[Point]| {
        let along = edge[1] - edge[0];
        let share = along.dot(&(p - edge[0])) / along.norm_squared();
        (p - (edge[0] + along * share.clamp(0.0, 1.0))).norm()
    };
    polyline
        .windows(2)
        .map(to_edge)
        .fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(height: f64, edges: u32) -> Vec<Point> {
        let at = |i: u32| Point::new(100.0 * f64::from(i) / f64::from(edges), height, 0.0);
        (0..=edges).map(at).collect()
    }

    #[test]
    fn parallel_lines_are_apart_by_their_height_whatever_their_points() {
        let (a, b) = (line(0.0, 7), line(3.0, 100));
        assert!((frechet_mm(&a, &b) - 3.0).abs() < 1e-9);
        assert!((hausdorff_mm(&a, &b) - 3.0).abs() < 1e-12);
    }

    #[test]
    fn a_detour_counts_for_the_leash_and_a_way_back_too() {
        // The second walker goes back by 40 mm, so the first must wait in the middle: 20 mm.
        let there_and_back = [0.0, 70.0, 30.0, 100.0].map(|x| Point::new(x, 0.0, 0.0));
        let found = frechet_mm(&line(0.0, 10), &there_and_back);
        assert!((found - 20.0).abs() < 1e-9, "{found}");
        assert!(hausdorff_mm(&line(0.0, 10), &there_and_back) < 1e-12);
        let spike = [
            Point::new(0.0, 0.0, 0.0),
            Point::new(50.0, 12.0, 0.0),
            Point::new(100.0, 0.0, 0.0),
        ];
        let found = frechet_mm(&line(0.0, 10), &spike);
        assert!((found - 12.0).abs() < 1e-9, "{found}");
    }

    #[test]
    fn the_distance_is_the_same_both_ways_and_at_most_that_of_the_samples() {
        let wave = |shift: f64| -> Vec<Point> {
            let at = |i: u32| {
                let t = f64::from(i) * 0.2;
                Point::new(10.0 * t, 8.0 * (t + shift).sin(), 5.0 * (1.7 * t).cos())
            };
            (0..80).map(at).collect()
        };
        let (a, b) = (wave(0.0), wave(0.6));
        let (there, back) = (frechet_mm(&a, &b), frechet_mm(&b, &a));
        assert!((there - back).abs() < 1e-9, "{there} {back}");
        assert!(there <= Deviation::between(&a, &b).max_mm + 1e-9);
        assert!(there >= hausdorff_mm(&a, &b) - 1e-9);
    }

    #[test]
    fn the_deviation_is_the_greatest_and_the_mean_square() {
        let deviation = Deviation::between(
            &line(0.0, 1),
            &[Point::new(0.0, 3.0, 0.0), Point::new(100.0, 0.0, 4.0)],
        );
        assert_eq!(deviation.max_mm, 4.0);
        assert!((deviation.rms_mm - 12.5f64.sqrt()).abs() < 1e-15);
    }
}
