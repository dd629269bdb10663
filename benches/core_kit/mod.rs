//! The stages of an object on a base: growth, panels, shell, nesting, and the judge of its kit.
//!
//! Aims, on two cores and 600 mm models on a sheet of 5 mm. Those of a whole kit are not measured
//! yet (`benches/README.md`):
//!
//! | stage | aim |
//! |---|---|
//! | the growth of one polyhedron | 10 s |
//! | a whole kit of the bunny | 90 s and 2 GiB |

use std::path::{Path, PathBuf};
use std::sync::{LazyLock, OnceLock};

use divan::{Bencher, black_box};
use equipoise::base::units::Length;
use equipoise::base::verdict::Verdict;
use equipoise::base::watch::Watch;
use equipoise::cladding::{CladShell, ScrewKit, ShellRequest, ShellStyle, Sides};
use equipoise::core_kit::prepare;
use equipoise::cutter::{Cutter, Fastener, StockSheet};
use equipoise::cutting::{SheetOrder, cut_sheets};
use equipoise::geom::Vector;
use equipoise::io::read_model;
use equipoise::job::core_kit::{CoreGoal, CoreJob, CutChoice};
use equipoise::job::{ModelChoice, PrinterChoice, Scaling};
use equipoise::kit::Existing;
use equipoise::mesh::{Solid, scaled};
use equipoise::panels::{BracketKind, JointStyle, PanelRequest, PanelSet};
use equipoise::polyhedra::{BasePlan, Ground, Limits, Polyhedron, Request, grow_polyhedron};
use equipoise::printer::Printer;
use equipoise::repair::repair;
use equipoise::verify::verify_core;
use equipoise::wing::Outcome;

use super::{made, shared};

/// The order of every figure: 600 mm, the printer, cutter and sheet of the README.
const SIZE_MM: f64 = 600.0;
const PRINTER: &str = "prusa-mk3s";
const CUTTER: &str = "makerspace-900x600";
const SHEET: &str = "birch-5";
/// The distance of the base from the surface, the wall of parts and the gap over panels, mm.
const DISTANCE_MM: f64 = 15.0;
const WALL_MM: f64 = 3.0;
const GAP_MM: f64 = 0.5;
/// The thickness of the sheet, the heads of its screws and the largest panel, mm.
const SHEET_MM: f64 = 5.0;
const HEAD_MM: f64 = 5.5;
const PANEL_MM: [f64; 2] = [890.0, 590.0];
/// Pieces that grow on a neighbour, mm³.
const CRUMB_MM3: f64 = 2000.0;

/// A model, and what the later stages start from, made when first asked for.
struct Object {
    name: &'static str,
    path: PathBuf,
    ground: OnceLock<Ground>,
    base: OnceLock<Polyhedron>,
    shell: OnceLock<CladShell>,
    kit: OnceLock<PathBuf>,
}

static OBJECTS: LazyLock<Vec<Object>> = LazyLock::new(|| {
    let of = |name, path| Object {
        name,
        path,
        ground: OnceLock::new(),
        base: OnceLock::new(),
        shell: OnceLock::new(),
        kit: OnceLock::new(),
    };
    let all = [
        of("tilted-ellipsoid", made("tilted-ellipsoid")),
        of("bunny", shared("bunny.stl")),
    ];
    all.into_iter()
        .filter(|object| object.path.is_file())
        .collect()
});

fn names() -> Vec<&'static str> {
    OBJECTS.iter().map(|object| object.name).collect()
}

fn object(name: &str) -> &'static Object {
    OBJECTS.iter().find(|object| object.name == name).unwrap()
}

fn panel_request() -> PanelRequest {
    PanelRequest {
        sheet_mm: SHEET_MM,
        joints: JointStyle::Auto,
        press_mm: 0.0,
        cut_mm: 0.2,
        brackets: BracketKind {
            hole_mm: 3.4,
            head_mm: HEAD_MM,
            thread_mm: 2.5,
            flange_mm: 4.0,
        },
    }
}

impl Object {
    fn ground(&self) -> &Ground {
        self.ground.get_or_init(|| {
            let mesh = read_model(&self.path).unwrap();
            let (mesh, _) = repair(mesh, &Watch::silent()).unwrap();
            let factor = SIZE_MM / mesh.longest_side_mm();
            Ground::new(&Solid::new(scaled(&mesh, factor)).unwrap()).unwrap()
        })
    }

