//! The parts of a unit as they lie on the bench, drawn off each other along their pins.

use super::made::Made;
use crate::geom::{Frame, Point, Vector};
use crate::mass::Lump;
use crate::mesh::{TriMesh, primitives};
use crate::verify::UnitPromise;

/// Distance between parts on the bench, in lengths of the longest pin: pins stand free of sockets.
const APART_LENGTHS: f64 = 4.0;
/// Sides of a drawn disc.
const SIDES: u32 = 48;

/// Returns the way of each part of the shell off the first part of its unit, mm. Parts that no
/// pins join to others of their unit stay.
///
/// Each joint parts its two parts along its pins. All that is on one side of a cut moves alike,
/// since cuts of one unit form a tree.
pub fn bench_shifts(made: &Made, units: &[UnitPromise]) -> Vec<Vector> {
    let shell = &made.built.shell;
    let unit_of = |part: usize| {
        let name = &made.names.parts[part];
        units.iter().position(|unit| unit.parts.contains(name))
    };
    let joints = shell.pins.iter().filter(|joint| {
        let [on, into] = joint.parts.map(unit_of);
        on == into
    });
    let ways = joints.filter_map(|joint| {
        let first = joint.sites.first()?;
        Some((joint.parts, Vector::from(first.direction)))
    });
    let ways: Vec<([usize; 2], Vector)> = ways.collect();
    let lengths = shell.pins.iter().flat_map(|joint| &joint.sites);
    let longest_mm = lengths.map(|site| site.length_mm).fold(0.0, f64::max);
    drawn_apart(shell.parts.len(), &ways)
        .into_iter()
        .map(|way| way * (APART_LENGTHS * longest_mm))
        .collect()
}

/// Returns the way of each part: along all joints that lead to it from the first part that it hangs
/// together with.
fn drawn_apart(parts: usize, joints: &[([usize; 2], Vector)]) -> Vec<Vector> {
    let mut ways: Vec<Option<Vector>> = vec![None; parts];
    for first in 0..parts {
        if ways[first].is_some() {
            continue;
        }
        ways[first] = Some(Vector::zeros());
        let mut waiting = vec![first];
        while let Some(here) = waiting.pop() {
            let from = ways[here].unwrap_or_default();
            for ([on, into], way) in joints {
                let (next, by) = match here {
                    at if at == *on => (*into, *way),
                    at if at == *into => (*on, -way),
                    _ => continue,
                };
                if ways[next].is_none() {
                    ways[next] = Some(from + by);
                    waiting.push(next);
                }
            }
        }
    }
    ways.into_iter().map(Option::unwrap_or_default).collect()
}

/// Returns a round piece of ballast as it is drawn: a cylinder of its radius and height.
pub fn disc(lump: &Lump) -> TriMesh {
    let height_mm = 2.0 * lump.shape.half_height_mm();
    let frame = Frame::with_axis(Point::from(lump.center_mm), &Vector::from(lump.axis));
    let body = primitives::cylinder(lump.shape.radius_mm(), height_mm, SIDES);
    body.map_vertices(|p| frame.to_model(&(p - Vector::z() * (0.5 * height_mm))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mass::LumpShape;

    #[test]
    fn four_parts_of_two_cuts_lie_apart_as_a_grid_and_others_stay() {
        let (x, y) = (Vector::x(), Vector::y());
        // 0 and 1 beside each other, 2 and 3 above them; pins of the second row point back.
        let joints = [([0, 1], x), ([3, 2], -x), ([0, 2], y), ([1, 3], y)];
        let ways = drawn_apart(5, &joints);
        assert_eq!(ways, [Vector::zeros(), x, y, x + y, Vector::zeros()]);
    }

    #[test]
    fn a_disc_is_drawn_where_it_lies() {
        let lump = Lump {
            shape: LumpShape::Disc {
                diameter_mm: 50.0,
                thickness_mm: 10.0,
            },
            mass_g: 150.0,
            center_mm: [10.0, 20.0, 30.0],
            axis: [1.0, 0.0, 0.0],
        };
        let bounds = disc(&lump).aabb();
        assert!(
            (bounds.min - Point::new(5.0, -5.0, 5.0)).norm() < 0.2,
            "{bounds:?}"
        );
        assert!(
            (bounds.max - Point::new(15.0, 45.0, 55.0)).norm() < 0.2,
            "{bounds:?}"
        );
    }
}
