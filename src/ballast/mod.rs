//! Ballast: stock parts of steel in pockets of their own, where hollowing alone is not enough.
//!
//! [`catalogue`] is what a shop has at hand, [`Order`] what a user asks for, [`Search`] finds where
//! the parts act most, and [`Load`] is what was decided: parts of declared mass at declared places,
//! each in a pocket with a wall around it.
//!
//! # How the places are found
//! A part of mass m at x adds (m/ρ) φ(x) to the ten moments, φ = (1, x, y, z, …), and takes its
//! pocket away from them. With the dual's quadric g of the interior at hand (for an impossible goal
//! the one that proves it), the value changes to first order by g·(the part − its pocket): the site
//! where that is least acts most. One part is placed so, the interior is solved again with it,
//! which gives the next quadric, and so on; then each part in turn is taken out and placed anew.
//!
//! # What is proved, and what is not
//! With the parts at their places, the interior around them is the best there is, with the same
//! certificate as without them. That no fewer or lighter parts do is proved only as far as
//! [`crate::hollow::least_ballast`] goes: its bound on the mass of steel holds for steel of any
//! shape anywhere inside, so fewer parts than reach that mass are never tried. Which of the sites
//! are best is a search by descent, not a proof: other places may give a better value.

mod error;
mod load;
mod order;
mod pocket;
mod rank;
mod search;
mod sites;
mod stock;

pub use error::{BallastError, StockFault};
pub use load::{Load, Placed};
pub use order::{MOST_PARTS, Order};
pub use pocket::{Fit, Pocket};
pub use search::{Found, Search, Shop};
pub use stock::{Part, Provenance, catalogue, find};
