//! The foot on which a telescope stands, and the order of opening that needs the least.

use super::asked::Asked;
use super::balance::{Standing, centre, drop_mm, tail};
use super::best::Reason;
use super::feet;
use crate::ballast::{BallastError, Order as BallastOrder, Part, catalogue, find};
use crate::base::units::MM3_PER_CM3;
use crate::base::verdict::Verdict;
use crate::geom::Point;
use crate::job::telescope::{self as job, FootSize};
use crate::mass::{Lump, LumpShape};
use crate::telescope::balance::DiscFoot;
use crate::telescope::motion::{Opening, Order};
use crate::telescope::nest::Telescope;
use crate::telescope::tube::TubeMass;
use crate::verify::TelescopeBallast;

/// The most discs that lie on each other.
const MOST_DISCS: u32 = 4;

/// Least wall of a foot around its pocket, mm.
const RIM_MM: f64 = 3.0;

/// The most ballast that is told, as a multiple of the telescope's mass.
const MOST_BALLAST_RATIO: f64 = 50.0;

/// Halvings by which the least ballast is found: to a share of 1e-9 of the most.
const HALVINGS: usize = 30;

/// A foot, with the ballast in its pocket.
#[derive(Debug, Clone, PartialEq)]
pub struct Base {
    pub foot: DiscFoot,
    pub ballast: Vec<TelescopeBallast>,
}

impl Base {
    /// Returns true if it is less than another: lighter ballast, or as light and a smaller foot.
    fn is_less(&self, other: &Self) -> bool {
        let key = |base: &Self| {
            let mass_g: f64 = base.ballast.iter().map(|piece| piece.lump.mass_g).sum();
            [mass_g, base.foot.radius_mm]
        };
        key(self) < key(other)
    }
}

/// Chooses the order of opening and the foot with which it stands. Of all free orders that the job
/// leaves open it takes the one with the least ballast on the least foot. `masses` are those of the
/// shells.
///
/// The reason is that of the order that was found first.
///
/// # Errors
/// The catalogue of ballast is at fault, or a part is ordered that is no disc of it.
pub fn choose_order(
    asked: &Asked,
    telescope: &Telescope,
    found: &Opening,
    masses: &[TubeMass],
) -> Result<Verdict<(Opening, Option<Base>), Reason>, BallastError> {
    if !asked.stands() {
        return Ok(Verdict::Found((found.clone(), None)));
    }
    let stacks = stacks(&asked.job.ballast)?;
    let footing = |opening: &Opening| {
        let footing = Footing {
            asked,
            telescope,
            opening,
            masses,
            stacks: &stacks,
        };
        footing.choose()
    };
    let joints = telescope.joints.len();
    let is_open = asked.job.order == job::Opening::Auto;
    let others = [Order::root_first(joints), Order::tip_first(joints)];
    let others = others
        .iter()
        .filter(|order| is_open && **order != found.order);
    let mut best = footing(found).map(|foot| (found.clone(), foot));
    for opening in others.filter_map(|order| telescope.open_in(order).ok()) {
        let Verdict::Found(foot) = footing(&opening) else {
            continue;
        };
        let is_less = match &best {
            Verdict::Found((_, known)) => foot.is_less(known),
            Verdict::No(_) => true,
        };
        if is_less {
            best = Verdict::Found((opening, foot));
        }
    }
    Ok(best.map(|(opening, foot)| (opening, Some(foot))))
}

/// Discs of one kind, one on the other.
struct Stack {
    part: Part,
    count: u32,
}

impl Stack {
    fn mass_g(&self) -> f64 {
        self.part.mass_g * f64::from(self.count)
    }

    fn height_mm(&self) -> f64 {
        2.0 * self.part.shape.half_height_mm() * f64::from(self.count)
    }
}

/// Returns the stacks of discs that an order allows, the lightest first.
fn stacks(order: &BallastOrder) -> Result<Vec<Stack>, BallastError> {
    let is_flat = |part: &Part| matches!(part.shape, LumpShape::Disc { .. });
    let (kinds, counts) = match order {
        BallastOrder::None => return Ok(Vec::new()),
        BallastOrder::Auto => {
            let mut kinds = catalogue()?;
            kinds.retain(is_flat);
            (kinds, 1..=MOST_DISCS)
        }
        BallastOrder::Parts { id, count } => {
            let part = find(id)?;
            if !is_flat(&part) {
                return Err(BallastError::Unknown {
                    id: id.clone(),
                    remedy: "it does not lie flat in a foot; use a disc such as disc-60-10"
                        .to_owned(),
                });
            }
            let counts = count.map_or(1..=MOST_DISCS, |count| count..=count);
            (vec![part], counts)
        }
    };
    let mut stacks: Vec<Stack> = kinds
        .iter()
        .flat_map(|part| {
            let stack = |count: u32| Stack {
                part: part.clone(),
                count,
            };
            counts.clone().map(stack).collect::<Vec<_>>()
        })
        .collect();
    stacks.sort_by(|a, b| a.mass_g().total_cmp(&b.mass_g()));
    Ok(stacks)
}

