//! The voids of a model.
//!
//! The cavity is the region that the wall leaves; it is drawn once. The voids are the parts that a
//! quadric cuts out of the cavity, and are made again for each quadric.

// The public types.
mod cavity;
mod error;
mod for_printer;
mod grow;
mod split;

// The functions that are drawn: their samples, and one file for each.
mod density_field;
mod field;
mod quadric_field;
mod wall_field;

// Drawing a function's positive region: octree, lattice, marching tetrahedra.
mod extract;
mod lattice;
mod march;
mod nodes;
mod octree;
mod roots;
mod runs;
mod table;

// Fewer triangles, checked for self-intersection.
mod coarsen;
mod crossing;
mod decimate;
mod simplify;

// The two surfaces, and the test for voids that are too small.
mod inscribed;
mod offset;
mod region;

// A new surface for broken ones.
mod remesh;
mod soup_field;

#[cfg(test)]
mod shapes;
#[cfg(test)]
mod tests;

pub use cavity::{Cavity, without_slivers};
pub use coarsen::coarsen;
pub use density_field::DensityLevel;
pub use error::VoidError;
pub use grow::grow_bodies;
pub use offset::CavitySpec;
pub use region::{Drawn, draw_below};
pub use remesh::{Missing, Soup};
pub use split::Voids;
