//! The stages of telescopes: fit, skeleton, solids, sweep, reach, and the judge of a kit.
//!
//! Aims, on two cores. None is measured yet (`benches/README.md`):
//!
//! | stage | aim |
//! |---|---|
//! | the skeleton of a model of 12 000 to 14 000 triangles | 5 s |
//! | a whole kit | 30 s and 1 GiB |

use std::path::{Path, PathBuf};
use std::sync::{LazyLock, OnceLock};

use divan::{Bencher, black_box};
use equipoise::base::watch::Watch;
use equipoise::curve::{Curve, FitRequest, NamedCurve, fit};
use equipoise::io::{decode_curve, read_bytes, read_model};
use equipoise::job::telescope::{ShellCount, Stance, TelescopeJob};
use equipoise::job::{ModelUnit, PrinterChoice, Scaling};
use equipoise::kit::Existing;
use equipoise::mesh::{Solid, scaled};
use equipoise::repair::repair;
use equipoise::skeleton::Skeleton;
use equipoise::telescope::{
    Design, JointSizes, Network, Order, Tails, Target, Wish, design, prepare,
};
use equipoise::verify::verify_telescope;
use equipoise::wing::Outcome;

use super::shared;

/// The printer of a kit.
const PRINTER: &str = "prusa-mk4";
/// Shells of every telescope.
const SHELLS: usize = 6;
/// The longest side of a model, mm.
const SIZE_MM: f64 = 300.0;

/// The measures of joints for filament.
const SIZES: JointSizes = JointSizes {
    wall_mm: 0.9,
    slide_mm: 0.3,
    engagement_mm: 0.6,
    flange_mm: 3.0,
    lip_mm: 3.0,
    seat_mm: 0.1,
    spigot_mm: 2.0,
    glue_mm: 0.1,
    vent_mm: 2.0,
    chamfer_mm: 0.3,
    feature_mm: 0.9,
    tails: Tails::Capped,
};

/// A curve, and what the later stages start from, made when first asked for.
struct Line {
    name: &'static str,
    source: String,
    curve: Curve,
    design: OnceLock<Design>,
    kit: OnceLock<PathBuf>,
}

static LINES: LazyLock<Vec<Line>> = LazyLock::new(|| {
    let line = |name, source: String, curve| Line {
        name,
        source,
        curve,
        design: OnceLock::new(),
        kit: OnceLock::new(),
    };
    let hook = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/hook.csv");
    let points = decode_curve(&read_bytes(Path::new(hook)).unwrap()).unwrap();
    let helix = "helix:60,80,1";
    let named: NamedCurve = helix.parse().unwrap();
    vec![
        line("hook", hook.to_owned(), Curve::through(&points).unwrap()),
        line(
            "helix",
            helix.to_owned(),
            Curve::of_polyline(named.points()).unwrap(),
        ),
    ]
});

fn lines() -> Vec<&'static str> {
    LINES.iter().map(|line| line.name).collect()
}

fn line(name: &str) -> &'static Line {
    LINES.iter().find(|line| line.name == name).unwrap()
}

impl Line {
    fn design(&self) -> &Design {
        let wish = Wish::new(vec![SHELLS], SIZES);
        self.design
            .get_or_init(|| design(&self.curve, &wish, SHELLS).unwrap())
    }

    fn job(&self) -> TelescopeJob {
        let printer = PrinterChoice {
            id: PRINTER.to_owned(),
            material: None,
        };
        TelescopeJob {
            shells: ShellCount::Given(SHELLS),
            goal: Stance::None,
            ..TelescopeJob::new(&self.source, Scaling::Unit(ModelUnit::Mm), printer)
        }
    }

    /// Returns the folder of its kit.
    fn kit(&self) -> &Path {
        self.kit.get_or_init(|| {
            let Outcome::Prepared(prepared) = prepare(&self.job(), &Watch::silent()).unwrap()
            else {
                unreachable!("the curve has a telescope")
            };
            let tmp = Path::new(env!("CARGO_TARGET_TMPDIR"));
            let folder = tmp.join(format!("{}-telescope", self.name));
            prepared.kit.write(&folder, Existing::Replace).unwrap();
            folder
        })
    }
}

/// The models of the shared folder that are there, by their names.
fn models() -> Vec<&'static str> {
    let all = ["armadillo.obj", "elephant.obj", "homer.obj"];
    let found = all.into_iter().filter(|file| shared(file).is_file());
    found.collect()
}

#[divan::bench(name = "telescope/fit", args = lines(), sample_count = 3, sample_size = 1)]
fn fit_shells(bencher: Bencher, name: &str) {
    let curve = &line(name).curve;
    let request = FitRequest::new(SHELLS, 0.75 / 14.0, 0.02);
    bencher.bench(|| fit(black_box(curve), &request).unwrap());
}

#[divan::bench(name = "telescope/skeleton", args = models(), sample_count = 3, sample_size = 1)]
fn skeleton(bencher: Bencher, file: &str) {
    let (mesh, _) = repair(read_model(&shared(file)).unwrap(), &Watch::silent()).unwrap();
    let factor = SIZE_MM / mesh.longest_side_mm();
    let solid = Solid::new(scaled(&mesh, factor)).unwrap();
    bencher.bench(|| Skeleton::of(black_box(&solid), &Watch::silent()).unwrap());
}

#[divan::bench(name = "telescope/solids", args = lines(), sample_count = 5, sample_size = 1)]
fn solids(bencher: Bencher, name: &str) {
    let telescope = &line(name).design().telescope;
    bencher.bench(|| {
        for shell in 0..telescope.shells.len() {
            black_box(telescope).shell_solid(shell).unwrap();
            black_box(telescope).cap_solid(shell).unwrap();
        }
    });
}

#[divan::bench(name = "telescope/sweep", args = lines(), sample_count = 5, sample_size = 1)]
fn sweep(bencher: Bencher, name: &str) {
    let telescope = &line(name).design().telescope;
    let order = Order::root_first(telescope.joints.len());
    // Whether it is free is not asked: both answers take the same steps up to a touch.
    bencher.bench(|| black_box(telescope).open_in(&order).is_ok());
}

#[divan::bench(name = "telescope/reach", args = lines(), sample_count = 5, sample_size = 1)]
fn reach(bencher: Bencher, name: &str) {
    let design = line(name).design();
    let network = Network::alone(design.telescope.clone(), design.opening.clone());
    let half = design.opening.keys[design.opening.keys.len() / 2].clone();
    let place = network.ends(&[half])[0];
    let target = Target { limb: 0, place };
    bencher.bench(|| black_box(&network).reach(&[target]));
}

#[divan::bench(name = "telescope/judge", args = lines(), sample_count = 2, sample_size = 1)]
fn judge(bencher: Bencher, name: &str) {
    let kit = line(name).kit();
    bencher.bench(|| verify_telescope(black_box(kit), &Watch::silent()).unwrap());
}

#[divan::bench(name = "telescope/whole", args = lines(), sample_count = 1, sample_size = 1)]
fn whole(bencher: Bencher, name: &str) {
    let job = line(name).job();
    bencher.bench(|| prepare(black_box(&job), &Watch::silent()).unwrap());
}