/// A telescope whose foot is looked for.
struct Footing<'a> {
    asked: &'a Asked<'a>,
    telescope: &'a Telescope,
    opening: &'a Opening,
    masses: &'a [TubeMass],
    /// The ballast that may be taken, the lightest first.
    stacks: &'a [Stack],
}

impl Footing<'_> {
    /// Chooses the foot: as ordered, or the least on which it stands as promised. Ballast is taken
    /// if it was ordered by name, or if no foot alone does.
    fn choose(&self) -> Verdict<Base, Reason> {
        if let Some(reason) = self.find_low() {
            return Verdict::No(reason);
        }
        let is_named = matches!(self.asked.job.ballast, BallastOrder::Parts { .. });
        let bare = self.radii_mm(self.first_mm());
        let bare = bare.into_iter().find(|mm| self.holds(&self.foot(*mm), 0.0));
        if let Some(radius_mm) = bare.filter(|_| !is_named) {
            return Verdict::Found(Base {
                foot: self.foot(radius_mm),
                ballast: Vec::new(),
            });
        }
        let weighted = self.stacks.iter().find_map(|stack| self.weighted(stack));
        let greatest_mm = match self.asked.job.foot {
            FootSize::Given(radius) => radius.mm(),
            FootSize::Auto => self.most_mm(),
        };
        let narrow = self.stacks.first().filter(|_| is_named);
        let narrow = narrow.map(|stack| (stack, self.least_mm(stack)));
        match (weighted, narrow) {
            (Some(base), _) => Verdict::Found(base),
            (None, Some((stack, least_mm))) if least_mm > greatest_mm => {
                Verdict::No(Reason::NoPocket {
                    part: stack.part.name.clone(),
                    least_mm,
                    foot_mm: greatest_mm,
                })
            }
            (None, _) => Verdict::No(self.falls(greatest_mm)),
        }
    }

    /// Returns the radius and the depth of the pocket of a stack, mm.
    fn pocket_mm(&self, stack: &Stack) -> [f64; 2] {
        let glue_mm = self.telescope.sizes.glue_mm;
        [
            stack.part.shape.radius_mm() + glue_mm,
            stack.height_mm() + 2.0 * glue_mm,
        ]
    }

    /// Returns the least radius of a foot that has a rim around the pocket of a stack, mm.
    fn least_mm(&self, stack: &Stack) -> f64 {
        let rim_mm = RIM_MM.max(2.0 * self.telescope.sizes.wall_mm);
        self.pocket_mm(stack)[0] + rim_mm
    }

    /// Returns the radii to try, from one on; the one that was ordered if there is one.
    fn radii_mm(&self, first_mm: f64) -> Vec<f64> {
        feet::radii_mm(self.asked.job.foot, [first_mm, self.most_mm()])
    }

    /// Returns true if it stands as promised on a foot with so much ballast, mm³ of the shells'
    /// material. A foot that is chosen has room for the rounding of files.
    fn holds(&self, foot: &DiscFoot, ballast_mm3: f64) -> bool {
        let job = self.asked.job;
        let wanted_deg = feet::wanted_deg(job.foot, job.least_angle_deg);
        self.angle_deg(foot, ballast_mm3) >= wanted_deg
    }

    /// Returns the least foot with a stack of discs on which it stands, even if they are as light
    /// as their stock allows; `None` if there is none.
    fn weighted(&self, stack: &Stack) -> Option<Base> {
        let (pocket, least_mm) = (self.pocket_mm(stack), self.least_mm(stack));
        let first_mm = self.first_mm().max(least_mm.ceil());
        let light = stack.mass_g() * (1.0 - stack.part.mass_spread_ratio);
        let light_mm3 = light * MM3_PER_CM3 / self.asked.shop.material.density_g_cm3.value;
        let foot = |radius_mm: f64| DiscFoot {
            radius_mm,
            height_mm: self.foot(radius_mm).height_mm + pocket[1],
            pocket_mm: Some(pocket),
        };
        let radii = self.radii_mm(first_mm).into_iter();
        let mut wide = radii.filter(|mm| *mm >= least_mm).map(foot);
        let foot = wide.find(|foot| self.holds(foot, light_mm3))?;
        Some(Base {
            ballast: self.placed(stack, &foot),
            foot,
        })
    }

    /// Returns the discs of a stack in the pocket of a foot, in the root's frame.
    fn placed(&self, stack: &Stack, foot: &DiscFoot) -> Vec<TelescopeBallast> {
        let tail = tail(self.telescope);
        let thick_mm = 2.0 * stack.part.shape.half_height_mm();
        let low_mm = self.telescope.sizes.glue_mm - foot.height_mm;
        let piece = |index: u32| {
            let middle_mm = low_mm + thick_mm * (f64::from(index) + 0.5);
            TelescopeBallast {
                id: stack.part.id.clone(),
                name: stack.part.name.clone(),
                lump: Lump {
                    shape: stack.part.shape,
                    mass_g: stack.part.mass_g,
                    center_mm: tail.to_model(&Point::new(middle_mm, 0.0, 0.0)).into(),
                    axis: tail.axes.column(0).into_owned().into(),
                },
            }
        };
        (0..stack.count).map(piece).collect()
    }

    fn foot(&self, radius_mm: f64) -> DiscFoot {
        DiscFoot {
            radius_mm,
            height_mm: feet::height_mm(&self.telescope.sizes),
            pocket_mm: None,
        }
    }

    fn first_mm(&self) -> f64 {
        feet::first_mm(self.telescope.shells[0].body_mm)
    }

    fn most_mm(&self) -> f64 {
        feet::most_mm(&self.asked.shop.printer)
    }

    /// Returns the reason that a shell reaches below the foot, if one does.
    fn find_low(&self) -> Option<Reason> {
        let least = Standing {
            telescope: self.telescope,
            masses: self.masses,
            foot: self.foot(self.telescope.shells[0].body_mm),
        };
        let lowest = least.lowest_over(self.opening)?;
        (!least.is_clear(&lowest)).then(|| Reason::UnderGround {
            shell: lowest.shell + 1,
            below_mm: -lowest.height_mm - drop_mm(self.telescope, &least.foot),
        })
    }

    /// Returns the lean at which it topples first on a foot of a radius, degrees. Ballast lies in
    /// the middle of the foot's lower face, in mm³ of the shells' material.
    fn angle_deg(&self, foot: &DiscFoot, ballast_mm3: f64) -> f64 {
        // A stack lies in the middle of its pocket, other ballast on the lower face.
        let up_mm = foot.pocket_mm.map_or(0.0, |[_, depth_mm]| 0.5 * depth_mm);
        let low_mm = up_mm - drop_mm(self.telescope, foot);
        let ballast = TubeMass {
            volume_mm3: ballast_mm3,
            centre: tail(self.telescope).to_model(&Point::new(low_mm, 0.0, 0.0)),
        };
        let mut masses = self.masses.to_vec();
        masses[0] = both(&with_foot(&masses[0], self.telescope, foot), &ballast);
        let standing = Standing {
            telescope: self.telescope,
            masses: &masses,
            foot: *foot,
        };
        standing.worst(self.opening).1.sagged_rad.to_degrees()
    }

    fn falls(&self, foot_mm: f64) -> Reason {
        Reason::Falls {
            angle_deg: self.angle_deg(&self.foot(foot_mm), 0.0),
            least_deg: self.asked.job.least_angle_deg,
            foot_mm,
            ballast_g: self.ballast_g(foot_mm),
        }
    }

    /// Returns the least mass in the middle of the foot with which it stands as promised, g; `None`
    /// if much more than the telescope's own mass does not do it. In place the middle is open.
    fn ballast_g(&self, foot_mm: f64) -> Option<f64> {
        if self.telescope.sizes.is_in_place() {
            return None;
        }
        let least_deg = self.asked.job.least_angle_deg;
        let foot = self.foot(foot_mm);
        let holds = |mm3: f64| self.angle_deg(&foot, mm3) >= least_deg;
        let own_mm3: f64 = self.masses.iter().map(|mass| mass.volume_mm3).sum();
        let (mut low, mut high) = (0.0, MOST_BALLAST_RATIO * own_mm3);
        if !holds(high) {
            return None;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            match holds(middle) {
                true => high = middle,
                false => low = middle,
            }
        }
        let density = self.asked.shop.material.density_g_cm3.value;
        Some(high / MM3_PER_CM3 * density)
    }
}

