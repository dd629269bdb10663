//! The outcome of a run, as a value and as a sentence.

use super::field_miss::FieldMiss;
use super::miss::MatchMiss;
use crate::base::numbers::measured;
use crate::geom::Quadric;
use crate::goal::{Goal, GoalKind};

/// The outcome of a run: an optimal void, or the proof that none exists.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Status {
    /// Gap and residual are within the accepted limits: no interior is better.
    Solved,
    /// The constraints are met to a thousandth, but the gap is wider than accepted.
    AlmostSolved,
    /// No interior meets the constraints.
    ConstraintsInfeasible {
        /// Unmet constraint.
        obstacle: Obstacle,
        /// Least residual of any interior, in units of the solid's volume and radius of gyration;
        /// proved, positive.
        least_miss: f64,
        /// Proof: Σλᵢ(constraint i), whose integral over every interior is at least `least_miss`.
        separator: Quadric,
    },
    /// Yo-yo: in every interior some axis across has at least the moment of inertia about the spin
    /// axis.
    NotDominant {
        /// Lower bound of I_b/I_c over every interior, at least 1; proved.
        least_ratio: f64,
    },
    /// Top: no interior spins upright at any speed.
    UnstableForEveryInterior {
        /// Lower bound of I_b/I_c over every interior.
        least_ratio: f64,
        /// True if the bound is proved for every height of the centre; false if it holds for the
        /// heights tried.
        proved: bool,
    },
    /// Stand: every interior topples by itself.
    CannotStand {
        /// Greatest toppling angle of any interior, rad; not positive; proved.
        greatest_angle_rad: f64,
    },
    /// Float: even the lightest interior is too heavy for this waterline.
    Sinks {
        /// Its mass over that of the displaced water, above 1; proved.
        least_ratio: f64,
    },
    /// Float: even the solid is too light for this waterline.
    RidesHigh {
        /// Its mass over that of the displaced water, below 1; proved.
        greatest_ratio: f64,
    },
    /// Float: no interior of the right mass has its centre above the centre of buoyancy.
    CannotTrim {
        /// Least horizontal offset of the centre, mm; proved, positive.
        least_offset_mm: f64,
        /// Proof: its integral over every interior exceeds `level_mm3`. For an interior of the
        /// right mass and centre it would be `level_mm3` at most.
        separator: Quadric,
        /// Level of the proof, mm³.
        level_mm3: f64,
    },
    /// Float: every interior of the right mass and centre capsizes.
    Capsizes {
        /// Greatest metacentric height, mm; not positive; proved.
        greatest_gm_mm: f64,
    },
    /// Balance: the unbalance of every interior exceeds the grade.
    CannotBalance {
        /// Best grade of any interior at the rotor's speed, mm/s; above the requested one; proved.
        least_grade_mm_s: f64,
        /// Proof: (weights)·(unbalances in the end planes) − (permitted unbalance)·(mass). Its
        /// integral over every interior is positive.
        separator: Quadric,
    },
    /// Match: no density within the bounds has the wanted moments.
    CannotMatch {
        /// The nearest, and the bound of the distance.
        miss: MatchMiss,
        /// Proof: its integral over every such body exceeds that over the wanted one.
        separator: Quadric,
    },
    /// A given field does not meet the goal, or none of a family that was fitted to it.
    FieldMisses {
        /// How near it comes.
        miss: FieldMiss,
    },
    /// The passes were used up before the limits were met.
    IterationLimit {
        /// Remaining gap, as a part of the value.
        gap_ratio: f64,
        /// Remaining residual, in the solver's normalised units.
        residual: f64,
    },
    /// The caller stopped the run.
    Cancelled,
}

/// The constraint that no interior meets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Obstacle {
    /// The centre of mass cannot reach its required place.
    Center,
    /// The axis cannot be made a principal axis.
    PrincipalAxis,
    /// Each could be met alone, but not both together.
    Both,
    /// Stand: it cannot bear the tilt that is promised.
    Tilt,
}

