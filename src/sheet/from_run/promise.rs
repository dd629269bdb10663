//! The promise against which the files are judged.

use super::hardware::{dowels, hardware};
use super::joints::{joint_id, promised_jig, promised_joints};
use super::printer::enlargement;
use super::voids::{cells_order, drain_holes, promised_cuts, promised_voids};
use crate::ballast::{Load, PlacedPart};
use crate::base::digest::sha256_hex;
use crate::cut::{CutPlan, Label, PinSite};
use crate::goal::Rotor;
use crate::mesh::{TriMesh, shells};
use crate::repair::weld;
use crate::run::{Made, Placed, WrittenPart, WrittenRegion};
use crate::verify::{
    Aim, BallastOrder, Density, FillOrder, InfillLevel, InfillOrder, LaidOrder, Mark, Peg,
    PrinterLimits, Promise, PromisedPart, RotorOrder, SCHEMA, WallOrder, WaterOrder,
};

/// Returns the promise of the parts, without the figure that they reach.
pub fn promise(placed: &Placed, made: &Made) -> Promise {
    let (printer, plan) = (&placed.shop.printer, &made.plan);
    let parts = made.parts.iter();
    Promise {
        schema: SCHEMA,
        printer: PrinterLimits {
            process: printer.process.clone(),
            build_volume_mm: printer.usable_volume_mm(),
            print_scale_ratio: enlargement(printer.print_scale_ratio()),
            minimum_wall_mm: placed.minimum_wall_mm(),
            minimum_opening_mm: Some(printer.min_opening_mm.value),
            cleaning: Some(printer.cleaning_rule()),
            seam_step_mm: placed.seam_step_mm(),
            dialect: printer.dialect(),
            layer_mm: Some(printer.layer_mm.value),
            pixel_mm: Some([printer.pixel_x_mm.value, printer.pixel_y_mm.value]),
        },
        material: Density {
            density_g_cm3: placed.density_g_cm3(),
        },
        goal: aim(placed),
        promise: None,
        // The bound is proved again from the written kit only: it takes seconds.
        certificate: None,
        wall: WallOrder {
            required_mm: placed.shop.wall.wall_mm,
        },
        parts: parts.map(|part| promised_part(part, plan)).collect(),
        cuts: promised_cuts(plan),
        voids: promised_voids(placed, made),
        drains: drain_holes(made),
        cells: cells_order(placed, made),
        hardware: hardware(placed),
        dowels: dowels(plan),
        string_gap_mm: placed.string_gap_mm(),
        joints: promised_joints(placed, made),
        jigs: made.jigs.iter().map(promised_jig).collect(),
        plates: Vec::new(),
        ballast: ballast_orders(&made.load),
        fill: fill_order(placed),
        infill: infill_order(placed, made),
        laid: laid_order(placed),
        files: Default::default(),
    }
}

fn promised_part(written: &WrittenPart, plan: &CutPlan) -> PromisedPart {
    let part = &written.part;
    let sockets = part.sockets.iter();
    PromisedPart {
        id: part.id.to_string(),
        file: written.file.clone(),
        sha256: sha256_hex(&[&written.bytes]),
        fingerprint: None,
        print_from_model: written.evidence().pose,
        pins: part.pins.iter().map(|site| pin(site, plan)).collect(),
        sockets: sockets.map(|site| socket(site, plan)).collect(),
        marks: part.labels.iter().map(mark).collect(),
    }
}

/// Returns the goal as the judge reads it.
pub fn aim(placed: &Placed) -> Aim {
    let goal = &placed.placement.goal;
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
        liquid_g_cm3: placed
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
        wanted: placed.request.target,
        least_lean_deg: placed.request.promised_lean_deg(),
        least_angle_deg: placed.request.promised_angle_deg(),
        ..Aim::new(
            goal.kind,
            goal.frame.origin.into(),
            goal.frame.axis().into(),
        )
    }
}

/// Returns a pin as the sheet names it.
pub fn pin(site: &PinSite, plan: &CutPlan) -> Peg {
    Peg {
        id: site.id.to_string(),
        joint: joint_of(site, plan),
        center_mm: site.center_mm,
        axis: site.direction,
        diameter_mm: site.diameter_mm,
        length_mm: site.length_mm,
        volume_mm3: site.pin_volume_mm3(),
    }
}

/// Returns the pin's socket as the sheet names it.
pub fn socket(site: &PinSite, plan: &CutPlan) -> Peg {
    Peg {
        diameter_mm: site.socket_diameter_mm,
        length_mm: site.socket_depth_mm,
        volume_mm3: site.socket_volume_mm3(),
        ..pin(site, plan)
    }
}

