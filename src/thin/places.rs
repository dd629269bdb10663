//! The features and necks that thin points form.

use std::collections::HashMap;

use super::medial::Touched;
use crate::geom::Point;
use crate::mesh::union_find::UnionFind;

/// Points within this many spacings are neighbours if they look to the same side.
const NEIGHBOUR_SPACINGS: f64 = 2.2;
const SAME_SIDE_COSINE: f64 = 0.0;
/// A width counts as thin below this share of the wall: facets and rounding.
const THIN_RATIO: f64 = 0.98;
/// A piece behind a neck is reported if it is wider than this many walls.
const LEAST_PIECE_WALLS: f64 = 3.0;

/// A thin feature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThinPlace {
    /// Its farthest point; of a neck its middle. Model frame, mm.
    pub at: Point,
    /// The length by which it sticks out of what is thick enough, mm; of a neck the length of the
    /// piece behind it.
    pub length_mm: f64,
}

/// Points in cubes, for the search by place.
struct Cubes {
    size_mm: f64,
    cubes: HashMap<[i64; 3], Vec<u32>>,
}

impl Cubes {
    fn of(places: impl Iterator<Item = (u32, Point)>, size_mm: f64) -> Self {
        let mut cubes: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
        for (index, at) in places {
            cubes.entry(cube_of(&at, size_mm)).or_default().push(index);
        }
        Self { size_mm, cubes }
    }

    /// Returns the points in the cubes within so many of the one that holds a place.
    fn around(&self, at: &Point, reach: i64) -> impl Iterator<Item = u32> + '_ {
        let [x, y, z] = cube_of(at, self.size_mm);
        let span = move || -reach..=reach;
        let offsets = span().flat_map(move |i| {
            span().flat_map(move |j| span().map(move |k| [x + i, y + j, z + k]))
        });
        offsets
            .filter_map(|cube| self.cubes.get(&cube))
            .flatten()
            .copied()
    }
}

fn cube_of(at: &Point, size_mm: f64) -> [i64; 3] {
    [at.x, at.y, at.z].map(|coordinate| (coordinate / size_mm).floor() as i64)
}

/// Returns the thin features, in any order: groups of thin points, each as long as its farthest
/// point is from what is thick.
pub(super) fn features(touched: &Touched, wall_mm: f64) -> Vec<ThinPlace> {
    let points = &touched.points;
    let is_thin = |i: usize| points[i].width_mm < THIN_RATIO * wall_mm;
    let thick = (0..points.len()).filter(|&i| !is_thin(i));
    let thick = Cubes::of(thick.map(|i| (i as u32, points[i].at)), wall_mm);
    let thin: Vec<usize> = (0..points.len()).filter(|&i| is_thin(i)).collect();
    let groups = Groups::of(touched, is_thin);
    let mut farthest: HashMap<u32, ThinPlace> = HashMap::new();
    for i in thin {
        let at = points[i].at;
        let length_mm = distance_mm(touched, &thick, &at);
        let known = farthest
            .entry(groups.root(i))
            .or_insert(ThinPlace { at, length_mm });
        if length_mm > known.length_mm {
            *known = ThinPlace { at, length_mm };
        }
    }
    farthest.into_values().collect()
}

/// The most walls that a distance is searched over.
const MOST_WALLS: i64 = 12;

/// Returns the distance of a place from the nearest ball that is thick enough, mm; at most twelve
/// walls. The balls that touch the surface near the place are searched.
fn distance_mm(touched: &Touched, thick: &Cubes, at: &Point) -> f64 {
    let mut reach = 1;
    loop {
        let near = thick.around(at, reach);
        let distances = near.map(|i| touched.points[i as usize].distance_mm(at));
        let least_mm = distances.fold(f64::INFINITY, f64::min);
        // Beyond the cubes that were searched a nearer point may lie.
        let searched_mm = reach as f64 * thick.size_mm;
        if least_mm <= searched_mm || reach >= MOST_WALLS {
            return least_mm.min(MOST_WALLS as f64 * thick.size_mm);
        }
        reach = (2 * reach).min(MOST_WALLS);
    }
}

/// Returns the pieces that only necks thinner than the wall join to the largest, in any order.
pub(super) fn necks(touched: &Touched, wall_mm: f64) -> Vec<ThinPlace> {
    let points = &touched.points;
    let is_thick = |i: usize| points[i].width_mm >= THIN_RATIO * wall_mm;
    let groups = Groups::of(touched, is_thick);
    let mut pieces: HashMap<u32, Vec<usize>> = HashMap::new();
    for i in (0..points.len()).filter(|&i| is_thick(i)) {
        pieces.entry(groups.root(i)).or_default().push(i);
    }
    let mut pieces: Vec<Vec<usize>> = pieces.into_values().collect();
    pieces.sort_by_key(|piece| (std::cmp::Reverse(piece.len()), piece[0]));
    let behind = pieces.iter().skip(1).map(|piece| {
        let places = piece.iter().map(|&i| points[i].at.coords);
        let middle = Point::from(places.sum::<crate::geom::Vector>() / piece.len() as f64);
        let reach = piece.iter().map(|&i| (points[i].at - middle).norm());
        ThinPlace {
            at: middle,
            length_mm: 2.0 * reach.fold(0.0, f64::max),
        }
    });
    let is_told = |place: &ThinPlace| place.length_mm > LEAST_PIECE_WALLS * wall_mm;
    behind.filter(is_told).collect()
}

/// Sorts places, the longest first.
pub(super) fn sort(places: &mut [ThinPlace]) {
    let coordinates = |place: &ThinPlace| [place.at.x, place.at.y, place.at.z];
    places.sort_by(|a, b| {
        let by_place = coordinates(a).partial_cmp(&coordinates(b));
        let by_place = by_place.unwrap_or(std::cmp::Ordering::Equal);
        b.length_mm.total_cmp(&a.length_mm).then(by_place)
    });
}

/// Groups of points that hang together on the surface, or through the body by a ball.
struct Groups(Vec<u32>);

impl Groups {
    fn of(touched: &Touched, belongs: impl Fn(usize) -> bool) -> Self {
        let points = &touched.points;
        let reach_mm = NEIGHBOUR_SPACINGS * touched.spacing_mm;
        let members = (0..points.len()).filter(|&i| belongs(i));
        let cubes = Cubes::of(members.clone().map(|i| (i as u32, points[i].at)), reach_mm);
        let mut sets = UnionFind::new(points.len());
        for i in members.collect::<Vec<_>>() {
            let touch = &points[i];
            for j in cubes.around(&touch.at, 1) {
                let other = &points[j as usize];
                let is_beside = (other.at - touch.at).norm() <= reach_mm
                    && other.normal.dot(&touch.normal) >= SAME_SIDE_COSINE;
                if is_beside {
                    sets.merge(i as u32, j);
                }
            }
            let across = cubes
                .around(&touch.other_side, 1)
                .find(|&j| (points[j as usize].at - touch.other_side).norm() <= reach_mm);
            if let Some(across) = across {
                sets.merge(i as u32, across);
            }
        }
        Self((0..points.len() as u32).map(|i| sets.root(i)).collect())
    }

    fn root(&self, index: usize) -> u32 {
        self.0[index]
    }
}
