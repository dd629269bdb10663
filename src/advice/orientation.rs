//! The best way up: axes over the whole sphere are ranked, and the best of them refined.

use rayon::prelude::*;

use super::case::Case;
use super::directions::{distinct, is_new, lattice, round_direction, with_axis};
use super::footing::resting_directions;
use super::reached::Reached;
use super::sampled_model::{COARSE_SAMPLES, FINE_SAMPLES, SampledModel, Trial};
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Frame, Point, Vector};
use crate::goal::{self, Contact, GoalKind, MeasuredSolid, Request};
use crate::mass::{Body, moments_of_mesh};
use crate::mesh::{Csg, TriMesh};

/// The number of lattice directions: 16° apart. Fewer miss the narrow ranges in which a top stands
/// over its contact; more cost some milliseconds each.
const LATTICE: usize = 160;
/// Directions nearer than this count as one: cos 3°.
const SAME_COSINE: f64 = 0.9986;
/// The number of best axes that are refined, and their least distance: cos 10°.
const STARTS: usize = 3;
const APART_COSINE: f64 = 0.985;
/// The first and the last tilt of a refinement, rad. Below the last, the critical speed changes by
/// less than the gap of its certificate on coarse columns.
const FIRST_TILT: f64 = 0.14;
const LAST_TILT: f64 = 0.008;
/// The height above the lowest at which a corner is still tried, as a part of the longest side.
/// Hollowing shifts the centre of mass by some per cent of that side.
const CORNER_SLACK_RATIO: f64 = 0.02;
/// The number of tilts from each place.
const WAYS: usize = 6;

/// An axis, and the value that the goal reaches on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orientation {
    /// The request with its axis, and a standing object's face, chosen.
    pub request: Request,
    /// The value it is ranked by, on sampled columns.
    pub reached: Reached,
    /// The number of axes that were tried before the best were refined.
    pub tried: usize,
    /// The number of these for which the goal is possible.
    pub possible: usize,
}

/// Returns the axis on which the goal reaches the best value. `None` if it is possible on none of
/// the axes tried.
///
/// The contact follows the request's own rule. If the lowest point allows no axis, it is put below
/// the centre of mass on a tip. So it is if the contact is free and leans too little there.
///
/// The axes tried are the faces of the convex hull for a standing object. For the other goals they
/// are a lattice over the sphere, the coordinate axes and the solid's principal axes. A yo-yo's
/// axis has no sense, so half of them suffice. For a top on its lowest point, the directions in
/// which a corner lies below the centre of mass are added.
///
/// The best few are refined by smaller and smaller tilts. Costs some hundred trials, about a second
/// on 10 000 triangles.
///
/// # Errors
/// The watch was stopped.
pub fn best_orientation(case: &Case, watch: &Watch) -> Result<Option<Orientation>, Cancelled> {
    let with = |contact| {
        let request = Request {
            contact: Some(contact),
            ..case.request
        };
        best_with_contact_rule(&Case { request, ..*case }, watch)
    };
    let best = match case.request.contact {
        Some(Contact::Auto) => with(Contact::Lowest).filter(|best| spins_on_lowest(case, best)),
        _ => best_with_contact_rule(case, watch),
    };
    watch.check()?;
    let is_lowest = matches!(case.request.contact, Some(Contact::Auto | Contact::Lowest));
    if best.is_some() || !is_lowest {
        return Ok(best);
    }
    let best = with(Contact::Center);
    watch.check()?;
    Ok(best)
}

/// Returns true if a top keeps its promise on the lowest point below an axis.
fn spins_on_lowest(case: &Case, best: &Orientation) -> bool {
    let measured = MeasuredSolid::new(case.solid);
    goal::spins_on_lowest(&measured, case.wall_mm, &best.request).unwrap_or(false)
}

