//! The telescope of a limb: its curve, its order, its design.

use super::along::at;
use super::plan::{Measures, Planned, tip_mm};
use super::skin::Skin;
use crate::base::units::Length;
use crate::base::verdict::Verdict;
use crate::base::watch::Watch;
use crate::curve::Curve;
use crate::geom::Point;
use crate::job::telescope::{ShellCount, Stance, TelescopeJob, Twists};
use crate::skeleton::Chain;
use crate::telescope::fastened::Fastened;
use crate::telescope::nest::Telescope;
use crate::telescope::prepare::asked::{Asked, measure};
use crate::telescope::prepare::best::{Best, design};
use crate::telescope::prepare::error::TelescopeRunError;
use crate::telescope::prepare::load::Loaded;
use crate::telescope::prepare::load_skeleton::Shop;

/// Points through which the curve of a limb is laid: nodes are noisy, so they are few.
const CURVE_POINTS: usize = 10;
/// The most by which a straight limb's curve is off its chord, as a share of it: less than the
/// noise of nodes.
const STRAIGHT_RATIO: f64 = 0.005;
/// Edges on which corners are looked for.
const CORNER_EDGES: usize = 240;
/// Share of the root's radius by which the open limb may be off its curve.
const OFF_SHARE: f64 = 0.5;
/// Radii of the tip that are tried: shares of the way from the widest to the thinnest.
const TIPS: [f64; 2] = [0.0, 1.0];
/// Overlaps that are tried: shares of the way from the least to that planned.
const SHORTER: [f64; 3] = [1.0, 0.5, 0.0];
/// The most by which turned shells may be wider than round, mm: what a seat has to spare. A leg of
/// 17 mm in radius was held at 0.011 mm.
const MOST_TILT_MM: f64 = 0.009;
/// Radii of the root that are tried: shares of the greatest.
const ROOTS: [f64; 3] = [1.0, 0.75, 0.55];
/// The same in a model, whose wall around the root decides.
const ROOTS_IN_MODEL: [f64; 5] = [1.0, 0.9, 0.8, 0.68, 0.55];

/// The order of a limb.
#[derive(Clone)]
pub struct LimbOrder {
    pub job: TelescopeJob,
    pub loaded: Loaded,
}

/// A limb with its design.
#[derive(Clone)]
pub struct Designed {
    pub order: LimbOrder,
    pub best: Best,
}

impl LimbOrder {
    /// Returns the measures of a limb whose ids begin with `prefix`.
    pub fn asked<'a>(
        &'a self,
        shop: &'a Shop,
        prefix: &str,
    ) -> Result<Asked<'a>, TelescopeRunError> {
        let asked = measure(&self.job, shop, &self.loaded)?;
        Ok(Asked {
            prefix: prefix.to_owned(),
            ..asked
        })
    }
}

/// Everything for the design of limbs: the job, the shop and the measures of all.
pub struct Studio<'a> {
    pub job: &'a TelescopeJob,
    pub shop: &'a Shop,
    pub measures: Measures,
    /// The model's surface, if junctures keep it.
    pub skin: Option<&'a Skin<'a>>,
    pub watch: &'a Watch,
}

