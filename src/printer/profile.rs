//! A profile's text as it stands in its file, and its numbers checked one by one.

use std::{collections::BTreeMap, ops::RangeInclusive};

use serde::Deserialize;
use toml::{Spanned, value::Datetime};

use super::{
    Corner, ExcludedCorner, Fault, Grid, Material, PrintPose, Problem, Quantity, SizedWall,
    Sourced, Support, Sure,
};
use crate::base::toml_text::{self, Place, TextFault};
use crate::base::units::MM_PER_INCH;

/// Sides of a build volume that can be meant, mm. Below it centimetres were given, above it
/// micrometres.
const BUILD_VOLUME_MM: RangeInclusive<f64> = 10.0..=10_000.0;

/// Densities that can be meant, g/cm³: from foam to beyond osmium (22.6). Outside it kg/m³ or g/mm³
/// were given.
const DENSITY_G_CM3: RangeInclusive<f64> = 0.05..=25.0;

/// Shares by which the mass of a sound print may differ; above it per cent were given.
const DENSITY_SPREAD_RATIO: RangeInclusive<f64> = 1e-4..=0.5;

/// Sides of a corner of the plate that can be meant, mm.
const CORNER_MM: RangeInclusive<f64> = 0.1..=5_000.0;

/// Sizes of parts that walls can depend on, mm.
const PART_SIZE_MM: RangeInclusive<f64> = 1.0..=10_000.0;

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
    pub largest_part_mm: Option<Spanned<Quoted<[f64; 3]>>>,
    pub compensates_shrinkage: Option<Spanned<Quoted<bool>>>,
    #[serde(default)]
    pub excluded_corners: Vec<Spanned<CornerText>>,
    #[serde(default)]
    pub walls_by_part_size: Vec<Spanned<WallText>>,
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
    pub density_spread_ratio: Option<Spanned<Quoted<f64>>>,
    pub lot: Option<Spanned<String>>,
    pub measured_on: Option<Spanned<Datetime>>,
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

/// A corner of the plate as written.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CornerText {
    corner: Corner,
    size_mm: [f64; 2],
    source: Option<String>,
    sure: Option<Sure>,
}

