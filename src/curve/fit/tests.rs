//! Fits of known curves, against the figures of the method's reference.

use super::*;
use crate::curve::samples;
use crate::curve::{Helix, frechet_mm};
use crate::geom::{Frame, Vector};

/// A chain of seven pieces at a skew place.
fn skew_chain() -> Chain {
    let piece = |i: u32| Helix {
        curvature: 0.02 + 0.002 * f64::from(i),
        torsion: 0.01 - 0.004 * f64::from(i),
    };
    Chain {
        start: Frame::with_axis(Point::new(5.0, -3.0, 8.0), &Vector::new(1.0, 2.0, -1.0)),
        piece_mm: 25.0,
        pieces: (0..7).map(piece).collect(),
        turns_rad: vec![0.5, -1.0, 0.0, 2.0, 0.3, -0.2],
    }
}

fn every_kind_of_residual() -> FitRequest {
    FitRequest {
        impulse_price: 0.7,
        turn_bound: Some(TurnBound {
            overlap_mm: 12.0,
            offset_mm: 0.2,
        }),
        ends: Ends::Pinned,
        ..FitRequest::new(7, 0.06, 0.05)
    }
}

#[test]
fn the_derivatives_are_those_of_differences() {
    let (chain, request) = (skew_chain(), every_kind_of_residual());
    let target = samples::viviani().scaled_to(180.0).samples(7 * FIT_SAMPLES);
    let problem = Problem::new(&target, &request);
    let free = Unknowns::of(&request, &chain);
    let linear = problem.linear(&chain, &free);
    for place in 0..free.count() {
        let at = |h: f64| {
            let mut step = vec![0.0; free.count()];
            step[place] = h;
            problem.residuals(&free.step(&chain, &step))
        };
        let h = 1e-6;
        let difference = (at(h) - at(-h)) / (2.0 * h);
        let column = linear.jacobian.column(place);
        let error = (difference - column).norm() / column.norm();
        assert!(error < 1e-6, "unknown {place}: {error:e}");
    }
}

#[test]
fn a_chain_is_found_again_from_its_own_points() {
    let points = skew_chain().samples(40);
    let curve = Curve::of_polyline(points).unwrap();
    let request = FitRequest {
        nesting_price: 0.0,
        ..FitRequest::new(7, 0.06, 0.05)
    };
    let found = fit(&curve, &request).unwrap();
    assert!(found.deviation.max_mm < 0.02, "{:?}", found.deviation);
}

#[test]
fn bounds_hold_and_one_value_for_all_is_one_value() {
    let curve = samples::viviani().scaled_to(300.0);
    let request = FitRequest {
        curvature: Freedom::One,
        torsion: Freedom::One,
        ..FitRequest::new(6, 0.02, 0.003)
    };
    let chain = fit(&curve, &request).unwrap().chain;
    assert!(chain.pieces.iter().all(|piece| *piece == chain.pieces[0]));
    assert!(chain.pieces[0].curvature <= 0.02 && chain.pieces[0].torsion.abs() <= 0.003);
    let flat = FitRequest {
        torsion: Freedom::Zero,
        ..request
    };
    let chain = fit(&curve, &flat).unwrap().chain;
    assert!(chain.pieces.iter().all(|piece| piece.torsion == 0.0));
}

#[test]
fn no_turn_parts_neighbours_by_more_than_its_bound() {
    let curve = samples::viviani().scaled_to(300.0);
    let bound = TurnBound {
        overlap_mm: 6.6,
        offset_mm: 0.05,
    };
    let free = FitRequest::new(6, 0.04, 0.02);
    let bounded = FitRequest {
        turn_bound: Some(bound),
        ..free.clone()
    };
    let greatest_mm = |request: &FitRequest| {
        let chain = fit(&curve, request).unwrap().chain;
        let joints = chain.turns_rad.iter().zip(&chain.pieces[1..]);
        let offsets = joints
            .map(|(turn, piece)| 0.25 * 6.6 * 6.6 * piece.curvature * (0.5 * turn.abs()).sin());
        offsets.fold(0.0, f64::max)
    };
    assert!(greatest_mm(&free) > 0.1);
    assert!(greatest_mm(&bounded) <= bound.offset_mm);
}

