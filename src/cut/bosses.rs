//! Bosses: material to be kept solid around pins, where the walls alone leave them no room.
//!
//! A site is as good as it is cheap. Near an optimum the objective changes, to first order, by the
//! integral of the optimal quadric over what is filled, so that is the price of a boss.

use std::f64::consts::{PI, TAU};

use rayon::prelude::*;

use super::{
    boss_places::{Cost, OpenPairs, Site, best_pairs, grid},
    boss_view::BossView,
    error::CutError,
    face::Face,
    order::CutOrder,
    outline::Outline,
    pin_shape::PinSite,
    pin_size::{Size, short_pairs, size_pairs},
    pins::{PinScene, Placement, is_confused, seated},
    plan::{CutPlan, JointNote, bridges_on, part_id},
    rejoin::rejoined,
    request::PlanRequest,
    section::{Chart, Point2, Section},
    split::{Joint, joints, split},
};
use crate::{
    geom::{Bvh, Frame, Point, Quadric, Vector, orthonormal_basis},
    mesh::{Csg, Hollowed, TriMesh},
};

/// Places whose price is found, at most.
const PRICED_PLACES: usize = 300;
/// How much wider than needed a boss is, mm: far above the rounding of booleans, below any pixel.
const MARGIN_MM: f64 = 0.01;
/// Sides of a boss.
const SIDES: usize = 32;
/// The turn of its corners about its axis, in sides, so that none lies in a plane of the model's
/// axes.
const ASKEW: f64 = 0.37;
/// Rings and heights in which a boss's price is sampled.
const PRICED_RINGS: [(f64, usize); 3] = [(0.0, 1), (0.5, 6), (0.9, 12)];
/// See [`PRICED_RINGS`]; as shares of the boss's height.
const PRICED_HEIGHTS: [f64; 5] = [0.1, 0.3, 0.5, 0.7, 0.9];

/// What bosses are to be found for.
#[derive(Debug, Clone, Copy)]
pub struct BossOrder<'a> {
    /// The body as it is hollowed now.
    pub hollowed: &'a Hollowed,
    /// What the plan was asked for.
    pub request: &'a PlanRequest,
    /// The plan of its cuts and pins.
    pub plan: &'a CutPlan,
    /// The pins that a person ordered: they get bosses where they need them, and no other pins are
    /// looked for.
    pub ordered: Option<&'a [PinSite]>,
    /// Joints for which no bosses are looked for any more.
    pub given_up: &'a [JointName],
    /// Where bosses stood that cost too much, model frame, mm: none is looked for beside them.
    pub refused: &'a [[f64; 3]],
    /// The quadric whose positive side is empty, and the frame it is given in.
    pub price: (Quadric, Frame),
}

/// A joint by the names of what meets there.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct JointName {
    /// The cut's id.
    pub cut: String,
    /// The ids of the parts below and above the cut.
    pub parts: [String; 2],
}

/// A pin with the material that is to be kept solid around it and its socket.
#[derive(Debug, Clone, PartialEq)]
pub struct Boss {
    /// The pin; its id is not settled yet.
    pub pin: PinSite,
    /// The ids of the parts it joins.
    pub parts: [String; 2],
    /// Closed, facing outward, model frame, mm; it reaches into the wall.
    pub body: TriMesh,
    /// Whether something of it is empty so far. A boss that is solid already is kept so when
    /// everything is solved again.
    pub is_new: bool,
}

impl Boss {
    /// The joint that its pin aligns.
    pub fn joint(&self) -> JointName {
        JointName {
            cut: self.pin.cut.clone(),
            parts: self.parts.clone(),
        }
    }
}

