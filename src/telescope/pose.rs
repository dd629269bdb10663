//! Poses: states of the joints whose tips come as near as they can to wanted places.
//!
//! A joint goes one way: its shell slides out, then it turns. So it has one unknown, how far it has
//! gone. The unknowns of all joints that move a tip are found by damped least squares within their
//! bounds, from many starts. (Buss, "Introduction to inverse kinematics", 2004.)

use nalgebra::{Cholesky, DMatrix, DVector};

use super::motion::Key;
use super::nest::JointState;
use super::network::{Network, NetworkFrames};
use crate::geom::{Point, Vector};

/// The way that a turn of one radian counts for, mm: the order of a shell's radius.
const TURN_MM: f64 = 20.0;
/// Starts of the search; the first are all out, half out and all in.
const STARTS: usize = 48;
/// Most steps from one start.
const MAX_STEPS: usize = 200;
/// Steps tried with more and more damping before a place counts as the nearest.
const MAX_TRIES: usize = 14;
/// Damping at the start and the least, in units of the mean diagonal.
const DAMPINGS: [f64; 2] = [1e-3, 1e-12];
/// Factor by which damping falls after a good step, and rises after a bad one.
const DAMPING_FACTOR: f64 = 5.0;
/// Distance at which a place is reached, mm: rounding.
const REACHED_MM: f64 = 1e-9;
/// Relative fall of the cost in one step that counts as none.
const FLAT: f64 = 1e-12;
/// Distances that differ by less than this are the same, mm.
const SAME_MM: f64 = 1e-6;
/// The golden ratio, and a step from joint to joint: starts that fill the bounds evenly.
const SPREAD: [f64; 2] = [0.618_033_988_749_895, 0.414_213_562_373_095];

/// A place that the end of a limb is to reach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target {
    /// The limb, counted from 0.
    pub limb: usize,
    /// The place in the frame of the model, mm.
    pub place: Point,
}

/// A state, and what it leaves to the wanted places.
#[derive(Debug, Clone, PartialEq)]
pub struct Reached {
    /// The state of every limb's joints. Joints that move no wanted tip are all out.
    pub state: Vec<Key>,
    /// The greatest distance of a tip from its place, mm.
    pub off_mm: f64,
    /// Steps of the search that found it.
    pub steps: usize,
}

/// A place that is beyond all that a limb can reach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TooFar {
    /// The limb, counted from 0.
    pub limb: usize,
    /// Distance of the place from the mouth of the first root, mm.
    pub distance_mm: f64,
    /// The most that all shells on the way reach from there, mm.
    pub reach_mm: f64,
}

impl Network {
    /// Returns the end of every limb in a state: the centre of its last shell's visible end.
    pub fn ends(&self, state: &[Key]) -> Vec<Point> {
        self.ends_of(&self.frames(state))
    }

    fn ends_of(&self, frames: &NetworkFrames) -> Vec<Point> {
        let limbs = self.limbs.iter().zip(&frames.shells);
        let end = limbs.map(|(limb, frames)| {
            let telescope = &limb.telescope;
            let last = telescope.shells.len() - 1;
            let helix = &telescope.shells[last].helix;
            frames[last].to_model(&helix.frame_at(telescope.visible_mm).origin)
        });
        end.collect()
    }

    /// Returns the state with all shells out.
    pub fn open(&self) -> Vec<Key> {
        let open = self.limbs.iter().map(|limb| limb.telescope.open());
        open.collect()
    }

    /// Returns states whose tips come as near as they can to wanted places, the nearest first.
    ///
    /// They are the minima of the sum of squared distances that a search from many starts finds. Of
    /// equally near ones, that of the start which is more open comes first.
    pub fn reach(&self, targets: &[Target]) -> Vec<Reached> {
        let search = Search::new(self, targets);
        let starts = (0..STARTS).map(|start| search.start(start));
        let mut found: Vec<Reached> = Vec::new();
        for reached in starts.map(|start| search.descend(start)) {
            if !found.iter().any(|known| is_same(known, &reached)) {
                found.push(reached);
            }
        }
        let rank = |reached: &Reached| (reached.off_mm / SAME_MM).round();
        found.sort_by(|a, b| rank(a).total_cmp(&rank(b)));
        found
    }

    /// Returns the proof that a place is too far for a limb; `None` if this proves nothing.
    ///
    /// A tip is at the end of a line of arcs and of fixed ways through junctures. No arc is longer
    /// than what its shell shows, so no tip is farther than the sum.
    pub fn too_far(&self, target: &Target) -> Option<TooFar> {
        let path = self.path(target.limb);
        let open = self.frames(&self.open());
        let ends = self.ends_of(&open);
        let mouth = |limb: usize| {
            let telescope = &self.limbs[limb].telescope;
            let root = &telescope.shells[0].helix;
            open.shells[limb][0].to_model(&root.frame_at(telescope.visible_mm).origin)
        };
        let arcs = path.iter().map(|limb| {
            let telescope = &self.limbs[*limb].telescope;
            telescope.visible_mm * telescope.joints.len() as f64
        });
        let between = path.windows(2);
        let between = between.map(|pair| (mouth(pair[1]) - ends[pair[0]]).norm());
        let reach_mm = arcs.chain(between).sum();
        let distance_mm = (target.place - mouth(*path.first()?)).norm();
        (distance_mm > reach_mm).then_some(TooFar {
            limb: target.limb,
            distance_mm,
            reach_mm,
        })
    }

