//! The whole input of an object on a laser-cut base. `job.toml` replays the run exactly.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Deserializer, Serialize, de::Error as _};

use super::base_choice::{BaseChoice, Dowel, Polyhedra};
use super::base_method::BaseMethod;
use super::{GrainChoice, JobError, ModelChoice, PrinterChoice, StockList};
use crate::ballast::Order;
use crate::base::digest::sha256_hex;
use crate::base::toml_text::{self, TextFault};
use crate::base::units::Length;
use crate::base::words::choice;
use crate::goal::Up;

/// The version of such a `job.toml` that this program writes and reads.
pub const CORE_SCHEMA: u32 = 1;

/// The number of faces of the base if the job says nothing else.
pub const USUAL_FACES: usize = 12;

/// The toppling angle that a standing object promises if the job says nothing else, degrees.
pub const CORE_LEAST_ANGLE_DEG: f64 = 5.0;

/// The first line of every written `job.toml`.
const REMARK: &str = "# Replays the run: equipoise core, with this file as its job; away from its kit with the model too.\n\n";

choice! {
    /// The kind of job, which tells it from others.
    CoreKind, "kind of job" {
        /// Printed parts on a laser-cut base.
        Core = "core",
    }
}

choice! {
    /// The goal of the object.
    CoreGoal, "goal of an object on a base" {
        /// It stands on its own foot.
        Stand = "stand",
        /// Nothing is promised.
        None = "none",
    }
}

choice! {
    /// The style of the printed parts.
    CoreShell, "style of shell" {
        /// Hollow, open to the base.
        Cups = "cups",
        /// Solid down to the base.
        Solid = "solid",
    }
}

choice! {
    /// The joints between panels.
    CoreJoints, "kind of joint" {
        /// Fingers where they fit, brackets elsewhere.
        Auto = "auto",
        /// Fingers on all edges.
        Fingers = "fingers",
        /// Printed brackets on all edges.
        Brackets = "brackets",
    }
}

/// Everything that decides the bytes of a kit, apart from the version of the program and of its
/// built-in profiles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CoreJob {
    /// The version of the file's format, [`CORE_SCHEMA`].
    #[serde(deserialize_with = "read_schema")]
    pub schema: u32,
    /// Always an object on a base.
    pub kind: CoreKind,
    /// The greatest number of faces of each polyhedron of the base.
    pub faces: usize,
    /// The method by which the base is looked for.
    #[serde(default, skip_serializing_if = "BaseMethod::is_planes")]
    pub method: BaseMethod,
    /// The number of polyhedra.
    #[serde(default = "one_polyhedron", skip_serializing_if = "Polyhedra::is_one")]
    pub polyhedra: Polyhedra,
    /// The least radius of the disc in which panels of two polyhedra bear on each other. If `None`,
    /// it is 20 mm, or what two bolts need if that is more.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub connector: Option<Length>,
    /// The rods between polyhedra whose panels do not bear on each other.
    #[serde(default, skip_serializing_if = "Dowel::is_auto")]
    pub dowel: Dowel,
    /// The joints between panels.
    pub joints: CoreJoints,
    /// The style of the printed parts.
    pub shell: CoreShell,
    /// The wall asked for; 3 mm, or the printer's minimum if that is more, if `None`.
    pub wall: Option<Length>,
    /// The goal of the object.
    pub goal: CoreGoal,
    /// The toppling angle that it promises if it stands, degrees.
    pub least_angle_deg: f64,
    /// The ballast on the lowest panel.
    #[serde(default, skip_serializing_if = "Order::is_none")]
    pub ballast: Order,
    /// The direction of the model that points up.
    pub up: Up,
    /// The model.
    pub model: ModelChoice,
    /// The printer and its material.
    pub printer: PrinterChoice,
    /// The cutter and its sheet.
    pub cutting: CutChoice,
    /// The base to use, in place of one that is looked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub base: Option<BaseChoice>,
    /// A copy of the model that is read in its place. It is no part of the file.
    #[serde(skip)]
    pub model_copy: Option<PathBuf>,
}

/// The cutter and the sheet.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CutChoice {
    /// A built-in cutter's id, or the path of a profile.
    pub cutter: String,
    /// A built-in sheet's id, or the path of a profile.
    pub sheet: String,
    /// The sheets at hand; those of the sheet's profile if empty.
    #[serde(default, skip_serializing_if = "StockList::is_empty")]
    pub stock: StockList,
    /// The choice to let panels follow the grain; as the sheet's profile says if `None`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub grain: Option<GrainChoice>,
}

impl CutChoice {
    /// Returns the choice of a cutter and a sheet, with the sizes and the grain of its profile.
    pub fn new(cutter: impl Into<String>, sheet: impl Into<String>) -> Self {
        Self {
            cutter: cutter.into(),
            sheet: sheet.into(),
            stock: StockList::default(),
            grain: None,
        }
    }
}

impl CoreJob {
    /// Returns the job with default settings.
    pub fn new(model: ModelChoice, printer: PrinterChoice, cutting: CutChoice) -> Self {
        Self {
            schema: CORE_SCHEMA,
            kind: CoreKind::Core,
            faces: USUAL_FACES,
            method: BaseMethod::Planes,
            polyhedra: one_polyhedron(),
            connector: None,
            dowel: Dowel::Auto,
            joints: CoreJoints::Auto,
            shell: CoreShell::Cups,
            wall: None,
            goal: CoreGoal::Stand,
            least_angle_deg: CORE_LEAST_ANGLE_DEG,
            ballast: Order::None,
            up: Up::Natural,
            model,
            printer,
            cutting,
            base: None,
            model_copy: None,
        }
    }

