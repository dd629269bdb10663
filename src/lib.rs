//! Equipoise hollows a 3D model so that its printed, glued parts spin, stand, float or run true as
//! asked.
//!
//! A mesh, a printer and a goal go in, and a kit comes out. It holds parts that can be printed,
//! cleaned and glued, and a job sheet that says what to do and what to measure. The void is
//! provably the best there is: for every goal it is what may be emptied, cut by one quadric
//! ([`guide::theory`]). Every solution carries its certificate.
//!
//! # The line
//! [`prepare::prepare`] runs a [`job::Job`] to its end. Its stages and the rooms that do the work:
//!
//! | stage | rooms |
//! | --- | --- |
//! | load | [`io`] reads, [`repair`] mends, [`mesh`] proves a solid, [`printer`] gives wall and pitch |
//! | place | [`goal`] places the aim, [`hardware`] bores sockets, [`advice`] chooses an open axis |
//! | solve | [`shell`] keeps the wall, [`interior`] measures columns, [`hollow`] solves, [`ballast`] adds mass |
//! | open | [`voids`] draws the surfaces, [`cut`] plans cuts and pins, [`open`] resolves both |
//! | make | [`make`] writes the parts and corrects them |
//! | judge | [`verify`] judges the files without knowing how they were made |
//! | kit | [`sheet`] and [`page`] make the job sheet with [`draw`], [`kit`] writes the folder |
//!
//! [`run`] holds the facts that pass from stage to stage, [`base`] units and the watch over a run.
//! [`coupon`] lets a shop measure what its printer does.
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

pub mod advice;
pub mod ballast;
pub mod base;
#[cfg(feature = "cli")]
pub mod cli;
pub mod coupon;
pub mod cut;
pub mod draw;
pub mod error;
pub mod geom;
pub mod goal;
pub mod guide;
pub mod hardware;
pub mod hollow;
pub mod interior;
pub mod io;
pub mod job;
pub mod kit;
pub mod make;
pub mod mass;
pub mod mesh;
pub mod open;
pub mod page;
pub mod prepare;
pub mod printer;
pub mod repair;
pub mod run;
pub mod sheet;
pub mod shell;
#[cfg(test)]
pub(crate) mod testing;
pub mod verify;
pub mod voids;
