//! Densities that vary in space, and the exact mass properties of solids that have them.
//!
//! A density is the printed mass over the solid mass at a place, from 0 to 1. A [`Density`] gives
//! its value anywhere, bounds over a box, and the [`Form`] in which it is integrated. That names
//! its kinks: a density that is a polynomial between planes is integrated exactly.
//!
//! | file | density | kinks | integral |
//! |---|---|---|---|
//! | `uniform`, `linear`, `polynomial` | a polynomial | none | exact |
//! | `ramp` | linear between two planes, constant beyond | both planes | exact |
//! | `sine` | a wave of the distance to a point | the point | closed form along rays, 1e-9 |
//! | `levels` | constant between nested quadrics | the quadrics | closed form along rays |
//! | `clamped` | a quadratic, clamped | two quadrics | closed form along rays |
//! | `skin` | a function of the depth below the surface | the medial axis | cells, halved |
//! | `sum`, `product` | of others | those of the parts | by parts, exact where it can be |
//!
//! [`measure()`] integrates and says the error it reached. [`check`] finds a place where a density
//! is none. [`Order`] reads a density from a few words or from a file.
//!
//! Ramp and sine are those of Bukenberger and Lensch, "Tetrahedra of Varying Density and Their
//! Applications", The Visual Computer 37, 2021, §4. Levels and clamped quadrics are what the solver
//! in [`crate::hollow`] finds.

mod density;
mod range;

mod cells;
mod clamped;
mod levels;
mod linear;
mod polynomial;
mod product;
mod ramp;
mod sine;
mod skin;
mod sum;
mod uniform;

mod check;
mod file;
mod measure;
mod order;
mod words;

pub use check::{NotADensity, check};
pub use clamped::Clamped;
pub use density::{AlongRays, Density, Form, OfDepth};
pub use file::{FileError, is_file_name, read_file, read_text, text_of};
pub use levels::{Levels, LevelsError};
pub use linear::Linear;
pub use measure::{Measured, measure};
pub use order::{Order, SkinOrder};
pub use polynomial::{Polynomial, PolynomialError, Term};
pub use product::Product;
pub use ramp::Ramp;
pub use range::{DensityRange, RangeError};
pub use sine::Sine;
pub use skin::{Profile, Skin};
pub use sum::Sum;
pub use uniform::Uniform;
pub use words::WordsError;
