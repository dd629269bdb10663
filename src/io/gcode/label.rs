//! Labels of objects: in comments, by `M486`, or by `EXCLUDE_OBJECT` commands.

use std::collections::HashMap;

use super::error::Limit;
use crate::io::threemf::REGION;

/// Letters of a name that are kept.
const KEPT: usize = 200;

/// The name of an object on the plate.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Default)]
pub struct Label {
    /// The name, as a rule of the model's file; empty if only a number is given.
    pub name: String,
    /// The number of the object; `None` if the file gives none.
    pub id: Option<i64>,
    /// The number of the copy, from 0; `None` if the file gives none.
    pub copy: Option<i64>,
}

/// The ways to name the current object. A file may use several at once for the same object; the
/// first in this order counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scheme {
    /// `; printing object NAME id:N copy K` of PrusaSlicer, SuperSlicer and OrcaSlicer.
    Printing,
    /// `; start printing object, unique label id: N` of Bambu Studio.
    Bambu,
    /// `;MESH:NAME` of Cura.
    Mesh,
    /// `EXCLUDE_OBJECT_START NAME=…` of Klipper.
    Exclude,
    /// `M486 S…` of Marlin and Prusa's firmware.
    M486,
}

const SCHEMES: usize = 5;

/// The labels met so far and the current one.
#[derive(Debug, Default)]
pub struct Labels {
    known: Vec<Label>,
    index: HashMap<Label, usize>,
    current: [Option<usize>; SCHEMES],
    /// Names that `M486 A` gives to numbers.
    names: HashMap<i64, String>,
    /// The object that `M486 A` names.
    numbered: Option<i64>,
}

impl Labels {
    /// Returns the index of the current object; `None` between objects.
    pub fn current(&self) -> Option<usize> {
        self.current.iter().copied().flatten().next()
    }

    /// Begins an object, or none.
    pub fn begin(&mut self, scheme: Scheme, label: Option<Label>) -> Result<(), Limit> {
        let index = label.map(|label| self.index_of(label)).transpose()?;
        self.current[scheme as usize] = index;
        Ok(())
    }

    /// Takes a comment without its semicolon. Returns true if it names an object.
    pub fn take_comment(&mut self, comment: &str) -> Result<bool, Limit> {
        if let Some(text) = comment.strip_prefix("printing object ") {
            self.begin(Scheme::Printing, Some(Label::of_comment(text)))?;
        } else if comment.starts_with("stop printing object,") {
            self.begin(Scheme::Bambu, None)?;
        } else if comment.starts_with("stop printing object ") {
            self.begin(Scheme::Printing, None)?;
        } else if let Some(text) = comment.strip_prefix("start printing object,") {
            let id = text
                .rsplit(':')
                .next()
                .and_then(|id| id.trim().parse().ok());
            self.begin(
                Scheme::Bambu,
                Some(Label {
                    id,
                    ..Label::default()
                }),
            )?;
        } else if let Some(name) = comment.strip_prefix("MESH:") {
            // Cura has a region of other infill as a mesh of its own.
            let name = name.split(REGION).next().unwrap_or(name).trim();
            let label = (name != "NONMESH").then(|| Label::named(name));
            self.begin(Scheme::Mesh, label)?;
        } else {
            return Ok(false);
        }
        Ok(true)
    }

    /// Takes a command of Klipper's; other lines change nothing.
    pub fn take_macro(&mut self, line: &str) -> Result<(), Limit> {
        let line = line.trim();
        if line.starts_with("EXCLUDE_OBJECT_END") {
            self.begin(Scheme::Exclude, None)?;
        } else if let Some(rest) = line.strip_prefix("EXCLUDE_OBJECT_START") {
            let name = rest
                .split_whitespace()
                .find_map(|word| word.strip_prefix("NAME="));
            let label = name.map(|name| Label::named(name.trim_matches(['"', '\''])));
            self.begin(Scheme::Exclude, label)?;
        }
        Ok(())
    }

    /// Takes the words of an `M486`: `S` begins an object or, below 0, ends it; `A` names it.
    pub fn take_m486(&mut self, words: &str) -> Result<(), Limit> {
        let words = words.split(';').next().unwrap_or_default().trim();
        if let Some(name) = words.strip_prefix('A') {
            return self.name_numbered(name.trim());
        }
        let number = words
            .split_whitespace()
            .find_map(|word| word.strip_prefix('S')?.parse::<i64>().ok());
        let Some(number) = number else {
            return Ok(());
        };
        let label = (number >= 0).then(|| Label {
            name: self.names.get(&number).cloned().unwrap_or_default(),
            id: Some(number),
            copy: None,
        });
        self.numbered = (number >= 0).then_some(number);
        self.begin(Scheme::M486, label)
    }

    /// Returns the labels in the order in which they were met.
    pub fn into_known(self) -> Vec<Label> {
        self.known
    }

