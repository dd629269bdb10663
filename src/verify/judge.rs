//! The judgement: every promise of a kit held against its files.

use rayon::prelude::*;

use super::pegs::{Felt, overlaps, pegs};
use super::{
    Check, Figures, FileChange, Fit, Hull, PartEvidence, PartFacts, PegFacts, Promise, Setting,
    Shells, Support, SurfaceFacts, VoidFacts, assembly_moments,
    ballast::{ballast_moments, fill_moments, least_room_mm},
    checks,
    cleaning::voids,
    hardware::{fit, mass_moments},
    joints::{film_error, film_moments, lost_strokes},
    rotor::ends_mm,
    smallest_wall_mm,
};
use crate::goal::GoalKind;
use crate::mass::moments_of_mesh;
use crate::mesh::TriMesh;
use crate::repair::weld;

/// What lies before the judge: the promises, and the meshes as they were read back from the files.
#[derive(Debug, Clone, PartialEq)]
pub struct Evidence {
    /// What was promised.
    pub promise: Promise,
    /// The uncut result, model frame, mm.
    pub hollowed: TriMesh,
    /// The parts, in the order of the checklist.
    pub parts: Vec<PartEvidence>,
}

/// What the judge found.
#[derive(Debug, Clone, PartialEq)]
pub struct Judgement {
    /// The figures of the outer surface filled solid.
    pub solid: Figures,
    /// The figures of the uncut result with its ballast.
    pub hollowed: Figures,
    /// The figures of the parts put together with the ballast.
    pub assembly: Figures,
    /// What is true of the uncut result's surface.
    pub surface: SurfaceFacts,
    /// What is true of each part.
    pub parts: Vec<PartFacts>,
    /// The smallest wall between a void and the outside, mm; none without voids.
    pub wall_min_mm: Option<f64>,
    /// How the hardware sits in the outer surface; none without hardware.
    pub fit: Option<Fit>,
    /// The least gap around a part of ballast, mm; none without ballast.
    pub ballast_room_mm: Option<f64>,
    /// Every pin and its socket, as found in the files.
    pub pegs: Vec<PegFacts>,
    /// How many of a sample of places just under the parts' surfaces lie in another part too.
    pub overlaps: usize,
    /// How every void lies open in the parts; none where no cleaning was ordered.
    pub voids: Vec<VoidFacts>,
    /// By how much of it a film of glue differs from its faces at worst, and in which joint; none
    /// without films.
    pub film_error: Option<(f64, String)>,
    /// How many strokes of engraved ids are not in their files as deep as promised; none without
    /// ids.
    pub lost_strokes: Option<usize>,
    /// Every promise with its verdict.
    pub checks: Vec<Check>,
    /// What became of the files since the kit was made; empty while it is made.
    pub changes: Vec<FileChange>,
}

impl Judgement {
    /// Whether every promise is kept.
    pub fn passes(&self) -> bool {
        self.checks.iter().all(|check| check.pass)
    }
}

/// Measures the evidence and holds every promise against it.
///
/// Exact integrals of the written triangles; the wall is the distance between triangles. Some
/// seconds for a million triangles; the same judgement on any number of threads.
pub fn judge(evidence: &Evidence) -> Judgement {
    let promise = &evidence.promise;
    let welded = weld(&evidence.hollowed);
    let shells = Shells::of_mesh(&welded);
    let outer = shells.outer_mesh();
    let setting = setting(promise, &outer);
    let load = ballast_moments(&promise.ballast, setting.density_g_mm3())
        + fill_moments(promise.fill, &shells.inner_mesh(), setting.density_g_cm3);
    let figures_of = |moments| Figures::loaded(&moments, &load, &setting);
    let joined =
        (film_moments(promise) + mass_moments(&promise.dowels)) * setting.density_g_mm3().recip();
    let assembled = assembly_moments(&evidence.parts);
    let felt: Vec<Felt> = evidence.parts.par_iter().map(Felt::of).collect();
    let mut judgement = Judgement {
        solid: Figures::new(&moments_of_mesh(&outer), &setting),
        hollowed: figures_of(moments_of_mesh(&welded)),
        assembly: Figures::loaded(&assembled, &(load + joined), &setting),
        surface: SurfaceFacts::of_mesh(&welded),
        parts: evidence.parts.par_iter().map(PartFacts::of_part).collect(),
        wall_min_mm: smallest_wall_mm(&shells),
        fit: fit(
            &promise.hardware,
            &promise.goal,
            (&outer, promise.wall.required_mm),
        ),
        ballast_room_mm: least_room_mm(&promise.ballast, &welded, &outer),
        pegs: pegs(&evidence.promise, &felt, &evidence.hollowed),
        overlaps: overlaps(&felt),
        voids: voids(promise, &shells.inward, &felt),
        film_error: film_error(promise, &evidence.parts),
        lost_strokes: lost_strokes(promise, &felt),
        checks: Vec::new(),
        changes: Vec::new(),
    };
    judgement.checks = checks(promise, &judgement);
    judgement
}

/// How the bodies of a kit are looked at: its goal, and what the goal needs of the outer surface.
pub fn setting(promise: &Promise, outer: &TriMesh) -> Setting {
    let aim = promise.goal;
    let support = (aim.kind == GoalKind::Stand).then(|| Support::of_mesh(outer, &aim.frame()));
    let ends_mm = (aim.kind == GoalKind::Balance).then(|| ends_mm(outer, &aim.frame()));
    let hull = (aim.kind == GoalKind::Float).then(|| Hull::new(outer, &aim.frame()));
    let hardware = mass_moments(&promise.hardware);
    Setting {
        density_g_cm3: promise.material.density_g_cm3,
        aim,
        support,
        ends_mm,
        hull,
        hardware,
    }
}
