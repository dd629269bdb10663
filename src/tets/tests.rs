//! Claims of volume meshes: what is refused and where, exact moments, and honest errors.

use super::{Densities, Difference, Quality, Sampling, Tets, TetsError, TetsParts};
use crate::base::random::Random;
use crate::field::{Density, Linear, Sine, measure};
use crate::geom::{Point, Vector};
use crate::mass::moments_of_mesh;

/// The four corners of the unit tetrahedron, mm.
const UNIT: [[f64; 3]; 4] = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]];
/// The six tetrahedra of a cube whose corners are numbered by bits x, y, z.
const KUHN: [[u32; 4]; 6] = [
    [0, 1, 3, 7],
    [0, 3, 2, 7],
    [0, 2, 6, 7],
    [0, 6, 4, 7],
    [0, 4, 5, 7],
    [0, 5, 1, 7],
];

fn parts(vertices: &[[f64; 3]], cells: &[[u32; 4]]) -> TetsParts {
    TetsParts {
        vertices: vertices.iter().copied().map(Point::from).collect(),
        cells: cells.to_vec(),
        densities: Densities::Solid,
    }
}

/// Returns a box of so many cubes a side, each of six tetrahedra.
fn block(count: u32, size_mm: f64) -> TetsParts {
    let side = count + 1;
    let number = |[x, y, z]: [u32; 3]| x + side * (y + side * z);
    let mut mesh = parts(&[], &[]);
    for z in 0..side {
        for y in 0..side {
            for x in 0..side {
                let at = [x, y, z].map(|c| f64::from(c) * size_mm / f64::from(count));
                mesh.vertices.push(Point::from(at));
                if x < count && y < count && z < count {
                    let corner =
                        |bits: u32| number([0, 1, 2].map(|i| [x, y, z][i] + (bits >> i & 1)));
                    mesh.cells.extend(KUHN.map(|cell| cell.map(corner)));
                }
            }
        }
    }
    mesh
}

fn refused(parts: TetsParts) -> TetsError {
    Tets::new(parts).expect_err("a fault")
}

#[test]
fn one_tetrahedron_has_its_textbook_mass_in_either_order_of_turning() {
    for (cell, turned) in [([0, 1, 2, 3], 0), ([0, 2, 1, 3], 1)] {
        let mut mesh = parts(&UNIT, &[cell]);
        mesh.densities = Densities::Corners(vec![0.2, 0.4, 0.6, 0.8]);
        let tets = Tets::new(mesh).unwrap();
        assert_eq!(tets.turned(), turned);
        let moments = tets.moments();
        // ∫ d = V · mean; ∫ d x = V (D S + R)/20.
        assert!((moments.volume() - 0.5 / 6.0).abs() < 1e-16);
        let first = Vector::new(2.0 + 0.4, 2.0 + 0.6, 2.0 + 0.8) / 120.0;
        assert!((moments.first() - first).amax() < 1e-16);
        assert_eq!(tets.boundary().mesh().triangles().len(), 4);
        assert!(tets.boundary().solid().is_some());
    }
}

#[test]
fn densities_of_cells_weigh_each_by_its_own() {
    let mut mesh = block(1, 2.0);
    mesh.densities = Densities::Cells(vec![0.1, 0.2, 0.3, 0.4, 0.5, 0.6]);
    let tets = Tets::new(mesh).unwrap();
    assert!((tets.moments().volume() - 2.1 * 8.0 / 6.0).abs() < 1e-14);
    assert!((tets.solid_moments().volume() - 8.0).abs() < 1e-14);
    let jump = Sampling::of(&tets).jump;
    assert!((jump.density - 0.5).abs() < 1e-15, "{jump:?}");
}

#[test]
fn a_linear_field_sampled_at_the_corners_is_exact_far_from_the_origin() {
    let mut mesh = block(4, 8.0);
    for at in &mut mesh.vertices {
        *at += Vector::new(1000.0, -500.0, 300.0);
    }
    let field = Linear {
        at_origin: 0.5 - 10.0,
        gradient: Vector::new(0.01, 0.0, 0.0),
    };
    let tets = Tets::new(mesh).unwrap().sampled(&field).unwrap();
    let boundary = tets.boundary().mesh();
    let exact = measure(boundary, &field).moments;
    for (got, want) in tets.moments().0.iter().zip(exact.0) {
        assert!((got / want - 1.0).abs() < 1e-12, "{got} {want}");
    }
    let solid = moments_of_mesh(boundary);
    for (got, want) in tets.solid_moments().0.iter().zip(solid.0) {
        assert!((got / want - 1.0).abs() < 1e-13, "{got} {want}");
    }
    // A linear density has no curvature, so nothing is missed.
    let estimate = Sampling::of(&tets).estimate.unwrap();
    assert!(
        estimate.mass_ratio < 1e-12 && estimate.center_mm < 1e-9,
        "{estimate:?}"
    );
}

