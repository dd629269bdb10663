//! Times and prices are estimates from the profiles of a shop, if these have the figures.

use std::fs;
use std::path::Path;

use serde_json::Value;

use super::common::{assert_exit, checklist, equipoise, list, number, path, sum, words};
use super::{SIDES_MM, block};

/// What the shop's own profiles say.
const SPEED_MM_S: f64 = 20.0;
const PRICE: f64 = 24.5;
/// What the printer's profile says, mm³/s.
const WALL_FLOW: f64 = 2.55;
const SOLID_FLOW: f64 = 5.1;

/// Writes a cutter with a speed and a sheet with a price.
fn shop(folder: &Path) -> [std::path::PathBuf; 2] {
    let sourced =
        |value: &str| format!("{{ value = {value}, source = \"ours\", sure = \"measured\" }}");
    let cutter = format!(
        "id = \"own-laser\"\nname = \"Own laser\"\ninherits = \"makerspace-900x600\"\n\n[[kerf]]\n\
         material = \"plywood\"\nthickness_mm = 3\nkerf_mm = {}\nspeed_mm_s = {SPEED_MM_S}\n",
        sourced("0.2")
    );
    let sheet = format!(
        "id = \"own-birch\"\nname = \"Own birch\"\ninherits = \"birch-3\"\n\n[[size]]\nsize_mm = {}\n\
         price = {PRICE}\n",
        sourced("[900, 600]")
    );
    let files = ["own-laser.toml", "own-birch.toml"].map(|name| folder.join(name));
    for (file, text) in files.iter().zip([cutter, sheet]) {
        fs::write(file, text).unwrap();
    }
    files
}

#[test]
fn times_and_prices_are_those_of_the_profiles_and_named_as_estimates() {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("kit");
    let model = block(folder.path());
    let [cutter, sheet] = shop(folder.path());
    let options = "--printer prusa-mk3s --faces 6 --up z";
    let start = ["core", path(&model), "--out", path(&kit)];
    let machines = ["--cutter", path(&cutter), "--sheet", path(&sheet)];
    let output = equipoise(&[&start[..], &machines, &words(options)].concat());
    assert_exit(&output, 0);
    let sheet = checklist(&kit);
    let near = |key: &str, wanted: f64| {
        let found = number(&sheet, &format!("/estimates/{key}"));
        assert!(
            (found / wanted - 1.0).abs() < 1e-6,
            "{key}: {found} {wanted}"
        );
    };
    let g_mm3 = number(&sheet, "/material/density_g_cm3") / 1000.0;
    let printed_g = sum(list(&sheet, "part_rows"), "/mass_g");
    near("print_s", printed_g / g_mm3 / WALL_FLOW);
    let [x, y, z] = SIDES_MM;
    near("if_solid_s", x * y * z / SOLID_FLOW);
    let skin_mm3 = 2.0 * (x * y + y * z + z * x) * number(&sheet, "/wall_mm");
    near("if_skin_s", skin_mm3 / WALL_FLOW);
    let rows = list(&sheet, "sheet_rows");
    near("cut_s", sum(rows, "/cut_mm") / SPEED_MM_S);
    near("sheets_price", PRICE * rows.len() as f64);
    let page = fs::read_to_string(kit.join("job.html")).unwrap();
    let price = format!("the sheets {:.2} in the shop", PRICE * rows.len() as f64);
    for said in [
        "by the printer's profile, an estimate without support",
        "Cutting takes about",
        &price,
    ] {
        assert!(page.contains(said), "{said}");
    }
}

/// Holds that nothing is estimated where the profiles have no figures, and that the sheet says so.
pub fn hold_none(kit: &Path, sheet: &Value) {
    let estimates = sheet["estimates"].as_object().unwrap();
    assert!(estimates.values().all(Value::is_null), "{estimates:?}");
    assert_eq!(estimates.len(), 5);
    let page = fs::read_to_string(kit.join("job.html")).unwrap();
    for said in ["the printer's profile has no flow", "has no speed"] {
        assert!(page.contains(said), "{said}");
    }
    assert!(!page.contains("in the shop's currency"));
}
