//! How the whole is looked at.

use super::subject::Subject;
use crate::draw::{Camera, LABEL_RATIO, camera, turned};
use crate::geom::{Frame, Plane, Point, Vector};
use crate::mesh::TriMesh;

/// How far the viewer stands to the right of the cut's normal and above the ground, radians: enough
/// to tell depth from shape, not so much that the cut is foreshortened.
const TURN: f64 = 0.45;

const LIFT: f64 = 0.35;

/// How the model is looked at: upright, from the side that shows most of it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Viewpoint {
    /// From a little to the right and above.
    pub camera: Camera,
    /// The plane of the cut-away, through the axis and the wider side.
    pub cut: Plane,
}

impl Viewpoint {
    pub fn of(outer: &TriMesh, frame: &Frame) -> Self {
        let local = outer.in_frame(frame).aabb();
        let size = local.size();
        // The cut holds the axis and the wider side.
        let normal = if size.x < size.y {
            Vector::x()
        } else {
            -Vector::y()
        };
        let cut = Plane::through(
            &frame.to_model(&local.center()),
            &frame.direction_to_model(&normal),
        );
        let toward = turned(&cut.normal, &frame.axis(), [TURN, LIFT]);
        Self {
            camera: camera(toward, frame.axis()),
            cut,
        }
    }

    /// The same with its cut through what is not printed: through the axis where there is hardware
    /// on it, else through the first piece of ballast.
    pub fn through(self, subject: &Subject) -> Self {
        let rods = (!subject.hardware.is_empty()).then(|| subject.aim.frame().origin);
        let lump = subject
            .ballast
            .first()
            .map(|order| Point::from(order.lump.center_mm));
        let cut = rods
            .or(lump)
            .map_or(self.cut, |at| Plane::through(&at, &self.cut.normal));
        let margin_ratio = [
            if rods.or(lump).is_some() {
                LABEL_RATIO
            } else {
                0.0
            },
            0.0,
        ];
        Self {
            camera: Camera {
                margin_ratio,
                ..self.camera
            },
            cut,
        }
    }
}
