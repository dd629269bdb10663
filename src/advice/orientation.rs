//! Which way up is best: axes over the whole sphere, ranked, and the best of them refined.

use rayon::prelude::*;

use super::Case;
use super::directions::{distinct, is_new, lattice, rounded_direction};
use super::footing::resting_directions;
use super::ground::{COARSE_SAMPLES, FINE_SAMPLES, Ground, Trial};
use super::reached::Reached;
use crate::geom::{Frame, Point, Vector};
use crate::goal::{Contact, GoalKind, Request, Up};
use crate::mass::{Body, moments_of_mesh};
use crate::mesh::{Csg, TriMesh};

/// Directions of the lattice: 16° apart. Fewer miss the narrow ranges in which a top stands over
/// its contact; more cost some milliseconds each.
const LATTICE: usize = 160;
/// Directions nearer than this are one: cos 3°.
const SAME_COSINE: f64 = 0.9986;
/// How many of the best are refined, and how far apart they are: cos 10°.
const STARTS: usize = 3;
const APART_COSINE: f64 = 0.985;
/// The first and the last tilt of a refinement, rad. The last is where the critical speed changes
/// by less than its certificate on the coarse columns can tell.
const FIRST_TILT: f64 = 0.14;
const LAST_TILT: f64 = 0.008;
/// How much higher than the lowest a corner may be to be tried, as a part of the longest side:
/// hollowing shifts the centre of mass by some per cent of it.
const CORNER_SLACK_RATIO: f64 = 0.02;
/// Ways to tilt from each place.
const WAYS: usize = 6;

/// An axis, and what the goal reaches on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orientation {
    /// The request with its axis, and a standing object's face, chosen.
    pub request: Request,
    /// What it is ranked by, on sampled columns.
    pub reached: Reached,
    /// How many axes were tried before the best were refined.
    pub tried: usize,
    /// For how many of them the goal is possible.
    pub possible: usize,
}

/// The axis on which the goal reaches most, over all directions; none where it is possible on none
/// of those tried.
///
/// The contact follows by the request's own rule; where the lowest point allows no axis, it is put
/// below the centre of mass, where a tip has to reach it. Tried are a lattice over the sphere (half
/// of it for a yo-yo, whose axis has no sense), the coordinate axes, the solid's principal axes
/// and, for a top on its lowest point, the directions in which a corner lies below the centre of
/// mass; for a standing object the faces of its convex hull. The best few are refined by tilting
/// less and less. Takes some hundred trials, about a second on 10 000 triangles.
pub fn best_orientation(case: &Case) -> Option<Orientation> {
    let center = Request {
        contact: Some(Contact::Center),
        ..case.request
    };
    let is_lowest = case.request.contact == Some(Contact::Lowest);
    best_by_its_rule(case).or_else(|| {
        if is_lowest {
            best_by_its_rule(&Case {
                request: center,
                ..*case
            })
        } else {
            None
        }
    })
}

fn best_by_its_rule(case: &Case) -> Option<Orientation> {
    let coarse = Ground::new(*case, COARSE_SAMPLES);
    let axes = candidates(case);
    let ranked = ranked(&coarse, &axes);
    let starts = spread(&ranked);
    let ground = Ground::new(*case, FINE_SAMPLES);
    let refined: Vec<Option<Place>> = starts
        .par_iter()
        .map(|start| refined(&ground, start))
        .collect();
    let best = refined.into_iter().flatten().min_by(by_score)?;
    let (request, reached) = (best.request, best.reached);
    Some(Orientation {
        request,
        reached,
        tried: axes.len(),
        possible: ranked.len(),
    })
}

/// A possible axis.
#[derive(Debug, Clone, Copy)]
struct Place {
    axis: Vector,
    request: Request,
    reached: Reached,
}

fn by_score(a: &Place, b: &Place) -> std::cmp::Ordering {
    a.reached.score().total_cmp(&b.reached.score())
}

/// The request with this axis.
pub(super) fn along(request: &Request, axis: &Vector) -> Request {
    Request {
        up: Up::Along((*axis).into()),
        ..*request
    }
}

/// What a goal reaches on an axis; none where it is impossible.
fn place_on(ground: &Ground, axis: &Vector) -> Option<Place> {
    let axis = rounded_direction(axis);
    let request = along(&ground.case.request, &axis);
    let trial = ground
        .trial(&request, ground.case.wall_mm)
        .filter(Trial::is_possible)?;
    Some(Place {
        axis,
        request,
        reached: Reached::of(&trial),
    })
}

