//! Skeletons of lines that branch: every node has the same ball, for lines are not thick.

use super::error::SkeletonError;
use super::tree::{Branch, Node, Skeleton};
use crate::geom::Point;
use crate::mesh::union_find::UnionFind;

impl Skeleton {
    /// Returns the skeleton of lines between points (mm), with a ball of one radius (mm) at each.
    /// It grows from the point in which most lines meet, the first of them in the file.
    ///
    /// # Errors
    /// The lines are several pieces, or none of them branches or ends.
    pub fn of_lines(
        points: &[Point],
        links: &[[usize; 2]],
        radius_mm: f64,
    ) -> Result<Self, SkeletonError> {
        let mut meets = vec![Vec::new(); points.len()];
        for [a, b] in links.iter().copied().filter(|[a, b]| a != b) {
            meets[a].push(b);
            meets[b].push(a);
        }
        for ends in &mut meets {
            ends.sort_unstable();
            ends.dedup();
        }
        check_pieces(&meets)?;
        let number: Vec<usize> = used(&meets).collect();
        let index = |point: usize| number.partition_point(|used| *used < point);
        let nodes = number.iter().zip(1..).map(|(point, id)| Node {
            id,
            at: points[*point],
            radius_mm,
        });
        let branches = branches(&meets).into_iter().map(|run| Branch {
            nodes: run.into_iter().map(index).collect(),
            solid: None,
        });
        let most = meets.iter().map(Vec::len).max().unwrap_or_default();
        let root = meets.iter().position(|ends| ends.len() == most);
        Ok(Self {
            nodes: nodes.collect(),
            branches: branches.collect(),
            root: index(root.unwrap_or_default()),
            open: Vec::new(),
        })
    }
}

/// Returns the points in which a line ends.
fn used(meets: &[Vec<usize>]) -> impl Iterator<Item = usize> {
    (0..meets.len()).filter(|point| !meets[*point].is_empty())
}

fn check_pieces(meets: &[Vec<usize>]) -> Result<(), SkeletonError> {
    let mut joined = UnionFind::new(meets.len());
    for (point, ends) in meets.iter().enumerate() {
        for end in ends {
            joined.merge(point as u32, *end as u32);
        }
    }
    let labels = joined.labels().0;
    let mut pieces: Vec<u32> = used(meets).map(|point| labels[point]).collect();
    pieces.sort_unstable();
    pieces.dedup();
    let has_end = meets.iter().any(|ends| ends.len() == 1 || ends.len() > 2);
    if pieces.len() == 1 && has_end {
        return Ok(());
    }
    Err(SkeletonError::NotOneLine {
        pieces: pieces.len(),
    })
}

/// Returns the runs of points between those in which one line ends or several meet.
fn branches(meets: &[Vec<usize>]) -> Vec<Vec<usize>> {
    let is_end = |point: usize| meets[point].len() != 2;
    let ends = used(meets).filter(|point| is_end(*point));
    let starts = ends.flat_map(|from| meets[from].iter().map(move |next| [from, *next]));
    let runs = starts.map(|[from, next]| {
        let mut run = vec![from, next];
        while let [.., before, here] = run[..] {
            let onward = meets[here].iter().find(|point| **point != before);
            match onward {
                Some(onward) if !is_end(here) => run.push(*onward),
                _ => break,
            }
        }
        run
    });
    // Every run is found from both of its ends.
    let is_first = |run: &Vec<usize>| {
        let back: Vec<usize> = run.iter().rev().copied().collect();
        *run <= back
    };
    runs.filter(is_first).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_that_branch_are_runs_between_ends_and_junctures() {
        let points: Vec<Point> = (0..6).map(|i| Point::new(f64::from(i), 0.0, 0.0)).collect();
        let links = [[0, 1], [1, 2], [2, 4], [2, 5]];
        let skeleton = Skeleton::of_lines(&points, &links, 7.0).unwrap();
        // Point 3 is on no line.
        assert_eq!(skeleton.nodes.len(), 5);
        let runs: Vec<_> = skeleton.branches.iter().map(|b| b.nodes.clone()).collect();
        assert_eq!(runs, [vec![0, 1, 2], vec![2, 3], vec![2, 4]]);
        assert_eq!(skeleton.root, 2);
        let two = Skeleton::of_lines(&points, &[[0, 1], [2, 3]], 7.0);
        assert_eq!(two, Err(SkeletonError::NotOneLine { pieces: 2 }));
        assert!(Skeleton::of_lines(&points, &[[0, 1], [1, 2], [2, 0]], 7.0).is_err());
    }
}
