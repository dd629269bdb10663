//! The foot on which a telescope stands, and the order of opening that needs the least.

use super::asked::Asked;
use super::balance::{Standing, centre, drop_mm, tail};
use super::best::Reason;
use crate::base::units::MM3_PER_CM3;
use crate::base::verdict::Verdict;
use crate::geom::Point;
use crate::job::telescope::{self as job, FootSize};
use crate::telescope::balance::DiscFoot;
use crate::telescope::motion::{Opening, Order};
use crate::telescope::nest::Telescope;
use crate::telescope::tube::TubeMass;

/// Step in which the radius of a foot grows, mm.
const FOOT_STEP_MM: f64 = 1.0;

/// Height of a foot over the flange's length, and the least, mm: thinner discs curl.
const FOOT_HEIGHT_MM: f64 = 3.0;

/// Room of the plate that is left free around a foot, mm.
const PLATE_ROOM_MM: f64 = 2.0;

/// The greatest foot for a printer whose plate is not known, mm.
const MOST_FOOT_MM: f64 = 100.0;

/// Angle beyond what is promised for which a foot is chosen, degrees: rounding of files.
const SPARE_DEG: f64 = 0.1;

/// The most ballast that is told, as a multiple of the telescope's mass.
const MOST_BALLAST_RATIO: f64 = 50.0;

/// Halvings by which the least ballast is found: to a share of 1e-9 of the most.
const HALVINGS: usize = 30;

/// Chooses the order of opening and the foot with which it stands. Of all free orders that the job
/// leaves open it takes the one on the least foot. `masses` are those of the shells.
///
/// The reason is that of the order that was found first.
pub fn choose_order(
    asked: &Asked,
    telescope: &Telescope,
    found: &Opening,
    masses: &[TubeMass],
) -> Verdict<(Opening, Option<DiscFoot>), Reason> {
    if !asked.stands() {
        return Verdict::Found((found.clone(), None));
    }
    let footing = |opening: &Opening| {
        let footing = Footing {
            asked,
            telescope,
            opening,
            masses,
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
            Verdict::Found((_, known)) => foot.radius_mm < known.radius_mm,
            Verdict::No(_) => true,
        };
        if is_less {
            best = Verdict::Found((opening, foot));
        }
    }
    best.map(|(opening, foot)| (opening, Some(foot)))
}

/// A telescope whose foot is looked for.
struct Footing<'a> {
    asked: &'a Asked<'a>,
    telescope: &'a Telescope,
    opening: &'a Opening,
    masses: &'a [TubeMass],
}

impl Footing<'_> {
    /// Chooses the foot: as ordered, or the least on which it stands as promised.
    fn choose(&self) -> Verdict<DiscFoot, Reason> {
        if let Some(reason) = self.find_low() {
            return Verdict::No(reason);
        }
        let least_deg = self.asked.job.least_angle_deg;
        let holds = |radius_mm: f64, deg: f64| self.angle_deg(radius_mm, 0.0) >= deg;
        match self.asked.job.foot {
            FootSize::Given(radius) if holds(radius.mm(), least_deg) => {
                Verdict::Found(self.foot(radius.mm()))
            }
            FootSize::Given(radius) => Verdict::No(self.falls(radius.mm())),
            FootSize::Auto => {
                let (first_mm, most_mm) = (self.first_mm(), self.most_mm());
                let steps = ((most_mm - first_mm) / FOOT_STEP_MM).max(0.0) as usize;
                let mut radii = (0..=steps).map(|i| first_mm + FOOT_STEP_MM * i as f64);
                match radii.find(|mm| holds(*mm, least_deg + SPARE_DEG)) {
                    Some(radius_mm) => Verdict::Found(self.foot(radius_mm)),
                    None => Verdict::No(self.falls(most_mm)),
                }
            }
        }
    }

    fn foot(&self, radius_mm: f64) -> DiscFoot {
        DiscFoot {
            radius_mm,
            height_mm: FOOT_HEIGHT_MM.max(2.0 * self.telescope.sizes.wall_mm),
        }
    }

    fn first_mm(&self) -> f64 {
        (self.telescope.shells[0].body_mm + FOOT_STEP_MM).ceil()
    }

    /// Returns the greatest foot that can be printed, mm.
    fn most_mm(&self) -> f64 {
        let room = self.asked.shop.printer.usable_volume_mm();
        room.map_or(MOST_FOOT_MM, |[x, y, _]| 0.5 * x.min(y) - PLATE_ROOM_MM)
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
    fn angle_deg(&self, radius_mm: f64, ballast_mm3: f64) -> f64 {
        let foot = self.foot(radius_mm);
        let low_mm = -drop_mm(self.telescope, &foot);
        let ballast = TubeMass {
            volume_mm3: ballast_mm3,
            centre: tail(self.telescope).to_model(&Point::new(low_mm, 0.0, 0.0)),
        };
        let mut masses = self.masses.to_vec();
        masses[0] = both(&with_foot(&masses[0], self.telescope, &foot), &ballast);
        let standing = Standing {
            telescope: self.telescope,
            masses: &masses,
            foot,
        };
        standing.worst(self.opening).1.sagged_rad.to_degrees()
    }

    fn falls(&self, foot_mm: f64) -> Reason {
        Reason::Falls {
            angle_deg: self.angle_deg(foot_mm, 0.0),
            least_deg: self.asked.job.least_angle_deg,
            foot_mm,
            ballast_g: self.ballast_g(foot_mm),
        }
    }

    /// Returns the least mass in the middle of the foot with which it stands as promised, g; `None`
    /// if much more than the telescope's own mass does not do it.
    fn ballast_g(&self, foot_mm: f64) -> Option<f64> {
        let least_deg = self.asked.job.least_angle_deg;
        let holds = |mm3: f64| self.angle_deg(foot_mm, mm3) >= least_deg;
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
    let area_mm2 = std::f64::consts::PI * (foot.radius_mm.powi(2) - inner_mm.powi(2));
    let disc = TubeMass {
        volume_mm3: area_mm2 * foot.height_mm,
        centre: tail(telescope).to_model(&Point::new(0.5 * up * foot.height_mm, 0.0, 0.0)),
    };
    both(root, &disc)
}

/// Returns two masses in one.
fn both(a: &TubeMass, b: &TubeMass) -> TubeMass {
    let both = [*a, *b];
    TubeMass {
        volume_mm3: both.iter().map(|mass| mass.volume_mm3).sum(),
        centre: centre(&both),
    }
}
