//! The fields of a paper, fitted to a goal: a ramp, and a wave of the distance to a point.
//!
//! Both have four numbers: a ramp its slope and its place, a wave its centre and its number. So a
//! goal with four equations has at best a few such fields. They are found by Levenberg's and
//! Marquardt's method from many starts, with the derivatives ∂s/∂θ = ∫ ∂d/∂θ m dV.
//!
//! They are printed in steps: nested regions of one density each, between level sets of one
//! quadric. They have other moments than the smooth field. So the last fit is of the steps.
//!
//! Source: Bukenberger, Lensch, "Tetrahedra of varying density and their applications", The Visual
//! Computer 37, 2021. They search by Powell's method, without derivatives. K. Levenberg, "A method
//! for the solution of certain non-linear problems in least squares", Quarterly of Applied
//! Mathematics 2, 1944. D. Marquardt, "An algorithm for least-squares estimation of nonlinear
//! parameters", J. SIAM 11, 1963.

mod descent;
mod fits;
mod regions;
mod shape;
mod smooth;
mod starts;
mod state;
mod task;

pub use fits::{SmoothFit, fit_smooth};
pub use regions::Region;
pub(super) use regions::{is_cut, regions};
pub use shape::{Family, Shape};
pub(super) use starts::{compare, cost, fit_steps};
pub(super) use state::{Rows, stepped};
pub(super) use task::Task;
