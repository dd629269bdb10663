//! The plan of a limb: its number of shells, and the depth of its root in its juncture.

use super::along::{at, radius_mm};
use super::skin::Skin;
use crate::geom::Point;
use crate::skeleton::{Chain, Limbs, Skeleton};
use crate::telescope::sizes::JointSizes;

/// Share of a limb's radius that its root takes: the rest is the wall of its juncture.
const ROOT_SHARE: f64 = 0.85;
/// Share of a limb's radius at its end that the last shell takes.
const TIP_SHARE: f64 = 0.85;
/// Least visible length of a shell, over what its caps and its overlap take.
const STAGE_RATIO: f64 = 1.6;
/// The most shells of a limb if nothing else is said: with more there are too many parts to glue.
const MOST_AUTO: usize = 5;
/// Share of the longest stroke that fewer shells must have.
const STROKE_SHARE: f64 = 0.9;
/// Share of a stage that stays inside, so that it does not wobble.
const OVERLAP_SHARE: f64 = 0.3;
/// Room for walls that grow by misfit, mm.
const MISFIT_MM: f64 = 0.5;
/// Places of a root that are tried, from all in to flush, and again as many outwards.
const PLACES: usize = 8;
/// The most of a limb's length by which its root is pushed outwards.
const PUSH_SHARE: f64 = 0.4;
/// Points of a root's axis, and points around its tail, that are looked at.
const STATIONS: usize = 12;
const AROUND: usize = 8;

/// A limb as it is to be made.
#[derive(Debug, Clone, PartialEq)]
pub struct Planned {
    /// Its nodes in the skeleton.
    pub nodes: Vec<usize>,
    /// The number of shells.
    pub shells: usize,
    /// Arc length along the limb at which the root's visible part begins, mm: below zero if it lies
    /// behind the first node.
    pub from_mm: f64,
    /// The most that the root's body radius may be, mm.
    pub root_mm: f64,
    /// Arc length along the limb at which it ends, mm.
    pub end_mm: f64,
    /// The length that stays inside of a shell that is all out, mm.
    pub overlap_mm: f64,
}

/// The measures by which limbs are planned.
#[derive(Debug, Clone, Copy)]
pub struct Measures {
    /// Measures of the joints with the least overlap.
    pub least: JointSizes,
    /// Body radius of the thinnest tip, mm.
    pub tip_mm: f64,
    /// The number of shells that was ordered; as many as are sound if `None`.
    pub shells: Option<usize>,
    /// The most that a root may be in radius, mm.
    pub root_mm: f64,
    /// The radius below which a limb stays solid, mm.
    pub solid_mm: f64,
}

/// The surroundings in which limbs are planned.
pub struct Ground<'a> {
    pub skeleton: &'a Skeleton,
    pub measures: &'a Measures,
    /// The model's surface, if junctures keep it.
    pub skin: Option<&'a Skin<'a>>,
}

/// A tube that lies in a juncture: points of its axis, and its radius.
struct Tube {
    axis: Vec<Point>,
    radius_mm: f64,
}

/// Plans every limb; the error names the first that gets none, by its index, with the reason.
pub fn plan(limbs: &Limbs, ground: &Ground) -> Result<Vec<Planned>, (usize, String)> {
    let Ground {
        skeleton,
        measures,
        skin,
    } = *ground;
    let mut planned: Vec<Option<Planned>> = vec![None; limbs.chains.len()];
    for juncture in 0..limbs.junctures.len() {
        let mut tubes: Vec<Tube> = limbs.junctures[juncture]
            .parent
            .map(|parent| incoming(&limbs.chains[parent]))
            .into_iter()
            .collect();
        let own = limbs.chains.iter().enumerate();
        let mut own: Vec<(usize, &Chain)> = own.filter(|(_, c)| c.from == juncture).collect();
        // The thickest first: it has the least choice.
        own.sort_by(|a, b| {
            radius_mm(b.1)
                .total_cmp(&radius_mm(a.1))
                .then(a.0.cmp(&b.0))
        });
        let balls = balls(limbs, skeleton, juncture);
        for (index, chain) in own {
            let most = count(chain, measures).map_err(|why| (index, why))?;
            let place = |shells: usize| Place {
                chain,
                measures,
                shells,
                balls: &balls,
                skin,
            };
            // In the model the root may have to be thinner, and then fewer shells fit.
            let fewest = skin.map_or(most, |_| 2);
            let mut counts = (fewest..=most).rev();
            let Some((found, tube)) = counts.find_map(|shells| place(shells).free(&tubes)) else {
                let why = match skin {
                    Some(_) => {
                        "no place for its root: a wall would be too thin, another root too \
                                near, or no cut across it alone"
                    }
                    None => "its root meets another in their juncture",
                };
                return Err((index, why.to_owned()));
            };
            tubes.push(tube);
            planned[index] = Some(found);
        }
    }
    Ok(planned.into_iter().flatten().collect())
}

