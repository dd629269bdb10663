//! Ballast: laid in if it is ordered, or if hollowing alone is not enough.

use super::outcome::Impossible;
use super::solve::{Answer, with_load};
use crate::ballast::{Fit, Load, Search, Shop};
use crate::base::verdict::Verdict;
use crate::base::watch::{Phase, Watch};
use crate::error::Error;
use crate::run::Placed;

/// Solves with the ballast that the job orders.
///
/// If no places for it are found, the answer is the one without ballast (`known`, or solved now)
/// and says what was tried.
pub fn laid_in(placed: &Placed, known: Option<Impossible>, watch: &Watch) -> Result<Answer, Error> {
    watch.enter(Phase::Ballast);
    let order = &placed.job.ballast;
    let found = Search::new(shop(placed))?.of_order(order)?;
    watch.check()?;
    if let Some(found) = found {
        return with_load(placed, found.load, watch);
    }
    let answer = match known {
        Some(impossible) => Verdict::No(impossible),
        None => with_load(placed, Load::default(), watch)?,
    };
    match answer {
        Verdict::No(mut impossible) => {
            let refused = format!("no places for the ballast {order} make it possible");
            impossible.warnings.push(refused);
            Ok(Verdict::No(impossible))
        }
        Verdict::Found(_) => Err(Error::NoRoomForBallast {
            order: order.clone(),
        }),
    }
}

fn shop(placed: &Placed) -> Shop<'_> {
    let printer = &placed.shop.printer;
    Shop {
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
