//! A profile merged with its parents.

use std::path::Path;

use toml::Spanned;

use super::error::{Problem, ProfileError, suggest};
use super::library::{Profile, Shelf, is_path};
use super::reader::Reader;
use crate::base::digest::sha256_hex;
use crate::base::toml_text::TextFault;

/// The values of one file, some of them missing.
pub(super) trait Layer: Sized {
    /// Reads the file; returns its values and the parent it names.
    fn read(reader: &mut Reader) -> Result<(Self, Option<Spanned<String>>), TextFault>;

    /// Returns these values, and the parent's where they are missing.
    fn over(self, parent: Self) -> Self;

    /// Marks all values as defaults of a family.
    fn into_defaults(self, family: &str) -> Self;
}

/// A profile with everything it inherits.
pub(super) struct Inherited<L> {
    pub values: L,
    /// The SHA-256 of all texts.
    pub sha256: String,
}

/// Reads a profile and its parents; faults of all of them are noted in `reader`.
pub(super) fn inherit<L: Layer>(
    shelf: &Shelf,
    profile: Profile,
    reader: &mut Reader,
) -> Result<Inherited<L>, ProfileError> {
    let mut ancestry = Ancestry {
        shelf,
        names: Vec::new(),
        texts: Vec::new(),
    };
    let values = ancestry.read(profile, reader)?;
    let texts: Vec<&[u8]> = ancestry.texts.iter().map(String::as_bytes).collect();
    Ok(Inherited {
        values,
        sha256: sha256_hex(&texts),
    })
}

/// The files read so far, from the profile up.
struct Ancestry<'a> {
    shelf: &'a Shelf<'a>,
    /// Their names: ids of built-in profiles, paths of files.
    names: Vec<String>,
    texts: Vec<String>,
}

/// The text of a parent.
struct Parent {
    name: String,
    text: String,
    is_family: bool,
}

impl Ancestry<'_> {
    fn read<L: Layer>(&mut self, profile: Profile, reader: &mut Reader) -> Result<L, ProfileError> {
        self.names.push(profile.id.to_owned());
        self.texts.push(profile.text.to_owned());
        let (values, inherits) = L::read(reader)?;
        let Some(id) = inherits else {
            return Ok(values);
        };
        let Some(parent) = self.find_parent(reader, profile.file, &id) else {
            reader.refuse_faults()?;
            return Ok(values);
        };
        let name = parent.name.as_str();
        let above = Profile {
            id: name,
            file: name,
            text: &parent.text,
        };
        let mut parent_reader = Reader::new(name, &parent.text);
        let inherited: L = self.read(above, &mut parent_reader)?;
        reader.take_faults(parent_reader);
        let inherited = if parent.is_family {
            inherited.into_defaults(name)
        } else {
            inherited
        };
        Ok(values.over(inherited))
    }

    /// Finds a parent: a built-in profile, or a file beside the one that names it. Notes one that
    /// cannot be had, or that is among the children.
    fn find_parent(
        &self,
        reader: &mut Reader,
        child: &str,
        id: &Spanned<String>,
    ) -> Option<Parent> {
        let (at, word) = (id.span().start, id.get_ref());
        let (name, text) = if is_path(word) {
            let folder = Path::new(child).parent().unwrap_or(Path::new(""));
            let path = folder.join(word);
            let name = path.to_string_lossy().into_owned();
            (name, std::fs::read_to_string(&path).ok())
        } else {
            let text = self.shelf.parent(word).map(|found| found.text.to_owned());
            (word.clone(), text)
        };
        if self.names.contains(&name) {
            let chain = [self.names.as_slice(), std::slice::from_ref(&name)].concat();
            let problem = Problem::Cycle {
                id: name,
                chain: chain.join(" → "),
                known: self.shelf.parent_ids().join(", "),
            };
            reader.note(at, problem);
            return None;
        }
        let Some(text) = text else {
            let problem = if is_path(word) {
                Problem::UnreadableParent(word.clone())
            } else {
                Problem::UnknownParent {
                    parent: word.clone(),
                    remedy: suggest(word, &self.shelf.parent_ids()),
                }
            };
            reader.note(at, problem);
            return None;
        };
        let is_family = self.shelf.families.iter().any(|family| family.id == name);
        Some(Parent {
            name,
            text,
            is_family,
        })
    }
}
