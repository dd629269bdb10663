//! From the quadric to written parts that meet the goal: voids, cuts, parts, and the correction of their defect.

use rayon::prelude::*;

use super::{Error, Setup, Solved, phase, stopwatch::Stopwatch, tuning::is_tuned};
use crate::cut::{
    self, CutError, CutPlan, GoalAxis, Part, PinSettings, PlanRequest, PosePreference, parts, plan,
    plan_for_cuts,
};
use crate::hollow::Solution;
use crate::io::stl;
use crate::job::CutMode;
use crate::mass::{Moments, moments_of_mesh};
use crate::mesh::{Crossings, Hollowed, TriMesh, weld};
use crate::printer::PrintPose;
use crate::progress::Progress;
use crate::verify::{PartEvidence, Pose, assembly_moments};
use crate::voids::{Cavity, CavitySpec, Voids as Bodies};

/// Rounds of measuring and solving again, at most. Two bring the parts to a micrometre; a third would only follow
/// pins that came to lie elsewhere.
const MAX_ROUNDS: usize = 4;
/// The surface of a void may lie this share of a pixel from the true one.
const SURFACE_TOLERANCE_PIXELS: f64 = 0.5;
/// No finer than this, mm: below, triangles grow without any printer showing it.
const FINEST_SURFACE_TOLERANCE_MM: f64 = 0.02;

/// Places on the plate that are tried until a part's file is free of folds. Each of them folds another sliver of a
/// thousand, so few are needed.
const PLACES: usize = 6;
/// From one place to the next, mm: far less than a part's room on the plate, and no multiple of a file's steps.
const PLACE_STEP_MM: [f64; 2] = [0.013_7, 0.009_1];

/// A part as it is written.
#[derive(Debug, Clone)]
pub struct WrittenPart {
    /// The part.
    pub part: Part,
    /// Its file, relative to the kit.
    pub file: String,
    /// The bytes of its STL file.
    pub bytes: Vec<u8>,
    /// The triangles read back from those bytes, print pose.
    pub read_back: TriMesh,
}

/// The parts of a kit, tuned so that what is written meets the goal.
#[derive(Debug, Clone)]
pub struct Assembly {
    /// The solution the parts were made from.
    pub solution: Solution,
    /// The uncut body.
    pub hollowed: Hollowed,
    /// The volume of voids that were too small to clean and stay solid, mm³.
    pub refused_mm3: f64,
    /// The cuts and pins.
    pub plan: CutPlan,
    /// The parts.
    pub parts: Vec<WrittenPart>,
    /// The moments of nothing emptied that the solution was found with, goal frame.
    fixed: Moments,
    /// How many times it was solved again.
    pub rounds: usize,
}

impl Assembly {
    /// Makes the parts of a solution, measures what would be written, and solves again with the difference until the written
    /// parts meet the goal (THEORY §4).
    pub fn corrected(
        setup: &Setup,
        solved: Solved,
        progress: &Progress,
        watch: &mut Stopwatch,
    ) -> Result<Self, Error> {
        progress.report(phase::SHELL, 0.0);
        let spec = cavity_spec(setup);
        let cavity = Cavity::extract(&setup.model.solid, &spec, progress)?;
        watch.lap("shell");
        let source = Source { setup, solved: &solved, cavity: &cavity };
        let tuned = source.tuned()?;
        watch.lap("voids");
        progress.report(phase::PARTS, 0.0);
        let assembly = source.with_parts(tuned)?;
        watch.lap("parts");
        Ok(assembly)
    }

    /// The moments of the written parts put together, model frame.
    pub fn written_moments(&self) -> Moments {
        assembly_moments(&self.evidence())
    }

    /// The parts as the judge sees them.
    pub fn evidence(&self) -> Vec<PartEvidence> {
        self.parts.iter().map(WrittenPart::evidence).collect()
    }
}

impl WrittenPart {
    /// The part as it is written and read back, at the first place on the plate where the rounding of the file's
    /// coordinates folds no sliver of its surface.
    fn of(part: Part, job: &str, count: usize) -> Result<Self, Error> {
        let name = format!("{job}_{}of{count:02}", part.id);
        let mut written = Self::at_place(part.clone(), &name, 0)?;
        for place in 1..PLACES {
            if Crossings::of(&weld(&written.read_back)).pairs == 0 {
                break;
            }
            written = Self::at_place(part.clone(), &name, place)?;
        }
        Ok(written)
    }

    /// The part written at one of the places tried.
    fn at_place(mut part: Part, name: &str, place: usize) -> Result<Self, Error> {
        let pose = &mut part.pose.print_from_model;
        pose[0][3] += PLACE_STEP_MM[0] * place as f64;
        pose[1][3] += PLACE_STEP_MM[1] * place as f64;
        let pose = Pose { rows: *pose };
        let laid = part.solid.mesh().map_vertices(|p| pose.to_print(p));
        let bytes = stl::encode(&laid, name);
        let read_back = stl::decode(&bytes)?;
        Ok(Self { part, file: format!("parts/{name}.stl"), bytes, read_back })
    }

    /// The part as the judge sees it.
    pub fn evidence(&self) -> PartEvidence {
        let pose = Pose { rows: self.part.pose.print_from_model };
        PartEvidence { id: self.part.id.clone(), mesh: self.read_back.clone(), pose }
    }
}

/// The voids of a solution.
struct Voids {
    solution: Solution,
    fixed: Moments,
    hollowed: Hollowed,
    refused_mm3: f64,
    rounds: usize,
}

