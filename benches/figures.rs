//! The figures the design holds, stage by stage: `cargo bench`, or `cargo bench -- NAME` for one of
//! them.
//!
//! Limits, on two cores and 100 mm models with a wall of 1 mm:
//!
//! | stage | limit |
//! |---|---|
//! | the solve at 100 columns a side | 30 ms |
//! | the solve at the printer's own pitch | 3 s |
//! | the whole of `prepare`, 12 000 triangles (elephant) | 10 s |
//! | the whole of `prepare`, 86 000 triangles (armadillo) | 15 s and 2 GiB |

#![allow(
    clippy::unwrap_used,
    reason = "a benchmark whose input cannot be had has failed"
)]

mod core_kit;
#[path = "../examples/make_models/models.rs"]
mod models;
mod telescope;

use std::path::{Path, PathBuf};
use std::sync::{LazyLock, OnceLock};

use divan::{Bencher, black_box};
use equipoise::base::units::Length;
use equipoise::base::watch::Watch;
use equipoise::goal::{Contact, GoalKind, Objective, Placement, Request, Up, place};
use equipoise::hollow::{Problem, Settings, Solution, refine, solve};
use equipoise::interior::Columns;
use equipoise::io::stl;
use equipoise::job::{Job, ModelChoice, PrinterChoice, Scaling};
use equipoise::mass::moments_of_mesh;
use equipoise::mesh::{Solid, scaled};
use equipoise::prepare::prepare;
use equipoise::printer::Printer;
use equipoise::repair::repair;
use equipoise::shell::Shell;
use equipoise::voids::{Cavity, CavitySpec};

/// The order of every figure: 100 mm, a wall of 1 mm, and the machine with the finest pixels of the
/// built-in ones.
const SIZE_MM: f64 = 100.0;
const WALL_MM: f64 = 1.0;
const PRINTER: &str = "objet-connex350";

/// Columns a side of the coarse solve, and of the level between it and the printer's own pitch.
const COARSE: usize = 100;
const MIDDLE: usize = 400;

/// How far the surface of the voids may stray, in pixels, as `prepare` has it.
const TOLERANCE_PIXELS: f64 = 0.5;

fn main() {
    divan::main();
}

/// A model, its goal, and what the later stages start from, made when first asked for.
struct Scene {
    name: &'static str,
    path: PathBuf,
    request: Request,
    solid: OnceLock<Solid>,
    placement: OnceLock<Placement>,
    shell: OnceLock<Shell>,
    native: OnceLock<(Columns, Solution)>,
    cavity: OnceLock<Cavity>,
}

static PRINTED_BY: LazyLock<Printer> = LazyLock::new(|| Printer::find(PRINTER).unwrap());

static SCENES: LazyLock<Vec<Scene>> = LazyLock::new(|| {
    let top = Request::new(GoalKind::Top);
    let made =
        ["tilted-ellipsoid", "asymmetric-heart"].map(|name| Scene::new(name, made(name), top));
    let center = Request {
        contact: Some(Contact::Center),
        ..top
    };
    let elephant = Scene::new("elephant", shared("elephant.obj"), center);
    let leaning = Request {
        up: Up::Along([-0.1, -0.19, 0.98]),
        ..center
    };
    let armadillo = Scene::new("armadillo", shared("armadillo.obj"), leaning);
    made.into_iter()
        .chain([elephant, armadillo])
        .filter(|scene| scene.path.is_file())
        .collect()
});

