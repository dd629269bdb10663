//! Tips that reach places, and places that they cannot.

use super::*;
use crate::telescope::motion::{Key, Opening, Order};

/// The eight shells of the reference, alone. Its opening is not looked at.
fn eight() -> Network {
    let telescope = Telescope::nest(&eight_pieces(vec![0.0; 7]), 4.0, &sizes()).unwrap();
    alone(telescope)
}

fn eight_pieces(turns_rad: Vec<f64>) -> Chain {
    let piece = Helix {
        curvature: 1.0 / 60.0,
        torsion: 0.0,
    };
    Chain {
        start: Frame::identity(),
        piece_mm: 40.0,
        pieces: vec![piece; turns_rad.len() + 1],
        turns_rad,
    }
}

fn alone(telescope: Telescope) -> Network {
    let opening = Opening {
        order: Order::root_first(telescope.joints.len()),
        keys: vec![telescope.closed(), telescope.open()],
        least: Gap {
            gap_mm: f64::INFINITY,
            shells: [0, 0],
        },
    };
    Network::alone(telescope, opening)
}

/// Returns a state of all joints, each at its share of stroke, or turned by it when all out.
fn state_at(network: &Network, share: impl Fn(usize) -> f64) -> Vec<Key> {
    let telescope = &network.limbs[0].telescope;
    let closed_mm = telescope.sizes.closed_mm();
    let joints = telescope.joints.iter().enumerate();
    let state = joints.map(|(joint, own)| {
        let gone = 2.0 * share(joint);
        let turned = if own.turn_rad == 0.0 {
            0.0
        } else {
            (gone - 1.0).max(0.0)
        };
        let slid = if own.turn_rad == 0.0 {
            0.5 * gone
        } else {
            gone.min(1.0)
        };
        JointState {
            slide_mm: closed_mm + slid * (telescope.visible_mm - closed_mm),
            turn_rad: turned * own.turn_rad,
        }
    });
    vec![state.collect()]
}

/// Goals of the reference: ends of states that are spread over all.
fn goals(network: &Network) -> Vec<Target> {
    let goal = |i: usize| {
        let share = |joint: usize| {
            (f64::from(i as u32 + 1) * 0.618_034 * (1.0 + joint as f64 * 0.317)).fract()
        };
        let place = network.ends(&state_at(network, share))[0];
        Target { limb: 0, place }
    };
    (0..20).map(goal).collect()
}

#[test]
fn twenty_goals_of_eight_shells_are_reached_in_few_steps() {
    let network = eight();
    let mut steps = Vec::new();
    for goal in goals(&network) {
        let found = network.reach(&[goal]);
        assert!(found[0].off_mm < 1e-6, "{:?}", found[0]);
        let end = network.ends(&found[0].state)[0];
        assert!((end - goal.place).norm() < 1e-6);
        steps.push(found[0].steps);
    }
    steps.sort_unstable();
    assert!(steps[steps.len() / 2] <= 30, "{steps:?}");
}

#[test]
fn turns_are_used_where_shells_turn_and_only_when_all_out() {
    let turns = vec![1.2, -0.8, 0.6, 1.0];
    let network = alone(Telescope::nest(&eight_pieces(turns), 4.0, &sizes()).unwrap());
    let telescope = &network.limbs[0].telescope;
    let mut turned = 0;
    for goal in goals(&network) {
        let found = network.reach(&[goal]);
        assert!(found[0].off_mm < 1e-6, "{:?}", found[0]);
        for (own, joint) in found[0].state[0].iter().zip(&telescope.joints) {
            let closed_mm = telescope.sizes.closed_mm();
            assert!((closed_mm - 1e-9..=telescope.visible_mm + 1e-9).contains(&own.slide_mm));
            let share = own.turn_rad / joint.turn_rad;
            assert!((-1e-9..=1.0 + 1e-9).contains(&share), "{own:?}");
            let is_out = (own.slide_mm - telescope.visible_mm).abs() < 1e-9;
            assert!(is_out || own.turn_rad.abs() < 1e-9, "{own:?}");
            turned += usize::from(share > 1e-6 && share < 1.0 - 1e-6);
        }
    }
    assert!(turned > 0);
}

#[test]
fn where_the_search_ends_no_small_step_of_a_joint_comes_nearer() {
    // Where the search ends, no joint that moves a little comes nearer.
    let network = eight();
    let goal = Target {
        limb: 0,
        place: Point::new(30.0, 40.0, 90.0),
    };
    let found = &network.reach(&[goal])[0];
    assert!(found.off_mm > 1.0);
    let telescope = &network.limbs[0].telescope;
    let off = |state: &[Key]| (network.ends(state)[0] - goal.place).norm();
    for joint in 0..telescope.joints.len() {
        let moved = |by_mm: f64| {
            let mut state = found.state.clone();
            let own = &mut state[0][joint];
            let range = [telescope.sizes.closed_mm(), telescope.visible_mm];
            own.slide_mm = (own.slide_mm + by_mm).clamp(range[0], range[1]);
            off(&state)
        };
        for by_mm in [-1e-3, 1e-3] {
            assert!(moved(by_mm) > found.off_mm - 1e-6, "joint {joint}");
        }
    }
}

#[test]
fn a_place_beyond_all_shells_is_proved_too_far_and_none_reaches_it() {
    let network = eight();
    let far = Target {
        limb: 0,
        place: Point::new(0.0, 500.0, 0.0),
    };
    let proof = network.too_far(&far).unwrap();
    assert!(proof.distance_mm > proof.reach_mm);
    assert!((proof.reach_mm - 7.0 * 40.0).abs() < 1e-9);
    assert!(network.reach(&[far])[0].off_mm > proof.distance_mm - proof.reach_mm);
    for goal in goals(&network) {
        assert!(network.too_far(&goal).is_none());
    }
}
