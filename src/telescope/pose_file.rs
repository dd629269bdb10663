//! `poses/*.toml`: a state of the joints as text, to edit and hand back.
//!
//! ```toml
//! kind = "pose"
//! schema = 1
//! name = "bow"
//!
//! [[joint]]
//! id = "J01"
//! stroke_mm = 38.2              # how far its shell is out
//! turn_deg = 0.0                # only of a shell that is all out
//! ```
//!
//! Joints that are not named are all out and turned.

use std::fmt::Write;

use serde::Deserialize;
use toml::Spanned;

use super::motion::Key;
use super::nest::{JointState, Telescope};
use super::network::Network;
use crate::base::toml_text::{self, Place, TextFault, nearest_name};

/// The word that tells a pose from other files.
const KIND: &str = "pose";
/// The version of the file that this program writes and reads.
const SCHEMA: u32 = 1;
/// Digits after the point of a written stroke and turn.
const DIGITS: usize = 4;
/// A stroke (mm) or turn (degrees) may be beyond its range by this: the digits of a file.
const BEYOND: f64 = 1e-3;
/// The most joints of a file: more than any figure has.
const MOST_JOINTS: usize = 2_000;
/// The longest name of a pose.
const LONGEST_NAME: usize = 40;

/// A pose as its file tells it, and the places of its words in the file.
#[derive(Debug, Clone, PartialEq)]
pub struct PoseFile {
    /// The name.
    pub name: String,
    /// The joints that it names.
    pub joints: Vec<PoseJoint>,
    name_at: Place,
}

/// A joint of a pose.
#[derive(Debug, Clone, PartialEq)]
pub struct PoseJoint {
    /// Its id on the sheet.
    pub id: String,
    /// The stroke by which its shell is out, mm: 0 if all in.
    pub stroke_mm: f64,
    /// Its turn, degrees.
    pub turn_deg: f64,
    id_at: Place,
    stroke_at: Place,
    turn_at: Place,
}

/// The key that tells the kind of a file.
#[derive(Deserialize)]
struct Head {
    kind: Spanned<String>,
}

/// The file as it stands.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Text {
    #[serde(rename = "kind")]
    _kind: String,
    schema: Spanned<u32>,
    name: Spanned<String>,
    #[serde(default)]
    joint: Vec<Spanned<JointText>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct JointText {
    id: Spanned<String>,
    stroke_mm: Spanned<f64>,
    turn_deg: Option<Spanned<f64>>,
}

/// The file that is read.
struct Reader<'a> {
    file: &'a str,
    text: &'a str,
}

impl Reader<'_> {
    fn place(&self, span: &std::ops::Range<usize>) -> Place {
        Place::of_byte(self.file, self.text, span.start)
    }

    fn fault<T>(&self, at: &Spanned<T>, message: String) -> TextFault {
        TextFault {
            place: self.place(&at.span()),
            message,
        }
    }

    fn read(&self) -> Result<PoseFile, TextFault> {
        self.check_head()?;
        let read: Text = toml_text::read(self.file, self.text)?;
        let schema = *read.schema.get_ref();
        if schema != SCHEMA {
            let message = format!(
                "schema {schema} is unknown; remedy: write `schema = {SCHEMA}`, which this program \
                 reads"
            );
            return Err(self.fault(&read.schema, message));
        }
        if !is_plain(read.name.get_ref()) {
            let message = format!(
                "a pose is named by letters, digits, - and _, {LONGEST_NAME} at most; remedy: write \
                 name = \"bow\""
            );
            return Err(self.fault(&read.name, message));
        }
        if let Some(first) = read.joint.get(MOST_JOINTS) {
            let message = format!("more than {MOST_JOINTS} joints; remedy: name each joint once");
            return Err(self.fault(first, message));
        }
        let mut joints: Vec<PoseJoint> = Vec::new();
        for joint in &read.joint {
            let joint = self.joint(joint)?;
            if let Some(known) = joints.iter().find(|known| known.id == joint.id) {
                let message = format!(
                    "joint {} stands in line {} already; remedy: name it once",
                    joint.id, known.id_at.line
                );
                let place = joint.id_at;
                return Err(TextFault { place, message });
            }
            joints.push(joint);
        }
        Ok(PoseFile {
            name_at: self.place(&read.name.span()),
            name: read.name.into_inner(),
            joints,
        })
    }

    /// Refuses a file of another kind by its kind, and not by the keys that it has.
    fn check_head(&self) -> Result<(), TextFault> {
        let Ok(Head { kind }) = toml::from_str(self.text) else {
            return Ok(());
        };
        if kind.get_ref() == KIND {
            return Ok(());
        }
        let found = kind.get_ref();
        let message = format!("this is a file of kind \"{found}\"; remedy: give a pose");
        Err(self.fault(&kind, message))
    }

    fn joint(&self, joint: &Spanned<JointText>) -> Result<PoseJoint, TextFault> {
        let own = joint.get_ref();
        let numbers = [Some(&own.stroke_mm), own.turn_deg.as_ref()];
        for number in numbers.into_iter().flatten() {
            if !number.get_ref().is_finite() {
                let message = format!(
                    "{} is no number; remedy: give mm for stroke_mm, degrees for turn_deg",
                    number.get_ref()
                );
                return Err(self.fault(number, message));
            }
        }
        let stroke_at = self.place(&own.stroke_mm.span());
        let turn = own.turn_deg.as_ref();
        Ok(PoseJoint {
            id: own.id.get_ref().clone(),
            stroke_mm: *own.stroke_mm.get_ref(),
            turn_deg: turn.map_or(0.0, |turn| *turn.get_ref()),
            id_at: self.place(&own.id.span()),
            turn_at: turn.map_or_else(|| stroke_at.clone(), |turn| self.place(&turn.span())),
            stroke_at,
        })
    }
}