/// Every goal once, with each of its objectives, on the larger models.
static GOALS: LazyLock<Vec<Scene>> = LazyLock::new(|| {
    let of = |name, file, request: Request| Scene::new(name, shared(file), request);
    let spin_it = |gamma_c| Objective::SpinIt {
        gamma_c,
        gamma_i: 1.0,
    };
    let top = |objective| Request {
        contact: Some(Contact::Center),
        objective,
        ..Request::new(GoalKind::Top)
    };
    let yoyo = |objective| Request {
        objective,
        ..Request::new(GoalKind::Yoyo)
    };
    let upright = |kind, objective| Request {
        up: Up::Y,
        objective,
        ..Request::new(kind)
    };
    let rotor = |objective| Request {
        objective,
        ..Request::new(GoalKind::Balance)
    };
    let goals = [
        of(
            "top-critical-speed",
            "elephant.obj",
            top(Objective::CriticalSpeed),
        ),
        of("top-inertia", "elephant.obj", top(spin_it(0.0))),
        of("top-inertia-and-lever", "elephant.obj", top(spin_it(1.0))),
        of("yoyo-inertia", "cheburashka.obj", yoyo(spin_it(0.0))),
        of(
            "yoyo-dominance",
            "cheburashka.obj",
            yoyo(Objective::Dominance),
        ),
        of(
            "stand-toppling",
            "elephant.obj",
            upright(GoalKind::Stand, Objective::TopplingAngle),
        ),
        of(
            "stand-lowest",
            "elephant.obj",
            upright(GoalKind::Stand, Objective::LowestCenter),
        ),
        of("float", "elephant.obj", Request::new(GoalKind::Float)),
        of(
            "balance-least-removed",
            "rocker-arm.obj",
            rotor(Objective::LeastRemoved),
        ),
        of(
            "balance-least-unbalance",
            "rocker-arm.obj",
            rotor(Objective::LeastUnbalance),
        ),
    ];
    goals
        .into_iter()
        .filter(|scene| scene.path.is_file())
        .collect()
});

/// A model that is made by code, written where it can be read.
fn made(name: &'static str) -> PathBuf {
    let (_, make) = models::MODELS
        .into_iter()
        .find(|(known, _)| *known == name)
        .unwrap();
    let path = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join(name)
        .with_extension("stl");
    stl::write(&path, models::solid(make).unwrap().mesh(), name).unwrap();
    path
}

/// A model of the folder that `EQUIPOISE_SHARED_MODELS` names, by default the one beside the
/// repository.
fn shared(file: &str) -> PathBuf {
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/models");
    let folder = std::env::var_os("EQUIPOISE_SHARED_MODELS")
        .map_or_else(|| PathBuf::from(beside), PathBuf::from);
    folder.join(file)
}

/// The names of the models there are; the large ones only where they are found.
fn names() -> Vec<&'static str> {
    SCENES.iter().map(|scene| scene.name).collect()
}

/// The names of the goals there are models for.
fn goal_names() -> Vec<&'static str> {
    GOALS.iter().map(|scene| scene.name).collect()
}

fn scene(name: &str) -> &'static Scene {
    SCENES
        .iter()
        .chain(GOALS.iter())
        .find(|scene| scene.name == name)
        .unwrap()
}

impl Scene {
    fn new(name: &'static str, path: PathBuf, request: Request) -> Self {
        let (solid, placement, shell) = Default::default();
        let (native, cavity) = Default::default();
        Self {
            name,
            path,
            request,
            solid,
            placement,
            shell,
            native,
            cavity,
        }
    }

    fn solid(&self) -> &Solid {
        self.solid.get_or_init(|| {
            let (mesh, _) = repair(
                equipoise::io::read_model(&self.path).unwrap(),
                &Watch::silent(),
            )
            .unwrap();
            Solid::new(scaled(&mesh, SIZE_MM / mesh.longest_side_mm())).unwrap()
        })
    }

    fn wall_mm(&self) -> f64 {
        PRINTED_BY
            .quantise_wall(Some(WALL_MM), SIZE_MM)
            .unwrap()
            .wall_mm
    }

    fn native_pitch_mm(&self) -> [f64; 2] {
        PRINTED_BY.solve_pitch_mm(self.wall_mm(), SIZE_MM, None)
    }

    fn placement(&self) -> &Placement {
        self.placement.get_or_init(|| {
            place(self.solid(), self.wall_mm(), &self.request.unpromised()).unwrap()
        })
    }

    fn shell(&self) -> &Shell {
        let placement = self.placement();
        self.shell.get_or_init(|| {
            Shell::new(
                self.solid(),
                &placement.goal.frame,
                self.wall_mm(),
                &placement.keeps,
            )
            .unwrap()
        })
    }

    fn columns(&self, pitch_mm: [f64; 2]) -> Columns {
        Columns::of_shell(self.shell(), pitch_mm, &Watch::silent()).unwrap()
    }

    fn problem<'a>(&'a self, columns: &'a Columns) -> Problem<'a> {
        let goal = &self.placement().goal;
        Problem {
            goal,
            fixed: goal.solid,
            columns,
        }
    }

    fn solved(&self, columns: &Columns) -> Solution {
        solve(
            &self.problem(columns),
            &Settings::default(),
            &Watch::silent(),
        )
    }

    fn refined(&self, columns: &Columns, known: &Solution) -> Solution {
        refine(
            &self.problem(columns),
            &Settings::default(),
            known,
            &Watch::silent(),
        )
    }

