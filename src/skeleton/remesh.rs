//! Remeshes a surface with triangles that are small, round and of one size.
//!
//! Botsch and Kobbelt, "A Remeshing Approach to Multiresolution Modeling", SGP 2004. Long edges are
//! split, short ones collapse, others flip towards six neighbours. Vertices then relax along the
//! surface and are laid back on it.

use super::surface::{Diamond, Surface, area_vector};
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Bvh, NO_HINT, Point, Vector};

/// Rounds of remeshing: after five the shapes of the triangles hardly change.
const ROUNDS: usize = 5;
/// Edges longer than the first share of the wanted length are split, shorter than the second
/// collapse. Halves are no shorter than that, and joined edges no longer.
const LONG_RATIO: f64 = 4.0 / 3.0;
const SHORT_RATIO: f64 = 4.0 / 5.0;
/// Sweeps over the edges at most. Each halves the long edges of a coarse mesh, or the number of the
/// short ones of a fine mesh. A factor of 2¹² is enough for any.
const MOST_SWEEPS: usize = 12;
/// The number of neighbours in a sheet of equal triangles.
const WANTED_VALENCE: i64 = 6;
/// Share of the way to the middle of its neighbours that a vertex is moved: all of it swings.
const RELAX_RATIO: f64 = 0.6;
/// Least cosine between a triangle's normal before and after a step: 60°. Below, folds arise.
const LEAST_TURN_COSINE: f64 = 0.5;

/// Remeshes a surface to about so many triangles; every vertex lies on `original`.
pub(super) fn remesh(
    surface: &mut Surface,
    original: &Bvh,
    triangles: usize,
    watch: &Watch,
) -> Result<(), Cancelled> {
    let length_mm = edge_length_mm(surface.area_mm2(), triangles);
    for _ in 0..ROUNDS {
        watch.check()?;
        split_long(surface, LONG_RATIO * length_mm);
        watch.check()?;
        collapse_short(surface, length_mm);
        flip_edges(surface);
        relax(surface, original);
    }
    Ok(())
}

/// Returns the side of equilateral triangles that together have an area, mm.
fn edge_length_mm(area_mm2: f64, triangles: usize) -> f64 {
    (area_mm2 / triangles as f64 * 4.0 / 3f64.sqrt()).sqrt()
}

fn split_long(surface: &mut Surface, most_mm: f64) {
    for _ in 0..MOST_SWEEPS {
        let edges = surface.edges();
        let long = edges
            .into_iter()
            .filter(|edge| surface.length_mm(*edge) > most_mm);
        let long: Vec<[u32; 2]> = long.collect();
        if long.is_empty() {
            return;
        }
        for edge in long {
            if let Some(diamond) = surface.diamond(edge) {
                surface.split(diamond, middle(surface, edge));
            }
        }
    }
}

fn middle(surface: &Surface, [a, b]: [u32; 2]) -> Point {
    nalgebra::center(&surface.place(a), &surface.place(b))
}

fn collapse_short(surface: &mut Surface, length_mm: f64) {
    for _ in 0..MOST_SWEEPS {
        let mut is_done = true;
        for edge in surface.edges() {
            is_done &= !collapse_if_short(surface, edge, length_mm);
        }
        if is_done {
            return;
        }
    }
}

/// Collapses an edge that is short, if it may be; false if nothing was done.
fn collapse_if_short(surface: &mut Surface, edge: [u32; 2], length_mm: f64) -> bool {
    let is_short = edge.iter().all(|v| surface.is_alive(*v))
        && surface.length_mm(edge) < SHORT_RATIO * length_mm;
    let diamond = surface.diamond(edge).filter(|_| is_short);
    if !diamond.is_some_and(|diamond| surface.may_collapse(diamond)) {
        return false;
    }
    let at = middle(surface, edge);
    let is_gentle = is_gentle(surface, edge, &at, LONG_RATIO * length_mm);
    if is_gentle {
        surface.collapse(edge, at);
    }
    is_gentle
}

