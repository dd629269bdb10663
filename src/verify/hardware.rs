//! Hardware in a kit's parts: its mass, and its fit in the sockets.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use crate::base::units::MM3_PER_CM3;
use crate::geom::{Frame, Point, Vector};
use crate::mass::{Moments, RoundBar};
use crate::mesh::{NearAxis, TriMesh, walled_mm, winding_number};

/// Length left out at each end of a rod, mm, since the ends touch the bottoms of their sockets.
const END_MM: f64 = 1e-3;
/// Number of lines along the axis on which the string gap is measured.
const GAP_LINES: usize = 16;
/// Angle of the first line on which the grip is measured, rad: off a model's planes of symmetry.
const GRIP_TURN_RAD: f64 = 0.1;
/// Distance of these lines from the socket as a share of the ordered wall: the middle of the hub.
const GAP_WALL_RATIO: f64 = 0.5;

/// One piece of hardware as the kit declares it: a round bar in its place.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Hardware {
    /// The name on the sheet, such as `H1`.
    pub id: String,
    /// Its kind.
    #[serde(rename = "what")]
    pub kind: HardwareKind,
    /// One end of its axis, model frame, mm.
    pub from_mm: [f64; 3],
    /// The other end, model frame, mm; of a round end the outermost point.
    pub to_mm: [f64; 3],
    /// The outer diameter, mm.
    pub diameter_mm: f64,
    /// The diameter of the hole along it, mm; zero for none.
    pub hole_mm: f64,
    /// True if the end at `to_mm` is a half ball.
    pub round_end: bool,
    /// g/cm³.
    pub density_g_cm3: f64,
    /// Its mass, g.
    pub mass_g: f64,
    /// Its depth in the socket, mm; in each half for an axle.
    pub depth_mm: f64,
    /// The diameter of its socket, mm; zero if it has none.
    pub socket_mm: f64,
}

/// The kind of a piece of hardware; in JSON its key.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "String", into = "String")]
pub enum HardwareKind {
    /// A yo-yo's axle, `axle`.
    Axle,
    /// The fittings on a yo-yo's axle, `ring`.
    Ring,
    /// The tip that a top spins on, `tip`.
    Tip,
    /// The stem that a top is spun by, `stem`.
    Stem,
    /// A dowel; its key is the name of its stock.
    Dowel(String),
}

impl From<String> for HardwareKind {
    fn from(key: String) -> Self {
        match key.as_str() {
            "axle" => Self::Axle,
            "ring" => Self::Ring,
            "tip" => Self::Tip,
            "stem" => Self::Stem,
            _ => Self::Dowel(key),
        }
    }
}

impl From<HardwareKind> for String {
    fn from(kind: HardwareKind) -> Self {
        match kind {
            HardwareKind::Axle => "axle".to_owned(),
            HardwareKind::Ring => "ring".to_owned(),
            HardwareKind::Tip => "tip".to_owned(),
            HardwareKind::Stem => "stem".to_owned(),
            HardwareKind::Dowel(stock) => stock,
        }
    }
}

/// The fit of the hardware in the parts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fit {
    /// The least room between a rod and the surface around it, mm; negative if a rod does not go
    /// in.
    pub room_mm: Option<f64>,
    /// The gap between a yo-yo's halves around their axle, mm; `None` if there is one body.
    pub gap_mm: Option<f64>,
    /// The length over which each half of a yo-yo holds the axle, mm: the shorter of the two.
    /// `None` if there is no axle.
    pub grip_mm: Option<f64>,
}

impl Hardware {
    fn bar(&self) -> RoundBar {
        RoundBar {
            from: Point::from(self.from_mm),
            to: Point::from(self.to_mm),
            radius_mm: 0.5 * self.diameter_mm,
            hole_mm: 0.5 * self.hole_mm,
            is_round: self.round_end,
        }
    }

    /// Returns its moments times its density, g, g·mm and g·mm², model frame.
    fn mass_moments(&self) -> Moments {
        self.bar().moments() * (self.density_g_cm3 / MM3_PER_CM3)
    }
}

/// Returns the moments of all pieces times their densities, g, g·mm and g·mm², model frame.
pub fn mass_moments(hardware: &[Hardware]) -> Moments {
    hardware
        .iter()
        .map(Hardware::mass_moments)
        .fold(Moments::default(), |sum, piece| sum + piece)
}

