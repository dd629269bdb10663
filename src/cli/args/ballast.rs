//! The arguments for ballast and fillings.

use clap::Args;

use crate::ballast::Order;
use crate::job::Filling;

/// The arguments for material that makes a print heavier somewhere.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Method")]
pub struct BallastArgs {
    /// Add steel parts as ballast: auto, none, or a part such as ball-4 [default: none]
    ///
    /// Auto lays in the fewest balls if hollowing alone is not enough. A part may have its number,
    /// such as nut-m5x2 or coin-euro-1-cent.
    #[arg(long, value_name = "auto|ID[xN]|none")]
    pub ballast: Option<Order>,
    /// Fill the voids with a material of this density, such as 2.3 for plaster, instead of air
    #[arg(
        long,
        value_name = "G/CM3",
        allow_hyphen_values = true,
        conflicts_with = "ballast"
    )]
    pub fill: Option<Filling>,
}
