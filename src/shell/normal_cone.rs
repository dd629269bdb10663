//! The part of the wall that only an edge or a vertex covers: its normal cone.
//!
//! Take a point whose nearest surface point lies on an edge or vertex. No direction along the
//! surface leads nearer, so the point lies in the polar cone of the surface's directions there.
//! Only that part of the edge's cylinder or the vertex's ball is not already in the slabs of the
//! faces. On a smooth mesh it is a sliver, and it is empty about convex edges and saddles.

use crate::geom::Vector;

/// Distance by which a unit vector may leave a half-space and still count as in it. It is several
/// times [`PARALLEL`], so that rays lost with a pair of nearly parallel edges are found from their
/// neighbours. Too large only costs time (a sliver that many radians wider). Rays get lost below
/// the rounding of a cross product divided by [`PARALLEL`], about 1e-10.
const TOLERANCE: f64 = 4e-6;
/// Length of the cross product of two edge directions below which they count as parallel.
const PARALLEL: f64 = 1e-6;
/// Largest number of edges at a vertex for which the cone is computed, as the cost is the cube of
/// their number. A vertex with more gets the whole ball.
const MAX_EDGES: usize = 24;
/// Least cosine between a cone's axis and its rays for which a hull around its part of a ball is
/// made. A wider cone gets the whole ball, as its hull would be larger than the ball's own bounds.
const MIN_COSINE: f64 = 0.5;

/// The part of an edge's or vertex's neighbourhood that must be covered.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Need {
    /// Nothing beyond the slabs.
    Nothing,
    /// The hull of zero (or the edge) and these vectors, for a unit radius.
    Hull(Vec<Vector>),
    /// All of it.
    Whole,
}

/// Returns the part that an edge needs.
///
/// `normals` are the outer unit normals of its two faces, and `along` is the edge's unit direction
/// along the first. If `one_sided`, only the inside of the solid matters.
pub(super) fn of_edge(normals: [Vector; 2], along: &Vector, one_sided: bool) -> Need {
    let [first, second] = normals;
    let into_second = along.cross(&second);
    let valley = first.dot(&into_second);
    if one_sided && valley < -TOLERANCE {
        return Need::Nothing;
    }
    let sign = if one_sided || valley > 0.0 { -1.0 } else { 1.0 };
    let is_flat = valley.abs() <= TOLERANCE;
    if first.dot(&second) < -MIN_COSINE || (is_flat && !one_sided) {
        return Need::Whole;
    }
    let tip = (first + second) / (1.0 + first.dot(&second));
    Need::Hull(vec![
        Vector::zeros(),
        first * sign,
        second * sign,
        tip * sign,
    ])
}

/// Returns the part that a vertex needs, from the unit directions of its edges.
///
/// `outward` is the angle-weighted pseudonormal. It is given if only the inside matters and the
/// vertex is simple enough for the pseudonormal to tell inside from outside. Within a normal cone
/// its sign is the same everywhere. (Bærentzen & Aanæs, "Signed distance computation using the
/// angle weighted pseudonormal", IEEE TVCG 11(3), 2005.)
pub(super) fn of_vertex(edges: &[Vector], outward: Option<&Vector>) -> Need {
    if edges.len() > MAX_EDGES {
        return Need::Whole;
    }
    let mut rays = polar_rays(edges);
    if let Some(outward) = outward {
        rays.retain(|ray| ray.dot(outward) <= TOLERANCE);
    }
    if rays.is_empty() {
        Need::Nothing
    } else {
        hull_of_rays(&rays)
    }
}

/// Returns the extreme rays of { d : d · e ≤ 0 for every edge e }, some of them several times. They
/// are the crossings of two boundary planes that stay within the other half-spaces.
fn polar_rays(edges: &[Vector]) -> Vec<Vector> {
    let mut rays = Vec::new();
    for (i, a) in edges.iter().enumerate() {
        for b in &edges[..i] {
            let Some(ray) = a.cross(b).try_normalize(PARALLEL) else {
                continue;
            };
            let candidates = [ray, -ray].into_iter();
            rays.extend(
                candidates.filter(|ray| edges.iter().all(|edge| ray.dot(edge) <= TOLERANCE)),
            );
        }
    }
    rays
}

/// Returns a hull around the part of the unit ball in the cone of these rays. Its corners are zero
/// and each ray's point in the plane that touches the ball at the cone's axis.
fn hull_of_rays(rays: &[Vector]) -> Need {
    let Some(axis) = rays.iter().sum::<Vector>().try_normalize(MIN_COSINE) else {
        return Need::Whole;
    };
    if rays.iter().any(|ray| ray.dot(&axis) < MIN_COSINE) {
        return Need::Whole;
    }
    let tips = rays.iter().map(|ray| ray / ray.dot(&axis));
    Need::Hull(std::iter::once(Vector::zeros()).chain(tips).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_convex_edge_needs_nothing_and_a_valley_a_wedge() {
        let along = Vector::y();
        assert_eq!(
            of_edge([Vector::z(), Vector::x()], &along, true),
            Need::Nothing
        );
        let Need::Hull(hull) = of_edge([Vector::z(), -Vector::x()], &along, true) else {
            panic!("a hull")
        };
        assert_eq!(
            hull,
            [
                Vector::zeros(),
                -Vector::z(),
                Vector::x(),
                Vector::new(1.0, 0.0, -1.0)
            ]
        );
    }

    #[test]
    fn the_outer_corner_of_a_cube_needs_nothing_and_its_inner_corner_an_octant() {
        let edges = [Vector::x(), Vector::y(), Vector::z()];
        let outward = Vector::repeat(-1.0 / 3.0f64.sqrt());
        assert_eq!(of_vertex(&edges, Some(&outward)), Need::Nothing);
        let Need::Hull(hull) = of_vertex(&edges, Some(&-outward)) else {
            panic!("a hull")
        };
        assert_eq!(hull.len(), 4);
        assert!(
            hull[1..]
                .iter()
                .all(|tip| (tip.dot(&outward) - 1.0).abs() < 1e-12),
            "up to the plane of the axis"
        );
    }

    #[test]
    fn a_saddle_needs_nothing() {
        let edges = [
            [1.0, 0.0, 0.2],
            [0.0, 1.0, -0.2],
            [-1.0, 0.0, 0.2],
            [0.0, -1.0, -0.2],
        ]
        .map(|[x, y, z]| Vector::new(x, y, z).normalize());
        assert_eq!(of_vertex(&edges, None), Need::Nothing);
    }

    #[test]
    fn every_direction_of_a_random_cone_lies_in_its_hull() {
        let mut random = crate::shell::fixtures::Random::new(7);
        let mut tried = 0;
        while tried < 200 {
            let edges: Vec<Vector> = (0..6)
                .map(|_| (random.direction() + Vector::z() * 1.2).normalize())
                .collect();
            let Need::Hull(hull) = of_vertex(&edges, None) else {
                continue;
            };
            let axis = hull[1..]
                .iter()
                .map(|tip| tip.normalize())
                .sum::<Vector>()
                .normalize();
            let direction = (random.direction() * 0.7 + axis).normalize();
            if edges.iter().any(|edge| edge.dot(&direction) > 0.0) {
                continue;
            }
            tried += 1;
            for plane in (0..50).map(|_| random.direction()) {
                let support = hull
                    .iter()
                    .map(|tip| tip.dot(&plane))
                    .fold(f64::NEG_INFINITY, f64::max);
                assert!(
                    direction.dot(&plane) <= support + 1e-9,
                    "the hull misses a direction"
                );
            }
        }
    }
}
