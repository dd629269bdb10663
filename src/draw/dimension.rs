//! Lengths on a drawing, and lines that show where things belong.

use super::palette::{INK, PAPER};
use super::svg::{Anchor, Drawing, Paint, Spot, Stroke};

/// A line is upright if it goes sideways by less than this share of its height.
const UPRIGHT_RATIO: f64 = 0.1;

impl Drawing {
    /// Adds a dimension between two spots, drawn `aside` of them: extension lines, a line with dots
    /// at its ends, and its words.
    pub fn dimension(&mut self, [a, b]: [Spot; 2], aside: Spot, words: &str) {
        let moved = |[x, y]: Spot, times: f64| [x + times * aside[0], y + times * aside[1]];
        let (from, to) = (moved(a, 1.0), moved(b, 1.0));
        for (end, spot) in [(from, a), (to, b)] {
            self.line(
                [spot, [end[0] + 0.15 * aside[0], end[1] + 0.15 * aside[1]]],
                Stroke::solid(INK, 0.8),
            );
        }
        self.line([from, to], Stroke::THIN);
        for end in [from, to] {
            self.circle(end, 3.0, Paint::filled(INK, Stroke::NONE));
        }
        let length = aside[0].hypot(aside[1]).max(f64::MIN_POSITIVE);
        if (from[0] - to[0]).abs() < UPRIGHT_RATIO * (from[1] - to[1]).abs() {
            // There may be no room beside an upright line.
            let top = if from[1] < to[1] { from } else { to };
            return self.text([top[0], top[1] - self.text_px()], Anchor::Middle, words);
        }
        let out = 1.0 + self.text_px() / length;
        let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
        let anchor = match aside[0] / length {
            lean if lean > 0.5 => Anchor::Start,
            lean if lean < -0.5 => Anchor::End,
            _ => Anchor::Middle,
        };
        self.text(moved(middle, out), anchor, words);
    }

    /// Adds a dashed line that is visible on dark colours too.
    pub fn dashed_line(&mut self, ends: [Spot; 2]) {
        self.line(ends, Stroke::solid(PAPER, 4.5));
        self.line(
            ends,
            Stroke {
                width: 2.0,
                ..Stroke::DASHED
            },
        );
    }
}
