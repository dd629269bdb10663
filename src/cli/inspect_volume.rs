//! `equipoise inspect` of a volume mesh: its mass properties, its shapes, and what it samples.

use std::io::Write;
use std::path::PathBuf;

use super::args::{FieldChoice, InspectArgs};
use super::exit::Exit;
use super::field_facts::field_facts;
use super::usual::{density_g_cm3, size_hint};
use super::voice::Voice;
use super::volume_facts::{FieldSampling, VolumeFacts, volume_text};
use crate::field::{FileError, NotADensity, Order};
use crate::io::{ReadVolumeError, read_volume};
use crate::printer::{MaterialError, Printer, ProfileError};
use crate::tets::{Difference, Tets, TetsError};

/// A reason why a volume mesh cannot be inspected.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum InspectVolumeError {
    /// The file cannot be read.
    #[error(transparent)]
    Read(#[from] ReadVolumeError),
    /// An option that says nothing of a volume mesh.
    #[error("{option} is for surfaces, and {} is a volume mesh; remedy: leave it out", path.display())]
    ForSurfaces {
        /// The option, as it is typed.
        option: &'static str,
        /// The file.
        path: PathBuf,
    },
    /// An option that says nothing of a surface.
    #[error(
        "{option} is for volume meshes, and {} is a surface; remedy: leave it out, or name a .msh, \
         .vtk, .node or .ele file",
        path.display()
    )]
    ForVolumes {
        /// The option, as it is typed.
        option: &'static str,
        /// The file.
        path: PathBuf,
    },
    /// The surface of the mesh bounds no solid, so a field cannot be integrated over it.
    #[error(
        "parts of the mesh touch along {edges} edges only, first at ({:.3}, {:.3}, {:.3}) mm, so no \
         field can be integrated over it exactly; remedy: mesh the parts apart, or leave the field out",
        at[0], at[1], at[2]
    )]
    Contacts {
        /// Number of edges.
        edges: usize,
        /// The middle of the first, mm.
        at: [f64; 3],
    },
    /// The field is no density at a corner.
    #[error(transparent)]
    Sampled(#[from] TetsError),
    /// The field is no density somewhere in the mesh.
    #[error(transparent)]
    Field(#[from] NotADensity),
    /// The field's file cannot be used.
    #[error(transparent)]
    FieldFile(#[from] FileError),
    /// The printer's profile cannot be used.
    #[error(transparent)]
    Profile(#[from] ProfileError),
    /// The printer has no material.
    #[error(transparent)]
    Material(#[from] MaterialError),
    /// The standard output is closed.
    #[error("cannot write to the standard output")]
    Output(#[from] std::io::Error),
    /// The facts cannot be put into JSON.
    #[error("the facts cannot be written as JSON")]
    Json(#[from] serde_json::Error),
}

/// Writes the facts of a volume mesh to `out`.
pub(super) fn inspect_volume(
    args: &InspectArgs,
    voice: Voice,
    out: &mut dyn Write,
) -> Result<Exit, InspectVolumeError> {
    if let Some(option) = args.only_for_surfaces() {
        let path = args.model.clone();
        return Err(InspectVolumeError::ForSurfaces { option, path });
    }
    let order = args.field.as_ref().map(FieldChoice::order).transpose()?;
    let printer = args.printer.as_deref().map(Printer::find).transpose()?;
    let material_g_cm3 = density_g_cm3(printer.as_ref())?;
    let data = args.data.clone().unwrap_or_default();
    let mut volume = read_volume(&args.model, &data)?;
    let longest = volume.tets.aabb().size().max();
    volume.tets = volume.tets.scaled(args.scaling.scaling().factor(longest));
    let mut facts = VolumeFacts::of(&volume, material_g_cm3);
    facts.size_hint = size_hint(volume.tets.aabb().size().max());
    if let Some(order) = &order {
        let name = args.field.as_ref().map(ToString::to_string);
        facts.field = Some(sample(
            name.unwrap_or_default(),
            order,
            &volume.tets,
            material_g_cm3,
        )?);
    }
    if voice.json {
        writeln!(out, "{}", serde_json::to_string_pretty(&facts)?)?;
    } else if !voice.manner.quiet {
        write!(out, "{}", volume_text(&facts))?;
    }
    Ok(Exit::Kept)
}

/// Measures a field over the surface of a mesh, and what its corners tell of it.
fn sample(
    name: String,
    order: &Order,
    tets: &Tets,
    material_g_cm3: f64,
) -> Result<FieldSampling, InspectVolumeError> {
    let boundary = tets.boundary();
    let Some(solid) = boundary.solid() else {
        let contacts = boundary.contacts();
        let at = contacts.first().copied().unwrap_or_default();
        return Err(InspectVolumeError::Contacts {
            edges: contacts.len(),
            at: at.coords.into(),
        });
    };
    let (exact, moments) = field_facts(name, order, solid, material_g_cm3)?;
    let sampled = tets.sampled(order.on(solid).as_ref());
    let sampled = sampled?;
    Ok(FieldSampling {
        exact,
        sampling_error: Difference::between(&sampled.moments(), &moments).map(Into::into),
    })
}
