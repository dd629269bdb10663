//! Joins the pieces again that a cut separates needlessly: a plane also slices what merely reaches
//! across it.

use crate::{
    base::watch::{Cancelled, Watch},
    cut::{
        error::CutError,
        geometry::{
            chart::{Chart, Point2},
            section::Section,
            tree::{CutTree, Limit},
        },
        hollowed::Hollowed,
        pieces::{
            pose::{choose_pose, sides_down},
            split::{Cap, Joint, Piece, joints, piece, piece_at, sort_pieces},
        },
        plan::Bridge,
        request::PlanRequest,
    },
    geom::{Plane, Point},
    mesh::{Csg, Solid, TriMesh, union_find::UnionFind},
    repair::sew,
};
use rayon::prelude::*;

/// Distance within which a corner of a void's mouth lies on the outline of the cut face, mm. They
/// are the same points but for rounding, and a wall separates different mouths.
const MOUTH_TOLERANCE_MM: f64 = 1e-6;

/// Distance within which corners of two meeting faces are the same, mm. One cut makes both, with a
/// rounding of 1e-13; the model's own corners are farther apart.
const SEAM_TOLERANCE_MM: f64 = 1e-9;

/// Cells on a side of the height map that checks the way out of a part. A coarser map joins fewer
/// pieces.
const MAP_CELLS: usize = 96;

/// The body, the cuts and the request.
pub(crate) struct Cutting<'a> {
    pub(crate) hollowed: &'a Hollowed,
    pub(crate) tree: &'a CutTree,
    pub(crate) request: &'a PlanRequest,
}

impl Cutting<'_> {
    /// Returns whether a cut acts on a piece. A piece beyond the cut's limits is removed before the
    /// two sides of that cut come apart.
    fn acts_on(&self, cut: usize, piece: &Piece) -> bool {
        let holds = |limit: &Limit| piece.is_above(&self.tree.planes[limit.cut]) == limit.is_above;
        self.tree.limits(cut).iter().all(holds)
    }
}

/// Returns the faces over which pieces had better stay joined. A piece stays joined if it touches a
/// single other one, and
///
/// * no void opens in the face between them,
/// * the piece does not block what is removed on its side of the cut,
/// * both together fit the build volume.
///
/// A piece thinner than the wall stays joined even if a void opens beside it. It is a bump of the
/// void's wall that the plane grazes, or a sliver of the outside, and no part to print.
///
/// The smallest pieces are tried first. A piece that others stay joined to is not joined to a
/// third.
pub(crate) fn find_bridges(cutting: &Cutting, pieces: &[Piece]) -> Result<Vec<Bridge>, Cancelled> {
    let joints = joints(pieces, cutting.tree);
    if joints.len() < 2 {
        return Ok(Vec::new());
    }
    let watch = &cutting.request.watch;
    watch.check()?;
    let mouths = mouths(cutting);
    let mut order: Vec<usize> = (0..pieces.len()).collect();
    order.sort_by(|&i, &j| pieces[i].volume_mm3.total_cmp(&pieces[j].volume_mm3));
    let mut is_host = vec![false; pieces.len()];
    let mut is_guest = vec![false; pieces.len()];
    let mut bridges = Vec::new();
    for index in order {
        watch.check()?;
        let touching: Vec<&Joint> = joints.iter().filter(|joint| joint.touches(index)).collect();
        let [joint] = touching[..] else { continue };
        let host = joint.other(index);
        if !is_host[index]
            && !is_guest[host]
            && (is_sliver(cutting, &pieces[index], joint) || !has_mouth(joint, &mouths))
            && lets_others_out(cutting, pieces, joint, index)
            && fits_together(cutting, &pieces[index], &pieces[host])
        {
            (is_guest[index], is_host[host]) = (true, true);
            let at = |face: &Cap| Bridge {
                cut: joint.cut,
                at: face.inner_point(),
            };
            bridges.extend(joint.faces.iter().map(at));
        }
    }
    Ok(bridges)
}

