//! The map from the plane of a cut to a drawing, and what is measured in that plane.

use crate::draw::Spot;
use crate::geom::{Plane, Point};

/// If the projection of up on the plane is shorter than this, the plane counts as level.
const LEVEL_RATIO: f64 = 0.2;

/// The map from the plane of a cut to the drawing.
pub(super) struct PlaneMap {
    turn: [f64; 2],
    scale: f64,
    offset: Spot,
    /// −1 for a face that is seen from the other side, else 1.
    across: f64,
}

/// A part of a drawing that a section fills.
pub(super) struct Window {
    /// Left, top, right and bottom, pixels. Lower than wide sections leave room at the bottom.
    pub frame_px: [f64; 4],
    /// True for a face that is seen against the plane's normal.
    pub is_mirrored: bool,
}

impl Window {
    /// Returns a window for a face that is seen along the plane's normal.
    pub fn open(frame_px: [f64; 4]) -> Self {
        Self {
            frame_px,
            is_mirrored: false,
        }
    }
}

impl PlaneMap {
    /// Returns the map that turns `up`, a direction in the plane, upward and fills the window.
    pub fn of(rings: &[Vec<[f64; 2]>], up: [f64; 2], window: &Window) -> Self {
        let length = up[0].hypot(up[1]);
        let turn = if length > LEVEL_RATIO {
            up.map(|x| x / length)
        } else {
            [0.0, 1.0]
        };
        let unscaled = Self {
            turn,
            scale: 1.0,
            offset: [0.0; 2],
            across: if window.is_mirrored { -1.0 } else { 1.0 },
        };
        let [low, high] = bounds(rings.iter().flatten().map(|point| unscaled.at(*point)));
        let [left, top, right, bottom] = window.frame_px;
        let fit = |from: f64, to: f64, pixels: f64| pixels / (to - from).max(f64::MIN_POSITIVE);
        let scale = fit(low[0], high[0], right - left).min(fit(low[1], high[1], bottom - top));
        let offset = [
            0.5 * (left + right - scale * (low[0] + high[0])),
            top - scale * low[1],
        ];
        Self {
            scale,
            offset,
            ..unscaled
        }
    }

    /// Returns pixels per mm.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// Returns the spot of a point of the plane.
    pub fn at(&self, [u, v]: [f64; 2]) -> Spot {
        let [x, y] = self.turn;
        [
            self.offset[0] + self.across * self.scale * (u * y - v * x),
            self.offset[1] - self.scale * (u * x + v * y),
        ]
    }
}

/// Returns the least and the greatest coordinates of spots.
pub(super) fn bounds(spots: impl Iterator<Item = Spot>) -> [Spot; 2] {
    spots.fold(
        [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]],
        |[low, high], spot| {
            [
                [low[0].min(spot[0]), low[1].min(spot[1])],
                [high[0].max(spot[0]), high[1].max(spot[1])],
            ]
        },
    )
}

/// Returns twice the area inside a ring, negative for a clockwise ring.
pub(super) fn doubled_area_mm2(ring: &[[f64; 2]]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    ring.iter()
        .zip(next)
        .map(|(a, b)| a[0] * b[1] - a[1] * b[0])
        .sum()
}

/// Returns a point of the plane in its coordinates.
pub(super) fn flat(plane: &Plane, point_mm: &[f64; 3]) -> [f64; 2] {
    let (u, v) = plane.basis();
    let from_origin = Point::from(*point_mm).coords;
    [u.dot(&from_origin), v.dot(&from_origin)]
}

/// Returns whether a point of the plane lies inside a ring.
pub(super) fn is_inside(ring: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let next = ring.iter().cycle().skip(1);
    let crossings = ring.iter().zip(next).filter(|(a, b)| {
        let is_across = (a[1] > y) != (b[1] > y);
        is_across && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
    });
    crossings.count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A window of a drawing.
    const FRAME_PX: [f64; 4] = [230.0, 40.0, 770.0, 540.0];

    fn square(low: f64, high: f64) -> Vec<[f64; 2]> {
        vec![[low, low], [high, low], [high, high], [low, high]]
    }

    #[test]
    fn a_clockwise_ring_has_a_negative_area() {
        let ring = square(1.0, 3.0);
        let back: Vec<[f64; 2]> = ring.iter().rev().copied().collect();
        assert_eq!(
            [doubled_area_mm2(&ring), doubled_area_mm2(&back)],
            [8.0, -8.0]
        );
    }

    #[test]
    fn a_section_fills_the_frame_upright_and_unmirrored() {
        let rings = [square(0.0, 10.0)];
        let window = Window::open(FRAME_PX);
        for up in [[0.0, 1.0], [1.0, 0.0], [-0.6, 0.8]] {
            let map = PlaneMap::of(&rings, up, &window);
            let [origin, above] = [[0.0, 0.0], up].map(|point| map.at(point));
            assert!(
                (above[0] - origin[0]).abs() < 1e-9 && above[1] < origin[1],
                "{up:?}"
            );
            // Up turned clockwise points right: the drawing is not mirrored.
            let right = map.at([up[1], -up[0]]);
            assert!(
                right[0] > origin[0] && (right[1] - origin[1]).abs() < 1e-9,
                "{up:?}"
            );
        }
        let [low, high] = bounds(
            rings[0]
                .iter()
                .map(|point| PlaneMap::of(&rings, [0.0, 1.0], &window).at(*point)),
        );
        assert!((low[1] - FRAME_PX[1]).abs() < 1e-9 && (high[1] - FRAME_PX[3]).abs() < 1e-9);
    }

    #[test]
    fn a_face_seen_from_behind_is_mirrored_and_fills_the_same_window() {
        let rings = [vec![[0.0, 0.0], [10.0, 0.0], [0.0, 10.0]]];
        let window = Window {
            is_mirrored: true,
            ..Window::open(FRAME_PX)
        };
        let map = PlaneMap::of(&rings, [0.0, 1.0], &window);
        let [corner, along, above] = rings[0].clone().try_into().unwrap();
        let [corner, along, above] = [corner, along, above].map(|at: [f64; 2]| map.at(at));
        assert!(along[0] < corner[0] && above[1] < corner[1]);
        assert!((above[1] - FRAME_PX[1]).abs() < 1e-9 && (corner[1] - FRAME_PX[3]).abs() < 1e-9);
        assert!(corner[0] <= FRAME_PX[2] && along[0] >= FRAME_PX[0]);
    }

    #[test]
    fn a_ring_holds_the_points_inside_it_only() {
        let ring = square(0.0, 2.0);
        assert!(is_inside(&ring, [1.0, 0.5]) && !is_inside(&ring, [2.5, 0.5]));
    }
}