/// Returns true for names that every file system takes.
fn is_plain(name: &str) -> bool {
    let is_letter = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    !name.is_empty() && name.len() <= LONGEST_NAME && name.chars().all(is_letter)
}

impl PoseFile {
    /// Reads a pose from the text of its file; messages call it `file`.
    ///
    /// # Errors
    /// The text is no such file, a number is none, or a joint stands twice.
    pub fn from_toml(file: &str, text: &str) -> Result<Self, TextFault> {
        Reader { file, text }.read()
    }

    /// Returns the fault that this name is taken.
    pub fn is_taken(&self) -> TextFault {
        TextFault {
            place: self.name_at.clone(),
            message: format!("the name {} is taken; remedy: give another", self.name),
        }
    }

    /// Returns the state of a network that the file tells. `ids` are those of every limb's joints.
    ///
    /// # Errors
    /// The network has no such joint, or it does not go so far.
    pub fn state(&self, network: &Network, ids: &[Vec<String>]) -> Result<Vec<Key>, TextFault> {
        let mut state = network.open();
        for joint in &self.joints {
            let limbs = ids.iter().enumerate();
            let mut found = limbs.filter_map(|(limb, ids)| {
                let at = ids.iter().position(|id| *id == joint.id)?;
                Some((limb, at))
            });
            let Some((limb, at)) = found.next() else {
                return Err(joint.unknown(ids));
            };
            state[limb][at] = joint.state(&network.limbs[limb].telescope, at)?;
        }
        Ok(state)
    }
}

impl PoseJoint {
    fn unknown(&self, ids: &[Vec<String>]) -> TextFault {
        let known = || ids.iter().flatten().map(String::as_str);
        let remedy = match nearest_name(&self.id, known()) {
            Some(name) => format!("did you mean {name}?"),
            None => "the sheet of the kit names them".to_owned(),
        };
        TextFault {
            place: self.id_at.clone(),
            message: format!("there is no joint {}; remedy: {remedy}", self.id),
        }
    }

    fn state(&self, telescope: &Telescope, at: usize) -> Result<JointState, TextFault> {
        let closed_mm = telescope.sizes.closed_mm();
        let most_mm = telescope.visible_mm - closed_mm;
        let id = &self.id;
        if !(-BEYOND..=most_mm + BEYOND).contains(&self.stroke_mm) {
            return Err(TextFault {
                place: self.stroke_at.clone(),
                message: format!(
                    "joint {id} cannot be {} mm out; remedy: give 0 to {most_mm:.DIGITS$}",
                    self.stroke_mm
                ),
            });
        }
        let is_out = self.stroke_mm >= most_mm - BEYOND;
        let whole_deg = telescope.joints[at].turn_rad.to_degrees();
        let ends = if is_out { [0.0, whole_deg] } else { [0.0; 2] };
        let [low, high] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        if !(low - BEYOND..=high + BEYOND).contains(&self.turn_deg) {
            let message = match is_out {
                true => format!(
                    "joint {id} cannot turn by {}°; remedy: give {low:.DIGITS$} to {high:.DIGITS$}",
                    self.turn_deg
                ),
                false => format!(
                    "joint {id} turns only when it is all out; remedy: give no turn, or a stroke of \
                     {most_mm:.DIGITS$} mm"
                ),
            };
            let place = self.turn_at.clone();
            return Err(TextFault { place, message });
        }
        Ok(JointState {
            slide_mm: match is_out {
                true => telescope.visible_mm,
                false => closed_mm + self.stroke_mm.max(0.0),
            },
            turn_rad: self.turn_deg.clamp(low, high).to_radians(),
        })
    }
}

