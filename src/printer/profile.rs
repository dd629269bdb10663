//! A profile's text as it stands in its file, and its numbers checked one by one.

use std::{collections::BTreeMap, ops::RangeInclusive};

use serde::Deserialize;
use toml::Spanned;

use super::{Fault, Grid, Material, PrintPose, Problem, Quantity, Sourced, Support, Sure};
use crate::{
    toml_text::{self, Place, TextFault},
    units::MM_PER_INCH,
};

/// Sides of a build volume that can be meant, mm. Below it centimetres were given, above it micrometres.
const BUILD_VOLUME_MM: RangeInclusive<f64> = 10.0..=10_000.0;

/// Densities that can be meant, g/cm³: from foam to beyond osmium (22.6). Outside it kg/m³ or g/mm³ were given.
const DENSITY_G_CM3: RangeInclusive<f64> = 0.05..=25.0;

/// Shares by which the mass of a sound print may differ; above it per cent were given.
const DENSITY_SPREAD_RATIO: RangeInclusive<f64> = 1e-4..=0.5;

/// A printer's or a process's file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ProfileText {
    pub id: Spanned<String>,
    pub name: Spanned<String>,
    pub inherits: Option<Spanned<String>>,
    pub grid: Option<Grid>,
    pub support: Option<Support>,
    pub print_pose: Option<PrintPose>,
    pub cleaning: Option<Spanned<String>>,
    pub materials: Option<Spanned<Vec<Spanned<String>>>>,
    pub default_material: Option<Spanned<String>>,
    pub build_volume_mm: Option<Spanned<Quoted<[f64; 3]>>>,
    #[serde(default)]
    pub numbers: BTreeMap<Quantity, Spanned<Quoted<f64>>>,
    #[serde(default)]
    pub material: Vec<MaterialText>,
}

/// A material's file, or a `[[material]]` table of a printer's.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MaterialText {
    pub id: Spanned<String>,
    pub name: Spanned<String>,
    pub density_g_cm3: Spanned<Quoted<f64>>,
    pub density_spread_ratio: Spanned<Quoted<f64>>,
}

/// A value as written, with its source still unchecked.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Quoted<T> {
    value: Option<T>,
    dpi: Option<f64>,
    source: Option<String>,
    sure: Option<Sure>,
}

/// A file being read: what it is called, what it says, and everything found wrong with it so far.
pub(super) struct Reader<'a> {
    pub file: &'a str,
    pub text: &'a str,
    pub faults: Vec<Fault>,
}

impl<'a> Reader<'a> {
    pub fn new(file: &'a str, text: &'a str) -> Self {
        Self { file, text, faults: Vec::new() }
    }

    pub fn parse<T: serde::de::DeserializeOwned>(&self) -> Result<T, TextFault> {
        toml_text::read(self.file, self.text)
    }

    /// Notes a problem with what begins at the byte `offset`.
    pub fn note(&mut self, offset: usize, problem: Problem) {
        self.faults.push(Fault { place: Place::of_byte(self.file, self.text, offset), problem });
    }

    /// The text, noted if it is blank.
    pub fn words(&mut self, key: &str, text: &Spanned<String>) -> String {
        if text.get_ref().trim().is_empty() {
            self.note(text.span().start, Problem::Empty { key: key.to_owned() });
        }
        text.get_ref().clone()
    }

    /// The id, noted unless it is fit for file names.
    pub fn id(&mut self, id: &Spanned<String>) -> String {
        let is_fit = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
        if id.get_ref().is_empty() || !id.get_ref().chars().all(is_fit) {
            self.note(id.span().start, Problem::BadId { id: id.get_ref().clone() });
        }
        id.get_ref().clone()
    }

    /// A number of the table, as a value in its key's unit.
    pub fn number(&mut self, quantity: Quantity, quoted: &Spanned<Quoted<f64>>) -> Option<Sourced<f64>> {
        let key = quantity.key();
        let at = quoted.span().start;
        let mut quoted = quoted.get_ref().clone();
        if let (Some(dpi), true) = (quoted.dpi, quantity.is_grid_step()) {
            if quoted.value.is_some() {
                self.note(at, Problem::TwoValues { key: key.to_owned() });
            }
            quoted = Quoted { value: Some(MM_PER_INCH / dpi), dpi: None, ..quoted };
        }
        self.sourced(Entry { key, at, range: quantity.plausible() }, quoted)
    }

    /// The build volume.
    pub fn build_volume(&mut self, quoted: &Spanned<Quoted<[f64; 3]>>) -> Option<Sourced<[f64; 3]>> {
        let entry = Entry { key: "build_volume_mm", at: quoted.span().start, range: BUILD_VOLUME_MM };
        self.sourced(entry, quoted.get_ref().clone())
    }

    /// A material with its two numbers.
    pub fn material(&mut self, text: &MaterialText) -> Option<Material> {
        let id = self.id(&text.id);
        let name = self.words("name", &text.name);
        let [density, spread] = [
            ("density_g_cm3", &text.density_g_cm3, DENSITY_G_CM3),
            ("density_spread_ratio", &text.density_spread_ratio, DENSITY_SPREAD_RATIO),
        ]
        .map(|(key, quoted, range)| {
            self.sourced(Entry { key, at: quoted.span().start, range }, quoted.get_ref().clone())
        });
        Some(Material { id, name, density_g_cm3: density?, density_spread_ratio: spread? })
    }

    /// The value with its source; everything missing or impossible about it is noted.
    fn sourced<T: Numbers>(&mut self, entry: Entry, quoted: Quoted<T>) -> Option<Sourced<T>> {
        let key = || entry.key.to_owned();
        if quoted.dpi.is_some() {
            self.note(entry.at, Problem::DpiNotAStep { key: key() });
        }
        let source = quoted.source.filter(|source| !source.trim().is_empty());
        if source.is_none() {
            self.note(entry.at, Problem::NoSource { key: key() });
        }
        if quoted.sure.is_none() {
            self.note(entry.at, Problem::NotSure { key: key() });
        }
        match &quoted.value {
            None => self.note(entry.at, Problem::NoValue { key: key() }),
            Some(value) => value.numbers().iter().for_each(|&number| self.judge(&entry, number)),
        }
        Some(Sourced { value: quoted.value?, source: source?, sure: quoted.sure?, process_default_of: None })
    }

    /// Notes a number that is not positive and finite, or that cannot be meant.
    fn judge(&mut self, entry: &Entry, value: f64) {
        let key = entry.key.to_owned();
        if !(value.is_finite() && value > 0.0) {
            self.note(entry.at, Problem::NotPositive { key, value });
        } else if !entry.range.contains(&value) {
            let (least, most) = (*entry.range.start(), *entry.range.end());
            self.note(entry.at, Problem::Implausible { key, value, least, most });
        }
    }
}

/// What a value is called, where it stands, and what can be meant by it.
struct Entry {
    key: &'static str,
    at: usize,
    range: RangeInclusive<f64>,
}

/// One number, or several of one kind.
trait Numbers {
    fn numbers(&self) -> &[f64];
}

impl Numbers for f64 {
    fn numbers(&self) -> &[f64] {
        std::slice::from_ref(self)
    }
}

impl Numbers for [f64; 3] {
    fn numbers(&self) -> &[f64] {
        self
    }
}