/// Measures the fit of the pieces in the outer surface (model frame); `None` if there are none. The
/// string gap is measured along z of `goal`, in the middle of a hub with this wall.
pub fn measure_fit(
    hardware: &[Hardware],
    goal: &Frame,
    outer: &TriMesh,
    wall_mm: f64,
) -> Option<Fit> {
    let rooms = hardware.iter().map(|piece| room_mm(&piece.bar(), outer));
    let room_mm = rooms.min_by(f64::total_cmp)?;
    let axle = hardware
        .iter()
        .find(|piece| piece.kind == HardwareKind::Axle);
    let radius_mm = |axle: &Hardware| 0.5 * axle.socket_mm + GAP_WALL_RATIO * wall_mm;
    let gap_mm = axle.and_then(|axle| gap_mm(outer, goal, radius_mm(axle)));
    let grip_mm = axle.map(|axle| grip_mm(axle, goal, outer, radius_mm(axle)));
    Some(Fit {
        room_mm: Some(room_mm),
        gap_mm,
        grip_mm,
    })
}

/// Returns the least distance of the surface from the side of a bar, mm, negative where the surface
/// reaches into the bar. A bar entirely inside the material has minus its radius.
fn room_mm(bar: &RoundBar, outer: &TriMesh) -> f64 {
    let frame = Frame::with_axis(bar.from, &(bar.to - bar.from));
    let middle = nalgebra::center(&bar.from, &bar.to);
    let beside = middle + frame.axes.column(0) * (0.5 * (bar.radius_mm + bar.hole_mm));
    if winding_number(outer, &beside).abs() > 0.5 {
        return -bar.radius_mm;
    }
    let ends_mm = [END_MM, bar.length_mm() - END_MM];
    let off_axis = outer.iter_corners().filter_map(|corners| {
        distance_from_axis(&clip_between(
            corners.map(|p| frame.to_local(&p).coords),
            ends_mm,
        ))
    });
    off_axis.fold(f64::INFINITY, f64::min) - bar.radius_mm
}

/// Returns the corners of the part of a triangle between two heights (Sutherland and Hodgman,
/// 1974).
fn clip_between(corners: [Vector; 3], [low_mm, high_mm]: [f64; 2]) -> Vec<Vector> {
    let above = clip(&corners, |p| p.z - low_mm);
    clip(&above, |p| high_mm - p.z)
}

/// Clips a polygon to the region where a linear height is not negative.
fn clip(polygon: &[Vector], height: impl Fn(&Vector) -> f64) -> Vec<Vector> {
    let mut kept = Vec::new();
    for (i, p) in polygon.iter().enumerate() {
        let next = &polygon[(i + 1) % polygon.len()];
        let (here, there) = (height(p), height(next));
        if here >= 0.0 {
            kept.push(*p);
        }
        if (here >= 0.0) != (there >= 0.0) {
            kept.push(p + (next - p) * (here / (here - there)));
        }
    }
    kept
}

/// Returns the distance of a polygon from the z axis, mm; `None` for an empty polygon.
fn distance_from_axis(polygon: &[Vector]) -> Option<f64> {
    let sides = || polygon.iter().zip(polygon.iter().cycle().skip(1));
    let turns = |sign: f64| sides().all(|(p, q)| sign * (p.x * q.y - p.y * q.x) > 0.0);
    if !polygon.is_empty() && (turns(1.0) || turns(-1.0)) {
        return Some(0.0);
    }
    let to_side = |(p, q): (&Vector, &Vector)| {
        let (start, along) = (p.xy(), q.xy() - p.xy());
        let length = along.norm_squared();
        let share = if length > 0.0 {
            (-start.dot(&along) / length).clamp(0.0, 1.0)
        } else {
            0.0
        };
        (start + along * share).norm()
    };
    sides().map(to_side).min_by(f64::total_cmp)
}

/// Returns the length of an axle that each half surrounds, mm: of the shorter one. The halves are
/// felt on lines at this radius.
fn grip_mm(axle: &Hardware, goal: &Frame, outer: &TriMesh, radius_mm: f64) -> f64 {
    let lines = NearAxis::new(outer, goal, radius_mm).ring(GAP_LINES, radius_mm, GRIP_TURN_RAD);
    let ends = [axle.from_mm, axle.to_mm].map(|end| goal.to_local(&Point::from(end)).z);
    let sides = [[0.0, ends[0].max(ends[1])], [ends[0].min(ends[1]), 0.0]];
    let grips = sides.map(|side| walled_mm(&lines, side));
    grips[0].min(grips[1])
}

