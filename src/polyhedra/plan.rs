//! Several polyhedra: planes first, then a polyhedron on each side.

use rayon::prelude::*;

use super::base_plan::{BasePlan, Child, Split, connected};
use super::branch::{Branch, Leaf, Parted, most_apart, most_gainful, part_branch};
use super::connection::{ConnectorRequest, Joint, Pair};
use super::ground::Ground;
use super::inscribe::{Region, Request};
use super::neck::{NeckPart, ends_of_neck};
use super::polyhedron::Polyhedron;
use super::unjoined::{NoPlan, Unjoined};
use crate::base::verdict::Verdict;
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Aabb, Plane, Point, Vector};

/// Places of the first planes along each axis, as shares of the region's extent.
const PLACES: [f64; 3] = [0.35, 0.5, 0.65];
/// Step of the last places about the best ones, as a share of the extent.
const REFINEMENT: f64 = 0.07;
/// The least gain of volume by one more polyhedron.
const LEAST_GAIN: f64 = 0.05;
/// Starts on each side while planes are compared.
const SOUNDING_STARTS: usize = 2;
/// Planes that are tried in full.
const FINALISTS: usize = 3;

/// The number of polyhedra.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Count {
    /// As many as each raise the volume by 5 %, but no more than this.
    Auto(usize),
    /// This many, or fewer if no plane leaves room for one more on both sides.
    Exactly(usize),
}

/// The order for several polyhedra.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Several {
    /// Their number.
    pub count: Count,
    /// Their connections.
    pub connector: ConnectorRequest,
}

/// A model that was parted as often as was asked for and could be.
struct Divided {
    polyhedra: Vec<Polyhedron>,
    splits: Vec<Split>,
    /// The polyhedra for which there was room, but nothing that joins them.
    unjoined: Option<Unjoined>,
}

/// A place for a plane square to an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Place {
    axis: usize,
    /// The share of the extent below it.
    share: f64,
}

/// The search for planes.
struct Planner<'a> {
    ground: &'a Ground,
    request: &'a Request,
    connector: &'a ConnectorRequest,
    watch: &'a Watch,
}

/// Returns polyhedra on both sides of planes that part the model, or why there are none, or fewer
/// than asked for because nothing joins them.
///
/// Each side of a plane grows its own, with one face locked on the plane. Planes are square to the
/// axes of the model. Every polyhedron costs a search of its own and some trials of planes: two of
/// them took 21 to 29 s of processor time. A plane is taken only if connections join all polyhedra.
///
/// The same bytes on any number of threads.
pub fn grow_polyhedra(
    ground: &Ground,
    request: &Request,
    several: &Several,
    watch: &Watch,
) -> Result<Verdict<BasePlan, NoPlan>, Cancelled> {
    let whole = Region::new(ground, request, Vec::new());
    let Some(polyhedron) = whole.grow(whole.starts(), watch)? else {
        return Ok(Verdict::No(NoPlan::NoRoom(whole.no_room())));
    };
    let planner = Planner {
        ground,
        request,
        connector: &several.connector,
        watch,
    };
    let first = Leaf {
        locked: Vec::new(),
        polyhedron,
    };
    let divided = planner.divided(first, several.count)?;
    if let (Some(apart), Count::Exactly(_)) = (divided.unjoined, several.count) {
        let joined = divided.polyhedra.len();
        return Ok(Verdict::No(NoPlan::Unjoined { apart, joined }));
    }
    let (polyhedra, splits) = (divided.polyhedra, divided.splits);
    let plan = connected(ground, polyhedra, splits, &several.connector);
    Ok(Verdict::Found(plan))
}

