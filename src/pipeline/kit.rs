//! The kit in memory: files, judgement, checklist and page.

use super::faces::faces;
use super::joinery_rows;
use super::joining;
use super::packages;
use super::printer_rows;
use super::rows::{self, Sheet};
use super::void_rows;
use super::{Assembly, Error, Prepared, Setup, phase, stopwatch::Stopwatch};
use crate::base::digest::sha256_hex;
use crate::base::watch::Watch;
use crate::cut::{CutOrder, CutPlan};
use crate::geom::Parting;
use crate::io::stl;
use crate::job::JobError;
use crate::kit::Kit;
use crate::page::{PageInputs, Picture, Subject, View, album, drawings, page};
use crate::repair::weld;
use crate::sheet::{Checklist, Verdict};
use crate::verify::{
    CHECKLIST_FILE, Density, Evidence, FigureName, Judgement, PrinterLimits, Promise,
    PromisedFigure, PromisedPart, SCHEMA, SHEET_FILE, SUMS_FILE, Shells, WallOrder, checks, judge,
    sums,
};

/// The name of the uncut result in a kit.
const HOLLOWED: &str = "hollowed.stl";
/// The name of the job in a kit.
const JOB: &str = "job.toml";
/// The name of the cuts and pins in a kit, to edit.
const CUTS: &str = "cuts.toml";

/// Judges what is to be written and puts the kit together.
pub fn prepared(
    setup: &Setup,
    assembly: &Assembly,
    progress: &Watch,
    mut watch: Stopwatch,
) -> Result<Prepared, Error> {
    progress.report(phase::VERIFY, 0.0);
    let hollowed = stl::encode(
        &assembly.hollowed.to_mesh(),
        &format!("{} hollowed", setup.name()),
    );
    let evidence = Evidence {
        promise: promise(setup, assembly),
        hollowed: stl::decode(&hollowed)?,
        parts: assembly.evidence(),
    };
    let shells = Shells::of_mesh(&weld(&evidence.hollowed));
    let cuts = assembly.plan.partings()?;
    let sitting = sitting(&shells, &cuts, &evidence);
    let ((promise, judgement), ((pictures, view), packages)) = rayon::join(
        || judged(setup, evidence.clone()),
        || {
            let drawn = || rayon::join(|| album(&sitting), || View::of(&sitting));
            rayon::join(drawn, || packages::packages(setup, assembly))
        },
    );
    let (mut pictures, view, packages) = (pictures?, view?, packages?);
    watch.lap(phase::VERIFY);
    progress.report(phase::REPORT, 0.0);
    let mut kit = Kit::default();
    kit.add(HOLLOWED, hollowed);
    for part in &assembly.parts {
        kit.add(&part.file, part.bytes.clone());
    }
    for (file, bytes) in packages {
        kit.add(&file, bytes);
    }
    kit.add(JOB, setup.job.to_toml()?.into_bytes());
    kit.add(
        CUTS,
        CutOrder::of(&assembly.plan)
            .to_toml()
            .map_err(JobError::from)?
            .into_bytes(),
    );
    let sheet = Sheet {
        setup,
        assembly,
        judgement: &judgement,
        promised: promise.promise,
    };
    let mut checklist = rows::checklist(&sheet);
    pictures.extend(drawings(&checklist, &sitting, &faces(assembly)?)?);
    for picture in &pictures {
        kit.add(&picture.file, picture.bytes());
    }
    checklist.files = kit
        .files()
        .map(|(file, bytes)| (file.to_owned(), sha256_hex(&[bytes])))
        .collect();
    file_papers(&mut kit, &checklist, (&pictures, &view))?;
    watch.lap(phase::REPORT);
    checklist.timing_s = Some(watch.timing());
    Ok(Prepared {
        kit,
        checklist,
        failure: None,
    })
}

/// Adds the job sheet, for people and for machines, without anything that differs from run to run,
/// and the list of all hashes.
fn file_papers(
    kit: &mut Kit,
    sheet: &Checklist,
    (pictures, view): (&[Picture], &View),
) -> Result<(), Error> {
    let json = sheet.to_json()?;
    let sha256 = &sha256_hex(&[json.as_bytes()]);
    kit.add(CHECKLIST_FILE, json.into_bytes());
    kit.add(
        SHEET_FILE,
        page(&PageInputs {
            sheet,
            sha256,
            pictures,
            view: Some(view),
        })
        .into_bytes(),
    );
    kit.add(SUMS_FILE, sums(kit.files()).into_bytes());
    Ok(())
}