/// Returns the pieces, with those united that meet at a bridge. A bridge on no cut face changes
/// nothing.
pub(crate) fn rejoin(
    pieces: Vec<Piece>,
    tree: &CutTree,
    bridges: &[Bridge],
    watch: &Watch,
) -> Result<Vec<Piece>, CutError> {
    let mut sets = UnionFind::new(pieces.len());
    for bridge in bridges {
        let side = |is_above| piece_at(&pieces, bridge.cut, is_above, &bridge.at);
        if let (Some(below), Some(above)) = (side(false), side(true)) {
            sets.merge(below as u32, above as u32);
        }
    }
    let mut groups: Vec<Vec<Piece>> = pieces.iter().map(|_| Vec::new()).collect();
    for (index, piece) in pieces.into_iter().enumerate() {
        groups[sets.root(index as u32) as usize].push(piece);
    }
    groups.retain(|group| !group.is_empty());
    let united = groups.into_par_iter().map(|group| {
        watch.check()?;
        unite(group, tree, bridges)
    });
    Ok(sort_pieces(united.collect::<Result<_, _>>()?))
}

/// Returns, for each plane, the corners of its sections of all voids.
fn mouths(cutting: &Cutting) -> Vec<Vec<Point2>> {
    let corners = |plane: &Plane| {
        let sections = cutting
            .hollowed
            .voids
            .iter()
            .map(|void| Section::of_mesh(void.mesh(), plane));
        sections
            .flat_map(|section| section.rings)
            .flat_map(|ring| ring.points)
            .collect()
    };
    cutting.tree.planes.par_iter().map(corners).collect()
}

/// Returns whether a void opens in one of the joint's faces.
fn has_mouth(joint: &Joint, mouths: &[Vec<Point2>]) -> bool {
    let on_edge = |cap: &Cap| {
        let Some((min, max)) = cap.outline.bounds() else {
            return false;
        };
        let near = mouths[joint.cut]
            .iter()
            .filter(|p| p.x >= min.x && p.y >= min.y && p.x <= max.x && p.y <= max.y);
        near.into_iter()
            .any(|p| cap.outline.signed_distance(p).abs() <= MOUTH_TOLERANCE_MM)
    };
    joint.faces.iter().any(on_edge)
}

/// Returns whether a piece is thinner than the least wall: its volume over the area of the face
/// that would be glued.
fn is_sliver(cutting: &Cutting, piece: &Piece, joint: &Joint) -> bool {
    let face_mm2: f64 = piece
        .caps
        .iter()
        .filter(|cap| cap.cut == joint.cut)
        .map(|cap| cap.area_mm2)
        .sum();
    piece.volume_mm3 < cutting.request.wall_mm * face_mm2
}

/// Returns whether everything else on the piece's side of the cut can be removed along the normal
/// while the piece stays.
fn lets_others_out(cutting: &Cutting, pieces: &[Piece], joint: &Joint, index: usize) -> bool {
    let plane = &cutting.tree.planes[joint.cut];
    let is_above = joint.above == index;
    let sign = if is_above { 1.0 } else { -1.0 };
    let map = HeightMap::new(&pieces[index].mesh, plane, sign);
    let is_cut_apart = |i: usize| cutting.acts_on(joint.cut, &pieces[i]);
    let moves =
        |i: &usize| *i != index && is_cut_apart(*i) && pieces[*i].is_above(plane) == is_above;
    (0..pieces.len())
        .filter(moves)
        .all(|i| !map.blocks(&pieces[i].mesh))
}

fn fits_together(cutting: &Cutting, a: &Piece, b: &Piece) -> bool {
    let both = a.mesh.clone().joined(&b.mesh);
    choose_pose(
        &both,
        &sides_down(b, &cutting.tree.planes, &[], cutting.request),
        cutting.request,
    )
    .fits
}

