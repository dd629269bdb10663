//! The parts of a model in the making: each with its polyhedron, and the best plane to part it.

use super::polyhedron::Polyhedron;
use super::unjoined::Unjoined;
use crate::geom::Plane;

/// One side of a plane, and its polyhedron.
#[derive(Debug, Clone)]
pub(super) struct Leaf {
    pub locked: Vec<Plane>,
    pub polyhedron: Polyhedron,
}

/// A leaf, and the best way to part it as far as one was looked for.
pub(super) struct Branch {
    pub leaf: Leaf,
    pub parted: Option<Parted>,
    pub is_tried: bool,
    /// The polyhedra that would stay apart if it were parted beside the other branches as they are.
    pub apart: Option<Unjoined>,
}

impl Branch {
    pub(super) fn new(leaf: Leaf) -> Self {
        Self {
            leaf,
            parted: None,
            is_tried: false,
            apart: None,
        }
    }

    /// Returns the polyhedra that would stay apart if it were parted; `last` is the index of the
    /// new one.
    fn unjoined(&self, index: usize, last: usize) -> Option<Unjoined> {
        let alone = self.parted.as_ref().and_then(|parted| parted.unjoined);
        let alone = alone.map(|apart| Unjoined {
            polyhedra: [index, last],
            ..apart
        });
        alone.or(self.apart)
    }

    pub(super) fn polyhedron(&self) -> &Polyhedron {
        &self.leaf.polyhedron
    }
}

/// Returns the branch that gains most by being parted, if it gains more than the least.
pub(super) fn most_gainful(branches: &[Branch], least_mm3: f64) -> Option<usize> {
    let last = branches.len();
    let is_joined = |index: usize| branches[index].unjoined(index, last).is_none();
    let joined = gains(branches).filter(|(index, _)| is_joined(*index));
    let enough = joined
        .map(|(index, parted)| (index, parted.gain_mm3))
        .filter(|(_, gain)| *gain > least_mm3);
    let best = enough.reduce(|a, b| if b.1 > a.1 { b } else { a });
    best.map(|(index, _)| index)
}

/// Returns the branches for which a plane is known, with it.
fn gains(branches: &[Branch]) -> impl Iterator<Item = (usize, &Parted)> {
    let all = branches.iter().enumerate();
    all.filter_map(|(index, branch)| Some((index, branch.parted.as_ref()?)))
}

/// A leaf parted by a plane.
pub(super) struct Parted {
    pub plane: Plane,
    pub leaves: [Leaf; 2],
    pub gain_mm3: f64,
    /// True if panels of both bear on each other.
    pub bears: bool,
    /// Both sides, if nothing joins them.
    pub unjoined: Option<Unjoined>,
}

impl Parted {
    /// Returns what makes one plane better than another: first of all, both sides are joined. Bolts
    /// come before rods.
    pub(super) fn rank(&self) -> (bool, bool, f64) {
        (self.unjoined.is_none(), self.bears, self.gain_mm3)
    }
}

/// Puts both sides of a plane in the place of a branch; the one above it is new. What stayed apart
/// beside the branches before is tried again beside these.
pub(super) fn part_branch(branches: &mut Vec<Branch>, index: usize, [below, above]: [Leaf; 2]) {
    branches[index] = Branch::new(below);
    branches.push(Branch::new(above));
    for branch in branches {
        branch.apart = None;
    }
}

/// Returns the polyhedra that stay apart by the plane that would gain most, of those that leave
/// some apart.
pub(super) fn most_apart(branches: &[Branch]) -> Option<Unjoined> {
    let last = branches.len();
    let apart = gains(branches).filter_map(|(index, parted)| {
        let apart = branches[index].unjoined(index, last)?;
        Some((parted.gain_mm3, apart))
    });
    let best = apart.reduce(|a, b| if b.0 > a.0 { b } else { a });
    best.map(|(_, apart)| apart)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::watch::Watch;
    use crate::geom::{Point, Vector};
    use crate::mesh::{Solid, primitives};
    use crate::polyhedra::ground::Ground;
    use crate::polyhedra::inscribe::{Region, Request};
    use crate::polyhedra::limits::Limits;

    /// Returns a block of 10 mm, and a leaf with a polyhedron in it.
    fn leaf() -> Leaf {
        let block = primitives::cuboid(&Point::origin(), &Point::new(10.0, 10.0, 10.0));
        let ground = Ground::new(&Solid::new(block).unwrap()).unwrap();
        let request = Request::new(1.0, Limits::NONE);
        let whole = Region::new(&ground, &request, Vec::new());
        let grown = whole.grow(whole.starts(), &Watch::silent()).unwrap();
        Leaf {
            locked: Vec::new(),
            polyhedron: grown.unwrap(),
        }
    }

    fn apart(polyhedra: [usize; 2]) -> Unjoined {
        Unjoined {
            polyhedra,
            plane: Plane {
                normal: Vector::x(),
                offset_mm: 5.0,
            },
            disc_mm: 2.0,
            way_mm: None,
        }
    }

    fn branch(leaf: &Leaf, gain_mm3: f64, unjoined: Option<Unjoined>) -> Branch {
        let parted = Parted {
            plane: apart([0, 1]).plane,
            leaves: [leaf.clone(), leaf.clone()],
            gain_mm3,
            bears: false,
            unjoined,
        };
        Branch {
            parted: Some(parted),
            ..Branch::new(leaf.clone())
        }
    }

    #[test]
    fn what_stays_apart_is_told_by_the_polyhedra_that_are_there_at_the_end() {
        let leaf = leaf();
        let mut branches = vec![
            branch(&leaf, 2.0, None),
            branch(&leaf, 9.0, Some(apart([0, 1]))),
            branch(&leaf, 5.0, None),
        ];
        // What nothing joins is told with the number that the new polyhedron would get.
        assert_eq!(most_apart(&branches), Some(apart([1, 3])));
        // A branch that stays apart from others is not taken, and its gain is less than that.
        branches[2].apart = Some(apart([0, 3]));
        assert_eq!(most_gainful(&branches, 0.0), Some(0));
        assert_eq!(most_apart(&branches), Some(apart([1, 3])));
        branches[1] = Branch::new(leaf.clone());
        assert_eq!(most_apart(&branches), Some(apart([0, 3])));
        // Beside one more branch it is tried again.
        part_branch(&mut branches, 0, [leaf.clone(), leaf]);
        assert_eq!(most_apart(&branches), None);
        assert_eq!(most_gainful(&branches, 0.0), Some(2));
    }
}