/// The least wall of parts up to a size, as written.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WallText {
    up_to_mm: f64,
    wall_mm: f64,
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
        Self {
            file,
            text,
            faults: Vec::new(),
        }
    }

    pub fn parse<T: serde::de::DeserializeOwned>(&self) -> Result<T, TextFault> {
        toml_text::read(self.file, self.text)
    }

    /// Notes a problem with what begins at the byte `offset`.
    pub fn note(&mut self, offset: usize, problem: Problem) {
        self.faults.push(Fault {
            place: Place::of_byte(self.file, self.text, offset),
            problem,
        });
    }

    /// The text, noted if it is blank.
    pub fn words(&mut self, key: &str, text: &Spanned<String>) -> String {
        if text.get_ref().trim().is_empty() {
            self.note(
                text.span().start,
                Problem::Empty {
                    key: key.to_owned(),
                },
            );
        }
        text.get_ref().clone()
    }

    /// The id, noted unless it is fit for file names.
    pub fn id(&mut self, id: &Spanned<String>) -> String {
        let is_fit = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
        if id.get_ref().is_empty() || !id.get_ref().chars().all(is_fit) {
            self.note(
                id.span().start,
                Problem::BadId {
                    id: id.get_ref().clone(),
                },
            );
        }
        id.get_ref().clone()
    }

    /// A number of the table, as a value in its key's unit.
    pub fn number(
        &mut self,
        quantity: Quantity,
        quoted: &Spanned<Quoted<f64>>,
    ) -> Option<Sourced<f64>> {
        let key = quantity.key();
        let at = quoted.span().start;
        let mut quoted = quoted.get_ref().clone();
        if let (Some(dpi), true) = (quoted.dpi, quantity.is_grid_step()) {
            if quoted.value.is_some() {
                self.note(
                    at,
                    Problem::TwoValues {
                        key: key.to_owned(),
                    },
                );
            }
            quoted = Quoted {
                value: Some(MM_PER_INCH / dpi),
                dpi: None,
                ..quoted
            };
        }
        self.sourced(
            Entry {
                key,
                at,
                range: quantity.plausible(),
            },
            quoted,
        )
    }

    /// A box's sides.
    pub fn volume(
        &mut self,
        key: &'static str,
        quoted: &Spanned<Quoted<[f64; 3]>>,
    ) -> Option<Sourced<[f64; 3]>> {
        let entry = Entry {
            key,
            at: quoted.span().start,
            range: BUILD_VOLUME_MM,
        };
        self.sourced(entry, quoted.get_ref().clone())
    }

    /// Whether the machine makes up for shrinkage by itself.
    pub fn flag(
        &mut self,
        key: &'static str,
        quoted: &Spanned<Quoted<bool>>,
    ) -> Option<Sourced<bool>> {
        let entry = Entry {
            key,
            at: quoted.span().start,
            range: BUILD_VOLUME_MM,
        };
        self.sourced(entry, quoted.get_ref().clone())
    }

    /// A corner where nothing may be printed.
    pub fn corner(&mut self, text: &Spanned<CornerText>) -> Option<ExcludedCorner> {
        let CornerText {
            corner,
            size_mm,
            source,
            sure,
        } = text.get_ref().clone();
        let entry = Entry {
            key: "excluded_corners",
            at: text.span().start,
            range: CORNER_MM,
        };
        let size_mm = self.sourced(
            entry,
            Quoted {
                value: Some(size_mm),
                dpi: None,
                source,
                sure,
            },
        )?;
        Some(ExcludedCorner { corner, size_mm })
    }

    /// The least wall of parts up to a size.
    pub fn sized_wall(&mut self, text: &Spanned<WallText>) -> Option<SizedWall> {
        let WallText {
            up_to_mm,
            wall_mm,
            source,
            sure,
        } = text.get_ref().clone();
        let at = text.span().start;
        let key = "walls_by_part_size";
        self.judge(
            &Entry {
                key,
                at,
                range: PART_SIZE_MM,
            },
            up_to_mm,
        );
        let entry = Entry {
            key,
            at,
            range: Quantity::MinWallMm.plausible(),
        };
        let wall_mm = self.sourced(
            entry,
            Quoted {
                value: Some(wall_mm),
                dpi: None,
                source,
                sure,
            },
        )?;
        Some(SizedWall { up_to_mm, wall_mm })
    }

    /// A material with its two numbers.
    pub fn material(&mut self, text: &MaterialText) -> Option<Material> {
        let id = self.id(&text.id);
        let name = self.words("name", &text.name);
        let density = self.number_of("density_g_cm3", &text.density_g_cm3, DENSITY_G_CM3);
        let spread = text.density_spread_ratio.as_ref();
        let spread = spread
            .map(|quoted| self.number_of("density_spread_ratio", quoted, DENSITY_SPREAD_RATIO));
        let lot = text.lot.as_ref().map(|lot| self.words("lot", lot));
        let measured_on = text.measured_on.as_ref().and_then(|day| self.day(day));
        let density = density?;
        if density.sure == Sure::Measured {
            self.note_not_dated(text, &id);
        }
        let density_spread_ratio = spread.flatten();
        Some(Material {
            id,
            name,
            density_g_cm3: density,
            density_spread_ratio,
            lot,
            measured_on,
        })
    }

    fn number_of(
        &mut self,
        key: &'static str,
        quoted: &Spanned<Quoted<f64>>,
        range: RangeInclusive<f64>,
    ) -> Option<Sourced<f64>> {
        self.sourced(
            Entry {
                key,
                at: quoted.span().start,
                range,
            },
            quoted.get_ref().clone(),
        )
    }

    /// A day without a time, as year-month-day.
    fn day(&mut self, day: &Spanned<Datetime>) -> Option<String> {
        let text = day.get_ref().to_string();
        if day.get_ref().date.is_some() && day.get_ref().time.is_none() {
            return Some(text);
        }
        self.note(day.span().start, Problem::NotADay { value: text });
        None
    }

    /// Notes what a measured density lacks to be traced.
    fn note_not_dated(&mut self, text: &MaterialText, id: &str) {
        for (is_there, missing) in [
            (text.measured_on.is_some(), "measured_on"),
            (text.lot.is_some(), "lot"),
        ] {
            if !is_there {
                self.note(
                    text.density_g_cm3.span().start,
                    Problem::NotDated {
                        id: id.to_owned(),
                        missing,
                    },
                );
            }
        }
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
            Some(value) => value
                .numbers()
                .iter()
                .for_each(|&number| self.judge(&entry, number)),
        }
        Some(Sourced {
            value: quoted.value?,
            source: source?,
            sure: quoted.sure?,
            process_default_of: None,
        })
    }

    /// Notes a number that is not positive and finite, or that cannot be meant.
    fn judge(&mut self, entry: &Entry, value: f64) {
        let key = entry.key.to_owned();
        if !(value.is_finite() && value > 0.0) {
            self.note(entry.at, Problem::NotPositive { key, value });
        } else if !entry.range.contains(&value) {
            let (least, most) = (*entry.range.start(), *entry.range.end());
            self.note(
                entry.at,
                Problem::Implausible {
                    key,
                    value,
                    least,
                    most,
                },
            );
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

impl<const N: usize> Numbers for [f64; N] {
    fn numbers(&self) -> &[f64] {
        self
    }
}

impl Numbers for bool {
    fn numbers(&self) -> &[f64] {
        &[]
    }
}
