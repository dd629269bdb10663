//! Openings through the walls between two voids.

use rayon::prelude::*;

use super::prism::corner_mm;
use super::rooms::{Void, Voids};
use crate::cells::{Beyond, Polytope};
use crate::geom::{Plane, Point, Vector};
use crate::mesh::MeshDistance;

/// Reach of an opening into the void on either side, mm: bodies that only touch are not united.
const REACH_MM: f64 = 0.02;
/// Room of an opening to the sides of its wall, in walls. Where three walls meet at 120° it lies
/// 0.134 of a wall too near to the third void without it. That is the worst of all angles.
pub(super) const ROOM_RATIO: f64 = 0.15;
/// The same where two openings beside each other must leave a wall: 1 / (2 sin 60°), for walls that
/// meet at 120°. Openings of a sharper corner do not face each other.
pub(super) const APART_RATIO: f64 = 0.58;
/// The same for the reach into the voids, mm.
const ROOM_MM: f64 = 0.03;
/// Places along each side of a wall's box that are tried.
const PLACES: usize = 16;
/// Halvings of the step around the best place.
const HALVINGS: usize = 8;

/// An opening through the wall between two voids.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Door {
    /// The voids on both sides, by their numbers.
    pub voids: [usize; 2],
    /// The cells on both sides.
    pub cells: [usize; 2],
    /// The ends of its axis, mm.
    pub ends: [Point; 2],
    /// The distance of its axis to the sides of the wall, mm.
    pub room_mm: f64,
}

/// The sizes of openings.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sizes {
    /// The wall, mm.
    pub wall_mm: f64,
    /// The free diameter, mm.
    pub opening_mm: f64,
    /// The room of openings to the sides of their walls besides, in walls.
    pub room_ratio: f64,
}

impl Sizes {
    /// Returns the distance that an opening's axis keeps from the sides of its wall, mm.
    pub fn room_mm(self) -> f64 {
        corner_mm(self.opening_mm) + self.room_ratio * self.wall_mm + ROOM_MM
    }
}

/// Returns an opening in every wall that can hold one: at the place farthest from its sides, or as
/// far `down` as one fits.
pub(super) fn doors(
    voids: &Voids,
    cavity: &MeshDistance,
    sizes: Sizes,
    down: Option<Vector>,
) -> Vec<Door> {
    let pairs = voids.drawn_in.iter().enumerate().flat_map(|(one, drawn)| {
        let faces = drawn.faces().iter();
        faces.filter_map(move |face| match face.beyond {
            Beyond::Cell(other) if other > one => Some([one, other]),
            _ => None,
        })
    });
    let pairs: Vec<[usize; 2]> = pairs.collect();
    let found = pairs.into_par_iter().filter_map(|cells| {
        let wall = Wall::between(cells, &voids.drawn_in, sizes)?;
        let (at, room_mm) = match down {
            Some(down) => wall.lowest(&down, cavity)?,
            None => {
                let (at, room_mm) = wall.widest(cavity)?;
                (wall.place(&at), room_mm)
            }
        };
        let half = wall.plane.normal * wall.half_mm();
        let ends = [at - half, at + half];
        let void = |side: usize| {
            let holds = |void: &Void| void.distance.signed(&ends[side]) > 0.0;
            let of_cell = |void: &&Void| void.cell == cells[side];
            let here = voids.all.partition_point(|void| void.cell < cells[side]);
            let here_on = voids.all[here..].iter().take_while(of_cell);
            here_on.clone().position(holds).map(|index| here + index)
        };
        Some(Door {
            voids: [void(0)?, void(1)?],
            cells,
            ends,
            room_mm,
        })
    });
    found.collect()
}

/// The wall between two cells.
struct Wall {
    /// The plane in its middle, toward the second cell.
    plane: Plane,
    axes: [Vector; 2],
    /// The corners of the faces of both voids, in the plane.
    rings: [Vec<[f64; 2]>; 2],
    sizes: Sizes,
}

impl Wall {
    /// Returns the wall between two cells; `None` if they do not face each other.
    fn between(cells: [usize; 2], drawn_in: &[Polytope], sizes: Sizes) -> Option<Self> {
        let [one, other] = cells;
        let face = |from: usize, to: usize| {
            let mut faces = drawn_in[from].faces().iter();
            faces.find(|face| face.beyond == Beyond::Cell(to))
        };
        let faces = [face(one, other)?, face(other, one)?];
        let near = faces[0].plane;
        let plane = Plane {
            offset_mm: near.offset_mm + 0.5 * sizes.wall_mm,
            ..near
        };
        let (u, v) = plane.basis();
        let flat = |at: &Point| [u.dot(&at.coords), v.dot(&at.coords)];
        Some(Self {
            plane,
            axes: [u, v],
            rings: faces.map(|face| face.ring.iter().map(flat).collect()),
            sizes,
        })
    }

    fn half_mm(&self) -> f64 {
        0.5 * self.sizes.wall_mm + REACH_MM
    }

