//! What is asked of a telescope, in the printer's measures.

use super::error::TelescopeRunError;
use super::in_place;
use super::load::Loaded;
use super::load_skeleton::{CurveFile, Shop};
use crate::base::units::Length;
use crate::curve::{Curve, Freedom};
use crate::job::telescope::{Bends, Lock, Opening, ShellCount, Stance, TelescopeJob, Twists};
use crate::printer::{Quantity, Sourced, Sure};
use crate::telescope::design::{OrderWish, Wish};
use crate::telescope::sizes::{JointSizes, Tails};

/// Share of the length of a curve within which a telescope is near enough if nothing else is said.
const WITHIN_RATIO: f64 = 0.01;
/// The least such deviation, mm: less is not seen.
const LEAST_WITHIN_MM: f64 = 1.0;

/// Fewest shells if nothing else is said: with fewer it is hardly a telescope.
const FEWEST_SHELLS: usize = 3;
/// Numbers of shells that are tried from the fewest on.
const COUNTS_TRIED: usize = 8;

/// Walls in the tip's radius: two of them, and a bore for its cap.
const TIP_WALLS: f64 = 3.0;
/// The least radius of a tip, mm: thinner ones snap.
const LEAST_TIP_MM: f64 = 3.0;

/// Share of a stage that stays inside at least, so that it does not wobble.
const OVERLAP_RATIO: f64 = 0.2;
/// Factor by which an overlap is shortened if shells do not nest with it.
const SHORTER_RATIO: f64 = 0.6;
/// Least length of flange and lip, mm: shorter ones shear off.
const LEAST_FLANGE_MM: f64 = 2.0;

/// Bend by torsion of one shell, rad, that a fit may use.
const MAX_TWIST_RAD: f64 = 0.75;

/// Length of a spigot over the wall, and the least, mm: it must hold a cap square.
const SPIGOT_WALLS: f64 = 2.0;
const LEAST_SPIGOT_MM: f64 = 2.0;

/// Share of a wall that a chamfer may take.
const CHAMFER_WALL_RATIO: f64 = 0.5;

/// Room of the build volume that is left free above a shell, mm.
const HEADROOM_MM: f64 = 2.0;

/// A right angle, degrees.
const UPRIGHT_DEG: f64 = 90.0;

/// What is asked of a telescope.
pub struct Asked<'a> {
    pub job: &'a TelescopeJob,
    pub shop: &'a Shop,
    pub curve: &'a Curve,
    /// The curve's file; `None` for measures.
    pub file: Option<CurveFile>,
    /// The clearance with which shells slide, and its source.
    pub slide: Sourced<f64>,
    /// Measures of the joints with the least overlap.
    pub least: JointSizes,
    /// Body radius of the tip, mm.
    pub tip_mm: f64,
    /// The greatest visible length of a shell, mm.
    pub longest_mm: f64,
    /// The deviation that is near enough, mm.
    pub within_mm: f64,
    /// The beginning of the ids of its parts and joints; empty for a curve alone.
    pub prefix: String,
    /// Warnings for the shop.
    pub warnings: Vec<String>,
}

/// The measures that do not depend on a curve.
pub struct Basics {
    /// The clearance with which shells slide, and its source.
    pub slide: Sourced<f64>,
    /// Measures of the joints with the least overlap.
    pub least: JointSizes,
    /// Body radius of the tip, mm.
    pub tip_mm: f64,
    /// Warnings for the shop.
    pub warnings: Vec<String>,
}

/// Takes the measures of a job that do not depend on a curve. `length_mm` is that of the object.
pub fn basics(
    job: &TelescopeJob,
    shop: &Shop,
    length_mm: f64,
) -> Result<Basics, TelescopeRunError> {
    let mut warnings = Vec::new();
    let slide = match job.in_place {
        true => in_place::clearance(job, shop)?,
        false => slide(job, shop, &mut warnings),
    };
    let least = least_sizes(job, shop, slide.value, length_mm)?;
    least.check()?;
    if let Some(overlap_mm) = mm(job.overlap) {
        with_overlap(&least, overlap_mm).check()?;
    }
    Ok(Basics {
        tip_mm: tip_mm(job, shop, &least)?,
        slide,
        least,
        warnings,
    })
}

