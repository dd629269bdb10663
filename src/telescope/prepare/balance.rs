//! Whether a telescope stands: mass and centre in every state, and the least foot.

use super::asked::Asked;
use super::best::Reason;
use crate::base::verdict::Verdict;
use crate::geom::{Frame, Point, Vector};
use crate::job::telescope::FootSize;
use crate::telescope::balance::DiscFoot;
use crate::telescope::motion::{Opening, between};
use crate::telescope::nest::{JointState, Telescope};
use crate::telescope::sizes::JointSizes;
use crate::telescope::tube::TubeMass;

/// States of each move at which the balance is taken.
pub(super) const STATES: usize = 20;

/// Step in which the radius of a foot grows, mm.
const FOOT_STEP_MM: f64 = 1.0;

/// Height of a foot over the flange's length, and the least, mm: thinner discs curl.
const FOOT_HEIGHT_MM: f64 = 3.0;

/// Room of the plate that is left free around a foot, mm.
const PLATE_ROOM_MM: f64 = 2.0;

/// Angle beyond what is promised for which a foot is chosen, degrees: rounding of files.
const SPARE_DEG: f64 = 0.1;

/// The balance in a state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Balanced {
    /// The centre of volume, mm, model frame.
    pub centre: Point,
    /// The distance from the centre's foot to the edge of the foot, mm, with all play taken up.
    pub margin_mm: f64,
    /// The lean at which it topples, rad.
    pub toppling_rad: f64,
    /// The same with all play taken up, rad.
    pub sagged_rad: f64,
}

/// A telescope with the masses of its shells, on a foot.
pub struct Standing<'a> {
    pub telescope: &'a Telescope,
    /// Volume and centre of every shell with its cap, in the shell's frame.
    pub masses: &'a [TubeMass],
    pub foot: DiscFoot,
}

impl Standing<'_> {
    /// Returns the balance in a state.
    pub fn at(&self, states: &[JointState]) -> Balanced {
        let frames = self.telescope.frames(states);
        let placed: Vec<TubeMass> = self
            .masses
            .iter()
            .zip(&frames)
            .map(|(mass, frame)| TubeMass {
                centre: frame.to_model(&mass.centre),
                ..*mass
            })
            .collect();
        let centre = centre(&placed);
        let local = ground(self.telescope).to_local(&centre);
        // The edge on which it rests is chamfered.
        let edge_mm = self.foot.radius_mm - self.telescope.sizes.chamfer_mm;
        let margin_mm = edge_mm - local.y.hypot(local.z);
        let height_mm = local.x + self.foot.height_mm;
        let sagged_mm = margin_mm - self.sag_mm(&placed, &frames);
        Balanced {
            centre,
            margin_mm: sagged_mm,
            toppling_rad: margin_mm.atan2(height_mm),
            sagged_rad: sagged_mm.atan2(height_mm),
        }
    }

    /// Returns how far the centre moves if all joints that are out tilt to the limit of their play
    /// the same way, mm.
    fn sag_mm(&self, placed: &[TubeMass], frames: &[Frame]) -> f64 {
        let whole: f64 = placed.iter().map(|mass| mass.volume_mm3).sum();
        let joints = self.telescope.joints.iter().enumerate();
        let sags = joints.map(|(joint, own)| {
            let beyond = &placed[joint + 1..];
            let volume: f64 = beyond.iter().map(|mass| mass.volume_mm3).sum();
            let lever = (centre(beyond) - frames[joint + 1].origin).norm();
            tilt_rad(own.seat_mm, &self.telescope.sizes) * lever * volume / whole
        });
        sags.sum()
    }

    /// Returns the state of an opening in which it topples first, with its balance.
    pub fn worst(&self, opening: &Opening) -> (Vec<JointState>, Balanced) {
        let first = opening.keys.first().cloned().unwrap_or_default();
        let start = (first.clone(), self.at(&first));
        let moves = opening.keys.windows(2);
        let states = moves.flat_map(|pair| {
            (1..=STATES).map(|i| between(&pair[0], &pair[1], i as f64 / STATES as f64))
        });
        states.fold(start, |worst, state| {
            let found = self.at(&state);
            let is_worse = found.sagged_rad < worst.1.sagged_rad;
            if is_worse { (state, found) } else { worst }
        })
    }
}

