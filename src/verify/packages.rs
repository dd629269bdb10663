//! The check of the 3MF files: they hold the parts that are judged, in their places, with their
//! orders for a slicer.

use std::path::Path;

use rayon::prelude::*;

use super::fingerprint::Likeness;
use super::orders::{Ordered, Wanted};
use super::reading::{read_file, undo_print_scale};
use super::{
    Check, CheckKind, Evidence, Fingerprint, Limit, PartEvidence, PlateSpot, Promise, VerifyError,
};
use crate::io::threemf::{PlacedObject, SlicerOrders, ThreeMfError, decode_objects, decode_orders};

/// The file with all parts in place.
const ASSEMBLY_FILE: &str = "assembly.3mf";
/// The prefix of the names of plates.
const PLATE: &str = "plate";
/// The rounding of a place on a plate in a 3MF file, mm.
const IN_PLACE_MM: f64 = 1e-3;

/// A package, or all plates together.
struct Package {
    name: String,
    kind: Kind,
    objects: Vec<PlacedObject>,
}

/// The parts as they were read back, with the fingerprint of each.
struct Parts<'a> {
    evidence: &'a Evidence,
    prints: Vec<Fingerprint>,
}

/// The kind of a package.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    /// All parts in place.
    Assembly,
    /// All parts and jigs in print pose, on plates.
    Plates,
    /// One part.
    Part,
}

/// Checks all packages of a kit; `None` if it has none.
///
/// Objects are compared with the fingerprints of the parts as made, so that a changed file of a
/// part is not blamed on them.
///
/// # Errors
///
/// If a package cannot be read.
pub fn packages_check(folder: &Path, evidence: &Evidence) -> Result<Option<Check>, VerifyError> {
    let promise = &evidence.promise;
    let is_jig = |file: &&String| {
        let mut jigs = promise.jigs.iter();
        jigs.any(|jig| Path::new(&jig.file).with_extension("3mf") == Path::new(*file))
    };
    let is_beside = |file: &&String| {
        let is_part = promise.parts.iter().any(|part| part.file == **file);
        file.ends_with(".3mf") && !is_part && !is_jig(file)
    };
    let files: Vec<&String> = promise.files.keys().filter(is_beside).collect();
    if files.is_empty() {
        return Ok(None);
    }
    let there = files.into_par_iter();
    let there = there.filter(|file| folder.join(file).is_file());
    let decoded = there.map(|file| Ok((file, decode(&read_file(&folder.join(file))?))));
    let (prints, decoded) = rayon::join(
        || evidence.fingerprints(),
        || decoded.collect::<Vec<Result<_, VerifyError>>>(),
    );
    let (mut faults, mut packages) = (Vec::new(), Vec::new());
    let wanted = Wanted::of(promise);
    for read in decoded {
        match read? {
            (file, Err(error)) => faults.push(format!("{file}: {error}")),
            (file, Ok((objects, orders))) => {
                faults.extend(misplaced(file, &objects, promise));
                let package = Ordered {
                    file,
                    objects: &objects,
                    orders: &orders,
                };
                let is_printed = file != ASSEMBLY_FILE;
                faults.extend(
                    is_printed
                        .then(|| wanted.faults(&package))
                        .into_iter()
                        .flatten(),
                );
                packages.push(Package::new(file, objects, promise));
            }
        }
    }
    let packages = merge_plates(packages);
    let parts = Parts { evidence, prints };
    let found = packages.par_iter();
    let found = found.map(|package| find_faults(package, &parts));
    faults.extend(found.collect::<Vec<_>>().concat());
    let words = "every 3MF file holds the parts as they are judged, and orders their infill";
    let check = Check::new(
        CheckKind::Packages,
        words,
        Some(faults.len() as f64),
        Limit::at_most(0.0, ""),
    );
    Ok(Some(
        check.at((!faults.is_empty()).then(|| faults.join("; "))),
    ))
}

/// Returns the objects of a package, and its orders for a slicer.
fn decode(bytes: &[u8]) -> Result<(Vec<PlacedObject>, Vec<SlicerOrders>), ThreeMfError> {
    Ok((decode_objects(bytes)?, decode_orders(bytes)?))
}

impl Package {
    /// Recognises the kind of a package by its name. Printed objects are returned in nominal size.
    fn new(file: &str, objects: Vec<PlacedObject>, promise: &Promise) -> Self {
        let kind = match file {
            ASSEMBLY_FILE => Kind::Assembly,
            _ if file.starts_with(PLATE) => Kind::Plates,
            _ => Kind::Part,
        };
        let scale_ratio = match kind {
            Kind::Assembly => None,
            Kind::Plates | Kind::Part => promise.printer.print_scale_ratio,
        };
        let nominal = |object: PlacedObject| PlacedObject {
            mesh: undo_print_scale(object.mesh, scale_ratio),
            ..object
        };
        Self {
            name: file.to_owned(),
            kind,
            objects: objects.into_iter().map(nominal).collect(),
        }
    }
}

