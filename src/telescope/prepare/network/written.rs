//! Junctures as they were written: each in one part, or in several that are glued together.

use rayon::prelude::*;

use super::super::error::TelescopeRunError;
use super::super::made::{Printing, WrittenFile};
use super::bodies::{body, body_of_model};
use super::divide::{Divided, Divider};
use super::made::{Form, Workshop};
use super::tree::Tree;
use crate::base::watch::Phase;
use crate::cut::{CutPlan, Part, PartId};
use crate::make::write;
use crate::mesh::{ClipError, Solid, TriMesh};
use crate::verify::{PartEvidence, Pose};

/// A juncture as it was written.
pub struct WrittenJuncture {
    pub id: String,
    /// Its parts; one if it is not cut.
    pub parts: Vec<WrittenPiece>,
    /// The cuts between its parts.
    pub division: Option<Division>,
    /// Its body before it was cut.
    solid: Solid,
}

/// The cuts between the parts of a juncture.
pub struct Division {
    pub plan: CutPlan,
    /// Its volume before it was cut, mm³.
    pub volume_mm3: f64,
}

/// A part of a juncture as it was written.
pub struct WrittenPiece {
    pub id: String,
    /// The way it lies, in words.
    pub lies: String,
    /// Model frame, with all out, to print frame.
    pub pose: Pose,
    pub file: String,
    pub bytes: Vec<u8>,
    /// The triangles read back, in print pose, in the part's own size.
    pub read_back: TriMesh,
    /// The part with its pins and sockets; `None` for a juncture in one part.
    pub cut: Option<Part>,
}

impl WrittenJuncture {
    /// Returns the mesh where it is when all is out, as the files hold it.
    pub fn in_model(&self) -> TriMesh {
        let parts = self.parts.iter().map(WrittenPiece::in_model);
        parts.fold(TriMesh::default(), |all, part| all.joined(&part))
    }

    /// Returns the parts as the judge reads them.
    pub fn evidence(&self) -> Vec<PartEvidence> {
        let parts = self.parts.iter().map(|part| PartEvidence {
            id: part.id.clone(),
            mesh: part.read_back.clone(),
            inner: Vec::new(),
            pose: part.pose,
        });
        parts.collect()
    }
}

impl WrittenPiece {
    /// Returns the mesh where it is when all is out, as the file holds it.
    pub fn in_model(&self) -> TriMesh {
        self.read_back.map_vertices(|p| self.pose.to_model(p))
    }
}

/// Makes and writes the junctures; `pieces` are those of the model.
pub fn junctures(
    workshop: &Workshop,
    tree: &Tree,
    pieces: &[TriMesh],
) -> Result<Vec<WrittenJuncture>, TelescopeRunError> {
    workshop.watch.enter(Phase::Parts);
    let count = 0..tree.network.junctures;
    let solids: Vec<Solid> = count
        .into_par_iter()
        .map(|juncture| match workshop.form {
            Form::Balls => body(tree, juncture, false),
            Form::Hulls => body(tree, juncture, true),
            Form::Model(_) => body_of_model(tree, juncture, &pieces[juncture]),
        })
        .collect::<Result<_, ClipError>>()?;
    let writer = JunctureWriter { workshop, tree };
    let written = solids.into_par_iter().enumerate();
    let written = written.map(|(index, solid)| writer.write_whole(index, solid));
    written.collect()
}

/// Divides the junctures for which the printer has no room, if they can be. The ids on their cut
/// faces count on through all of them.
pub fn divide(
    workshop: &Workshop,
    tree: &Tree,
    junctures: Vec<WrittenJuncture>,
) -> Result<Vec<WrittenJuncture>, TelescopeRunError> {
    let writer = JunctureWriter { workshop, tree };
    let divider = Divider { workshop, tree };
    let mut numbered = 0;
    let divide = |(index, own): (usize, WrittenJuncture)| {
        let size_mm: [f64; 3] = own.parts[0].read_back.aabb().size().into();
        if workshop.shop.printer.fits(size_mm) != Some(false) {
            return Ok(own);
        }
        let Some(divided) = divider.divide(index, &own.solid, numbered)? else {
            return Ok(own);
        };
        let own = writer.write_divided(own, divided, numbered)?;
        numbered += own.division.as_ref().map_or(0, |_| own.parts.len());
        Ok(own)
    };
    junctures.into_iter().enumerate().map(divide).collect()
}

/// The writer of junctures.
struct JunctureWriter<'a> {
    workshop: &'a Workshop<'a>,
    tree: &'a Tree<'a>,
}

impl JunctureWriter<'_> {
    /// Writes a juncture in one part, as is usual.
    fn write_whole(
        &self,
        index: usize,
        solid: Solid,
    ) -> Result<WrittenJuncture, TelescopeRunError> {
        let down = self.workshop.down(self.tree, index);
        let laid = self.workshop.lay(solid.mesh(), &down);
        let printing = Printing {
            shop: self.workshop.shop,
            watch: self.workshop.watch,
        };
        let id = format!("N{:02}", index + 1);
        let name = format!("{}_{id}", self.workshop.job.name());
        let WrittenFile {
            file,
            bytes,
            read_back,
        } = printing.write(&name, &laid, &solid)?;
        let whole = WrittenPiece {
            id: id.clone(),
            lies: laid.lies.words().to_owned(),
            pose: laid.pose,
            file,
            bytes,
            read_back,
            cut: None,
        };
        Ok(WrittenJuncture {
            id,
            parts: vec![whole],
            division: None,
            solid,
        })
    }

    /// Writes a juncture in the parts of its division.
    fn write_divided(
        &self,
        own: WrittenJuncture,
        divided: Divided,
        numbered: usize,
    ) -> Result<WrittenJuncture, TelescopeRunError> {
        let WrittenJuncture { id, solid, .. } = own;
        let is_whole = divided.plan.cuts.is_empty();
        let scale_ratio = self.workshop.shop.printer.print_scale_ratio();
        let parts = divided.parts.into_iter().enumerate().map(|(index, part)| {
            let own = PartId::of(numbered + index);
            let id = match is_whole {
                true => id.clone(),
                false => format!("{id}-{own}"),
            };
            let name = format!("{}_{id}", self.workshop.job.name());
            let written = write(part, &name, scale_ratio, self.workshop.watch)?;
            Ok(WrittenPiece {
                lies: written.part.pose.lies.to_string(),
                pose: Pose {
                    rows: written.part.pose.print_from_model,
                },
                id,
                file: written.file,
                bytes: written.bytes,
                read_back: written.read_back,
                cut: Some(written.part),
            })
        });
        let parts = parts.collect::<Result<_, TelescopeRunError>>()?;
        let division = (!is_whole).then(|| Division {
            plan: divided.plan,
            volume_mm3: solid.mesh().signed_volume_mm3(),
        });
        Ok(WrittenJuncture {
            id,
            parts,
            division,
            solid,
        })
    }
}
