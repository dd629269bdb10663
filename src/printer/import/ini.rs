//! Slicers' `.ini` files: sections of keys, and sections that inherit from others of their kind.

use std::collections::BTreeMap;

use super::ImportError;
use crate::base::toml_text::{Place, nearest};

/// What the kind of a file without sections is called: a configuration that a slicer has exported.
pub(super) const FLAT: &str = "";

/// The key that names what a section inherits from.
const INHERITS: &str = "inherits";

/// A section: its own keys and where they stand.
#[derive(Debug, Clone, Default)]
pub(super) struct Section {
    pub line: usize,
    pub values: BTreeMap<String, String>,
}

/// A file: its sections by kind and name, as in `[printer:NAME]`.
#[derive(Debug, Clone, Default)]
pub(super) struct Ini {
    pub file: String,
    sections: BTreeMap<(String, String), Section>,
}

impl Ini {
    /// The sections of a text; a line that is none of section, key, comment or blank is refused
    /// with its place.
    pub fn parse(file: &str, text: &str) -> Result<Self, ImportError> {
        let mut ini = Self {
            file: file.to_owned(),
            sections: BTreeMap::new(),
        };
        let mut current = (FLAT.to_owned(), FLAT.to_owned());
        for (index, line) in text.lines().enumerate() {
            let (line, number) = (line.trim_start_matches('\u{feff}').trim(), index + 1);
            if line.is_empty() || line.starts_with(['#', ';']) {
                continue;
            }
            if let Some(head) = line.strip_prefix('[') {
                let name = head
                    .strip_suffix(']')
                    .ok_or_else(|| ini.fault(number, "a section has no `]`"))?;
                current = split_name(name);
                ini.sections.entry(current.clone()).or_default().line = number;
            } else {
                let fault = || ini.fault(number, "neither a [section] nor `key = value`");
                let (key, value) = line.split_once('=').ok_or_else(fault)?;
                let section = ini.sections.entry(current.clone()).or_default();
                section
                    .values
                    .insert(key.trim().to_owned(), value.trim().to_owned());
            }
        }
        Ok(ini)
    }

    fn fault(&self, line: usize, problem: &'static str) -> ImportError {
        ImportError::Line {
            place: Place {
                file: self.file.clone(),
                line,
                column: 1,
            },
            problem,
        }
    }

    /// The names of the sections of a kind that a user sees: not those in asterisks, which only
    /// lend their keys.
    pub fn names(&self, kind: &str) -> Vec<&str> {
        let of_kind = self
            .sections
            .keys()
            .filter(|(of, _)| of == kind)
            .map(|(_, name)| name.as_str());
        of_kind.filter(|name| !name.starts_with('*')).collect()
    }

    /// The line a section begins at.
    pub fn line(&self, kind: &str, name: &str) -> usize {
        self.sections
            .get(&(kind.to_owned(), name.to_owned()))
            .map_or(1, |section| section.line)
    }

    /// Every key of a section with what it inherits; its own and the later parents' come first.
    pub fn resolved(
        &self,
        kind: &str,
        name: &str,
    ) -> Result<BTreeMap<String, String>, ImportError> {
        self.resolved_on_way(kind, name, &mut Vec::new())
    }

    fn resolved_on_way(
        &self,
        kind: &str,
        name: &str,
        way: &mut Vec<String>,
    ) -> Result<BTreeMap<String, String>, ImportError> {
        let key = (kind.to_owned(), name.to_owned());
        let Some(section) = self.sections.get(&key) else {
            return Err(self.no_section(kind, name));
        };
        if way.iter().any(|on_way| on_way == name) {
            let way = way.join(" → ") + " → " + name;
            return Err(ImportError::Cycle {
                place: self.place(section.line),
                way,
            });
        }
        way.push(name.to_owned());
        let mut values = BTreeMap::new();
        let parents = section.values.get(INHERITS).map_or("", String::as_str);
        for parent in parents
            .split(';')
            .map(|parent| parent.trim().trim_matches('"'))
            .filter(|p| !p.is_empty())
        {
            values.extend(self.resolved_on_way(kind, parent, way)?);
        }
        way.pop();
        values.extend(
            section
                .values
                .iter()
                .filter(|(key, _)| *key != INHERITS)
                .map(|(k, v)| (k.clone(), v.clone())),
        );
        Ok(values)
    }

    fn place(&self, line: usize) -> Place {
        Place {
            file: self.file.clone(),
            line,
            column: 1,
        }
    }

    fn no_section(&self, kind: &str, name: &str) -> ImportError {
        let names = self.names(kind);
        let remedy = match nearest(name, names.iter().copied()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => "list what there is with --list".to_owned(),
        };
        ImportError::NoSection {
            file: self.file.clone(),
            kind: kind.to_owned(),
            name: name.to_owned(),
            remedy,
        }
    }
}

/// The kind and the name of `kind:name`; a section without a colon is its own kind.
fn split_name(name: &str) -> (String, String) {
    let (kind, name) = name.split_once(':').unwrap_or((name, FLAT));
    (kind.trim().to_owned(), name.trim().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "# bundle\nkey = flat\n[print:*common*]\na = 1\nb = 1\n[print:*fine*]\nb = 2\n\
                        [print:Mine]\ninherits = *common*; *fine*\nc = x = y\n";

    #[test]
    fn own_keys_come_before_the_later_parents_and_these_before_the_earlier() {
        let ini = Ini::parse("t.ini", TEXT).unwrap();
        let mine = ini.resolved("print", "Mine").unwrap();
        let pairs: Vec<(&str, &str)> = mine.iter().map(|(k, v)| (k.as_str(), v.as_str())).collect();
        assert_eq!(pairs, [("a", "1"), ("b", "2"), ("c", "x = y")]);
        assert_eq!(
            ini.names("print"),
            ["Mine"],
            "those in asterisks only lend their keys"
        );
        assert_eq!(ini.resolved(FLAT, FLAT).unwrap()["key"], "flat");
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        for (text, words) in [
            ("a = 1\n[print:x\n", "t.ini:2:1: a section has no `]`"),
            ("a = 1\n\nwhat is this\n", "t.ini:3:1: neither a [section]"),
            (
                "[print:a]\ninherits = b\n[print:b]\ninherits = a\n",
                "inherits from itself (a → b → a)",
            ),
            (
                "[print:a]\ninherits = Min\n[print:Mine]\n",
                "did you mean `Mine`?",
            ),
        ] {
            let error = Ini::parse("t.ini", text)
                .and_then(|ini| ini.resolved("print", "a"))
                .unwrap_err();
            assert!(error.to_string().contains(words), "{error}");
        }
    }
}
