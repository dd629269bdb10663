//! The check of an outside that was drawn anew: how far it lies from where the triangles of the
//! model separate inside from outside.

use rayon::prelude::*;

use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Bvh, Point, Vector};
use crate::mesh::{TriMesh, WindingNumbers, spread_points};

/// Number of points spread over each surface, besides the corners of the new one.
const SPREAD_POINTS: usize = 20_000;
/// Directions in which inside and outside are looked for, besides a triangle's normal.
const AROUND: [[f64; 3]; 7] = [
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [0.577, 0.577, 0.577],
    [0.577, 0.577, -0.577],
    [0.577, -0.577, 0.577],
    [-0.577, 0.577, 0.577],
];
/// Shares of the limit at which they are looked for: nearer ones for thin walls.
const REACHES: [f64; 3] = [1.0, 0.5, 0.25];
/// Step beside an old triangle at which its sides are asked, as a share of the longest side. Below
/// 1e-9 rounding decides; above 1e-5 thin walls are stepped through.
const STEP_RATIO: f64 = 1e-7;
/// Least distance of a winding number from one half that counts as inside or outside: the numbers
/// are right to 0.015.
const SURE_RATIO: f64 = 0.02;

/// Returns points of the new surface that are too far from the old one, by a limit in mm.
///
/// Of the old one the places count where it separates inside from outside, by generalised winding
/// number. Takes some seconds.
///
/// # Errors
/// The watch was stopped.
pub(super) fn find_strays(
    new: &TriMesh,
    old: &TriMesh,
    limit_mm: f64,
    watch: &Watch,
) -> Result<Vec<Point>, Cancelled> {
    let sides = WindingNumbers::new(old.iter_corners());
    let is_near = |spot: &Spot| is_near_a_change(&sides, spot, limit_mm);
    keep_strays(&[corners(new), spread(new)].concat(), is_near, watch)
}

/// Returns points of the old triangles that separate inside from outside and are farther than a
/// limit, mm, from the new surface.
///
/// # Errors
/// The watch was stopped.
pub(super) fn find_missing(
    new: &TriMesh,
    old: &TriMesh,
    limit_mm: f64,
    watch: &Watch,
) -> Result<Vec<Point>, Cancelled> {
    let sides = WindingNumbers::new(old.iter_corners());
    let surface = Bvh::new(new.iter_corners());
    let step_mm = STEP_RATIO * old.longest_side_mm();
    let is_near = |spot: &Spot| {
        let is_near = surface.closest(&spot.at, limit_mm, &[]).is_some();
        is_near || !separates(&sides, spot, step_mm)
    };
    keep_strays(&spread(old), is_near, watch)
}

/// A point of a triangle, and the triangle's normal.
#[derive(Debug, Clone, Copy)]
struct Spot {
    at: Point,
    normal: Vector,
}

/// Returns the corners of all triangles.
fn corners(mesh: &TriMesh) -> Vec<Spot> {
    let triangles = mesh.iter_corners();
    let spots = triangles.flat_map(|corners| {
        let normal = normal_of(&corners);
        corners
            .map(|at| normal.map(|normal| Spot { at, normal }))
            .into_iter()
            .flatten()
    });
    spots.collect()
}

/// Returns points spread over a surface by area.
fn spread(mesh: &TriMesh) -> Vec<Spot> {
    let triangles: Vec<[Point; 3]> = mesh.iter_corners().collect();
    let points = spread_points(&triangles, SPREAD_POINTS).into_iter();
    let spots = points.filter_map(|point| {
        let normal = normal_of(&triangles[point.triangle])?;
        Some(Spot {
            at: point.at,
            normal,
        })
    });
    spots.collect()
}

fn normal_of([a, b, c]: &[Point; 3]) -> Option<Vector> {
    (b - a).cross(&(c - a)).try_normalize(0.0)
}

/// Returns the places of the spots that are not near.
fn keep_strays(
    spots: &[Spot],
    is_near: impl Fn(&Spot) -> bool + Sync,
    watch: &Watch,
) -> Result<Vec<Point>, Cancelled> {
    let found = spots.par_iter().map(|spot| {
        watch.check()?;
        Ok((!is_near(spot)).then_some(spot.at))
    });
    let found = found.collect::<Result<Vec<Option<Point>>, Cancelled>>()?;
    Ok(found.into_iter().flatten().collect())
}

/// Returns true if the ball of the limit about a spot holds a point inside and one outside.
fn is_near_a_change(sides: &WindingNumbers, spot: &Spot, limit_mm: f64) -> bool {
    let is_inside = |step: Vector| sides.at(&(spot.at + step)) > 0.5;
    let around = std::iter::once(spot.normal).chain(AROUND.map(Vector::from));
    let steps = REACHES
        .into_iter()
        .flat_map(|reach| around.clone().map(move |way| way * (reach * limit_mm)));
    let mut seen = [false; 2];
    for step in steps.flat_map(|step| [-step, step]) {
        seen[usize::from(is_inside(step))] = true;
        if seen == [true; 2] {
            return true;
        }
    }
    false
}

/// Returns true if an old triangle surely has inside on one side and outside on the other.
fn separates(sides: &WindingNumbers, spot: &Spot, step_mm: f64) -> bool {
    let step = spot.normal * step_mm;
    let excess = [spot.at + step, spot.at - step].map(|p| sides.at(&p) - 0.5);
    excess[0] * excess[1] < 0.0 && excess.iter().all(|excess| excess.abs() > SURE_RATIO)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::primitives::{ball, cuboid};

    fn strays(new: &TriMesh, old: &TriMesh, limit_mm: f64) -> usize {
        let watch = Watch::silent();
        let strays = find_strays(new, old, limit_mm, &watch).unwrap();
        let missing = find_missing(new, old, limit_mm, &watch).unwrap();
        strays.len() + missing.len()
    }

    #[test]
    fn a_surface_strays_where_it_is_farther_away_than_the_limit_and_nowhere_else() {
        let old = ball(&Point::origin(), 10.0, 4);
        for (factor, limit_mm, is_near) in
            [(1.0, 0.05, true), (1.01, 0.2, true), (1.01, 0.05, false)]
        {
            let new = old.map_vertices(|p| p * factor);
            let found = strays(&new, &old, limit_mm);
            assert_eq!(found == 0, is_near, "{factor} {limit_mm}: {found}");
        }
    }

    #[test]
    fn a_part_of_the_old_surface_that_is_missing_is_found() {
        let ball = ball(&Point::origin(), 10.0, 4);
        let beside = cuboid(&Point::new(20.0, 0.0, 0.0), &Point::new(22.0, 2.0, 2.0));
        let old = ball.clone().joined(&beside);
        assert!(strays(&ball, &old, 0.1) > 0);
        assert_eq!(strays(&old, &old, 0.1), 0);
    }

    #[test]
    fn what_lies_inside_the_old_surface_twice_does_not_count() {
        let outer = cuboid(&Point::origin(), &Point::new(10.0, 10.0, 10.0));
        let inner = cuboid(&Point::new(2.0, 2.0, 2.0), &Point::new(8.0, 8.0, 8.0));
        assert_eq!(strays(&outer, &outer.clone().joined(&inner), 0.1), 0);
    }
}
