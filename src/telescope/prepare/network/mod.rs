//! The line from a skeleton to the kit of several telescopes: plan, design, make, sweep, judge.
//!
//! Every limb is a telescope of its own, as along a curve. Its root is glued into the socket of the
//! juncture it grows from, and its last shell carries the next juncture on a peg. A limb that
//! cannot be made stays solid, and the search begins again without it.

mod along;
mod bodies;
mod divide;
mod draft;
mod ends;
mod film;
mod foot;
mod footing;
mod held;
mod limb;
mod made;
mod papers;
mod pieces;
mod plan;
mod posing;
mod rows;
mod skin;
mod sweep;
mod tree;
mod written;

use self::draft::{MadeNetwork, draft};
use self::foot::{Falls, Foot, StoodFoot};
use self::footing::{Footing, masses};
use self::limb::Studio;
use self::made::{Form, Workshop};
use self::plan::Measures;
use self::skin::Skin;
use self::sweep::{Bodies, Hit, Item};
use self::tree::{Kept, Search, Tree};
use self::written::{WrittenJuncture, divide, junctures};
use super::advise::Tried;
use super::asked::basics;
use super::error::TelescopeRunError;
use super::load_skeleton::{LoadedSkeleton, Shop};
use super::made::Made;
use super::unposed::Unposed;
use crate::base::setting::{Key, Setting};
use crate::base::units::Length;
use crate::base::verdict::Verdict;
use crate::base::watch::Watch;
use crate::job::telescope::{JunctureKind, ShellCount, Stance, TelescopeJob};
use crate::mesh::TriMesh;
use crate::sheet::network::NetworkSheet;
use crate::skeleton::ShellSizes;
use crate::wing::{Impossible, Outcome};

/// Feet that are tried if the one by calculation is a little too small.
const FOOT_TRIES: usize = 4;

/// Prepares the telescopes of a skeleton to their end: a kit, or the reason why there is none.
pub fn prepare(
    job: &TelescopeJob,
    shop: &Shop,
    loaded: &LoadedSkeleton,
    watch: &Watch,
) -> Result<Outcome<NetworkSheet, Tried>, TelescopeRunError> {
    if job.shells == ShellCount::Given(1) {
        return Err(TelescopeRunError::OneShell);
    }
    let skin = skin(job, loaded)?;
    let form = match (&skin, job.junctures) {
        (Some(skin), _) => Form::Model(skin),
        (None, Some(JunctureKind::Hull)) => Form::Hulls,
        (None, _) => Form::Balls,
    };
    if let (Some(_), Stance::Stand) = (form.skin(), job.goal) {
        let setting = Setting::new(Key::Goal, Stance::Stand);
        return Err(TelescopeRunError::NoFoot(setting));
    }
    let workshop = Workshop {
        job,
        shop,
        loaded,
        form,
        watch,
    };
    let studio = studio(&workshop)?;
    let mut search = search(&studio, loaded);
    loop {
        let round = match search.find()? {
            Err(rings) => return Ok(no_tree(&rings)),
            Ok(None) => return Ok(no_limb(&search.kept)),
            Ok(Some(round)) => round,
        };
        let skeleton = search.skeleton.clone();
        let Some(tree) = search.tree(&round, &skeleton) else {
            return Ok(no_limb(&search.kept));
        };
        match attempt(&workshop, tree, &search.kept)? {
            Verdict::Found(made) => {
                let draft = draft(&workshop, &made)?;
                let prepared = papers::finish(&workshop, &made, draft)?;
                return Ok(Outcome::Prepared(Box::new(prepared)));
            }
            Verdict::No(Failed::Pose(unposed)) => {
                return Ok(Outcome::Impossible(Box::new(unposed.impossible())));
            }
            Verdict::No(Failed::Stand(falls)) => {
                let answer = falls.impossible(job.least_angle_deg);
                return Ok(Outcome::Impossible(Box::new(answer)));
            }
            Verdict::No(Failed::Limb(barred)) => {
                let is_shorter = barred.by_end && search.shorten_limb(&round, barred.limb);
                if !is_shorter {
                    search.keep(Search::nodes_of(&round, barred.limb), barred.why);
                }
            }
        }
    }
}

/// Returns the model's surface if junctures keep it: as ordered, or as is usual for a model.
fn skin<'a>(
    job: &TelescopeJob,
    loaded: &'a LoadedSkeleton,
) -> Result<Option<Skin<'a>>, TelescopeRunError> {
    match (job.junctures, &loaded.solid) {
        (Some(JunctureKind::Model) | None, Some(solid)) => Ok(Some(Skin::new(solid))),
        (Some(kind @ JunctureKind::Model), None) => {
            let setting = Setting::new(Key::Junctures, kind);
            Err(TelescopeRunError::NoModel(setting))
        }
        _ => Ok(None),
    }
}

