//! Profiles as a shop meets them: a slicer's bundle taken over, coupons sliced, a profile of its
//! own calibrated and used.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a test that is skipped says so")]

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use equipoise::printer::{
    Printer,
    import::{Imported, Technology},
};

/// The bundle that Debian's prusa-slicer ships.
const BUNDLE: &str = "/usr/share/PrusaSlicer/profiles/PrusaResearch.ini";

fn equipoise(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_equipoise"))
        .current_dir(folder)
        .args(arguments)
        .output()
        .unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr)
}

/// The values of a key by preset, found by a reader of our own that knows nothing of the program's:
/// own keys, then those of the parents from the last to the first.
fn values(text: &str, kind: &str, key: &str) -> BTreeMap<String, String> {
    let mut sections: BTreeMap<&str, Vec<(&str, &str)>> = BTreeMap::new();
    let mut current = "";
    for line in text.lines() {
        if let Some(name) = line
            .strip_prefix('[')
            .and_then(|rest| rest.strip_suffix(']'))
        {
            current = name;
            sections.entry(current).or_default();
        } else if let (Some((key, value)), false) =
            (line.split_once('='), line.starts_with(['#', ';']))
        {
            sections
                .entry(current)
                .or_default()
                .push((key.trim(), value.trim()));
        }
    }
    fn value<'a>(
        sections: &BTreeMap<&str, Vec<(&'a str, &'a str)>>,
        kind: &str,
        name: &str,
        key: &str,
    ) -> Option<&'a str> {
        let own = &sections[format!("{kind}:{name}").as_str()];
        let found = |key: &str| {
            own.iter()
                .rev()
                .find(|(k, _)| *k == key)
                .map(|(_, value)| *value)
        };
        let parents = found("inherits").unwrap_or_default();
        let above = || {
            parents
                .split(';')
                .rev()
                .map(str::trim)
                .filter(|name| !name.is_empty())
                .find_map(|parent| value(sections, kind, parent, key))
        };
        found(key).or_else(above)
    }
    let names = sections
        .keys()
        .filter_map(|name| name.strip_prefix(&format!("{kind}:")))
        .filter(|name| !name.starts_with('*'));
    names
        .filter_map(|name| {
            Some((
                name.to_owned(),
                value(&sections, kind, name, key)?.to_owned(),
            ))
        })
        .collect()
}

#[test]
fn every_printer_and_filament_of_debians_prusa_bundle_arrives_with_its_density() {
    let Ok(text) = fs::read_to_string(BUNDLE) else {
        eprintln!(
            "SKIPPED: no {BUNDLE} here; apt-get install --no-install-recommends prusa-slicer"
        );
        return;
    };
    let all = Imported::read(&[BUNDLE.into()]).unwrap();
    let densities = values(&text, "filament", "filament_density");
    let filaments: Vec<_> = all
        .materials
        .iter()
        .filter(|m| m.technology == Technology::Filament)
        .collect();
    assert_eq!(filaments.len(), densities.len());
    for material in filaments {
        let expected = densities[&material.name]
            .split(',')
            .next()
            .unwrap()
            .parse::<f64>()
            .unwrap();
        let found = material
            .density_g_cm3
            .as_ref()
            .map_or(0.0, |found| found.value);
        assert_eq!(found, expected, "{}", material.name);
    }
    let heights = values(&text, "printer", "max_print_height");
    assert_eq!(all.printers.len(), heights.len());
    let folder = tempfile::tempdir().unwrap();
    let mut families = BTreeMap::from([("MK3S", 0), ("MK4", 0), ("SL1", 0)]);
    for printer in &all.printers {
        let Some(family) = families
            .keys()
            .copied()
            .find(|family| printer.name.contains(family))
        else {
            continue;
        };
        *families.get_mut(family).unwrap() += 1;
        let path = folder.path().join("imported.toml");
        fs::write(&path, all.to_toml(printer, "imported")).unwrap();
        let profile =
            Printer::read(&path).unwrap_or_else(|error| panic!("{}: {error}", printer.name));
        let volume = profile.build_volume_mm.as_ref().unwrap().value;
        assert_eq!(
            volume[2].to_string(),
            heights[&printer.name],
            "{}",
            printer.name
        );
        let own = |key: &str| {
            profile
                .numbers()
                .iter()
                .any(|(q, n)| q.key() == key && n.process_default_of.is_none())
        };
        assert!(
            own("pixel_x_mm") && own("pixel_y_mm") && own("layer_mm"),
            "{}",
            printer.name
        );
        if printer.technology == Technology::Filament {
            let weighed = densities
                .values()
                .filter(|density| density.parse::<f64>().unwrap() > 0.0)
                .count();
            assert_eq!(profile.materials.len(), weighed, "{}", printer.name);
        }
    }
    for (family, count) in families {
        match count {
            0 => eprintln!("SKIPPED: this bundle has no {family}"),
            _ => eprintln!("{count} printers {family}"),
        }
    }
}

