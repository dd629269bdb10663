//! Faces added and dropped until no limit is broken.

use super::dropping::drop_cheapest;
use super::growth::{Growth, Tilts};
use super::limits::LimitKind;
use super::side::Side;
use crate::base::random::Random;
use crate::geom::{Plane, Point};

/// Depths of a bevel below the edge that it takes away, over the least width of a face.
const BEVELS: [f64; 3] = [0.4, 0.7, 1.1];
/// Rounds of random moves after a face was added or dropped.
const SETTLING: usize = 40;
/// The tilts of the growth after a face was added or dropped.
const AFTER: Tilts = Tilts {
    first: 0.12,
    least: 0.02,
};
/// Most faces that are added or dropped.
const MOST_MOVES: usize = 6;

/// Adds bevels along sharp edges and drops faces while that raises the merit.
pub(super) fn mend<'a>(mut growth: Growth<'a>, faces: usize, random: &mut Random) -> Growth<'a> {
    for _ in 0..MOST_MOVES {
        let breaches = growth.breaches();
        if breaches.is_empty() {
            break;
        }
        let sharp = breaches.iter().filter(|b| b.kind == LimitKind::Sharp);
        let bevels = sharp.flat_map(|b| bevelled(&growth, b.planes));
        let mut tries: Vec<Growth> = bevels.collect();
        tries.extend(drop_cheapest(&mut growth));
        let settled = tries
            .into_iter()
            .filter_map(|next| settled(next, faces, random));
        let best = settled.reduce(|a, b| if b.merit_mm3 > a.merit_mm3 { b } else { a });
        match best {
            Some(best) if best.merit_mm3 > growth.merit_mm3 => growth = best,
            _ => break,
        }
    }
    growth
}

/// Returns the growth with a bevel along the edge of two faces, at several depths.
fn bevelled<'a>(growth: &Growth<'a>, [f, g]: [usize; 2]) -> Vec<Growth<'a>> {
    let edges = growth.body.edges().into_iter();
    let mut edge = edges.filter(|edge| edge.planes == [f, g] || edge.planes == [g, f]);
    let Some(edge) = edge.next_back() else {
        return Vec::new();
    };
    let normals = [f, g].map(|face| growth.planes[face].normal);
    let Some(normal) = (normals[0] + normals[1]).try_normalize(1e-9) else {
        return Vec::new();
    };
    let middle: Point = nalgebra::center(&edge.ends[0], &edge.ends[1]);
    let bevels = BEVELS.iter().filter_map(|depth| {
        let depth_mm = depth * growth.terms.limits.least_width_mm;
        let plane = Plane::through(&(middle - normal * depth_mm), &normal);
        growth.with_side(Side {
            plane,
            is_locked: false,
        })
    });
    bevels.collect()
}

/// Drops faces that are too many, and settles the rest.
fn settled<'a>(mut growth: Growth<'a>, faces: usize, random: &mut Random) -> Option<Growth<'a>> {
    growth.settle(SETTLING, random);
    while growth.planes.len() > faces {
        growth = drop_cheapest(&mut growth)?;
        growth.settle(SETTLING, random);
    }
    growth.grow(AFTER);
    growth.settle(SETTLING, random);
    Some(growth)
}
