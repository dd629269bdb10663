//! Nesting: where panels lie on sheets, so that few sheets are cut.
//!
//! Panels are convex but for some per cent of their area, so their convex hulls are laid out. For
//! two hulls the places that touch are a convex polygon, their no-fit polygon: the sum of one and
//! the other turned by half a turn. A hull goes to the corner or crossing of these polygons that
//! uses the least length of the sheet. Several orders are tried, the same on every run.

use crate::geom::hull::convex_hull;

/// A corner counts as outside of a no-fit polygon up to this depth, mm. It is far below what a
/// drawing keeps.
const TOUCH_MM: f64 = 1e-7;
/// Number of directions in which a panel is tried where the grain does not matter.
const TURNS: usize = 12;
/// Number of orders that are tried.
const ORDERS: usize = 24;

/// A sheet on which panels may lie.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stock {
    /// Length and width, mm.
    pub size_mm: [f64; 2],
    /// Number of such sheets at hand; `None` for any number.
    pub count: Option<usize>,
}

/// The order for a nest.
#[derive(Debug, Clone, PartialEq)]
pub struct NestRequest {
    /// The sheets; the first ones are used first, so offcuts come first.
    pub stock: Vec<Stock>,
    /// The width that stays free along the edges of a sheet, mm.
    pub margin_mm: f64,
    /// The least distance of two panels, mm.
    pub spacing_mm: f64,
    /// True if panels may only be turned by half a turn.
    pub keeps_grain: bool,
}

/// The place of a panel on a sheet.
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
    /// Returns the place of one of the panel's points, mm.
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
    for order in orders(&items) {
        match lay_out(&items, &order, request) {
            Ok(sheets) => {
                if best.as_ref().is_none_or(|best| rank(&sheets) < rank(best)) {
                    best = Some(sheets);
                }
            }
            Err(why) => first_error = first_error.or(Some(why)),
        }
    }
    match (best, first_error) {
        (Some(best), _) => Ok(best),
        (None, Some(why)) => Err(why),
        (None, None) => Ok(Vec::new()),
    }
}

