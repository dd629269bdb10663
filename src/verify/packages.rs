//! The 3MF files beside the parts: do they hold the parts that are judged, where they belong?

use std::path::Path;

use super::{
    Check, Evidence, Fingerprint, Limit, PartEvidence, Promise, VerifyError,
    fingerprint::Likeness,
    kit::{of_nominal_size, read_file},
};
use crate::io::threemf::{PlacedObject, decode_objects};

/// The parts in place.
const ASSEMBLY_FILE: &str = "assembly.3mf";
/// What the names of the plates begin with.
const PLATE: &str = "plate";

/// The check of all packages of a kit; none where it has none.
pub fn packages_check(folder: &Path, evidence: &Evidence) -> Result<Option<Check>, VerifyError> {
    let promise = &evidence.promise;
    let is_beside =
        |file: &&String| file.ends_with(".3mf") && !promise.parts.iter().any(|part| part.file == **file);
    let files: Vec<&String> = promise.files.keys().filter(is_beside).collect();
    if files.is_empty() {
        return Ok(None);
    }
    let (mut faults, mut on_plates) = (Vec::new(), Vec::new());
    for file in files.into_iter().filter(|file| folder.join(file).exists()) {
        match decode_objects(&read_file(&folder.join(file))?) {
            Err(error) => faults.push(format!("{file}: {error}")),
            Ok(objects) => {
                let nominal = |object| if file == ASSEMBLY_FILE { object } else { nominal(object, promise) };
                let objects: Vec<PlacedObject> = objects.into_iter().map(nominal).collect();
                if file.starts_with(PLATE) {
                    on_plates.extend(objects);
                } else {
                    faults.extend(object_faults(file, &objects, evidence));
                }
            }
        }
    }
    if !on_plates.is_empty() {
        faults.extend(object_faults(PLATE, &on_plates, evidence));
    }
    let words = "every 3MF file holds the parts as they are judged";
    let check = Check::new("3MF files", words, Some(faults.len() as f64), Limit::at_most(0.0, ""));
    Ok(Some(check.at((!faults.is_empty()).then(|| faults.join("; ")))))
}

/// An object of a plate or of a part's own package in the size before it was scaled for the printer.
fn nominal(object: PlacedObject, promise: &Promise) -> PlacedObject {
    PlacedObject { mesh: of_nominal_size(object.mesh, promise.printer.print_scale_ratio), ..object }
}

/// What is wrong with the objects of a file, in words.
fn object_faults(file: &str, objects: &[PlacedObject], evidence: &Evidence) -> Vec<String> {
    let parts = evidence.promise.parts.iter().zip(&evidence.parts);
    let twin = |file_of_part: &str| Path::new(file_of_part).with_extension("3mf") == Path::new(file);
    let own: Vec<&PartEvidence> =
        parts.clone().filter(|(part, _)| twin(&part.file)).map(|(_, read)| read).collect();
    let wanted = if own.is_empty() { evidence.parts.iter().collect() } else { own };
    let mut faults = Vec::new();
    if objects.len() != wanted.len() {
        faults.push(format!("{file} holds {} objects in place of {}", objects.len(), wanted.len()));
    }
    for part in wanted {
        let found: Vec<&PlacedObject> = objects.iter().filter(|object| object.name == part.id).collect();
        match found.as_slice() {
            [object] if is_right(file, object, part) => {}
            [_] => faults
                .push(format!("{file}: {} is not the part of its own file, or not in its place", part.id)),
            _ => faults.push(format!("{file} holds {} {} times", part.id, found.len())),
        }
    }
    faults
}

/// Whether an object is the part: in its place in the assembly, anywhere on a plate, with the same triangles in its own file.
fn is_right(file: &str, object: &PlacedObject, part: &PartEvidence) -> bool {
    let found = Fingerprint::of(&object.mesh);
    let printed = || Fingerprint::of(&part.mesh).likeness(&found);
    match file {
        ASSEMBLY_FILE => {
            let placed = part.mesh.map_vertices(|p| part.pose.to_model(p));
            matches!(Fingerprint::of(&placed).likeness(&found), Likeness::Same | Likeness::Near)
        }
        PLATE => !matches!(printed(), Likeness::Scaled(_) | Likeness::Mirrored | Likeness::Other),
        _ => printed() == Likeness::Same,
    }
}
