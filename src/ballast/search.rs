//! The search for the parts and their places: one part after the other where it acts most, then
//! each placed anew.

use super::load::{Load, Placed};
use super::rank::Rank;
use super::sites::{Sites, Wish};
use super::{BallastError, Fit, MOST_PARTS, Order, Part, catalogue, find};
use crate::base::units::MM3_PER_CM3;
use crate::base::watch::Watch;
use crate::goal::Placement;
use crate::hollow::{Problem, Settings, Solution, has_spare, least_ballast, solve};
use crate::interior::Columns;
use crate::mesh::Solid;
use crate::shell::Shell;

/// Columns a side while places are looked for: each place takes a solve.
const SEARCHING_COLUMNS: usize = 60;
/// Columns a side on which the places found are confirmed: as many as a run's first level.
const CONFIRMING_COLUMNS: usize = 150;
/// Passes an ascent of the least ballast may take: with a price to pay it bends more sharply than
/// without.
const PASSES: usize = 150;
/// How much of the least mass that is proved on coarse columns is taken for sure.
const SURE_RATIO: f64 = 0.9;
/// How often each part is taken out and placed anew. The second sweep seldom finds anything.
const SWEEPS: usize = 2;
/// Shares of the way to the place that acts most. A part heavier than needed overshoots there; with
/// less than an eighth of the way nothing is gained that the interior could not do as well.
const STEPS: [f64; 4] = [1.0, 0.5, 0.25, 0.125];
/// What ballast is looked for in.
#[derive(Debug, Clone, Copy)]
pub struct Shop<'a> {
    /// The model.
    pub solid: &'a Solid,
    /// What it is to do.
    pub placement: &'a Placement,
    /// The wall that stays under its surface, mm.
    pub wall_mm: f64,
    /// How parts lie in their pockets.
    pub fit: Fit,
    /// The density of the print, g/cm³.
    pub density_g_cm3: f64,
}

/// A load, and what the solver says of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// The parts at their places.
    pub load: Load,
    /// The interior around them, on the columns of the search.
    pub solution: Solution,
}

/// The search in one model.
pub struct Search<'a> {
    shop: Shop<'a>,
    sites: Sites<'a>,
    coarse: Columns,
    fine: Columns,
}

impl<'a> Search<'a> {
    /// Looks at where parts may lie. Costs the columns and some ten thousand distances.
    pub fn new(shop: Shop<'a>) -> Result<Self, BallastError> {
        let Placement { goal, keeps, .. } = shop.placement;
        let shell = Shell::new(shop.solid, &goal.frame, shop.wall_mm, keeps)?;
        let columns = |side| Columns::of_shell(&shell, shell.coarse_pitch(side), &Watch::silent());
        let (coarse, fine) = (columns(SEARCHING_COLUMNS)?, columns(CONFIRMING_COLUMNS)?);
        let sites = Sites::new(shop.solid, shop.placement, shop.wall_mm, &fine);
        Ok(Self {
            shop,
            sites,
            coarse,
            fine,
        })
    }

    /// The ballast that an order asks for; none where no number of the parts that fit makes the
    /// goal possible, or where the parts asked for do not fit.
    ///
    /// A number of parts that is asked for is laid in whether the goal becomes possible or not.
    pub fn of_order(&self, order: &Order) -> Result<Option<Found>, BallastError> {
        match order {
            Order::None => Ok(None),
            Order::Auto => Ok(self.fewest_balls(&catalogue()?)),
            Order::Parts {
                id,
                count: Some(count),
            } => Ok(self.so_many(&find(id)?, *count)),
            Order::Parts { id, count: None } => {
                let part = find(id)?;
                Ok((1..=MOST_PARTS).find_map(|count| self.possible(&part, count)))
            }
        }
    }

    /// The fewest steel balls that do, and of as many the lightest.
    ///
    /// Fewer or lighter than the least steel that is proved to be needed are not tried.
    fn fewest_balls(&self, parts: &[Part]) -> Option<Found> {
        let balls: Vec<&Part> = parts.iter().filter(|part| part.shape.is_ball()).collect();
        let least_g = self.least_g(balls.first()?)?;
        (1..=MOST_PARTS).find_map(|count| {
            let heavy_enough = |ball: &&&Part| ball.mass_g * f64::from(count) >= least_g;
            let found = balls
                .iter()
                .filter(heavy_enough)
                .filter_map(|ball| self.possible(ball, count));
            best_kind(found, |found| self.rank(&found.solution))
        })
    }

