//! The kit's paperwork: the checklist as data, as a page and as pictures, and the folder it is
//! written to.

mod album;
mod apart;
mod base64;
mod checklist;
mod cleaning;
mod course;
mod cover;
mod cut_drawing;
mod drawings;
mod figure;
mod finished;
mod gluing;
mod grid;
mod halves;
mod hardware;
mod hatch;
mod inertia;
mod inserts;
mod joinery;
mod kit;
mod page;
mod palette;
mod parts_table;
mod picture;
mod plate;
mod plot;
mod printing;
mod projection;
mod proof;
mod qr;
mod rows;
mod running;
#[cfg(test)]
mod sample;
mod seen;
mod steps;
mod support;
mod svg;
#[cfg(test)]
mod tests;
mod timing;
mod trials;
mod view;
mod weighing;
mod words;

pub use album::{Sitting, album, part_picture_file};
pub use checklist::{
    Certificate, Checklist, ChecklistError, GoalRow, HeightProof, LogRow, MaterialRow, ModelRow,
    PrinterRow, Tool, Verdict, WallRow,
};
pub use cleaning::{CleaningRow, KeptRow, is_clean};
pub use course::{Course, PassRow, SpeedRow};
pub use cut_drawing::{CutFace, Mouth, Region};
pub use drawings::drawings;
pub use figure::{Drawn, Picture, Role};
pub use finished::{TurnRow, cup_warning, finished_size_mm};
pub use grid::GridRow;
pub use joinery::{BossRow, CutListRow, RoundRow};
pub use kit::{COUPON_FILE, Existing, Kit, KitError};
pub use page::{Papers, document, page};
pub use palette::part_color;
pub use picture::{Camera, Color, Image, Item, PictureError, Scene, render};
pub use projection::Projection;
pub use qr::JobId;
pub use rows::{BallastRow, CutRow, JointRow, PartRow, SideRow, VoidRow};
pub use support::SupportRow;
pub use svg::{Anchor, Drawing, Spot, Stroke};
pub use timing::Timing;
pub use trials::FootRow;
pub use view::View;
pub use words::{promise, quantity};
