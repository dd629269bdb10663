//! The whole input of a run as plain data. `job.toml` replays the run exactly.

pub mod base_choice;
pub mod base_method;
mod choices;
pub mod core_kit;
mod defaults;
mod densities;
mod drain;
mod effort;
mod field;
mod filling;
mod like;
mod model;
mod reading;
mod sliced;
mod slicer;
mod stock_list;
pub mod telescope;
mod telescope_pose;
mod telescope_root;

use std::path::{Path, PathBuf};

use serde::{Deserialize, Deserializer, Serialize, de::Error as _};

pub use choices::{CutMode, IdStyle, Interior, ModelUnit, PartFormat, PinStyle};
pub use densities::{DensityError, DensityOrder, InfillDensity, KeptShare, LevelCount};
pub use drain::{DrainOrder, DrainOrderError};
pub use effort::Effort;
pub use field::{FieldOrder, FieldOrderError, GivenField};
pub use filling::Filling;
pub use like::Like;
pub use model::ModelChoice;
pub use sliced::{SlicedKit, SlicedPart, SlicedPlate, SlicedRound};
pub use slicer::SlicerChoice;
pub use stock_list::{GrainChoice, StockError, StockItem, StockList};

use reading::{read_goal, read_positive};

use crate::ballast::Order;
use crate::base::digest::sha256_hex;
use crate::base::toml_text::{self, TextFault};
use crate::base::units::Length;
use crate::cut::{CutOrder, KeepClear, LeastPart, SeamStyle};
use crate::goal::Request;
use crate::repair::RepairOrder;

/// The version of `job.toml` that this program writes and reads.
pub const JOB_SCHEMA: u32 = 1;

/// The first line of every written `job.toml`.
const REMARK: &str = "# Replays the run: equipoise prepare, with this file as its job; away from its kit with the model too.\n\n";

/// The line of a `job.toml` that named the only solver.
const OLD_SOLVER: &str = "solver = \"quadric\"";

/// Everything that decides the bytes of a kit, apart from the version of the program and of its
/// built-in profiles.
///
/// The number of threads, the output folder and the progress display are not part of it: they do
/// not change the kit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Job {
    /// The version of the file's format, [`JOB_SCHEMA`].
    #[serde(deserialize_with = "read_schema")]
    pub schema: u32,
    /// The wall asked for; the profile's minimum if `None`.
    pub wall: Option<Length>,
    /// The pitch of the solver's columns; the printer's own if `None`.
    pub pitch: Option<Length>,
    /// The choice to cut the object.
    pub cut: CutMode,
    /// The drain holes of an uncut piece; the least that do if the key is missing.
    #[serde(default, skip_serializing_if = "DrainOrder::is_auto")]
    pub drain: DrainOrder,
    /// True if each drain hole gets a plug that closes it; it stays open if the key is missing.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub plugs: bool,
    /// The kind of seam; hidden ones if the key is missing.
    #[serde(
        default = "defaults::seam",
        skip_serializing_if = "SeamStyle::is_hidden"
    )]
    pub seam: SeamStyle,
    /// The least part; the usual limit if the key is missing.
    #[serde(
        default = "defaults::least_part",
        skip_serializing_if = "LeastPart::is_usual"
    )]
    pub least_part: LeastPart,
    /// The pins that align the parts; printed ones if the key is missing.
    #[serde(
        default = "defaults::pins",
        skip_serializing_if = "PinStyle::is_printed"
    )]
    pub pins: PinStyle,
    /// The marking of parts with their ids; engraved into cut faces if the key is missing.
    #[serde(
        default = "defaults::ids",
        skip_serializing_if = "IdStyle::is_engraved"
    )]
    pub ids: IdStyle,
    /// The effort of the search for cuts and pins; the usual one if the key is missing.
    #[serde(
        default = "defaults::effort",
        skip_serializing_if = "Effort::is_normal"
    )]
    pub effort: Effort,
    /// The greatest share of the goal's figure that joints may cost; the policy's own if `None`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint_price_ratio: Option<f64>,
    /// True if thin features of the model are thickened to the printer's least wall.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub thicken: bool,
    /// True if the kit is made without a copy of the model; it has one if the key is missing.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub no_model: bool,
    /// The file format of the parts.
    pub format: PartFormat,
    /// The slicer that is asked what the plates take; none if the key is missing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slicer: Option<SlicerChoice>,
    /// The ballast asked for; none if the key is missing.
    #[serde(default, skip_serializing_if = "Order::is_none")]
    pub ballast: Order,
    /// The filling of the voids; air if the key is missing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fill: Option<Filling>,
    /// The inside of the print; hollow if the key is missing.
    #[serde(
        default = "defaults::interior",
        skip_serializing_if = "Interior::is_hollow"
    )]
    pub interior: Interior,
    /// The size of the cells of an inside of cells; the usual one if the key is missing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cell_size: Option<Length>,
    /// The least and the greatest density of a graded print; the printer's if the key is missing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub density: Option<DensityOrder>,
    /// The infill that a graded print should be near to everywhere; the goal decides without it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub infill: Option<InfillDensity>,
    /// The number of densities near that infill; the usual one if the key is missing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub levels: Option<LevelCount>,
    /// The share of the best figure that a print near that infill keeps; the usual one of the goal
    /// if the key is missing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub keep: Option<KeptShare>,
    /// The field of densities of a graded print; the best densities if the key is missing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub field: Option<FieldOrder>,
    /// The repairs of the model asked for; those that everyone gets if the key is missing.
    #[serde(default, skip_serializing_if = "RepairOrder::is_auto")]
    pub repair: RepairOrder,
    /// The model.
    pub model: ModelChoice,
    /// The printer and its material.
    pub printer: PrinterChoice,
    /// The goal.
    #[serde(deserialize_with = "read_goal")]
    pub goal: Request,
    /// The body that a match is like; none if its numbers were typed, and for other goals.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub like: Option<Like>,
    /// The balls that no seam enters; none if the key is missing.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub keep_clear: Vec<KeepClear>,
    /// The rounds in which the kit was sliced. The last one holds; none if the key is missing.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sliced: Vec<SlicedRound>,
    /// The toolpaths of the kit itself, as they were weighed; `None` if nobody sliced it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub toolpaths: Option<SlicedKit>,
    /// The cuts and pins that the user ordered, in place of the planner's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plan: Option<CutOrder>,
    /// A copy of the model that is read in its place. It is no part of the file.
    #[serde(skip)]
    pub model_copy: Option<PathBuf>,
}

