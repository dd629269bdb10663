//! The 3MF files beside the parts: do they hold the parts that are judged, where they belong?

use std::path::Path;

use super::{
    Check, CheckKind, Evidence, Fingerprint, Limit, Promise, VerifyError,
    fingerprint::Likeness,
    kit::{of_nominal_size, read_file},
    sheet::has_its_shape,
};
use crate::io::threemf::{PlacedObject, decode_objects};

/// The parts in place.
const ASSEMBLY_FILE: &str = "assembly.3mf";
/// What the names of the plates begin with.
const PLATE: &str = "plate";

/// A package, or all plates together: its name, what it is, and what it holds.
struct Package {
    name: String,
    kind: Kind,
    objects: Vec<PlacedObject>,
}

/// What a package is.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    /// All parts in place.
    Assembly,
    /// All parts in print pose, anywhere.
    Plates,
    /// One part.
    Part,
}

/// The check of all packages of a kit; none where it has none.
///
/// Objects are held against the marks of the parts as they were made, so that a part's changed file
/// is not laid to them.
pub fn packages_check(folder: &Path, evidence: &Evidence) -> Result<Option<Check>, VerifyError> {
    let promise = &evidence.promise;
    let is_beside = |file: &&String| {
        file.ends_with(".3mf") && !promise.parts.iter().any(|part| part.file == **file)
    };
    let files: Vec<&String> = promise.files.keys().filter(is_beside).collect();
    if files.is_empty() {
        return Ok(None);
    }
    let (mut faults, mut packages) = (Vec::new(), Vec::new());
    for file in files.into_iter().filter(|file| folder.join(file).exists()) {
        match decode_objects(&read_file(&folder.join(file))?) {
            Err(error) => faults.push(format!("{file}: {error}")),
            Ok(objects) => packages.push(package(file, objects, promise)),
        }
    }
    faults.extend(
        together(packages)
            .iter()
            .flat_map(|package| object_faults(package, evidence)),
    );
    let words = "every 3MF file holds the parts as they are judged";
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

fn package(file: &str, objects: Vec<PlacedObject>, promise: &Promise) -> Package {
    let kind = match file {
        ASSEMBLY_FILE => Kind::Assembly,
        _ if file.starts_with(PLATE) => Kind::Plates,
        _ => Kind::Part,
    };
    let nominal = |object| {
        if kind == Kind::Assembly {
            object
        } else {
            nominal(object, promise)
        }
    };
    Package {
        name: file.to_owned(),
        kind,
        objects: objects.into_iter().map(nominal).collect(),
    }
}

/// The packages, those of plates taken together: each part lies on one of them.
fn together(packages: Vec<Package>) -> Vec<Package> {
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

/// An object of a plate or of a part's own package in the size before it was scaled for the
/// printer.
fn nominal(object: PlacedObject, promise: &Promise) -> PlacedObject {
    PlacedObject {
        mesh: of_nominal_size(object.mesh, promise.printer.print_scale_ratio),
        ..object
    }
}

/// What is wrong with the objects of a package, in words.
fn object_faults(package: &Package, evidence: &Evidence) -> Vec<String> {
    let Package {
        name,
        kind,
        objects,
    } = package;
    let all = 0..evidence.parts.len();
    let twin = |part: &usize| {
        Path::new(&evidence.promise.parts[*part].file).with_extension("3mf") == Path::new(name)
    };
    let wanted: Vec<usize> = all
        .filter(|part| *kind != Kind::Part || twin(part))
        .collect();
    let mut faults = Vec::new();
    if objects.len() != wanted.len() {
        faults.push(format!(
            "{name} holds {} objects in place of {}",
            objects.len(),
            wanted.len()
        ));
    }
    for part in wanted {
        let id = &evidence.parts[part].id;
        let found: Vec<&PlacedObject> =
            objects.iter().filter(|object| object.name == *id).collect();
        match found.as_slice() {
            [object] if is_right(*kind, object, (evidence, part)) => {}
            [_] => {
                faults.push(format!(
                    "{name}: {id} is not the part of its own file, or not in its place"
                ));
            }
            _ => faults.push(format!("{name} holds {id} {} times", found.len())),
        }
    }
    faults
}

/// Whether an object is the part: in its place in the assembly, anywhere on a plate, with the same
/// triangles in its own file.
fn is_right(kind: Kind, object: &PlacedObject, (evidence, part): (&Evidence, usize)) -> bool {
    let (found, read) = (Fingerprint::of(&object.mesh), &evidence.parts[part]);
    let mark = evidence.promise.parts[part].fingerprint.clone();
    let printed = || {
        mark.unwrap_or_else(|| Fingerprint::of(&read.mesh))
            .likeness(&found)
    };
    match kind {
        // Where it belongs can be told only by the part as it was made.
        Kind::Assembly if !has_its_shape(evidence, part) => true,
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
