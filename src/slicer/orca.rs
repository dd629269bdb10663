//! OrcaSlicer and Bambu Studio: they read the plate's package and its orders by themselves, and
//! the rest from three files of presets. Nobody has run one of them with this program yet.

use std::fs::{self, File};

use serde_json::{Map, Value, json};

use super::error::SlicerError;
use super::reword::reword;
use super::run::Work;
use super::settings::{FILAMENT_MM, SliceSettings};
use crate::base::dialect::Dialect;
use crate::base::watch::Watch;
use crate::io::threemf::ORCA_WIDTHS;

/// The file that they write for the first plate of a package.
const TOOLPATHS: &str = "plate_1.gcode";
/// The files of presets, each with its kind.
const PRESETS: [[&str; 2]; 3] = [
    ["machine.json", "machine"],
    ["process.json", "process"],
    ["filament.json", "filament"],
];
/// Slices a plate and returns its toolpaths.
pub(super) fn slice(work: &Work, watch: &Watch) -> Result<File, SlicerError> {
    let package = work.file("plate.3mf");
    let own = reword(work, Dialect::Orca)?;
    let bytes = own.as_deref().unwrap_or(work.plate.bytes);
    fs::write(&package, bytes).map_err(SlicerError::Folder)?;
    for [file, kind] in PRESETS {
        let text = preset(kind, work.settings).to_string();
        fs::write(work.file(file), text).map_err(SlicerError::Folder)?;
    }
    let said = work.run(watch, |command| {
        command
            .args(["--slice", "0", "--arrange", "0", "--orient", "0"])
            .args(["--load-settings", "machine.json;process.json"])
            .args(["--load-filaments", "filament.json"])
            .args(["--outputdir", "."])
            .arg(&package);
    })?;
    File::open(work.file(TOOLPATHS)).map_err(|_| work.no_toolpaths(&said))
}

/// Returns a preset of a kind. Settings of a shop's profile hold where it says nothing.
fn preset(kind: &str, settings: &SliceSettings) -> Value {
    let lines = settings
        .profile()
        .unwrap_or_default()
        .lines()
        .map(str::trim);
    let lines = lines.filter(|line| !line.starts_with(['#', ';']));
    let shop = lines.filter_map(|line| line.split_once('='));
    let shop = shop.map(|(key, value)| (key.trim().to_owned(), json!(value.trim())));
    let mut all: Map<String, Value> = shop.collect();
    let own = match kind {
        "machine" => machine(settings),
        "process" => process(settings),
        _ => filament(settings),
    };
    all.extend(own.as_object().cloned().unwrap_or_default());
    let head = json!({"type": kind, "name": "equipoise", "from": "User"});
    all.extend(head.as_object().cloned().unwrap_or_default());
    Value::Object(all)
}

/// Returns the settings of the filament.
fn filament(settings: &SliceSettings) -> Value {
    let mut all = json!({
        "filament_diameter": [FILAMENT_MM.to_string()],
        "filament_density": [settings.density_g_cm3().to_string()],
    });
    if let Some(ratio) = settings.flow_ratio() {
        all["filament_flow_ratio"] = json!([ratio.to_string()]);
    }
    all
}

/// Returns the settings of the machine.
fn machine(settings: &SliceSettings) -> Value {
    let [width, depth, height] = settings.room_mm();
    let corners = [[0.0, 0.0], [width, 0.0], [width, depth], [0.0, depth]];
    json!({
        "printable_area": corners.map(|[x, y]| format!("{x}x{y}")),
        "printable_height": height.to_string(),
        "nozzle_diameter": [format!("{:.3}", settings.nozzle_mm())],
        "gcode_flavor": "marlin2",
        "use_relative_e_distances": "0",
    })
}

/// Returns the settings of lines and layers.
fn process(settings: &SliceSettings) -> Value {
    let layer_mm = settings.layer_mm().to_string();
    let mut all = json!({
        "layer_height": layer_mm,
        "initial_layer_print_height": layer_mm,
        "gcode_label_objects": "1",
        "xy_contour_compensation": "0",
        "xy_hole_compensation": "0",
        "spiral_mode": "0",
    });
    for key in ORCA_WIDTHS {
        all[key] = json!(settings.line_mm().to_string());
    }
    all
}
