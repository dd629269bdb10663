//! The price of a pose, and the cheapest of many.

use rayon::prelude::*;

use super::columns::Columns;
use super::cups::{LEAST_CUP_MM3, cup_volume_mm3};
use super::directions::{around, of_cube, on_feet, spread};
use super::shape::Shape;
use super::support::{Support, SupportRule};
use crate::base::watch::{Cancelled, Watch};
use crate::geom::Vector;
use crate::mesh::GOOD_FOOT_MM2;

/// What makes a pose good.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Want {
    /// Little support, as filament wants.
    LittleSupport(SupportRule),
    /// No cup and a tilt, as resin in a vat wants. Its slicer adds the raft and the supports.
    NoCup(SupportRule),
}

/// The rules that a pose keeps, and what decides among those that do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoseRules {
    /// What decides.
    pub want: Want,
    /// The thinnest wall of the part, mm: a finer grid finds every cup.
    pub wall_mm: f64,
}

/// Pitch of the grid in the first round, as a share of the part's longest side, and its limits, mm.
const COARSE_RATIO: f64 = 1.0 / 60.0;
const COARSE_MM: [f64; 2] = [0.8, 3.0];
/// Pitch of the grid in the later rounds over that of the first.
const FINE_RATIO: f64 = 0.5;
/// Poses that are looked at again in the second round.
const KEPT: usize = 6;
/// Angles by which the kept poses are turned in later rounds, degrees, and in how many directions.
const TURNS_DEG: [f64; 2] = [6.0, 2.0];
const WAYS: usize = 6;
/// Least area of the first layer at its top, mm². On less, a part stands on a point, and comes off
/// at the first touch of the nozzle. The middle of the layer, which is what a slicer prints, then
/// has 5.7 mm² or more on bunny, elephant, homer and humpty. It costs them 1 to 17 % of support.
const LEAST_FOOT_MM2: f64 = 10.0;
/// Angle by which a surface is steeper than the rule and still counts in part, degrees, and that
/// part. Without it, the cheapest poses have large surfaces that just need no support.
const NEARLY_DEG: f64 = 3.0;
const NEARLY_RATIO: f64 = 0.3;
/// Height of a part over the side of a square on which it and its support hold, and the least area
/// of that, mm².
const SLENDERNESS: f64 = 5.0;
const LEAST_BED_MM2: f64 = 20.0;
/// Price of a pose without any foot, over that of its support.
const FOOT_RATIO: f64 = 0.08;

/// Price of a visible area that support touches, over that of the material in its end layers, mm.
const SEEN_MM: f64 = 0.1;
/// Price of a hollow's or a cut face's area that support touches, mm.
const UNSEEN_MM: f64 = 0.05;
/// Price of a millimetre of height, mm³: it decides between equals only.
const HEIGHT_MM2: f64 = 0.05;

/// Price of a cup, mm² a mm³.
const CUP_PER_MM: f64 = 1.0;
/// Angles by which the best poses are turned if they still make cups, degrees. Often only few
/// poses make none.
const CUP_TURNS_DEG: [f64; 4] = [10.0, 5.0, 2.5, 1.0];
/// The faults of a pose that makes a cup.
const CUP_FAULTS: u8 = 2;
/// Angles by which cut faces lean from the platform in a vat, degrees.
const TILTS_DEG: [f64; 4] = [15.0, 30.0, 45.0, 60.0];
/// Least angle between a flat face and the platform of a vat, as a cosine: 10°. A flatter one is
/// pulled off the film at once.
const LEVEL_COSINE: f64 = 0.985;

/// A pose by its direction, with its price.
#[derive(Debug, Clone, Copy)]
struct Priced {
    up: Vector,
    /// Rules that it breaks; the fewer the better, before the price.
    faults: u8,
    price: f64,
}

/// Returns directions that may point up, the best first. `faces` are the outward normals of the
/// part's cut faces.
///
/// # Errors
/// The watch was stopped.
pub fn rank_poses(
    shape: &Shape,
    faces: &[Vector],
    rules: &PoseRules,
    watch: &Watch,
) -> Result<Vec<Vector>, Cancelled> {
    let coarse_mm = (COARSE_RATIO * shape.mesh.longest_side_mm()).clamp(COARSE_MM[0], COARSE_MM[1]);
    let fine_mm = match rules.want {
        Want::LittleSupport(_) => FINE_RATIO * coarse_mm,
        Want::NoCup(_) => (FINE_RATIO * coarse_mm).min(FINE_RATIO * rules.wall_mm),
    };
    let judge = Judge {
        shape,
        faces,
        rules,
        watch,
    };
    let mut directions: Vec<Vector> = faces.iter().flat_map(|face| [-face, *face]).collect();
    directions.extend(on_feet(shape));
    directions.extend(of_cube());
    directions.extend(spread());
    if matches!(rules.want, Want::NoCup(_)) {
        let leaning = |lean_deg| {
            faces
                .iter()
                .flat_map(move |face| around(&-face, lean_deg, 8))
        };
        directions.extend(TILTS_DEG.into_iter().flat_map(leaning));
    }
    let ranked = judge.rank(&directions, coarse_mm)?;
    let mut best: Vec<Priced> = judge.rank(&ups(&ranked[..ranked.len().min(KEPT)]), fine_mm)?;
    let has_cup = |best: &[Priced]| best.first().is_some_and(|pose| pose.faults >= CUP_FAULTS);
    let is_vat = matches!(rules.want, Want::NoCup(_));
    let mut turns_deg = TURNS_DEG.to_vec();
    if is_vat && has_cup(&best) {
        // A coarse grid does not see every cup, and sees some that are none.
        best.extend(judge.rank(&ups(&ranked[ranked.len().min(KEPT)..]), fine_mm)?);
        best.sort_by(order);
        if has_cup(&best) {
            turns_deg = CUP_TURNS_DEG.to_vec();
        }
    }
    for turn_deg in turns_deg {
        let turned: Vec<Vector> = best
            .iter()
            .take(KEPT / 2)
            .flat_map(|pose| around(&pose.up, turn_deg, WAYS))
            .collect();
        best.extend(judge.rank(&turned, fine_mm)?);
        best.sort_by(order);
    }
    let rest = ranked.iter().skip(KEPT);
    Ok(ups(&best)
        .into_iter()
        .chain(rest.map(|pose| pose.up))
        .collect())
}

