//! The checklist's rows from what the stages gave.

use std::collections::BTreeMap;

use super::finished_rows::{cup_mm3, turn_row};
use super::fitting::{half_of, halves, shallow_axle};
use super::joinery_rows::{
    bosses_mm3, cut_list, is_told_in_a_step, joint_id, joint_rows, joints_to_mind, round_rows,
};
use super::joining::{dowels, joined, mark};
use super::kit::{figure_name, verdict};
use super::printer_rows::{material_row, printer_row, scale_note, scaled};
use super::support_rows::{Surfaces, support_row};
use super::{Assembly, Setup, standing, void_rows, written::WrittenPart};
use crate::ballast::Placed;
use crate::cut::{CutPlan, PinSite};
use crate::geom::Vector;
use crate::goal::{GoalKind, Objective, Rotor, Warning, figures};
use crate::hollow;
use crate::mass::moments_of_mesh;
use crate::page::cup_warning;
use crate::sheet::{
    BallastRow, Certificate, Checklist, Course, FootRow, GoalRow, LogRow, ModelRow, PartRow,
    PassRow, SpeedRow, Tool, WallRow, finished_size_mm,
};
use crate::verify::{
    Aim, BallastOrder, FigureName, FillOrder, Fingerprint, Judgement, Peg, PromisedFigure,
    RotorOrder, WaterOrder,
};

/// A face whose normal has this much of the vertical is level, within 0.8°.
const LEVEL_COSINE: f64 = 0.9999;

/// Less than this left solid is not worth a warning, mm³: it would be told as nothing.
const LEAST_TOLD_MM3: f64 = 0.05;

/// What must be minded of anything hollow in water.
const SEAL: &str = "seal every joint: a void that fills with water sinks it or turns it over";

/// What must be minded of anything that floats, where its density was not measured.
const UNWEIGHED: &str = "how deep it floats rests on a density that was not measured: weigh coupons (equipoise coupon) and \
                         prepare again; every part too heavy by 1 % takes 1 % more water";

/// Everything a checklist is filled from.
pub struct Sheet<'a> {
    /// What the run rests on.
    pub setup: &'a Setup,
    /// What was made.
    pub assembly: &'a Assembly,
    /// What the judge found.
    pub judgement: &'a Judgement,
    /// What the buyer is told.
    pub promised: Option<PromisedFigure>,
}

/// The checklist, but for the hashes of the kit's files and the timings.
pub fn checklist(sheet: &Sheet) -> Checklist {
    let mut checklist = filled(sheet);
    checklist.warnings.extend(cup_warning(&checklist));
    checklist
}

fn filled(sheet: &Sheet) -> Checklist {
    let (setup, judgement) = (sheet.setup, sheet.judgement);
    let parts = part_rows(sheet);
    let foot = standing::foot_row(sheet);
    Checklist {
        schema: Checklist::SCHEMA,
        tool: Tool {
            name: env!("CARGO_PKG_NAME").to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
        },
        job: setup.name(),
        model: model_row(setup),
        printer: printer_row(setup),
        material: material_row(setup),
        goal: goal_row(setup),
        promise: sheet.promised,
        solid: judgement.solid.clone(),
        hollowed: judgement.hollowed.clone(),
        assembly: judgement.assembly.clone(),
        certificate: certificate(sheet),
        wall: WallRow {
            required_mm: setup.wall.wall_mm,
            asked_mm: setup.wall.asked_mm,
            measured_min_mm: judgement.wall_min_mm,
        },
        voids: void_rows::void_rows(sheet),
        cuts: void_rows::cut_rows(&sheet.assembly.plan),
        turn: turn_row(sheet, &parts),
        foot,
        parts,
        joints: joint_rows(sheet),
        grid: super::grid_rows::grid_rows(sheet),
        hardware: setup.hardware(),
        dowels: dowels(&sheet.assembly.plan),
        cut_list: cut_list(sheet),
        string_gap_mm: setup.string_gap_mm(),
        finished_size_mm: Some(finished_size_mm(
            &sheet.assembly.evidence(),
            &setup.hardware(),
        )),
        ballast: ballast_rows(sheet),
        fill: fill_order(setup),
        rounds: round_rows(sheet),
        checks: judgement.checks.clone(),
        verdict: verdict(judgement),
        warnings: warnings(sheet, foot.as_ref()),
        notes: notes(sheet),
        files: BTreeMap::new(),
        timing_s: None,
        log: sheet.assembly.solution.log.iter().map(log_row).collect(),
    }
}

