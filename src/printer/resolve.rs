//! Resolution of a profile, with its parents and materials, to one printer.

use std::path::Path;

use toml::Spanned;

use super::{
    Faults, Printer, Problem, ProfileError,
    complete::{complete, note_contradictions},
    error::suggest,
    layer::Layer,
    library::{Library, PROFILE_ENDING, Profile, by_id, ids},
    materials::collect_materials,
    profile::ProfileText,
    reader::Reader,
};
use crate::base::digest::sha256_hex;
use crate::base::toml_text::TextFault;

/// Builds the printer that `profile` and its parents describe; fails with all their faults.
///
/// Missing values are reported only if all present ones are right.
pub(super) fn resolve(library: &Library, profile: Profile) -> Result<Printer, ProfileError> {
    let mut reader = Reader::new(profile.file, profile.text);
    let mut ancestry = Ancestry {
        library,
        names: Vec::new(),
        ids: Vec::new(),
        texts: Vec::new(),
    };
    let layer = ancestry.read_layer(profile, &mut reader)?;
    let materials = collect_materials(library, &mut reader, &layer)?;
    refuse_faults(&mut reader)?;
    note_contradictions(&mut reader, &layer);
    let printer = complete(&mut reader, layer, materials);
    refuse_faults(&mut reader)?;
    let texts: Vec<&[u8]> = ancestry.texts.iter().map(String::as_bytes).collect();
    let profile_sha256 = sha256_hex(&texts);
    // Without a fault, no required value is missing.
    let printer = printer.ok_or_else(|| ProfileError::Broken(Faults(Vec::new())))?;
    Ok(Printer {
        profile_sha256,
        ..printer
    })
}

/// Fails with the noted faults, if there are any.
fn refuse_faults(reader: &mut Reader) -> Result<(), ProfileError> {
    if reader.faults.is_empty() {
        Ok(())
    } else {
        Err(Faults(std::mem::take(&mut reader.faults)).into())
    }
}

/// A profile and its ancestors, as far as they have been read.
struct Ancestry<'l, 'a> {
    library: &'l Library<'a>,
    /// Their files, from the profile up; built-in profiles by their ids.
    names: Vec<String>,
    /// Their ids, in the same order.
    ids: Vec<String>,
    /// Their texts, in the same order.
    texts: Vec<String>,
}

/// The parent of a profile.
enum Parent<'a> {
    Process(Profile<'a>),
    Printer(Profile<'a>),
    File { path: String, text: String },
}

impl<'a> Ancestry<'_, 'a> {
    /// Reads a profile and merges it with its parents.
    fn read_layer(&mut self, profile: Profile, reader: &mut Reader) -> Result<Layer, ProfileError> {
        let text: ProfileText = reader.parse()?;
        let layer = Layer::read(reader, &text);
        self.names.push(self.unique_name(&profile));
        self.ids.push(text.id.get_ref().clone());
        self.texts.push(profile.text.to_owned());
        let Some(id) = &text.inherits else {
            return Ok(layer);
        };
        let Some(parent) = self.find_parent(reader, profile.file, id) else {
            refuse_faults(reader)?;
            return Ok(layer);
        };
        let inherited = match &parent {
            Parent::Process(process) => self.read_process(*process, reader)?,
            Parent::Printer(printer) => self.read_parent(*printer, reader)?,
            Parent::File { path, text } => {
                let (id, file) = (path, path);
                self.read_parent(Profile { id, file, text }, reader)?
            }
        };
        Ok(layer.over(inherited))
    }

    /// Reads a parent; its faults join those of the child.
    fn read_parent(&mut self, parent: Profile, child: &mut Reader) -> Result<Layer, ProfileError> {
        let mut reader = Reader::new(parent.file, parent.text);
        let layer = self.read_layer(parent, &mut reader)?;
        child.faults.append(&mut reader.faults);
        Ok(layer)
    }

    /// Reads a process as defaults; its faults join those of the child.
    fn read_process(&mut self, process: Profile, child: &mut Reader) -> Result<Layer, TextFault> {
        let mut reader = Reader::new(process.file, process.text);
        let text: ProfileText = reader.parse()?;
        let layer = Layer::read(&mut reader, &text);
        if let Some(parent) = &text.inherits {
            let problem = Problem::ProcessInherits {
                id: layer.id.clone(),
                parent: parent.get_ref().clone(),
            };
            reader.note(parent.span().start, problem);
        }
        self.texts.push(process.text.to_owned());
        child.faults.append(&mut reader.faults);
        Ok(layer.into_defaults())
    }

    /// Returns the name by which a circle of parents is found: one name per profile.
    fn unique_name(&self, profile: &Profile) -> String {
        let is_built_in =
            by_id(self.library.printers, profile.id).is_some_and(|p| p.file == profile.file);
        if is_built_in {
            profile.id.to_owned()
        } else {
            canonical(Path::new(profile.file))
        }
    }

    /// Finds the parent of the profile in `file`; `None` if it cannot be had, which is noted.
    fn find_parent(
        &self,
        reader: &mut Reader,
        file: &str,
        id: &Spanned<String>,
    ) -> Option<Parent<'a>> {
        let at = id.span().start;
        let parent = id.get_ref();
        let known = ids(self.library.processes);
        let path = parent
            .ends_with(PROFILE_ENDING)
            .then(|| path_beside(file, parent));
        let name = path.clone().unwrap_or_else(|| parent.clone());
        if let Some(first) = self.names.iter().position(|read| *read == name) {
            reader.note(at, circle(&self.names[first..], &known));
            return None;
        }
        if let Some(path) = path {
            return match std::fs::read_to_string(&path) {
                Ok(text) => Some(Parent::File { path, text }),
                Err(_) => {
                    reader.note(at, Problem::UnreadableParent { parent: path });
                    None
                }
            };
        }
        let process =
            by_id(self.library.processes, parent).map(|process| Parent::Process(*process));
        let printer = by_id(self.library.printers, parent).map(|printer| Parent::Printer(*printer));
        let found = process.or(printer);
        if let (None, Some(first)) = (&found, self.ids.iter().position(|id| id == parent)) {
            reader.note(at, circle(&self.ids[first..], &known));
        } else if found.is_none() {
            let all: Vec<&str> = known
                .into_iter()
                .chain(ids(self.library.printers))
                .collect();
            let problem = Problem::UnknownParent {
                remedy: suggest(parent, &all),
                parent: parent.clone(),
            };
            reader.note(at, problem);
        }
        found
    }
}

/// Builds the fault of a profile that is its own ancestor along `chain`.
fn circle(chain: &[String], known: &[&str]) -> Problem {
    let id = chain.first().cloned().unwrap_or_default();
    Problem::Cycle {
        chain: format!("{} → {id}", chain.join(" → ")),
        id,
        known: known.join(", "),
    }
}

/// Returns the canonical path of a parent that `file` names.
fn path_beside(file: &str, parent: &str) -> String {
    let folder = Path::new(file).parent().unwrap_or(Path::new(""));
    canonical(&folder.join(parent))
}

/// Returns the absolute path without links and dots; the path itself if there is no such file.
fn canonical(path: &Path) -> String {
    std::fs::canonicalize(path)
        .unwrap_or_else(|_| path.to_owned())
        .to_string_lossy()
        .into_owned()
}

#[cfg(test)]
mod broken;
#[cfg(test)]
mod tests;