/// Returns the text of a pose. `joints` are id, stroke (mm), turn (degrees) and their greatest.
pub fn pose_text(name: &str, joints: &[PoseLine]) -> String {
    let mut text = format!(
        "# A pose. Give it back with the option pose, edited or not. Strokes are in mm, turns in\n\
         # degrees; a shell turns only when it is all out. Joints left out are all out and turned.\n\
         kind = \"{KIND}\"\nschema = {SCHEMA}\nname = \"{name}\"\n"
    );
    for joint in joints {
        _ = write!(
            text,
            "\n[[joint]]\nid = \"{}\"\nstroke_mm = {:.DIGITS$} # of {:.DIGITS$}\n",
            joint.id,
            joint.stroke_mm + 0.0,
            joint.whole_mm
        );
        if joint.whole_deg != 0.0 {
            let (turn, whole) = (joint.turn_deg + 0.0, joint.whole_deg);
            _ = writeln!(text, "turn_deg = {turn:.DIGITS$} # of {whole:.DIGITS$}");
        }
    }
    text
}

/// A joint of a pose as it is written.
#[derive(Debug, Clone, PartialEq)]
pub struct PoseLine {
    /// Its id.
    pub id: String,
    /// The stroke by which its shell is out, mm.
    pub stroke_mm: f64,
    /// The stroke when all out, mm.
    pub whole_mm: f64,
    /// Its turn, degrees.
    pub turn_deg: f64,
    /// The turn when all out, degrees.
    pub whole_deg: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "kind = \"pose\"\nschema = 1\nname = \"bow\"\n";

    fn fault(rest: &str) -> String {
        let text = format!("{HEAD}{rest}");
        PoseFile::from_toml("bow.toml", &text)
            .unwrap_err()
            .to_string()
    }

    #[test]
    fn a_written_pose_is_read_again_as_it_was() {
        let line = |id: &str, turn_deg: f64| PoseLine {
            id: id.to_owned(),
            stroke_mm: 12.25,
            whole_mm: 30.0,
            turn_deg,
            whole_deg: -90.0,
        };
        let text = pose_text("bow", &[line("J01", -45.0), line("A-J02", 0.0)]);
        let read = PoseFile::from_toml("bow.toml", &text).unwrap();
        assert_eq!((read.name.as_str(), read.joints.len()), ("bow", 2));
        assert_eq!(read.joints[0].turn_deg, -45.0);
        assert_eq!(read.joints[1].stroke_mm, 12.25);
    }

    #[test]
    fn faults_of_a_pose_are_told_with_their_line_and_a_remedy() {
        let twice = "[[joint]]\nid = \"J01\"\nstroke_mm = 1.0\n";
        let said = fault(&format!("{twice}{twice}"));
        assert!(said.starts_with("bow.toml:8:6: joint J01 stands in line 5"));
        let said = fault("[[joint]]\nid = \"J01\"\nstroke_mm = nan\n");
        assert!(
            said.starts_with("bow.toml:6:13: NaN is no number"),
            "{said}"
        );
        let said = fault("[[joint]]\nid = \"J01\"\nstroke = 1.0\n");
        assert!(said.contains("did you mean `stroke_mm`?"), "{said}");
        for (text, word) in [
            ("kind = \"skeleton\"\nroot = 1\n", "give a pose"),
            ("kind = \"pose\"\nschema = 2\nname = \"a\"\n", "schema 2"),
            ("kind = \"pose\"\nschema = 1\nname = \"../a\"\n", "letters"),
        ] {
            let said = PoseFile::from_toml("bow.toml", text).unwrap_err();
            assert!(said.to_string().contains(word), "{said}");
        }
    }
}
