//! The judge of objects on a laser-cut base: from the written parts, the drawings of the sheets,
//! and the lists of the kit alone.
//!
//! [`verify_core`] reads a kit from its folder, [`judge_core`] measures evidence in memory. Nothing
//! of the code that makes bases, panels and shells is seen here. The judge halves triangles, builds
//! panels and finds seams by its own hand.

mod ballast;
mod base_files;
mod bench;
mod certificate;
mod checks;
mod drawings;
mod error;
mod evidence;
mod facts;
mod flat;
mod hardware;
mod joining;
mod packages;
mod panels;
mod pins;
mod promise;
mod reading;
mod rod_promise;
mod rods;
mod shell;
mod standing;
mod stock;
mod surfaces;
mod ways;

pub use base_files::{
    BaseCertificate, CoreCertificate, EdgePromise, HolePromise, PanelPromise, PanelsFile,
};
pub use checks::core_checks;
pub use error::CoreVerifyError;
pub use evidence::CoreEvidence;
pub use facts::{CoreFacts, judge_core};
pub use promise::{
    BallastPromise, BossPromise, CorePartKind, CorePartPromise, CorePromise, CutPromise,
    CutSheetPromise, CutterPromise, FastenerKind, FastenerPromise, GluePromise, JoinPromise,
    PegPromise, PlacedPanel, StockPromise, UnitPromise,
};
pub use reading::{CORE_CERTIFICATE_FILE, MODEL_FILE, PANELS_FILE, verify_core};
pub use rod_promise::{BuyPromise, RodPromise};