    /// Returns the limbs that move the end of a limb: those that carry it, and itself.
    fn path(&self, limb: usize) -> Vec<usize> {
        let mut path = vec![limb];
        let mut from = self.limbs[limb].from;
        while let Some(carrier) = self.limbs.iter().position(|limb| limb.to == from) {
            path.push(carrier);
            from = self.limbs[carrier].from;
        }
        path.reverse();
        path
    }
}

fn is_same(a: &Reached, b: &Reached) -> bool {
    let states = a.state.iter().flatten().zip(b.state.iter().flatten());
    let mut off = states.map(|(a, b)| {
        let slide = (a.slide_mm - b.slide_mm).abs();
        slide.max((a.turn_rad - b.turn_rad).abs() * TURN_MM)
    });
    off.all(|off| off < SAME_MM.sqrt())
}

/// The unknown of a joint: the way that it has gone, mm.
struct Way {
    limb: usize,
    joint: usize,
    closed_mm: f64,
    stroke_mm: f64,
    turn_rad: f64,
}

impl Way {
    /// Returns the greatest way, mm: all out and all turned.
    fn most_mm(&self) -> f64 {
        self.stroke_mm + TURN_MM * self.turn_rad.abs()
    }

    fn state(&self, gone_mm: f64) -> JointState {
        let turned = (gone_mm - self.stroke_mm).max(0.0) / TURN_MM;
        JointState {
            slide_mm: self.closed_mm + gone_mm.min(self.stroke_mm),
            turn_rad: turned.copysign(self.turn_rad),
        }
    }
}

/// The change of all residuals with one unknown, and the range in which it is right.
struct Column {
    values: DVector<f64>,
    range_mm: [f64; 2],
}

struct Search<'a> {
    network: &'a Network,
    targets: &'a [Target],
    ways: Vec<Way>,
    /// The limbs that move each target's tip.
    paths: Vec<Vec<usize>>,
}

/// A place of the search.
struct Place {
    gone: Vec<f64>,
    frames: NetworkFrames,
    /// From every wanted place to its tip.
    residuals: DVector<f64>,
}

impl Place {
    fn cost(&self) -> f64 {
        self.residuals.norm_squared()
    }
}

impl<'a> Search<'a> {
    fn new(network: &'a Network, targets: &'a [Target]) -> Self {
        let paths: Vec<Vec<usize>> = targets.iter().map(|own| network.path(own.limb)).collect();
        let limbs = network.limbs.iter().enumerate();
        let moving = limbs.filter(|(limb, _)| paths.iter().any(|path| path.contains(limb)));
        let ways = moving.flat_map(|(limb, own)| {
            let telescope = &own.telescope;
            let closed_mm = telescope.sizes.closed_mm();
            let joints = telescope.joints.iter().enumerate();
            joints.map(move |(joint, own)| Way {
                limb,
                joint,
                closed_mm,
                stroke_mm: telescope.visible_mm - closed_mm,
                turn_rad: own.turn_rad,
            })
        });
        Self {
            ways: ways.collect(),
            network,
            targets,
            paths,
        }
    }

    /// Returns where a search begins.
    fn start(&self, number: usize) -> Vec<f64> {
        let share = |unknown: usize| match number {
            0 => 1.0,
            1 => 0.5,
            2 => 0.0,
            _ => (number as f64 * (SPREAD[0] + unknown as f64 * SPREAD[1])).fract(),
        };
        let ways = self.ways.iter().enumerate();
        ways.map(|(i, way)| share(i) * way.most_mm()).collect()
    }

    fn state(&self, gone: &[f64]) -> Vec<Key> {
        let mut state = self.network.open();
        for (way, gone) in self.ways.iter().zip(gone) {
            state[way.limb][way.joint] = way.state(*gone);
        }
        state
    }

    fn look(&self, gone: Vec<f64>) -> Place {
        let frames = self.network.frames(&self.state(&gone));
        let ends = self.network.ends_of(&frames);
        let off = self.targets.iter();
        let off = off.flat_map(|own| <[f64; 3]>::from(ends[own.limb] - own.place));
        Place {
            residuals: DVector::from_iterator(3 * self.targets.len(), off),
            frames,
            gone,
        }
    }

