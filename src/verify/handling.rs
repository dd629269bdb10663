//! A match: how far a body is from the mass, centre and inertia that are wanted.

use super::limits::{AXIS_OFFSET_LIMIT_MM, MATCH_LIMIT_RATIO};
use super::{Check, CheckKind, Figures, Limit};
use crate::geom::Point;
use crate::goal::Target;

/// The distance of a body from the mass properties that are wanted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mismatch {
    /// What it weighs too much, as a share of the wanted mass; negative if it is too light.
    pub mass_ratio: f64,
    /// The distance of its centre of mass, mm.
    pub center_mm: f64,
    /// The greatest error of an entry of its inertia tensor, as a share of the wanted trace.
    pub inertia_ratio: f64,
}

/// The limits of a match, and the words for its body.
#[derive(Debug, Clone, Copy)]
pub(super) struct MatchLimits {
    /// Share of the mass.
    pub mass_ratio: f64,
    /// Distance of the centre of mass, mm.
    pub center_mm: f64,
    /// Share of the trace of the inertia tensor.
    pub inertia_ratio: f64,
}

impl MatchLimits {
    /// The limits of the written parts.
    pub const WRITTEN: Self = Self {
        mass_ratio: MATCH_LIMIT_RATIO,
        center_mm: AXIS_OFFSET_LIMIT_MM,
        inertia_ratio: MATCH_LIMIT_RATIO,
    };
}

impl Mismatch {
    /// Compares a body with what is wanted.
    pub fn of(wanted: &Target, found: &Figures) -> Self {
        let body = wanted.body();
        let tensor = body.inertia_g_mm2;
        let error = |row: usize, column: usize| {
            (found.inertia_g_mm2[row][column] - tensor[(row, column)]).abs()
        };
        let entries = (0..3).flat_map(|row| (0..3).map(move |column| (row, column)));
        let most = entries.fold(0.0, |most: f64, (row, column)| most.max(error(row, column)));
        Self {
            mass_ratio: found.mass_g / wanted.mass_g - 1.0,
            center_mm: (Point::from(found.center_mm) - body.center).norm(),
            inertia_ratio: most / tensor.trace(),
        }
    }

    /// Checks that all is as wanted, within limits.
    pub(super) fn checks(&self, limits: MatchLimits) -> [Check; 3] {
        let percent = |ratio: f64| Some(ratio.abs() * 100.0);
        [
            Check::new(
                CheckKind::MatchMass,
                "its mass is the wanted one, within",
                percent(self.mass_ratio),
                Limit::at_most(limits.mass_ratio * 100.0, "%"),
            ),
            Check::new(
                CheckKind::MatchCenter,
                "its centre of mass is where it is wanted, within",
                Some(self.center_mm),
                Limit::at_most(limits.center_mm, "mm"),
            ),
            Check::new(
                CheckKind::MatchInertia,
                "its moments of inertia are the wanted ones, in shares of their sum within",
                percent(self.inertia_ratio),
                Limit::at_most(limits.inertia_ratio * 100.0, "%"),
            ),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::goal::GoalKind;
    use crate::mass::{Body, moments_of_mesh};
    use crate::verify::{Aim, Setting};

    fn setting(wanted: Option<Target>) -> Setting {
        Setting {
            density_g_cm3: 1.24,
            aim: Aim {
                wanted,
                ..Aim::new(GoalKind::Match, [0.0; 3], [0.0, 0.0, 1.0])
            },
            support: None,
            ends_mm: None,
            hull: None,
            hardware: crate::mass::Moments::default(),
        }
    }

    #[test]
    fn a_body_matches_itself_and_a_moved_or_heavier_one_is_told_by_how_much() {
        let corner = Point::new(1.0, 2.0, 3.0);
        let cube = crate::verify::test_meshes::block(corner, [3.0, 5.0, 6.0]);
        let moments = moments_of_mesh(&cube);
        let body = Body::new(&moments, 1.24e-3);
        let found = Figures::new(&moments, &setting(None));
        let same = Mismatch::of(&Target::of(&body), &found);
        assert!(same.mass_ratio.abs() < 1e-12 && same.center_mm < 1e-12);
        assert!(same.inertia_ratio < 1e-12);
        assert!(
            same.checks(MatchLimits::WRITTEN)
                .iter()
                .all(|check| check.pass)
        );
        let other = Target {
            mass_g: body.mass_g * 1.02,
            ..Target::of(&body)
        };
        let other = Mismatch::of(&other, &found);
        assert!((other.mass_ratio + 0.02 / 1.02).abs() < 1e-12);
        let checks = other.checks(MatchLimits::WRITTEN);
        let broken: Vec<&CheckKind> = checks
            .iter()
            .filter(|check| !check.pass)
            .map(|check| &check.kind)
            .collect();
        assert_eq!(broken, [&CheckKind::MatchMass]);
        let mut turned = Target::of(&body);
        turned.inertia_g_mm2[3] += 0.01 * body.inertia_g_mm2.trace();
        let turned = Mismatch::of(&turned, &found);
        assert!((turned.inertia_ratio - 0.01).abs() < 1e-9);
    }
}
