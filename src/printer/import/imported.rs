//! Printers and materials as slicers know them.

use super::ImportError;
use crate::base::dialect::Dialect;
use crate::base::setting::{Key, Setting};
use crate::base::toml_text::nearest_name;

/// The working principle of a printer, as far as slicers state it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Technology {
    /// Lines of filament: the process `fdm`.
    Filament,
    /// A vat of resin: the process `sla`.
    Resin,
}

impl Technology {
    /// Returns the id of the process that profiles inherit from.
    pub fn process(self) -> &'static str {
        match self {
            Self::Filament => "fdm",
            Self::Resin => "sla",
        }
    }
}

/// A number and its place in a slicer's files.
#[derive(Debug, Clone, PartialEq)]
pub struct Found<T> {
    /// The number, mm or g/cm³.
    pub value: T,
    /// The file, section and key, and how it was computed if it was.
    pub source: String,
    /// True if it was computed from values of the source, false if the source states it.
    pub is_computed: bool,
}

/// A printer as slicers know it.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportedPrinter {
    /// Its name.
    pub name: String,
    /// Its working principle.
    pub technology: Technology,
    /// Sizes of pixels or widths of lines along x and y.
    pub pixel_mm: Option<[Found<f64>; 2]>,
    /// Height of the default layer.
    pub layer_mm: Option<Found<f64>>,
    /// Heights of the thinnest and the thickest layer.
    pub layers_mm: [Option<Found<f64>>; 2],
    /// The build volume.
    pub build_volume_mm: Option<Found<[f64; 3]>>,
    /// The elephant foot for which the slicer compensates.
    pub elephant_foot_mm: Option<Found<f64>>,
    /// Lines along a wall.
    pub perimeters: Option<Found<f64>>,
    /// Solid layers over and under sparse infill, the lesser number of both.
    pub solid_layers: Option<Found<f64>>,
    /// The share of a line by which infill reaches into the walls.
    pub overlap_ratio: Option<Found<f64>>,
    /// The family of slicers that its plates give orders to; `None` for the usual one.
    pub dialect: Option<Found<Dialect>>,
    /// The name of its default material.
    pub default_material: Option<String>,
}

/// A material as slicers know it.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportedMaterial {
    /// Its name.
    pub name: String,
    /// The printers it is for.
    pub technology: Technology,
    /// Its density; `None` if the file omits it or sets it to zero.
    pub density_g_cm3: Option<Found<f64>>,
    /// Its flow; `None` if the file omits it.
    pub flow_ratio: Option<Found<f64>>,
}

/// Everything found in a set of files.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Imported {
    /// The printers.
    pub printers: Vec<ImportedPrinter>,
    /// The materials.
    pub materials: Vec<ImportedMaterial>,
    /// Names of the files.
    pub(super) files: Vec<String>,
}

impl Imported {
    /// Finds the printer of that name, or the only one for `None`.
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
                    let names = known.iter().map(|printer| printer.name.as_str());
                    let remedy = match nearest_name(name, names) {
                        Some(near) => format!("did you mean `{near}`?"),
                        None => format!("list the printers (`{}`)", Setting::open(Key::List)),
                    };
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