    /// The least mass of the ball's metal that any ballast must have, g; none where no amount of it
    /// does.
    fn least_g(&self, ball: &Part) -> Option<f64> {
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
        let least = least_ballast(&problem, density_ratio, &settings, &Watch::silent())?;
        Some(SURE_RATIO * least.bound_mm3 * metal_g_mm3)
    }

    /// So many of a part, if that makes the goal possible with something to spare, on finer columns
    /// too.
    fn possible(&self, part: &Part, count: u32) -> Option<Found> {
        let found = self.so_many(part, count)?;
        let fine = self.solved(found.load, &self.fine);
        has_spare(&self.shop.placement.goal, &fine.solution).then_some(fine)
    }

    /// So many of a part, each where it acts most; none where they do not fit.
    fn so_many(&self, part: &Part, count: u32) -> Option<Found> {
        let mut found = self.solved(self.nothing(), &self.coarse);
        for _ in 0..count {
            let placed = self.placed(part, &found)?;
            found = self.solved(found.load.with(placed), &self.coarse);
        }
        for _ in 0..SWEEPS {
            let better = self.exchanged(part, found.clone());
            if better.load == found.load {
                break;
            }
            found = better;
        }
        Some(found)
    }

    /// Each part taken out in turn and placed where it acts most on the answer at hand, or part of
    /// the way there; kept where that gains.
    fn exchanged(&self, part: &Part, mut found: Found) -> Found {
        for index in 0..found.load.parts.len() {
            let (before, rest) = (found.load.parts[index].clone(), found.load.without(index));
            // With the prices of the answer at hand: the multipliers know what the other parts
            // already do.
            let rest = Found {
                load: rest,
                solution: found.solution.clone(),
            };
            let Some(after) = self.placed(part, &rest) else {
                continue;
            };
            let ways = STEPS
                .iter()
                .filter_map(|&share| self.sites.between(&before, &after, share, &rest.load));
            let tried = ways.map(|placed| self.solved(rest.load.with(placed), &self.coarse));
            let better =
                |other: &Found| self.rank(&other.solution).beats(self.rank(&found.solution));
            if let Some(other) = { tried }.find(better) {
                found = other;
            }
        }
        found
    }

    /// The part where it acts most on an answer.
    fn placed(&self, part: &Part, found: &Found) -> Option<Placed> {
        let solution = &found.solution;
        let prices = solution.status.separator().unwrap_or(solution.quadric);
        self.sites.best(&Wish {
            part,
            prices,
            load: &found.load,
        })
    }

    /// The interior around a load.
    fn solved(&self, load: Load, columns: &Columns) -> Found {
        let goal = &self.shop.placement.goal;
        let columns = load.carved(columns.clone(), &goal.frame);
        let fixed = goal.solid + load.excess().in_frame(&goal.frame);
        let problem = Problem {
            goal,
            fixed,
            columns: &columns,
        };
        let solution = solve(&problem, &Settings::default(), &Watch::silent());
        Found { load, solution }
    }

