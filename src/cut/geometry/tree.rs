//! The planes of a plan, and where each of them cuts: a binary space partition (Fuchs, Kedem and
//! Naylor, "On visible surface generation by a priori tree structures", SIGGRAPH 1980).

use crate::{
    cut::{
        error::CutError,
        ids::CutId,
        side::{CutSide, Side},
    },
    geom::{Parting, Plane, Point},
    mesh::{Csg, TriMesh},
};

/// What of a closed mesh lies in the half-spaces within which a plane parts it, closed where they
/// end.
pub fn reached(parting: &Parting, mesh: &TriMesh) -> Result<TriMesh, CutError> {
    if parting.within.is_empty() {
        return Ok(mesh.clone());
    }
    let mut body = Csg::of_mesh(mesh)?;
    for (plane, is_above) in &parting.within {
        if body.is_empty() {
            break;
        }
        let (above, below) = body.split_by_plane(plane)?;
        body = if *is_above { above } else { below };
    }
    Ok(body.to_mesh()?)
}

/// The side of a cut on which alone another cuts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Limit {
    /// The cut whose side it is.
    pub(crate) cut: usize,
    pub(crate) is_above: bool,
}

impl Limit {
    /// The side in the ids of the planner.
    pub(crate) fn side(&self) -> CutSide {
        CutSide {
            cut: CutId::of(self.cut),
            side: Side::of(self.is_above),
        }
    }
}

/// Planes, each with the sides of others on which alone it cuts; without any it cuts everything.
#[derive(Debug, Clone, Default)]
pub(crate) struct CutTree {
    pub(crate) planes: Vec<Plane>,
    limits: Vec<Vec<Limit>>,
}

/// A body between cuts.
struct Cell {
    body: Csg,
    /// For every cut whether the cell lies above it; none where the cut does not act.
    sides: Vec<Option<bool>>,
}

impl CutTree {
    /// Planes that cut everything.
    pub(crate) fn everywhere(planes: &[Plane]) -> Self {
        Self {
            planes: planes.to_vec(),
            limits: vec![Vec::new(); planes.len()],
        }
    }