impl Status {
    /// Returns a sentence that explains the outcome, with its numbers.
    pub fn explain(&self, goal: &Goal) -> String {
        let why = match *self {
            Self::Solved => return "Solved: no other interior is better.".into(),
            Self::AlmostSolved => return "Solved, but the last digits are not proved.".into(),
            Self::Cancelled => return "Stopped before the end.".into(),
            Self::IterationLimit {
                gap_ratio: gap,
                residual,
            } => return explain_limit(gap, residual),
            Self::ConstraintsInfeasible {
                obstacle,
                least_miss,
                ..
            } => return explain_imbalance(obstacle, least_miss, goal.kind),
            Self::CannotMatch { miss, .. } => return miss.explain(goal),
            Self::FieldMisses { miss } => return miss.explain(goal),
            Self::NotDominant { least_ratio } => {
                return explain_spin(WOBBLES, &compare_moments(least_ratio));
            }
            Self::UnstableForEveryInterior {
                least_ratio,
                proved,
            } => return explain_instability(least_ratio, proved),
            Self::CannotStand { greatest_angle_rad } => format!(
                "it falls over whatever its interior (at least {:.1}° short)",
                -greatest_angle_rad.to_degrees()
            ),
            Self::Sinks { least_ratio } => format!(
                "even fully hollowed it weighs {least_ratio:.3} times the water it displaces at \
                 this waterline"
            ),
            Self::RidesHigh { greatest_ratio } => format!(
                "even solid it weighs only {greatest_ratio:.3} times the water it displaces at \
                 this waterline"
            ),
            Self::CannotTrim {
                least_offset_mm: offset,
                ..
            } => format!(
                "at this waterline, whatever its interior, the centre of mass stays at least \
                 {offset:.3} mm beside the centre of buoyancy, so it would not float upright"
            ),
            Self::Capsizes { greatest_gm_mm: gm } => format!(
                "at this waterline, whatever its interior, the centre of mass stays at least {:.3} mm \
                 above the metacentre, so it would turn over",
                -gm
            ),
            Self::CannotBalance {
                least_grade_mm_s: grade,
                ..
            } => format!(
                "whatever its interior, at its speed the rotor's balance grade stays at G {grade:.1} \
                 or above"
            ),
        };
        format!("Impossible: {why}.")
    }

