//! The tree that telescopes grow along: junctures that stay solid, and chains between them.

use std::collections::BTreeMap;

use super::rings::Ring;
use super::solid::ShellSizes;
use super::tree::{Branch, Skeleton, StaysSolid};
use crate::geom::Point;
use crate::mesh::union_find::UnionFind;

/// The least free length of a chain, in radii: two shells that are each visible for one.
const LEAST_LENGTH_RADII: f64 = 2.0;
/// The least number of shells of a chain: one alone slides out of nothing.
const LEAST_SHELLS: usize = 2;
/// Nodes of a ring that a message names.
const NAMED_NODES: usize = 8;

/// A body that stays solid: where chains meet, and the branches that carry no shells.
#[derive(Debug, Clone, PartialEq)]
pub struct Juncture {
    /// The indices of its nodes in the skeleton, ascending.
    pub nodes: Vec<usize>,
    /// The chain whose end it is; `None` for the root.
    pub parent: Option<usize>,
}

/// A line along which shells slide, from the root outwards.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    /// The index of the juncture it grows from.
    pub from: usize,
    /// The index of the juncture at its end; `None` at a tip.
    pub to: Option<usize>,
    /// The indices of its nodes in the skeleton. The first belongs to `from`, the last to `to`.
    pub nodes: Vec<usize>,
    /// The places of the nodes, mm.
    pub points: Vec<Point>,
    /// The radius that a shell may have at each place, mm: never more than nearer to the root.
    pub radii_mm: Vec<f64>,
    /// Arc length from the first point at which the chain leaves the ball of its first node, mm.
    pub start_mm: f64,
    /// Arc length at which it ends, mm: at the ball of `to`, or where a tip becomes too thin.
    pub end_mm: f64,
}

/// A tree of junctures and chains; the first juncture holds the root.
#[derive(Debug, Clone, PartialEq)]
pub struct Limbs {
    /// The junctures, each after its parent.
    pub junctures: Vec<Juncture>,
    /// The chains, each after those nearer to the root.
    pub chains: Vec<Chain>,
}

/// The rings that keep a skeleton from being a tree.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{}", describe_rings(.rings, .open_line))]
pub struct NotATree {
    /// The rings, each by the numbers of its nodes in the file.
    pub rings: Vec<Vec<u32>>,
    /// The line of the skeleton file that cuts them.
    pub open_line: String,
}

fn describe_rings(rings: &[Vec<u32>], open_line: &str) -> String {
    let name = |ring: &Vec<u32>| {
        let step = ring.len().div_ceil(NAMED_NODES).max(1);
        let ids: Vec<String> = ring.iter().step_by(step).map(u32::to_string).collect();
        format!("through nodes {}", ids.join(", "))
    };
    let names: Vec<String> = rings.iter().map(name).collect();
    let count = match rings.len() {
        1 => "a ring".to_owned(),
        count => format!("{count} rings"),
    };
    format!(
        "the skeleton has {count}, and only a tree can open: {}; remedy: cut each of them; in the \
         skeleton file this line does: {open_line}",
        names.join("; ")
    )
}

impl Chain {
    /// Returns the length on which shells may slide, mm.
    pub fn free_mm(&self) -> f64 {
        (self.end_mm - self.start_mm).max(0.0)
    }

    /// Returns the arc length from the first point to each point, mm.
    pub fn arcs_mm(&self) -> Vec<f64> {
        let mut arc_mm = 0.0;
        let steps = self.points.windows(2).map(|pair| {
            arc_mm += (pair[1] - pair[0]).norm();
            arc_mm
        });
        let arcs: Vec<f64> = steps.collect();
        [vec![0.0], arcs].concat()
    }

    /// Returns the radius that a shell may have at an arc length, mm; that of the ends beyond.
    pub fn radius_at_mm(&self, arc_mm: f64) -> f64 {
        let arcs = self.arcs_mm();
        let after = arcs.partition_point(|arc| *arc <= arc_mm);
        let at = after.clamp(1, arcs.len() - 1) - 1;
        let share = (arc_mm - arcs[at]) / (arcs[at + 1] - arcs[at]).max(f64::MIN_POSITIVE);
        let [from, to] = [self.radii_mm[at], self.radii_mm[at + 1]];
        from + (to - from) * share.clamp(0.0, 1.0)
    }

