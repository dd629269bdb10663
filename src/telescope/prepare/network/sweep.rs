//! The order in which the telescopes of a network open without touching each other.
//!
//! Shells of one telescope were proved free before. Here every body that a move carries is held
//! against every other. Two states are so near that no point goes farther than the gap that all
//! pairs keep at both. So nothing lies between them.

use rayon::prelude::*;

use super::super::made::Made;
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Aabb, Frame, Point};
use crate::mesh::{MeshDistance, TriMesh};
use crate::telescope::motion::{Key, between};
use crate::telescope::nest::JointState;
use crate::telescope::network::{Network, NetworkFrames};

/// The gap that bodies keep which move against each other, mm.
const CLEAR_MM: f64 = 0.6;
/// Share of the gap by which a point may move from one state to the next.
const STEP_SHARE: f64 = 0.9;
/// The gap of bodies that are at rest against each other, mm: rounding.
const TOUCH_MM: f64 = 1e-3;
/// The most steps of a move: more than any move of a print needs. A longer one counts as barred.
const MAX_STEPS: usize = 2_000;

/// A body: a shell of a limb with its cap, or a juncture. All are counted from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Item {
    /// A shell of a limb.
    Shell { limb: usize, shell: usize },
    /// A juncture.
    Juncture(usize),
}

/// Two bodies that meet, while a limb opens.
#[derive(Debug, Clone, PartialEq)]
pub struct Hit {
    pub limb: usize,
    pub items: [Item; 2],
}

/// The states between the moves of a limb.
struct Way<'a> {
    limb: usize,
    keys: &'a [Key],
}

struct Body {
    item: Item,
    mesh: TriMesh,
    bounds: Aabb,
    distance: MeshDistance,
    centre: Point,
    radius_mm: f64,
}

/// The bodies of a network.
pub struct Bodies<'a> {
    network: &'a Network,
    bodies: Vec<Body>,
}

impl<'a> Bodies<'a> {
    /// Takes the parts as they were written, and the junctures where they are when all is out.
    pub fn new(network: &'a Network, limbs: &[&Made], junctures: Vec<TriMesh>) -> Self {
        let shells = limbs.iter().enumerate().flat_map(|(limb, made)| {
            let pairs = made.parts.chunks(2).enumerate();
            pairs.map(move |(shell, pair)| {
                let mesh = pair
                    .iter()
                    .fold(TriMesh::default(), |all, part| all.joined(&part.in_shell()));
                (Item::Shell { limb, shell }, mesh)
            })
        });
        let junctures = junctures.into_iter().enumerate();
        let junctures = junctures.map(|(index, mesh)| (Item::Juncture(index), mesh));
        let all: Vec<(Item, TriMesh)> = shells.chain(junctures).collect();
        let bodies = all.into_par_iter().map(|(item, mesh)| {
            let bounds = mesh.aabb();
            let centre = bounds.center();
            let far = mesh.vertices().iter().map(|p| (p - centre).norm());
            Body {
                item,
                radius_mm: far.fold(0.0, f64::max),
                bounds,
                centre,
                distance: MeshDistance::new(&mesh),
                mesh,
            }
        });
        Self {
            bodies: bodies.collect(),
            network,
        }
    }

    /// Finds a sequence of limbs that is free: as they are listed, from the root on, or another.
    /// The error is what the first one that is barred runs into.
    ///
    /// `ways` are the states between the moves of every limb.
    pub fn sequence(
        &self,
        ways: &[&[Key]],
        watch: &Watch,
    ) -> Result<Result<Vec<usize>, Hit>, Cancelled> {
        let mut state = self.network.closed();
        if let Some(hit) = self.at_rest(&state) {
            return Ok(Err(hit));
        }
        let mut left: Vec<usize> = (0..self.network.limbs.len()).collect();
        let mut sequence = Vec::new();
        while !left.is_empty() {
            let mut first_hit = None;
            let mut free = None;
            for (place, limb) in left.iter().enumerate() {
                let way = Way {
                    limb: *limb,
                    keys: ways[*limb],
                };
                match self.opens(&state, &way, watch)? {
                    None => {
                        free = Some(place);
                        break;
                    }
                    Some(hit) => first_hit = first_hit.or(Some(hit)),
                }
            }
            match (free, first_hit) {
                (Some(place), _) => {
                    let limb = left.remove(place);
                    if let Some(last) = ways[limb].last() {
                        state[limb].clone_from(last);
                    }
                    sequence.push(limb);
                }
                (None, Some(hit)) => return Ok(Err(hit)),
                (None, None) => break,
            }
        }
        Ok(Ok(sequence))
    }

