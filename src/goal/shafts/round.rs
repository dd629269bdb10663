//! The part of a cylinder that a mesh covers all around.

use std::f64::consts::{PI, TAU};
use std::fmt;

use super::cylinder::Cylinder;
use crate::geom::{Point, Vector};
use crate::mesh::TriMesh;

/// Triangles within this share of the radius belong to it: corners of a prism of ten sides do.
const NEAR_RATIO: f64 = 0.08;
/// The cells around and along in which the covered part is marked.
const AROUND: usize = 24;
const ALONG: usize = 24;
/// A gap of so many slabs is a groove, and not the end of a round part.
const MOST_GAP: usize = 1;
/// The share of the turn that must be covered: a keyway or an oil hole may break it.
const LEAST_AROUND: usize = AROUND * 3 / 4;
/// The least round length, in diameters. A bearing sits in a bore as thin as a tenth; a shaft end
/// shorter than half is a disc.
const LEAST_BORE: f64 = 0.1;
const LEAST_SHAFT: f64 = 0.5;
/// The greatest root mean square of the slope of the surface along the axis, and of its distance
/// from the cylinder in radii. The bore of a scanned rocker arm slopes by 0.05. A ball, a ring or a
/// neck goes on to the steepest slope that still counts as radial: 0.18 in the mean.
const MOST_SLOPE: f64 = 0.1;
const MOST_OFF_RATIO: f64 = 0.03;
/// A shaft end reaches to within this share of its diameter of the model's end: a chamfer or a
/// round edge.
const END_RATIO: f64 = 0.3;
/// Beside a shaft end the model is no wider than this many radii.
const CLEAR_RADII: f64 = 1.06;

/// The kind of a round surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RoundKind {
    /// A hole, right through or not.
    Bore,
    /// The end of the model itself.
    ShaftEnd,
}

/// A round surface that a rotor can turn on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoundSurface {
    /// The kind.
    pub kind: RoundKind,
    /// The diameter, mm.
    pub diameter_mm: f64,
    /// The length over which it is round, mm.
    pub length_mm: f64,
    /// The middle of its axis, model frame, mm.
    pub middle: Point,
}

impl fmt::Display for RoundSurface {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let what = match self.kind {
            RoundKind::Bore => "bore",
            RoundKind::ShaftEnd => "shaft end",
        };
        let (diameter_mm, length_mm) = (self.diameter_mm, self.length_mm);
        write!(
            f,
            "{what} of {diameter_mm:.1} mm diameter, {length_mm:.1} mm long"
        )
    }
}

/// A cylinder with the part of it that is round.
pub(super) struct Measured {
    pub cylinder: Cylinder,
    pub surface: RoundSurface,
    /// The area of the round part, mm².
    pub round_mm2: f64,
}

/// Measures the parts of a cylinder that the mesh covers all around: its bores, or shaft ends.
pub(super) fn measure(mesh: &TriMesh, cylinder: &Cylinder) -> Vec<Measured> {
    let corners: Vec<[Point; 3]> = mesh
        .iter_corners()
        .filter(|corners| is_on(cylinder, corners))
        .collect();
    if !is_true(cylinder, &corners) {
        return Vec::new();
    }
    let ends_mm = ends_mm(cylinder, corners.iter().flatten());
    let parts = round_parts_mm(cylinder, &corners, ends_mm).into_iter();
    let kept = parts.filter(|part_mm| is_kept(mesh, cylinder, *part_mm));
    kept.map(|part_mm| Measured::of(cylinder, part_mm))
        .collect()
}

impl Measured {
    fn of(cylinder: &Cylinder, [low_mm, high_mm]: [f64; 2]) -> Self {
        let (diameter_mm, length_mm) = (2.0 * cylinder.radius_mm, high_mm - low_mm);
        let surface = RoundSurface {
            kind: if cylinder.is_bore {
                RoundKind::Bore
            } else {
                RoundKind::ShaftEnd
            },
            diameter_mm,
            length_mm,
            middle: cylinder.point + cylinder.axis * (0.5 * (low_mm + high_mm)),
        };
        Self {
            cylinder: *cylinder,
            surface,
            round_mm2: PI * diameter_mm * length_mm,
        }
    }
}

/// Returns true if a round part is long enough, and of a shaft stands clear.
fn is_kept(mesh: &TriMesh, cylinder: &Cylinder, [low_mm, high_mm]: [f64; 2]) -> bool {
    let (diameter_mm, length_mm) = (2.0 * cylinder.radius_mm, high_mm - low_mm);
    if cylinder.is_bore {
        length_mm >= LEAST_BORE * diameter_mm
    } else {
        length_mm >= LEAST_SHAFT * diameter_mm && is_end(mesh, cylinder, [low_mm, high_mm])
    }
}

fn is_on(cylinder: &Cylinder, corners: &[Point; 3]) -> bool {
    let [a, b, c] = corners;
    let normal = (b - a).cross(&(c - a)).try_normalize(0.0);
    normal.is_some_and(|normal| {
        corners.iter().all(|corner| is_near(cylinder, corner))
            && cylinder.holds(&center(corners), &normal, NEAR_RATIO)
    })
}