/// Returns the least distance between the halves along the axis, mm, on lines at this radius around
/// it. `None` if no line meets both halves.
fn gap_mm(outer: &TriMesh, frame: &Frame, radius_mm: f64) -> Option<f64> {
    let local: Vec<[Vector; 3]> = outer
        .iter_corners()
        .map(|corners| corners.map(|p| frame.to_local(&p).coords))
        .collect();
    let on_line = |i: usize| {
        let (sin, cos) = (TAU * (i as f64 + 0.5) / GAP_LINES as f64).sin_cos();
        let at = Vector::new(radius_mm * cos, radius_mm * sin, 0.0);
        let heights = local
            .iter()
            .filter_map(|corners| height_on_line(corners, &at));
        let [above, below] =
            heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[above, below], z| {
                if z >= 0.0 {
                    [above.min(z), below]
                } else {
                    [above, below.max(z)]
                }
            });
        above - below
    };
    (0..GAP_LINES)
        .map(on_line)
        .min_by(f64::total_cmp)
        .filter(|gap| gap.is_finite())
}

/// Returns the height at which the vertical line through a point meets a triangle, if it does.
fn height_on_line(corners: &[Vector; 3], at: &Vector) -> Option<f64> {
    let [a, b, c] = corners.map(|corner| corner - at);
    let cross = |p: &Vector, q: &Vector| p.x * q.y - p.y * q.x;
    let weights = [cross(&b, &c), cross(&c, &a), cross(&a, &b)];
    let area: f64 = weights.iter().sum();
    let holds = area != 0.0 && weights.iter().all(|w| w * area.signum() >= 0.0);
    holds.then(|| (weights[0] * a.z + weights[1] * b.z + weights[2] * c.z) / area)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::test_meshes::block;

    fn rod(kind: HardwareKind, from_mm: [f64; 3], to_mm: [f64; 3]) -> Hardware {
        Hardware {
            id: "H1".into(),
            kind,
            from_mm,
            to_mm,
            diameter_mm: 2.0,
            hole_mm: 0.0,
            round_end: false,
            density_g_cm3: 8.0,
            mass_g: 0.0,
            depth_mm: 1.0,
            socket_mm: 2.2,
        }
    }

    /// Returns two blocks of 10 × 10 × 5 mm, 3 mm apart.
    fn blocks() -> TriMesh {
        block(Point::new(-5.0, -5.0, 1.5), [10.0, 10.0, 5.0])
            .joined(&block(Point::new(-5.0, -5.0, -6.5), [10.0, 10.0, 5.0]))
    }

    #[test]
    fn a_kind_reads_back_from_its_key() {
        for key in ["axle", "ring", "tip", "stem", "filament-1.75"] {
            let kind = HardwareKind::from(key.to_owned());
            let is_dowel = matches!(kind, HardwareKind::Dowel(_));
            assert_eq!(serde_json::to_value(&kind).unwrap(), key);
            assert_eq!(is_dowel, key == "filament-1.75");
        }
    }

    #[test]
    fn the_gap_between_two_blocks_is_their_distance() {
        let goal = Frame::identity();
        let axle = rod(HardwareKind::Axle, [0.0, 0.0, -1.4], [0.0, 0.0, 1.4]);
        let fit = measure_fit(&[axle], &goal, &blocks(), 1.0).unwrap();
        assert!((fit.gap_mm.unwrap() - 3.0).abs() < 1e-12);
        // Between the faces the rod is in the open: nothing lies beside it.
        assert_eq!(fit.room_mm, Some(f64::INFINITY));
    }

    #[test]
    fn a_rod_has_the_room_that_the_wall_beside_it_leaves() {
        let tip = |from_mm, to_mm| rod(HardwareKind::Tip, from_mm, to_mm).bar();
        let beside = |x: f64| room_mm(&tip([x, 0.0, -3.0], [x, 0.0, 9.0]), &blocks());
        assert!((beside(7.5) - 1.5).abs() < 1e-12);
        assert!((beside(5.4) + 0.6).abs() < 1e-12);
        let within = tip([0.0, 0.0, 2.0], [0.0, 0.0, 4.0]);
        assert_eq!(room_mm(&within, &blocks()), -1.0);
    }

    #[test]
    fn a_triangle_about_the_axis_touches_it_and_one_beside_it_does_not() {
        let about = [
            Vector::new(-1.0, -1.0, 0.0),
            Vector::new(2.0, -1.0, 0.0),
            Vector::new(0.0, 2.0, 0.0),
        ];
        assert_eq!(distance_from_axis(&about), Some(0.0));
        let moved = about.map(|p| p + Vector::new(0.0, 3.0, 0.0));
        assert!((distance_from_axis(&moved).unwrap() - 2.0).abs() < 1e-12);
    }
}
