//! The unknowns of a chain as a list of numbers, with their bounds.

use std::f64::consts::{PI, TAU};

use super::request::{FitRequest, Freedom};
use crate::curve::chain::Chain;
use crate::geom::{Frame, Point, Vector};

/// Number of unknowns of the pose: a turn and a shift.
pub(super) const POSE: usize = 6;

/// Greatest factor by which a piece may become longer or shorter than at the start.
const LENGTH_FACTOR: f64 = 2.0;

/// The greatest turn of the pose in one step, rad.
const MAX_POSE_STEP_RAD: f64 = 0.5;

/// Which numbers of a chain are unknown, and where each stands in the list: the pose, the length of
/// a piece, curvatures, torsions, turns.
#[derive(Debug, Clone)]
pub(super) struct Unknowns {
    pieces: usize,
    curvature: Freedom,
    torsion: Freedom,
    /// The place in the list of the turn before each piece but the first.
    turns: Vec<Option<usize>>,
    count: usize,
    /// The bounds of every unknown after the pose.
    bounds: Vec<[f64; 2]>,
    /// The point about which the pose turns.
    centre: Point,
}

impl Unknowns {
    /// Lays out the unknowns for a request: all turns are free.
    pub fn of(request: &FitRequest, start: &Chain) -> Self {
        let free = Self {
            pieces: request.pieces,
            curvature: request.curvature,
            torsion: request.torsion,
            turns: Vec::new(),
            count: 0,
            bounds: Vec::new(),
            centre: start.start.origin,
        };
        let length = [
            start.piece_mm / LENGTH_FACTOR,
            start.piece_mm * LENGTH_FACTOR,
        ];
        let curvatures = vec![[0.0, request.max_curvature]; free.values(request.curvature)];
        let limit = request.max_torsion;
        let torsions = vec![[-limit, limit]; free.values(request.torsion)];
        let bounds = [vec![length], curvatures, torsions].concat();
        let joints = request.pieces.saturating_sub(1);
        Self { bounds, ..free }.with_turns(&vec![true; joints])
    }

    /// Returns the layout with only some of the turns.
    fn with_turns(mut self, are_free: &[bool]) -> Self {
        self.bounds
            .truncate(1 + self.values(self.curvature) + self.values(self.torsion));
        let mut next = POSE + self.bounds.len();
        self.turns = are_free
            .iter()
            .map(|is_free| {
                let place = is_free.then_some(next);
                next += usize::from(*is_free);
                place
            })
            .collect();
        self.count = next;
        self.bounds
            .resize(next - POSE, [f64::NEG_INFINITY, f64::INFINITY]);
        self
    }

    /// Returns the layout without the turns below a limit.
    pub fn without_small_turns(&self, chain: &Chain, limit_rad: f64) -> Self {
        let are_free: Vec<bool> = chain
            .turns_rad
            .iter()
            .map(|turn| turn.abs() >= limit_rad)
            .collect();
        self.clone().with_turns(&are_free)
    }

    /// Returns the chain with the turns at zero that are not unknown.
    pub fn cleared(&self, chain: &Chain) -> Chain {
        let mut cleared = chain.clone();
        for (turn, place) in cleared.turns_rad.iter_mut().zip(&self.turns) {
            *turn = if place.is_some() { *turn } else { 0.0 };
        }
        cleared
    }

    /// Returns the number of unknowns.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Returns the place of the length of a piece.
    pub fn length(&self) -> usize {
        POSE
    }

    /// Returns the place of a piece's curvature; `None` if it is fixed.
    pub fn curvature(&self, piece: usize) -> Option<usize> {
        place(self.curvature, POSE + 1, piece)
    }

    /// Returns the place of a piece's torsion; `None` if it is fixed.
    pub fn torsion(&self, piece: usize) -> Option<usize> {
        let first = POSE + 1 + self.values(self.curvature);
        place(self.torsion, first, piece)
    }

