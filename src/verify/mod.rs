//! The independent judge. It sees the written files of a kit, its promises and the printer, and
//! nothing of the code that made them.
//!
//! [`verify_kit`] reads a kit from its folder; [`judge`] measures the evidence; [`checks`] compares
//! the facts with the promises. Facts and checks are separate: a fact is a measured value, a check
//! holds it against a limit.

// The promises: the judge's view of `checklist.json`.
mod bound_proof;
mod fingerprint;
mod pose;
mod process;
mod promise;
// The evidence: reading a kit.
mod error;
mod evidence;
mod files;
mod reading;
// The facts about a whole body.
mod asked;
mod ballast;
mod body;
mod bound;
mod cells_order;
mod figures;
mod hardware;
mod hole;
mod laid;
mod loads;
mod rotor;
mod sparse;
mod spin;
mod stock;
mod support;
mod water;
// The facts about surfaces, parts and joints.
mod cell_walls;
mod cleaning;
mod cover;
mod cups;
mod drains;
mod jigs;
mod joints;
mod measure;
mod mouths;
mod part_probe;
mod peg_shape;
mod pegs;
mod plates;
mod play;
mod plugs;
mod regions;
mod rim;
mod rooms;
mod shape;
mod shells;
mod slack;
// The checks and the verdict.
mod check;
mod checks;
mod goal_checks;
mod handling;
mod judge;
mod judgement;
mod kind;
mod limits;
mod peg_checks;
mod shape_checks;
mod thin_checks;
mod void_checks;
// The checks of the files of a kit as they were delivered.
mod change;
mod changes;
mod claims;
mod kit;
mod machine;
mod model;
mod orders;
mod packages;
mod redrawn;
mod rows;
mod seal;
mod sheet;
mod strangers;
// The toolpaths of a kit.
mod printed;
// Objects on a base, telescopes, and what the judges of both read alike.
mod core_kit;
mod kind_packages;
mod kit_folder;
mod telescope;

#[cfg(test)]
mod cleaning_tests;
#[cfg(test)]
pub(crate) mod judge_tests;
#[cfg(test)]
mod kit_tests;
#[cfg(test)]
mod pegs_tests;
#[cfg(test)]
mod shape_tests;
#[cfg(test)]
pub(crate) mod test_meshes;

// The judgement: from a folder, or from evidence in memory.
pub use error::VerifyError;
pub use evidence::{Evidence, PartEvidence, assembly_moments};
pub use judge::{judge, judge_measured};
pub use judgement::Judgement;
pub use kit::{verify_kit, verify_kit_of};
pub use reading::{find_model, read_kit, read_promise};

// The promises.
pub use crate::printer::{Cleaning, CleaningRule};
pub use ballast::{BallastOrder, FillOrder};
pub use bound_proof::{BoundPoint, BoundProof, KeptPlace};
pub use cells_order::CellsOrder;
pub use fingerprint::{Fingerprint, Likeness};
pub use hardware::{Hardware, HardwareKind};
pub use hole::{PromisedHole, PromisedPlug};
pub use laid::LaidOrder;
pub use plates::{PlateSpot, PromisedPlate};
pub use plugs::PlugFacts;
pub use pose::Pose;
pub use process::{Density, PrinterLimits};
pub use promise::{
    Aim, FigureName, GlueFilm, HeldBy, Mark, Peg, Promise, PromisedBound, PromisedCut,
    PromisedFigure, PromisedJig, PromisedJoint, PromisedPart, PromisedVoid, SCHEMA, WallOrder,
};
pub use rotor::RotorOrder;
pub use sparse::{InfillLevel, InfillOrder, beyond_ratio, infill_share};
pub use water::WaterOrder;

// The facts.
pub use body::Body;
pub use cell_walls::CellFacts;
pub use cleaning::VoidFacts;
pub use cups::CupFacts;
pub use drains::HoleFacts;
pub use figures::{Figures, Setting};
pub use handling::Mismatch;
pub use hardware::{Fit, mass_moments};
pub use jigs::{JigFacts, is_loose, measure_jigs};
pub use joints::FilmError;
pub use measure::{PartFacts, SurfaceFacts};
pub use pegs::PegFacts;
pub use play::JointFacts;
pub use regions::RegionFacts;
pub use rotor::Unbalance;
pub use shape::{ShapeFacts, Stray};
pub use shells::Shells;
pub use spin::SpinFacts;
pub use support::{SUPPORT_BAND_RATIO, Support};
pub use water::{Afloat, Hull};

