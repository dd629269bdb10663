//! The pictures of several telescopes on junctures: all in, half open, all out with names.

use rayon::prelude::*;

use super::figure::{Draft, Picture, Role};
use super::telescope_album::{pose_picture, viewer_of};
use crate::draw::{Camera, Item, Label, PictureError, Scene, Shot, TEXT_PX, part_color};
use crate::geom::{Aabb, Point, Vector};
use crate::mesh::TriMesh;

/// Gap between junctures that are drawn apart, as a share of the widest.
const APART_RATIO: f64 = 0.25;
/// Way of a juncture's part from the middle of all, as a share of its distance.
const PARTED_RATIO: f64 = 0.5;
/// Junctures that stand in one row.
const A_ROW: usize = 5;

/// A body as it is drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ShownBody {
    /// Its id.
    pub id: String,
    /// Its colour's place in the palette.
    pub color: usize,
    /// True if the picture of all names it.
    pub is_named: bool,
}

/// The bodies that the pictures show, and their meshes in three states.
#[derive(Debug)]
pub struct NetworkView {
    /// The bodies; the junctures last.
    pub bodies: Vec<ShownBody>,
    /// The meshes all in.
    pub collapsed: Vec<TriMesh>,
    /// The meshes half open.
    pub half: Vec<TriMesh>,
    /// The meshes all out.
    pub extended: Vec<TriMesh>,
    /// The names of the poses, and the meshes in each.
    pub poses: Vec<(String, Vec<TriMesh>)>,
    /// The direction that points up.
    pub up: Vector,
    /// The number of parts of every juncture.
    pub junctures: Vec<usize>,
}

/// The parts of a juncture that is divided, drawn apart.
struct Apart {
    /// The first of its bodies.
    first: usize,
    meshes: Vec<TriMesh>,
}

/// Draws the pictures; the same bytes on any number of threads.
///
/// # Errors
/// A picture cannot be encoded.
pub fn draw_network(view: &NetworkView) -> Result<Vec<Picture>, PictureError> {
    let toward = viewer_of(
        view.extended.iter().map(|mesh| mesh.aabb().center()),
        &view.up,
    );
    let apart = stand_apart(view);
    let divided = divided(view);
    let mut drafts = vec![
        state(view, &view.collapsed, ["collapsed.png", "All in."], &toward),
        state(
            view,
            &view.half,
            ["half-open.png", "Half of the joints out."],
            &toward,
        ),
        state(view, &view.extended, ["extended.png", "All out."], &toward),
        named(view, &toward),
        junctures(view, &apart),
    ];
    let parts = divided.iter().map(|own| parts_of(view, own, &toward));
    drafts.extend(parts);
    let poses = view.poses.iter().map(|(name, meshes)| Draft {
        file: pose_picture(name),
        role: Role::Pose,
        ..state(view, meshes, ["", &format!("Pose {name}.")], &toward)
    });
    drafts.extend(poses);
    drafts.par_iter().map(Draft::draw).collect()
}

fn items<'a>(view: &NetworkView, meshes: &'a [TriMesh]) -> Vec<Item<'a>> {
    let bodies = view.bodies.iter().zip(meshes);
    bodies
        .map(|(body, mesh)| Item::new(mesh, part_color(body.color)))
        .collect()
}

fn state<'a>(
    view: &NetworkView,
    meshes: &'a [TriMesh],
    [file, caption]: [&str; 2],
    toward: &Vector,
) -> Draft<'a> {
    Draft {
        file: format!("pictures/{file}"),
        role: Role::State,
        caption: caption.to_owned(),
        alt: format!("The figure from the side. {caption}"),
        shot: Shot {
            scene: Scene {
                items: items(view, meshes),
                cut: None,
            },
            camera: Camera::new(*toward, view.up),
            text_px: TEXT_PX,
            labels: Vec::new(),
            keys: Vec::new(),
        },
    }
}

/// Returns the picture with the names of junctures and limbs.
fn named<'a>(view: &'a NetworkView, toward: &Vector) -> Draft<'a> {
    let bodies = view.bodies.iter().enumerate();
    let named = bodies.filter(|(_, body)| body.is_named);
    Draft {
        file: "pictures/names.svg".to_owned(),
        role: Role::Exploded,
        caption: "All out: the junctures (N) and the second shell of every limb.".to_owned(),
        alt: "The open figure with the names of its junctures and limbs.".to_owned(),
        shot: Shot {
            scene: Scene {
                items: items(view, &view.extended),
                cut: None,
            },
            camera: Camera::new(*toward, view.up).with_label_margins(),
            text_px: TEXT_PX,
            labels: named
                .map(|(item, body)| Label::Seen(item, body.id.clone()))
                .collect(),
            keys: Vec::new(),
        },
    }
}