    fn grown(&self) -> Polyhedron {
        let limits = Limits::for_sheet(SHEET_MM, HEAD_MM, PANEL_MM);
        let request = Request::new(DISTANCE_MM, limits);
        match grow_polyhedron(self.ground(), &request, &Watch::silent()).unwrap() {
            Verdict::Found(base) => base,
            Verdict::No(why) => unreachable!("{why}"),
        }
    }

    fn base(&self) -> &Polyhedron {
        self.base.get_or_init(|| self.grown())
    }

    fn panels(&self) -> PanelSet {
        PanelSet::of(self.base(), &panel_request()).unwrap()
    }

    fn clad(&self) -> CladShell {
        let plan = BasePlan::one(self.base().clone());
        let sides = Sides::new(self.ground(), &plan, GAP_MM).unwrap();
        let stock = Fastener::all().unwrap();
        let kit = ScrewKit::choose(&stock, 3.0, SHEET_MM + GAP_MM).unwrap();
        let printer = Printer::find(PRINTER).unwrap();
        let request = ShellRequest {
            wall_mm: WALL_MM,
            style: ShellStyle::Cups,
            crumb_mm3: CRUMB_MM3,
            room_mm: printer.usable_volume_mm(),
            kit: Some(&kit),
            pins: None,
            up: Vector::z(),
        };
        sides
            .clad(&[self.panels()], &request, &Watch::silent())
            .unwrap()
    }

    fn shell(&self) -> &CladShell {
        self.shell.get_or_init(|| self.clad())
    }

    fn job(&self) -> CoreJob {
        let model = ModelChoice {
            path: self.path.clone(),
            sha256: None,
            scaling: Scaling::Size(Length::from_mm(SIZE_MM).unwrap()),
        };
        let printer = PrinterChoice {
            id: PRINTER.to_owned(),
            material: None,
        };
        CoreJob {
            goal: CoreGoal::None,
            ..CoreJob::new(model, printer, CutChoice::new(CUTTER, SHEET))
        }
    }

    /// Returns the folder of the object's kit.
    fn kit(&self) -> &Path {
        self.kit.get_or_init(|| {
            let Outcome::Prepared(prepared) = prepare(&self.job(), &Watch::silent()).unwrap()
            else {
                unreachable!("the object has a base")
            };
            let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{}-core", self.name));
            prepared.kit.write(&folder, Existing::Replace).unwrap();
            folder
        })
    }
}

#[divan::bench(name = "core/growth", args = names(), sample_count = 3, sample_size = 1)]
fn growth(bencher: Bencher, name: &str) {
    let object = object(name);
    object.ground();
    bencher.bench(|| black_box(object).grown());
}

#[divan::bench(name = "core/panels", args = names(), sample_count = 20, sample_size = 1)]
fn panels(bencher: Bencher, name: &str) {
    let object = object(name);
    object.base();
    bencher.bench(|| black_box(object).panels());
}

#[divan::bench(name = "core/shell", args = names(), sample_count = 2, sample_size = 1)]
fn shell(bencher: Bencher, name: &str) {
    let object = object(name);
    object.base();
    bencher.bench(|| black_box(object).clad());
}

#[divan::bench(name = "core/nesting", args = names(), sample_count = 5, sample_size = 1)]
fn nesting(bencher: Bencher, name: &str) {
    let panels = &object(name).shell().panels;
    let (cutter, sheet) = (
        Cutter::find(CUTTER).unwrap(),
        StockSheet::find(SHEET).unwrap(),
    );
    let order = SheetOrder {
        cutter: &cutter,
        sheet: &sheet,
        stock: &[],
        keeps_grain: false,
    };
    bencher.bench(|| cut_sheets(black_box(panels), &order).unwrap());
}

#[divan::bench(name = "core/judge", args = names(), sample_count = 2, sample_size = 1)]
fn judge(bencher: Bencher, name: &str) {
    let kit = object(name).kit();
    bencher.bench(|| verify_core(black_box(kit), &Watch::silent()).unwrap());
}

#[divan::bench(name = "core/whole", args = names(), sample_count = 1, sample_size = 1)]
fn whole(bencher: Bencher, name: &str) {
    let job = object(name).job();
    bencher.bench(|| prepare(black_box(&job), &Watch::silent()).unwrap());
}
