//! A plot of curves with axes and a legend.

use super::palette::{Color, INK, PAPER};
use super::svg::{Anchor, Drawing, Paint, Spot, Stroke};
use crate::base::numbers::number;

/// Width and height, pixels.
const SIZE_PX: [usize; 2] = [720, 460];

/// Height of words, pixels: 7 points at half the width of an A4 page.
const TEXT_PX: f64 = 22.0;

/// The frame of the curves: left, top, right, bottom, pixels.
const FRAME_PX: [f64; 4] = [110.0, 40.0, 690.0, 380.0];

/// Aimed number of intervals between the numbers on an axis.
const TICKS: f64 = 7.0;

/// Room beyond the least and the greatest value, as a share of their difference.
const ROOM_RATIO: f64 = 0.08;

/// Greatest value shown, in multiples of the greatest last value of a curve: worse values only
/// flatten the rest.
const WORST_RATIO: f64 = 4.0;

/// Width of a letter, in heights of the words.
const LETTER_RATIO: f64 = 0.55;

/// A curve and its name.
pub struct Curve {
    /// The name in the legend.
    pub name: &'static str,
    /// The points, across and up.
    pub points: Vec<Spot>,
    /// The colour of line and marks.
    pub color: Color,
    /// A flag for a dashed line with hollow squares as marks, in place of a solid one with discs.
    pub is_second: bool,
}

/// Curves over the same number.
pub struct Plot {
    /// The words at the axis across.
    pub across: String,
    /// The words at the axis up.
    pub up: String,
    /// The curves.
    pub curves: Vec<Curve>,
    /// A point with a name.
    pub mark: Option<(Spot, String)>,
}

impl Plot {
    /// Draws the plot.
    pub fn draw(&self) -> Drawing {
        let mut drawing = Drawing::new(SIZE_PX, TEXT_PX);
        let scales = self.scales();
        draw_axes(&mut drawing, &scales, [&self.across, &self.up]);
        for curve in &self.curves {
            draw_curve(&mut drawing, curve, &scales);
        }
        draw_legend(&mut drawing, &self.curves);
        if let Some((at, words)) = &self.mark {
            let [x, y] = scales
                .each_ref()
                .map(|scale| scale.clamp_at(at[scale.axis]));
            drawing.circle([x, y], 8.0, Paint::filled(PAPER, Stroke::THICK));
            let anchor = if x > 0.6 * SIZE_PX[0] as f64 {
                Anchor::End
            } else {
                Anchor::Start
            };
            let aside = if anchor == Anchor::End { -16.0 } else { 16.0 };
            drawing.text([x + aside, y - 18.0], anchor, words);
        }
        drawing
    }

    /// Returns the scales across and up.
    fn scales(&self) -> [Scale; 2] {
        let [left, top, right, bottom] = FRAME_PX;
        let of = |axis: usize| {
            self.curves
                .iter()
                .flat_map(move |curve| curve.points.iter().map(move |point| point[axis]))
        };
        let marked = self.mark.iter().map(|(at, _)| at[1]);
        let (low, high) = range(of(1).chain(marked));
        let ends = self
            .curves
            .iter()
            .filter_map(|curve| curve.points.last().map(|point| point[1].abs()));
        let (_, end) = range(ends);
        let (low, high) = (low.max(-WORST_RATIO * end), high.min(WORST_RATIO * end));
        let room = ROOM_RATIO * (high - low).max(1e-6 * end);
        let (first, last) = range(of(0));
        [
            Scale {
                axis: 0,
                from: [first, last],
                to: [left, right],
            },
            Scale {
                axis: 1,
                from: [low - room, high + room],
                to: [bottom, top],
            },
        ]
    }
}

/// Returns the least and the greatest of values.
fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (low.min(value), high.max(value))
    })
}

/// The map from numbers to pixels along one axis.
struct Scale {
    axis: usize,
    from: [f64; 2],
    to: [f64; 2],
}

impl Scale {
    fn at(&self, value: f64) -> f64 {
        let share = (value - self.from[0]) / (self.from[1] - self.from[0]).max(f64::MIN_POSITIVE);
        self.to[0] + share * (self.to[1] - self.to[0])
    }

    /// Returns the pixel of a value, with values outside of the axis put on its end.
    fn clamp_at(&self, value: f64) -> f64 {
        self.at(value.clamp(self.from[0], self.from[1]))
    }

