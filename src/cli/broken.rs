//! The picture of what keeps a model from being one solid body.

use std::path::{Path, PathBuf};

use super::flags::flag;
use super::new_files::{NewFileError, write_all};
use crate::base::setting::{Key, Setting};
use crate::base::watch::{Cancelled, Watch};
use crate::draw::PictureError;
use crate::mesh::{Broken, Defects, TriMesh};
use crate::page::{Place, draw_broken};
use crate::repair::NotOneBody;

/// The ending of a picture's file. Others are refused, so that no model is written over.
const PICTURE_ENDING: &str = "svg";

/// A reason why no picture was written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BrokenPictureError {
    /// The file has another ending.
    #[error(
        "{} is not the name of an SVG file; remedy: give a name that ends in .svg",
        .0.display()
    )]
    NotSvg(PathBuf),
    /// The picture cannot be drawn.
    #[error(transparent)]
    Draw(#[from] PictureError),
    /// The file exists already.
    #[error("{} exists; remedy: give another name, or move that file away", .0.display())]
    Exists(PathBuf),
    /// A file cannot be written.
    #[error(transparent)]
    File(#[from] NewFileError),
    /// The command was stopped.
    #[error(transparent)]
    Stopped(#[from] Cancelled),
}

/// Refuses a name that is not that of a new SVG file.
pub(super) fn check_name(path: &Path) -> Result<(), BrokenPictureError> {
    let ending = path.extension().and_then(|ending| ending.to_str());
    if !ending.is_some_and(|ending| ending.eq_ignore_ascii_case(PICTURE_ENDING)) {
        return Err(BrokenPictureError::NotSvg(path.to_owned()));
    }
    if path.exists() {
        return Err(BrokenPictureError::Exists(path.to_owned()));
    }
    Ok(())
}

/// Writes the picture of a mesh with what is broken in it in red, and these places with names.
pub(super) fn write_picture(
    path: &Path,
    mesh: &TriMesh,
    places: &[Place],
) -> Result<(), BrokenPictureError> {
    let broken = Broken::of(mesh, &Watch::silent())?;
    let svg = draw_broken(mesh, &broken, places)?;
    Ok(write_all([(path, &svg)])?)
}

/// Returns the places of what was refused, in the coordinates of the file, which this factor scales
/// to mm.
pub(super) fn places(
    defects: Option<&Defects>,
    bodies: Option<&NotOneBody>,
    scale_ratio: f64,
) -> Vec<Place> {
    let of_bodies = bodies.map(|why| places_of_bodies(why, scale_ratio));
    defects
        .map(places_of_defects)
        .or(of_bodies)
        .unwrap_or_default()
}

/// Returns a line that tells how to let a new surface be drawn; empty if that is of no use.
pub(super) fn redraw_hint(can_be_redrawn: bool) -> String {
    if !can_be_redrawn {
        return String::new();
    }
    let order = flag(&Setting::new(Key::Repair, "remesh"));
    format!("or let a new surface be drawn around it ({order})\n")
}

/// Returns the places that the defects list, in the coordinates of the file.
fn places_of_defects(defects: &Defects) -> Vec<Place> {
    let listed = defects.list().iter();
    let places = listed.flat_map(|defect| {
        defect.places.iter().map(|at| Place {
            words: defect.kind.name().to_owned(),
            at: *at,
        })
    });
    places.collect()
}

/// Returns the places of a model that is not one body, in the coordinates of the file, which this
/// factor scales to mm.
fn places_of_bodies(why: &NotOneBody, scale_ratio: f64) -> Vec<Place> {
    match why {
        NotOneBody::Crosses(crossings) => {
            let first = crossings.first.iter().map(|at| Place {
                at: at / scale_ratio,
                words: "crosses itself".to_owned(),
            });
            first.collect()
        }
        NotOneBody::SeveralShells(shells) => {
            let named = shells.iter().take(NotOneBody::MAX_LISTED);
            let places = named.map(|shell| Place {
                at: shell.center / scale_ratio,
                words: shell.role.to_string(),
            });
            places.collect()
        }
    }
}
