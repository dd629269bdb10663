//! Nested shells and their solids, against the figures of the method's reference.

use super::*;
use crate::curve::{Chain, Curve, FitRequest, Helix, fit};
use crate::geom::{Frame, Point};
use crate::mass::moments_of_mesh;
use crate::mesh::{Csg, MeshDistance, Solid, TriMesh};

/// The measures of the reference; without a press ring.
pub(super) fn sizes() -> JointSizes {
    JointSizes {
        wall_mm: 0.8,
        slide_mm: 0.3,
        engagement_mm: 0.6,
        flange_mm: 3.0,
        lip_mm: 3.0,
        seat_mm: 0.3,
        spigot_mm: 2.0,
        glue_mm: 0.1,
        vent_mm: 2.0,
        chamfer_mm: 0.3,
        feature_mm: 1.0,
    }
}

/// Shells of 40 mm of one helix.
fn chain(turns_rad: Vec<f64>) -> Chain {
    let piece = Helix {
        curvature: 1.0 / 60.0,
        torsion: 1.0 / 120.0,
    };
    Chain {
        start: Frame::identity(),
        piece_mm: 40.0,
        pieces: vec![piece; turns_rad.len() + 1],
        turns_rad,
    }
}

fn placed(solid: &Solid, frame: &Frame) -> TriMesh {
    solid.mesh().map_vertices(|p| frame.to_model(p))
}

/// A pair of shells with their solids.
struct Pair {
    telescope: Telescope,
    outer: Csg,
    inner: Solid,
    cap: Solid,
}

impl Pair {
    fn new(turn_rad: f64, sizes: &JointSizes) -> Self {
        let telescope = Telescope::nest(&chain(vec![turn_rad]), 6.0, sizes).unwrap();
        Self {
            outer: Csg::of_solid(&telescope.shell_solid(0).unwrap()).unwrap(),
            inner: telescope.shell_solid(1).unwrap(),
            cap: telescope.cap_solid(1).unwrap(),
            telescope,
        }
    }

    /// The volume that the inner shell with its cap shares with the outer one, mm³.
    fn common_mm3(&self, slide_mm: f64, turn_rad: f64) -> f64 {
        let state = JointState { slide_mm, turn_rad };
        let frame = self.telescope.step(0, &state);
        let volume = |solid: &Solid| {
            let inner = Csg::of_mesh(&placed(solid, &frame)).unwrap();
            let common = self.outer.intersect(&inner).unwrap();
            common.to_mesh().unwrap().signed_volume_mm3()
        };
        volume(&self.inner) + volume(&self.cap)
    }

    fn gap_mm(&self, slide_mm: f64) -> f64 {
        let state = JointState {
            slide_mm,
            turn_rad: 0.0,
        };
        let frame = self.telescope.step(0, &state);
        let outer = MeshDistance::new(&self.outer.to_mesh().unwrap());
        outer.min_distance_to(&placed(&self.inner, &frame))
    }
}

#[test]
fn radii_follow_from_the_body() {
    let radii = sizes().radii(6.0);
    assert!((radii.flange_mm - 6.9).abs() < 1e-12 && (radii.lip_mm - 6.3).abs() < 1e-12);
    assert!((radii.bore_mm - 7.2).abs() < 1e-12);
    let telescope = Telescope::nest(&chain(vec![0.0; 4]), 6.0, &sizes()).unwrap();
    let pitch = sizes().pitch_mm();
    for (i, shell) in telescope.shells.iter().rev().enumerate() {
        assert!((shell.body_mm - 6.0 - pitch * i as f64).abs() < 1e-9);
    }
}

#[test]
fn the_stop_is_free_before_and_holds_after() {
    let pair = Pair::new(0.0, &sizes());
    assert!(pair.common_mm3(39.95, 0.0) < 1e-9);
    let held = pair.common_mm3(40.05, 0.0);
    // The reference has a whole ring. Ours has the gap for the rib, on the inside of the bend,
    // where there is less of the ring.
    let joint = &pair.telescope.joints[0];
    let open = (joint.rib_rad + 2.0 * joint.play_rad) / std::f64::consts::TAU;
    let inside = 1.0 - 6.6 * pair.telescope.shells[1].helix.curvature;
    let expected = 1.243 * (1.0 - open * inside);
    assert!((held - expected).abs() < 0.005, "{held} {expected}");
}

#[test]
fn the_gap_is_the_clearance_over_the_stroke() {
    let pair = Pair::new(0.0, &sizes());
    for slide_mm in [7.0, 15.0, 25.0, 35.0, 39.5] {
        let gap = pair.gap_mm(slide_mm);
        assert!((0.295..0.3005).contains(&gap), "{slide_mm}: {gap}");
    }
}

