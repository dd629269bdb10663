//! From the quadric to written parts that meet the goal: voids, cuts, parts, and the correction of
//! their defect.

use rayon::prelude::*;

use super::{
    Error, Setup, Solved,
    ballasting::seats,
    bosses::BossRound,
    cleaning::{CleaningRound, planned_once},
    joining::{joined, label_style},
    phase,
    planning::{Lengths, Planned, planned},
    printer_rows::minimum_wall_mm,
    stopwatch::Stopwatch,
    tuner::{Tuner, Voids, inside},
    tuning::defect_ratio,
    written::WrittenPart,
};
use crate::base::watch::Watch;
use crate::cut::{
    self, CutError, CutPlan, GoalAxis, PinSettings, PlanRequest, PosePreference, parts_and_faces,
};
use crate::hollow::{Solution, TopCourse};
use crate::mass::{Moments, moments_of_mesh};
use crate::mesh::Hollowed;
use crate::printer::{Grid, PrintPose, Quantity};
use crate::sheet::HeightProof;
use crate::verify::{PartEvidence, assembly_moments};

/// How often parts are made at most. Pins and sockets are foreseen exactly, so the first are right
/// but for the rounding of their files, unless the plan had to be changed.
const MAX_ASSEMBLIES: usize = 3;

/// A cut for cleaning alone must bring this share of all voids' walls into sight. Less, and a kit
/// gets a joint more, with crumbs where cuts cross (fertility at 100 mm by stereolithography: 3
/// cuts, 16 joints); more, and voids shrink by what shows in the goal's figure.
const WORTH_RATIO: f64 = 0.02;

/// The parts of a kit, tuned so that what is written meets the goal.
#[derive(Debug, Clone)]
pub struct Assembly {
    /// The solution the parts were made from.
    pub solution: Solution,
    /// Tops: the proof for other heights of the centre.
    pub height_proof: Option<HeightProof>,
    /// How the first answer came about.
    pub course: TopCourse,
    /// The uncut body.
    pub hollowed: Hollowed,
    /// The volume of voids that stay solid because they could not be cleaned, or left a joint no
    /// room for pins, mm³.
    pub refused_mm3: f64,
    /// The cuts and pins.
    pub plan: CutPlan,
    /// The parts.
    pub parts: Vec<WrittenPart>,
    /// How many times it was solved again.
    pub rounds: usize,
    /// The figure of the certificate before anything was kept solid so that voids can be cleaned.
    pub value_before_cleaning: f64,
    /// What was kept solid so that voids can be cleaned.
    pub cleaning: Vec<CleaningRound>,
    /// The rounds in which bosses were kept solid around pins.
    pub bosses: Vec<BossRound>,
    /// The least lengths, for the pins of its joints, with which it would have come out so.
    pub lengths: Lengths,
}

impl Assembly {
    /// Makes the parts of a solution, measures what would be written, and solves again with the
    /// difference until the written parts meet the goal (THEORY §4); for the pins of its joints it
    /// goes to these lengths.
    pub fn corrected(
        setup: &Setup,
        solved: Solved,
        lengths: Lengths,
        (progress, watch): (&Watch, &mut Stopwatch),
    ) -> Result<Self, Error> {
        progress.report(phase::SHELL, 0.0);
        let value_before_cleaning = solved.solution.certificate.value;
        let mut tuner = Tuner::new(setup, solved, progress)?;
        watch.lap("shell");
        let voids = tuner.first()?;
        watch.lap("voids");
        progress.report(phase::PARTS, 0.0);
        let asked = (&plan_request(setup), lengths);
        let Planned {
            voids,
            plan,
            notes,
            request,
            cleaning,
            bosses,
            lengths,
        } = planned(setup, (&mut tuner, &mut *watch), voids, asked)?;
        let mut assembly = assembled(setup, &mut tuner, (voids, plan), &request)?;
        assembly.plan.notes.extend(notes);
        watch.lap("parts");
        Ok(Self {
            value_before_cleaning,
            cleaning,
            bosses,
            lengths,
            ..assembly
        })
    }

    /// The moments of the written parts put together, without hardware and ballast, model frame.
    pub fn written_moments(&self) -> Moments {
        written_moments(&self.parts)
    }

    /// The parts as the judge sees them.
    pub fn evidence(&self) -> Vec<PartEvidence> {
        self.parts.iter().map(WrittenPart::evidence).collect()
    }
}

fn written_moments(parts: &[WrittenPart]) -> Moments {
    let evidence: Vec<PartEvidence> = parts.iter().map(WrittenPart::evidence).collect();
    assembly_moments(&evidence)
}

/// Written parts, and what they lack.
#[derive(Clone)]
struct Made {
    voids: Voids,
    plan: CutPlan,
    parts: Vec<WrittenPart>,
    /// What the parts have more than the uncut voids' body: pins, sockets, glue, and what rounding
    /// does; model frame.
    more: Moments,
    /// How far they are from the goal's constraints, in tolerances.
    defect_ratio: f64,
}