/// Returns what makes a nest worse: the area of its sheets, of which only the used length counts
/// on the last one.
fn rank(sheets: &[NestedSheet]) -> f64 {
    let whole = |sheet: &NestedSheet| sheet.size_mm[0] * sheet.size_mm[1];
    let Some((last, others)) = sheets.split_last() else {
        return 0.0;
    };
    others.iter().map(whole).sum::<f64>() + last.used_mm * last.size_mm[1]
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
        let count = if request.keeps_grain { 2 } else { TURNS };
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
    let mut state = 1u64;
    let mut random = |below: usize| {
        // A linear congruence of full period; the high bits are even enough for exchanges.
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    while items.len() > 1 && orders.len() < ORDERS {
        let mut order = by_area.clone();
        for _ in 0..items.len().div_ceil(2) {
            let at = random(items.len() - 1);
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
                size_mm: stock.size_mm,
                laid: Vec::new(),
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
    kind: usize,
    size_mm: [f64; 2],
    /// The placements, with the hulls in their places.
    laid: Vec<(Placement, Vec<[f64; 2]>)>,
}

impl Laid {
    /// Lays a panel where it uses the least length, and then the least width. Returns whether
    /// there was room.
    fn take(&mut self, panel: usize, item: &Item, request: &NestRequest) -> bool {
        let places = item.turns.iter().filter_map(|turned| {
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
            used_mm: last_mm + request.margin_mm,
            placements: self
                .laid
                .into_iter()
                .map(|(placement, _)| placement)
                .collect(),
        }
    }
}

fn turned([x, y]: [f64; 2], by_rad: f64) -> [f64; 2] {
    let (sin, cos) = by_rad.sin_cos();
    [x * cos - y * sin, x * sin + y * cos]
}

fn bounds(ring: &[[f64; 2]]) -> [[f64; 2]; 2] {
    let start = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    ring.iter().fold(start, |[low, high], at| {
        [
            [low[0].min(at[0]), low[1].min(at[1])],
            [high[0].max(at[0]), high[1].max(at[1])],
        ]
    })
}

fn edges(ring: &[[f64; 2]]) -> impl Iterator<Item = [[f64; 2]; 2]> + '_ {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(a, b)| [*a, *b])
}

fn area_mm2(ring: &[[f64; 2]]) -> f64 {
    0.5 * edges(ring)
        .map(|[a, b]| a[0] * b[1] - a[1] * b[0])
        .sum::<f64>()
}

/// Returns a convex ring with every edge moved outward by a distance, mm.
fn grown(ring: &[[f64; 2]], by_mm: f64) -> Vec<[f64; 2]> {
    let moved: Vec<[[f64; 2]; 2]> = edges(ring)
        .map(|[a, b]| {
            let [x, y] = [b[0] - a[0], b[1] - a[1]];
            let length = x.hypot(y);
            let out = [y / length * by_mm, -x / length * by_mm];
            [[a[0] + out[0], a[1] + out[1]], [x, y]]
        })
        .collect();
    let count = moved.len();
    let corner = |k: usize| {
        let ([p, u], [q, v]) = (moved[(k + count - 1) % count], moved[k]);
        let across = u[0] * v[1] - u[1] * v[0];
        let share = ((q[0] - p[0]) * v[1] - (q[1] - p[1]) * v[0]) / across;
        [p[0] + share * u[0], p[1] + share * u[1]]
    };
    (0..count).map(corner).collect()
}

/// Returns the no-fit polygon of two convex rings: the places of the moving one's origin at which
/// it touches the fixed one. Inside they overlap.
fn no_fit_polygon(fixed: &[[f64; 2]], moving: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let turned: Vec<[f64; 2]> = moving.iter().map(|[x, y]| [-x, -y]).collect();
    let start = |ring: &[[f64; 2]]| {
        let lowest = (0..ring.len()).min_by(|&i, &j| {
            ring[i][1]
                .total_cmp(&ring[j][1])
                .then(ring[i][0].total_cmp(&ring[j][0]))
        });
        lowest.unwrap_or(0)
    };
    let (a, b) = (start(fixed), start(&turned));
    let [mut i, mut j] = [0; 2];
    let mut ring = Vec::with_capacity(fixed.len() + turned.len());
    let at = |ring: &[[f64; 2]], k: usize| ring[k % ring.len()];
    while i < fixed.len() || j < turned.len() {
        let ([p, p_next], [q, q_next]) = (
            [at(fixed, a + i), at(fixed, a + i + 1)],
            [at(&turned, b + j), at(&turned, b + j + 1)],
        );
        ring.push([p[0] + q[0], p[1] + q[1]]);
        let (u, v) = (
            [p_next[0] - p[0], p_next[1] - p[1]],
            [q_next[0] - q[0], q_next[1] - q[1]],
        );
        let across = u[0] * v[1] - u[1] * v[0];
        let takes_first = j == turned.len() || (i < fixed.len() && across >= 0.0);
        let takes_second = i == fixed.len() || (j < turned.len() && across <= 0.0);
        i += usize::from(takes_first);
        j += usize::from(takes_second);
    }
    ring
}

/// Returns how deep a point is inside a convex ring, mm; less than zero outside.
fn depth_mm(ring: &[[f64; 2]], at: &[f64; 2]) -> f64 {
    let inward = edges(ring).filter_map(|[a, b]| {
        let [x, y] = [b[0] - a[0], b[1] - a[1]];
        let length = x.hypot(y);
        (length > 0.0).then(|| (x * (at[1] - a[1]) - y * (at[0] - a[0])) / length)
    });
    inward.fold(f64::INFINITY, f64::min)
}

/// Returns the points in which the edges of two rings cross.
fn crossings(a: &[[f64; 2]], b: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut found = Vec::new();
    for [p, p_next] in edges(a) {
        for [q, q_next] in edges(b) {
            let (u, v) = (
                [p_next[0] - p[0], p_next[1] - p[1]],
                [q_next[0] - q[0], q_next[1] - q[1]],
            );
            let across = u[0] * v[1] - u[1] * v[0];
            if across == 0.0 {
                continue;
            }
            let way = [q[0] - p[0], q[1] - p[1]];
            let along_a = (way[0] * v[1] - way[1] * v[0]) / across;
            let along_b = (way[0] * u[1] - way[1] * u[0]) / across;
            if (0.0..=1.0).contains(&along_a) && (0.0..=1.0).contains(&along_b) {
                found.push([p[0] + along_a * u[0], p[1] + along_a * u[1]]);
            }
        }
    }
    found
}