#[test]
fn the_press_ring_closes_the_gap_only_at_the_end() {
    let tight = JointSizes {
        seat_mm: 0.1,
        ..sizes()
    };
    let pair = Pair::new(0.0, &tight);
    let (sliding, seated) = (pair.gap_mm(25.0), pair.gap_mm(39.8));
    assert!((0.295..0.3005).contains(&sliding), "{sliding}");
    assert!((seated - 0.0994).abs() < 0.005, "{seated}");
    assert!(pair.common_mm3(39.95, 0.0) < 1e-9);
}

#[test]
fn the_twist_stop_turns_as_far_as_asked_and_no_farther() {
    for sign in [1.0, -1.0] {
        let turn = sign * 110f64.to_radians();
        let pair = Pair::new(turn, &sizes());
        let beyond = sign * (pair.telescope.joints[0].play_rad + 2f64.to_radians());
        // A turned flange is out of the middle, and the stop leaves room for that.
        for share in [0.0, 0.5, 1.0] {
            let free = pair.common_mm3(40.0, share * turn);
            assert!(free < 1e-6, "{share}: {free}");
        }
        let stop_mm = 40.0 + pair.telescope.joints[0].stop_room_mm;
        assert!(pair.common_mm3(stop_mm - 0.02, 0.0) < 1e-6);
        assert!(pair.common_mm3(stop_mm + 0.05, 0.0) > 0.1);
        for stopped in [turn + beyond, -beyond] {
            let held = pair.common_mm3(40.0, stopped);
            // The reference has 0.37 and 0.39; our rib reaches on to the lip's cone.
            assert!((0.36..0.5).contains(&held), "{stopped}: {held}");
        }
        assert!(pair.common_mm3(25.0, 0.0) < 1e-9);
    }
}

#[test]
fn every_part_is_a_solid_and_a_cap_fits_its_shell() {
    let mut unlike = chain(vec![0.3, -0.8]);
    unlike.pieces[1].curvature = 0.02;
    unlike.pieces[2].torsion = 0.012;
    let telescope = Telescope::nest(&unlike, 6.0, &sizes()).unwrap();
    assert!(telescope.joints[0].excess_mm > 1.0);
    for shell in 0..3 {
        let (tube, cap) = (telescope.shell_solid(shell), telescope.cap_solid(shell));
        let [tube, cap] = [tube, cap].map(|part| Csg::of_solid(&part.unwrap()).unwrap());
        let common = tube.intersect(&cap).unwrap().to_mesh().unwrap();
        assert!(common.signed_volume_mm3().abs() < 1e-6, "{shell}");
        assert!(!tube.has_self_intersections() && !cap.has_self_intersections());
        assert_eq!(tube.decompose().unwrap().len(), 1);
        assert_eq!(cap.decompose().unwrap().len(), 1);
    }
}

#[test]
fn neighbours_of_unlike_shape_are_free_over_the_stroke_and_leave_the_wall() {
    let mut unlike = chain(vec![0.3]);
    unlike.pieces[1].curvature = 0.02;
    let telescope = Telescope::nest(&unlike, 6.0, &sizes()).unwrap();
    let outer = telescope.shell_solid(0).unwrap();
    let (tube, cap) = (
        telescope.shell_solid(1).unwrap(),
        telescope.cap_solid(1).unwrap(),
    );
    let own_cap = telescope.cap_solid(0).unwrap();
    for slide_mm in [sizes().closed_mm(), 20.0, 39.5] {
        let state = JointState {
            slide_mm,
            turn_rad: 0.0,
        };
        let frame = telescope.step(0, &state);
        for part in [&tube, &cap] {
            let part = placed(part, &frame);
            let gap = MeshDistance::new(outer.mesh()).min_distance_to(&part);
            assert!(gap > 0.29, "{slide_mm}: {gap}");
            let gap = MeshDistance::new(own_cap.mesh()).min_distance_to(&part);
            assert!(gap > 0.29, "{slide_mm}: {gap} to the cap");
        }
    }
}

#[test]
fn a_tube_in_closed_form_is_that_of_the_mesh() {
    let helix = chain(vec![]).pieces[0];
    let tube = |radius| {
        let profile = Profile::new([[0.0, radius], [60.0, radius]]);
        let mesh = sweep_profile(&Frame::identity(), &helix, &profile).unwrap();
        moments_of_mesh(&mesh)
    };
    let found = tube(12.0) - tube(11.2);
    let expected = TubeMass::of(&helix, [11.2, 12.0], [0.0, 60.0]);
    assert!((found.volume() / expected.volume_mm3 - 1.0).abs() < 1e-3);
    let centre = found.first() / found.volume();
    assert!((centre - expected.centre.coords).norm() < 0.01, "{centre}");
}

