//! Deep points of a model, and the first planes about them.

use rayon::prelude::*;

use super::growth::Terms;
use super::side::Side;
use crate::geom::{Aabb, Plane, Point, Vector};
use crate::mesh::TriMesh;

/// Cells of the grid along the longest side on which deep points are looked for.
const CELLS: usize = 24;
/// The step at which the search for a deep point ends, over its depth.
const FINEST_RATIO: f64 = 1e-3;
/// A deep point nearer to a deeper one than this share of that one's depth is the same.
const SAME_RATIO: f64 = 0.5;
/// Steps from a cell to its 26 neighbours.
const AROUND: i64 = 1;

/// A point inside, where the depth is a local maximum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Deep {
    pub at: Point,
    pub depth_mm: f64,
}

/// Returns the local maxima of a depth in a box, deepest first. The depth must be negative
/// outside.
pub(super) fn deep_points(within: &Aabb, depth: impl Fn(&Point) -> f64 + Sync) -> Vec<Deep> {
    let grid = Grid::over(within);
    let depths: Vec<f64> = (0..grid.len())
        .into_par_iter()
        .map(|cell| depth(&grid.center(cell)))
        .collect();
    let tops = (0..grid.len()).filter(|&cell| depths[cell] > 0.0 && grid.is_top(cell, &depths));
    let mut found: Vec<Deep> = tops
        .map(|cell| climb(&depth, grid.center(cell), grid.step_mm))
        .collect();
    found.sort_by(|a, b| b.depth_mm.total_cmp(&a.depth_mm));
    let mut kept: Vec<Deep> = Vec::new();
    for deep in found {
        let is_new = |known: &Deep| (known.at - deep.at).norm() > SAME_RATIO * known.depth_mm;
        if kept.iter().all(is_new) {
            kept.push(deep);
        }
    }
    kept
}

/// A grid of cells over a box.
struct Grid {
    min: Point,
    counts: [usize; 3],
    step_mm: f64,
}

impl Grid {
    fn over(within: &Aabb) -> Self {
        let size = within.size();
        let step_mm = size.max() / CELLS as f64;
        Self {
            min: within.min,
            counts: [0, 1, 2].map(|k| ((size[k] / step_mm).ceil() as usize).max(1)),
            step_mm,
        }
    }

    fn len(&self) -> usize {
        self.counts.iter().product()
    }

    fn place(&self, cell: usize) -> [usize; 3] {
        let [x, y, _] = self.counts;
        [cell % x, cell / x % y, cell / x / y]
    }

    fn center(&self, cell: usize) -> Point {
        let place = self.place(cell).map(|k| k as f64 + 0.5);
        self.min + Vector::from(place) * self.step_mm
    }

    /// Returns true if no neighbour is deeper.
    fn is_top(&self, cell: usize, depths: &[f64]) -> bool {
        let place = self.place(cell);
        let range = |k: usize| {
            let (at, last) = (place[k] as i64, self.counts[k] as i64 - 1);
            (at - AROUND).max(0)..=(at + AROUND).min(last)
        };
        range(2).all(|z| {
            range(1).all(|y| {
                range(0).all(|x| {
                    let row = z as usize * self.counts[1] + y as usize;
                    depths[row * self.counts[0] + x as usize] <= depths[cell]
                })
            })
        })
    }
}

/// Climbs to a local maximum by steps to 26 sides that become finer.
fn climb(depth: &impl Fn(&Point) -> f64, start: Point, step_mm: f64) -> Deep {
    let mut deep = Deep {
        at: start,
        depth_mm: depth(&start),
    };
    let mut step = step_mm;
    while step > FINEST_RATIO * deep.depth_mm {
        let sides = (0..27).filter(|&side| side != 13);
        let higher = sides.into_iter().find_map(|side| {
            let way = [side % 3, side / 3 % 3, side / 9].map(|k| f64::from(k) - 1.0);
            let at = deep.at + Vector::from(way) * step;
            let depth_mm = depth(&at);
            (depth_mm > deep.depth_mm).then_some(Deep { at, depth_mm })
        });
        match higher {
            Some(higher) => deep = higher,
            None => step /= 2.0,
        }
    }
    deep
}

