//! The base of a large object as plain data: polyhedra, planes between them, connections.

use super::connection::{Connection, ConnectorRequest, Joint, Pair};
use super::ground::Ground;
use super::polyhedron::{Face, Polyhedron, lowest};
use super::unjoined::Unjoined;
use crate::geom::{Plane, Vector};

/// One side of a split.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Child {
    /// Another split, as an index.
    Split(usize),
    /// A polyhedron, as an index.
    Polyhedron(usize),
}

/// A plane that parts polyhedra.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Split {
    /// The plane, in the middle of the gap.
    pub plane: Plane,
    /// The side below it.
    pub below: Child,
    /// The side above it.
    pub above: Child,
}

/// The base of a large object: polyhedra, the planes between them, and their connections.
#[derive(Debug, Clone, PartialEq)]
pub struct BasePlan {
    /// The polyhedra.
    pub polyhedra: Vec<Polyhedron>,
    /// The planes between them, a tree whose root is the first; empty for one polyhedron.
    pub splits: Vec<Split>,
    /// The connections across the planes.
    pub connections: Vec<Connection>,
}

/// Connects the polyhedra across every plane.
pub(super) fn connected(
    ground: &Ground,
    polyhedra: Vec<Polyhedron>,
    splits: Vec<Split>,
    connector: &ConnectorRequest,
) -> BasePlan {
    let mut connections = Vec::new();
    for split in &splits {
        let [below, above] = [split.below, split.above].map(|side| leaves_of(&splits, side));
        let pairs = below
            .iter()
            .flat_map(|&i| above.iter().map(move |&j| [i, j]));
        let found = pairs.filter_map(|indices| {
            let pair = Pair {
                ground,
                indices,
                polyhedra: indices.map(|at| &polyhedra[at]),
                plane: split.plane,
            };
            pair.connect(connector)
        });
        let free = found.filter(|connection| is_free(connection, &polyhedra, &splits));
        let (bolted, rods): (Vec<Connection>, Vec<Connection>) =
            free.partition(|connection| connection.joint == Joint::Bolted);
        // Rods only where no panels bear on each other across the plane: those of the widest way.
        let widest = rods
            .into_iter()
            .reduce(|a, b| match b.radius_mm > a.radius_mm {
                true => b,
                false => a,
            });
        let has_bolts = !bolted.is_empty();
        connections.extend(bolted);
        connections.extend(widest.filter(|_| !has_bolts));
    }
    BasePlan {
        polyhedra,
        splits,
        connections,
    }
}

/// Returns true if a connection passes no other polyhedron, and rods no other plane than the one
/// that they cross.
fn is_free(connection: &Connection, polyhedra: &[Polyhedron], splits: &[Split]) -> bool {
    let own = connection.polyhedra;
    let others = polyhedra.iter().enumerate();
    let mut others = others.filter(|(at, _)| !own.contains(at));
    if others.any(|(_, other)| connection.is_barred_by(other)) {
        return false;
    }
    let [from, to] = connection.ends;
    let mut crossed = splits.iter().filter(|split| {
        let [a, b] = [from, to].map(|end| split.plane.distance(&end));
        let sine = split.plane.normal.cross(&(to - from)).norm() / (to - from).norm();
        a * b <= 0.0 || a.abs().min(b.abs()) < connection.radius_mm * sine
    });
    connection.joint == Joint::Bolted || (crossed.next().is_some() && crossed.next().is_none())
}

/// Returns the polyhedra of one side of a split.
fn leaves_of(splits: &[Split], side: Child) -> Vec<usize> {
    match side {
        Child::Polyhedron(index) => vec![index],
        Child::Split(index) => {
            let split = &splits[index];
            [split.below, split.above]
                .map(|side| leaves_of(splits, side))
                .concat()
        }
    }
}

impl BasePlan {
    /// Returns the base of one polyhedron.
    pub fn one(polyhedron: Polyhedron) -> Self {
        Self {
            polyhedra: vec![polyhedron],
            splits: Vec::new(),
            connections: Vec::new(),
        }
    }

