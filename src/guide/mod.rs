//! The manual behind the code: [`conventions`], the [`map`] of the code, the [`theory`] of the
//! solver, [`telescopes`], [`large_objects`], [`cells`], and the [`bibliography`].

pub mod bibliography;
pub mod cells;
pub mod conventions;
pub mod large_objects;
pub mod map;
pub mod telescopes;
pub mod theory;
