//! Writes a program again with more or less material in some of its beads.

#[cfg(test)]
mod tests;

use std::io::{BufRead, Write};

use super::edit::{command_of, replace_word, short, word_of};
use super::error::{GcodeError, Limit, from_io};
use super::feature::Feature;
use super::follow::Follower;
use super::lines::read_whole;
use super::machine::{Effect, Stroke};
use super::parse::WATCHED;
use super::pieces::{Piece, cut};
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Point, Vector};
use crate::mass::Moments;

/// The first line of a program that was written so. Twice would scale it twice.
pub const MARK: &str = "; extrusion scaled by equipoise";
/// Steps of E in the written program, mm or mm³: what slicers write.
const E_STEP: f64 = 1e-5;
/// A factor may leave its bounds by this: a mean over a piece is rounded.
const ROUNDING: f64 = 1e-9;
/// Bytes of a line that is copied. Slicers put whole programs of the machine into a comment.
const MOST_LINE: u64 = 1 << 20;
/// Seconds in a minute.
const S_PER_MIN: f64 = 60.0;
/// Speeds that differ by less are one, mm/min.
const SAME_SPEED: f64 = 1e-9;

/// Says how much is laid where.
pub trait Portions {
    /// Returns whether the beads of a feature are scaled at a place: the middle of a bead, and of
    /// its height, on the plate, mm.
    ///
    /// # Errors
    /// The place cannot be told.
    fn takes(&self, feature: Feature, middle: &Point) -> Result<bool, String>;

    /// Returns the factor on what a feature lays at a place.
    fn factor(&self, feature: Feature, at: &Point) -> f64;

    /// Returns whether a place could be given more or less than it gets.
    fn is_free(&self, at: &Point) -> bool;
}

/// An order to write a program again.
#[derive(Clone, Copy)]
pub struct Rewriting<'a> {
    /// The portions of material at every place.
    pub portions: &'a dyn Portions,
    /// Longest piece into which a bead is cut, mm.
    pub piece_mm: f64,
    /// Least and greatest factor.
    pub factors: [f64; 2],
    /// Most that the hot end melts, mm³/s. Pieces that need more are laid more slowly.
    pub most_flow_mm3_s: f64,
    /// Cross-section of the filament, mm².
    pub filament_mm2: f64,
}

/// The counts of what was written.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize)]
pub struct Rewritten {
    /// Number of beads that were scaled.
    pub beads: u64,
    /// Number of pieces in their place.
    pub pieces: u64,
    /// Number of pieces that are laid more slowly than the slicer wanted.
    pub slowed: u64,
    /// Least and greatest factor; zero without beads.
    pub factors: [f64; 2],
    /// Feed of E in these beads, before and after: mm of filament, or mm³ if it is volumetric.
    pub fed: [f64; 2],
    /// The moments of what was laid at places that are free, on the plate, mm³ to mm⁵.
    #[serde(skip)]
    pub free: Moments,
}

/// A reason why a program is not written again.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RewriteError {
    /// The program cannot be followed.
    #[error(transparent)]
    Gcode(#[from] GcodeError),
    /// It was written so before.
    #[error("it is scaled already; remedy: give the G-code that the slicer wrote")]
    Already,
    /// A bead is told in a way that cannot be cut into pieces.
    #[error(
        "line {line}: material is laid by {how}; remedy: let the slicer write absolute places in mm"
    )]
    Manner {
        /// The line.
        line: u64,
        /// The manner.
        how: &'static str,
    },
    /// A place asks for more or less than a line can be.
    #[error(
        "line {line}: the field asks for {factor:.2} times what the slicer lays, at {at} on the plate; \
         remedy: {}",
        if *factor > 1.0 { "slice with more infill, or make the field less dense" }
        else { "slice with less infill, or make the field denser" }
    )]
    Factor {
        /// The line.
        line: u64,
        /// The factor.
        factor: f64,
        /// The place on the plate, mm.
        at: String,
    },
    /// A place cannot be told.
    #[error("line {line}: {reason}")]
    Place {
        /// The line.
        line: u64,
        /// The reason, with its remedy.
        reason: String,
    },
    /// The program cannot be written.
    #[error("cannot write the program: {0}")]
    Write(#[from] std::io::Error),
    /// The watch was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Writes a program again, with its chosen beads cut into pieces and scaled. All else stays as it
/// is, but for absolute places of E, which follow.
///
/// Memory does not grow with the program. The rounding of E is carried on, so that it does not
/// add up.
///
/// # Errors
/// The program cannot be followed or written, was scaled before, or asks for too much.
pub fn rewrite_text(
    mut input: impl BufRead,
    output: &mut dyn Write,
    rewriting: &Rewriting,
    watch: &Watch,
) -> Result<Rewritten, RewriteError> {
    let mut writer = Writer {
        follower: Follower::new(),
        rewriting,
        output,
        shift_steps: 0,
        left: 0.0,
        asked_speed: 0.0,
        written_speed: 0.0,
        done: Rewritten::default(),
    };
    let mut line = Vec::new();
    writeln!(writer.output, "{MARK}")?;
    while read_whole(&mut input, &mut line, MOST_LINE).map_err(|error| writer.unreadable(error))? {
        if writer.follower.number.is_multiple_of(WATCHED) {
            watch.check()?;
        }
        writer.take(&line)?;
    }
    Ok(writer.done)
}

/// A bead that is scaled.
struct ScaledBead {
    feature: Feature,
    /// From the middle of the bead's height to the nozzle, mm.
    down: Vector,
}

/// A program that is being written.
struct Writer<'a> {
    follower: Follower,
    rewriting: &'a Rewriting<'a>,
    output: &'a mut dyn Write,
    /// Lead of absolute places of E over those of the slicer, in steps.
    shift_steps: i64,
    /// Rest that is still to be fed, as rounding left it.
    left: f64,
    /// The speed that holds in the slicer's program, mm/min.
    asked_speed: f64,
    /// The speed that holds in the written program, mm/min.
    written_speed: f64,
    done: Rewritten,
}