fn ups(poses: &[Priced]) -> Vec<Vector> {
    poses.iter().map(|pose| pose.up).collect()
}

/// Compares two poses, the better first.
fn order(a: &Priced, b: &Priced) -> std::cmp::Ordering {
    a.faults.cmp(&b.faults).then(a.price.total_cmp(&b.price))
}

/// Prices the poses of a part.
struct Judge<'a> {
    shape: &'a Shape<'a>,
    faces: &'a [Vector],
    rules: &'a PoseRules,
    watch: &'a Watch,
}

impl Judge<'_> {
    /// Returns the poses with their prices, the best first.
    fn rank(&self, ups: &[Vector], pitch_mm: f64) -> Result<Vec<Priced>, Cancelled> {
        let price = |up: &Vector| {
            self.watch.check()?;
            Ok(self.price(up, pitch_mm))
        };
        let mut poses = ups
            .par_iter()
            .map(price)
            .collect::<Result<Vec<Priced>, Cancelled>>()?;
        poses.sort_by(order);
        Ok(poses)
    }

    fn price(&self, up: &Vector, pitch_mm: f64) -> Priced {
        let columns = Columns::of(self.shape, up, pitch_mm);
        let (faults, price) = match &self.rules.want {
            Want::LittleSupport(rule) => {
                let support = Support::of(self.shape, &columns, up, rule);
                let is_on_peg = self.shape.rests_on_peg(up, rule.layer_mm);
                let bed_mm2 = (columns.height_mm / SLENDERNESS).powi(2).max(LEAST_BED_MM2);
                let has_foot = support.foot_mm2 >= LEAST_FOOT_MM2 && support.bed_mm2 >= bed_mm2;
                let steeper = SupportRule {
                    overhang_deg: rule.overhang_deg + NEARLY_DEG,
                    ..*rule
                };
                let nearly = Support::of(self.shape, &columns, up, &steeper);
                let price = (1.0 - NEARLY_RATIO) * by_filament(&support, &columns)
                    + NEARLY_RATIO * by_filament(&nearly, &columns);
                (2 * u8::from(is_on_peg) + u8::from(!has_foot), price)
            }
            Want::NoCup(rule) => {
                let support = Support::of(self.shape, &columns, up, rule);
                let cup_mm3 = cup_volume_mm3(&columns);
                let is_cup = cup_mm3 >= LEAST_CUP_MM3;
                let is_level = self
                    .faces
                    .iter()
                    .any(|face| face.dot(up).abs() > LEVEL_COSINE);
                let price =
                    by_resin(&support, &columns) + self.hanging_pegs(up) + CUP_PER_MM * cup_mm3;
                (CUP_FAULTS * u8::from(is_cup) + u8::from(is_level), price)
            }
        };
        Priced {
            up: *up,
            faults,
            price,
        }
    }

    /// Returns the price of pins that point toward the platform and begin in the air, mm².
    fn hanging_pegs(&self, up: &Vector) -> f64 {
        const PRICE_MM: f64 = 10.0;
        let drop_mm = self
            .shape
            .pegs
            .iter()
            .map(|peg| (-peg.axis.dot(up) * peg.length_mm).max(0.0));
        PRICE_MM * drop_mm.sum::<f64>()
    }
}

/// Returns the price of a pose for filament, mm³ of support.
fn by_filament(support: &Support, columns: &Columns) -> f64 {
    let unseen_mm2 = support.hollow_mm2 + support.cut_face_mm2;
    let lack = (1.0 - support.foot_mm2 / GOOD_FOOT_MM2).max(0.0);
    (1.0 + FOOT_RATIO * lack) * support.material_mm3()
        + SEEN_MM * support.outside_mm2
        + UNSEEN_MM * unseen_mm2
        + HEIGHT_MM2 * columns.height_mm
}

/// Returns the price of a pose in a vat, mm² of visible area that support touches. Support on cut
/// faces and in hollows costs more, and so do a large layer and height.
fn by_resin(support: &Support, columns: &Columns) -> f64 {
    const CUT_FACE: f64 = 3.0;
    const HOLLOW: f64 = 2.0;
    const LAYER: f64 = 0.5;
    const HEIGHT_MM: f64 = 2.0;
    support.outside_mm2
        + CUT_FACE * support.cut_face_mm2
        + HOLLOW * support.hollow_mm2
        + LAYER * columns.greatest_layer_mm2()
        + HEIGHT_MM * columns.height_mm
}