    /// Returns the round numbers on the axis, at most 32.
    fn ticks(&self) -> Vec<f64> {
        let step = round_step((self.from[1] - self.from[0]) / TICKS);
        let first = (self.from[0] / step).ceil() as i64;
        (first..)
            .map(|count| count as f64 * step)
            .take_while(|tick| *tick <= self.from[1])
            .take(32)
            .collect()
    }
}

/// Returns the least of 1, 2 and 5 times a power of ten that is not less than `step`.
fn round_step(step: f64) -> f64 {
    let power = 10f64.powf(step.max(f64::MIN_POSITIVE).log10().floor());
    [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|times| times * power)
        .find(|rounded| *rounded >= step)
        .unwrap_or(step)
}

/// Draws the grid, the numbers and the words of both axes.
fn draw_axes(drawing: &mut Drawing, [across, up]: &[Scale; 2], [x_words, y_words]: [&str; 2]) {
    let [left, top, right, bottom] = FRAME_PX;
    let grid = Stroke::solid([201, 206, 212], 1.0);
    for tick in across.ticks() {
        drawing.line([[across.at(tick), top], [across.at(tick), bottom]], grid);
        drawing.text(
            [across.at(tick), bottom + TEXT_PX],
            Anchor::Middle,
            &number(tick),
        );
    }
    for tick in up.ticks() {
        drawing.line([[left, up.at(tick)], [right, up.at(tick)]], grid);
        drawing.text([left - 10.0, up.at(tick)], Anchor::End, &number(tick));
    }
    let frame = vec![[left, top], [left, bottom], [right, bottom]];
    let paint = Paint::line(Stroke::solid(INK, 2.0));
    drawing.path(&[frame], false, paint);
    drawing.text([right, bottom + 2.4 * TEXT_PX], Anchor::End, x_words);
    drawing.text([10.0, 0.6 * TEXT_PX], Anchor::Start, y_words);
}

fn draw_curve(drawing: &mut Drawing, curve: &Curve, [across, up]: &[Scale; 2]) {
    let spots: Vec<Spot> = curve
        .points
        .iter()
        .map(|[x, y]| [across.clamp_at(*x), up.clamp_at(*y)])
        .collect();
    draw_line(drawing, &spots, curve);
}

/// Draws a line with its marks.
fn draw_line(drawing: &mut Drawing, spots: &[Spot], curve: &Curve) {
    let stroke = Stroke {
        dashes: if curve.is_second { "10 6" } else { "" },
        ..Stroke::solid(curve.color, 3.0)
    };
    drawing.path(&[spots.to_vec()], false, Paint::line(stroke));
    for &[x, y] in spots {
        if curve.is_second {
            let square = vec![
                [x - 5.0, y - 5.0],
                [x + 5.0, y - 5.0],
                [x + 5.0, y + 5.0],
                [x - 5.0, y + 5.0],
            ];
            let paint = Paint::filled(PAPER, Stroke::solid(curve.color, 2.5));
            drawing.path(&[square], true, paint);
        } else {
            drawing.circle([x, y], 5.0, Paint::filled(curve.color, Stroke::NONE));
        }
    }
}

/// Draws the names of the curves at the upper right, each with a piece of its line.
fn draw_legend(drawing: &mut Drawing, curves: &[Curve]) {
    let mut right = FRAME_PX[2];
    for curve in curves.iter().rev() {
        let y = 0.6 * TEXT_PX;
        drawing.text([right, y], Anchor::End, curve.name);
        let start = right - LETTER_RATIO * TEXT_PX * curve.name.chars().count() as f64 - 46.0;
        draw_line(drawing, &[[start, y], [start + 36.0, y]], curve);
        right = start - 30.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_lie_on_the_scale() {
        let scale = Scale {
            axis: 0,
            from: [0.13, 1.21],
            to: [0.0, 100.0],
        };
        // A seventh of 1.08 rounds up to 0.2.
        assert_eq!(
            scale
                .ticks()
                .iter()
                .map(|tick| (tick * 10.0).round())
                .collect::<Vec<_>>(),
            [2.0, 4.0, 6.0, 8.0, 10.0, 12.0]
        );
        assert_eq!([0.21, 3.0, 70.0].map(round_step), [0.5, 5.0, 100.0]);
    }

    #[test]
    fn a_scale_maps_its_ends_to_the_frame() {
        let scale = Scale {
            axis: 1,
            from: [2.0, 4.0],
            to: [380.0, 40.0],
        };
        assert_eq!(
            [2.0, 3.0, 4.0].map(|value| scale.at(value)),
            [380.0, 210.0, 40.0]
        );
        assert_eq!(scale.clamp_at(9.0), 40.0);
    }
}
