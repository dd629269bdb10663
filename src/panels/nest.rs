//! Nesting: where panels lie on sheets, so that few sheets are cut.
//!
//! Panels are convex but for some per cent of their area, so their convex hulls are laid out. For
//! two hulls the places that touch are a convex polygon, their no-fit polygon. It is the sum of one
//! and the other turned by half a turn. A hull goes to the corner or crossing of these polygons
//! that uses the least length of the sheet. Several orders are tried, the same on every run.

use super::rings::{area_mm2, bounds, crossings, depth_mm, grown, no_fit_polygon, turned};
use crate::base::random::Random;
use crate::geom::hull::convex_hull;

/// A corner counts as outside of a no-fit polygon up to this depth, mm. It is far below what a
/// drawing keeps.
const TOUCH_MM: f64 = 1e-7;
/// Number of directions in which a panel is tried where the grain does not matter.
const TURNS: usize = 12;
/// Number of directions where it does: two for sheets that lie along their grain, two for others.
const QUARTERS: usize = 4;
/// Number of orders that are tried.
const ORDERS: usize = 24;

/// A sheet on which panels may lie.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stock {
    /// Length and width, mm.
    pub size_mm: [f64; 2],
    /// Number of such sheets at hand; `None` for any number.
    pub count: Option<usize>,
    /// True if it lies turned by a quarter, and its grain with it.
    pub is_turned: bool,
}

/// The order for a nest.
#[derive(Debug, Clone, PartialEq)]
pub struct NestRequest {
    /// The sheets. Those with a number are offcuts: they are used first, in their order. Of the
    /// others, those are used that take the least area.
    pub stock: Vec<Stock>,
    /// The width that stays free along the edges of a sheet, mm.
    pub margin_mm: f64,
    /// The least distance of two panels, mm.
    pub spacing_mm: f64,
    /// True if panels keep to the grain of their sheet: they may only be turned by half a turn
    /// against it.
    pub keeps_grain: bool,
}

/// The place of a panel on a sheet, its inner face up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    /// The index of the panel.
    pub panel: usize,
    /// The turn about its origin, counterclockwise, radians.
    pub turn_rad: f64,
    /// The place of its origin, mm.
    pub at_mm: [f64; 2],
}

impl Placement {
    /// Returns the place of a point of the outline that was laid, mm.
    pub fn place(&self, point: [f64; 2]) -> [f64; 2] {
        let [x, y] = turned(point, self.turn_rad);
        [x + self.at_mm[0], y + self.at_mm[1]]
    }
}

/// A sheet with panels on it.
#[derive(Debug, Clone, PartialEq)]
pub struct NestedSheet {
    /// Length and width, mm.
    pub size_mm: [f64; 2],
    /// True if it is one of a number of offcuts.
    pub is_offcut: bool,
    /// True if it lies turned by a quarter, and its grain with it.
    pub is_turned: bool,
    /// The panels.
    pub placements: Vec<Placement>,
    /// The length of the sheet up to the last panel with its margin, mm.
    pub used_mm: f64,
}

/// The reason that panels find no place.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NestError {
    /// A panel that fits no sheet.
    #[error("panel {0} is larger than every sheet less its margins")]
    TooLarge(usize),
    /// Fewer sheets than the panels need.
    #[error("the sheets at hand have no room for panel {0}")]
    NoSheetLeft(usize),
}

/// Lays panels, each given by its outline's corners (mm), on sheets.
///
/// # Errors
/// A panel is larger than every sheet, or the sheets are used up.
pub fn nest(
    panels: &[Vec<[f64; 2]>],
    request: &NestRequest,
) -> Result<Vec<NestedSheet>, NestError> {
    let items: Vec<Item> = panels
        .iter()
        .map(|corners| Item::of(corners, request))
        .collect();
    let mut best: Option<Vec<NestedSheet>> = None;
    let mut first_error = None;
    let orders = orders(&items);
    for stock in stock_orders(&request.stock) {
        let request = NestRequest {
            stock,
            ..request.clone()
        };
        for order in &orders {
            match lay_out(&items, order, &request) {
                Ok(sheets) => {
                    let sheets = on_smaller_sheets(sheets, &items, &request);
                    if best.as_ref().is_none_or(|best| is_better(&sheets, best)) {
                        best = Some(sheets);
                    }
                }
                Err(why) => first_error = first_error.or(Some(why)),
            }
        }
    }
    match (best, first_error) {
        (Some(best), _) => Ok(best),
        (None, Some(why)) => Err(why),
        (None, None) => Ok(Vec::new()),
    }
}