    /// Returns the most shells that fit into one another where the chain starts.
    pub fn most_shells(&self, sizes: &ShellSizes) -> usize {
        let room_mm = self.radius_at_mm(self.start_mm) - sizes.least_radius_mm;
        if room_mm < 0.0 {
            return 0;
        }
        1 + (room_mm / sizes.pitch_mm) as usize
    }

    /// Returns the reason that no two shells slide on the chain; `None` if they do.
    fn refusal(&self, sizes: &ShellSizes) -> Option<StaysSolid> {
        let is_thin = self.most_shells(sizes) < LEAST_SHELLS;
        let least_mm = LEAST_LENGTH_RADII * self.radius_at_mm(0.5 * (self.start_mm + self.end_mm));
        let is_short = self.free_mm() < least_mm;
        is_thin
            .then_some(StaysSolid::Thin)
            .or(is_short.then_some(StaysSolid::Short))
    }

    /// Ends the chain where it becomes thinner than the thinnest shell.
    fn end_where_thin(&mut self, least_mm: f64) {
        let Some(at) = self.radii_mm.iter().position(|mm| *mm < least_mm) else {
            return;
        };
        let arcs = self.arcs_mm();
        let thin_mm = if at == 0 {
            0.0
        } else {
            let fall_mm = self.radii_mm[at - 1] - self.radii_mm[at];
            let share = (self.radii_mm[at - 1] - least_mm) / fall_mm;
            arcs[at - 1] + share * (arcs[at] - arcs[at - 1])
        };
        self.end_mm = self.end_mm.min(thin_mm);
    }
}

impl Limbs {
    /// Returns the limbs of a skeleton with its links cut, each chain with two shells or more of
    /// these sizes. A chain that carries fewer becomes part of the juncture it grows from.
    ///
    /// # Errors
    /// Rings are left.
    pub fn of(skeleton: &Skeleton, sizes: &ShellSizes) -> Result<Self, NotATree> {
        let mut tree = cut(skeleton)?;
        loop {
            let mut growth = Growth::of(&tree);
            for chain in &mut growth.limbs.chains {
                chain.end_where_thin(sizes.least_radius_mm);
            }
            let chains = growth.limbs.chains.iter().zip(&growth.branch_of);
            let mut refused = chains.filter_map(|(chain, branch)| {
                let why = chain.refusal(sizes)?;
                Some((*branch, why))
            });
            let Some((branch, why)) = refused.next() else {
                return Ok(growth.limbs);
            };
            tree.branches[branch].solid = Some(why);
        }
    }
}

/// Returns a skeleton without the links that are cut, whose branches end at the root too.
fn cut(skeleton: &Skeleton) -> Result<Skeleton, NotATree> {
    if let Some(open_line) = skeleton.open_line() {
        let ids = |ring: &Ring| ring.nodes.iter().map(|n| skeleton.nodes[*n].id).collect();
        let rings = skeleton.rings().iter().map(ids).collect();
        return Err(NotATree { rings, open_line });
    }
    let runs = skeleton.branches.iter().flat_map(|branch| {
        let pieces = branch.nodes.chunk_by(|a, b| !skeleton.is_open([*a, *b]));
        let pieces = pieces.flat_map(|piece| split_at(piece, skeleton.root));
        pieces.map(|nodes| Branch {
            nodes,
            solid: branch.solid,
        })
    });
    Ok(Skeleton {
        nodes: skeleton.nodes.clone(),
        branches: runs.collect(),
        root: skeleton.root,
        open: Vec::new(),
    })
}

/// Splits a run of nodes at one of them, which both pieces keep. A lone node is no run.
fn split_at(nodes: &[usize], middle: usize) -> Vec<Vec<usize>> {
    let at = nodes.iter().position(|node| *node == middle).unwrap_or(0);
    let pieces = [&nodes[..=at], &nodes[at..]].map(<[usize]>::to_vec);
    pieces.into_iter().filter(|piece| piece.len() > 1).collect()
}