#[test]
fn the_estimated_error_of_sampling_is_near_the_true_one() {
    let field = Sine::new(Point::new(12.0, -5.0, 3.0), 25.0, [0.1, 0.9]).unwrap();
    for count in [6, 10] {
        let tets = Tets::new(block(count, 20.0)).unwrap();
        let tets = tets.sampled(&field).unwrap();
        let exact = measure(tets.boundary().mesh(), &field).moments;
        let truth = Difference::between(&tets.moments(), &exact).unwrap();
        let estimate = Sampling::of(&tets).estimate.unwrap();
        let ratio = estimate.mass_ratio / truth.mass_ratio;
        assert!((0.5..2.0).contains(&ratio), "{estimate:?} {truth:?}");
    }
}

#[test]
fn finer_samples_of_a_wave_come_nearer_by_the_square_of_the_edges() {
    let field = Sine::new(Point::new(3.0, 4.0, 5.0), 30.0, [0.0, 1.0]).unwrap();
    let off = |count| {
        let tets = Tets::new(block(count, 20.0)).unwrap();
        let tets = tets.sampled(&field).unwrap();
        let exact = measure(tets.boundary().mesh(), &field).moments;
        Difference::between(&tets.moments(), &exact)
            .unwrap()
            .mass_ratio
    };
    let ratio = off(6) / off(12);
    assert!((3.5..4.5).contains(&ratio), "{ratio}");
}

#[test]
fn what_fills_no_solid_once_is_refused_with_the_place() {
    let [a, b, c, d] = UNIT;
    let below = [0.2, 0.2, -1.0];
    let above = [0.2, 0.2, 0.9];
    let says =
        |vertices: &[[f64; 3]], cells: &[[u32; 4]]| refused(parts(vertices, cells)).to_string();
    let unit = [0, 1, 2, 3];
    assert!(says(&UNIT, &[]).contains("no tetrahedra"));
    assert!(says(&UNIT, &[unit, [0, 1, 2, 4]]).contains("tetrahedron 2 names corner 5"));
    assert!(says(&UNIT, &[[0, 1, 1, 3]]).contains("corner 2 twice"));
    assert!(says(&[a, b, c, [f64::NAN, 0.0, 0.0]], &[unit]).contains("corner 4"));
    let flat = says(&[a, b, c, [0.3, 0.3, 0.0]], &[unit]);
    assert!(
        flat.contains("tetrahedron 1 near (0.3250, 0.3250, 0.0000) is flat"),
        "{flat}"
    );
    // Far from the origin, what rounding leaves of a flat one is no volume.
    let far = [a, b, c, [1.0 / 3.0, 1.0 / 3.0, 1e-14]].map(|[x, y, z]| [x + 1e3, y + 1e3, z + 1e3]);
    assert!(says(&far, &[unit]).contains("is flat"));
    let same_side = says(&[a, b, c, d, above], &[unit, [0, 1, 2, 4]]);
    assert!(
        same_side.contains("tetrahedron 1 and tetrahedron 2"),
        "{same_side}"
    );
    let twice = says(&[a, b, c, d, below], &[unit, [0, 1, 2, 4], [1, 0, 2, 3]]);
    assert!(twice.contains("tetrahedron 1 and tetrahedron 3"), "{twice}");
    assert!(twice.contains("have the same corners"), "{twice}");
    let three = [[0, 1, 2, 4], [0, 1, 2, 5], unit];
    let crowded = says(&[a, b, c, d, below, [0.3, 0.3, -2.0]], &three);
    assert!(crowded.contains("3 tetrahedra share one face"), "{crowded}");
    let cells = [unit, [0, 1, 2, 4]];
    assert!(Tets::new(parts(&[a, b, c, d, below], &cells)).is_ok());
}

#[test]
fn parts_that_fill_the_same_space_are_found_by_their_surface() {
    let mut two = block(2, 10.0);
    let one = two.clone();
    // Smaller and inside: the surfaces do not meet.
    let shift = two.vertices.len() as u32;
    let inside = |at: &Point| Point::from(at.coords * 0.1 + Vector::repeat(2.2));
    two.vertices.extend(one.vertices.iter().map(inside));
    two.cells.extend(
        one.cells
            .iter()
            .map(|cell| cell.map(|corner| corner + shift)),
    );
    assert!(matches!(refused(two), TetsError::FilledTwice { .. }));
    // Shifted: they cross.
    let mut two = one.clone();
    let shifted = |at: &Point| at + Vector::new(4.1, 3.3, 2.7);
    two.vertices.extend(one.vertices.iter().map(shifted));
    two.cells.extend(
        one.cells
            .iter()
            .map(|cell| cell.map(|corner| corner + shift)),
    );
    assert!(matches!(
        refused(two),
        TetsError::Crossing { pairs: 1.., .. }
    ));
    // Apart: both are weighed.
    let mut two = one.clone();
    two.vertices
        .extend(one.vertices.iter().map(|at| at + Vector::x() * 20.0));
    two.cells.extend(
        one.cells
            .iter()
            .map(|cell| cell.map(|corner| corner + shift)),
    );
    let tets = Tets::new(two).unwrap();
    assert!((tets.moments().volume() - 2000.0).abs() < 1e-9);
}

