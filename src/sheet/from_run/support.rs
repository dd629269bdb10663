//! The overhangs of each part in print pose, which need support.

use std::collections::BTreeMap;

use crate::geom::{Bvh, Plane, Point, Vector};
use crate::mesh::union_find::UnionFind;
use crate::mesh::{TriMesh, foot_area_mm2};
use crate::poses::{Columns, Shape, Support, SupportRule};
use crate::repair::weld;
use crate::run::{Made, Placed, WrittenPart};
use crate::sheet::SupportRow;
use crate::verify::Peg;

/// Distance up to which a point lies on a surface of the uncut body, mm. Files round to 1e-5 mm and
/// repaired folds move by less than this; no wall is thinner.
const ON_SURFACE_MM: f64 = 0.01;
/// Margin around a socket in the search for its roof, mm: it allows for rounding.
const SOCKET_ROOM_MM: f64 = 0.01;
/// Side of the smallest square that needs support, in line widths: the lines beside it carry less.
/// With a smaller side every facet would need support, with a larger one a fingertip would get
/// none.
const LEAST_LINES: f64 = 3.0;

/// Distance between the columns of the estimate, mm: about a line of filament.
const COLUMN_MM: f64 = 0.5;

/// The kind of surface at a point of a part.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Side {
    Outside,
    Hollow,
    CutFace,
    /// In a socket or an engraved id, whose roofs are bridged.
    Bridged,
}

/// The surfaces that tell the kind of a place, model frame.
pub struct Surfaces {
    outer: Bvh,
    voids: Bvh,
    cuts: Vec<Plane>,
}

impl Surfaces {
    /// Returns the surfaces of what was made.
    pub fn of(made: &Made) -> Self {
        let hollowed = &made.hollowed;
        let voids = hollowed
            .voids
            .iter()
            .fold(TriMesh::default(), |all, void| all.joined(void.mesh()));
        Self {
            outer: Bvh::new(hollowed.outer.mesh().iter_corners()),
            voids: Bvh::new(voids.iter_corners()),
            cuts: made
                .plan
                .cuts
                .iter()
                .filter_map(|cut| cut.plane().ok())
                .collect(),
        }
    }

    /// Returns the kind of surface at a point of a part.
    fn side(&self, at: &Point, [pins, sockets]: [&[Peg]; 2]) -> Side {
        let is_on = |surface: &Bvh| surface.closest(at, ON_SURFACE_MM, &[]).is_some();
        let is_in = |peg: &Peg| is_in_peg(peg, at);
        if sockets.iter().any(is_in) {
            Side::Bridged
        } else if is_on(&self.outer) {
            Side::Outside
        } else if is_on(&self.voids) {
            Side::Hollow
        } else if pins.iter().any(is_in)
            || self
                .cuts
                .iter()
                .any(|cut| cut.distance(at).abs() < ON_SURFACE_MM)
        {
            Side::CutFace
        } else {
            Side::Bridged
        }
    }
}

/// Returns whether a point is in a pin or a socket, its rim included.
fn is_in_peg(peg: &Peg, at: &Point) -> bool {
    let from_base = at - Point::from(peg.center_mm);
    let axis = Vector::from(peg.axis);
    let along = from_base.dot(&axis);
    let aside = (from_base - axis * along).norm();
    along > -SOCKET_ROOM_MM
        && along < peg.length_mm + SOCKET_ROOM_MM
        && aside < 0.5 * peg.diameter_mm + SOCKET_ROOM_MM
}

/// Returns the overhangs of a part; `None` if the printer does not say which surfaces print without
/// support.
pub fn support_row(
    placed: &Placed,
    surfaces: &Surfaces,
    written: &WrittenPart,
    pegs: [&[Peg]; 2],
) -> Option<SupportRow> {
    let overhang_deg = placed.shop.printer.cleaning_rule().overhang_deg?;
    let pose = written.evidence().pose;
    let rule = Rule {
        steepest: overhang_deg.to_radians().cos(),
        layer_mm: placed.shop.printer.layer_mm.value,
        least_mm2: (LEAST_LINES * placed.shop.printer.pixel_x_mm.value).powi(2),
    };
    let side = |at: &Point| surfaces.side(&pose.to_model(at), pegs);
    let mesh = weld(written.surface());
    let found = find_overhangs(&mesh, &rule, side);
    let material_mm3 = if found.places > 0 {
        let rule = SupportRule {
            overhang_deg,
            layer_mm: rule.layer_mm,
        };
        estimate_mm3(&mesh, &rule)
    } else {
        0.0
    };
    Some(SupportRow {
        material_mm3,
        foot_mm2: foot_area_mm2(&mesh),
        ..found
    })
}

/// Estimates the material of the support under a part in print pose, mm³.
fn estimate_mm3(mesh: &TriMesh, rule: &SupportRule) -> f64 {
    let (shape, up) = (Shape::plain(mesh), Vector::z());
    let columns = Columns::of(&shape, &up, COLUMN_MM);
    Support::of(&shape, &columns, &up, rule).material_mm3()
}

