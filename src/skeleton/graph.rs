//! Nodes in space and the links between them, and the branches that they form.

use std::collections::BTreeSet;

use crate::geom::Point;

/// Nodes with links. Nodes keep their numbers; removed ones have no links and are dead.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Graph {
    /// The place of each node, mm.
    pub at: Vec<Point>,
    links: Vec<BTreeSet<usize>>,
    is_dead: Vec<bool>,
}

/// A path between two nodes that are a tip or a juncture, or round a ring back to its start.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Path {
    /// The nodes, ends included. Of a ring, the first node comes again at the end.
    pub nodes: Vec<usize>,
}

impl Path {
    /// Returns both ends.
    pub fn ends(&self) -> [usize; 2] {
        [self.nodes[0], self.nodes[self.nodes.len() - 1]]
    }

    /// Returns the nodes between the ends.
    pub fn inner(&self) -> &[usize] {
        &self.nodes[1..self.nodes.len() - 1]
    }
}

impl Graph {
    /// Adds a node and returns its number.
    pub fn add(&mut self, at: Point) -> usize {
        self.at.push(at);
        self.links.push(BTreeSet::new());
        self.is_dead.push(false);
        self.at.len() - 1
    }

    /// Links two nodes.
    pub fn link(&mut self, [a, b]: [usize; 2]) {
        self.links[a].insert(b);
        self.links[b].insert(a);
    }

    /// Removes a node and its links.
    pub fn remove(&mut self, node: usize) {
        for other in std::mem::take(&mut self.links[node]) {
            self.links[other].remove(&node);
        }
        self.is_dead[node] = true;
    }

    /// Returns the living nodes, in order.
    pub fn nodes(&self) -> impl Iterator<Item = usize> {
        (0..self.at.len()).filter(|node| !self.is_dead[*node])
    }

    /// Returns the nodes linked to a node.
    pub fn linked(&self, node: usize) -> impl Iterator<Item = usize> {
        self.links[node].iter().copied()
    }

    /// Returns true if two nodes are linked.
    pub fn is_linked(&self, [a, b]: [usize; 2]) -> bool {
        self.links[a].contains(&b)
    }

    /// Returns the number of links of a node: 1 at a tip, 3 or more at a juncture.
    pub fn degree(&self, node: usize) -> usize {
        self.links[node].len()
    }

    /// Returns the length of a path, mm.
    pub fn length_mm(&self, path: &Path) -> f64 {
        let steps = path.nodes.windows(2);
        steps
            .map(|step| (self.at[step[1]] - self.at[step[0]]).norm())
            .sum()
    }

    /// Returns all branches: the paths between tips and junctures, then the rings without any.
    pub fn paths(&self) -> Vec<Path> {
        let mut paths: Vec<Path> = Vec::new();
        let mut seen = vec![false; self.at.len()];
        for start in self.nodes().filter(|node| self.degree(*node) != 2) {
            seen[start] = true;
            for next in self.linked(start) {
                let path = self.walk([start, next]);
                path.inner().iter().for_each(|node| seen[*node] = true);
                if is_first_way(&path) {
                    paths.push(path);
                }
            }
        }
        for start in self.nodes() {
            if !seen[start]
                && let Some(next) = self.linked(start).next()
            {
                let ring = self.walk([start, next]);
                ring.nodes.iter().for_each(|node| seen[*node] = true);
                paths.push(ring);
            }
        }
        paths
    }

    /// Walks along nodes with two links, until a tip, a juncture or the start.
    fn walk(&self, [start, next]: [usize; 2]) -> Path {
        let mut nodes = vec![start, next];
        while nodes[nodes.len() - 1] != start && self.degree(nodes[nodes.len() - 1]) == 2 {
            let [before, here] = [nodes[nodes.len() - 2], nodes[nodes.len() - 1]];
            let Some(on) = self.linked(here).find(|node| *node != before) else {
                break;
            };
            nodes.push(on);
        }
        Path { nodes }
    }
}

#[cfg(test)]
impl Graph {
    /// Returns the number of living nodes.
    pub fn count(&self) -> usize {
        self.nodes().count()
    }

    /// Returns every link once, the smaller node first.
    pub fn edges(&self) -> Vec<[usize; 2]> {
        let from = |a: usize| self.linked(a).map(move |b| [a, b]);
        self.nodes().flat_map(from).filter(|[a, b]| a < b).collect()
    }

    /// Returns the number of pieces that no link joins.
    pub fn pieces(&self) -> usize {
        let mut seen = self.is_dead.clone();
        let mut pieces = 0;
        for node in self.nodes() {
            pieces += usize::from(!seen[node]);
            let mut open = vec![node];
            while let Some(node) = open.pop() {
                if !std::mem::replace(&mut seen[node], true) {
                    open.extend(self.linked(node));
                }
            }
        }
        pieces
    }

    /// Returns the number of independent loops.
    pub fn loops(&self) -> usize {
        self.edges().len() + self.pieces() - self.count()
    }
}

/// Tells one of both ways along a path from the other.
fn is_first_way(path: &Path) -> bool {
    let [first, last] = path.ends();
    let second = path.nodes[1];
    let last_but_one = path.nodes[path.nodes.len() - 2];
    (first, second) <= (last, last_but_one)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A graph of nodes on a line with these links.
    fn graph(links: &[[usize; 2]]) -> Graph {
        let count = links.iter().flatten().max().map_or(0, |most| most + 1);
        let mut graph = Graph::default();
        for node in 0..count {
            graph.add(Point::new(node as f64, 0.0, 0.0));
        }
        links.iter().for_each(|link| graph.link(*link));
        graph
    }

    #[test]
    fn branches_run_between_tips_and_junctures() {
        let y = graph(&[[0, 1], [1, 2], [2, 3], [2, 4], [4, 5]]);
        let paths: Vec<_> = y.paths().into_iter().map(|path| path.nodes).collect();
        assert_eq!(paths, [vec![0, 1, 2], vec![2, 3], vec![2, 4, 5]]);
        assert_eq!((y.loops(), y.pieces()), (0, 1));
    }

    #[test]
    fn rings_and_handles_are_branches_too() {
        let ring = graph(&[[0, 1], [1, 2], [0, 2]]);
        let paths: Vec<_> = ring.paths().into_iter().map(|path| path.nodes).collect();
        assert_eq!((paths, ring.loops()), (vec![vec![0, 1, 2, 0]], 1));
        let handle = graph(&[[0, 1], [1, 2], [2, 3], [1, 3]]);
        let paths: Vec<_> = handle.paths().into_iter().map(|path| path.nodes).collect();
        assert_eq!(paths, [vec![0, 1], vec![1, 2, 3, 1]]);
    }

    #[test]
    fn a_removed_node_takes_its_links_with_it() {
        let mut chain = graph(&[[0, 1], [1, 2]]);
        chain.remove(1);
        assert_eq!(
            (chain.count(), chain.edges().len(), chain.pieces()),
            (2, 0, 2)
        );
        assert!(chain.paths().is_empty());
    }
}