/// Returns directions spread evenly over a sphere along a spiral, turned by the seed. (Vogel, "A
/// better way to construct the sunflower head", Mathematical Biosciences 44, 1979, on a sphere.)
pub(super) fn directions(count: usize, seed: usize) -> Vec<Vector> {
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let turn = turn(seed);
    let direction = |k: usize| {
        let z = 1.0 - (2.0 * k as f64 + 1.0) / count as f64;
        let (radius, angle) = ((1.0 - z * z).sqrt(), golden * k as f64);
        turn * Vector::new(radius * angle.cos(), radius * angle.sin(), z)
    };
    (0..count).map(direction).collect()
}

/// Returns the face normals of the regular polyhedron of `faces` faces, turned by the seed; `None`
/// if there is no such polyhedron.
pub(super) fn regular(faces: usize, seed: usize) -> Option<Vec<Vector>> {
    let golden = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let turned = |[x, y, z]: [f64; 3]| [[x, y, z], [y, z, x], [z, x, y]];
    let signs = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
    let in_planes = |a: f64, b: f64| signs.map(|[s, t]| turned([0.0, s * a, t * b])).concat();
    let corners = signs.map(|[s, t]| [[s, t, 1.0], [s, t, -1.0]]).concat();
    let normals: Vec<[f64; 3]> = match faces {
        4 => vec![
            [1.0, 1.0, 1.0],
            [1.0, -1.0, -1.0],
            [-1.0, 1.0, -1.0],
            [-1.0, -1.0, 1.0],
        ],
        6 => [turned([1.0, 0.0, 0.0]), turned([-1.0, 0.0, 0.0])].concat(),
        8 => corners,
        12 => in_planes(1.0, golden),
        20 => [in_planes(golden.recip(), golden), corners].concat(),
        _ => return None,
    };
    let turn = turn(seed);
    let unit = |normal: [f64; 3]| turn * Vector::from(normal).normalize();
    Some(normals.into_iter().map(unit).collect())
}

/// Returns the rotation of a seed.
fn turn(seed: usize) -> nalgebra::Rotation3<f64> {
    let [a, b, c] = [1.3, 2.1, 0.7].map(|rate| rate * seed as f64);
    nalgebra::Rotation3::from_euler_angles(a, b, c)
}

/// Normals within this angle belong to one flat, as a cosine: 8°.
const FLAT_COSINE: f64 = 0.99;
/// Directions of a spiral within this angle of a flat's normal are left out, as a cosine: 25°.
const NEAR_COSINE: f64 = 0.9;
/// The least share of the surface that counts as a flat.
const FLAT_RATIO: f64 = 0.04;

/// Returns the outward normals of the flats of a surface, the largest first; none for one that is
/// round all over.
///
/// Triangles join the first flat of nearly their normal, the largest triangles first.
pub(super) fn flat_normals(mesh: &TriMesh) -> Vec<Vector> {
    let doubled = mesh.iter_corners().map(|[a, b, c]| (b - a).cross(&(c - a)));
    let mut areas: Vec<Vector> = doubled.collect();
    areas.sort_by(|a, b| b.norm_squared().total_cmp(&a.norm_squared()));
    let total: f64 = areas.iter().map(Vector::norm).sum();
    let mut flats: Vec<(Vector, Vector)> = Vec::new();
    for area in areas {
        let Some(normal) = area.try_normalize(0.0) else {
            continue;
        };
        match flats
            .iter_mut()
            .find(|(first, _)| first.dot(&normal) > FLAT_COSINE)
        {
            Some((_, sum)) => *sum += area,
            None => flats.push((normal, area)),
        }
    }
    flats.retain(|(_, sum)| sum.norm() >= FLAT_RATIO * total);
    flats.sort_by(|a, b| b.1.norm_squared().total_cmp(&a.1.norm_squared()));
    flats.into_iter().map(|(_, sum)| sum.normalize()).collect()
}

/// Returns the normals of flats, and of directions spread over the sphere those that are far from
/// all of them.
pub(super) fn directions_with(flats: &[Vector], count: usize) -> Vec<Vector> {
    let is_far = |way: &Vector| flats.iter().all(|flat| flat.dot(way) < NEAR_COSINE);
    let others = directions(count, 0).into_iter().filter(is_far);
    flats.iter().copied().chain(others).collect()
}

/// The directions of the first sides, and the planes that stay.
#[derive(Debug, Clone, Copy)]
pub(super) struct Normals<'a> {
    pub free: &'a [Vector],
    pub locked: &'a [Plane],
}