impl Studio<'_> {
    /// Designs a limb with as many shells as planned, or fewer; else returns the reason.
    ///
    /// Thinner shells bend more, so a limb that is far off its curve is tried with thinner ones.
    pub fn design(
        &self,
        chain: &Chain,
        planned: &Planned,
    ) -> Result<Verdict<Designed, String>, TelescopeRunError> {
        let curve = match curve(chain, planned) {
            Ok(curve) => curve,
            Err(fault) => return Ok(Verdict::No(fault.to_string())),
        };
        let most_off_mm = OFF_SHARE * planned.root_mm;
        let mut why = "no number of shells nests".to_owned();
        let roots: &[f64] = match self.skin {
            Some(_) => &ROOTS_IN_MODEL,
            None => &ROOTS,
        };
        for share in roots {
            for shells in (2..=planned.shells).rev() {
                let thinner = Planned {
                    shells,
                    root_mm: share * planned.root_mm,
                    ..planned.clone()
                };
                match self.nest(chain, &thinner, &curve)? {
                    Verdict::No(reason) => why = reason,
                    Verdict::Found(found) => {
                        let design = &found.best.design;
                        let off_mm = design.fit.deviation.max_mm;
                        let fault = match off_mm <= most_off_mm {
                            true => self.skin.and_then(|skin| skin.fault(&design.telescope)),
                            false => {
                                Some(format!("the best telescope found is {off_mm:.1} mm off it"))
                            }
                        };
                        let Some(fault) = fault else {
                            return Ok(Verdict::Found(found));
                        };
                        why = fault;
                        // Fewer shells are farther off.
                        break;
                    }
                }
            }
        }
        Ok(Verdict::No(why))
    }

    /// Designs a limb with the thickest tip that nests.
    fn nest(
        &self,
        chain: &Chain,
        planned: &Planned,
        curve: &Curve,
    ) -> Result<Verdict<Designed, String>, TelescopeRunError> {
        let mut why = "its shells do not nest".to_owned();
        let Some(widest_mm) = tip_mm(chain, planned, &self.measures) else {
            return Ok(Verdict::No(why));
        };
        for overlap_mm in self.overlaps(planned) {
            for share in TIPS {
                let tip_mm = widest_mm + share * (self.measures.tip_mm - widest_mm);
                let planned = Planned {
                    overlap_mm,
                    ..planned.clone()
                };
                let order = self.order(&planned, tip_mm, curve);
                let asked = measure(&order.job, self.shop, &order.loaded)?;
                match design(&asked, self.watch)? {
                    Verdict::No(refused) => why = refused.reason.to_string(),
                    Verdict::Found(best) if tilt_mm(&best.design.telescope) > MOST_TILT_MM => {
                        "its turns tilt the shells too much".clone_into(&mut why);
                        break;
                    }
                    Verdict::Found(best) => {
                        let best = fastened(best);
                        return Ok(Verdict::Found(Designed { order, best }));
                    }
                }
            }
        }
        Ok(Verdict::No(why))
    }

    /// Returns the overlaps to try, mm: as planned, and shorter ones down to the least.
    fn overlaps(&self, planned: &Planned) -> Vec<f64> {
        let least_mm = self.measures.least.overlap_mm();
        let span_mm = planned.overlap_mm - least_mm;
        if self.job.overlap.is_some() || span_mm <= 0.0 {
            return vec![planned.overlap_mm];
        }
        SHORTER.map(|share| least_mm + share * span_mm).to_vec()
    }

    fn order(&self, planned: &Planned, tip_mm: f64, curve: &Curve) -> LimbOrder {
        let job = TelescopeJob {
            shells: ShellCount::Given(planned.shells),
            tip_radius: Length::from_mm(tip_mm).ok(),
            root_radius: Length::from_mm(planned.root_mm).ok(),
            overlap: self
                .job
                .overlap
                .or(Length::from_mm(planned.overlap_mm).ok()),
            // Torsion brings little to a limb, and turns do the rest.
            torsion: Twists::None,
            goal: Stance::None,
            ..self.job.clone()
        };
        let loaded = Loaded {
            curve: curve.clone(),
            file: None,
        };
        LimbOrder { job, loaded }
    }
}

/// Fastens a telescope at both ends.
fn fastened(mut best: Best) -> Best {
    best.design.telescope.fastened = Fastened {
        root: true,
        tip: true,
    };
    best
}

/// Returns by how much a turned shell is wider across its parent than it is round, mm, at the worst
/// joint.
///
/// At the ends of an overlap o the tangents part by α = κ o sin(|θ|/2). A tube of radius r that
/// leans by α is r / cos α wide. The clearance of a thick shell must hold this too.
fn tilt_mm(telescope: &Telescope) -> f64 {
    let overlap_mm = telescope.sizes.overlap_mm();
    let joints = telescope.joints.iter().zip(telescope.shells.iter().skip(1));
    let tilts = joints.map(|(joint, inner)| {
        let lean = inner.helix.curvature * overlap_mm * (0.5 * joint.turn_rad.abs()).sin();
        joint.radii.flange_mm * (1.0 / lean.cos() - 1.0)
    });
    tilts.fold(0.0, f64::max)
}

/// Returns points on their chord if they hardly leave it, else as they are.
///
/// Arcs of some hundred metres in radius bend by less than nodes are off. Their shells would have
/// slivers, and would turn for nothing.
fn straightened(points: Vec<Point>) -> Vec<Point> {
    let (first, last) = (points[0], points[points.len() - 1]);
    let chord = last - first;
    let on_chord = |share: f64| first + chord * share;
    let off_mm = points.iter().map(|p| {
        let share = (p - first).dot(&chord) / chord.norm_squared().max(f64::MIN_POSITIVE);
        (p - on_chord(share)).norm()
    });
    if off_mm.fold(0.0, f64::max) > STRAIGHT_RATIO * chord.norm() {
        return points;
    }
    let steps = points.len() - 1;
    (0..=steps)
        .map(|i| on_chord(i as f64 / steps as f64))
        .collect()
}

/// Returns the curve of a limb, from where its root begins.
fn curve(chain: &Chain, planned: &Planned) -> Result<Curve, crate::curve::CurveError> {
    let span = chain.end_mm - planned.from_mm;
    let place = |i: usize| {
        at(
            chain,
            planned.from_mm + span * i as f64 / CURVE_POINTS as f64,
        )
    };
    let points: Vec<Point> = (0..=CURVE_POINTS).map(place).collect();
    let curve = Curve::through(&straightened(points))?;
    curve.refuse_corners(CORNER_EDGES)?;
    Ok(curve)
}
