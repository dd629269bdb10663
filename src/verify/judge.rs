//! The judge: measures the files of a kit and checks every promise against them.

use rayon::prelude::*;

use super::ballast::least_room_mm;
use super::body::Body;
use super::cell_walls::measure_cells;
use super::checks::checks;
use super::cleaning::inspect_voids;
use super::cups::measure_cups;
use super::drains::{Bored, measure_holes, open_through_holes};
use super::hardware::measure_fit;
use super::jigs::measure_jigs;
use super::joints::{count_lost_strokes, film_error};
use super::loads::Loads;
use super::part_probe::PartProbe;
use super::pegs::{count_overlaps, measure_pegs};
use super::play::measure_joints;
use super::plugs::{measure_plugs, unplugged};
use super::regions::measure_inner_regions;
use super::shape::measure_shapes;
use super::slack::Slack;
use super::{
    CellFacts, Evidence, Figures, Fit, HoleFacts, JigFacts, Judgement, PartFacts, PegFacts,
    PlugFacts, RegionFacts, Setting, ShapeFacts, SpinFacts, SurfaceFacts, VoidFacts,
    assembly_moments,
};
use crate::base::watch::{Cancelled, Watch};
use crate::mass::{Moments, moments_of_mesh};
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
    judge_beside(evidence, &Body::of(&evidence.hollowed), None, watch)
}

/// Judges as [`judge`] does, with the uncut result as [`Body::of`] takes it apart.
///
/// # Errors
/// As [`judge`].
pub(super) fn judge_body(
    evidence: &Evidence,
    body: &Body,
    watch: &Watch,
) -> Result<Judgement, Cancelled> {
    judge_beside(evidence, body, None, watch)
}

/// Judges as [`judge`] does, with what was measured before: the uncut result as [`Body::of`] takes
/// it apart, and the jigs as [`measure_jigs`] finds them.
///
/// # Errors
/// As [`judge`].
pub fn judge_measured(
    evidence: &Evidence,
    body: &Body,
    jigs: Vec<JigFacts>,
    watch: &Watch,
) -> Result<Judgement, Cancelled> {
    judge_beside(evidence, body, Some(jigs), watch)
}

/// Measures what is left to measure, in parallel, and checks it.
fn judge_beside(
    evidence: &Evidence,
    body: &Body,
    jigs: Option<Vec<JigFacts>>,
    watch: &Watch,
) -> Result<Judgement, Cancelled> {
    let promise = &evidence.promise;
    watch.check()?;
    let bored = Bored::of(promise, body);
    let bored = bored.as_ref();
    let jigs = || jigs.map_or_else(|| measure_jigs(evidence, body, watch), Ok);
    let thin = || find_thin(&body.outer, promise.printer.minimum_wall_mm, watch);
    let ((surface, (jigs, walls)), ((thin, cups), (inside, figures))) = both(
        || {
            let surface = || SurfaceFacts::of_mesh(&body.welded, &body.whole, watch);
            both(surface, || {
                both(jigs, || Walls::of(evidence, body, bored, watch))
            })
        },
        || {
            let cups = || measure_cups(promise, &evidence.parts, watch);
            let inside = || Inside::of(evidence, body, bored, watch);
            let figures = || AllFigures::of(evidence, body, watch);
            both(|| both(thin, cups), || both(inside, figures))
        },
    )?;
    let mut joints = measure_joints(promise, &evidence.parts, &jigs);
    let slack = Slack {
        promise,
        parts: &evidence.parts,
        whole: &figures.whole,
        setting: &figures.setting,
    };
    slack.state(&mut joints);
    let mut judgement = Judgement {
        solid: figures.solid,
        hollowed: figures.hollowed,
        assembly: figures.assembly,
        surface,
        parts: inside.parts,
        wall_min_mm: walls.least_mm,
        shape: walls.shape,
        fit: figures.fit,
        spin: figures.spin,
        ballast_room_mm: figures.ballast_room_mm,
        thin,
        cups,
        pegs: inside.pegs,
        joints,
        jigs,
        overlaps: inside.overlaps,
        voids: inside.voids,
        holes: inside.holes,
        plugs: inside.plugs,
        cells: inside.cells,
        drained_mm3: bored.map_or_else(Vec::new, |bored| bored.taken_mm3.clone()),
        beyond_ratio: figures.beyond_ratio,
        inner_regions: inside.inner_regions,
        film_error: film_error(promise, &evidence.parts),
        lost_strokes: inside.lost_strokes,
        checks: Vec::new(),
        changes: Vec::new(),
        unlisted: Vec::new(),
    };
    judgement.checks = checks(promise, &judgement);
    Ok(judgement)
}

/// Measures two things in parallel.
fn both<A: Send, B: Send>(
    a: impl FnOnce() -> Result<A, Cancelled> + Send,
    b: impl FnOnce() -> Result<B, Cancelled> + Send,
) -> Result<(A, B), Cancelled> {
    let (a, b) = rayon::join(a, b);
    Ok((a?, b?))
}

