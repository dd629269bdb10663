//! An adaptive octree over the columns: large cells deep inside, small ones at the boundary and at
//! a void's surface.

use std::ops::Range;

use super::cells::Cells;
use super::choice::Choice;
use super::columns::Columns;
use super::emptied::{Emptied, Piece};
use super::grid::Grid;
use super::leaf::Leaf;
use super::octree_neighbours;
use crate::geom::Quadric;
use crate::mass::Moments;

/// Share of its box above which a leaf counts as not cut by the boundary. Rounding alone makes it
/// less than 1; with a smaller ratio, cut leaves would pass as whole ones.
const WHOLE_RATIO: f64 = 1.0 - 1e-9;

/// Levels at which an octree starts. Level n has 2ⁿ cells along the longest side.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Levels {
    /// Level of leaves deep inside. Below 4 there are too few to begin with; above 7 nothing is
    /// saved.
    pub inner: u32,
    /// Level of leaves that the boundary of the region cuts.
    pub boundary: u32,
}

/// The octree of Bächer, Whiting, Bickel and Sorkine-Hornung, "Spin-It", 2014, §5: of every leaf a
/// share β is emptied.
///
/// A leaf of the finest level is one column wide, so the pitch of the columns determines that
/// level. With 2⁹ columns along the longest side it is level 9. A leaf that the boundary cuts holds
/// exactly the part of the region inside it.
#[derive(Debug, Clone)]
pub struct Octree<'a> {
    grid: Grid<'a>,
    levels: Levels,
    leaves: Vec<Leaf>,
    cells: Cells,
    neighbours: Vec<[u32; 2]>,
}

impl<'a> Octree<'a> {
    /// Returns the octree over the columns, refined at the boundary alone.
    pub fn of(columns: &'a Columns, levels: Levels) -> Self {
        let grid = Grid::of(columns);
        let mut leaves = Vec::new();
        let mut open = vec![Leaf::root(grid.finest_level())];
        while let Some(leaf) = open.pop() {
            let volume = grid.volume_in(&leaf);
            let wanted = if volume < WHOLE_RATIO * grid.box_volume_mm3(&leaf) {
                levels.boundary
            } else {
                levels.inner
            };
            if volume > 0.0 && leaf.level() < wanted.max(levels.inner).min(grid.finest_level()) {
                open.extend(leaf.children().into_iter().rev());
            } else if volume > 0.0 {
                leaves.push(leaf);
            }
        }
        Self::with_leaves(grid, levels, leaves)
    }

    fn with_leaves(grid: Grid<'a>, levels: Levels, leaves: Vec<Leaf>) -> Self {
        let cells = Cells::new(leaves.iter().map(|leaf| grid.moments_in(leaf)).collect());
        let neighbours = octree_neighbours::pairs(&leaves);
        Self {
            grid,
            levels,
            leaves,
            cells,
            neighbours,
        }
    }

    /// Returns the level whose leaves are one column wide.
    pub fn finest_level(&self) -> u32 {
        self.grid.finest_level()
    }

    /// Splits fractional leaves, merges siblings that agree on 0 or 1, and returns the octree with
    /// its shares. `None` if no leaf is left to split.
    ///
    /// Shares within `tolerance` of 0 or 1 count as 0 or 1.
    pub fn refine(&self, x: &[f64], tolerance: f64) -> Option<(Self, Vec<f64>)> {
        let is_fractional = |share: f64| share > tolerance && share < 1.0 - tolerance;
        let splits =
            |leaf: &Leaf, share| is_fractional(share) && leaf.level() < self.finest_level();
        if !self
            .leaves
            .iter()
            .zip(x)
            .any(|(leaf, &share)| splits(leaf, share))
        {
            return None;
        }
        let mut leaves = Vec::with_capacity(self.leaves.len());
        let mut first = 0;
        while first < self.leaves.len() {
            let family = self.family(first);
            let merged = self.merge_family(&x[family.clone()], first, tolerance);
            if let Some(parent) = merged {
                leaves.push(parent);
                first = family.end;
                continue;
            }
            let (leaf, share) = (self.leaves[first], x[first]);
            if splits(&leaf, share) {
                let children = leaf
                    .children()
                    .into_iter()
                    .filter(|child| self.grid.volume_in(child) > 0.0);
                leaves.extend(children.map(|child| (child, share)));
            } else {
                leaves.push((leaf, share));
            }
            first += 1;
        }
        let (leaves, shares) = leaves.into_iter().unzip();
        Some((
            Self::with_leaves(self.grid.clone(), self.levels, leaves),
            shares,
        ))
    }

    /// Returns the leaves that fill one parent, if `first` is the first of them; otherwise only
    /// that leaf.
    fn family(&self, first: usize) -> Range<usize> {
        let leaf = &self.leaves[first];
        let Some(parent) = leaf.parent() else {
            return first..first + 1;
        };
        let begins = first == 0 || !parent.contains(&self.leaves[first - 1]);
        let rest = self.leaves[first..]
            .iter()
            .take_while(|other| parent.contains(other));
        let (count, flat) = rest.fold((0, true), |(count, flat), other| {
            (count + 1, flat && other.level() == leaf.level())
        });
        if begins && flat {
            first..first + count
        } else {
            first..first + 1
        }
    }

