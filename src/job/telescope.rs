//! The whole input of a telescope as plain data. `job.toml` replays the run exactly.

use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use serde::{Deserialize, Deserializer, Serialize, de::Error as _};

pub use super::telescope_pose::{PoseChoice, PoseReadError, Reach, ReachError};
pub use super::telescope_root::{Root, RootError};
use super::{JobError, PrinterChoice, Scaling};
use crate::ballast::Order;
use crate::base::toml_text::{self, TextFault};
use crate::base::units::Length;
use crate::base::words::{ChoiceError, as_text, choice};

/// The version of a telescope's `job.toml` that this program writes and reads.
pub const TELESCOPE_SCHEMA: u32 = 1;

/// The most shells that a job may ask for. More than some dozen never nest.
pub const MOST_SHELLS: usize = 40;

/// The first line of every written `job.toml`.
const REMARK: &str = "# Replays the run: equipoise telescope, with this file as its job; away from its kit with the curve too.\n\n";

/// The toppling angle that a standing telescope promises if the job says nothing else, degrees.
pub const USUAL_LEAST_ANGLE_DEG: f64 = 5.0;

choice! {
    /// The kind of job, which tells it from others.
    JobKind, "kind of job" {
        /// Shells that slide out of one another.
        Telescope = "telescope",
    }
}

choice! {
    /// The values that the curvature of the shells takes.
    Bends, "choice of curvature" {
        /// One for all shells.
        One = "one",
        /// Its own for each shell.
        Each = "each",
    }
}

choice! {
    /// The values that the torsion of the shells takes.
    Twists, "choice of torsion" {
        /// One for all shells.
        One = "one",
        /// Its own for each shell.
        Each = "each",
        /// None: every shell bends in a plane.
        None = "none",
    }
}

choice! {
    /// What holds a shell that is all out.
    Lock, "lock" {
        /// A ring that is pressed in over the last millimetres.
        Press = "press",
        /// Nothing: it slides back by its weight.
        None = "none",
    }
}

choice! {
    /// The order in which the joints open.
    Opening, "order" {
        /// Whichever is free, and has the greater gap.
        Auto = "auto",
        /// From the root to the tip.
        Root = "root",
        /// From the tip to the root.
        Tip = "tip",
    }
}

choice! {
    /// What the open telescope does.
    Stance, "goal of a telescope" {
        /// It stands on a foot under its root, at every state of its opening.
        Stand = "stand",
        /// Nothing is promised.
        None = "none",
    }
}

choice! {
    /// The bodies in which the limbs of a skeleton meet.
    JunctureKind, "kind of juncture" {
        /// Balls, and rounded links where branches stay solid.
        Ball = "ball",
        /// The convex hull of the ends that meet.
        Hull = "hull",
        /// The model's own pieces, cut across its branches.
        Model = "model",
    }
}

/// The number of shells.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum ShellCount {
    /// The fewest that come near enough.
    Auto,
    /// So many.
    Given(usize),
}

/// The radius of the foot.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum FootSize {
    /// The least on which it stands as promised.
    Auto,
    /// This.
    Given(Length),
}

