//! The search for the parts and their places: one part after the other where it acts most, then
//! each placed again.

use std::ops::RangeInclusive;

use super::error::BallastError;
use super::load::{Load, PlacedPart};
use super::order::{MOST_PARTS, Order};
use super::pocket::Fit;
use super::rank::Rank;
use super::sites::{PlaceQuery, Sites};
use super::stock::{Part, catalogue, find};
use crate::base::units::MM3_PER_CM3;
use crate::base::watch::Watch;
use crate::goal::Placement;
use crate::hollow::{Problem, Settings, Solution, has_margin, least_ballast, solve};
use crate::interior::Columns;
use crate::mesh::Solid;
use crate::shell::Shell;

/// The share of the effect of ballast that is kept in reserve where a part allows it.
///
/// Cleaning and joints keep parts of the interior solid, and so take from what hollowing adds. A
/// half is a choice: the row `ballast-rocker-arm` ends in full balance with it.
const RESERVE_RATIO: f64 = 0.5;
/// The columns a side during the search: each place takes a solve.
const SEARCHING_COLUMNS: usize = 60;
/// The columns a side on which the places are confirmed: as many as at a run's first level.
const CONFIRMING_COLUMNS: usize = 150;
/// The passes of an ascent for the least ballast. With the ballast's price the dual bends more
/// sharply.
const PASSES: usize = 150;
/// The share of the mass bound from coarse columns that is trusted.
const SURE_RATIO: f64 = 0.9;
/// The number of sweeps in which each part is placed again. The second seldom finds anything.
const SWEEPS: usize = 2;
/// The balls beyond those that suffice for a bare body, where its cuts and its glue take too much.
const MORE_BALLS: u32 = 2;
/// The shares of the way to the place that acts most. A part heavier than needed overshoots there.
/// Less than an eighth of the way gains nothing that the interior could not do as well.
const STEPS: [f64; 4] = [1.0, 0.5, 0.25, 0.125];

/// The model in which ballast is searched.
#[derive(Debug, Clone, Copy)]
pub struct Workshop<'a> {
    /// The model.
    pub solid: &'a Solid,
    /// Its goal.
    pub placement: &'a Placement,
    /// The wall that stays under its surface, mm.
    pub wall_mm: f64,
    /// The clearance and the web of pockets.
    pub fit: Fit,
    /// The density of the print, g/cm³.
    pub density_g_cm3: f64,
}

/// A load, and the solver's answer to it.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// The parts at their places.
    pub load: Load,
    /// The interior around them, on the columns of the search.
    pub solution: Solution,
}

/// The search for ballast in one model. Once its watch is stopped, nothing has room.
pub struct Search<'a> {
    shop: Workshop<'a>,
    watch: Watch,
    sites: Sites<'a>,
    coarse: Columns,
    fine: Columns,
}

impl<'a> Search<'a> {
    /// Finds the sites where parts may lie. Costs the columns and some ten thousand distances.
    pub fn new(shop: Workshop<'a>, watch: &Watch) -> Result<Self, BallastError> {
        let watch = watch.muted();
        let Placement { goal, keeps, .. } = shop.placement;
        let shell = Shell::new(shop.solid, &goal.frame, shop.wall_mm, keeps)?;
        let columns = |side| Columns::of_shell(&shell, shell.coarse_pitch(side), &watch);
        let (coarse, fine) = (columns(SEARCHING_COLUMNS)?, columns(CONFIRMING_COLUMNS)?);
        let sites = Sites::new(shop.solid, shop.placement, shop.wall_mm, &fine);
        Ok(Self {
            shop,
            watch,
            sites,
            coarse,
            fine,
        })
    }

    /// Returns the ballast for an order. `None` if no number of parts that fit makes the goal
    /// possible, or if the ordered parts do not fit.
    ///
    /// An ordered number of parts is placed even if the goal stays impossible.
    ///
    /// # Errors
    /// The order or the catalogue is at fault, or the watch was stopped.
    pub fn of_order(&self, order: &Order) -> Result<Option<Found>, BallastError> {
        let found = match order {
            Order::None => None,
            Order::Auto => self.fewest_balls(&catalogue()?, 1..=MOST_PARTS),
            Order::Parts {
                id,
                count: Some(count),
            } => self.place_parts(&find(id)?, *count),
            Order::Parts { id, count: None } => {
                let part = find(id)?;
                (1..=MOST_PARTS).find_map(|count| self.place_if_possible(&part, count))
            }
        };
        self.watch.check()?;
        Ok(found)
    }