/// Returns the orders in which sheets are tried: offcuts first, and then each of the others first.
fn stock_orders(stock: &[Stock]) -> Vec<Vec<Stock>> {
    let (offcuts, whole): (Vec<Stock>, Vec<Stock>) =
        stock.iter().partition(|stock| stock.count.is_some());
    let rotated = (0..whole.len().max(1)).map(|first| {
        let mut order = whole.clone();
        order.rotate_left(first.min(whole.len()));
        [offcuts.clone(), order].concat()
    });
    rotated.collect()
}

/// Returns the same sheets, each whole one in exchange for a smaller one where its panels fit that.
fn on_smaller_sheets(
    sheets: Vec<NestedSheet>,
    items: &[Item],
    request: &NestRequest,
) -> Vec<NestedSheet> {
    let mut whole: Vec<Stock> = request.stock.clone();
    whole.retain(|stock| stock.count.is_none());
    whole.sort_by(|a, b| area_of(a.size_mm).total_cmp(&area_of(b.size_mm)));
    let smaller = sheets.into_iter().map(|sheet| {
        if sheet.is_offcut {
            return sheet;
        }
        let is_smaller = |stock: &&Stock| area_of(stock.size_mm) < area_of(sheet.size_mm);
        let found = whole.iter().filter(is_smaller).find_map(|stock| {
            let mut fresh = Laid::new(*stock);
            let mut all = sheet.placements.iter();
            let fits = all.all(|at| fresh.take(at.panel, &items[at.panel], request));
            fits.then(|| fresh.done(request))
        });
        found.unwrap_or(sheet)
    });
    smaller.collect()
}

fn area_of(size_mm: [f64; 2]) -> f64 {
    size_mm[0] * size_mm[1]
}

/// Returns true if a nest is better than another one: it takes less area of whole sheets, or else
/// less of offcuts. Of the last whole sheet only the used length counts.
fn is_better(sheets: &[NestedSheet], than: &[NestedSheet]) -> bool {
    let rank = |sheets: &[NestedSheet]| {
        let whole = sheets.iter().filter(|sheet| !sheet.is_offcut);
        let unused = whole.clone().next_back().map_or(0.0, |last| {
            (last.size_mm[0] - last.used_mm) * last.size_mm[1]
        });
        let offcuts = sheets.iter().filter(|sheet| sheet.is_offcut);
        let areas: f64 = whole.map(|sheet| area_of(sheet.size_mm)).sum();
        let offcuts = offcuts.map(|sheet| sheet.used_mm * sheet.size_mm[1]);
        [areas - unused, offcuts.sum()]
    };
    let [own, other] = [rank(sheets), rank(than)];
    let by_rank = own[0].total_cmp(&other[0]);
    by_rank.then(own[1].total_cmp(&other[1])).is_lt()
}

/// A panel as it is laid out: its hull in each direction, with half of the spacing around it.
struct Item {
    turns: Vec<Turned>,
    area_mm2: f64,
    length_mm: f64,
}

/// A hull in one direction.
struct Turned {
    turn_rad: f64,
    /// The corners, counterclockwise.
    hull: Vec<[f64; 2]>,
}

impl Item {
    fn of(corners: &[[f64; 2]], request: &NestRequest) -> Self {
        let hull = grown(&convex_hull(corners.to_vec()), 0.5 * request.spacing_mm);
        let count = if request.keeps_grain { QUARTERS } else { TURNS };
        let turn = |index: usize| {
            let turn_rad = std::f64::consts::TAU * index as f64 / count as f64;
            Turned {
                turn_rad,
                hull: hull.iter().map(|&at| turned(at, turn_rad)).collect(),
            }
        };
        let [low, high] = bounds(&hull);
        Self {
            turns: (0..count).map(turn).collect(),
            area_mm2: area_mm2(&hull),
            length_mm: (high[0] - low[0]).max(high[1] - low[1]),
        }
    }
}

/// Returns the orders that are tried: by area, by length, and the first with neighbours exchanged.
fn orders(items: &[Item]) -> Vec<Vec<usize>> {
    let sorted = |key: &dyn Fn(&Item) -> f64| {
        let mut order: Vec<usize> = (0..items.len()).collect();
        order.sort_by(|&a, &b| key(&items[b]).total_cmp(&key(&items[a])).then(a.cmp(&b)));
        order
    };
    let by_area = sorted(&|item| item.area_mm2);
    let mut orders = vec![by_area.clone(), sorted(&|item| item.length_mm)];
    let mut random = Random::new(1);
    while items.len() > 1 && orders.len() < ORDERS {
        let mut order = by_area.clone();
        for _ in 0..items.len().div_ceil(2) {
            let at = random.below(items.len() - 1);
            order.swap(at, at + 1);
        }
        orders.push(order);
    }
    orders
}

