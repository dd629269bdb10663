//! The facts about several telescopes on junctures.

use rayon::prelude::*;

use super::contact::{Body, moved};
use super::course::{APART_SHARE, BETWEEN, SAME_MM, mixed};
use super::divided::{DividedFacts, Joints};
use super::facts::{TelescopeFacts, judge_bodies, shell_bodies};
use super::motion::frame_of;
use super::network::{NetworkEvidence, Places};
use super::network_ends::Ends;
use super::network_model::{Made, ModelFacts, measure_model};
use super::network_seats::Seats;
use super::network_standing::{Balanced, NetworkStanding, measure_standing};
use super::pose::{PoseState, PosesFacts};
use super::poses::PoseTrial;
use super::surfaces::{LyingPart, Surfaces};
use crate::base::units::MM3_PER_CM3;
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Aabb, Frame, Point, Vector};
use crate::mass::{Moments, moments_of_mesh};

/// The facts about several telescopes.
#[derive(Debug, Clone, PartialEq)]
pub struct NetworkFacts {
    /// Those of every telescope.
    pub limbs: Vec<TelescopeFacts>,
    /// Junctures that bound no solid, with the first defect.
    pub broken: Vec<String>,
    /// Pairs of triangles of one juncture that cross.
    pub crossings: usize,
    /// Junctures that are more than one body.
    pub in_pieces: Vec<String>,
    /// The greatest height of a juncture's lowest point over the plate, mm.
    pub above_plate_mm: f64,
    /// Junctures that are larger than the printer.
    pub too_large: Vec<String>,
    /// Faults of roots in their sockets and pegs in their mouths, in words.
    pub seat_faults: Vec<String>,
    /// The facts about every juncture in several parts.
    pub divided: Vec<DividedFacts>,
    /// The facts about junctures that are pieces of a model; `None` if they are none.
    pub model: Option<ModelFacts>,
    /// Pairs of bodies that come too near at a state, in words.
    pub too_near: Vec<String>,
    /// The greatest difference of a written motion from the judge's own, mm.
    pub placement_error_mm: f64,
    /// Mass of all parts, g.
    pub mass_g: f64,
    /// The centre of mass at every key, mm.
    pub centres: Vec<Point>,
    /// How it stands on its first juncture; `None` if it need not.
    pub standing: Option<NetworkStanding>,
    /// The boxes of all parts when all in and all out, mm.
    pub boxes_mm: [[f64; 3]; 2],
    /// The facts about its poses.
    pub poses: PosesFacts,
}

/// A body with its name, and what it is fixed to.
struct Named {
    name: String,
    place: Place,
    body: Body,
    centre: Point,
    radius_mm: f64,
}

/// A shell of a limb, or a juncture, counted from 0.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Place {
    Shell { limb: usize, shell: usize },
    Juncture(usize),
}

/// Measures several telescopes and their junctures.
///
/// # Errors
/// The watch was stopped.
pub fn judge_network(evidence: &NetworkEvidence, watch: &Watch) -> Result<NetworkFacts, Cancelled> {
    let promise = &evidence.promise;
    let shells: Vec<Vec<Body>> = evidence.limbs.iter().map(shell_bodies).collect();
    let limbs = evidence.limbs.iter().zip(&shells);
    let limbs = limbs.map(|(limb, bodies)| judge_bodies(limb, bodies, watch));
    let limbs = limbs.collect::<Result<Vec<_>, Cancelled>>()?;
    let junctures = evidence.whole_junctures().into_iter().map(Body::new);
    let junctures: Vec<Body> = junctures.collect();
    let seat_faults = seats(evidence, &shells, &junctures);
    let read = evidence.junctures.iter().flatten();
    let parts = read.map(|part| LyingPart {
        id: &part.id,
        mesh: &part.mesh,
    });
    let surfaces = Surfaces::of(parts, promise.printer.build_volume_mm, watch)?;
    let made = Made {
        ends: (0..limbs.len())
            .map(|limb| Ends::of(evidence, limb))
            .collect(),
        joints: (0..promise.junctures.len())
            .map(|juncture| Joints::of(evidence, juncture))
            .collect(),
    };
    let joints = made.joints.iter().flatten();
    let divided = joints.map(|joints| joints.facts(evidence, &made.ends, watch));
    let divided = divided.collect::<Result<Vec<_>, Cancelled>>()?;
    let mut poses =
        pose_trial(evidence, &shells).facts(|key| evidence.places(key).shells, watch)?;
    let bodies = named(evidence, shells, junctures);
    poses.faults.extend(touched(evidence, &bodies, watch)?);
    let moments: Vec<Moments> = bodies
        .iter()
        .map(|b| moments_of_mesh(&b.body.mesh))
        .collect();
    let volume: f64 = moments.iter().map(Moments::volume).sum();
    let keys = &evidence.motion.keys;
    let opening: Vec<&PoseState> = keys.iter().map(|key| &key.states).collect();
    let ends = [keys.first(), keys.last()];
    let size = |states: &[Vec<[f64; 2]>]| size_mm(&bodies, &evidence.places(states));
    Ok(NetworkFacts {
        limbs,
        broken: surfaces.broken,
        crossings: surfaces.crossings,
        in_pieces: surfaces.in_pieces,
        above_plate_mm: surfaces.above_plate_mm,
        too_large: surfaces.too_large,
        seat_faults,
        divided,
        model: measure_model(evidence, &made, watch)?,
        too_near: too_near(evidence, &bodies, &opening, watch)?,
        poses,
        placement_error_mm: placement_error_mm(evidence),
        mass_g: volume * promise.material.density_g_cm3 / MM3_PER_CM3,
        standing: standing(evidence, &bodies, &moments),
        centres: centres(evidence, &bodies, &moments),
        boxes_mm: ends.map(|key| key.map_or([0.0; 3], |key| size(&key.states))),
    })
}

