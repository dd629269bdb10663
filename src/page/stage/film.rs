//! The view of telescopes: shells that go along their helices from key to key.

use serde::Serialize;

use super::pack::{Body, PackedBody, simplify_all};
use super::{
    HELICES, Named, PLAYER, Packed, Player, STAGE, Stage, Step, Toggle, Words, columns, corners,
    packed,
};
use crate::base::watch::Watch;
use crate::draw::{Hatch, INK, PictureError, part_color};
use crate::geom::{Aabb, Frame, Point, Vector};
use crate::mesh::TriMesh;
use crate::verify::{Pose, TelescopeMotion};

/// A body that moves: its mesh in its own frame.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmBody<'a> {
    /// Its id.
    pub id: &'a str,
    /// Its mesh, mm.
    pub mesh: &'a TriMesh,
    /// Its colour's place in the palette.
    pub color: usize,
    /// The body that it is fixed to.
    pub place: FilmPlace,
    /// True if its name is written beside it.
    pub is_named: bool,
}

/// The thing that a body is fixed to, counted from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FilmPlace {
    /// A shell of a limb.
    Shell {
        /// The limb.
        limb: usize,
        /// The shell, the root first.
        shell: usize,
    },
    /// A juncture.
    Juncture(usize),
}

/// A telescope between two junctures.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmLimb<'a> {
    /// Its name; empty for a telescope alone.
    pub id: &'a str,
    /// Its motion.
    pub motion: &'a TelescopeMotion,
    /// The junctures that hold its root and that its last shell carries, from 0.
    pub ends: [usize; 2],
}

/// Everything that the view of telescopes shows.
#[derive(Debug, Clone, PartialEq)]
pub struct Film<'a> {
    /// The bodies.
    pub bodies: Vec<FilmBody<'a>>,
    /// The telescopes, each after the one that carries it.
    pub limbs: Vec<FilmLimb<'a>>,
    /// The number of junctures, those without a body among them.
    pub junctures: usize,
    /// Slide (mm) and turn (rad) of every joint of every limb between moves.
    pub keys: Vec<Vec<Vec<[f64; 2]>>>,
    /// The poses.
    pub poses: Vec<FilmPose>,
    /// The frames of all bodies in states for which the view has room.
    pub seen: Vec<Vec<Frame>>,
    /// The points that were asked for, of each limb, mm.
    pub curves: &'a [Vec<Point>],
    /// The direction that points up.
    pub up: Vector,
}

/// A pose to be seen.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FilmPose {
    /// Its name.
    pub name: String,
    /// Slide (mm) and turn (rad) of every joint of every limb.
    pub state: Vec<Vec<[f64; 2]>>,
}

/// The motion that the script reads.
#[derive(Serialize)]
struct PackedFilm<'a> {
    junctures: usize,
    limbs: Vec<PackedLimb<'a>>,
    /// The thing that each body is fixed to: a limb and a shell, or a juncture.
    bodies: Vec<Vec<usize>>,
    keys: &'a [Vec<Vec<[f64; 2]>>],
    poses: &'a [FilmPose],
}

#[derive(Serialize)]
struct PackedLimb<'a> {
    root: Pose,
    from: usize,
    to: usize,
    /// Curvature and torsion, 1/mm, and visible length, mm.
    shells: Vec<[f64; 3]>,
    joints: Vec<PackedJoint<'a>>,
}

#[derive(Serialize)]
struct PackedJoint<'a> {
    id: &'a str,
    closed: f64,
    open: f64,
    turn: f64,
}

