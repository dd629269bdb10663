//! A scene as it was read, and where its nodes are at a time.

use nalgebra::UnitQuaternion;

use crate::geom::{Frame, Point};
use crate::mesh::TriMesh;

/// A scene as it was read. The one root stands for the unit and the direction up; all is told in
/// its frame, mm.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadScene {
    /// The scale of the root: 0.001 if its nodes are in mm.
    pub scale: f64,
    /// The place of the root, without its scale, in metres.
    pub root: Frame,
    /// The nodes but the root; each after its parent.
    pub nodes: Vec<ReadNode>,
    /// The animations.
    pub animations: Vec<ReadAnimation>,
}

/// A node.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadNode {
    /// Its name.
    pub name: String,
    /// The index of the node that carries it.
    pub parent: Option<usize>,
    /// Its place in its parent's frame.
    pub place: Frame,
    /// Its body, in its own frame.
    pub mesh: Option<TriMesh>,
}

/// An animation.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadAnimation {
    /// Its name.
    pub name: String,
    /// The motions of single nodes.
    pub tracks: Vec<ReadTrack>,
}

/// The motion of a node.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadTrack {
    /// The index of the node.
    pub node: usize,
    /// The times, s.
    pub times_s: Vec<f64>,
    /// The values at these times.
    pub values: Values,
}

/// The values of a track.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Places of the node's origin.
    Places(Vec<Point>),
    /// Turns of the node.
    Turns(Vec<UnitQuaternion<f64>>),
}

impl ReadScene {
    /// Returns the places of all nodes in the root's frame at a time of an animation, s.
    ///
    /// It is as the format has it: linear between keys, along the great arc for turns.
    pub fn places(&self, animation: &ReadAnimation, time_s: f64) -> Vec<Frame> {
        let mut own: Vec<Frame> = self.nodes.iter().map(|node| node.place).collect();
        for track in &animation.tracks {
            let after = track.times_s.partition_point(|time| *time <= time_s);
            let last = track.times_s.len() - 1;
            let [from, to] = [after.saturating_sub(1), after.min(last)];
            let [start, end] = [from, to].map(|at| track.times_s[at]);
            let share = if end > start {
                ((time_s - start) / (end - start)).clamp(0.0, 1.0)
            } else {
                0.0
            };
            let place = &mut own[track.node];
            match &track.values {
                Values::Places(all) => place.origin = all[from] + (all[to] - all[from]) * share,
                Values::Turns(all) => {
                    let turn = all[from].try_slerp(&all[to], share, 1e-9);
                    let turn = turn.unwrap_or(all[from]);
                    place.axes = turn.to_rotation_matrix().into_inner();
                }
            }
        }
        let mut places: Vec<Frame> = Vec::with_capacity(own.len());
        for (node, own) in self.nodes.iter().zip(&own) {
            let placed = match node.parent {
                Some(parent) => places[parent].frame_to_model(own),
                None => *own,
            };
            places.push(placed);
        }
        places
    }
}