/// The figure a goal is judged by.
pub fn promised_figure(kind: GoalKind, objective: Objective) -> FigureName {
    match (kind, objective) {
        (GoalKind::Top, _) => FigureName::CriticalSpeedRpm,
        (_, Objective::Dominance) => FigureName::DominanceRatio,
        (GoalKind::Yoyo, _) => FigureName::SpinItRatio,
        (GoalKind::Stand, Objective::LowestCenter) => FigureName::CenterHeightMm,
        (GoalKind::Stand, _) => FigureName::TopplesDeg,
        (GoalKind::Float, _) => FigureName::MetacentricHeightMm,
        (GoalKind::Balance, _) => FigureName::BalanceGradeMmS,
    }
}

/// The goal as the judge sees it.
pub fn aim(setup: &Setup) -> Aim {
    let goal = &setup.placement.goal;
    let rotor = goal.spindle.map(|spindle| {
        let Rotor {
            speed_rpm,
            grade_mm_s,
            ..
        } = spindle.rotor;
        RotorOrder {
            speed_rpm,
            grade_mm_s,
        }
    });
    let water = goal.afloat.map(|afloat| WaterOrder {
        liquid_g_cm3: setup
            .job
            .goal
            .water
            .unwrap_or_default()
            .liquid
            .density_g_cm3(),
        waterline_mm: afloat.waterline_mm,
    });
    Aim {
        rotor,
        water,
        ..Aim::new(
            goal.kind,
            goal.frame.origin.into(),
            goal.frame.axis().into(),
        )
    }
}

/// The density of the material, g/cm³.
pub fn density_g_cm3(setup: &Setup) -> f64 {
    setup.material.density_g_cm3.value
}

fn model_row(setup: &Setup) -> ModelRow {
    let model = &setup.model;
    let mesh = setup.bare.as_ref().unwrap_or(&model.solid).mesh();
    let file = setup.job.model.path.file_name().unwrap_or_default();
    ModelRow {
        file: file.to_string_lossy().into_owned(),
        sha256: model.sha256.clone(),
        triangles: mesh.triangles().len(),
        size_mm: mesh.aabb().size().into(),
        volume_mm3: moments_of_mesh(mesh).volume(),
        scale_ratio: model.scale_ratio,
    }
}

fn goal_row(setup: &Setup) -> GoalRow {
    let gap = setup
        .placement
        .warnings
        .iter()
        .find_map(|warning| match warning {
            Warning::ContactInAir { missing_mm } => Some(*missing_mm),
            _ => None,
        });
    let asked = setup.request.objective;
    let spin_it_weights = match asked {
        Objective::SpinIt { gamma_c, gamma_i } => Some([gamma_c, gamma_i]),
        _ => None,
    };
    GoalRow {
        aim: aim(setup),
        objective: asked.word().replace('-', "_"),
        spin_it_weights,
        contact_gap_mm: gap.unwrap_or(0.0),
        choice: setup.choice.clone(),
    }
}

fn certificate(sheet: &Sheet) -> Certificate {
    let certificate = &sheet.assembly.solution.certificate;
    let figure = figure_name(certificate.figure);
    let shown = |value: f64| shown(sheet.setup, certificate.figure, value);
    Certificate {
        figure,
        value: shown(certificate.value),
        bound: shown(certificate.bound),
        gap_ratio: certificate.gap_ratio,
        kept_solid_mm3: sheet.assembly.refused_mm3,
        value_before_cleaning: Some(shown(sheet.assembly.value_before_cleaning)),
        cleaning_rounds: void_rows::cleaning_rows(&sheet.assembly.cleaning, shown),
        bosses_mm3: bosses_mm3(sheet),
        over_heights: sheet.assembly.height_proof,
        written_value: written_value(sheet, figure),
        course: course(&sheet.assembly.course, shown),
    }
}

/// A value of a certificate's figure in the unit in which it is shown.
pub fn shown(setup: &Setup, figure: hollow::Figure, value: f64) -> f64 {
    match figure {
        hollow::Figure::TopplingAngleRad => value.to_degrees(),
        hollow::Figure::VolumeMm3 => value * setup.material.density_g_mm3(),
        _ => value,
    }
}