/// Returns the first sides about a point: planes in the directions at one common distance, as far
/// as parting allows, and the locked planes. `None` if there is no room.
pub(super) fn first_sides(terms: &Terms, at: &Point, normals: &Normals) -> Option<Vec<Side>> {
    let Normals { free, locked } = *normals;
    let common_mm = common_mm(terms, at, normals) - terms.distance_mm;
    if common_mm <= 0.0 || locked.iter().any(|plane| plane.distance(at) >= 0.0) {
        return None;
    }
    let free = free.iter().map(|normal| Side {
        plane: Plane {
            normal: *normal,
            offset_mm: normal.dot(&at.coords) + common_mm,
        },
        is_locked: false,
    });
    let locked = locked.iter().map(|&plane| Side {
        plane,
        is_locked: true,
    });
    Some(locked.chain(free).collect())
}

/// Returns the largest distance that planes in the directions may have from a point, mm. Each
/// obstacle must still be parted by one of them, or by the asked distance by a locked plane.
pub(super) fn common_mm(terms: &Terms, at: &Point, normals: &Normals) -> f64 {
    let obstacles = terms.obstacles;
    let mut best = vec![f64::NEG_INFINITY; obstacles.len()];
    for plane in normals.locked {
        for (best, parted) in best.iter_mut().zip(obstacles.all_parted_mm(plane)) {
            if parted >= terms.distance_mm {
                *best = f64::INFINITY;
            }
        }
    }
    for normal in normals.free {
        let plane = Plane::through(at, normal);
        for (best, parted) in best.iter_mut().zip(obstacles.all_parted_mm(&plane)) {
            *best = best.max(parted);
        }
    }
    best.into_iter().fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::primitives;

    #[test]
    fn the_deep_points_of_two_balls_are_their_centres() {
        let centers = [Point::new(-40.0, 3.0, 1.0), Point::new(45.0, 0.0, -2.0)];
        let radii = [30.0, 22.0];
        let depth = |p: &Point| {
            let inside = |k: usize| radii[k] - (p - centers[k]).norm();
            inside(0).max(inside(1))
        };
        let corner = Point::new(80.0, 40.0, 40.0);
        let deep = deep_points(&Aabb::of_points(&[-corner, corner]), depth);
        assert_eq!(deep.len(), 2);
        for (deep, k) in deep.iter().zip(0..2) {
            assert!((deep.at - centers[k]).norm() < 0.1, "{deep:?}");
            assert!((deep.depth_mm - radii[k]).abs() < 0.1, "{deep:?}");
        }
    }

    #[test]
    fn the_normals_of_regular_polyhedra_are_evenly_spread() {
        for (faces, least_deg) in [(4, 109.4), (6, 89.9), (8, 70.5), (12, 63.4), (20, 41.8)] {
            let normals = regular(faces, 3).unwrap();
            assert_eq!(normals.len(), faces);
            for (k, a) in normals.iter().enumerate() {
                let others = normals.iter().skip(k + 1);
                let nearest = others.map(|b| a.angle(b)).fold(f64::INFINITY, f64::min);
                assert!(nearest.to_degrees() > least_deg, "{faces}: {nearest}");
            }
        }
        assert_eq!(regular(7, 0), None);
    }

    #[test]
    fn a_block_has_six_flats_and_a_ball_none() {
        let block = primitives::cuboid(&Point::origin(), &Point::new(9.0, 5.0, 3.0));
        let flats = flat_normals(&block);
        assert_eq!(flats.len(), 6);
        assert!(flats[0].x == 0.0 && flats[0].y == 0.0 && flats[5].x.abs() == 1.0);
        let with_others = directions_with(&flats, 24);
        assert_eq!(with_others[..6], flats);
        assert!((7..30).contains(&with_others.len()));
        let ball = primitives::ball(&Point::origin(), 9.0, 4);
        assert!(flat_normals(&ball).is_empty());
    }

    #[test]
    fn directions_have_unit_length_and_no_large_gap() {
        for seed in 0..5 {
            let directions = directions(24, seed);
            assert!(directions.iter().all(|d| (d.norm() - 1.0).abs() < 1e-12));
            for probe in super::directions(500, seed + 9) {
                let nearest = directions
                    .iter()
                    .map(|d| d.dot(&probe))
                    .fold(-1.0, f64::max);
                assert!(nearest > 36.0_f64.to_radians().cos(), "{nearest}");
            }
        }
    }
}