/// Returns one piece made of several that touch at bridges.
fn unite(mut members: Vec<Piece>, tree: &CutTree, bridges: &[Bridge]) -> Result<Piece, CutError> {
    if members.len() == 1 {
        return Ok(members.remove(0));
    }
    let mesh = match stitch(&members, bridges) {
        Some(mesh) => mesh,
        None => union_all(members)?,
    };
    Ok(piece(mesh, tree))
}

/// Returns the members without the faces in which they meet, sewn together along the rims of these
/// faces. `None` if the rims do not have the same corners.
///
/// A union would find the planes of the faces 1e-14 mm apart, and sometimes leaves a sheet between
/// them.
fn stitch(members: &[Piece], bridges: &[Bridge]) -> Option<TriMesh> {
    let is_bridge = |cap: &Cap| {
        bridges
            .iter()
            .any(|bridge| bridge.cut == cap.cut && cap.holds(&bridge.at))
    };
    let open = |member: &Piece| {
        let mut is_kept = vec![true; member.mesh.triangles().len()];
        for cap in member.caps.iter().filter(|cap| is_bridge(cap)) {
            cap.faces.iter().for_each(|&face| is_kept[face] = false);
        }
        let remaining = member
            .mesh
            .triangles()
            .iter()
            .zip(is_kept)
            .filter_map(|(t, is_kept)| is_kept.then_some(*t));
        TriMesh::new(member.mesh.vertices().to_vec(), remaining.collect()).ok()
    };
    let all = members.iter().try_fold(TriMesh::default(), |all, member| {
        Some(all.joined(&open(member)?))
    })?;
    Some(Solid::new(sew(&all, SEAM_TOLERANCE_MM)).ok()?.into_mesh())
}

/// Returns the union of the members. The smaller ones are united first, which is cheap.
fn union_all(mut members: Vec<Piece>) -> Result<TriMesh, CutError> {
    members.sort_by(|a, b| a.volume_mm3.total_cmp(&b.volume_mm3));
    let mut body = Csg::of_mesh(&TriMesh::default())?;
    for member in &members {
        body = body.union(&Csg::of_mesh(&member.mesh)?)?;
    }
    Ok(body.to_mesh()?)
}

/// The height of a piece over a grid on the plane. It shows whether another piece can be drawn out
/// past it.
struct HeightMap {
    chart: Chart,
    plane: Plane,
    sign: f64,
    min: Point2,
    cell: nalgebra::Vector2<f64>,
    /// The greatest height in each cell, mm.
    top: Vec<f64>,
}

impl HeightMap {
    fn new(mesh: &TriMesh, plane: &Plane, sign: f64) -> Self {
        let chart = Chart::of_plane(plane);
        let flat = mesh.vertices().iter().map(|p| chart.flat(p));
        let all = Point2::new(f64::INFINITY, f64::INFINITY);
        let (min, max) = flat.fold((all, -all), |(min, max), p| (min.inf(&p), max.sup(&p)));
        let cell = (max - min) / MAP_CELLS as f64;
        let top = vec![f64::NEG_INFINITY; MAP_CELLS * MAP_CELLS];
        let mut map = Self {
            chart,
            plane: *plane,
            sign,
            min,
            cell,
            top,
        };
        for corners in mesh.iter_corners() {
            let (_, high, cells) = map.span(&corners);
            for cell in cells {
                map.top[cell] = map.top[cell].max(high);
            }
        }
        map
    }

    /// Returns whether a triangle of the mesh lies below the mapped piece, which then blocks its
    /// way.
    fn blocks(&self, mesh: &TriMesh) -> bool {
        mesh.iter_corners().any(|corners| {
            let (low, _, mut cells) = self.span(&corners);
            cells.any(|cell| low < self.top[cell])
        })
    }