/// The pins, with bosses where they need them, of every joint that has not two pins that fit one
/// way only; of ordered pins those of joints in which one stands in too little material. A joint
/// for which there is no place has none of them. Where no place leaves every void open, one is
/// taken that closes some: what it closes is to be kept solid.
///
/// The axis of every boss keeps the wall from the outside, from pockets, from other cuts and from
/// other pins.
pub fn bosses(order: &BossOrder) -> Result<Vec<Boss>, CutError> {
    if order.ordered.is_none() && order.plan.joints.iter().all(JointNote::is_aligned) {
        return Ok(Vec::new());
    }
    let own = CutOrder::of(order.plan).numbered();
    let tree = order.plan.tree()?;
    let bridges = bridges_on(&tree.planes, &own.cuts, &own.uncut);
    let material = order.hollowed.to_mesh();
    let pieces = rejoined(split(&material, &tree)?, &tree, &bridges)?;
    let filled = filled(order);
    let scene = |material| PinScene {
        request: order.request,
        tree: &tree,
        material,
    };
    let (hollow, filled) = (scene(&material), scene(&filled));
    let joints = joints(&pieces, &tree);
    let mut placements = seated(&hollow, &joints, own.pins.as_deref().unwrap_or_default())?;
    let [air, outer] = [hollow.material, filled.material].map(|mesh| Bvh::new(mesh.iter_corners()));
    let view = BossView::new(order.hollowed, &tree, order.request)?;
    let search = Search {
        order,
        hollow: &hollow,
        filled: &filled,
        air,
        outer,
        view,
    };
    let mut bosses = Vec::new();
    if let Some(pins) = order.ordered {
        let able: Vec<Boss> = pins
            .iter()
            .filter_map(|pin| search.for_ordered(&joints, pin))
            .collect();
        // As when the planner finds a pattern: all of a joint's pins keep their material, or none
        // needs to.
        let is_needy = |boss: &&Boss| {
            able.iter()
                .any(|other| other.is_new && other.joint() == boss.joint())
        };
        return Ok(able.iter().filter(is_needy).cloned().collect());
    }
    for (index, joint) in joints.iter().enumerate() {
        if !placements[index].is_sound() && !order.given_up.contains(&search.name(joint)) {
            let others = placements
                .iter()
                .enumerate()
                .filter(|(i, _)| *i != index)
                .map(|(_, p)| p);
            let others: Vec<&Placement> = others.collect();
            let is_bare = placements[index].sites.is_empty();
            let pair = search.found(joint, &others)?;
            let found = if pair.is_none() && is_bare {
                search.lone(joint, &others)
            } else {
                pair
            };
            if let Some(found) = found {
                bosses.extend(found.sites.iter().filter_map(|pin| search.boss(joint, pin)));
                placements[index] = found;
            }
        }
    }
    Ok(bosses)
}

/// The body with nothing empty but what holds parts.
fn filled(order: &BossOrder) -> TriMesh {
    let Hollowed { outer, voids } = order.hollowed;
    let seats = voids.len().saturating_sub(order.request.seats.len());
    Hollowed {
        outer: outer.clone(),
        voids: voids[seats..].to_vec(),
    }
    .to_mesh()
}

struct Search<'a> {
    order: &'a BossOrder<'a>,
    /// The body as it is.
    hollow: &'a PinScene<'a>,
    /// The body with its voids filled.
    filled: &'a PinScene<'a>,
    /// The surface of the body as it is.
    air: Bvh,
    /// The surface of the filled body.
    outer: Bvh,
    /// What is seen of its voids.
    view: BossView<'a>,
}