/// Returns the centre of mass at every key.
fn centres(evidence: &NetworkEvidence, bodies: &[Named], moments: &[Moments]) -> Vec<Point> {
    let keys = evidence.motion.keys.iter();
    let places = keys.map(|key| evidence.places(&key.states));
    places
        .map(|places| centre(&places, bodies, moments))
        .collect()
}

fn centre(places: &Places, bodies: &[Named], moments: &[Moments]) -> Point {
    let volume: f64 = moments.iter().map(Moments::volume).sum();
    let weighed = bodies.iter().zip(moments).map(|(body, moments)| {
        let frame = places.of(body.place);
        frame.to_model(&moments.centroid()).coords * moments.volume()
    });
    Point::from(weighed.sum::<Vector>() / volume)
}

/// Returns how it stands on its first juncture; `None` if it need not.
fn standing(
    evidence: &NetworkEvidence,
    bodies: &[Named],
    moments: &[Moments],
) -> Option<NetworkStanding> {
    evidence.promise.least_angle_deg?;
    let mut junctures = bodies.iter();
    let base = junctures.find(|body| body.place == Place::Juncture(0))?;
    let state = |places: &Places, to_ground: &Frame| {
        let lowest = bodies.par_iter().map(|body| {
            let placed = to_ground.frame_to_model(places.of(body.place));
            let heights = body.body.mesh.vertices().iter();
            heights.fold(f64::INFINITY, |low, p| low.min(placed.to_model(p).z))
        });
        Balanced {
            centre: centre(places, bodies, moments),
            lowest_mm: lowest.reduce(|| f64::INFINITY, f64::min),
        }
    };
    Some(measure_standing(evidence, &base.body.mesh, state))
}

fn pose_trial<'a>(evidence: &'a NetworkEvidence, shells: &'a [Vec<Body>]) -> PoseTrial<'a> {
    PoseTrial {
        promises: &evidence.promise.poses,
        poses: &evidence.motion.poses,
        files: &evidence.pose_files,
        limbs: evidence.limbs.iter().collect(),
        bodies: shells.iter().map(Vec::as_slice).collect(),
    }
}

/// Returns the bodies of different telescopes and junctures that touch on the way to a pose.
fn touched(
    evidence: &NetworkEvidence,
    bodies: &[Named],
    watch: &Watch,
) -> Result<Vec<String>, Cancelled> {
    let mut faults = Vec::new();
    for pose in pose_trial(evidence, &[]).sound() {
        let keys: Vec<&PoseState> = pose.keys.iter().collect();
        let near = too_near(evidence, bodies, &keys, watch)?.into_iter();
        faults.extend(near.map(|why| format!("pose {}: {why}", pose.name)));
    }
    Ok(faults)
}

fn seats(evidence: &NetworkEvidence, shells: &[Vec<Body>], junctures: &[Body]) -> Vec<String> {
    let limbs = evidence.promise.limbs.par_iter().enumerate();
    let faults = limbs.map(|(index, limb)| {
        let seats = Seats {
            id: &limb.id,
            motion: &evidence.motion.limbs[index],
            shells: &shells[index],
            from: &junctures[limb.from - 1],
            to: &junctures[limb.to - 1],
            glue_mm: evidence.promise.glue_mm,
        };
        seats.faults()
    });
    faults.collect::<Vec<_>>().into_iter().flatten().collect()
}

fn named(evidence: &NetworkEvidence, shells: Vec<Vec<Body>>, junctures: Vec<Body>) -> Vec<Named> {
    let motions = &evidence.motion.limbs;
    let shells = shells.into_iter().enumerate().flat_map(|(limb, bodies)| {
        let bodies = bodies.into_iter().enumerate();
        bodies.map(move |(shell, body)| {
            let name = motions[limb].shells[shell].id.clone();
            (name, Place::Shell { limb, shell }, body)
        })
    });
    let names = evidence
        .promise
        .junctures
        .iter()
        .map(|part| part.id.clone());
    let junctures = names.zip(junctures).enumerate();
    let junctures = junctures.map(|(index, (name, body))| (name, Place::Juncture(index), body));
    let all = shells.chain(junctures);
    all.map(|(name, place, body)| Named {
        name,
        place,
        centre: body.centre(),
        radius_mm: body.radius_mm(),
        body,
    })
    .collect()
}

