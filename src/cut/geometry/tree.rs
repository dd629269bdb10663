//! The planes of a plan and the region in which each of them cuts: a binary space partition.
//!
//! Source: Fuchs, Kedem and Naylor, "On visible surface generation by a priori tree structures",
//! SIGGRAPH 1980.

use crate::{
    base::watch::Watch,
    cut::{
        error::CutError,
        ids::CutId,
        side::{CutSide, Side},
    },
    geom::{Parting, Plane, Point},
    mesh::{ClipError, Csg, TriMesh},
};

/// Returns the part of a closed mesh within the half-spaces to which a cut is limited, closed by
/// caps at their planes.
pub fn clip_to_limits(parting: &Parting, mesh: &TriMesh) -> Result<TriMesh, CutError> {
    if parting.within.is_empty() {
        return Ok(mesh.clone());
    }
    let mut body = mesh.clone();
    for (plane, is_above) in &parting.within {
        if body.is_empty() {
            break;
        }
        let (above, below) = body.split_by_plane(plane)?;
        body = if *is_above { above } else { below };
    }
    Ok(body)
}

/// A body that planes divide: exactly for the parts that are written, or fast for trials.
pub(crate) trait Divisible: Clone {
    /// Returns the parts above and below a plane.
    fn divide(&self, plane: &Plane) -> Result<(Self, Self), ClipError>;

    /// Returns true if nothing is left.
    fn is_empty(&self) -> bool;
}

impl Divisible for Csg {
    fn divide(&self, plane: &Plane) -> Result<(Self, Self), ClipError> {
        self.split_by_plane(plane)
    }

    fn is_empty(&self) -> bool {
        Self::is_empty(self)
    }
}

impl Divisible for TriMesh {
    fn divide(&self, plane: &Plane) -> Result<(Self, Self), ClipError> {
        self.split_by_plane(plane)
    }

    fn is_empty(&self) -> bool {
        Self::is_empty(self)
    }
}

/// A side of a cut to which another cut is limited.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Limit {
    /// The cut that limits.
    pub(crate) cut: usize,
    pub(crate) is_above: bool,
}

impl Limit {
    /// Returns the side, in the planner's ids.
    pub(crate) fn side(&self) -> CutSide {
        CutSide {
            cut: CutId::of(self.cut),
            side: Side::of(self.is_above),
        }
    }
}

/// Planes, each limited to sides of others; a plane without limits cuts everything.
#[derive(Debug, Clone, Default)]
pub(crate) struct CutTree {
    pub(crate) planes: Vec<Plane>,
    limits: Vec<Vec<Limit>>,
}

/// A body between cuts.
struct Cell<B> {
    body: B,
    /// For each cut, `true` if the cell lies above it; `None` if the cut does not act on the cell.
    sides: Vec<Option<bool>>,
}

impl CutTree {
    /// Returns planes that cut everything.
    pub(crate) fn everywhere(planes: &[Plane]) -> Self {
        Self {
            planes: planes.to_vec(),
            limits: vec![Vec::new(); planes.len()],
        }
    }

    /// Returns planes with their limits, each cut inheriting the limits of the cuts that limit it.
    /// `None` if limits form a circle, or limit a cut to both sides of another.
    pub(crate) fn new(planes: Vec<Plane>, limits: Vec<Vec<Limit>>) -> Option<Self> {
        let mut tree = Self { planes, limits };
        let order = tree.order_by_limits();
        if order.len() < tree.planes.len() {
            return None;
        }
        for cut in order {
            let inherited = tree.limits[cut]
                .iter()
                .flat_map(|limit| tree.limits[limit.cut].clone());
            let all: Vec<Limit> = tree.limits[cut].iter().copied().chain(inherited).collect();
            let mut own: Vec<Limit> = Vec::new();
            for limit in all {
                match own.iter().find(|known| known.cut == limit.cut) {
                    Some(known) if *known != limit => return None,
                    Some(_) => {}
                    None => own.push(limit),
                }
            }
            tree.limits[cut] = own;
        }
        Some(tree)
    }

    /// Returns the tree with one more limit on a cut, inherited by the cuts that it limits. `None`
    /// as in [`CutTree::new`], or if the cut is limited by that other one already.
    pub(crate) fn with_limit(&self, cut: usize, limit: Limit) -> Option<Self> {
        let mut limits = self.limits.clone();
        let is_new = limits[cut].iter().all(|known| known.cut != limit.cut);
        limits[cut].push(limit);
        Self::new(self.planes.clone(), limits).filter(|_| is_new)
    }

