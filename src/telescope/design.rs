//! From a curve to the telescope that opens into it.

use super::error::TelescopeError;
use super::motion::{Collision, Opening, Order};
use super::nest::Telescope;
use super::sizes::JointSizes;
use crate::curve::{Curve, Fit, FitError, FitRequest, Freedom, fit};

/// The prices of misfit at joints that are tried in turn. A dearer misfit makes thinner walls.
const PRICES: [f64; 4] = [0.3, 0.6, 1.2, 2.4];

/// The greatest product of curvature and the root's radius that a fit may use, with room for walls
/// that grow by misfit.
const BEND_RATIO: f64 = 0.75;

/// The greatest bend of a shell that a fit may use, rad: a little less than half a circle, for its
/// length is fitted too.
const MAX_BEND_RAD: f64 = 3.0;

/// What a telescope is to be like.
#[derive(Debug, Clone, PartialEq)]
pub struct Wish {
    /// The numbers of shells to try.
    pub shells: Vec<usize>,
    /// Body radius of the tip, mm.
    pub tip_mm: f64,
    /// The most that the body radius of the root may be, mm; infinite if any will do.
    pub root_mm: f64,
    /// The deviation that is near enough, mm, at equal shares of the length.
    pub within_mm: f64,
    /// The greatest torsion of a shell either way, 1/mm.
    pub max_torsion: f64,
    /// The values that curvature takes.
    pub curvature: Freedom,
    /// The values that torsion takes.
    pub torsion: Freedom,
    /// The order of opening.
    pub order: OrderWish,
    /// The measures of the joints.
    pub sizes: JointSizes,
}

/// The order in which the joints are to open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OrderWish {
    /// Whichever is free, and has the greater gap.
    Free,
    /// From the root to the tip.
    RootFirst,
    /// From the tip to the root.
    TipFirst,
}

/// Body radius of the tip that is wished if nothing else is said, mm.
const TIP_MM: f64 = 4.0;

/// Deviation that is near enough if nothing else is said, mm.
const WITHIN_MM: f64 = 1.0;

/// The greatest torsion that is wished if nothing else is said, 1/mm: a turn in 314 mm.
const MAX_TORSION: f64 = 0.02;

impl Wish {
    /// Wishes for one of these numbers of shells, with all else as usual.
    pub fn new(shells: Vec<usize>, sizes: JointSizes) -> Self {
        Self {
            shells,
            tip_mm: TIP_MM,
            root_mm: f64::INFINITY,
            within_mm: WITHIN_MM,
            max_torsion: MAX_TORSION,
            curvature: Freedom::Each,
            torsion: Freedom::Each,
            order: OrderWish::Free,
            sizes,
        }
    }

    fn open(&self, telescope: &Telescope) -> Result<Opening, Box<Collision>> {
        let joints = telescope.joints.len();
        match self.order {
            OrderWish::Free => telescope.find_opening(),
            OrderWish::RootFirst => telescope.open_in(&Order::root_first(joints)),
            OrderWish::TipFirst => telescope.open_in(&Order::tip_first(joints)),
        }
    }
}

/// A telescope for a curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Design {
    /// The chain of helices and its deviation.
    pub fit: Fit,
    /// The shells.
    pub telescope: Telescope,
    /// A free way to open it.
    pub opening: Opening,
}

/// A number of shells, and what came of it.
#[derive(Debug, Clone, PartialEq)]
pub struct DesignRow {
    /// The number of shells.
    pub shells: usize,
    /// The design, or why there is none.
    pub outcome: Result<Design, DesignError>,
}