/// Returns the name of the joint to which a pin belongs; empty if there is none.
fn joint_of(pin: &PinSite, plan: &CutPlan) -> String {
    let joint = plan
        .joints
        .iter()
        .position(|joint| joint.pins.contains(&pin.id));
    joint.map(joint_id).unwrap_or_default()
}

/// Returns the ballast as the judge reads it.
pub fn ballast_orders(load: &Load) -> Vec<BallastOrder> {
    let order = |(index, placed): (usize, &PlacedPart)| BallastOrder {
        id: format!("B{}", index + 1),
        lump: placed.lump,
    };
    load.parts.iter().enumerate().map(order).collect()
}

/// Returns the filling as the judge reads it.
pub fn fill_order(placed: &Placed) -> Option<FillOrder> {
    placed.job.fill.map(|filling| FillOrder {
        density_g_cm3: filling.density_g_cm3(),
    })
}

/// Returns the regions of sparse infill as the judge reads them; `None` for other prints.
pub fn infill_order(placed: &Placed, made: &Made) -> Option<InfillOrder> {
    let sparse = placed.sparse.as_ref()?;
    let written = made.parts.iter().find_map(|part| part.sparse.as_ref())?;
    let rows = infill_levels(placed, &written.regions);
    let (outermost, inner) = rows.split_first()?;
    let last = placed.job.sliced.last();
    Some(InfillOrder {
        pattern: sparse.pattern.clone(),
        nominal_ratio: outermost.nominal_ratio,
        laid_ratio: outermost.laid_ratio,
        regions: outermost.regions,
        volume_mm3: outermost.volume_mm3,
        mass_g: outermost.mass_g,
        slicer_ratio: last.and_then(|round| round.infill_ratio),
        beyond: last.map(|round| round.beyond),
        misses_mm: placed
            .job
            .sliced
            .iter()
            .map(|round| round.miss_mm)
            .collect(),
        file: outermost.file.clone(),
        field: sparse
            .field
            .as_ref()
            .map(|field| field.words(&made.solution, &placed.goal().frame)),
        smooth: made.smooth.as_ref().map(|smooth| {
            let frame = placed.goal().frame.inverse();
            smooth.in_frame(&frame).to_string()
        }),
        inner: inner.to_vec(),
    })
}

/// Returns what a slicer lays beyond the parts of a hollow kit, as the judge reads it; `None` if it
/// was not sliced, or is one piece.
pub fn laid_order(placed: &Placed) -> Option<LaidOrder> {
    let rounds = &placed.job.sliced;
    let last = rounds.last().filter(|_| placed.sparse.is_none())?;
    Some(LaidOrder {
        beyond: last.beyond,
        misses_mm: rounds.iter().map(|round| round.miss_mm).collect(),
    })
}

/// Returns a row for each region of infill, the outermost first.
fn infill_levels(placed: &Placed, regions: &[WrittenRegion]) -> Vec<InfillLevel> {
    let density_g_mm3 = placed.shop.material.density_g_mm3();
    let volume_mm3 = |region: &WrittenRegion| region.mesh.signed_volume_mm3();
    let row = |(index, region): (usize, &WrittenRegion)| {
        let within_mm3 = regions.get(index + 1).map_or(0.0, volume_mm3);
        let level = &region.level;
        InfillLevel {
            nominal_ratio: level.nominal_ratio,
            laid_ratio: level.laid_ratio,
            regions: bodies(&region.mesh),
            volume_mm3: volume_mm3(region),
            mass_g: level.laid_ratio * (volume_mm3(region) - within_mm3) * density_g_mm3,
            file: region.file.as_ref().map(|(file, _)| file.clone()),
        }
    };
    regions.iter().enumerate().map(row).collect()
}

/// Returns the number of bodies in a mesh; a denser core in one is no body of its own.
fn bodies(mesh: &TriMesh) -> usize {
    let shells = shells(&weld(mesh)).into_iter();
    shells
        .filter(|shell| shell.signed_volume_mm3() > 0.0)
        .count()
}

/// Returns a label as the judge reads it.
pub fn mark(label: &Label) -> Mark {
    Mark {
        text: label.text.clone(),
        cut: label.cut.to_string(),
        axis: label.into,
        depth_mm: label.depth_mm,
        stroke_mm: label.stroke_mm,
        strokes_mm: label.strokes().into_iter().map(Into::into).collect(),
        volume_mm3: label.volume_mm3(),
    }
}
