//! The 3MF files of a telescope: the parts all in, all out, and on their plates.

use std::path::Path;

use super::evidence::TelescopeEvidence;
use super::motion::MotionKey;
use crate::geom::{Aabb, Vector};
use crate::io::threemf::{PlacedObject, decode_objects};
use crate::mesh::TriMesh;
use crate::verify::{Check, CheckKind, Limit};

/// The beginning of the names of plates.
const PLATE: &str = "plate";
/// The ending of packages.
const ENDING: &str = ".3mf";
/// By how much a box or the cube root of a volume may differ, mm: single precision, twice.
const SAME_MM: f64 = 2e-3;

/// Checks all packages that a kit lists.
pub(super) fn packages_check(folder: &Path, evidence: &TelescopeEvidence) -> Check {
    let listed = evidence.promise.files.keys();
    let packages = listed.filter(|file| file.ends_with(ENDING));
    let (mut faults, mut on_plates) = (Vec::new(), Vec::new());
    for file in packages {
        let bytes = std::fs::read(folder.join(file)).unwrap_or_default();
        match decode_objects(&bytes) {
            Err(error) => faults.push(format!("{file}: {error}")),
            Ok(objects) if file.starts_with(PLATE) => on_plates.extend(objects),
            Ok(objects) => faults.extend(placed_faults(file, &objects, evidence)),
        }
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

/// Returns the faults of a package in which the parts are together.
fn placed_faults(
    file: &str,
    objects: &[PlacedObject],
    evidence: &TelescopeEvidence,
) -> Vec<String> {
    let keys = &evidence.motion.keys;
    let key = match file {
        "collapsed.3mf" => keys.first(),
        "extended.3mf" => keys.last(),
        _ => return vec![format!("{file} is none of a telescope's packages")],
    };
    let Some(key) = key else {
        return vec![format!("{file} belongs to no key")];
    };
    let parts = evidence.promise.parts.iter().zip(&evidence.parts);
    let wrong = parts.filter(|(part, mesh)| {
        let placed = in_model(evidence, key, part.shell, mesh);
        let mut own = objects.iter().filter(|object| object.name == part.id);
        !own.next()
            .is_some_and(|object| is_same(&object.mesh, &placed))
    });
    let mut faults: Vec<String> = wrong
        .map(|(part, _)| format!("{file}: {} is not where it belongs", part.id))
        .collect();
    let is_more = objects.len() > evidence.parts.len();
    faults.extend(is_more.then(|| format!("{file} holds more than the parts")));
    faults
}

fn in_model(
    evidence: &TelescopeEvidence,
    key: &MotionKey,
    shell: usize,
    mesh: &TriMesh,
) -> TriMesh {
    let frames = evidence.motion.frames(&key.states);
    let frame = &frames[shell - 1];
    mesh.map_vertices(|p| frame.to_model(p))
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
fn plate_faults(objects: &[PlacedObject], evidence: &TelescopeEvidence) -> Vec<String> {
    let scale = evidence
        .promise
        .printer
        .print_scale_ratio
        .unwrap_or([1.0; 3]);
    let scale = Vector::from(scale);
    let parts = evidence.promise.parts.iter().zip(&evidence.parts);
    let wrong = parts.filter(|(part, mesh)| {
        let printed = mesh
            .map_vertices(|p| part.print_from_shell.to_print(p))
            .aabb();
        let size = printed.size().component_mul(&scale);
        let own: Vec<Aabb> = objects
            .iter()
            .filter(|object| object.name == part.id)
            .map(|object| object.mesh.aabb())
            .collect();
        let fits = |found: &Aabb| {
            let [a, b] = [found.size(), size];
            let turned = Vector::new(b.y, b.x, b.z);
            let is_flat = found.min.z.abs() < SAME_MM;
            is_flat && ((a - b).amax() < SAME_MM || (a - turned).amax() < SAME_MM)
        };
        own.len() != 1 || !own.iter().all(fits)
    });
    wrong
        .map(|(part, _)| format!("{} is not on a plate as it is printed", part.id))
        .collect()
}
