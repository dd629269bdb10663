//! The features and necks that thin points form.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use rayon::prelude::*;

use super::medial::Touched;
use crate::geom::{Aabb, Point};
use crate::mesh::union_find::UnionFind;

/// A feature that sticks out by more than this many walls is lost when it does not print.
pub const LEAST_LENGTH_WALLS: f64 = 3.0;
/// Points within this many spacings are neighbours if they look to the same side.
const NEIGHBOUR_SPACINGS: f64 = 2.2;
const SAME_SIDE_COSINE: f64 = 0.0;
/// A width counts as thin below this share of the wall: facets and rounding.
const THIN_RATIO: f64 = 0.98;
/// A point within this many walls of a ball that is wide enough is covered. Near the edges of
/// facets balls are narrow. A right angle leaves 0.2.
const COVERED_WALLS: f64 = 0.1;
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
pub(super) struct Cubes {
    size_mm: f64,
    cubes: HashMap<[i64; 3], Vec<u32>>,
}

impl Cubes {
    pub fn of(places: impl Iterator<Item = (u32, Point)>, size_mm: f64) -> Self {
        let mut cubes: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
        for (index, at) in places {
            cubes.entry(cube_of(&at, size_mm)).or_default().push(index);
        }
        Self { size_mm, cubes }
    }

    /// Returns the points in the cubes within so many of the one that holds a place.
    pub fn around(&self, at: &Point, reach: i64) -> impl Iterator<Item = u32> + '_ {
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

/// The widths of a model at the points of its surface, against a wall.
pub(super) struct Widths<'a> {
    touched: &'a Touched,
    wall_mm: f64,
    /// The distance of each point from the nearest ball that is wide enough, mm.
    short_mm: Vec<f64>,
}

impl<'a> Widths<'a> {
    /// Measures how far each thin point is from what is thick.
    pub fn of(touched: &'a Touched, wall_mm: f64) -> Self {
        let is_thin = |i: usize| touched.points[i].width_mm < THIN_RATIO * wall_mm;
        let points = touched.points.iter().enumerate();
        let thick = points.filter(|(i, _)| !is_thin(*i));
        let thick = Cubes::of(thick.map(|(i, point)| (i as u32, point.at)), wall_mm);
        let short_mm = touched.points.par_iter().enumerate().map(|(i, point)| {
            if is_thin(i) {
                distance_mm(touched, &thick, &point.at).min(point.bare_mm)
            } else {
                0.0
            }
        });
        Self {
            touched,
            wall_mm,
            short_mm: short_mm.collect(),
        }
    }

    fn is_thin(&self, i: usize) -> bool {
        self.touched.points[i].width_mm < THIN_RATIO * self.wall_mm
    }

    /// Returns whether a ball that is wide enough covers a point, or all but covers it.
    fn is_covered(&self, i: usize) -> bool {
        self.short_mm[i] <= COVERED_WALLS * self.wall_mm
    }

    /// Returns the thin features, in any order: groups of thin points, each as long as its farthest
    /// point is from what is thick.
    pub fn features(&self) -> Vec<ThinPlace> {
        let groups = Groups::of(self.touched, |i| self.is_thin(i));
        self.farthest(&groups).into_values().collect()
    }

    /// Returns the farthest point of each group of thin points from what is thick.
    fn farthest(&self, groups: &Groups) -> BTreeMap<u32, ThinPlace> {
        let mut farthest: BTreeMap<u32, ThinPlace> = BTreeMap::new();
        for (i, point) in self.touched.points.iter().enumerate() {
            let place = ThinPlace {
                at: point.at,
                length_mm: self.short_mm[i],
            };
            if self.is_thin(i) {
                let known = farthest.entry(groups.root(i)).or_insert(place);
                if place.length_mm > known.length_mm {
                    *known = place;
                }
            }
        }
        farthest
    }

    /// Returns the points that no ball covers, of the features that are lost and of the necks, in
    /// order.
    pub fn weak_points(&self) -> Vec<usize> {
        let thin = Groups::of(self.touched, |i| self.is_thin(i));
        let farthest = self.farthest(&thin);
        let bare = Groups::of(self.touched, |i| !self.is_covered(i));
        let necks = self.neck_groups(&bare);
        let is_lost = |i: usize| {
            let place = farthest.get(&thin.root(i));
            place.is_some_and(|place| place.length_mm > LEAST_LENGTH_WALLS * self.wall_mm)
        };
        let is_weak =
            |&i: &usize| !self.is_covered(i) && (is_lost(i) || necks.contains(&bare.root(i)));
        (0..self.short_mm.len()).filter(is_weak).collect()
    }

    /// Returns the groups of bare points that lie between two wide pieces.
    fn neck_groups(&self, bare: &Groups) -> BTreeSet<u32> {
        let points = &self.touched.points;
        let pieces = Groups::of(self.touched, |i| self.is_covered(i));
        let wide = self.wide_pieces(&pieces);
        let reach_mm = NEIGHBOUR_SPACINGS * self.touched.spacing_mm;
        let covered = (0..points.len()).filter(|&i| self.is_covered(i));
        let covered = Cubes::of(covered.map(|i| (i as u32, points[i].at)), reach_mm);
        let mut beside: BTreeMap<u32, BTreeSet<u32>> = BTreeMap::new();
        for i in (0..points.len()).filter(|&i| !self.is_covered(i)) {
            let at = points[i].at;
            let near = covered.around(&at, 1);
            let near = near.filter(|&j| (points[j as usize].at - at).norm() <= reach_mm);
            let near = near.map(|j| pieces.root(j as usize));
            let known = near.filter(|root| wide.contains(root));
            beside.entry(bare.root(i)).or_default().extend(known);
        }
        let necks = beside.into_iter().filter(|(_, pieces)| pieces.len() > 1);
        necks.map(|(root, _)| root).collect()
    }

    /// Returns the pieces that are wide enough to be missed.
    fn wide_pieces(&self, pieces: &Groups) -> BTreeSet<u32> {
        let mut boxes: BTreeMap<u32, Aabb> = BTreeMap::new();
        for i in (0..self.short_mm.len()).filter(|&i| self.is_covered(i)) {
            let point = Aabb::of_points(&[self.touched.points[i].at]);
            let known = boxes.entry(pieces.root(i)).or_insert(point);
            *known = known.union(&point);
        }
        let is_wide = |bounds: &Aabb| bounds.size().norm() > LEAST_PIECE_WALLS * self.wall_mm;
        let wide = boxes.into_iter().filter(|(_, bounds)| is_wide(bounds));
        wide.map(|(root, _)| root).collect()
    }

    /// Returns the pieces that only necks thinner than the wall join to the largest, in any order.
    pub fn necks(&self) -> Vec<ThinPlace> {
        let points = &self.touched.points;
        let groups = Groups::of(self.touched, |i| self.is_covered(i));
        let mut pieces: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for i in (0..points.len()).filter(|&i| self.is_covered(i)) {
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
        let is_told = |place: &ThinPlace| place.length_mm > LEAST_PIECE_WALLS * self.wall_mm;
        behind.filter(is_told).collect()
    }
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
