//! The state of a machine that follows a program: where its nozzle is and what it lays.

use super::arc::{self, Centre};
use super::error::GcodeError;
use super::words::{Command, Line};
use crate::base::units::MM_PER_INCH;
use crate::geom::{Point, Vector};
use crate::mass::Turn;

/// Tools that are counted apart; numbers beyond are commands of other kinds.
const MOST_TOOLS: u32 = 256;
/// The letters of the axes.
const AXES: &[u8; 3] = b"XYZ";
/// Full turns that an arc may add.
const MOST_TURNS: f64 = 1000.0;

/// A move, with what the extruder does meanwhile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// Start, mm.
    pub from: Point,
    /// End, mm.
    pub to: Point,
    /// The turn of an arc.
    pub turn: Option<Turn>,
    /// What E moves: mm of filament, or mm³ if it is volumetric.
    pub feed: f64,
}

/// An effect of a command on the print.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Effect {
    /// None, or only on the machine's state.
    None,
    /// A move.
    Stroke(Stroke),
    /// A retraction by the firmware (`G10`).
    Retraction,
}

/// The state of the machine.
#[derive(Debug, Clone)]
pub struct Machine {
    /// The nozzle in the coordinates of the machine, mm.
    at: Point,
    /// Less this, it is what the program takes for its place (`G92`), mm.
    origin: Vector,
    /// What the program takes for the place of E, mm or mm³.
    e: f64,
    /// Length of a unit, mm (`G20`, `G21`).
    unit_mm: f64,
    /// `G91` in the place of `G90`.
    is_relative: bool,
    /// `M83` in the place of `M82`.
    is_e_relative: bool,
    /// `G90.1` in the place of `G91.1`.
    has_absolute_centres: bool,
    /// `G17`, not `G18` or `G19`.
    is_level: bool,
    /// True if `M200` makes E a volume.
    pub is_volumetric: bool,
    /// The factor of `M221`.
    pub flow_ratio: f64,
    /// The tool.
    pub tool: u16,
}

impl Default for Machine {
    fn default() -> Self {
        Self {
            at: Point::origin(),
            origin: Vector::zeros(),
            e: 0.0,
            unit_mm: 1.0,
            is_relative: false,
            is_e_relative: false,
            has_absolute_centres: false,
            is_level: true,
            is_volumetric: false,
            flow_ratio: 1.0,
            tool: 0,
        }
    }
}

/// The words of a move.
#[derive(Debug, Clone, Copy, Default)]
struct Words {
    xyz: [Option<f64>; 3],
    e: Option<f64>,
    i: Option<f64>,
    j: Option<f64>,
    r: Option<f64>,
    p: Option<f64>,
}

impl Machine {
    /// Executes a command. Passes over all that neither moves nor lays material.
    pub fn execute(&mut self, command: Command, line: &Line) -> Result<Effect, GcodeError> {
        match (command.letter, command.number, command.after_dot) {
            (b'G', 0 | 1, 0) => return self.straight(line),
            (b'G', 2, 0) => return self.arc(line, -1.0),
            (b'G', 3, 0) => return self.arc(line, 1.0),
            (b'G', 5, 0) => self.refuse_spline(line)?,
            (b'G', 10, 0) => return firmware_retraction(line),
            (b'G', 17, 0) => self.is_level = true,
            (b'G', 18 | 19, 0) => self.is_level = false,
            (b'G', 20, 0) => self.set(line, |machine| machine.unit_mm = MM_PER_INCH)?,
            (b'G', 21, 0) => self.set(line, |machine| machine.unit_mm = 1.0)?,
            (b'G', 28, 0) => self.home(line),
            (b'G', 90, 0) => self.set(line, |machine| machine.is_relative = false)?,
            (b'G', 91, 0) => self.set(line, |machine| machine.is_relative = true)?,
            (b'G', 90, 1) => self.has_absolute_centres = true,
            (b'G', 91, 1) => self.has_absolute_centres = false,
            (b'G', 92, 0) => self.rename_place(line)?,
            (b'M', 82, 0) => self.set(line, |machine| machine.is_e_relative = false)?,
            (b'M', 83, 0) => self.set(line, |machine| machine.is_e_relative = true)?,
            (b'M', 200, 0) => self.take_volumetric(line)?,
            (b'M', 221, 0) => self.take_flow(line)?,
            (b'T', tool, 0) if tool < MOST_TOOLS => self.tool = tool as u16,
            _ => {}
        }
        Ok(Effect::None)
    }

