//! The facts of a run, stage by stage: each type holds what its stage has established.
//!
//! | stage | type | holds |
//! | --- | --- | --- |
//! | load | [`Model`], [`Shop`] | a closed solid in mm; a printer, its material and a wall that it can print |
//! | place | [`Placed`] | the goal in the model, with waterline and hardware |
//! | solve | [`Solved`] | the optimal void on the printer's columns, and the ballast beside it |
//! | open | [`Opened`] | the voids, and the cuts and pins that open them |
//! | make | [`Made`] | the parts as they are written and read back |
//!
//! Searches are elsewhere: this room holds types, verdicts and the [`Policy`] of the searches.

mod brief;
mod glue;
mod laid_field;
mod made;
mod natural;
mod nested;
mod opened;
mod policy;
mod remark;
mod solved;
mod tendency;

pub use brief::{Inside, Model, Placed, Shop};
pub use laid_field::LaidField;
pub use made::{Made, WrittenJig, WrittenPart, WrittenRegion, WrittenSparse};
pub use natural::{NaturalUp, short_reason};
pub use nested::{Extent, Level, Nested};
pub use opened::{
    Achieved, BossRound, CleaningRound, DrawnCells, KeptBoss, KeptSolid, Opened, Voids,
};
pub use policy::{Policy, Rung};
pub use remark::{AxisChoice, FewerFault, KeptCause, Refusal, Remark, Untried};
pub use solved::{HeightProof, Solved};
pub use tendency::Tendency;
