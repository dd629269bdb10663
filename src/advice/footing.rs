//! The faces a model can stand on: those of its convex hull.

use super::directions::{is_new, nearly_words, round_direction, with_axis};
use super::remedy::{Change, Kind, Remedy};
use super::sampled_model::{SampledModel, Trial};
use crate::base::setting::{Key, Setting};
use crate::geom::{Point, Vector};
use crate::goal::Up;
use crate::mesh::{Csg, TriMesh};

/// The greatest number of faces that are tried, the largest first. The hull of a scan has
/// thousands, but nothing stands on a sliver.
const MOST_FACES: usize = 48;
/// The smallest face to stand on, as a part of the model's longest side squared.
const LEAST_AREA_RATIO: f64 = 1e-3;
/// Faces whose normals differ by less than this are one: cos 2°. The support is taken from all
/// vertices near the floor anyway.
const SAME_FACE_COSINE: f64 = 0.9994;

/// Returns the up directions of a solid that rests on a face of its convex hull, the largest face
/// first. They are rounded to the decimals they are printed with.
pub(super) fn resting_directions(mesh: &TriMesh) -> Vec<Vector> {
    let Ok(hull) = Csg::convex_hull(mesh.vertices()).and_then(|hull| hull.to_mesh()) else {
        return Vec::new();
    };
    let least_mm2 = LEAST_AREA_RATIO * mesh.longest_side_mm().powi(2);
    let mut faces: Vec<(f64, Vector)> = merge_faces(&hull);
    faces.retain(|(area_mm2, _)| *area_mm2 >= least_mm2);
    faces.sort_by(|a, b| b.0.total_cmp(&a.0));
    faces.truncate(MOST_FACES);
    faces
        .into_iter()
        .map(|(_, normal)| round_direction(&-normal))
        .collect()
}

/// Returns the area and the outward normal of each face, triangles of nearly one normal taken
/// together.
fn merge_faces(hull: &TriMesh) -> Vec<(f64, Vector)> {
    let doubled = |[a, b, c]: [Point; 3]| (b - a).cross(&(c - a));
    let mut triangles: Vec<Vector> = hull.iter_corners().map(doubled).collect();
    triangles.sort_by(|a, b| b.norm().total_cmp(&a.norm()));
    let mut faces: Vec<Vector> = Vec::new();
    for triangle in triangles.into_iter().filter(|normal| normal.norm() > 0.0) {
        let is_on =
            |face: &&mut Vector| face.normalize().dot(&triangle.normalize()) > SAME_FACE_COSINE;
        match faces.iter_mut().find(is_on) {
            Some(face) => *face += triangle,
            None => faces.push(triangle),
        }
    }
    faces
        .into_iter()
        .map(|face| (0.5 * face.norm(), face.normalize()))
        .collect()
}

/// Returns the nearest face on which the model stands as firmly as is promised, by the angle by
/// which it is turned.
pub(super) fn remedy(model: &SampledModel, up: &Vector) -> Remedy {
    let mut faces = resting_directions(model.case.solid.mesh());
    faces.retain(|face| is_new(&[*up], face, SAME_FACE_COSINE));
    faces.sort_by(|a, b| b.dot(up).total_cmp(&a.dot(up)));
    let found = faces
        .into_iter()
        .find_map(|face| Some((face, trial(model, &face)?)));
    let Some((face, trial)) = found else {
        return Remedy::dead_end(Kind::NearestFace, "other faces to stand on".to_owned());
    };
    let angle_deg = face.angle(up).to_degrees();
    let nearly = nearly_words(&face);
    let nearly = nearly.map_or(String::new(), |axis| format!(", with {axis} up"));
    let words = format!("turn it by {angle_deg:.1}° onto another face{nearly}");
    let change = Change {
        amount: angle_deg,
        settings: vec![Setting::new(Key::Up, Up::Along(face.into()))],
        words,
    };
    Remedy::helping(Kind::NearestFace, change, &trial)
}

/// Returns the confirming solve for a face on which the model stands as firmly as is promised.
fn trial(model: &SampledModel, face: &Vector) -> Option<Trial> {
    let (request, wall_mm) = (with_axis(&model.case.request, face), model.case.wall_mm);
    if !model.allows(&request, wall_mm) {
        return None;
    }
    model.confirm(&request, wall_mm)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::primitives::{cuboid, cylinder};

    #[test]
    fn a_box_rests_on_its_six_faces_the_largest_first() {
        let faces = resting_directions(&cuboid(&Point::origin(), &Point::new(3.0, 2.0, 1.0)));
        assert_eq!(faces.len(), 6);
        for (pair, axis) in faces.chunks(2).zip([2, 1, 0]) {
            assert!(
                (pair[0][axis].abs(), pair[1][axis]) == (1.0, -pair[0][axis]),
                "{pair:?}"
            );
        }
    }

    #[test]
    fn a_round_prism_rests_on_its_ends_before_its_sides() {
        // Radius 5, height 2, 24 sides of 13 mm² each: the ends have 78 mm².
        let faces = resting_directions(&cylinder(5.0, 2.0, 24));
        assert_eq!(faces.len(), 26);
        assert!(faces[..2].iter().all(|up| up.z.abs() == 1.0) && faces[2].z == 0.0);
    }
}
