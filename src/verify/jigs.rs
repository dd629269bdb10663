//! Facts about jigs: they come off, keep their gap, leave the seam free, and hold the parts.

use std::ops::ControlFlow;

use rayon::prelude::*;

use super::rim::rim_of;
use super::{Body, Evidence, PartFacts, Promise, PromisedJig};
use crate::base::watch::{Cancelled, Watch};
use crate::geom::play::{Play, Seat, Spot, Stop, Way};
use crate::geom::triangle::{Feature, closest_on_triangle};
use crate::geom::{Aabb, Bvh, Nearest, Plane, Point, Vector};
use crate::mesh::{TriMesh, least_distance_mm, nearest_shell};

/// Distance within which a jig stops a point of the outside, mm.
const REACH_MM: f64 = 1.0;
/// Distance of the points on the outside that a jig may stop, mm.
const STEP_MM: f64 = 0.15;
/// Distance of the sections of the outside in which more such points lie, mm. Points along the
/// sides of triangles alone miss places that a jig meets first: parts then seem to sink deeper.
/// At 0.1 mm a step of 0.33 mm is stated 3 % too small, at 0.25 mm 11 %.
const SECTION_MM: f64 = 0.1;
/// Least part of a stop's direction in the plane of the joint: others hold nothing there.
const IN_PLANE_RATIO: f64 = 0.9;
/// Distance of the points on the outside from the ends of the ribs that they touch, mm.
const WITHIN_MM: f64 = 1e-3;
/// Least part of the way to the jig that is normal to its face, if it is to stop a point.
const FACING_RATIO: f64 = 0.99;
/// Distance within which faces of a jig meet, mm: a hundred steps of f32 coordinates at 10 mm.
const TOUCHING_MM: f64 = 1e-4;

/// A jig as found in its file.
#[derive(Debug, Clone, PartialEq)]
pub struct JigFacts {
    /// The name of its joint.
    pub joint: String,
    /// Its surface and its place on the plate.
    pub part: PartFacts,
    /// Least distance from the outside of the object, mm.
    pub gap_mm: f64,
    /// Ordered distance, mm.
    pub ordered_gap_mm: f64,
    /// Number of points of either that meet the other while it comes off.
    pub caught: usize,
    /// Least distance from the rim of the joint, mm.
    pub seam_mm: f64,
    /// Play of the parts that are pressed into it; `None` if they slide or turn even so.
    pub play: Option<Play>,
}

/// Measures every jig beside the outside of the object, in the order of the checklist.
///
/// # Errors
/// The watch was stopped before all was measured.
pub fn measure_jigs(
    evidence: &Evidence,
    body: &Body,
    watch: &Watch,
) -> Result<Vec<JigFacts>, Cancelled> {
    let promise = &evidence.promise;
    let jigs = promise.jigs.iter().zip(&evidence.jigs);
    let facts = jigs.map(|(jig, read)| {
        let part = PartFacts::of_part(read, &Bvh::new(read.mesh.iter_corners()), watch)?;
        let rim = rim_in(jig, evidence);
        // The other half of a yo-yo is not there while the glue of this one sets.
        let own = nearest_shell(&body.shells.outward, &rim).unwrap_or(&body.outer);
        let is_whole = own.triangles().len() == body.outer.triangles().len();
        let apart = (!is_whole).then(|| Bvh::new(own.iter_corners()));
        watch.check()?;
        let mesh = read.mesh.map_vertices(|p| read.pose.to_model(p));
        let bench = Bench {
            jig,
            surface: Bvh::new(mesh.iter_corners()),
            mesh,
            outer: own,
            outside: apart.as_ref().unwrap_or(&body.outside),
        };
        Ok(JigFacts {
            joint: jig.joint.clone(),
            part,
            gap_mm: bench.gap_mm(watch)?,
            ordered_gap_mm: jig.gap_mm,
            caught: bench.count_caught(watch)?,
            seam_mm: bench.distance_mm(&rim),
            play: bench.play(&rim, watch)?,
        })
    });
    facts.collect()
}