/// Everything that decides the bytes of a telescope's kit, apart from the version of the program
/// and of its built-in profiles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TelescopeJob {
    /// The version of the file's format, [`TELESCOPE_SCHEMA`].
    #[serde(deserialize_with = "read_schema")]
    pub schema: u32,
    /// Always a telescope.
    pub kind: JobKind,
    /// The number of shells.
    pub shells: ShellCount,
    /// The radius of the tip's body; the least that can be made if `None`.
    pub tip_radius: Option<Length>,
    /// The greatest radius of the root; any if `None`.
    pub root_radius: Option<Length>,
    /// The greatest visible length of a shell; what the printer has room for if `None`.
    pub shell_length: Option<Length>,
    /// The deviation from the curve that is near enough; a hundredth of its length if `None`.
    pub deviation: Option<Length>,
    /// The wall asked for; the profile's minimum if `None`.
    pub wall: Option<Length>,
    /// The sliding clearance on each side; the profile's if `None`.
    pub clearance: Option<Length>,
    /// The overlap of shells that are all out; chosen by the play if `None`.
    pub overlap: Option<Length>,
    /// The values that curvature takes.
    pub curvature: Bends,
    /// The values that torsion takes.
    pub torsion: Twists,
    /// What holds a shell that is all out.
    pub lock: Lock,
    /// The order of opening.
    pub order: Opening,
    /// What the open telescope does.
    pub goal: Stance,
    /// The toppling angle that it promises if it stands, degrees.
    pub least_angle_deg: f64,
    /// The radius of its foot if it stands.
    pub foot: FootSize,
    /// The ballast in its foot.
    #[serde(default, skip_serializing_if = "Order::is_none")]
    pub ballast: Order,
    /// True to print all shells in each other, in one go.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub in_place: bool,
    /// The bodies of junctures; pieces of a model or else balls if `None`. A curve has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub junctures: Option<JunctureKind>,
    /// The radius below which a limb stays solid; the least that can be made if `None`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub keep_solid: Option<Length>,
    /// The root of the skeleton; its own if `None`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub root: Option<Root>,
    /// The places that tips are to reach in one pose.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub reach: Vec<Reach>,
    /// A pose file; `None` if none is given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pose: Option<PoseChoice>,
    /// The curve.
    pub curve: CurveChoice,
    /// The printer and its material.
    pub printer: PrinterChoice,
    /// A copy of the curve's file that is read in its place. It is no part of the file.
    #[serde(skip)]
    pub curve_copy: Option<PathBuf>,
}

/// The curve and its size.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CurveChoice {
    /// A file, or the measures of an arc or a helix.
    pub source: String,
    /// The SHA-256 of the file's bytes; `None` for measures, and until it has been read.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sha256: Option<String>,
    /// The conversion of its numbers to mm.
    pub scaling: Scaling,
}

impl TelescopeJob {
    /// Returns the job with default settings.
    pub fn new(source: &str, scaling: Scaling, printer: PrinterChoice) -> Self {
        Self {
            schema: TELESCOPE_SCHEMA,
            kind: JobKind::Telescope,
            shells: ShellCount::Auto,
            tip_radius: None,
            root_radius: None,
            shell_length: None,
            deviation: None,
            wall: None,
            clearance: None,
            overlap: None,
            curvature: Bends::Each,
            torsion: Twists::Each,
            lock: Lock::Press,
            order: Opening::Auto,
            goal: Stance::None,
            least_angle_deg: USUAL_LEAST_ANGLE_DEG,
            foot: FootSize::Auto,
            ballast: Order::None,
            in_place: false,
            junctures: None,
            keep_solid: None,
            root: None,
            reach: Vec::new(),
            pose: None,
            curve: CurveChoice {
                source: source.to_owned(),
                sha256: None,
                scaling,
            },
            printer,
            curve_copy: None,
        }
    }

    /// Returns the file that the curve is read from; `None` if it is given by its measures.
    pub fn curve_file(&self) -> Option<&Path> {
        let named = Path::new(&self.curve.source);
        let is_measures = self.curve.source.contains(':') && !named.is_file();
        let own = (!is_measures).then_some(named);
        self.curve_copy.as_deref().or(own)
    }

    /// Returns the job as its kit tells it: without the folder in which the curve's file lay.
    pub fn in_kit(&self) -> Self {
        let mut job = self.clone();
        let named = self
            .curve_file()
            .and_then(|_| Path::new(&self.curve.source).file_name());
        if let Some(name) = named {
            job.curve.source = name.to_string_lossy().into_owned();
        }
        job.pose = job.pose.as_ref().map(PoseChoice::in_kit);
        job
    }

    /// Reads the job in the file at `path`.
    pub fn read(path: &Path) -> Result<Self, JobError> {
        let text = std::fs::read_to_string(path).map_err(|source| JobError::Unreadable {
            path: path.to_owned(),
            source,
        })?;
        Ok(toml_text::read::<Self>(&path.to_string_lossy(), &text)?)
    }

    /// Reads a job from the text of a `job.toml`; messages call it `file`.
    pub fn from_toml(file: &str, text: &str) -> Result<Self, TextFault> {
        toml_text::read(file, text)
    }

    /// Returns the job as the text of a `job.toml`.
    pub fn to_toml(&self) -> Result<String, JobError> {
        Ok(format!("{REMARK}{}", toml::to_string(self)?))
    }

