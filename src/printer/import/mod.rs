//! Printers, materials and layers taken over from slicers: PrusaSlicer's and SuperSlicer's `.ini`,
//! Cura's definitions.
//!
//! What is read becomes the text of a profile of ours ([`Imported::to_toml`]), every number with
//! the file, section and key it is from. What slicers do not know (least walls, clearances,
//! cleaning) is inherited from the process and marked so.

mod cura;
mod formula;
mod ini;
mod prusa;
mod write;

pub use write::slug;

use std::path::{Path, PathBuf};

use crate::base::toml_text::Place;

/// Why nothing can be taken over.
#[derive(Debug, thiserror::Error)]
pub enum ImportError {
    /// A file cannot be read.
    #[error("cannot read {}; remedy: check the path and its permissions", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// A line that does not belong into such a file.
    #[error("{place}: {problem}")]
    Line {
        /// Where it stands.
        place: Place,
        /// What is wrong.
        problem: &'static str,
    },
    /// A section that is its own ancestor.
    #[error("{place}: the section inherits from itself ({way})")]
    Cycle {
        /// Where it stands.
        place: Place,
        /// The way round.
        way: String,
    },
    /// A section that is not there.
    #[error("{file} has no [{kind}:{name}]; remedy: {remedy}")]
    NoSection {
        /// The file.
        file: String,
        /// Its kind.
        kind: String,
        /// Its name.
        name: String,
        /// The nearest name, or how to list them.
        remedy: String,
    },
    /// JSON that is none, or no definition.
    #[error("{file}:{line}:{column}: {message}; remedy: give a Cura definition (.def.json)")]
    Json {
        /// The file.
        file: String,
        /// The line.
        line: usize,
        /// The column.
        column: usize,
        /// What is wrong.
        message: String,
    },
    /// A file of an unknown kind.
    #[error(
        "{} is none of .ini, .def.json, .inst.cfg and .xml.fdm_material; remedy: give a file that a slicer has written",
        path.display()
    )]
    UnknownKind {
        /// The file.
        path: PathBuf,
    },
    /// No printer in the files.
    #[error(
        "there is no printer in {files}; remedy: give a slicer's bundle, an exported configuration or a .def.json"
    )]
    NoPrinter {
        /// The files.
        files: String,
    },
    /// Several printers and no choice.
    #[error(
        "there are {count} printers in {files}; remedy: choose one with --printer, list them with --list"
    )]
    SeveralPrinters {
        /// How many.
        count: usize,
        /// The files.
        files: String,
    },
}

/// How a printer works, as far as slicers tell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Technology {
    /// Filament in lines: our process `fdm`.
    Filament,
    /// A vat of resin: our process `sla`.
    Resin,
}

impl Technology {
    /// The id of our process.
    pub fn process(self) -> &'static str {
        match self {
            Self::Filament => "fdm",
            Self::Resin => "sla",
        }
    }
}

/// A number with the place it is from.
#[derive(Debug, Clone, PartialEq)]
pub struct Found<T> {
    /// The number, mm or g/cm³.
    pub value: T,
    /// The file, section and key, and how it was computed if it was.
    pub source: String,
    /// Whether it was computed from what the source says, not read there.
    pub is_computed: bool,
}

/// A printer as slicers know it.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportedPrinter {
    /// Its name.
    pub name: String,
    /// How it works.
    pub technology: Technology,
    /// Pixels or lines along x and y.
    pub pixel_mm: Option<[Found<f64>; 2]>,
    /// The usual layer.
    pub layer_mm: Option<Found<f64>>,
    /// The thinnest and the thickest layer.
    pub layers_mm: [Option<Found<f64>>; 2],
    /// The build volume.
    pub build_volume_mm: Option<Found<[f64; 3]>>,
    /// The elephant foot that the slicer takes off.
    pub elephant_foot_mm: Option<Found<f64>>,
    /// The name of its default material.
    pub default_material: Option<String>,
}

/// A material as slicers know it.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportedMaterial {
    /// Its name.
    pub name: String,
    /// For which printers.
    pub technology: Technology,
    /// Its density; none where the file leaves it at zero or out.
    pub density_g_cm3: Option<Found<f64>>,
}

/// Everything that was found in some files.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Imported {
    /// The printers.
    pub printers: Vec<ImportedPrinter>,
    /// The materials.
    pub materials: Vec<ImportedMaterial>,
    files: Vec<String>,
}

impl Imported {
    /// What the files say, together: a bundle or an exported configuration, or a Cura definition
    /// with materials and layers.
    pub fn read(paths: &[PathBuf]) -> Result<Self, ImportError> {
        let mut all = Self::default();
        for path in paths {
            let name = path
                .file_name()
                .map(|name| name.to_string_lossy().into_owned())
                .unwrap_or_default();
            let text = read_text(path)?;
            if name.ends_with(".ini") {
                prusa::read(&name, &text, &mut all)?;
            } else if name.ends_with(".def.json") {
                cura::read_definition(path, &text, &mut all)?;
            } else if name.ends_with(".xml.fdm_material") || name.ends_with(".xml") {
                cura::read_material(&name, &text, &mut all);
            } else if name.ends_with(".inst.cfg") {
                cura::read_layer(&name, &text, &mut all)?;
            } else {
                return Err(ImportError::UnknownKind { path: path.clone() });
            }
            all.files.push(name);
        }
        Ok(all)
    }

    /// The printer of that name; the only one where none is named.
    pub fn printer(&self, name: Option<&str>) -> Result<&ImportedPrinter, ImportError> {
        let files = self.files.join(", ");
        match (name, &self.printers[..]) {
            (_, []) => Err(ImportError::NoPrinter { files }),
            (None, [only]) => Ok(only),
            (None, several) => Err(ImportError::SeveralPrinters {
                count: several.len(),
                files,
            }),
            (Some(name), known) => known
                .iter()
                .find(|printer| printer.name == name)
                .ok_or_else(|| {
                    let near = crate::base::toml_text::nearest(
                        name,
                        known.iter().map(|printer| printer.name.as_str()),
                    );
                    let listed = || "list what there is with --list".to_owned();
                    let remedy = near.map_or_else(listed, |near| format!("did you mean `{near}`?"));
                    ImportError::NoSection {
                        file: files,
                        kind: "printer".to_owned(),
                        name: name.to_owned(),
                        remedy,
                    }
                }),
        }
    }
}

fn read_text(path: &Path) -> Result<String, ImportError> {
    std::fs::read_to_string(path).map_err(|source| ImportError::Unreadable {
        path: path.to_owned(),
        source,
    })
}

/// The number at the start of a slicer's value: of several by commas the first; none for `0`, `nil`
/// and words.
fn first_number(value: &str) -> Option<f64> {
    let first = value.split([',', ';']).next()?.trim();
    first
        .parse::<f64>()
        .ok()
        .filter(|number| number.is_finite() && *number > 0.0)
}
