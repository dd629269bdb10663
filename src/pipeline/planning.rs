//! Cuts, cleaning and bosses in their turn; and in other ways where joints are left without their
//! pins.

use super::{
    Error, Setup,
    bosses::{BossRound, Bossed, bossed},
    cleaning::{Cleaned, CleaningRound, cleaned, without_ends},
    settling::{CHEAP_LOSS_RATIO, DEAR_LOSS_RATIO, MAX_VOID_LOSS_RATIO, Reached, are_clean},
    stopwatch::Stopwatch,
    tuner::{Tuner, Voids},
};
use crate::base::units::counted;
use crate::cut::{CutPlan, PlanRequest, SolidEnd, beyond};
use crate::job::CutMode;

/// How often voids are given up beyond joints without pins: those of the cuts that are then made,
/// too.
const MAX_ENDS: usize = 3;

/// They are given up with so much of the interior around them, in minimum openings: humpty afloat
/// by PolyJet then has a metacentric height of 0.84, 0.82, 0.79, 0.72 and 0.49 mm with 0, 0.25,
/// 0.5, 1 and 2 (at a pitch of 0.5 mm); on a Form 3 none leaves the joints without pins.
const ENDS_MARGIN_RATIO: f64 = 0.25;

/// Openings are asked for that are so much wider than the least: solving again for pins narrows
/// them (fertility by filament from 5.00 to 4.93 mm), and a kit that breaks a promise is made the
/// usual way.
const SPARE_OPENING_RATIO: f64 = 1.03;

/// What pins may cost where some joint is left without them all the same.
const PARTIAL_LOSS_RATIO: f64 = 0.35;

/// Why something stays solid: the planner's reason, and a person's.
const BEYOND: &str = "the end beyond a joint without room for pins";
const ORDERED: &str = "the plan keeps it solid";

/// What is said where a person's plan keeps too much solid.
const TOO_SOLID: &str =
    "what the plan keeps solid leaves too little to be emptied for the goal: it is not kept solid";

/// How far it is gone so that every joint has its pins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lengths {
    /// Pins where the walls have room for them.
    Walls,
    /// Bosses around them, where they cost little.
    Bosses,
    /// Every way there is.
    All,
}

/// Voids with the plan that opens them, and how both came about.
pub struct Planned {
    /// The voids.
    pub voids: Voids,
    /// The cuts and pins.
    pub plan: CutPlan,
    /// What is to be said of the pins.
    pub notes: Vec<String>,
    /// What was asked of the plan.
    pub request: PlanRequest,
    /// What was kept solid so that voids can be cleaned, or joints have pins.
    pub cleaning: Vec<CleaningRound>,
    /// The rounds in which bosses were kept solid around pins.
    pub bosses: Vec<BossRound>,
    /// The least with which it would have come out so.
    pub lengths: Lengths,
}

/// Cuts with which every void can be cleaned, and pins: in the walls where they have room, in
/// bosses elsewhere.
///
/// The planner foresees how wide a joint is, and not what bosses in it hide or cost. Where joints
/// are left without their pins other ways are gone: fewer cuts for cleaning alone; cuts that are
/// weighed by how wide their joints are, walls or not; and if these do not give every joint its
/// pins cheaply, bosses at a higher price, and no voids beyond such joints at all. The way that
/// leaves the fewest joints without pins is taken, of several the one that costs the goal's figure
/// least. What a person ordered stays.
pub fn planned<'a>(
    setup: &'a Setup,
    (tuner, watch): (&mut Tuner<'a>, &mut Stopwatch),
    voids: Voids,
    (request, lengths): (&PlanRequest, Lengths),
) -> Result<Planned, Error> {
    let start = Start {
        tuner: tuner.clone(),
        voids,
        solid: Vec::new(),
        rounds: Vec::new(),
    };
    let (start, refused) = match setup
        .job
        .plan
        .as_ref()
        .filter(|order| !order.solid.is_empty())
    {
        Some(order) => match start.without(order.solid.clone(), ORDERED)? {
            Some(less) => (less, None),
            None => (start, Some(TOO_SOLID.to_owned())),
        },
        None => (start, None),
    };
    let ways = Ways {
        setup,
        start,
        request,
    };
    let mut planned = if lengths == Lengths::Walls {
        ways.walled(ways.start.clone(), request.clone(), watch)?
            .taken(tuner, None)
    } else {
        let first = ways.usual(watch)?;
        let found = if lengths == Lengths::All {
            ways.others(&first, watch)?
        } else {
            Vec::new()
        };
        let worth = found
            .into_iter()
            .filter(|way| way.is_worth(&first) && way.lacking() < first.lacking());
        let best = worth.min_by(|a, b| {
            let losses = [a, b].map(|way| way.loss_ratio(&first));
            a.lacking()
                .cmp(&b.lacking())
                .then(losses[0].total_cmp(&losses[1]))
        });
        match best {
            Some(best) => {
                let note = best.note(&first);
                best.taken(tuner, Some(note))
            }
            None => first.taken(tuner, None),
        }
    };
    planned.notes.extend(refused);
    Ok(planned)
}

