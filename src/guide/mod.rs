//! The manual behind the code: [`conventions`], the [`map`] of the code, the [`theory`] of the
//! solver, [`telescopes`], [`large_objects`], and the [`bibliography`].

pub mod bibliography;
pub mod conventions;
pub mod large_objects;
pub mod map;
pub mod telescopes;
pub mod theory;