    /// Returns what touches with all shells in.
    fn at_rest(&self, state: &[Key]) -> Option<Hit> {
        let frames = self.network.frames(state);
        let pairs = self.pairs(|_| true, |_| true);
        let near = pairs
            .into_par_iter()
            .find_first(|pair| pair[0] < pair[1] && self.is_near(*pair, &frames, TOUCH_MM));
        near.map(|pair| {
            let items = pair.map(|body| self.bodies[body].item);
            let limbs = items.map(|item| self.mover(item));
            Hit {
                limb: limbs[1].or(limbs[0]).unwrap_or_default(),
                items,
            }
        })
    }

    /// Returns the limb that carries a body; `None` for the first juncture.
    fn mover(&self, item: Item) -> Option<usize> {
        match item {
            Item::Shell { limb, .. } => Some(limb),
            Item::Juncture(index) => self.network.limbs.iter().position(|limb| limb.to == index),
        }
    }

    /// Returns what a limb runs into if it goes its way in a state.
    fn opens(&self, state: &[Key], way: &Way, watch: &Watch) -> Result<Option<Hit>, Cancelled> {
        let limb = way.limb;
        for pair in way.keys.windows(2) {
            let step = Step {
                bodies: self,
                state,
                limb,
                ends: [&pair[0], &pair[1]],
            };
            if let Some(items) = step.hit(watch)? {
                return Ok(Some(Hit { limb, items }));
            }
        }
        Ok(None)
    }

    /// Returns the pairs of bodies of which one moves and the other does not, and that are not
    /// fixed to each other or proved free.
    fn pairs(
        &self,
        is_moved: impl Fn(Item) -> bool,
        is_still: impl Fn(Item) -> bool,
    ) -> Vec<[usize; 2]> {
        let count = 0..self.bodies.len();
        let pairs = count
            .clone()
            .flat_map(|a| count.clone().map(move |b| [a, b]));
        let is_pair = |[a, b]: &[usize; 2]| {
            let items = [self.bodies[*a].item, self.bodies[*b].item];
            a != b && is_moved(items[0]) && is_still(items[1]) && !self.is_one(items)
        };
        pairs.filter(is_pair).collect()
    }

    /// Returns true for shells of one limb, and for what is glued together.
    fn is_one(&self, items: [Item; 2]) -> bool {
        match items {
            [Item::Shell { limb: a, .. }, Item::Shell { limb: b, .. }] => a == b,
            [Item::Shell { limb, shell }, Item::Juncture(index)]
            | [Item::Juncture(index), Item::Shell { limb, shell }] => {
                let own = &self.network.limbs[limb];
                let last = own.telescope.shells.len() - 1;
                (own.from == index && shell == 0) || (own.to == index && shell == last)
            }
            _ => false,
        }
    }

    fn is_near(&self, [a, b]: [usize; 2], frames: &NetworkFrames, limit_mm: f64) -> bool {
        let (moving, still) = (&self.bodies[a], &self.bodies[b]);
        let [own, other] = [moving, still].map(|body| frame_of(body.item, frames));
        let apart = (own.to_model(&moving.centre) - other.to_model(&still.centre)).norm();
        if apart - moving.radius_mm - still.radius_mm > limit_mm {
            return false;
        }
        let placed = other.inverse().frame_to_model(&own);
        let bounds = still.bounds.inflated(limit_mm);
        let are_apart = |placed: &Frame, own: &Aabb, other: &Aabb| {
            let placed = placed_box(own, placed);
            (0..3).any(|i| placed.max[i] < other.min[i] || placed.min[i] > other.max[i])
        };
        if are_apart(&placed, &moving.bounds, &bounds)
            || are_apart(&placed.inverse(), &bounds, &moving.bounds)
        {
            return false;
        }
        let mesh = moving.mesh.map_vertices(|p| placed.to_model(p));
        let mouth = self.mouth([moving.item, still.item], frames, &other);
        let mut near = mesh.iter_corners().filter(|corners| {
            let is_out =
                mouth.is_none_or(|mouth| corners.iter().any(|p| mouth.to_local(p).x > -limit_mm));
            is_out
                && (0..3).all(|axis| {
                    let values = corners.map(|p| p[axis]);
                    values.iter().any(|value| *value >= bounds.min[axis])
                        && values.iter().any(|value| *value <= bounds.max[axis])
                })
        });
        near.any(|corners| still.distance.bvh().is_triangle_within(&corners, limit_mm))
    }

