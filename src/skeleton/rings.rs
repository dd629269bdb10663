//! The rings of a skeleton, and the links to cut so that none is left.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::tree::Skeleton;

/// A ring of nodes, and the link to cut.
#[derive(Debug, Clone, PartialEq)]
pub struct Ring {
    /// The indices of its nodes, in their order round it.
    pub nodes: Vec<usize>,
    /// The link that is farthest from the root.
    pub cut: [usize; 2],
}

/// A node that waits to be reached over a link.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Waiting {
    way_mm: f64,
    node: usize,
    from: usize,
}

impl Eq for Waiting {}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Waiting {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        let ways = self.way_mm.total_cmp(&other.way_mm);
        ways.then((self.node, self.from).cmp(&(other.node, other.from)))
    }
}

impl Skeleton {
    /// Returns the rings that are left by the links in [`Skeleton::open`]; cutting the link of each
    /// leaves a tree. Without rings it is one.
    pub fn rings(&self) -> Vec<Ring> {
        let parents = self.parents();
        let is_tree = |[a, b]: [usize; 2]| parents[a] == Some(b) || parents[b] == Some(a);
        let left = self
            .links()
            .filter(|link| !self.is_open(*link) && !is_tree(*link));
        left.map(|cut| self.ring(cut, &parents)).collect()
    }

    /// Returns the line for a skeleton file that cuts all rings; `None` if there are none.
    pub fn open_line(&self) -> Option<String> {
        let rings = self.rings();
        let cuts = rings.iter().map(|ring| ring.cut);
        let links: Vec<String> = self
            .open
            .iter()
            .copied()
            .chain(cuts)
            .map(|link| {
                let [a, b] = link.map(|node| self.nodes[node].id);
                format!("[{a}, {b}]")
            })
            .collect();
        (!rings.is_empty()).then(|| format!("open = [{}]", links.join(", ")))
    }

    /// Returns true if a link is cut.
    pub fn is_open(&self, [a, b]: [usize; 2]) -> bool {
        self.open
            .iter()
            .any(|open| *open == [a, b] || *open == [b, a])
    }

    /// Tells of every node if a way leads to it from the root over links that are not cut.
    pub fn reached(&self) -> Vec<bool> {
        let parents = self.parents();
        let is_reached =
            |(node, parent): (usize, &Option<usize>)| parent.is_some() || node == self.root;
        parents.iter().enumerate().map(is_reached).collect()
    }

    /// Returns the node before each on its shortest way from the root; `None` for the root, and for
    /// nodes without a way.
    pub fn parents(&self) -> Vec<Option<usize>> {
        let links = self.linked();
        let mut parents = vec![None; self.nodes.len()];
        let mut is_done = vec![false; self.nodes.len()];
        let mut queue = BinaryHeap::from([Reverse(Waiting {
            way_mm: 0.0,
            node: self.root,
            from: self.root,
        })]);
        while let Some(Reverse(next)) = queue.pop() {
            if std::mem::replace(&mut is_done[next.node], true) {
                continue;
            }
            parents[next.node] = (next.node != self.root).then_some(next.from);
            for &node in links[next.node].iter().filter(|node| !is_done[**node]) {
                let step_mm = (self.nodes[node].at - self.nodes[next.node].at).norm();
                queue.push(Reverse(Waiting {
                    way_mm: next.way_mm + step_mm,
                    node,
                    from: next.node,
                }));
            }
        }
        parents
    }

    /// Returns the neighbours of every node over links that are not cut.
    pub(super) fn linked(&self) -> Vec<Vec<usize>> {
        let mut linked = vec![Vec::new(); self.nodes.len()];
        for [a, b] in self.links().filter(|link| !self.is_open(*link)) {
            linked[a].push(b);
            linked[b].push(a);
        }
        linked
    }

    /// Returns the ring that a link closes in the tree of shortest ways.
    fn ring(&self, cut: [usize; 2], parents: &[Option<usize>]) -> Ring {
        let way = |node: usize| {
            std::iter::successors(Some(node), |node| parents[*node]).collect::<Vec<_>>()
        };
        let [mut one, mut other] = cut.map(way);
        let mut meeting = None;
        while let (Some(a), Some(b)) = (one.last(), other.last())
            && a == b
        {
            meeting = Some(*a);
            one.pop();
            other.pop();
        }
        let nodes = one
            .into_iter()
            .chain(meeting)
            .chain(other.into_iter().rev());
        Ring {
            nodes: nodes.collect(),
            cut,
        }
    }
}
