//! The kit's paperwork: the checklist as data, as a page and as pictures, and the folder it is written to.

mod checklist;
mod kit;
mod picture;
mod rows;
mod timing;

pub use checklist::{
    Certificate, Checklist, ChecklistError, GoalRow, LogRow, MaterialRow, ModelRow, PrinterRow, Tool,
    Verdict, WallRow,
};
pub use kit::{Existing, Kit, KitError};
pub use picture::{Camera, Color, Image, Item, PictureError, Scene, render};
pub use rows::{CutRow, JointRow, PartRow, PegRow, VoidRow};
pub use timing::Timing;