#[test]
fn pinned_ends_lie_on_those_of_the_curve() {
    let curve = samples::sine().scaled_to(300.0);
    let request = FitRequest {
        ends: Ends::Pinned,
        ..FitRequest::new(5, 0.04, 0.02)
    };
    let samples = fit(&curve, &request).unwrap().chain.samples(1);
    assert!((samples[0] - curve.at(0.0)).norm() < 1e-3);
    assert!((samples[5] - curve.at(300.0)).norm() < 1e-3);
}

#[test]
fn a_price_of_turns_leaves_few() {
    let curve = samples::viviani().scaled_to(300.0);
    let turns = |price: f64| {
        let request = FitRequest {
            impulse_price: price,
            ..FitRequest::new(8, 0.04, 0.02)
        };
        let chain = fit(&curve, &request).unwrap().chain;
        chain.turns_rad.iter().filter(|turn| **turn != 0.0).count()
    };
    assert_eq!(turns(0.0), 7);
    assert!(turns(3.0) < 5);
}

#[test]
fn the_answer_is_the_same_on_one_thread() {
    let curve = samples::sine().scaled_to(200.0);
    let request = FitRequest::new(4, 0.04, 0.02);
    let alone = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .unwrap();
    let one = alone.install(|| fit(&curve, &request).unwrap());
    assert_eq!(one, fit(&curve, &request).unwrap());
}

#[test]
fn what_cannot_be_fitted_is_refused() {
    let curve = samples::sine().scaled_to(200.0);
    let refused = |request: FitRequest| fit(&curve, &request).unwrap_err().to_string();
    assert!(refused(FitRequest::new(0, 0.1, 0.1)).contains("ask for 1 to"));
    assert!(refused(FitRequest::new(3, f64::NAN, 0.1)).contains("greatest curvature"));
    let mut request = FitRequest::new(3, 0.1, 0.1);
    request.body_mm = vec![3.0];
    assert!(refused(request.clone()).contains("1 radii"));
    request.body_mm = vec![3.0, -2.0, 1.0];
    assert!(refused(request).contains("radius"));
    let corner = [[0.0, 0.0, 0.0], [50.0, 0.0, 0.0], [50.0, 50.0, 0.0]].map(Point::from);
    let corner = Curve::of_polyline(corner.to_vec()).unwrap();
    let error = fit(&corner, &FitRequest::new(3, 0.1, 0.1)).unwrap_err();
    assert!(error.to_string().contains("corner of 8"), "{error}");
}

/// A curve of the reference, and the greatest and mean deviation of its fit, mm.
struct Row {
    name: &'static str,
    curve: Curve,
    max_mm: f64,
    rms_mm: f64,
    misfit_mm: f64,
}

fn row(name: &'static str, curve: Curve, figures: [f64; 3]) -> Row {
    let [max_mm, rms_mm, misfit_mm] = figures;
    Row {
        name,
        curve: curve.scaled_to(300.0),
        max_mm,
        rms_mm,
        misfit_mm,
    }
}

fn print(name: &str, curve: &Curve, request: &FitRequest) -> Fit {
    let clock = std::time::Instant::now();
    let found = fit(curve, request).unwrap();
    let seconds = clock.elapsed().as_secs_f64();
    let guess = |price: f64| {
        let chain = first_guess(curve, request, price);
        let target = curve.samples(request.pieces * JUDGED_SAMPLES);
        Deviation::between(&chain.samples(JUDGED_SAMPLES), &target)
    };
    let target = curve.samples(request.pieces * 100);
    println!(
        "{name}: {:.3}/{:.3} misfit {:.3} gap {:.2} Fréchet {:.3} in {seconds:.2} s",
        found.deviation.max_mm,
        found.deviation.rms_mm,
        found.chain.nesting_misfit_mm(),
        found.least_gap_mm,
        frechet_mm(&found.chain.samples(100), &target),
    );
    for price in [0.0, 1.0, 3.0, 10.0, 30.0] {
        let Deviation { max_mm, rms_mm } = guess(price);
        println!("    first guess at {price}: {max_mm:.2}/{rms_mm:.2}");
    }
    found
}