impl Stage {
    /// Packs the view of telescopes.
    ///
    /// # Errors
    /// [`PictureError::Cancelled`] if the watch was stopped.
    pub fn of_film(film: &Film, watch: &Watch) -> Result<Self, PictureError> {
        let meshes: Vec<&TriMesh> = film.bodies.iter().map(|body| body.mesh).collect();
        let simple = simplify_all(&meshes, watch)?;
        let bodies = film.bodies.iter().zip(simple).map(|(body, mesh)| Body {
            name: body.id.to_owned(),
            mesh,
            color: part_color(body.color),
            hatch: Hatch::PRINTED,
        });
        let bodies: Vec<Body> = bodies.collect();
        let upright = Frame::with_axis(Point::origin(), &film.up);
        let curves = film.curves.iter().filter(|curve| curve.len() > 1);
        let named = film.bodies.iter().enumerate();
        let named = named.filter(|(_, body)| body.is_named);
        let named = named.map(|(index, body)| Named {
            body: index,
            words: body.id.to_owned(),
        });
        let steps = film.steps();
        let data = Packed {
            bounds: corners(&film.bounds(&bodies, &upright)),
            upright: columns(&upright.axes.transpose()),
            cuts_moved: true,
            items: bodies.iter().map(PackedBody::of).collect(),
            lines: curves
                .map(|curve| PackedBody::line("curve", curve, INK))
                .collect(),
            named: named.collect(),
            names_wait: false,
            steps: &steps,
            motion: film.motion(),
        };
        Ok(Self {
            packed: packed(&data)?,
            toggles: film.toggles(),
            scripts: &[STAGE, PLAYER, HELICES],
            words: Words {
                subject: "The telescope",
                slider: "Open",
                order: "Order of opening",
                line: Some("Curve that was asked for"),
            },
            player: Some(Player {
                moves: film.keys.len().saturating_sub(1),
                steps,
                poses: film.poses.iter().map(|pose| pose.name.clone()).collect(),
            }),
        })
    }
}