/// The rule by which a surface needs support.
struct Rule {
    /// Greatest downward component of a normal that prints without support.
    steepest: f64,
    /// Height of a layer, mm; all below it lies on the plate.
    layer_mm: f64,
    /// Least area that needs support, mm²; neighbours carry smaller places.
    least_mm2: f64,
}

/// A place that needs support.
#[derive(Default)]
struct Place {
    area_mm2: f64,
    heights_mm: Option<[f64; 2]>,
    starts: bool,
}

impl Place {
    /// Extends the place to this height.
    fn extend_to(&mut self, z: f64) {
        let [low, high] = self.heights_mm.unwrap_or([z, z]);
        self.heights_mm = Some([low.min(z), high.max(z)]);
    }
}

/// Returns the overhangs of a part in print pose; `side` returns the kind of surface at a point.
///
/// A place is a set of triangles of the same kind that look down too steeply and share vertices. A
/// vertex at which material begins in the air is a place too.
fn find_overhangs(mesh: &TriMesh, rule: &Rule, side: impl Fn(&Point) -> Side) -> SupportRow {
    let floor_mm = mesh.aabb().min.z;
    let height = |corner: u32| mesh.vertices()[corner as usize].z - floor_mm;
    let mut sets = UnionFind::new(mesh.vertices().len());
    let mut steep: Vec<(Side, [u32; 3], f64)> = Vec::new();
    for (index, &corners) in mesh.triangles().iter().enumerate() {
        let [a, b, c] = mesh.corners(index);
        let normal = (b - a).cross(&(c - a));
        let is_on_plate = corners.iter().all(|&corner| height(corner) < rule.layer_mm);
        if -normal.z <= rule.steepest * normal.norm() || is_on_plate {
            continue;
        }
        let middle = Point::from((a.coords + b.coords + c.coords) / 3.0);
        steep.push((side(&middle), corners, -0.5 * normal.z));
        sets.merge(corners[0], corners[1]);
        sets.merge(corners[1], corners[2]);
    }
    let mut places: BTreeMap<(u32, Side), Place> = BTreeMap::new();
    for (side, corners, area_mm2) in steep {
        let place = places.entry((sets.root(corners[0]), side)).or_default();
        place.area_mm2 += area_mm2;
        corners
            .iter()
            .for_each(|&corner| place.extend_to(height(corner)));
    }
    for corner in find_starts(mesh, rule.layer_mm) {
        let place = places
            .entry((sets.root(corner), side(&mesh.vertices()[corner as usize])))
            .or_default();
        place.starts = true;
        place.extend_to(height(corner));
    }
    places.retain(|(_, side), place| {
        *side != Side::Bridged && (place.starts || place.area_mm2 >= rule.least_mm2)
    });
    to_row(&places)
}

fn to_row(places: &BTreeMap<(u32, Side), Place>) -> SupportRow {
    let area_mm2 = |wanted: Side| {
        let of_side = places.iter().filter(|((_, side), _)| *side == wanted);
        of_side.fold(0.0, |sum, (_, place)| sum + place.area_mm2)
    };
    let heights = || places.values().filter_map(|place| place.heights_mm);
    let from_mm = heights().map(|[low, _]| low).fold(f64::INFINITY, f64::min);
    SupportRow {
        places: places.len(),
        outside_mm2: area_mm2(Side::Outside),
        hollow_mm2: area_mm2(Side::Hollow),
        cut_face_mm2: area_mm2(Side::CutFace),
        from_mm: if places.is_empty() { 0.0 } else { from_mm },
        to_mm: heights().map(|[_, high]| high).fold(0.0, f64::max),
        ..SupportRow::default()
    }
}

/// Returns the vertices at which material begins in the air. They are local minima off the plate
/// that look down. They lie a layer or more below the height at which they meet older material.
///
/// That difference is the persistence of the height: Edelsbrunner, Letscher and Zomorodian,
/// "Topological persistence and simplification", Discrete & Computational Geometry 28, 2002.
fn find_starts(mesh: &TriMesh, layer_mm: f64) -> Vec<u32> {
    let vertices = mesh.vertices();
    let floor_mm = mesh.aabb().min.z;
    let mut order: Vec<u32> = (0..vertices.len() as u32).collect();
    order.sort_by(|&a, &b| {
        vertices[a as usize]
            .z
            .total_cmp(&vertices[b as usize].z)
            .then(a.cmp(&b))
    });
    let mut ranks = vec![0u32; order.len()];
    for (rank, &corner) in order.iter().enumerate() {
        ranks[corner as usize] = rank as u32;
    }
    // Edges by the rank of their upper end: sets merge at the height at which both ends exist.
    let mut edges: Vec<[u32; 2]> = mesh
        .triangles()
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
        .map(|edge| edge.map(|corner| ranks[corner as usize]))
        .map(|[a, b]| [a.max(b), a.min(b)])
        .collect();
    edges.sort_unstable();
    let height = |rank: u32| vertices[order[rank as usize] as usize].z;
    let mut sets = UnionFind::new(order.len());
    let mut found: Vec<u32> = Vec::new();
    for [upper, lower] in edges {
        let younger = sets.root(upper).max(sets.root(lower));
        if sets.merge(upper, lower)
            && height(upper) - height(younger) >= layer_mm
            && height(younger) - floor_mm >= layer_mm
        {
            found.push(order[younger as usize]);
        }
    }
    let down = looks_down(mesh, &found);
    found
        .into_iter()
        .filter(|corner| down.contains(corner))
        .collect()
}

