//! The 3MF files of a kit: everything in its place, and the parts on their plates.

use std::path::Path;

use super::evidence::CoreEvidence;
use super::panels::panel_body;
use crate::geom::{Aabb, Vector};
use crate::io::threemf::{PlacedObject, decode_objects};
use crate::mesh::TriMesh;
use crate::verify::{Check, CheckKind, Limit};

/// The beginning of the names of plates.
const PLATE: &str = "plate";
/// The assembly.
const ASSEMBLY: &str = "assembly.3mf";
/// The ending of packages.
const ENDING: &str = ".3mf";
/// By how much a box or the cube root of a volume may differ, mm: single precision, twice.
const SAME_MM: f64 = 2e-3;

/// Checks all packages that a kit lists.
pub fn packages_check(folder: &Path, evidence: &CoreEvidence) -> Check {
    let listed = evidence.promise.files.keys();
    let packages: Vec<&String> = listed.filter(|file| file.ends_with(ENDING)).collect();
    let (mut faults, mut on_plates) = (Vec::new(), Vec::new());
    for file in &packages {
        let bytes = std::fs::read(folder.join(file)).unwrap_or_default();
        match decode_objects(&bytes) {
            Err(error) => faults.push(format!("{file}: {error}")),
            Ok(objects) if file.starts_with(PLATE) => on_plates.extend(objects),
            Ok(objects) if *file == ASSEMBLY => faults.extend(placed_faults(&objects, evidence)),
            Ok(_) => faults.push(format!("{file} is none of this kit's packages")),
        }
    }
    if !packages.iter().any(|file| *file == ASSEMBLY) {
        faults.push(format!("{ASSEMBLY} is missing"));
    }
    faults.extend(plate_faults(&on_plates, evidence));
    let check = Check::new(
        CheckKind::Packages,
        "every 3MF file holds the parts as they are judged, in their places",
        Some(faults.len() as f64),
        Limit::at_most(0.0, ""),
    );
    check.at((!faults.is_empty()).then(|| faults.join("; ")))
}

/// Returns the faults of the assembly.
fn placed_faults(objects: &[PlacedObject], evidence: &CoreEvidence) -> Vec<String> {
    let parts = evidence.promise.parts.iter().zip(&evidence.parts);
    let parts = parts.map(|(part, mesh)| (part.id.clone(), mesh.clone()));
    let count = evidence.panels.panels.len();
    let panels = (0..count).map(|at| (format!("panel {}", at + 1), panel_body(evidence, at)));
    let wrong = parts.chain(panels).filter(|(name, mesh)| {
        let mut own = objects.iter().filter(|object| object.name == *name);
        !own.next().is_some_and(|object| is_same(&object.mesh, mesh))
    });
    let mut faults: Vec<String> = wrong
        .map(|(name, _)| format!("{ASSEMBLY}: {name} is not where it belongs"))
        .collect();
    if objects.len() != evidence.parts.len() + count {
        faults.push(format!("{ASSEMBLY} holds {} things", objects.len()));
    }
    faults
}

fn is_same(a: &TriMesh, b: &TriMesh) -> bool {
    let [own, other] = [a, b].map(TriMesh::aabb);
    let side = |mesh: &TriMesh| mesh.signed_volume_mm3().cbrt();
    let is_near = |a: &Vector, b: &Vector| (a - b).amax() < SAME_MM;
    is_near(&own.min.coords, &other.min.coords)
        && is_near(&own.max.coords, &other.max.coords)
        && (side(a) - side(b)).abs() < SAME_MM
}

/// Returns the parts that are not on the plates just once, in print pose.
fn plate_faults(objects: &[PlacedObject], evidence: &CoreEvidence) -> Vec<String> {
    let scale = evidence
        .promise
        .printer
        .print_scale_ratio
        .unwrap_or([1.0; 3]);
    let scale = Vector::from(scale);
    let parts = evidence.promise.parts.iter().zip(&evidence.parts);
    let wrong = parts.filter(|(part, mesh)| {
        let printed = mesh
            .map_vertices(|p| part.print_from_model.to_print(p))
            .aabb();
        let size = printed.size().component_mul(&scale);
        let own = objects.iter().filter(|object| object.name == part.id);
        let own: Vec<Aabb> = own.map(|object| object.mesh.aabb()).collect();
        let fits = |found: &Aabb| {
            let turned = Vector::new(size.y, size.x, size.z);
            let is_flat = found.min.z.abs() < SAME_MM;
            let far = |size: &Vector| (found.size() - size).amax();
            is_flat && (far(&size) < SAME_MM || far(&turned) < SAME_MM)
        };
        own.len() != 1 || !own.iter().all(fits)
    });
    wrong
        .map(|(part, _)| format!("{} is not on a plate as it is printed", part.id))
        .collect()
}