/// Returns true if a jig leaves a larger step than the process accepts: it holds nothing.
pub fn is_loose(jig: &JigFacts, promise: &Promise) -> bool {
    let max_mm = promise.printer.seam_step_mm.unwrap_or(f64::INFINITY);
    jig.play.is_none_or(|play| play.step_mm > max_mm)
}

/// A jig beside the outside of the object, model frame.
struct Bench<'a> {
    jig: &'a PromisedJig,
    mesh: TriMesh,
    surface: Bvh,
    outer: &'a TriMesh,
    outside: &'a Bvh,
}

/// Returns the plane of a jig's joint.
fn plane_of(jig: &PromisedJig) -> Plane {
    Plane::through(&Point::from(jig.point_mm), &Vector::from(jig.normal))
}

/// Returns points of the rim of a jig's joint; empty if there is no such joint.
fn rim_in(jig: &PromisedJig, evidence: &Evidence) -> Vec<Point> {
    let mut joints = evidence.promise.joints.iter();
    let joint = joints.find(|joint| joint.id == jig.joint);
    let rim = joint.and_then(|joint| rim_of(joint, &plane_of(jig), &evidence.parts));
    rim.unwrap_or_default()
}

impl Bench<'_> {
    fn out(&self) -> Vector {
        Vector::from(self.jig.out)
    }

    fn gap_mm(&self, watch: &Watch) -> Result<f64, Cancelled> {
        watch.check()?;
        let most_mm = 2.0 * self.jig.gap_mm + 1.0;
        Ok(most_mm.min(least_distance_mm(self.outside, &self.mesh)))
    }

    /// Counts the points of the jig that meet the outside on its way off, and those of the outside
    /// that meet the jig.
    fn count_caught(&self, watch: &Watch) -> Result<usize, Cancelled> {
        let [box_a, box_b] = [self.outer.aabb(), self.mesh.aabb()];
        let way = self.out() * (box_a.size().norm() + box_b.size().norm());
        let middle = |corners: [Point; 3]| {
            let [a, b, c] = corners.map(|p| p.coords);
            Point::from((a + b + c) / 3.0)
        };
        let points = |mesh: &TriMesh| {
            let middles = mesh.iter_corners().map(middle);
            mesh.vertices()
                .iter()
                .copied()
                .chain(middles)
                .collect::<Vec<Point>>()
        };
        let count = |of: &TriMesh, surface: &Bvh, way: Vector| {
            let meets = |from: Point| {
                watch.check()?;
                Ok(usize::from(surface.crosses_segment(&from, &(from + way))))
            };
            points(of)
                .into_par_iter()
                .map(meets)
                .sum::<Result<usize, Cancelled>>()
        };
        Ok(count(&self.mesh, self.outside, -way)? + count(self.outer, &self.surface, way)?)
    }

    /// Returns the least distance of the jig from some points, mm; infinite without any.
    fn distance_mm(&self, points: &[Point]) -> f64 {
        let nearest = |p: &Point| self.surface.segment_distance(p, p, f64::INFINITY);
        points.iter().map(nearest).fold(f64::INFINITY, f64::min)
    }

    fn flat(&self, p: &Point) -> Spot {
        let across = Vector::from(self.jig.normal).cross(&self.out());
        Spot::new(across.dot(&p.coords), self.out().dot(&p.coords))
    }

    /// Returns the play of the parts that are pressed into the jig at the height of the rim.
    fn play(&self, rim: &[Point], watch: &Watch) -> Result<Option<Play>, Cancelled> {
        let rim: Vec<Spot> = rim.iter().map(|p| self.flat(p)).collect();
        let Some(first) = rim.first() else {
            return Ok(None);
        };
        let ends = |[low, high]: [Spot; 2], spot: &Spot| [low.inf(spot), high.sup(spot)];
        let [low, high] = rim.iter().fold([*first; 2], ends);
        let middle = nalgebra::center(&low, &high);
        let press = Stop {
            at: Spot::new(middle.x, high.y),
            normal: Way::new(0.0, -1.0),
            room_mm: self.jig.pressed_mm,
        };
        let seat = |side: f64| {
            let stops = self.stops(side, watch)?;
            Ok(Seat::pressed(&stops, &press, middle))
        };
        let (low, high) = rayon::join(|| seat(-1.0), || seat(1.0));
        let (Some(low), Some(high)) = (low?, high?) else {
            return Ok(None);
        };
        watch.check()?;
        Ok(Some(low.play_between(&high, middle, &rim)))
    }

    /// Returns the stops of the part on one side of the joint, -1 or 1.
    fn stops(&self, side: f64, watch: &Watch) -> Result<Vec<Stop>, Cancelled> {
        let plane = plane_of(self.jig);
        // Just within the ribs: an edge of a rib would count with the face of its end.
        let [near, far] = self.jig.ribs_mm;
        let [near, far] = [near + WITHIN_MM, far - WITHIN_MM];
        let slab = self.outer.iter_corners().filter_map(|corners| {
            let beyond = clip(&corners, |p| near - side * plane.distance(p));
            let within = clip(&beyond, |p| side * plane.distance(p) - far);
            (!within.is_empty()).then_some(within)
        });
        let slab: Vec<Vec<Point>> = slab.collect();
        let stops = slab.par_iter().map(|piece| {
            watch.check()?;
            let inside = sections(piece, |p| side * plane.distance(p));
            let points = along(piece).into_iter().chain(inside);
            Ok(points.filter_map(|p| self.stop(&p)).collect())
        });
        let stops = stops.collect::<Result<Vec<Vec<Stop>>, Cancelled>>()?;
        Ok(stops.concat())
    }

    /// Returns whether a face of the jig lies across the way to its nearest point: beside a corner
    /// there is room to pass it. Of the faces that meet at an edge any one will do.
    fn is_faced(&self, way: &Vector, nearest: &Nearest) -> bool {
        let own = self.mesh.corners(nearest.triangle as usize);
        if lies_across(&own, way) || nearest.feature == Feature::Face {
            return lies_across(&own, way);
        }
        let mut is_faced = false;
        let about = Aabb::of_points(&[nearest.point]).inflated(TOUCHING_MM);
        self.surface.visit_overlapping(&about, |_, corners| {
            let touching = closest_on_triangle(&nearest.point, corners).point;
            let touches = (touching - nearest.point).norm() <= TOUCHING_MM;
            is_faced |= touches && lies_across(corners, way);
            if is_faced {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
        is_faced
    }

    /// Returns the stop of a point of the outside; `None` if the jig is far from it, or beside it.
    fn stop(&self, at: &Point) -> Option<Stop> {
        let nearest = self.surface.closest(at, REACH_MM, &[])?;
        let way = nearest.point - at;
        let is_ahead = self.is_faced(&way, &nearest);
        let flat = self.flat(&nearest.point) - self.flat(at);
        let in_plane = flat.norm();
        (is_ahead && in_plane > IN_PLANE_RATIO * way.norm()).then(|| Stop {
            at: self.flat(at),
            normal: flat / in_plane,
            room_mm: in_plane,
        })
    }
}

/// Returns whether a triangle lies across a way.
fn lies_across([a, b, c]: &[Point; 3], way: &Vector) -> bool {
    let normal = (b - a).cross(&(c - a));
    let least = FACING_RATIO * way.norm() * normal.norm();
    least > 0.0 && way.dot(&normal).abs() >= least
}

/// Returns points along the sides of a polygon, [`STEP_MM`] apart at most.
fn along(polygon: &[Point]) -> Vec<Point> {
    let next = polygon.iter().cycle().skip(1);
    let sides = polygon.iter().zip(next);
    sides.flat_map(|(a, b)| spaced([a, b])).collect()
}

/// Returns points from one to before another, [`STEP_MM`] apart at most.
fn spaced([from, to]: [&Point; 2]) -> impl Iterator<Item = Point> + use<> {
    let (from, way) = (*from, to - from);
    let count = (way.norm() / STEP_MM).ceil().max(1.0);
    (0..count as usize).map(move |step| from + way * (step as f64 / count))
}

/// Returns points of a convex polygon in its sections at whole multiples of [`SECTION_MM`] of a
/// linear height, [`STEP_MM`] apart at most.
fn sections(polygon: &[Point], height: impl Fn(&Point) -> f64) -> Vec<Point> {
    let heights = polygon.iter().map(|p| height(p) / SECTION_MM);
    let ends = heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], level| {
        [low.min(level), high.max(level)]
    });
    let levels = ends[0].ceil() as i64..=ends[1].floor() as i64;
    let section = |level: i64| {
        let over = |p: &Point| height(p) - level as f64 * SECTION_MM;
        let next = polygon.iter().cycle().skip(1);
        let crossings = polygon.iter().zip(next).filter_map(|(a, b)| {
            let [at_a, at_b] = [over(a), over(b)];
            ((at_a < 0.0) != (at_b < 0.0)).then(|| a + (b - a) * (at_a / (at_a - at_b)))
        });
        let ends: Vec<Point> = crossings.collect();
        let sides = ends.windows(2);
        sides
            .flat_map(|ends| spaced([&ends[0], &ends[1]]))
            .collect::<Vec<Point>>()
    };
    levels.flat_map(section).collect()
}