#[test]
#[ignore = "takes a minute; run before a change of the fit"]
fn every_reference_curve_is_met_or_beaten() {
    let rows = [
        row("Viviani", samples::viviani(), [1.32, 0.30, 0.87]),
        row("sine", samples::sine(), [1.73, 0.85, 0.47]),
        row("clothoid", samples::clothoid(), [0.77, 0.17, 0.84]),
        row("const-κ", samples::constant_curvature(), [0.11, 0.06, 0.01]),
    ];
    // The same trade may be met at another price than the reference's own of 0.3.
    for row in rows {
        let met = [0.3, 0.27, 0.25].into_iter().any(|nesting_price| {
            let request = FitRequest {
                nesting_price,
                ..FitRequest::new(12, 0.04, 0.02)
            };
            let found = print(row.name, &row.curve, &request);
            found.deviation.rms_mm <= 1.01 * row.rms_mm + 0.005
                && found.deviation.max_mm <= row.max_mm + 0.005
                && found.chain.nesting_misfit_mm() <= 1.05 * row.misfit_mm + 0.005
        });
        assert!(met, "{}", row.name);
    }
}

#[test]
#[ignore = "takes a minute; run before a change of the fit"]
fn one_curvature_and_torsion_do_as_well_as_the_reference() {
    let rows = [
        ("Viviani", samples::viviani(), 0.81),
        ("sine", samples::sine(), 1.30),
        ("const-κ", samples::constant_curvature(), 0.06),
        ("clothoid", samples::clothoid(), 11.0),
    ];
    for (name, curve, rms_mm) in rows {
        let request = FitRequest {
            curvature: Freedom::One,
            torsion: Freedom::One,
            ..FitRequest::new(12, 0.04, 0.02)
        };
        let found = print(name, &curve.scaled_to(300.0), &request);
        assert!(found.deviation.rms_mm <= rms_mm + 0.05, "{name}");
    }
}

#[test]
#[ignore = "takes a minute; run before a change of the fit"]
fn the_trefoil_is_met_better_than_the_reference_and_is_free_of_itself() {
    let curve = samples::trefoil().scaled_to(900.0);
    let body_mm = (0..12).map(|i| 14.0 - f64::from(i)).collect();
    let request = FitRequest {
        body_mm,
        ..FitRequest::new(12, 0.75 / 14.0, 0.01)
    };
    let found = print("trefoil", &curve, &request);
    assert!(found.is_embedded());
    assert!(found.deviation.max_mm < 12.4 && found.deviation.rms_mm < 6.4);
}

/// Returns samples of a curve, each off by a distance whose root mean square is the deviation.
fn noisy(curve: &Curve, points: usize, deviation_mm: f64) -> Curve {
    let mut state = 1u64;
    let mut uniform = || {
        // Knuth's linear congruential generator.
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    // The sum of twelve uniform numbers has a variance of one.
    let mut normal = || (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
    let mut shaken = curve.samples(points);
    for point in &mut shaken {
        *point += Vector::new(normal(), normal(), normal()) * (deviation_mm / 3f64.sqrt());
    }
    Curve::of_polyline(shaken).unwrap()
}

#[test]
#[ignore = "takes a minute; run before a change of the fit"]
fn noise_of_the_samples_does_little_harm() {
    let curves = [
        ("Viviani", samples::viviani(), 300.0, 0.02),
        ("sine", samples::sine(), 300.0, 0.02),
        ("const-κ", samples::constant_curvature(), 300.0, 0.02),
        ("trefoil", samples::trefoil(), 900.0, 0.01),
    ];
    for (name, curve, length_mm, torsion) in curves {
        let curve = curve.scaled_to(length_mm);
        let request = FitRequest::new(12, 0.75 / 14.0, torsion);
        let rms = |curve: &Curve, clean: &Curve| {
            let chain = fit(curve, &request).unwrap().chain;
            let target = clean.samples(12 * JUDGED_SAMPLES);
            Deviation::between(&chain.samples(JUDGED_SAMPLES), &target).rms_mm
        };
        let clean = rms(&curve, &curve);
        let noise = rms(&noisy(&curve, 300, 0.3), &curve);
        println!("{name}: {clean:.3} clean, {noise:.3} with noise");
        assert!(noise <= 1.05 * clean + 0.1, "{name}");
    }
}
