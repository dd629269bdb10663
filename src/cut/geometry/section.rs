//! The section of a closed mesh by a plane.

use crate::{
    cut::geometry::{
        chart::{Chart, Point2},
        outline::Outline,
    },
    geom::Plane,
    mesh::TriMesh,
};
use geo::{LineString, MultiPolygon, Polygon};

/// The closed rings in which a plane meets a mesh, in the coordinates (u, v) of [`Plane::basis`].
///
/// For an outward solid, outer rings run counter-clockwise and holes clockwise. A vertex on the
/// plane counts as above it, as if the plane were moved by an infinitesimal distance. So every ring
/// closes, whatever lies in the plane.
#[derive(Debug, Clone, PartialEq)]
pub struct Section {
    /// The rings, each without its first point repeated, in the order of their first triangles.
    pub rings: Vec<Ring>,
}

/// One closed ring of a section.
#[derive(Debug, Clone, PartialEq)]
pub struct Ring {
    /// The corners, mm.
    pub points: Vec<Point2>,
    /// A mesh vertex above the plane at one end of an edge the ring crosses.
    pub above: u32,
    /// The mesh vertex below the plane at the edge's other end.
    pub below: u32,
}

/// A triangle that crosses the plane: the edge that goes down through the plane and the edge that
/// comes up.
struct Crossing {
    down: (u32, u32),
    up: (u32, u32),
}

impl Section {
    /// Returns the section of a closed mesh, in one pass over the triangles. In an open mesh, a
    /// ring ends early at the rim.
    pub fn of_mesh(mesh: &TriMesh, plane: &Plane) -> Self {
        let heights: Vec<f64> = mesh.vertices().iter().map(|p| plane.distance(p)).collect();
        let mut crossings: Vec<Crossing> = mesh
            .triangles()
            .iter()
            .filter_map(|t| crossing(t, &heights))
            .collect();
        crossings.sort_unstable_by_key(|c| c.down);
        let chart = Chart::of_plane(plane);
        let corner = |&(above, below): &(u32, u32)| {
            let (a, b) = (heights[above as usize], heights[below as usize]);
            let (p, q) = (
                mesh.vertices()[above as usize],
                mesh.vertices()[below as usize],
            );
            chart.flat(&(p + (q - p) * (a / (a - b))))
        };
        let rings = link_chains(&crossings)
            .into_iter()
            .filter(|chain| chain.len() > 2);
        Self {
            rings: rings.map(|chain| Ring::new(&chain, corner)).collect(),
        }
    }

    /// Returns the rings grouped into polygons: the index of an outer ring, then those of its
    /// holes.
    pub fn groups(&self) -> Vec<Vec<usize>> {
        let areas: Vec<f64> = self.rings.iter().map(Ring::area_mm2).collect();
        let outer: Vec<usize> = (0..areas.len()).filter(|&i| areas[i] > 0.0).collect();
        let mut groups: Vec<Vec<usize>> = outer.iter().map(|&i| vec![i]).collect();
        for hole in (0..areas.len()).filter(|&i| areas[i] <= 0.0) {
            let point = self.rings[hole].points[0];
            let holder = (0..outer.len())
                .filter(|&g| areas[outer[g]] >= -areas[hole])
                .filter(|&g| self.rings[outer[g]].outline().holds(&point))
                .min_by(|&g, &h| areas[outer[g]].total_cmp(&areas[outer[h]]));
            if let Some(group) = holder {
                groups[group].push(hole);
            }
        }
        groups
    }

    /// Returns the section as polygons with holes.
    pub fn polygons(&self) -> MultiPolygon<f64> {
        let line = |&i: &usize| {
            self.rings[i]
                .points
                .iter()
                .map(|p| (p.x, p.y))
                .collect::<LineString<f64>>()
        };
        let polygon = |group: &Vec<usize>| {
            Polygon::new(line(&group[0]), group[1..].iter().map(line).collect())
        };
        MultiPolygon(self.groups().iter().map(polygon).collect())
    }

    /// Returns the outline of some of the rings.
    pub(crate) fn outline(&self, rings: &[usize]) -> Outline {
        Outline::new(
            rings
                .iter()
                .flat_map(|&i| self.rings[i].segments())
                .collect(),
        )
    }

    /// Returns centre and diameter (mm) of the largest disc in each polygon.
    pub fn largest_discs(&self) -> Vec<(Point2, f64)> {
        let discs = self
            .groups()
            .into_iter()
            .filter_map(|rings| self.outline(&rings).largest_disc(0.0));
        discs
            .map(|disc| (disc.center, 2.0 * disc.radius_mm))
            .collect()
    }

    /// Returns the area, mm².
    pub fn area_mm2(&self) -> f64 {
        self.rings.iter().map(Ring::area_mm2).sum()
    }
}

impl Ring {
    fn new(chain: &[(u32, u32)], corner: impl Fn(&(u32, u32)) -> Point2) -> Self {
        let (above, below) = chain[0];
        Self {
            points: chain.iter().map(corner).collect(),
            above,
            below,
        }
    }

    /// Returns the enclosed area, mm²; negative for a hole.
    pub fn area_mm2(&self) -> f64 {
        let origin = self.points[0];
        self.segments()
            .map(|[a, b]| (a - origin).perp(&(b - origin)))
            .sum::<f64>()
            / 2.0
    }

    /// Returns the length around, mm.
    pub fn length_mm(&self) -> f64 {
        self.segments().map(|[a, b]| (b - a).norm()).sum()
    }

    /// Returns the edges of the ring, in order.
    pub fn segments(&self) -> impl Iterator<Item = [Point2; 2]> + '_ {
        let next = self.points.iter().cycle().skip(1);
        self.points.iter().zip(next).map(|(&a, &b)| [a, b])
    }

    /// Returns true if a point lies inside the ring.
    pub(crate) fn holds(&self, at: &Point2) -> bool {
        self.outline().holds(at)
    }

    fn outline(&self) -> Outline {
        Outline::new(self.segments().collect())
    }
}

/// Returns the crossing of a triangle with the plane; `None` if it does not cross. Edges are named
/// (vertex above, vertex below).
fn crossing(&[a, b, c]: &[u32; 3], heights: &[f64]) -> Option<Crossing> {
    let above = |v: u32| heights[v as usize] >= 0.0;
    let edges = [(a, b), (b, c), (c, a)];
    let down = edges
        .into_iter()
        .find(|&(from, to)| above(from) && !above(to))?;
    let up = edges
        .into_iter()
        .find(|&(from, to)| !above(from) && above(to))?;
    Some(Crossing {
        down,
        up: (up.1, up.0),
    })
}

/// Returns the crossed edges, linked in the order in which the section passes them; `crossings` are
/// sorted by `down`.
fn link_chains(crossings: &[Crossing]) -> Vec<Vec<(u32, u32)>> {
    let mut used = vec![false; crossings.len()];
    let mut chains = Vec::new();
    for start in 0..crossings.len() {
        let mut chain = Vec::new();
        let mut at = Some(start);
        while let Some(i) = at.filter(|&i| !used[i]) {
            used[i] = true;
            chain.push(crossings[i].down);
            at = crossings
                .binary_search_by_key(&crossings[i].up, |c| c.down)
                .ok();
        }
        if !chain.is_empty() {
            chains.push(chain);
        }
    }
    chains
}
