//! Arcs: from the words of a program to an axis and an angle.

use std::f64::consts::TAU;

use crate::geom::Point;
use crate::mass::Turn;

/// Ends nearer than this are one place, mm; the arc is then a full circle.
const SAME_MM: f64 = 1e-9;
/// Distance by which an arc may end off its circle, mm, and its share of the radius. Slicers round
/// to micrometres, which matters most for the flattest arcs.
const OFF_MM: f64 = 0.05;
const OFF_RATIO: f64 = 0.01;

/// The centre of an arc as a program gives it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Centre {
    /// Its x and y, mm.
    At([f64; 2]),
    /// The radius, mm; below zero for the long way round.
    Radius(f64),
}

/// Returns the turn of an arc; `way` is 1 counter-clockwise and −1 clockwise.
///
/// An arc that ends where it starts is a full circle. The error says what is wrong with the arc.
pub fn turn(from: &Point, to: &Point, centre: Centre, way: f64) -> Result<Turn, &'static str> {
    let [x, y] = match centre {
        Centre::At(place) => place,
        Centre::Radius(radius) => centre_at_radius(from, to, radius, way)?,
    };
    let start = [from.x - x, from.y - y];
    let end = [to.x - x, to.y - y];
    let radius = start[0].hypot(start[1]);
    let off = (end[0].hypot(end[1]) - radius).abs();
    if off > OFF_MM + OFF_RATIO * radius {
        return Err("ends off its circle");
    }
    let is_circle = (to.x - from.x).abs() < SAME_MM && (to.y - from.y).abs() < SAME_MM;
    let cross = start[0] * end[1] - start[1] * end[0];
    let dot = start[0] * end[0] + start[1] * end[1];
    let angle = (way * cross).atan2(dot);
    let angle = if is_circle {
        TAU
    } else {
        angle.rem_euclid(TAU)
    };
    Ok(Turn {
        axis_mm: [x, y],
        angle_rad: way * angle,
    })
}

/// Returns the centre of an arc given by its radius: on the left of the way for the short arc
/// counter-clockwise.
fn centre_at_radius(
    from: &Point,
    to: &Point,
    radius: f64,
    way: f64,
) -> Result<[f64; 2], &'static str> {
    let [dx, dy] = [to.x - from.x, to.y - from.y];
    let chord = dx.hypot(dy);
    if chord < SAME_MM {
        return Err("has a radius, but ends where it starts");
    }
    let square = radius * radius - 0.25 * chord * chord;
    if square < -2.0 * OFF_MM * radius.abs() {
        return Err("has a radius that is too small for its ends");
    }
    let side = way * radius.signum() * square.max(0.0).sqrt() / chord;
    Ok([
        0.5 * (from.x + to.x) - side * dy,
        0.5 * (from.y + to.y) + side * dx,
    ])
}