/// What a way starts from.
#[derive(Clone)]
struct Start<'a> {
    tuner: Tuner<'a>,
    voids: Voids,
    /// What of the interior is kept solid.
    solid: Vec<SolidEnd>,
    /// The rounds in which that was done.
    rounds: Vec<CleaningRound>,
}

impl<'a> Start<'a> {
    /// The same with these parts of the interior kept solid; none where the goal cannot be met so,
    /// or nothing lies there.
    fn without(&self, solid: Vec<SolidEnd>, why: &str) -> Result<Option<Self>, Error> {
        let mut tuner = self.tuner.clone();
        let less = without_ends(&mut tuner, &self.voids, (&solid, why))?;
        Ok(less.map(|(round, voids)| Self {
            tuner,
            voids,
            solid,
            rounds: vec![round],
        }))
    }
}

/// The ways to a plan.
struct Ways<'a, 'b> {
    setup: &'a Setup,
    start: Start<'a>,
    request: &'b PlanRequest,
}

/// A way gone to its end.
#[derive(Clone)]
struct Way<'a> {
    tuner: Tuner<'a>,
    request: PlanRequest,
    cleaning: Vec<CleaningRound>,
    bossed: Bossed,
    /// What it is called in the notes; the usual one is not.
    name: Option<&'static str>,
}

impl<'a> Ways<'a, '_> {
    fn usual(&self, watch: &mut Stopwatch) -> Result<Way<'a>, Error> {
        self.gone(self.start.clone(), self.request.clone(), watch)
    }

    /// The ways that are gone where the usual one leaves joints without pins, until one leaves
    /// none; a person's cuts stay.
    fn others(&self, first: &Way<'a>, watch: &mut Stopwatch) -> Result<Vec<Way<'a>>, Error> {
        let mut found: Vec<Way> = Vec::new();
        if first.is_full() {
            return Ok(found);
        }
        let is_solved = |way: &Way| way.is_full() && way.is_worth(first);
        let is_free = self.setup.job.plan.is_none() && self.setup.job.cut == CutMode::Auto;
        if is_free && first.bossed.plan.cuts.len() > 1 {
            found.extend(self.with_fewer_cuts(watch)?);
        }
        if is_free && !found.iter().any(is_solved) {
            found.extend(self.with_wide_joints(watch)?);
        }
        if !found
            .iter()
            .any(|way| is_solved(way) && way.loss_ratio(first) <= CHEAP_LOSS_RATIO)
        {
            let dear = self.paid_dearly(first, DEAR_LOSS_RATIO, watch)?;
            // What is too dear for some of the joints may leave others their pins.
            if dear.as_ref().is_some_and(|way| !way.is_worth(first)) {
                found.extend(self.paid_dearly(first, PARTIAL_LOSS_RATIO, watch)?);
            }
            found.extend(dear);
        }
        let mut ends = Vec::new();
        for base in std::iter::once(first).chain(&found).filter(|_| is_free) {
            if !found.iter().chain(&ends).any(is_solved) {
                ends.extend(self.without_ends(base, watch)?);
            }
        }
        found.extend(ends);
        Ok(found)
    }

    /// What is asked of plans after which more is solved for again than after the usual one.
    fn with_spare_openings(&self) -> PlanRequest {
        let min_opening_mm = SPARE_OPENING_RATIO * self.request.min_opening_mm;
        PlanRequest {
            min_opening_mm,
            ..self.request.clone()
        }
    }

    /// What only a further cut would let be cleaned stays solid, as long as the goal can be met so.
    fn with_fewer_cuts(&self, watch: &mut Stopwatch) -> Result<Option<Way<'a>>, Error> {
        let fewer = PlanRequest {
            worth_ratio: 1.0,
            ..self.with_spare_openings()
        };
        let way = optional(self.gone(self.start.clone(), fewer, watch).map(Some))?;
        Ok(way.map(|way| Way {
            name: Some("fewer cuts for cleaning alone"),
            ..way
        }))
    }

    fn with_wide_joints(&self, watch: &mut Stopwatch) -> Result<Option<Way<'a>>, Error> {
        let wide = PlanRequest {
            wants_wide_joints: true,
            ..self.with_spare_openings()
        };
        let way = optional(self.gone(self.start.clone(), wide, watch).map(Some))?;
        Ok(way.map(|way| Way {
            name: Some("cuts through wider places"),
            ..way
        }))
    }

    fn paid_dearly(
        &self,
        first: &Way<'a>,
        max_loss_ratio: f64,
        watch: &mut Stopwatch,
    ) -> Result<Option<Way<'a>>, Error> {
        if !first.bossed.has_dear() {
            return Ok(None);
        }
        let mut tuner = first.tuner.clone();
        let paid = first
            .bossed
            .clone()
            .paid_dearly(&mut tuner, self.request, max_loss_ratio);
        watch.lap("bosses");
        let way = |bossed| Way {
            tuner,
            bossed,
            name: Some("dear bosses"),
            ..first.clone()
        };
        Ok(optional(paid.map(Some))?.map(way))
    }

    /// From a way that leaves joints without pins: no voids beyond them, nor beyond those that are
    /// then left without.
    fn without_ends(&self, base: &Way<'a>, watch: &mut Stopwatch) -> Result<Vec<Way<'a>>, Error> {
        let mut found: Vec<Way> = Vec::new();
        let mut solid = Vec::new();
        for _ in 0..MAX_ENDS {
            let last = found.last().unwrap_or(base);
            let margin = (self.request, ENDS_MARGIN_RATIO);
            let more = beyond(&last.bossed.voids.hollowed, &last.bossed.plan, margin);
            let Some(more) =
                optional(more.map(Some).map_err(Error::from))?.filter(|more| !more.is_empty())
            else {
                break;
            };
            solid.extend(more);
            let Some(start) = optional(self.start.without(solid.clone(), BEYOND))? else {
                break;
            };
            let Some(way) = optional(self.gone(start, base.request.clone(), watch).map(Some))?
            else {
                break;
            };
            found.push(Way {
                name: Some("voids solid beyond joints without room"),
                ..way
            });
            if found.last().is_some_and(Way::is_full) {
                break;
            }
        }
        Ok(found)
    }

    fn walled(
        &self,
        Start {
            mut tuner,
            voids,
            solid,
            mut rounds,
        }: Start<'a>,
        request: PlanRequest,
        watch: &mut Stopwatch,
    ) -> Result<Way<'a>, Error> {
        let Cleaned {
            voids,
            plan,
            rounds: cleaning,
        } = cleaned(self.setup, &mut tuner, voids, &request)?;
        watch.lap("plan");
        rounds.extend(cleaning);
        let bossed = Bossed::without(voids, CutPlan { solid, ..plan });
        Ok(Way {
            tuner,
            request,
            cleaning: rounds,
            bossed,
            name: None,
        })
    }

    fn gone(
        &self,
        start: Start<'a>,
        request: PlanRequest,
        watch: &mut Stopwatch,
    ) -> Result<Way<'a>, Error> {
        let mut way = self.walled(start, request, watch)?;
        way.bossed = bossed(&mut way.tuner, way.bossed, &way.request)?;
        watch.lap("bosses");
        Ok(way)
    }
}