/// The facts about weights, and about the outside.
struct AllFigures {
    solid: Figures,
    hollowed: Figures,
    assembly: Figures,
    fit: Option<Fit>,
    spin: Option<SpinFacts>,
    ballast_room_mm: Option<f64>,
    beyond_ratio: Option<f64>,
    /// Moments of all that is put together, and the setting in which they are weighed.
    whole: Moments,
    setting: Setting,
}

impl AllFigures {
    fn of(evidence: &Evidence, body: &Body, watch: &Watch) -> Result<Self, Cancelled> {
        let promise = &evidence.promise;
        let outer = &body.outer;
        let setting = Setting::new(promise, outer);
        let Loads {
            inside,
            joined,
            sparse,
            beyond,
        } = Loads::of(evidence, body, &setting);
        let written = moments_of_mesh(&body.welded) + sparse;
        let sparse = sparse + beyond;
        let assembled = assembly_moments(&evidence.parts) + sparse;
        let hardware = setting.hardware * setting.density_g_mm3().recip();
        let figures = |printed: &Moments, load: &Moments| {
            watch.check()?;
            Ok(Figures::with_load(printed, load, &setting))
        };
        Ok(Self {
            solid: Figures::new(&moments_of_mesh(outer), &setting),
            hollowed: figures(&(written + beyond), &inside)?,
            assembly: figures(&assembled, &(inside + joined))?,
            fit: measure_fit(
                &promise.hardware,
                &promise.goal.frame(),
                outer,
                promise.wall.required_mm,
            ),
            spin: SpinFacts::of_top(&promise.goal, &promise.hardware, outer),
            beyond_ratio: promise.beyond_ratio(&written),
            ballast_room_mm: least_room_mm(&promise.ballast, &body.welded, outer),
            whole: assembled + inside + joined + hardware,
            setting,
        })
    }
}

/// The facts about the surfaces of the parts and the walls between them.
struct Walls {
    shape: ShapeFacts,
    least_mm: Option<f64>,
}

impl Walls {
    fn of(
        evidence: &Evidence,
        body: &Body,
        bored: Option<&Bored>,
        watch: &Watch,
    ) -> Result<Self, Cancelled> {
        let shape = || measure_shapes(evidence, &body.shells, bored, watch);
        let (shape, least_mm) = both(shape, || body.smallest_wall_mm(watch))?;
        Ok(Self {
            least_mm: least(least_mm, shape.wall_mm),
            shape,
        })
    }
}

/// The facts about the parts, and those that probes of them find.
struct Inside {
    parts: Vec<PartFacts>,
    pegs: Vec<PegFacts>,
    overlaps: usize,
    voids: Vec<VoidFacts>,
    holes: Vec<HoleFacts>,
    plugs: Vec<PlugFacts>,
    cells: Option<CellFacts>,
    lost_strokes: Option<usize>,
    inner_regions: Vec<RegionFacts>,
}

impl Inside {
    fn of(
        evidence: &Evidence,
        body: &Body,
        bored: Option<&Bored>,
        watch: &Watch,
    ) -> Result<Self, Cancelled> {
        let promise = &evidence.promise;
        let probes: Vec<PartProbe> = evidence.parts.par_iter().map(PartProbe::new).collect();
        let pegs = || measure_pegs(promise, &probes, &body.whole, watch);
        let overlaps = || count_overlaps(&probes, watch);
        // Voids are emptied before plugs close their holes.
        let unplugged = unplugged(promise, &evidence.parts);
        let bodies = unplugged.as_ref().unwrap_or(&probes);
        let voids = || inspect_voids(promise, &body.shells.inward, bodies, watch);
        let facts = |probe: &PartProbe| PartFacts::of_part(probe.part, &probe.surface, watch);
        let parts = || probes.par_iter().map(facts).collect::<Result<_, _>>();
        let ((pegs, overlaps), (voids, parts)) =
            both(|| both(pegs, overlaps), || both(voids, parts))?;
        let holes = measure_holes(promise, body, bodies, watch)?;
        let meant = bored.map_or(&[][..], |bored| &bored.plugs);
        let plugs = measure_plugs(promise, meant, &probes, watch)?;
        let cells = measure_cells(promise, body, &holes, watch)?;
        let mut voids = voids;
        open_through_holes(&mut voids, promise, body, &holes);
        Ok(Self {
            parts,
            pegs,
            overlaps,
            voids,
            holes,
            plugs,
            cells,
            lost_strokes: count_lost_strokes(promise, &probes),
            inner_regions: measure_inner_regions(evidence),
        })
    }
}

/// Returns the smaller of two lengths that may be missing.
fn least(a: Option<f64>, b: Option<f64>) -> Option<f64> {
    a.into_iter().chain(b).min_by(f64::total_cmp)
}