/// How the answer came about, in the units of the sheet.
fn course(found: &hollow::TopCourse, shown: impl Fn(f64) -> f64) -> Option<Course> {
    let pass = |pass: &hollow::Pass| PassRow {
        value: shown(pass.value),
        bound: shown(pass.bound),
    };
    let speed = |&[height_mm, critical_speed_rpm]: &[f64; 2]| SpeedRow {
        height_mm,
        critical_speed_rpm,
    };
    let (passes, speeds) = (
        found.passes.iter().map(pass).collect(),
        found.speeds.iter().map(speed).collect(),
    );
    (!found.passes.is_empty()).then_some(Course { passes, speeds })
}

/// The certificate's figure of the written assembly; Spin-It's functional with the weights it was
/// optimised with.
fn written_value(sheet: &Sheet, figure: FigureName) -> Option<f64> {
    let (setup, goal) = (sheet.setup, &sheet.setup.placement.goal);
    if figure != FigureName::SpinItRatio {
        return sheet.judgement.assembly.value_of(figure);
    }
    let joined = joined(setup, &sheet.assembly.plan);
    let whole = sheet.assembly.written_moments() + joined + setup.hardware_moments();
    figures(goal, &whole.in_frame(&goal.frame)).spin_it
}

fn part_rows(sheet: &Sheet) -> Vec<PartRow> {
    let found = &sheet.judgement.parts;
    let halves = halves(sheet.setup);
    let surfaces = Surfaces::of(sheet.assembly);
    sheet
        .assembly
        .parts
        .iter()
        .zip(found)
        .map(|(written, facts)| {
            let part = &written.part;
            let pins: Vec<Peg> = part
                .pins
                .iter()
                .map(|site| pin(site, &sheet.assembly.plan))
                .collect();
            let sockets: Vec<Peg> = part
                .sockets
                .iter()
                .map(|site| socket(site, &sheet.assembly.plan))
                .collect();
            let support = support_row(sheet.setup, &surfaces, written, [&pins, &sockets]);
            PartRow {
                id: part.id.clone(),
                file: written.file.clone(),
                sha256: crate::base::digest::sha256_hex(&[&written.bytes]),
                fingerprint: Some(Fingerprint::of(&written.read_back)),
                triangles: facts.surface.triangles,
                volume_mm3: facts.surface.volume_mm3,
                mass_g: facts.surface.volume_mm3 * sheet.setup.material.density_g_mm3(),
                size_mm: facts.size_mm,
                lies: lies(written, sheet),
                print_from_model: written.evidence().pose,
                pins,
                sockets,
                marks: part.labels.iter().map(mark).collect(),
                half: half_of(written, &halves),
                cup_mm3: cup_mm3(&written.read_back),
                support,
                picture: Some(crate::page::part_picture_file(&part.id)),
            }
        })
        .collect()
}

/// A pin as the sheet names it.
pub fn pin(site: &PinSite, plan: &CutPlan) -> Peg {
    Peg {
        id: site.id.clone(),
        joint: joint_of(site, plan),
        center_mm: site.center_mm,
        axis: site.direction,
        diameter_mm: site.diameter_mm,
        length_mm: site.length_mm,
        volume_mm3: site.pin_volume_mm3(),
    }
}

/// The pin's socket as the sheet names it.
pub fn socket(site: &PinSite, plan: &CutPlan) -> Peg {
    Peg {
        diameter_mm: site.socket_diameter_mm,
        length_mm: site.socket_depth_mm,
        volume_mm3: site.socket_volume_mm3(),
        ..pin(site, plan)
    }
}

/// The name of the joint a pin belongs to.
fn joint_of(pin: &PinSite, plan: &CutPlan) -> String {
    let joint = plan
        .joints
        .iter()
        .position(|joint| joint.pins.contains(&pin.id));
    joint.map(joint_id).unwrap_or_default()
}

/// The ballast as the judge sees it.
pub fn ballast_orders(setup: &Setup) -> Vec<BallastOrder> {
    let order = |(index, placed): (usize, &Placed)| BallastOrder {
        id: format!("B{}", index + 1),
        lump: placed.lump,
    };
    setup.load.parts.iter().enumerate().map(order).collect()
}

/// The filling as the judge sees it.
pub fn fill_order(setup: &Setup) -> Option<FillOrder> {
    setup.job.fill.map(|filling| FillOrder {
        density_g_cm3: filling.density_g_cm3(),
    })
}