impl Writer<'_> {
    fn take(&mut self, line: &[u8]) -> Result<(), RewriteError> {
        let text = line.trim_ascii();
        if text.starts_with(MARK.as_bytes()) {
            return Err(RewriteError::Already);
        }
        let effect = self.follower.take(text)?;
        let command = command_of(text);
        let is_move = matches!(command, Some((b'G', 0..=3)));
        if is_move && let Some(speed) = word_of(text, b'F') {
            self.asked_speed = speed;
        }
        if let Effect::Stroke(stroke) = effect
            && stroke.feed > 0.0
            && let Some(bead) = self.scaled_bead(&stroke)?
        {
            return self.scale(&stroke, &bead);
        }
        if command == Some((b'G', 92)) && self.names_e(text) {
            (self.shift_steps, self.left) = (0, 0.0);
        }
        self.copy(line, is_move)
    }

    /// Returns whether `G92` gives E a new name: it does without any axis, too.
    fn names_e(&self, text: &[u8]) -> bool {
        let has = |letter: u8| word_of(text, letter).is_some();
        has(b'E') || !b"XYZ".iter().any(|letter| has(*letter))
    }

    /// Copies a line. An absolute place of E moves on with what was scaled before.
    fn copy(&mut self, line: &[u8], is_move: bool) -> Result<(), RewriteError> {
        let text = line.trim_ascii();
        let is_slowed = (self.written_speed - self.asked_speed).abs() > SAME_SPEED;
        if is_move {
            if is_slowed && word_of(text, b'F').is_none() {
                writeln!(self.output, "G1 F{}", self.asked_speed)?;
            }
            self.written_speed = self.asked_speed;
        }
        let is_absolute = !self.follower.machine.is_e_relative();
        if is_move && is_absolute && self.shift_steps != 0 && word_of(text, b'E').is_some() {
            let at = self.follower.machine.e() + self.ahead();
            let at = self.follower.machine.word_of_e(at);
            self.output.write_all(&replace_word(line, b'E', at))?;
        } else {
            self.output.write_all(line)?;
        }
        self.output.write_all(b"\n")?;
        Ok(())
    }

    /// Returns the bead that a stroke lays, if it is scaled. Sets the height of its layer, too.
    fn scaled_bead(&mut self, stroke: &Stroke) -> Result<Option<ScaledBead>, RewriteError> {
        let along = stroke.to - stroke.from;
        if stroke.turn.is_none() && along.x == 0.0 && along.y == 0.0 {
            return Ok(None);
        }
        let feature = self.follower.context().feature;
        let height_mm = self.follower.height_of_mm(stroke);
        let down = Vector::new(0.0, 0.0, 0.5 * height_mm);
        let middle = nalgebra::center(&stroke.from, &stroke.to) - down;
        let takes = self.rewriting.portions.takes(feature, &middle);
        let line = self.follower.number;
        let takes = takes.map_err(|reason| RewriteError::Place { line, reason })?;
        Ok(takes.then_some(ScaledBead { feature, down }))
    }

    /// Writes a bead in pieces, each with what the field asks for there.
    fn scale(&mut self, stroke: &Stroke, bead: &ScaledBead) -> Result<(), RewriteError> {
        let line = self.follower.number;
        if let Some(how) = self.follower.machine.odd_manner() {
            return Err(RewriteError::Manner { line, how });
        }
        let pieces = cut(stroke, self.rewriting.piece_mm);
        let share = stroke.feed / pieces.len() as f64;
        let before = self.follower.machine.e() - stroke.feed + self.ahead();
        let mut steps = 0;
        for piece in &pieces {
            let factor = self.factor(piece, bead)?;
            let wanted = share * factor + self.left;
            let fed = (wanted / E_STEP).round() as i64;
            self.left = wanted - fed as f64 * E_STEP;
            steps += fed;
            let fed = fed as f64 * E_STEP;
            let at_e = if self.follower.machine.is_e_relative() {
                fed
            } else {
                before + steps as f64 * E_STEP
            };
            self.lay(stroke, piece, [at_e, fed])?;
            self.add_free(&(piece.middle - bead.down), fed);
        }
        self.done.beads += 1;
        self.done.pieces += pieces.len() as u64;
        self.done.fed[0] += stroke.feed;
        self.done.fed[1] += steps as f64 * E_STEP;
        self.shift_steps += steps - (stroke.feed / E_STEP).round() as i64;
        Ok(())
    }

    /// Adds a piece to the moments of what could be given more or less.
    fn add_free(&mut self, at: &Point, fed: f64) {
        if self.rewriting.portions.is_free(at) {
            let moments = Moments(Moments::monomials(at.x, at.y, at.z));
            self.done.free += moments * self.volume_mm3(fed);
        }
    }

    /// Returns the volume of what a step of E feeds, mm³.
    fn volume_mm3(&self, fed: f64) -> f64 {
        match self.follower.machine.is_volumetric {
            true => fed,
            false => fed * self.rewriting.filament_mm2,
        }
    }

    /// Returns what absolute places of E are ahead of those of the slicer, mm or mm³.
    fn ahead(&self) -> f64 {
        self.shift_steps as f64 * E_STEP
    }

    /// Returns the mean factor along a piece, by Simpson's rule: exact for fields up to the third
    /// degree.
    fn factor(&mut self, piece: &Piece, bead: &ScaledBead) -> Result<f64, RewriteError> {
        let portions = self.rewriting.portions;
        let at = |place: &Point| portions.factor(bead.feature, &(place - bead.down));
        let factor = (at(&piece.from) + 4.0 * at(&piece.middle) + at(&piece.to)) / 6.0;
        self.note(factor, &piece.middle)?;
        Ok(factor)
    }

    /// Notes the factor of a piece.
    fn note(&mut self, factor: f64, at: &Point) -> Result<(), RewriteError> {
        let [least, most] = self.rewriting.factors;
        if !(least - ROUNDING..=most + ROUNDING).contains(&factor) {
            return Err(RewriteError::Factor {
                line: self.follower.number,
                factor,
                at: format!("{:.1}, {:.1}, {:.1}", at.x, at.y, at.z),
            });
        }
        let [low, high] = self.done.factors;
        self.done.factors = if high == 0.0 {
            [factor; 2]
        } else {
            [low.min(factor), high.max(factor)]
        };
        Ok(())
    }

    /// Writes a piece: to its end, with this word of E, and with what it feeds.
    fn lay(&mut self, stroke: &Stroke, piece: &Piece, fed: [f64; 2]) -> Result<(), RewriteError> {
        let [e, fed] = fed;
        let machine = &self.follower.machine;
        let to = machine.program_place(&piece.to);
        let name = match piece.turn {
            None => "G1",
            Some(turn) if turn.angle_rad < 0.0 => "G2",
            Some(_) => "G3",
        };
        let [x, y, z] = [to.x, to.y, to.z].map(short);
        write!(self.output, "{name} X{x} Y{y}")?;
        if stroke.from.z != stroke.to.z {
            write!(self.output, " Z{z}")?;
        }
        if let Some(turn) = piece.turn {
            let [x, y] = turn.axis_mm;
            let [i, j] = [x - piece.from.x, y - piece.from.y].map(short);
            write!(self.output, " I{i} J{j}")?;
        }
        let volume_mm3 = self.volume_mm3(fed);
        let most = self.rewriting.most_flow_mm3_s * S_PER_MIN * piece.length_mm / volume_mm3;
        let speed = self.asked_speed.min(most);
        if speed < self.asked_speed {
            self.done.slowed += 1;
        }
        write!(self.output, " E{e:.5}")?;
        if (speed - self.written_speed).abs() > SAME_SPEED {
            write!(self.output, " F{speed:.1}")?;
            self.written_speed = speed;
        }
        writeln!(self.output)?;
        Ok(())
    }

    fn unreadable(&self, error: std::io::Error) -> RewriteError {
        let line = self.follower.number + 1;
        let fault = match error.kind() {
            std::io::ErrorKind::FileTooLarge => GcodeError::TooMuch {
                line,
                limit: Limit::Line,
            },
            _ => from_io(error, line),
        };
        fault.into()
    }
}
