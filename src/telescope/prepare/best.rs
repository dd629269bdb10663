//! The best telescope for a curve: the fewest shells that come near enough.

use super::asked::Asked;
use super::nested::find_overhang;
use crate::base::verdict::Verdict;
use crate::base::watch::{Cancelled, Phase, Watch};
use crate::curve::{Deviation, first_guess};
use crate::geom::Point;
use crate::sheet::telescope::TradeRow;
use crate::telescope::design::{Design, DesignError, design as design_shells, design_request};
use crate::telescope::error::TelescopeError;
use crate::telescope::limits::{Limit, ball_limit, budget_limit, strands_limit};
use crate::telescope::motion::Collision;

/// Points at which a curve is looked at for proofs. Pairs of them are compared.
const PROOF_EDGES: usize = 1200;

/// Samples of each shell at which the first guess is compared with the curve.
const GUESS_SAMPLES: usize = 20;

/// The price of turns in the first guess that is told, rad·mm.
const GUESS_PRICE: f64 = 1.0;

/// The telescope that was taken.
#[derive(Clone)]
pub struct Best {
    pub design: Design,
    /// Every number of shells that was tried.
    pub rows: Vec<TradeRow>,
    /// The rms deviation of the paper's own way, mm.
    pub guess_rms_mm: f64,
}

/// There is no telescope as asked.
pub struct Refused {
    pub reason: Reason,
    pub rows: Vec<TradeRow>,
}

/// A reason why there is none.
#[derive(Debug, Clone, PartialEq)]
pub enum Reason {
    /// It is proved that there can be none.
    Limit(Limit),
    /// Shells are longer than they may be.
    TooLong {
        shells: usize,
        shell_mm: f64,
        longest_mm: f64,
        fewest: usize,
    },
    /// The nearest design is too far off.
    TooFar {
        shells: usize,
        deviation_mm: f64,
        within_mm: f64,
    },
    /// No order that was tried is free.
    Collision(Box<Collision>),
    /// Shells do not nest.
    Nest(TelescopeError),
    /// The fit is refused.
    Fit(String),
    /// It falls on the greatest foot that can be printed.
    Falls {
        angle_deg: f64,
        least_deg: f64,
        foot_mm: f64,
        /// The least mass in the middle of the foot with which it would stand, g.
        ballast_g: Option<f64>,
    },
    /// The foot has no room for the ballast that was ordered.
    NoPocket {
        part: String,
        least_mm: f64,
        foot_mm: f64,
    },
    /// It reaches below the foot on which it should stand.
    UnderGround { shell: usize, below_mm: f64 },
    /// Shells bend by more than can be printed in place.
    HangsInPlace { bend_deg: f64, most_deg: f64 },
    /// Parts are larger than the printer.
    TooLarge { part: String, size_mm: [f64; 3] },
}

/// Designs telescopes from the fewest shells on, until one is near enough.
pub fn design(asked: &Asked, watch: &Watch) -> Result<Verdict<Best, Refused>, Cancelled> {
    watch.enter(Phase::Solve);
    let mut search = Search {
        asked,
        rows: Vec::new(),
        best: None,
        last: None,
    };
    for shells in asked.counts() {
        watch.check()?;
        if let Some(reason) = before_design(asked, shells) {
            search.refuse(shells, reason);
            continue;
        }
        search.try_shells(shells, watch)?;
        if search.is_near() {
            break;
        }
    }
    Ok(search.verdict())
}

/// Returns the reason why a number of shells cannot be, as far as it is known without a design.
fn before_design(asked: &Asked, shells: usize) -> Option<Reason> {
    let shell_mm = asked.curve.length_mm() / shells as f64;
    if shell_mm > asked.longest_mm {
        return Some(Reason::TooLong {
            shells,
            shell_mm,
            longest_mm: asked.longest_mm,
            fewest: asked.fewest(),
        });
    }
    let limit = budget_limit(&asked.least, shells, asked.tip_mm, asked.root_mm());
    limit.map(Reason::Limit)
}