    fn descend(&self, start: Vec<f64>) -> Reached {
        let mut place = self.look(start);
        let mut damping = DAMPINGS[0];
        let mut steps = 0;
        while steps < MAX_STEPS && place.cost() > REACHED_MM * REACHED_MM {
            let before = place.cost();
            let Some(next) = self.step(&place, &mut damping) else {
                break;
            };
            place = next;
            steps += 1;
            if before - place.cost() < FLAT * before {
                break;
            }
        }
        let off = self.targets.iter().enumerate();
        let off = off.map(|(i, _)| place.residuals.fixed_rows::<3>(3 * i).norm());
        Reached {
            state: self.state(&place.gone),
            off_mm: off.fold(0.0, f64::max),
            steps,
        }
    }

    /// Returns a better place; `None` if there is none near by.
    fn step(&self, place: &Place, damping: &mut f64) -> Option<Place> {
        let columns: Vec<Column> = (0..self.ways.len())
            .map(|unknown| self.column(unknown, place))
            .collect();
        let vectors: Vec<DVector<f64>> = columns.iter().map(|own| own.values.clone()).collect();
        if vectors.is_empty() {
            return None;
        }
        let jacobian = DMatrix::from_columns(&vectors);
        let square = &jacobian * jacobian.transpose();
        let size = square.nrows();
        let mean = square.trace() / size as f64;
        for _ in 0..MAX_TRIES {
            let damped = &square + DMatrix::identity(size, size) * (*damping * mean);
            let solved = Cholesky::new(damped)?.solve(&place.residuals);
            let step = -jacobian.tr_mul(&solved);
            let gone = place.gone.iter().zip(&step).zip(&columns);
            let gone = gone
                .map(|((gone, step), own)| (gone + step).clamp(own.range_mm[0], own.range_mm[1]));
            let next = self.look(gone.collect());
            if next.cost() < place.cost() {
                *damping = (*damping / DAMPING_FACTOR).max(DAMPINGS[1]);
                return Some(next);
            }
            *damping *= DAMPING_FACTOR;
        }
        None
    }

    /// Returns the column of an unknown: that of its slide or of its turn, whichever comes nearer,
    /// or zeros if it is at its end.
    fn column(&self, unknown: usize, place: &Place) -> Column {
        let (way, gone) = (&self.ways[unknown], place.gone[unknown]);
        let none = Column {
            values: DVector::zeros(place.residuals.len()),
            range_mm: [gone, gone],
        };
        let slide = (gone <= way.stroke_mm).then(|| Column {
            values: self.tips(way, place, |tip| slide_of(way, self.network, place, tip)),
            range_mm: [0.0, way.stroke_mm],
        });
        let turns = way.turn_rad != 0.0 && gone >= way.stroke_mm;
        let turn = turns.then(|| Column {
            values: self.tips(way, place, |tip| turn_of(way, self.network, place, tip)),
            range_mm: [way.stroke_mm, way.most_mm()],
        });
        let gain = |column: &Column| {
            let fall = -column.values.dot(&place.residuals);
            let [low, high] = column.range_mm;
            let is_free = if fall < 0.0 { gone > low } else { gone < high };
            if is_free { fall.abs() } else { 0.0 }
        };
        let useful = slide.into_iter().chain(turn);
        let useful = useful.filter(|column| gain(column) > 0.0);
        let best = useful.max_by(|a, b| gain(a).total_cmp(&gain(b)));
        best.unwrap_or(none)
    }

    /// Returns the velocities of all tips, zero for those that a joint does not move.
    fn tips(&self, way: &Way, place: &Place, of: impl Fn(&Point) -> Vector) -> DVector<f64> {
        let targets = self.targets.iter().zip(&self.paths).enumerate();
        let velocities = targets.flat_map(|(i, (target, path))| {
            let off: Vector = place.residuals.fixed_rows::<3>(3 * i).into_owned();
            let tip = target.place + off;
            let moves = path.contains(&way.limb);
            <[f64; 3]>::from(if moves { of(&tip) } else { Vector::zeros() })
        });
        DVector::from_iterator(place.residuals.len(), velocities)
    }
}

/// Returns the velocity of a point with the slide of a joint: the screw of the inner helix.
fn slide_of(way: &Way, network: &Network, place: &Place, point: &Point) -> Vector {
    let inner = way.joint + 1;
    let frame = &place.frames.shells[way.limb][inner];
    let helix = &network.limbs[way.limb].telescope.shells[inner].helix;
    let spin = Vector::new(helix.torsion, 0.0, helix.curvature);
    frame.direction_to_model(&(Vector::x() + spin.cross(&frame.to_local(point).coords)))
}

/// Returns the velocity of a point with the way of a turn, about the tangent at the pivot.
fn turn_of(way: &Way, network: &Network, place: &Place, point: &Point) -> Vector {
    let telescope = &network.limbs[way.limb].telescope;
    let outer = &place.frames.shells[way.limb][way.joint];
    let helix = &telescope.shells[way.joint].helix;
    let pivot = outer.frame_to_model(&helix.frame_at(telescope.visible_mm));
    let tangent: Vector = pivot.axes.column(0).into();
    tangent.cross(&(point - pivot.origin)) * (way.turn_rad.signum() / TURN_MM)
}