/// Nothing where another way came to nothing: the usual one stands.
fn optional<T>(way: Result<Option<T>, Error>) -> Result<Option<T>, Error> {
    match way {
        Err(Error::Cancelled) => Err(Error::Cancelled),
        Err(_) => Ok(None),
        way => way,
    }
}

impl<'a> Way<'a> {
    /// How many joints have not at least two pins that fit one way only, and how many have none.
    fn lacking(&self) -> [usize; 2] {
        let joints = &self.bossed.plan.joints;
        let without = joints.iter().filter(|joint| !joint.is_aligned()).count();
        [
            without,
            joints.iter().filter(|joint| joint.pins.is_empty()).count(),
        ]
    }

    /// Whether every joint has its pins.
    fn is_full(&self) -> bool {
        self.lacking() == [0, 0]
    }

    fn reached(&self) -> Reached {
        Reached::by(&self.bossed.voids)
    }

    /// By which share of itself the goal's figure is worse than in another way.
    fn loss_ratio(&self, other: &Self) -> f64 {
        other.reached().loss_ratio(&self.reached())
    }

    /// Whether it keeps what the first way keeps, at no more than pins may cost.
    fn is_worth(&self, first: &Self) -> bool {
        let is_clean = |way: &Self| are_clean(&way.bossed.plan, &way.request);
        let max_loss_ratio = if self.is_full() {
            DEAR_LOSS_RATIO
        } else {
            PARTIAL_LOSS_RATIO
        };
        self.bossed.voids.solution.is_usable()
            && (is_clean(self) || !is_clean(first))
            && self.loss_ratio(first) <= max_loss_ratio
            && first.reached().filled_ratio(&self.reached()) <= MAX_VOID_LOSS_RATIO
    }

    /// What it was taken for, and at which price.
    fn note(&self, first: &Self) -> String {
        let price = 100.0 * self.loss_ratio(first);
        format!(
            "pins: {}, for {} of {} would lack them otherwise; the goal's figure is {:.1} % {} for it",
            self.name.unwrap_or_default(),
            first.lacking()[0],
            counted(first.bossed.plan.joints.len(), "joint"),
            price.abs(),
            if price > 0.0 { "worse" } else { "better" },
        )
    }

    /// What was planned this way; the tuner is as it left it.
    fn taken(self, tuner: &mut Tuner<'a>, note: Option<String>) -> Planned {
        *tuner = self.tuner;
        let (voids, plan, bosses, mut notes) = self.bossed.told();
        notes.extend(note);
        let lengths = match (self.name, bosses.is_empty()) {
            (Some(_), _) => Lengths::All,
            (None, false) => Lengths::Bosses,
            (None, true) => Lengths::Walls,
        };
        Planned {
            voids,
            plan,
            notes,
            request: self.request,
            cleaning: self.cleaning,
            bosses,
            lengths,
        }
    }
}
