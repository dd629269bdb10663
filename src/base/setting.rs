//! Options as values, in the words of `job.toml`.
//!
//! A remedy, hint or warning that names an option holds it as a [`Setting`]. Its text writes the
//! setting between backticks. A user interface can then show it in its own words: the command line
//! writes `--ballast=auto` for `ballast = "auto"`.

use std::fmt;

use serde::Serialize;

use crate::base::words::choice;

choice! {
    /// An option, named by its key in `job.toml`.
    Key, "key of job.toml" {
        /// The material's id.
        Material = "material",
        /// The minimum wall.
        Wall = "wall",
        /// The pitch of the solver's columns.
        Pitch = "pitch",
        /// The choice to cut the object.
        Cut = "cut",
        /// The drain holes of an uncut piece.
        Drain = "drain",
        /// The order to close drain holes with plugs.
        Plugs = "plugs",
        /// The cuts and pins that the user orders.
        Plan = "plan",
        /// The kind of seam.
        Seam = "seam",
        /// The balls that no seam enters.
        KeepClear = "keep_clear",
        /// The least part.
        LeastPart = "least_part",
        /// The pins that align the parts.
        Pins = "pins",
        /// The marking of parts with their ids.
        Ids = "ids",
        /// The effort of the search for cuts and pins.
        Effort = "effort",
        /// The greatest share of the goal's figure that joints may cost.
        JointPrice = "joint_price_ratio",
        /// The order to thicken thin features of the model.
        Thicken = "thicken",
        /// The file format of the parts.
        Format = "format",
        /// The slicer that is asked what the plates take.
        Slicer = "slicer",
        /// The ballast.
        Ballast = "ballast",
        /// The filling of the voids.
        Fill = "fill",
        /// The inside of the print.
        Interior = "interior",
        /// The size of the cells of an inside of cells.
        CellSize = "cell_size",
        /// The least and the greatest density of a graded print.
        Density = "density",
        /// The infill that a graded print should be near to.
        Infill = "infill",
        /// The number of densities near that infill.
        Levels = "levels",
        /// The share of the best figure that is kept near that infill.
        Keep = "keep",
        /// The field of densities of a graded print.
        Field = "field",
        /// The repairs of the model.
        Repair = "repair",
        /// The unit of the model file's numbers.
        Unit = "unit",
        /// The factor from the model file's numbers to mm.
        Factor = "factor",
        /// The longest side of the model.
        Size = "size",
        /// The printer's id, or the path of its profile.
        Printer = "printer",
        /// The kind of goal.
        Goal = "kind",
        /// The direction that becomes the spin axis or up.
        Up = "up",
        /// The contact point of a top.
        Contact = "contact",
        /// The spin point of a yo-yo or a rotor.
        SpinPoint = "spin_point",
        /// The objective.
        Objective = "objective",
        /// The speed of a rotor.
        Speed = "speed_rpm",
        /// The balance quality grade of a rotor.
        Grade = "grade_mm_s",
        /// The bore of a rotor.
        Bore = "bore",
        /// The liquid of a floating object.
        Liquid = "liquid",
        /// The waterline of a floating object.
        Waterline = "waterline",
        /// The gap between a yo-yo's halves.
        StringGap = "string_gap",
        /// The axle of a yo-yo.
        Axle = "axle",
        /// The mass of the fittings on a yo-yo's axle.
        HardwareMass = "mass_g",
        /// The tip of a top.
        Tip = "tip",
        /// The stem of a top.
        Stem = "stem",
        /// The least lean that a top promises.
        LeastLean = "least_lean_deg",
        /// The least toppling angle that a standing object promises.
        LeastAngle = "least_angle_deg",
        /// The body that a match is like: its file and its density.
        Like = "like",
        /// The number of shells of a telescope.
        Shells = "shells",
        /// The kind of bodies in which limbs meet.
        Junctures = "junctures",
        /// The radius below which limbs stay solid.
        KeepSolid = "keep_solid",
        /// The node that limbs grow from.
        Root = "root",
        /// The radius of a telescope's tip.
        TipRadius = "tip_radius",
        /// The greatest radius of a telescope's root.
        RootRadius = "root_radius",
        /// The greatest visible length of a shell.
        ShellLength = "shell_length",
        /// The deviation of a telescope from its curve that is near enough.
        Deviation = "deviation",
        /// The values that the curvature of shells takes.
        Curvature = "curvature",
        /// The values that the torsion of shells takes.
        Torsion = "torsion",
        /// The sliding clearance of shells.
        Clearance = "clearance",
        /// The overlap of shells that are all out.
        Overlap = "overlap",
        /// The order in which shells come out.
        Order = "order",
        /// The order to print the shells of a telescope in each other.
        InPlace = "in_place",
        /// The radius of a telescope's foot.
        Foot = "foot",
        /// A place that a telescope's tip is to reach.
        Reach = "reach",
        /// The pose file of a telescope.
        Pose = "pose",
        /// The greatest number of faces of a base.
        Faces = "faces",
        /// The method by which a base is looked for.
        Method = "method",
        /// The number of polyhedra of a base.
        Polyhedra = "polyhedra",
        /// The least radius of the disc in which two polyhedra bear on each other.
        Connector = "connector",
        /// The rods between polyhedra.
        Dowel = "dowel",
        /// The base that is used in place of one that is looked for.
        Base = "base",
        /// The joints between the panels of a base.
        Joints = "joints",
        /// The style of the parts on a base.
        Shell = "shell",
        /// The sheets at hand.
        Stock = "stock",
        /// The choice to let panels follow the grain of their sheet.
        Grain = "grain",
        /// The folder or file that is written; it is not part of a job.
        Out = "out",
        /// The permission to replace what is there; it is not part of a job.
        Force = "force",
        /// The order to slice a print, and to solve again with its toolpaths; it is not part of a
        /// job.
        Slice = "slice",
        /// The list of a slicer's printers; it is not part of a job.
        List = "list",
        /// The data of a volume mesh that is its density; it is not part of a job.
        Data = "data",
    }
}

