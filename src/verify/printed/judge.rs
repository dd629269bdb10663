//! The judge of toolpaths: reads them, finds the parts, weighs them, and checks the promises.

use std::path::{Path, PathBuf};

use super::cause::Cause;
use super::causes::{Printed, missing_cause};
use super::checks::printed_checks;
use super::density::Densities;
use super::error::PrintedError;
use super::judgement::{PrintedFile, PrintedJudgement};
use super::limits::{FLOW_RATIO, PRINTED_MASS_LIMIT_RATIO};
use super::matching::{Catalogue, Match, Matches};
use super::names::name_some;
use super::part::PrintedPart;
use super::shape::Thing;
use super::source::{Source, calibration, read_sources};
use super::supports::Voids;
use crate::base::watch::Watch;
use crate::io::gcode::DiameterSource;
use crate::mass::{Moments, moments_of_mesh};
use crate::verify::changes::find_changes;
use crate::verify::loads::Loads;
use crate::verify::{
    Body, Evidence, Figures, HOLLOWED_FILE, PlateSpot, Promise, Setting, assembly_moments,
    files_check, read_kit,
};

/// Judges the toolpaths of the kit in `folder`: all plates together, in any order.
///
/// Ballast, hardware, glue and fillings are taken from the promise. Support, skirts, brims and
/// purge lines do not count.
///
/// # Errors
/// The kit or a file cannot be read, a file fits no part of the kit or several, or two files print
/// the same part.
pub fn verify_printed(
    folder: &Path,
    files: &[PathBuf],
    watch: &Watch,
) -> Result<PrintedJudgement, PrintedError> {
    let evidence = read_kit(folder)?;
    let changes = find_changes(folder, &evidence)?;
    let sources = read_sources(files, watch)?;
    let body = Body::of(&evidence.hollowed);
    if body.outer.is_empty() {
        return Err(PrintedError::NoBody {
            path: folder.join(HOLLOWED_FILE),
        });
    }
    let mut judgement = judge_toolpaths(&evidence, &body, &sources, watch)?;
    if !changes.is_empty() {
        judgement.checks.push(files_check(&changes));
    }
    Ok(judgement)
}

/// Judges toolpaths that were read.
pub(super) fn judge_toolpaths(
    evidence: &Evidence,
    body: &Body,
    sources: &[Source],
    watch: &Watch,
) -> Result<PrintedJudgement, PrintedError> {
    let promise = &evidence.promise;
    let catalogue = catalogue(evidence);
    let matches = catalogue.match_all(sources, watch)?;
    let mut parts = measure_parts(&catalogue, &matches, sources);
    let voids = Voids::new(evidence, body);
    for support in voids.find_support(&catalogue, &matches.found, sources, watch)? {
        let id = &evidence.parts[support.part].id;
        if let Some(part) = parts.iter_mut().find(|part| part.id == *id) {
            part.support_in_voids_mm3 += support.moments.volume();
        }
    }
    let is_missing = |id: &&String| !parts.iter().any(|part| part.id == **id);
    let ids = evidence.parts.iter().map(|part| &part.id);
    let missing: Vec<String> = ids.filter(is_missing).cloned().collect();
    let weighing = Weighing::new(evidence, body);
    let laid = missing.is_empty().then(|| {
        let sum = |sum: Moments, part: &PrintedPart| sum + part.moments_g;
        let mass_g = parts.iter().fold(Moments::default(), sum);
        mass_g * weighing.setting.density_g_mm3().recip()
    });
    let stated = promise.laid_beyond().unwrap_or_default();
    let mut judgement = PrintedJudgement {
        files: describe_files(&catalogue, &matches, sources),
        promise: promise.promise,
        model: weighing.model(body),
        written: weighing.weigh(&weighing.written),
        toolpaths: laid.map(|laid| weighing.weigh(&laid)),
        stated_g: promise.laid.as_ref().map_or(Moments::default(), |laid| {
            Moments(laid.beyond) * weighing.setting.density_g_mm3()
        }),
        beyond: laid.map(|laid| laid - (weighing.written - stated)),
        causes: find_causes(promise, &parts, &missing, sources),
        notes: write_notes(promise, &matches, &parts, sources),
        checks: Vec::new(),
        parts,
        missing,
    };
    let heavier = weighing.weigh(&(weighing.written * (1.0 + PRINTED_MASS_LIMIT_RATIO)));
    judgement.checks = printed_checks(&promise.goal, &judgement, &heavier);
    let is_explained = judgement.causes.iter().any(|cause| cause.is_wrong);
    if !(judgement.passes() || is_explained) {
        judgement.notes.push(UNEXPLAINED.to_owned());
    }
    Ok(judgement)
}

