//! Ballast: stock parts of steel in pockets of their own, for goals that hollowing alone does not
//! meet.
//!
//! [`catalogue`] lists the stock parts, [`Order`] is the user's request, and [`Search`] finds the
//! places where parts act most. [`Load`] is the result: parts of declared mass at declared places,
//! each in a pocket with a wall around it.
//!
//! # How the places are found
//! A part of mass m at x adds (m/ρ) φ(x) to the ten moments, and its pocket is subtracted from
//! them. Here φ = (1, x, y, z, …). Let g be the dual's quadric of the current interior; for an
//! impossible goal it is the one that proves it. To first order the value changes by g·(the part −
//! its pocket), so the part acts most at the site where that is least. One part is placed there,
//! and the interior is solved again with it, which gives the next quadric. In the end each part in
//! turn is taken out and placed again.
//!
//! # What is proved, and what is not
//! With the parts at their places, the interior around them is optimal, with the same certificate
//! as without them. [`crate::hollow::least_ballast`] bounds the mass of steel from below, for steel
//! of any shape anywhere inside. So fewer parts than reach that mass are never tried. More is not
//! proved: the sites are found by descent, and other places may give a better value.

mod error;
mod load;
mod order;
mod pocket;
mod rank;
mod search;
mod sites;
mod stock;

pub use error::{BallastError, StockFault};
pub use load::{Load, PlacedPart};
pub use order::{MOST_PARTS, Order};
pub use pocket::{Fit, Pocket};
pub use search::{Found, Search, Workshop};
pub use stock::{Part, Provenance, catalogue, find};
