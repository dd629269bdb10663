//! The manual behind the code: [`conventions`], the [`map`] of the code, the [`theory`] of the
//! solver, and the [`bibliography`].

pub mod bibliography;
pub mod conventions;
pub mod map;
pub mod theory;
