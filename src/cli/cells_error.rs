//! The reasons why a model is not divided into cells.

use std::path::PathBuf;

use crate::base::numbers::quantity;
use crate::base::setting::{Key, Setting};
use crate::base::units::show_mm;
use crate::base::watch::Cancelled;
use crate::cells::{BodyError, MOST_SITES, SitesError};
use crate::comb::CombError;
use crate::draw::PictureError;
use crate::field::{FileError, NotADensity};
use crate::geom::Point;
use crate::io::{ReadError, SitesFileError};
use crate::kit::KitError;
use crate::mend::MendError;
use crate::mesh::Defects;
use crate::printer::{ProfileError, WallError};

/// The density of cells twice as large as their walls: 1 − (1 − 1/2)³.
const GREATEST_DENSITY: f64 = 0.875;
/// A reason why a model was not divided into cells.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CellsCommandError {
    /// A file cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The model cannot be mended.
    #[error("the model cannot be repaired")]
    Mend(#[from] Box<MendError>),
    /// The model is no solid.
    #[error("the model is no solid: {0}; remedy: see what can be done (`equipoise inspect`)")]
    NoSolid(Box<Defects>),
    /// A file of sites or axes cannot be used.
    #[error("{}: {source}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// The fault.
        source: SitesFileError,
    },
    /// Axes of a file lie on a line.
    #[error(
        "{}: line {line}: the two directions lie on one line; remedy: give the second another \
         direction",
        path.display()
    )]
    FlatAxes {
        /// The file.
        path: PathBuf,
        /// The line.
        line: usize,
    },
    /// The axis has no direction.
    #[error("the axis has no direction; remedy: give at least one coordinate that is not zero")]
    NoAxis,
    /// The sites of a file cannot be used.
    #[error("{}, {lines}: {source}", path.display())]
    Sites {
        /// The file.
        path: PathBuf,
        /// The lines, in words.
        lines: String,
        /// The fault.
        source: SitesError,
    },
    /// No first site was found.
    #[error(transparent)]
    NoSites(#[from] SitesError),
    /// The cells are smaller than two walls.
    #[error(
        "cells of {} have no room between walls of {}; remedy: give cells of {} at least, or a \
         thinner wall (`{}`)",
        show_mm(*size_mm),
        show_mm(*wall_mm),
        show_mm(2.0 * wall_mm),
        Setting::open(Key::Wall)
    )]
    NoRoom {
        /// The size of a cell, mm.
        size_mm: f64,
        /// The wall, mm.
        wall_mm: f64,
    },
    /// The cells are larger than the model.
    #[error(
        "cells of {} are larger than the model, whose longest side is {}; remedy: give smaller \
         cells, or the model's own size or unit (`{}`)",
        show_mm(*size_mm),
        show_mm(*longest_mm),
        Setting::open(Key::Unit)
    )]
    Larger {
        /// The size of a cell, mm.
        size_mm: f64,
        /// The longest side of the model, mm.
        longest_mm: f64,
    },
    /// There would be too many cells.
    #[error(
        "there would be {count:.0} cells, and {MOST_SITES} are the most; remedy: give cells of {} \
         or more",
        show_mm(*least_mm)
    )]
    TooMany {
        /// The number of cells.
        count: f64,
        /// The size at which there are as many as may be, mm.
        least_mm: f64,
    },
    /// Holes could open into a closed cavity in place of the outside.
    #[error(
        "the model has a closed cavity, and holes into it drain nothing; remedy: fill it in \
         the model, or leave the printer out"
    )]
    Hollow,
    /// No wall is known for a density.
    #[error(
        "a density is made by walls, and none is known; remedy: give a wall, such as `{}`, or a \
         printer (`{}`)",
        Setting::new(Key::Wall, "1mm"),
        Setting::open(Key::Printer)
    )]
    NoWall,
    /// No cells have the density at a place.
    #[error(
        "no cells between walls of {} have the density {density:.4} wished at ({:.2}, {:.2}, \
         {:.2}) mm; remedy: give densities from {} to {}",
        show_mm(*wall_mm),
        at.x,
        at.y,
        at.z,
        quantity(*least, ""),
        quantity(GREATEST_DENSITY, "")
    )]
    NoSuchCells {
        /// The place, mm.
        at: Point,
        /// The density there.
        density: f64,
        /// The density of the largest cells that fit.
        least: f64,
        /// The wall, mm.
        wall_mm: f64,
    },
    /// The field's file cannot be used.
    #[error(transparent)]
    FieldFile(#[from] FileError),
    /// The field is no density somewhere in the model.
    #[error(transparent)]
    Field(#[from] NotADensity),
    /// The printer's profile cannot be used.
    #[error(transparent)]
    Profile(#[from] ProfileError),
    /// The wall cannot be printed.
    #[error(transparent)]
    Wall(#[from] WallError),
    /// The printer's process empties no cells.
    #[error(
        "{printer} prints no closed cells: {why}; remedy: name a printer of resin, powder or wax, \
         or only a wall (`{}`) to divide the model without a print",
        Setting::new(Key::Wall, "1mm")
    )]
    Undrainable {
        /// The printer's id.
        printer: String,
        /// The reason.
        why: &'static str,
    },
    /// No cell drains.
    #[error(
        "none of {cells} cells drains: no wall or skin holds an opening of {}; remedy: give larger \
         cells, of {} at least",
        show_mm(*opening_mm),
        show_mm(*least_mm)
    )]
    NoneDrains {
        /// The number of cells.
        cells: usize,
        /// The opening, mm.
        opening_mm: f64,
        /// The least size of a cube that can have one, mm.
        least_mm: f64,
    },
    /// The print cannot be made.
    #[error(transparent)]
    Comb(#[from] CombError),
    /// A cell has no body.
    #[error(transparent)]
    Body(#[from] BodyError),
    /// A picture cannot be drawn.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// The folder cannot be written.
    #[error(transparent)]
    Kit(#[from] KitError),
    /// The command was stopped.
    #[error(transparent)]
    Stopped(#[from] Cancelled),
    /// The standard output is closed.
    #[error("cannot write to the standard output")]
    Output(#[from] std::io::Error),
    /// The facts cannot be put into JSON.
    #[error("the facts cannot be written as JSON")]
    Json(#[from] serde_json::Error),
}