    /// Returns the parent of a family that agrees on 0 or on 1, with that share.
    fn merge_family(&self, shares: &[f64], first: usize, tolerance: f64) -> Option<(Leaf, f64)> {
        let leaf = &self.leaves[first];
        let parent = leaf
            .parent()
            .filter(|_| shares.len() > 1 && leaf.level() > self.levels.inner)?;
        let agree = |to: f64| shares.iter().all(|share| (share - to).abs() <= tolerance);
        [0.0, 1.0]
            .into_iter()
            .find(|&to| agree(to))
            .map(|to| (parent, to))
    }
}

impl Choice for Octree<'_> {
    fn weights(&self) -> &[f64] {
        self.cells.weights()
    }

    fn nothing(&self) -> Vec<f64> {
        vec![0.0; self.leaves.len()]
    }

    fn moments(&self, x: &[f64]) -> Moments {
        self.cells.moments(x)
    }

    fn derivative(&self, _: &[f64], quadric: &Quadric, out: &mut [f64]) {
        self.cells.derivative(quadric, out);
    }

    fn emptied(&self, x: &[f64]) -> Emptied {
        let mut pieces = vec![Vec::new(); self.grid.columns().len()];
        for (leaf, &share) in self.leaves.iter().zip(x) {
            self.grid.visit(leaf, |column, [bottom_mm, top_mm]| {
                pieces[column].push(Piece {
                    bottom_mm,
                    top_mm,
                    share,
                });
            });
        }
        Emptied::of_columns(pieces.into_iter())
    }

    fn neighbours(&self) -> &[[u32; 2]] {
        &self.neighbours
    }
}

#[cfg(test)]
mod tests {
    use super::super::choice::testing;
    use super::*;

    const COARSE: Levels = Levels {
        inner: 1,
        boundary: 2,
    };

    /// Returns a cube of 16 mm in columns of 1 mm.
    fn cube() -> Columns {
        let mut columns = Columns {
            pitch_mm: [1.0, 1.0],
            starts: vec![0],
            ..Columns::default()
        };
        for cell in 0..256 {
            columns
                .centers
                .push([f64::from(cell % 16), f64::from(cell / 16)]);
            columns.intervals.push([2.0, 18.0]);
            columns.starts.push(columns.intervals.len() as u32);
        }
        columns
    }

    #[test]
    fn leaves_have_the_moments_of_their_pieces_and_the_slopes_of_differences() {
        let columns = testing::uneven_columns();
        testing::check_choice(&Octree::of(&columns, COARSE), &columns);
    }

    #[test]
    fn all_leaves_together_are_the_columns_before_and_after_splitting() {
        let columns = testing::uneven_columns();
        let octree = Octree::of(&columns, COARSE);
        let (finer, shares) = octree
            .refine(&testing::some_numbers(octree.count()), 1e-3)
            .unwrap();
        assert!(finer.count() > octree.count() && shares.len() == finer.count());
        for octree in [octree, finer] {
            let all = octree.moments(&vec![1.0; octree.count()]);
            for (got, want) in all.0.iter().zip(columns.moments().0) {
                assert!((got - want).abs() < 1e-10 * all.0[0]);
            }
        }
    }

    #[test]
    fn splitting_alone_does_not_change_the_void() {
        let columns = testing::uneven_columns();
        let octree = Octree::of(&columns, COARSE);
        let x = testing::some_numbers(octree.count());
        let (finer, shares) = octree.refine(&x, 1e-3).unwrap();
        assert!(
            octree
                .emptied(&x)
                .difference_mm3(&finer.emptied(&shares), &columns)
                < 1e-9
        );
    }

    #[test]
    fn a_cube_of_whole_cells_needs_no_fine_leaves() {
        let columns = cube();
        let octree = Octree::of(
            &columns,
            Levels {
                inner: 2,
                boundary: 4,
            },
        );
        assert_eq!((octree.finest_level(), octree.count()), (4, 64));
        // Each of the three directions has 3 · 16 pairs inside.
        assert_eq!(octree.neighbours().len(), 144);
    }

    #[test]
    fn one_fractional_leaf_is_split_and_the_others_merge_back() {
        let columns = cube();
        let octree = Octree::of(
            &columns,
            Levels {
                inner: 1,
                boundary: 4,
            },
        );
        assert_eq!(octree.count(), 8);
        let mut x = vec![1.0; 8];
        x[3] = 0.4;
        let (finer, shares) = octree.refine(&x, 1e-3).unwrap();
        assert_eq!(finer.count(), 15);
        // The split leaf lies at a corner. It has 3 · 4 pairs inside, and 4 on each of three faces
        // with one large neighbour. The other leaves have 9.
        assert_eq!(finer.neighbours().len(), 12 + 12 + 9);
        let mut shares: Vec<f64> = shares.iter().map(|_| 0.0).collect();
        shares[0] = 0.5;
        let (again, _) = finer.refine(&shares, 1e-3).unwrap();
        // The first leaf is split into eight, and the eight children are merged again.
        assert_eq!(again.count(), 8 + 7);
        assert!(octree.refine(&[0.0; 8], 1e-3).is_none());
    }
}
