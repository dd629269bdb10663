//! Shells that are printed in each other: apart by the clearance everywhere, and held by rings.

use super::*;
use crate::telescope::sizes::Tails;

/// Measures of a printer that leaves powder.
fn nested_sizes() -> JointSizes {
    JointSizes {
        slide_mm: 0.5,
        seat_mm: 0.1,
        engagement_mm: 1.0,
        tails: Tails::InPlace { vent_mm: Some(4.0) },
        ..sizes()
    }
}

/// Three nested shells of one helix, with a turn.
fn nested() -> (Telescope, Vec<Solid>) {
    let telescope = Telescope::nest(&chain(vec![0.5, 0.0]), 6.0, &nested_sizes()).unwrap();
    let solids = (0..3).map(|shell| telescope.nested_solid(shell, None).unwrap());
    let solids = solids.collect();
    (telescope, solids)
}

/// The gap of a shell to the one before it in a state, mm.
fn gap_mm(telescope: &Telescope, solids: &[Solid], joint: usize, slide_mm: f64) -> f64 {
    let state = JointState {
        slide_mm,
        turn_rad: 0.0,
    };
    let inner = placed(&solids[joint + 1], &telescope.step(joint, &state));
    MeshDistance::new(solids[joint].mesh()).min_distance_to(&inner)
}

#[test]
fn nested_shells_are_apart_by_the_clearance_all_in_and_over_the_stroke() {
    let (telescope, solids) = nested();
    for joint in 0..2 {
        for slide_mm in [0.0, 1.0, 15.0, 34.0] {
            let gap = gap_mm(&telescope, &solids, joint, slide_mm);
            assert!((0.49..0.5005).contains(&gap), "{joint} {slide_mm}: {gap}");
        }
    }
    // The first and the last have a shell between them.
    let first = MeshDistance::new(solids[0].mesh());
    let last = placed(&solids[2], &telescope.frames(&telescope.closed())[2]);
    assert!(first.min_distance_to(&last) > 1.0);
}

#[test]
fn a_ring_holds_a_nested_shell_from_behind_after_a_clearance_along_the_cone() {
    let (telescope, solids) = nested();
    let shared_mm3 = |slide_mm: f64| {
        let state = JointState {
            slide_mm,
            turn_rad: 0.0,
        };
        let inner = Csg::of_mesh(&placed(&solids[1], &telescope.step(0, &state))).unwrap();
        let common = Csg::of_solid(&solids[0]).unwrap().intersect(&inner);
        common.unwrap().to_mesh().unwrap().signed_volume_mm3()
    };
    // Along a straight axis a cone of 45° is met after √2 clearances, in a bend no sooner.
    let along_mm = 0.5 * std::f64::consts::SQRT_2;
    assert!(shared_mm3(-along_mm + 0.02) < 1e-6);
    assert!(shared_mm3(-1.3 * along_mm) > 0.05);
    // Far behind, it is still held: the flange is wider than the ring is open.
    assert!(shared_mm3(-1.5) > 10.0);
}

#[test]
fn all_tails_lie_in_one_plane_and_the_last_shell_is_closed_there() {
    let (telescope, solids) = nested();
    let tail = telescope.shells[0].helix.frame_at(telescope.ends_mm()[0]);
    for (shell, solid) in solids.iter().enumerate() {
        let low = solid.mesh().vertices().iter().map(|p| tail.to_local(p).x);
        let low = low.fold(f64::INFINITY, f64::min);
        assert!(low.abs() < 1e-9, "{shell}: {low}");
        // A point on the axis, half a millimetre above the plate.
        let on_axis = tail.to_model(&Point::new(0.5, 0.0, 0.0));
        let is_inside = MeshDistance::new(solid.mesh()).signed(&on_axis) > 0.0;
        assert_eq!(is_inside, shell == 2, "{shell}");
    }
}

#[test]
fn powder_leaves_every_shell_that_holds_another_through_two_holes() {
    let (telescope, solids) = nested();
    assert_eq!(telescope.vent_of(2), None);
    for (shell, solid) in solids[..2].iter().enumerate() {
        let vent = telescope.vent_of(shell).unwrap();
        let own = &telescope.shells[shell];
        let frame = own.helix.frame_at(vent.arc_mm);
        let walls = MeshDistance::new(solid.mesh());
        for side in [-1.0, 1.0] {
            let in_wall = side * (own.body_mm - 0.4);
            let hole = frame.to_model(&Point::new(0.0, 0.0, in_wall));
            assert!((walls.signed(&hole) + vent.radius_mm).abs() < 0.1);
            // Beside the hole the wall is whole.
            let beside = frame.to_model(&Point::new(0.0, in_wall, 0.0));
            assert!(walls.signed(&beside) > 0.3);
        }
    }
}

#[test]
fn a_flange_too_short_for_its_cone_is_refused() {
    let short = JointSizes {
        flange_mm: 1.5,
        ..nested_sizes()
    };
    let said = short.check().unwrap_err().to_string();
    assert!(
        said.contains("cone at the tail") && said.contains("longer overlap"),
        "{said}"
    );
    let capped = JointSizes {
        tails: Tails::Capped,
        ..short
    };
    assert!(capped.check().is_ok());
}

#[test]
fn a_foot_around_a_nested_root_adds_its_ring_and_nothing_else() {
    let (telescope, solids) = nested();
    let foot = DiscFoot {
        pocket_mm: None,
        radius_mm: 20.0,
        height_mm: 3.0,
    };
    let with = telescope.nested_solid(0, Some(&foot)).unwrap();
    let [own, whole] = [&solids[0], &with].map(|solid| moments_of_mesh(solid.mesh()).volume());
    let body_mm = telescope.shells[0].body_mm;
    let ring = std::f64::consts::PI * (20.0_f64.powi(2) - body_mm.powi(2)) * 3.0;
    // Both chamfers of the foot, and that of the root's tail, are small.
    assert!(((whole - own) / ring - 1.0).abs() < 0.01, "{}", whole - own);
    let tail = telescope.shells[0].helix.frame_at(telescope.ends_mm()[0]);
    let low = with.mesh().vertices().iter().map(|p| tail.to_local(p).x);
    assert!(low.fold(f64::INFINITY, f64::min).abs() < 1e-9);
}