impl Planner<'_> {
    /// Parts leaves while that is asked for or gains enough.
    fn divided(&self, first: Leaf, count: Count) -> Result<Divided, Cancelled> {
        let (most, least_gain) = match count {
            Count::Auto(most) => (most, LEAST_GAIN),
            Count::Exactly(most) => (most, f64::NEG_INFINITY),
        };
        let mut branches = vec![Branch::new(first)];
        let mut splits: Vec<Split> = Vec::new();
        while branches.len() < most {
            for branch in branches.iter_mut().filter(|branch| !branch.is_tried) {
                branch.parted = self.part(&branch.leaf)?;
                branch.is_tried = true;
            }
            let polyhedra: Vec<&Polyhedron> = branches.iter().map(Branch::polyhedron).collect();
            let total: f64 = polyhedra.iter().map(|one| one.volume_mm3()).sum();
            let Some(index) = most_gainful(&branches, least_gain * total) else {
                break;
            };
            let Some(parted) = branches[index].parted.take() else {
                break;
            };
            let mut next = splits.clone();
            add_split(&mut next, index, parted.plane, branches.len());
            let plan = self.with_parted(&branches, index, &parted, &next);
            let apart = plan.unjoined(self.ground, self.connector);
            if apart.is_some() {
                branches[index].parted = Some(parted);
                branches[index].apart = apart;
                continue;
            }
            splits = next;
            part_branch(&mut branches, index, parted.leaves);
        }
        let is_short = branches.len() < most;
        Ok(Divided {
            unjoined: most_apart(&branches).filter(|_| is_short),
            polyhedra: branches
                .into_iter()
                .map(|branch| branch.leaf.polyhedron)
                .collect(),
            splits,
        })
    }

    /// Returns the base when a branch is parted.
    fn with_parted(
        &self,
        branches: &[Branch],
        index: usize,
        parted: &Parted,
        splits: &[Split],
    ) -> BasePlan {
        let mut polyhedra: Vec<Polyhedron> = branches
            .iter()
            .map(|branch| branch.polyhedron().clone())
            .collect();
        polyhedra[index] = parted.leaves[0].polyhedron.clone();
        polyhedra.push(parted.leaves[1].polyhedron.clone());
        connected(self.ground, polyhedra, splits.to_vec(), self.connector)
    }

    /// Returns the best plane for a leaf with a polyhedron on both sides; `None` if none leaves
    /// room for two. Planes whose sides can be connected come first.
    fn part(&self, leaf: &Leaf) -> Result<Option<Parted>, Cancelled> {
        let Some(extent) = self.extent(&leaf.locked) else {
            return Ok(None);
        };
        let first: Vec<Place> = (0..3)
            .flat_map(|axis| PLACES.map(|share| Place { axis, share }))
            .collect();
        let mut sounded = self.sounded(leaf, &extent, &first)?;
        sounded.truncate(2);
        let near = sounded.iter().flat_map(|&(_, Place { axis, share })| {
            let shares = [share - REFINEMENT, share + REFINEMENT];
            shares.map(|share| Place { axis, share })
        });
        let near: Vec<Place> = near.collect();
        sounded.extend(self.sounded(leaf, &extent, &near)?);
        sounded.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut best: Option<Parted> = None;
        for &(_, place) in sounded.iter().take(FINALISTS) {
            if let Some(parted) = self.parted(leaf, plane_at(&extent, place))?
                && best.as_ref().is_none_or(|best| parted.rank() > best.rank())
            {
                best = Some(parted);
            }
        }
        Ok(best)
    }

    /// Returns the places with room on both sides and the volume that a quick growth reaches in
    /// both, largest first.
    fn sounded(
        &self,
        leaf: &Leaf,
        extent: &Aabb,
        places: &[Place],
    ) -> Result<Vec<(f64, Place)>, Cancelled> {
        let volumes: Result<Vec<f64>, Cancelled> = places
            .par_iter()
            .map(|&place| {
                let sides = self.sides(leaf, &plane_at(extent, place));
                let volume = |locked: Vec<Plane>| {
                    let region = Region::new(self.ground, self.request, locked);
                    region.sounded_mm3(SOUNDING_STARTS, self.watch)
                };
                let [below, above] = sides.map(volume);
                let (below, above) = (below?, above?);
                Ok(if below.min(above) > 0.0 {
                    below + above
                } else {
                    0.0
                })
            })
            .collect();
        let sounded = volumes?.into_iter().zip(places.iter().copied());
        let mut sounded: Vec<_> = sounded.filter(|(volume, _)| *volume > 0.0).collect();
        sounded.sort_by(|a, b| b.0.total_cmp(&a.0));
        Ok(sounded)
    }

    /// Parts a leaf by a plane; `None` if a side has no room. Where nothing joins both sides, they
    /// stay off the neck between them, if rods have room in it.
    fn parted(&self, leaf: &Leaf, plane: Plane) -> Result<Option<Parted>, Cancelled> {
        let parted = self.parted_at(leaf, plane, self.sides(leaf, &plane))?;
        if parted
            .as_ref()
            .is_some_and(|parted| parted.unjoined.is_none())
        {
            return Ok(parted);
        }
        let Some(ends) = self.ends_of_neck(leaf, &plane) else {
            return Ok(parted);
        };
        let sides = ends.map(|end| [leaf.locked.as_slice(), &[end]].concat());
        let off = self.parted_at(leaf, plane, sides)?;
        let is_joined = off.as_ref().is_some_and(|off| off.unjoined.is_none());
        Ok(if is_joined { off } else { parted })
    }

    /// Returns the planes that bound both sides of a leaf's neck at a plane, if rods have room.
    fn ends_of_neck(&self, leaf: &Leaf, plane: &Plane) -> Option<[Plane; 2]> {
        let part = NeckPart {
            ground: self.ground,
            locked: &leaf.locked,
            around: self.extent(&leaf.locked)?,
        };
        ends_of_neck(&part, plane, self.request.distance_mm, self.connector)
    }

    /// Parts a leaf by a plane, with a polyhedron below all planes of each side.
    fn parted_at(
        &self,
        leaf: &Leaf,
        plane: Plane,
        sides: [Vec<Plane>; 2],
    ) -> Result<Option<Parted>, Cancelled> {
        let mut leaves = Vec::new();
        for locked in sides {
            let region = Region::new(self.ground, self.request, locked);
            let Some(polyhedron) = region.grow(region.starts(), self.watch)? else {
                return Ok(None);
            };
            let locked = region.locked;
            leaves.push(Leaf { locked, polyhedron });
        }
        let Ok(leaves) = <[Leaf; 2]>::try_from(leaves) else {
            return Ok(None);
        };
        let pair = Pair {
            ground: self.ground,
            indices: [0, 1],
            polyhedra: [&leaves[0].polyhedron, &leaves[1].polyhedron],
            plane,
        };
        let joined = pair.connect(self.connector);
        let unjoined = joined.is_none().then(|| pair.unjoined(self.connector));
        let sum: f64 = leaves.iter().map(|leaf| leaf.polyhedron.volume_mm3()).sum();
        let gain_mm3 = sum - leaf.polyhedron.volume_mm3();
        Ok(Some(Parted {
            plane,
            leaves,
            gain_mm3,
            bears: joined.is_some_and(|of| of.joint == Joint::Bolted),
            unjoined,
        }))
    }

    /// Returns the planes that bound the leaf's sides below and above a plane.
    fn sides(&self, leaf: &Leaf, plane: &Plane) -> [Vec<Plane>; 2] {
        let half_mm = self.connector.gap_mm / 2.0;
        let below = Plane {
            offset_mm: plane.offset_mm - half_mm,
            ..*plane
        };
        let above = Plane {
            normal: -plane.normal,
            offset_mm: -plane.offset_mm - half_mm,
        };
        [below, above].map(|side| [leaf.locked.as_slice(), &[side]].concat())
    }

    /// Returns the box around the model's corners in a part; `None` if there are none.
    fn extent(&self, locked: &[Plane]) -> Option<Aabb> {
        let points = self.ground.obstacles().points().iter();
        let is_inside = |p: &&Point| locked.iter().all(|plane| plane.distance(p) <= 0.0);
        let extent = Aabb::of_points(points.filter(is_inside));
        (!extent.is_empty()).then_some(extent)
    }
}

/// Puts a new split in the place of a polyhedron; the one above it is new.
fn add_split(splits: &mut Vec<Split>, index: usize, plane: Plane, new: usize) {
    let here = splits.len();
    for split in splits.iter_mut() {
        for side in [&mut split.below, &mut split.above] {
            if *side == Child::Polyhedron(index) {
                *side = Child::Split(here);
            }
        }
    }
    splits.push(Split {
        plane,
        below: Child::Polyhedron(index),
        above: Child::Polyhedron(new),
    });
}

fn plane_at(extent: &Aabb, Place { axis, share }: Place) -> Plane {
    let offset_mm = extent.min[axis] + share * extent.size()[axis];
    Plane {
        normal: Vector::ith(axis, 1.0),
        offset_mm,
    }
}
