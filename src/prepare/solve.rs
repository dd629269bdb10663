//! Solve: the best void, with ballast if it is ordered or if hollowing alone is not enough.

use super::levels::{Answer, with_load};
use super::outcome::Impossible;
use crate::ballast::{Fit, Load, Order, Search, Workshop};
use crate::base::setting::{Key, Setting};
use crate::base::verdict::Verdict;
use crate::base::watch::{Phase, Watch};
use crate::error::Error;
use crate::run::{Placed, Solved};

/// Solves for the best void, with the ballast that the job orders or needs.
pub fn best(placed: &Placed, watch: &Watch) -> Result<Answer, Error> {
    match placed.job.ballast {
        Order::None => with_load(placed, Load::default(), watch),
        Order::Parts { .. } => with_ballast(placed, None, watch),
        Order::Auto => match with_load(placed, Load::default(), watch)? {
            Verdict::No(impossible) => with_ballast(placed, Some(impossible), watch),
            found => Ok(found),
        },
    }
}

/// Solves with the ballast that the job orders.
///
/// If no places for it are found, the answer is the one without ballast (`known`, or solved now)
/// and says what was tried.
fn with_ballast(
    placed: &Placed,
    known: Option<Impossible>,
    watch: &Watch,
) -> Result<Answer, Error> {
    watch.enter(Phase::Ballast);
    let order = &placed.job.ballast;
    let found = Search::new(workshop(placed), watch)?.of_order(order)?;
    if let Some(found) = found {
        return with_load(placed, found.load, watch);
    }
    let answer = match known {
        Some(impossible) => Verdict::No(impossible),
        None => with_load(placed, Load::default(), watch)?,
    };
    match answer {
        Verdict::No(mut impossible) => {
            let ballast = Setting::new(Key::Ballast, order);
            let refused = format!("no places were found for `{ballast}` that make it possible");
            impossible.warnings.push(refused);
            Ok(Verdict::No(impossible))
        }
        Verdict::Found(_) => Err(Error::NoRoomForBallast {
            order: order.clone(),
        }),
    }
}

/// Solves with more steel balls than some number, as few as do; `None` if they find no places.
pub fn with_more_balls(
    placed: &Placed,
    than: usize,
    watch: &Watch,
) -> Result<Option<Solved>, Error> {
    watch.enter(Phase::Ballast);
    let than = u32::try_from(than).unwrap_or(u32::MAX);
    let found = Search::new(workshop(placed), watch)?.of_more_balls(than)?;
    let Some(found) = found else { return Ok(None) };
    Ok(match with_load(placed, found.load, watch)? {
        Verdict::Found(solved) => Some(solved),
        Verdict::No(_) => None,
    })
}

/// Returns the model of a run as one in which ballast is searched.
pub fn workshop(placed: &Placed) -> Workshop<'_> {
    let printer = &placed.shop.printer;
    Workshop {
        solid: placed.solid(),
        placement: &placed.placement,
        wall_mm: placed.shop.wall.wall_mm,
        fit: Fit {
            clearance_mm: printer.clearance_per_side_mm.value,
            web_mm: printer.min_wall_mm.value,
        },
        density_g_cm3: placed.density_g_cm3(),
    }
}
