//! The surfaces of pins, sockets and engraved ids, built from what the checklist states of them.

use std::f64::consts::{PI, TAU};

use super::{Mark, Peg};
use crate::geom::{Point, Vector, orthonormal_basis};

/// Number of sides of every pin and socket.
const SIDES: usize = 48;
/// Number of halvings in the search for a chamfer, enough for double precision.
const HALVINGS: usize = 60;

/// Distance from one character to the next, in strokes.
const ADVANCE: f64 = 5.5;
/// The seven strokes of a character, [left, right, bottom, top] in strokes from its lower left
/// corner. Bottom, middle and top come first, then left and right, each from below.
const STROKES: [[f64; 4]; 7] = [
    [0.0, 4.0, 0.0, 1.0],
    [0.0, 4.0, 3.5, 4.5],
    [0.0, 4.0, 7.0, 8.0],
    [0.0, 1.0, 1.4, 3.1],
    [0.0, 1.0, 4.9, 6.6],
    [3.0, 4.0, 1.4, 3.1],
    [3.0, 4.0, 4.9, 6.6],
];

/// The oriented surface of a pin, socket or stroke as the part has it.
#[derive(Debug, Default)]
pub(super) struct Relief {
    /// The triangles of the part that has it.
    pub(super) own: Vec<[Point; 3]>,
    /// Its mouth in the cut, turned as the face of the part on the other side is.
    pub(super) mouth: Vec<[Point; 3]>,
    /// The base of a pin, inside its part.
    pub(super) base: Vec<[Point; 3]>,
}

impl Peg {
    /// Returns the surface of a pin, without its base.
    pub(super) fn pin_relief(&self) -> Relief {
        let (radius, length) = (0.5 * self.diameter_mm, self.length_mm);
        let full = prism_factor() * radius * radius * length;
        let chamfer = find_chamfer_mm(full - self.volume_mm3, radius, -1.0, length);
        let profile = [
            (radius, 0.0),
            (radius, length - chamfer),
            (radius - chamfer, length),
        ];
        Relief {
            own: self.revolve(&profile),
            base: self.disc(profile[0]),
            ..Relief::default()
        }
    }

    /// Returns the surface of a socket, and its mouth.
    pub(super) fn socket_relief(&self) -> Relief {
        // The sides of a socket touch its circle; the corners of a pin lie on its own.
        let radius = 0.5 * self.diameter_mm / (PI / SIDES as f64).cos();
        let full = prism_factor() * radius * radius * self.length_mm;
        let chamfer = find_chamfer_mm(self.volume_mm3 - full, radius, 1.0, self.length_mm);
        let profile = [
            (radius + chamfer, 0.0),
            (radius, chamfer),
            (radius, self.length_mm),
        ];
        Relief {
            own: turn_over(self.revolve(&profile)),
            mouth: self.disc(profile[0]),
            ..Relief::default()
        }
    }

    /// Returns the disc within a ring, facing along the axis.
    fn disc(&self, ring: (f64, f64)) -> Vec<[Point; 3]> {
        let hub = self.corner((0.0, ring.1), 0);
        let sides = 0..SIDES;
        let fan = sides.map(|side| [hub, self.corner(ring, side), self.corner(ring, side + 1)]);
        fan.collect()
    }

    /// Returns a corner of the ring with this radius and height.
    fn corner(&self, (radius, height): (f64, f64), side: usize) -> Point {
        let axis = Vector::from(self.axis).normalize();
        let (u, v) = orthonormal_basis(&axis);
        let (sin, cos) = (TAU * (side % SIDES) as f64 / SIDES as f64).sin_cos();
        Point::from(self.center_mm) + (u * cos + v * sin) * radius + axis * height
    }

