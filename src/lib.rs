//! Equipoise hollows a 3D model so that its printed, glued parts spin, stand, float or run true as
//! asked.
//!
//! A mesh, a printer and a goal go in; a kit comes out: parts that can be printed, cleaned and
//! glued, and a job sheet that says what to do and what to measure. The void is provably the best
//! there is: whatever the goal, the optimal void is the region that may be emptied, cut by one
//! quadric ([`guide::theory`]), and every solution carries its certificate.
//!
//! # The way through
//! [`io`] reads, [`mesh`] checks and repairs, [`goal`] places the aim, [`printer`] gives wall,
//! pitch and material, [`shell`] keeps the wall, [`interior`] holds what may be emptied as exact
//! columns, [`hollow`] solves, [`advice`] says what helps where that is impossible, [`voids`] draws
//! the surfaces, [`cut`] opens and pins the parts, [`verify`] judges what is written without
//! knowing how it was made, [`sheet`] and [`page`] put the job sheet together, [`kit`] writes it;
//! [`coupon`] lets a shop measure what its printer does; [`prepare::prepare`] is that line.
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
