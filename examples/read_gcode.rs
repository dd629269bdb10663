//! Reads G-code and prints as JSON what it lays down, by object and feature.
//!
//! `cargo run --release --example read_gcode -- FILE [DIAMETER_MM]`; a 3MF gives a line for each
//! plate.

#![allow(clippy::print_stdout, reason = "an example prints what it found")]

use std::path::PathBuf;

use equipoise::base::watch::Watch;
use equipoise::io::gcode::{Deposits, Options, Toolpath, read_gcode};
use serde_json::{Value, json};

fn main() -> anyhow::Result<()> {
    let mut words = std::env::args().skip(1);
    let path: PathBuf = words.next().unwrap_or_default().into();
    let options = Options {
        filament_diameter_mm: words.next().map(|mm| mm.parse()).transpose()?,
        ..Options::default()
    };
    for plate in read_gcode(&path, &options, &Watch::silent())? {
        println!("{}", describe(&plate.toolpath));
    }
    Ok(())
}

fn describe(toolpath: &Toolpath) -> Value {
    let objects = toolpath.objects.iter().map(|object| {
        let label = object.label.as_ref().map(ToString::to_string);
        json!({"label": label, "deposits": deposits(&object.deposits)})
    });
    let facts = &toolpath.facts;
    json!({
        "generator": facts.generator.as_ref().map(|g| format!("{} {:?}", g.name, g.version)),
        "print_time_s": facts.print_time_s,
        "filament_used_mm": facts.filament_used_mm,
        "filament_used_g": facts.filament_used_g,
        "filament_density_g_cm3": facts.filament_density_g_cm3,
        "layer_height_mm": facts.layer_height_mm,
        "first_layer_height_mm": facts.first_layer_height_mm,
        "line_widths": format!("{:?}", facts.line_widths),
        "infill_ratio": facts.infill_ratio,
        "diameters_mm": toolpath.diameters_mm,
        "diameter_source": format!("{:?}", toolpath.diameter_source),
        "flow_ratio": toolpath.flow_ratio(),
        "net_feed": toolpath.feed.net(),
        "feed": format!("{:?}", toolpath.feed),
        "layers": toolpath.layers,
        "lines": toolpath.lines,
        "moments": toolpath.part_moments().0,
        "objects": objects.collect::<Vec<Value>>(),
    })
}

fn deposits(deposits: &Deposits) -> Value {
    let bounds = deposits.part_bounds();
    let volumes = deposits.volumes_mm3().into_iter();
    let volumes = volumes.map(|(feature, mm3)| (format!("{feature:?}"), json!(mm3)));
    json!({
        "moments": deposits.part_moments().0,
        "min_mm": bounds.min.coords.as_slice(),
        "max_mm": bounds.max.coords.as_slice(),
        "volumes_mm3": volumes.collect::<serde_json::Map<String, Value>>(),
        "layers": deposits.layers,
        "retractions": deposits.retractions,
    })
}
