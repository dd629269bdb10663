//! Cells of a solid: Voronoi diagrams cut off at its surface, and their relaxation under L∞ or L2.
//!
//! Under L∞ relaxed cells are near cubes, under L2 near round. The walls between them are the
//! density of prints that have no infill (`comb`).
//!
//! * [`Chain`]: the boundary of a region as signed triangles. Planes cut it exactly, and nothing is
//!   triangulated but by fans.
//! * [`Room`]: the solid that cells share, in blocks of which most are full or empty.
//! * [`Polytope`]: the convex cell of a site, cut from a box by the bisectors to near sites.
//! * [`cells`]: the parts of a room within the polytopes of all sites. They add up to the room.
//! * [`random_sites`] and [`poisson_sites`]: first sites, the latter by the wished size of cells.
//! * [`Chebyshev`] and [`Bulk`]: energies, their derivatives, volumes and centres in closed form.
//! * [`relax`]: Lloyd's relaxation, with a Newton search in every cell.
//! * [`Axes`]: turned and stretched cells, by a map of the space in which they are cubes.
//! * [`bodies`]: cells with faces that fit edge to edge, for files and pictures.
//!
//! Source: Bukenberger and Lensch, "Tetrahedra of varying density" (2021), for relaxation under L∞
//! with its six fragments a cell. Lengths are in mm.

mod axes;
mod body;
mod chain;
mod diagram;
mod energy;
mod facets;
mod fan;
mod files;
mod lloyd;
mod near;
mod parts;
mod poisson;
mod polytope;
mod room;
#[cfg(test)]
mod tests;
mod tree;

pub use axes::{Axes, PlacedAxes, nearest_axes};
pub use body::Body;
pub use chain::{Chain, Corners};
pub use diagram::{Cell, MOST_SITES, SitesError, cells, check_sites, random_sites};
pub use energy::{Bulk, Chebyshev, Weight};
pub use files::{CellFigures, StepFigures, encode_obj, encode_sites, encode_steps, encode_vtk};
pub use lloyd::{Norm, Order, Step, relax};
pub use parts::{BodyError, bodies};
pub use poisson::{SizeAt, Sizes, Start, poisson_sites, samples};
pub use polytope::{Beyond, Face, Polytope};
pub use room::Room;
