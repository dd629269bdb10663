//! The checklist and the judge's promise, filled from the facts of a run.

mod certificate;
mod checklist;
mod facts;
mod figures;
mod finished;
mod foot;
mod grid;
mod hardware;
mod joints;
mod parts;
mod printer;
mod promise;
mod remarks;
mod support;
mod toolpaths;
mod voids;

pub use checklist::checklist;
pub use facts::Facts;
pub use figures::promised_figure;
pub use joints::pin_warning;
pub use printer::{material_row, printer_row};
pub use promise::{mark, pin, promise, socket};
