//! The pictures of a telescope: in its states, its parts apart, and one joint cut open.

use rayon::prelude::*;

use super::figure::{Draft, Picture, Role};
use crate::base::numbers::measured;
use crate::draw::{
    Camera, HARDWARE, Hatch, Item, Label, PictureError, Scene, Shot, TEXT_PX, part_color,
    view_direction,
};
use crate::geom::{Aabb, Frame, Plane, Point, Vector};
use crate::mesh::TriMesh;

/// Angles of the viewer to the right and above the ground, radians.
const TURN_AND_LIFT: [f64; 2] = [0.5, 0.35];
/// Gap between parts that are drawn apart, as a share of the widest.
const APART_RATIO: f64 = 0.35;
/// Gap between a shell and its cap, as a share of the shell's height.
const BELOW_RATIO: f64 = 0.12;
/// Height of words on the picture of a joint, pixels.
const JOINT_TEXT_PX: f64 = 24.0;

/// A part in its shell's frame, as it is drawn.
#[derive(Debug, Clone, Copy)]
pub struct ShownPart<'a> {
    /// Its id.
    pub id: &'a str,
    /// Its shell, from 0.
    pub shell: usize,
    /// True for a tube, false for a cap.
    pub is_tube: bool,
    /// Its mesh.
    pub mesh: &'a TriMesh,
}

/// A joint cut to what lies near its pivot, in the outer shell's frame.
#[derive(Debug, Clone, PartialEq)]
pub struct CutJoint {
    /// The outer shell.
    pub outer: TriMesh,
    /// The inner shell.
    pub inner: TriMesh,
    /// The inner shell's cap; `None` if it is printed in place.
    pub cap: Option<TriMesh>,
    /// The pivot: tangent, normal and binormal as axes.
    pub pivot: Frame,
    /// Wall, mm.
    pub wall_mm: f64,
    /// Sliding clearance, mm.
    pub clearance_mm: f64,
    /// Radius of the inner body, mm.
    pub body_mm: f64,
    /// Radius of the outer bore, mm.
    pub bore_mm: f64,
    /// Overlap, mm.
    pub overlap_mm: f64,
    /// Way that is left before the stop, mm.
    pub before_stop_mm: f64,
}

/// What the pictures of a telescope show.
#[derive(Debug)]
pub struct TelescopeView<'a> {
    /// The parts.
    pub parts: &'a [ShownPart<'a>],
    /// The frames of the shells, all in.
    pub collapsed: Vec<Frame>,
    /// The frames half open.
    pub half: Vec<Frame>,
    /// The frames all out.
    pub extended: Vec<Frame>,
    /// The names of the poses, and the frames in each.
    pub poses: Vec<(String, Vec<Frame>)>,
    /// The direction that points up.
    pub up: Vector,
    /// A joint to cut open; `None` for a single shell.
    pub joint: Option<CutJoint>,
}

/// A state to draw: its file, its frames and its words.
struct State<'a> {
    file: String,
    role: Role,
    frames: &'a [Frame],
    caption: String,
}

/// Draws the pictures of a telescope; the same bytes on any number of threads.
///
/// # Errors
/// A picture cannot be encoded.
pub fn draw_telescope(view: &TelescopeView) -> Result<Vec<Picture>, PictureError> {
    let states = states(view);
    let toward = viewer(view);
    let placed: Vec<Vec<TriMesh>> = states
        .iter()
        .map(|state| place(view, state.frames))
        .collect();
    let apart = stand_apart(view);
    let drawn = states.iter().zip(&placed);
    let mut drafts: Vec<Draft> = drawn
        .map(|(state, meshes)| of_state(view, state, meshes, &toward))
        .collect();
    drafts.push(exploded(view, &apart));
    drafts.extend(placed.first().and_then(|meshes| nested(view, meshes)));
    drafts.extend(view.joint.as_ref().map(joint));
    drafts.par_iter().map(Draft::draw).collect()
}