    /// Returns where the program says that E is, mm or mm³.
    pub fn e(&self) -> f64 {
        self.e
    }

    /// Returns a place of E as the program would write it.
    pub fn word_of_e(&self, e: f64) -> f64 {
        e / self.unit_of_e()
    }

    /// Returns whether words of E say by how much it moves, not where to.
    pub fn is_e_relative(&self) -> bool {
        self.is_relative || self.is_e_relative
    }

    /// Returns a place as the program would write it, mm.
    pub fn program_place(&self, at: &Point) -> Vector {
        at.coords - self.origin
    }

    /// Returns a manner of moves that cannot be cut into pieces; `None` for absolute ones in mm.
    pub fn odd_manner(&self) -> Option<&'static str> {
        if self.is_relative {
            return Some("relative moves (G91)");
        }
        if self.unit_mm != 1.0 {
            return Some("moves in inches (G20)");
        }
        self.has_absolute_centres
            .then_some("arcs with absolute centres (G90.1)")
    }

    /// Changes a mode, and refuses a further command in the same line.
    fn set(&mut self, line: &Line, change: impl Fn(&mut Self)) -> Result<(), GcodeError> {
        line.each_word(|_, _| Ok(()))?;
        change(self);
        Ok(())
    }

    fn straight(&mut self, line: &Line) -> Result<Effect, GcodeError> {
        let words = Words::read(line)?;
        Ok(Effect::Stroke(self.moved(&words)))
    }

    /// Moves along an arc; `way` is 1 counter-clockwise and −1 clockwise.
    fn arc(&mut self, line: &Line, way: f64) -> Result<Effect, GcodeError> {
        let words = Words::read(line)?;
        let (from, mut stroke) = (self.at, self.moved(&words));
        if stroke.feed == 0.0 {
            return Ok(Effect::Stroke(stroke));
        }
        let fault = |reason| GcodeError::Arc {
            line: line.number,
            reason,
        };
        if !self.is_level {
            return Err(fault("stands upright (G18, G19)"));
        }
        let centre = self.centre(&words, &from);
        let centre = centre.ok_or_else(|| fault("has no centre (I, J or R)"))?;
        let mut turn = arc::turn(&from, &stroke.to, centre, way).map_err(fault)?;
        let more = words.p.unwrap_or(0.0).trunc().clamp(0.0, MOST_TURNS);
        turn.angle_rad += way * more * std::f64::consts::TAU;
        stroke.turn = Some(turn);
        Ok(Effect::Stroke(stroke))
    }

    /// Reads the centre of an arc; `None` if its words give none.
    fn centre(&self, words: &Words, from: &Point) -> Option<Centre> {
        let mm = |value: f64| value * self.unit_mm;
        match (words.i, words.j, words.r) {
            (None, None, None) => None,
            (None, None, Some(radius)) => Some(Centre::Radius(mm(radius))),
            (i, j, _) if self.has_absolute_centres => Some(Centre::At([
                i.map_or(from.x, |i| mm(i) + self.origin.x),
                j.map_or(from.y, |j| mm(j) + self.origin.y),
            ])),
            (i, j, _) => Some(Centre::At([
                from.x + mm(i.unwrap_or(0.0)),
                from.y + mm(j.unwrap_or(0.0)),
            ])),
        }
    }

    /// Moves nozzle and E as the words say.
    fn moved(&mut self, words: &Words) -> Stroke {
        let from = self.at;
        for (axis, word) in words.xyz.iter().enumerate() {
            if let Some(value) = word {
                let mm = value * self.unit_mm;
                let start = if self.is_relative {
                    self.at[axis]
                } else {
                    self.origin[axis]
                };
                self.at[axis] = start + mm;
            }
        }
        let feed = words.e.map_or(0.0, |value| self.feed(value));
        Stroke {
            from,
            to: self.at,
            turn: None,
            feed,
        }
    }

    /// Moves E to a value, or by it, and returns by how much.
    ///
    /// `G91` makes E relative, too; after `G90` the last `M82` or `M83` holds again. Firmwares
    /// differ here, so slicers repeat `M82` or `M83` where it would matter.
    fn feed(&mut self, value: f64) -> f64 {
        let value = value * self.unit_of_e();
        if self.is_relative || self.is_e_relative {
            self.e += value;
            return value;
        }
        let by = value - self.e;
        self.e = value;
        by
    }

    fn unit_of_e(&self) -> f64 {
        if self.is_volumetric {
            self.unit_mm.powi(3)
        } else {
            self.unit_mm
        }
    }

    /// Takes `G28`: the named axes, or all, stand at zero. Firmware allows `G28 XY`.
    fn home(&mut self, line: &Line) {
        let ends = |byte: &u8| matches!(byte, b';' | b'(');
        let text = line.rest.split(ends).next().unwrap_or_default();
        let is_named = |axis: &u8| text.iter().any(|byte| byte.to_ascii_uppercase() == *axis);
        let are_all = !AXES.iter().any(is_named);
        for (index, _) in AXES
            .iter()
            .enumerate()
            .filter(|(_, axis)| are_all || is_named(axis))
        {
            (self.at[index], self.origin[index]) = (0.0, 0.0);
        }
    }

    /// Takes `G92`: gives the present place another name, and moves nothing.
    fn rename_place(&mut self, line: &Line) -> Result<(), GcodeError> {
        let mut named = false;
        let (unit_mm, unit_of_e) = (self.unit_mm, self.unit_of_e());
        line.each_word(|letter, value| {
            let value = value.unwrap_or(0.0);
            if let Some(axis) = axis_of(letter) {
                self.origin[axis] = self.at[axis] - value * unit_mm;
                named = true;
            } else if letter == b'E' {
                self.e = value * unit_of_e;
                named = true;
            }
            Ok(())
        })?;
        if !named {
            (self.origin, self.e) = (self.at.coords, 0.0);
        }
        Ok(())
    }

    /// Takes `M200`: a diameter above zero makes E a volume, zero a length.
    fn take_volumetric(&mut self, line: &Line) -> Result<(), GcodeError> {
        line.each_word(|letter, value| {
            if let (b'D' | b'S', Some(value)) = (letter, value) {
                self.is_volumetric = value > 0.0;
            }
            Ok(())
        })
    }

    /// Takes `M221`: the flow in percent.
    fn take_flow(&mut self, line: &Line) -> Result<(), GcodeError> {
        line.each_word(|letter, value| {
            if let (b'S', Some(percent)) = (letter, value) {
                self.flow_ratio = percent / 100.0;
            }
            Ok(())
        })
    }

    fn refuse_spline(&self, line: &Line) -> Result<(), GcodeError> {
        match Words::read(line)?.e {
            None => Ok(()),
            Some(_) => Err(GcodeError::Unknown {
                line: line.number,
                command: "G5",
            }),
        }
    }
}