struct Search<'a> {
    asked: &'a Asked<'a>,
    rows: Vec<TradeRow>,
    best: Option<Design>,
    last: Option<Reason>,
}

impl Search<'_> {
    fn refuse(&mut self, shells: usize, reason: Reason) {
        self.rows.push(TradeRow {
            shells,
            deviation_mm: None,
            root_mm: None,
            collapsed_mm: None,
            why: Some(reason.to_string()),
        });
        self.last = Some(reason);
    }

    /// Designs with the longest overlap that nests.
    fn try_shells(&mut self, shells: usize, watch: &Watch) -> Result<(), Cancelled> {
        let mut last = None;
        for sizes in self.asked.sizes(shells) {
            watch.check()?;
            let wish = self.asked.wish(shells, &sizes);
            match design_shells(self.asked.curve, &wish, shells) {
                Ok(design) => {
                    match find_overhang(self.asked, &design.telescope) {
                        Some([bend_deg, most_deg]) => {
                            self.refuse(shells, Reason::HangsInPlace { bend_deg, most_deg });
                        }
                        None => self.take(shells, design),
                    }
                    return Ok(());
                }
                Err(error) => last = Some(error),
            }
        }
        if let Some(error) = last {
            self.refuse(shells, Reason::of(error));
        }
        Ok(())
    }

    fn take(&mut self, shells: usize, design: Design) {
        let telescope = &design.telescope;
        let collapsed_mm = telescope.visible_mm
            + telescope.sizes.overlap_mm()
            + telescope.sizes.closed_mm() * telescope.joints.len() as f64;
        self.rows.push(TradeRow {
            shells,
            deviation_mm: Some(design.fit.deviation.max_mm),
            root_mm: Some(telescope.shells[0].body_mm),
            collapsed_mm: Some(collapsed_mm),
            why: None,
        });
        let is_better = self
            .best
            .as_ref()
            .is_none_or(|best| design.fit.deviation.max_mm < best.fit.deviation.max_mm);
        if is_better {
            self.best = Some(design);
        }
    }

    fn is_near(&self) -> bool {
        let near = |design: &Design| design.fit.deviation.max_mm <= self.asked.within_mm;
        self.best.as_ref().is_some_and(near)
    }

    fn verdict(self) -> Verdict<Best, Refused> {
        let is_near = self.is_near();
        let is_ordered = self.asked.job.deviation.is_some();
        match self.best {
            Some(design) if is_near || !is_ordered => Verdict::Found(Best {
                guess_rms_mm: guess_rms_mm(self.asked, &design),
                rows: self.rows,
                design,
            }),
            best => Verdict::No(Refused {
                reason: reason(self.asked, best, self.last, &self.rows),
                rows: self.rows,
            }),
        }
    }
}

/// Returns the reason to tell: a proof if there is one, else what the search found.
fn reason(asked: &Asked, best: Option<Design>, last: Option<Reason>, rows: &[TradeRow]) -> Reason {
    if let Some(reason @ (Reason::Limit(_) | Reason::TooLong { .. })) = last {
        return reason;
    }
    if let Some(limit) = proof(asked, rows) {
        return Reason::Limit(limit);
    }
    match (best, last) {
        (Some(design), _) => Reason::TooFar {
            shells: design.telescope.shells.len(),
            deviation_mm: design.fit.deviation.max_mm,
            within_mm: asked.within_mm,
        },
        (None, Some(reason)) => reason,
        (None, None) => Reason::Fit("no number of shells was tried".to_owned()),
    }
}