fn states<'a>(view: &'a TelescopeView) -> Vec<State<'a>> {
    let usual = [
        ("collapsed.png", &view.collapsed, "All in."),
        ("half-open.png", &view.half, "Half of the joints out."),
        ("extended.png", &view.extended, "All out."),
    ];
    let usual = usual.into_iter().map(|(file, frames, caption)| State {
        file: format!("pictures/{file}"),
        role: Role::State,
        frames,
        caption: caption.to_owned(),
    });
    let poses = view.poses.iter().map(|(name, frames)| State {
        file: pose_picture(name),
        role: Role::Pose,
        frames,
        caption: format!("Pose {name}."),
    });
    usual.chain(poses).collect()
}

/// Returns the picture of a pose in a kit.
pub(super) fn pose_picture(name: &str) -> String {
    format!("pictures/pose-{name}.png")
}

fn viewer(view: &TelescopeView) -> Vector {
    viewer_of(view.extended.iter().map(|frame| frame.origin), &view.up)
}

/// Returns the direction to the viewer: from the side on which these points are widest.
pub(super) fn viewer_of(points: impl Iterator<Item = Point>, up: &Vector) -> Vector {
    let frame = Frame::with_axis(Point::origin(), up);
    let open = points.map(|p| frame.to_local(&p));
    let size = Aabb::of_points(&open.collect::<Vec<Point>>()).size();
    let side = if size.x < size.y {
        frame.axes.column(0).into_owned()
    } else {
        -frame.axes.column(1).into_owned()
    };
    view_direction(&side, up, TURN_AND_LIFT)
}

fn place(view: &TelescopeView, frames: &[Frame]) -> Vec<TriMesh> {
    let moved = |part: &ShownPart| part.mesh.map_vertices(|p| frames[part.shell].to_model(p));
    view.parts.iter().map(moved).collect()
}

fn of_state<'a>(
    view: &TelescopeView,
    state: &State,
    meshes: &'a [TriMesh],
    toward: &Vector,
) -> Draft<'a> {
    let parts = view.parts.iter().zip(meshes);
    Draft {
        file: state.file.clone(),
        role: state.role,
        caption: state.caption.clone(),
        alt: format!("The telescope from the side. {}", state.caption),
        shot: Shot {
            scene: Scene {
                items: parts
                    .map(|(part, mesh)| Item::new(mesh, part_color(part.shell)))
                    .collect(),
                cut: None,
            },
            camera: Camera::new(*toward, view.up),
            text_px: TEXT_PX,
            labels: Vec::new(),
            keys: Vec::new(),
        },
    }
}

/// Draws shells that are printed in each other, cut open along the root's bend; `None` for shells
/// with caps.
fn nested<'a>(view: &TelescopeView, meshes: &'a [TriMesh]) -> Option<Draft<'a>> {
    let root = view.collapsed.first()?;
    let is_nested = view.parts.len() > 1 && view.parts.iter().all(|part| part.is_tube);
    let axis = |column: usize| root.axes.column(column).into_owned();
    let parts = view.parts.iter().zip(meshes);
    let items = parts.map(|(part, mesh)| Item::new(mesh, part_color(part.shell)));
    is_nested.then(|| Draft {
        file: "pictures/nested.png".to_owned(),
        role: Role::CutJoint,
        caption: "All shells in each other, as they are printed, cut open.".to_owned(),
        alt: "The telescope all in, cut along its axis: every shell is a wall of its own, with a \
              gap to the next."
            .to_owned(),
        shot: Shot {
            scene: Scene {
                items: items.collect(),
                cut: Some(Plane::through(&root.origin, &axis(2))),
            },
            camera: Camera::new(axis(2), axis(0)),
            text_px: JOINT_TEXT_PX,
            labels: Vec::new(),
            keys: Vec::new(),
        },
    })
}

/// Returns the parts upright beside each other, every cap below its shell.
fn stand_apart(view: &TelescopeView) -> Vec<TriMesh> {
    let turn = Frame::with_axis(Point::origin(), &Vector::x());
    let upright: Vec<TriMesh> = view
        .parts
        .iter()
        .map(|part| part.mesh.map_vertices(|p| turn.to_local(p)))
        .collect();
    let widest = upright
        .iter()
        .map(|mesh| mesh.aabb().size().x)
        .fold(0.0, f64::max);
    let tallest = upright
        .iter()
        .map(|mesh| mesh.aabb().size().z)
        .fold(0.0, f64::max);
    let mut right = 0.0;
    let mut apart = Vec::new();
    for (part, mesh) in view.parts.iter().zip(&upright) {
        let bounds = mesh.aabb();
        if part.is_tube {
            right += bounds.size().x + APART_RATIO * widest;
        }
        let low = if part.is_tube {
            0.0
        } else {
            -BELOW_RATIO * tallest - bounds.size().z
        };
        let shift = Vector::new(right - bounds.max.x, -bounds.center().y, low - bounds.min.z);
        apart.push(mesh.map_vertices(|p| p + shift));
    }
    apart
}