impl<'a> Film<'a> {
    fn motion(&self) -> PackedFilm<'_> {
        let limbs = self.limbs.iter().map(|limb| PackedLimb {
            root: limb.motion.root,
            from: limb.ends[0],
            to: limb.ends[1],
            shells: limb
                .motion
                .shells
                .iter()
                .map(|shell| [shell.curvature, shell.torsion, shell.length_mm])
                .collect(),
            joints: limb
                .motion
                .joints
                .iter()
                .map(|joint| PackedJoint {
                    id: &joint.id,
                    closed: joint.closed_mm,
                    open: joint.open_mm,
                    turn: joint.turn_rad,
                })
                .collect(),
        });
        let place = |body: &FilmBody| match body.place {
            FilmPlace::Shell { limb, shell } => vec![limb, shell],
            FilmPlace::Juncture(index) => vec![index],
        };
        PackedFilm {
            junctures: self.junctures,
            limbs: limbs.collect(),
            bodies: self.bodies.iter().map(place).collect(),
            keys: &self.keys,
            poses: &self.poses,
        }
    }

    /// Returns the box of all bodies in all states that are to be seen, and of the curves.
    fn bounds(&self, bodies: &[Body], upright: &Frame) -> Aabb {
        let mut points = Vec::new();
        for frames in &self.seen {
            for (body, frame) in bodies.iter().zip(frames) {
                let seen = body
                    .mesh
                    .map_vertices(|p| upright.to_local(&frame.to_model(p)));
                let bounds = seen.aabb();
                points.extend([bounds.min, bounds.max]);
            }
        }
        let curves = self.curves.iter().flatten();
        points.extend(curves.map(|p| upright.to_local(p)));
        Aabb::of_points(&points)
    }

    /// Returns the steps: moves of the same joints, one after the other, are one.
    fn steps(&self) -> Vec<Step> {
        let mut steps: Vec<Step> = Vec::new();
        for (start, pair) in self.keys.windows(2).enumerate() {
            let name = self.moved(&pair[0], &pair[1]).join(", ");
            let to = start + 1;
            match steps.last_mut() {
                Some(last) if last.name == name => last.to = to,
                _ => steps.push(Step { name, to }),
            }
        }
        steps
    }

    /// Returns the ids of the joints that move between two keys.
    fn moved(&self, from: &[Vec<[f64; 2]>], to: &[Vec<[f64; 2]>]) -> Vec<&'a str> {
        let limbs = self.limbs.iter().zip(from.iter().zip(to));
        let joints = limbs.flat_map(|(limb, (from, to))| {
            let joints = limb.motion.joints.iter().zip(from.iter().zip(to));
            joints.filter(|(_, (from, to))| from != to)
        });
        joints.map(|(joint, _)| joint.id.as_str()).collect()
    }

    /// Returns a control for each shell with its cap; for several limbs, one for each limb and
    /// one for the junctures.
    fn toggles(&self) -> Vec<Toggle> {
        let of = |wanted: &dyn Fn(FilmPlace) -> bool| {
            let bodies = self.bodies.iter().enumerate();
            let own = bodies.filter(|(_, body)| wanted(body.place));
            own.map(|(index, _)| index).collect::<Vec<usize>>()
        };
        let single = self.limbs.first().filter(|limb| limb.id.is_empty());
        if let Some(limb) = single {
            let shells = (0..limb.motion.shells.len()).map(|shell| {
                let bodies = of(&|place| place == FilmPlace::Shell { limb: 0, shell });
                let ids: Vec<&str> = bodies.iter().map(|&at| self.bodies[at].id).collect();
                Toggle {
                    name: ids.join(" + "),
                    color: Some(part_color(shell)),
                    bodies,
                }
            });
            return shells.collect();
        }
        let limbs = self.limbs.iter().enumerate().map(|(index, limb)| Toggle {
            name: format!("limb {}", limb.id),
            color: None,
            bodies: of(&|place| matches!(place, FilmPlace::Shell { limb, .. } if limb == index)),
        });
        let junctures = Toggle {
            name: "junctures".to_owned(),
            color: None,
            bodies: of(&|place| matches!(place, FilmPlace::Juncture(_))),
        };
        limbs.chain([junctures]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::primitives::cuboid;
    use crate::verify::{JointMotion, ShellMotion};

    /// Returns the motion of three straight shells of 40 mm.
    fn straight() -> TelescopeMotion {
        let shell = |id: &str| ShellMotion {
            id: id.to_owned(),
            curvature: 0.0,
            torsion: 0.0,
            length_mm: 40.0,
            ends_mm: [-3.0, 43.0],
        };
        let joint = |id: &str| JointMotion {
            id: id.to_owned(),
            closed_mm: 5.0,
            open_mm: 40.0,
            turn_rad: 0.5,
        };
        TelescopeMotion {
            schema: 1,
            root: Pose::identity(),
            shells: ["S01", "S02", "S03"].map(shell).to_vec(),
            joints: ["J01", "J02"].map(joint).to_vec(),
            order: Vec::new(),
            poses: Vec::new(),
            keys: Vec::new(),
        }
    }

    #[test]
    fn a_joint_that_slides_and_turns_is_one_step_and_a_shell_is_shown_with_its_cap() {
        let motion = straight();
        let mesh = cuboid(&Point::origin(), &Point::new(4.0, 2.0, 2.0));
        let body = |id, shell| FilmBody {
            id,
            mesh: &mesh,
            color: shell,
            place: FilmPlace::Shell { limb: 0, shell },
            is_named: true,
        };
        let [closed, slid, turned] = [[5.0, 0.0], [40.0, 0.0], [40.0, 0.5]];
        let keys = [
            [closed; 2],
            [slid, closed],
            [turned, closed],
            [turned, slid],
        ];
        let bodies = vec![
            body("S01", 0),
            body("C01", 0),
            body("S02", 1),
            body("S03", 2),
        ];
        let out = Frame {
            origin: Point::new(70.0, 0.0, 0.0),
            ..Frame::identity()
        };
        let film = Film {
            seen: vec![vec![Frame::identity(); 4], vec![out; 4]],
            bodies,
            limbs: vec![FilmLimb {
                id: "",
                motion: &motion,
                ends: [0, 1],
            }],
            junctures: 2,
            keys: keys.iter().map(|key| vec![key.to_vec()]).collect(),
            poses: vec![FilmPose {
                name: "bow".to_owned(),
                state: vec![vec![slid, closed]],
            }],
            curves: &[vec![Point::origin(), Point::new(120.0, 0.0, 0.0)]],
            up: Vector::x(),
        };
        let step = |name: &str, to| Step {
            name: name.to_owned(),
            to,
        };
        assert_eq!(film.steps(), [step("J01", 2), step("J02", 3)]);
        let names: Vec<String> = film.toggles().into_iter().map(|own| own.name).collect();
        assert_eq!(names, ["S01 + C01", "S02", "S03"]);
        let stage = Stage::of_film(&film, &Watch::silent()).unwrap();
        let data: serde_json::Value = serde_json::from_str(&stage.packed).unwrap();
        // Upright, the view has room for both places and for the curve.
        assert_eq!(data["box"][0][2], 0.0);
        assert_eq!(data["box"][1][2], 120.0);
        assert_eq!(data["motion"]["poses"][0]["state"][0][1][0], 5.0);
        assert_eq!(stage.player.unwrap().poses, ["bow"]);
        assert_eq!(data["motion"]["bodies"][3], serde_json::json!([0, 2]));
        assert_eq!(data["items"][0]["size"], serde_json::json!([4.0, 2.0, 2.0]));
    }
}
