//! Follows a program: its machine, its layers, and what its comments say of the beads.

use super::error::{GcodeError, Limit};
use super::feature::Feature;
use super::height::Heights;
use super::label::Labels;
use super::machine::{Effect, Machine, Stroke};
use super::notes::Notes;
use super::sums::Context;
use super::words::split;

/// All that is known of a program after some lines.
pub struct Follower {
    /// The number of the latest line, from 1.
    pub number: u64,
    /// The machine.
    pub machine: Machine,
    /// The layers.
    pub heights: Heights,
    /// The objects.
    pub labels: Labels,
    /// The slicer's words about the whole file.
    pub notes: Notes,
    /// True if the file names features.
    pub has_features: bool,
    feature: Feature,
}

impl Follower {
    /// Starts before the first line.
    pub fn new() -> Self {
        Self {
            number: 0,
            machine: Machine::default(),
            heights: Heights::default(),
            labels: Labels::default(),
            notes: Notes::default(),
            feature: Feature::Unnamed,
            has_features: false,
        }
    }

    /// Takes the next line, without blanks at its ends; returns what it does.
    ///
    /// # Errors
    /// Names the line that is no G-code, or that no machine could follow.
    pub fn take(&mut self, text: &[u8]) -> Result<Effect, GcodeError> {
        self.number += 1;
        match text {
            [] => Ok(Effect::None),
            [b';', comment @ ..] => {
                self.take_comment(&String::from_utf8_lossy(comment))?;
                Ok(Effect::None)
            }
            _ => match split(text, self.number) {
                Some((command, line)) if (command.letter, command.number) == (b'M', 486) => {
                    let words = String::from_utf8_lossy(line.rest);
                    let taken = self.labels.take_m486(words.trim());
                    taken.map_err(|limit| self.too_much(limit))?;
                    Ok(Effect::None)
                }
                Some((command, line)) => {
                    let effect = self.machine.execute(command, &line)?;
                    if effect == Effect::None {
                        self.check_bytes(line.rest)?;
                    }
                    Ok(effect)
                }
                None => {
                    self.take_other(text)?;
                    Ok(Effect::None)
                }
            },
        }
    }

    /// Returns the circumstances of a bead that is laid now.
    pub fn context(&self) -> Context {
        Context {
            object: self.labels.current(),
            feature: self.feature,
            layer: self.heights.layers(),
        }
    }

    /// Returns the height of a bead, mm.
    pub fn height_of_mm(&mut self, stroke: &Stroke) -> f64 {
        let z_mm = stroke.from.z.max(stroke.to.z);
        self.heights.of_bead_mm(z_mm, self.notes.layer_height_mm())
    }

    /// Returns the fault of a file that exceeds a limit at this line.
    pub fn too_much(&self, limit: Limit) -> GcodeError {
        GcodeError::TooMuch {
            line: self.number,
            limit,
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
