//! Junctures as they were written: each in one part, or in several that are glued together.

use super::super::error::TelescopeRunError;
use rayon::prelude::*;

use super::super::made::{Printing, WrittenFile};
use super::super::poses::Laid;
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

    /// Returns the number of parts with ids on their cut faces.
    fn numbered(&self) -> usize {
        self.division.as_ref().map_or(0, |_| self.parts.len())
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
    // Few are divided. The ids on their cut faces count on through all of them.
    let mut written: Vec<WrittenJuncture> = Vec::new();
    let mut numbered = 0;
    for (index, solid) in solids.iter().enumerate() {
        let own = writer.write(index, solid, numbered)?;
        numbered += own.numbered();
        written.push(own);
    }
    Ok(written)
}

/// The writer of junctures.
struct JunctureWriter<'a> {
    workshop: &'a Workshop<'a>,
    tree: &'a Tree<'a>,
}

impl JunctureWriter<'_> {
    /// Writes a juncture that lies as is usual. One that does not fit so is divided, if it can be;
    /// `numbered` parts have ids before.
    fn write(
        &self,
        index: usize,
        solid: &Solid,
        numbered: usize,
    ) -> Result<WrittenJuncture, TelescopeRunError> {
        let id = format!("N{:02}", index + 1);
        let laid = self
            .workshop
            .lay(solid.mesh(), &self.workshop.down(self.tree, index));
        let divided = match self.workshop.has_room(solid.mesh(), &laid) {
            true => None,
            false => {
                let divider = Divider {
                    workshop: self.workshop,
                    tree: self.tree,
                };
                divider.divide(index, solid, numbered)?
            }
        };
        match divided {
            None => self.write_whole(id, &laid, solid),
            Some(divided) => self.write_divided(id, solid, divided, numbered),
        }
    }

    fn write_whole(
        &self,
        id: String,
        laid: &Laid,
        solid: &Solid,
    ) -> Result<WrittenJuncture, TelescopeRunError> {
        let printing = Printing {
            shop: self.workshop.shop,
            watch: self.workshop.watch,
        };
        let name = format!("{}_{id}", self.workshop.job.name());
        let WrittenFile {
            file,
            bytes,
            read_back,
        } = printing.write(&name, laid, solid)?;
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
        })
    }

    fn write_divided(
        &self,
        id: String,
        solid: &Solid,
        divided: Divided,
        numbered: usize,
    ) -> Result<WrittenJuncture, TelescopeRunError> {
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
        })
    }
}
