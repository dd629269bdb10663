//! The network of a skeleton: which limbs become telescopes, and which stay solid.

use super::super::error::TelescopeRunError;
use super::limb::{Designed, Studio};
use super::plan::{Ground, Planned, plan};
use crate::base::verdict::Verdict;
use crate::base::watch::Phase;
use crate::skeleton::{Chain, Limbs, NotATree, ShellSizes, Skeleton, StaysSolid};
use crate::telescope::nest::Telescope;
use crate::telescope::network::{Limb, Network};

/// Walls that are left between two roots in one juncture at least.
const APART_WALLS: f64 = 0.5;
/// Share to which a limb is shortened if nothing follows it, and how often.
const SHORTENED: f64 = 0.8;
const MOST_SHORTENED: usize = 3;
/// Points of a root's axis that are looked at.
const STATIONS: usize = 24;

/// A limb that stays solid, and why.
#[derive(Debug, Clone, PartialEq)]
pub struct Kept {
    /// The numbers of the nodes at its ends.
    pub ends: [u32; 2],
    /// The reason, in words.
    pub why: String,
}

/// Telescopes and junctures of a skeleton.
pub struct Tree<'a> {
    pub skeleton: &'a Skeleton,
    pub network: Network,
    /// The limbs with their orders, in the order of the network's.
    pub limbs: Vec<Designed>,
    /// The nodes of every juncture.
    pub nodes: Vec<Vec<usize>>,
    /// Of every juncture, the nodes of the limb that carries it from its mouth on.
    pub beyond: Vec<Vec<usize>>,
    /// Of every limb, the nodes before its root's collar.
    pub before: Vec<Vec<usize>>,
    /// Wall of the shells, mm.
    pub wall_mm: f64,
}

/// The search for limbs.
pub struct Search<'a> {
    pub studio: &'a Studio<'a>,
    pub sizes: ShellSizes,
    /// The skeleton with the branches marked that stay solid.
    pub skeleton: Skeleton,
    /// The branches that were found to stay solid.
    pub kept: Vec<Kept>,
    /// Limbs that end earlier than their skeleton, each by its nodes and where it ends, mm.
    pub ends: Vec<(Vec<usize>, f64)>,
    /// The places where limbs end in the model, mm, as found before.
    pub cut_ends: Vec<(Chain, f64)>,
    /// Limbs that were designed before, with how they were planned.
    pub known: Vec<(Planned, Designed)>,
}

/// The limbs of a round, as they were found.
pub struct Round {
    limbs: Limbs,
    plans: Vec<Planned>,
}

