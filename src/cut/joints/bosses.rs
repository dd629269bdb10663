//! Bosses: material kept solid around pins where the walls alone leave them no room.
//!
//! The cheapest site is the best. Near an optimum the objective changes, to first order, by the
//! integral of the optimal quadric over the material filled in. That integral is the price of a
//! boss.

use crate::{
    base::{verdict::Verdict, watch::Cancelled},
    cut::{
        error::{CutError, Obstacle, verdict},
        geometry::{
            chart::{Chart, Point2},
            outline::Outline,
        },
        joints::{
            boss::{Boss, BossRequest, JointName},
            boss_maker::{BossMaker, MARGIN_MM, PinAxis},
            boss_places::{Cost, OpenPairs, Site, grid},
            boss_sets::{SiteSet, held_sets, pattern_at},
            boss_view::BossView,
            face::Face,
            pin_shape::PinSite,
            pin_size::{Size, short_pairs, size_pairs},
            pins::seat_ordered,
            placement::{Facing, PinScene, Placement, is_confused},
        },
        order::CutOrder,
        pieces::{
            rejoin::rejoin,
            split::{Joint, joints, split},
        },
        plan::{JointNote, bridges_on, index_of},
    },
    geom::{Point, Vector},
};
use rayon::prelude::*;

/// Largest number of places that are priced.
const PRICED_PLACES: usize = 300;

/// Places pins with bosses in every joint without pins that fit one way only and hold it. If pins
/// are ordered, returns those of joints in which one stands in too little material.
///
/// A joint without a place for them gets none. If no place leaves every void open, one is taken
/// that closes some; what it closes must be kept solid.
///
/// The axis of every boss keeps the wall thickness from the outside, pockets, other cuts and other
/// pins. The answer is no if a pin of the plan stands on no cut face of the body.
pub fn bosses(order: &BossRequest) -> Result<Verdict<Vec<Boss>, Obstacle>, CutError> {
    verdict(find_bosses(order))
}

fn find_bosses(order: &BossRequest) -> Result<Vec<Boss>, CutError> {
    if order.ordered.is_none() && order.plan.joints.iter().all(JointNote::is_aligned) {
        return Ok(Vec::new());
    }
    let watch = &order.request.watch;
    let own = CutOrder::of(order.plan).numbered();
    let tree = order.plan.tree()?;
    let bridges = bridges_on(&tree.planes, &own.cuts, &own.uncut);
    let material = order.hollowed.to_mesh();
    let pieces = rejoin(split(&material, &tree, watch)?, &tree, &bridges, watch)?;
    let filled = order.hollowed.without_empty_voids().to_mesh();
    let scene = |material| PinScene {
        request: order.request,
        tree: &tree,
        material,
    };
    let (hollow, filled) = (scene(&material), scene(&filled));
    let joints = joints(&pieces, &tree);
    let placements = seat_ordered(&hollow, &joints, own.pins.as_deref().unwrap_or_default())?;
    watch.check()?;
    let search = Search {
        order,
        hollow: &hollow,
        filled: &filled,
        maker: BossMaker::new(&material, &filled, &order.price),
        view: BossView::new(order.hollowed, &tree, order.request)?,
    };
    match order.ordered {
        Some(pins) => Ok(search.boss_all_ordered(&joints, pins)?),
        None => search.boss_joints(&joints, placements),
    }
}

/// The best patterns of two pins.
struct Found<T> {
    /// The best that leaves every void open.
    open: Option<T>,
    /// The best of all.
    any: Option<T>,
    /// True if a pattern is confused with another joint's, in a direction that has no other.
    is_confused: bool,
}

/// A pattern with its cost.
type Priced = (Cost, Placement);

/// Returns the cheapest placement.
fn cheapest(found: Vec<Option<Priced>>) -> Option<Placement> {
    let cheapest = found.into_iter().flatten().min_by(|a, b| a.0.compare(&b.0));
    cheapest.map(|(_, placement)| placement)
}

struct Search<'a> {
    order: &'a BossRequest<'a>,
    /// The body with its voids.
    hollow: &'a PinScene<'a>,
    /// The body with its voids filled.
    filled: &'a PinScene<'a>,
    /// Maker of the bosses' bodies.
    maker: BossMaker<'a>,
    /// Visible walls of the voids.
    view: BossView<'a>,
}

