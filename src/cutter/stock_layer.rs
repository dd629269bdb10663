//! The values of one sheet's file, and their completion to a sheet.

use std::ops::RangeInclusive;

use serde::Deserialize;
use toml::Spanned;

use super::ancestry::{Inherited, Layer, inherit};
use super::cutter_layer::THICKNESS_MM;
use super::error::{Faults, Problem, ProfileError};
use super::library::{Profile, SHEETS};
use super::material::{SheetMaterial, has_chlorine};
use super::reader::{Key, Reader, ValueText};
use super::stock::{Grain, StockSheet, StockSize};
use crate::base::sourced::Sourced;
use crate::base::toml_text::TextFault;

/// Plausible densities, g/cm³: from balsa and honeycomb board to filled plastics. Other values must
/// be in kg/m³.
const DENSITY_G_CM3: RangeInclusive<f64> = 0.05..=3.0;
/// Plausible sides of a sheet, mm.
const SIDE_MM: RangeInclusive<f64> = 50.0..=10_000.0;
/// Plausible prices of a sheet, in any currency.
const PRICE: RangeInclusive<f64> = 0.01..=1e6;

/// The file of a sheet, as written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct SheetText {
    id: Spanned<String>,
    name: Spanned<String>,
    inherits: Option<Spanned<String>>,
    material: Option<Spanned<String>>,
    thickness_mm: Option<Spanned<ValueText<f64>>>,
    thickness_range_mm: Option<Spanned<ValueText<[f64; 2]>>>,
    density_g_cm3: Option<Spanned<ValueText<f64>>>,
    grain: Option<Grain>,
    #[serde(default)]
    size: Vec<SizeText>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct SizeText {
    size_mm: Spanned<ValueText<[f64; 2]>>,
    price: Option<Spanned<f64>>,
}

/// The values of a sheet, some of them missing.
struct SheetLayer {
    id: String,
    name: String,
    inherits: Option<String>,
    material: Option<SheetMaterial>,
    thickness_mm: Option<Sourced<f64>>,
    thickness_range_mm: Option<Sourced<[f64; 2]>>,
    density_g_cm3: Option<Sourced<f64>>,
    grain: Option<Grain>,
    sizes: Vec<StockSize>,
}

impl Layer for SheetLayer {
    fn read(reader: &mut Reader) -> Result<(Self, Option<Spanned<String>>), TextFault> {
        let text: SheetText = reader.parse()?;
        if has_chlorine(text.name.get_ref()) {
            let name = text.name.get_ref().clone();
            reader.note(text.name.span().start, Problem::Chlorine(name));
        }
        let number = |reader: &mut Reader, name, range, text: &Option<Spanned<ValueText<f64>>>| {
            let text = text.as_ref();
            text.and_then(|text| reader.value(&Key::new(name, range), text))
        };
        let range = text.thickness_range_mm.as_ref();
        let range_key = Key::new("thickness_range_mm", THICKNESS_MM);
        let layer = Self {
            id: reader.id(&text.id),
            name: reader.words("name", &text.name),
            inherits: text.inherits.as_ref().map(|id| id.get_ref().clone()),
            material: text
                .material
                .as_ref()
                .and_then(|word| reader.material(word)),
            thickness_mm: number(reader, "thickness_mm", THICKNESS_MM, &text.thickness_mm),
            thickness_range_mm: range.and_then(|text| reader.value(&range_key, text)),
            density_g_cm3: number(reader, "density_g_cm3", DENSITY_G_CM3, &text.density_g_cm3),
            grain: text.grain,
            sizes: read_sizes(reader, &text.size),
        };
        Ok((layer, text.inherits))
    }

    /// The sizes of a child replace those of its parent.
    fn over(self, parent: Self) -> Self {
        let sizes = if self.sizes.is_empty() {
            parent.sizes
        } else {
            self.sizes
        };
        Self {
            material: self.material.or(parent.material),
            thickness_mm: self.thickness_mm.or(parent.thickness_mm),
            thickness_range_mm: self.thickness_range_mm.or(parent.thickness_range_mm),
            density_g_cm3: self.density_g_cm3.or(parent.density_g_cm3),
            grain: self.grain.or(parent.grain),
            sizes,
            ..self
        }
    }

    fn into_defaults(mut self, family: &str) -> Self {
        let family = || Some(family.to_owned());
        let numbers = self.thickness_mm.iter_mut();
        let numbers = numbers.chain(&mut self.density_g_cm3);
        numbers.for_each(|number| number.process_default_of = family());
        let sizes = self.sizes.iter_mut().map(|size| &mut size.size_mm);
        let pairs = sizes.chain(&mut self.thickness_range_mm);
        pairs.for_each(|pair| pair.process_default_of = family());
        self
    }
}

fn read_sizes(reader: &mut Reader, texts: &[SizeText]) -> Vec<StockSize> {
    let mut sizes = Vec::new();
    for text in texts {
        if let Some(price) = &text.price {
            let key = Key::new("price", PRICE);
            reader.check_number(price.span().start, &key, *price.get_ref());
        }
        let price = text.price.as_ref().map(|price| *price.get_ref());
        if let Some(size_mm) = reader.value(&Key::new("size_mm", SIDE_MM), &text.size_mm) {
            sizes.push(StockSize { size_mm, price });
        }
    }
    sizes
}

/// Builds the sheet that a profile and its parents describe; fails with all their faults.
///
/// Missing values are reported only if all present ones are right.
pub(super) fn complete_sheet(profile: Profile) -> Result<StockSheet, ProfileError> {
    let mut reader = Reader::new(profile.file, profile.text);
    let Inherited { values, sha256 } = inherit::<SheetLayer>(&SHEETS, profile, &mut reader)?;
    note_range(&mut reader, &values);
    reader.refuse_faults()?;
    let material = reader.required("material", values.material);
    let thickness_mm = reader.required("thickness_mm", values.thickness_mm);
    let density_g_cm3 = reader.required("density_g_cm3", values.density_g_cm3);
    let grain = reader.required("grain", values.grain);
    if values.sizes.is_empty() {
        reader.note(0, Problem::Missing("size"));
    }
    reader.refuse_faults()?;
    let (Some(material), Some(thickness_mm), Some(density_g_cm3), Some(grain)) =
        (material, thickness_mm, density_g_cm3, grain)
    else {
        // Without a fault, no required value is missing.
        return Err(Faults(Vec::new()).into());
    };
    Ok(StockSheet {
        id: values.id,
        name: values.name,
        inherits: values.inherits,
        profile_sha256: sha256,
        material,
        thickness_mm,
        thickness_range_mm: values.thickness_range_mm,
        density_g_cm3,
        grain,
        sizes: values.sizes,
    })
}

/// Notes a thickness outside of the range of sheets on sale.
fn note_range(reader: &mut Reader, values: &SheetLayer) {
    if let (Some(thickness), Some(range)) = (&values.thickness_mm, &values.thickness_range_mm) {
        let [least, most] = range.value;
        if !(least..=most).contains(&thickness.value) {
            let problem = Problem::Contradiction {
                key: "thickness_mm".to_owned(),
                value: thickness.value,
                against: format!("`thickness_range_mm` is {least} to {most}"),
            };
            reader.note(0, problem);
        }
    }
}