fn exploded<'a>(view: &TelescopeView, apart: &'a [TriMesh]) -> Draft<'a> {
    let items = view.parts.iter().zip(apart);
    let names = view.parts.iter().enumerate();
    let has_caps = view.parts.iter().any(|part| !part.is_tube);
    Draft {
        file: "pictures/exploded.svg".to_owned(),
        role: Role::Exploded,
        caption: match has_caps {
            true => "The shells from the root on, every cap below its shell.".to_owned(),
            false => "The shells from the root on.".to_owned(),
        },
        alt: "The parts upright beside each other.".to_owned(),
        shot: Shot {
            scene: Scene {
                items: items
                    .map(|(part, mesh)| Item::new(mesh, part_color(part.shell)))
                    .collect(),
                cut: None,
            },
            camera: Camera::new(
                view_direction(&-Vector::y(), &Vector::z(), [0.2, 0.3]),
                Vector::z(),
            )
            .with_label_margins(),
            text_px: TEXT_PX,
            labels: names
                .map(|(item, part)| Label::On(item, part.id.to_owned()))
                .collect(),
            keys: Vec::new(),
        },
    }
}

fn joint(joint: &CutJoint) -> Draft<'_> {
    let axis = |column: usize| joint.pivot.axes.column(column).into_owned();
    let cut = Plane::through(&joint.pivot.origin, &axis(2));
    let at = |along: f64, aside: f64| joint.pivot.to_model(&Point::new(along, aside, 0.0));
    let half = 0.5 * joint.overlap_mm;
    let back = half + joint.before_stop_mm;
    let word = |name: &str, mm: f64| format!("{name} {}", measured(mm, "mm"));
    let outer_mm = joint.bore_mm + 0.5 * joint.wall_mm;
    let labels = vec![
        Label::At(at(-half, outer_mm), word("wall", joint.wall_mm)),
        Label::At(
            at(half - 0.3, joint.body_mm + 0.5 * joint.clearance_mm),
            word("sliding clearance", joint.clearance_mm),
        ),
        Label::At(
            at(half - 1.0, joint.body_mm + joint.clearance_mm + 0.3),
            "lip".to_owned(),
        ),
        Label::At(at(-back + 1.0, joint.body_mm + 0.3), "flange".to_owned()),
        Label::At(at(half, -joint.body_mm), word("overlap", joint.overlap_mm)),
    ];
    let glued = joint.cap.as_ref().map(|_| {
        let place = at(-back + 0.5, 0.5 * joint.body_mm);
        Label::At(place, "cap, glued in".to_owned())
    });
    let cap = joint.cap.as_ref().map(|cap| Item {
        hatch: Hatch::RODS,
        ..Item::new(cap, HARDWARE)
    });
    let tubes = [&joint.outer, &joint.inner].into_iter().enumerate();
    let tubes = tubes.map(|(shell, mesh)| Item::new(mesh, part_color(shell)));
    Draft {
        file: "pictures/joint.svg".to_owned(),
        role: Role::CutJoint,
        caption: format!(
            "J01 cut open, {} before its stop.",
            measured(joint.before_stop_mm, "mm")
        ),
        alt: "The first joint cut along its axis: the inner shell with its flange in the outer \
              shell with its lip."
            .to_owned(),
        shot: Shot {
            scene: Scene {
                items: tubes.chain(cap).collect(),
                cut: Some(cut),
            },
            camera: Camera::new(axis(2), axis(1)).with_label_margins(),
            text_px: JOINT_TEXT_PX,
            labels: labels.into_iter().chain(glued).collect(),
            keys: Vec::new(),
        },
    }
}