#[test]
fn what_cannot_nest_is_refused_with_its_figures() {
    let refused = |chain: &Chain, tip_mm: f64, sizes: &JointSizes| {
        Telescope::nest(chain, tip_mm, sizes)
            .unwrap_err()
            .to_string()
    };
    let straight = chain(vec![0.0]);
    assert!(refused(&straight, 60.0, &sizes()).contains("radius of 60.0 mm"));
    assert!(refused(&straight, 1.0, &sizes()).contains("at least two walls"));
    let wide = JointSizes {
        slide_mm: 0.9,
        ..sizes()
    };
    assert!(refused(&straight, 6.0, &wide).contains("at most the wall"));
    let nothing = JointSizes {
        lip_mm: f64::NAN,
        ..sizes()
    };
    assert!(refused(&straight, 6.0, &nothing).contains("lip"));
    let tight = JointSizes {
        slide_mm: 0.1,
        seat_mm: 0.05,
        ..sizes()
    };
    assert!(refused(&chain(vec![3.0]), 6.0, &tight).contains("before shell 2 parts"));
    assert!(refused(&chain(vec![4.2]), 6.0, &sizes()).contains("less than 120°"));
    let mut short = chain(vec![0.0]);
    short.piece_mm = 8.0;
    assert!(refused(&short, 6.0, &sizes()).contains("longer shells"));
    short.turns_rad.clear();
    assert!(refused(&short, 6.0, &sizes()).contains("a turn before each piece"));
    let mut curled = chain(vec![0.0]);
    curled.piece_mm = 200.0;
    assert!(refused(&curled, 6.0, &sizes()).contains("half a circle"));
}

#[test]
fn a_crook_opens_root_first_with_room_to_spare() {
    let mut crook = chain(vec![0.0; 5]);
    for piece in &mut crook.pieces {
        *piece = Helix {
            curvature: 1.0 / 120.0,
            torsion: 0.0,
        };
    }
    let telescope = Telescope::nest(&crook, 6.0, &sizes()).unwrap();
    let opening = telescope.find_opening().unwrap();
    assert!(opening.least.gap_mm > 5.0, "{:?}", opening.least);
    assert_eq!(opening.keys.first(), Some(&telescope.closed()));
    assert_eq!(opening.keys.last(), Some(&telescope.open()));
}

#[test]
fn the_open_state_is_the_chain_and_shells_in_line_slide_in_each_other() {
    let chain = chain(vec![0.4, -0.7]);
    let telescope = Telescope::nest(&chain, 6.0, &sizes()).unwrap();
    for (frame, start) in telescope
        .frames(&telescope.open())
        .iter()
        .zip(chain.starts())
    {
        assert!((frame.origin - start.origin).norm() < 1e-12);
        assert!((frame.axes - start.axes).norm() < 1e-12);
    }
    // Half out, the inner helix lies in the cavity's: it is the same curve, moved along.
    let half = JointState {
        slide_mm: 20.0,
        turn_rad: 0.0,
    };
    let full = JointState {
        slide_mm: 40.0,
        turn_rad: 0.0,
    };
    let helix = telescope.shells[1].helix;
    let there = telescope
        .step(0, &half)
        .frame_to_model(&helix.frame_at(20.0));
    let same = telescope
        .step(0, &full)
        .frame_to_model(&helix.frame_at(0.0));
    assert!((there.origin - same.origin).norm() < 1e-12);
}

/// Two arcs of half a circle with a straight shell between: turned, the last comes back to the
/// first.
fn hairpin(turn_rad: f64) -> Telescope {
    let arc = Helix {
        curvature: std::f64::consts::PI / 120.0,
        torsion: 0.0,
    };
    let chain = Chain {
        start: Frame::identity(),
        piece_mm: 100.0,
        pieces: vec![arc; 4],
        turns_rad: vec![turn_rad; 3],
    };
    Telescope::nest(&chain, 3.0, &sizes()).unwrap()
}

#[test]
fn an_order_that_collides_is_refused_with_the_shells_and_the_depth() {
    // Four arcs of 150° in a plane go round the circle more than once.
    let telescope = hairpin(0.0);
    let collision = telescope.open_in(&Order::root_first(3)).unwrap_err();
    assert!(collision.depth_mm > 1.0, "{collision}");
    assert!(collision.shells[1] >= collision.shells[0] + 2);
    assert!(collision.to_string().contains("run into each other"));
    assert!(telescope.find_opening().is_err());
}

