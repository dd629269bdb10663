//! The telescope of a limb: its curve, its order, its design.

use super::plan::{Measures, Planned, at, tip_mm};
use crate::base::units::Length;
use crate::base::verdict::Verdict;
use crate::base::watch::Watch;
use crate::curve::Curve;
use crate::job::telescope::{ShellCount, Stance, TelescopeJob};
use crate::skeleton::Chain;
use crate::telescope::fastened::Fastened;
use crate::telescope::prepare::asked::{Asked, measure};
use crate::telescope::prepare::best::{Best, design};
use crate::telescope::prepare::error::TelescopeRunError;
use crate::telescope::prepare::load::Loaded;
use crate::telescope::prepare::load_skeleton::Shop;

/// Points through which the curve of a limb is laid: nodes are noisy, so they are few.
const CURVE_POINTS: usize = 10;
/// Edges on which corners are looked for.
const CORNER_EDGES: usize = 240;
/// Share of the root's radius by which the open limb may be off its curve.
const OFF_SHARE: f64 = 0.5;
/// Radii of the tip that are tried: shares of the way from the widest to the thinnest.
const TIPS: [f64; 3] = [0.0, 0.5, 1.0];

/// What is asked of a limb.
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

/// Where a limb is designed: its job, its shop and the measures of all limbs.
pub struct Studio<'a> {
    pub job: &'a TelescopeJob,
    pub shop: &'a Shop,
    pub measures: Measures,
    pub watch: &'a Watch,
}

impl Studio<'_> {
    /// Designs a limb with as many shells as planned, or fewer; else returns the reason.
    pub fn design(
        &self,
        chain: &Chain,
        planned: &Planned,
    ) -> Result<Verdict<Designed, String>, TelescopeRunError> {
        let curve = match curve(chain, planned) {
            Ok(curve) => curve,
            Err(fault) => return Ok(Verdict::No(fault.to_string())),
        };
        let mut why = "no number of shells nests".to_owned();
        for shells in (2..=planned.shells).rev() {
            let planned = Planned {
                shells,
                ..planned.clone()
            };
            let Some(widest_mm) = tip_mm(chain, &planned, &self.measures) else {
                continue;
            };
            for tip_mm in TIPS.map(|share| widest_mm + share * (self.measures.tip_mm - widest_mm)) {
                let order = self.order(&planned, tip_mm, &curve);
                let asked = measure(&order.job, self.shop, &order.loaded)?;
                match design(&asked, self.watch)? {
                    Verdict::No(refused) => why = refused.reason.to_string(),
                    Verdict::Found(best) => {
                        let off_mm = best.design.fit.deviation.max_mm;
                        if off_mm <= OFF_SHARE * planned.root_mm {
                            let best = fastened(best);
                            return Ok(Verdict::Found(Designed { order, best }));
                        }
                        why = format!("the best telescope found is {off_mm:.1} mm off it");
                    }
                }
            }
        }
        Ok(Verdict::No(why))
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

/// Returns the curve of a limb, from where its root begins.
fn curve(chain: &Chain, planned: &Planned) -> Result<Curve, crate::curve::CurveError> {
    let span = chain.end_mm - planned.from_mm;
    let place = |i: usize| {
        at(
            chain,
            planned.from_mm + span * i as f64 / CURVE_POINTS as f64,
        )
    };
    let points: Vec<_> = (0..=CURVE_POINTS).map(place).collect();
    let curve = Curve::through(&points)?;
    curve.refuse_corners(CORNER_EDGES)?;
    Ok(curve)
}