    /// Planes with their limits, and those of the cuts that they are kept to; none where a cut
    /// waits, be it through others, for itself, or is kept to both sides of another.
    pub(crate) fn new(planes: Vec<Plane>, limits: Vec<Vec<Limit>>) -> Option<Self> {
        let mut tree = Self { planes, limits };
        let order = tree.order();
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

    /// The same with a cut, and those kept to a side of it, kept to a side of another; none where
    /// it is kept to a side of that already, or that cut to a side of it.
    pub(crate) fn kept_to(&self, cut: usize, limit: Limit) -> Option<Self> {
        let mut limits = self.limits.clone();
        let is_new = limits[cut].iter().all(|known| known.cut != limit.cut);
        limits[cut].push(limit);
        Self::new(self.planes.clone(), limits).filter(|_| is_new)
    }

    /// The same with other planes in the place of its own.
    pub(crate) fn moved(&self, planes: Vec<Plane>) -> Self {
        Self {
            planes,
            limits: self.limits.clone(),
        }
    }

    /// Whether every cut goes through everything.
    pub(crate) fn is_everywhere(&self) -> bool {
        self.limits.iter().all(Vec::is_empty)
    }

    /// The sides to which a cut is kept, those that it is kept to through others with them.
    pub(crate) fn limits(&self, cut: usize) -> &[Limit] {
        &self.limits[cut]
    }

    /// The cuts as they are made.
    pub(crate) fn partings(&self) -> impl Iterator<Item = Parting> {
        (0..self.planes.len()).map(|cut| self.parting(cut))
    }

    /// A cut as it is made.
    pub(crate) fn parting(&self, cut: usize) -> Parting {
        let side = |limit: &Limit| (self.planes[limit.cut], limit.is_above);
        Parting {
            plane: self.planes[cut],
            within: self.limits[cut].iter().map(side).collect(),
        }
    }

    /// How many cuts are made before this one, where it is kept to sides of them: more than before
    /// any of these.
    pub(crate) fn depth(&self, cut: usize) -> usize {
        self.limits[cut].len()
    }

    /// Whether the plane of a cut would cut at a point of it.
    pub(crate) fn acts_at(&self, cut: usize, at: &Point) -> bool {
        let holds = |limit: &Limit| (self.planes[limit.cut].distance(at) > 0.0) == limit.is_above;
        self.limits[cut].iter().all(holds)
    }

    /// The cuts, each after those that it is kept to a side of; without those in a circle.
    fn order(&self) -> Vec<usize> {
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

    /// What a body is cut into: every cell may hold several pieces.
    pub(crate) fn cells(&self, body: &Csg) -> Result<Vec<Csg>, CutError> {
        let mut cells = vec![Cell {
            body: body.clone(),
            sides: vec![None; self.planes.len()],
        }];
        for cut in self.order() {
            let mut after = Vec::new();
            for cell in cells {
                if self.limits[cut]
                    .iter()
                    .all(|limit| cell.sides[limit.cut] == Some(limit.is_above))
                {
                    after.extend(self.halves(cell, cut)?);
                } else {
                    after.push(cell);
                }
            }
            cells = after;
        }
        Ok(cells.into_iter().map(|cell| cell.body).collect())
    }

    fn halves(&self, cell: Cell, cut: usize) -> Result<impl Iterator<Item = Cell>, CutError> {
        let (above, below) = cell.body.split_by_plane(&self.planes[cut])?;
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

    /// The planes x = 0 and y = 0 through a cube of 20 mm.
    fn quartered() -> (CutTree, Csg) {
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
    fn a_cut_kept_to_a_side_leaves_the_other_whole() {
        let (tree, body) = quartered();
        assert_eq!(tree.cells(&body).unwrap().len(), 4);
        let kept = tree.kept_to(1, above(0)).unwrap();
        let mut volumes: Vec<f64> = kept
            .cells(&body)
            .unwrap()
            .iter()
            .map(|cell| cell.to_mesh().unwrap().signed_volume_mm3())
            .collect();
        volumes.sort_by(f64::total_cmp);
        assert_eq!(
            volumes.iter().map(|v| v.round()).collect::<Vec<_>>(),
            [2000.0, 2000.0, 4000.0]
        );
        // The first may as well be kept to a side of the second, though it stands before it.
        assert_eq!(
            tree.kept_to(0, above(1))
                .unwrap()
                .cells(&body)
                .unwrap()
                .len(),
            3
        );
    }

    #[test]
    fn what_lies_beyond_the_first_of_several_sides_is_reached_by_nothing() {
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
            reached(&parting, beyond.mesh())
                .unwrap()
                .triangles()
                .is_empty()
        );
    }

    #[test]
    fn a_cut_kept_to_both_sides_of_another_through_a_third_is_none() {
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
    fn cuts_that_wait_for_each_other_are_none() {
        let (tree, _) = quartered();
        let kept = tree.kept_to(1, above(0)).unwrap();
        assert!(kept.kept_to(0, above(1)).is_none() && kept.kept_to(1, above(1)).is_none());
        assert!(
            kept.kept_to(
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
    fn a_cut_acts_where_those_act_that_it_is_kept_to() {
        let planes = [Vector::x(), Vector::y(), Vector::z()].map(|normal| Plane {
            normal,
            offset_mm: 0.0,
        });
        let tree = CutTree::everywhere(&planes)
            .kept_to(1, above(0))
            .unwrap()
            .kept_to(2, above(1))
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
        let reached = reached(&last, cuboid([-10.0; 3], [10.0; 3]).mesh()).unwrap();
        assert!((reached.signed_volume_mm3() - 2000.0).abs() < 1e-9);
    }
}