/// Takes the measures of a job and its printer.
pub fn measure<'a>(
    job: &'a TelescopeJob,
    shop: &'a Shop,
    loaded: &'a Loaded,
) -> Result<Asked<'a>, TelescopeRunError> {
    let curve = &loaded.curve;
    let Basics {
        slide,
        least,
        tip_mm,
        warnings,
    } = basics(job, shop, curve.length_mm())?;
    let room_mm = shop.printer.usable_volume_mm().map(|[_, _, height]| height);
    let by_room_mm = room_mm.map_or(f64::INFINITY, |height| {
        height - HEADROOM_MM - least.overlap_mm()
    });
    let longest_mm = mm(job.shell_length)
        .unwrap_or(f64::INFINITY)
        .min(by_room_mm);
    let usual_mm = (WITHIN_RATIO * curve.length_mm()).max(LEAST_WITHIN_MM);
    Ok(Asked {
        job,
        shop,
        curve,
        file: loaded.file.clone(),
        slide,
        least,
        tip_mm,
        longest_mm,
        within_mm: mm(job.deviation).unwrap_or(usual_mm),
        prefix: String::new(),
        warnings,
    })
}

impl Asked<'_> {
    /// Returns the numbers of shells to try, the fewest first.
    pub fn counts(&self) -> Vec<usize> {
        match self.job.shells {
            ShellCount::Given(count) => vec![count],
            ShellCount::Auto => {
                let fewest = self.fewest().max(FEWEST_SHELLS);
                let most = self.most().min(fewest + COUNTS_TRIED - 1);
                (fewest..=most.max(fewest)).collect()
            }
        }
    }

    /// Returns the fewest shells that are short enough.
    pub fn fewest(&self) -> usize {
        let count = (self.curve.length_mm() / self.longest_mm).ceil();
        (count as usize).max(1)
    }

    /// Returns the most shells that fit into the root.
    pub fn most(&self) -> usize {
        let steps = (self.root_mm() - self.tip_mm) / self.least.pitch_mm();
        if steps.is_finite() {
            (steps.max(0.0) as usize).saturating_add(1)
        } else {
            usize::MAX
        }
    }

    /// Returns the most that the body radius of the root may be, mm.
    pub fn root_mm(&self) -> f64 {
        mm(self.job.root_radius).unwrap_or(f64::INFINITY)
    }

    /// Returns the measures of joints to try for a number of shells, the longest overlap first.
    pub fn sizes(&self, shells: usize) -> Vec<JointSizes> {
        if let Some(overlap_mm) = mm(self.job.overlap) {
            return vec![with_overlap(&self.least, overlap_mm)];
        }
        let stage_mm = self.curve.length_mm() / shells as f64;
        let root_mm = self.tip_mm + self.least.pitch_mm() * (shells - 1) as f64;
        let usual_mm = (OVERLAP_RATIO * stage_mm).max(root_mm);
        let least_mm = self.least.overlap_mm();
        let longer = std::iter::successors(Some(usual_mm), |mm| Some(mm * SHORTER_RATIO));
        let longer = longer.take_while(|mm| *mm > least_mm);
        let longer = longer.map(|mm| with_overlap(&self.least, mm));
        longer.chain([self.least]).collect()
    }

    /// Returns the wish for telescopes of so many shells with these joints.
    pub fn wish(&self, shells: usize, sizes: &JointSizes) -> Wish {
        let curvature = match self.job.curvature {
            Bends::One => Freedom::One,
            Bends::Each => Freedom::Each,
        };
        let torsion = match self.job.torsion {
            Twists::One => Freedom::One,
            Twists::Each => Freedom::Each,
            Twists::None => Freedom::Zero,
        };
        let order = match self.job.order {
            Opening::Auto => OrderWish::Free,
            Opening::Root => OrderWish::RootFirst,
            Opening::Tip => OrderWish::TipFirst,
        };
        Wish {
            tip_mm: self.tip_mm,
            root_mm: self.root_mm(),
            within_mm: self.within_mm,
            max_torsion: MAX_TWIST_RAD * shells as f64 / self.curve.length_mm(),
            curvature,
            torsion,
            order,
            ..Wish::new(vec![shells], *sizes)
        }
    }

    /// Returns the lean from the vertical that prints without support, rad; infinite if all do.
    pub fn steepest_rad(&self) -> f64 {
        let overhang = self.number(Quantity::OverhangDeg);
        let steepest_deg = overhang.map_or(f64::INFINITY, |overhang| UPRIGHT_DEG - overhang);
        steepest_deg.to_radians()
    }

    /// Returns true if it is to stand.
    pub fn stands(&self) -> bool {
        self.job.goal == Stance::Stand
    }

    /// Returns a number of the printer's profile, mm; `None` if it is not known.
    pub fn number(&self, quantity: Quantity) -> Option<f64> {
        let number = self.shop.printer.number(quantity);
        number.map(|number| number.value)
    }
}

