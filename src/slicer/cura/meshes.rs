//! The meshes of a plate as files that the engine loads, each with its settings.

use std::fs;

use super::words::{Pair, of_blocker, of_object, of_region};
use crate::geom::{Point, Vector};
use crate::io::stl;
use crate::io::threemf::PlateObject;
use crate::mesh::{Csg, TriMesh, primitives::cuboid, shells};
use crate::slicer::error::SlicerError;
use crate::slicer::run::Work;

/// Layers by which a blocker of support reaches beyond the surface that it keeps free. The engine
/// blocks support by the layer that needs it, which is the one above.
const BEYOND_LAYERS: f64 = 2.0;

/// A mesh that the engine loads.
#[derive(Debug)]
pub(super) struct Mesh {
    /// Its file in the folder, which is its name in the toolpaths.
    pub file: String,
    /// The name of the object that it belongs to.
    pub object: String,
    /// Its settings.
    pub settings: Vec<Pair>,
}

/// Writes the meshes of a plate: after each body its regions, the outermost first, and the meshes
/// that keep support away from it.
///
/// # Errors
/// A file cannot be written, or a pattern is not one of Cura's.
pub(super) fn write(objects: &[PlateObject], work: &Work) -> Result<Vec<Mesh>, SlicerError> {
    let mut meshes = Vec::new();
    for (number, object) in objects.iter().enumerate() {
        let mut add = |file: String, mesh: &TriMesh, settings| {
            save(work, &file, mesh)?;
            meshes.push(Mesh {
                file,
                object: object.name.clone(),
                settings,
            });
            Ok::<(), SlicerError>(())
        };
        add(format!("{number}.stl"), &object.outside, of_object(object))?;
        for (index, region) in object.regions.iter().enumerate() {
            let settings = of_region(region, index + 1, work.settings.line_mm())?;
            add(
                format!("{number}-region{index}.stl"),
                &region.mesh,
                settings,
            )?;
        }
        for (index, blocker) in blockers(object, work).iter().enumerate() {
            add(format!("{number}-free{index}.stl"), blocker, of_blocker())?;
        }
    }
    Ok(meshes)
}

/// Writes a mesh. The engine takes places from the middle of the plate.
fn save(work: &Work, file: &str, mesh: &TriMesh) -> Result<(), SlicerError> {
    let [width_mm, depth_mm, _] = work.settings.room_mm();
    let middle = Vector::new(0.5 * width_mm, 0.5 * depth_mm, 0.0);
    let bytes = stl::encode(&mesh.map_vertices(|p| p - middle), file);
    fs::write(work.file(file), bytes).map_err(SlicerError::Folder)
}

/// Returns a mesh around each connected piece of surface that gets no support.
fn blockers(object: &PlateObject, work: &Work) -> Vec<TriMesh> {
    let mesh = &object.outside;
    let all = mesh.triangles();
    let blocked = object.blocked.iter();
    let blocked = blocked.filter_map(|at| all.get(*at).copied());
    let surface = TriMesh::new(mesh.vertices().to_vec(), blocked.collect());
    let pieces = surface.map_or_else(|_| Vec::new(), |surface| shells(&surface));
    let [line_mm, layer_mm] = [work.settings.line_mm(), work.settings.layer_mm()];
    let beyond = Vector::new(line_mm, line_mm, BEYOND_LAYERS * layer_mm);
    pieces.iter().map(|piece| wrap(piece, &beyond)).collect()
}

/// Returns the convex hull of a surface, larger by a box on all sides.
fn wrap(surface: &TriMesh, beyond: &Vector) -> TriMesh {
    let sides = [-1.0, 1.0];
    let corners = sides.into_iter().flat_map(|x| {
        sides.into_iter().flat_map(move |y| {
            let corner = move |z| beyond.component_mul(&Vector::new(x, y, z));
            sides.into_iter().map(corner)
        })
    });
    let corners: Vec<Vector> = corners.collect();
    let points = surface.vertices().iter();
    let points = points.flat_map(|p| corners.iter().map(move |corner| p + corner));
    let points: Vec<Point> = points.collect();
    let hull = Csg::convex_hull(&points).and_then(|hull| hull.to_mesh());
    hull.unwrap_or_else(|_| {
        let room = surface.aabb();
        cuboid(&(room.min - beyond), &(room.max + beyond))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::slicer::run::tests::work;

    #[test]
    fn each_piece_of_surface_without_support_has_a_blocker_of_its_own() {
        let low = cuboid(&Point::origin(), &Point::new(10.0, 10.0, 10.0));
        let high = low.map_vertices(|p| p + Vector::new(30.0, 0.0, 0.0));
        let object = PlateObject {
            name: "P01".to_owned(),
            outside: low.joined(&high),
            perimeters: 2,
            overhang_deg: None,
            brim_mm: None,
            regions: Vec::new(),
            // Two triangles of a side of each.
            blocked: vec![0, 1, 12, 13],
        };
        let found = work(|work| blockers(&object, work));
        assert_eq!(found.len(), 2);
        for (piece, x) in found.iter().zip([0.0, 30.0]) {
            assert!(piece.signed_volume_mm3() > 0.0);
            let room = piece.aabb();
            assert!(room.min.x >= x - 1.0 && room.max.x <= x + 11.0, "{room:?}");
        }
    }

    #[test]
    fn regions_follow_their_body_in_their_order() {
        use crate::io::threemf::SparseRegion;
        let mesh = cuboid(&Point::origin(), &Point::new(10.0, 10.0, 10.0));
        let region = |percent| SparseRegion {
            mesh: mesh.clone(),
            pattern: "gyroid".to_owned(),
            percent,
        };
        let object = PlateObject {
            name: "a \"part\"".to_owned(),
            outside: mesh.clone(),
            perimeters: 2,
            overhang_deg: None,
            brim_mm: None,
            regions: vec![region(30.0), region(15.0)],
            blocked: Vec::new(),
        };
        let written = work(|work| {
            let written = write(&[object], work).unwrap();
            assert!(written.iter().all(|mesh| work.file(&mesh.file).is_file()));
            written
        });
        let files: Vec<&str> = written.iter().map(|mesh| mesh.file.as_str()).collect();
        assert_eq!(files, ["0.stl", "0-region0.stl", "0-region1.stl"]);
        assert!(written.iter().all(|mesh| mesh.object == "a \"part\""));
        let order = ("infill_mesh_order".to_owned(), "2".to_owned());
        assert!(written[2].settings.contains(&order));
    }
}