impl Search<'_> {
    /// The boss of an ordered pin that has its material, or could have.
    fn for_ordered(&self, joints: &[Joint], pin: &PinSite) -> Option<Boss> {
        let cut = self
            .order
            .plan
            .cuts
            .iter()
            .position(|cut| cut.id == pin.cut)?;
        let (plane, outline) = (&self.filled.tree.planes[cut], self.outline(cut));
        let at = Chart::of_plane(plane).flat(&Point::from(pin.center_mm));
        let is_of = |joint: &&Joint| joint.cut == cut && self.is_of_joint(joint, &outline, &at);
        let joint = joints.iter().find(is_of)?;
        self.has_meat(self.filled, joint, pin)
            .then(|| self.boss(joint, pin))
            .flatten()
    }

    /// The outline of the filled body in a cut.
    fn outline(&self, cut: usize) -> Outline {
        let section = Section::of_mesh(self.filled.material, &self.filled.tree.planes[cut]);
        section.outline(&(0..section.rings.len()).collect::<Vec<_>>())
    }

    /// Whether the wall nearest to a place in the cut is of this joint.
    fn is_of_joint(&self, joint: &Joint, outline: &Outline, at: &Point2) -> bool {
        let foot = outline.nearest(at);
        let inner = foot + (at - foot).normalize() * (self.order.request.wall_mm / 2.0);
        joint.faces.iter().any(|face| face.holds(&inner))
    }

    fn has_meat(&self, scene: &PinScene, joint: &Joint, pin: &PinSite) -> bool {
        let plane = &scene.tree.planes[joint.cut];
        let is_upward = plane.normal.dot(&Vector::from(pin.direction)) > 0.0;
        let at = Chart::of_plane(plane).flat(&Point::from(pin.center_mm));
        Face::bare(scene, joint, (&[], is_upward)).has_meat(&at, &Size::of(pin))
    }

    /// The cheapest pattern of pins for a joint, looking either way, of the thinnest pins that fit
    /// one way only.
    fn found(&self, joint: &Joint, others: &[&Placement]) -> Result<Option<Placement>, CutError> {
        let thin_first = |mut pairs: Vec<[Size; 2]>| {
            let equal = pairs.pop();
            pairs.into_iter().rev().chain(equal)
        };
        let request = self.order.request;
        let pairs = thin_first(size_pairs(request)).chain(thin_first(short_pairs(request)));
        let pairs: Vec<[Size; 2]> = pairs.collect();
        let ways = [true, false]
            .into_iter()
            .flat_map(|must_open| pairs.iter().map(move |sizes| (must_open, sizes)));
        for (must_open, sizes) in ways {
            let mut best: Option<(Cost, Placement)> = None;
            for is_upward in [true, false] {
                let found = self.along(joint, (others, is_upward), sizes, must_open)?;
                best = match (best, found) {
                    (Some(best), Some(found)) if found.0.order(&best.0).is_ge() => Some(best),
                    (best, found) => found.or(best),
                };
            }
            if let Some((_, placement)) = best {
                return Ok(Some(placement));
            }
        }
        Ok(None)
    }

    /// The cheapest single pin of the thinnest size for a joint without room for two; only the
    /// parts' outlines tell the turn then.
    fn lone(&self, joint: &Joint, others: &[&Placement]) -> Option<Placement> {
        let [_, size] = size_pairs(self.order.request).pop()?;
        let along = |is_upward: bool| {
            let face = Face::bare(self.filled, joint, (others, is_upward));
            let sites = self.sites(joint, &face, (&size, is_upward)).into_iter();
            let costs = sites.map(|site| (Cost::of(&[&site], &self.view), site.at));
            let (cost, at) = costs.min_by(|a, b| a.0.order(&b.0))?;
            Some((cost, face.placement(&[(at, size)], false)))
        };
        let found = [true, false].into_iter().filter_map(along);
        found
            .min_by(|a, b| a.0.order(&b.0))
            .map(|(_, placement)| placement)
    }

    /// The best pattern of two pins of these sizes, and what it costs; with `must_open` of those
    /// that leave every void open.
    fn along(
        &self,
        joint: &Joint,
        (others, is_upward): (&[&Placement], bool),
        sizes: &[Size; 2],
        must_open: bool,
    ) -> Result<Option<(Cost, Placement)>, CutError> {
        let face = Face::bare(self.filled, joint, (others, is_upward));
        let sites = self.sites(joint, &face, (&sizes[0], is_upward));
        let mut open = OpenPairs::new(
            &self.view,
            &sites,
            sizes[0].room_mm(self.order.request) / 2.0,
        );
        for pair in best_pairs(&sites, face.gap_mm(&sizes[0]), &self.view) {
            let [i, j] = pair.sites;
            let pattern = [(sites[i].at, sizes[0]), (sites[j].at, sizes[1])];
            let is_taken = !is_confused(&face.end_views(&pattern), others)
                && (!must_open || open.holds(pair.sites)?);
            if is_taken {
                return Ok(Some((pair.cost, face.placement(&pattern, true))));
            }
            if open.is_over() {
                break;
            }
        }
        Ok(None)
    }

    /// The places of a joint where a boss of this size joins its wall and keeps off the outside,
    /// with their prices.
    fn sites(&self, joint: &Joint, face: &Face, (size, is_upward): (&Size, bool)) -> Vec<Site> {
        let request = self.order.request;
        let plane = &self.filled.tree.planes[joint.cut];
        let outline = self.outline(joint.cut);
        let room = size.room_mm(request) / 2.0 + MARGIN_MM;
        let chart = Chart::of_plane(plane);
        let refused: Vec<Point2> = self
            .order
            .refused
            .iter()
            .map(|p| chart.flat(&Point::from(*p)))
            .collect();
        let is_near = |p: &Point2| (room..2.0 * room).contains(&outline.signed_distance(p));
        let is_refused = |p: &Point2| refused.iter().any(|at| (at - p).norm() < room);
        let places: Vec<Point2> = grid(&outline)
            .into_par_iter()
            .filter(|p| {
                is_near(p)
                    && !is_refused(p)
                    && self.is_of_joint(joint, &outline, p)
                    && face.has_meat(p, size)
            })
            .collect();
        let stride = places.len().div_ceil(PRICED_PLACES).max(1);
        let priced = |&at: &Point2| -> Option<Site> {
            let sign = if is_upward { 1.0 } else { -1.0 };
            let mouth = chart.lift(plane, &at);
            let along = plane.normal * sign;
            let price = self.price(&mouth, &along, size);
            let body = self.body(joint, (&mouth, &along), size)?;
            Some(Site {
                at,
                price,
                hides: self.view.hidden_by(&body),
                body,
            })
        };
        places
            .par_iter()
            .step_by(stride)
            .filter_map(priced)
            .collect()
    }

    /// What the boss of a pin costs, to first order and up to a factor: the integral of the quadric
    /// over what it fills.
    fn price(&self, mouth: &Point, along: &Vector, size: &Size) -> f64 {
        let (quadric, frame) = &self.order.price;
        let (u, v) = orthonormal_basis(along);
        let radius = size.room_mm(self.order.request) / 2.0;
        let [low, high] = self.ends_mm(size);
        let value = |height: f64, ring: f64, turn: f64| {
            let aside = (u * turn.cos() + v * turn.sin()) * (ring * radius);
            let p = mouth + aside + along * (low + height * (high - low));
            let value = quadric.value(&frame.to_local(&p));
            if value > 0.0 && self.air.winding(&p) == 0 {
                value
            } else {
                0.0
            }
        };
        let rings = PRICED_RINGS.iter().flat_map(|&(ring, count)| {
            let turn = move |k: usize| TAU * (k as f64 + ASKEW) / count as f64;
            (0..count).map(move |k| (ring, turn(k)))
        });
        rings
            .flat_map(|(ring, turn)| PRICED_HEIGHTS.map(|height| value(height, ring, turn)))
            .sum()
    }

    /// From where to where along the pin its boss reaches, mm from the cut.
    fn ends_mm(&self, size: &Size) -> [f64; 2] {
        let wall = size.corner() + self.order.request.wall_mm + MARGIN_MM;
        let back = if size.dowel.is_some() {
            size.depth
        } else {
            size.chamfer
        };
        [-(wall + back), size.depth + wall]
    }

    fn name(&self, joint: &Joint) -> JointName {
        let cut = self.order.plan.cuts[joint.cut].id.clone();
        JointName {
            cut,
            parts: [part_id(joint.below), part_id(joint.above)],
        }
    }

    /// The pin with its boss, none where it has no volume: a round or long bar about it that
    /// reaches to the outside in the cut, so that it stands in the wall.
    fn boss(&self, joint: &Joint, pin: &PinSite) -> Option<Boss> {
        let JointName { cut, parts } = self.name(joint);
        let is_new = !self.has_meat(self.hollow, joint, pin);
        let axis = (&Point::from(pin.center_mm), &Vector::from(pin.direction));
        let body = self.body(joint, axis, &Size::of(pin))?;
        Some(Boss {
            pin: PinSite { cut, ..pin.clone() },
            parts,
            body,
            is_new,
        })
    }

    /// The hull of discs about the pin's axis, and of others moved to the wall beside it wherever a
    /// gap too narrow to be cleaned would stay between.
    fn body(
        &self,
        joint: &Joint,
        (middle, along): (&Point, &Vector),
        size: &Size,
    ) -> Option<TriMesh> {
        let radius = size.room_mm(self.order.request) / 2.0 + MARGIN_MM;
        let ends = self.ends_mm(size).map(|height| middle + along * height);
        let ribs = ends.iter().filter_map(|end| self.rib(end, along, radius));
        let ribs = ribs.chain([self.root(joint, middle, radius)]);
        let centers: Vec<Point> = ends.iter().copied().chain(ribs).collect();
        let points: Vec<Point> = centers
            .iter()
            .flat_map(|center| disc(center, along, radius))
            .collect();
        Csg::convex_hull(&points).ok()?.to_mesh().ok()
    }

    /// A disc's middle moved in the cut until it touches the outside.
    fn root(&self, joint: &Joint, middle: &Point, radius: f64) -> Point {
        let plane = &self.filled.tree.planes[joint.cut];
        let chart = Chart::of_plane(plane);
        let at = chart.flat(middle);
        let outward = self.outline(joint.cut).nearest(&at) - at;
        chart.lift(
            plane,
            &(at + outward.normalize() * (outward.norm() - radius).max(0.0)),
        )
    }

    /// A disc's middle moved to the wall beside it, across its axis; none where the gap between
    /// them can be cleaned, or is none.
    fn rib(&self, end: &Point, along: &Vector, radius: f64) -> Option<Point> {
        let request = self.order.request;
        let outward = self.outer.closest(end, f64::INFINITY, &[])?.point - end;
        let gap = outward.norm() - radius;
        let across = (outward - along * along.dot(&outward)).try_normalize(0.0)?;
        (gap > 0.0 && gap < request.wall_mm + request.min_opening_mm).then(|| end + across * gap)
    }
}

/// The corners of a polygon about a disc.
fn disc(center: &Point, normal: &Vector, radius_mm: f64) -> Vec<Point> {
    let (u, v) = orthonormal_basis(normal);
    let corner_mm = radius_mm / (PI / SIDES as f64).cos();
    let corner = |side: usize| {
        let (sin, cos) = (TAU * (side as f64 + ASKEW) / SIDES as f64).sin_cos();
        center + (u * cos + v * sin) * corner_mm
    };
    (0..SIDES).map(corner).collect()
}