/// Returns the volume of a foot with the root's mass, in the root's frame.
fn with_foot(root: &TubeMass, telescope: &Telescope, foot: &DiscFoot) -> TubeMass {
    // In place it is a ring around the root, whose bend is not seen over its height.
    let (inner_mm, up) = match telescope.sizes.is_in_place() {
        true => (telescope.shells[0].body_mm, 1.0),
        false => (0.0, -1.0),
    };
    let round = |area_mm2: f64, height_mm: f64, middle_mm: f64| TubeMass {
        volume_mm3: std::f64::consts::PI * area_mm2 * height_mm,
        centre: tail(telescope).to_model(&Point::new(middle_mm, 0.0, 0.0)),
    };
    let area_mm2 = foot.radius_mm.powi(2) - inner_mm.powi(2);
    let disc = round(area_mm2, foot.height_mm, 0.5 * up * foot.height_mm);
    let whole = both(root, &disc);
    let Some([radius_mm, depth_mm]) = foot.pocket_mm else {
        return whole;
    };
    // A pocket is mass that is taken away.
    let middle_mm = 0.5 * depth_mm - foot.height_mm;
    both(&whole, &round(-radius_mm.powi(2), depth_mm, middle_mm))
}

/// Returns two masses in one.
pub fn both(a: &TubeMass, b: &TubeMass) -> TubeMass {
    let both = [*a, *b];
    TubeMass {
        volume_mm3: both.iter().map(|mass| mass.volume_mm3).sum(),
        centre: centre(&both),
    }
}
