//! Slicers' `.ini` files: sections of keys that inherit from other sections of their kind.

use std::collections::BTreeMap;

use super::ImportError;
use crate::base::toml_text::{Place, nearest_name};

/// Kind and name of the section of an exported configuration, which has no sections.
pub(super) const FLAT: &str = "";

/// The key that names the parents of a section.
const INHERITS: &str = "inherits";

/// A section: its own keys, and the line of its head.
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
    /// Parses the sections of a text. A line that is no section, key, comment or blank is an error.
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
            place: self.place(line),
            problem,
        }
    }

    /// Returns the names of the sections of a kind, without those in asterisks: these only lend
    /// their keys.
    pub fn names(&self, kind: &str) -> Vec<&str> {
        let of_kind = self
            .sections
            .keys()
            .filter(|(of, _)| of == kind)
            .map(|(_, name)| name.as_str());
        of_kind.filter(|name| !name.starts_with('*')).collect()
    }

    /// Returns the line of a section's head; 1 if it has none.
    pub fn line(&self, kind: &str, name: &str) -> usize {
        self.sections
            .get(&(kind.to_owned(), name.to_owned()))
            .map_or(1, |section| section.line)
    }

    /// Returns every key of a section with the inherited ones. Its own keys take precedence, then
    /// those of later parents.
    pub fn resolve(&self, kind: &str, name: &str) -> Result<BTreeMap<String, String>, ImportError> {
        self.resolve_below(kind, name, &mut Vec::new())
    }

    /// Resolves a section from which `heirs` inherit, the nearest last.
    fn resolve_below(
        &self,
        kind: &str,
        name: &str,
        heirs: &mut Vec<String>,
    ) -> Result<BTreeMap<String, String>, ImportError> {
        let key = (kind.to_owned(), name.to_owned());
        let Some(section) = self.sections.get(&key) else {
            return Err(self.missing_section(kind, name));
        };
        if heirs.iter().any(|heir| heir == name) {
            let chain = heirs.join(" → ") + " → " + name;
            return Err(ImportError::Cycle {
                place: self.place(section.line),
                chain,
            });
        }
        heirs.push(name.to_owned());
        let mut values = BTreeMap::new();
        let parents = section.values.get(INHERITS).map_or("", String::as_str);
        for parent in parents
            .split(';')
            .map(|parent| parent.trim().trim_matches('"'))
            .filter(|p| !p.is_empty())
        {
            values.extend(self.resolve_below(kind, parent, heirs)?);
        }
        heirs.pop();
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

    fn missing_section(&self, kind: &str, name: &str) -> ImportError {
        let names = self.names(kind);
        let remedy = match nearest_name(name, names.iter().copied()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => "export it again, with all sections it inherits from".to_owned(),
        };
        ImportError::NoSection {
            file: self.file.clone(),
            kind: kind.to_owned(),
            name: name.to_owned(),
            remedy,
        }
    }
}

/// Splits `kind:name`; without a colon, the whole is the kind.
fn split_name(name: &str) -> (String, String) {
    let (kind, name) = name.split_once(':').unwrap_or((name, FLAT));
    (kind.trim().to_owned(), name.trim().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "# bundle\nkey = flat\n[print:*common*]\na = 1\nb = 1\n\
                        [print:*fine*]\nb = 2\n\
                        [print:Mine]\ninherits = *common*; *fine*\nc = x = y\n";

    #[test]
    fn own_keys_take_precedence_then_those_of_later_parents() {
        let ini = Ini::parse("t.ini", TEXT).unwrap();
        let mine = ini.resolve("print", "Mine").unwrap();
        let pairs: Vec<(&str, &str)> = mine.iter().map(|(k, v)| (k.as_str(), v.as_str())).collect();
        assert_eq!(pairs, [("a", "1"), ("b", "2"), ("c", "x = y")]);
        assert_eq!(
            ini.names("print"),
            ["Mine"],
            "sections in asterisks only lend their keys"
        );
        assert_eq!(ini.resolve(FLAT, FLAT).unwrap()["key"], "flat");
    }

    #[test]
    fn faults_are_reported_with_their_line() {
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
                .and_then(|ini| ini.resolve("print", "a"))
                .unwrap_err();
            assert!(error.to_string().contains(words), "{error}");
        }
    }
}
