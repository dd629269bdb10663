//! Marks the branches of which no shells can be made.

use std::fmt;

use rayon::prelude::*;

use super::tree::{Branch, Skeleton, StaysSolid};
use crate::geom::{Bvh, Point, Vector, orthonormal_basis};
use crate::mesh::Solid;

/// Rays across a branch by which its section is measured.
const RAYS: usize = 16;
/// Radius of a section over that of its ball from which it is flat. A tube has 1, a rectangle of
/// 1:2 has 1.6, one of 1:4 has 2.3. A tube in the latter would leave most of the limb.
const FLAT_RATIO: f64 = 2.0;
/// The least length of a tube, in radii: two shells, each visible for one radius at least, which is
/// what overlaps too.
const LEAST_LENGTH_RADII: f64 = 2.0;

/// The sizes of shells that decide if a branch can carry two.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShellSizes {
    /// The radius of the thinnest shell, mm.
    pub least_radius_mm: f64,
    /// The difference of radius between two shells, mm: wall, engagement and clearances.
    pub pitch_mm: f64,
}

impl ShellSizes {
    /// Returns the least radius that holds two shells, mm.
    pub fn two_shells_mm(&self) -> f64 {
        self.least_radius_mm + self.pitch_mm
    }
}

impl fmt::Display for StaysSolid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Thin => "too thin for two shells",
            Self::Short => "too short for two shells",
            Self::Plate => "flat, no tube",
            Self::Ordered => "as ordered",
        })
    }
}

impl Skeleton {
    /// Marks the branches that carry fewer than two shells, or are flat; others become free.
    ///
    /// A branch that the user ordered solid stays so.
    pub fn mark_solid(&mut self, solid: &Solid, sizes: &ShellSizes) {
        let degrees = self.degrees();
        let marks: Vec<Option<StaysSolid>> = self
            .branches
            .par_iter()
            .map(|branch| match branch.solid {
                Some(StaysSolid::Ordered) => branch.solid,
                _ => self.reason(&self.free_nodes(branch, &degrees), solid.bvh(), sizes),
            })
            .collect();
        for (branch, mark) in self.branches.iter_mut().zip(marks) {
            branch.solid = mark;
        }
    }

    /// Returns the reason that these nodes of a branch carry no two shells.
    fn reason(&self, free: &[usize], surface: &Bvh, sizes: &ShellSizes) -> Option<StaysSolid> {
        let radius = |node: &usize| self.nodes[*node].radius_mm;
        let widest_mm = free.iter().map(radius).fold(0.0, f64::max);
        if free.len() > 1 && widest_mm < sizes.two_shells_mm() {
            return Some(StaysSolid::Thin);
        }
        if self.is_short(free) {
            return Some(StaysSolid::Short);
        }
        let tube = self.longest_tube(free, surface);
        self.is_short(tube).then_some(StaysSolid::Plate)
    }

    /// Returns the nodes of a branch outside the balls of its junctures, in their order.
    fn free_nodes(&self, branch: &Branch, degrees: &[usize]) -> Vec<usize> {
        let ends = [branch.nodes[0], branch.nodes[branch.nodes.len() - 1]];
        let is_free = |node: &usize| {
            let at = self.nodes[*node].at;
            let mut balls = ends.iter().filter(|end| degrees[**end] > 2);
            balls.all(|end| (at - self.nodes[*end].at).norm() >= self.nodes[*end].radius_mm)
        };
        branch.nodes.iter().copied().filter(is_free).collect()
    }

    /// Returns true if a run of nodes is too short for two shells.
    fn is_short(&self, run: &[usize]) -> bool {
        let radii = sorted(run.iter().map(|node| self.nodes[*node].radius_mm));
        let middle_mm = radii.get(radii.len() / 2).copied().unwrap_or_default();
        run.len() < 2 || self.run_length_mm(run) < LEAST_LENGTH_RADII * middle_mm
    }

    /// Returns the longest run of nodes at which the section is about as wide as the ball.
    fn longest_tube<'a>(&self, run: &'a [usize], surface: &Bvh) -> &'a [usize] {
        let is_tube = |at: usize| {
            let [before, after] = [run[at.saturating_sub(1)], run[(at + 1).min(run.len() - 1)]];
            let here = &self.nodes[run[at]];
            let along = self.nodes[after].at - self.nodes[before].at;
            section_radius_mm(surface, &here.at, &along) <= FLAT_RATIO * here.radius_mm
        };
        let tubes: Vec<(usize, bool)> = (0..run.len()).map(|at| (at, is_tube(at))).collect();
        let runs = tubes.chunk_by(|a, b| a.1 == b.1).filter(|piece| piece[0].1);
        let longest = runs.max_by_key(|piece| piece.len());
        longest.map_or(&[], |piece| &run[piece[0].0..=piece[piece.len() - 1].0])
    }
}

fn sorted(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values
}

/// Returns the radius of the circle with the area of the section across a direction, mm, seen from
/// a point of it.
fn section_radius_mm(surface: &Bvh, at: &Point, along: &Vector) -> f64 {
    let Some(along) = along.try_normalize(0.0) else {
        return 0.0;
    };
    let reach_mm = surface.aabb().size().norm();
    let (u, v) = orthonormal_basis(&along);
    let square = |ray: usize| {
        let (sin, cos) = (std::f64::consts::TAU * ray as f64 / RAYS as f64).sin_cos();
        let end = at + (u * cos + v * sin) * reach_mm;
        let share = surface.first_crossing(at, &end).unwrap_or_default();
        (share * reach_mm).powi(2)
    };
    let squares: f64 = (0..RAYS).map(square).sum();
    (squares / RAYS as f64).sqrt()
}
