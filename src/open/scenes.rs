//! Small bodies, each with a goal and a printer, for the tests of this folder.

use super::bosses::Bossed;
use super::clean::{Start, clean};
use super::request::request;
use super::resolve::Resolver;
use super::way::Way;
use crate::ballast::Load;
use crate::base::watch::Watch;
use crate::cut::{Cut, CutOrder, LeastPart, PlanRequest, SeamStyle};
use crate::geom::Point;
use crate::goal::{GoalKind, Objective, PrintStock, Request, place_in_material};
use crate::hollow::{Fill, TopCourse};
use crate::interior::Columns;
use crate::job::{Effort, IdStyle, Job, ModelChoice, ModelUnit, PrinterChoice, Scaling};
use crate::mesh::{Csg, Solid, TriMesh, primitives};
use crate::printer::{Printer, Quantity, Support, WallChoice};
use crate::repair::Repairs;
use crate::run::{Model, Placed, Policy, Rung, Shop, Solved, Voids};
use crate::shell::Shell;

/// The printer that is made coarse: its profile has every number that a run needs.
const PRINTER: &str = "objet-connex350";
/// Pixel and layer, mm. Surfaces are drawn to half of it, which makes few triangles.
const PIXEL_MM: f64 = 0.4;
/// Pitch of the solver's columns, mm.
const PITCH_MM: f64 = 1.0;

/// Returns the box between two corners, mm.
pub(super) fn cuboid(low: [f64; 3], high: [f64; 3]) -> TriMesh {
    primitives::cuboid(&Point::from(low), &Point::from(high))
}

/// Returns the union of closed bodies.
pub(super) fn union(bodies: &[TriMesh]) -> Solid {
    let bodies = bodies.iter().map(|body| Csg::of_mesh(body).unwrap());
    let all = bodies.reduce(|all, body| all.union(&body).unwrap());
    all.unwrap().to_solid().unwrap()
}

/// The goal to lean far before toppling, which every hollow body meets.
pub(super) const LEAN: Objective = Objective::TopplingAngle;
/// The goal of a low centre above the middle of the foot, which a lopsided body may miss.
pub(super) const LOW: Objective = Objective::LowestCenter;

/// Returns a cube with room for pins in its walls of 5 mm.
pub(super) fn thick_box() -> Placed {
    standing(&[cuboid([0.0; 3], [20.0; 3])], 5.0, LOW)
}

/// Returns two equal towers on a solid bar, each with a void of its own. Walls of 1 mm have no room
/// for pins across the towers.
pub(super) fn towers(objective: Objective) -> Placed {
    let bodies = [
        cuboid([0.0, 0.0, 0.0], [14.0, 14.0, 24.0]),
        cuboid([13.0, 5.0, 0.0], [27.0, 9.0, 4.0]),
        cuboid([26.0, 0.0, 0.0], [40.0, 14.0, 24.0]),
    ];
    standing(&bodies, 1.0, objective)
}

/// Returns two towers as in [`towers`], cut across both of them.
pub(super) fn cut_towers(objective: Objective) -> Placed {
    let mut placed = towers(objective);
    placed.job.plan = Some(order(vec![across(18.0)]));
    placed
}

/// Returns a slab with a tower beside its middle. Only a void in the tower puts the centre of mass
/// above the middle of the foot.
pub(super) fn lopsided() -> Placed {
    let bodies = [
        cuboid([0.0, 0.0, 0.0], [40.0, 14.0, 4.0]),
        cuboid([14.0, 0.0, 0.0], [28.0, 14.0, 24.0]),
    ];
    standing(&bodies, 1.0, LOW)
}

/// Returns a slab with a row of chimneys, hollow throughout, and a cut across all chimneys.
///
/// The only void opens through the chimneys. A pin of 3 mm with its boss closes one, so that its
/// tip must stay solid. The last open one must not be closed.
pub(super) fn chimneys(count: usize) -> Placed {
    let right_mm = |number: usize| 13.0 * number as f64;
    let slab = cuboid([0.0, 0.0, 0.0], [right_mm(count) + 1.0, 14.0, 14.0]);
    let chimney = |number: usize| {
        let left_mm = right_mm(number) + 2.0;
        cuboid([left_mm, 2.0, 13.0], [left_mm + 10.0, 12.0, 24.0])
    };
    let bodies: Vec<TriMesh> = (0..count).map(chimney).chain([slab]).collect();
    let mut placed = standing(&bodies, 1.0, LEAN);
    placed.shop.printer.min_opening_mm.value = 7.0;
    placed.shop.printer.pin_min_diameter_mm.value = 3.0;
    placed.policy.boss_patterns = 1;
    placed.policy.max_void_loss_ratio = 0.9;
    placed.job.plan = Some(order(vec![across(18.0)]));
    placed
}