fn ballast_rows(sheet: &Sheet) -> Vec<BallastRow> {
    let (load, voids) = (&sheet.setup.load, &sheet.assembly.plan.voids);
    let pockets = &voids[voids.len().saturating_sub(load.parts.len())..];
    let rows = ballast_orders(sheet.setup)
        .into_iter()
        .zip(&load.parts)
        .zip(pockets);
    rows.map(|((order, Placed { part, .. }), pocket)| BallastRow {
        order,
        part: part.id.clone(),
        name: part.name.clone(),
        void: void_rows::void_id(pocket.void),
        opened_by: pocket.opened_by.clone(),
        clearance_mm: load.fit.clearance_mm,
        mass_spread_ratio: part.mass_spread_ratio,
        sources: [&part.size, &part.mass].map(|known| format!("{}: {}", known.sure, known.source)),
    })
    .collect()
}

fn warnings(sheet: &Sheet, foot: Option<&FootRow>) -> Vec<String> {
    let setup = sheet.setup;
    let foot = foot.map(standing::flat_foot);
    let placement = setup
        .placement
        .warnings
        .iter()
        .chain(&foot)
        .map(ToString::to_string);
    let repairs = setup.model.repairs.notable();
    let repairs = (!repairs.is_empty()).then(|| format!("the model was repaired: {repairs}"));
    let refused = sheet.assembly.refused_mm3;
    let which = if sheet.assembly.cleaning.iter().any(|round| round.by_plan) {
        "that could not be cleaned, or that the plan keeps solid,"
    } else {
        "that could not be cleaned"
    };
    let small = (refused >= LEAST_TOLD_MM3)
        .then(|| format!("{refused:.1} mm³ of voids {which} stay solid"));
    let floats = setup.placement.goal.kind == GoalKind::Float;
    let seal = floats.then(|| SEAL.to_owned());
    let unweighed = (floats && !setup.material.is_measured()).then(|| UNWEIGHED.to_owned());
    let told = placement
        .chain(repairs)
        .chain(small)
        .chain(seal)
        .chain(unweighed)
        .chain(shallow_axle(setup));
    told.chain(joints_to_mind(&sheet.assembly.plan)).collect()
}

fn notes(sheet: &Sheet) -> Vec<String> {
    let wall = sheet.setup.wall.why.clone();
    let scale = scaled(sheet.setup.printer.print_scale_ratio()).map(scale_note);
    let planned = sheet
        .assembly
        .plan
        .notes
        .iter()
        .filter(|note| !is_told_in_a_step(note))
        .cloned();
    std::iter::once(wall).chain(scale).chain(planned).collect()
}

fn log_row(row: &hollow::LogRow) -> LogRow {
    let figures = [
        ("passes", row.passes as f64),
        ("value", row.value),
        ("bound", row.bound),
        ("residual", row.residual),
    ];
    let finite = figures.into_iter().filter(|(_, value)| value.is_finite());
    LogRow {
        phase: stage_words(row.stage),
        figures: finite
            .map(|(name, value)| (name.to_owned(), value))
            .collect(),
    }
}

fn stage_words(stage: hollow::Stage) -> String {
    use hollow::Stage;
    match stage {
        Stage::Goal => "goal".to_owned(),
        Stage::Dominance => "dominance".to_owned(),
        Stage::HeightRange => "range of heights".to_owned(),
        Stage::AtHeight { height_mm } => format!("centre at {height_mm:.3} mm"),
        Stage::AtLever {
            height_mm,
            lever_mm4,
        } => {
            format!("centre at {height_mm:.3} mm, lever {lever_mm4:.0} mm⁴")
        }
        Stage::Cover { height_mm } => format!("no better height near {height_mm:.3} mm"),
    }
}

/// How a part lies on the plate, in words: which of its cut faces looks down or up.
fn lies(written: &WrittenPart, sheet: &Sheet) -> String {
    let pose = written.evidence().pose;
    let center = written.part.solid.mesh().aabb().center();
    let facing = |cut: &crate::cut::Cut| {
        let plane = cut.plane().ok()?;
        let outward: Vector = -plane.normal * plane.distance(&center).signum();
        match (pose.rotation() * outward).z {
            z if z < -LEVEL_COSINE => Some(format!("cut face {} down", cut.id)),
            z if z > LEVEL_COSINE => Some(format!("cut face {} up", cut.id)),
            _ => None,
        }
    };
    let facing: Vec<String> = sheet
        .assembly
        .plan
        .cuts_of(&written.part.id)
        .filter_map(facing)
        .collect();
    if facing.is_empty() {
        "as the model stands".to_owned()
    } else {
        facing.join(", ")
    }
}
