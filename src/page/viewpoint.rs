//! The view of the whole object: the camera and the plane of the cut-away.

use super::subject::Subject;
use crate::draw::{Camera, view_direction};
use crate::geom::{Frame, Plane, Point, Vector};
use crate::mesh::TriMesh;

/// Angles of the viewer to the right of the cut's normal and above the ground, radians. They show
/// depth without foreshortening the cut much.
const TURN_AND_LIFT: [f64; 2] = [0.45, 0.35];

/// The view of the whole object, upright, from the side that shows most of it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Viewpoint {
    /// Camera, a little to the right and above.
    pub camera: Camera,
    /// Plane of the cut-away, through the axis and the wider side.
    pub cut: Plane,
}

impl Viewpoint {
    /// Returns the view of a model whose goal has this frame, with the cut through its middle.
    pub fn of(outer: &TriMesh, frame: &Frame) -> Self {
        let local = outer.in_frame(frame).aabb();
        let size = local.size();
        let normal = if size.x < size.y {
            Vector::x()
        } else {
            -Vector::y()
        };
        let cut = Plane::through(
            &frame.to_model(&local.center()),
            &frame.direction_to_model(&normal),
        );
        let toward = view_direction(&cut.normal, &frame.axis(), TURN_AND_LIFT);
        Self {
            camera: Camera::new(toward, frame.axis()),
            cut,
        }
    }

    /// Returns the view with room for names, and its cut through the axis if there is hardware,
    /// else through the first piece of ballast.
    pub fn through_inserts(self, subject: &Subject) -> Self {
        let rods = (!subject.hardware.is_empty()).then(|| subject.aim.frame().origin);
        let lump = subject.ballast.first();
        let lump = lump.map(|order| Point::from(order.lump.center_mm));
        match rods.or(lump) {
            Some(at) => Self {
                camera: self.camera.with_label_margins(),
                cut: Plane::through(&at, &self.cut.normal),
            },
            None => self,
        }
    }
}
