//! Fewer triangles within a tolerance.
//!
//! Vertices are merged into neighbours as long as every vertex ever removed stays near the
//! triangles that replaced it. The error is global, not per step, as each triangle keeps the
//! removed vertices that it stands for. (Ciampalini, Cignoni, Montani & Scopigno, "Multiresolution
//! decimation based on global error", The Visual Computer 13, 1997.)

mod collapse;
mod parts;
mod patch;
mod rounds;
mod rules;

pub use rounds::Decimation;
pub use rules::{Rules, Stray};
