//! The parts of a network as files: those of every limb, and the junctures.

use super::super::error::TelescopeRunError;
use super::super::load_skeleton::{LoadedSkeleton, Shop};
use super::super::made::{Made, make};
use super::super::poses::{Laid, lay_juncture};
use super::ends::last;
use super::held::held;
use super::pieces::{NoPieces, pieces};
use super::skin::Skin;
use super::tree::Tree;
use crate::base::verdict::Verdict;
use crate::base::watch::Watch;
use crate::geom::{Vector, orthonormal_basis};
use crate::job::telescope::TelescopeJob;
use crate::mesh::TriMesh;

/// The shape of junctures.
#[derive(Clone, Copy)]
pub enum Form<'a> {
    Balls,
    Hulls,
    /// Pieces of the model with this surface.
    Model(&'a Skin<'a>),
}

impl<'a> Form<'a> {
    /// Returns the model's surface, if junctures keep it.
    pub fn skin(self) -> Option<&'a Skin<'a>> {
        match self {
            Self::Model(skin) => Some(skin),
            Self::Balls | Self::Hulls => None,
        }
    }
}

/// Everything for the making of a network.
pub struct Workshop<'a> {
    pub job: &'a TelescopeJob,
    pub shop: &'a Shop,
    pub loaded: &'a LoadedSkeleton,
    pub form: Form<'a>,
    pub watch: &'a Watch,
}

impl Workshop<'_> {
    /// Makes the parts of every limb; the answer may be that a limb cannot be printed.
    pub fn limbs(&self, tree: &Tree) -> Result<Verdict<Vec<Made>, Refused>, TelescopeRunError> {
        let mut all = Vec::new();
        for (index, (limb, designed)) in tree.network.limbs.iter().zip(&tree.limbs).enumerate() {
            let asked = designed.order.asked(self.shop, &prefix(&limb.id))?;
            match make(&asked, designed.best.clone(), self.watch)? {
                Verdict::Found(made) => match held(&made) {
                    None => all.push(made),
                    Some(why) => return Ok(Verdict::No(Refused { limb: index, why })),
                },
                Verdict::No(refused) => {
                    let why = refused.reason.to_string();
                    return Ok(Verdict::No(Refused { limb: index, why }));
                }
            }
        }
        Ok(Verdict::Found(all))
    }

    /// Cuts the model into the pieces of its junctures; there are none of other forms.
    pub fn pieces(&self, tree: &Tree) -> Result<Result<Vec<TriMesh>, NoPieces>, TelescopeRunError> {
        match self.form.skin() {
            Some(skin) => Ok(pieces(tree, skin, self.watch)?),
            None => Ok(Ok(Vec::new())),
        }
    }

    /// Lays a juncture with this direction down, or with another if it fits into the printer so.
    pub fn lay(&self, mesh: &TriMesh, down: &Vector) -> Laid {
        let (u, v) = orthonormal_basis(down);
        let fits = |laid: &Laid| self.has_room(mesh, laid);
        let others = [-down, u, -u, v, -v];
        let usual = lay_juncture(mesh, down);
        if fits(&usual) {
            return usual;
        }
        let mut laid = others.iter().map(|down| lay_juncture(mesh, down));
        laid.find(fits).unwrap_or(usual)
    }

    /// Returns whether the printer has room for a mesh that lies so.
    fn has_room(&self, mesh: &TriMesh, laid: &Laid) -> bool {
        let printed = mesh.map_vertices(|p| laid.pose.to_print(p));
        self.shop.printer.fits(printed.aabb().size().into()) != Some(false)
    }

    /// Returns the direction that points down in print: away from the peg, or the model's down.
    pub fn down(&self, tree: &Tree, juncture: usize) -> Vector {
        let mut limbs = tree.network.limbs.iter();
        let carrier = limbs.find(|limb| limb.to == juncture);
        carrier.map_or(-self.loaded.up, |limb| {
            last(&limb.telescope).1.axes.column(0).into()
        })
    }
}

/// A limb that cannot be printed, from 0, and why.
pub struct Refused {
    pub limb: usize,
    pub why: String,
}

/// Returns what the ids of a limb's parts begin with.
pub fn prefix(limb: &str) -> String {
    format!("{limb}-")
}