/// Returns the part of a convex polygon where `excess` is not positive.
fn clip(polygon: &[Point], excess: impl Fn(&Point) -> f64) -> Vec<Point> {
    let mut kept = Vec::new();
    let next = polygon.iter().cycle().skip(1);
    for (a, b) in polygon.iter().zip(next) {
        let [at_a, at_b] = [excess(a), excess(b)];
        if at_a <= 0.0 {
            kept.push(*a);
        }
        if at_a * at_b < 0.0 {
            kept.push(a + (b - a) * (at_a / (at_a - at_b)));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::primitives;
    use crate::verify::Pose;

    /// Returns two faces that meet in a ridge along x, each so many degrees below the level.
    fn ridge(left_deg: f64, right_deg: f64) -> [[Point; 3]; 4] {
        let foot = |side: f64, deg: f64| {
            let (sin, cos) = deg.to_radians().sin_cos();
            [-9.0, 9.0].map(|x| Point::new(x, side * 5.0 * cos, -5.0 * sin))
        };
        let crest = [-9.0, 9.0].map(|x| Point::new(x, 0.0, 0.0));
        let (left, right) = (foot(-1.0, left_deg), foot(1.0, right_deg));
        [
            [left[0], left[1], crest[1]],
            [left[0], crest[1], crest[0]],
            [crest[0], crest[1], right[1]],
            [crest[0], right[1], right[0]],
        ]
    }

    /// Returns the stop of a point over a ridge, whose faces stand in this order in the file.
    fn stop_over(faces: &[[Point; 3]], at: &Point) -> Option<Stop> {
        let jig = PromisedJig {
            id: String::new(),
            joint: String::new(),
            file: String::new(),
            print_from_model: Pose::identity(),
            out: [0.0, 0.0, 1.0],
            point_mm: [0.0; 3],
            normal: [1.0, 0.0, 0.0],
            gap_mm: 0.1,
            ribs_mm: [4.0, 8.0],
            pressed_mm: 0.03,
        };
        let corners = |face: u32| [3 * face, 3 * face + 1, 3 * face + 2];
        let outer = primitives::ball(&Point::origin(), 1.0, 1);
        let outside = Bvh::new(outer.iter_corners());
        let bench = Bench {
            jig: &jig,
            mesh: TriMesh::new(faces.concat(), (0..4).map(corners).collect()).unwrap(),
            surface: Bvh::new(faces.iter().copied()),
            outside: &outside,
            outer: &outer,
        };
        bench.stop(at)
    }

    #[test]
    fn a_ridge_stops_a_point_that_one_of_its_faces_lies_below() {
        // A way between both normals, 2° from the right one and 13° from the left one.
        let tilt = 1.0_f64.to_radians();
        let at = Point::new(0.3, 0.5 * tilt.sin(), 0.5 * tilt.cos());
        let faces = ridge(12.0, 3.0);
        let mut turned = faces;
        turned.reverse();
        for faces in [faces, turned] {
            let stop = stop_over(&faces, &at).unwrap();
            assert!((stop.room_mm - 0.5).abs() < 1e-9);
        }
    }

    #[test]
    fn beside_a_sharp_ridge_there_is_room_to_pass() {
        let at = Point::new(0.3, 0.0, 0.5);
        assert_eq!(stop_over(&ridge(30.0, 20.0), &at), None);
    }
}