impl Search<'_> {
    /// Returns the bosses of ordered pins, for every joint in which one of them lacks material.
    fn boss_all_ordered(&self, joints: &[Joint], pins: &[PinSite]) -> Result<Vec<Boss>, Cancelled> {
        let mut candidates: Vec<Boss> = Vec::new();
        for pin in pins {
            self.order.request.watch.check()?;
            candidates.extend(self.boss_ordered(joints, pin));
        }
        // As in patterns of the planner, either all pins of a joint get bosses or none does.
        let lacks_material = |boss: &&Boss| {
            candidates
                .iter()
                .any(|other| other.is_new && other.joint() == boss.joint())
        };
        Ok(candidates.iter().filter(lacks_material).cloned().collect())
    }

    /// Finds bosses for every joint without two pins that fit one way only.
    fn boss_joints(
        &self,
        joints: &[Joint],
        mut placements: Vec<Placement>,
    ) -> Result<Vec<Boss>, CutError> {
        let mut bosses = Vec::new();
        for (index, joint) in joints.iter().enumerate() {
            if !placements[index].is_sound()
                && !self.order.given_up.contains(&self.joint_name(joint))
            {
                let others = placements
                    .iter()
                    .enumerate()
                    .filter(|(i, _)| *i != index)
                    .map(|(_, p)| p);
                let others: Vec<&Placement> = others.collect();
                let has_no_pins = placements[index].sites.is_empty();
                let pair = self.find_pattern(joint, &others)?;
                let found = if pair.is_none() && has_no_pins {
                    self.find_single(joint, &others)?
                } else {
                    pair
                };
                if let Some(found) = found {
                    bosses.extend(
                        found
                            .sites
                            .iter()
                            .filter_map(|pin| self.make_boss(joint, pin)),
                    );
                    placements[index] = found;
                }
            }
        }
        Ok(bosses)
    }

    /// Returns the boss of an ordered pin. `None` if the filled body has too little material around
    /// it.
    fn boss_ordered(&self, joints: &[Joint], pin: &PinSite) -> Option<Boss> {
        let cut = index_of(&self.order.plan.cuts, &pin.cut)?;
        let (plane, outline) = (&self.filled.tree.planes[cut], self.maker.outline(cut));
        let at = Chart::of_plane(plane).flat(&Point::from(pin.center_mm));
        let is_of = |joint: &&Joint| joint.cut == cut && self.is_of_joint(joint, outline, &at);
        let joint = joints.iter().find(is_of)?;
        self.has_material(self.filled, joint, pin)
            .then(|| self.make_boss(joint, pin))
            .flatten()
    }

    /// Returns true if the wall nearest to a place in the cut belongs to this joint.
    fn is_of_joint(&self, joint: &Joint, outline: &Outline, at: &Point2) -> bool {
        let foot = outline.nearest(at);
        let inner = foot + (at - foot).normalize() * (self.order.request.wall_mm / 2.0);
        joint.faces.iter().any(|face| face.holds(&inner))
    }

    fn has_material(&self, scene: &PinScene, joint: &Joint, pin: &PinSite) -> bool {
        let plane = &scene.tree.planes[joint.cut];
        let is_upward = plane.normal.dot(&Vector::from(pin.direction)) > 0.0;
        let at = Chart::of_plane(plane).flat(&Point::from(pin.center_mm));
        let facing = Facing {
            others: &[],
            is_upward,
        };
        Face::without_points(scene, joint, facing).has_material(&at, &Size::of(pin))
    }

    /// Finds the cheapest pattern of two pins for a joint, in either direction. Takes the thinnest
    /// pins that fit one way only, and those that leave every void open before others.
    fn find_pattern(
        &self,
        joint: &Joint,
        others: &[&Placement],
    ) -> Result<Option<Placement>, CutError> {
        let request = self.order.request;
        let faces = self.faces(joint, others);
        let mut closing = None;
        for pairs in [size_pairs(request), short_pairs(request)] {
            let Some((equal, different)) = pairs.split_last() else {
                continue;
            };
            let mut tried = Vec::new();
            for sizes in different.iter().rev() {
                let found = self.try_sizes(joint, &faces, others, sizes)?;
                // Thicker pins are no farther apart than thin ones, and close more.
                let is_last = found.open.is_some() || !found.is_confused;
                tried.push(found);
                if is_last {
                    break;
                }
            }
            if tried.iter().all(|found| found.open.is_none()) {
                tried.push(self.try_sizes(joint, &faces, others, equal)?);
            }
            for found in tried {
                if found.open.is_some() {
                    return Ok(found.open);
                }
                closing = closing.or(found.any);
            }
        }
        Ok(closing)
    }

    /// Finds the cheapest patterns of two pins of these sizes, in either direction.
    fn try_sizes(
        &self,
        joint: &Joint,
        faces: &[Face],
        others: &[&Placement],
        sizes: &[Size; 2],
    ) -> Result<Found<Placement>, CutError> {
        let along = |face| self.find_pattern_along(joint, face, others, sizes);
        let found = faces.iter().map(along).collect::<Result<Vec<_>, _>>()?;
        let mut ways = found.iter();
        let is_confused = ways.any(|found| found.any.is_none() && found.is_confused);
        let (open, any) = found
            .into_iter()
            .map(|found| (found.open, found.any))
            .unzip();
        Ok(Found {
            open: cheapest(open),
            any: cheapest(any),
            is_confused,
        })
    }

    /// Returns the faces of a joint in the filled body for pins in either direction.
    fn faces<'s>(&'s self, joint: &'s Joint, others: &[&Placement]) -> [Face<'s>; 2] {
        [true, false]
            .map(|is_upward| Face::without_points(self.filled, joint, Facing { others, is_upward }))
    }

    /// Finds the cheapest single pin of the thinnest size, for a joint without room for two. Only
    /// the parts' outlines then show the rotation.
    fn find_single(
        &self,
        joint: &Joint,
        others: &[&Placement],
    ) -> Result<Option<Placement>, Cancelled> {
        let Some([_, size]) = size_pairs(self.order.request).pop() else {
            return Ok(None);
        };
        let mut found: Vec<Option<Priced>> = Vec::new();
        for face in &self.faces(joint, others) {
            let sites = self.sites(joint, face, &size)?.into_iter();
            let costs = sites.map(|site| (Cost::of(&[&site], &self.view), site.at));
            let cheapest = costs.min_by(|a, b| a.0.compare(&b.0));
            found.push(cheapest.map(|(cost, at)| (cost, face.placement(&[(at, size)], false))));
        }
        Ok(cheapest(found))
    }

    /// Finds the best patterns of two pins of these sizes.
    fn find_pattern_along(
        &self,
        joint: &Joint,
        face: &Face,
        others: &[&Placement],
        sizes: &[Size; 2],
    ) -> Result<Found<Priced>, CutError> {
        let sites = self.sites(joint, face, &sizes[0])?;
        let mut open = OpenPairs::new(
            &self.view,
            &sites,
            sizes[0].room_mm(self.order.request) / 2.0,
        );
        let mut found = Found {
            open: None,
            any: None,
            is_confused: false,
        };
        for SiteSet { sites: set, cost } in held_sets(face, &sites, sizes, &self.view) {
            let pattern = pattern_at(&sites, &set, sizes);
            if is_confused(&face.end_views(&pattern), others) {
                found.is_confused = true;
                continue;
            }
            let placed = || Some((cost, face.placement(&pattern, true)));
            found.any = found.any.or_else(placed);
            if open.leaves_open(&set)? {
                found.open = placed();
            }
            if found.open.is_some() || open.is_exhausted() {
                break;
            }
        }
        Ok(found)
    }

    /// Returns priced places of a joint where a boss of this size joins the wall and stays inside
    /// the outline.
    fn sites(&self, joint: &Joint, face: &Face, size: &Size) -> Result<Vec<Site>, Cancelled> {
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
        let is_place = |p: &Point2| {
            is_near(p)
                && !is_refused(p)
                && self.is_of_joint(joint, outline, p)
                && face.has_material(p, size)
        };
        let places = grid(outline).into_par_iter().map(|p| {
            request.watch.check()?;
            Ok(is_place(&p).then_some(p))
        });
        let places = places.collect::<Result<Vec<Option<Point2>>, Cancelled>>()?;
        let places: Vec<Point2> = places.into_iter().flatten().collect();
        let stride = places.len().div_ceil(PRICED_PLACES).max(1);
        let price_site = |&at: &Point2| -> Option<Site> {
            let axis = PinAxis {
                middle: chart.lift(plane, &at),
                along: face.along(),
            };
            let body = self.maker.body(joint, &axis, size)?;
            Some(Site {
                at,
                price: self.maker.price(&axis, size),
                hidden_ratios: self.view.hidden_by(&body),
                body,
            })
        };
        let sites = places.par_iter().step_by(stride).map(|at| {
            request.watch.check()?;
            Ok(price_site(at))
        });
        let sites = sites.collect::<Result<Vec<Option<Site>>, Cancelled>>()?;
        Ok(sites.into_iter().flatten().collect())
    }

    fn joint_name(&self, joint: &Joint) -> JointName {
        let cut = self.order.plan.cuts[joint.cut].id.clone();
        JointName {
            cut,
            parts: joint.parts(),
        }
    }

    /// Builds a pin's boss: a round or long bar around the pin. It reaches the outside in the cut,
    /// so that it stands in the wall. `None` if it has no volume.
    fn make_boss(&self, joint: &Joint, pin: &PinSite) -> Option<Boss> {
        let JointName { cut, parts } = self.joint_name(joint);
        let is_new = !self.has_material(self.hollow, joint, pin);
        let body = self.maker.body(joint, &PinAxis::of(pin), &Size::of(pin))?;
        Some(Boss {
            pin: PinSite { cut, ..pin.clone() },
            parts,
            body,
            is_new,
        })
    }
}