impl Places {
    fn of(&self, place: Place) -> &Frame {
        match place {
            Place::Shell { limb, shell } => &self.shells[limb][shell],
            Place::Juncture(index) => &self.junctures[index],
        }
    }
}

/// Returns the box of all bodies, mm, along the model's axes.
fn size_mm(bodies: &[Named], places: &Places) -> [f64; 3] {
    let boxes = bodies
        .iter()
        .map(|body| moved(&body.body.mesh, places.of(body.place)).aabb());
    let whole = boxes.fold(Aabb::EMPTY, |whole, part| whole.union(&part));
    whole.size().into()
}

fn placement_error_mm(evidence: &NetworkEvidence) -> f64 {
    let errors = evidence.motion.keys.iter().map(|key| {
        let own = evidence.places(&key.states).junctures;
        if own.len() != key.junctures.len() {
            return f64::INFINITY;
        }
        let pairs = own.iter().zip(&key.junctures).map(|(own, written)| {
            let written = frame_of(written);
            let far = (own.origin - written.origin).norm();
            far.max((own.axes - written.axes).amax())
        });
        pairs.fold(0.0, f64::max)
    });
    errors.fold(0.0, f64::max)
}

/// Returns the pairs of bodies of which neither slides in the other and that are not glued, where
/// they come nearer than their limit.
fn too_near(
    evidence: &NetworkEvidence,
    bodies: &[Named],
    keys: &[&PoseState],
    watch: &Watch,
) -> Result<Vec<String>, Cancelled> {
    let clearance = evidence.limbs.iter().map(|limb| limb.promise.clearance_mm);
    let limit_mm = APART_SHARE * clearance.fold(f64::INFINITY, f64::min);
    let count = bodies.len();
    let pairs = (0..count).flat_map(|i| (i + 1..count).map(move |j| [i, j]));
    let pairs = pairs.filter(|pair| !evidence.is_one(pair.map(|body| bodies[body].place)));
    let mut pairs: Vec<Looked> = pairs.map(Looked::new).collect();
    let mut found = Vec::new();
    for (number, pair) in keys.windows(2).enumerate() {
        let first = (number == 0).then_some(0.0);
        for share in first.into_iter().chain(BETWEEN).chain([1.0]) {
            watch.check()?;
            let limbs = pair[0].iter().zip(pair[1]);
            let states: Vec<_> = limbs.map(|(a, b)| mixed(a, b, share)).collect();
            let places = evidence.places(&states);
            let near = pairs.par_iter_mut().filter_map(|pair| {
                let [a, b] = pair.bodies.map(|body| &bodies[body]);
                let is_near = pair.look([a, b], &places, limit_mm);
                is_near.then(|| format!("{} and {} in move {}", a.name, b.name, number + 1))
            });
            found.extend(near.collect::<Vec<_>>());
        }
    }
    Ok(found)
}

impl NetworkEvidence {
    /// Returns true for shells of one telescope, which its own judge holds against each other, and
    /// for what is glued together.
    fn is_one(&self, places: [Place; 2]) -> bool {
        match places {
            [Place::Shell { limb: a, .. }, Place::Shell { limb: b, .. }] => a == b,
            [Place::Shell { limb, shell }, Place::Juncture(index)]
            | [Place::Juncture(index), Place::Shell { limb, shell }] => {
                let own = &self.promise.limbs[limb];
                let last = self.motion.limbs[limb].shells.len() - 1;
                (own.from == index + 1 && shell == 0) || (own.to == index + 1 && shell == last)
            }
            _ => false,
        }
    }
}

/// A pair of bodies, and where the second was last, seen from the first.
struct Looked {
    bodies: [usize; 2],
    last: Option<Frame>,
}

impl Looked {
    fn new(bodies: [usize; 2]) -> Self {
        Self { bodies, last: None }
    }

    /// Returns true if the bodies come nearer than a limit, where they were not before.
    fn look(&mut self, [a, b]: [&Named; 2], places: &Places, limit_mm: f64) -> bool {
        let (own, other) = (places.of(a.place), places.of(b.place));
        let placed = own.inverse().frame_to_model(other);
        let is_known = self.last.is_some_and(|last| {
            (last.origin - placed.origin).norm() < SAME_MM
                && (last.axes - placed.axes).amax() < SAME_MM
        });
        self.last = Some(placed);
        let apart = (a.centre - placed.to_model(&b.centre)).norm();
        if is_known || apart - a.radius_mm - b.radius_mm > limit_mm {
            return false;
        }
        // The smaller one is moved.
        if b.radius_mm > a.radius_mm {
            return b.body.is_nearer(&a.body, &placed.inverse(), limit_mm);
        }
        a.body.is_nearer(&b.body, &placed, limit_mm)
    }
}
