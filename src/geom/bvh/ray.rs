//! Intersections of a segment or a vertical ray with boxes and triangles.

use crate::geom::{Aabb, Point, Vector};

/// Returns the point at which the segment from `a` along 1/`inverse` enters the box, as a share of
/// its length. `None` if it misses the box. The slab test of Kay and Kajiya (1986).
#[inline]
pub(super) fn box_entry(a: &Point, inverse: &Vector, aabb: &Aabb) -> Option<f64> {
    let low = (aabb.min - a).component_mul(inverse);
    let high = (aabb.max - a).component_mul(inverse);
    // A segment that lies in a face of the box gives 0/0; sup and inf then keep the other number.
    let enter = (0..3).map(|i| low[i].min(high[i])).fold(0.0, f64::max);
    let leave = (0..3).map(|i| low[i].max(high[i])).fold(1.0, f64::min);
    (enter <= leave).then_some(enter)
}

/// Returns the point at which the segment from `a` along `along` passes through the triangle, as a
/// share of its length. `None` if it does not (Möller and Trumbore, 1997).
#[inline]
pub(super) fn triangle_crossing(a: &Point, along: &Vector, [p, q, r]: &[Point; 3]) -> Option<f64> {
    let (first, second) = (q - p, r - p);
    let normal = along.cross(&second);
    let determinant = first.dot(&normal);
    if determinant == 0.0 {
        return None;
    }
    let from = (a - p) / determinant;
    let across = from.cross(&first);
    let (u, v, t) = (from.dot(&normal), along.dot(&across), second.dot(&across));
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && (0.0..=1.0).contains(&t)).then_some(t)
}

/// Returns true if the ray from `p` along +z may meet the box.
#[inline]
pub(super) fn is_above(p: &Point, aabb: &Aabb) -> bool {
    aabb.max.z >= p.z
        && aabb.min.x <= p.x
        && p.x <= aabb.max.x
        && aabb.min.y <= p.y
        && p.y <= aabb.max.y
}

/// Returns +1 or −1 if the ray from `p` along +z leaves or enters through the triangle, else 0.
///
/// Computes the projected triangle's winding about `p` by half-open edge crossings. So a ray
/// through a common edge of triangles counts exactly once.
#[inline]
pub(super) fn crossing(p: &Point, corners: &[Point; 3]) -> i32 {
    let winding: i32 = (0..3)
        .map(|i| edge_crossing(p, &corners[i], &corners[(i + 1) % 3]))
        .sum();
    if winding == 0 {
        return 0;
    }
    let [a, b, c] = corners.map(|v| robust::Coord3D {
        x: v.x,
        y: v.y,
        z: v.z,
    });
    let below = robust::orient3d(
        a,
        b,
        c,
        robust::Coord3D {
            x: p.x,
            y: p.y,
            z: p.z,
        },
    );
    if below * f64::from(winding) > 0.0 {
        winding
    } else {
        0
    }
}

/// Returns the crossing of the ray from `p` along +x, in the plane, with an edge: +1 upward, −1
/// downward.
#[inline]
fn edge_crossing(p: &Point, from: &Point, to: &Point) -> i32 {
    let upward = from.y <= p.y && p.y < to.y;
    let downward = to.y <= p.y && p.y < from.y;
    if !upward && !downward {
        return 0;
    }
    let [a, b, q] = [from, to, p].map(|v| robust::Coord { x: v.x, y: v.y });
    let side = robust::orient2d(a, b, q);
    i32::from(upward && side > 0.0) - i32::from(downward && side < 0.0)
}