    /// Returns changes that may make the goal possible; empty if it is possible.
    pub fn remedies(&self, goal: &Goal) -> &'static [&'static str] {
        if self.is_tilt() {
            return &TILT_REMEDIES;
        }
        match (self, goal.kind) {
            (Self::ConstraintsInfeasible { .. }, GoalKind::Top) => &[
                "make the model larger with the same wall, or the wall thinner",
                "move the contact point below the centre of mass (contact center)",
                "turn the model so that the axis is nearer to one of its principal axes (up principal)",
            ],
            (Self::ConstraintsInfeasible { .. }, GoalKind::Yoyo) => &[
                "make the model larger with the same wall, or the wall thinner",
                "move the spin point to the centre of mass",
                "turn the model so that the axis is nearer to one of its principal axes (up principal)",
            ],
            (Self::ConstraintsInfeasible { .. }, GoalKind::Stand) => &[
                "make the model larger with the same wall, or the wall thinner",
                "ask for the largest toppling angle instead of a centre over the middle",
            ],
            (Self::NotDominant { .. } | Self::UnstableForEveryInterior { .. }, _) => &[
                "spin it about the axis of its largest moment (up principal)",
                "make the model larger with the same wall, or the wall thinner",
            ],
            (Self::CannotStand { .. }, _) => &[
                "turn the model, or stand it on another part",
                "give it a larger foot, or put ballast in it",
                "make the model larger with the same wall, or the wall thinner",
            ],
            (Self::Sinks { .. }, _) => &[
                "let it lie deeper",
                "leave the waterline free (waterline auto)",
                "make the model larger with the same wall, or the wall thinner",
                "use a lighter material or a denser liquid",
            ],
            (Self::RidesHigh { .. }, _) => &[
                "let it float higher",
                "leave the waterline free (waterline auto)",
                "use a denser material, or put ballast in it",
            ],
            (Self::CannotTrim { .. }, _) => &[
                "turn the model",
                "leave the waterline free (waterline auto)",
                "make the model larger with the same wall, or the wall thinner",
                "put ballast in it, on the side that floats high",
            ],
            (Self::Capsizes { .. }, _) => &[
                "leave the waterline free (waterline auto)",
                "turn the model",
                "put ballast in it, as low as possible",
                "make the model larger with the same wall, or the wall thinner",
            ],
            (Self::CannotMatch { miss, .. }, _) => miss.remedies(goal),
            (Self::CannotBalance { .. }, _) => &[
                "put ballast on its light side, opposite to the unbalance",
                "make the model larger with the same wall, or the wall thinner",
                "ask for a coarser grade or a lower speed",
            ],
            _ => &[],
        }
    }

    /// Returns whether it cannot bear the tilt that is promised.
    fn is_tilt(&self) -> bool {
        let tilt = Obstacle::Tilt;
        matches!(self, Self::ConstraintsInfeasible { obstacle, .. } if *obstacle == tilt)
    }

    /// Returns the quadric whose integral over every interior proves that the goal cannot be met.
    /// `None` if the bound of the solution's own quadric is the proof.
    pub fn separator(&self) -> Option<Quadric> {
        match *self {
            Self::ConstraintsInfeasible { separator, .. }
            | Self::CannotTrim { separator, .. }
            | Self::CannotMatch { separator, .. }
            | Self::CannotBalance { separator, .. } => Some(separator),
            _ => None,
        }
    }

    /// Returns true if this proves that the goal cannot be met.
    pub fn is_impossible(&self) -> bool {
        matches!(
            self,
            Self::ConstraintsInfeasible { .. }
                | Self::NotDominant { .. }
                | Self::UnstableForEveryInterior { .. }
                | Self::CannotStand { .. }
                | Self::Sinks { .. }
                | Self::RidesHigh { .. }
                | Self::CannotTrim { .. }
                | Self::Capsizes { .. }
                | Self::CannotBalance { .. }
                | Self::CannotMatch { .. }
        )
    }
}

fn explain_limit(gap_ratio: f64, residual: f64) -> String {
    format!(
        "Not solved within the allowed passes: the gap is {gap_ratio:.1e} and the constraints are \
         missed by {residual:.1e}. Allow more passes."
    )
}

/// Changes that may let an object bear the tilt that is promised.
const TILT_REMEDIES: [&str; 2] = [
    "promise less tilt",
    "make the model larger with the same wall, or the wall thinner",
];

/// The reason why a body does not turn steadily about an axis.
const WOBBLES: &str = "it would wobble about this axis, whatever its interior";

/// Words why a body cannot spin, and in brackets the numbers of the proof.
fn explain_spin(why: &str, proof: &str) -> String {
    format!("Impossible: {why}. ({proof}.)")
}

fn explain_imbalance(obstacle: Obstacle, least_miss: f64, kind: GoalKind) -> String {
    let task = obstacle.task(kind);
    let miss = format!("it misses by {}", measured(100.0 * least_miss, "%"));
    match kind {
        GoalKind::Stand | GoalKind::Float => {
            format!("Impossible: with this wall it cannot {task}, whatever its interior ({miss}).")
        }
        _ => explain_spin(
            WOBBLES,
            &format!("With this wall it cannot {task}, whatever its interior; {miss}"),
        ),
    }
}

fn explain_instability(least_ratio: f64, proved: bool) -> String {
    let scope = if proved {
        "this is proved for every height of the centre"
    } else {
        "so it is at every height that was tried"
    };
    let proof = format!("{}; {scope}", compare_moments(least_ratio));
    explain_spin("it is too tall to spin upright about this axis", &proof)
}

