//! The arguments for ballast and fillings.

use clap::Args;

use crate::ballast::Order;
use crate::job::Filling;

/// The arguments for material that makes a print heavier somewhere.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Method")]
pub struct BallastArgs {
    /// Lay stock parts into pockets: none, auto (the fewest steel balls, if hollowing alone is not
    /// enough), or a part and its number. Parts are such as ball-4, nut-m5x2 or coin-euro-1-cent
    /// [default: none]
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
