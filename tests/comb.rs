//! Printed cells from outside, measured apart from how they were made.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]

use equipoise::base::watch::Watch;
use equipoise::cells::{Cell, Norm, Order, Room, cells, poisson_sites, relax};
use equipoise::comb::{Comb, CombCell, CombError, CombOrder, Door, Escape, build};
use equipoise::geom::{Point, Vector};
use equipoise::mesh::{Csg, MeshDistance, Solid, TriMesh, primitives, shells};

/// The rays by which a wall is measured, at most.
const MOST_RAYS: usize = 4000;
/// What a printed wall may lack, mm.
const LACK_MM: f64 = 0.01;

fn order() -> CombOrder {
    CombOrder {
        wall_mm: 1.0,
        skin_mm: 1.2,
        tolerance_mm: 0.04,
        opening_mm: 2.0,
        holes: 2,
    }
}

/// Divides a mesh into so many relaxed cells.
fn divided(mesh: &TriMesh, count: usize) -> (Solid, Vec<Cell>) {
    let triangles: Vec<_> = mesh.iter_corners().collect();
    let room = Room::of_triangles(&triangles, 8.0);
    let mut sites = poisson_sites(&room, count, &|_| 8.0, 1);
    let plan = Order {
        norm: Norm::Linf,
        steps: 8,
        still_mm: 0.0,
        frame: None,
        weight: None,
    };
    relax(&mut sites, &room, &plan, || false);
    (Solid::new(mesh.clone()).unwrap(), cells(&sites, &room))
}

fn built(mesh: &TriMesh, count: usize, order: &CombOrder) -> (Solid, Comb) {
    let (solid, cells) = divided(mesh, count);
    let comb = build(&solid, &cells, order, &Watch::silent()).unwrap();
    (solid, comb)
}

/// Returns the least thickness of a solid, along the inward normal of each of its triangles.
///
/// Holes to the outside are left out: at their rims walls end in wedges, as those of any bore do.
fn least_wall_mm(comb: &Comb, opening_mm: f64) -> f64 {
    let mesh = comb.solid.mesh();
    let is_bore = |at: &Point| comb.escapes.iter().any(|hole| is_in(hole, at, opening_mm));
    // Some thousand rays, spread over the whole surface.
    let stride = mesh.triangles().len() / MOST_RAYS + 1;
    let corners = mesh.iter_corners().step_by(stride);
    let depths = corners.filter_map(|[a, b, c]| {
        let normal = (b - a).cross(&(c - a));
        // Slivers have no normal to speak of.
        let inward = -normal.try_normalize(1e-4)?;
        let middle = Point::from((a.coords + b.coords + c.coords) / 3.0);
        let far_mm = through_mm(mesh, &middle, &inward)?;
        let is_free = !is_bore(&middle) && !is_bore(&(middle + inward * far_mm));
        is_free.then_some(far_mm)
    });
    depths.fold(f64::INFINITY, f64::min)
}

/// Returns true for a point in a hole to the outside or on its sides.
fn is_in(hole: &Escape, at: &Point, opening_mm: f64) -> bool {
    let axis = (hole.to - hole.from).normalize();
    let along_mm = (at - hole.from).dot(&axis);
    let off_mm = (at - hole.from - axis * along_mm).norm();
    // The corners of twelve sides are 3.6 % farther out.
    along_mm > -LACK_MM && off_mm < 0.5 * 1.036 * opening_mm + LACK_MM
}

/// Returns the least distance of the axes of holes to voids of other cells, less their radius.
fn least_at_holes_mm(comb: &Comb, opening_mm: f64) -> f64 {
    let mut least_mm = f64::INFINITY;
    for hole in &comb.escapes {
        for void in &comb.voids {
            let distance = MeshDistance::new(void);
            if distance.signed(&hole.from) > 0.0 {
                continue;
            }
            for step in 0..=20 {
                let at = hole.from + (hole.mouth - hole.from) * (f64::from(step) / 20.0);
                let far_mm = -distance.signed(&at) - 0.5 * opening_mm;
                least_mm = least_mm.min(far_mm);
            }
        }
    }
    least_mm
}

/// Returns the way from a point of a surface to the next triangle along a ray.
fn through_mm(mesh: &TriMesh, from: &Point, along: &Vector) -> Option<f64> {
    let hits = mesh.iter_corners().filter_map(|[a, b, c]| {
        let [one, other] = [b - a, c - a];
        let across = along.cross(&other);
        let determinant = one.dot(&across);
        if determinant.abs() < 1e-12 {
            return None;
        }
        let off = from - a;
        let u = off.dot(&across) / determinant;
        let turned = off.cross(&one);
        let v = along.dot(&turned) / determinant;
        let far = other.dot(&turned) / determinant;
        let is_in = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
        (is_in && far > 1e-4).then_some(far)
    });
    hits.min_by(f64::total_cmp)
}