#[test]
fn no_state_on_a_free_way_has_a_lesser_gap_than_was_told() {
    let telescope = Telescope::nest(&chain(vec![0.9; 5]), 4.0, &sizes()).unwrap();
    let opening = telescope.find_opening().unwrap();
    for pair in opening.keys.windows(2) {
        for i in 0..=40 {
            let share = f64::from(i) / 40.0;
            let mix = |a: f64, b: f64| a + (b - a) * share;
            let state: Vec<JointState> = pair[0]
                .iter()
                .zip(&pair[1])
                .map(|(a, b)| JointState {
                    slide_mm: mix(a.slide_mm, b.slide_mm),
                    turn_rad: mix(a.turn_rad, b.turn_rad),
                })
                .collect();
            let gap = clearance::Shown::of(&telescope, &state).gaps().least.gap_mm;
            assert!(
                gap >= 0.5 * opening.least.gap_mm,
                "{gap} {:?}",
                opening.least
            );
        }
    }
}

/// The trefoil of the reference, 900 mm long.
fn trefoil_curve() -> Curve {
    let at = |i: u32| {
        let t = 0.25 + (std::f64::consts::TAU - 0.5) * f64::from(i) / 3000.0;
        let [x, y] = [
            t.sin() + 2.0 * (2.0 * t).sin(),
            t.cos() - 2.0 * (2.0 * t).cos(),
        ];
        Point::new(x, y, -(3.0 * t).sin())
    };
    let curve = Curve::of_polyline((0..=3000).map(at).collect()).unwrap();
    curve.scaled_to(900.0)
}

/// The trefoil in 12 shells with bodies of 14 to 3 mm, fitted anew.
fn trefoil() -> Telescope {
    let body_mm: Vec<f64> = (0..12).map(|i| 14.0 - f64::from(i)).collect();
    let request = FitRequest {
        body_mm: body_mm.clone(),
        ..FitRequest::new(12, 0.75 / 14.0, 0.01)
    };
    let fit = fit(&trefoil_curve(), &request).unwrap();
    println!("deviation {:?}", fit.deviation);
    // The reference has its bodies as given, without the walls that unlike shapes cost.
    bare(&fit.chain, &body_mm)
}

/// Measures with a pitch of 1 mm.
fn thin() -> JointSizes {
    JointSizes {
        wall_mm: 0.4,
        slide_mm: 0.15,
        engagement_mm: 0.3,
        seat_mm: 0.1,
        chamfer_mm: 0.1,
        ..sizes()
    }
}

/// Shells of given bodies on a chain, without the checks of nesting.
fn bare(chain: &Chain, body_mm: &[f64]) -> Telescope {
    let joint = |(turn_rad, body_mm): (&f64, &f64)| Joint {
        turn_rad: *turn_rad,
        radii: thin().radii(*body_mm),
        seat_mm: 0.15,
        stop_room_mm: 0.0,
        excess_mm: 0.0,
        rib_rad: 0.1,
        play_rad: 0.05,
    };
    let shell = |(helix, body_mm): (&Helix, &f64)| Shell {
        helix: *helix,
        body_mm: *body_mm,
    };
    Telescope {
        start: chain.start,
        visible_mm: chain.piece_mm,
        shells: chain.pieces.iter().zip(body_mm).map(shell).collect(),
        joints: chain
            .turns_rad
            .iter()
            .zip(&body_mm[1..])
            .map(joint)
            .collect(),
        sizes: thin(),
    }
}

#[test]
#[ignore = "takes a minute; run before a change of the motion"]
fn the_trefoil_opens_root_first_and_not_all_at_once() {
    let telescope = trefoil();
    let joints = telescope.joints.len();
    for order in [
        Order::root_first(joints),
        Order::together(joints),
        Order::tip_first(joints),
    ] {
        let clock = std::time::Instant::now();
        let found = telescope.open_in(&order);
        let seconds = clock.elapsed().as_secs_f64();
        match &found {
            Ok(opening) => println!(
                "{:?}: {:?} in {seconds:.1} s",
                order.groups(),
                opening.least
            ),
            Err(collision) => println!("{:?}: {collision} in {seconds:.1} s", order.groups()),
        }
        assert_eq!(found.is_err(), order == Order::together(joints));
    }
}