// The checks and their limits.
pub use check::{Check, Comparison, Limit};
pub use checks::checks;
pub use kind::CheckKind;
pub use limits::{
    AXIS_OFFSET_LIMIT_MM, AXIS_TILT_LIMIT_DEG, CONTACT_LIMIT_MM, DOMINANCE_LIMIT_RATIO,
    FIGURE_SLACK_RATIO, FILM_LIMIT_RATIO, GAP_TOLERANCE_MM, METACENTRIC_LIMIT_MM, PIN_LIMIT_MM,
    POSE_LIMIT_RATIO, RESTING_LIMIT_MM, RIGHTING_LIMIT_DEG, SHEET_LIMIT_RATIO,
    SIGHT_TOLERANCE_RATIO, STANDING_LIMIT_DEG, STRING_GAP_TOLERANCE_MM, VOLUME_SUM_LIMIT_RATIO,
    WALL_TOLERANCE_MM, WATERLINE_LIMIT_MM,
};

// The files of a kit and their changes.
pub use change::{Change, FileChange};
pub use changes::files_check;
pub use files::{
    CERTIFICATE_FILE, CHECKLIST_FILE, CUTS_FILE, FIELD_FILE, HOLLOWED_FILE, JOB_FILE, MODEL_FOLDER,
    SHEET_FILE, SPARSE_FOLDER, SUMS_FILE,
};
pub use seal::sums;
pub use sheet::find_misstatements;
// The toolpaths of a kit.
pub use printed::{
    Cause, CauseKind, LocatedPart, LocatedPlate, MatchedBy, PRINTED_CENTER_LIMIT_MM,
    PRINTED_MASS_LIMIT_RATIO, PRINTED_SKIN_MM, PRINTED_TILT_LIMIT_DEG, PrintedError, PrintedFile,
    PrintedJudgement, PrintedPart, locate_parts, verify_printed,
};
// The kinds of kits.
pub use kit_folder::{KindJudgement, KitFolderError, KitKind};
// Objects on a base.
pub use core_kit::{
    BallastPromise, BaseCertificate, BossPromise, BuyPromise, CORE_CERTIFICATE_FILE,
    CoreCertificate, CoreEvidence, CoreFacts, CorePartKind, CorePartPromise, CorePromise,
    CoreVerifyError, CutPromise, CutSheetPromise, CutterPromise, EdgePromise, FastenerKind,
    FastenerPromise, GluePromise, HolePromise, JoinPromise, MODEL_FILE, PANELS_FILE, PanelPromise,
    PanelsFile, PegPromise, PlacedPanel, RodPromise, StockPromise, UnitPromise, core_checks,
    judge_core, verify_core,
};
// Telescopes.
pub use telescope::{
    BalancePromise, DeviationPromise, JointMotion, JointPromise, MotionKey, PoseMotion,
    PosePromise, PoseState, PoseText, PoseTextJoint, PoseTipPromise, PosesFacts, REACH_LIMIT_MM,
    ShellMotion, TelescopeBallast, TelescopeEvidence, TelescopeFacts, TelescopeMotion,
    TelescopePartPromise, TelescopePromise, TelescopeVerifyError, judge_telescope,
    telescope_checks, verify_telescope,
};
pub use telescope::{
    CURVE_FILE, MOTION_FILE, MOTION_SCENE_FILE, NESTED_FILE, NESTED_NAME, OPENING, asked_points,
};
// Several telescopes on junctures.
pub use telescope::{
    DividedFacts, DividedPromise, JunctureJointPromise, JuncturePartPromise, JuncturePromise,
    LimbPromise, ModelFacts, NETWORK_SCHEMA, NetworkEvidence, NetworkFacts, NetworkKey,
    NetworkMotion, NetworkPromise, NetworkStanding, judge_network, limb_curve_file, network_checks,
};