/// The conversion of a model file's numbers to mm.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Scaling {
    /// The numbers are in this unit.
    Unit(ModelUnit),
    /// The numbers times this factor, positive and finite, are mm.
    #[serde(deserialize_with = "read_positive")]
    Factor(f64),
    /// The longest side of the model's bounding box becomes this.
    Size(Length),
}

impl Scaling {
    /// Returns the factor from the file's numbers to mm, for a model whose longest side is
    /// `longest_side` in those numbers (positive).
    pub fn factor(self, longest_side: f64) -> f64 {
        match self {
            Self::Unit(unit) => unit.mm(),
            Self::Factor(factor) => factor,
            Self::Size(size) => size.mm() / longest_side,
        }
    }
}

/// The printer and the material.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PrinterChoice {
    /// A built-in printer's id, or the path of a profile.
    pub id: String,
    /// A material's id; the printer's default if `None`.
    pub material: Option<String>,
}

/// A reason why a plan of cuts cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PlanError {
    /// The file cannot be read.
    #[error(
        "cannot read the cuts {path}; remedy: give auto, never, or the path of a plan such as a \
         kit's cuts.toml"
    )]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: std::io::Error,
    },
    /// The text is not a plan.
    #[error(transparent)]
    Text(#[from] TextFault),
}

/// Reads the cuts and pins ordered in the file at `path`.
pub fn read_plan(path: &Path) -> Result<CutOrder, PlanError> {
    let text = std::fs::read_to_string(path).map_err(|source| PlanError::Unreadable {
        path: path.to_owned(),
        source,
    })?;
    Ok(CutOrder::from_toml(&path.to_string_lossy(), &text)?)
}

