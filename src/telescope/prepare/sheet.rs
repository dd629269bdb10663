//! The checklist of a telescope, filled from what was made.

use std::collections::BTreeMap;

use super::asked::Asked;
use super::balance::{Standing, tilt_rad};
use super::made::{Made, PartKind, WrittenPart};
use super::motion_file::motion;
use super::nested;
use super::poses::{Lies, NO_SUPPORT};
use crate::base::digest::sha256_hex;
use crate::base::units::MM3_PER_CM3;
use crate::curve::{frechet_mm, hausdorff_mm};
use crate::geom::Aabb;
use crate::job::telescope::Lock;
use crate::mass::moments_of_mesh;
use crate::printer::{Quantity, Support, Sure};
use crate::sheet::Verdict;
use crate::sheet::telescope::{
    CurveRow, FootRow, JointRow, JointSizesRow, ShellRow, TELESCOPE_SHEET_SCHEMA,
    TelescopeMaterial, TelescopePartRow, TelescopePrinter, TelescopeSheet,
};
use crate::telescope::balance::DiscFoot;
use crate::telescope::motion::{Key, Order};
use crate::telescope::nest::{Joint, Shell, Telescope};
use crate::telescope::sizes::JointSizes;
use crate::verify::{
    BalancePromise, DeviationPromise, JointPromise, PrinterLimits, TelescopePartPromise,
};

/// The process that lays down filament.
const FILAMENT: &str = "fdm";
/// Samples of each shell between which the Fréchet distance is taken.
const FRECHET_SAMPLES: usize = 20;
/// By how much before flange and lip meet the whole clearance is free, mm.
const FREE_MM: f64 = 0.5;
/// By how many clearances a shell must be pushed back until it is held from behind.
const BACK_CLEARANCES: f64 = 3.0;
/// And by how much more on the inside of a bend, mm.
const BACK_MM: f64 = 0.5;

/// Returns the checklist, but for its checks and the hashes of other files.
pub fn checklist(asked: &Asked, made: &Made) -> TelescopeSheet {
    let mut sheet = ordered(asked, made);
    add_parts(&mut sheet, asked, made);
    add_figures(&mut sheet, asked, made);
    add_balance(&mut sheet, made);
    sheet
}

/// Returns the sheet of an order, without what was made.
fn ordered(asked: &Asked, made: &Made) -> TelescopeSheet {
    let sizes = &made.best.design.telescope.sizes;
    TelescopeSheet {
        schema: TELESCOPE_SHEET_SCHEMA,
        kind: "telescope",
        job: asked.job.name(),
        version: env!("CARGO_PKG_VERSION"),
        verdict: Verdict::Fail,
        printer: printer(asked),
        material: material(asked),
        curve: curve(asked),
        joint_sizes: joint_sizes(sizes),
        wall_mm: sizes.wall_mm,
        clearance_mm: sizes.slide_mm,
        clearance_source: asked.slide.provenance(),
        is_clearance_proved: asked.slide.sure == Sure::Measured,
        is_pressed: asked.job.lock == Lock::Press,
        in_place: sizes.is_in_place(),
        shells: Vec::new(),
        parts: Vec::new(),
        part_rows: Vec::new(),
        joints: Vec::new(),
        joint_rows: Vec::new(),
        order: Vec::new(),
        order_words: String::new(),
        least_gap_mm: None,
        deviation: DeviationPromise {
            max_mm: 0.0,
            rms_mm: 0.0,
        },
        frechet_mm: 0.0,
        hausdorff_mm: 0.0,
        within_mm: asked.within_mm,
        paper_rms_mm: made.best.guess_rms_mm,
        tip_play_mm: 0.0,
        mass_g: 0.0,
        balance: Vec::new(),
        worst_toppling_deg: None,
        least_angle_deg: asked.stands().then_some(asked.job.least_angle_deg),
        foot: made.foot.map(foot_row),
        ballast: made.ballast.clone(),
        collapsed_mm: [0.0; 3],
        extended_mm: [0.0; 3],
        ratio: 0.0,
        trade: made.best.rows.clone(),
        poses: Vec::new(),
        warnings: warnings(asked, made),
        checks: Vec::new(),
        files: BTreeMap::new(),
    }
}

