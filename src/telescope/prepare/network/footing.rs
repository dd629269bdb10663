//! How a figure stands on its foot over its opening, and the least foot that holds it.

use rayon::prelude::*;

use super::super::balance::{STATES, centre, tilt_rad};
use super::super::feet;
use super::super::made::Made;
use super::foot::{Falls, Foot};
use super::made::Workshop;
use super::tree::Tree;
use super::written::WrittenJuncture;
use crate::geom::{Frame, Matrix, Point, Vector, orthonormal_basis};
use crate::mass::moments_of_mesh;
use crate::mesh::TriMesh;
use crate::telescope::balance::DiscFoot;
use crate::telescope::motion::{Key, between};
use crate::telescope::network::NetworkFrames;
use crate::telescope::tube::TubeMass;

/// Depth below the table that is rounding, mm.
const ROUNDING_MM: f64 = 1e-3;

/// A figure with a sequence of opening, as it is put on a foot.
pub struct Footing<'a> {
    pub workshop: &'a Workshop<'a>,
    pub tree: &'a Tree<'a>,
    pub limbs: &'a [Made],
    pub junctures: &'a [WrittenJuncture],
    /// The masses of the junctures.
    pub masses: Vec<TubeMass>,
    /// The limbs in the order in which they open.
    pub sequence: &'a [usize],
}

impl Footing<'_> {
    /// Returns the least foot on which it stands by calculation; its juncture has none yet.
    pub fn choose(&self) -> Result<Foot, Falls> {
        let job = self.workshop.job;
        let root_mm = self.tree.network.limbs[0].telescope.shells[0].body_mm;
        let most_mm = feet::most_mm(&self.workshop.shop.printer);
        let radii_mm = feet::radii_mm(job.foot, [feet::first_mm(root_mm), most_mm]);
        let ground = self.ground();
        let states = self.states();
        self.refuse_low(&ground, &states)?;
        let wanted_deg = feet::wanted_deg(job.foot, job.least_angle_deg);
        let mut last = None;
        for radius_mm in radii_mm {
            let foot = self.foot(radius_mm, ground);
            let angle_deg = self
                .worst_rad(&foot, &states, Some(&foot.mass()))
                .to_degrees();
            if angle_deg >= wanted_deg {
                return Ok(foot);
            }
            last = Some((angle_deg, radius_mm));
        }
        let (angle_deg, foot_mm) = last.unwrap_or((f64::NEG_INFINITY, 0.0));
        Err(Falls::Topples { angle_deg, foot_mm })
    }

    /// Returns the lean at which it topples first on a foot that its juncture has, degrees. All
    /// play is taken up. Else it is told why it does not stand as asked.
    pub fn confirm(&self, foot: &Foot) -> Result<f64, Falls> {
        let states = self.states();
        self.refuse_low(&foot.ground, &states)?;
        let angle_deg = self.worst_rad(foot, &states, None).to_degrees();
        if angle_deg >= self.workshop.job.least_angle_deg {
            return Ok(angle_deg);
        }
        Err(Falls::Topples {
            angle_deg,
            foot_mm: foot.disc.radius_mm,
        })
    }

    fn foot(&self, radius_mm: f64, ground: Frame) -> Foot {
        let sizes = &self.tree.network.limbs[0].telescope.sizes;
        Foot {
            disc: DiscFoot {
                pocket_mm: None,
                radius_mm,
                height_mm: feet::height_mm(sizes),
            },
            chamfer_mm: sizes.chamfer_mm,
            ground,
        }
    }

    /// Returns the table under the first juncture: its lowest point, and up as the first axis.
    fn ground(&self) -> Frame {
        let up = self.workshop.loaded.up.normalize();
        let mesh = self.junctures[0].in_model();
        let mut points = mesh.vertices().iter();
        let first = points.next().copied().unwrap_or_else(Point::origin);
        let lower = |low: Point, p: &Point| match (p - low).dot(&up) < 0.0 {
            true => *p,
            false => low,
        };
        let origin = points.fold(first, lower);
        let (u, v) = orthonormal_basis(&up);
        Frame {
            origin,
            axes: Matrix::from_columns(&[up, u, v]),
        }
    }

    /// Returns the states that are looked at: the keys, and 20 of each move.
    fn states(&self) -> Vec<Vec<Key>> {
        let keys = self.tree.network.keys(self.sequence);
        let moves = keys.windows(2).flat_map(|pair| {
            (1..=STATES).map(|i| {
                let share = i as f64 / STATES as f64;
                let limbs = pair[0].iter().zip(&pair[1]);
                limbs.map(|(a, b)| between(a, b, share)).collect()
            })
        });
        keys.first().cloned().into_iter().chain(moves).collect()
    }

    /// Refuses a figure of which a body reaches below the table.
    fn refuse_low(&self, ground: &Frame, states: &[Vec<Key>]) -> Result<(), Falls> {
        let up: Vector = ground.axes.column(0).into();
        let bodies = self.bodies();
        let lowest = |state: &Vec<Key>| {
            let frames = self.tree.network.frames(state);
            let heights = bodies.iter().map(|body| {
                let frame = body.place.frame(&frames);
                // The height of a vertex is linear in the body's own axes.
                let along = frame.axes.transpose() * up;
                let low = body.mesh.vertices().iter().map(|p| along.dot(&p.coords));
                let low = low.fold(f64::INFINITY, f64::min);
                let height_mm = low + up.dot(&(frame.origin - ground.origin));
                (height_mm, body.id.as_str())
            });
            heights.min_by(|a, b| a.0.total_cmp(&b.0))
        };
        let lowest = states.par_iter().filter_map(lowest);
        let lowest = lowest.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(b.1)));
        match lowest {
            Some((height_mm, body)) if height_mm < -ROUNDING_MM => Err(Falls::Low {
                body: body.to_owned(),
                below_mm: -height_mm,
            }),
            _ => Ok(()),
        }
    }

    fn bodies(&self) -> Vec<Standing> {
        let limbs = self.limbs.iter().enumerate().flat_map(|(limb, made)| {
            made.parts.iter().map(move |part| Standing {
                id: part.id.clone(),
                place: Place::Shell(limb, part.shell),
                mesh: part.in_shell(),
            })
        });
        let junctures = self.junctures.iter().enumerate();
        let junctures = junctures.map(|(index, own)| Standing {
            id: own.id.clone(),
            place: Place::Juncture(index),
            mesh: own.in_model(),
        });
        limbs.chain(junctures).collect()
    }

    /// Returns the lean at which it topples first, with all play taken up, rad. `more` is mass that
    /// the first juncture does not have yet.
    fn worst_rad(&self, foot: &Foot, states: &[Vec<Key>], more: Option<&TubeMass>) -> f64 {
        let lean = |state: &Vec<Key>| {
            let frames = self.tree.network.frames(state);
            let mut placed = self.placed(&frames);
            placed.more.extend(more);
            foot.lean_rad(&centre(&placed.all()), self.sag_mm(&placed, &frames))
        };
        let leans: Vec<f64> = states.par_iter().map(lean).collect();
        leans.into_iter().fold(f64::INFINITY, f64::min)
    }

    fn placed(&self, frames: &NetworkFrames) -> Placed {
        let moved = |(mass, frame): (&TubeMass, &Frame)| TubeMass {
            centre: frame.to_model(&mass.centre),
            ..*mass
        };
        let limbs = self.limbs.iter().zip(&frames.shells);
        let limbs = limbs.map(|(made, frames)| made.masses.iter().zip(frames).map(moved).collect());
        Placed {
            limbs: limbs.collect(),
            junctures: self
                .masses
                .iter()
                .zip(&frames.junctures)
                .map(moved)
                .collect(),
            more: Vec::new(),
        }
    }

    /// Returns how far the centre moves if all joints tilt to the limit of their play the same way,
    /// mm.
    fn sag_mm(&self, placed: &Placed, frames: &NetworkFrames) -> f64 {
        let network = &self.tree.network;
        let whole: f64 = placed.all().iter().map(|mass| mass.volume_mm3).sum();
        let mut sag_mm = 0.0;
        for (index, limb) in network.limbs.iter().enumerate() {
            let carried = network.carried_by(index);
            let held = |(other, _): &(usize, &Vec<TubeMass>)| carried[network.limbs[*other].from];
            let limbs = placed.limbs.iter().enumerate().filter(held);
            let junctures = placed
                .junctures
                .iter()
                .zip(&carried)
                .filter(|(_, own)| **own);
            let outer: Vec<TubeMass> = limbs
                .flat_map(|(_, masses)| masses)
                .chain(junctures.map(|(mass, _)| mass))
                .copied()
                .collect();
            for (joint, own) in limb.telescope.joints.iter().enumerate() {
                let shells = &placed.limbs[index][joint + 1..];
                let beyond = [shells, &outer[..]].concat();
                let volume: f64 = beyond.iter().map(|mass| mass.volume_mm3).sum();
                let pivot = frames.shells[index][joint + 1].origin;
                let lever_mm = (centre(&beyond) - pivot).norm();
                let tilt = tilt_rad(own.seat_mm, &limb.telescope.sizes);
                sag_mm += tilt * lever_mm * volume / whole;
            }
        }
        sag_mm
    }
}