    /// Returns the model's name as it stands in file names: without its ending, and with hyphens
    /// for what is no letter or digit.
    pub fn name(&self) -> String {
        let stem = self.model.path.file_stem();
        let stem = stem.map(|stem| stem.to_string_lossy().into_owned());
        let is_plain = |c: char| c.is_alphanumeric() || c == '-' || c == '_';
        let plain = |c: char| if is_plain(c) { c } else { '-' };
        stem.unwrap_or_default().chars().map(plain).collect()
    }

    /// Returns the file that the model is read from.
    pub fn model_file(&self) -> &Path {
        self.model_copy.as_ref().unwrap_or(&self.model.path)
    }

    /// Returns the job as its kit tells it: without the folder in which the model lay.
    pub fn in_kit(&self) -> Self {
        Self {
            model: self.model.without_folder(),
            base: self.base.as_ref().map(BaseChoice::without_folder),
            ..self.clone()
        }
    }

    /// Binds the job to the bytes of its model file. Refuses if it was bound to others.
    pub fn bind_to(mut self, model_bytes: &[u8]) -> Result<Self, JobError> {
        let found = sha256_hex(&[model_bytes]);
        match self.model.sha256 {
            Some(expected) if expected != found => Err(JobError::ModelChanged {
                path: self.model.path,
                found,
                expected,
            }),
            _ => {
                self.model.sha256 = Some(found);
                Ok(self)
            }
        }
    }

    /// Reads the job in the file at `path`.
    pub fn read(path: &Path) -> Result<Self, JobError> {
        let text = std::fs::read_to_string(path).map_err(|source| JobError::Unreadable {
            path: path.to_owned(),
            source,
        })?;
        Ok(Self::from_toml(&path.to_string_lossy(), &text)?)
    }

    /// Reads a job from the text of a `job.toml`; messages call it `file`.
    pub fn from_toml(file: &str, text: &str) -> Result<Self, TextFault> {
        toml_text::read(file, text)
    }

    /// Returns the job as the text of a `job.toml`.
    pub fn to_toml(&self) -> Result<String, JobError> {
        Ok(format!("{REMARK}{}", toml::to_string(self)?))
    }
}

fn one_polyhedron() -> Polyhedra {
    Polyhedra::Exactly(1)
}

fn read_schema<'de, D: Deserializer<'de>>(deserializer: D) -> Result<u32, D::Error> {
    match u32::deserialize(deserializer)? {
        CORE_SCHEMA => Ok(CORE_SCHEMA),
        other => Err(D::Error::custom(format!(
            "schema {other} is not known; remedy: use the version of equipoise that wrote it, this \
             one reads schema {CORE_SCHEMA}"
        ))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Scaling;

    fn job() -> CoreJob {
        let model = ModelChoice {
            path: "models/a hare.stl".into(),
            sha256: None,
            scaling: Scaling::Size("600mm".parse().unwrap()),
        };
        let printer = PrinterChoice {
            id: "prusa-mk3s".to_owned(),
            material: None,
        };
        let cutting = CutChoice::new("makerspace-900x600", "birch-5");
        CoreJob::new(model, printer, cutting)
    }

    #[test]
    fn a_written_job_is_read_again_as_it_was() {
        let mut job = job();
        job.joints = CoreJoints::Brackets;
        job.wall = Some(Length::from_mm(3.2).unwrap());
        job.up = Up::Along([0.0, 0.5, 1.0]);
        let usual = job.to_toml().unwrap();
        assert!(!usual.contains("stock") && !usual.contains("ballast"));
        job.cutting.stock = "900x600,600x400*2".parse().unwrap();
        job.cutting.grain = Some(GrainChoice::Free);
        job.ballast = Order::Auto;
        let plain = job.to_toml().unwrap();
        assert!(
            !plain.contains("polyhedra") && !plain.contains("base") && !plain.contains("method"),
            "{plain}"
        );
        assert_eq!(CoreJob::from_toml("job.toml", &plain).unwrap(), job);
        job.polyhedra = Polyhedra::Auto;
        job.method = BaseMethod::Vertices(None);
        job.connector = Some(Length::from_mm(25.0).unwrap());
        job.dowel = Dowel::Id("dowel-8".to_owned());
        job.base = Some(BaseChoice {
            file: "base.toml".to_owned(),
            toml: "# A base\n[[polyhedron]]\nword = \"it's\"\n".to_owned(),
        });
        let text = job.to_toml().unwrap();
        assert!(text.contains("kind = \"core\""));
        assert_eq!(CoreJob::from_toml("job.toml", &text).unwrap(), job);
        let newer = text.replace("schema = 1", "schema = 7");
        assert!(CoreJob::from_toml("job.toml", &newer).is_err());
        assert_eq!(job.name(), "a-hare");
    }

    #[test]
    fn a_job_stays_with_the_model_that_it_was_made_of() {
        let bound = job().bind_to(b"a hare").unwrap();
        assert!(bound.clone().bind_to(b"a hare").is_ok());
        assert!(matches!(
            bound.bind_to(b"a tortoise"),
            Err(JobError::ModelChanged { .. })
        ));
    }
}