    fn nothing(&self) -> Load {
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

/// The first that does all that was asked; where there is none, the first.
fn best_kind(
    mut found: impl Iterator<Item = Found>,
    rank: impl Fn(&Found) -> Rank,
) -> Option<Found> {
    let first = found.next()?;
    if rank(&first).is_full() {
        return Some(first);
    }
    Some(found.find(|other| rank(other).is_full()).unwrap_or(first))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::goal::{GoalKind, Request, SpinPoint, Stock, Up, place_made_of, testing};
    use crate::mesh::MeshDistance;
    use crate::shell::fixtures;

    const WALL_MM: f64 = 3.0;
    /// With the arm's inside emptied the figure leans out of its foot by 0.05 mm.
    const FIGURE_WALL_MM: f64 = 1.5;
    const WEB_MM: f64 = 1.0;
    const DENSITY_G_CM3: f64 = 1.2;

    fn placed(solid: &Solid, wall_mm: f64, request: Request) -> Placement {
        place_made_of(
            solid,
            &Stock {
                wall_mm,
                density_g_cm3: DENSITY_G_CM3,
            },
            &request,
        )
        .unwrap()
    }

    fn searched(solid: &Solid, wall_mm: f64, request: Request, order: &str) -> Option<Found> {
        let placement = placed(solid, wall_mm, request);
        let fit = Fit {
            clearance_mm: 0.2,
            web_mm: WEB_MM,
        };
        let shop = Shop {
            solid,
            placement: &placement,
            wall_mm,
            fit,
            density_g_cm3: DENSITY_G_CM3,
        };
        let found = Search::new(shop)
            .unwrap()
            .of_order(&order.parse().unwrap())
            .unwrap()?;
        assert_sound(solid, wall_mm, &found.load);
        Some(found)
    }

    /// Every pocket leaves the wall, and the web to every other pocket.
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

    /// A block that turns about an axis 3 mm above its middle.
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

    /// A foot with an arm to one side.
    fn leaning() -> (Solid, Request) {
        let solid = fixtures::cells(&[[0, 0, 0], [0, 0, 1], [1, 0, 1], [2, 0, 1]], 12.0);
        (solid, Request::new(GoalKind::Stand))
    }

    fn bare(solid: &Solid, wall_mm: f64, request: Request) -> Solution {
        let placement = placed(solid, wall_mm, request);
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
    fn a_rotor_that_no_hollowing_balances_is_balanced_with_as_few_balls_as_reach_its_unbalance() {
        let (solid, request) = rotor();
        assert!(bare(&solid, WALL_MM, request).status.is_impossible());
        let found = searched(&solid, WALL_MM, request, "auto").unwrap();
        assert!(found.solution.is_usable());
        // In mm⁴ of the print: the block pulls down by 19200 · 3; all of the interior below the
        // axis, 34 · 10 · 15 mm³ of it 7.5 mm down, is 38250 of it. A ball of diameter d, 7.83/1.2
        // times as dense, has its middle at most 27 − d/2 − 0.2 high.
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
        assert!(bare(&solid, FIGURE_WALL_MM, request).status.is_impossible());
        let found = searched(&solid, FIGURE_WALL_MM, request, "auto").unwrap();
        assert_eq!(found.load.parts.len(), 1);
        let Point { coords } = Point::from(found.load.parts[0].lump.center_mm);
        assert!(coords.x < 8.0, "{coords}");
        assert!(found.solution.certificate.value > 0.0087);
    }

    #[test]
    fn parts_of_a_kind_are_laid_in_as_they_were_ordered_or_not_at_all() {
        let (solid, request) = rotor();
        let found = searched(&solid, WALL_MM, request, "ball-5x3").unwrap();
        assert_eq!(found.load.parts.len(), 3);
        assert!(
            found
                .load
                .parts
                .iter()
                .all(|placed| placed.part.id == "ball-5")
        );
        // The interior is 10 mm wide.
        assert!(searched(&solid, WALL_MM, request, "ball-10x1").is_none());
        assert!(searched(&solid, WALL_MM, request, "coin-us-quarterx1").is_none());
    }

    #[test]
    fn a_nut_lies_where_its_round_has_room_on_all_sides() {
        let (solid, request) = leaning();
        let found = searched(&solid, FIGURE_WALL_MM, request, "nut-m3").unwrap();
        assert!(!found.load.parts.is_empty() && found.solution.is_usable());
    }

    #[test]
    fn what_no_steel_inside_helps_gets_none() {
        // A pole on its edge: the axis lies 6 mm outside the block.
        let solid = testing::block([0.0; 3], [40.0, 16.0, 30.0]);
        let spin_point = Some(SpinPoint::At([20.0, 8.0, 36.0]));
        let request = Request {
            up: Up::X,
            spin_point,
            ..Request::new(GoalKind::Balance)
        };
        assert!(searched(&solid, WALL_MM, request, "auto").is_none());
    }
}
