//! What is asked of a print in two materials, and the reasons why it is not done.

use crate::field::Order;
use crate::geom::Point;
use crate::mesh::Solid;
use crate::printer::{Grid, Material, MaterialError, Printer};

/// The process that sets a drop of one of several materials into each pixel.
const JETTING: &str = "polyjet";

/// A model to be printed in two materials.
#[derive(Debug, Clone, Copy)]
pub struct DitherOrder<'a> {
    /// The model's file, for the list.
    pub model: &'a str,
    /// The model, scaled, in the axes of its file.
    pub solid: &'a Solid,
    /// Its density over that of the heavier material, model frame.
    pub field: &'a Order,
    /// The field as it was typed.
    pub field_words: &'a str,
    /// The printer.
    pub printer: &'a Printer,
    /// The ids of the two materials, in any order.
    pub materials: [&'a str; 2],
}

/// A reason why a model is not printed in two materials.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DitherError {
    /// The printer sets no drops.
    #[error(
        "{printer} does not set two materials side by side ({reason}); \
         remedy: choose a material-jetting printer, such as objet-connex350"
    )]
    NoJetting {
        /// The name of the printer.
        printer: String,
        /// What it does instead.
        reason: &'static str,
    },
    /// The layers have too many pixels.
    #[error(
        "the layers of the model of {} × {} × {} mm have {pixels_millions} million pixels each on \
         {printer}, and 100 million are the most; remedy: a smaller size",
        size_mm[0], size_mm[1], size_mm[2]
    )]
    TooManyPixels {
        /// The name of the printer.
        printer: String,
        /// The size of the model, rounded, mm.
        size_mm: [f64; 3],
        /// The pixels of a layer, rounded, millions.
        pixels_millions: f64,
    },
    /// The model is larger than the printer's room.
    #[error(
        "the model of {} × {} × {} mm is larger than {printer} prints ({} × {} × {} mm); remedy: a \
         smaller size",
        size_mm[0], size_mm[1], size_mm[2], room_mm[0], room_mm[1], room_mm[2]
    )]
    TooLarge {
        /// The name of the printer.
        printer: String,
        /// The size of the model, rounded, mm.
        size_mm: [f64; 3],
        /// The size of the printer's room, mm.
        room_mm: [f64; 3],
    },
    /// The printer's profile has one material.
    #[error(
        "the profile of {printer} has one material, {only}; remedy: make a profile of your own \
         from it, and add a [[material]] with its id, name and density_g_cm3"
    )]
    OneMaterial {
        /// The printer's id.
        printer: String,
        /// The id of the material.
        only: String,
    },
    /// The printer has no such material.
    #[error(transparent)]
    Material(#[from] MaterialError),
    /// Both materials weigh the same.
    #[error(
        "{} and {} have the same density, {density_g_cm3} g/cm³; \
         remedy: name two materials of different density", ids[0], ids[1]
    )]
    SameDensity {
        /// The ids of the materials.
        ids: [String; 2],
        /// Their density, g/cm³.
        density_g_cm3: f64,
    },
    /// The field asks for a density that the materials do not have.
    #[error(
        "the field is {value:.4} at ({:.2}, {:.2}, {:.2}) mm, and these materials print from \
         {least:.4} to 1 of the heavier one; remedy: scale the field into that range",
        at.x, at.y, at.z
    )]
    Beyond {
        /// The place, model coordinates, mm.
        at: Point,
        /// The value there.
        value: f64,
        /// The density of the lighter material over that of the heavier one.
        least: f64,
    },
    /// Parts are enlarged for shrinkage, which bitmaps are not.
    #[error(
        "the profile of {0} leaves shrinkage to this program, and bitmaps are of nominal size; \
         remedy: let the machine compensate shrinkage, and say so in the profile"
    )]
    Shrinks(String),
}

impl<'a> DitherOrder<'a> {
    /// Returns the heavier and the lighter material.
    ///
    /// # Errors
    /// The printer cannot set two materials, or has not these two of different density.
    pub(super) fn pair(&self) -> Result<[&'a Material; 2], DitherError> {
        let printer = self.printer;
        let reason = if printer.grid != Grid::Pixel {
            Some("it lays lines")
        } else if printer.process.as_deref() != Some(JETTING) {
            Some("it prints one material at a time")
        } else {
            None
        };
        if let Some(reason) = reason {
            return Err(DitherError::NoJetting {
                printer: printer.name.clone(),
                reason,
            });
        }
        if let [only] = printer.materials.as_slice() {
            return Err(DitherError::OneMaterial {
                printer: printer.id.clone(),
                only: only.id.clone(),
            });
        }
        if printer
            .print_scale_ratio()
            .iter()
            .any(|ratio| *ratio != 1.0)
        {
            return Err(DitherError::Shrinks(printer.id.clone()));
        }
        let [first, second] = self.materials.map(|id| printer.material(Some(id)));
        let (first, second) = (first?, second?);
        let [a, b] = [first, second].map(|material| material.density_g_cm3.value);
        if a == b {
            return Err(DitherError::SameDensity {
                ids: self.materials.map(str::to_owned),
                density_g_cm3: a,
            });
        }
        Ok(if a > b {
            [first, second]
        } else {
            [second, first]
        })
    }
}