    /// Returns what an order for as few steel balls as do would find, if it takes no more than this
    /// many. `None` if it takes more, or if none do.
    ///
    /// # Errors
    /// The catalogue is at fault, or the watch was stopped.
    pub fn of_few_balls(&self, most: u32) -> Result<Option<Found>, BallastError> {
        let found = self.fewest_balls(&catalogue()?, 1..=most.min(MOST_PARTS));
        self.watch.check()?;
        Ok(found)
    }

    /// Returns what an order for as few steel balls as do would find among loads of more balls than
    /// this. `None` if one or two more make nothing possible.
    ///
    /// # Errors
    /// The catalogue is at fault, or the watch was stopped.
    pub fn of_more_balls(&self, than: u32) -> Result<Option<Found>, BallastError> {
        let most = MOST_PARTS.min(than.saturating_add(MORE_BALLS));
        let found = self.fewest_balls(&catalogue()?, than.saturating_add(1)..=most);
        self.watch.check()?;
        Ok(found)
    }

    /// Returns the fewest steel balls that make the goal possible, and of as many the lightest.
    ///
    /// Loads below the proved bound on the mass of steel are not tried.
    fn fewest_balls(&self, parts: &[Part], mut counts: RangeInclusive<u32>) -> Option<Found> {
        let balls: Vec<&Part> = parts.iter().filter(|part| part.shape.is_ball()).collect();
        let least_mass_g = self.least_mass_g(balls.first()?)?;
        counts.find_map(|count| {
            let heavy_enough = |ball: &&&Part| ball.mass_g * f64::from(count) >= least_mass_g;
            let found = balls
                .iter()
                .filter(heavy_enough)
                .filter_map(|ball| self.place_if_possible(ball, count));
            first_of_most_merit(found, |found| self.merit(found))
        })
    }

    /// Returns a lower bound on the mass of ballast of the ball's metal, g. `None` if no amount of
    /// it suffices.
    fn least_mass_g(&self, ball: &Part) -> Option<f64> {
        let metal_g_mm3 = ball.mass_g / ball.shape.volume_mm3();
        let density_ratio = metal_g_mm3 * MM3_PER_CM3 / self.shop.density_g_cm3;
        let settings = Settings {
            passes_per_ascent: PASSES,
            ..Settings::default()
        };
        let goal = &self.shop.placement.goal;
        let problem = Problem {
            goal,
            fixed: goal.solid,
            columns: &self.coarse,
        };
        let least = least_ballast(&problem, density_ratio, &settings, &self.watch)?;
        Some(SURE_RATIO * least.bound_mm3 * metal_g_mm3)
    }

    /// Places `count` of a part, if that makes the goal possible with a margin on the finer columns
    /// too.
    fn place_if_possible(&self, part: &Part, count: u32) -> Option<Found> {
        let found = self.place_parts(part, count)?;
        let fine = self.solve_around(found.load, &self.fine);
        has_margin(&self.shop.placement.goal, &fine.solution).then_some(fine)
    }

    /// Places `count` of a part, each where it acts most. Returns `None` if they do not fit.
    fn place_parts(&self, part: &Part, count: u32) -> Option<Found> {
        let mut found = self.solve_around(self.empty_load(), &self.coarse);
        for _ in 0..count {
            let placed = self.place_part(part, &found)?;
            found = self.solve_around(found.load.with(placed), &self.coarse);
        }
        for _ in 0..SWEEPS {
            let better = self.improve_places(part, found.clone());
            if better.load == found.load {
                break;
            }
            found = better;
        }
        Some(found)
    }

