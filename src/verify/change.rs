//! Changes of a kit's files since it was made, as values and in words.

use std::fmt;

use super::files::HOLLOWED_FILE;

/// A file that has changed since the kit was made.
#[derive(Debug, Clone, PartialEq)]
pub struct FileChange {
    /// Its path in the kit.
    pub file: String,
    /// The change.
    pub change: Change,
}

/// The change of a file.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Change {
    /// It is missing.
    Missing,
    /// It has other bytes; nothing more is known.
    Altered,
    /// It holds no mesh, for this reason.
    Unreadable(String),
    /// It belongs to another checklist.
    OfAnother,
    /// It can be printed, and is not on the kit's list.
    Unlisted,
    /// It is a link to another place.
    Link,
    /// It has other bytes but the same triangles: another program saved it again.
    Resaved,
    /// It has the same shape except for rounded coordinates or single moved corners.
    Touched,
    /// It holds the part with this id.
    Exchanged(String),
    /// The part was moved by this distance, mm.
    Moved(f64),
    /// The part was turned.
    Turned,
    /// The part was scaled by this factor.
    Scaled(f64),
    /// The part was mirrored.
    Mirrored,
    /// It has another shape, which lacks these pins of the part.
    Reshaped(Vec<String>),
}

impl fmt::Display for FileChange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let words = match &self.change {
            Change::Missing => "is missing".to_owned(),
            Change::Altered => "was changed: it has other bytes".to_owned(),
            Change::Unreadable(why) => format!("holds no mesh: {why}"),
            Change::OfAnother => "belongs to another checklist.json".to_owned(),
            Change::Unlisted => "does not belong to the kit: it is not on its list".to_owned(),
            Change::Link => "is a link: the kit must hold the file itself".to_owned(),
            Change::Resaved => "was saved again: other bytes, the same triangles".to_owned(),
            Change::Touched => {
                "was changed a little: its coordinates were rounded, or a corner was moved"
                    .to_owned()
            }
            Change::Exchanged(part) => format!("was exchanged: it holds part {part}"),
            Change::Moved(mm) => format!("was moved by {mm:.3} mm"),
            Change::Turned => "was turned".to_owned(),
            Change::Scaled(ratio) => format!("was scaled to {:.3} % of its size", ratio * 100.0),
            Change::Mirrored => "was mirrored".to_owned(),
            Change::Reshaped(pins) if pins.is_empty() => "has another shape".to_owned(),
            Change::Reshaped(pins) => {
                format!("has another shape: it lacks the pins {}", pins.join(", "))
            }
        };
        write!(f, "{} {words}", self.file)
    }
}

impl FileChange {
    /// Returns the advice for this change.
    pub fn remedy(&self) -> &'static str {
        match self.change {
            Change::Missing => {
                "copy it again from where the kit was made, or make the kit again from its job.toml"
            }
            Change::Unreadable(_) => "copy it again: it is incomplete or another file",
            Change::Altered | Change::OfAnother => {
                "restore the original file; if the change was intended, make the kit again from its job.toml"
            }
            Change::Unlisted => "do not print it; move it out of the kit's folder",
            Change::Link => "put the file itself in its place, or remove the link",
            Change::Resaved => "its shape is unchanged; print the original file to be sure",
            Change::Exchanged(_) => "give the file its original name, or copy it again",
            Change::Scaled(_) => "print the original file, at 100 %",
            Change::Touched
            | Change::Moved(_)
            | Change::Turned
            | Change::Mirrored
            | Change::Reshaped(_) => {
                "print the original file; turn and move a part on the plate, not in its file"
            }
        }
    }

    /// Returns true if the change alters a shape that is judged, so that other promises fail with
    /// it.
    pub fn is_of_shape(&self) -> bool {
        match self.change {
            Change::Altered => self.file == HOLLOWED_FILE,
            Change::Missing
            | Change::OfAnother
            | Change::Unlisted
            | Change::Link
            | Change::Resaved => false,
            _ => true,
        }
    }
}
