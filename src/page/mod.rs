//! The job sheet as a page for people, with its pictures.

mod album;
mod apart;
mod cleaning;
mod cover;
mod curves;
mod cut_drawing;
mod document;
mod fields;
mod figure;
mod gluing;
mod grid;
mod hardware;
mod inertia;
mod inputs;
mod inserts;
mod job_id;
mod job_sheet;
mod parts_table;
mod plate;
mod printing;
mod proof;
mod running;
mod steps;
mod subject;
mod support;
#[cfg(test)]
mod tests;
mod trials;
mod view;
mod viewpoint;
mod weighing;
mod words;

pub use album::{draw_figures, render_pictures};
pub use cut_drawing::{CutFace, Mouth, Region};
pub use document::document;
pub use figure::{Picture, Role};
pub use inputs::PageInputs;
pub use job_id::JobId;
pub use job_sheet::page;

pub use printing::cup_warning;
pub use subject::Subject;
pub use view::View;
pub use words::{promise, spins_on};
