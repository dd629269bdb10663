//! The skeleton of a solid: nodes with their balls, and the branches between them.

use super::centre::{center, spread};
use super::curve::collapse_to_curve;
use super::error::SkeletonError;
use super::flow::Flow;
use super::graph::Graph;
use super::poles::poles;
use super::remesh::remesh;
use super::surface::Surface;
use super::tidy::{depth_mm, tidy};
use crate::base::watch::Watch;
use crate::geom::Point;
use crate::mesh::Solid;
use crate::mesh::edges::EdgeTable;
use crate::mesh::shells::Shells;

/// Triangles of the remeshed surface. With far fewer, thin limbs lose their branches; with twice as
/// many it takes more than twice as long.
const TRIANGLES: usize = 10_000;
/// Distance of the nodes along a branch, as a share of the model's longest side: fifty along it.
const SPACING_RATIO: f64 = 0.02;
/// Least radius of a ball, as a share of the longest side. A node that is left outside gets it.
const LEAST_BALL_RATIO: f64 = 1e-4;

/// A node of a skeleton.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Node {
    /// Its number in a skeleton file.
    pub id: u32,
    /// Its place, mm.
    pub at: Point,
    /// The radius of the largest ball about it inside the solid, mm.
    pub radius_mm: f64,
}

/// A run of nodes between tips and junctures.
#[derive(Debug, Clone, PartialEq)]
pub struct Branch {
    /// The indices of its nodes. Of a ring, the first comes again at the end.
    pub nodes: Vec<usize>,
    /// The reason that no shells are made of it; `None` if it becomes a telescope.
    pub solid: Option<StaysSolid>,
}

/// A reason that a branch stays solid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum StaysSolid {
    /// It is too thin for two shells, one in the other.
    Thin,
    /// It is too short to slide out of anything.
    Short,
    /// It is flat: its balls are much smaller than its sections.
    Plate,
    /// The user said so.
    Ordered,
}

/// Curves inside a solid, with the largest ball about each of their nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct Skeleton {
    /// The nodes.
    pub nodes: Vec<Node>,
    /// The branches; none if the skeleton is a point.
    pub branches: Vec<Branch>,
    /// The node from which telescopes grow.
    pub root: usize,
    /// The links that are cut, so that no ring is left: neighbours in a branch.
    pub open: Vec<[usize; 2]>,
}

impl Skeleton {
    /// Finds the skeleton of a solid of one closed surface.
    ///
    /// It takes 1 to 5 s for up to 100 000 triangles.
    ///
    /// Nodes are 2 % of the longest side apart. The same solid gives the same skeleton on any
    /// number of threads. Its root is the juncture with the largest ball, else the thickest end.
    ///
    /// # Errors
    /// The surface has several closed pieces, or the watch is stopped.
    pub fn of(solid: &Solid, watch: &Watch) -> Result<Self, SkeletonError> {
        let mesh = solid.mesh();
        let shells = Shells::of(mesh, &EdgeTable::of(mesh)).count();
        if shells != 1 {
            return Err(SkeletonError::SeveralShells { shells });
        }
        let mut surface = Surface::of(mesh);
        remesh(&mut surface, solid.bvh(), TRIANGLES, watch)?;
        let surface = Surface::of(&surface.compact().0);
        let poles = poles(&surface, watch)?;
        let mut flow = Flow::new(surface, poles);
        flow.run(watch)?;
        let mut graph = collapse_to_curve(&flow.surface);
        tidy(&mut graph, solid.bvh());
        let spacing_mm = SPACING_RATIO * mesh.longest_side_mm();
        let mut graph = spread(&graph, spacing_mm);
        center(&mut graph, solid.bvh());
        Ok(Self::of_graph(&graph, solid))
    }