/// Holds walls, skin, volumes and ways of a printed model.
fn hold(solid: &Solid, comb: &Comb, order: &CombOrder) {
    let mesh = comb.solid.mesh();
    assert!(!Csg::of_mesh(mesh).unwrap().has_self_intersections());
    // Voids, measured exactly between triangles.
    let distances: Vec<MeshDistance> = comb.voids.iter().map(MeshDistance::new).collect();
    for (k, void) in comb.voids.iter().enumerate() {
        let skin_mm = MeshDistance::new(solid.mesh()).min_distance_to(void);
        assert!(skin_mm >= order.skin_mm - LACK_MM, "skin {skin_mm}");
        for other in &distances[..k] {
            let wall_mm = other.min_distance_to(void);
            assert!(wall_mm >= order.wall_mm - 1e-9, "wall {wall_mm}");
        }
    }
    let beside_mm = least_at_holes_mm(comb, order.opening_mm);
    assert!(
        beside_mm >= order.wall_mm - LACK_MM,
        "beside a hole {beside_mm}"
    );
    let thickness_mm = least_wall_mm(comb, order.opening_mm);
    assert!(
        thickness_mm >= order.wall_mm.min(order.skin_mm) - LACK_MM,
        "{thickness_mm}"
    );
    // Volumes.
    let air_mm3: f64 = comb.cells.iter().map(|cell| cell.air_mm3).sum();
    let sum_mm3 = mesh.signed_volume_mm3() + air_mm3 + comb.doors_mm3 + comb.escapes_mm3;
    let whole_mm3 = solid.mesh().signed_volume_mm3();
    assert!(
        (sum_mm3 / whole_mm3 - 1.0).abs() < 1e-6,
        "{sum_mm3} {whole_mm3}"
    );
    let cells_mm3: f64 = comb.cells.iter().map(|cell| cell.volume_mm3).sum();
    assert!((cells_mm3 / whole_mm3 - 1.0).abs() < 1e-9);
    // Ways: each step goes through a door, and the last cell has the hole.
    for (index, cell) in comb.cells.iter().enumerate() {
        let Some(escape) = cell.escape else {
            assert!(cell.path.is_empty() && cell.air_mm3 == 0.0);
            continue;
        };
        assert_eq!(cell.path[0], index);
        assert_eq!(*cell.path.last().unwrap(), comb.escapes[escape].cell);
        for step in cell.path.windows(2) {
            let joins = |door: &Door| {
                let [a, b] = door.cells;
                [a, b] == [step[0], step[1]] || [b, a] == [step[0], step[1]]
            };
            assert!(comb.doors.iter().any(joins), "{step:?}");
        }
    }
    // Air is in one piece with the outside: nothing of the surface is shut in.
    assert_eq!(shells(mesh).len(), 1);
}

#[test]
fn a_box_of_cells_has_its_walls_and_skin_and_every_cell_drains() {
    let block = primitives::cuboid(&Point::origin(), &Point::new(32.0, 24.0, 16.3));
    let (solid, comb) = built(&block, 24, &order());
    hold(&solid, &comb, &order());
    let drained = comb.cells.iter().filter(|cell| !cell.is_solid()).count();
    assert_eq!(drained, 24);
    assert_eq!(comb.escapes.len(), 2);
    // Walls of 1 mm between cells of 8 mm, and half of the openings.
    let densities = comb.cells.iter().map(CombCell::density);
    assert!(
        densities
            .clone()
            .all(|density| (0.2..0.8).contains(&density))
    );
}

#[test]
fn a_ball_and_a_ring_of_cells_keep_their_walls_and_drain_what_they_can() {
    let ball = primitives::ball(&Point::new(1.0, 2.0, 3.0), 15.0, 4);
    let ring = primitives::torus(20.0, 8.0, 60, 40);
    for mesh in [ball, ring] {
        let count = (mesh.signed_volume_mm3() / 512.0).round() as usize;
        let (solid, comb) = built(&mesh, count, &order());
        hold(&solid, &comb, &order());
        let drained = comb.cells.iter().filter(|cell| !cell.is_solid()).count();
        assert!(drained * 10 > count * 8, "{drained} of {count}");
    }
}

#[test]
fn cells_whose_walls_hold_no_opening_stay_solid() {
    let block = primitives::cuboid(&Point::origin(), &Point::new(24.0, 24.0, 24.1));
    let wide = CombOrder {
        opening_mm: 9.0,
        ..order()
    };
    let (solid, comb) = built(&block, 27, &wide);
    hold(&solid, &comb, &wide);
    assert!(comb.cells.iter().all(CombCell::is_solid));
    assert!(
        (comb.solid.mesh().signed_volume_mm3() / solid.mesh().signed_volume_mm3() - 1.0).abs()
            < 1e-12
    );
}

#[test]
fn a_thick_skin_leaves_nothing_to_empty_and_a_length_of_nothing_is_refused() {
    let block = primitives::cuboid(&Point::origin(), &Point::new(16.0, 16.0, 8.1));
    let (solid, cells) = divided(&block, 4);
    let thick = CombOrder {
        skin_mm: 5.0,
        ..order()
    };
    let comb = build(&solid, &cells, &thick, &Watch::silent()).unwrap();
    assert!(comb.voids.is_empty() && comb.escapes.is_empty());
    for wall_mm in [0.0, -1.0, f64::NAN] {
        let none = CombOrder { wall_mm, ..order() };
        let refused = build(&solid, &cells, &none, &Watch::silent());
        assert!(matches!(refused, Err(CombError::NotPositive { .. })));
    }
}

#[test]
fn printed_cells_have_the_same_bits_on_any_number_of_threads() {
    let block = primitives::cuboid(&Point::origin(), &Point::new(24.0, 16.0, 16.1));
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            let (_, comb) = built(&block, 12, &order());
            (comb.solid.mesh().clone(), comb.cells)
        })
    };
    assert_eq!(on(1), on(3));
}