#[test]
fn a_shop_makes_a_profile_weighs_coupons_and_prepares_with_it_by_default() {
    let folder = tempfile::tempdir().unwrap();
    let run = |arguments: &[&str]| {
        let output = equipoise(folder.path(), arguments);
        assert!(output.status.success(), "{arguments:?}: {}", said(&output));
        said(&output)
    };
    run(&[
        "printers",
        "new",
        "--from",
        "objet-connex350",
        "--out",
        "shop.toml",
    ]);
    run(&["coupon", "--printer", "shop.toml", "--out", "coupons"]);
    for file in [
        "density.stl",
        "comb.stl",
        "trial-pin.stl",
        "pins.stl",
        "walls-x.stl",
        "walls-y.stl",
        "coupon.html",
    ] {
        assert!(folder.path().join("coupons").join(file).is_file(), "{file}");
    }
    let calibrate = [
        "printers",
        "calibrate",
        "shop.toml",
        "--lot",
        "7B",
        "--date",
        "2026-11-21",
        "--clearance",
        "0.15",
    ];
    let weighed = [
        "--weighed",
        "9.45",
        "--weighed",
        "9.47",
        "--weighed",
        "9.46",
        "--volume",
        "8000",
    ];
    let told = run(&[&calibrate[..], &weighed[..]].concat());
    assert!(
        told.contains("vero-white: 1.1825 g/cm³") && told.contains("(was 0.2)"),
        "{told}"
    );
    let profile = Printer::read(&folder.path().join("shop.toml")).unwrap();
    assert!(profile.material(None).unwrap().is_measured());

    let shop = folder.path().join("shop.toml");
    let text = fs::read_to_string(&shop).unwrap();
    let shrinks = |key: &str, value: &str| {
        format!(
            "{key} = {{ value = {value}, source = \"a bar of 100 mm\", sure = \"measured\" }}\n"
        )
    };
    let top = shrinks("compensates_shrinkage", "false");
    let numbers = shrinks("shrinkage_xy_ratio", "0.02") + &shrinks("shrinkage_z_ratio", "0.01");
    let text = text.replace("[numbers]\n", &format!("{top}[numbers]\n{numbers}"));
    fs::write(&shop, text).unwrap();
    fs::write(
        folder.path().join("equipoise.toml"),
        "printer = \"shop.toml\"\n",
    )
    .unwrap();
    let model = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/examples/models/tilted-ellipsoid.stl"
    );
    run(&[
        "-q", "prepare", model, "--goal", "top", "--size", "60mm", "--wall", "1.5mm", "--pitch",
        "0.3mm", "--out", "kit",
    ]);
    let sheet = fs::read(folder.path().join("kit/checklist.json")).unwrap();
    let sheet: serde_json::Value = serde_json::from_slice(&sheet).unwrap();
    assert_eq!(sheet["printer"]["id"], "shop");
    assert_eq!(sheet["material"]["density_sure"], "measured");
    assert!(sheet["material"]["density_spread_ratio"].as_f64().unwrap() < 0.02);
    let sources = sheet["printer"]["sources"].to_string();
    assert!(
        sources.contains("lot 7B, 2026-11-21") && sources.contains("default of polyjet"),
        "{sources}"
    );
    assert!(sources.contains("build volume: not known"), "{sources}");
    files_are_larger_by_the_shrinkage_and_judged_at_nominal_size(folder.path(), &sheet);
}

/// The part files make up for the shrinkage that the profile states, and the kit is still judged by
/// the parts' own size.
fn files_are_larger_by_the_shrinkage_and_judged_at_nominal_size(
    folder: &Path,
    sheet: &serde_json::Value,
) {
    let verified = equipoise(folder, &["verify", "kit"]);
    assert!(verified.status.success(), "{}", said(&verified));
    for part in sheet["parts"].as_array().unwrap() {
        let bytes = fs::read(folder.join("kit").join(part["file"].as_str().unwrap())).unwrap();
        let mesh = equipoise::io::decode_model(&bytes).unwrap();
        let size: [f64; 3] = mesh.aabb().size().into();
        for (axis, shrinkage) in [0.02, 0.02, 0.01].into_iter().enumerate() {
            let ratio = size[axis] / part["size_mm"][axis].as_f64().unwrap();
            assert!((ratio - 1.0 / (1.0 - shrinkage)).abs() < 1e-6, "{ratio}");
        }
    }
}

