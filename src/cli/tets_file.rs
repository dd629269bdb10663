//! Writes a volume mesh of a solid whose density varies, for simulation.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use serde::Serialize;

use super::args::TetsArgs;
use super::field_facts::share;
use super::mass_facts::plain;
use super::new_files::{NewFileError, write_all};
use super::volume_facts::{ErrorFacts, error_text};
use crate::base::setting::{Key, Setting};
use crate::base::units::Length;
use crate::field::Density;
use crate::io::{ContentError, decode_model, encode_msh, encode_vtk};
use crate::job::{Interior, Job, PartFormat};
use crate::mass::{Moments, moments_of_mesh};
use crate::mesh::{Defects, Solid, TriMesh};
use crate::prepare::Prepared;
use crate::printer::{Printer, ProfileError};
use crate::repair::weld;
use crate::tets::{
    Densities, Difference, NestedDensity, Quality, StuffingError, Tets, TetsError, stuff,
};
use crate::verify::InfillLevel;

/// Edges along the longest side, unless their length is ordered.
const EDGES: f64 = 40.0;

/// A reason why no volume mesh is written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TetsFileError {
    /// The name has another ending.
    #[error("{} ends neither in .msh nor in .vtk; remedy: name such a file", .0.display())]
    Name(PathBuf),
    /// The file exists.
    #[error("{} exists; remedy: name another file, or remove it first", .0.display())]
    Exists(PathBuf),
    /// There is no field.
    #[error(
        "a volume mesh is written with the densities of a field, and none is given; remedy: give \
         one too, such as uniform:100%"
    )]
    NoField,
    /// The print is hollow.
    #[error(
        "a volume mesh has the densities of a graded print, and this one is hollow; remedy: \
         order `{}`, or mesh a part of the kit",
        Setting::new(Key::Interior, Interior::Graded)
    )]
    Hollow,
    /// The regions of infill are in packages only.
    #[error(
        "the regions of infill have no STL files; remedy: order `{}`",
        Setting::new(Key::Format, PartFormat::Both)
    )]
    OnlyPackages,
    /// A file of the kit cannot be read back.
    #[error("{file} of the kit cannot be read back")]
    Content {
        /// The file.
        file: String,
        /// The fault.
        source: ContentError,
    },
    /// The surface of the print bounds no solid.
    #[error("the surface of the print bounds no solid")]
    NotSolid(#[from] Defects),
    /// The printer's profile cannot be used.
    #[error(transparent)]
    Profile(#[from] ProfileError),
    /// The edges are too short or too long.
    #[error(transparent)]
    Edge(#[from] StuffingError),
    /// The tetrahedra fill no solid, or a value is no density.
    #[error("the solid cannot be filled with tetrahedra of this edge; remedy: order another edge")]
    Mesh(#[from] TetsError),
    /// The file cannot be written.
    #[error(transparent)]
    File(#[from] NewFileError),
}

/// A volume mesh that was written.
#[derive(Debug, Serialize)]
pub(super) struct WrittenTets {
    file: PathBuf,
    tetrahedra: usize,
    /// True if each corner has a density, false if each tetrahedron has one.
    is_at_corners: bool,
    edge_mm: f64,
    least_angle_deg: f64,
    /// Error of the volume, as a share of the solid's.
    volume_error_ratio: f64,
    /// Error of mass, centre and moments; `None` without mass.
    error: Option<ErrorFacts>,
}

/// The exact values that a volume mesh is held against.
struct Exact {
    volume_mm3: f64,
    moments: Moments,
}

/// Checks the name of the file before anything is done.
///
/// # Errors
/// It has another ending, or it exists and may not be replaced.
fn check_file(path: &Path, may_replace: bool) -> Result<(), TetsFileError> {
    if !["msh", "vtk"].contains(&ending(path).as_str()) {
        return Err(TetsFileError::Name(path.to_owned()));
    }
    if path.exists() && !may_replace {
        return Err(TetsFileError::Exists(path.to_owned()));
    }
    Ok(())
}

/// Checks an order of `inspect` before anything is done.
///
/// # Errors
/// The file's name, or an order without a field.
pub(super) fn check_sampled(order: &TetsArgs, has_field: bool) -> Result<(), TetsFileError> {
    let Some(path) = &order.tets else {
        return Ok(());
    };
    check_file(path, false)?;
    match has_field {
        true => Ok(()),
        false => Err(TetsFileError::NoField),
    }
}

fn ending(path: &Path) -> String {
    let ending = path.extension().and_then(OsStr::to_str);
    ending.unwrap_or_default().to_ascii_lowercase()
}

/// Checks an order of `prepare` before anything is done.
///
/// # Errors
/// The file's name, or a print without densities.
pub(super) fn check_graded(path: &Path, job: &Job, may_replace: bool) -> Result<(), TetsFileError> {
    check_file(path, may_replace)?;
    if job.interior != Interior::Graded {
        return Err(TetsFileError::Hollow);
    }
    if job.format == PartFormat::ThreeMf {
        return Err(TetsFileError::OnlyPackages);
    }
    Ok(())
}

/// Fills a solid, samples a field at the corners and writes both; `exact` are the field's moments.
pub(super) fn write_sampled(
    order: &TetsArgs,
    solid: &Solid,
    field: &dyn Density,
    exact: Moments,
) -> Result<Option<WrittenTets>, TetsFileError> {
    let Some(path) = &order.tets else {
        return Ok(None);
    };
    let (edge_mm, tets) = filled(order, solid)?;
    let exact = Exact {
        volume_mm3: moments_of_mesh(solid.mesh()).volume(),
        moments: exact,
    };
    write(path, edge_mm, &tets.sampled(field)?, &exact).map(Some)
}

/// Fills the part of a graded print with the densities of its regions, in the model's axes.
pub(super) fn write_graded(
    order: &TetsArgs,
    job: &Job,
    prepared: &Prepared,
) -> Result<Option<WrittenTets>, TetsFileError> {
    let Some(path) = &order.tets else {
        return Ok(None);
    };
    let (Some(infill), [part, ..]) = (&prepared.checklist.infill, &prepared.checklist.parts[..])
    else {
        return Err(TetsFileError::Hollow);
    };
    let scale = Printer::find(&job.printer.id)?.print_scale_ratio();
    let in_model = |file: &str| -> Result<TriMesh, TetsFileError> {
        let mut files = prepared.kit.files();
        let bytes = files
            .find(|(name, _)| *name == file)
            .map(|(_, bytes)| bytes);
        let mesh = decode_model(bytes.unwrap_or_default());
        let mesh = mesh.map_err(|source| TetsFileError::Content {
            file: file.to_owned(),
            source,
        })?;
        let unscaled = weld(&mesh).map_vertices(|at| {
            let mut at = *at;
            (0..3).for_each(|axis| at[axis] /= scale[axis]);
            part.print_from_model.to_model(&at)
        });
        Ok(unscaled)
    };
    let solid = Solid::new(in_model(&part.file)?)?;
    let region = |level: InfillLevel| {
        let file = level.file.ok_or(TetsFileError::OnlyPackages)?;
        Ok((in_model(&file)?, level.laid_ratio))
    };
    let regions: Result<Vec<_>, TetsFileError> = infill.levels().into_iter().map(region).collect();
    let density = NestedDensity::new(1.0, &regions?);
    let body = moments_of_mesh(solid.mesh());
    let exact = Exact {
        volume_mm3: body.volume(),
        moments: density.moments(&body),
    };
    let (edge_mm, tets) = filled(order, &solid)?;
    write(path, edge_mm, &density.on(&tets), &exact).map(Some)
}

/// Fills a solid with tetrahedra; returns their edge, mm, too.
fn filled(order: &TetsArgs, solid: &Solid) -> Result<(f64, Tets), TetsFileError> {
    let plain_mm = solid.mesh().longest_side_mm() / EDGES;
    let edge_mm = order.tets_edge.map_or(plain_mm, Length::mm);
    let tets = Tets::new(stuff(solid, edge_mm)?)?;
    Ok((edge_mm, tets))
}

fn write(
    path: &Path,
    edge_mm: f64,
    tets: &Tets,
    exact: &Exact,
) -> Result<WrittenTets, TetsFileError> {
    let text = match ending(path).as_str() {
        "vtk" => encode_vtk(tets),
        _ => encode_msh(tets),
    };
    write_all([(path, &text)])?;
    let difference = Difference::between(&tets.moments(), &exact.moments);
    Ok(WrittenTets {
        file: path.to_owned(),
        tetrahedra: tets.cells().len(),
        is_at_corners: matches!(tets.densities(), Densities::Corners(_)),
        edge_mm,
        least_angle_deg: Quality::of(tets).least_angle_deg,
        volume_error_ratio: (tets.solid_moments().volume() / exact.volume_mm3 - 1.0).abs(),
        error: difference.map(Into::into),
    })
}

/// Returns in words what was written, and how far it is off.
pub(super) fn written_text(written: &WrittenTets) -> String {
    let on = match written.is_at_corners {
        true => "at each corner",
        false => "in each tetrahedron",
    };
    let error = written
        .error
        .as_ref()
        .map_or(String::new(), |error| format!(", {}", error_text(error)));
    format!(
        "{}: {} tetrahedra of edges of about {}, least angle {}, with a density {on}\n\
         it is an approximation: off by {} of the volume{error}\n",
        written.file.display(),
        written.tetrahedra,
        plain(written.edge_mm, "mm"),
        plain(written.least_angle_deg, "°"),
        share(written.volume_error_ratio),
    )
}
