//! Junctures as they were written: each in one part, or in several that are glued together.

use rayon::prelude::*;

use super::super::error::TelescopeRunError;
use super::super::made::{Printing, WrittenFile};
use super::bodies::{body, body_of_model};
use super::divide::{Divided, Divider};
use super::foot::Foot;
use super::made::{Form, Workshop};
use super::tree::Tree;
use crate::base::verdict::Verdict;
use crate::base::watch::Phase;
use crate::cut::{CutId, CutPlan, JointNote, Lie, Part, PartId};
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
    /// The reason why it stays whole though the printer has no room for it.
    pub undivided: Option<String>,
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

/// Makes and writes the junctures; `pieces` are those of the model. The first one has the foot.
pub fn junctures(
    workshop: &Workshop,
    tree: &Tree,
    pieces: &[TriMesh],
    foot: Option<&Foot>,
) -> Result<Vec<WrittenJuncture>, TelescopeRunError> {
    workshop.watch.enter(Phase::Parts);
    let count = 0..tree.network.junctures;
    let own_foot = |juncture: usize| foot.filter(|_| juncture == 0);
    let solids: Vec<Solid> = count
        .into_par_iter()
        .map(|juncture| match workshop.form {
            Form::Balls => body(tree, juncture, false, own_foot(juncture)),
            Form::Hulls => body(tree, juncture, true, own_foot(juncture)),
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
        let divided = divider.divide(index, &own.solid, numbered);
        let written = divided.and_then(|divided| match divided {
            Verdict::Found(divided) => {
                let written = writer.write_divided(&own, divided, numbered)?;
                Ok(Verdict::Found(written))
            }
            Verdict::No(why) => Ok(Verdict::No(why)),
        });
        // A juncture that cannot be cut stays whole, with a warning: the kit is made all the same.
        let written = match written {
            Err(error) if !error.is_stop() => Verdict::No(error.to_string()),
            other => other?,
        };
        let own = match written {
            Verdict::Found(own) => own,
            Verdict::No(why) => WrittenJuncture {
                undivided: Some(why),
                ..own
            },
        };
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
            undivided: None,
            solid,
        })
    }

    /// Writes a juncture in the parts of its division.
    fn write_divided(
        &self,
        whole: &WrittenJuncture,
        divided: Divided,
        numbered: usize,
    ) -> Result<WrittenJuncture, TelescopeRunError> {
        let WrittenJuncture { id, solid, .. } = whole;
        let is_whole = divided.plan.cuts.is_empty();
        let scale_ratio = self.workshop.shop.printer.print_scale_ratio();
        let name_of = |index: usize| match is_whole {
            true => id.clone(),
            false => format!("{id}-{}", PartId::of(numbered + index)),
        };
        let joints = &divided.plan.joints;
        let parts = divided.parts.into_iter().enumerate().map(|(index, part)| {
            let id = name_of(index);
            let name = format!("{}_{id}", self.workshop.job.name());
            let written = write(part, &name, scale_ratio, self.workshop.watch)?;
            Ok(WrittenPiece {
                lies: words(&written.part.pose.lies, &mates(joints, index, &name_of)),
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
            id: id.clone(),
            parts,
            division,
            undivided: None,
            solid: solid.clone(),
        })
    }
}

/// A part that another is glued to, in a cut.
struct Mate {
    cut: CutId,
    id: String,
}

/// Returns the parts that the one with this index is glued to.
fn mates(joints: &[JointNote], index: usize, name_of: &dyn Fn(usize) -> String) -> Vec<Mate> {
    let own = joints.iter().filter_map(|joint| {
        let [below, above] = joint.parts.map(|part| part.index());
        let other = match index {
            _ if index == below => above,
            _ if index == above => below,
            _ => return None,
        };
        Some(Mate {
            cut: joint.cut.clone(),
            id: name_of(other),
        })
    });
    own.collect()
}

/// Words the way in which a part lies: the shop knows its mates, not its cuts.
fn words(lies: &Lie, mates: &[Mate]) -> String {
    let face = |cut: &CutId| {
        let ids = mates.iter().filter(|mate| mate.cut == *cut);
        let ids: Vec<&str> = ids.map(|mate| mate.id.as_str()).collect();
        format!("the face glued to {}", ids.join(" and "))
    };
    match lies {
        Lie::CutFaceDown(cut) => format!("on {}", face(cut)),
        Lie::CutFaceUp(cut) => format!("{} up", face(cut)),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_lies_on_the_face_glued_to_its_mates() {
        let mate = |cut: usize, id: &str| Mate {
            cut: CutId::of(cut),
            id: id.to_owned(),
        };
        let mates = [mate(0, "N01-P02"), mate(1, "N01-P03"), mate(0, "N01-P04")];
        let down = words(&Lie::CutFaceDown(CutId::of(0)), &mates);
        assert_eq!(down, "on the face glued to N01-P02 and N01-P04");
        let up = words(&Lie::CutFaceUp(CutId::of(1)), &mates);
        assert_eq!(up, "the face glued to N01-P03 up");
        assert_eq!(words(&Lie::Upright, &mates), "upright");
    }
}