impl Words {
    fn read(line: &Line) -> Result<Self, GcodeError> {
        let mut words = Self::default();
        line.each_word(|letter, value| {
            let place = match letter {
                b'X' => &mut words.xyz[0],
                b'Y' => &mut words.xyz[1],
                b'Z' => &mut words.xyz[2],
                b'E' => &mut words.e,
                b'I' => &mut words.i,
                b'J' => &mut words.j,
                b'R' => &mut words.r,
                b'P' => &mut words.p,
                _ => return Ok(()),
            };
            *place = Some(value.ok_or_else(|| GcodeError::Number {
                line: line.number,
                letter: char::from(letter),
                found: String::new(),
            })?);
            Ok(())
        })?;
        Ok(words)
    }
}

fn axis_of(letter: u8) -> Option<usize> {
    AXES.iter().position(|axis| *axis == letter)
}

/// Takes `G10`: a retraction, unless its words set offsets of a tool.
fn firmware_retraction(line: &Line) -> Result<Effect, GcodeError> {
    let mut is_retraction = true;
    line.each_word(|letter, _| {
        is_retraction &= letter == b'S';
        Ok(())
    })?;
    Ok(if is_retraction {
        Effect::Retraction
    } else {
        Effect::None
    })
}

#[cfg(test)]
mod tests {
    use super::super::words::split;
    use super::*;

    /// Runs a program and returns its strokes.
    fn strokes(program: &str) -> Vec<Stroke> {
        let mut machine = Machine::default();
        let effects = program.lines().filter_map(|text| {
            let (command, line) = split(text.as_bytes(), 1)?;
            match machine.execute(command, &line).unwrap() {
                Effect::Stroke(stroke) => Some(stroke),
                _ => None,
            }
        });
        effects.collect()
    }

    fn feeds(program: &str) -> Vec<f64> {
        let round = |stroke: &Stroke| (stroke.feed * 1e9).round() / 1e9;
        strokes(program).iter().map(round).collect()
    }

