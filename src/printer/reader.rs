//! The checks of a profile's values one by one; all faults are collected.

use std::ops::RangeInclusive;

use toml::{Spanned, value::Datetime};

use super::{
    ExcludedCorner, Fault, InfillPattern, Material, Problem, Quantity, SizedWall, Sourced, Sure,
    profile::{CornerText, MaterialText, ProfileText, ValueText, WallText},
    quantity::INFILL_RATIOS,
};
use crate::base::dialect::Dialect;
use crate::base::toml_text::{self, Place, TextFault};
use crate::base::units::MM_PER_INCH;

/// Plausible sides of a build volume, mm. Smaller values must be in centimetres, larger ones in
/// micrometres.
const BUILD_VOLUME_MM: RangeInclusive<f64> = 10.0..=10_000.0;

/// Plausible densities, g/cm³: from foam to beyond osmium (22.6). Other values must be in kg/m³ or
/// g/mm³.
const DENSITY_G_CM3: RangeInclusive<f64> = 0.05..=25.0;

/// Plausible relative spreads of the mass of sound prints. Larger values must be in per cent.
const DENSITY_SPREAD_RATIO: RangeInclusive<f64> = 1e-4..=0.5;
/// Plausible flows of filaments. The judge of toolpaths takes these off; others are faults.
pub(super) const FLOW_RATIO: RangeInclusive<f64> = 0.92..=1.08;

/// Plausible sides of an excluded corner, mm.
const CORNER_MM: RangeInclusive<f64> = 0.1..=5_000.0;

/// Plausible sizes of parts on which the thinnest wall depends, mm.
const PART_SIZE_MM: RangeInclusive<f64> = 1.0..=10_000.0;