/// Returns the masses of junctures where they are when all is out.
pub fn masses(junctures: &[WrittenJuncture]) -> Vec<TubeMass> {
    let mass = |own: &WrittenJuncture| {
        let moments = moments_of_mesh(&own.in_model());
        TubeMass {
            volume_mm3: moments.volume(),
            centre: moments.centroid(),
        }
    };
    junctures.iter().map(mass).collect()
}

/// A body of a figure, in its own frame.
struct Standing {
    id: String,
    place: Place,
    mesh: TriMesh,
}

/// A shell of a limb, or a juncture, counted from 0.
enum Place {
    Shell(usize, usize),
    Juncture(usize),
}

impl Place {
    fn frame<'a>(&self, frames: &'a NetworkFrames) -> &'a Frame {
        match self {
            Self::Shell(limb, shell) => &frames.shells[*limb][*shell],
            Self::Juncture(index) => &frames.junctures[*index],
        }
    }
}

/// The masses of a figure in a state.
struct Placed {
    limbs: Vec<Vec<TubeMass>>,
    junctures: Vec<TubeMass>,
    /// What stands still besides.
    more: Vec<TubeMass>,
}

impl Placed {
    fn all(&self) -> Vec<TubeMass> {
        let limbs = self.limbs.iter().flatten();
        let all = limbs.chain(&self.junctures).chain(&self.more);
        all.copied().collect()
    }
}