    /// Takes out each part in turn and places it where it acts most on the current answer, or part
    /// of the way there. Keeps a move that gains.
    fn improve_places(&self, part: &Part, mut found: Found) -> Found {
        for index in 0..found.load.parts.len() {
            let (before, rest) = (found.load.parts[index].clone(), found.load.without(index));
            // The current answer's prices: its multipliers reflect the effect of the other parts.
            let rest = Found {
                load: rest,
                solution: found.solution.clone(),
            };
            let Some(after) = self.place_part(part, &rest) else {
                continue;
            };
            let moves = STEPS
                .iter()
                .filter_map(|&share| self.sites.move_toward(&before, &after, share, &rest.load));
            let answers =
                moves.map(|placed| self.solve_around(rest.load.with(placed), &self.coarse));
            let better =
                |other: &Found| self.rank(&other.solution).beats(self.rank(&found.solution));
            if let Some(other) = { answers }.find(better) {
                found = other;
            }
        }
        found
    }

    /// Places the part where it acts most on an answer.
    fn place_part(&self, part: &Part, found: &Found) -> Option<PlacedPart> {
        self.watch.check().ok()?;
        let solution = &found.solution;
        let prices = solution.status.separator().unwrap_or(solution.quadric);
        self.sites.best(&PlaceQuery {
            part,
            prices,
            load: &found.load,
            watch: &self.watch,
        })
    }

    /// Returns what speaks for a load that makes the goal possible.
    fn merit(&self, found: &Found) -> Merit {
        if !self.rank(&found.solution).is_full() {
            return Merit::Partial;
        }
        let left = self.solve_with(&found.load, 1.0 - RESERVE_RATIO, &self.fine);
        if self.rank(&left).is_full() {
            Merit::InReserve
        } else {
            Merit::Full
        }
    }

    /// Solves for the interior around a load.
    fn solve_around(&self, load: Load, columns: &Columns) -> Found {
        let solution = self.solve_with(&load, 1.0, columns);
        Found { load, solution }
    }

    /// Solves for the interior around a load of which only a share acts.
    fn solve_with(&self, load: &Load, share: f64, columns: &Columns) -> Solution {
        let goal = &self.shop.placement.goal;
        let columns = load.carve(columns.clone(), &goal.frame);
        let fixed = goal.solid + load.excess().in_frame(&goal.frame) * share;
        let problem = Problem {
            goal,
            fixed,
            columns: &columns,
        };
        solve(&problem, &Settings::default(), &self.watch)
    }

    fn empty_load(&self) -> Load {
        let density_g_mm3 = self.shop.density_g_cm3 / MM3_PER_CM3;
        Load {
            parts: Vec::new(),
            fit: self.shop.fit,
            density_g_mm3,
        }
    }

    fn rank(&self, solution: &Solution) -> Rank {
        Rank::of(solution, &self.shop.placement.goal)
    }
}

/// Ranks a load that makes the goal possible; more is better.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Merit {
    /// It meets the goal by another objective only.
    Partial,
    /// It meets the goal as asked.
    Full,
    /// It meets the goal as asked, and would with less of its effect, too.
    InReserve,
}