/// Returns the tilt that the play of a seat allows, rad: two rings an overlap apart.
pub fn tilt_rad(seat_mm: f64, sizes: &JointSizes) -> f64 {
    2.0 * seat_mm / sizes.overlap_mm()
}

fn centre(placed: &[TubeMass]) -> Point {
    let volume: f64 = placed.iter().map(|mass| mass.volume_mm3).sum();
    let weighed = placed
        .iter()
        .map(|mass| mass.centre.coords * mass.volume_mm3);
    Point::from(weighed.sum::<Vector>() / volume)
}

/// Returns the frame of the root's tail in the model frame: its x axis is up.
pub fn ground(telescope: &Telescope) -> Frame {
    telescope.start.frame_to_model(&tail(telescope))
}

/// Returns the frame of the root's tail in that of the root.
fn tail(telescope: &Telescope) -> Frame {
    let helix = &telescope.shells[0].helix;
    helix.frame_at(telescope.ends_mm()[0])
}

/// Returns the volume of a foot with the root's mass, in the root's frame.
fn with_foot(root: &TubeMass, telescope: &Telescope, foot: &DiscFoot) -> TubeMass {
    let disc = TubeMass {
        volume_mm3: std::f64::consts::PI * foot.radius_mm.powi(2) * foot.height_mm,
        centre: tail(telescope).to_model(&Point::new(-0.5 * foot.height_mm, 0.0, 0.0)),
    };
    let both = [*root, disc];
    TubeMass {
        volume_mm3: both.iter().map(|mass| mass.volume_mm3).sum(),
        centre: centre(&both),
    }
}

/// Chooses the foot: as ordered, or the least on which it stands as promised; `None` if it need not
/// stand.
pub fn choose_foot(
    asked: &Asked,
    telescope: &Telescope,
    opening: &Opening,
    masses: &[TubeMass],
) -> Verdict<Option<DiscFoot>, Reason> {
    if !asked.stands() {
        return Verdict::Found(None);
    }
    let height_mm = FOOT_HEIGHT_MM.max(2.0 * telescope.sizes.wall_mm);
    let foot = |radius_mm: f64| DiscFoot {
        radius_mm,
        height_mm,
    };
    let least = Standing {
        telescope,
        masses,
        foot: foot(telescope.shells[0].body_mm),
    };
    let lowest = least.lowest_over(opening);
    if let Some(lowest) = lowest.filter(|lowest| !least.is_clear(lowest)) {
        return Verdict::No(Reason::UnderGround {
            shell: lowest.shell + 1,
            below_mm: -lowest.height_mm - height_mm,
        });
    }
    let angle_deg = |radius_mm: f64| {
        let foot = foot(radius_mm);
        let mut masses = masses.to_vec();
        masses[0] = with_foot(&masses[0], telescope, &foot);
        let standing = Standing {
            telescope,
            masses: &masses,
            foot,
        };
        standing.worst(opening).1.sagged_rad.to_degrees()
    };
    let least_deg = asked.job.least_angle_deg;
    let room = asked.shop.printer.usable_volume_mm();
    let most_mm = room.map_or(MOST_FOOT_MM, |[x, y, _]| 0.5 * x.min(y) - PLATE_ROOM_MM);
    let falls = |radius_mm: f64| {
        Verdict::No(Reason::Falls {
            angle_deg: angle_deg(radius_mm),
            least_deg,
            foot_mm: radius_mm,
        })
    };
    match asked.job.foot {
        FootSize::Given(radius) if angle_deg(radius.mm()) >= least_deg => {
            Verdict::Found(Some(foot(radius.mm())))
        }
        FootSize::Given(radius) => falls(radius.mm()),
        FootSize::Auto => {
            let first_mm = (telescope.shells[0].body_mm + FOOT_STEP_MM).ceil();
            let steps = ((most_mm - first_mm) / FOOT_STEP_MM).max(0.0) as usize;
            let radii = (0..=steps).map(|i| first_mm + FOOT_STEP_MM * i as f64);
            let mut holds = radii.filter(|mm| angle_deg(*mm) >= least_deg + SPARE_DEG);
            match holds.next() {
                Some(radius_mm) => Verdict::Found(Some(foot(radius_mm))),
                None => falls(most_mm),
            }
        }
    }
}

/// The greatest foot for a printer whose plate is not known, mm.
const MOST_FOOT_MM: f64 = 100.0;
