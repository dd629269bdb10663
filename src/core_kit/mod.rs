//! Objects larger than the printer: the line from a model to the kit of a laser-cut base and the
//! printed parts around it.
//!
//! [`prepare()`] goes it: load, measure, build, make, weigh, judge, kit. The work is done by the
//! rooms that it joins. [`polyhedra`](crate::polyhedra) finds the base, and
//! [`panels`](crate::panels) cuts it into sheets with joints. [`cladding`](crate::cladding) makes
//! the parts, and [`cutting`](crate::cutting) lays the panels out. Here are only what they are
//! asked for, the fasteners, the mass, and the files.

mod advise;
mod advise_base;
mod advise_size;
mod asked;
mod ballast;
mod ballast_rows;
mod base;
mod bench;
mod build;
mod error;
mod estimates;
mod files;
mod hardware;
mod home;
mod judge;
mod load;
mod made;
mod mass;
mod method;
mod names;
mod papers;
mod pockets;
mod rods;
mod rows;
mod scene;
mod sheet;
mod units;

pub use error::CoreRunError;

use crate::base::verdict::Verdict;
use crate::base::watch::Watch;
use crate::job::core_kit::CoreJob;
use crate::sheet::core_kit::CoreSheet;
use crate::wing::Outcome;

/// Prepares an object on a base to its end: a kit with its checklist, or the reason why there is
/// none.
///
/// Nothing is written: the kit ([`crate::wing::Prepared`]) is in memory. The same job gives the
/// same bytes on any number of threads.
///
/// # Errors
/// An error means that no answer was reached: the model cannot be read, the job contradicts itself,
/// the caller stopped the run. A model without room for a base, or an object that falls, is an
/// answer.
pub fn prepare(job: &CoreJob, watch: &Watch) -> Result<Outcome<CoreSheet>, CoreRunError> {
    let shop = load::shop(job, watch)?;
    let loaded = load::model(job, &shop, watch)?;
    let asked = asked::measure(&shop, &loaded, watch)?;
    let built = match build::build(&asked, watch)? {
        Verdict::Found(built) => built,
        Verdict::No(why) => {
            let impossible = advise::refused(&asked, &why, watch)?;
            return Ok(Outcome::Impossible(Box::new(impossible)));
        }
    };
    let made = made::make(&asked, built, watch)?;
    let weighed = mass::weigh(&asked, &made);
    let weighed = ballast::ballasted(&asked, &made, weighed, &job.ballast)?;
    if let Some(impossible) = advise::too_few(&asked, &made, &weighed)? {
        return Ok(Outcome::Impossible(Box::new(impossible)));
    }
    if let Some(impossible) = advise::falls(&asked, &made, &weighed)? {
        return Ok(Outcome::Impossible(Box::new(impossible)));
    }
    let draft = judge::draft(&asked, made, &weighed, watch)?;
    let prepared = papers::finish(&asked, draft, watch)?;
    Ok(Outcome::Prepared(Box::new(prepared)))
}