/// An option and the value to give it.
///
/// Prints as in `job.toml`, `ballast = "auto"`, or `contact = …` if any value may follow.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Setting {
    /// The option.
    pub key: Key,
    /// The value; `None` if the user chooses it.
    pub value: Option<String>,
}

impl Setting {
    /// Returns the setting of an option to a value.
    pub fn new(key: Key, value: impl fmt::Display) -> Self {
        Self {
            key,
            value: Some(value.to_string()),
        }
    }

    /// Returns the setting of an option to a value that the user chooses.
    pub fn open(key: Key) -> Self {
        Self { key, value: None }
    }

    /// Reads a setting as it prints; `None` for any other text.
    pub fn read(text: &str) -> Option<Self> {
        let (key, value) = text.split_once(" = ")?;
        let key = key.parse().ok()?;
        match value {
            OPEN => Some(Self::open(key)),
            _ => {
                let value = value.strip_prefix('"')?.strip_suffix('"')?;
                Some(Self::new(key, value))
            }
        }
    }
}

/// The mark for a value that the user chooses.
const OPEN: &str = "…";

impl fmt::Display for Setting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.value {
            Some(value) => write!(f, "{} = \"{value}\"", self.key),
            None => write!(f, "{} = {OPEN}", self.key),
        }
    }
}

/// Rewrites every setting between backticks in `text` by `word`.
///
/// Other text between backticks stays as it is.
pub fn reword(text: &str, word: impl Fn(&Setting) -> String) -> String {
    let mut reworded = String::with_capacity(text.len());
    let mut rest = text;
    while let Some((before, quoted)) = rest.split_once('`') {
        reworded.push_str(before);
        let setting = quoted
            .split_once('`')
            .and_then(|(inside, after)| Some((Setting::read(inside)?, after)));
        match setting {
            Some((setting, after)) => {
                reworded.push_str(&word(&setting));
                rest = after;
            }
            None => {
                reworded.push('`');
                rest = quoted;
            }
        }
    }
    reworded + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_setting_reads_back_as_it_prints() {
        for &key in Key::ALL {
            for setting in [Setting::new(key, "-0.1,-0.19,0.98"), Setting::open(key)] {
                assert_eq!(Setting::read(&setting.to_string()), Some(setting));
            }
        }
        assert_eq!(
            Setting::new(Key::Ballast, "auto").to_string(),
            "ballast = \"auto\""
        );
    }

    #[test]
    fn settings_between_backticks_are_reworded_and_nothing_else() {
        let word = |setting: &Setting| format!("<{}>", setting.key);
        for (text, expected) in [
            ("give `up = \"z\"` or `tip = …`", "give <up> or <tip>"),
            (
                "`up` is not `x = \"1\"`; `wall = \"1mm\"",
                "`up` is not `x = \"1\"`; `wall = \"1mm\"",
            ),
            ("one ` and `size = \"9mm\"`.", "one ` and <size>."),
            ("", ""),
        ] {
            assert_eq!(reword(text, word), expected);
        }
    }
}
