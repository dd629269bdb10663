//! Equipoise hollows a 3D model so that its printed, glued parts spin, stand, float or run true as
//! asked.
//!
//! A mesh, a printer and a goal go in, and a kit comes out. It holds parts that can be printed,
//! cleaned and glued, and a job sheet that says what to do and what to measure. The void is
//! provably the best there is: for every goal it is what may be emptied, cut by one quadric
//! ([`guide::theory`]). Every solution carries its certificate.
//!
//! # The line
//! [`prepare::prepare`] runs a [`job::Job`] to its end. Its stages, and the rooms that do the work:
//!
//! | stage | rooms |
//! | --- | --- |
//! | load | [`io`] reads, [`mend`] mends by the rungs of [`repair`], [`mesh`] proves a solid, [`printer`] gives wall and pitch |
//! | place | [`goal`] places the aim, [`hardware`] bores sockets, [`advice`] chooses an open axis |
//! | solve | [`shell`] keeps the wall, [`interior`] measures columns, [`hollow`] solves, [`ballast`] adds mass |
//! | open | [`voids`] draws the surfaces, [`cut`] plans cuts and pins, [`poses`] chooses poses, [`open`] resolves both |
//! | make | [`make`] writes the parts and corrects them |
//! | judge | [`verify`] judges the files without knowing how they were made |
//! | kit | [`sheet`] and [`page`] make the job sheet with [`draw`], [`press`] prints it, [`kit`] writes the folder |
//!
//! [`run`] holds the facts that pass from stage to stage, [`base`] units and the watch over a run.
//! [`coupon`] lets a shop measure what its printer does. [`guide::map`] answers where things are.
//!
//! # The modules
//! This page lists fourteen modules. Six of them, [`model`], [`solve`], [`stages`], [`report`],
//! [`extend`] and [`large`], gather rooms: `equipoise::model::mesh` is also `equipoise::mesh`, and its
//! files lie in `src/mesh`.
//!
//! # Example
//! ```no_run
//! use equipoise::goal::{GoalKind, Request};
//! use equipoise::job::{Job, ModelChoice, PrinterChoice, Scaling};
//! use equipoise::prepare::{Outcome, prepare};
//! use equipoise::base::watch::Watch;
//! use equipoise::kit::Existing;
//!
//! let model = ModelChoice {
//!     path: "examples/models/tilted-ellipsoid.stl".into(),
//!     sha256: None,
//!     scaling: Scaling::Size("100mm".parse()?),
//! };
//! let printer = PrinterChoice { id: "objet-connex350".into(), material: None };
//! let job = Job::new(model, printer, Request::new(GoalKind::Top));
//! match prepare(&job, &Watch::silent())? {
//!     Outcome::Prepared(prepared) => prepared.kit.write("top-kit".as_ref(), Existing::Keep)?,
//!     Outcome::Impossible(why) => println!("{}", why.reason),
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![forbid(unsafe_code)]

pub mod base;
pub mod cut;
pub mod guide;
pub mod job;
pub mod kit;
pub mod prepare;
pub mod printer;
pub mod verify;

/// Points, meshes of triangles and tetrahedra, their files, repair, mass, densities that vary, and
/// cells.
pub mod model {
    #[doc(inline)]
    pub use crate::{cells, field, geom, io, mass, mend, mesh, repair, tets};
}

/// From a goal to the best void: what is asked, what may be emptied, the solver and its surfaces.
pub mod solve {
    #[doc(inline)]
    pub use crate::{ballast, comb, goal, hardware, hollow, interior, shell, voids};
}

/// The stages of a run between the solver and the judge, and the facts that pass between them.
pub mod stages {
    #[doc(inline)]
    pub use crate::{advice, error, make, open, poses, run, wing};
}

/// Telescopes: the curves and skeletons that they are to follow, and the shells that do. Their
/// junctures are cut for a small printer as models are, by [`cut`].
pub mod extend {
    #[doc(inline)]
    pub use crate::{curve, skeleton, telescope};
}

/// Objects larger than the printer: the polyhedra of a laser-cut base, their panels, and the
/// printed parts around them. With them come the machines, sheets and fasteners.
pub mod large {
    #[doc(inline)]
    pub use crate::{cladding, core_kit, cutter, cutting, panels, polyhedra};
}

/// Checklists, job sheets, drawings and coupons.
pub mod report {
    #[doc(inline)]
    pub use crate::{coupon, draw, page, press, quote, sheet, slicer};
}

// The rooms of the six groups, and the command line, which is no library.
#[doc(hidden)]
pub mod advice;
#[doc(hidden)]
pub mod ballast;
#[doc(hidden)]
pub mod cells;
#[doc(hidden)]
pub mod cladding;
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod cli;
#[doc(hidden)]
pub mod comb;
#[doc(hidden)]
pub mod core_kit;
#[doc(hidden)]
pub mod coupon;
#[doc(hidden)]
pub mod curve;
#[doc(hidden)]
pub mod cutter;
#[doc(hidden)]
pub mod cutting;
#[doc(hidden)]
pub mod draw;
#[doc(hidden)]
pub mod error;
#[doc(hidden)]
pub mod field;
#[doc(hidden)]
pub mod geom;
#[doc(hidden)]
pub mod goal;
#[doc(hidden)]
pub mod hardware;
#[doc(hidden)]
pub mod hollow;
#[doc(hidden)]
pub mod interior;
#[doc(hidden)]
pub mod io;
#[doc(hidden)]
pub mod make;
#[doc(hidden)]
pub mod mass;
#[doc(hidden)]
pub mod mend;
#[doc(hidden)]
pub mod mesh;
#[doc(hidden)]
pub mod open;
#[doc(hidden)]
pub mod page;
#[doc(hidden)]
pub mod panels;
#[doc(hidden)]
pub mod polyhedra;
#[doc(hidden)]
pub mod poses;
#[doc(hidden)]
pub mod press;
#[doc(hidden)]
pub mod quote;
#[doc(hidden)]
pub mod raster;
#[doc(hidden)]
pub mod repair;
#[doc(hidden)]
pub mod run;
#[doc(hidden)]
pub mod sheet;
#[doc(hidden)]
pub mod shell;
#[doc(hidden)]
pub mod skeleton;
#[doc(hidden)]
pub mod slice;
#[doc(hidden)]
pub mod slicer;
#[doc(hidden)]
pub mod telescope;
#[cfg(test)]
pub(crate) mod testing;
#[doc(hidden)]
pub mod tets;
#[doc(hidden)]
pub mod thin;
#[doc(hidden)]
pub mod voids;
#[doc(hidden)]
pub mod wing;