#[test]
fn what_a_shop_gets_wrong_is_told_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(
        folder.path().join("b.ini"),
        "[printer:A]\nx = 1\n[printer:B]\nx = 1\n",
    )
    .unwrap();
    fs::write(folder.path().join("taken.toml"), "").unwrap();
    for (arguments, words) in [
        (
            vec![
                "printers",
                "calibrate",
                "prusa-mk4",
                "--lot",
                "1",
                "--wall",
                "1",
            ],
            "is a shipped printer",
        ),
        (
            vec!["printers", "new", "--from", "prusa-mk5", "--out", "n.toml"],
            "did you mean `prusa-mk4`?",
        ),
        (
            vec![
                "printers",
                "new",
                "--from",
                "prusa-mk4",
                "--out",
                "taken.toml",
            ],
            "--force",
        ),
        (
            vec![
                "printers",
                "new",
                "--from",
                "prusa-mk4",
                "--id",
                "My Own",
                "--out",
                "n.toml",
            ],
            "lower-case letters",
        ),
        (
            vec!["printers", "import", "b.ini"],
            "choose one with --printer",
        ),
        (
            vec![
                "printers",
                "import",
                "b.ini",
                "--printer",
                "A",
                "--out",
                "n.toml",
            ],
            "`pixel_x_mm` is not set",
        ),
        (vec!["printers", "import", "taken.toml"], "is none of .ini"),
        (
            vec!["coupon", "--printer", "prusa-mk4", "--material", "vero"],
            "does not print `vero`",
        ),
    ] {
        let output = equipoise(folder.path(), &arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(
            said(&output).contains(words),
            "{arguments:?}: {}",
            said(&output)
        );
        assert_eq!(
            fs::read_dir(folder.path()).unwrap().count(),
            2,
            "{arguments:?} left something behind"
        );
    }
}

#[test]
fn a_slicer_takes_every_coupon_without_repair() {
    let is_there = Command::new("prusa-slicer").arg("--help").output().is_ok();
    if !is_there {
        eprintln!(
            "SKIPPED: no prusa-slicer here; apt-get install --no-install-recommends prusa-slicer"
        );
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    assert!(
        equipoise(
            folder.path(),
            &["coupon", "--printer", "prusa-mk4", "--out", "c"]
        )
        .status
        .success()
    );
    for file in ["density", "comb", "trial-pin", "pins", "walls-x", "walls-y"] {
        let path = folder.path().join("c").join(format!("{file}.stl"));
        let output = Command::new("prusa-slicer")
            .arg("--info")
            .arg(path)
            .output()
            .unwrap();
        let said = said(&output);
        assert!(
            said.contains("manifold = yes") && said.contains("number_of_parts =  1"),
            "{file}: {said}"
        );
        assert!(
            !said.contains("open_edges") && !said.contains("facets_r"),
            "{file}: {said}"
        );
    }
}

/// Whether a row of the sheet's table must be whole: along the coarser of x and y for walls, pins
/// and sockets (on pixels that are not square the finer cannot be too), and along z for lengths and
/// depths. Walls are counted in layers as they come.
fn must_be_whole(row: &serde_json::Value, coarser: &str) -> bool {
    let [what, along] = ["what", "along"].map(|key| row[key].as_str().unwrap());
    let is_peg = what.starts_with("pin") || what.starts_with("socket");
    match along {
        "z" => is_peg,
        "tilted" => false,
        along => (is_peg || what == "wall") && along == coarser,
    }
}

#[test]
fn one_job_lands_on_the_grid_of_a_display_of_oblong_pixels_of_polyjet_and_of_filament() {
    let model = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/examples/models/tilted-ellipsoid.stl"
    );
    let folder = tempfile::tempdir().unwrap();
    for (printer, coarser) in [
        ("elegoo-saturn-4-ultra", "y"),
        ("objet-connex350", "x"),
        ("prusa-mk4", "x"),
    ] {
        let job = [
            "-q", "prepare", model, "--goal", "top", "--size", "60mm", "--wall", "1.5mm",
            "--pitch", "0.3mm",
        ];
        let output = equipoise(
            folder.path(),
            &[&job[..], &["--printer", printer, "--out", printer]].concat(),
        );
        assert!(output.status.success(), "{printer}: {}", said(&output));
        let sheet = fs::read(folder.path().join(printer).join("checklist.json")).unwrap();
        let sheet: serde_json::Value = serde_json::from_slice(&sheet).unwrap();
        assert_eq!(sheet["verdict"], "pass");
        let rows = sheet["grid"].as_array().unwrap();
        for row in rows {
            assert!(
                row["is_whole"] == true || !must_be_whole(row, coarser),
                "{printer}: {row}"
            );
            let step_mm = row["step_mm"].as_f64().unwrap();
            let given_mm = row["steps"].as_f64().unwrap() * step_mm;
            assert!(
                (row["given_mm"].as_f64().unwrap() - given_mm).abs() < 1e-9,
                "{printer}: {row}"
            );
            let is_pixel = printer != "prusa-mk4" && row["what"] == "wall";
            assert!(
                !is_pixel || given_mm >= 1.5 - 1e-9,
                "{printer}: a wall may come out thinner than asked: {row}"
            );
        }
        for cut in sheet["cuts"].as_array().unwrap() {
            let start = format!("cut face {} ", cut["id"].as_str().unwrap());
            let mut faces = rows
                .iter()
                .filter(|row| row["what"].as_str().unwrap().starts_with(&start));
            assert!(
                faces.any(|row| row["is_whole"] == true),
                "{printer}: no face of {cut} ends at a layer"
            );
        }
    }
}