/// Returns true if a collapse to `at` makes no long edge and turns no triangle over.
fn is_gentle(surface: &Surface, edge: [u32; 2], at: &Point, most_mm: f64) -> bool {
    let around = |v: u32| surface.neighbours(v);
    let reaches = |v: u32| around(v).all(|w| (surface.place(w) - at).norm() <= most_mm);
    let keeps = |v: u32| {
        let stays = surface
            .star(v)
            .filter(|t| !edge.iter().all(|end| t.contains(end)));
        stays.into_iter().all(|t| {
            let before = area_vector(surface.corners(t));
            let moved = t.map(|w| if w == v { *at } else { surface.place(w) });
            is_alike(&before, &area_vector(moved))
        })
    };
    edge.iter().all(|v| reaches(*v) && keeps(*v))
}

/// Returns true if two normals differ by less than 60°.
fn is_alike(before: &Vector, after: &Vector) -> bool {
    after.dot(before) > LEAST_TURN_COSINE * after.norm() * before.norm()
}

fn flip_edges(surface: &mut Surface) {
    for edge in surface.edges() {
        if let Some(diamond) = surface.diamond(edge)
            && evens_out(surface, diamond)
            && surface.may_flip(diamond)
            && stays_smooth(surface, diamond)
        {
            surface.flip(diamond);
        }
    }
}

/// Returns true if a flip brings the numbers of neighbours nearer to six.
fn evens_out(surface: &Surface, diamond: Diamond) -> bool {
    let off = |v: u32, change: i64| (surface.valence(v) as i64 + change - WANTED_VALENCE).pow(2);
    let sum = |sign: i64| {
        let ends: i64 = diamond.ends.iter().map(|v| off(*v, -sign)).sum();
        let across: i64 = diamond.across.iter().map(|v| off(*v, sign)).sum();
        ends + across
    };
    sum(1) < sum(0)
}

/// Returns true if the triangles after a flip face as those before.
fn stays_smooth(surface: &Surface, diamond: Diamond) -> bool {
    let ([a, b], [c, d]) = (diamond.ends, diamond.across);
    let area = |t: [u32; 3]| area_vector(surface.corners(t));
    let before = area([a, b, c]) + area([b, a, d]);
    let mut after = diamond.flipped().into_iter().map(area);
    after.all(|normal| is_alike(&before, &normal))
}

/// Moves every vertex towards the middle of its neighbours, along the surface.
fn relax(surface: &mut Surface, original: &Bvh) {
    let vertices: Vec<u32> = surface.vertices().collect();
    let mut hint = NO_HINT;
    for v in vertices {
        let place = surface.place(v);
        let sum: Vector = surface
            .neighbours(v)
            .map(|w| surface.place(w) - place)
            .sum();
        let step = sum / surface.valence(v) as f64;
        let normal = surface.normal(v).try_normalize(0.0);
        let across = normal.map_or(Vector::zeros(), |n| n * n.dot(&step));
        let moved = place + (step - across) * RELAX_RATIO;
        let nearest = original.closest(&moved, f64::INFINITY, &[hint]);
        if let Some(nearest) = nearest {
            surface.at[v as usize] = nearest.point;
            hint = nearest.hint;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Solid;
    use crate::mesh::primitives::{cuboid, cylinder};

    #[test]
    fn a_block_of_twelve_triangles_gets_small_round_ones_on_its_faces() {
        let mesh = cuboid(&Point::origin(), &Point::new(30.0, 20.0, 10.0));
        let mut surface = Surface::of(&mesh);
        let original = Bvh::new(mesh.iter_corners());
        remesh(&mut surface, &original, 2000, &Watch::silent()).unwrap();
        let (mesh, _) = surface.compact();
        assert!((1400..2600).contains(&mesh.triangles().len()));
        let solid = Solid::new(mesh).unwrap();
        // Edges of the block are cut by less than the triangles are long: 2200 mm² in 2000.
        assert!((solid.mesh().signed_volume_mm3() / 6000.0 - 1.0).abs() < 0.02);
        let longest = surface
            .edges()
            .into_iter()
            .map(|edge| surface.length_mm(edge))
            .fold(0.0, f64::max);
        assert!(longest < 2.0 * edge_length_mm(2200.0, 2000), "{longest}");
    }

    #[test]
    fn a_fine_cylinder_gets_fewer_triangles() {
        let mesh = cylinder(5.0, 40.0, 600);
        let mut surface = Surface::of(&mesh);
        let original = Bvh::new(mesh.iter_corners());
        remesh(&mut surface, &original, 1000, &Watch::silent()).unwrap();
        assert!((700..1300).contains(&surface.triangles().count()));
        assert!(Solid::new(surface.compact().0).is_ok());
    }
}
