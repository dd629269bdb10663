//! A made telescope, or several on junctures, as bodies that move: for the page and other programs.

use rayon::prelude::*;

use super::balance::ground;
use super::made::{Made, PartKind};
use super::motion_file::motion;
use super::posing::Posed;
use crate::base::watch::Watch;
use crate::draw::PictureError;
use crate::geom::{Frame, Point, Vector};
use crate::mesh::TriMesh;
use crate::page::{Film, FilmBody, FilmLimb, FilmPlace, FilmPose, Stage};
use crate::repair::weld;
use crate::telescope::motion::{Key, between};
use crate::telescope::nest::JointState;
use crate::telescope::network::Network;
use crate::verify::TelescopeMotion;

/// The share of a move at which the view looks for room besides the ends.
const HALF: f64 = 0.5;

/// A body in its own frame: that of its shell, or the model's where all is out.
pub struct MovingBody {
    pub id: String,
    pub mesh: TriMesh,
    /// Its colour's place in the palette.
    pub color: usize,
    pub place: FilmPlace,
    /// True if the view writes its name beside it.
    pub is_named: bool,
}

/// Bodies on a network of joints. A single telescope is a network of one limb on bare ends.
pub struct Moving {
    pub network: Network,
    pub motions: Vec<TelescopeMotion>,
    /// The parts of the limbs, a shell before its cap, then the junctures.
    pub bodies: Vec<MovingBody>,
    /// The points that were asked for, of each limb.
    pub curves: Vec<Vec<Point>>,
    /// The states between moves.
    pub keys: Vec<Vec<Key>>,
    pub poses: Vec<Posed>,
    /// The direction that points up.
    pub up: Vector,
}

impl Moving {
    /// Returns a single telescope, upright on its root's tail.
    pub fn of_chain(made: &Made, poses: &[Posed], asked: Vec<Point>) -> Self {
        let design = &made.best.design;
        Self {
            up: ground(&design.telescope).axes.column(0).into(),
            network: Network::alone(design.telescope.clone(), design.opening.clone()),
            motions: vec![motion(made)],
            bodies: limb_bodies(0, made),
            curves: vec![asked],
            poses: poses.to_vec(),
            keys: design
                .opening
                .keys
                .iter()
                .map(|key| vec![key.clone()])
                .collect(),
        }
    }

    /// Returns the frames of all bodies in a state.
    pub fn frames(&self, state: &[Key]) -> Vec<Frame> {
        let frames = self.network.frames(state);
        let place = |body: &MovingBody| match body.place {
            FilmPlace::Shell { limb, shell } => frames.shells[limb][shell],
            FilmPlace::Juncture(index) => frames.junctures[index],
        };
        self.bodies.iter().map(place).collect()
    }

    /// Draws the view of the page.
    pub fn stage(&self, watch: &Watch) -> Result<Stage, PictureError> {
        let bodies = self.bodies.iter().map(|body| FilmBody {
            id: &body.id,
            mesh: &body.mesh,
            color: body.color,
            place: body.place,
            is_named: body.is_named,
        });
        let limbs = self.network.limbs.iter().zip(&self.motions);
        let limbs = limbs.map(|(limb, motion)| FilmLimb {
            id: &limb.id,
            motion,
            ends: [limb.from, limb.to],
        });
        let film = Film {
            bodies: bodies.collect(),
            limbs: limbs.collect(),
            junctures: self.network.junctures,
            keys: self.keys.iter().map(|state| written(state)).collect(),
            poses: self.film_poses(),
            seen: self.looked_at().map(|state| self.frames(&state)).collect(),
            curves: &self.curves,
            up: self.up,
        };
        Stage::of_film(&film, watch)
    }

    fn film_poses(&self) -> Vec<FilmPose> {
        let poses = self.poses.iter().filter_map(|posed| {
            Some(FilmPose {
                name: posed.name.clone(),
                state: written(posed.keys.last()?),
            })
        });
        poses.collect()
    }

    /// Returns the keys, the states half way between two, and the poses.
    fn looked_at(&self) -> impl Iterator<Item = Vec<Key>> {
        let half = self.keys.windows(2).map(|pair| middle(&pair[0], &pair[1]));
        let poses = self.poses.iter().filter_map(|own| own.keys.last().cloned());
        self.keys.iter().cloned().chain(half).chain(poses)
    }
}

fn middle(from: &[Key], to: &[Key]) -> Vec<Key> {
    let limbs = from.iter().zip(to);
    limbs.map(|(a, b)| between(a, b, HALF)).collect()
}

/// Returns a state as it is written.
pub fn written(state: &[Key]) -> Vec<Vec<[f64; 2]>> {
    let joint = |own: &JointState| [own.slide_mm, own.turn_rad];
    state
        .iter()
        .map(|key| key.iter().map(joint).collect())
        .collect()
}

/// Returns the parts of a limb, counted from 0, each in its shell's frame.
pub fn limb_bodies(limb: usize, made: &Made) -> Vec<MovingBody> {
    let parts = made.parts.par_iter().map(|part| MovingBody {
        id: part.id.clone(),
        // A file of triangles holds every corner anew.
        mesh: weld(&part.in_shell()),
        color: part.shell,
        place: FilmPlace::Shell {
            limb,
            shell: part.shell,
        },
        is_named: part.kind == PartKind::Shell,
    });
    parts.collect()
}
