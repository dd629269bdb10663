//! The judge: measures the files of a kit and checks every promise against them.

use rayon::prelude::*;

use super::ballast::{ballast_moments, fill_moments, least_room_mm};
use super::checks::checks;
use super::cleaning::inspect_voids;
use super::cups::measure_cups;
use super::hardware::{mass_moments, measure_fit};
use super::jigs::measure_jigs;
use super::joints::{count_lost_strokes, film_error, film_moments};
use super::part_probe::PartProbe;
use super::pegs::{count_overlaps, measure_pegs};
use super::play::measure_joints;
use super::shape::measure_shapes;
use super::{
    Evidence, Figures, Judgement, PartEvidence, PartFacts, Setting, Shells, SpinFacts,
    SurfaceFacts, assembly_moments,
};
use crate::base::watch::{Cancelled, Watch};
use crate::mass::{Moments, moments_of_mesh};
use crate::repair::weld;
use crate::thin::find_thin;

/// Measures the evidence and checks every promise against it.
///
/// The figures are exact integrals of the written triangles; the wall is the distance between
/// triangles. Some seconds for a million triangles. The judgement is the same on any number of
/// threads.
///
/// # Errors
/// The watch was stopped before the judgement was made.
pub fn judge(evidence: &Evidence, watch: &Watch) -> Result<Judgement, Cancelled> {
    let promise = &evidence.promise;
    let welded = weld(&evidence.hollowed);
    watch.check()?;
    let shells = Shells::of_mesh(&welded);
    let outer = shells.outer_mesh();
    let setting = Setting::new(promise, &outer);
    let density_g_mm3 = setting.density_g_mm3();
    let load = ballast_moments(&promise.ballast, density_g_mm3)
        + fill_moments(promise.fill, &shells.inner_mesh(), setting.density_g_cm3);
    let joined = (film_moments(promise) + mass_moments(&promise.dowels)) * density_g_mm3.recip();
    watch.check()?;
    let assembled = assembly_moments(&evidence.parts);
    let probes: Vec<PartProbe> = evidence.parts.par_iter().map(PartProbe::new).collect();
    watch.check()?;
    let part_facts = |part: &PartEvidence| PartFacts::of_part(part, watch);
    let jigs = measure_jigs(evidence, &outer, watch)?;
    let shape = measure_shapes(evidence, &shells, watch)?;
    let figures = |printed: &Moments, load: &Moments| {
        watch.check()?;
        Ok(Figures::with_load(printed, load, &setting))
    };
    let mut judgement = Judgement {
        solid: Figures::new(&moments_of_mesh(&outer), &setting),
        hollowed: figures(&moments_of_mesh(&welded), &load)?,
        assembly: figures(&assembled, &(load + joined))?,
        surface: SurfaceFacts::of_mesh(&welded, watch)?,
        parts: evidence
            .parts
            .par_iter()
            .map(part_facts)
            .collect::<Result<_, _>>()?,
        wall_min_mm: least(shells.smallest_wall_mm(watch)?, shape.wall_mm),
        shape,
        fit: measure_fit(
            &promise.hardware,
            &promise.goal.frame(),
            &outer,
            promise.wall.required_mm,
        ),
        spin: SpinFacts::of_top(&promise.goal, &promise.hardware, &outer),
        ballast_room_mm: least_room_mm(&promise.ballast, &welded, &outer),
        thin: find_thin(&outer, promise.printer.minimum_wall_mm, watch)?,
        cups: measure_cups(promise, &evidence.parts, watch)?,
        pegs: measure_pegs(promise, &probes, &evidence.hollowed, watch)?,
        joints: measure_joints(promise, &evidence.parts, &jigs),
        jigs,
        overlaps: count_overlaps(&probes, watch)?,
        voids: inspect_voids(promise, &shells.inward, &probes, watch)?,
        film_error: film_error(promise, &evidence.parts),
        lost_strokes: count_lost_strokes(promise, &probes),
        checks: Vec::new(),
        changes: Vec::new(),
        unlisted: Vec::new(),
    };
    judgement.checks = checks(promise, &judgement);
    Ok(judgement)
}

/// Returns the smaller of two lengths that may be missing.
fn least(a: Option<f64>, b: Option<f64>) -> Option<f64> {
    a.into_iter().chain(b).min_by(f64::total_cmp)
}