/// Limbs that grow from the root outwards.
struct Growth<'a> {
    tree: &'a Skeleton,
    /// The body of every node: nodes that solid branches join are one.
    body_of: Vec<u32>,
    /// The juncture of every body that is reached.
    juncture_of: BTreeMap<u32, usize>,
    /// The branch of every chain.
    branch_of: Vec<usize>,
    limbs: Limbs,
}

impl<'a> Growth<'a> {
    fn of(tree: &'a Skeleton) -> Self {
        let mut bodies = UnionFind::new(tree.nodes.len());
        for branch in tree.branches.iter().filter(|branch| branch.solid.is_some()) {
            for pair in branch.nodes.windows(2) {
                bodies.merge(pair[0] as u32, pair[1] as u32);
            }
        }
        let mut growth = Self {
            tree,
            body_of: bodies.labels().0,
            juncture_of: BTreeMap::new(),
            branch_of: Vec::new(),
            limbs: Limbs {
                junctures: Vec::new(),
                chains: Vec::new(),
            },
        };
        growth.add_juncture(tree.root, None);
        let degrees = tree.degrees();
        while growth.add_next(&degrees) {}
        growth.list_nodes();
        growth
    }

    /// Adds the juncture of a node, and returns its index.
    fn add_juncture(&mut self, node: usize, parent: Option<usize>) -> usize {
        let juncture = self.limbs.junctures.len();
        self.juncture_of.insert(self.body_of[node], juncture);
        self.limbs.junctures.push(Juncture {
            nodes: Vec::new(),
            parent,
        });
        juncture
    }

    /// Adds the first chain that begins where something is; false if there is none left.
    fn add_next(&mut self, degrees: &[usize]) -> bool {
        let reached = |node: usize| self.juncture_of.get(&self.body_of[node]).copied();
        let next = self
            .tree
            .branches
            .iter()
            .enumerate()
            .find_map(|(at, branch)| {
                let is_new = branch.solid.is_none() && !self.branch_of.contains(&at);
                let nodes = is_new.then_some(&branch.nodes)?;
                let [first, last] = [nodes[0], nodes[nodes.len() - 1]].map(reached);
                let outwards = first.map(|from| (from, nodes.clone()));
                let inwards = last.map(|from| (from, nodes.iter().rev().copied().collect()));
                Some((at, outwards.or(inwards)?))
            });
        let Some((branch, (from, nodes))) = next else {
            return false;
        };
        let end = nodes[nodes.len() - 1];
        let chain = self.limbs.chains.len();
        let to = (degrees[end] > 1).then(|| self.add_juncture(end, Some(chain)));
        self.branch_of.push(branch);
        let chain = self.chain(nodes, [Some(from), to]);
        self.limbs.chains.push(chain);
        true
    }

    /// Returns the chain along nodes, between two junctures.
    fn chain(&self, nodes: Vec<usize>, [from, to]: [Option<usize>; 2]) -> Chain {
        let node = |index: &usize| &self.tree.nodes[*index];
        let [first, last] = [node(&nodes[0]), node(&nodes[nodes.len() - 1])];
        let mut radius_mm = f64::INFINITY;
        let mut least = |index: &usize| {
            radius_mm = node(index).radius_mm.min(radius_mm);
            radius_mm
        };
        let mut chain = Chain {
            from: from.unwrap_or_default(),
            to,
            points: nodes.iter().map(|index| node(index).at).collect(),
            radii_mm: nodes.iter().map(&mut least).collect(),
            nodes,
            start_mm: 0.0,
            end_mm: 0.0,
        };
        let length_mm = chain.arcs_mm().last().copied().unwrap_or_default();
        chain.start_mm = first.radius_mm.min(length_mm);
        chain.end_mm = if to.is_some() {
            length_mm - last.radius_mm
        } else {
            length_mm
        };
        chain
    }

