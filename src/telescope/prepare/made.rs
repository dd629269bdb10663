//! The parts of a telescope as files: shells and caps, each in print pose, read back.

use rayon::prelude::*;

use super::asked::Asked;
use super::best::{Best, Reason, Refused};
use super::error::TelescopeRunError;
use super::footing::{both, choose_order};
use super::load_skeleton::Shop;
use super::nested::lay_nested;
use super::poses::{Laid, Lies, lay_cap, lay_shell};
use crate::base::units::MM3_PER_CM3;
use crate::base::verdict::Verdict;
use crate::base::watch::{Phase, Watch};
use crate::geom::{Frame, Point, Vector};
use crate::io::stl;
use crate::make::write_free_of_folds;
use crate::mass::{Moments, moments_of_mesh};
use crate::mesh::{Solid, TriMesh};
use crate::telescope::balance::DiscFoot;
use crate::telescope::error::TelescopeError;
use crate::telescope::nest::Telescope;
use crate::telescope::tube::TubeMass;
use crate::verify::{Pose, TelescopeBallast};

/// The kind of a part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PartKind {
    /// A tube.
    Shell,
    /// The disc with a spigot that closes a tube's tail.
    Cap,
}

/// A part as it was written.
pub struct WrittenPart {
    pub id: String,
    pub kind: PartKind,
    /// The shell that it is or closes, from 0.
    pub shell: usize,
    pub lies: Lies,
    /// Shell frame to print frame.
    pub pose: Pose,
    pub file: String,
    pub bytes: Vec<u8>,
    /// The triangles read back, in print pose, in the part's own size.
    pub read_back: TriMesh,
}

impl WrittenPart {
    /// Returns the mesh in its shell's frame, as the file holds it.
    pub fn in_shell(&self) -> TriMesh {
        self.read_back.map_vertices(|p| self.pose.to_model(p))
    }
}

/// The parts of a telescope.
pub struct Made {
    /// The beginning of the ids of its parts and joints.
    pub prefix: String,
    pub best: Best,
    pub foot: Option<DiscFoot>,
    /// The ballast in the foot.
    pub ballast: Vec<TelescopeBallast>,
    /// The shells and caps, a shell before its cap, the root first. What is printed in place has
    /// no caps.
    pub parts: Vec<WrittenPart>,
    /// Volume and centre of every shell with its cap as written, in the shell's frame. Ballast
    /// counts as a volume of the shells' material.
    pub masses: Vec<TubeMass>,
}

/// Makes and writes every part.
pub fn make(
    asked: &Asked,
    mut best: Best,
    watch: &Watch,
) -> Result<Verdict<Made, Refused>, TelescopeRunError> {
    watch.enter(Phase::Parts);
    let telescope = &best.design.telescope;
    let shells = 0..telescope.shells.len();
    let solids: Vec<ShellSolids> = shells
        .into_par_iter()
        .map(|shell| ShellSolids::make(telescope, shell))
        .collect::<Result<_, TelescopeError>>()?;
    watch.check()?;
    let drawn: Vec<TubeMass> = solids.iter().map(ShellSolids::weigh).collect();
    let base = match choose_order(asked, telescope, &best.design.opening, &drawn)? {
        Verdict::Found((opening, base)) => {
            best.design.opening = opening;
            base
        }
        Verdict::No(reason) => return Ok(refused(best, reason)),
    };
    let telescope = &best.design.telescope;
    let foot = base.as_ref().map(|base| base.foot);
    let ballast = base.map_or_else(Vec::new, |base| base.ballast);
    let solids = with_foot(telescope, solids, foot.as_ref())?;
    let nested = telescope.sizes.is_in_place();
    let writer = Writer {
        asked,
        telescope,
        nested: nested.then(|| lay_nested(telescope, solids[0].tube.mesh())),
        is_over_pocket: !ballast.is_empty(),
        watch,
    };
    let parts: Vec<WrittenPart> = solids
        .into_par_iter()
        .enumerate()
        .map(|(shell, solids)| writer.write(shell, &solids))
        .collect::<Result<Vec<Vec<WrittenPart>>, _>>()?
        .into_iter()
        .flatten()
        .collect();
    if let Some(reason) = too_large(asked, &parts) {
        return Ok(refused(best, reason));
    }
    let masses = parts.chunk_by(|a, b| a.shell == b.shell).map(|own| {
        let moments = own.iter().map(|part| moments_of_mesh(&part.in_shell()));
        let whole = moments.fold(Moments::default(), |sum, one| sum + one);
        mass_of(&whole)
    });
    let mut masses: Vec<TubeMass> = masses.collect();
    let density_g_mm3 = asked.shop.material.density_g_cm3.value / MM3_PER_CM3;
    for piece in &ballast {
        masses[0] = both(&masses[0], &mass_of(&piece.lump.moments(density_g_mm3)));
    }
    Ok(Verdict::Found(Made {
        prefix: asked.prefix.clone(),
        masses,
        foot,
        ballast,
        parts,
        best,
    }))
}

fn refused(best: Best, reason: Reason) -> Verdict<Made, Refused> {
    Verdict::No(Refused {
        reason,
        rows: best.rows,
    })
}

fn mass_of(moments: &Moments) -> TubeMass {
    TubeMass {
        volume_mm3: moments.volume(),
        centre: moments.centroid(),
    }
}

