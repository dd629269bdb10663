//! The poses that are compared: those in which the model rests, and those that its symmetry and its
//! own axes give.

use super::rest::Support;
use super::shape::Shape;
use super::symmetry::Mirror;
use crate::geom::Vector;

/// Faces of the hull whose normals differ by less than this are one face: cos 4°. The feet of a
/// scan are that uneven.
const SAME_FACE_COSINE: f64 = 0.9976;
/// The greatest number of faces that are gathered, and of those the largest that are tried.
const MOST_GATHERED: usize = 400;
const MOST_FACES: usize = 120;
/// The greatest number of poses at rest.
const MOST_RESTS: usize = 40;
/// Corners this near to the floor carry a model, in lengths of the model.
const SLACK_RATIO: f64 = 0.005;
/// Two planes weaker than this give no axis.
const LEAST_STRENGTH_RATIO: f64 = 0.3;
/// The number of strong mirror planes that are crossed.
const MOST_PLANES: usize = 4;
/// Poses nearer than this are one: cos 0.5°.
const SAME_POSE_COSINE: f64 = 0.99996;
/// Poses are steadied by less than this: cos 4°.
const NEAR_COSINE: f64 = 0.9976;
/// The height over the floor of what carries a steadied pose, in lengths of the model: as for a
/// standing object.
const STEADY_SLACK_RATIO: f64 = 0.002;
/// The number of faces of the hull on which a steadied pose may rest.
const MOST_STEADY: usize = 24;
/// A steadier pose must be steadier by this angle, degrees: a level foot is worth keeping level.
const STEADIER_DEG: f64 = 1.0;

/// Returns the poses to compare, as directions up.
pub(super) fn poses(shape: &Shape, mirrors: &[Mirror]) -> Vec<Vector> {
    let mut all = crossings(mirrors);
    all.extend(rests(shape));
    let axes = [Vector::x(), Vector::y(), Vector::z()];
    all.extend(axes.into_iter().flat_map(|axis| [axis, -axis]));
    let mut poses: Vec<Vector> = Vec::new();
    for pose in all {
        if poses
            .iter()
            .all(|known| known.dot(&pose) < SAME_POSE_COSINE)
        {
            poses.push(pose);
        }
    }
    poses
}

/// Returns the lines in which strong mirror planes meet, in both senses: the axis of a vase, the
/// upright of a heart.
fn crossings(mirrors: &[Mirror]) -> Vec<Vector> {
    let is_strong = |mirror: &&Mirror| mirror.strength_ratio > LEAST_STRENGTH_RATIO;
    let strong: Vec<&Mirror> = mirrors.iter().filter(is_strong).take(MOST_PLANES).collect();
    let pairs = strong.iter().enumerate().flat_map(|(i, mirror)| {
        let others = strong[..i].iter();
        others.filter_map(move |other| mirror.normal.cross(&other.normal).try_normalize(1e-3))
    });
    pairs.flat_map(|axis| [axis, -axis]).collect()
}

/// Returns the poses in which the model rests on a face of its convex hull, the largest face first.
fn rests(shape: &Shape) -> Vec<Vector> {
    let mut faces: Vec<Vector> = Vec::new();
    for triangle in &shape.hull_normals {
        let unit = triangle.normalize();
        let is_on = |face: &Vector| face.dot(&unit) > SAME_FACE_COSINE * face.norm();
        match faces.iter().position(is_on) {
            Some(known) => faces[known] += triangle,
            None if faces.len() < MOST_GATHERED => faces.push(*triangle),
            None => {}
        }
    }
    faces.sort_by(|a, b| b.norm_squared().total_cmp(&a.norm_squared()));
    let poses = faces.iter().take(MOST_FACES).map(|face| -face.normalize());
    let slack_mm = SLACK_RATIO * shape.length_mm;
    let rests = |up: &Vector| Support::of(shape, up, slack_mm).topples_at_deg > 0.0;
    poses.filter(rests).take(MOST_RESTS).collect()
}

/// Returns the steadiest pose near one: on a strong mirror plane, or on a face of the hull. A pose
/// in which nothing rests stays as it is.
pub(super) fn steadied(shape: &Shape, up: &Vector, mirrors: &[Mirror]) -> Vector {
    let slack_mm = STEADY_SLACK_RATIO * shape.length_mm;
    let steadiness = |up: &Vector| Support::of(shape, up, slack_mm).topples_at_deg;
    let upright = mirrors
        .iter()
        .map(|mirror| up - mirror.normal * mirror.normal.dot(up));
    let faces = shape.hull_normals.iter().map(|face| -face);
    let near = |direction: Vector| {
        let direction = direction.try_normalize(0.0)?;
        (direction.dot(up) > NEAR_COSINE).then_some(direction)
    };
    let others = upright.filter_map(near);
    let others = others.chain(faces.filter_map(near).take(MOST_STEADY));
    let own = (*up, steadiness(up).max(0.0) + STEADIER_DEG);
    let better = |best: (Vector, f64), other: Vector| {
        let steady_deg = steadiness(&other);
        if steady_deg > best.1 {
            (other, steady_deg)
        } else {
            best
        }
    };
    others.fold(own, better).0
}