    /// Returns the least and greatest height of a triangle, and the cells that it meets.
    fn span(&self, corners: &[Point; 3]) -> (f64, f64, impl Iterator<Item = usize> + use<>) {
        let heights = corners.map(|p| self.sign * self.plane.distance(&p));
        let places = corners.map(|p| (self.chart.flat(&p) - self.min).component_div(&self.cell));
        let range = |axis: usize| {
            let (from, to) = extent(places.map(|p| p[axis]));
            // Casts saturate: a triangle beside the grid has an empty range.
            let first = if to < 0.0 {
                MAP_CELLS
            } else {
                from.max(0.0) as usize
            };
            first..((to.max(0.0) as usize).saturating_add(1)).min(MAP_CELLS)
        };
        let (columns, rows) = (range(0), range(1));
        let cells = columns.flat_map(move |i| rows.clone().map(move |j| [i, j]));
        let met = cells
            .filter(move |cell| meets(&places, *cell))
            .map(|[i, j]| i * MAP_CELLS + j);
        let (low, high) = extent(heights);
        (low, high, met)
    }
}

fn extent(values: [f64; 3]) -> (f64, f64) {
    (
        values.iter().copied().fold(f64::INFINITY, f64::min),
        values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
    )
}

/// Returns whether a triangle meets a unit cell, given that their bounding boxes meet: no side of
/// the triangle has the whole cell beyond it.
fn meets(places: &[nalgebra::Vector2<f64>; 3], cell: [usize; 2]) -> bool {
    let middle = nalgebra::Vector2::new(cell[0] as f64 + 0.5, cell[1] as f64 + 0.5);
    let area = (places[1] - places[0]).perp(&(places[2] - places[0]));
    let is_beyond = |from: usize| {
        let side = places[(from + 1) % 3] - places[from];
        let reach = (side.x.abs() + side.y.abs()) / 2.0;
        side.perp(&(middle - places[from])) * area.signum() < -reach
    };
    !(0..3).any(is_beyond)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        cut::{
            pieces::split::split,
            scenes::{cuboid, request},
        },
        geom::Vector,
    };

    fn union(boxes: &[([f64; 3], [f64; 3])]) -> Solid {
        let bodies = boxes
            .iter()
            .map(|&(min, max)| Csg::of_solid(&cuboid(min, max)).unwrap());
        bodies
            .reduce(|sum, body| sum.union(&body).unwrap())
            .unwrap()
            .to_solid()
            .unwrap()
    }

    /// Returns the number of pieces that the plane z = 15 leaves, and the pieces after joining.
    fn cut_at_15(hollowed: &Hollowed) -> (usize, Vec<Piece>) {
        let tree = CutTree::everywhere(&[Plane {
            normal: Vector::z(),
            offset_mm: 15.0,
        }]);
        let request = request();
        let cutting = Cutting {
            hollowed,
            tree: &tree,
            request: &request,
        };
        let watch = &request.watch;
        let pieces = split(&hollowed.to_mesh(), &tree, watch).unwrap();
        let bridges = find_bridges(&cutting, &pieces).unwrap();
        let count = pieces.len();
        (count, rejoin(pieces, &tree, &bridges, watch).unwrap())
    }

    #[test]
    fn the_solid_legs_of_a_table_are_not_cut_off_with_the_hollow_one() {
        let leg = |x: f64, y: f64| ([x, y, 0.0], [x + 10.0, y + 10.0, 31.0]);
        let outer = union(&[
            ([0.0, 0.0, 30.0], [50.0, 50.0, 40.0]),
            leg(0.0, 0.0),
            leg(40.0, 0.0),
            leg(0.0, 40.0),
            leg(40.0, 40.0),
        ]);
        let hollowed = Hollowed::new(outer, vec![cuboid([2.0, 2.0, 4.0], [8.0, 8.0, 25.0])]);
        let (cut, remaining) = cut_at_15(&hollowed);
        assert_eq!((cut, remaining.len()), (5, 2));
        let volume: f64 = remaining.iter().map(|piece| piece.volume_mm3).sum();
        assert!((volume - hollowed.to_mesh().signed_volume_mm3()).abs() < 1e-9 * volume);
    }

    #[test]
    fn a_bump_of_a_voids_floor_that_the_plane_grazes_is_no_part() {
        let outer = cuboid([0.0; 3], [30.0; 3]);
        // A post in the void that rises `over` mm above the plane z = 15.
        let post = |over: f64| {
            let void = Csg::of_solid(&cuboid([5.0; 3], [25.0; 3])).unwrap();
            let post =
                Csg::of_solid(&cuboid([12.0, 12.0, 4.0], [18.0, 18.0, 15.0 + over])).unwrap();
            Hollowed::new(
                outer.clone(),
                vec![void.subtract(&post).unwrap().to_solid().unwrap()],
            )
        };
        let (cut, remaining) = cut_at_15(&post(0.05));
        assert_eq!((cut, remaining.len()), (3, 2));
        // A piece as thick as a wall can be printed and stays a part of its own.
        let (cut, remaining) = cut_at_15(&post(2.0 * request().wall_mm));
        assert_eq!((cut, remaining.len()), (3, 3));
    }

    #[test]
    fn a_bump_is_blocked_by_what_lies_over_it_and_not_by_a_bounding_box() {
        // A void with a post through a level cut, and a slanted cut beside it. The bounding boxes
        // of the faces' large triangles contain the post.
        let void = Csg::of_solid(&cuboid([5.0; 3], [30.0, 30.0, 25.0])).unwrap();
        let post = Csg::of_solid(&cuboid([12.0, 12.0, 4.0], [18.0, 18.0, 15.05])).unwrap();
        let voids = vec![void.subtract(&post).unwrap().to_solid().unwrap()];
        let hollowed = Hollowed::new(cuboid([0.0; 3], [60.0, 60.0, 30.0]), voids);
        let level = Plane {
            normal: Vector::z(),
            offset_mm: 15.0,
        };
        let slanted = Plane::through(&Point::new(46.0, 0.0, 0.0), &Vector::new(1.0, 0.5, 0.0));
        let tree = CutTree::everywhere(&[level, slanted]);
        let request = request();
        let cutting = Cutting {
            hollowed: &hollowed,
            tree: &tree,
            request: &request,
        };
        let watch = &request.watch;
        let pieces = split(&hollowed.to_mesh(), &tree, watch).unwrap();
        let bridges = find_bridges(&cutting, &pieces).unwrap();
        let remaining = rejoin(pieces.clone(), &tree, &bridges, watch).unwrap();
        assert_eq!((pieces.len(), remaining.len()), (5, 4));
    }

    #[test]
    fn a_triangle_meets_the_cells_it_covers_and_crosses_and_no_others() {
        let corner = nalgebra::Vector2::new;
        for triangle in [
            [corner(0.0, 0.0), corner(9.0, 0.5), corner(0.5, 9.0)],
            [corner(0.0, 0.0), corner(0.5, 9.0), corner(9.0, 0.5)],
        ] {
            assert!(
                meets(&triangle, [0, 0]) && meets(&triangle, [2, 2]) && meets(&triangle, [4, 4])
            );
            assert!(!meets(&triangle, [5, 5]) && !meets(&triangle, [8, 8]));
        }
        let needle = [corner(0.2, 0.2), corner(8.8, 8.8), corner(8.8, 8.8)];
        assert!(
            meets(&needle, [3, 3]),
            "a degenerate triangle counts as meeting, which is the safe side"
        );
    }

    #[test]
    fn a_solid_hook_over_a_hollow_tower_is_cut_off_so_that_the_tower_lifts() {
        let outer = union(&[
            ([0.0, 0.0, 0.0], [50.0, 10.0, 5.0]),
            ([0.0, 0.0, 0.0], [10.0, 10.0, 30.0]),
            ([40.0, 0.0, 0.0], [50.0, 10.0, 40.0]),
            ([5.0, 0.0, 35.0], [50.0, 10.0, 40.0]),
        ]);
        let hollowed = Hollowed::new(outer, vec![cuboid([2.0, 2.0, 10.0], [8.0, 8.0, 25.0])]);
        let (cut, remaining) = cut_at_15(&hollowed);
        assert_eq!((cut, remaining.len()), (3, 3));
    }
}
