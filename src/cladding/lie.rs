//! The way in which a part lies in the printer's room.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::geom::{Aabb, Frame, Matrix, Point, Vector, hull};
use crate::poses::{of_cube, spread};

/// Length by which rounding may make a part larger than the room, mm.
const ROUNDING_MM: f64 = 1e-6;

/// The way in which a part lies in the printer's room.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lie {
    /// The print's frame in the model: z is up, and the part's box begins at the origin.
    pub frame: Frame,
    /// The extents of the part along the frame's axes, mm.
    pub size_mm: [f64; 3],
}

impl Lie {
    /// Returns how a part with these points fits a room, with the foot down if it does.
    ///
    /// A part that does not fit that way may lie in any other.
    pub fn find(points: &[Point], foot_up: &Vector, room_mm: [f64; 3]) -> Option<Self> {
        let ways = [*foot_up].into_iter().chain(of_cube()).chain(spread());
        let mut lies = ways.filter_map(|up| Self::with_up(points, &up, room_mm));
        lies.next()
    }

    /// Returns how a part fits a room with this direction up, in its best turn about it.
    pub fn with_up(points: &[Point], up: &Vector, room_mm: [f64; 3]) -> Option<Self> {
        let upright = Frame::with_axis(Point::origin(), up);
        let local: Vec<Point> = points.iter().map(|p| upright.to_local(p)).collect();
        if Aabb::of_points(&local).size().z > room_mm[2] + ROUNDING_MM {
            return None;
        }
        let ring = hull::convex_hull(local.iter().map(|p| [p.x, p.y]).collect());
        let turn_rad = best_turn(&ring, [room_mm[0], room_mm[1]])?;
        let (sine, cosine) = turn_rad.sin_cos();
        let local = Matrix::from_columns(&[
            Vector::new(cosine, sine, 0.0),
            Vector::new(-sine, cosine, 0.0),
            Vector::z(),
        ]);
        let axes = upright.axes * local;
        let turned = |p: &Point| Point::from(axes.tr_mul(&p.coords));
        let turned: Vec<Point> = points.iter().map(turned).collect();
        let extent = Aabb::of_points(&turned);
        let size = extent.size();
        Some(Self {
            frame: Frame {
                origin: Point::from(axes * extent.min.coords),
                axes,
            },
            size_mm: [size.x, size.y, size.z],
        })
    }
}

/// Returns the turn, in radians, at which a convex ring uses the least share of a rectangle; `None`
/// if it fits at no turn.
///
/// Between turns at which a side is parallel to the rectangle, both extents are cosines. So the
/// turns that fit begin or end at such a turn, or where an extent is that of the rectangle.
fn best_turn(ring: &[[f64; 2]], room_mm: [f64; 2]) -> Option<f64> {
    let mut breaks = vec![0.0];
    for (k, from) in ring.iter().enumerate() {
        let to = ring[(k + 1) % ring.len()];
        let along = (to[1] - from[1]).atan2(to[0] - from[0]);
        breaks.extend([along, along + FRAC_PI_2].map(|turn| turn.rem_euclid(PI)));
    }
    breaks.sort_by(f64::total_cmp);
    let mut turns = breaks.clone();
    for (k, &from) in breaks.iter().enumerate() {
        let to = breaks.get(k + 1).copied().unwrap_or(breaks[0] + PI);
        for (axis, &room_mm) in room_mm.iter().enumerate() {
            let turn = axis as f64 * FRAC_PI_2;
            let [x, y] = span(ring, 0.5 * (from + to) + turn);
            let angle = (room_mm / x.hypot(y)).acos();
            if angle.is_finite() {
                let ends = [-angle, angle].map(|by| y.atan2(x) + by - turn);
                turns.extend(ends.map(|turn| turn.rem_euclid(PI)));
            }
        }
    }
    let use_ratio = |turn: f64| {
        let extents = [0, 1].map(|axis| {
            let angle = turn + axis as f64 * FRAC_PI_2;
            let [x, y] = span(ring, angle);
            x * angle.cos() + y * angle.sin()
        });
        let fits = (0..2).all(|axis| extents[axis] <= room_mm[axis] + ROUNDING_MM);
        fits.then(|| (extents[0] / room_mm[0]).max(extents[1] / room_mm[1]))
    };
    let fits = turns
        .into_iter()
        .filter_map(|turn| Some((use_ratio(turn)?, turn)));
    let best = fits.reduce(|a, b| if b.0 < a.0 { b } else { a });
    best.map(|(_, turn)| turn)
}

/// Returns the way from the last corner of a ring to the first, seen along a direction.
fn span(ring: &[[f64; 2]], angle: f64) -> [f64; 2] {
    let (sine, cosine) = angle.sin_cos();
    let place = |at: &&[f64; 2]| at[0] * cosine + at[1] * sine;
    let by_place = |a: &&[f64; 2], b: &&[f64; 2]| place(a).total_cmp(&place(b));
    let ends = ring
        .iter()
        .max_by(by_place)
        .zip(ring.iter().min_by(by_place));
    ends.map_or([0.0; 2], |(last, first)| {
        [last[0] - first[0], last[1] - first[1]]
    })
}