/// Returns the first of those with the most merit. None is looked at after one with a reserve.
fn first_of_most_merit<T>(
    found: impl Iterator<Item = T>,
    merit: impl Fn(&T) -> Merit,
) -> Option<T> {
    let mut best: Option<(Merit, T)> = None;
    for other in found {
        let merit = merit(&other);
        if best.as_ref().is_none_or(|(most, _)| merit > *most) {
            best = Some((merit, other));
        }
        if merit == Merit::InReserve {
            break;
        }
    }
    best.map(|(_, found)| found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::goal::{GoalKind, PrintStock, Request, SpinPoint, Up, place_in_material, testing};
    use crate::mesh::MeshDistance;
    use crate::shell::fixtures;

    const WALL_MM: f64 = 3.0;
    /// With the arm's inside emptied the figure leans out of its foot by 0.05 mm.
    const FIGURE_WALL_MM: f64 = 1.5;
    const WEB_MM: f64 = 1.0;
    const DENSITY_G_CM3: f64 = 1.2;

    fn place(solid: &Solid, wall_mm: f64, request: Request) -> Placement {
        place_in_material(
            solid,
            &PrintStock {
                wall_mm,
                density_g_cm3: DENSITY_G_CM3,
            },
            &request,
        )
        .unwrap()
    }

    fn search(solid: &Solid, wall_mm: f64, request: Request, order: &str) -> Option<Found> {
        let placement = place(solid, wall_mm, request);
        let fit = Fit {
            clearance_mm: 0.2,
            web_mm: WEB_MM,
        };
        let shop = Workshop {
            solid,
            placement: &placement,
            wall_mm,
            fit,
            density_g_cm3: DENSITY_G_CM3,
        };
        let found = Search::new(shop, &Watch::silent())
            .unwrap()
            .of_order(&order.parse().unwrap())
            .unwrap()?;
        assert_sound(solid, wall_mm, &found.load);
        Some(found)
    }

    /// Asserts that every pocket leaves the wall, and the web to every other pocket.
    fn assert_sound(solid: &Solid, wall_mm: f64, load: &Load) {
        let outside = MeshDistance::new(solid.mesh());
        let meshes: Vec<_> = load.pockets().map(|pocket| pocket.mesh()).collect();
        for (index, mesh) in meshes.iter().enumerate() {
            assert!(
                outside.min_distance_to(mesh) >= wall_mm
                    && outside.signed(&mesh.vertices()[0]) > 0.0
            );
            let distance = MeshDistance::new(mesh);
            for other in &meshes[..index] {
                assert!(distance.min_distance_to(other) >= WEB_MM, "{index}");
            }
        }
    }

    /// Returns a block that turns about an axis 3 mm above its middle.
    fn rotor() -> (Solid, Request) {
        let solid = testing::block([0.0; 3], [40.0, 16.0, 30.0]);
        let spin_point = Some(SpinPoint::At([20.0, 8.0, 18.0]));
        (
            solid,
            Request {
                up: Up::X,
                spin_point,
                ..Request::new(GoalKind::Balance)
            },
        )
    }

    /// Returns a foot with an arm to one side.
    fn leaning() -> (Solid, Request) {
        let solid = fixtures::cells(&[[0, 0, 0], [0, 0, 1], [1, 0, 1], [2, 0, 1]], 12.0);
        (solid, Request::new(GoalKind::Stand))
    }

    fn solve_without(solid: &Solid, wall_mm: f64, request: Request) -> Solution {
        let placement = place(solid, wall_mm, request);
        let shell = Shell::new(solid, &placement.goal.frame, wall_mm, &placement.keeps).unwrap();
        let columns = Columns::of_shell(&shell, shell.coarse_pitch(100), &Watch::silent()).unwrap();
        let problem = Problem {
            goal: &placement.goal,
            fixed: placement.goal.solid,
            columns: &columns,
        };
        solve(&problem, &Settings::default(), &Watch::silent())
    }

    #[test]
    fn a_rotor_that_hollowing_cannot_balance_gets_as_few_balls_as_reach_its_unbalance() {
        let (solid, request) = rotor();
        assert!(
            solve_without(&solid, WALL_MM, request)
                .status
                .is_impossible()
        );
        let found = search(&solid, WALL_MM, request, "auto").unwrap();
        assert!(found.solution.is_usable());
        // First moments in mm⁴ of the print: the block's is 19200 · 3. The interior below the axis,
        // 34 · 10 · 15 mm³ with its middle 7.5 mm down, accounts for 38250. A ball of diameter d is
        // 7.83/1.2 times as dense, and its middle is at most 27 − d/2 − 0.2 high.
        let missing = 19_200.0 * 3.0 - 34.0 * 10.0 * 15.0 * 7.5;
        let pull = |d: f64| std::f64::consts::PI / 6.0 * d.powi(3) * (7.83 / 1.2) * (8.8 - d / 2.0);
        let most = (1..=19)
            .map(|half| pull(0.5 * f64::from(half)))
            .fold(0.0, f64::max);
        let least = (missing / most).ceil() as usize;
        assert!(
            least >= 2 && found.load.parts.len() >= least,
            "{least} {}",
            found.load.parts.len()
        );
        assert!(
            found.load.parts.len() <= least + 1,
            "{}",
            found.load.parts.len()
        );
        assert!(
            found
                .load
                .parts
                .iter()
                .all(|placed| placed.lump.center_mm[2] > 18.0)
        );
    }

    #[test]
    fn a_figure_that_falls_over_stands_with_one_ball_in_its_foot() {
        let (solid, request) = leaning();
        assert!(
            solve_without(&solid, FIGURE_WALL_MM, request)
                .status
                .is_impossible()
        );
        let found = search(&solid, FIGURE_WALL_MM, request, "auto").unwrap();
        assert_eq!(found.load.parts.len(), 1);
        let Point { coords } = Point::from(found.load.parts[0].lump.center_mm);
        assert!(coords.x < 8.0, "{coords}");
        assert!(found.solution.certificate.value > 0.0087);
    }

    #[test]
    fn parts_of_a_kind_are_laid_in_as_they_were_ordered_or_not_at_all() {
        let (solid, request) = rotor();
        let found = search(&solid, WALL_MM, request, "ball-5x3").unwrap();
        assert_eq!(found.load.parts.len(), 3);
        assert!(
            found
                .load
                .parts
                .iter()
                .all(|placed| placed.part.id == "ball-5")
        );
        // The interior is 10 mm wide.
        assert!(search(&solid, WALL_MM, request, "ball-10x1").is_none());
        assert!(search(&solid, WALL_MM, request, "coin-us-quarterx1").is_none());
    }

    #[test]
    fn a_nut_lies_where_its_round_has_room_on_all_sides() {
        let (solid, request) = leaning();
        let found = search(&solid, FIGURE_WALL_MM, request, "nut-m3").unwrap();
        assert!(!found.load.parts.is_empty() && found.solution.is_usable());
    }

    #[test]
    fn of_as_many_balls_the_lightest_with_a_reserve_is_taken_else_the_lightest_that_does() {
        use Merit::{Full, InReserve, Partial};
        let taken = |merits: &[Merit]| {
            let balls = merits.iter().copied().enumerate();
            first_of_most_merit(balls, |ball| ball.1).map(|ball| ball.0)
        };
        assert_eq!(taken(&[Partial, Full, InReserve, InReserve]), Some(2));
        assert_eq!(taken(&[Partial, Full, Full]), Some(1));
        assert_eq!(taken(&[Partial, Partial]), Some(0));
        assert_eq!(taken(&[]), None);
    }

    #[test]
    fn a_ball_with_a_reserve_is_taken_rather_than_a_lighter_one_without() {
        // The axis is 2 mm above the block's middle: a ball of 7 or 8 mm balances it just so.
        let (solid, mut request) = rotor();
        request.spin_point = Some(SpinPoint::At([20.0, 8.0, 17.0]));
        let single = search(&solid, WALL_MM, request, "ball-7x1").unwrap();
        assert!(single.solution.is_usable());
        let found = search(&solid, WALL_MM, request, "auto").unwrap();
        let ids: Vec<&str> = found
            .load
            .parts
            .iter()
            .map(|placed| &*placed.part.id)
            .collect();
        assert_eq!(ids, ["ball-9"]);
    }

    #[test]
    fn more_balls_are_the_fewest_beyond_a_number_and_still_make_the_goal_possible() {
        let (solid, mut request) = rotor();
        // One ball balances this block.
        request.spin_point = Some(SpinPoint::At([20.0, 8.0, 17.0]));
        let placement = place(&solid, WALL_MM, request);
        let shop = Workshop {
            solid: &solid,
            placement: &placement,
            wall_mm: WALL_MM,
            fit: Fit {
                clearance_mm: 0.2,
                web_mm: WEB_MM,
            },
            density_g_cm3: DENSITY_G_CM3,
        };
        let search = Search::new(shop, &Watch::silent()).unwrap();
        let found = search.of_more_balls(1).unwrap().unwrap();
        assert!(found.load.parts.len() == 2 && found.solution.is_usable());
        assert_sound(&solid, WALL_MM, &found.load);
        assert_eq!(search.of_more_balls(MOST_PARTS).unwrap(), None);
    }

    #[test]
    fn no_ballast_is_placed_if_no_steel_inside_helps() {
        // A pole on its edge: the axis lies 6 mm outside the block.
        let solid = testing::block([0.0; 3], [40.0, 16.0, 30.0]);
        let spin_point = Some(SpinPoint::At([20.0, 8.0, 36.0]));
        let request = Request {
            up: Up::X,
            spin_point,
            ..Request::new(GoalKind::Balance)
        };
        assert!(search(&solid, WALL_MM, request, "auto").is_none());
    }
}