    /// Returns the place that is farthest from the sides of the wall and from the skin, with that
    /// distance; `None` if no opening fits there.
    fn widest(&self, cavity: &MeshDistance) -> Option<([f64; 2], f64)> {
        let (places, mut step) = self.places();
        let better = |best: ([f64; 2], f64), at: [f64; 2]| {
            let room = self.room_mm(&at, best.1, cavity);
            if room > best.1 { (at, room) } else { best }
        };
        let mut best = places.into_iter().fold(([0.0; 2], 0.0), better);
        for _ in 0..HALVINGS {
            step = step.map(|step| 0.5 * step);
            best = around(best.0, step).fold(best, better);
        }
        (best.1 >= self.sizes.room_mm()).then_some(best)
    }

    /// Returns the place that is farthest down of those that hold an opening, with its distance
    /// from the sides of the wall; `None` if no opening fits.
    fn lowest(&self, down: &Vector, cavity: &MeshDistance) -> Option<(Point, f64)> {
        let widest = self.widest(cavity)?;
        let need_mm = self.sizes.room_mm();
        let depth = |at: &[f64; 2]| down.dot(&self.place(at).coords);
        let lower = |best: ([f64; 2], f64), at: [f64; 2]| {
            if depth(&at) <= depth(&best.0) {
                return best;
            }
            let room_mm = self.room_mm(&at, need_mm, cavity);
            if room_mm > need_mm {
                (at, room_mm)
            } else {
                best
            }
        };
        let (places, mut step) = self.places();
        let mut best = places.into_iter().fold(widest, lower);
        for _ in 0..HALVINGS {
            // A place beside may be lower than the one below.
            for _ in 0..PLACES {
                let next = around(best.0, step).fold(best, lower);
                if next.0 == best.0 {
                    break;
                }
                best = next;
            }
            step = step.map(|step| 0.5 * step);
        }
        Some((self.place(&best.0), best.1))
    }

    /// Returns places all over the wall's box, and the steps between them.
    fn places(&self) -> (Vec<[f64; 2]>, [f64; 2]) {
        let all = || self.rings[0].iter();
        let range = |axis: usize| {
            let along = all().map(|at| at[axis]);
            along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| {
                [low.min(x), high.max(x)]
            })
        };
        let ranges = [range(0), range(1)];
        let step = ranges.map(|[low, high]| (high - low) / PLACES as f64);
        let places = (0..PLACES * PLACES).map(|k| {
            let shares = [k % PLACES, k / PLACES].map(|k| k as f64 + 0.5);
            [0, 1].map(|axis| ranges[axis][0] + shares[axis] * step[axis])
        });
        (places.collect(), step)
    }

    fn place(&self, at: &[f64; 2]) -> Point {
        self.plane.foot() + self.axes[0] * at[0] + self.axes[1] * at[1]
    }

    /// Returns the distance from the sides of the wall, mm. It may be too small where it is not
    /// more than a known one.
    fn room_mm(&self, at: &[f64; 2], known_mm: f64, cavity: &MeshDistance) -> f64 {
        let inside = self.rings.iter().map(|ring| depth_mm(ring, at));
        let inside = inside.fold(f64::INFINITY, f64::min);
        if inside <= known_mm {
            return inside;
        }
        // A ball of this depth holds a cylinder through the wall.
        let depth = cavity.signed(&self.place(at));
        let across = depth * depth - self.half_mm() * self.half_mm();
        if depth <= 0.0 || across <= 0.0 {
            return 0.0;
        }
        inside.min(across.sqrt())
    }
}

/// Returns a place and the eight around it.
fn around([x, y]: [f64; 2], step: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
    (0..9).map(move |k| {
        let [i, j] = [k % 3, k / 3].map(|k| f64::from(k) - 1.0);
        [x + i * step[0], y + j * step[1]]
    })
}

/// Returns the distance of a point to the sides of a convex ring; negative outside.
fn depth_mm(ring: &[[f64; 2]], [x, y]: &[f64; 2]) -> f64 {
    let next = || ring.iter().cycle().skip(1);
    let turn: f64 = ring
        .iter()
        .zip(next())
        .map(|(a, b)| a[0] * b[1] - a[1] * b[0])
        .sum();
    let depths = ring.iter().zip(next()).map(|(a, b)| {
        let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
        let length = dx.hypot(dy);
        if length == 0.0 {
            return f64::INFINITY;
        }
        turn.signum() * (dx * (y - a[1]) - dy * (x - a[0])) / length
    });
    depths.fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_depth_is_that_to_the_nearest_side_whichever_way_the_ring_runs() {
        let mut ring = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [4.0, 4.0], [0.0, 4.0]];
        for _ in 0..2 {
            assert!((depth_mm(&ring, &[1.0, 2.0]) - 1.0).abs() < 1e-12);
            assert!((depth_mm(&ring, &[5.0, 2.0]) + 1.0).abs() < 1e-12);
            ring.reverse();
        }
    }
}