    /// Returns the tree with other planes in place of its own.
    pub(crate) fn with_planes(&self, planes: Vec<Plane>) -> Self {
        Self {
            planes,
            limits: self.limits.clone(),
        }
    }

    /// Returns whether every cut goes through everything.
    pub(crate) fn is_everywhere(&self) -> bool {
        self.limits.iter().all(Vec::is_empty)
    }

    /// Returns the sides to which a cut is limited, inherited ones included.
    pub(crate) fn limits(&self, cut: usize) -> &[Limit] {
        &self.limits[cut]
    }

    /// Returns the cuts, each with the half-spaces within which it is made.
    pub(crate) fn partings(&self) -> impl Iterator<Item = Parting> {
        (0..self.planes.len()).map(|cut| self.parting(cut))
    }

    /// Returns a cut with the half-spaces within which it is made.
    pub(crate) fn parting(&self, cut: usize) -> Parting {
        let side = |limit: &Limit| (self.planes[limit.cut], limit.is_above);
        Parting {
            plane: self.planes[cut],
            within: self.limits[cut].iter().map(side).collect(),
        }
    }

    /// Returns the number of cuts that limit this one, inherited ones included. For each of those
    /// it is smaller.
    pub(crate) fn depth(&self, cut: usize) -> usize {
        self.limits[cut].len()
    }

    /// Returns whether a cut reaches a point of its plane.
    pub(crate) fn acts_at(&self, cut: usize, at: &Point) -> bool {
        let holds = |limit: &Limit| (self.planes[limit.cut].distance(at) > 0.0) == limit.is_above;
        self.limits[cut].iter().all(holds)
    }

    /// Returns the cuts, each after those that limit it, without those in a circle.
    fn order_by_limits(&self) -> Vec<usize> {
        let mut order: Vec<usize> = Vec::new();
        for _ in 0..self.planes.len() {
            let is_next = |cut: &usize| {
                !order.contains(cut)
                    && self.limits[*cut]
                        .iter()
                        .all(|limit| order.contains(&limit.cut))
            };
            order.extend((0..self.planes.len()).find(is_next));
        }
        order
    }

    /// Returns the cells that a body is cut into; a cell may hold several pieces.
    pub(crate) fn cells<B: Divisible>(&self, body: &B, watch: &Watch) -> Result<Vec<B>, CutError> {
        let mut cells = vec![Cell {
            body: body.clone(),
            sides: vec![None; self.planes.len()],
        }];
        for cut in self.order_by_limits() {
            let mut after = Vec::new();
            for cell in cells {
                watch.check()?;
                if self.limits[cut]
                    .iter()
                    .all(|limit| cell.sides[limit.cut] == Some(limit.is_above))
                {
                    after.extend(self.split_cell(cell, cut)?);
                } else {
                    after.push(cell);
                }
            }
            cells = after;
        }
        Ok(cells.into_iter().map(|cell| cell.body).collect())
    }

