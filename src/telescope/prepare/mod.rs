//! The line from a curve to the kit of a telescope: load, measure, design, make, judge, kit.

mod advise;
mod asked;
mod balance;
mod best;
mod error;
mod files;
mod judge;
mod load;
mod made;
mod motion_file;
mod papers;
mod poses;
mod scene;
mod sheet;

pub use advise::Tried;
pub use error::TelescopeRunError;

use crate::base::verdict::Verdict;
use crate::base::watch::Watch;
use crate::job::telescope::TelescopeJob;
use crate::sheet::telescope::TelescopeSheet;
use crate::wing::Outcome;

/// Prepares a telescope to its end: a kit with its checklist, or the reason why there is none.
///
/// Nothing is written: the kit ([`crate::wing::Prepared`]) is in memory. The same job gives the
/// same bytes on any number of threads.
///
/// # Errors
/// An error means that no answer was reached: the curve cannot be read, the job contradicts itself,
/// the caller stopped the run. A curve that no telescope follows is an answer.
pub fn prepare(
    job: &TelescopeJob,
    watch: &Watch,
) -> Result<Outcome<TelescopeSheet, Tried>, TelescopeRunError> {
    let shop = load::shop(job, watch)?;
    let curve = load::curve(job, &shop)?;
    let asked = asked::measure(job, &shop, &curve)?;
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
    let draft = judge::draft(&asked, made, watch)?;
    let prepared = papers::finish(&asked, draft, watch)?;
    Ok(Outcome::Prepared(Box::new(prepared)))
}