/// The possible axes, the best first.
fn ranked(ground: &Ground, axes: &[Vector]) -> Vec<Place> {
    let places: Vec<Option<Place>> = axes.par_iter().map(|axis| place_on(ground, axis)).collect();
    let mut places: Vec<Place> = places.into_iter().flatten().collect();
    places.sort_by(by_score);
    places
}

/// The best few that lie apart.
fn spread(ranked: &[Place]) -> Vec<Place> {
    let mut chosen: Vec<Vector> = Vec::new();
    let mut starts = Vec::new();
    for place in ranked {
        if starts.len() < STARTS && is_new(&chosen, &place.axis, APART_COSINE) {
            chosen.push(place.axis);
            starts.push(*place);
        }
    }
    starts
}

/// A place on the finer ground, tilted as long as that is better, less and less.
fn refined(ground: &Ground, start: &Place) -> Option<Place> {
    let mut best = place_on(ground, &start.axis)?;
    let mut tilt = if ground.case.request.kind == GoalKind::Stand {
        0.0
    } else {
        FIRST_TILT
    };
    while tilt > LAST_TILT {
        let ways: Vec<Option<Place>> = tilted(&best.axis, tilt)
            .par_iter()
            .map(|axis| place_on(ground, axis))
            .collect();
        let better = ways.into_iter().flatten().min_by(by_score);
        match better.filter(|place| by_score(place, &best).is_lt()) {
            Some(place) => best = place,
            None => tilt *= 0.5,
        }
    }
    Some(best)
}

/// The directions this much aside, evenly around.
fn tilted(axis: &Vector, tilt: f64) -> Vec<Vector> {
    let frame = Frame::with_axis(Point::origin(), axis);
    let around = (0..WAYS).map(|i| std::f64::consts::TAU * i as f64 / WAYS as f64);
    let aside = |angle: f64| {
        let local = Vector::new(
            tilt.sin() * angle.cos(),
            tilt.sin() * angle.sin(),
            tilt.cos(),
        );
        frame.direction_to_model(&local)
    };
    around.map(aside).collect()
}

/// The axes to try.
fn candidates(case: &Case) -> Vec<Vector> {
    let mesh = case.solid.mesh();
    if case.request.kind == GoalKind::Stand {
        return resting_directions(mesh);
    }
    let mut all = special_axes(case);
    all.extend(lattice(LATTICE));
    if case.request.contact == Some(Contact::Lowest) {
        all.extend(over_corners(mesh));
    }
    if case.request.kind == GoalKind::Yoyo {
        all.iter_mut()
            .filter(|axis| points_down(axis))
            .for_each(|axis| *axis = -*axis);
    }
    distinct(all, SAME_COSINE)
}

/// The coordinate axes and the solid's principal ones, in both senses.
pub(super) fn special_axes(case: &Case) -> Vec<Vector> {
    let principal = Body::new(&moments_of_mesh(case.solid.mesh()), 1.0)
        .principal()
        .axes;
    let own = [2, 1, 0].map(|i| rounded_direction(&principal.column(i).into_owned()));
    let axes = [Vector::z(), Vector::y(), Vector::x()]
        .into_iter()
        .chain(own);
    axes.flat_map(|axis| [axis, -axis])
        .map(|axis| rounded_direction(&axis))
        .collect()
}

/// Whether the first of z, y, x that is not zero is negative: one of the two senses of an axis.
pub(super) fn points_down(axis: &Vector) -> bool {
    let first = [axis.z, axis.y, axis.x]
        .into_iter()
        .find(|part| part.abs() > f64::EPSILON);
    first.is_some_and(|part| part < 0.0)
}

/// The directions from a corner of the convex hull to the centre of mass, where that corner is the
/// lowest or nearly so: the solid all but balances on it, and hollowing has the least to do.
pub(super) fn over_corners(mesh: &TriMesh) -> Vec<Vector> {
    let center = moments_of_mesh(mesh).centroid();
    let hull = Csg::convex_hull(mesh.vertices())
        .and_then(|hull| hull.to_mesh())
        .unwrap_or_default();
    let slack_mm = CORNER_SLACK_RATIO * mesh.longest_side_mm();
    let is_low = |corner: &Point, up: &Vector| {
        let height_mm = corner.coords.dot(up) - slack_mm;
        hull.vertices()
            .iter()
            .all(|other| other.coords.dot(up) >= height_mm)
    };
    let over = |corner: &Point| {
        (center - corner)
            .try_normalize(0.0)
            .filter(|up| is_low(corner, up))
    };
    distinct(
        hull.vertices().iter().filter_map(over).collect(),
        SAME_COSINE,
    )
}