/// Lays the panels out one after another, each on the first sheet that has room.
fn lay_out(
    items: &[Item],
    order: &[usize],
    request: &NestRequest,
) -> Result<Vec<NestedSheet>, NestError> {
    let mut sheets: Vec<Laid> = Vec::new();
    for &panel in order {
        let item = &items[panel];
        if sheets
            .iter_mut()
            .any(|sheet| sheet.take(panel, item, request))
        {
            continue;
        }
        let mut fits_any = false;
        let fresh = request.stock.iter().enumerate().find_map(|(kind, stock)| {
            let mut sheet = Laid {
                kind,
                ..Laid::new(*stock)
            };
            let fits = sheet.take(panel, item, request);
            fits_any |= fits;
            let used = sheets.iter().filter(|sheet| sheet.kind == kind).count();
            (fits && stock.count.is_none_or(|count| used < count)).then_some(sheet)
        });
        match fresh {
            Some(sheet) => sheets.push(sheet),
            None if fits_any => return Err(NestError::NoSheetLeft(panel)),
            None => return Err(NestError::TooLarge(panel)),
        }
    }
    Ok(sheets
        .into_iter()
        .map(|sheet| sheet.done(request))
        .collect())
}

/// A sheet that is being filled.
struct Laid {
    /// The index of its size in the stock.
    kind: usize,
    size_mm: [f64; 2],
    is_offcut: bool,
    is_turned: bool,
    /// The placements, with the hulls in their places.
    laid: Vec<(Placement, Vec<[f64; 2]>)>,
}

impl Laid {
    fn new(stock: Stock) -> Self {
        Self {
            kind: 0,
            size_mm: stock.size_mm,
            is_offcut: stock.count.is_some(),
            is_turned: stock.is_turned,
            laid: Vec::new(),
        }
    }

    /// Lays a panel where it uses the least length, and then the least width. Returns whether
    /// there was room.
    fn take(&mut self, panel: usize, item: &Item, request: &NestRequest) -> bool {
        let first = usize::from(request.keeps_grain && self.is_turned);
        let step = if request.keeps_grain { 2 } else { 1 };
        let turns = item.turns.iter().skip(first).step_by(step);
        let places = turns.filter_map(|turned| {
            let at_mm = self.place(&turned.hull, request)?;
            let [_, high] = bounds(&turned.hull);
            Some((at_mm[0] + high[0], at_mm[1] + high[1], turned, at_mm))
        });
        let best = places.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let Some((_, _, turned, at_mm)) = best else {
            return false;
        };
        let placement = Placement {
            panel,
            turn_rad: turned.turn_rad,
            at_mm,
        };
        let hull = turned
            .hull
            .iter()
            .map(|at| [at[0] + at_mm[0], at[1] + at_mm[1]]);
        self.laid.push((placement, hull.collect()));
        true
    }

    /// Returns the place of a hull's origin that uses the least length; `None` without room.
    fn place(&self, hull: &[[f64; 2]], request: &NestRequest) -> Option<[f64; 2]> {
        let edge_mm = request.margin_mm - 0.5 * request.spacing_mm;
        let [low, high] = bounds(hull);
        let least = [0, 1].map(|axis| edge_mm - low[axis]);
        let most = [0, 1].map(|axis| self.size_mm[axis] - edge_mm - high[axis]);
        if least[0] > most[0] || least[1] > most[1] {
            return None;
        }
        let no_fit: Vec<Vec<[f64; 2]>> = self
            .laid
            .iter()
            .map(|(_, fixed)| no_fit_polygon(fixed, hull))
            .collect();
        let frame = [
            [least[0], least[1]],
            [most[0], least[1]],
            [most[0], most[1]],
            [least[0], most[1]],
        ];
        let mut places: Vec<[f64; 2]> = frame.to_vec();
        places.extend(no_fit.iter().flatten());
        let rings: Vec<&[[f64; 2]]> = no_fit
            .iter()
            .map(Vec::as_slice)
            .chain([&frame[..]])
            .collect();
        for (index, ring) in rings.iter().enumerate() {
            for other in &rings[index + 1..] {
                places.extend(crossings(ring, other));
            }
        }
        let is_free = |at: &[f64; 2]| {
            let in_frame = (0..2)
                .all(|axis| (least[axis] - TOUCH_MM..=most[axis] + TOUCH_MM).contains(&at[axis]));
            in_frame && no_fit.iter().all(|ring| depth_mm(ring, at) <= TOUCH_MM)
        };
        let free = places.into_iter().filter(is_free);
        free.min_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])))
    }

    fn done(self, request: &NestRequest) -> NestedSheet {
        let ends = self.laid.iter().map(|(_, hull)| bounds(hull)[1][0]);
        let last_mm = ends.fold(0.0, f64::max) - 0.5 * request.spacing_mm;
        NestedSheet {
            size_mm: self.size_mm,
            is_offcut: self.is_offcut,
            is_turned: self.is_turned,
            used_mm: last_mm + request.margin_mm,
            placements: self
                .laid
                .into_iter()
                .map(|(placement, _)| placement)
                .collect(),
        }
    }
}