fn compare_moments(least_ratio: f64) -> String {
    format!(
        "The moment of inertia across the axis is at least {least_ratio:.3} \
         times the one about it"
    )
}

impl Obstacle {
    fn task(self, kind: GoalKind) -> &'static str {
        match (self, kind) {
            (Self::Tilt, _) => "bear the tilt that is promised",
            (Self::Center, GoalKind::Top | GoalKind::Balance) => {
                "bring the centre of mass onto the spin axis"
            }
            (Self::Center, GoalKind::Yoyo | GoalKind::Match) => {
                "bring the centre of mass to the spin point"
            }
            (Self::Center, GoalKind::Float) => {
                "bring the centre of mass over the centre of buoyancy"
            }
            (Self::Center, GoalKind::Stand) => {
                "bring the centre of mass over the middle of the support"
            }
            (Self::PrincipalAxis, _) => "turn a principal axis of inertia onto the spin axis",
            (Self::Both, _) => {
                "balance the centre of mass and the principal axis on the spin axis together"
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Settings, Solution, solve, worlds};
    use super::*;
    use crate::base::watch::Watch;
    use crate::goal::{FloatConditions, Objective, compute_figures};
    use crate::interior::moments_where_positive;

    /// Every impossibility, with the number that its sentence has to contain.
    fn impossibilities() -> [(Status, &'static str); 9] {
        [
            (
                Status::NotDominant {
                    least_ratio: 1.0637,
                },
                "1.064",
            ),
            (
                Status::UnstableForEveryInterior {
                    least_ratio: 1.389,
                    proved: true,
                },
                "1.389",
            ),
            (
                Status::CannotStand {
                    greatest_angle_rad: -0.0239,
                },
                "1.4°",
            ),
            (
                Status::Sinks {
                    least_ratio: 1.0637,
                },
                "1.064",
            ),
            (
                Status::RidesHigh {
                    greatest_ratio: 0.6372,
                },
                "0.637",
            ),
            (
                Status::CannotTrim {
                    least_offset_mm: 0.6372,
                    separator: Quadric([0.0; 10]),
                    level_mm3: 1.0,
                },
                "0.637 mm",
            ),
            (
                Status::Capsizes {
                    greatest_gm_mm: -1.5,
                },
                "1.500 mm",
            ),
            (
                Status::CannotBalance {
                    least_grade_mm_s: 17.08,
                    separator: Quadric([0.0; 10]),
                },
                "G 17.1",
            ),
            (
                Status::ConstraintsInfeasible {
                    obstacle: Obstacle::Center,
                    least_miss: 0.0169,
                    separator: Quadric([0.0; 10]),
                },
                "1.7\u{a0}%",
            ),
        ]
    }

    #[test]
    fn every_impossibility_is_explained_with_its_number_and_a_remedy() {
        let goal = worlds::egg(Objective::Dominance).goal;
        for (status, number) in impossibilities() {
            assert!(status.is_impossible());
            assert!(
                status.explain(&goal).contains(number),
                "{}",
                status.explain(&goal)
            );
            assert!(!status.remedies(&goal).is_empty());
            assert!(status.explain(&goal).starts_with("Impossible: "));
        }
        assert!(!Status::Solved.is_impossible() && Status::Solved.remedies(&goal).is_empty());
    }

    #[test]
    fn what_cannot_spin_is_said_plainly_and_its_numbers_stand_in_brackets() {
        let goal = worlds::egg(Objective::Dominance).goal;
        let said = Status::NotDominant { least_ratio: 1.2 }.explain(&goal);
        assert!(
            said.starts_with(
                "Impossible: it would wobble about this axis, whatever its interior. (The"
            ),
            "{said}"
        );
        let tall = Status::UnstableForEveryInterior {
            least_ratio: 1.2,
            proved: false,
        };
        assert!(
            tall.explain(&goal)
                .starts_with("Impossible: it is too tall to spin upright about this axis. (")
        );
    }

    #[test]
    fn every_impossibility_of_a_small_world_holds_for_many_interiors_of_it() {
        let worlds = [
            worlds::long_egg(),
            worlds::tower(),
            far_from_support(),
            worlds::tank(120.0, [0.0; 2]),
        ];
        let statuses = worlds.map(|mut world| {
            world.goal.afloat = world.goal.afloat.map(|afloat| FloatConditions {
                metacenter_mm: 4.0,
                ..afloat
            });
            let status = solve(&world.problem(), &Settings::default(), &Watch::silent()).status;
            // Even in x and y, so that every interior meets the rows that the world itself meets.
            for seed in 0..400 {
                let Quadric([c, _, _, z, _, _, _, xx, _, zz]) = worlds::some_quadric(seed, 8.0);
                let z = if world.goal.kind == GoalKind::Yoyo {
                    0.0
                } else {
                    z
                };
                let even = Quadric([c, 0., 0., z, 0., 0., 0., xx, xx, zz]);
                let moments = world.fixed - moments_where_positive(&world.columns, &even);
                let figures = compute_figures(&world.goal, &moments);
                let (reached, limit) = match status {
                    Status::NotDominant { least_ratio }
                    | Status::UnstableForEveryInterior { least_ratio, .. } => {
                        (figures.dominance_ratio, least_ratio)
                    }
                    Status::CannotStand { greatest_angle_rad } => {
                        (-figures.toppling_angle_rad.unwrap(), -greatest_angle_rad)
                    }
                    // The bound covers only interiors of the mass that the water carries.
                    Status::Capsizes { greatest_gm_mm }
                        if (moments.volume() - 120.0).abs() < 0.5 =>
                    {
                        (figures.center_height_mm, 4.0 - greatest_gm_mm)
                    }
                    Status::Capsizes { .. } => continue,
                    _ => panic!("{status:?}"),
                };
                // Half a unit of mass at the tank's far end, 5 from its centre, moves the centre by
                // 0.5·5/120.
                let slack = if matches!(status, Status::Capsizes { .. }) {
                    0.021
                } else {
                    1e-9
                };
                assert!(reached >= limit - slack, "{status:?}: {reached}");
            }
            std::mem::discriminant(&status)
        });
        assert!(
            (0..4).all(|i| !statuses[..i].contains(&statuses[i])),
            "four different impossibilities"
        );
    }

    fn far_from_support() -> worlds::World {
        let mut world = worlds::blocks_on_a_slope();
        world
            .goal
            .support
            .iter_mut()
            .for_each(|corner| corner[0] -= 20.0);
        world
    }

    #[test]
    fn too_few_passes_end_as_almost_solved_or_unsolved_and_never_as_solved() {
        let world = worlds::egg(Objective::Dominance);
        let with = |passes| {
            let settings = Settings {
                passes_per_ascent: passes,
                ..Settings::default()
            };
            solve(&world.problem(), &settings, &Watch::silent())
        };
        let ends: Vec<Solution> = (1..12).map(with).collect();
        let count = |is: fn(&Status) -> bool| ends.iter().filter(|end| is(&end.status)).count();
        assert!(count(|status| matches!(status, Status::IterationLimit { .. })) > 0);
        assert!(count(|status| *status == Status::AlmostSolved) > 0);
        assert!(count(|status| *status == Status::Solved) > 0);
        for Solution {
            status,
            certificate,
            ..
        } in &ends
        {
            let met = certificate.residual <= 1e-7 && certificate.gap_ratio.abs() <= 1e-6;
            assert_eq!(*status == Status::Solved, met, "{status:?} {certificate:?}");
            if let Status::IterationLimit {
                gap_ratio,
                residual,
            } = *status
            {
                assert!(residual > 1e-3 || gap_ratio.abs() > 1e-2);
                assert!(status.explain(&world.goal).contains("Allow more passes"));
            }
        }
    }
}
