//! Bases of several polyhedra whose panels do not bear on each other: rods join them.

use std::fs;
use std::path::{Path, PathBuf};

use equipoise::geom::Point;
use equipoise::io::stl;
use equipoise::mesh::{Csg, TriMesh, primitives};
use serde_json::Value;

use super::common::{assert_exit, checklist, copy, json, list, number, path, printed, sum, verify};
use super::{
    add, base_comes_back, core, hold_broken, hold_broken_in_python, judge_in_python, two_boxes,
};

/// The sides of both boxes of the dumbbell, mm, and its length.
const BOX_MM: [f64; 3] = [130.0, 150.0, 150.0];
const LONG_MM: f64 = 300.0;

/// Returns a dumbbell: two boxes on a square neck of this width, mm.
fn dumbbell(folder: &Path, neck_mm: f64) -> PathBuf {
    let block = |low: [f64; 3], high: [f64; 3]| {
        let mesh = primitives::cuboid(&Point::from(low), &Point::from(high));
        Csg::of_mesh(&mesh).unwrap()
    };
    let [x, y, z] = BOX_MM;
    let [low, high] = [-0.5, 0.5].map(|half| 0.5 * y + half * neck_mm);
    let left = block([0.0; 3], BOX_MM);
    let right = block([LONG_MM - x, 0.0, 0.0], [LONG_MM, y, z]);
    let neck = block([x - 1.0, low, low], [LONG_MM - x + 1.0, high, high]);
    let whole = left.union(&right).unwrap().union(&neck).unwrap();
    let mesh: TriMesh = whole.to_mesh().unwrap();
    let file = folder.join("dumbbell.stl");
    fs::write(&file, stl::encode(&mesh, "dumbbell")).unwrap();
    file
}

#[test]
#[ignore = "a whole kit, its replay, and twelve lies through both judges: minutes"]
fn a_dumbbell_is_joined_by_two_rods_and_passes_both_judges() {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("kit");
    let model = dumbbell(folder.path(), 50.0);
    let output = core(&model, &kit, "--faces 6 --up z --polyhedra 2");
    assert_exit(&output, 0);
    hold_rods(&kit);
    let (code, said) = verify(&kit);
    assert_eq!(code, Some(0), "{said}");
    judge_in_python(&kit);
    tell_lies(folder.path(), &kit);
    let again = base_comes_back(folder.path(), &model, &kit);
    assert_eq!(checklist(&kit)["rods"], checklist(&again)["rods"]);
}

/// Holds what two rods through the neck must have.
fn hold_rods(kit: &Path) {
    let sheet = checklist(kit);
    let rods = list(&sheet, "rods");
    assert_eq!(rods.len(), 2);
    // No bolts: the panels do not bear on each other.
    assert!(
        list(&sheet, "fasteners")
            .iter()
            .all(|one| one["kind"] != "bolt")
    );
    let join = &list(&sheet, "joins")[0];
    assert_eq!([number(join, "/bolts"), number(join, "/rods")], [0.0, 2.0]);
    for rod in rods {
        // Square to the plane in the neck, through both panels, with 3 mm beyond either.
        let [from, to] =
            [0, 1].map(|end| [0, 1, 2].map(|axis| number(rod, &format!("/ends_mm/{end}/{axis}"))));
        assert!((from[1] - to[1]).abs() < 1e-9 && (from[2] - to[2]).abs() < 1e-9);
        let length_mm = (to[0] - from[0]).abs();
        assert!((length_mm - number(rod, "/length_mm")).abs() < 1e-9);
        assert!(length_mm > 40.0, "{length_mm}");
        // Beech of its size.
        let expected_g =
            0.72e-3 * std::f64::consts::FRAC_PI_4 * number(rod, "/diameter_mm").powi(2) * length_mm;
        assert!((number(rod, "/mass_g") / expected_g - 1.0).abs() < 1e-3);
    }
    assert!((sum(rods, "/mass_g") / number(&sheet, "/masses/rods_g") - 1.0).abs() < 1e-12);
    // Both are sawn from one rod of a metre.
    let bought = list(&sheet, "buy")
        .iter()
        .find(|row| row["id"] == rods[0]["id"]);
    assert_eq!(number(bought.unwrap(), "/count"), 1.0);
    let page = fs::read_to_string(kit.join("job.html")).unwrap();
    for words in [
        "Rods between polyhedra",
        "It slides on 2 rods",
        ">☐ R1<",
        ">☐ R2<",
    ] {
        assert!(page.contains(words), "{words}");
    }
}

/// A lie about rods that a judge could overlook.
struct Lie {
    file: &'static str,
    /// Words of the promise that it breaks.
    promise: &'static str,
    /// The check of the judge in Python that it breaks.
    check: &'static str,
    tell: fn(&mut Value),
}

const fn of_rods(tell: fn(&mut Value)) -> Lie {
    Lie {
        file: "checklist.json",
        promise: "rods reach through",
        check: "faults of rods",
        tell,
    }
}

/// Moves the ends and the middle of the first rod along an axis of the model, mm.
fn shift(sheet: &mut Value, axis: usize, by_mm: f64) {
    let rod = &mut sheet["rods"][0];
    add(&mut rod["ends_mm"][0][axis], by_mm);
    add(&mut rod["ends_mm"][1][axis], by_mm);
    add(&mut rod["center_mm"][axis], by_mm);
}