/// Returns the union of bodies that is to stand.
///
/// The printer needs openings of 3 mm and nothing else to clean a void. Its pins are 1 mm thick and
/// long, however near each other, and parts bear no ids. Joints may cost more than usual, so that
/// small bodies reach every rung.
pub(super) fn standing(bodies: &[TriMesh], wall_mm: f64, objective: Objective) -> Placed {
    let goal = Request {
        objective,
        ..Request::new(GoalKind::Stand)
    };
    let solid = union(bodies);
    let printer = coarse_printer();
    let material = printer.material(None).unwrap().clone();
    let stock = PrintStock {
        wall_mm,
        density_g_cm3: material.density_g_cm3.value,
    };
    Placed {
        job: job(goal),
        placement: place_in_material(&solid, &stock, &goal).unwrap(),
        model: Model {
            solid,
            repairs: Repairs::default(),
            thickened: None,
            sha256: String::new(),
            scale_ratio: 1.0,
        },
        shop: Shop {
            printer,
            material,
            wall: WallChoice {
                asked_mm: None,
                wall_mm,
                steps: 1,
                step_mm: wall_mm,
                why: String::new(),
            },
            pitch_mm: [PITCH_MM; 2],
            rods: Vec::new(),
        },
        request: goal,
        choice: None,
        fitted: None,
        fill: Fill::AIR,
        cells: None,
        sparse: None,
        policy: Policy {
            partial_loss_ratio: 0.35,
            dear_loss_ratio: 0.65,
            pin_spread_ratio: 0.0,
            jigs_first: false,
            // The rungs are looked at one by one.
            aligned_loss_ratio: -1.0,
            boss_rounds: 3,
            boss_patterns: 3,
            ..Policy::STANDARD
        },
    }
}

fn job(goal: Request) -> Job {
    let model = ModelChoice {
        path: "scene.stl".into(),
        sha256: None,
        scaling: Scaling::Unit(ModelUnit::Mm),
    };
    let printer = PrinterChoice {
        id: PRINTER.into(),
        material: None,
    };
    // Boxes have no face: their plans open widest, as if nobody looked at them.
    Job {
        ids: IdStyle::None,
        seam: SeamStyle::Short,
        effort: Effort::Normal,
        least_part: LeastPart::NONE,
        ..Job::new(model, printer, goal)
    }
}

fn coarse_printer() -> Printer {
    let mut printer = Printer::find(PRINTER).unwrap();
    printer.pixel_x_mm.value = PIXEL_MM;
    printer.pixel_y_mm.value = PIXEL_MM;
    printer.layer_mm.value = PIXEL_MM;
    printer.pin_min_diameter_mm.value = 1.0;
    printer.pin_length_ratio.value = 1.0;
    printer.optional_numbers.remove(&Quantity::SeamStepMm);
    printer.support = Support::Soluble;
    printer
}

/// Lets the printer need a water jet that reaches so deep, mm.
pub(super) fn need_jet(placed: &mut Placed, reach_mm: f64) {
    let printer = &mut placed.shop.printer;
    printer.support = Support::WaterJet;
    let reach = printer.optional_numbers.get_mut(&Quantity::CleaningReachMm);
    reach.unwrap().value = reach_mm;
}

/// Lets no boss be looked for.
pub(super) fn forbid_bosses(placed: &mut Placed) {
    (placed.policy.boss_rounds, placed.policy.boss_patterns) = (0, 1);
}

/// Returns a horizontal cut, named by its height, mm.
pub(super) fn across(z_mm: f64) -> Cut {
    Cut {
        id: format!("Z{z_mm}").as_str().into(),
        point_mm: [0.0, 0.0, z_mm],
        normal: [0.0, 0.0, 1.0],
        within: Vec::new(),
    }
}

/// Returns an upright cut at an x, mm.
pub(super) fn along(x_mm: f64) -> Cut {
    Cut {
        id: format!("X{x_mm}").as_str().into(),
        point_mm: [x_mm, 0.0, 0.0],
        normal: [1.0, 0.0, 0.0],
        within: Vec::new(),
    }
}

/// Returns the order for some cuts; the planner places the pins.
pub(super) fn order(cuts: Vec<Cut>) -> CutOrder {
    CutOrder {
        cuts,
        ..CutOrder::default()
    }
}

/// Solves for the best void.
pub(super) fn solve(placed: &Placed) -> Solved {
    let goal = placed.goal();
    let (keeps, wall_mm) = (&placed.placement.keeps, placed.shop.wall.wall_mm);
    let shell = Shell::new(placed.solid(), &goal.frame, wall_mm, keeps).unwrap();
    let watch = Watch::silent();
    let columns = Columns::of_shell(&shell, placed.shop.pitch_mm, &watch).unwrap();
    Solved {
        load: Load::default(),
        fixed: goal.solid,
        solution: placed.solve(&columns, goal.solid, None, &watch),
        columns,
        height_proof: None,
        proof: None,
        course: TopCourse::default(),
        coarse: None,
    }
}

/// Returns a resolver, and the voids that it draws first.
pub(super) fn draw(placed: &Placed) -> (Resolver<'_>, Voids) {
    let mut resolver = Resolver::new(placed, solve(placed), &Watch::silent()).unwrap();
    let voids = resolver.draw().unwrap();
    (resolver, voids)
}

/// Returns the request for cuts of a run that nobody watches.
pub(super) fn unwatched(placed: &Placed) -> PlanRequest {
    request(placed, &Watch::silent()).unwrap()
}

/// Returns the plan with pins in the walls alone.
pub(super) fn plan_walls(placed: &Placed) -> Way<'_> {
    let (mut resolver, voids) = draw(placed);
    let request = unwatched(placed);
    let cleaned = clean(&mut resolver, Start::of(voids), &request, &|_| false).unwrap();
    let finished = resolver
        .planner()
        .finish(&cleaned.voids, &request, cleaned.plan);
    let plan = finished.unwrap();
    Way {
        rung: Rung::Walls,
        resolver,
        request,
        cleaning: cleaned.rounds,
        bossed: Bossed::without(cleaned.voids, plan),
    }
}

/// Returns the volume of all voids, mm³.
pub(super) fn volume_mm3(voids: &Voids) -> f64 {
    let bodies = voids.hollowed.voids.iter();
    bodies.map(|void| void.mesh().signed_volume_mm3()).sum()
}
