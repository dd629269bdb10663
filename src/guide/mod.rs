//! The manual behind the code: [`conventions`], the [`theory`] of the solver, and the
//! [`bibliography`].

pub mod bibliography;
pub mod conventions;
pub mod theory;
