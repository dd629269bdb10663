//! Checks if pins enter sockets they are not meant for.

use crate::cut::geometry::chart::Point2;

/// End view of a pin and its socket, looking along the pin, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Peg {
    pub(crate) at: Point2,
    pub(crate) pin_mm: f64,
    pub(crate) socket_mm: f64,
}

/// Distance by which a printed pin may be forced beyond its nominal play, mm: the common tolerance
/// of the printers.
pub(crate) const FORCE_TOLERANCE_MM: f64 = 0.1;

/// Returns true if the pins of one joint enter the sockets of another.
///
/// Exact to the play. Tries a rotation of the plane for every ordered pair of sockets that the
/// first two pins could enter. The cost grows with the square of the number of sockets. A single
/// pin enters every wider socket.
pub(crate) fn fits(pins: &[Peg], sockets: &[Peg]) -> bool {
    let Some((first, rest)) = pins.split_first() else {
        return false;
    };
    if rest.is_empty() {
        sockets.iter().any(|s| enters(first, s))
    } else {
        fits_rotated(pins, sockets, None)
    }
}

/// Returns true if the pins of a joint enter their own sockets in a second way.
pub(crate) fn fits_itself(pegs: &[Peg]) -> bool {
    fits_rotated(pegs, pegs, Some((0, 1)))
}

/// Returns true if two or more pins enter sockets in some rotation. The first two may take any pair
/// of sockets but the excluded one.
fn fits_rotated(pins: &[Peg], sockets: &[Peg], excluded: Option<(usize, usize)>) -> bool {
    let [first, second, ..] = pins else {
        return false;
    };
    (0..sockets.len()).any(|i| {
        (0..sockets.len())
            .filter(|&j| j != i && excluded != Some((i, j)))
            .any(|j| {
                enters(first, &sockets[i])
                    && enters(second, &sockets[j])
                    && all_enter(pins, sockets, [&sockets[i], &sockets[j]])
            })
    })
}

/// Returns true if a pin is thin enough for a socket.
fn enters(pin: &Peg, socket: &Peg) -> bool {
    pin.pin_mm <= socket.socket_mm + FORCE_TOLERANCE_MM
}

/// Returns true if all pins find a socket once the first two sit in `seats`.
fn all_enter(pins: &[Peg], sockets: &[Peg], seats: [&Peg; 2]) -> bool {
    let (from, to) = (pins[1].at - pins[0].at, seats[1].at - seats[0].at);
    let play = |pin: &Peg, socket: &Peg| {
        (socket.socket_mm - pin.pin_mm).max(0.0) / 2.0 + FORCE_TOLERANCE_MM
    };
    let slack = play(&pins[0], seats[0]) + play(&pins[1], seats[1]);
    if (from.norm() - to.norm()).abs() > slack || from.norm() == 0.0 || to.norm() == 0.0 {
        return false;
    }
    let (a, b) = (from.normalize(), to.normalize());
    let (cos, sin) = (a.dot(&b), a.perp(&b));
    pins[2..].iter().all(|pin| {
        let arm = pin.at - pins[0].at;
        let rotated = seats[0].at
            + nalgebra::Vector2::new(cos * arm.x - sin * arm.y, sin * arm.x + cos * arm.y);
        let lever = 1.0 + arm.norm() / from.norm();
        sockets
            .iter()
            .any(|s| enters(pin, s) && (s.at - rotated).norm() <= play(pin, s) + lever * slack)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn peg(x: f64, y: f64, diameter: f64) -> Peg {
        Peg {
            at: Point2::new(x, y),
            pin_mm: diameter,
            socket_mm: diameter + 0.2,
        }
    }

    #[test]
    fn two_equal_pins_fit_after_a_half_turn_and_two_unequal_ones_do_not() {
        let equal = [peg(0.0, 0.0, 2.0), peg(9.0, 0.0, 2.0)];
        let unequal = [peg(0.0, 0.0, 2.0), peg(9.0, 0.0, 1.5)];
        assert!(fits_itself(&equal));
        assert!(!fits_itself(&unequal));
    }

    #[test]
    fn an_equilateral_triangle_rotates_onto_itself_and_a_scalene_one_does_not() {
        let equilateral = [
            peg(0.0, 0.0, 2.0),
            peg(8.0, 0.0, 2.0),
            peg(4.0, 48f64.sqrt(), 2.0),
        ];
        let scalene = [peg(0.0, 0.0, 2.0), peg(12.0, 0.0, 2.0), peg(3.0, 7.0, 2.0)];
        assert!(fits_itself(&equilateral));
        assert!(!fits_itself(&scalene));
    }

    #[test]
    fn the_same_pattern_in_another_joint_is_not_mistaken_for_its_own() {
        let pattern = [peg(0.0, 0.0, 2.0), peg(9.0, 0.0, 1.5)];
        assert!(!fits_itself(&pattern) && fits(&pattern, &pattern));
    }

    #[test]
    fn a_moved_and_rotated_copy_of_a_pattern_is_recognised() {
        let pattern = [peg(0.0, 0.0, 2.0), peg(9.0, 0.0, 1.5)];
        let copy = [peg(5.0, 14.0, 2.0), peg(5.0, 5.0, 1.5)];
        let wider = [peg(5.0, 15.0, 2.0), peg(5.0, 5.0, 1.5)];
        assert!(fits(&pattern, &copy));
        assert!(!fits(&pattern, &wider));
    }
}