/// The scales on which prints are weighed: with all that the kit adds to its parts.
struct Weighing {
    setting: Setting,
    loads: Loads,
    /// The moments of the written parts, put together.
    written: Moments,
}

impl Weighing {
    fn new(evidence: &Evidence, body: &Body) -> Self {
        let setting = Setting::new(&evidence.promise, &body.outer);
        let loads = Loads::of(evidence, body, &setting);
        Self {
            written: assembly_moments(&evidence.parts) + loads.sparse + loads.beyond,
            loads,
            setting,
        }
    }

    /// Returns the figures of printed parts, with moments of the kit's density.
    fn weigh(&self, printed: &Moments) -> Figures {
        let load = self.loads.inside + self.loads.joined;
        Figures::with_load(printed, &load, &self.setting)
    }

    /// Returns the figures of the uncut result with its ballast.
    fn model(&self, body: &Body) -> Figures {
        let solid = moments_of_mesh(&body.welded) + self.loads.sparse;
        Figures::with_load(&solid, &self.loads.inside, &self.setting)
    }
}

/// The note on a check that fails while no setting is wrong.
const UNEXPLAINED: &str = "no wrong setting was found: lines of whole width fill thin walls \
    unevenly, and the print will balance as shown";

/// Returns the parts of the kit, then its jigs, with their places on plates.
pub(super) fn catalogue(evidence: &Evidence) -> Catalogue<'_> {
    let promise = &evidence.promise;
    let spot = |id: &str| -> Option<&PlateSpot> {
        let mut spots = promise.plates.iter().flat_map(|plate| &plate.holds);
        spots.find(|spot| spot.id == id)
    };
    let scale_ratio = promise.printer.print_scale_ratio;
    let parts = evidence.parts.iter().map(|part| (part, false));
    let jigs = evidence.jigs.iter().map(|jig| (jig, true));
    let things = parts.chain(jigs).map(|(read, is_jig)| {
        let thing = Thing::new(read, is_jig, scale_ratio, spot(&read.id));
        match promise.infill.as_ref().filter(|_| !is_jig) {
            Some(infill) => thing.with_infill(read, infill),
            None => thing,
        }
    });
    Catalogue {
        promise,
        things: things.collect(),
    }
}

/// Measures every part that was found, in the order of the checklist.
fn measure_parts(catalogue: &Catalogue, matches: &Matches, sources: &[Source]) -> Vec<PrintedPart> {
    let mut found: Vec<&Match> = matches.found.iter().collect();
    found.retain(|this| !catalogue.things[this.thing].is_jig);
    found.sort_by_key(|this| this.thing);
    let measure = |this: &Match| {
        let (thing, source) = (&catalogue.things[this.thing], &sources[this.source]);
        PrintedPart::of(this, thing, source, catalogue.promise)
    };
    found.into_iter().map(measure).collect()
}

fn find_causes(
    promise: &Promise,
    parts: &[PrintedPart],
    missing: &[String],
    sources: &[Source],
) -> Vec<Cause> {
    let of_source = |source: &Source| {
        let here = parts.iter().filter(|part| part.file == source.name);
        let printed = Printed {
            promise,
            source,
            parts: here.collect(),
        };
        printed.causes()
    };
    let mut causes: Vec<_> = missing_cause(missing, promise).into_iter().collect();
    causes.extend(sources.iter().flat_map(of_source));
    causes
}