impl Search<'_> {
    /// Returns the limbs that can be made, `None` if there are none.
    pub fn find(&mut self) -> Result<Result<Option<Round>, NotATree>, TelescopeRunError> {
        self.studio.watch.enter(Phase::Solve);
        loop {
            self.studio.watch.check()?;
            let mut limbs = match Limbs::of(&self.skeleton, &self.sizes) {
                Ok(limbs) => limbs,
                Err(rings) => return Ok(Err(rings)),
            };
            self.end_in_model(&mut limbs);
            for chain in &mut limbs.chains {
                let own = self
                    .ends
                    .iter()
                    .rev()
                    .find(|(nodes, _)| *nodes == chain.nodes);
                chain.end_mm = own.map_or(chain.end_mm, |(_, end_mm)| *end_mm);
            }
            if limbs.chains.is_empty() {
                return Ok(Ok(None));
            }
            let ground = Ground {
                skeleton: &self.skeleton,
                measures: &self.studio.measures,
                skin: self.studio.skin,
            };
            match plan(&limbs, &ground) {
                Err((index, why)) => self.keep(&limbs.chains[index].nodes, why),
                Ok(plans) => {
                    if self.design(&limbs, &plans)? {
                        return Ok(Ok(Some(Round { limbs, plans })));
                    }
                }
            }
        }
    }

    /// Ends limbs where the model is to be cut, if junctures keep its surface.
    fn end_in_model(&mut self, limbs: &mut Limbs) {
        let Some(skin) = self.studio.skin else { return };
        for chain in &mut limbs.chains {
            let mut known = self.cut_ends.iter();
            let known = known.find(|(own, _)| own == chain).map(|(_, end)| *end);
            let end_mm = known.unwrap_or_else(|| {
                let found = skin.end_mm(chain, &self.skeleton);
                // A branch that can be cut nowhere is refused when its root is placed.
                let end_mm = found.unwrap_or(chain.end_mm);
                self.cut_ends.push((chain.clone(), end_mm));
                end_mm
            });
            chain.end_mm = end_mm;
        }
    }

    /// Keeps the limb along these nodes solid.
    pub fn keep(&mut self, nodes: &[usize], why: String) {
        let is_of = |branch: &crate::skeleton::Branch| {
            let link = [nodes[0], nodes[1]];
            let mut links = branch.nodes.windows(2);
            links.any(|pair| pair == link || [pair[1], pair[0]] == link)
        };
        for branch in self
            .skeleton
            .branches
            .iter_mut()
            .filter(|branch| is_of(branch))
        {
            branch.solid = Some(StaysSolid::Ordered);
        }
        let ends = [nodes[0], nodes[nodes.len() - 1]].map(|node| self.skeleton.nodes[node].id);
        self.kept.push(Kept { ends, why });
    }

    /// Designs every limb that is not known; false if one of them is kept solid instead.
    fn design(&mut self, limbs: &Limbs, plans: &[Planned]) -> Result<bool, TelescopeRunError> {
        for (chain, planned) in limbs.chains.iter().zip(plans) {
            if self.known.iter().any(|(known, _)| known == planned) {
                continue;
            }
            match self.studio.design(chain, planned)? {
                Verdict::Found(designed) => self.known.push((planned.clone(), designed)),
                Verdict::No(why) => {
                    if !self.shorten(chain) {
                        self.keep(&chain.nodes, why);
                    }
                    return Ok(false);
                }
            }
        }
        if let Some((index, why)) = self.crowded(limbs, plans) {
            self.keep(&limbs.chains[index].nodes, why);
            return Ok(false);
        }
        Ok(true)
    }

    /// Lets the limb of a round end earlier, as [`Self::shorten`] does.
    pub fn shorten_limb(&mut self, round: &Round, limb: usize) -> bool {
        self.shorten(&round.limbs.chains[limb])
    }

    /// Lets a limb end earlier; what bends at its end, as a foot does, stays solid. It is false if
    /// it would be too short.
    fn shorten(&mut self, chain: &Chain) -> bool {
        let times = self
            .ends
            .iter()
            .filter(|(nodes, _)| *nodes == chain.nodes)
            .count();
        let is_long = times < MOST_SHORTENED;
        if is_long {
            let end_mm = chain.start_mm + SHORTENED * chain.free_mm();
            self.ends.push((chain.nodes.clone(), end_mm));
        }
        is_long
    }

    fn designed(&self, planned: &Planned) -> Option<&Designed> {
        let mut known = self.known.iter();
        known
            .find(|(known, _)| known == planned)
            .map(|(_, designed)| designed)
    }

    /// Returns the thinner of two limbs whose roots are too near in their juncture.
    fn crowded(&self, limbs: &Limbs, plans: &[Planned]) -> Option<(usize, String)> {
        let roots = plans
            .iter()
            .map(|planned| Some(root(self.designed(planned)?)));
        let roots: Vec<(Vec<crate::geom::Point>, f64)> = roots.collect::<Option<_>>()?;
        let needed_mm = APART_WALLS * self.studio.measures.least.wall_mm;
        let pairs = (0..roots.len()).flat_map(|i| (i + 1..roots.len()).map(move |j| [i, j]));
        let mut together = pairs.filter(|[i, j]| limbs.chains[*i].from == limbs.chains[*j].from);
        together.find_map(|[i, j]| {
            let (a, b) = (&roots[i], &roots[j]);
            let near =
                a.0.iter()
                    .flat_map(|p| b.0.iter().map(move |q| (p - q).norm()));
            let gap_mm = near.fold(f64::INFINITY, f64::min) - a.1 - b.1;
            let thinner = if a.1 < b.1 { i } else { j };
            let why = "its root meets another in their juncture".to_owned();
            (gap_mm < needed_mm).then_some((thinner, why))
        })
    }

    /// Puts the network of a round together.
    pub fn tree<'a>(&self, round: &Round, skeleton: &'a Skeleton) -> Option<Tree<'a>> {
        let Round { limbs, plans } = round;
        let tips = limbs
            .chains
            .iter()
            .filter(|chain| chain.to.is_none())
            .count();
        let mut tree = Tree {
            skeleton,
            network: Network {
                junctures: limbs.junctures.len() + tips,
                limbs: Vec::new(),
            },
            limbs: Vec::new(),
            nodes: limbs.junctures.iter().map(|j| j.nodes.clone()).collect(),
            beyond: vec![Vec::new(); limbs.junctures.len() + tips],
            before: Vec::new(),
            wall_mm: self.studio.measures.least.wall_mm,
        };
        for (index, (chain, planned)) in limbs.chains.iter().zip(plans).enumerate() {
            let designed = self.designed(planned)?;
            let telescope = designed.best.design.telescope.clone();
            let to = chain.to.unwrap_or_else(|| {
                tree.nodes.push(Vec::new());
                tree.nodes.len() - 1
            });
            let end_mm = chain.end_mm + 0.5 * telescope.sizes.overlap_mm();
            tree.beyond[to] = nodes_between(chain, [end_mm, f64::INFINITY]);
            let start_mm = planned.from_mm.max(chain.start_mm);
            tree.before
                .push(nodes_between(chain, [f64::NEG_INFINITY, start_mm]));
            tree.network.limbs.push(Limb {
                id: name(index),
                from: chain.from,
                to,
                opening: designed.best.design.opening.clone(),
                telescope,
            });
            tree.limbs.push(designed.clone());
        }
        Some(tree)
    }

    /// Returns the nodes of the limb of a round, counted from 0.
    pub fn nodes_of(round: &Round, limb: usize) -> &[usize] {
        &round.limbs.chains[limb].nodes
    }
}