    /// Lists the nodes of every juncture.
    fn list_nodes(&mut self) {
        for (node, body) in self.body_of.iter().enumerate() {
            if let Some(juncture) = self.juncture_of.get(body) {
                self.limbs.junctures[*juncture].nodes.push(node);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZES: ShellSizes = ShellSizes {
        least_radius_mm: 2.0,
        pitch_mm: 2.0,
    };

    /// A trunk along z from node 1 to 3 with two limbs along ±x, and radii falling outwards.
    fn tree(text: &str) -> Skeleton {
        let head = "kind = \"skeleton\"\nschema = 1\nroot = 1\n";
        Skeleton::from_toml("tree.toml", &format!("{head}{text}")).unwrap()
    }

    const Y: &str = "[nodes]\n1 = [0, 0, 0, 10]\n2 = [0, 0, 40, 8]\n3 = [0, 0, 80, 9]\n\
        4 = [60, 0, 80, 5]\n5 = [-60, 0, 80, 1]\n\
        [[branch]]\nnodes = [1, 2, 3]\n[[branch]]\nnodes = [4, 3]\n[[branch]]\nnodes = [3, 5]\n";

    #[test]
    fn limbs_grow_from_the_root_and_get_no_thicker() {
        let limbs = Limbs::of(&tree(Y), &SIZES).unwrap();
        assert_eq!(limbs.junctures.len(), 2);
        assert_eq!(limbs.junctures[1].parent, Some(0));
        let nodes: Vec<_> = limbs.chains.iter().map(|chain| &chain.nodes[..]).collect();
        assert_eq!(nodes, [&[0, 1, 2][..], &[2, 3], &[2, 4]]);
        assert_eq!(limbs.chains[0].radii_mm, [10.0, 8.0, 8.0]);
        // The trunk leaves the ball of 10 mm at its foot and ends at the ball of 9 mm at its top.
        assert_eq!(
            [limbs.chains[0].start_mm, limbs.chains[0].end_mm],
            [10.0, 71.0]
        );
        // The radius falls from 9 to 1 over 60 mm: it is 2 at seven eighths.
        assert!((limbs.chains[2].end_mm - 52.5).abs() < 1e-9);
    }

    #[test]
    fn shells_are_counted_from_the_thinnest_outwards() {
        let chain = &Limbs::of(&tree(Y), &SIZES).unwrap().chains[0];
        // 9.5 mm where it starts: 2, 4, 6 and 8 mm fit.
        assert_eq!(chain.most_shells(&SIZES), 4);
    }

    #[test]
    fn a_limb_that_carries_no_two_shells_joins_its_juncture() {
        let thick = ShellSizes {
            least_radius_mm: 4.0,
            pitch_mm: 4.2,
        };
        let limbs = Limbs::of(&tree(Y), &thick).unwrap();
        // The limb to node 4 has 8.4 mm where it starts, that to node 5 has 7.8 mm.
        assert_eq!(limbs.chains.len(), 2);
        assert_eq!(limbs.junctures[1].nodes, [2, 4]);
    }

    #[test]
    fn what_is_ordered_solid_is_one_body_with_all_it_joins() {
        let solid = Y.replacen("nodes = [1, 2, 3]", "nodes = [1, 2, 3]\nsolid = true", 1);
        let limbs = Limbs::of(&tree(&solid), &SIZES).unwrap();
        assert_eq!(limbs.junctures.len(), 1);
        assert_eq!(limbs.junctures[0].nodes, [0, 1, 2]);
        assert_eq!(limbs.chains.len(), 2);
    }

    #[test]
    fn a_ring_is_refused_with_the_line_that_cuts_it() {
        let ring = "[nodes]\n1 = [0, 0, 0, 5]\n2 = [50, 0, 0, 5]\n3 = [50, 50, 0, 5]\n\
            4 = [0, 50, 0, 5]\n[[branch]]\nnodes = [1, 2, 3, 4, 1]\n";
        let refused = Limbs::of(&tree(ring), &SIZES).unwrap_err();
        // Both ways round to node 3 are equally long; that over the smaller number counts.
        assert_eq!(refused.open_line, "open = [[3, 4]]");
        assert!(refused.to_string().contains("a ring"), "{refused}");
        let cut = tree(&format!("{}\n{ring}", refused.open_line));
        let limbs = Limbs::of(&cut, &SIZES).unwrap();
        assert_eq!((limbs.junctures.len(), limbs.chains.len()), (1, 2));
        let refused = Limbs::of(
            &tree(&ring.replace("nodes = [1, 2, 3, 4, 1]", "nodes = [2, 3, 4, 1, 2]")),
            &SIZES,
        );
        assert!(refused.is_err());
    }
}