    /// Returns the sides and the end of a body of revolution, turned outward. The profile rises.
    fn revolve(&self, profile: &[(f64, f64); 3]) -> Vec<[Point; 3]> {
        let mut triangles = self.disc(profile[2]);
        for side in 0..SIDES {
            for rings in profile.windows(2) {
                let [a, b] = [side, side + 1].map(|k| self.corner(rings[0], k));
                let [c, d] = [side + 1, side].map(|k| self.corner(rings[1], k));
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
        triangles
    }
}

impl Mark {
    /// Returns the surface of the strokes, and their mouths. Empty if the stated strokes are not
    /// those of its text.
    pub(super) fn relief(&self) -> Relief {
        let strokes = strokes_of(&self.text);
        let Some((right, up)) = self.find_directions(&strokes) else {
            return Relief::default();
        };
        let into = Vector::from(self.axis).normalize();
        let mut relief = Relief::default();
        for ([left, to_right, bottom, top], middle) in strokes.iter().zip(&self.strokes_mm) {
            let half = [to_right - left, top - bottom].map(|size| 0.5 * size * self.stroke_mm);
            let corner = |x: f64, y: f64, deep: f64| {
                Point::from(*middle)
                    + right * (x * half[0])
                    + up * (y * half[1])
                    + into * (deep * self.depth_mm)
            };
            let ring = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
            let rim = ring.map(|(x, y)| corner(x, y, 0.0));
            let floor = ring.map(|(x, y)| corner(x, y, 1.0));
            // Counter-clockwise for whoever looks into the part.
            relief.own.extend(halve(floor));
            relief.mouth.extend(turn_over(halve(rim)));
            for i in 0..4 {
                let j = (i + 1) % 4;
                relief
                    .own
                    .extend(halve([rim[i], rim[j], floor[j], floor[i]]));
            }
        }
        relief
    }

    /// Returns the directions to the right and up; `None` if the stated middles are not those of
    /// the strokes.
    fn find_directions(&self, strokes: &[[f64; 4]]) -> Option<(Vector, Vector)> {
        if strokes.len() != self.strokes_mm.len() {
            return None;
        }
        let flat = |[left, right, bottom, top]: [f64; 4]| {
            [0.5 * (left + right), 0.5 * (bottom + top)].map(|x| x * self.stroke_mm)
        };
        let [from, to] = [flat(*strokes.first()?), flat(*strokes.last()?)];
        let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
        let way = Point::from(*self.strokes_mm.last()?) - Point::from(*self.strokes_mm.first()?);
        let along = way.try_normalize(0.0)?;
        let across = along.cross(&Vector::from(self.axis).try_normalize(0.0)?);
        let length = dx.hypot(dy);
        Some((
            (along * dx - across * dy) / length,
            (along * dy + across * dx) / length,
        ))
    }
}

/// Returns the area of a polygon of [`SIDES`] sides whose corners have distance 1 from its middle.
fn prism_factor() -> f64 {
    0.5 * SIDES as f64 * (TAU / SIDES as f64).sin()
}

/// Returns the chamfer that changes a prism by this volume, mm. It widens the prism's end if `sign`
/// is 1, and narrows it if it is -1.
fn find_chamfer_mm(change_mm3: f64, radius_mm: f64, sign: f64, length_mm: f64) -> f64 {
    let change = |c: f64| prism_factor() * c * c * (radius_mm + sign * c / 3.0);
    let (mut low, mut high) = (0.0, radius_mm.min(length_mm));
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if change(middle) < change_mm3 {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// Returns the strokes of a text, in strokes; characters without strokes have none.
fn strokes_of(text: &str) -> Vec<[f64; 4]> {
    let of_character = |(index, character): (usize, char)| {
        let shift = ADVANCE * index as f64;
        let strokes = segments_of(character).iter().map(|&stroke| STROKES[stroke]);
        strokes.map(move |[left, right, bottom, top]| [left + shift, right + shift, bottom, top])
    };
    text.chars().enumerate().flat_map(of_character).collect()
}

/// Returns the strokes of a character, as on a display of seven segments.
fn segments_of(character: char) -> &'static [usize] {
    match character {
        '0' => &[0, 2, 3, 4, 5, 6],
        '1' => &[5, 6],
        '2' => &[0, 1, 2, 3, 6],
        '3' => &[0, 1, 2, 5, 6],
        '4' => &[1, 4, 5, 6],
        '5' => &[0, 1, 2, 4, 5],
        '6' => &[0, 1, 2, 3, 4, 5],
        '7' => &[2, 5, 6],
        '8' => &[0, 1, 2, 3, 4, 5, 6],
        '9' => &[0, 1, 2, 4, 5, 6],
        'P' => &[1, 2, 3, 4, 6],
        _ => &[],
    }
}

/// Returns the two triangles of a rectangle.
fn halve([a, b, c, d]: [Point; 4]) -> Vec<[Point; 3]> {
    vec![[a, b, c], [a, c, d]]
}

/// Turns triangles over.
fn turn_over(triangles: Vec<[Point; 3]>) -> Vec<[Point; 3]> {
    triangles.into_iter().map(|[a, b, c]| [a, c, b]).collect()
}