fn best_with_contact_rule(case: &Case, watch: &Watch) -> Option<Orientation> {
    let coarse = SampledModel::new(*case, COARSE_SAMPLES, watch);
    let axes = candidates(case);
    let ranked = rank_axes(&coarse, &axes);
    let starts = spread(&ranked);
    let model = SampledModel::new(*case, FINE_SAMPLES, watch);
    let refined: Vec<Option<Place>> = starts
        .par_iter()
        .map(|start| refine(&model, start))
        .collect();
    let best = refined.into_iter().flatten().min_by(by_score)?;
    let (request, wall_mm) = (best.request, case.wall_mm);
    let as_promised = model.trial_as_promised(&request, wall_mm);
    let reached = as_promised.filter(Trial::is_possible);
    let reached = reached.map_or(best.reached, |trial| {
        Reached::of(&trial.solution.certificate)
    });
    Some(Orientation {
        request,
        reached,
        tried: axes.len(),
        possible: ranked.len(),
    })
}

/// A possible axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub axis: Vector,
    pub request: Request,
    pub reached: Reached,
}

pub(super) fn by_score(a: &Place, b: &Place) -> std::cmp::Ordering {
    a.reached.score().total_cmp(&b.reached.score())
}

/// Tries a goal on an axis. Returns `None` if it is impossible there.
pub(super) fn place_on(model: &SampledModel, axis: &Vector) -> Option<Place> {
    place_with(model, axis, model.case.request.contact)
}

/// Tries a goal on an axis with this contact. Returns `None` if it is impossible there.
pub(super) fn place_with(
    model: &SampledModel,
    axis: &Vector,
    contact: Option<Contact>,
) -> Option<Place> {
    let axis = round_direction(axis);
    let request = Request {
        contact,
        ..with_axis(&model.case.request, &axis)
    };
    let trial = model
        .trial(&request, model.case.wall_mm)
        .filter(Trial::is_possible)?;
    Some(Place {
        axis,
        request,
        reached: Reached::of(&trial.solution.certificate),
    })
}

/// Returns the possible axes, the best first.
fn rank_axes(model: &SampledModel, axes: &[Vector]) -> Vec<Place> {
    let places: Vec<Option<Place>> = axes.par_iter().map(|axis| place_on(model, axis)).collect();
    let mut places: Vec<Place> = places.into_iter().flatten().collect();
    places.sort_by(by_score);
    places
}

/// Returns the best few that lie apart.
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

/// Refines a place on the finely sampled model: tilts it while that improves the value, by smaller
/// and smaller angles.
fn refine(model: &SampledModel, start: &Place) -> Option<Place> {
    let mut best = place_on(model, &start.axis)?;
    let mut tilt = if model.case.request.kind == GoalKind::Stand {
        0.0
    } else {
        FIRST_TILT
    };
    while tilt > LAST_TILT {
        let ways: Vec<Option<Place>> = tilts_around(&best.axis, tilt)
            .par_iter()
            .map(|axis| place_on(model, axis))
            .collect();
        let better = ways.into_iter().flatten().min_by(by_score);
        match better.filter(|place| by_score(place, &best).is_lt()) {
            Some(place) => best = place,
            None => tilt *= 0.5,
        }
    }
    Some(best)
}

/// Returns the directions at this angle from an axis, evenly around it.
fn tilts_around(axis: &Vector, tilt: f64) -> Vec<Vector> {
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

/// Returns the axes to try.
pub(super) fn candidates(case: &Case) -> Vec<Vector> {
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

/// Returns the coordinate axes and the solid's principal axes, in both senses.
pub(super) fn special_axes(case: &Case) -> Vec<Vector> {
    let principal = Body::new(&moments_of_mesh(case.solid.mesh()), 1.0)
        .principal()
        .axes;
    let own = [2, 1, 0].map(|i| round_direction(&principal.column(i).into_owned()));
    let axes = [Vector::z(), Vector::y(), Vector::x()]
        .into_iter()
        .chain(own);
    axes.flat_map(|axis| [axis, -axis])
        .map(|axis| round_direction(&axis))
        .collect()
}

/// Returns true if the first of z, y, x that is not zero is negative. This picks one of the two
/// senses of an axis.
pub(super) fn points_down(axis: &Vector) -> bool {
    let first = [axis.z, axis.y, axis.x]
        .into_iter()
        .find(|part| part.abs() > f64::EPSILON);
    first.is_some_and(|part| part < 0.0)
}

/// Returns the directions from a corner of the convex hull to the centre of mass, if that corner is
/// then the lowest or nearly so. The solid almost balances on it, so hollowing has the least to do.
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