/// The parts by a plan, of voids solved for again with what the pins and sockets change; of all
/// attempts those that come nearest to the goal.
fn assembled(
    setup: &Setup,
    tuner: &mut Tuner,
    (voids, plan): (Voids, CutPlan),
    request: &PlanRequest,
) -> Result<Assembly, Error> {
    let more = moments_of_mesh(&plan.pegs()) + joined(setup, &plan);
    let mut last = made(setup, tuner, (voids, plan, more), request)?;
    let mut best = last.clone();
    for _ in 1..MAX_ASSEMBLIES {
        if best.defect_ratio <= 1.0 {
            break;
        }
        last = made(setup, tuner, (last.voids, last.plan, last.more), request)?;
        if last.defect_ratio < best.defect_ratio {
            best = last.clone();
        }
    }
    let Made {
        voids, plan, parts, ..
    } = best;
    let plan = cut::plan_of(&voids.hollowed, plan, request)?;
    let Voids {
        solution,
        hollowed,
        refused_mm3,
        rounds,
        ..
    } = voids;
    Ok(Assembly {
        value_before_cleaning: solution.certificate.value,
        solution,
        height_proof: tuner.height_proof(),
        course: tuner.course().clone(),
        hollowed,
        refused_mm3,
        plan,
        parts,
        rounds,
        cleaning: Vec::new(),
        bosses: Vec::new(),
        lengths: Lengths::Walls,
    })
}

/// One attempt: the voids tuned to what the parts have more, and the parts.
fn made(
    setup: &Setup,
    tuner: &mut Tuner,
    (voids, mut plan, more): (Voids, CutPlan, Moments),
    request: &PlanRequest,
) -> Result<Made, Error> {
    let goal = &setup.placement.goal;
    let voids = tuner.tuned(voids, more)?.finished()?;
    let parts = written_parts(setup, &voids, &mut plan, request)?;
    let whole = written_moments(&parts) + joined(setup, &plan);
    let inside = inside(setup, &voids.hollowed);
    let defect_ratio = defect_ratio(
        goal,
        &voids.solution.moments,
        &(whole + inside).in_frame(&goal.frame),
    );
    let more = whole - moments_of_mesh(&voids.hollowed.to_mesh());
    Ok(Made {
        voids,
        plan,
        parts,
        more,
        defect_ratio,
    })
}

/// Cuts the voids' body by the plan and writes its parts, in memory. Where the voids have changed
/// so that the plan leaves one closed, it is planned anew.
fn written_parts(
    setup: &Setup,
    voids: &Voids,
    plan: &mut CutPlan,
    request: &PlanRequest,
) -> Result<Vec<WrittenPart>, Error> {
    let (parts, refaced) = match parts_and_faces(&voids.hollowed, plan, request) {
        Err(CutError::ClosedCavity { .. }) => {
            let solid = std::mem::take(&mut plan.solid);
            *plan = CutPlan {
                solid,
                ..planned_once(setup, voids, request)?
            };
            parts_and_faces(&voids.hollowed, plan, request)?
        }
        parts => parts?,
    };
    *plan = refaced;
    let (job, count, scale_ratio) = (setup.name(), parts.len(), setup.printer.print_scale_ratio());
    parts
        .into_par_iter()
        .map(|part| WrittenPart::of(part, &job, count, scale_ratio))
        .collect()
}

/// What cuts, pins and poses are asked for.
pub fn plan_request(setup: &Setup) -> PlanRequest {
    let (printer, frame) = (&setup.printer, &setup.placement.goal.frame);
    let elephant_foot_mm = printer
        .number(Quantity::ElephantFootMm)
        .map_or(0.0, |foot| foot.value);
    let pixel_mm = printer.pixel_x_mm.value.max(printer.pixel_y_mm.value);
    PlanRequest {
        worth_ratio: WORTH_RATIO,
        wants_wide_joints: false,
        min_opening_mm: printer.min_opening_mm.value,
        cleaning: printer.cleaning_rule(),
        build_volume_mm: printer.usable_volume_mm(),
        wall_mm: minimum_wall_mm(setup),
        pins: PinSettings {
            min_diameter_mm: printer.pin_min_diameter_mm.value,
            length_ratio: printer.pin_length_ratio.value,
            clearance_mm: printer.clearance_per_side_mm.value,
            // The mouth of a socket that lies on the plate must be wider than what spreads there.
            chamfer_mm: printer.chamfer_mm.value.max(elephant_foot_mm),
            bottom_relief_mm: printer.socket_extra_depth_mm.value,
        },
        axis: GoalAxis {
            point: frame.origin,
            direction: frame.axis(),
        },
        pixel_mm,
        hole_step_mm: if printer.grid == Grid::Pixel {
            pixel_mm
        } else {
            0.0
        },
        layer_mm: printer.layer_mm.value,
        pose: match printer.print_pose {
            PrintPose::OpenHollowsUp => PosePreference::OpenHollowUp,
            PrintPose::CutFaceDown => PosePreference::CutFaceDown,
        },
        seats: seats(&setup.load),
        rods: setup.rods.clone(),
        labels: label_style(setup),
    }
}
