//! The room that cells share: a box, or a solid in blocks.

use super::chain::{Chain, Corners, cap, clip, cross};
use super::fan;
use super::polytope::Polytope;
use super::tree::{Tree, holds, overlap};
use crate::geom::{Aabb, Plane, Point, Vector};

/// Most triangles of a block that is not divided further.
const FEW_TRIANGLES: usize = 60;
/// The least side of a block, as a part of the longest side of the room. A smaller one stays whole,
/// however many triangles meet in a point of it.
const LEAST_SIDE_RATIO: f64 = 1e-3;

/// The distance within which a corner lies on a side of its block, as a part of the room's longest
/// side. Points on a cut are off it by rounding.
const SIDE_RATIO: f64 = 1e-13;

/// The part of a side that may be missing where it counts as covered or as free.
const COVER_RATIO: f64 = 1e-11;

/// A region that is divided into cells.
#[derive(Debug, Clone)]
pub struct Room {
    bounds: Aabb,
    blocks: Vec<Block>,
    tree: Tree,
    volume_mm3: f64,
}

/// A box of the room, and the boundary of the region within it.
#[derive(Debug, Clone)]
struct Block {
    bounds: Aabb,
    inside: Inside,
}

/// The part of a block that belongs to the region.
#[derive(Debug, Clone)]
enum Inside {
    All,
    Some {
        surface: Vec<Corners>,
        sides: Vec<Corners>,
    },
}

impl Room {
    /// Makes a room of a box.
    pub fn of_box(bounds: Aabb) -> Self {
        let block = Block {
            bounds,
            inside: Inside::All,
        };
        let size = bounds.size();
        Self {
            bounds,
            blocks: vec![block],
            tree: Tree::new(vec![bounds]),
            volume_mm3: size.x * size.y * size.z,
        }
    }

    /// Makes a room of a closed surface, and divides it into blocks of some `block_mm` or less.
    ///
    /// Triangles run counter-clockwise as seen from outside.
    pub fn of_triangles(triangles: &[Corners], block_mm: f64) -> Self {
        let whole = Chain::new(triangles.to_vec());
        let bounds = whole.bounds();
        let longest_mm = bounds.size().max();
        let division = Division {
            triangles,
            block_mm,
            least_mm: LEAST_SIDE_RATIO * longest_mm,
            near_mm: SIDE_RATIO * longest_mm,
        };
        let all = (0..triangles.len()).collect();
        let mut blocks = Vec::new();
        division.divide(all, Vec::new(), bounds, &mut blocks);
        let boxes = blocks.iter().map(|block| block.bounds).collect();
        Self {
            bounds,
            blocks,
            tree: Tree::new(boxes),
            volume_mm3: whole.volume_mm3(),
        }
    }

    /// Returns the box around the room.
    pub fn bounds(&self) -> &Aabb {
        &self.bounds
    }

    /// Returns the volume of the room, mm³.
    pub fn volume_mm3(&self) -> f64 {
        self.volume_mm3
    }

    /// Returns the part of the room within a polytope.
    pub fn within(&self, polytope: &Polytope) -> Chain {
        let around = polytope.bounds();
        let near = self.tree.find(|bounds| overlap(bounds, &around));
        let near: Vec<&Block> = near.into_iter().map(|index| &self.blocks[index]).collect();
        if self.is_inside(&around, &near) {
            return polytope.chain();
        }
        let parts = near.into_iter().flat_map(|block| block.within(polytope));
        Chain::new(parts.collect())
    }

    /// Returns true if a box lies wholly in the room.
    fn is_inside(&self, around: &Aabb, near: &[&Block]) -> bool {
        let is_full = near.iter().all(|block| matches!(block.inside, Inside::All));
        let size = around.size();
        let covered = near.iter().map(|block| {
            let side = |axis: usize| {
                let end = around.max[axis].min(block.bounds.max[axis]);
                (end - around.min[axis].max(block.bounds.min[axis])).max(0.0)
            };
            side(0) * side(1) * side(2)
        });
        // Blocks do not overlap: they cover the box if their volumes do.
        let whole = size.x * size.y * size.z;
        is_full && covered.sum::<f64>() >= whole * (1.0 - 1e-9)
    }

    /// Returns true if a point lies in the room.
    pub fn holds(&self, at: &Point) -> bool {
        let near = self.tree.find(|bounds| holds(bounds, at));
        near.into_iter().any(|index| self.blocks[index].holds(at))
    }
}

impl Block {
    /// Returns the surface and the faces that bound what is in the block and in a polytope.
    ///
    /// Its sides are left out: beside it is another block with the same side, the other way round.
    fn within(&self, polytope: &Polytope) -> Vec<Corners> {
        let (mut kept, mut sides) = match &self.inside {
            Inside::All => (Vec::new(), Chain::of_box(&self.bounds).into_triangles()),
            Inside::Some { surface, sides } => (surface.clone(), sides.clone()),
        };
        for face in polytope.faces() {
            if !crosses(&face.plane, &self.bounds) {
                continue;
            }
            let mut edges = Vec::new();
            for part in [&mut kept, &mut sides] {
                let before = std::mem::take(part);
                for corners in &before {
                    clip(corners, &face.plane, part, &mut edges);
                }
            }
            kept.extend(cap(&edges));
        }
        kept
    }

    /// Returns true if a point of the block lies in the region.
    fn holds(&self, at: &Point) -> bool {
        match &self.inside {
            Inside::All => true,
            Inside::Some { surface, sides } => {
                let all = [surface.as_slice(), sides.as_slice()].concat();
                Chain::new(all).holds(at)
            }
        }
    }
}

