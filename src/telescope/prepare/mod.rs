//! The line from a curve to the kit of a telescope: load, measure, design, make, judge, kit. That
//! from a skeleton is in `network`.

mod advise;
mod animate;
mod asked;
mod balance;
mod best;
mod error;
mod fallen;
mod feet;
mod files;
mod footing;
mod ground;
mod in_place;
mod judge;
mod load;
mod load_skeleton;
mod made;
mod motion_file;
mod moving;
mod nested;
mod network;
mod papers;
mod posed;
mod poses;
mod posing;
mod scene;
mod sheet;
mod unposed;
mod unreached;

pub use advise::Tried;
pub use error::TelescopeRunError;
pub use load_skeleton::choose_root;

use self::load::{Input, Loaded};
use self::load_skeleton::Shop;
use self::posing::TIP;
use crate::base::setting::{Key, Setting};
use crate::base::verdict::Verdict;
use crate::base::watch::Watch;
use crate::job::telescope::{Stance, TelescopeJob};
use crate::sheet::network::AnyTelescopeSheet;
use crate::sheet::telescope::TelescopeSheet;
use crate::wing::Outcome;

/// Prepares a telescope to its end: a kit with its checklist, or the reason why there is none. A
/// skeleton or a model gets several, on junctures.
///
/// Nothing is written: the kit ([`crate::wing::Prepared`]) is in memory. The same job gives the
/// same bytes on any number of threads.
///
/// # Errors
/// An error means that no answer was reached: the input cannot be read, the job contradicts itself,
/// the caller stopped the run. A curve that no telescope follows is an answer.
pub fn prepare(
    job: &TelescopeJob,
    watch: &Watch,
) -> Result<Outcome<AnyTelescopeSheet, Tried>, TelescopeRunError> {
    posing::pose_file(job)?;
    posing::refuse_twice(job)?;
    in_place::refuse_unlike(job)?;
    let shop = load::shop(job, watch)?;
    match load::input(job, &shop, watch)? {
        Input::Curve(curve) => {
            refuse_limbs(job)?;
            let outcome = along_curve(job, &shop, &curve, watch)?;
            Ok(outcome.map(|sheet| AnyTelescopeSheet::Curve(Box::new(sheet))))
        }
        Input::Skeleton(loaded) => {
            in_place::refuse_limbs(job)?;
            if !job.ballast.is_none() {
                return Err(no_pocket(job));
            }
            let outcome = network::prepare(job, &shop, &loaded, watch)?;
            Ok(outcome.map(|sheet| AnyTelescopeSheet::Network(Box::new(sheet))))
        }
    }
}

/// Returns the error that ballast finds no pocket.
fn no_pocket(job: &TelescopeJob) -> TelescopeRunError {
    TelescopeRunError::NoPocket(Setting::new(Key::Ballast, &job.ballast))
}

/// Refuses options that a curve does not have.
fn refuse_limbs(job: &TelescopeJob) -> Result<(), TelescopeRunError> {
    let junctures = job.junctures.map(|kind| Setting::new(Key::Junctures, kind));
    let solid = job
        .keep_solid
        .map(|radius| Setting::new(Key::KeepSolid, radius));
    let root = job.root.map(|root| Setting::new(Key::Root, root));
    if let Some(setting) = junctures.or(solid).or(root) {
        return Err(TelescopeRunError::OnlyLimbs(setting));
    }
    if !job.ballast.is_none() && (job.in_place || job.goal == Stance::None) {
        return Err(no_pocket(job));
    }
    let mut reaches = job.reach.iter();
    match reaches.find(|reach| reach.tip != TIP) {
        Some(reach) => Err(TelescopeRunError::NoTip {
            tip: reach.tip.clone(),
            known: vec![TIP.to_owned()],
        }),
        None => Ok(()),
    }
}

/// Prepares the telescope of a curve.
fn along_curve(
    job: &TelescopeJob,
    shop: &Shop,
    curve: &Loaded,
    watch: &Watch,
) -> Result<Outcome<TelescopeSheet, Tried>, TelescopeRunError> {
    let asked = asked::measure(job, shop, curve)?;
    let best = match best::design(&asked, watch)? {
        Verdict::Found(best) => best,
        Verdict::No(refused) => {
            let impossible = advise::remedies(&asked, refused, watch)?;
            return Ok(Outcome::Impossible(Box::new(impossible)));
        }
    };
    let made = match made::make(&asked, best, watch)? {
        Verdict::Found(made) => made,
        Verdict::No(refused) => {
            let impossible = advise::remedies(&asked, refused, watch)?;
            return Ok(Outcome::Impossible(Box::new(impossible)));
        }
    };
    let poses = match posing::of_chain(job, &made, watch)? {
        Verdict::Found(poses) => poses,
        Verdict::No(unposed) => return Ok(Outcome::Impossible(Box::new(unposed.impossible()))),
    };
    if let Some(unposed) = fallen::find_fallen(&asked, &made, &poses) {
        return Ok(Outcome::Impossible(Box::new(unposed.impossible())));
    }
    let draft = judge::draft(&asked, made, poses, watch)?;
    let prepared = papers::finish(&asked, draft, watch)?;
    Ok(Outcome::Prepared(Box::new(prepared)))
}
