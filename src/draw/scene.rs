//! What is drawn and from where: meshes with their colours, and the camera.

use super::hatch::Hatch;
use super::palette::Color;
use crate::geom::{Plane, Vector};
use crate::mesh::TriMesh;

/// Width and height of a picture, pixels: sharp at half the width of an A4 page, small enough to
/// mail.
const SIZE_PX: [usize; 2] = [720, 560];

/// The share of a picture left free for words at its sides.
pub const LABEL_RATIO: f64 = 0.12;

/// A mesh to draw and its colour.
#[derive(Debug, Clone, Copy)]
pub struct Item<'a> {
    /// The triangles; their outward side is lit.
    pub mesh: &'a TriMesh,
    /// The colour of a face turned to the lamp.
    pub color: Color,
    /// Where it is moved to for the picture, mm.
    pub shift: Vector,
    /// What it is filled with where it is cut.
    pub hatch: Hatch,
}

/// What is drawn.
#[derive(Debug, Clone, Default)]
pub struct Scene<'a> {
    /// The meshes, solids together.
    pub items: Vec<Item<'a>>,
    /// What is cut away: everything on the positive side of the plane; the cut itself is hatched.
    pub cut: Option<Plane>,
}

/// A parallel projection that shows all of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// From the scene to the viewer, a unit vector.
    pub toward_viewer: Vector,
    /// What points up in the picture; not parallel to the view.
    pub up: Vector,
    /// Width and height of the picture, pixels.
    pub size_px: [usize; 2],
    /// The share of the picture left free for words at the left and the right, and above and below;
    /// never less than a little.
    pub margin_ratio: [f64; 2],
}

/// A camera for pictures of the whole, without room for words.
pub fn camera(toward_viewer: Vector, up: Vector) -> Camera {
    Camera {
        toward_viewer,
        up,
        size_px: SIZE_PX,
        margin_ratio: [0.0; 2],
    }
}

/// The same with room for words at its sides.
pub fn labelled_camera(toward_viewer: Vector, up: Vector) -> Camera {
    Camera {
        margin_ratio: [LABEL_RATIO, 0.0],
        ..camera(toward_viewer, up)
    }
}

/// The direction to a viewer who faces `normal` from `turn` radians to the right and `lift` radians
/// above.
pub fn turned(normal: &Vector, up: &Vector, [turn, lift]: [f64; 2]) -> Vector {
    let right = up.cross(normal);
    (normal * turn.cos() + right * turn.sin()) * lift.cos() + up * lift.sin()
}

pub fn still(mesh: &TriMesh, color: Color) -> Item<'_> {
    Item {
        mesh,
        color,
        shift: Vector::zeros(),
        hatch: Hatch::PRINTED,
    }
}