/// A reason why a job cannot be read, written or replayed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum JobError {
    /// The file cannot be read.
    #[error("cannot read the job {path}; remedy: check the path and its permissions")]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: std::io::Error,
    },
    /// The text is not a job.
    #[error(transparent)]
    Text(#[from] TextFault),
    /// The model is not the one that the job was made with.
    #[error(
        "{path} is not the file this job was made with (SHA-256 {found}, was {expected}); remedy: \
         restore the file, or remove sha256 from the job"
    )]
    ModelChanged {
        /// The model file.
        path: PathBuf,
        /// Its hash now.
        found: String,
        /// Its hash in the job.
        expected: String,
    },
    /// The job cannot be written as TOML, for instance because a path is not Unicode.
    #[error(
        "the job cannot be written as TOML; remedy: rename the model so that its path is plain text"
    )]
    Unwritable(#[from] toml::ser::Error),
}

impl Job {
    /// Returns the job with default settings.
    pub fn new(model: ModelChoice, printer: PrinterChoice, goal: Request) -> Self {
        Self {
            schema: JOB_SCHEMA,
            wall: None,
            pitch: None,
            cut: CutMode::Auto,
            drain: DrainOrder::Auto,
            plugs: false,
            seam: defaults::seam(),
            least_part: defaults::least_part(),
            pins: PinStyle::Printed,
            ids: IdStyle::Engraved,
            effort: Effort::Normal,
            joint_price_ratio: None,
            thicken: false,
            no_model: false,
            slicer: None,
            format: PartFormat::Both,
            ballast: Order::None,
            fill: None,
            interior: Interior::Hollow,
            cell_size: None,
            density: None,
            infill: None,
            levels: None,
            keep: None,
            field: None,
            repair: RepairOrder::default(),
            model,
            printer,
            goal,
            like: None,
            keep_clear: Vec::new(),
            sliced: Vec::new(),
            toolpaths: None,
            plan: None,
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

    /// Reads the job in the file at `path`.
    pub fn read(path: &Path) -> Result<Self, JobError> {
        let text = std::fs::read_to_string(path).map_err(|source| JobError::Unreadable {
            path: path.to_owned(),
            source,
        })?;
        Ok(Self::from_toml(&path.to_string_lossy(), &text)?)
    }

    /// Reads a job from the text of a `job.toml`; messages call it `file`. Restores the values that
    /// [`Job::to_toml`] wrote, to the bit.
    ///
    /// Accepts the line `solver = "quadric"` of older kits, which had no other value.
    pub fn from_toml(file: &str, text: &str) -> Result<Self, TextFault> {
        toml_text::read(file, &without_solver(text))
    }

    /// Returns the job as the text of a `job.toml`.
    pub fn to_toml(&self) -> Result<String, JobError> {
        Ok(format!("{REMARK}{}", toml::to_string(self)?))
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
}

/// Blanks the line that older kits carry for the only solver. The places of other lines stay.
fn without_solver(text: &str) -> String {
    let (head, tables) = text.split_at(text.find("\n[").unwrap_or(text.len()));
    let kept = |line: &str| match line.trim_end() {
        OLD_SOLVER => line.replacen(OLD_SOLVER, "", 1),
        _ => line.to_owned(),
    };
    head.split_inclusive('\n').map(kept).collect::<String>() + tables
}

fn read_schema<'de, D: Deserializer<'de>>(deserializer: D) -> Result<u32, D::Error> {
    match u32::deserialize(deserializer)? {
        JOB_SCHEMA => Ok(JOB_SCHEMA),
        other => Err(D::Error::custom(format!(
            "schema {other} is not known; remedy: use the version of equipoise that wrote it, \
             this one reads schema {JOB_SCHEMA}"
        ))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::goal::{
        Contact, GoalKind, Hardware, Liquid, Objective, Rotor, Up, Water, Waterline,
    };
    use proptest::prelude::*;

    fn job() -> Job {
        let model = ModelChoice {
            path: "models/elephant.obj".into(),
            sha256: None,
            scaling: Scaling::Size(Length::from_mm(100.0).unwrap()),
        };
        let printer = PrinterChoice {
            id: "objet-connex350".into(),
            material: None,
        };
        Job::new(model, printer, Request::new(GoalKind::Top))
    }

    fn reread(job: &Job) -> Job {
        Job::from_toml("job.toml", &job.to_toml().unwrap()).unwrap()
    }

    #[test]
    fn a_written_job_reads_back_equal() {
        let mut other = job().bind_to(b"solid").unwrap();
        other.wall = Some("1.1mm".parse().unwrap());
        other.pitch = Some("0.1".parse().unwrap());
        other.cut = CutMode::Never;
        other.seam = SeamStyle::Level;
        other.effort = Effort::Thorough;
        other.interior = Interior::Graded;
        other.cell_size = Some("12mm".parse().unwrap());
        other.density = Some("15%..62.5%".parse().unwrap());
        other.infill = Some("40%".parse().unwrap());
        other.levels = Some("6".parse().unwrap());
        other.keep = Some("95%".parse().unwrap());
        other.field = Some("ramp:0,0,1@20mm..60mm:0.2..1".parse().unwrap());
        let mut shaped = job();
        shaped.field = serde_json::from_value(serde_json::json!({
            "file": "dense.toml",
            "text": "# A core\n[field]\nsum = [\"uniform:20%\", \"skin:3mm:linear:0..0.3\"]\n",
        }))
        .ok();
        assert!(shaped.field.is_some());
        assert_eq!(reread(&shaped), shaped);
        other.sliced = vec![SlicedRound {
            infill_ratio: None,
            miss_mm: 0.0317,
            beyond: [460.1, -3.0, 0.1 + 0.2, 0.0, 1e-7, 2.0, 3.0, 4e9, 5.0, 6.0],
        }];
        other.toolpaths = Some(SlicedKit {
            slicer: "PrusaSlicer 2.5.0".into(),
            profile_sha256: Some("cd".repeat(32)),
            mass_g: 81.25,
            miss_mm: 0.0031,
            tilt_deg: None,
            plates: vec![SlicedPlate {
                file: "plate.3mf".into(),
                sha256: "ab".repeat(32),
                minutes: 185,
                parts_g: 81.25,
                support_g: 7.5,
                filament_g: Some(0.1 + 0.2),
            }],
            parts: Vec::new(),
        });
        other.least_part = "5%".parse().unwrap();
        other.repair = "remesh:0.1mm,fill".parse().unwrap();
        other.keep_clear = vec!["1,2.5,-3,4".parse().unwrap(), "0,0,9,1".parse().unwrap()];
        other.printer.material = Some("vero-white".into());
        other.model.scaling = Scaling::Factor(0.1 + 0.2);
        other.goal = Request {
            up: Up::Principal,
            objective: Objective::Dominance,
            ..Request::new(GoalKind::Yoyo)
        };
        let [mut rotor, mut boat] = [job(), job()];
        rotor.goal = Request::new(GoalKind::Balance);
        rotor.goal.rotor = Some(Rotor {
            speed_rpm: 12_000.0,
            grade_mm_s: 1.0,
            bore: "8mm".parse().ok(),
        });
        boat.goal = Request::new(GoalKind::Float);
        boat.goal.water = Some(Water {
            liquid: Liquid::Density(1.26),
            waterline: Waterline::Auto,
        });
        (boat.pins, boat.ids) = (PinStyle::Dowel, IdStyle::None);
        let mut yoyo = job();
        yoyo.goal = Request::new(GoalKind::Yoyo);
        let axle = "6mmx30mm:2.7".parse().ok();
        yoyo.goal.hardware = Some(Hardware {
            string_gap: "3mm".parse().ok(),
            axle,
            mass_g: Some(2.5),
            ..Hardware::default()
        });
        let mut firm = job();
        firm.goal.tip = "none".parse().unwrap();
        firm.goal.least_lean_deg = 12.5;
        assert!(firm.to_toml().unwrap().contains("tip = \"none\""));
        assert_eq!(reread(&firm), firm);
        assert!(yoyo.to_toml().unwrap().contains("axle = \"6mmx30mm:2.7\""));
        for job in [job(), other, rotor, boat, yoyo] {
            assert_eq!(reread(&job), job);
        }
    }

    #[test]
    fn a_job_of_an_older_kit_reads_with_its_only_solver() {
        let text = job().to_toml().unwrap();
        let older = text.replacen("schema = 1\n", "schema = 1\nsolver = \"quadric\"\n", 1);
        assert!(!text.contains("solver") && older.contains("solver"));
        assert_eq!(Job::from_toml("job.toml", &older), Ok(job()));
        let broken = older.replacen("cut = ", "cuts = ", 1);
        let error = Job::from_toml("job.toml", &broken).unwrap_err().to_string();
        assert!(error.starts_with("job.toml:5:1: "), "{error}");
    }

    #[test]
    fn a_job_reads_as_a_person_would_write_it() {
        let text = job().to_toml().unwrap();
        for line in [
            "schema = 1",
            "up = \"z\"",
            "contact = \"auto\"",
            "size = \"100mm\"",
            "kind = \"top\"",
        ] {
            assert!(text.contains(line), "{line} in\n{text}");
        }
        assert!(!text.contains("thread") && !text.contains("out"), "{text}");
    }

    proptest! {
        #[test]
        fn any_numbers_survive_the_file(
            x in -1e9..1e9_f64,
            z in 1e-9..1.0_f64,
            size in 1e-3..1e6_f64,
        ) {
            let mut job = job();
            job.goal.up = Up::Along([x, 0.0, z]);
            job.goal.contact = Some(Contact::At([z, x, -size]));
            job.model.scaling = Scaling::Size(Length::from_mm(size).unwrap());
            prop_assert_eq!(reread(&job), job);
        }
    }

    /// A replacement in a written job, and the words that the message must contain.
    const BROKEN: [(&str, &str, &str); 15] = [
        ("schema = 1", "schema = 2", ":3:10: schema 2 is not known"),
        ("schema = 1\n", "", "missing field `schema`"),
        (
            "schema = 1\n",
            "schema = 1\nsolver = \"octree\"\n",
            "unknown field `solver`",
        ),
        ("cut = ", "cuts = ", "did you mean `cut`"),
        (
            "schema = 1\n",
            "schema = 1\nwall = \"-1mm\"\n",
            ":4:8: `-1mm` is not a positive, finite length",
        ),
        (
            "schema = 1\n",
            "schema = 1\nwall = nan\n",
            ":4:8: `NaN` is not a positive, finite length",
        ),
        (
            "schema = 1\n",
            "schema = 1\nwall = \"1 league\"\n",
            "`league` in `1 league` is not a unit",
        ),
        ("up = \"z\"", "up = \"0,0,0\"", "has no direction"),
        ("up = \"z\"", "up = \"w\"", "is not a direction"),
        (
            "contact = \"auto\"",
            "contact = \"highest\"",
            "is not a contact point",
        ),
        (
            "kind = \"top\"",
            "kind = \"spinner\"",
            "unknown variant `spinner`",
        ),
        (
            "kind = \"top\"",
            "kind = \"yoyo\"",
            "critical-speed does not go with the goal yoyo; remedy: use spin-it or dominance",
        ),
        (
            "objective = ",
            "spin_point = \"center\"\nobjective = ",
            "a spin point goes with the goal yoyo or balance",
        ),
        (
            "size = \"100mm\"",
            "factor = -2.0",
            "-2 is not a positive, finite factor",
        ),
        ("size = \"100mm\"", "length = 3", "unknown variant `length`"),
    ];

    #[test]
    fn every_broken_job_is_refused_with_its_place_and_its_reason() {
        let whole = job().to_toml().unwrap();
        let mut wrong = Vec::new();
        for (from, to, reason) in BROKEN {
            assert!(whole.contains(from), "{from} in\n{whole}");
            let error = Job::from_toml("job.toml", &whole.replacen(from, to, 1))
                .expect_err(to)
                .to_string();
            if !error.contains(reason)
                || !error.starts_with("job.toml:")
                || error.starts_with("job.toml:1:1: `")
            {
                wrong.push(format!("{from} → {to}: {error}"));
            }
        }
        assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    }

    #[test]
    fn a_job_is_bound_to_the_bytes_of_its_model() {
        let bound = job().bind_to(b"abc").unwrap();
        let abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(
            bound.model.sha256.as_deref(),
            Some(abc),
            "the test vector of FIPS 180-4"
        );
        assert!(bound.clone().bind_to(b"abc").is_ok());
        assert!(matches!(
            bound.bind_to(b"abd"),
            Err(JobError::ModelChanged { .. })
        ));
    }

    #[test]
    fn scaling_brings_the_longest_side_to_the_size() {
        assert_eq!(
            Scaling::Size(Length::from_mm(100.0).unwrap()).factor(0.5),
            200.0
        );
        assert_eq!(Scaling::Unit(ModelUnit::In).factor(7.0), 25.4);
        assert_eq!(Scaling::Factor(3.0).factor(7.0), 3.0);
    }
}