/// A shell as it is made: its tube, and its cap unless it is printed in place.
struct ShellSolids {
    tube: Solid,
    cap: Option<Solid>,
}

impl ShellSolids {
    fn make(telescope: &Telescope, shell: usize) -> Result<Self, TelescopeError> {
        let (tube, cap) = match telescope.sizes.is_in_place() {
            true => (telescope.nested_solid(shell, None)?, None),
            false => {
                let cap = telescope.cap_solid(shell)?;
                (telescope.shell_solid(shell)?, Some(cap))
            }
        };
        Ok(Self { tube, cap })
    }

    fn weigh(&self) -> TubeMass {
        let solids = [&self.tube].into_iter().chain(&self.cap);
        let moments = solids.map(|solid| moments_of_mesh(solid.mesh()));
        mass_of(&moments.fold(Moments::default(), |sum, one| sum + one))
    }
}

/// Returns the solids with the foot on the root's cap, or around a root that is printed in place.
fn with_foot(
    telescope: &Telescope,
    mut solids: Vec<ShellSolids>,
    foot: Option<&DiscFoot>,
) -> Result<Vec<ShellSolids>, TelescopeError> {
    if let (Some(foot), Some(root)) = (foot, solids.first_mut()) {
        match &mut root.cap {
            Some(cap) => *cap = telescope.foot_solid(foot)?,
            None => root.tube = telescope.nested_solid(0, Some(foot))?,
        }
    }
    Ok(solids)
}

struct Writer<'a> {
    asked: &'a Asked<'a>,
    telescope: &'a Telescope,
    /// How all shells lie that are printed in place.
    nested: Option<Laid>,
    /// True if there is a pocket under the foot.
    is_over_pocket: bool,
    watch: &'a Watch,
}

impl Writer<'_> {
    /// Writes a shell and its cap, if it has one.
    fn write(
        &self,
        shell: usize,
        solids: &ShellSolids,
    ) -> Result<Vec<WrittenPart>, TelescopeRunError> {
        let mesh = solids.tube.mesh();
        let steepest_rad = self.asked.steepest_rad();
        let alone = || lay_shell(self.telescope, shell, mesh, steepest_rad);
        let laid = self.nested.unwrap_or_else(alone);
        let mut written = vec![self.part(PartKind::Shell, shell, laid, &solids.tube)?];
        if let Some(cap) = &solids.cap {
            let laid = Laid {
                lies: match shell == 0 && self.is_over_pocket {
                    true => Lies::OverPocket,
                    false => Lies::OnTail,
                },
                ..lay_cap(self.telescope, shell, cap.mesh())
            };
            written.push(self.part(PartKind::Cap, shell, laid, cap)?);
        }
        Ok(written)
    }

    fn part(
        &self,
        kind: PartKind,
        shell: usize,
        laid: Laid,
        solid: &Solid,
    ) -> Result<WrittenPart, TelescopeRunError> {
        let letter = match kind {
            PartKind::Shell => 'S',
            PartKind::Cap => 'C',
        };
        let id = format!("{}{letter}{:02}", self.asked.prefix, shell + 1);
        let name = format!("{}_{id}", self.asked.job.name());
        let printing = Printing {
            shop: self.asked.shop,
            watch: self.watch,
        };
        let written = printing.write(&name, &laid, solid)?;
        Ok(WrittenPart {
            file: written.file,
            id,
            kind,
            shell,
            lies: laid.lies,
            pose: laid.pose,
            bytes: written.bytes,
            read_back: written.read_back,
        })
    }
}

/// A solid as it was written.
pub struct WrittenFile {
    pub file: String,
    pub bytes: Vec<u8>,
    /// The triangles read back, in print pose, in the part's own size.
    pub read_back: TriMesh,
}

/// A writer of parts for a printer.
pub struct Printing<'a> {
    pub shop: &'a Shop,
    pub watch: &'a Watch,
}

impl Printing<'_> {
    /// Writes a solid in print pose, in the size that is printed.
    pub fn write(
        &self,
        name: &str,
        laid: &Laid,
        solid: &Solid,
    ) -> Result<WrittenFile, TelescopeRunError> {
        self.watch.check()?;
        let scale = Vector::from(self.shop.printer.print_scale_ratio());
        let at = |p: &Point| laid.pose.to_print(p).coords.component_mul(&scale).into();
        let bytes = write_free_of_folds(&solid.mesh().map_vertices(at), name, self.watch)?;
        let read_back = stl::decode(&bytes)?;
        Ok(WrittenFile {
            file: format!("parts/{name}.stl"),
            bytes,
            read_back: read_back.map_vertices(|p| p.coords.component_div(&scale).into()),
        })
    }
}

/// Returns the first part that does not fit into the printer.
fn too_large(asked: &Asked, parts: &[WrittenPart]) -> Option<Reason> {
    parts.iter().find_map(|part| {
        let size_mm: [f64; 3] = part.read_back.aabb().size().into();
        let fits = asked.shop.printer.fits(size_mm);
        (fits == Some(false)).then(|| Reason::TooLarge {
            part: part.id.clone(),
            size_mm,
        })
    })
}

/// Returns the motion that lays a part from its file into its shell's frame.
pub fn from_print(pose: &Pose) -> Frame {
    let back = pose.rotation().transpose();
    Frame {
        origin: Point::from(-(back * pose.translation())),
        axes: back,
    }
}