/// What the pictures are taken of: the files as they are written.
fn sitting<'a>(shells: &'a Shells, cuts: &'a [Parting], evidence: &'a Evidence) -> Subject<'a> {
    let Promise {
        goal,
        hardware,
        ballast,
        parts: promised,
        ..
    } = &evidence.promise;
    Subject {
        shells,
        parts: &evidence.parts,
        promised,
        cuts,
        aim: *goal,
        hardware,
        ballast,
    }
}

/// The judgement, and the promise with the figure that the written parts reach: what a buyer may
/// rely on.
fn judged(setup: &Setup, evidence: Evidence) -> (Promise, Judgement) {
    let mut judgement = judge(&evidence);
    let figure = rows::promised_figure(setup.placement.goal.kind, setup.placement.goal.objective);
    let reached = judgement.assembly.value_of(figure);
    let promise = Promise {
        promise: reached.map(|value| PromisedFigure { figure, value }),
        ..evidence.promise
    };
    judgement.checks = checks(&promise, &judgement);
    (promise, judgement)
}

/// What the files are held against.
fn promise(setup: &Setup, assembly: &Assembly) -> Promise {
    Promise {
        schema: SCHEMA,
        printer: PrinterLimits {
            build_volume_mm: setup.printer.usable_volume_mm(),
            print_scale_ratio: printer_rows::scaled(setup.printer.print_scale_ratio()),
            minimum_wall_mm: printer_rows::minimum_wall_mm(setup),
            minimum_opening_mm: Some(setup.printer.min_opening_mm.value),
            cleaning: Some(setup.printer.cleaning_rule()),
        },
        material: Density {
            density_g_cm3: rows::density_g_cm3(setup),
        },
        goal: rows::aim(setup),
        promise: None,
        wall: WallOrder {
            required_mm: setup.wall.wall_mm,
        },
        parts: assembly
            .parts
            .iter()
            .map(|part| promised_part(part, &assembly.plan))
            .collect(),
        cuts: void_rows::promised_cuts(&assembly.plan),
        voids: void_rows::promised_voids(setup, &assembly.plan),
        hardware: setup.hardware(),
        dowels: joining::dowels(&assembly.plan),
        string_gap_mm: setup.string_gap_mm(),
        joints: joinery_rows::promised_joints(setup, &assembly.plan),
        ballast: rows::ballast_orders(setup),
        fill: rows::fill_order(setup),
        files: Default::default(),
    }
}

fn promised_part(written: &super::written::WrittenPart, plan: &CutPlan) -> PromisedPart {
    let part = &written.part;
    PromisedPart {
        id: part.id.clone(),
        file: written.file.clone(),
        sha256: sha256_hex(&[&written.bytes]),
        fingerprint: None,
        print_from_model: written.evidence().pose,
        pins: part.pins.iter().map(|pin| rows::pin(pin, plan)).collect(),
        sockets: part
            .sockets
            .iter()
            .map(|pin| rows::socket(pin, plan))
            .collect(),
        marks: part.labels.iter().map(joining::mark).collect(),
    }
}

/// The verdict over a judgement.
pub fn verdict(judgement: &Judgement) -> Verdict {
    Verdict::of(&judgement.checks)
}

/// The figure that a certificate speaks of, as the judge names it.
pub fn figure_name(figure: crate::hollow::Figure) -> FigureName {
    use crate::hollow::Figure;
    match figure {
        Figure::CriticalSpeedRpm => FigureName::CriticalSpeedRpm,
        Figure::SpinIt => FigureName::SpinItRatio,
        Figure::DominanceRatio => FigureName::DominanceRatio,
        Figure::TopplingAngleRad => FigureName::TopplesDeg,
        Figure::CenterHeightMm => FigureName::CenterHeightMm,
        Figure::MetacentricHeightMm => FigureName::MetacentricHeightMm,
        Figure::VolumeMm3 => FigureName::MassG,
        Figure::BalanceGradeMmS => FigureName::BalanceGradeMmS,
    }
}