#[test]
fn parts_numbered_apart_share_their_faces_and_may_jump_there() {
    let one = block(2, 10.0);
    let shift = one.vertices.len() as u32;
    let mut two = one.clone();
    two.vertices
        .extend(one.vertices.iter().map(|at| at + Vector::x() * 10.0));
    two.cells.extend(
        one.cells
            .iter()
            .map(|cell| cell.map(|corner| corner + shift)),
    );
    let side = |high: bool| if high { 0.8 } else { 0.2 };
    two.densities = Densities::Corners((0..2 * shift).map(|at| side(at >= shift)).collect());
    let tets = Tets::new(two).unwrap();
    assert_eq!(tets.boundary().mesh().triangles().len(), 2 * 4 * 10);
    assert!((tets.moments().volume() - 1000.0).abs() < 1e-9);
}

#[test]
fn parts_that_touch_along_an_edge_are_told_and_bound_no_solid() {
    let vertices = [
        UNIT[0],
        UNIT[1],
        UNIT[2],
        UNIT[3],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, -1.0],
    ];
    let tets = Tets::new(parts(&vertices, &[[0, 1, 2, 3], [0, 1, 4, 5]])).unwrap();
    assert!(tets.boundary().solid().is_none());
    assert_eq!(tets.boundary().contacts(), [Point::new(0.5, 0.0, 0.0)]);
}

#[test]
fn what_is_no_density_is_refused_with_its_number() {
    let with = |densities| TetsParts {
        densities,
        ..parts(&UNIT, &[[0, 1, 2, 3]])
    };
    let says = |densities| refused(with(densities)).to_string();
    for wrong in [f64::NAN, -0.1, 1.01, 1240.0, f64::INFINITY] {
        let said = says(Densities::Corners(vec![0.5, 0.5, wrong, 0.5]));
        assert!(
            said.contains("corner 3") && said.contains("0 to 1"),
            "{said}"
        );
    }
    assert!(says(Densities::Cells(vec![2.0])).contains("tetrahedron 1 is 2"));
    assert!(says(Densities::Cells(vec![])).contains("0 densities for 1 tetrahedra"));
    // Single precision writes 1 so.
    assert!(Tets::new(with(Densities::Cells(vec![1.000_000_1]))).is_ok());
}

#[test]
fn tetrahedra_in_any_order_have_the_same_moments() {
    let mut mesh = block(3, 9.0);
    let mut random = Random::new(5);
    let values = mesh.vertices.iter().map(|_| random.between(0.0, 1.0));
    mesh.densities = Densities::Corners(values.collect());
    let forward = Tets::new(mesh.clone()).unwrap().moments();
    mesh.cells.reverse();
    let backward = Tets::new(mesh).unwrap().moments();
    for (one, other) in forward.0.iter().zip(backward.0) {
        assert!((one / other - 1.0).abs() < 1e-14);
    }
}

#[test]
fn the_cubes_of_six_have_their_textbook_shape() {
    let quality = Quality::of(&Tets::new(block(2, 4.0)).unwrap());
    assert!((quality.least_angle_deg - 45.0).abs() < 1e-12);
    assert!((quality.greatest_angle_deg - 90.0).abs() < 1e-12);
    assert_eq!(quality.slivers, 0);
    assert!((quality.shortest_edge_mm - 2.0).abs() < 1e-15);
    assert!((quality.longest_edge_mm - 12.0_f64.sqrt()).abs() < 1e-14);
}

#[test]
fn a_scaled_mesh_has_the_mass_of_its_size() {
    let tets = Tets::new(block(2, 1.0)).unwrap().scaled(10.0);
    assert!((tets.moments().volume() - 1000.0).abs() < 1e-9);
    assert!((moments_of_mesh(tets.boundary().mesh()).volume() - 1000.0).abs() < 1e-9);
    let field: &dyn Density = &Linear {
        at_origin: 0.0,
        gradient: Vector::z(),
    };
    assert!(matches!(
        tets.sampled(field),
        Err(TetsError::Density { .. })
    ));
}
