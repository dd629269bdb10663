//! A scene to draw: meshes with their colours, an optional cut, and the camera.

use super::hatch::Hatch;
use super::palette::Color;
use crate::geom::{Plane, Vector};
use crate::mesh::TriMesh;

/// Width and height of a picture, pixels: sharp at half the width of an A4 page, small enough for
/// an e-mail.
const SIZE_PX: [usize; 2] = [720, 560];
/// Share of a picture's width left free on either side for names.
const LABEL_RATIO: f64 = 0.12;

/// A mesh to draw and its colour.
#[derive(Debug, Clone, Copy)]
pub struct Item<'a> {
    /// The triangles; their outward side is lit.
    pub mesh: &'a TriMesh,
    /// The colour of a face turned to the lamp.
    pub color: Color,
    /// The displacement of the mesh in the picture, mm.
    pub shift: Vector,
    /// The filling of its cut face.
    pub hatch: Hatch,
}

impl<'a> Item<'a> {
    /// Returns a printed mesh, drawn in its place.
    pub fn new(mesh: &'a TriMesh, color: Color) -> Self {
        Self {
            mesh,
            color,
            shift: Vector::zeros(),
            hatch: Hatch::PRINTED,
        }
    }
}

/// The meshes of a picture, and the plane that cuts them open.
#[derive(Debug, Clone, Default)]
pub struct Scene<'a> {
    /// The meshes; together they bound solids.
    pub items: Vec<Item<'a>>,
    /// The cut: everything on the positive side of this plane is taken away, and the cut face is
    /// hatched.
    pub cut: Option<Plane>,
}

/// A parallel projection that shows all of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// From the scene to the viewer, a unit vector.
    pub toward_viewer: Vector,
    /// The direction that points up in the picture; not parallel to the view.
    pub up: Vector,
    /// Width and height of the picture, pixels.
    pub size_px: [usize; 2],
    /// Shares of the picture left free for names: at the left and right, and above and below. A
    /// small margin is always kept.
    pub margin_ratio: [f64; 2],
}

impl Camera {
    /// Returns a camera for pictures of the whole, without room for names.
    pub fn new(toward_viewer: Vector, up: Vector) -> Self {
        Self {
            toward_viewer,
            up,
            size_px: SIZE_PX,
            margin_ratio: [0.0; 2],
        }
    }

    /// Returns the same camera with room for names at the left and right.
    #[must_use]
    pub fn with_label_margins(self) -> Self {
        Self {
            margin_ratio: [LABEL_RATIO, 0.0],
            ..self
        }
    }
}

/// Returns the direction to a viewer who faces `normal` from `turn` radians to the right and `lift`
/// radians above.
pub fn view_direction(normal: &Vector, up: &Vector, [turn, lift]: [f64; 2]) -> Vector {
    let right = up.cross(normal);
    (normal * turn.cos() + right * turn.sin()) * lift.cos() + up * lift.sin()
}
