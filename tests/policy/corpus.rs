//! The table of constants and rows, and the check that it is complete and up to date.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::sync::LazyLock;

use equipoise::run::Policy;
use serde::Deserialize;

/// The folder of this test.
const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/policy");

/// The table that was read from `corpus.toml`.
pub static CORPUS: LazyLock<Corpus> = LazyLock::new(|| {
    let text = fs::read_to_string(Path::new(FOLDER).join("corpus.toml")).unwrap();
    toml::from_str(&text).unwrap()
});

/// The constants of the search, and the rows that set them.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Corpus {
    constant: Vec<Constant>,
    /// The runs.
    pub row: Vec<Row>,
}

/// A ratio or limit of the search.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Constant {
    /// A field of [`Policy`], or the name of a constant in `file`.
    name: String,
    /// The file below `src`; a field of [`Policy`] needs none.
    file: Option<String>,
    /// The value that the rows justify.
    value: f64,
    /// The names of the rows that set it; none if it is kept by judgement.
    #[serde(default)]
    rows: Vec<String>,
    /// The claim behind the value.
    claim: String,
}

/// A run and what it must reach.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Row {
    /// The name of the test that runs it.
    pub name: String,
    /// The commit whose message or comments state the figures.
    pub recorded: String,
    /// The file in the folder of shared models.
    pub model: String,
    /// The SHA-256 of that file.
    pub sha256: String,
    /// The goal: `top`, `yoyo`, `stand`, `balance` or `float`.
    pub goal: String,
    /// The axis; up if it is left out.
    pub up: Option<String>,
    /// The contact point of a top; the lowest if it is left out.
    pub contact: Option<String>,
    /// The liquid of something that floats; water if it is left out.
    pub liquid: Option<String>,
    /// The printer's id.
    pub printer: String,
    /// Longest side of the model, mm.
    pub size_mm: f64,
    /// Thickness of the wall, mm; the printer's own if it is left out.
    pub wall_mm: Option<f64>,
    /// Pitch of the solver's columns, mm. Coarse ones are quick.
    pub pitch_mm: f64,
    /// Greatest number of joints without their pins; any number if it is left out.
    pub joints_without_pins: Option<usize>,
    /// Numbers of the checklist.
    #[serde(default)]
    pub claims: Vec<Claim>,
}

/// The range of a number, or of the length of a list, on the checklist.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Claim {
    /// Its JSON pointer.
    pub at: String,
    /// Its least value.
    pub least: Option<f64>,
    /// Its greatest value.
    pub most: Option<f64>,
}

impl Constant {
    /// The value in the program; `None` if there is no such constant any more.
    fn current(&self) -> Option<f64> {
        let Some(file) = &self.file else {
            return policy()
                .find(|(name, _)| *name == self.name)
                .map(|(_, value)| value);
        };
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("src").join(file);
        let text = fs::read_to_string(path).ok()?;
        let (_, definition) = text.split_once(&format!("const {}: ", self.name))?;
        let (_, value) = definition.split_once(';')?.0.split_once('=')?;
        value.trim().replace('_', "").parse().ok()
    }
}

/// The fields of the policy, with their values.
fn policy() -> impl Iterator<Item = (String, f64)> {
    let text = format!("{:?}", Policy::STANDARD);
    let fields = text.trim_start_matches("Policy { ").trim_end_matches(" }");
    let field = |field: &str| {
        let (name, value) = field.split_once(": ").unwrap();
        let value = match value {
            "true" => 1.0,
            "false" => 0.0,
            number => number.parse().unwrap(),
        };
        (name.to_owned(), value)
    };
    fields
        .split(", ")
        .map(field)
        .collect::<Vec<_>>()
        .into_iter()
}

#[test]
fn every_field_of_the_policy_is_in_the_corpus() {
    let known: BTreeSet<&str> = CORPUS
        .constant
        .iter()
        .map(|constant| constant.name.as_str())
        .collect();
    let missing: Vec<String> = policy()
        .map(|(name, _)| name)
        .filter(|name| !known.contains(name.as_str()))
        .collect();
    assert!(missing.is_empty(), "add them to corpus.toml: {missing:?}");
}

#[test]
fn every_constant_has_the_value_that_the_corpus_states() {
    for constant in &CORPUS.constant {
        let current = constant.current();
        assert_eq!(
            current,
            Some(constant.value),
            "{}: run its rows, then change corpus.toml",
            constant.name
        );
        assert!(!constant.claim.is_empty(), "{} has no claim", constant.name);
    }
}

#[test]
fn every_row_sets_a_constant_and_every_name_of_a_row_is_known() {
    let rows: BTreeSet<&str> = CORPUS.row.iter().map(|row| row.name.as_str()).collect();
    let named = CORPUS.constant.iter().flat_map(|constant| &constant.rows);
    let named: BTreeSet<&str> = named.map(String::as_str).collect();
    assert_eq!(rows, named);
}