/// Returns the nodes of a juncture with their balls.
fn balls(limbs: &Limbs, skeleton: &Skeleton, juncture: usize) -> Vec<(Point, f64)> {
    let nodes = limbs.junctures[juncture].nodes.iter();
    let ball = |node: &usize| (skeleton.nodes[*node].at, skeleton.nodes[*node].radius_mm);
    nodes.map(ball).collect()
}

/// Returns the end of the limb that carries a juncture: nothing else may lie there.
fn incoming(chain: &Chain) -> Tube {
    let radius_mm = TIP_SHARE * chain.radius_at_mm(chain.end_mm);
    let at = |i: usize| at(chain, chain.end_mm + radius_mm * i as f64 / STATIONS as f64);
    Tube {
        axis: (0..=STATIONS).map(at).collect(),
        radius_mm,
    }
}

/// Returns the number of shells of a limb, or the reason why it gets fewer than two.
fn count(chain: &Chain, measures: &Measures) -> Result<usize, String> {
    let least = &measures.least;
    let root_mm = root_mm(chain, measures);
    if radius_mm(chain) < measures.solid_mm {
        return Err("as ordered".to_owned());
    }
    let by_radius = (root_mm - MISFIT_MM - measures.tip_mm) / least.pitch_mm();
    let by_radius = if by_radius < 0.0 {
        0
    } else {
        1 + by_radius as usize
    };
    let stage_mm = STAGE_RATIO * (least.closed_mm() + least.overlap_mm());
    let by_length = 1 + (chain.free_mm() / stage_mm) as usize;
    let wanted = measures.shells.unwrap_or(MOST_AUTO);
    let words = |what: &str| format!("too {what} for two shells");
    match (by_radius, by_length) {
        (0 | 1, _) => Err(words("thin")),
        (_, 0 | 1) => Err(words("short")),
        (by_radius, by_length) => {
            let most = wanted.min(by_radius).min(by_length).max(2);
            let is_free = measures.shells.is_none();
            Ok(if is_free {
                worthwhile(chain.free_mm(), least.closed_mm(), most)
            } else {
                most
            })
        }
    }
}

/// Returns the fewest shells whose stroke is nearly the greatest of up to so many. More of them are
/// thinner, and more parts to glue.
///
/// On a length l, n shells that stand out by c each when all in have a stroke of (n − 1)(l/n − c).
fn worthwhile(length_mm: f64, closed_mm: f64, most: usize) -> usize {
    let stroke_mm = |n: usize| (n - 1) as f64 * (length_mm / n as f64 - closed_mm);
    let longest_mm = (2..=most).map(stroke_mm).fold(0.0, f64::max);
    let mut counts = 2..=most;
    let is_worth = |n: &usize| stroke_mm(*n) >= STROKE_SHARE * longest_mm;
    counts.find(is_worth).unwrap_or(most)
}

fn root_mm(chain: &Chain, measures: &Measures) -> f64 {
    (ROOT_SHARE * radius_mm(chain)).min(measures.root_mm)
}

/// Returns the radius of the last shell that a limb of so many shells may have, mm; `None` if they
/// do not nest.
pub fn tip_mm(chain: &Chain, planned: &Planned, measures: &Measures) -> Option<f64> {
    let steps = planned.shells.saturating_sub(1) as f64;
    let by_root_mm = planned.root_mm - MISFIT_MM - steps * measures.least.pitch_mm();
    let by_end_mm = TIP_SHARE * chain.radius_at_mm(chain.end_mm);
    (by_root_mm >= measures.tip_mm).then_some(by_root_mm.min(by_end_mm).max(measures.tip_mm))
}

/// A limb for whose root a place is searched.
struct Place<'a> {
    chain: &'a Chain,
    measures: &'a Measures,
    shells: usize,
    balls: &'a [(Point, f64)],
    skin: Option<&'a Skin<'a>>,
}