/// Returns a proof that no telescope of any tried number of shells follows the curve, if one is
/// found. Only the fewest shells are looked at: more of them are thicker.
fn proof(asked: &Asked, rows: &[TradeRow]) -> Option<Limit> {
    let shells = rows.first()?.shells;
    let points: Vec<Point> = asked.curve.samples(PROOF_EDGES);
    let step_mm = asked.curve.length_mm() / PROOF_EDGES as f64;
    let body = |i: usize| {
        let shell = (i * shells / (PROOF_EDGES + 1)).min(shells - 1);
        asked.tip_mm + asked.least.pitch_mm() * (shells - 1 - shell) as f64
    };
    let bodies: Vec<f64> = (0..points.len()).map(body).collect();
    let by_strands = strands_limit(&points, &bodies, step_mm, asked.within_mm);
    by_strands.or_else(|| ball_limit(&points, step_mm, asked.tip_mm, asked.within_mm))
}

/// Returns the rms deviation of the chain of Yu, Crane and Coros with as many shells, mm.
fn guess_rms_mm(asked: &Asked, design: &Design) -> f64 {
    let shells = design.telescope.shells.len();
    let wish = asked.wish(shells, &design.telescope.sizes);
    let request = design_request(asked.curve, &wish, shells);
    let chain = first_guess(asked.curve, &request, GUESS_PRICE);
    let target = asked.curve.samples(shells * GUESS_SAMPLES);
    Deviation::between(&chain.samples(GUESS_SAMPLES), &target).rms_mm
}

impl Reason {
    fn of(error: DesignError) -> Self {
        match error {
            DesignError::Motion(collision) => Self::Collision(collision),
            DesignError::Nest(error) => Self::Nest(error),
            DesignError::Fit(error) => Self::Fit(error.to_string()),
        }
    }

    /// Returns true if it is proved, and not only not found.
    pub fn is_proved(&self) -> bool {
        matches!(
            self,
            Self::Limit(_) | Self::TooLong { .. } | Self::TooLarge { .. }
        )
    }
}

impl std::fmt::Display for Reason {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Limit(limit) => write!(f, "{limit}"),
            Self::TooLong {
                shells,
                shell_mm,
                longest_mm,
                fewest,
            } => write!(
                f,
                "{shells} shells would show {shell_mm:.1} mm each, and {longest_mm:.1} mm is the most \
                 that can be printed or was allowed; {fewest} shells are short enough"
            ),
            Self::TooFar {
                shells,
                deviation_mm,
                within_mm,
            } => write!(
                f,
                "the best telescope found, of {shells} shells, is {deviation_mm:.2} mm off the curve, \
                 where {within_mm:.2} mm is asked"
            ),
            Self::Collision(collision) => write!(f, "no order that was tried is free: {collision}"),
            Self::Nest(error) => write!(f, "the shells found do not nest: {error}"),
            Self::Fit(why) => f.write_str(why),
            Self::Falls {
                angle_deg,
                least_deg,
                foot_mm,
                ballast_g: _,
            } => write!(
                f,
                "it topples at {angle_deg:.1}° on a foot of {foot_mm:.0} mm in radius, where \
                 {least_deg:.1}° is asked"
            ),
            Self::NoPocket {
                part,
                least_mm,
                foot_mm,
            } => write!(
                f,
                "a {part} needs a foot of {least_mm:.1} mm in radius, and {foot_mm:.1} mm is the most"
            ),
            Self::UnderGround { shell, below_mm } => write!(
                f,
                "as it opens, shell S{shell:02} reaches {below_mm:.1} mm below the table: the root \
                 stands where the curve begins, and points up along it"
            ),
            Self::HangsInPlace { bend_deg, most_deg } => write!(
                f,
                "printed in place, its shells would bend by {bend_deg:.0}°, where {most_deg:.0}° is the \
                 most that stays free of support between them"
            ),
            Self::TooLarge {
                part,
                size_mm: [x, y, z],
            } => write!(
                f,
                "part {part} of {x:.0} × {y:.0} × {z:.0} mm is larger than the printer"
            ),
        }
    }
}