    /// The solution between the coarse one and the printer's own pitch.
    fn middle(&self) -> Solution {
        let [coarse, middle] = [COARSE, MIDDLE].map(|n| self.columns(self.shell().coarse_pitch(n)));
        self.refined(&middle, &self.solved(&coarse))
    }

    /// The columns at the printer's own pitch, and the solution before they are solved on.
    fn native(&self) -> &(Columns, Solution) {
        self.native
            .get_or_init(|| (self.columns(self.native_pitch_mm()), self.middle()))
    }

    fn extracted(&self) -> Cavity {
        let [x_mm, y_mm] =
            [&PRINTED_BY.pixel_x_mm, &PRINTED_BY.pixel_y_mm].map(|pixel| pixel.value);
        let spec = CavitySpec {
            wall_mm: self.wall_mm(),
            tolerance_mm: TOLERANCE_PIXELS * x_mm.min(y_mm),
            quadric_tolerance_mm: TOLERANCE_PIXELS * x_mm.min(y_mm),
            keeps: &self.placement().keeps,
            min_void_mm: PRINTED_BY.min_opening_mm.value,
        };
        Cavity::extract(self.solid(), &spec, &Watch::silent()).unwrap()
    }

    fn cavity(&self) -> &Cavity {
        self.cavity.get_or_init(|| self.extracted())
    }

    fn job(&self) -> Job {
        let scaling = Scaling::Size(Length::from_mm(SIZE_MM).unwrap());
        let model = ModelChoice {
            path: self.path.clone(),
            sha256: None,
            scaling,
        };
        let printer = PrinterChoice {
            id: PRINTER.into(),
            material: None,
        };
        Job {
            wall: Some(Length::from_mm(WALL_MM).unwrap()),
            ..Job::new(model, printer, self.request)
        }
    }
}

#[divan::bench(args = names(), sample_count = 20, sample_size = 1)]
fn moments_of_a_mesh(bencher: Bencher, name: &str) {
    let mesh = scene(name).solid().mesh();
    bencher.bench(|| moments_of_mesh(black_box(mesh)));
}

#[divan::bench(args = names(), sample_count = 10, sample_size = 1)]
fn solve_at_100_columns_a_side(bencher: Bencher, name: &str) {
    let scene = scene(name);
    let columns = scene.columns(scene.shell().coarse_pitch(COARSE));
    bencher.bench(|| scene.solved(black_box(&columns)));
}

#[divan::bench(args = goal_names(), sample_count = 20, sample_size = 1)]
fn goal_at_100_columns_a_side(bencher: Bencher, name: &str) {
    solve_at_100_columns_a_side(bencher, name);
}

#[divan::bench(args = goal_names(), sample_count = 3, sample_size = 1)]
fn goal_at_native_pitch(bencher: Bencher, name: &str) {
    solve_at_native_pitch(bencher, name);
}

#[divan::bench(args = names(), sample_count = 3, sample_size = 1)]
fn columns_at_native_pitch(bencher: Bencher, name: &str) {
    let scene = scene(name);
    scene.shell();
    bencher.bench(|| scene.columns(black_box(scene.native_pitch_mm())));
}

#[divan::bench(args = names(), sample_count = 3, sample_size = 1)]
fn solve_at_native_pitch(bencher: Bencher, name: &str) {
    let scene = scene(name);
    let (columns, middle) = scene.native();
    bencher.bench(|| scene.refined(black_box(columns), middle));
}

#[divan::bench(args = names(), sample_count = 2, sample_size = 1)]
fn cavity_extraction(bencher: Bencher, name: &str) {
    let scene = scene(name);
    scene.placement();
    bencher.bench(|| black_box(scene).extracted());
}

#[divan::bench(args = names(), sample_count = 3, sample_size = 1)]
fn void_bodies(bencher: Bencher, name: &str) {
    let scene = scene(name);
    let (frame, solution) = (&scene.placement().goal.frame, scene.middle());
    let cavity = scene.cavity();
    bencher.bench(|| {
        cavity
            .void_bodies(black_box(&solution.quadric), frame, &Watch::silent())
            .unwrap()
    });
}

#[divan::bench(args = names(), sample_count = 1, sample_size = 1)]
fn whole_prepare(bencher: Bencher, name: &str) {
    let job = scene(name).job();
    bencher.bench(|| prepare(black_box(&job), &Watch::silent()).unwrap());
}