/// A file being checked: its name, its text, and the faults found so far.
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

    /// Notes a problem with the value that begins at the byte `offset`.
    pub fn note(&mut self, offset: usize, problem: Problem) {
        self.faults.push(Fault {
            place: Place::of_byte(self.file, self.text, offset),
            problem,
        });
    }

    /// Returns a text for people; notes a blank one.
    pub fn words(&mut self, key: &str, text: &Spanned<String>) -> String {
        if text.get_ref().trim().is_empty() {
            let key = key.to_owned();
            self.note(text.span().start, Problem::Empty { key });
        }
        text.get_ref().clone()
    }

    /// Returns an id; notes one that is unfit for file names.
    pub fn id(&mut self, id: &Spanned<String>) -> String {
        let is_fit = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
        let at = id.span().start;
        if id.get_ref().is_empty() || !id.get_ref().chars().all(is_fit) {
            let id = id.get_ref().clone();
            self.note(at, Problem::BadId { id });
        }
        id.get_ref().clone()
    }

    /// Returns a number of the table in the unit of its key.
    pub fn number(
        &mut self,
        quantity: Quantity,
        text: &Spanned<ValueText<f64>>,
    ) -> Option<Sourced<f64>> {
        let key = quantity.key();
        let at = text.span().start;
        let mut text = text.get_ref().clone();
        if let (Some(dpi), true) = (text.dpi, quantity.is_grid_step()) {
            if text.value.is_some() {
                let key = key.to_owned();
                self.note(at, Problem::TwoValues { key });
            }
            text = ValueText {
                value: Some(MM_PER_INCH / dpi),
                dpi: None,
                ..text
            };
        }
        let range = quantity.plausible();
        self.check(Entry { key, at, range }, text)
    }

    /// Returns the sides of a box.
    pub fn volume(
        &mut self,
        key: &'static str,
        text: &Spanned<ValueText<[f64; 3]>>,
    ) -> Option<Sourced<[f64; 3]>> {
        let entry = Entry {
            key,
            at: text.span().start,
            range: BUILD_VOLUME_MM,
        };
        self.check(entry, text.get_ref().clone())
    }

    /// Returns a true-or-false value.
    pub fn flag(
        &mut self,
        key: &'static str,
        text: &Spanned<ValueText<bool>>,
    ) -> Option<Sourced<bool>> {
        let entry = Entry {
            key,
            at: text.span().start,
            range: BUILD_VOLUME_MM,
        };
        self.check(entry, text.get_ref().clone())
    }

    /// Returns the family of slicers that a plate gives orders to.
    pub fn dialect(&mut self, text: &Spanned<ValueText<Dialect>>) -> Option<Sourced<Dialect>> {
        let entry = Entry {
            key: "dialect",
            at: text.span().start,
            range: BUILD_VOLUME_MM,
        };
        self.check(entry, text.get_ref().clone())
    }

    /// Returns the pattern of infill with its table; `None` if either is missing, which is noted if
    /// the other is there.
    pub fn infill(&mut self, text: &ProfileText) -> Option<InfillPattern> {
        let (pattern, table) = match (&text.infill_pattern, &text.infill_core_ratio) {
            (Some(pattern), Some(table)) => (pattern, table),
            (Some(pattern), None) => {
                let key = "infill_core_ratio".to_owned();
                self.note(pattern.span().start, Problem::Missing { key });
                return None;
            }
            (None, Some(table)) => {
                let key = "infill_pattern".to_owned();
                self.note(table.span().start, Problem::Missing { key });
                return None;
            }
            (None, None) => return None,
        };
        let (key, at) = ("infill_core_ratio", table.span().start);
        let range = INFILL_RATIOS;
        let core_ratio = self.check(Entry { key, at, range }, table.get_ref().clone());
        let rows = table
            .get_ref()
            .value
            .iter()
            .flat_map(|rows| rows.windows(2));
        for rows in rows.filter(|rows| rows[0][0] >= rows[1][0]) {
            let problem = Problem::Contradiction {
                key: key.to_owned(),
                value: rows[1][0],
                against: format!("the row before it is for {}", rows[0][0]),
            };
            self.note(at, problem);
        }
        Some(InfillPattern {
            pattern: self.words("infill_pattern", pattern),
            core_ratio: core_ratio?,
        })
    }

    /// Returns a corner that must stay free.
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
        let size_mm = self.check(
            entry,
            ValueText {
                value: Some(size_mm),
                dpi: None,
                source,
                sure,
            },
        )?;
        Some(ExcludedCorner { corner, size_mm })
    }

    /// Returns the thinnest wall of parts up to a size.
    pub fn sized_wall(&mut self, text: &Spanned<WallText>) -> Option<SizedWall> {
        let WallText {
            up_to_mm,
            wall_mm,
            source,
            sure,
        } = text.get_ref().clone();
        let at = text.span().start;
        let key = "walls_by_part_size";
        let range = PART_SIZE_MM;
        self.check_number(&Entry { key, at, range }, up_to_mm);
        let range = Quantity::MinWallMm.plausible();
        let entry = Entry { key, at, range };
        let wall_mm = self.check(
            entry,
            ValueText {
                value: Some(wall_mm),
                dpi: None,
                source,
                sure,
            },
        )?;
        Some(SizedWall { up_to_mm, wall_mm })
    }

    /// Returns a material; `None` without a usable density.
    pub fn material(&mut self, text: &MaterialText) -> Option<Material> {
        let id = self.id(&text.id);
        let name = self.words("name", &text.name);
        let density = self.number_within("density_g_cm3", &text.density_g_cm3, DENSITY_G_CM3);
        let spread = text.density_spread_ratio.as_ref();
        let spread = spread
            .map(|text| self.number_within("density_spread_ratio", text, DENSITY_SPREAD_RATIO));
        let slide = Quantity::ClearanceSlidePerSideMm;
        let gap = text.clearance_slide_per_side_mm.as_ref();
        let gap = gap.and_then(|text| self.number_within(slide.key(), text, slide.plausible()));
        let flow = text.flow_ratio.as_ref();
        let flow = flow.and_then(|text| self.number_within("flow_ratio", text, FLOW_RATIO));
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
            clearance_slide_per_side_mm: gap,
            flow_ratio: flow,
            lot,
            measured_on,
        })
    }

    fn number_within(
        &mut self,
        key: &'static str,
        text: &Spanned<ValueText<f64>>,
        range: RangeInclusive<f64>,
    ) -> Option<Sourced<f64>> {
        let at = text.span().start;
        self.check(Entry { key, at, range }, text.get_ref().clone())
    }

    /// Returns a day as year-month-day; notes a time of day.
    fn day(&mut self, day: &Spanned<Datetime>) -> Option<String> {
        let text = day.get_ref().to_string();
        if day.get_ref().date.is_some() && day.get_ref().time.is_none() {
            return Some(text);
        }
        self.note(day.span().start, Problem::NotADay { value: text });
        None
    }

    /// Notes a missing day or lot of a measured density.
    fn note_not_dated(&mut self, text: &MaterialText, id: &str) {
        for (is_given, missing) in [
            (text.measured_on.is_some(), "measured_on"),
            (text.lot.is_some(), "lot"),
        ] {
            if !is_given {
                let id = id.to_owned();
                let at = text.density_g_cm3.span().start;
                self.note(at, Problem::NotDated { id, missing });
            }
        }
    }

    /// Returns the value with its source; notes everything missing or implausible.
    fn check<T: Numbers>(&mut self, entry: Entry, text: ValueText<T>) -> Option<Sourced<T>> {
        let key = || entry.key.to_owned();
        if text.dpi.is_some() {
            self.note(entry.at, Problem::DpiNotAStep { key: key() });
        }
        let source = text.source.filter(|source| !source.trim().is_empty());
        if source.is_none() {
            self.note(entry.at, Problem::NoSource { key: key() });
        }
        if text.sure.is_none() {
            self.note(entry.at, Problem::NotSure { key: key() });
        }
        match &text.value {
            None => self.note(entry.at, Problem::NoValue { key: key() }),
            Some(value) => value
                .numbers()
                .iter()
                .for_each(|&number| self.check_number(&entry, number)),
        }
        Some(Sourced {
            value: text.value?,
            source: source?,
            sure: text.sure?,
            process_default_of: None,
        })
    }

    /// Notes a number that is not positive and finite, or not plausible.
    fn check_number(&mut self, entry: &Entry, value: f64) {
        let key = entry.key.to_owned();
        if !(value.is_finite() && value > 0.0) {
            self.note(entry.at, Problem::NotPositive { key, value });
        } else if !entry.range.contains(&value) {
            let problem = Problem::Implausible {
                key,
                value,
                least: *entry.range.start(),
                most: *entry.range.end(),
            };
            self.note(entry.at, problem);
        }
    }
}

/// The key, the place and the plausible range of a value.
struct Entry {
    key: &'static str,
    at: usize,
    range: RangeInclusive<f64>,
}

/// A value whose numbers are checked.
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

impl Numbers for Vec<[f64; 2]> {
    fn numbers(&self) -> &[f64] {
        self.as_flattened()
    }
}

impl Numbers for Dialect {
    fn numbers(&self) -> &[f64] {
        &[]
    }
}

impl Numbers for bool {
    fn numbers(&self) -> &[f64] {
        &[]
    }
}
