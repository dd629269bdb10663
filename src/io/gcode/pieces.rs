//! Cuts a stroke into pieces of equal length.

use super::machine::Stroke;
use crate::geom::Point;
use crate::mass::Turn;

/// A piece of a stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// Start, mm.
    pub from: Point,
    /// Halfway, mm.
    pub middle: Point,
    /// End, mm.
    pub to: Point,
    /// Its turn, if it is an arc.
    pub turn: Option<Turn>,
    /// Its length seen from above, mm.
    pub length_mm: f64,
}

/// Most pieces of one stroke. A longer stroke than a hundred metres gets longer pieces.
const MOST_PIECES: f64 = 1e5;

/// Cuts a stroke into equal pieces that are no longer than asked for, mm.
pub fn cut(stroke: &Stroke, longest_mm: f64) -> Vec<Piece> {
    let length_mm = length_mm(stroke);
    let count = (length_mm / longest_mm).ceil().clamp(1.0, MOST_PIECES);
    let turn = stroke.turn.map(|turn| Turn {
        angle_rad: turn.angle_rad / count,
        ..turn
    });
    let place = |index: f64| place(stroke, index / count);
    let piece = |index: u32| Piece {
        from: place(f64::from(index)),
        middle: place(f64::from(index) + 0.5),
        to: place(f64::from(index) + 1.0),
        turn,
        length_mm: length_mm / count,
    };
    (0..count as u32).map(piece).collect()
}

/// Returns the length of a stroke seen from above, mm.
fn length_mm(stroke: &Stroke) -> f64 {
    let along = stroke.to - stroke.from;
    match stroke.turn {
        Some(turn) => {
            let [x, y] = turn.axis_mm;
            (stroke.from.x - x).hypot(stroke.from.y - y) * turn.angle_rad.abs()
        }
        None => along.x.hypot(along.y),
    }
}

/// Returns the place after a share of a stroke.
fn place(stroke: &Stroke, share: f64) -> Point {
    // The last piece ends where the stroke does, to the last digit.
    if share >= 1.0 {
        return stroke.to;
    }
    let straight = stroke.from + (stroke.to - stroke.from) * share;
    let Some(turn) = stroke.turn else {
        return straight;
    };
    let [x, y] = turn.axis_mm;
    let (sin, cos) = (turn.angle_rad * share).sin_cos();
    let (dx, dy) = (stroke.from.x - x, stroke.from.y - y);
    Point::new(x + cos * dx - sin * dy, y + sin * dx + cos * dy, straight.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn a_line_is_cut_into_equal_pieces_that_join() {
        let stroke = Stroke {
            from: Point::new(1.0, 2.0, 3.0),
            to: Point::new(6.0, 2.0, 4.0),
            turn: None,
            feed: 1.0,
        };
        let pieces = cut(&stroke, 2.0);
        assert_eq!(pieces.len(), 3);
        assert_eq!((pieces[0].from, pieces[2].to), (stroke.from, stroke.to));
        for pair in pieces.windows(2) {
            assert_eq!(pair[0].to, pair[1].from);
        }
        assert!((pieces[1].middle - Point::new(3.5, 2.0, 3.5)).norm() < 1e-12);
    }

    #[test]
    fn an_arc_is_cut_into_arcs_about_the_same_axis() {
        let stroke = Stroke {
            from: Point::new(10.0, 0.0, 0.2),
            to: Point::new(0.0, 10.0, 0.2),
            turn: Some(Turn {
                axis_mm: [0.0, 0.0],
                angle_rad: FRAC_PI_2,
            }),
            feed: 1.0,
        };
        let pieces = cut(&stroke, 2.0);
        assert_eq!(pieces.len(), 8);
        assert!((pieces[0].length_mm - 10.0 * PI / 16.0).abs() < 1e-12);
        let middle = pieces[4].from;
        assert!((middle.x - 50.0_f64.sqrt()).abs() < 1e-12 && (middle.x - middle.y).abs() < 1e-12);
    }
}