/// A reason why a curve gets no telescope of a number of shells.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DesignError {
    /// No chain can be fitted.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// The fitted shells do not nest.
    #[error(transparent)]
    Nest(#[from] TelescopeError),
    /// No order that was tried opens it.
    #[error(transparent)]
    Motion(#[from] Box<Collision>),
}

/// Designs a telescope for each number of shells: the trade of shells against deviation.
pub fn design_table(curve: &Curve, wish: &Wish) -> Vec<DesignRow> {
    let row = |shells: &usize| DesignRow {
        shells: *shells,
        outcome: design(curve, wish, *shells),
    };
    wish.shells.iter().map(row).collect()
}

/// Returns the place in a table of the design to take, if there is one.
///
/// It is the one of fewest shells within the deviation that is wished, else the nearest.
pub fn choose_design(rows: &[DesignRow], within_mm: f64) -> Option<usize> {
    let made = rows.iter().enumerate().filter_map(|(i, row)| {
        let design = row.outcome.as_ref().ok()?;
        let deviation_mm = design.fit.deviation.max_mm;
        let is_far = deviation_mm > within_mm;
        let by = if is_far {
            deviation_mm
        } else {
            row.shells as f64
        };
        Some((i, is_far, by))
    });
    let best = made.min_by(|a, b| a.1.cmp(&b.1).then(a.2.total_cmp(&b.2)));
    best.map(|(i, _, _)| i)
}

/// Designs a telescope of so many shells: fits, nests and opens it.
///
/// Walls grow where neighbours are unlike, and thick walls bend less. So a fit that does not nest
/// is tried again with a dearer misfit. The error is that of the last try.
pub fn design(curve: &Curve, wish: &Wish, shells: usize) -> Result<Design, DesignError> {
    let mut last = None;
    for price in PRICES {
        match attempt(
            curve,
            &with_price(design_request(curve, wish, shells), price),
            wish,
        ) {
            Ok(design) => return Ok(design),
            Err(DesignError::Fit(error)) => return Err(error.into()),
            Err(error) => last = Some(error),
        }
    }
    Err(last.unwrap_or(DesignError::Nest(TelescopeError::Chain {
        pieces: shells,
        turns: 0,
    })))
}

fn attempt(curve: &Curve, request: &FitRequest, wish: &Wish) -> Result<Design, DesignError> {
    wish.sizes.check()?;
    let fit = fit(curve, request)?;
    let telescope = Telescope::nest(&fit.chain, wish.tip_mm, &wish.sizes)?;
    let root_mm = telescope.shells[0].body_mm;
    if root_mm > wish.root_mm {
        let most_mm = wish.root_mm;
        return Err(TelescopeError::RootTooThick { root_mm, most_mm }.into());
    }
    let opening = wish.open(&telescope)?;
    Ok(Design {
        fit,
        telescope,
        opening,
    })
}

fn with_price(request: FitRequest, nesting_price: f64) -> FitRequest {
    FitRequest {
        nesting_price,
        ..request
    }
}

/// Asks for shells whose bodies grow by a pitch each.
pub fn design_request(curve: &Curve, wish: &Wish, shells: usize) -> FitRequest {
    let body = |i: usize| wish.tip_mm + wish.sizes.pitch_mm() * i as f64;
    let root_mm = body(shells.saturating_sub(1));
    let by_turn = MAX_BEND_RAD * shells as f64 / curve.length_mm();
    FitRequest {
        curvature: wish.curvature,
        torsion: wish.torsion,
        turn_bound: Some(wish.sizes.turn_bound()),
        body_mm: (0..shells).rev().map(body).collect(),
        ..FitRequest::new(shells, by_turn.min(BEND_RATIO / root_mm), wish.max_torsion)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::NamedCurve;
    use crate::telescope::tests::sizes;

    fn wish(shells: Vec<usize>) -> Wish {
        Wish::new(shells, sizes())
    }

    fn named(text: &str) -> Curve {
        let curve: NamedCurve = text.parse().unwrap();
        Curve::of_polyline(curve.points()).unwrap()
    }

    #[test]
    fn an_arc_becomes_a_telescope_that_opens_into_it() {
        let curve = named("arc:100,120");
        let design = design(&curve, &wish(vec![]), 5).unwrap();
        assert!(
            design.fit.deviation.max_mm < 0.01,
            "{:?}",
            design.fit.deviation
        );
        let telescope = &design.telescope;
        let tip = telescope.frames(&telescope.open())[4];
        let end = tip.to_model(
            &telescope.shells[4]
                .helix
                .frame_at(telescope.visible_mm)
                .origin,
        );
        assert!((end - curve.at(curve.length_mm())).norm() < 0.01);
        assert!(telescope.shells[0].body_mm < 4.0 + 4.0 * sizes().pitch_mm() + 0.1);
    }

    #[test]
    fn the_table_tells_which_numbers_do_and_the_fewest_near_enough_is_taken() {
        let curve = named("helix:60,80,1");
        let wish = wish(vec![1, 4, 6]);
        let rows = design_table(&curve, &wish);
        // One shell may turn by half a circle only, which is far off.
        let alone = rows[0].outcome.as_ref().unwrap();
        assert!(alone.fit.deviation.max_mm > 10.0);
        assert_eq!(choose_design(&rows, wish.within_mm), Some(1));
        assert_eq!(choose_design(&rows[..1], wish.within_mm), Some(0));
        assert_eq!(choose_design(&[], wish.within_mm), None);
    }
}
