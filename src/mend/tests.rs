use super::*;
use crate::geom::{Point, Vector};
use crate::mesh::primitives::{ball, cuboid};
use crate::mesh::{Crossings, MeshDistance, Solid};

/// Mends a mesh in mm by an order in words.
fn try_mend(mesh: &TriMesh, order: &str) -> Result<Mended, MendError> {
    mend(
        mesh.clone(),
        order.parse().unwrap(),
        |_| 1.0,
        &Watch::silent(),
    )
}

/// Mends a mesh, which must become a solid that does not cross itself.
fn redraw(mesh: &TriMesh, order: &str) -> (Solid, Repairs) {
    let mended = try_mend(mesh, order).unwrap();
    assert_eq!(Crossings::of(&mended.mesh).pairs, 0);
    (Solid::new(mended.mesh).unwrap(), mended.repairs)
}

fn cube(side: f64) -> TriMesh {
    cuboid(&Point::origin(), &Point::new(side, side, side))
}

/// The mesh without its triangles above a height, and every other one moved by 0.05 mm: no rung of
/// the ladder closes it.
fn broken(mesh: &TriMesh, height: f64) -> TriMesh {
    let kept = mesh.iter_corners().filter(|[a, _, _]| a.z < height);
    let corners: Vec<Point> = kept
        .enumerate()
        .flat_map(|(i, corners)| {
            let by = Vector::new(0.03, -0.02, 0.03) * f64::from(i as u32 % 2);
            corners.map(|p| p + by)
        })
        .collect();
    let count = corners.len() as u32 / 3;
    let triangles = (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]);
    TriMesh::new(corners, triangles.collect()).unwrap()
}

#[test]
fn a_new_surface_of_a_box_keeps_its_tolerance_on_faces_edges_and_corners() {
    let (solid, _) = redraw(&cube(10.0), "remesh:0.2mm");
    // Distances from the box are known without a mesh.
    let to_box = |p: &Point| {
        let out = p.coords.map(|x| (x - 5.0).abs() - 5.0);
        let beyond = out.map(|x| x.max(0.0)).norm();
        beyond + out.max().min(0.0)
    };
    let new = solid.mesh().vertices().iter().map(|p| to_box(p).abs());
    assert!(new.fold(0.0, f64::max) < 0.2);
    let surface = MeshDistance::new(solid.mesh());
    let steps = || (0..=20).map(|i| f64::from(i) / 2.0);
    for (u, v) in steps().flat_map(|u| steps().map(move |v| (u, v))) {
        for face in 0..6 {
            let fixed = 10.0 * f64::from(face % 2);
            let mut p = [fixed, u, v];
            p.rotate_right(face as usize / 2);
            let off = surface.signed(&Point::from(p)).abs();
            assert!(off <= 0.2, "{p:?}: {off}");
        }
    }
}

#[test]
fn triangles_without_order_become_a_solid_within_the_tolerance_that_is_told() {
    let old = broken(&ball(&Point::origin(), 10.0, 3), 9.0);
    assert!(Solid::new(try_mend(&old, "auto").unwrap().mesh).is_err());
    let (solid, repairs) = redraw(&old, "remesh:0.3mm");
    let redrawn = repairs.redrawn.unwrap();
    assert_eq!(redrawn.within_mm, 0.3);
    assert!(redrawn.moved_mm > 0.0 && redrawn.moved_mm <= 0.3);
    assert!(repairs.to_string().contains("within 0.300 mm"), "{repairs}");
    // Below the cap that is missing every old corner lies on the ball.
    let surface = MeshDistance::new(solid.mesh());
    let corners = old.iter_corners().flatten().filter(|p| p.z < 8.0);
    corners.for_each(|p| assert!(surface.signed(&p).abs() <= 0.3, "{p}"));
}

#[test]
fn a_wall_thinner_than_the_tolerance_is_drawn_by_finer_cells_or_refused_with_its_place() {
    let plate = |thick| {
        let plate = cuboid(
            &Point::new(1.0, 1.0, 2.0),
            &Point::new(1.0 + thick, 2.0, 4.5),
        );
        cube(3.0).joined(&plate)
    };
    let (solid, _) = redraw(&plate(0.3), "remesh:0.4mm");
    assert!(solid.mesh().aabb().max.z > 4.1);
    match try_mend(&plate(0.001), "remesh:0.4mm") {
        Err(MendError::Strays { at, strays_mm, .. }) => {
            assert!(strays_mm > 0.4 && at.z > 3.0, "{strays_mm} {at}");
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn what_encloses_nothing_and_what_is_too_fine_is_refused_with_what_to_type() {
    let sheet = TriMesh::new(cube(1.0).into_vertices(), vec![[0, 1, 2]]).unwrap();
    assert_eq!(try_mend(&sheet, "remesh").unwrap_err(), MendError::Nothing);
    let error = try_mend(&cube(10.0), "remesh:0.0001mm").unwrap_err();
    assert!(error.to_string().contains("repair = \"remesh:"), "{error}");
}

#[test]
fn a_tolerance_counts_in_the_size_that_is_printed_and_the_mesh_stays_in_its_numbers() {
    let order = "remesh:0.2mm".parse().unwrap();
    let factor = |longest: f64| 10.0 / longest;
    let mended = mend(cube(0.5), order, factor, &Watch::silent()).unwrap();
    assert!((mended.mesh.longest_side_mm() - 0.5).abs() < 0.02);
    let printed = mended.scale_ratio * mended.mesh.longest_side_mm();
    assert!((printed - 10.0).abs() < 1e-12, "{printed}");
}

#[test]
fn a_surface_inside_is_filled_or_bounds_a_cavity_in_the_new_one_as_ordered() {
    let inner = cube(4.0).map_vertices(|p| p + Vector::repeat(3.0));
    let nested = cube(10.0).joined(&inner.reversed());
    let volume = |order| redraw(&nested, order).0.mesh().signed_volume_mm3();
    // Bevels of 0.2 mm take at most 0.02 mm² along 120 mm of edges.
    assert!((volume("remesh:0.2mm,fill") - 1000.0).abs() < 2.4);
    assert!((volume("remesh:0.2mm,cavities") - 936.0).abs() < 3.4);
}

#[test]
fn one_thread_and_four_draw_the_same_surface() {
    let old = broken(&ball(&Point::origin(), 10.0, 3), 8.0);
    let draw = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let pool = pool.build().unwrap();
        pool.install(|| try_mend(&old, "remesh:0.3mm").unwrap().mesh)
    };
    assert_eq!(draw(1), draw(4));
}
