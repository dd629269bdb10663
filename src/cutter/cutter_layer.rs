//! The values of one cutter's file, and their completion to a cutter.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;

use serde::Deserialize;
use toml::Spanned;

use super::ancestry::{Inherited, Layer, inherit};
use super::error::{Problem, ProfileError};
use super::library::{CUTTERS, Profile};
use super::machine::{Cutter, CutterNumber, Dialect, Kerf, Thickest};
use super::reader::{Key, Reader, ValueText};
use crate::base::sourced::Sourced;
use crate::base::toml_text::TextFault;

/// Plausible sides of a bed, mm. Smaller values must be in inches or metres.
const BED_MM: RangeInclusive<f64> = 50.0..=10_000.0;
/// Plausible kerfs, mm. Larger values must be in micrometres.
const KERF_MM: RangeInclusive<f64> = 0.01..=2.0;
/// Plausible thicknesses of sheets, mm.
pub(super) const THICKNESS_MM: RangeInclusive<f64> = 0.2..=60.0;
/// Plausible speeds of a cut, mm/s. Larger values must be in mm/min.
const SPEED_MM_S: RangeInclusive<f64> = 0.1..=2000.0;

/// The file of a cutter, as written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct CutterText {
    id: Spanned<String>,
    name: Spanned<String>,
    inherits: Option<Spanned<String>>,
    bed_mm: Option<Spanned<ValueText<[f64; 2]>>>,
    dialect: Option<Dialect>,
    compensates_kerf: Option<Spanned<ValueText<bool>>>,
    #[serde(default)]
    kerf: Vec<KerfText>,
    #[serde(default)]
    thickest: Vec<ThickestText>,
    #[serde(default)]
    numbers: BTreeMap<CutterNumber, Spanned<ValueText<f64>>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct KerfText {
    material: Spanned<String>,
    thickness_mm: Spanned<f64>,
    kerf_mm: Spanned<ValueText<f64>>,
    speed_mm_s: Option<Spanned<f64>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ThickestText {
    material: Spanned<String>,
    thickness_mm: Spanned<ValueText<f64>>,
}

impl CutterNumber {
    fn key(self) -> Key {
        match self {
            Self::MarginMm => Key::new("margin_mm", 0.1..=200.0),
            Self::TaperDeg => Key::new("taper_deg", 0.01..=15.0),
            Self::MinFeatureMm => Key::new("min_feature_mm", 0.05..=20.0),
            Self::MinGapMm => Key::new("min_gap_mm", 0.05..=20.0),
            Self::PowerW => Key::new("power_w", 1.0..=10_000.0),
        }
    }
}

/// The values of a cutter, some of them missing.
#[derive(Debug, Default)]
pub(super) struct CutterLayer {
    id: String,
    name: String,
    inherits: Option<String>,
    bed_mm: Option<Sourced<[f64; 2]>>,
    dialect: Option<Dialect>,
    compensates_kerf: Option<Sourced<bool>>,
    kerfs: Vec<Kerf>,
    thickest: Vec<Thickest>,
    numbers: BTreeMap<CutterNumber, Sourced<f64>>,
}

impl Layer for CutterLayer {
    fn read(reader: &mut Reader) -> Result<(Self, Option<Spanned<String>>), TextFault> {
        let text: CutterText = reader.parse()?;
        let bed = Key::new("bed_mm", BED_MM);
        let flag = Key::new("compensates_kerf", BED_MM);
        let numbers = text.numbers.iter();
        let numbers = numbers
            .filter_map(|(number, text)| Some((*number, reader.value(&number.key(), text)?)))
            .collect();
        let layer = Self {
            id: reader.id(&text.id),
            name: reader.words("name", &text.name),
            inherits: text.inherits.as_ref().map(|id| id.get_ref().clone()),
            bed_mm: text.bed_mm.as_ref().and_then(|t| reader.value(&bed, t)),
            dialect: text.dialect,
            compensates_kerf: text
                .compensates_kerf
                .as_ref()
                .and_then(|t| reader.value(&flag, t)),
            kerfs: read_kerfs(reader, &text.kerf),
            thickest: read_thickest(reader, &text.thickest),
            numbers,
        };
        Ok((layer, text.inherits))
    }

    fn over(self, parent: Self) -> Self {
        let mut numbers = parent.numbers;
        numbers.extend(self.numbers);
        let is_new = |kerf: &Kerf| !self.kerfs.iter().any(|own| is_same(own, kerf));
        let mut kerfs: Vec<Kerf> = parent.kerfs.into_iter().filter(is_new).collect();
        kerfs.extend(self.kerfs);
        sort(&mut kerfs);
        let is_new = |limit: &Thickest| {
            let own = self.thickest.iter();
            own.into_iter().all(|own| own.material != limit.material)
        };
        let mut thickest: Vec<Thickest> = parent.thickest.into_iter().filter(is_new).collect();
        thickest.extend(self.thickest);
        thickest.sort_by_key(|limit| limit.material);
        Self {
            bed_mm: self.bed_mm.or(parent.bed_mm),
            dialect: self.dialect.or(parent.dialect),
            compensates_kerf: self.compensates_kerf.or(parent.compensates_kerf),
            kerfs,
            thickest,
            numbers,
            ..self
        }
    }

    fn into_defaults(mut self, family: &str) -> Self {
        let family = || Some(family.to_owned());
        self.bed_mm
            .iter_mut()
            .for_each(|s| s.process_default_of = family());
        let flag = self.compensates_kerf.iter_mut();
        flag.for_each(|s| s.process_default_of = family());
        let kerfs = self.kerfs.iter_mut().map(|kerf| &mut kerf.kerf_mm);
        let limits = self
            .thickest
            .iter_mut()
            .map(|limit| &mut limit.thickness_mm);
        let numbers = self.numbers.values_mut();
        let all = kerfs.chain(limits).chain(numbers);
        all.for_each(|s| s.process_default_of = family());
        self
    }
}

fn is_same(a: &Kerf, b: &Kerf) -> bool {
    a.material == b.material && a.thickness_mm == b.thickness_mm
}

fn sort(kerfs: &mut [Kerf]) {
    kerfs.sort_by(|a, b| {
        let by_thickness = a.thickness_mm.total_cmp(&b.thickness_mm);
        a.material.cmp(&b.material).then(by_thickness)
    });
}

fn read_kerfs(reader: &mut Reader, texts: &[KerfText]) -> Vec<Kerf> {
    let mut kerfs: Vec<Kerf> = Vec::new();
    for text in texts {
        let (at, thickness_mm) = (text.thickness_mm.span().start, *text.thickness_mm.get_ref());
        reader.check_number(at, &Key::new("thickness_mm", THICKNESS_MM), thickness_mm);
        if let Some(speed) = &text.speed_mm_s {
            let key = Key::new("speed_mm_s", SPEED_MM_S);
            reader.check_number(speed.span().start, &key, *speed.get_ref());
        }
        let material = reader.material(&text.material);
        let kerf_mm = reader.value(&Key::new("kerf_mm", KERF_MM), &text.kerf_mm);
        let (Some(material), Some(kerf_mm)) = (material, kerf_mm) else {
            continue;
        };
        let kerf = Kerf {
            material,
            thickness_mm,
            kerf_mm,
            speed_mm_s: text.speed_mm_s.as_ref().map(|speed| *speed.get_ref()),
        };
        if kerfs.iter().any(|known| is_same(known, &kerf)) {
            let what = format!("the kerf in {material} of {thickness_mm} mm");
            reader.note(at, Problem::Twice(what));
        }
        kerfs.push(kerf);
    }
    sort(&mut kerfs);
    kerfs
}

fn read_thickest(reader: &mut Reader, texts: &[ThickestText]) -> Vec<Thickest> {
    let mut limits: Vec<Thickest> = Vec::new();
    for text in texts {
        let key = Key::new("thickness_mm", THICKNESS_MM);
        let material = reader.material(&text.material);
        let thickness_mm = reader.value(&key, &text.thickness_mm);
        let (Some(material), Some(thickness_mm)) = (material, thickness_mm) else {
            continue;
        };
        if limits.iter().any(|known| known.material == material) {
            let what = format!("the thickest {material}");
            reader.note(text.material.span().start, Problem::Twice(what));
        }
        limits.push(Thickest {
            material,
            thickness_mm,
        });
    }
    limits
}

/// Builds the cutter that a profile and its parents describe; fails with all their faults.
///
/// Missing values are reported only if all present ones are right.
pub(super) fn complete_cutter(profile: Profile) -> Result<Cutter, ProfileError> {
    let mut reader = Reader::new(profile.file, profile.text);
    let Inherited { values, sha256 } = inherit::<CutterLayer>(&CUTTERS, profile, &mut reader)?;
    note_contradictions(&mut reader, &values);
    reader.refuse_faults()?;
    let bed_mm = reader.required("bed_mm", values.bed_mm);
    let dialect = reader.required("dialect", values.dialect);
    let compensates_kerf = reader.required("compensates_kerf", values.compensates_kerf);
    if values.kerfs.is_empty() {
        reader.note(0, Problem::Missing("kerf"));
    }
    reader.refuse_faults()?;
    let (Some(bed_mm), Some(dialect), Some(compensates_kerf)) = (bed_mm, dialect, compensates_kerf)
    else {
        // Without a fault, no required value is missing.
        return Err(super::error::Faults(Vec::new()).into());
    };
    Ok(Cutter {
        id: values.id,
        name: values.name,
        inherits: values.inherits,
        profile_sha256: sha256,
        bed_mm,
        dialect,
        compensates_kerf,
        kerfs: values.kerfs,
        thickest: values.thickest,
        numbers: values.numbers,
    })
}

/// Notes kerfs that eat the narrowest strip, and margins that leave no bed.
fn note_contradictions(reader: &mut Reader, values: &CutterLayer) {
    let number = |number| values.numbers.get(&number).map(|s: &Sourced<f64>| s.value);
    let widest = values.kerfs.iter().map(|kerf| kerf.kerf_mm.value);
    let widest = widest.fold(0.0, f64::max);
    if let Some(least) = number(CutterNumber::MinFeatureMm)
        && widest >= least
    {
        let problem = Problem::Contradiction {
            key: "kerf_mm".to_owned(),
            value: widest,
            against: format!("the narrowest strip `min_feature_mm` is {least}"),
        };
        reader.note(0, problem);
    }
    if let (Some(margin), Some(bed)) = (number(CutterNumber::MarginMm), &values.bed_mm)
        && 2.0 * margin >= bed.value[0].min(bed.value[1])
    {
        let problem = Problem::Contradiction {
            key: "margin_mm".to_owned(),
            value: margin,
            against: format!("the bed is {} × {}", bed.value[0], bed.value[1]),
        };
        reader.note(0, problem);
    }
}