    /// Measures the balls of a graph's nodes.
    fn of_graph(graph: &Graph, solid: &Solid) -> Self {
        let least_mm = LEAST_BALL_RATIO * solid.mesh().longest_side_mm();
        let node = |(id, at): (u32, &Point)| Node {
            id,
            at: *at,
            radius_mm: depth_mm(solid.bvh(), at).max(least_mm),
        };
        let branch = |path: super::graph::Path| Branch {
            nodes: path.nodes,
            solid: None,
        };
        let mut skeleton = Self {
            nodes: (1..).zip(&graph.at).map(node).collect(),
            branches: graph.paths().into_iter().map(branch).collect(),
            root: 0,
            open: Vec::new(),
        };
        skeleton.root = skeleton.thickest();
        skeleton
    }

    /// Returns the juncture with the largest ball; else such an end; else any such node.
    fn thickest(&self) -> usize {
        let degrees = self.degrees();
        let rank = |node: usize| match degrees[node] {
            0 | 2 => 0,
            1 => 1,
            _ => 2,
        };
        let order = |a: &usize, b: &usize| {
            let [thick_a, thick_b] = [a, b].map(|node| self.nodes[*node].radius_mm);
            let ranks = rank(*a).cmp(&rank(*b));
            // The first of equal ones wins.
            ranks.then(thick_a.total_cmp(&thick_b)).then(b.cmp(a))
        };
        (0..self.nodes.len()).max_by(order).unwrap_or_default()
    }

    /// Returns every link, branch by branch.
    pub fn links(&self) -> impl Iterator<Item = [usize; 2]> {
        let of = |branch: &Branch| {
            let pairs = branch.nodes.windows(2).map(|pair| [pair[0], pair[1]]);
            pairs.collect::<Vec<_>>()
        };
        self.branches.iter().flat_map(of)
    }

    /// Returns the number of links at every node: 1 at a tip, 3 or more at a juncture.
    pub fn degrees(&self) -> Vec<usize> {
        let mut degrees = vec![0; self.nodes.len()];
        self.links().flatten().for_each(|end| degrees[end] += 1);
        degrees
    }

    /// Returns the nodes in which a branch ends and no other begins.
    pub fn tips(&self) -> Vec<usize> {
        let degrees = self.degrees();
        (0..degrees.len())
            .filter(|node| degrees[*node] == 1)
            .collect()
    }

    /// Returns the nodes in which three branches or more meet.
    pub fn junctures(&self) -> Vec<usize> {
        let degrees = self.degrees();
        (0..degrees.len())
            .filter(|node| degrees[*node] > 2)
            .collect()
    }

    /// Returns the number of independent rings: the genus of the solid.
    pub fn loops(&self) -> usize {
        (self.links().count() + 1).saturating_sub(self.nodes.len())
    }

    /// Returns the length of a branch, mm.
    pub fn length_mm(&self, branch: &Branch) -> f64 {
        self.run_length_mm(&branch.nodes)
    }

    /// Returns the length of the way over these nodes, mm.
    pub(super) fn run_length_mm(&self, run: &[usize]) -> f64 {
        let steps = run.windows(2);
        steps
            .map(|step| (self.nodes[step[1]].at - self.nodes[step[0]].at).norm())
            .sum()
    }

    /// Makes the node of this number the root.
    ///
    /// # Errors
    /// There is no such node.
    pub fn root_at(&mut self, id: u32) -> Result<(), SkeletonError> {
        let node = self.nodes.iter().position(|node| node.id == id);
        let last = self.nodes.iter().map(|node| node.id).max();
        self.root = node.ok_or(SkeletonError::NoNode {
            node: id,
            last: last.unwrap_or_default(),
        })?;
        Ok(())
    }

