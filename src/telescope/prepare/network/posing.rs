//! The poses of a network.

use super::super::error::TelescopeRunError;
use super::super::made::Made;
use super::super::posing::{Posed, Poser};
use super::super::unposed::Unposed;
use super::made::Workshop;
use super::sweep::{Bodies, Hit, Item};
use super::tree::Tree;
use crate::base::verdict::Verdict;

impl Hit {
    /// Words what meets.
    pub fn words(&self, tree: &Tree) -> String {
        let limb = |limb: usize| &tree.network.limbs[limb].id;
        let word = |item: &Item| match item {
            Item::Shell { limb: own, shell } => format!("{}-S{:02}", limb(*own), shell + 1),
            Item::Juncture(index) => format!("N{:02}", index + 1),
        };
        let [a, b] = [word(&self.items[0]), word(&self.items[1])];
        format!(
            "{a} and {b} run into each other when limb {} opens",
            limb(self.limb)
        )
    }
}

impl Workshop<'_> {
    /// Takes the poses of the job, with all bodies swept against each other.
    pub fn poses(
        &self,
        tree: &Tree,
        limbs: &[Made],
        bodies: &Bodies,
    ) -> Result<Verdict<Vec<Posed>, Unposed>, TelescopeRunError> {
        let names = tree.network.limbs.iter();
        let poser = Poser {
            job: self.job,
            network: &tree.network,
            joints: joints(limbs),
            tips: names
                .map(|limb| vec![limb.id.clone(), format!("N{:02}", limb.to + 1)])
                .collect(),
            watch: self.watch,
        };
        poser.poses(&|ways| {
            let found = bodies.sequence(ways, self.watch)?;
            Ok(found.map_err(|hit| hit.words(tree)))
        })
    }
}

/// Returns the ids of the joints of every limb.
pub fn joints(limbs: &[Made]) -> Vec<Vec<String>> {
    let ids = |made: &Made| {
        let joints = 0..made.best.design.telescope.joints.len();
        joints.map(|joint| made.joint_id(joint)).collect()
    };
    limbs.iter().map(ids).collect()
}
