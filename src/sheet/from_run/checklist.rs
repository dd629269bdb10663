//! The checklist of a kit, section by section.

use std::collections::BTreeMap;

use super::certificate::{certificate, log_row};
use super::facts::Facts;
use super::finished::turn_row;
use super::foot::foot_row;
use super::grid::grid_rows;
use super::hardware::{dowels, hardware};
use super::joints::{cut_list, jig_rows, joint_rows, round_rows};
use super::parts::part_rows;
use super::printer::{material_row, printer_row};
use super::promise::{aim, ballast_orders, fill_order, infill_order, laid_order};
use super::remarks::{notes, offers, warnings};
use super::toolpaths::{print_time_row, toolpaths_row};
use super::voids::{cells_order, cut_rows, drain_holes, void_rows};
use crate::ballast::PlacedPart;
use crate::goal::{Objective, RoundKind, RoundSurface, Warning};
use crate::mass::moments_of_mesh;
use crate::mesh::{TriMesh, shells};
use crate::run::{AxisChoice, Placed};
use crate::sheet::{
    BallastRow, Checklist, GoalRow, ModelRow, RedrawnRow, ShaftKind, ShaftRow, ThickenedRow, Tool,
    Verdict, WallRow, finished_size_mm,
};

/// Fills the checklist, but for the hashes of the kit's files and the timings.
pub fn checklist(facts: &Facts) -> Checklist {
    let (placed, judgement) = (facts.placed, facts.judgement);
    let parts = part_rows(facts);
    let foot = foot_row(facts);
    let finished_mm = finished_size_mm(&facts.made.evidence(), &hardware(placed));
    let tolerance = &placed.shop.printer.tolerance;
    Checklist {
        schema: Checklist::SCHEMA,
        tool: Tool {
            name: env!("CARGO_PKG_NAME").to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
        },
        job: placed.name(),
        model: model_row(placed),
        printer: printer_row(&placed.shop.printer, placed.minimum_wall_mm()),
        material: material_row(&placed.shop.material),
        goal: goal_row(facts),
        promise: facts.promised,
        solid: judgement.solid.clone(),
        hollowed: judgement.hollowed.clone(),
        assembly: judgement.assembly.clone(),
        certificate: certificate(facts),
        wall: WallRow {
            required_mm: placed.shop.wall.wall_mm,
            asked_mm: placed.shop.wall.asked_mm,
            measured_min_mm: judgement.wall_min_mm,
        },
        voids: void_rows(facts),
        drains: drain_holes(facts.made),
        cells: cells_order(placed, facts.made),
        cuts: cut_rows(&facts.made.plan),
        turn: turn_row(facts, &parts),
        foot,
        parts,
        joints: joint_rows(facts),
        jigs: jig_rows(facts),
        plates: facts.plates.to_vec(),
        print_time: print_time_row(placed),
        grid: grid_rows(facts),
        hardware: hardware(placed),
        dowels: dowels(&facts.made.plan),
        cut_list: cut_list(facts),
        string_gap_mm: placed.string_gap_mm(),
        finished_size_mm: Some(finished_mm),
        size_tolerance_mm: Some(tolerance.at_mm(finished_mm.into_iter().fold(0.0, f64::max))),
        ballast: ballast_rows(facts),
        fill: fill_order(placed),
        infill: infill_order(placed, facts.made),
        laid: laid_order(placed),
        toolpaths: toolpaths_row(placed),
        rounds: round_rows(facts),
        checks: judgement.checks.clone(),
        verdict: Verdict::of(&judgement.checks),
        warnings: warnings(facts, foot.as_ref()),
        offers: offers(facts),
        notes: notes(facts),
        files: BTreeMap::new(),
        timing_s: None,
        log: facts.made.solution.log.iter().map(log_row).collect(),
    }
}