fn of_junctures(view: &NetworkView) -> usize {
    let parts: usize = view.junctures.iter().sum();
    view.bodies.len().saturating_sub(parts)
}

/// Returns the junctures in several parts, each part moved away from the middle of all.
fn divided(view: &NetworkView) -> Vec<Apart> {
    let mut first = of_junctures(view);
    let mut found = Vec::new();
    for &count in &view.junctures {
        let parts = &view.extended[first..first + count];
        if count > 1 {
            let boxes = parts.iter().map(TriMesh::aabb);
            let middle = boxes
                .fold(Aabb::EMPTY, |whole, part| whole.union(&part))
                .center();
            let away = |part: &TriMesh| {
                let way = (part.aabb().center() - middle) * PARTED_RATIO;
                part.map_vertices(|p| p + way)
            };
            found.push(Apart {
                first,
                meshes: parts.iter().map(away).collect(),
            });
        }
        first += count;
    }
    found
}

/// Returns the picture of the parts of one juncture.
fn parts_of<'a>(view: &NetworkView, own: &'a Apart, toward: &Vector) -> Draft<'a> {
    let bodies = view.bodies[own.first..].iter().zip(&own.meshes);
    let ids: Vec<&str> = bodies.clone().map(|(body, _)| body.id.as_str()).collect();
    let items = bodies.clone().enumerate();
    let name = ids[0].split('-').next().unwrap_or_default();
    Draft {
        file: format!("pictures/{name}-parts.svg"),
        role: Role::Exploded,
        caption: format!("{} apart, as they are glued.", ids.join(", ")),
        alt: format!("The parts {} apart, with their pins.", ids.join(", ")),
        shot: Shot {
            scene: Scene {
                items: items
                    .map(|(index, (_, mesh))| Item::new(mesh, part_color(index)))
                    .collect(),
                cut: None,
            },
            camera: Camera::new(*toward, view.up).with_label_margins(),
            text_px: TEXT_PX,
            labels: bodies
                .enumerate()
                .map(|(item, (body, _))| Label::On(item, body.id.clone()))
                .collect(),
            keys: Vec::new(),
        },
    }
}

/// Returns the junctures upright beside each other, in rows.
fn stand_apart(view: &NetworkView) -> Vec<TriMesh> {
    let turn = crate::geom::Frame::with_axis(Point::origin(), &view.up);
    let upright = view.extended[of_junctures(view)..].iter();
    let upright: Vec<TriMesh> = upright
        .map(|mesh| mesh.map_vertices(|p| turn.to_local(p)))
        .collect();
    let widest = upright
        .iter()
        .map(|mesh| mesh.aabb().size().max())
        .fold(0.0, f64::max);
    let step = (1.0 + APART_RATIO) * widest;
    let place = |(index, mesh): (usize, &TriMesh)| {
        let (row, column) = (index / A_ROW, index % A_ROW);
        let to = Point::new(step * column as f64, 0.0, -step * row as f64);
        let shift = to - mesh.aabb().center();
        mesh.map_vertices(|p| p + shift)
    };
    upright.iter().enumerate().map(place).collect()
}

/// Returns the picture of the junctures apart.
fn junctures<'a>(view: &NetworkView, apart: &'a [TriMesh]) -> Draft<'a> {
    let bodies = &view.bodies[of_junctures(view)..];
    let items = bodies.iter().zip(apart);
    let side = -Vector::y();
    let toward = crate::draw::view_direction(&side, &Vector::z(), [0.5, 0.35]);
    Draft {
        file: "pictures/junctures.svg".to_owned(),
        role: Role::Exploded,
        caption: "The junctures, as they stand in the open figure.".to_owned(),
        alt: "The junctures beside each other, with their sockets and pegs.".to_owned(),
        shot: Shot {
            scene: Scene {
                items: items
                    .map(|(body, mesh)| Item::new(mesh, part_color(body.color)))
                    .collect(),
                cut: None,
            },
            camera: Camera::new(toward, Vector::z()).with_label_margins(),
            text_px: TEXT_PX,
            labels: bodies
                .iter()
                .enumerate()
                .map(|(item, body)| Label::On(item, body.id.clone()))
                .collect(),
            keys: Vec::new(),
        },
    }
}
