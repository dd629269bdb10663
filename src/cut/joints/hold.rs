//! The hold of pins on a joint: their play, and the step that it leaves at the rim.

use crate::{
    cut::{
        geometry::chart::{Chart, Point2},
        joints::{pin_shape::PinSite, pin_size::Size},
        pieces::split::Joint,
        request::PinSettings,
    },
    geom::{
        Plane, Point,
        play::{Play, Stop, corners_of, extent_mm, step_bound_mm},
    },
};

/// Share of the accepted step that is kept in reserve. A judge turns the polygon around a pin's
/// circle, which makes 0.2 %, and sees a rim that is rounded to a file.
const RESERVE_RATIO: f64 = 0.003;

/// The rim of a joint, in the coordinates of its plane.
pub(crate) struct Rim {
    /// The corners of its convex hull.
    corners: Vec<Point2>,
    /// The least distance of the farthest pins, mm.
    least_spread_mm: f64,
    /// The largest step that is accepted, less a reserve, mm.
    max_step_mm: f64,
}

impl Rim {
    /// Returns the rim of a joint, to be held by these rules.
    pub(crate) fn of(joint: &Joint, rules: &PinSettings) -> Self {
        let faces = joint.faces.iter();
        let corners = corners_of(faces.flat_map(|face| face.outline.corners()));
        Self {
            least_spread_mm: rules.spread_ratio * extent_mm(&corners),
            corners,
            max_step_mm: rules.max_step_mm.unwrap_or(f64::INFINITY) * (1.0 - RESERVE_RATIO),
        }
    }

    /// Returns true if pins of these sizes are far enough apart and leave no larger step than is
    /// accepted. Never true for pins that leave a larger one.
    pub(crate) fn is_held_by(&self, pattern: &[(Point2, Size)]) -> bool {
        let places: Vec<Point2> = pattern.iter().map(|(at, _)| *at).collect();
        let rooms = pattern.iter().map(|(_, size)| size.room_to_move_mm());
        let step_mm = || step_bound_mm(&places, rooms.fold(0.0, f64::max), &self.corners);
        self.is_spread(&places) && step_mm() <= self.max_step_mm
    }

    /// Returns true if some two pins are far enough apart.
    fn is_spread(&self, places: &[Point2]) -> bool {
        places.len() >= 2 && extent_mm(places) >= self.least_spread_mm
    }

    /// Measures what pins leave that stand in the joint's plane.
    pub(crate) fn measure(&self, plane: &Plane, pins: &[PinSite]) -> Hold {
        let chart = Chart::of_plane(plane);
        let flat = |pin: &PinSite| chart.flat(&Point::from(pin.center_mm));
        let places: Vec<Point2> = pins.iter().map(flat).collect();
        let rooms = pins.iter().map(PinSite::room_to_move_mm);
        let stops = places.iter().zip(rooms);
        let stops: Vec<Stop> = stops
            .flat_map(|(at, room_mm)| Stop::around(*at, room_mm))
            .collect();
        let play = Play::of(&stops, &self.corners);
        let keeps = |play: Play| play.step_mm <= self.max_step_mm;
        Hold {
            play,
            is_enough: play.is_some_and(keeps) && self.is_spread(&places),
        }
    }
}

/// The hold of a joint's pins.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Hold {
    /// Their play; `None` if they leave a turn free.
    pub(crate) play: Option<Play>,
    /// True if the step is accepted and the pins are far enough apart.
    pub(crate) is_enough: bool,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_pins_around_a_round_joint_hold_it_where_two_across_it_do_not() {
        let around = |radius_mm: f64, count: usize| {
            let place = |index: usize| {
                let (sin, cos) = (std::f64::consts::TAU * index as f64 / count as f64).sin_cos();
                Point2::new(cos, sin) * radius_mm
            };
            (0..count).map(place).collect::<Vec<Point2>>()
        };
        // Half of a sphere on a laser sinter machine with pixels of 0.247 mm.
        let size = Size {
            diameter: 2.223,
            length: 2.75,
            chamfer: 0.4,
            socket_diameter: 2.964,
            depth: 3.3,
            dowel: None,
        };
        let rim = Rim {
            corners: around(24.6, 60),
            least_spread_mm: 49.2 / 3.0,
            max_step_mm: 0.5,
        };
        let is_held = |count: usize| {
            let pins = around(21.0, count).into_iter().map(|at| (at, size));
            rim.is_held_by(&pins.collect::<Vec<_>>())
        };
        // An independent search over shifts and turns finds 0.469 mm for three, 0.571 mm for two.
        assert!(!is_held(2) && is_held(3));
    }
}
