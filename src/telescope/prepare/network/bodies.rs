//! The solids of junctures: balls along what stays solid, hulls, or pieces of the model.
//!
//! They are bored for the roots of their telescopes. A peg fits the mouth that carries them.

use std::collections::BTreeSet;

use super::ends::{last, on_root};
use super::foot::Foot;
use super::tree::Tree;
use crate::geom::{Frame, Plane, Point, Vector};
use crate::mesh::primitives::ball;
use crate::mesh::{ClipError, Csg, Solid, TriMesh};
use crate::telescope::nest::Telescope;

/// Subdivisions of balls: facets of the largest are a tenth of a mm off.
const BALL_LEVEL: u32 = 4;
/// Points on a ring of a hull.
const RING_POINTS: usize = 48;
/// Walls around the root of a telescope.
const COLLAR_WALLS: f64 = 2.0;
/// Length of a root that its collar holds, in its radii; and what the cap takes.
const HELD_RADII: f64 = 0.6;
/// Length ahead of a root's mouth that is bored for what comes out of it, in its radii.
pub const CLEAR_RADII: f64 = 2.0;
/// The same in a piece of the model, mm: it ends at the mouth.
const CLEAR_IN_MODEL_MM: f64 = 1.0;
/// Least radius of a ball, in walls: thinner ends snap.
const LEAST_BALL_WALLS: f64 = 1.5;

/// A ball: its centre, and its radius in mm.
#[derive(Debug, Clone, Copy)]
struct Ball {
    centre: Point,
    radius_mm: f64,
}

/// Returns the solid of a juncture where it lies when all is out: balls, or a hull, on its foot if
/// it has one.
pub fn body(
    tree: &Tree,
    juncture: usize,
    is_hull: bool,
    foot: Option<&Foot>,
) -> Result<Solid, ClipError> {
    let shape = Shape { tree, juncture };
    let mut whole = joined(&shape.links())?;
    if !shape.outgoing().is_empty() {
        let holder = match is_hull {
            false => joined(&shape.collars())?,
            true => Csg::convex_hull(&shape.hull())?,
        };
        whole = whole.union(&holder)?;
    }
    if let Some(foot) = foot {
        whole = whole.union(&foot.body()?)?;
    }
    let whole = shape.bored(whole, |root_mm| CLEAR_RADII * root_mm)?;
    let Some(parent) = shape.incoming() else {
        return largest(&whole)?.to_solid();
    };
    let (_, mouth) = last(parent);
    let along: Vector = mouth.axes.column(0).into();
    let (ahead, _) = whole.split_by_plane(&Plane::through(&mouth.origin, &along))?;
    largest(&pegged(&ahead, parent)?)?.to_solid()
}

/// Returns the solid of a juncture that is a piece of the model.
pub fn body_of_model(tree: &Tree, juncture: usize, piece: &TriMesh) -> Result<Solid, ClipError> {
    let shape = Shape { tree, juncture };
    // Ahead of the mouth nothing of the piece is in the way, or the limb does not open.
    let whole = shape.bored(Csg::of_mesh(piece)?, |_| CLEAR_IN_MODEL_MM)?;
    let whole = match shape.incoming() {
        Some(parent) => pegged(&whole, parent)?,
        None => whole,
    };
    largest(&whole)?.to_solid()
}

/// Returns a body with the peg that fits the last mouth of a telescope.
fn pegged(body: &Csg, parent: &Telescope) -> Result<Csg, ClipError> {
    let (frame, _) = last(parent);
    let peg = parent.peg()?.to_mesh()?;
    body.union(&Csg::of_mesh(&peg.map_vertices(|p| frame.to_model(p)))?)
}

/// Returns the greatest piece: what a cut leaves elsewhere is none of the juncture.
fn largest(whole: &Csg) -> Result<Csg, ClipError> {
    let mut best: Option<(f64, Csg)> = None;
    for piece in whole.decompose()? {
        let volume = piece.to_mesh()?.signed_volume_mm3();
        if best.as_ref().is_none_or(|(most, _)| volume > *most) {
            best = Some((volume, piece));
        }
    }
    Ok(best.map_or_else(|| whole.clone(), |(_, piece)| piece))
}

/// The shape of a juncture.
struct Shape<'a> {
    tree: &'a Tree<'a>,
    juncture: usize,
}

