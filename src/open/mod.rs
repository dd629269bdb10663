//! Open: the voids of a solution, the cuts and pins that open them, and what stays solid for both.
//!
//! [`climb`] tries the rungs of a ladder until every joint has its pins. Each rung draws voids
//! ([`Resolver`]), plans cuts and keeps solid what cannot be cleaned or drained. Then it looks for
//! room for pins in bosses. Whatever is kept solid is solved for again, so that the rest stays
//! optimal.

mod aligned;
mod bosses;
mod budget;
mod build;
mod clean;
mod defect;
mod drain;
mod drained;
mod draw;
mod failed;
mod field_bodies;
mod ground;
mod ladder;
mod one_piece;
mod plan;
mod plans;
mod proxy;
mod refused;
mod request;
mod resolve;
mod search;
mod settle;
mod tendency;
mod way;

#[cfg(test)]
mod scenes;

pub use defect::shortfall_ratio;
pub use drained::drain_again;
pub use draw::finish;
pub use field_bodies::{Drawing, draw_field};
pub use one_piece::one_piece;
pub use plan::Planner;
pub use plans::{Leaning, climb_by_tendency};
pub use resolve::Resolver;
pub use search::{Candidates, climb};
pub use way::Candidate;
