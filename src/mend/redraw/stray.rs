//! The distance between a new surface and the old one, measured both ways.

use rayon::prelude::*;

use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Bvh, Point, Vector};
use crate::mesh::{TriMesh, spread_points};
use crate::voids::{Missing, Soup};

/// Number of points spread over each surface by area.
const SPREAD_POINTS: usize = 10_000;

/// Largest number of triangles that are measured at their middles and corners. Of more an even
/// share is taken. A distance to the old surface costs winding numbers too, so that fewer of the
/// new one's are measured.
const MOST_OLD: usize = 100_000;
const MOST_NEW: usize = 5_000;

/// Number of the farthest spots of a new surface that are measured besides. Without them the bunny
/// was told to have moved by 0.10 mm where it had moved by 0.24 mm.
const MOST_FAR: usize = 1_000;

/// Number of points spread over a new surface, of which these are the farthest. Ten thousand missed
/// the place inside a triangle of the bunny.
const SEARCHED_POINTS: usize = 200_000;

/// Largest number of places that are told as missing, the farthest ones. Each costs a pass over the
/// cells.
const MOST_MISSING: usize = 1_000;

/// Share of the tolerance beyond which a place is missing: simplifying moves the surface by the
/// rest.
const MISSING_RATIO: f64 = 0.8;

/// Move of a measured point towards the middle of its triangle, as a share of the way. On a sharp
/// edge a step along the normal would leave the body again.
const BESIDE_RATIO: f64 = 1e-3;

/// Step beside an old triangle at which its winding numbers are asked, as a share of the longest
/// side. Below 1e-9 rounding decides; above 1e-5 thin walls are stepped through.
const STEP_RATIO: f64 = 1e-7;

/// Least distance of a winding number from one half that counts as inside or outside. The numbers
/// are right to 0.015, and a lone sheet has nearly one half on one side.
const SURE_RATIO: f64 = 0.02;

/// First step from a new triangle in search of the old surface, as a share of the longest side. It
/// is 0.01 mm on a model of 100 mm. Distances that are found by such steps are too large by up to a
/// quarter.
const FIRST_STEP_RATIO: f64 = 1e-4;
/// Step for the slope of the winding number, as a share of the longest side. Below 1e-4 its errors
/// decide the direction.
const SLOPE_RATIO: f64 = 2e-3;
/// Ratio of each step to the one before.
const STEP_GROWTH: f64 = 1.25;

/// The place where two surfaces are farthest apart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Farthest {
    /// The distance, mm.
    pub distance_mm: f64,
    /// The place.
    pub at: Point,
}

/// The old surface, ready to be compared with new ones. Of it only what parts inside from outside
/// counts, and the membranes that the winding number draws across holes.
pub(super) struct Old<'a> {
    soup: &'a Soup,
    spots: Vec<Spot>,
    size_mm: f64,
}

/// A point on a triangle, and the triangle's normal.
#[derive(Debug, Clone, Copy)]
struct Spot {
    at: Point,
    normal: Vector,
}

impl Spot {
    /// Returns a spot of a triangle beside a point of it, a little towards its middle; `None` if it
    /// has no area.
    fn beside(at: &Point, triangle: &[Point; 3]) -> Option<Self> {
        let [a, b, c] = triangle;
        Some(Self {
            at: at + (middle_of(triangle) - at) * BESIDE_RATIO,
            normal: (b - a).cross(&(c - a)).try_normalize(0.0)?,
        })
    }
}

impl<'a> Old<'a> {
    /// Makes a surface ready, whose triangles are those of the soup.
    pub fn new(mesh: &TriMesh, soup: &'a Soup) -> Self {
        Self {
            soup,
            spots: spots(mesh, MOST_OLD),
            size_mm: mesh.longest_side_mm(),
        }
    }

    /// Returns where the new surface and the old one are farthest apart.
    ///
    /// # Errors
    /// The watch was stopped.
    pub fn farthest(&self, new: &TriMesh, watch: &Watch) -> Result<Farthest, Cancelled> {
        let missing = self.far_spots(new, 0.0, watch)?.into_iter();
        let mut old_way = missing.filter(|(_, spot)| self.parts_at(spot));
        let (old_mm, old_spot) = old_way.next().unzip();
        let spots = self.spots_to_measure(new, watch)?;
        let distances = spots.par_iter().map(|spot| {
            watch.check()?;
            Ok(self.distance_mm(spot))
        });
        let distances = distances.collect::<Result<Vec<f64>, Cancelled>>()?;
        let new_way = spots.into_iter().zip(distances);
        let mut farthest = Farthest {
            distance_mm: old_mm.unwrap_or(0.0),
            at: old_spot.map_or(Point::origin(), |spot| spot.at),
        };
        for (spot, distance_mm) in new_way {
            if distance_mm > farthest.distance_mm {
                farthest = Farthest {
                    distance_mm,
                    at: spot.at,
                };
            }
        }
        Ok(farthest)
    }

    /// Returns the spots of a new surface that are measured: an even share, and of many more those
    /// farthest from any triangle. No spot is nearer to what counts of the old surface
    /// than to its triangles, or to the membranes beside them.
    fn spots_to_measure(&self, new: &TriMesh, watch: &Watch) -> Result<Vec<Spot>, Cancelled> {
        let with_distances = spots_among(new, SEARCHED_POINTS, usize::MAX)
            .into_par_iter()
            .map(|spot| {
                watch.check()?;
                let nearest = self.soup.nearest(&spot.at);
                let mm = nearest.map_or(f64::INFINITY, |(at, _)| (at - spot.at).norm());
                Ok((mm, spot))
            });
        let mut far = with_distances.collect::<Result<Vec<_>, Cancelled>>()?;
        far.sort_by(|a, b| b.0.total_cmp(&a.0));
        let far = far.into_iter().take(MOST_FAR).map(|(_, spot)| spot);
        Ok(spots(new, MOST_NEW).into_iter().chain(far).collect())
    }

