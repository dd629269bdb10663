//! The job sheet as data: the checklist and its rows, key for key as in `checklist.json`.

mod certificate;
mod checklist;
pub mod core_kit;
pub mod from_run;
mod goal;
mod joints;
mod kind;
pub mod network;
mod parts;
pub mod pose;
mod print_time;
mod printer;
mod shortfall;
pub mod telescope;
#[cfg(test)]
mod tests;
mod timing;
mod toolpaths;
mod voids;

pub use certificate::{
    Certificate, CleaningRow, Course, HeightProof, KeptRow, PassRow, SpeedRow, TradeRow,
};
pub use checklist::{
    Checklist, ChecklistError, LogRow, ModelRow, RedrawnRow, ThickenedRow, Tool, Verdict,
};
pub use goal::{FootRow, GoalRow, ObjectiveName, ShaftKind, ShaftRow, TurnRow};
pub use joints::{BallastRow, BossRow, CutListRow, JigRow, JointRow, RoundRow};
pub use kind::KindSheet;
pub use parts::{Half, PartRow, SupportRow, finished_size_mm, part_picture_file};
pub use print_time::{PlateTimeRow, PrintTimeRow};
pub use printer::{
    Direction, GlueRow, GridRow, MaterialRow, PrinterRow, Process, SupportMethod, WallRow,
};
pub use shortfall::{Shortfall, Taken, Taker};
pub use timing::Timing;
pub use toolpaths::{ToolpathPart, ToolpathPlate, ToolpathsRow};
pub(crate) use voids::checks_of_void;
pub use voids::{CutRow, SideRow, VoidRow, is_clean};