/// A limb that cannot be made, from 0, and why.
struct Barred {
    limb: usize,
    why: String,
    /// True if what it carries is in the way, so that it may end earlier.
    by_end: bool,
}

/// A network that is not made.
enum Failed {
    /// For a limb cannot be.
    Limb(Barred),
    /// For a pose cannot be.
    Pose(Box<Unposed>),
    /// For it does not stand.
    Stand(Falls),
}

/// Makes the parts of a network, finds a sequence that is free, and takes the poses. Else names the
/// limb to keep solid and why, or the pose that cannot be.
fn attempt<'a>(
    workshop: &Workshop,
    tree: Tree<'a>,
    kept: &[Kept],
) -> Result<Verdict<MadeNetwork<'a>, Failed>, TelescopeRunError> {
    let barred = |limb: usize, why: String| {
        Failed::Limb(Barred {
            limb,
            why,
            by_end: false,
        })
    };
    let pieces = match workshop.pieces(&tree)? {
        Ok(pieces) => pieces,
        Err((limb, why)) => return Ok(Verdict::No(barred(limb, why))),
    };
    let limbs = match workshop.limbs(&tree)? {
        Verdict::Found(limbs) => limbs,
        Verdict::No(refused) => return Ok(Verdict::No(barred(refused.limb, refused.why))),
    };
    let attempt = Attempt {
        workshop,
        tree: &tree,
        limbs: &limbs,
        pieces: &pieces,
    };
    let Opened {
        junctures,
        bodies,
        found,
        foot,
    } = match attempt.stand()? {
        Verdict::Found(opened) => opened,
        Verdict::No(falls) => return Ok(Verdict::No(Failed::Stand(falls))),
    };
    let poses = match &found {
        Ok(_) => workshop.poses(&tree, &limbs, &bodies)?,
        Err(_) => Verdict::Found(Vec::new()),
    };
    drop(bodies);
    let poses = match poses {
        Verdict::Found(poses) => poses,
        Verdict::No(unposed) => return Ok(Verdict::No(Failed::Pose(Box::new(unposed)))),
    };
    match found {
        Ok(sequence) => Ok(Verdict::Found(MadeNetwork {
            solid: kept.iter().map(words).collect(),
            limbs,
            // What moves is the whole juncture: it is divided last.
            junctures: divide(workshop, &tree, junctures)?,
            tree,
            sequence,
            poses,
            foot,
        })),
        Err(hit) => {
            let end = Item::Juncture(tree.network.limbs[hit.limb].to);
            let by_end = workshop.form.skin().is_some() && hit.items.contains(&end);
            Ok(Verdict::No(Failed::Limb(Barred {
                limb: hit.limb,
                why: hit.words(&tree),
                by_end,
            })))
        }
    }
}

/// The parts of a network, of which the junctures are made.
struct Attempt<'b> {
    workshop: &'b Workshop<'b>,
    tree: &'b Tree<'b>,
    limbs: &'b [Made],
    pieces: &'b [TriMesh],
}

/// A network with a sequence of opening, or what is in its way.
struct Opened<'b> {
    junctures: Vec<WrittenJuncture>,
    bodies: Bodies<'b>,
    found: Result<Vec<usize>, Hit>,
    foot: Option<StoodFoot>,
}