/// Adds the shells, parts and joints.
fn add_parts(sheet: &mut TelescopeSheet, asked: &Asked, made: &Made) {
    let design = &made.best.design;
    let telescope = &design.telescope;
    let parts = || made.parts.iter();
    sheet.shells = shells(made);
    sheet.parts = parts().map(|part| promised_part(telescope, part)).collect();
    sheet.part_rows = parts().map(|part| part_row(asked, part)).collect();
    sheet.joints = promised_joints(made);
    sheet.joint_rows = joint_rows(asked, made);
    sheet.order = motion(made).order;
    sheet.order_words = order_words(&design.opening.order, telescope.joints.len());
}

/// Adds what was reached: deviation, gaps, boxes.
fn add_figures(sheet: &mut TelescopeSheet, asked: &Asked, made: &Made) {
    let design = &made.best.design;
    let telescope = &design.telescope;
    let chain = design.fit.chain.samples(FRECHET_SAMPLES);
    let target = asked
        .curve
        .samples(telescope.shells.len() * FRECHET_SAMPLES);
    let gap_mm = design.opening.least.gap_mm;
    sheet.least_gap_mm = gap_mm.is_finite().then_some(gap_mm);
    sheet.deviation = DeviationPromise {
        max_mm: design.fit.deviation.max_mm,
        rms_mm: design.fit.deviation.rms_mm,
    };
    sheet.frechet_mm = frechet_mm(&chain, &target);
    sheet.hausdorff_mm = hausdorff_mm(&chain, &target);
    sheet.tip_play_mm = tip_play_mm(telescope);
    let keys = &design.opening.keys;
    let ends = [keys.first(), keys.last()];
    [sheet.collapsed_mm, sheet.extended_mm] =
        ends.map(|key| key.map_or([0.0; 3], |key| size_mm(made, telescope, key)));
    sheet.ratio = asked.curve.length_mm() / sheet.collapsed_mm[0];
}

/// Adds the mass and the balance along the motion.
fn add_balance(sheet: &mut TelescopeSheet, made: &Made) {
    let design = &made.best.design;
    let standing = standing(&design.telescope, made);
    let volume_mm3: f64 = made.masses.iter().map(|mass| mass.volume_mm3).sum();
    sheet.mass_g = volume_mm3 / MM3_PER_CM3 * sheet.material.density_g_cm3;
    let keys = design.opening.keys.iter();
    sheet.balance = keys.map(|key| balance_row(&standing, key)).collect();
    let lowest = standing.lowest_over(&design.opening);
    let is_clear = lowest.is_none_or(|lowest| standing.is_clear(&lowest));
    let worst = is_clear.then(|| standing.worst(&design.opening).1);
    sheet.worst_toppling_deg = worst.map(|worst| worst.sagged_rad.to_degrees());
}

pub fn material(asked: &Asked) -> TelescopeMaterial {
    let material = &asked.shop.material;
    TelescopeMaterial {
        id: material.id.clone(),
        name: material.name.clone(),
        density_g_cm3: material.density_g_cm3.value,
    }
}

fn curve(asked: &Asked) -> CurveRow {
    CurveRow {
        source: asked.job.in_kit().curve.source,
        sha256: asked.file.as_ref().map(|file| file.sha256.clone()),
        length_mm: asked.curve.length_mm(),
    }
}

fn joint_sizes(sizes: &JointSizes) -> JointSizesRow {
    JointSizesRow {
        seat_mm: sizes.seat_mm,
        engagement_mm: sizes.engagement_mm,
        flange_mm: sizes.flange_mm,
        lip_mm: sizes.lip_mm,
        overlap_mm: sizes.overlap_mm(),
        glue_mm: sizes.glue_mm,
        chamfer_mm: sizes.chamfer_mm,
    }
}

pub fn foot_row(foot: DiscFoot) -> FootRow {
    FootRow {
        radius_mm: foot.radius_mm,
        height_mm: foot.height_mm,
    }
}