    /// Returns the planes of the splits that bound a polyhedron's part of the model; their normals
    /// point out of it. Empty for one polyhedron.
    pub fn sides(&self, polyhedron: usize) -> Vec<Plane> {
        let beside = self.splits.iter().enumerate().filter_map(|(at, split)| {
            let [below, above] = self.polyhedra_beside(at);
            if below.contains(&polyhedron) {
                Some(split.plane)
            } else {
                above.contains(&polyhedron).then(|| split.plane.flipped())
            }
        });
        beside.collect()
    }

    /// Returns the number of faces of all polyhedra before one. Counted on from there, its faces
    /// have indices of their own in the whole base.
    pub fn faces_before(&self, polyhedron: usize) -> usize {
        let before = self.polyhedra.iter().take(polyhedron);
        before.map(|one| one.faces().len()).sum()
    }

    /// Returns a face by its index in the whole base.
    pub fn face(&self, index: usize) -> Option<&Face> {
        self.polyhedra.iter().flat_map(Polyhedron::faces).nth(index)
    }

    /// Returns the index in the whole base of the face that looks down most along a direction.
    /// Faces on planes between polyhedra do not count.
    pub fn bottom_face(&self, up: &Vector) -> Option<usize> {
        let faces = self.polyhedra.iter().flat_map(Polyhedron::faces);
        lowest(faces.enumerate().filter(|(_, face)| !face.is_locked), up)
    }

    /// Returns the volume of all polyhedra, mm³.
    pub fn volume_mm3(&self) -> f64 {
        self.polyhedra.iter().map(Polyhedron::volume_mm3).sum()
    }

    /// Returns the polyhedra on each side of a split, the ones below it first.
    pub fn polyhedra_beside(&self, split: usize) -> [Vec<usize>; 2] {
        let Split { below, above, .. } = self.splits[split];
        [below, above].map(|side| leaves_of(&self.splits, side))
    }

    /// Returns two polyhedra across a plane of which connections join only one to the first
    /// polyhedron; `None` if all are joined. Of several such pairs it is the one whose faces share
    /// the largest disc.
    pub fn unjoined(&self, ground: &Ground, connector: &ConnectorRequest) -> Option<Unjoined> {
        let joined = self.joined_to_first();
        let pairs = self.splits.iter().enumerate().flat_map(|(at, split)| {
            let [below, above] = self.polyhedra_beside(at);
            let pairs = below
                .into_iter()
                .flat_map(move |i| above.clone().into_iter().map(move |j| [i, j]));
            pairs.map(move |indices| (split.plane, indices))
        });
        let apart = pairs.filter(|(_, [i, j])| joined[*i] != joined[*j]);
        let apart = apart.map(|(plane, indices)| {
            let pair = Pair {
                ground,
                indices,
                polyhedra: indices.map(|at| &self.polyhedra[at]),
                plane,
            };
            pair.unjoined(connector)
        });
        apart.reduce(|a, b| if b.disc_mm > a.disc_mm { b } else { a })
    }

    /// Returns, for each polyhedron, whether connections join it to the first.
    fn joined_to_first(&self) -> Vec<bool> {
        let mut joined = vec![false; self.polyhedra.len()];
        let mut waiting = vec![0];
        while let Some(here) = waiting.pop() {
            let is_new = joined
                .get_mut(here)
                .is_some_and(|seen| !std::mem::replace(seen, true));
            if is_new {
                let connections = self.connections.iter();
                let ends = connections.map(|connection| connection.polyhedra);
                waiting.extend(ends.filter(|ends| ends.contains(&here)).flatten());
            }
        }
        joined
    }

    /// Returns the least distance from a split to the corners of the polyhedra beside it, mm;
    /// positive if its plane parts them.
    pub fn parted_by_mm(&self, split: usize) -> f64 {
        let plane = self.splits[split].plane;
        let sides = self.polyhedra_beside(split);
        let distances = sides.iter().zip([-1.0, 1.0]).flat_map(|(side, sign)| {
            let corners = side.iter().flat_map(|&at| self.polyhedra[at].corners());
            corners.map(move |p| sign * plane.distance(p))
        });
        distances.fold(f64::INFINITY, f64::min)
    }

    /// Returns the least of [`Self::parted_by_mm`] over all splits, mm; infinite for one
    /// polyhedron. Positive if all pairs are parted.
    pub fn parted_mm(&self) -> f64 {
        let all = (0..self.splits.len()).map(|split| self.parted_by_mm(split));
        all.fold(f64::INFINITY, f64::min)
    }
}