    #[test]
    fn e_is_absolute_until_the_program_says_otherwise() {
        assert_eq!(
            feeds("G1 X1 E1\nG1 X2 E1.5\nG92 E0\nG1 X3 E.5"),
            [1.0, 0.5, 0.5]
        );
        assert_eq!(
            feeds("G1 X1 E1\nM83\nG1 X2 E1.5\nG1 X3 E-.5\nM82\nG1 X4 E3"),
            [1.0, 1.5, -0.5, 1.0]
        );
        assert_eq!(feeds("M83\nG91\nG1 X1 E1\nG90\nG1 X2 E1"), [1.0, 1.0]);
        assert_eq!(
            feeds("M82\nG1 E5\nG91\nG1 E-2\nG90\nG1 E5"),
            [5.0, -2.0, 2.0]
        );
    }

    #[test]
    fn places_are_followed_through_every_mode() {
        let last = |program: &str| strokes(program).last().unwrap().to;
        assert_eq!(last("G1 X1 Y2\nG91\nG1 X1 Z3"), Point::new(2.0, 2.0, 3.0));
        assert_eq!(last("G20\nG1 X1\nG21\nG1 Y1"), Point::new(25.4, 1.0, 0.0));
        assert_eq!(last("G1 X10\nG92 X0\nG1 X5"), Point::new(15.0, 0.0, 0.0));
        assert_eq!(last("G1 X10 Y4\nG28 X\nG1 Z1"), Point::new(0.0, 4.0, 1.0));
        assert_eq!(
            last("G1 X10 Y4\nG28 XY ; Z\nG1 Z1"),
            Point::new(0.0, 0.0, 1.0)
        );
        assert_eq!(
            last("G1 X10 Y4\nG92\nG28 W\nG1 Z1"),
            Point::new(0.0, 0.0, 1.0)
        );
    }

    #[test]
    fn volumes_and_inches_of_e_are_mm() {
        assert_eq!(feeds("G20\nG1 X1 E1"), [25.4]);
        assert_eq!(feeds("M200 D1.75\nG20\nM83\nG1 X1 E1"), [16_387.064]);
        assert_eq!(feeds("M200 D1.75\nM200 D0\nG20\nG1 X1 E1"), [25.4]);
    }

    #[test]
    fn arcs_turn_as_they_are_told() {
        let angle = |program: &str| {
            strokes(program)
                .last()
                .unwrap()
                .turn
                .unwrap()
                .angle_rad
                .to_degrees()
                .round()
        };
        assert_eq!(angle("G1 X1 Y0\nG3 X0 Y1 I-1 J0 E1"), 90.0);
        assert_eq!(angle("G1 X1 Y0\nG2 X0 Y1 I-1 J0 E1"), -270.0);
        assert_eq!(angle("G1 X1 Y0\nG2 I-1 E1"), -360.0);
        assert_eq!(angle("G1 X1 Y0\nG3 X0 Y1 R1 E1"), 90.0);
        assert_eq!(angle("G1 X1 Y0\nG3 X0 Y1 R-1 E1"), 270.0);
        assert_eq!(angle("G1 X1 Y0\nG90.1\nG3 X0 Y1 I0 J0 E1"), 90.0);
        assert_eq!(angle("G1 X1 Y0\nG3 X0 Y1 I-1 P1 E1"), 450.0);
    }

    #[test]
    fn what_cannot_be_followed_is_refused_with_its_line() {
        let refused = |program: &str| {
            let mut machine = Machine::default();
            let run = |text: &str| {
                let (command, line) = split(text.as_bytes(), 4).unwrap();
                machine.execute(command, &line).map(|_| ())
            };
            program.lines().try_for_each(run).unwrap_err().to_string()
        };
        assert!(refused("G2 X1 E1").contains("line 4: the arc has no centre"));
        assert!(refused("G3 X5 I1 E1").contains("ends off its circle"));
        assert!(refused("G18\nG3 X2 I1 E1").contains("stands upright"));
        assert!(refused("G5 X1 Y1 I1 J1 P1 Q1 E1").contains("G5 lays material"));
        assert!(refused("G90 G1 X1").contains("second command"));
        assert!(refused("G1 X E1").contains("`X` is followed by"));
        assert_eq!(strokes("G18\nG2 X2 Z1\nG5 X1").len(), 1);
    }
}