    /// Returns the name of the job: the file's without its ending, or the kind of curve.
    pub fn name(&self) -> String {
        let stem = match self.curve.source.split_once(':') {
            Some((kind, _)) if !Path::new(&self.curve.source).is_file() => kind.to_owned(),
            _ => PathBuf::from(&self.curve.source)
                .file_stem()
                .map(|stem| stem.to_string_lossy().into_owned())
                .unwrap_or_default(),
        };
        let plain = |c: char| c.is_alphanumeric() || matches!(c, '-' | '_' | '.');
        let name: String = stem
            .chars()
            .map(|c| if plain(c) { c } else { '-' })
            .collect();
        if name.is_empty() {
            "curve".to_owned()
        } else {
            name
        }
    }
}

impl fmt::Display for ShellCount {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::Given(count) => write!(f, "{count}"),
        }
    }
}

impl FromStr for ShellCount {
    type Err = ChoiceError;

    fn from_str(text: &str) -> Result<Self, ChoiceError> {
        let range = 1..=MOST_SHELLS;
        let count = text
            .trim()
            .parse()
            .ok()
            .filter(|count| range.contains(count));
        match (text.trim(), count) {
            ("auto", _) => Ok(Self::Auto),
            (_, Some(count)) => Ok(Self::Given(count)),
            _ => Err(ChoiceError::unknown(
                "number of shells",
                text,
                &["auto", "a number from 1 to 40"],
            )),
        }
    }
}

impl fmt::Display for FootSize {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::Given(length) => write!(f, "{length}"),
        }
    }
}

impl FromStr for FootSize {
    type Err = ChoiceError;

    fn from_str(text: &str) -> Result<Self, ChoiceError> {
        match (text.trim(), text.parse()) {
            ("auto", _) => Ok(Self::Auto),
            (_, Ok(length)) => Ok(Self::Given(length)),
            _ => Err(ChoiceError::unknown(
                "radius of a foot",
                text,
                &["auto", "a length such as 30mm"],
            )),
        }
    }
}

as_text!(ShellCount FootSize);

fn read_schema<'de, D: Deserializer<'de>>(deserializer: D) -> Result<u32, D::Error> {
    match u32::deserialize(deserializer)? {
        TELESCOPE_SCHEMA => Ok(TELESCOPE_SCHEMA),
        other => Err(D::Error::custom(format!(
            "schema {other} is not known; remedy: use the version of equipoise that wrote it, \
             this one reads schema {TELESCOPE_SCHEMA}"
        ))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::ModelUnit;

    fn job() -> TelescopeJob {
        let printer = PrinterChoice {
            id: "prusa-mk4".to_owned(),
            material: None,
        };
        TelescopeJob::new("models/hook.csv", Scaling::Unit(ModelUnit::Mm), printer)
    }

    #[test]
    fn a_written_job_is_read_again_as_it_was() {
        let mut job = job();
        job.shells = ShellCount::Given(7);
        job.foot = FootSize::Given(Length::from_mm(32.5).unwrap());
        job.deviation = Some(Length::from_mm(0.75).unwrap());
        job.curve.scaling = Scaling::Factor(2.5);
        job.reach = vec!["tip=1,2.5,-3".parse().unwrap()];
        job.pose = Some(PoseChoice {
            source: "bow.toml".to_owned(),
            text: "kind = \"pose\"\n# a \"quoted\" line\n".to_owned(),
        });
        let text = job.to_toml().unwrap();
        assert!(text.contains("kind = \"telescope\""));
        assert_eq!(TelescopeJob::from_toml("job.toml", &text).unwrap(), job);
    }

    #[test]
    fn a_job_is_named_after_its_curve() {
        assert_eq!(job().name(), "hook");
        let mut arc = job();
        arc.curve.source = "arc:60,90".to_owned();
        assert_eq!(arc.name(), "arc");
    }

    #[test]
    fn a_number_of_shells_that_cannot_be_is_refused() {
        for text in ["0", "-3", "41", "many", "2.5", ""] {
            assert!(text.parse::<ShellCount>().is_err(), "{text}");
        }
        assert_eq!("12".parse(), Ok(ShellCount::Given(12)));
        assert!(
            "wide"
                .parse::<FootSize>()
                .unwrap_err()
                .to_string()
                .contains("30mm")
        );
    }
}
