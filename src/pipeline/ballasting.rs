//! Ballast in a run: laid in where it was ordered, or where hollowing alone is not enough.

use super::{Error, Impossible, Setup, Solved, phase, stopwatch::Stopwatch};
use crate::ballast::{Fit, Load, Order, Search, Shop};
use crate::base::watch::Watch;
use crate::cut::Seat;

/// A setup, and what is solved on it; or why it cannot be.
pub type Answer = Result<Solved, Impossible>;

/// The answer without ballast, or with that which the job orders; the setup then carries it.
pub fn solved(
    setup: Setup,
    progress: &Watch,
    watch: &mut Stopwatch,
) -> Result<(Setup, Answer), Error> {
    match setup.job.ballast {
        Order::None => without(setup, progress, watch),
        Order::Auto => match without(setup, progress, watch)? {
            (setup, Err(impossible)) => loaded(setup, Some(impossible), progress, watch),
            possible => Ok(possible),
        },
        Order::Parts { .. } => loaded(setup, None, progress, watch),
    }
}

fn without(
    setup: Setup,
    progress: &Watch,
    watch: &mut Stopwatch,
) -> Result<(Setup, Answer), Error> {
    let answer = Solved::of(&setup, progress, watch)?;
    Ok((setup, answer))
}

/// The answer with the ballast ordered; where none is found, the one without, and what was tried.
fn loaded(
    setup: Setup,
    known: Option<Impossible>,
    progress: &Watch,
    watch: &mut Stopwatch,
) -> Result<(Setup, Answer), Error> {
    progress.report(phase::SOLVE, 0.0);
    let found = Search::new(shop(&setup))?.of_order(&setup.job.ballast)?;
    watch.lap("ballast");
    if let Some(found) = found {
        return without(
            Setup {
                load: found.load,
                ..setup
            },
            progress,
            watch,
        );
    }
    let refused = format!(
        "no places were found for --ballast={} that make it possible",
        setup.job.ballast
    );
    let (setup, answer) = match known {
        Some(impossible) => (setup, Err(impossible)),
        None => without(setup, progress, watch)?,
    };
    match answer {
        Err(mut impossible) => {
            impossible.warnings.push(refused);
            Ok((setup, Err(impossible)))
        }
        Ok(_) => Err(Error::NoRoomForBallast {
            order: setup.job.ballast,
        }),
    }
}

fn shop(setup: &Setup) -> Shop<'_> {
    Shop {
        solid: &setup.model.solid,
        placement: &setup.placement,
        wall_mm: setup.wall.wall_mm,
        fit: Fit {
            clearance_mm: setup.printer.clearance_per_side_mm.value,
            web_mm: setup.printer.min_wall_mm.value,
        },
        density_g_cm3: setup.material.density_g_cm3.value,
    }
}

/// What the cuts must let into the pockets, in their order.
pub fn seats(load: &Load) -> Vec<Seat> {
    let seat = |(placed, pocket): (&crate::ballast::Placed, crate::ballast::Pocket)| Seat {
        center: pocket.center,
        axis: pocket.half_height_mm.map(|half| (pocket.axis, half)),
        radius_mm: pocket.radius_mm,
        opening_mm: 2.0 * placed.lump.shape.radius_mm(),
    };
    load.parts.iter().zip(load.pockets()).map(seat).collect()
}