fn model_row(placed: &Placed) -> ModelRow {
    let model = &placed.model;
    let mesh = model.solid.mesh();
    let file = placed.job.model.path.file_name().unwrap_or_default();
    ModelRow {
        file: file.to_string_lossy().into_owned(),
        sha256: model.sha256.clone(),
        repair: placed.job.repair,
        redrawn: model.repairs.redrawn.map(|redrawn| RedrawnRow {
            within_mm: redrawn.within_mm,
            moved_mm: redrawn.moved_mm,
        }),
        triangles: mesh.triangles().len(),
        size_mm: mesh.aabb().size().into(),
        volume_mm3: outside_mm3(mesh),
        scale_ratio: model.scale_ratio,
        thickened: model.thickened.as_ref().map(|thick| ThickenedRow {
            wall_mm: thick.wall_mm,
            moved_mm: thick.moved_mm,
            added_mm3: thick.added_mm3,
        }),
    }
}

/// Returns the volume inside the outside of a mesh, with cavities that the model came with, mm³.
fn outside_mm3(mesh: &TriMesh) -> f64 {
    let shells = shells(mesh);
    let volumes = shells.iter().map(|shell| moments_of_mesh(shell).volume());
    volumes.filter(|volume| *volume > 0.0).sum()
}

fn goal_row(facts: &Facts) -> GoalRow {
    let placed = facts.placed;
    let gap = placed
        .placement
        .warnings
        .iter()
        .find_map(|warning| match warning {
            Warning::ContactInAir { missing_mm } => Some(*missing_mm),
            _ => None,
        });
    let asked = placed.request.objective;
    let spin_it_weights = match asked {
        Objective::SpinIt { gamma_c, gamma_i } => Some([gamma_c, gamma_i]),
        _ => None,
    };
    GoalRow {
        aim: aim(placed),
        objective: asked.into(),
        spin_it_weights,
        contact_gap_mm: gap.unwrap_or(0.0),
        spins_on: facts.judgement.spin,
        turns_on: turns_on(placed),
        choice: placed.choice.as_ref().map(ToString::to_string),
        off_natural_deg: match &placed.choice {
            Some(AxisChoice::NearNatural { nearby, .. }) => Some(nearby.off_deg),
            _ => None,
        },
    }
}

/// Returns the round surfaces that a rotor turns on; empty for other goals.
fn turns_on(placed: &Placed) -> Vec<ShaftRow> {
    let ordered = placed.request.rotor.and_then(|rotor| rotor.bore);
    let to_make = ordered.map(|bore| ShaftRow {
        kind: ShaftKind::BoreToMake,
        diameter_mm: bore.mm(),
    });
    let surfaces = match &placed.choice {
        Some(AxisChoice::OnShaft(shaft)) => shaft.surfaces.as_slice(),
        _ => &[],
    };
    let row = |surface: &RoundSurface| ShaftRow {
        kind: match surface.kind {
            RoundKind::Bore => ShaftKind::Bore,
            RoundKind::ShaftEnd => ShaftKind::ShaftEnd,
        },
        diameter_mm: surface.diameter_mm,
    };
    to_make
        .into_iter()
        .chain(surfaces.iter().map(row))
        .collect()
}

fn ballast_rows(facts: &Facts) -> Vec<BallastRow> {
    let load = &facts.made.load;
    let voids = facts.made.plan.voids.iter();
    let pockets = voids.filter(|void| void.part_opening_mm.is_some());
    let rows = ballast_orders(load)
        .into_iter()
        .zip(&load.parts)
        .zip(pockets);
    rows.map(|((order, PlacedPart { part, .. }), pocket)| BallastRow {
        order,
        part: part.id.clone(),
        name: part.name.clone(),
        void: pocket.void.to_string(),
        opened_by: pocket.opened_by.iter().map(ToString::to_string).collect(),
        clearance_mm: load.fit.clearance_mm,
        mass_spread_ratio: part.mass_spread_ratio,
        sources: [&part.size, &part.mass].map(|known| format!("{}: {}", known.sure, known.source)),
    })
    .collect()
}
