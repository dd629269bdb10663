//! Names at the edges of a drawing, each with a line to what it names.

use super::palette::{INK, PAPER};
use super::svg::{Anchor, Drawing, Paint, Spot, Stroke};

/// Radius of the dot at the end of a line, pixels: larger dots hide small pins, smaller ones are
/// lost in print.
const DOT_PX: f64 = 3.5;

/// Width of a letter with its share of the gap before a line, in heights of the words.
const LETTER_TEXTS: f64 = 0.62;

/// A name at the edge of a drawing, and the place it names.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// The place.
    pub at: Spot,
    /// The name.
    pub words: String,
    /// The radius of the circle that stands for the place, pixels. The line ends at its rim without
    /// a dot; zero for a dot.
    pub radius_px: f64,
    /// A flag for a place that lies behind something: its line is dashed and its dot hollow.
    pub is_hidden: bool,
}

impl Mark {
    /// Returns a name for a visible place.
    pub fn new(at: Spot, words: String) -> Self {
        Self {
            at,
            words,
            radius_px: 0.0,
            is_hidden: false,
        }
    }

    /// Returns the end of a line from `start` to the place: on the rim of its circle.
    fn end_from(&self, start: Spot) -> Spot {
        let way = [start[0] - self.at[0], start[1] - self.at[1]];
        let share = (self.radius_px / way[0].hypot(way[1]).max(f64::MIN_POSITIVE)).min(1.0);
        [self.at[0] + share * way[0], self.at[1] + share * way[1]]
    }
}

impl Drawing {
    /// Adds names at the left and right edges, each with a line to its place, in the order of their
    /// heights.
    pub fn callouts(&mut self, marks: &[Mark]) {
        let [width, height] = self.size_px();
        for (edge, anchor, is_left) in [
            (8.0, Anchor::Start, true),
            (width - 8.0, Anchor::End, false),
        ] {
            let mut side: Vec<&Mark> = marks
                .iter()
                .filter(|mark| (mark.at[0] < 0.5 * width) == is_left)
                .collect();
            side.sort_by(|a, b| a.at[1].total_cmp(&b.at[1]));
            let wanted: Vec<f64> = side.iter().map(|mark| mark.at[1]).collect();
            let heights = spread(
                &wanted,
                1.35 * self.text_px(),
                [self.text_px(), height - self.text_px()],
            );
            let inward = if is_left { 1.0 } else { -1.0 };
            let letter_px = inward * LETTER_TEXTS * self.text_px();
            let start =
                |mark: &Mark, y: f64| [edge + letter_px * mark.words.chars().count() as f64, y];
            uncross(&mut side, &heights, start);
            for (mark, y) in side.into_iter().zip(heights) {
                self.leader(start(mark, y), mark);
                self.text([edge, y], anchor, &mark.words);
            }
        }
    }

    /// Adds the line from a name to its place, on a rim of paper so that it is visible on any
    /// colour.
    fn leader(&mut self, start: Spot, mark: &Mark) {
        let end = mark.end_from(start);
        self.line([start, end], Stroke::solid(PAPER, 5.0));
        let (stroke, fill, rim) = if mark.is_hidden {
            (Stroke::DASHED, PAPER, INK)
        } else {
            (Stroke::THIN, INK, PAPER)
        };
        self.line([start, end], stroke);
        if mark.radius_px == 0.0 {
            let paint = Paint::filled(fill, Stroke::solid(rim, 1.5));
            self.circle(end, DOT_PX, paint);
        }
    }
}

/// Exchanges names whose lines cross, so that no two lines on a side do. `start` is where the line
/// of a name at a height begins.
///
/// Each exchange shortens both lines together, but for names of unlike lengths; so the number of
/// passes is limited.
fn uncross(side: &mut [&Mark], heights: &[f64], start: impl Fn(&Mark, f64) -> Spot) {
    for _ in 0..side.len() {
        let mut is_done = true;
        for i in 0..side.len() {
            for j in i + 1..side.len() {
                let line = |at: usize| [start(side[at], heights[at]), side[at].at];
                if do_cross(line(i), line(j)) {
                    side.swap(i, j);
                    is_done = false;
                }
            }
        }
        if is_done {
            break;
        }
    }
}

/// Returns whether two lines cross between their ends.
fn do_cross([a, b]: [Spot; 2], [c, d]: [Spot; 2]) -> bool {
    let turn =
        |p: Spot, q: Spot, r: Spot| (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    turn(a, b, c) * turn(a, b, d) < 0.0 && turn(c, d, a) * turn(c, d, b) < 0.0
}

/// Returns places at least `gap` apart between two ends, as near as fits to the wanted ones, which
/// ascend.
fn spread(wanted: &[f64], gap: f64, [low, high]: [f64; 2]) -> Vec<f64> {
    let mut placed = Vec::with_capacity(wanted.len());
    let mut next = low;
    for &place in wanted {
        placed.push(place.max(next));
        next = place.max(next) + gap;
    }
    let mut last = high;
    for place in placed.iter_mut().rev() {
        *place = place.min(last);
        last = *place - gap;
    }
    placed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_are_spread_in_order_and_stay_on_the_paper() {
        let placed = spread(&[5.0, 6.0, 50.0, 99.0, 100.0], 10.0, [0.0, 100.0]);
        assert_eq!(placed, [5.0, 15.0, 50.0, 90.0, 100.0]);
    }

    #[test]
    fn no_two_lines_on_a_side_cross() {
        // In the order of their heights the line to the far place would cross the other two.
        let marks = [[90.0, 10.0], [20.0, 12.0], [60.0, 14.0], [30.0, 40.0]];
        let marks: Vec<Mark> = marks
            .iter()
            .map(|at| Mark::new(*at, "P01".to_owned()))
            .collect();
        let heights = [10.0, 40.0, 70.0, 100.0];
        let lines = |side: &[&Mark]| -> Vec<[Spot; 2]> {
            let line = |(mark, y): (&&Mark, &f64)| [[5.0, *y], mark.at];
            side.iter().zip(&heights).map(line).collect()
        };
        let crossings = |side: &[&Mark]| {
            let lines = lines(side);
            let pairs = (0..4).flat_map(|i| (i + 1..4).map(move |j| (i, j)));
            pairs.filter(|&(i, j)| do_cross(lines[i], lines[j])).count()
        };
        let mut side: Vec<&Mark> = marks.iter().collect();
        assert!(crossings(&side) > 0);
        uncross(&mut side, &heights, |_, y| [5.0, y]);
        assert_eq!(crossings(&side), 0);
    }

    #[test]
    fn a_line_to_a_circle_ends_at_its_rim_and_leaves_it_free() {
        let pin = Mark {
            radius_px: 5.0,
            ..Mark::new([10.0, 20.0], "N1".to_owned())
        };
        assert_eq!(pin.end_from([40.0, 60.0]), [13.0, 24.0]);
        let mut drawing = Drawing::new([100, 100], 5.0);
        drawing.callouts(&[pin]);
        assert!(!drawing.inline("x").contains("<circle"));
    }
}
