//! The kit's paperwork: the checklist as data, as a page and as pictures, and the folder it is written to.

mod album;
mod base64;
mod checklist;
mod grid;
mod hardware;
mod joinery;
mod kit;
mod page;
mod picture;
mod rows;
#[cfg(test)]
mod sample;
mod steps;
#[cfg(test)]
mod tests;
mod timing;
mod words;

pub use album::{Picture, Sitting, album, part_picture_file};
pub use checklist::{
    Certificate, Checklist, ChecklistError, GoalRow, HeightProof, LogRow, MaterialRow, ModelRow, PrinterRow,
    Tool, Verdict, WallRow,
};
pub use grid::GridRow;
pub use joinery::{BossRow, CutListRow, RoundRow};
pub use kit::{COUPON_FILE, Existing, Kit, KitError};
pub use page::{document, page};
pub use picture::{Camera, Color, Image, Item, PictureError, Scene, render};
pub use rows::{BallastRow, CutRow, JointRow, PartRow, VoidRow};
pub use timing::Timing;