fn is_near(cylinder: &Cylinder, corner: &Point) -> bool {
    let distance_mm = cylinder.across(corner).norm();
    (distance_mm - cylinder.radius_mm).abs() <= NEAR_RATIO * cylinder.radius_mm
}

fn center([a, b, c]: &[Point; 3]) -> Point {
    Point::from((a.coords + b.coords + c.coords) / 3.0)
}

/// Returns true if the surface runs along the axis, and as far from it as the radius.
fn is_true(cylinder: &Cylinder, corners: &[[Point; 3]]) -> bool {
    let (mut area, mut slope, mut off) = (0.0, 0.0, 0.0);
    for triangle in corners {
        let [a, b, c] = triangle;
        let doubled = (b - a).cross(&(c - a));
        let doubled_mm2 = doubled.norm();
        area += doubled_mm2;
        slope += doubled.dot(&cylinder.axis).powi(2) / doubled_mm2.max(f64::MIN_POSITIVE);
        let distance_mm = cylinder.across(&center(triangle)).norm();
        off += doubled_mm2 * (distance_mm / cylinder.radius_mm - 1.0).powi(2);
    }
    area > 0.0 && (slope / area).sqrt() <= MOST_SLOPE && (off / area).sqrt() <= MOST_OFF_RATIO
}

fn ends_mm<'a>(cylinder: &Cylinder, points: impl Iterator<Item = &'a Point>) -> [f64; 2] {
    let heights = points.map(|point| cylinder.height_mm(point));
    heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], height| {
        [low.min(height), high.max(height)]
    })
}

/// Returns the heights between which the surface is round, the lowest part first.
fn round_parts_mm(
    cylinder: &Cylinder,
    corners: &[[Point; 3]],
    [low_mm, high_mm]: [f64; 2],
) -> Vec<[f64; 2]> {
    let slab_mm = (high_mm - low_mm) / ALONG as f64;
    let first = Vector::ith(cylinder.axis.iamin(), 1.0)
        .cross(&cylinder.axis)
        .normalize();
    let second = cylinder.axis.cross(&first);
    let angle = |point: &Point| {
        let across = cylinder.across(point);
        across.dot(&second).atan2(across.dot(&first))
    };
    let mut covered = [[false; AROUND]; ALONG];
    for triangle in corners {
        let [bottom_mm, top_mm] = ends_mm(cylinder, triangle.iter());
        let slab = |height_mm: f64| {
            (((height_mm - low_mm) / slab_mm).floor().max(0.0) as usize).min(ALONG - 1)
        };
        let middle = angle(&center(triangle));
        let turns = triangle.map(|corner| {
            let turn = angle(&corner) - middle;
            turn - TAU * (turn / TAU).round()
        });
        let cell = |turn: f64| ((middle + turn) / TAU * AROUND as f64).floor() as i64;
        let from = cell(turns.into_iter().fold(0.0, f64::min));
        let to = cell(turns.into_iter().fold(0.0, f64::max));
        for row in &mut covered[slab(bottom_mm)..=slab(top_mm)] {
            for at in from..=to {
                row[at.rem_euclid(AROUND as i64) as usize] = true;
            }
        }
    }
    let is_round =
        |row: &[bool; AROUND]| row.iter().filter(|&&is_met| is_met).count() >= LEAST_AROUND;
    let mut parts: Vec<[usize; 2]> = Vec::new();
    for (slab, _) in covered.iter().enumerate().filter(|(_, row)| is_round(row)) {
        match parts.last_mut() {
            Some([_, end]) if slab <= *end + MOST_GAP => *end = slab + 1,
            _ => parts.push([slab, slab + 1]),
        }
    }
    let height_mm = |slab: usize| low_mm + slab as f64 * slab_mm;
    parts.into_iter().map(|part| part.map(height_mm)).collect()
}

/// Returns true if the round part is an end of the model, with nothing beside it.
fn is_end(mesh: &TriMesh, cylinder: &Cylinder, [low_mm, high_mm]: [f64; 2]) -> bool {
    let [least_mm, most_mm] = ends_mm(cylinder, mesh.vertices().iter());
    let middle_mm = 0.5 * (low_mm + high_mm);
    let reach_mm = END_RATIO * 2.0 * cylinder.radius_mm;
    let is_clear = |beyond: &dyn Fn(f64) -> bool| {
        mesh.vertices()
            .iter()
            .filter(|vertex| beyond(cylinder.height_mm(vertex)))
            .all(|vertex| cylinder.across(vertex).norm() <= CLEAR_RADII * cylinder.radius_mm)
    };
    let is_top = high_mm >= most_mm - reach_mm && is_clear(&|height| height > middle_mm);
    let is_bottom = low_mm <= least_mm + reach_mm && is_clear(&|height| height < middle_mm);
    is_top || is_bottom
}
