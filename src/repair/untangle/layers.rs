//! Layers: how often the surface winds around the space in front of each piece.

use super::pieces::{Pieces, Seam};
use crate::geom::{Bvh, Point};
use crate::mesh::edges::{EdgeKind, EdgeTable, Side, edge_kind};
use crate::mesh::{TriMesh, area_mm2};

/// Number of pieces of a connected part that are asked for their winding number. One would do, but
/// for points so near to another surface that the step beside the piece passes through it.
const MAX_WITNESSES: usize = 5;

/// Step beside a piece at which the winding number is asked, as a share of the root of its area.
/// Below 1e-9 rounding decides on which side it lies. Above 1e-3 other surfaces are passed.
const STEP_RATIO: f64 = 1e-5;

/// A neighbour of a piece, and how much larger its number is.
type Link = (u32, i32);

/// Returns the winding number of the whole surface in front of each piece; `None` if the pieces
/// contradict each other. Behind each piece it is larger by one.
///
/// Across an edge of the mesh the number stays; across a seam it changes by one as its direction
/// tells. One piece of each connected part is asked by exact ray casting.
pub(super) fn layers_in_front(old: &TriMesh, whole: &TriMesh, pieces: &Pieces) -> Option<Vec<i32>> {
    let links = links(whole, pieces)?;
    let bvh = Bvh::new(old.iter_corners());
    let mut layers: Vec<Option<i32>> = vec![None; links.len()];
    for first in 0..links.len() {
        if layers[first].is_some() {
            continue;
        }
        let part = spread(&links, &mut layers, first)?;
        let shift = shift(whole, &bvh, &part, &layers)?;
        for &piece in &part {
            layers[piece as usize] = layers[piece as usize].map(|layer| layer + shift);
        }
    }
    layers.into_iter().collect()
}

/// Links pieces across all edges but those at which surfaces touch.
fn links(whole: &TriMesh, pieces: &Pieces) -> Option<Vec<Vec<Link>>> {
    let mut links: Vec<Vec<Link>> = vec![Vec::new(); whole.triangles().len()];
    for sides in EdgeTable::of(whole).edges() {
        let levels: Vec<i32> = match pieces.seams.get(&[sides[0].low, sides[0].high]) {
            Some(seam) => levels_at(seam, sides, pieces)?,
            None if edge_kind(sides) == EdgeKind::Paired => vec![0; 2],
            None if edge_kind(sides) == EdgeKind::Crowded => continue,
            None => return None,
        };
        for (side, level) in sides[1..].iter().zip(&levels[1..]) {
            let (a, b) = (sides[0].triangle(), side.triangle());
            links[a].push((b as u32, level - levels[0]));
            links[b].push((a as u32, levels[0] - level));
        }
    }
    Some(links)
}

/// Returns the numbers of the four sides of a seam, up to a common one; `None` if they are not two
/// of each triangle, one on either side.
fn levels_at(seam: &Seam, sides: &[Side], pieces: &Pieces) -> Option<Vec<i32>> {
    let mut seen = Vec::with_capacity(4);
    let mut levels = Vec::with_capacity(4);
    for side in sides {
        let parent = pieces.parents[side.triangle()];
        let is_first = parent == seam.triangles[0];
        (is_first || parent == seam.triangles[1]).then_some(())?;
        let is_left = side.forward == (seam.start == side.low);
        // Left of the seam the first triangle lies behind the second, right of it the second
        // behind the first.
        levels.push(i32::from(is_first == is_left));
        seen.push((is_first, is_left));
    }
    seen.sort_unstable();
    let all = [(false, false), (false, true), (true, false), (true, true)];
    (seen == all).then_some(levels)
}

/// Numbers the pieces connected to `first`, which gets 0, and returns them.
fn spread(links: &[Vec<Link>], layers: &mut [Option<i32>], first: usize) -> Option<Vec<u32>> {
    layers[first] = Some(0);
    let mut part = vec![first as u32];
    let mut next = 0;
    while let Some(&piece) = part.get(next) {
        next += 1;
        let own = layers[piece as usize]?;
        for &(other, more) in &links[piece as usize] {
            match layers[other as usize] {
                None => {
                    layers[other as usize] = Some(own + more);
                    part.push(other);
                }
                Some(known) if known == own + more => {}
                Some(_) => return None,
            }
        }
    }
    Some(part)
}

/// Returns by how much the numbers of a connected part are too small; `None` if its largest pieces
/// do not agree.
fn shift(whole: &TriMesh, bvh: &Bvh, part: &[u32], layers: &[Option<i32>]) -> Option<i32> {
    let area = |piece: &u32| area_mm2(&whole.corners(*piece as usize));
    let mut largest = part.to_vec();
    largest.sort_by(|a, b| area(b).total_cmp(&area(a)).then(a.cmp(b)));
    largest.truncate(MAX_WITNESSES);
    let shifts = largest.iter().filter_map(|&piece| {
        let found = winding_in_front(&whole.corners(piece as usize), bvh)?;
        Some(found - layers[piece as usize]?)
    });
    let shifts: Vec<i32> = shifts.collect();
    let agree = shifts.windows(2).all(|pair| pair[0] == pair[1]);
    shifts.first().copied().filter(|_| agree)
}

/// Returns the winding number just in front of a piece; `None` if that behind is not larger by one.
fn winding_in_front(corners: &[Point; 3], bvh: &Bvh) -> Option<i32> {
    let [a, b, c] = corners;
    let normal = (b - a).cross(&(c - a)).try_normalize(0.0)?;
    let center = Point::from((a.coords + b.coords + c.coords) / 3.0);
    let step = normal * (STEP_RATIO * area_mm2(corners).sqrt());
    let (front, back) = (bvh.winding(&(center + step)), bvh.winding(&(center - step)));
    (back == front + 1).then_some(front)
}
