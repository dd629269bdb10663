//! Mass properties: the ten moments that add, and the body they describe.

mod bar;
mod body;
mod film;
mod lump;
mod moments;
mod of_mesh;
mod submerged;
#[cfg(test)]
mod tests;

pub use bar::RoundBar;
pub use body::{Body, Principal};
pub use film::FlatFace;
pub(crate) use lump::rims;
pub use lump::{Lump, LumpShape};
pub use moments::Moments;
pub use of_mesh::moments_of_mesh;
pub use submerged::{Section, Submerged, submerged};