impl<'b> Attempt<'b> {
    /// Makes the junctures and finds a sequence that is free. A figure that is to stand gets the
    /// least foot that holds it.
    fn stand(&self) -> Result<Verdict<Opened<'b>, Falls>, TelescopeRunError> {
        let bare = self.open(None)?;
        let is_asked = self.workshop.job.goal == Stance::Stand;
        let Some(sequence) = bare.found.as_ref().ok().filter(|_| is_asked) else {
            return Ok(Verdict::Found(bare));
        };
        let mut foot = match self.footing(&bare.junctures, sequence).choose() {
            Ok(foot) => foot,
            Err(falls) => return Ok(Verdict::No(falls)),
        };
        let mut tries = 0;
        loop {
            tries += 1;
            let mut opened = self.open(Some(&foot))?;
            let sequence = match &opened.found {
                Ok(sequence) => sequence,
                Err(hit) => {
                    let why = hit.words(self.tree);
                    return Ok(Verdict::No(Falls::Barred { why }));
                }
            };
            match self.footing(&opened.junctures, sequence).confirm(&foot) {
                Ok(worst_deg) => {
                    opened.foot = Some(StoodFoot { foot, worst_deg });
                    return Ok(Verdict::Found(opened));
                }
                Err(falls @ Falls::Topples { .. }) if tries < FOOT_TRIES => {
                    match foot.wider(self.workshop) {
                        Some(wider) => foot = wider,
                        None => return Ok(Verdict::No(falls)),
                    }
                }
                Err(falls) => return Ok(Verdict::No(falls)),
            }
        }
    }

    fn footing<'c>(
        &'c self,
        junctures: &'c [WrittenJuncture],
        sequence: &'c [usize],
    ) -> Footing<'c> {
        Footing {
            workshop: self.workshop,
            tree: self.tree,
            limbs: self.limbs,
            junctures,
            masses: masses(junctures),
            sequence,
        }
    }

    /// Makes the junctures, and finds a sequence that is free.
    fn open(&self, foot: Option<&Foot>) -> Result<Opened<'b>, TelescopeRunError> {
        let (workshop, tree) = (self.workshop, self.tree);
        let junctures = junctures(workshop, tree, self.pieces, foot)?;
        let meshes: Vec<TriMesh> = junctures.iter().map(|own| own.in_model()).collect();
        let refs: Vec<_> = self.limbs.iter().collect();
        let bodies = Bodies::new(&tree.network, &refs, meshes);
        let openings = tree.network.limbs.iter();
        let openings: Vec<&[_]> = openings.map(|limb| &limb.opening.keys[..]).collect();
        let found = bodies.sequence(&openings, workshop.watch)?;
        Ok(Opened {
            junctures,
            bodies,
            found,
            foot: None,
        })
    }
}

fn words(kept: &Kept) -> String {
    let [from, to] = kept.ends;
    format!("nodes {from} to {to}: {}", kept.why)
}

/// Returns the measures for the limbs of a skeleton.
fn studio<'a>(workshop: &Workshop<'a>) -> Result<Studio<'a>, TelescopeRunError> {
    let (job, shop) = (workshop.job, workshop.shop);
    let basics = basics(job, shop, workshop.loaded.longest_mm)?;
    let measures = Measures {
        least: basics.least,
        tip_mm: basics.tip_mm,
        shells: match job.shells {
            ShellCount::Auto => None,
            ShellCount::Given(count) => Some(count),
        },
        root_mm: job.root_radius.map_or(f64::INFINITY, Length::mm),
        solid_mm: job.keep_solid.map_or(0.0, Length::mm),
    };
    Ok(Studio {
        job,
        shop,
        measures,
        skin: workshop.form.skin(),
        watch: workshop.watch,
    })
}

/// Begins the search, with the branches marked that carry no two shells.
fn search<'a>(studio: &'a Studio<'a>, loaded: &LoadedSkeleton) -> Search<'a> {
    let sizes = ShellSizes {
        least_radius_mm: studio.measures.tip_mm,
        pitch_mm: studio.measures.least.pitch_mm(),
    };
    let mut skeleton = loaded.skeleton.clone();
    if let Some(solid) = &loaded.solid {
        skeleton.mark_solid(solid, &sizes);
    }
    let marked = skeleton.branches.iter();
    let kept = marked.filter_map(|branch| {
        let ends = [branch.nodes[0], branch.nodes[branch.nodes.len() - 1]];
        let why = branch.solid?.to_string();
        let ends = ends.map(|node| skeleton.nodes[node].id);
        Some(Kept { ends, why })
    });
    Search {
        studio,
        sizes,
        kept: kept.collect(),
        skeleton,
        ends: Vec::new(),
        cut_ends: Vec::new(),
        known: Vec::new(),
    }
}

/// Returns the answer that rings cannot open.
fn no_tree(rings: &crate::skeleton::NotATree) -> Outcome<NetworkSheet, Tried> {
    Outcome::Impossible(Box::new(Impossible {
        is_proved: true,
        ..Impossible::new(rings.to_string())
    }))
}

/// Returns the answer that no limb carries two shells.
fn no_limb(kept: &[Kept]) -> Outcome<NetworkSheet, Tried> {
    let why: Vec<String> = kept.iter().map(words).collect();
    let why = match why.is_empty() {
        true => String::new(),
        false => format!(": {}", why.join("; ")),
    };
    let hints = vec!["make it larger, its walls thinner, or take a finer printer".to_owned()];
    Outcome::Impossible(Box::new(Impossible {
        hints,
        ..Impossible::new(format!("no limb carries two shells{why}"))
    }))
}