/// Returns the vertices around which more of the surface looks down than up.
fn looks_down(mesh: &TriMesh, corners: &[u32]) -> Vec<u32> {
    let mut up_mm2: BTreeMap<u32, f64> = corners.iter().map(|&corner| (corner, 0.0)).collect();
    for (index, triangle) in mesh.triangles().iter().enumerate() {
        let [a, b, c] = mesh.corners(index);
        for corner in triangle {
            if let Some(up) = up_mm2.get_mut(corner) {
                *up += (b - a).cross(&(c - a)).z;
            }
        }
    }
    up_mm2
        .into_iter()
        .filter(|(_, up)| *up < 0.0)
        .map(|(corner, _)| corner)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Csg, primitives};

    /// 45°, layers of 0.2 mm, lines of 0.45 mm.
    const RULE: Rule = Rule {
        steepest: std::f64::consts::FRAC_1_SQRT_2 + 1e-9,
        layer_mm: 0.2,
        least_mm2: (LEAST_LINES * 0.45) * (LEAST_LINES * 0.45),
    };

    fn block(low: [f64; 3], high: [f64; 3]) -> Csg {
        Csg::of_mesh(&primitives::cuboid(&low.into(), &high.into())).unwrap()
    }

    fn outside(mesh: &TriMesh) -> SupportRow {
        find_overhangs(mesh, &RULE, |_| Side::Outside)
    }

    #[test]
    fn a_block_needs_no_support_and_a_table_does_beside_its_leg() {
        let leg = block([0.0; 3], [10.0, 10.0, 20.0]);
        assert_eq!(outside(&leg.to_mesh().unwrap()), SupportRow::default());
        let table = leg
            .union(&block([-5.0, -5.0, 20.0], [15.0, 15.0, 22.0]))
            .unwrap()
            .to_mesh()
            .unwrap();
        let row = outside(&table);
        assert!((row.outside_mm2 - 300.0).abs() < 1e-9 && row.places == 1);
        assert_eq!([row.from_mm, row.to_mm], [20.0, 20.0]);
    }

    #[test]
    fn socket_roofs_and_places_under_three_lines_need_no_support() {
        let hole = |side: f64| {
            let cut = block([4.0, 4.0, -1.0], [4.0 + side, 4.0 + side, 5.0]);
            block([0.0; 3], [10.0, 10.0, 20.0])
                .subtract(&cut)
                .unwrap()
                .to_mesh()
                .unwrap()
        };
        assert_eq!(
            find_overhangs(&hole(4.0), &RULE, |_| Side::Bridged).places,
            0
        );
        // 1.3² = 1.69 mm² is less than 1.35² = 1.82 mm², 1.4² = 1.96 mm² is more.
        assert_eq!(outside(&hole(1.3)).places, 0);
        assert_eq!(outside(&hole(1.4)).places, 1);
    }

    #[test]
    fn a_steep_tip_that_begins_in_the_air_needs_support() {
        let body = block([0.0; 3], [10.0, 10.0, 20.0]);
        let arm = block([10.0, 2.0, 10.0], [20.0, 8.0, 20.0]);
        let bare = body.union(&arm).unwrap().to_mesh().unwrap();
        let fall =
            |p: &Point| Point::new(p.x, p.y, if p.x > 19.0 && p.z < 11.0 { 2.0 } else { p.z });
        // Its lower face falls 8 mm over 10 mm outward: 39° from level, so it overhangs. A steeper
        // one does not.
        let leaning = bare.map_vertices(|p| fall(p));
        assert_eq!(outside(&leaning).places, 1);
        let steep = leaning.map_vertices(|p| {
            Point::new(
                10.0 + (p.x - 10.0) * if p.x > 10.0 { 0.5 } else { 1.0 },
                p.y,
                p.z,
            )
        });
        let row = outside(&steep);
        assert_eq!((row.places, row.outside_mm2), (1, 0.0));
        assert!((row.from_mm - 2.0).abs() < 1e-9);
    }

    #[test]
    fn a_pit_in_the_top_is_no_tip() {
        let cut = block([2.0, 2.0, 10.0], [8.0, 8.0, 30.0]);
        let cup = block([0.0; 3], [10.0, 10.0, 20.0])
            .subtract(&cut)
            .unwrap()
            .to_mesh()
            .unwrap();
        assert_eq!(outside(&cup), SupportRow::default());
    }
}
