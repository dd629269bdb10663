//! Follows a program line by line.

use std::io::BufRead;

use super::error::GcodeError;
use super::follow::Follower;
use super::lines::Lines;
use super::machine::Effect;
use super::sums::{Place, Sums};
use super::toolpath::Toolpath;
use super::totals::{Gauge, Totals};
use crate::base::watch::Watch;

/// Lines between two looks at the watch.
pub(super) const WATCHED: u64 = 1 << 14;

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
/// Names the line that is no G-code, that no machine could follow, or that exceeds a bound.
pub fn read_text(
    input: impl BufRead,
    options: &Options,
    watch: &Watch,
) -> Result<Toolpath, GcodeError> {
    let mut lines = Lines::new(input);
    let mut reader = Reader::new(options);
    while let Some(text) = lines.next_line()? {
        let text = text.trim_ascii();
        if reader.follower.number.is_multiple_of(WATCHED) {
            watch.check()?;
        }
        reader.take(text)?;
    }
    reader.finish(options)
}

/// The program so far, and the sums of its beads.
struct Reader {
    follower: Follower,
    sums: Sums,
}

impl Reader {
    fn new(options: &Options) -> Self {
        Self {
            follower: Follower::new(),
            sums: Sums::new(&options.places, options.support_cell_mm),
        }
    }

    fn take(&mut self, text: &[u8]) -> Result<(), GcodeError> {
        let effect = self.follower.take(text)?;
        self.take_effect(effect)
    }

    fn take_effect(&mut self, effect: Effect) -> Result<(), GcodeError> {
        let mut context = self.follower.context();
        match effect {
            Effect::None => {}
            Effect::Retraction => self.sums.retract(&context),
            Effect::Stroke(stroke) if stroke.feed == 0.0 => {}
            Effect::Stroke(stroke) => {
                if self.sums.is_bead(&stroke, &context) {
                    let height_mm = self.follower.height_of_mm(&stroke);
                    context.layer = self.follower.heights.layers();
                    let machine = &self.follower.machine;
                    let added = self.sums.add(&stroke, height_mm, &context, machine);
                    added.map_err(|limit| self.follower.too_much(limit))?;
                }
            }
        }
        Ok(())
    }

    fn finish(mut self, options: &Options) -> Result<Toolpath, GcodeError> {
        let follower = self.follower;
        if follower.number == 0 {
            return Err(GcodeError::Empty);
        }
        if !follower.has_features {
            self.sums.forget_features();
        }
        let facts = follower.notes.finish();
        let labels = follower.labels.into_known();
        if self.sums.sums.is_empty() {
            return Err(GcodeError::NoBeads {
                lines: follower.number,
            });
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
            layers: follower.heights.layers(),
            lines: follower.number,
        })
    }
}
