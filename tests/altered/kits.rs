//! Kits of small coarse models, in memory, and the folders in which altered ones are judged.

use std::collections::BTreeMap;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::OnceLock;

use equipoise::base::watch::Watch;
use equipoise::geom::{Matrix, Point, Vector};
use equipoise::io::stl;
use equipoise::mesh::TriMesh;
use equipoise::mesh::primitives::{cuboid, ellipsoid};
use equipoise::press;
use equipoise::sheet::Checklist;
use equipoise::verify::{CheckKind, verify_kit};
use serde_json::Value;

use crate::common::{assert_exit, equipoise, files, path, words};

/// A kit to make: its name, its model and its options.
type Order = (&'static str, fn() -> TriMesh, &'static str);

/// The kits that are altered.
const KITS: [Order; 4] = [
    (
        "top",
        tilted,
        "--goal top --up z --printer objet-connex350 --wall 1.5mm",
    ),
    (
        "yoyo",
        tilted,
        "--goal yoyo --up z --printer objet-connex350 --wall 1.5mm",
    ),
    (
        "stand",
        block,
        "--goal stand --up z --printer objet-connex350 --wall 1.5mm",
    ),
    (
        "float",
        tilted,
        "--goal float --up z --printer objet-connex350 --wall 1.5mm",
    ),
];

/// A kit in memory: its files by their paths.
#[derive(Clone)]
pub struct Kit {
    /// Its name.
    pub name: &'static str,
    /// Its files.
    pub files: BTreeMap<String, Vec<u8>>,
}

/// What the judge says of a kit.
#[derive(Debug)]
pub enum Said {
    /// It keeps every promise: exit 0.
    Kept,
    /// It breaks these promises: exit 1.
    Broken(Vec<CheckKind>),
    /// It cannot be judged: exit 1 or 2.
    Refused,
    /// The judge gave up by itself.
    Panicked,
}

/// An ellipsoid with tilted axes.
fn tilted() -> TriMesh {
    let (sin, cos) = 0.15f64.sin_cos();
    let turn = Matrix::new(1.0, 0.0, 0.0, 0.0, cos, -sin, 0.0, sin, cos);
    let body = ellipsoid(&Point::origin(), &Vector::new(20.0, 18.0, 14.0), 3);
    body.map_vertices(|p| turn * p)
}

/// A block that is higher than wide.
fn block() -> TriMesh {
    cuboid(&Point::origin(), &Point::new(22.0, 18.0, 30.0))
}

/// Returns the kits, made once.
pub fn kits() -> &'static [Kit] {
    static MADE: OnceLock<Vec<Kit>> = OnceLock::new();
    MADE.get_or_init(|| {
        // Threads of their own: those of the pool may wait for these kits.
        std::thread::scope(|scope| {
            let makers = KITS.map(|order| scope.spawn(move || make(order)));
            makers.map(|maker| maker.join().unwrap()).into()
        })
    })
}

fn make((name, model, options): Order) -> Kit {
    let room = tempfile::tempdir().unwrap();
    let (file, kit) = (room.path().join("model.stl"), room.path().join("kit"));
    fs::write(&file, stl::encode(&model(), name)).unwrap();
    let usual = ["prepare", path(&file), "--out", path(&kit), "-q"];
    let sizes = words("--size 36mm --pitch 1mm");
    assert_exit(
        &equipoise(&[&usual[..], &sizes, &words(options)].concat()),
        0,
    );
    let read = files(&kit).into_iter();
    let read = read.map(|(file, bytes)| (file.to_str().unwrap().replace('\\', "/"), bytes));
    Kit {
        name,
        files: read.collect(),
    }
}

impl Kit {
    /// Returns the checklist.
    pub fn sheet(&self) -> Value {
        serde_json::from_slice(&self.files["checklist.json"]).unwrap()
    }

    /// Puts the checklist back, as the program writes it if it still is one.
    pub fn set_sheet(&mut self, sheet: &Value) {
        let whole = serde_json::from_value(sheet.clone()).ok();
        let text = whole.and_then(|whole: Checklist| whole.to_json().ok());
        let text = text.unwrap_or_else(|| sheet.to_string());
        let file = "checklist.json".to_owned();
        self.files.insert(file, text.into_bytes());
    }

    /// Returns the file of a part.
    pub fn part_file(&self, part: usize) -> String {
        self.sheet()["parts"][part]["file"]
            .as_str()
            .unwrap()
            .to_owned()
    }

    /// Returns the mesh of a file.
    pub fn mesh(&self, file: &str) -> TriMesh {
        stl::decode(&self.files[file]).unwrap()
    }

    /// Replaces the mesh of a file.
    pub fn set_mesh(&mut self, file: &str, mesh: &TriMesh) {
        self.files
            .insert(file.to_owned(), stl::encode(mesh, "altered"));
    }
}

/// A folder in which altered copies of kits are judged, one after the other.
pub struct Room {
    folder: tempfile::TempDir,
    there: Option<Kit>,
}

impl Room {
    /// Makes an empty room.
    pub fn new() -> Self {
        Self {
            folder: tempfile::tempdir().unwrap(),
            there: None,
        }
    }

    /// Judges a kit, as `equipoise verify` does.
    ///
    /// Papers are printed again only if nothing else is found, since that takes longest.
    pub fn judge(&mut self, kit: &Kit) -> Said {
        self.lay_out(kit);
        let folder = self.path();
        let judge = || match verify_kit(&folder, &Watch::silent()) {
            Ok(judgement) if judgement.passes() => press::verify(&folder, None, &Watch::silent()),
            judged => judged,
        };
        match catch_unwind(AssertUnwindSafe(judge)) {
            Err(_) => Said::Panicked,
            Ok(Err(_)) => Said::Refused,
            Ok(Ok(judgement)) if judgement.passes() => Said::Kept,
            Ok(Ok(judgement)) => {
                let broken = judgement.checks.into_iter().filter(|check| !check.pass);
                Said::Broken(broken.map(|check| check.kind).collect())
            }
        }
    }

    /// Returns the folder of the kit.
    pub fn path(&self) -> PathBuf {
        self.folder.path().join("kit")
    }

    /// Lays out a kit; writes what differs from the kit before.
    pub fn lay_out(&mut self, kit: &Kit) {
        let folder = self.path();
        let known = self
            .there
            .take()
            .map(|there| there.files)
            .unwrap_or_default();
        for file in known.keys().filter(|file| !kit.files.contains_key(*file)) {
            fs::remove_file(folder.join(file)).unwrap();
        }
        for (file, bytes) in kit
            .files
            .iter()
            .filter(|(file, bytes)| known.get(*file) != Some(bytes))
        {
            let path = folder.join(file);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, bytes).unwrap();
        }
        self.there = Some(kit.clone());
    }
}
