//! Tests of relaxed cells.

use super::*;
use crate::geom::{Aabb, Matrix, Plane, Point, Vector};

fn unit_box() -> Aabb {
    Aabb {
        min: Point::origin(),
        max: Point::new(1.0, 1.0, 1.0),
    }
}

fn order(norm: Norm, steps: usize) -> Order<'static> {
    Order {
        norm,
        steps,
        still_mm: 0.0,
        frame: None,
        weight: None,
    }
}

/// Returns the energy of each step as a part of that of cubes which fill the unit box.
fn shares(norm: Norm, count: usize, seed: u64, steps: usize) -> Vec<f64> {
    let room = Room::of_box(unit_box());
    let mut sites = random_sites(&room, count, seed);
    let taken = relax(&mut sites, &room, &order(norm, steps), || false);
    // A cube of side a has 3a⁴/8.
    let cube = 3.0 / 8.0 * (count as f64).powf(-4.0 / 3.0);
    taken
        .iter()
        .map(|step| step.chebyshev / (count as f64 * cube))
        .collect()
}

/// Returns a torus of `sides` × `sides` quads about z.
fn torus(large_mm: f64, small_mm: f64, sides: usize) -> Vec<Corners> {
    let at = |i: usize, j: usize| {
        let turn = |k: usize| std::f64::consts::TAU * (k % sides) as f64 / sides as f64;
        let out = large_mm + small_mm * turn(j).cos();
        Point::new(
            out * turn(i).cos(),
            out * turn(i).sin(),
            small_mm * turn(j).sin(),
        )
    };
    let quads = (0..sides).flat_map(|i| (0..sides).map(move |j| [i, j]));
    let halves = quads.flat_map(|[i, j]| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    halves.collect()
}

#[test]
fn eight_sites_find_the_grid_from_some_starts() {
    let ends = (0..10).map(|seed| *shares(Norm::Linf, 8, seed, 60).last().unwrap());
    let ends: Vec<f64> = ends.collect();
    assert!(ends.iter().any(|end| (end - 1.0).abs() < 5e-6), "{ends:?}");
    assert!(ends.iter().all(|&end| end > 1.0 - 1e-9), "{ends:?}");
}

/// Holds that relaxed cubes beat relaxed round cells in the mean of ten starts.
fn hold_cubes_best(count: usize) {
    let mean = |norm| {
        let ends = (0..10).map(|seed| *shares(norm, count, seed, 50).last().unwrap());
        ends.sum::<f64>() / 10.0
    };
    let [linf, l2] = [mean(Norm::Linf), mean(Norm::L2)];
    assert!(linf < l2, "{count} sites: {linf} against {l2}");
    assert!(linf < 1.03, "{count} sites: {linf}");
}

#[test]
fn cubes_have_less_chebyshev_energy_than_round_cells_in_the_mean_of_ten_starts() {
    hold_cubes_best(27);
}

#[test]
#[ignore = "64 and 512 sites: a minute"]
fn many_cubes_have_less_chebyshev_energy_too() {
    hold_cubes_best(64);
    hold_cubes_best(512);
}

#[test]
fn cells_of_a_torus_add_up_to_it_before_and_after_they_relax() {
    let triangles = torus(20.0, 8.0, 60);
    let whole = Chain::new(triangles.clone()).volume_mm3();
    let room = Room::of_triangles(&triangles, 5.0);
    let mut sites = random_sites(&room, 100, 1);
    check_sites(&sites, &room).unwrap();
    let hold_sum = |sites: &[Point]| {
        let cells = cells(sites, &room);
        let sum: f64 = cells.iter().map(|cell| cell.part.volume_mm3()).sum();
        assert!((sum / whole - 1.0).abs() < 1e-9, "{sum} {whole}");
        cells
    };
    hold_sum(&sites);
    let steps = relax(&mut sites, &room, &order(Norm::Linf, 3), || false);
    let cells = hold_sum(&sites);
    assert!(steps[2].chebyshev < 0.9 * steps[0].chebyshev, "{steps:?}");
    // One that the surface cuts, against the integral of what lies outside of cubes of all sizes.
    let (site, cell) = sites
        .iter()
        .zip(&cells)
        .max_by_key(|(_, cell)| cell.part.triangles().len())
        .unwrap();
    let found = Chebyshev::of(&cell.part, site, &Matrix::identity(), None).energy;
    let expected = energy_by_cubes(&cell.part, site, cell.polytope.reach_mm(site));
    assert!((found / expected - 1.0).abs() < 1e-6, "{found} {expected}");
}

/// Returns the energy of a region as the integral of its volume outside of cubes of all sizes.
fn energy_by_cubes(part: &Chain, site: &Point, far_mm: f64) -> f64 {
    let whole = part.volume_mm3();
    let steps = 2000;
    let outside = |k: usize| {
        let reach = far_mm * (k as f64 + 0.5) / f64::from(steps);
        let axes = [Vector::x(), Vector::y(), Vector::z()];
        let within = axes.iter().fold(part.clone(), |part, axis| {
            let [up, down] = [reach, -reach].map(|by| site + axis * by);
            let part = part.below(&Plane::through(&up, axis));
            part.below(&Plane::through(&down, &-axis))
        });
        whole - within.volume_mm3()
    };
    (0..2000).map(outside).sum::<f64>() * far_mm / f64::from(steps)
}

#[test]
fn a_turned_box_with_turned_axes_relaxes_as_one_that_is_not() {
    let turn = nalgebra::Rotation3::new(Vector::new(0.3, -0.7, 0.5)).into_inner();
    let plain = Chain::of_box(&unit_box());
    let turned = plain.mapped(|at| turn * at);
    let room = Room::of_triangles(turned.triangles(), 0.3);
    let mut sites: Vec<Point> = random_sites(&Room::of_box(unit_box()), 27, 6);
    let mut moved: Vec<Point> = sites.iter().map(|site| turn * site).collect();
    let axes = |_: &Point| turn;
    let along = Order {
        frame: Some(&axes),
        ..order(Norm::Linf, 4)
    };
    let [one, other] = [
        relax(
            &mut sites,
            &Room::of_box(unit_box()),
            &order(Norm::Linf, 4),
            || false,
        ),
        relax(&mut moved, &room, &along, || false),
    ];
    assert_eq!(one.len(), 4);
    for (one, other) in one.iter().zip(&other) {
        assert!((one.chebyshev / other.chebyshev - 1.0).abs() < 1e-9);
    }
    for (site, moved) in sites.iter().zip(&moved) {
        assert!((turn * site - moved).norm() < 1e-9);
    }
}

#[test]
fn sites_move_toward_a_greater_weight() {
    let weight = |at: &Point| 1.0 + 9.0 * at.x;
    for norm in [Norm::Linf, Norm::L2] {
        let mut sites = random_sites(&Room::of_box(unit_box()), 60, 3);
        let heavy = Order {
            weight: Some(&weight),
            ..order(norm, 30)
        };
        relax(&mut sites, &Room::of_box(unit_box()), &heavy, || false);
        let right = sites.iter().filter(|site| site.x > 0.5).count();
        assert!(right > 33, "{right} of 60");
    }
}

#[test]
fn relaxed_sites_have_the_same_bits_on_any_number_of_threads() {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            let mut sites = random_sites(&Room::of_box(unit_box()), 40, 2);
            let steps = relax(
                &mut sites,
                &Room::of_box(unit_box()),
                &order(Norm::Linf, 5),
                || false,
            );
            (sites, steps)
        })
    };
    assert_eq!(on(1), on(3));
}