    /// Returns the place of the turn before a piece; `None` if it is fixed.
    pub fn turn(&self, piece: usize) -> Option<usize> {
        let joint = piece.checked_sub(1)?;
        self.turns.get(joint).copied().flatten()
    }

    /// Returns the point about which the pose turns.
    pub fn centre(&self) -> Point {
        self.centre
    }

    /// Returns true if an unknown is at a bound and a fall of the cost pushes it out.
    pub fn is_blocked(&self, chain: &Chain, unknown: usize, gradient: f64) -> bool {
        let Some([low, high]) = unknown.checked_sub(POSE).and_then(|i| self.bounds.get(i)) else {
            return false;
        };
        let value = self.value(chain, unknown);
        (value <= *low && gradient > 0.0) || (value >= *high && gradient < 0.0)
    }

    /// Returns the chain after a step of every unknown, kept within the bounds.
    pub fn step(&self, chain: &Chain, step: &[f64]) -> Chain {
        let turn = Vector::new(step[0], step[1], step[2]);
        let shift = Vector::new(step[3], step[4], step[5]);
        let mut moved = chain.moved(&self.pose_step(&turn, &shift));
        let next = |place: usize, value: f64| {
            let [low, high] = self.bounds[place - POSE];
            (value + step[place]).clamp(low, high)
        };
        moved.piece_mm = next(self.length(), chain.piece_mm);
        for (i, piece) in moved.pieces.iter_mut().enumerate() {
            if let Some(place) = self.curvature(i) {
                piece.curvature = next(place, piece.curvature);
            }
            if let Some(place) = self.torsion(i) {
                piece.torsion = next(place, piece.torsion);
            }
        }
        for (turn, place) in moved.turns_rad.iter_mut().zip(&self.turns) {
            *turn = place.map_or(*turn, |place| next(place, *turn));
        }
        moved
    }

    /// Returns the chain with every turn between −π and π.
    pub fn wrapped(&self, chain: &Chain) -> Chain {
        let mut wrapped = chain.clone();
        for turn in &mut wrapped.turns_rad {
            *turn = wrap(*turn);
        }
        wrapped
    }

    /// Returns the motion of a step of the pose about the centre. A long turn is cut short.
    fn pose_step(&self, turn: &Vector, shift: &Vector) -> Frame {
        let turn = turn.cap_magnitude(MAX_POSE_STEP_RAD);
        let axes = nalgebra::Rotation3::from_scaled_axis(turn).into_inner();
        let centre = self.centre.coords;
        Frame {
            origin: Point::from(centre + shift - axes * centre),
            axes,
        }
    }

    fn values(&self, freedom: Freedom) -> usize {
        match freedom {
            Freedom::Zero => 0,
            Freedom::One => 1,
            Freedom::Each => self.pieces,
        }
    }

    fn value(&self, chain: &Chain, unknown: usize) -> f64 {
        let pieces = || 0..self.pieces;
        if unknown == self.length() {
            return chain.piece_mm;
        }
        if let Some(i) = pieces().find(|i| self.curvature(*i) == Some(unknown)) {
            return chain.pieces[i].curvature;
        }
        if let Some(i) = pieces().find(|i| self.torsion(*i) == Some(unknown)) {
            return chain.pieces[i].torsion;
        }
        let joint = self.turns.iter().position(|turn| *turn == Some(unknown));
        joint.map_or(0.0, |joint| chain.turns_rad[joint])
    }
}

/// Returns the angle between −π and π.
pub(super) fn wrap(angle_rad: f64) -> f64 {
    let turned = (angle_rad + PI).rem_euclid(TAU) - PI;
    if turned <= -PI { PI } else { turned }
}

fn place(freedom: Freedom, first: usize, piece: usize) -> Option<usize> {
    match freedom {
        Freedom::Zero => None,
        Freedom::One => Some(first),
        Freedom::Each => Some(first + piece),
    }
}
