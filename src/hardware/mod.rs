//! Hardware in its place: bored sockets, a yo-yo's halves moved apart, and the masses of the rods.
//!
//! A run with hardware solves for the solid that this room makes of the model. A socket then counts
//! as outside, and keeps a wall around it. The hardware adds constant moments
//! ([`Fitted::moments`]).
//!
//! # A yo-yo's halves
//! The model is cut across the axis through the spin point, and each half is moved by half the
//! string gap. Seen from the spin point, a grain of the upper half at (x, y, z) then counts as (x,
//! y, z + gap/2). The extreme interior along g (`hollow`) is therefore
//!
//! ```text
//! { q(x, y, z + gap/2) > 0 } of the upper half,
//! { q(x, y, z − gap/2) > 0 } of the lower half,    q = g·m
//! ```
//!
//! It is one quadric with the ten coefficients g in the moved halves. In the model it is two
//! quadrics with the same multipliers: q with its z shifted. Only the set of reachable moments
//! changes; the programmes and their proofs stay. So the halves are moved first, and every later
//! step works on the moved halves. Each half is closed towards the gap by a wall of its own, so
//! that the string runs between two faces.
//!
//! Moving halves of mass m/2 apart by a gap g adds m (c g + g²/4) to both moments across the axis.
//! Here c is the distance of a half's centre from the cut. The gap adds nothing to the moment about
//! the axis, so it costs dominance.

mod bore;
mod error;
mod fitted;
mod halves;
#[cfg(test)]
mod tests;
mod top;
mod workshop;
mod yoyo;

use crate::goal::{Goal, Hardware};
use crate::mesh::Solid;

pub use bore::SeatError;
pub use error::FitError;
pub use fitted::{Fitted, Kind, Piece};
pub use workshop::Allowances;

use workshop::Workshop;

/// Bores the sockets, moves the halves apart and puts the hardware in place. Returns `None` if
/// there is no hardware.
///
/// The rods lie along the goal's axis. Costs some booleans: about a second for 100 000 triangles.
pub fn fit_hardware(
    solid: &Solid,
    goal: &Goal,
    hardware: &Hardware,
    allowances: &Allowances,
) -> Result<Option<Fitted>, FitError> {
    let workshop = Workshop {
        solid,
        goal,
        allowances,
    };
    match (hardware.axle, hardware.string_gap) {
        (Some(axle), Some(gap)) => {
            yoyo::fit(&workshop, axle, gap.mm(), hardware.mass_g.unwrap_or(0.0)).map(Some)
        }
        _ if hardware.is_empty() => Ok(None),
        _ => top::fit(&workshop, hardware.tip, hardware.stem).map(Some),
    }
}