    /// Returns the skeleton made larger by a factor, about the model's origin.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let larger = |node: &Node| Node {
            at: node.at * factor,
            radius_mm: node.radius_mm * factor,
            ..*node
        };
        Self {
            nodes: self.nodes.iter().map(larger).collect(),
            ..self.clone()
        }
    }

    /// Returns the index of the node nearest to a place.
    pub fn nearest(&self, at: &Point) -> usize {
        let distance = |node: &usize| (self.nodes[*node].at - at).norm();
        let nearer = |a: &usize, b: &usize| distance(a).total_cmp(&distance(b));
        (0..self.nodes.len()).min_by(nearer).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::geom::{Frame, Vector};
    use crate::mesh::primitives::{ball, cuboid, cylinder, torus};
    use crate::mesh::{Csg, TriMesh};
    use crate::skeleton::ShellSizes;

    const SIZES: ShellSizes = ShellSizes {
        least_radius_mm: 1.0,
        pitch_mm: 1.0,
    };

    fn skeleton(mesh: TriMesh) -> Skeleton {
        marked(&Solid::new(mesh).unwrap())
    }

    fn marked(solid: &Solid) -> Skeleton {
        let mut skeleton = Skeleton::of(solid, &Watch::silent()).unwrap();
        skeleton.mark_solid(solid, &SIZES);
        skeleton
    }

    /// A rod of radius 4 mm from the origin along a direction.
    fn rod(along: &Vector, length_mm: f64) -> Csg {
        let frame = Frame::with_axis(Point::origin(), along);
        let rod = cylinder(4.0, length_mm, 48);
        Csg::of_mesh(&rod.map_vertices(|p| frame.to_model(p))).unwrap()
    }

    #[test]
    fn the_skeleton_of_a_cylinder_is_its_axis_with_its_radius() {
        let skeleton = skeleton(cylinder(5.0, 80.0, 64));
        assert_eq!((skeleton.tips().len(), skeleton.loops()), (2, 0));
        // Smoothing keeps 95 % of a ball of 5 mm, facets lie 0.006 mm inside. Near a flat end
        // the end bounds the ball, which is as large anywhere until it meets the wall.
        for node in &skeleton.nodes {
            let end_mm = node.at.z.min(80.0 - node.at.z);
            let free_mm = (5.0 - end_mm).max(0.0);
            assert!(node.at.coords.xy().norm() < free_mm + 0.26, "{node:?}");
            assert!((node.radius_mm - end_mm.min(5.0)).abs() < 0.26, "{node:?}");
        }
        // It reaches into both ends at least as far as the ball there.
        let heights = skeleton.nodes.iter().map(|node| node.at.z);
        let (low, high) = heights.fold((80.0f64, 0.0f64), |(low, high), z| {
            (low.min(z), high.max(z))
        });
        assert!(low < 8.0 && high > 72.0, "{low} to {high}");
        assert_eq!(skeleton.branches[0].solid, None);
    }

    #[test]
    fn the_skeleton_of_a_torus_is_one_ring() {
        let skeleton = skeleton(torus(30.0, 6.0, 96, 48));
        assert_eq!((skeleton.tips().len(), skeleton.loops()), (0, 1));
        for node in &skeleton.nodes {
            let off = (node.at.coords.xy().norm() - 30.0).hypot(node.at.z);
            assert!(off < 0.3 && (node.radius_mm - 6.0).abs() < 0.3, "{node:?}");
        }
        let line = skeleton.open_line().unwrap();
        assert!(line.starts_with("open = [["), "{line}");
    }

    #[test]
    fn the_skeleton_of_a_y_of_tubes_has_three_tips_and_a_juncture() {
        let arms = [0.0f64, 2.1, 4.2].map(|turn| Vector::new(turn.cos(), turn.sin(), 0.0));
        let [a, b, c] = arms.map(|along| rod(&along, 50.0));
        let solid = a.union(&b).unwrap().union(&c).unwrap().to_solid().unwrap();
        let skeleton = marked(&solid);
        let counts = (skeleton.tips().len(), skeleton.junctures().len());
        assert_eq!((counts, skeleton.loops()), ((3, 1), 0));
        assert_eq!(skeleton.root, skeleton.junctures()[0]);
        assert!(skeleton.nodes[skeleton.root].at.coords.norm() < 2.0);
        assert!(
            skeleton
                .branches
                .iter()
                .all(|branch| branch.solid.is_none())
        );
    }

    #[test]
    fn a_ball_has_a_point_or_a_stub_that_stays_solid() {
        let middle = Point::new(10.0, 0.0, 0.0);
        let skeleton = skeleton(ball(&middle, 20.0, 4));
        assert!(skeleton.loops() == 0 && skeleton.junctures().is_empty());
        let all_solid = skeleton
            .branches
            .iter()
            .all(|branch| branch.solid.is_some());
        assert!(all_solid, "{:?}", skeleton.branches);
        assert!((skeleton.nodes[skeleton.root].at - middle).norm() < 4.0);
    }

    #[test]
    fn a_disc_is_flat_and_stays_solid() {
        let skeleton = skeleton(cylinder(40.0, 4.0, 96));
        assert_eq!(skeleton.loops(), 0);
        let solid = skeleton.branches.iter().map(|branch| branch.solid);
        assert!(solid.into_iter().all(|why| why.is_some()), "{skeleton:?}");
    }

    #[test]
    fn a_thin_rod_stays_solid_and_a_thick_one_carries_shells() {
        let why = |radius_mm: f64| skeleton(cylinder(radius_mm, 60.0, 32)).branches[0].solid;
        assert_eq!(why(1.5), Some(StaysSolid::Thin));
        assert_eq!(why(4.0), None);
    }

    #[test]
    fn a_block_with_a_tiny_eye_gets_an_answer() {
        let block = cuboid(
            &Point::new(-10.0, -10.0, 0.0),
            &Point::new(10.0, 10.0, 60.0),
        );
        let hole = cylinder(0.3, 40.0, 12);
        let across = Frame::with_axis(Point::new(0.0, -20.0, 55.0), &Vector::y());
        let hole = hole.map_vertices(|p| across.to_model(p));
        let eye = Csg::of_mesh(&block).unwrap();
        let eye = eye.subtract(&Csg::of_mesh(&hole).unwrap()).unwrap();
        let skeleton = marked(&eye.to_solid().unwrap());
        assert!(skeleton.loops() <= 1);
        assert!(skeleton.nodes.iter().all(|node| node.radius_mm > 0.0));
    }

    #[test]
    fn several_pieces_are_refused() {
        let one = ball(&Point::origin(), 5.0, 2);
        let other = ball(&Point::new(20.0, 0.0, 0.0), 5.0, 2);
        let solid = Solid::new(one.joined(&other)).unwrap();
        let refused = Skeleton::of(&solid, &Watch::silent());
        assert_eq!(refused, Err(SkeletonError::SeveralShells { shells: 2 }));
    }

    #[test]
    fn a_stopped_watch_stops_it() {
        let watch = Watch::silent();
        watch.cancel();
        let solid = Solid::new(ball(&Point::origin(), 5.0, 3)).unwrap();
        assert!(Skeleton::of(&solid, &watch).is_err());
    }

    #[test]
    fn any_number_of_threads_finds_the_same_skeleton() {
        let solid = Solid::new(torus(20.0, 4.0, 60, 24)).unwrap();
        let on = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            let pool = pool.build().unwrap();
            pool.install(|| marked(&solid).to_toml("ring"))
        };
        assert_eq!(on(1), on(3));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(6))]

        #[test]
        fn random_bodies_of_rods_have_skeletons_inside_them(
            ends in prop::collection::vec(
                ([-1.0..1.0f64, -1.0..1.0, -1.0..1.0], 20.0..60.0f64),
                1..4,
            )
        ) {
            let rods = ends.iter().filter_map(|(along, length_mm)| {
                let along = Vector::from(*along).try_normalize(0.1)?;
                Some(rod(&along, *length_mm))
            });
            let ball = Csg::of_mesh(&ball(&Point::origin(), 8.0, 3)).unwrap();
            let body = rods.fold(ball, |body, rod| body.union(&rod).unwrap());
            let Ok(solid) = body.to_solid() else {
                return Ok(());
            };
            let skeleton = marked(&solid);
            let is_inside = |node: &Node| solid.bvh().winding(&node.at) > 0;
            prop_assert!(skeleton.nodes.iter().all(is_inside));
            prop_assert_eq!(skeleton.loops(), 0);
            let text = skeleton.to_toml("rods");
            let read = Skeleton::from_toml("rods.toml", &text).unwrap();
            prop_assert_eq!(read.to_toml("rods"), text.replace(" # too thin for two shells", "")
                .replace(" # too short for two shells", "").replace(" # flat, no tube", ""));
        }
    }
}