/// What the voids of a setup are made from.
struct Source<'a> {
    setup: &'a Setup,
    solved: &'a Solved,
    cavity: &'a Cavity,
}

impl Source<'_> {
    /// The voids of the first solution.
    fn first(&self) -> Result<Voids, Error> {
        self.voids(self.solved.solution.clone(), self.setup.placement.goal.solid, 0)
    }

    /// The voids solved for once more, with `defect` (goal frame) added to what stays.
    fn corrected(&self, fixed: Moments, defect: Moments, rounds: usize) -> Result<Voids, Error> {
        let fixed = fixed + defect;
        self.voids(self.solved.corrected(self.setup, fixed), fixed, rounds + 1)
    }

    fn voids(&self, solution: Solution, fixed: Moments, rounds: usize) -> Result<Voids, Error> {
        let (setup, frame) = (self.setup, &self.setup.placement.goal.frame);
        let Bodies { bodies, dropped_mm3, .. } = self.cavity.void_bodies(&solution.quadric, frame)?;
        let hollowed = Hollowed { outer: setup.model.solid.clone(), voids: bodies };
        Ok(Voids { solution, fixed, hollowed, refused_mm3: dropped_mm3, rounds })
    }

    /// The voids whose uncut mesh meets the goal's constraints, before cuts and pins.
    fn tuned(&self) -> Result<Voids, Error> {
        let goal = &self.setup.placement.goal;
        let mut voids = self.first()?;
        while voids.rounds < MAX_ROUNDS {
            let written = moments_of_mesh(&voids.hollowed.to_mesh()).in_frame(&goal.frame);
            if is_tuned(goal, &written) {
                break;
            }
            voids = self.corrected(voids.fixed, written - voids.solution.moments, voids.rounds)?;
        }
        Ok(voids)
    }

    /// The parts of tuned voids, solved for again until they too meet the goal as written.
    fn with_parts(&self, voids: Voids) -> Result<Assembly, Error> {
        let request = plan_request(self.setup);
        let plan = match self.setup.job.cut {
            CutMode::Auto => plan(&voids.hollowed, &request)?,
            CutMode::Never => plan_for_cuts(&voids.hollowed, &request, &[])?,
        };
        let goal = &self.setup.placement.goal;
        let most = voids.rounds + MAX_ROUNDS;
        let mut assembly = assembled(self.setup, voids, plan, &request)?;
        while assembly.rounds < most {
            let written = assembly.written_moments().in_frame(&goal.frame);
            if is_tuned(goal, &written) {
                break;
            }
            let defect = written - assembly.solution.moments;
            let voids = self.corrected(assembly.fixed, defect, assembly.rounds)?;
            assembly = assembled(self.setup, voids, assembly.plan, &request)?;
        }
        Ok(assembly)
    }
}

/// Cuts the voids' body by the plan and writes its parts, in memory. Where the voids have changed so that the plan leaves
/// one closed, it is planned anew.
fn assembled(setup: &Setup, voids: Voids, plan: CutPlan, request: &PlanRequest) -> Result<Assembly, Error> {
    let (plan, parts) = match parts(&voids.hollowed, &plan, request) {
        Err(CutError::ClosedCavity { .. }) => {
            let plan = cut::plan(&voids.hollowed, request)?;
            let parts = parts(&voids.hollowed, &plan, request)?;
            (plan, parts)
        }
        parts => (plan, parts?),
    };
    let (job, count) = (setup.name(), parts.len());
    let written = parts
        .into_par_iter()
        .map(|part| WrittenPart::of(part, &job, count))
        .collect::<Result<Vec<_>, _>>()?;
    let Voids { solution, fixed, hollowed, refused_mm3, rounds } = voids;
    Ok(Assembly { solution, fixed, hollowed, refused_mm3, plan, parts: written, rounds })
}

/// What the surface of the voids is made to.
fn cavity_spec(setup: &Setup) -> CavitySpec<'_> {
    let pixel_mm = setup.printer.pixel_x_mm.value.min(setup.printer.pixel_y_mm.value);
    CavitySpec {
        wall_mm: setup.wall.wall_mm,
        tolerance_mm: (SURFACE_TOLERANCE_PIXELS * pixel_mm).max(FINEST_SURFACE_TOLERANCE_MM),
        keeps: &setup.placement.keeps,
        min_void_mm: setup.printer.min_opening_mm.value,
    }
}

/// What cuts, pins and poses are asked for.
pub fn plan_request(setup: &Setup) -> PlanRequest {
    let (printer, frame) = (&setup.printer, &setup.placement.goal.frame);
    PlanRequest {
        min_opening_mm: printer.min_opening_mm.value,
        build_volume_mm: printer.build_volume_mm.as_ref().map(|volume| volume.value),
        wall_mm: printer.min_wall_mm.value,
        pins: PinSettings {
            min_diameter_mm: printer.pin_min_diameter_mm.value,
            length_ratio: printer.pin_length_ratio.value,
            clearance_mm: printer.clearance_per_side_mm.value,
            chamfer_mm: printer.chamfer_mm.value,
            bottom_relief_mm: printer.socket_extra_depth_mm.value,
        },
        axis: GoalAxis { point: frame.origin, direction: frame.axis() },
        pixel_mm: printer.pixel_x_mm.value.max(printer.pixel_y_mm.value),
        layer_mm: printer.layer_mm.value,
        pose: match printer.print_pose {
            PrintPose::OpenHollowsUp => PosePreference::OpenHollowUp,
            PrintPose::CutFaceDown => PosePreference::CutFaceDown,
        },
    }
}