/// Returns the faults of where things lie on a plate, in words; none for other packages.
fn misplaced(file: &str, objects: &[PlacedObject], promise: &Promise) -> Vec<String> {
    if !file.starts_with(PLATE) {
        return Vec::new();
    }
    let Some(plate) = promise.plates.iter().find(|plate| plate.file == *file) else {
        return vec![format!("the checklist does not say what lies on {file}")];
    };
    let is_there = |spot: &PlateSpot, object: &PlacedObject| {
        let found = object.mesh.aabb();
        let size = found.size();
        let pairs = [
            (found.min.x, spot.low_mm[0]),
            (found.min.y, spot.low_mm[1]),
            (size.x, spot.size_mm[0]),
            (size.y, spot.size_mm[1]),
        ];
        object.name == spot.id && pairs.iter().all(|(a, b)| (a - b).abs() <= IN_PLACE_MM)
    };
    let lost = plate.holds.iter().filter(|spot| {
        let mut objects = objects.iter();
        !objects.any(|object| is_there(spot, object))
    });
    let lost = lost.map(|spot| format!("{file}: {} does not lie where the sheet says", spot.id));
    let count = (plate.holds.len() != objects.len()).then(|| {
        format!(
            "{file} holds {} objects, not as the sheet says",
            objects.len()
        )
    });
    count.into_iter().chain(lost).collect()
}

/// Merges the plates into one package, since each part lies on only one of them.
fn merge_plates(packages: Vec<Package>) -> Vec<Package> {
    let (plates, mut all): (Vec<Package>, Vec<Package>) = packages
        .into_iter()
        .partition(|package| package.kind == Kind::Plates);
    let names: Vec<&str> = plates.iter().map(|plate| plate.name.as_str()).collect();
    let name = names.join(", ");
    if !plates.is_empty() {
        let objects = plates.into_iter().flat_map(|plate| plate.objects).collect();
        all.push(Package {
            name,
            kind: Kind::Plates,
            objects,
        });
    }
    all
}

/// Returns the faults of a package's objects, in words.
fn find_faults(package: &Package, parts: &Parts) -> Vec<String> {
    let evidence = parts.evidence;
    let Package {
        name,
        kind,
        objects,
    } = package;
    let all = 0..evidence.parts.len();
    let is_own = |part: &usize| {
        Path::new(&evidence.promise.parts[*part].file).with_extension("3mf") == Path::new(name)
    };
    let wanted: Vec<usize> = all
        .filter(|part| *kind != Kind::Part || is_own(part))
        .collect();
    let jigs: &[PartEvidence] = match kind {
        Kind::Plates => &evidence.jigs,
        Kind::Assembly | Kind::Part => &[],
    };
    let (found, count) = (objects.len(), wanted.len() + jigs.len());
    let mut faults = Vec::new();
    if found != count {
        faults.push(format!("{name} holds {found} objects instead of {count}"));
    }
    faults.extend(jigs.iter().filter_map(|jig| jig_fault(name, objects, jig)));
    let fault = |part: usize| {
        let id = &evidence.parts[part].id;
        let found: Vec<&PlacedObject> =
            objects.iter().filter(|object| object.name == *id).collect();
        match found.as_slice() {
            [object] if is_right(*kind, object, parts, part) => None,
            [_] => Some(format!(
                "{name}: {id} differs from the part in its own file, or is not in its place"
            )),
            _ => Some(format!("{name} holds {id} {} times", found.len())),
        }
    };
    let of_parts = wanted.into_par_iter().filter_map(fault);
    faults.extend(of_parts.collect::<Vec<String>>());
    faults
}

/// Returns the fault of a jig on the plates, in words.
fn jig_fault(plates: &str, objects: &[PlacedObject], jig: &PartEvidence) -> Option<String> {
    let mut found = objects.iter().filter(|object| object.name == jig.id);
    let is_right = |object: &PlacedObject| {
        !matches!(
            Fingerprint::of(&jig.mesh).likeness(&Fingerprint::of(&object.mesh)),
            Likeness::Scaled(_) | Likeness::Mirrored | Likeness::Other
        )
    };
    let is_sound = found.next().is_some_and(is_right) && found.next().is_none();
    (!is_sound).then(|| format!("{plates}: {} is not as in its own file", jig.id))
}

/// Returns true if an object is the part. In the assembly its place counts too; in its own package
/// it has the same triangles.
fn is_right(kind: Kind, object: &PlacedObject, parts: &Parts, part: usize) -> bool {
    let Parts { evidence, prints } = parts;
    let (found, read) = (Fingerprint::of(&object.mesh), &evidence.parts[part]);
    let promised = evidence.promise.parts[part].fingerprint.as_ref();
    let printed = || match read.inner.is_empty() {
        true => promised.unwrap_or(&prints[part]).likeness(&found),
        // The fingerprint of a part knows its outermost region only.
        false => Fingerprint::of(&read.whole()).likeness(&found),
    };
    match kind {
        // Only the part as made shows the place in the assembly.
        Kind::Assembly if !evidence.is_part_as_made(part, &prints[part]) => true,
        Kind::Assembly => {
            let placed = read.mesh.map_vertices(|p| read.pose.to_model(p));
            matches!(
                Fingerprint::of(&placed).likeness(&found),
                Likeness::Same | Likeness::Near
            )
        }
        Kind::Plates => !matches!(
            printed(),
            Likeness::Scaled(_) | Likeness::Mirrored | Likeness::Other
        ),
        Kind::Part => printed() == Likeness::Same,
    }
}