#[test]
fn a_relaxation_ends_when_it_stands_still_or_is_stopped() {
    let room = Room::of_box(unit_box());
    let mut sites = vec![Point::new(0.2, 0.3, 0.4)];
    let still = Order {
        still_mm: 1e-9,
        ..order(Norm::Linf, 50)
    };
    let steps = relax(&mut sites, &room, &still, || false);
    assert!(steps.len() <= 3, "{}", steps.len());
    assert!((sites[0] - Point::new(0.5, 0.5, 0.5)).norm() < 1e-9);
    assert!(relax(&mut sites, &room, &still, || true).is_empty());
}

#[test]
fn sites_that_have_no_cells_are_named() {
    let room = Room::of_box(unit_box());
    let at = |x: f64| Point::new(x, 0.5, 0.5);
    assert_eq!(check_sites(&[], &room), Err(SitesError::None));
    let outside = check_sites(&[at(0.5), at(1.5)], &room);
    assert_eq!(outside, Err(SitesError::Outside(2)));
    let twice = check_sites(&[at(0.1), at(0.5), at(0.1)], &room);
    assert_eq!(twice, Err(SitesError::Doubled(1, 3)));
    let nan = check_sites(&[at(f64::NAN)], &room);
    assert_eq!(nan, Err(SitesError::NotFinite(1)));
    let many = check_sites(&vec![at(0.5); MOST_SITES + 1], &room);
    assert_eq!(many, Err(SitesError::TooMany(MOST_SITES + 1)));
    assert_eq!(check_sites(&[at(0.5)], &room), Ok(()));
}