impl Shape<'_> {
    /// Returns a body without the sockets of the roots. `clear_mm` tells from a root's radius how
    /// far ahead of its mouth the body is cleared.
    fn bored(&self, mut body: Csg, clear_mm: impl Fn(f64) -> f64) -> Result<Csg, ClipError> {
        for limb in self.outgoing() {
            let telescope = &self.tree.network.limbs[limb].telescope;
            let start = telescope.start;
            let socket = telescope.socket(clear_mm(telescope.shells[0].body_mm))?;
            let socket = socket.to_mesh()?.map_vertices(|p| start.to_model(p));
            body = body.subtract(&Csg::of_mesh(&socket)?)?;
        }
        Ok(body)
    }

    fn outgoing(&self) -> Vec<usize> {
        let limbs = self.tree.network.limbs.iter().enumerate();
        let own = limbs.filter(|(_, limb)| limb.from == self.juncture);
        own.map(|(index, _)| index).collect()
    }

    fn incoming(&self) -> Option<&Telescope> {
        let mut limbs = self.tree.network.limbs.iter();
        let own = limbs.find(|limb| limb.to == self.juncture);
        own.map(|limb| &limb.telescope)
    }

    fn node(&self, node: usize) -> Ball {
        let least_mm = LEAST_BALL_WALLS * self.tree.wall_mm;
        let node = &self.tree.skeleton.nodes[node];
        Ball {
            centre: node.at,
            radius_mm: node.radius_mm.max(least_mm),
        }
    }

    /// Returns the balls of the juncture's nodes, joined along what stays solid, and what is beyond
    /// the mouth that carries it.
    fn links(&self) -> Vec<[Ball; 2]> {
        let own: BTreeSet<usize> = self.tree.nodes[self.juncture].iter().copied().collect();
        let links = self.tree.skeleton.links();
        let links = links.filter(|link| link.iter().all(|node| own.contains(node)));
        let mut pairs: Vec<[Ball; 2]> = links.map(|link| link.map(|n| self.node(n))).collect();
        let alone = own.iter().map(|node| [self.node(*node); 2]);
        pairs.extend(alone);
        if let Some(parent) = self.incoming() {
            let (_, mouth) = last(parent);
            let radius_mm = parent.shells[parent.shells.len() - 1].body_mm;
            let first = Ball {
                centre: mouth.origin,
                radius_mm,
            };
            let beyond = self.tree.beyond[self.juncture].iter();
            let beyond: Vec<Ball> = beyond.map(|node| self.node(*node)).collect();
            let run: Vec<Ball> = [first].into_iter().chain(beyond).collect();
            pairs.extend(run.windows(2).map(|pair| [pair[0], pair[1]]));
            pairs.push([first; 2]);
        }
        pairs
    }

    /// Returns the collars: what holds the roots of the telescopes.
    fn collars(&self) -> Vec<[Ball; 2]> {
        let mut pairs = Vec::new();
        for limb in self.outgoing() {
            let collar = self.collar(limb);
            let before = self.tree.before[limb].iter().map(|node| self.node(*node));
            let run: Vec<Ball> = before.chain([collar]).collect();
            pairs.extend(run.windows(2).map(|pair| [pair[0], pair[1]]));
            pairs.push([collar; 2]);
        }
        pairs
    }

    /// Returns the ball of a collar, on the axis of the root.
    fn collar(&self, limb: usize) -> Ball {
        let telescope = &self.tree.network.limbs[limb].telescope;
        let body_mm = telescope.shells[0].body_mm;
        let held_mm = HELD_RADII * body_mm + telescope.sizes.flange_mm;
        let [tail_mm, _] = telescope.ends_mm();
        Ball {
            centre: on_root(telescope, tail_mm + held_mm).origin,
            radius_mm: body_mm + telescope.sizes.glue_mm + COLLAR_WALLS * self.tree.wall_mm,
        }
    }

    /// Returns the points whose hull covers the ends that meet.
    fn hull(&self) -> Vec<Point> {
        let mut points = Vec::new();
        for limb in self.outgoing() {
            let telescope = &self.tree.network.limbs[limb].telescope;
            let collar = self.collar(limb);
            let [tail_mm, _] = telescope.ends_mm();
            let held_mm = HELD_RADII * telescope.shells[0].body_mm + telescope.sizes.flange_mm;
            let behind_mm = tail_mm - COLLAR_WALLS * self.tree.wall_mm - 1.0;
            for arc_mm in [behind_mm, tail_mm + held_mm] {
                points.extend(ring(&on_root(telescope, arc_mm), collar.radius_mm));
            }
        }
        if let Some(parent) = self.incoming() {
            let radius_mm = parent.shells[parent.shells.len() - 1].body_mm;
            points.extend(ring(&last(parent).1, radius_mm));
        }
        points
    }
}

/// Returns points of a circle about the first axis of a frame.
pub fn ring(frame: &Frame, radius_mm: f64) -> Vec<Point> {
    let at = |i: usize| {
        let (sin, cos) = (std::f64::consts::TAU * i as f64 / RING_POINTS as f64).sin_cos();
        frame.to_model(&Point::new(0.0, radius_mm * cos, radius_mm * sin))
    };
    (0..RING_POINTS).map(at).collect()
}

/// Returns the union of the hulls of pairs of balls.
fn joined(pairs: &[[Ball; 2]]) -> Result<Csg, ClipError> {
    let hull = |pair: &[Ball; 2]| {
        let meshes = pair.map(|one| ball(&one.centre, one.radius_mm, BALL_LEVEL));
        let points = meshes.iter().flat_map(|mesh| mesh.vertices()).copied();
        Csg::convex_hull(&points.collect::<Vec<Point>>())
    };
    let Some((first, others)) = pairs.split_first() else {
        return Csg::convex_hull(&[]);
    };
    let mut whole = hull(first)?;
    for pair in others {
        whole = whole.union(&hull(pair)?)?;
    }
    Ok(whole)
}
