//! Repair: the rungs that turn a mesh as it was read into one that can be proved solid.

mod ladder;
mod one_body;
mod orient;
mod sew;
mod unfold;
mod unstitch;
mod weld;

pub use ladder::{Repairs, repair};
pub use one_body::{NotOneBody, ShellFact, ShellRole, one_body};
pub(crate) use sew::sewn;
pub use unfold::unfolded;
pub use weld::weld;