impl Place<'_> {
    /// Returns the deepest place in which the root meets nothing, with the tube that it takes.
    fn free(&self, tubes: &[Tube]) -> Option<(Planned, Tube)> {
        let found = self.places().into_iter().find_map(|from_mm| {
            let root_mm = self.root_mm(from_mm)?;
            let tube = self.tube(from_mm, root_mm);
            let is_held = match self.skin {
                Some(skin) => self.is_cut(from_mm, skin),
                None => self.is_inside(from_mm, &tube),
            };
            let is_free = is_held && self.is_apart(&tube, tubes);
            is_free.then_some((from_mm, root_mm, tube))
        });
        let (from_mm, root_mm, tube) = found?;
        let planned = Planned {
            nodes: self.chain.nodes.clone(),
            shells: self.shells,
            from_mm,
            root_mm,
            end_mm: self.chain.end_mm,
            overlap_mm: self.overlap_mm(from_mm),
        };
        Some((planned, tube))
    }

    /// Returns the radius that the root may have in a place, mm; `None` if too little for its
    /// shells.
    ///
    /// In the model it takes what the walls leave; in other junctures its share of the limb.
    fn root_mm(&self, from_mm: f64) -> Option<f64> {
        let least = &self.measures.least;
        let Some(skin) = self.skin else {
            return Some(root_mm(self.chain, self.measures));
        };
        let axis = self.tube(from_mm, 0.0).axis;
        let room_mm = skin.room_mm(&axis) - least.wall_mm - least.glue_mm;
        let root_mm = room_mm.min(self.measures.root_mm);
        let nested_mm = (self.shells - 1) as f64 * least.pitch_mm();
        (root_mm >= self.measures.tip_mm + MISFIT_MM + nested_mm).then_some(root_mm)
    }

    /// Returns true if the model can be cut across the branch alone at the root's mouth.
    fn is_cut(&self, from_mm: f64, skin: &Skin) -> bool {
        let mouth_mm = from_mm + self.visible_mm(from_mm) + 0.5 * self.overlap_mm(from_mm);
        let step_mm = self.measures.tip_mm;
        let [behind, mouth, ahead] =
            [mouth_mm - step_mm, mouth_mm, mouth_mm + step_mm].map(|arc| at(self.chain, arc));
        skin.ring_across(&mouth, &(ahead - behind)).is_some()
    }

    /// Returns where the root may begin, the deepest first.
    fn places(&self) -> Vec<f64> {
        let (start, free) = (self.chain.start_mm, self.chain.free_mm());
        let deep = free / (self.shells - 1) as f64;
        let share = |i: usize| i as f64 / PLACES as f64;
        let inwards = (0..=PLACES).map(|i| start - (1.0 - share(i)) * deep);
        let outwards = (1..=PLACES).map(|i| start + share(i) * PUSH_SHARE * free);
        inwards.chain(outwards).collect()
    }

    /// Returns the visible length of every shell.
    fn visible_mm(&self, from_mm: f64) -> f64 {
        (self.chain.end_mm - from_mm) / self.shells as f64
    }

    fn overlap_mm(&self, from_mm: f64) -> f64 {
        let least_mm = self.measures.least.overlap_mm();
        least_mm.max(OVERLAP_SHARE * self.visible_mm(from_mm))
    }

    /// Returns the root from tail to mouth.
    fn tube(&self, from_mm: f64, root_mm: f64) -> Tube {
        let half_mm = 0.5 * self.overlap_mm(from_mm);
        let visible_mm = self.visible_mm(from_mm);
        let span = visible_mm + 2.0 * half_mm;
        let place = |i: usize| {
            at(
                self.chain,
                from_mm - half_mm + span * i as f64 / STATIONS as f64,
            )
        };
        Tube {
            axis: (0..=STATIONS).map(place).collect(),
            radius_mm: root_mm + self.measures.least.glue_mm,
        }
    }

    /// Returns true if the tail has a wall of the juncture around it, or is pushed outwards, where
    /// a collar holds it.
    fn is_inside(&self, from_mm: f64, tube: &Tube) -> bool {
        if from_mm >= self.chain.start_mm {
            return true;
        }
        let wall_mm = 2.0 * self.measures.least.wall_mm;
        let along = (tube.axis[1] - tube.axis[0]).normalize();
        let (u, v) = crate::geom::orthonormal_basis(&along);
        let ring = (0..AROUND).map(|i| {
            let (sin, cos) = (std::f64::consts::TAU * i as f64 / AROUND as f64).sin_cos();
            tube.axis[0] + (u * cos + v * sin) * tube.radius_mm
        });
        let mut ring = ring;
        ring.all(|p| {
            let mut balls = self.balls.iter();
            balls.any(|(centre, radius_mm)| (p - centre).norm() <= radius_mm - wall_mm)
        })
    }

    fn is_apart(&self, tube: &Tube, tubes: &[Tube]) -> bool {
        let least = &self.measures.least;
        let needed_mm = least.wall_mm + 2.0 * least.glue_mm;
        tubes.iter().all(|other| {
            let pairs = tube
                .axis
                .iter()
                .flat_map(|p| other.axis.iter().map(move |q| [p, q]));
            let nearest = pairs
                .map(|[p, q]| (p - q).norm())
                .fold(f64::INFINITY, f64::min);
            nearest - tube.radius_mm - other.radius_mm >= needed_mm
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_short_limb_gets_fewer_shells_if_more_would_hardly_come_out_farther() {
        // On 40 mm four shells come out by 16.2 mm, three by 17.5 mm, two by 15.4 mm.
        assert_eq!(worthwhile(40.0, 4.6, 4), 3);
        // On 30 mm three come out by 10.8 mm, two by 10.4 mm.
        assert_eq!(worthwhile(30.0, 4.6, 4), 2);
        // On 140 mm five come out by 93.6 mm, four by 91.2 mm, three by 84.1 mm.
        assert_eq!(worthwhile(140.0, 4.6, 5), 4);
    }
}