pub fn printer(asked: &Asked) -> TelescopePrinter {
    let printer = &asked.shop.printer;
    let scale = printer.print_scale_ratio();
    TelescopePrinter {
        id: printer.id.clone(),
        name: printer.name.clone(),
        layer_mm: printer.layer_mm.value,
        is_filament: printer.process.as_deref() == Some(FILAMENT),
        glue: printer.glue.clone(),
        glue_safety: printer.glue_safety.clone(),
        glue_hold_s: asked.number(Quantity::GlueHoldS),
        glue_cure_h: asked.number(Quantity::GlueCureH),
        limits: PrinterLimits {
            process: printer.process.clone(),
            build_volume_mm: printer.usable_volume_mm(),
            print_scale_ratio: (scale != [1.0; 3]).then_some(scale),
            minimum_wall_mm: printer.min_wall_mm.value,
            ..PrinterLimits::default()
        },
    }
}

fn shells(made: &Made) -> Vec<ShellRow> {
    let telescope = &made.best.design.telescope;
    let bore = |i: usize| {
        let joint = telescope.joints.get(i);
        let own = telescope.shells[i].body_mm - telescope.sizes.wall_mm;
        joint.map_or(own, |joint| joint.radii.bore_mm)
    };
    let shells = telescope.shells.iter().enumerate();
    let row = |(i, shell): (usize, &Shell)| ShellRow {
        id: made.shell_id(i),
        curvature: shell.helix.curvature,
        torsion: shell.helix.torsion,
        visible_mm: telescope.visible_mm,
        body_mm: shell.body_mm,
        bore_mm: bore(i),
    };
    shells.map(row).collect()
}

fn promised_part(telescope: &Telescope, part: &WrittenPart) -> TelescopePartPromise {
    let vent = telescope.vent_of(part.shell);
    TelescopePartPromise {
        id: part.id.clone(),
        shell: part.shell + 1,
        is_tube: part.kind == PartKind::Shell,
        body_mm: telescope.shells[part.shell].body_mm,
        file: part.file.clone(),
        sha256: sha256_hex(&[&part.bytes]),
        print_from_shell: part.pose,
        vent_mm: vent.map(|vent| [vent.arc_mm, vent.radius_mm]),
    }
}

fn part_row(asked: &Asked, part: &WrittenPart) -> TelescopePartRow {
    let volume_mm3 = moments_of_mesh(&part.read_back).volume();
    let support = match asked.shop.printer.support {
        Support::Breakaway => part.lies.support_words(),
        _ => NO_SUPPORT,
    };
    TelescopePartRow {
        id: part.id.clone(),
        lies: part.lies.words().to_owned(),
        size_mm: part.read_back.aabb().size().into(),
        mass_g: volume_mm3 / MM3_PER_CM3 * asked.shop.material.density_g_cm3.value,
        is_free_of_support: support == NO_SUPPORT,
        support,
    }
}

fn promised_joints(made: &Made) -> Vec<JointPromise> {
    let telescope = &made.best.design.telescope;
    let sizes = &telescope.sizes;
    let joints = telescope.joints.iter().enumerate();
    let promise = |(i, joint): (usize, &Joint)| JointPromise {
        id: made.joint_id(i),
        stop_mm: telescope.visible_mm + joint.stop_room_mm,
        free_to_mm: telescope.visible_mm
            - sizes.flange_mm.max(sizes.lip_mm)
            - sizes.rise_mm()
            - FREE_MM,
        back_mm: sizes.closed_mm() - BACK_CLEARANCES * sizes.slide_mm - BACK_MM,
        play_rad: joint.play_rad,
    };
    joints.map(promise).collect()
}

fn joint_rows(asked: &Asked, made: &Made) -> Vec<JointRow> {
    let telescope = &made.best.design.telescope;
    let printer = &asked.shop.printer;
    // The cones of flange and lip are at 45°: an error of both radii moves the stop by as much.
    let tolerance_mm = printer.tolerance.least_mm.value + printer.layer_mm.value;
    let joints = telescope.joints.iter().enumerate();
    let row = |(i, joint): (usize, &Joint)| JointRow {
        id: made.joint_id(i),
        shells: [made.shell_id(i), made.shell_id(i + 1)],
        stroke_mm: telescope.visible_mm - telescope.sizes.closed_mm(),
        tolerance_mm,
        turn_deg: joint.turn_rad.to_degrees(),
        play_deg: joint.play_rad.to_degrees(),
        tilt_deg: tilt_rad(joint.seat_mm, &telescope.sizes).to_degrees(),
    };
    joints.map(row).collect()
}