const LIES: [Lie; 12] = [
    // Longer than the way between its ends, or with an end elsewhere.
    of_rods(|sheet| add(&mut sheet["rods"][0]["length_mm"], 0.5)),
    of_rods(|sheet| add(&mut sheet["rods"][0]["ends_mm"][1][0], 0.5)),
    of_rods(|sheet| add(&mut sheet["rods"][0]["diameter_mm"], 0.5)),
    of_rods(|sheet| add(&mut sheet["rods"][0]["diameter_mm"], -2.0)),
    of_rods(|sheet| shift(sheet, 1, 0.5)),
    of_rods(|sheet| shift(sheet, 0, 0.5)),
    of_rods(|sheet| {
        let id = sheet["rods"][0]["id"].clone();
        let rows = sheet["buy"].as_array_mut().unwrap();
        rows.retain(|row| row["id"] != id);
    }),
    of_rods(|sheet| add(&mut sheet["rods"][0]["mass_g"], 1.0)),
    // Of heavier wood than the catalogue's, and of longer stock.
    of_rods(|sheet| {
        for key in ["density_g_cm3", "mass_g"] {
            let number = &mut sheet["rods"][0][key];
            *number = Value::from(1.1 * number.as_f64().unwrap());
        }
    }),
    of_rods(|sheet| add(&mut sheet["rods"][0]["stock_mm"], 1000.0)),
    Lie {
        promise: "all the way",
        check: "rods on which nothing comes",
        ..of_rods(|sheet| {
            sheet["rods"].as_array_mut().unwrap().pop();
        })
    },
    Lie {
        file: "panels.json",
        ..of_rods(|panels| {
            // The holes of rods are the widest: all others are for screws.
            for panel in panels["panels"].as_array_mut().unwrap() {
                for hole in panel["holes"].as_array_mut().unwrap() {
                    if hole["diameter_mm"].as_f64().unwrap() > 6.0 {
                        add(&mut hole["at_mm"][0], 0.5);
                    }
                }
            }
        })
    },
];

fn tell_lies(folder: &Path, kit: &Path) {
    for (index, lie) in LIES.iter().enumerate() {
        let copied = folder.join(format!("lie-{index}"));
        copy(kit, &copied);
        let file = copied.join(lie.file);
        let mut value: Value = serde_json::from_slice(&fs::read(&file).unwrap()).unwrap();
        (lie.tell)(&mut value);
        fs::write(&file, value.to_string()).unwrap();
        hold_broken(&copied, lie.promise);
        hold_broken_in_python(&copied, lie.check);
    }
}

/// Orders a kit of the dumbbell on the given base.
fn on_two_boxes(folder: &Path, neck_mm: f64, options: &str) -> (PathBuf, std::process::Output) {
    let base = folder.join("base.toml");
    fs::write(&base, two_boxes(150.0, [110.0, 190.0], 280.0)).unwrap();
    let kit = folder.join("kit");
    let options = format!("--up z --goal none --base {} {options}", path(&base));
    let output = core(&dumbbell(folder, neck_mm), &kit, &options);
    (kit, output)
}

#[test]
fn rods_too_thick_for_the_neck_are_answered_with_its_width_and_thinner_ones() {
    let folder = tempfile::tempdir().unwrap();
    let (kit, output) = on_two_boxes(folder.path(), 50.0, "--dowel dowel-20 --json");
    assert_exit(&output, 1);
    let answer = json(&output);
    let reason = answer["reason"].as_str().unwrap();
    assert!(reason.contains("are not joined"), "{reason}");
    let hints = answer["hints"].to_string();
    // Half of the neck, and what two rods of 20 mm need: 20.3 + 10.35 + 3 and the bore's play.
    assert!(
        hints.contains("radius of 25") && hints.contains("dowel-20 need 33"),
        "{hints}"
    );
    assert!(hints.contains("two rods dowel-12: give"), "{hints}");
    assert!(!kit.exists());
}

#[test]
fn a_neck_too_thin_for_any_rods_or_without_any_allowed_is_an_answer() {
    let folder = tempfile::tempdir().unwrap();
    let (_, output) = on_two_boxes(folder.path(), 18.0, "--json");
    assert_exit(&output, 1);
    let hints = json(&output)["hints"].to_string();
    assert!(
        hints.contains("radius of 9") && hints.contains("dowel-6 need 12"),
        "{hints}"
    );
    let (_, output) = on_two_boxes(folder.path(), 50.0, "--dowel none --json");
    assert_exit(&output, 1);
    let hints = json(&output)["hints"].to_string();
    assert!(hints.contains("two rods dowel-12: give"), "{hints}");
}

#[test]
fn a_rod_that_is_not_on_stock_is_refused_with_those_that_are() {
    let folder = tempfile::tempdir().unwrap();
    let (kit, output) = on_two_boxes(folder.path(), 50.0, "--dowel dowel-7");
    assert_exit(&output, 2);
    let said = printed(&output);
    assert!(
        said.contains("dowel-7") && said.contains("dowel-8"),
        "{said}"
    );
    assert!(!kit.exists());
}

#[test]
#[ignore = "a whole kit: a minute on 2 cores"]
fn the_hint_of_thinner_rods_works_when_it_is_typed() {
    let folder = tempfile::tempdir().unwrap();
    let (kit, output) = on_two_boxes(folder.path(), 50.0, "--dowel dowel-12");
    assert_exit(&output, 0);
    let sheet = checklist(&kit);
    let rods = list(&sheet, "rods");
    assert!(rods.len() == 2 && rods.iter().all(|rod| rod["id"] == "dowel-12"));
    // Panels 40 mm off the middle of the neck: 80 mm, two sheets, and 3 mm at either end.
    let sheet_mm = number(&sheet, "/sheet/thickness_mm");
    let expected_mm = 80.0 + 2.0 * sheet_mm + 6.0;
    assert!((number(&rods[0], "/length_mm") - expected_mm).abs() < 1e-9);
}