fn mm(length: Option<Length>) -> Option<f64> {
    length.map(Length::mm)
}

/// Returns the clearance with which shells slide: that of the order, the material or the printer.
fn slide(job: &TelescopeJob, shop: &Shop, warnings: &mut Vec<String>) -> Sourced<f64> {
    if let Some(ordered) = mm(job.clearance) {
        return Sourced {
            value: ordered,
            source: "ordered".to_owned(),
            sure: Sure::OwnChoice,
            process_default_of: None,
        };
    }
    if let Some(known) = shop.printer.slide_clearance(&shop.material) {
        return known.clone();
    }
    let glued = &shop.printer.clearance_per_side_mm;
    warnings.push(format!(
        "the profile of {} has no sliding clearance; that of its glued joints is used, {} mm, which \
         is mostly too tight to slide",
        shop.printer.id, glued.value
    ));
    glued.clone()
}

/// Returns the measures of joints with the least overlap.
fn least_sizes(
    job: &TelescopeJob,
    shop: &Shop,
    slide_mm: f64,
    length_mm: f64,
) -> Result<JointSizes, TelescopeRunError> {
    let printer = &shop.printer;
    let number = |quantity| printer.number(quantity).map(|number| number.value);
    let wall_mm = printer.quantise_wall(mm(job.wall), length_mm)?.wall_mm;
    let feature_mm = printer.min_feature_mm.value;
    let glue_mm = printer.clearance_per_side_mm.value;
    let press_mm = printer.snug_gap_mm();
    let seat_mm = match job.lock {
        Lock::Press => press_mm.min(slide_mm),
        Lock::None => slide_mm,
    };
    let engagement_mm = feature_mm.max(2.0 * slide_mm);
    let flange_mm = LEAST_FLANGE_MM.max(2.0 * feature_mm);
    let foot_mm = number(Quantity::ElephantFootMm).unwrap_or(0.0);
    let lead_mm = number(Quantity::ChamferFirstLayerMm).unwrap_or(printer.chamfer_mm.value);
    let capped = JointSizes {
        wall_mm,
        slide_mm,
        engagement_mm,
        flange_mm,
        lip_mm: flange_mm,
        seat_mm,
        spigot_mm: LEAST_SPIGOT_MM.max(SPIGOT_WALLS * wall_mm),
        glue_mm,
        vent_mm: number(Quantity::MinHoleMm).unwrap_or(printer.min_opening_mm.value),
        chamfer_mm: lead_mm.max(foot_mm).min(CHAMFER_WALL_RATIO * wall_mm),
        feature_mm,
        tails: Tails::Capped,
    };
    Ok(match job.in_place {
        true => in_place::with_rings(capped, shop),
        false => capped,
    })
}

/// Returns the measures with another overlap, shared by flange and lip.
fn with_overlap(sizes: &JointSizes, overlap_mm: f64) -> JointSizes {
    let half_mm = 0.5 * (overlap_mm - sizes.engagement_mm);
    JointSizes {
        flange_mm: half_mm,
        lip_mm: half_mm,
        ..*sizes
    }
}

/// Returns the body radius of the tip.
fn tip_mm(job: &TelescopeJob, shop: &Shop, sizes: &JointSizes) -> Result<f64, TelescopeRunError> {
    let by_pin_mm = 0.5 * shop.printer.pin_min_diameter_mm.value + sizes.wall_mm;
    let usual_mm = LEAST_TIP_MM.max(TIP_WALLS * sizes.wall_mm).max(by_pin_mm);
    let tip_mm = mm(job.tip_radius).unwrap_or(usual_mm);
    let root_mm = mm(job.root_radius).unwrap_or(f64::INFINITY);
    if tip_mm > root_mm {
        return Err(TelescopeRunError::TipOverRoot { tip_mm, root_mm });
    }
    Ok(tip_mm)
}