    /// Returns the mouth of the root out of which a shell comes, in the frame of the juncture that
    /// holds it. What is behind the mouth is within the root.
    fn mouth(&self, items: [Item; 2], frames: &NetworkFrames, other: &Frame) -> Option<Frame> {
        let [Item::Shell { limb, .. }, Item::Juncture(index)] = items else {
            return None;
        };
        let own = &self.network.limbs[limb];
        if own.from != index {
            return None;
        }
        let root = &own.telescope.shells[0].helix;
        let mouth = root.frame_at(own.telescope.ends_mm()[1]);
        let placed = frames.shells[limb][0].frame_to_model(&mouth);
        Some(other.inverse().frame_to_model(&placed))
    }
}

/// Returns the box around a box that is placed.
fn placed_box(bounds: &Aabb, placed: &Frame) -> Aabb {
    let corner = |index: usize| {
        let pick = |axis: usize| [bounds.min, bounds.max][index >> axis & 1][axis];
        placed.to_model(&Point::new(pick(0), pick(1), pick(2)))
    };
    (0..8).fold(Aabb::EMPTY, |aabb, index| aabb.grown_over(&corner(index)))
}

fn frame_of(item: Item, frames: &NetworkFrames) -> Frame {
    match item {
        Item::Shell { limb, shell } => frames.shells[limb][shell],
        Item::Juncture(index) => frames.junctures[index],
    }
}

/// A move of a limb while all others are at rest.
struct Step<'a> {
    bodies: &'a Bodies<'a>,
    state: &'a [Key],
    limb: usize,
    ends: [&'a [JointState]; 2],
}

impl Step<'_> {
    /// Returns the two bodies that come too near; `None` if none do.
    fn hit(&self, watch: &Watch) -> Result<Option<[Item; 2]>, Cancelled> {
        let Some(first) = self.first_joint() else {
            return Ok(None);
        };
        let carried = self.bodies.network.carried_by(self.limb);
        let moves = |item: Item| match item {
            Item::Shell { limb, shell } if limb == self.limb => shell > first,
            Item::Shell { limb, .. } => carried[self.bodies.network.limbs[limb].from],
            Item::Juncture(index) => carried[index],
        };
        let pairs = self.bodies.pairs(moves, |item| !moves(item));
        let steps = self.steps(moves);
        if steps > MAX_STEPS {
            // So long a way is not proved free, and none is.
            return Ok(pairs
                .first()
                .map(|pair| pair.map(|body| self.bodies.bodies[body].item)));
        }
        for i in 0..=steps {
            watch.check()?;
            let frames = self.frames(i as f64 / steps as f64);
            let is_near = |pair: &&[usize; 2]| self.bodies.is_near(**pair, &frames, CLEAR_MM);
            if let Some(pair) = pairs.par_iter().find_first(is_near) {
                return Ok(Some(pair.map(|body| self.bodies.bodies[body].item)));
            }
        }
        Ok(None)
    }

    /// Returns the first joint that moves.
    fn first_joint(&self) -> Option<usize> {
        let [from, to] = self.ends;
        from.iter().zip(to).position(|(a, b)| a != b)
    }

    fn frames(&self, share: f64) -> NetworkFrames {
        let [from, to] = self.ends;
        let mut state = self.state.to_vec();
        state[self.limb] = between(from, to, share);
        self.bodies.network.frames(&state)
    }

    /// Returns the number of steps, of which none moves a point farther than the gap.
    fn steps(&self, moves: impl Fn(Item) -> bool) -> usize {
        let network = self.bodies.network;
        let telescope = &network.limbs[self.limb].telescope;
        let frames = [0.0, 1.0].map(|share| self.frames(share));
        let [from, to] = self.ends;
        let joints = from.iter().zip(to).enumerate();
        let ways = joints.filter(|(_, (a, b))| a != b).map(|(joint, (a, b))| {
            let helix = &telescope.shells[joint].helix;
            let reaches = frames.iter().map(|frames| {
                let outer = &frames.shells[self.limb][joint];
                let pivot = outer
                    .frame_to_model(&helix.frame_at(telescope.visible_mm))
                    .origin;
                let moved = self.bodies.bodies.iter().filter(|body| moves(body.item));
                let far = moved.map(|body| {
                    let centre = frame_of(body.item, frames).to_model(&body.centre);
                    (centre - pivot).norm() + body.radius_mm
                });
                far.fold(0.0, f64::max)
            });
            let slide_mm = (b.slide_mm - a.slide_mm).abs();
            let reach_mm = reaches.fold(0.0, f64::max) + slide_mm;
            let inner = &telescope.shells[joint + 1].helix;
            let bend = inner.curvature.hypot(inner.torsion);
            slide_mm * (1.0 + bend * reach_mm) + (b.turn_rad - a.turn_rad).abs() * reach_mm
        });
        let way_mm: f64 = ways.sum();
        ((way_mm / (STEP_SHARE * CLEAR_MM)).ceil() as usize).max(1)
    }
}