/// A surface that is divided into blocks.
struct Division<'a> {
    triangles: &'a [Corners],
    block_mm: f64,
    least_mm: f64,
    near_mm: f64,
}

impl Division<'_> {
    /// Divides a block until it is small and simple, and keeps those that are not empty.
    ///
    /// `crossing` are the triangles that may pass through it, `sides` what is inside on its sides.
    fn divide(
        &self,
        crossing: Vec<usize>,
        sides: Vec<Corners>,
        bounds: Aabb,
        blocks: &mut Vec<Block>,
    ) {
        let pieces = crossing.iter().map(|&index| {
            let piece = within(&self.triangles[index], &bounds);
            (index, piece)
        });
        let pieces = pieces.filter(|(_, piece)| piece.len() >= 3);
        let (crossing, pieces): (Vec<usize>, Vec<Vec<Point>>) = pieces.unzip();
        let sides = self.plain(sides, &bounds);
        if pieces.is_empty() && sides.is_empty() {
            return;
        }
        let is_full = pieces.is_empty() && sides == Chain::of_box(&bounds).triangles();
        let size = bounds.size();
        let axis = size.imax();
        let is_intricate = pieces.len() > FEW_TRIANGLES && size[axis] > self.least_mm;
        if is_full || !(size[axis] > self.block_mm || is_intricate) {
            let inside = if is_full {
                Inside::All
            } else {
                let surface = pieces.iter().flat_map(|piece| fan(piece)).collect();
                Inside::Some { surface, sides }
            };
            blocks.push(Block { bounds, inside });
            return;
        }
        let mut normal = Vector::zeros();
        normal[axis] = 1.0;
        let middle = bounds.center();
        let plane = Plane::through(&middle, &normal);
        let mut halves = [bounds, bounds];
        halves[0].max[axis] = middle[axis];
        halves[1].min[axis] = middle[axis];
        for (half, plane) in halves.into_iter().zip([plane, plane.flipped()]) {
            // The surface is cut anew from its whole triangles: only its edges count here.
            let (mut surface, mut part, mut edges) = (Vec::new(), Vec::new(), Vec::new());
            for corners in pieces.iter().flat_map(|piece| fan(piece)) {
                clip(&corners, &plane, &mut surface, &mut edges);
            }
            for corners in &sides {
                clip(corners, &plane, &mut part, &mut edges);
            }
            part.extend(cap(&edges));
            self.divide(crossing.clone(), part, half, blocks);
        }
    }

    /// Draws the sides of a block anew with few triangles.
    ///
    /// Cuts of the blocks before leave many thin triangles on sides far from the surface.
    fn plain(&self, mut rest: Vec<Corners>, bounds: &Aabb) -> Vec<Corners> {
        let mut sides = Vec::new();
        for pair in Chain::of_box(bounds).triangles().chunks(2) {
            let [a, b, c] = pair[0];
            let side = Plane::through(&a, &(b - a).cross(&(c - a)));
            let is_on = |corners: &Corners| {
                corners
                    .iter()
                    .all(|at| side.distance(at).abs() <= self.near_mm)
            };
            let on: Vec<Corners> = rest.extract_if(.., |one| is_on(one)).collect();
            let area = |corners: &Corners| {
                let [a, b, c] = corners;
                0.5 * (b - a).cross(&(c - a)).dot(&side.normal)
            };
            let whole: f64 = pair.iter().map(area).sum();
            let covered: f64 = on.iter().map(area).sum();
            if (covered - whole).abs() <= COVER_RATIO * whole {
                sides.extend(pair);
            } else if covered.abs() > COVER_RATIO * whole {
                sides.extend(fan::anew(&on, bounds, self.near_mm));
            }
        }
        sides
    }
}

/// Returns the corners of the part of a triangle in a box; fewer than three if there is none.
fn within(corners: &Corners, bounds: &Aabb) -> Vec<Point> {
    let mut ring = corners.to_vec();
    for axis in 0..3 {
        for (sign, end) in [(1.0, bounds.max[axis]), (-1.0, bounds.min[axis])] {
            let height = |at: &Point| sign * (at[axis] - end);
            if !ring.iter().any(|at| height(at) > 0.0) {
                continue;
            }
            let before = std::mem::take(&mut ring);
            for (k, from) in before.iter().enumerate() {
                let to = &before[(k + 1) % before.len()];
                let [here, there] = [height(from), height(to)];
                if here <= 0.0 {
                    ring.push(*from);
                }
                if (here > 0.0 && there < 0.0) || (here < 0.0 && there > 0.0) {
                    let mut crossing = cross([*from, *to], [here, there]);
                    crossing[axis] = end;
                    ring.push(crossing);
                }
            }
        }
    }
    ring.dedup();
    if ring.len() > 1 && ring.first() == ring.last() {
        ring.pop();
    }
    ring
}

/// Returns the triangles of a convex ring.
fn fan(ring: &[Point]) -> impl Iterator<Item = Corners> {
    ring[1..].windows(2).map(|pair| [ring[0], pair[0], pair[1]])
}

/// Returns true if some of a box lies above a plane.
fn crosses(plane: &Plane, room: &Aabb) -> bool {
    let half = room.size() * 0.5;
    let reach = half.dot(&plane.normal.abs());
    plane.distance(&room.center()) + reach > 0.0
}
