//! The manual behind the code: [`conventions`], the [`map`] of the code, the [`theory`] of the
//! solver, [`telescopes`], and the [`bibliography`].

pub mod bibliography;
pub mod conventions;
pub mod map;
pub mod telescopes;
pub mod theory;
