//! Bosses: material to be kept solid around pins, where the walls alone leave them no room.
//!
//! A site is as good as it is cheap. Near an optimum the objective changes, to first order, by the
//! integral of the optimal quadric over what is filled, so that is the price of a boss.

use crate::{
    cut::{
        error::CutError,
        geometry::{
            chart::{Chart, Point2},
            outline::Outline,
        },
        joints::{
            boss::{Boss, BossOrder, JointName},
            boss_maker::{BossMaker, MARGIN_MM, PinAxis},
            boss_places::{Cost, OpenPairs, Site, best_pairs, grid},
            boss_view::BossView,
            face::Face,
            pin_shape::PinSite,
            pin_size::{Size, short_pairs, size_pairs},
            pins::seated,
            placement::{Facing, PinScene, Placement, is_confused},
        },
        order::CutOrder,
        pieces::{
            rejoin::rejoined,
            split::{Joint, joints, split},
        },
        plan::{JointNote, bridges_on, index_of},
    },
    geom::{Point, Vector},
};
use rayon::prelude::*;

/// Places whose price is found, at most.
const PRICED_PLACES: usize = 300;

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
    let filled = order.hollowed.without_empty_voids().to_mesh();
    let scene = |material| PinScene {
        request: order.request,
        tree: &tree,
        material,
    };
    let (hollow, filled) = (scene(&material), scene(&filled));
    let joints = joints(&pieces, &tree);
    let placements = seated(&hollow, &joints, own.pins.as_deref().unwrap_or_default())?;
    let search = Search {
        order,
        hollow: &hollow,
        filled: &filled,
        maker: BossMaker::new(&material, &filled, &order.price),
        view: BossView::new(order.hollowed, &tree, order.request)?,
    };
    match order.ordered {
        Some(pins) => Ok(search.for_all_ordered(&joints, pins)),
        None => search.for_joints(&joints, placements),
    }
}

struct Search<'a> {
    order: &'a BossOrder<'a>,
    /// The body as it is.
    hollow: &'a PinScene<'a>,
    /// The body with its voids filled.
    filled: &'a PinScene<'a>,
    /// What makes the bosses' bodies.
    maker: BossMaker<'a>,
    /// What is seen of its voids.
    view: BossView<'a>,
}

impl Search<'_> {
    /// The bosses of ordered pins: of every joint in which one of them lacks material.
    fn for_all_ordered(&self, joints: &[Joint], pins: &[PinSite]) -> Vec<Boss> {
        let able: Vec<Boss> = pins
            .iter()
            .filter_map(|pin| self.for_ordered(joints, pin))
            .collect();
        // As when the planner finds a pattern: all of a joint's pins keep their material, or none
        // needs to.
        let is_needy = |boss: &&Boss| {
            able.iter()
                .any(|other| other.is_new && other.joint() == boss.joint())
        };
        able.iter().filter(is_needy).cloned().collect()
    }

    /// The bosses of every joint that has not two pins that fit one way only.
    fn for_joints(
        &self,
        joints: &[Joint],
        mut placements: Vec<Placement>,
    ) -> Result<Vec<Boss>, CutError> {
        let mut bosses = Vec::new();
        for (index, joint) in joints.iter().enumerate() {
            if !placements[index].is_sound() && !self.order.given_up.contains(&self.name(joint)) {
                let others = placements
                    .iter()
                    .enumerate()
                    .filter(|(i, _)| *i != index)
                    .map(|(_, p)| p);
                let others: Vec<&Placement> = others.collect();
                let is_bare = placements[index].sites.is_empty();
                let pair = self.found(joint, &others)?;
                let found = if pair.is_none() && is_bare {
                    self.lone(joint, &others)
                } else {
                    pair
                };
                if let Some(found) = found {
                    bosses.extend(found.sites.iter().filter_map(|pin| self.boss(joint, pin)));
                    placements[index] = found;
                }
            }
        }
        Ok(bosses)
    }

    /// The boss of an ordered pin that has its material, or could have.
    fn for_ordered(&self, joints: &[Joint], pin: &PinSite) -> Option<Boss> {
        let cut = index_of(&self.order.plan.cuts, &pin.cut)?;
        let (plane, outline) = (&self.filled.tree.planes[cut], self.maker.outline(cut));
        let at = Chart::of_plane(plane).flat(&Point::from(pin.center_mm));
        let is_of = |joint: &&Joint| joint.cut == cut && self.is_of_joint(joint, &outline, &at);
        let joint = joints.iter().find(is_of)?;
        self.has_meat(self.filled, joint, pin)
            .then(|| self.boss(joint, pin))
            .flatten()
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
        let facing = Facing {
            others: &[],
            is_upward,
        };
        Face::bare(scene, joint, facing).has_meat(&at, &Size::of(pin))
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
                let found = self.along(joint, Facing { others, is_upward }, sizes, must_open)?;
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
            let face = Face::bare(self.filled, joint, Facing { others, is_upward });
            let sites = self.sites(joint, &face, &size).into_iter();
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
        facing: Facing,
        sizes: &[Size; 2],
        must_open: bool,
    ) -> Result<Option<(Cost, Placement)>, CutError> {
        let face = Face::bare(self.filled, joint, facing);
        let sites = self.sites(joint, &face, &sizes[0]);
        let mut open = OpenPairs::new(
            &self.view,
            &sites,
            sizes[0].room_mm(self.order.request) / 2.0,
        );
        for pair in best_pairs(&sites, face.gap_mm(&sizes[0]), &self.view) {
            let [i, j] = pair.sites;
            let pattern = [(sites[i].at, sizes[0]), (sites[j].at, sizes[1])];
            let is_taken = !is_confused(&face.end_views(&pattern), facing.others)
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
    fn sites(&self, joint: &Joint, face: &Face, size: &Size) -> Vec<Site> {
        let request = self.order.request;
        let plane = &self.filled.tree.planes[joint.cut];
        let outline = self.maker.outline(joint.cut);
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
            let axis = PinAxis {
                middle: chart.lift(plane, &at),
                along: face.along(),
            };
            let body = self.maker.body(joint, &axis, size)?;
            Some(Site {
                at,
                price: self.maker.price(&axis, size),
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

    fn name(&self, joint: &Joint) -> JointName {
        let cut = self.order.plan.cuts[joint.cut].id.clone();
        JointName {
            cut,
            parts: joint.parts(),
        }
    }

    /// The pin with its boss, none where it has no volume: a round or long bar about it that
    /// reaches to the outside in the cut, so that it stands in the wall.
    fn boss(&self, joint: &Joint, pin: &PinSite) -> Option<Boss> {
        let JointName { cut, parts } = self.name(joint);
        let is_new = !self.has_meat(self.hollow, joint, pin);
        let body = self.maker.body(joint, &PinAxis::of(pin), &Size::of(pin))?;
        Some(Boss {
            pin: PinSite { cut, ..pin.clone() },
            parts,
            body,
            is_new,
        })
    }
}