    fn split_cell<B: Divisible>(
        &self,
        cell: Cell<B>,
        cut: usize,
    ) -> Result<impl Iterator<Item = Cell<B>>, CutError> {
        let (above, below) = cell.body.divide(&self.planes[cut])?;
        let half = move |(body, is_above)| {
            let mut sides = cell.sides.clone();
            sides[cut] = Some(is_above);
            Cell { body, sides }
        };
        Ok([(above, true), (below, false)]
            .into_iter()
            .filter(|(body, _)| !body.is_empty())
            .map(half))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{cut::scenes::cuboid, geom::Vector};

    /// Returns the planes x = 0 and y = 0 through a cube of 20 mm, and the cube.
    fn two_planes_and_a_cube() -> (CutTree, Csg) {
        let across = [Vector::x(), Vector::y()].map(|normal| Plane {
            normal,
            offset_mm: 0.0,
        });
        (
            CutTree::everywhere(&across),
            Csg::of_solid(&cuboid([-10.0; 3], [10.0; 3])).unwrap(),
        )
    }

    fn above(cut: usize) -> Limit {
        Limit {
            cut,
            is_above: true,
        }
    }

    #[test]
    fn a_limited_cut_leaves_the_other_side_whole() {
        let (tree, body) = two_planes_and_a_cube();
        assert_eq!(tree.cells(&body, &Watch::silent()).unwrap().len(), 4);
        let kept = tree.with_limit(1, above(0)).unwrap();
        let mut volumes: Vec<f64> = kept
            .cells(&body, &Watch::silent())
            .unwrap()
            .iter()
            .map(|cell| cell.to_mesh().unwrap().signed_volume_mm3())
            .collect();
        volumes.sort_by(f64::total_cmp);
        assert_eq!(
            volumes.iter().map(|v| v.round()).collect::<Vec<_>>(),
            [2000.0, 2000.0, 4000.0]
        );
        // The first may be limited to a side of the second, although it comes before it.
        assert_eq!(
            tree.with_limit(0, above(1))
                .unwrap()
                .cells(&body, &Watch::silent())
                .unwrap()
                .len(),
            3
        );
    }

    #[test]
    fn nothing_is_left_of_a_body_beyond_one_of_several_limits() {
        let [x, y] = [Vector::x(), Vector::y()].map(|normal| Plane {
            normal,
            offset_mm: 0.0,
        });
        let level = Plane {
            normal: Vector::z(),
            offset_mm: 0.0,
        };
        let parting = Parting {
            plane: level,
            within: vec![(x, true), (y, true)],
        };
        let beyond = cuboid([-10.0; 3], [-5.0, 10.0, 10.0]);
        assert!(
            clip_to_limits(&parting, beyond.mesh())
                .unwrap()
                .triangles()
                .is_empty()
        );
    }

    #[test]
    fn a_cut_limited_to_both_sides_of_another_through_a_third_is_refused() {
        let planes = [Vector::x(), Vector::y(), Vector::z()].map(|normal| Plane {
            normal,
            offset_mm: 0.0,
        });
        let below = Limit {
            cut: 0,
            is_above: false,
        };
        assert!(
            CutTree::new(
                planes.to_vec(),
                vec![vec![], vec![above(0)], vec![above(1), below]]
            )
            .is_none()
        );
        let chain = CutTree::new(
            planes.to_vec(),
            vec![vec![], vec![above(0)], vec![above(1)]],
        )
        .unwrap();
        assert_eq!(chain.limits(2), [above(1), above(0)]);
        assert_eq!([0, 1, 2].map(|cut| chain.depth(cut)), [0, 1, 2]);
    }

    #[test]
    fn cuts_that_limit_each_other_are_refused() {
        let (tree, _) = two_planes_and_a_cube();
        let kept = tree.with_limit(1, above(0)).unwrap();
        assert!(kept.with_limit(0, above(1)).is_none() && kept.with_limit(1, above(1)).is_none());
        assert!(
            kept.with_limit(
                1,
                Limit {
                    cut: 0,
                    is_above: false
                }
            )
            .is_none(),
            "both sides are none"
        );
        assert_eq!((kept.depth(0), kept.depth(1)), (0, 1));
    }

    #[test]
    fn a_cut_acts_only_where_the_cuts_that_limit_it_act() {
        let planes = [Vector::x(), Vector::y(), Vector::z()].map(|normal| Plane {
            normal,
            offset_mm: 0.0,
        });
        let tree = CutTree::everywhere(&planes)
            .with_limit(1, above(0))
            .unwrap()
            .with_limit(2, above(1))
            .unwrap();
        let acts = |x: f64, y: f64| tree.acts_at(2, &Point::new(x, y, 0.0));
        assert!(acts(1.0, 1.0) && !acts(1.0, -1.0));
        assert!(
            !acts(-1.0, 1.0),
            "there the second does not cut, so nothing lies above it"
        );
        assert!(tree.acts_at(0, &Point::new(0.0, -5.0, 5.0)));
        let last = tree.partings().last().unwrap();
        assert_eq!(last.within.len(), 2);
        assert!(
            last.acts_at(&Point::new(1.0, 1.0, 0.0)) && !last.acts_at(&Point::new(-1.0, 1.0, 0.0))
        );
        let reached = clip_to_limits(&last, cuboid([-10.0; 3], [10.0; 3]).mesh()).unwrap();
        assert!((reached.signed_volume_mm3() - 2000.0).abs() < 1e-9);
    }
}
