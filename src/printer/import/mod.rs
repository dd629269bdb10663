//! Import of printers, materials and layers from slicers: the `.ini` files of PrusaSlicer and
//! SuperSlicer, and Cura's definitions.
//!
//! The result is written as a profile ([`Imported::to_toml`]). Every number carries its file,
//! section and key as its source. Slicers do not know least walls, clearances and cleaning; these
//! are inherited from the process and marked as its defaults.

mod cura;
mod error;
mod formula;
mod imported;
mod ini;
mod prusa;
mod text;
mod write;

pub use error::ImportError;
pub use imported::{Found, Imported, ImportedMaterial, ImportedPrinter, Technology};
pub use write::slug;

use std::path::PathBuf;

impl Imported {
    /// Reads files that belong together: a bundle, an exported configuration, or a Cura definition
    /// with its materials and layers.
    pub fn read(paths: &[PathBuf]) -> Result<Self, ImportError> {
        let mut all = Self::default();
        for path in paths {
            let name = path
                .file_name()
                .map(|name| name.to_string_lossy().into_owned())
                .unwrap_or_default();
            let text = text::read(path)?;
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
}