    /// Names the object that was begun last, also where it is known already.
    fn name_numbered(&mut self, name: &str) -> Result<(), Limit> {
        let (Some(number), Some(index)) = (self.numbered, self.current[Scheme::M486 as usize])
        else {
            return Ok(());
        };
        let name: String = name.chars().take(KEPT).collect();
        self.names.insert(number, name.clone());
        let label = Label {
            name,
            id: Some(number),
            copy: None,
        };
        if let Some(other) = self.index.get(&label) {
            self.current[Scheme::M486 as usize] = Some(*other);
            return Ok(());
        }
        self.index.remove(&self.known[index]);
        self.known[index] = label.clone();
        self.index.insert(label, index);
        Ok(())
    }

    fn index_of(&mut self, label: Label) -> Result<usize, Limit> {
        if let Some(index) = self.index.get(&label) {
            return Ok(*index);
        }
        if self.known.len() as u64 >= Limit::Objects.most() {
            return Err(Limit::Objects);
        }
        self.known.push(label.clone());
        self.index.insert(label, self.known.len() - 1);
        Ok(self.known.len() - 1)
    }
}

impl Label {
    /// Makes a label of a name alone.
    pub fn named(name: &str) -> Self {
        Self {
            name: name.trim().chars().take(KEPT).collect(),
            ..Self::default()
        }
    }

    /// Reads `NAME id:N copy K`; a name may hold anything.
    fn of_comment(text: &str) -> Self {
        let text = text.trim();
        let number = |text: &str| text.trim().parse::<i64>().ok();
        let (rest, copy) = match text.rsplit_once(" copy ") {
            Some((rest, copy)) if number(copy).is_some() => (rest, number(copy)),
            _ => (text, None),
        };
        let (name, id) = match rest.rsplit_once(" id:") {
            Some((name, id)) if number(id).is_some() => (name, number(id)),
            _ => (rest, None),
        };
        Self {
            id,
            copy,
            ..Self::named(name)
        }
    }
}

impl std::fmt::Display for Label {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match (self.name.is_empty(), self.id) {
            (true, Some(id)) => write!(f, "object {id}")?,
            (true, None) => f.write_str("object")?,
            (false, Some(id)) => write!(f, "{} ({id})", self.name)?,
            (false, None) => f.write_str(&self.name)?,
        }
        match self.copy {
            Some(copy) if copy > 0 => write!(f, ", copy {copy}"),
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the current object after every line.
    fn follow(lines: &[&str]) -> Vec<Option<String>> {
        let mut labels = Labels::default();
        let mut seen = Vec::new();
        for line in lines {
            match (line.strip_prefix(';'), line.strip_prefix("M486 ")) {
                (Some(comment), _) => {
                    labels.take_comment(comment.trim()).unwrap();
                }
                (_, Some(words)) => labels.take_m486(words).unwrap(),
                _ => labels.take_macro(line).unwrap(),
            }
            seen.push(labels.current());
        }
        let known = labels.into_known();
        seen.iter()
            .map(|at| at.map(|at| known[at].to_string()))
            .collect()
    }

    fn said(names: &[&str]) -> Vec<Option<String>> {
        let some = |name: &&str| (!name.is_empty()).then(|| (*name).to_owned());
        names.iter().map(some).collect()
    }

    #[test]
    fn comments_name_objects_and_their_copies() {
        let lines = [
            "; printing object left id:half id:3 copy 1",
            "; stop printing object left id:half id:3 copy 1",
            ";MESH:a b.stl",
            ";MESH:a b.stl sparse infill 1",
            ";MESH:NONMESH",
            "; start printing object, unique label id: 15",
            "; stop printing object, unique label id: 15",
        ];
        let want = said(&[
            "left id:half (3), copy 1",
            "",
            "a b.stl",
            "a b.stl",
            "",
            "object 15",
            "",
        ]);
        assert_eq!(follow(&lines), want);
    }

    #[test]
    fn two_labels_at_once_are_one_object() {
        let lines = [
            "; printing object a id:0 copy 0",
            "EXCLUDE_OBJECT_START NAME=a_id_0_copy_0",
            "EXCLUDE_OBJECT_END NAME=a_id_0_copy_0",
            "; stop printing object a id:0 copy 0",
        ];
        assert_eq!(follow(&lines), said(&["a (0)", "a (0)", "a (0)", ""]));
    }

    #[test]
    fn klipper_and_marlin_name_objects_by_commands() {
        let lines = [
            "EXCLUDE_OBJECT_DEFINE NAME=\"b\" CENTER=1,2",
            "EXCLUDE_OBJECT_START NAME=\"b\"",
            "EXCLUDE_OBJECT_END",
            "M486 S0",
            "M486 ACube one",
            "M486 S-1",
            "M486 S1",
            "M486 S0 ; again",
        ];
        let want = [
            "",
            "b",
            "",
            "Cube one (0)",
            "Cube one (0)",
            "",
            "object 1",
            "Cube one (0)",
        ];
        assert_eq!(follow(&lines), said(&want));
    }

    #[test]
    fn the_number_of_objects_is_bounded() {
        let mut labels = Labels::default();
        let mut begin = |n: usize| labels.take_comment(&format!("MESH:{n}"));
        assert!((0..10_000).all(|n| begin(n).is_ok()));
        assert_eq!(begin(10_000), Err(Limit::Objects));
    }
}