/// Returns the nodes of a limb at arc lengths within these, mm.
fn nodes_between(chain: &Chain, [from_mm, to_mm]: [f64; 2]) -> Vec<usize> {
    let arcs = chain.arcs_mm();
    let nodes = chain.nodes.iter().zip(arcs);
    let nodes = nodes.filter(|(_, arc)| *arc >= from_mm && *arc <= to_mm);
    nodes.map(|(node, _)| *node).collect()
}

/// Returns points of a root's axis from tail to mouth, and its radius.
fn root(designed: &Designed) -> (Vec<crate::geom::Point>, f64) {
    let telescope: &Telescope = &designed.best.design.telescope;
    let [tail_mm, mouth_mm] = telescope.ends_mm();
    let helix = &telescope.shells[0].helix;
    let at = |i: usize| {
        let arc_mm = tail_mm + (mouth_mm - tail_mm) * i as f64 / STATIONS as f64;
        telescope.start.to_model(&helix.frame_at(arc_mm).origin)
    };
    let radius_mm = telescope.shells[0].body_mm + telescope.sizes.glue_mm;
    ((0..=STATIONS).map(at).collect(), radius_mm)
}

/// Returns the name of a limb, from 0: A to Z, then A2 and on.
fn name(index: usize) -> String {
    let letter = char::from(b'A' + (index % 26) as u8);
    match index / 26 {
        0 => letter.to_string(),
        round => format!("{letter}{}", round + 1),
    }
}