#[test]
#[ignore = "takes a minute; run before a change of the fit"]
fn the_trefoil_nests_with_its_turns_bounded_and_opens() {
    let wish = Wish {
        tip_mm: 3.0,
        within_mm: 20.0,
        max_torsion: 0.01,
        ..Wish::new(vec![12], thin())
    };
    let made = design(&trefoil_curve(), &wish, 12).unwrap();
    let turns = made
        .telescope
        .joints
        .iter()
        .map(|j| j.turn_rad.to_degrees());
    println!(
        "deviation {:?}, root {:.1} mm, turns {:.0?}, {:?}",
        made.fit.deviation,
        made.telescope.shells[0].body_mm,
        turns.collect::<Vec<f64>>(),
        made.opening.least,
    );
    for joint in &made.telescope.joints {
        assert!(joint.seat_mm <= thin().slide_mm);
    }
}

#[test]
fn neighbours_that_curl_into_each_other_are_refused() {
    let curl = |degrees: f64| {
        let arc = Helix {
            curvature: degrees.to_radians() / 100.0,
            torsion: 0.0,
        };
        let chain = Chain {
            start: Frame::identity(),
            piece_mm: 100.0,
            pieces: vec![arc; 2],
            turns_rad: vec![0.0],
        };
        bare(&chain, &[4.0, 3.0]).open_in(&Order::root_first(1))
    };
    // With half an overlap of 6.3 mm at either end, twice 178° go round once and 7° more.
    assert_eq!(curl(178.0).unwrap_err().shells, [0, 1]);
    // Twice 170° leave 20° of 33.7 mm less the overlap: 5.5 mm between two faces that lean by 9°.
    let gap_mm = curl(170.0).unwrap().least.gap_mm;
    assert!((4.0..5.5).contains(&gap_mm), "{gap_mm}");
}

#[test]
fn a_plane_across_a_mouth_parts_what_is_beyond_it() {
    // A last shell that bends as sharply as it can, before a root much thicker than its bend.
    let piece = |curvature| Helix {
        curvature,
        torsion: 0.0,
    };
    let chain = Chain {
        start: Frame::identity(),
        piece_mm: 60.0,
        pieces: vec![piece(0.0), piece(0.0), piece(0.05)],
        turns_rad: vec![0.0; 2],
    };
    let opening = bare(&chain, &[30.0, 27.0, 4.0]).open_in(&Order::root_first(2));
    assert!(opening.unwrap().least.gap_mm > 0.5);
}

/// The crook of the reference: six tubes of 40 mm on a foot, in a plane.
fn crook() -> Telescope {
    let chain = Chain {
        start: Frame::identity(),
        piece_mm: 40.0,
        pieces: vec![
            Helix {
                curvature: 1.0 / 120.0,
                torsion: 0.0,
            };
            6
        ],
        turns_rad: vec![0.0; 5],
    };
    bare(&chain, &[14.0, 12.0, 10.0, 8.0, 6.0, 4.0])
}

const FOOT: DiscFoot = DiscFoot {
    radius_mm: 30.0,
    height_mm: 6.0,
};

#[test]
fn the_crook_weighs_and_topples_as_the_reference_says() {
    let crook = crook();
    let tube = |shell: &Shell| {
        TubeMass::of(
            &shell.helix,
            [shell.body_mm - 0.8, shell.body_mm],
            [0.0, 40.0],
        )
    };
    let tubes: Vec<TubeMass> = crook.shells.iter().map(tube).collect();
    for (slide_mm, degrees) in [(0.0, 68.28), (20.0, 44.65), (40.0, 22.71)] {
        let state = JointState {
            slide_mm,
            turn_rad: 0.0,
        };
        let balance = crook.balance(&tubes, &FOOT, &[state; 5]);
        let mass_g = balance.volume_mm3 * 1.24e-3;
        let found = balance.toppling_rad.to_degrees();
        assert!((mass_g - 33.901).abs() < 0.01, "{mass_g}");
        assert!((found - degrees).abs() < 0.01, "{found} {degrees}");
    }
}

#[test]
fn the_worst_balance_is_no_better_than_that_of_any_key() {
    let telescope = Telescope::nest(&chain(vec![0.5, -0.5]), 6.0, &sizes()).unwrap();
    let masses = telescope.weigh().unwrap();
    let opening = telescope.find_opening().unwrap();
    let (state, worst) = telescope.worst_balance(&masses, &FOOT, &opening);
    assert_eq!(telescope.balance(&masses, &FOOT, &state), worst);
    for key in &opening.keys {
        let balance = telescope.balance(&masses, &FOOT, key);
        assert!(balance.toppling_rad >= worst.toppling_rad);
        assert!((balance.volume_mm3 - worst.volume_mm3).abs() < 1e-6);
    }
}