/// Words the order of opening.
fn order_words(order: &Order, joints: usize) -> String {
    let words = if *order == Order::root_first(joints) {
        "from the root to the tip"
    } else if *order == Order::tip_first(joints) {
        "from the tip to the root"
    } else {
        "in the order of the list"
    };
    words.to_owned()
}

/// Returns the distance by which the tip moves if all joints tilt the same way, mm.
fn tip_play_mm(telescope: &Telescope) -> f64 {
    let count = telescope.joints.len();
    let joints = telescope.joints.iter().enumerate();
    let plays = joints.map(|(i, joint)| {
        let beyond_mm = telescope.visible_mm * (count - i) as f64;
        tilt_rad(joint.seat_mm, &telescope.sizes) * beyond_mm
    });
    plays.sum()
}

/// Returns a made telescope on its foot, or on the root's own cap.
pub fn standing<'a>(telescope: &'a Telescope, made: &'a Made) -> Standing<'a> {
    let own = DiscFoot {
        pocket_mm: None,
        radius_mm: telescope.shells[0].body_mm,
        height_mm: 0.0,
    };
    Standing {
        telescope,
        masses: &made.masses,
        foot: made.foot.unwrap_or(own),
    }
}

fn balance_row(standing: &Standing, key: &Key) -> BalancePromise {
    let found = standing.at(key);
    let is_clear = standing.is_clear(&standing.lowest(key));
    BalancePromise {
        centre_mm: found.centre.into(),
        toppling_deg: is_clear.then(|| found.toppling_rad.to_degrees()),
    }
}

/// Returns the box of all parts in a state, along the root's axes.
fn size_mm(made: &Made, telescope: &Telescope, key: &Key) -> [f64; 3] {
    let frames = telescope.frames(key);
    let root = telescope.start.inverse();
    let boxes = made.parts.iter().map(|part| {
        let placed = root.frame_to_model(&frames[part.shell]);
        part.in_shell().map_vertices(|p| placed.to_model(p)).aabb()
    });
    let whole = boxes.fold(Aabb::EMPTY, |whole, part| whole.union(&part));
    whole.size().into()
}

fn warnings(asked: &Asked, made: &Made) -> Vec<String> {
    let mut warnings = asked.warnings.clone();
    let deviation = &made.best.design.fit.deviation;
    if deviation.max_mm > asked.within_mm {
        warnings.push(format!(
            "The best telescope found is {:.1} mm off the curve at the worst place, more than a \
             hundredth of its length.",
            deviation.max_mm
        ));
    }
    warnings.extend(untried(asked, made));
    warnings.extend(nested::warnings(asked, &made.best.design.telescope));
    warnings.extend(leaning(asked, made));
    warnings
}

/// Returns the warning that the clearance was never tried on this machine.
pub fn untried(asked: &Asked, made: &Made) -> Option<String> {
    let count = made.best.design.telescope.shells.len();
    let is_untried = asked.slide.sure != Sure::Measured && count > 1 && !asked.job.in_place;
    is_untried.then(|| {
        format!(
            "The sliding clearance of {} mm was never tried on this machine. Print its slide coupon, \
             or {} and {} with their caps, and try them before you print the rest.",
            asked.slide.value,
            made.shell_id(count - 2),
            made.shell_id(count - 1)
        )
    })
}

/// Returns the warning that shells bend by more than may hang over.
pub fn leaning(asked: &Asked, made: &Made) -> Option<String> {
    let parts = made.parts.iter();
    let leaning = parts.filter(|part| part.lies == Lies::Leaning);
    let leaning: Vec<&str> = leaning.map(|part| part.id.as_str()).collect();
    let is_told = !leaning.is_empty() && asked.shop.printer.support == Support::Breakaway;
    is_told.then(|| {
        format!(
            "{} bend more than may hang over: support them outside only, never in the bore.",
            leaning.join(", ")
        )
    })
}