    /// Returns places that the new surface lacks within a tolerance, mm, the farthest first.
    ///
    /// # Errors
    /// The watch was stopped.
    pub fn missing(
        &self,
        new: &TriMesh,
        within_mm: f64,
        watch: &Watch,
    ) -> Result<Vec<Missing>, Cancelled> {
        let far = self.far_spots(new, MISSING_RATIO * within_mm, watch)?;
        let lost = far.into_iter().filter(|(_, spot)| self.parts_at(spot));
        let lost = lost.map(|(distance_mm, spot)| Missing {
            at: spot.at,
            distance_mm,
        });
        Ok(lost.take(MOST_MISSING).collect())
    }

    /// Returns the spots farther than a limit, mm, from a surface, with their distances, the
    /// farthest first.
    fn far_spots(
        &self,
        new: &TriMesh,
        least_mm: f64,
        watch: &Watch,
    ) -> Result<Vec<(f64, Spot)>, Cancelled> {
        let surface = Bvh::new(new.iter_corners());
        let with_distances = self.spots.par_iter().map(|spot| {
            watch.check()?;
            let nearest = surface.closest(&spot.at, f64::INFINITY, &[]);
            let squared = nearest.map_or(f64::INFINITY, |nearest| nearest.distance_squared);
            Ok((squared.sqrt(), *spot))
        });
        let mut far = with_distances.collect::<Result<Vec<_>, Cancelled>>()?;
        far.retain(|(distance_mm, _)| *distance_mm > least_mm);
        far.sort_by(|a, b| b.0.total_cmp(&a.0));
        Ok(far)
    }

    /// Returns true if an old triangle surely parts inside from outside at a spot of it.
    fn parts_at(&self, spot: &Spot) -> bool {
        let step = spot.normal * (STEP_RATIO * self.size_mm);
        let excess = [spot.at + step, spot.at - step].map(|p| self.soup.winding_number(&p) - 0.5);
        excess[0] * excess[1] < 0.0 && excess.iter().all(|excess| excess.abs() > SURE_RATIO)
    }

    /// Returns a distance from a spot of the new surface within which the old one parts inside from
    /// outside, mm.
    ///
    /// It is that of the nearest triangle, if that parts them. It is the first step to both sides
    /// that comes out on both, if that is less.
    fn distance_mm(&self, spot: &Spot) -> f64 {
        let nearest = self.soup.nearest(&spot.at);
        let nearest = nearest.and_then(|(at, triangle)| Spot::beside(&at, &triangle));
        let nearest = nearest.filter(|nearest| self.parts_at(nearest));
        let near_mm = nearest.map_or(self.size_mm, |nearest| (nearest.at - spot.at).norm());
        let mut step_mm = FIRST_STEP_RATIO * self.size_mm;
        if near_mm <= step_mm {
            return near_mm;
        }
        let outward = self.outward(spot);
        while step_mm < near_mm && !self.is_passed(&spot.at, &(outward * step_mm)) {
            step_mm *= STEP_GROWTH;
        }
        near_mm.min(step_mm)
    }

    /// Returns the direction in which the winding number falls at a spot; the normal if it does not
    /// change. On a membrane the normals of slivers lead nowhere.
    fn outward(&self, spot: &Spot) -> Vector {
        let step_mm = SLOPE_RATIO * self.size_mm;
        let fall = Vector::from_fn(|axis, _| {
            let step = Vector::ith(axis, step_mm);
            self.soup.winding_number(&(spot.at - step))
                - self.soup.winding_number(&(spot.at + step))
        });
        fall.try_normalize(0.0).unwrap_or(spot.normal)
    }

    /// Returns true if a step in comes out inside and a step out outside.
    fn is_passed(&self, at: &Point, step: &Vector) -> bool {
        let is_inside = |p: Point| self.soup.winding_number(&p) > 0.5;
        is_inside(at - step) && !is_inside(at + step)
    }
}

/// Returns points of a surface: spread by area, and in the middle and beside the corners of at most
/// so many triangles.
fn spots(mesh: &TriMesh, most: usize) -> Vec<Spot> {
    spots_among(mesh, SPREAD_POINTS, most)
}

/// Returns spots as [`spots`] does, with so many spread by area.
fn spots_among(mesh: &TriMesh, spread: usize, most: usize) -> Vec<Spot> {
    let corners: Vec<[Point; 3]> = mesh.iter_corners().collect();
    let every = corners.len().div_ceil(most).max(1);
    let spread = spread_points(&corners, spread);
    let spread = spread.iter().map(|spot| (spot.at, spot.triangle));
    let marked = (0..corners.len()).step_by(every).flat_map(|t| {
        let [a, b, c] = corners[t];
        [middle_of(&corners[t]), a, b, c].map(|at| (at, t))
    });
    let all = spread.chain(marked);
    all.filter_map(|(at, t)| Spot::beside(&at, &corners[t]))
        .collect()
}

fn middle_of([a, b, c]: &[Point; 3]) -> Point {
    Point::from((a.coords + b.coords + c.coords) / 3.0)
}
