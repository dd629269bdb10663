//! Follows a program line by line.

use std::io::BufRead;

use super::error::{GcodeError, Limit};
use super::feature::Feature;
use super::height::Heights;
use super::label::Labels;
use super::lines::Lines;
use super::machine::{Effect, Machine};
use super::notes::Notes;
use super::sums::{Context, Place, Sums};
use super::toolpath::Toolpath;
use super::totals::{Gauge, Totals};
use super::words::split;
use crate::base::watch::Watch;

/// Lines between two looks at the watch.
const WATCHED: u64 = 1 << 14;

/// What a caller knows about a file and asks of it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Options {
    /// Diameter of the filament, mm; `None` takes what the file states.
    pub filament_diameter_mm: Option<f64>,
    /// Rectangles of the plate that are to be counted apart. A bead belongs to the first that
    /// holds its middle.
    pub places: Vec<Place>,
    /// Edge of the cubes by which support is counted, mm; `None` if its places are not needed.
    pub support_cell_mm: Option<f64>,
}

/// Reads G-code as text, in memory that does not grow with the file.
///
/// # Errors
/// Names the line that is no G-code, that no machine could follow, or that exceeds a [`Limit`].
pub fn read_text(
    input: impl BufRead,
    options: &Options,
    watch: &Watch,
) -> Result<Toolpath, GcodeError> {
    let mut lines = Lines::new(input);
    let mut reader = Reader::new(options);
    while let Some(text) = lines.next_line()? {
        let text = text.trim_ascii();
        reader.number += 1;
        if reader.number.is_multiple_of(WATCHED) {
            watch.check()?;
        }
        reader.take(text)?;
    }
    reader.finish(options)
}

/// All that is known after some lines.
struct Reader {
    number: u64,
    machine: Machine,
    heights: Heights,
    labels: Labels,
    notes: Notes,
    sums: Sums,
    feature: Feature,
    has_features: bool,
}

impl Reader {
    fn new(options: &Options) -> Self {
        Self {
            number: 0,
            machine: Machine::default(),
            heights: Heights::default(),
            labels: Labels::default(),
            notes: Notes::default(),
            sums: Sums::new(&options.places, options.support_cell_mm),
            feature: Feature::Unnamed,
            has_features: false,
        }
    }

    fn take(&mut self, text: &[u8]) -> Result<(), GcodeError> {
        match text {
            [] => Ok(()),
            [b';', comment @ ..] => self.take_comment(&String::from_utf8_lossy(comment)),
            _ => match split(text, self.number) {
                Some((command, line)) if (command.letter, command.number) == (b'M', 486) => {
                    let words = String::from_utf8_lossy(line.rest);
                    let taken = self.labels.take_m486(words.trim());
                    taken.map_err(|limit| self.too_much(limit))
                }
                Some((command, line)) => {
                    let effect = self.machine.execute(command, &line)?;
                    if effect == Effect::None {
                        self.check_bytes(line.rest)?;
                    }
                    self.take_effect(effect)
                }
                None => self.take_other(text),
            },
        }
    }

    /// Takes a comment: a note of the slicer about what follows, or about the whole file.
    fn take_comment(&mut self, comment: &str) -> Result<(), GcodeError> {
        let comment = comment.trim();
        if let Some(name) = strip_any(comment, &["TYPE:", "FEATURE:"]) {
            self.feature = Feature::of_name(name);
            self.has_features = true;
        } else if let Some(value) = strip_any(comment, &["HEIGHT:", "LAYER_HEIGHT:"]) {
            self.heights.state(value);
        } else if comment == "LAYER_CHANGE" || comment == "CHANGE_LAYER" || is_cura_layer(comment) {
            self.heights.begin_layer();
        } else {
            let taken = self.labels.take_comment(comment);
            if !taken.map_err(|limit| self.too_much(limit))? {
                self.notes.take(comment);
            }
        }
        Ok(())
    }

    fn take_effect(&mut self, effect: Effect) -> Result<(), GcodeError> {
        let mut context = Context {
            object: self.labels.current(),
            feature: self.feature,
            layer: self.heights.layers(),
        };
        match effect {
            Effect::None => {}
            Effect::Retraction => self.sums.retract(&context),
            Effect::Stroke(stroke) if stroke.feed == 0.0 => {}
            Effect::Stroke(stroke) => {
                if self.sums.is_bead(&stroke, &context) {
                    let z_mm = stroke.from.z.max(stroke.to.z);
                    let usual_mm = self.notes.layer_height_mm();
                    let height_mm = self.heights.of_bead_mm(z_mm, usual_mm);
                    context.layer = self.heights.layers();
                    let added = self.sums.add(&stroke, height_mm, &context, &self.machine);
                    added.map_err(|limit| self.too_much(limit))?;
                }
            }
        }
        Ok(())
    }

    /// Takes a line that is no command of a number: a macro of Klipper's, or foreign text.
    fn take_other(&mut self, text: &[u8]) -> Result<(), GcodeError> {
        self.check_bytes(text)?;
        let text = String::from_utf8_lossy(text);
        let taken = self.labels.take_macro(&text);
        taken.map_err(|limit| self.too_much(limit))
    }

    /// Refuses bytes that no text has.
    fn check_bytes(&self, text: &[u8]) -> Result<(), GcodeError> {
        let is_foreign = |byte: &u8| *byte < b' ' && !byte.is_ascii_whitespace() && *byte != 0x0b;
        if text.iter().any(is_foreign) {
            return Err(GcodeError::NotText { line: self.number });
        }
        Ok(())
    }

    fn too_much(&self, limit: Limit) -> GcodeError {
        GcodeError::TooMuch {
            line: self.number,
            limit,
        }
    }

    fn finish(mut self, options: &Options) -> Result<Toolpath, GcodeError> {
        if self.number == 0 {
            return Err(GcodeError::Empty);
        }
        if !self.has_features {
            self.sums.forget_features();
        }
        let facts = self.notes.finish();
        let labels = self.labels.into_known();
        if self.sums.sums.is_empty() {
            return Err(GcodeError::NoBeads { lines: self.number });
        }
        let gauge = Gauge::choose(&self.sums, &facts, options.filament_diameter_mm);
        let totals = Totals::gather(&self.sums, &gauge, &labels);
        Ok(Toolpath {
            facts,
            objects: totals.objects,
            places: totals.places,
            supports: totals.supports,
            feed: self.sums.feed,
            diameters_mm: gauge.diameters_mm,
            diameter_source: gauge.source,
            layers: self.heights.layers(),
            lines: self.number,
        })
    }
}

/// Returns the text after the first mark that a comment begins with.
fn strip_any<'a>(comment: &'a str, marks: &[&str]) -> Option<&'a str> {
    marks.iter().find_map(|mark| comment.strip_prefix(mark))
}

/// Returns true for `LAYER:12` and `LAYER:-3`, Cura's marks of layers.
fn is_cura_layer(comment: &str) -> bool {
    comment
        .strip_prefix("LAYER:")
        .is_some_and(|number| number.trim().parse::<i64>().is_ok())
}