fn describe_files(
    catalogue: &Catalogue,
    matches: &Matches,
    sources: &[Source],
) -> Vec<PrintedFile> {
    let describe = |(index, source): (usize, &Source)| {
        let here = matches.found.iter().filter(|this| this.source == index);
        let densities = Densities::of(source, catalogue.promise);
        let facts = &source.toolpath.facts;
        let tools = 0..source.toolpath.diameters_mm.len().max(1);
        PrintedFile {
            name: source.name.clone(),
            slicer: facts.generator.as_ref().map(|generator| {
                let version = generator.version.as_deref().unwrap_or_default();
                format!("{} {version}", generator.name)
                    .trim_end()
                    .to_owned()
            }),
            holds: here
                .map(|this| catalogue.things[this.thing].id.to_owned())
                .collect(),
            density_g_cm3: tools.map(|tool| densities.of_tool(tool as u16)).collect(),
            is_density_stated: densities.are_stated(),
            print_time_s: facts.print_time_s,
        }
    };
    sources.iter().enumerate().map(describe).collect()
}

/// Returns the assumptions under which the toolpaths were judged.
fn write_notes(
    promise: &Promise,
    matches: &Matches,
    parts: &[PrintedPart],
    sources: &[Source],
) -> Vec<String> {
    let mut notes = Vec::new();
    let moved = parts.iter().filter(|part| part.is_moved && !part.is_turned);
    let turned = parts.iter().filter(|part| part.is_turned);
    let ids = |parts: Vec<&PrintedPart>| {
        let ids: Vec<&str> = parts.iter().map(|part| part.id.as_str()).collect();
        ids.join(", ")
    };
    let (moved, turned) = (ids(moved.collect()), ids(turned.collect()));
    if !moved.is_empty() {
        notes.push(format!(
            "moved on the plate since the kit was made, and placed by its box: {moved}"
        ));
    }
    if !turned.is_empty() {
        notes.push(format!(
            "turned on the plate since the kit was made, and placed by its box: {turned}"
        ));
    }
    if !matches.strangers.is_empty() {
        let strangers = name_some(&matches.strangers);
        notes.push(format!("not of this kit, and left out: {strangers}"));
    }
    if !matches.copies.is_empty() {
        let copies = name_some(&matches.copies);
        notes.push(format!(
            "printed more than once, and weighed once: {copies}"
        ));
    }
    notes.extend(
        sources
            .iter()
            .flat_map(|source| source_notes(source, promise)),
    );
    notes
}

/// Returns what one file leaves open.
fn source_notes(source: &Source, promise: &Promise) -> Vec<String> {
    let (toolpath, name) = (&source.toolpath, &source.name);
    let mut notes = Vec::new();
    if source.is_images {
        return vec![format!(
            "{name} holds images of layers: the material is weighed with the kit's {} g/cm³, and \
             support in the images counts as parts",
            promise.material.density_g_cm3
        )];
    }
    if !Densities::of(source, promise).are_stated() {
        notes.push(format!(
            "{name} does not state the density of its filament; the kit's {} g/cm³ is taken",
            promise.material.density_g_cm3
        ));
    }
    if toolpath.diameter_source == DiameterSource::Assumed {
        notes.push(format!(
            "{name} does not state the diameter of its filament; 1.75 mm is taken"
        ));
    }
    let set_flows = toolpath.facts.flow_ratios.iter();
    let is_taken_off = |ratio: &&f64| (calibration(&[**ratio], 0) - 1.0).abs() > FLOW_RATIO;
    if let Some(ratio) = set_flows.clone().find(is_taken_off) {
        notes.push(format!(
            "{name} sets a flow of {:.1} % for its filament, which is not counted: it calibrates \
             the filament",
            ratio * 100.0
        ));
    }
    let flow_ratio = toolpath.flow_ratio();
    if (flow_ratio - 1.0).abs() > FLOW_RATIO {
        notes.push(format!(
            "{name} sets a flow of {:.1} % (M221), which is not counted: it calibrates the machine",
            flow_ratio * 100.0
        ));
    }
    notes
}
