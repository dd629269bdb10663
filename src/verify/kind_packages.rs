//! The 3MF files of kits of their own kind: parts in their places, and parts on their plates.

use std::path::Path;

use super::{Check, CheckKind, Limit};
use crate::geom::{Aabb, Vector};
use crate::io::threemf::{PlacedObject, decode_objects};
use crate::mass::moments_of_mesh;
use crate::mesh::TriMesh;

/// The beginning of the names of plates.
const PLATE: &str = "plate";
/// The ending of packages.
const ENDING: &str = ".3mf";
/// By how much a box or the cube root of a volume may differ, mm: single precision, twice.
const SAME_MM: f64 = 2e-3;

/// A body with the name under which a package holds it.
pub struct Named {
    /// The name.
    pub name: String,
    /// The body in its place.
    pub body: TriMesh,
}

/// The packages that a kit must have.
pub struct Packages<'a> {
    /// The kit's folder.
    pub folder: &'a Path,
    /// Packages in which all is in its place, by their names.
    pub placed: Vec<(&'static str, Vec<Named>)>,
    /// The parts in print pose, in the size that is printed.
    pub printed: Vec<Named>,
}

impl Packages<'_> {
    /// Checks all packages that a kit lists among its files.
    pub fn check<'f>(&self, files: impl Iterator<Item = &'f String>) -> Check {
        let packages: Vec<&String> = files.filter(|file| file.ends_with(ENDING)).collect();
        let (mut faults, mut on_plates) = (Vec::new(), Vec::new());
        for file in &packages {
            let bytes = std::fs::read(self.folder.join(file)).unwrap_or_default();
            let wanted = self.placed.iter().find(|(name, _)| name == file);
            match (decode_objects(&bytes), wanted) {
                (Err(error), _) => faults.push(format!("{file}: {error}")),
                (Ok(objects), None) if file.starts_with(PLATE) => on_plates.extend(objects),
                (Ok(objects), Some((_, bodies))) => {
                    faults.extend(placed_faults(file, &objects, bodies));
                }
                (Ok(_), None) => faults.push(format!("{file} is none of this kit's packages")),
            }
        }
        let names = self.placed.iter().map(|(name, _)| *name);
        let missing = names.filter(|name| !packages.iter().any(|file| file == name));
        faults.extend(missing.map(|name| format!("{name} is missing")));
        faults.extend(plate_faults(&on_plates, &self.printed));
        let check = Check::new(
            CheckKind::Packages,
            "every 3MF file holds the parts as they are judged, in their places",
            Some(faults.len() as f64),
            Limit::at_most(0.0, ""),
        );
        check.at((!faults.is_empty()).then(|| faults.join("; ")))
    }
}

/// Returns the faults of a package in which all is in its place.
fn placed_faults(file: &str, objects: &[PlacedObject], bodies: &[Named]) -> Vec<String> {
    let wrong = bodies.iter().filter(|wanted| {
        let mut own = objects.iter().filter(|object| object.name == wanted.name);
        !own.next()
            .is_some_and(|object| is_same(&object.mesh, &wanted.body))
    });
    let mut faults: Vec<String> = wrong
        .map(|wanted| format!("{file}: {} is not where it belongs", wanted.name))
        .collect();
    if objects.len() != bodies.len() {
        let (found, count) = (objects.len(), bodies.len());
        faults.push(format!("{file} holds {found} bodies in place of {count}"));
    }
    faults
}

/// Returns whether two bodies have the same box and the same ten moments, up to single precision.
///
/// A box and a volume alone are those of a body mirrored in its box, too.
pub(super) fn is_same(a: &TriMesh, b: &TriMesh) -> bool {
    let [own, other] = [a, b].map(TriMesh::aabb);
    let is_near = |a: &Vector, b: &Vector| (a - b).amax() < SAME_MM;
    is_near(&own.min.coords, &other.min.coords)
        && is_near(&own.max.coords, &other.max.coords)
        && has_same_moments([a, b], &other)
}

/// Returns whether bodies in a box have the same volume, centre and second moments.
fn has_same_moments(bodies: [&TriMesh; 2], bounds: &Aabb) -> bool {
    let middle = bounds.center().coords;
    let [a, b] = bodies.map(|body| moments_of_mesh(body).translated(&-middle));
    let off = (a.volume().cbrt() - b.volume().cbrt()).abs();
    // A shift of the surface moves the square of a radius by twice that radius at most.
    let reach_mm = bounds.size().norm();
    let second = (a.second() - b.second()).amax();
    off < SAME_MM
        && (a.first() - b.first()).amax() < SAME_MM * b.volume().abs()
        && second < SAME_MM * reach_mm * b.volume().abs()
}

/// Returns the parts that are not on the plates just once, in print pose.
fn plate_faults(objects: &[PlacedObject], printed: &[Named]) -> Vec<String> {
    let wrong = printed.iter().filter(|part| {
        let size = part.body.aabb().size();
        let turned = Vector::new(size.y, size.x, size.z);
        let own = objects.iter().filter(|object| object.name == part.name);
        let own: Vec<Aabb> = own.map(|object| object.mesh.aabb()).collect();
        let fits = |found: &Aabb| {
            let far = |size: &Vector| (found.size() - size).amax();
            found.min.z.abs() < SAME_MM && (far(&size) < SAME_MM || far(&turned) < SAME_MM)
        };
        own.len() != 1 || !own.iter().all(fits)
    });
    wrong
        .map(|part| format!("{} is not on a plate as it is printed", part.name))
        .collect()
}
