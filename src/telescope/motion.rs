//! Opening a telescope: joint after joint, with a proof that nothing is hit on the way.
//!
//! Neighbours are free where they slide by the identity of the helix, pairs of one bend by its
//! reach. All other pairs are measured, in states so near that nothing lies between them.

use super::clearance::{Gap, Gaps, MAX_SLIDE_MM, Shown};
use super::nest::{JointState, Telescope};

/// The gap at which shells count as touching, mm.
const TOUCHING_MM: f64 = 0.05;

/// Share of the gap by which a step of the check may move a point.
const STEP_SHARE: f64 = 0.5;

/// The most steps of the check of one move. A gap so small that more are needed counts as none.
const MAX_STEPS: usize = 20_000;

/// States of a move at which the depth of a collision is measured.
const DEPTH_STATES: usize = 50;

/// The joints that move at the same time, in turn: first they slide out, then they turn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Order(Vec<Vec<usize>>);

/// The end of a move: every joint of the telescope, root first.
pub type Key = Vec<JointState>;

/// A free way to open a telescope.
#[derive(Debug, Clone, PartialEq)]
pub struct Opening {
    /// The order.
    pub order: Order,
    /// The states between moves, from all in to all out.
    pub keys: Vec<Key>,
    /// The least gap on the way. No collision lies between the states that were looked at.
    pub least: Gap,
}

/// An order that runs shells into each other.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error(
    "shells {first} and {second} run into each other, by {depth_mm:.1} mm at the deepest; remedy: \
     open in another order, such as the root first",
    first = shells[0] + 1,
    second = shells[1] + 1
)]
pub struct Collision {
    /// The order.
    pub order: Order,
    /// The two shells, counted from 0.
    pub shells: [usize; 2],
    /// The state in which they overlap most.
    pub state: Key,
    /// The overlap in that state, mm.
    pub depth_mm: f64,
}

/// A straight move between two states.
struct Move<'a> {
    telescope: &'a Telescope,
    from: &'a [JointState],
    to: &'a [JointState],
}

impl Order {
    /// Returns the order from the root to the tip: all beyond a joint that moves is still nested.
    pub fn root_first(joints: usize) -> Self {
        Self((0..joints).map(|joint| vec![joint]).collect())
    }

    /// Returns the order from the tip to the root.
    pub fn tip_first(joints: usize) -> Self {
        Self((0..joints).rev().map(|joint| vec![joint]).collect())
    }

    /// Returns the order in which all joints move at once, as films show it.
    pub fn together(joints: usize) -> Self {
        Self(vec![(0..joints).collect()])
    }

    /// Returns the groups of joints, counted from 0, in their turn.
    pub fn groups(&self) -> &[Vec<usize>] {
        &self.0
    }
}

impl Telescope {
    /// Opens the telescope in an order, or says which shells collide.
    ///
    /// All pairs are checked by conservative advancement. From a state with a gap, the next is so
    /// near that no point moves by more than half of the gap. So none lies between them in which
    /// shells touch. That holds for pairs that cease to be of one bend between the two, too.
    pub fn open_in(&self, order: &Order) -> Result<Opening, Box<Collision>> {
        self.move_in(order, &self.open())
    }

    /// Goes from all in to another state in an order, or says which shells collide. It is checked
    /// as an opening is.
    pub fn move_in(&self, order: &Order, to: &[JointState]) -> Result<Opening, Box<Collision>> {
        let keys = self.keys(order, to);
        let mut least = Shown::of(self, &keys[0]).gaps().least;
        for pair in keys.windows(2) {
            let motion = Move {
                telescope: self,
                from: &pair[0],
                to: &pair[1],
            };
            let Some(gap) = motion.least_gap() else {
                return Err(Box::new(motion.collision(order)));
            };
            if gap.gap_mm < least.gap_mm {
                least = gap;
            }
        }
        let order = order.clone();
        Ok(Opening { order, keys, least })
    }

    /// Finds a free order: root first or tip first, the one with the greater gap, else one found
    /// step by step. The error is that of the root first if none is free.
    pub fn find_opening(&self) -> Result<Opening, Box<Collision>> {
        self.find_way(&self.open())
    }

    /// Finds a free order from all in to another state, as [`Self::find_opening`] does.
    pub fn find_way(&self, to: &[JointState]) -> Result<Opening, Box<Collision>> {
        let joints = self.joints.len();
        let first = self.move_in(&Order::root_first(joints), to);
        match (first, self.move_in(&Order::tip_first(joints), to)) {
            (Ok(root), Ok(tip)) if tip.least.gap_mm > root.least.gap_mm => Ok(tip),
            (Ok(root), _) => Ok(root),
            (Err(_), Ok(tip)) => Ok(tip),
            (Err(collision), Err(_)) => {
                let found = self.step_by_step(to);
                let opening = found.and_then(|order| self.move_in(&order, to).ok());
                opening.ok_or(collision)
            }
        }
    }

    /// Moves at each turn the joint that keeps the greatest gap; `None` if a turn has none.
    fn step_by_step(&self, to: &[JointState]) -> Option<Order> {
        let mut left: Vec<usize> = (0..self.joints.len()).collect();
        let mut groups = Vec::new();
        let mut state = self.closed();
        while !left.is_empty() {
            let gap_of = |joint: &usize| {
                let [slid, turned] = moved(&state, to, &[*joint]);
                let slide = self.least_between(&state, &slid)?;
                let turn = self.least_between(&slid, &turned)?;
                Some(slide.min(turn))
            };
            let gaps: Vec<Option<f64>> = left.iter().map(gap_of).collect();
            let free = gaps
                .iter()
                .enumerate()
                .filter_map(|(i, gap)| gap.map(|gap| (i, gap)));
            let (best, _) = free.max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)))?;
            let joint = left.remove(best);
            [_, state] = moved(&state, to, &[joint]);
            groups.push(vec![joint]);
        }
        Some(Order(groups))
    }

    fn least_between(&self, from: &[JointState], to: &[JointState]) -> Option<f64> {
        let motion = Move {
            telescope: self,
            from,
            to,
        };
        motion.least_gap().map(|gap| gap.gap_mm)
    }

    /// Returns the states between the moves of an order.
    fn keys(&self, order: &Order, to: &[JointState]) -> Vec<Key> {
        let mut keys = vec![self.closed()];
        let mut state = self.closed();
        for group in &order.0 {
            let [slid, turned] = moved(&state, to, group);
            state.clone_from(&turned);
            keys.push(slid);
            keys.push(turned);
        }
        keys.dedup();
        keys
    }
}

/// Returns the states after joints slid to another state, and after they turned.
fn moved(state: &[JointState], to: &[JointState], joints: &[usize]) -> [Key; 2] {
    let mut slid = state.to_vec();
    for joint in joints.iter().filter(|joint| **joint < to.len()) {
        slid[*joint].slide_mm = to[*joint].slide_mm;
    }
    let mut turned = slid.clone();
    for joint in joints.iter().filter(|joint| **joint < to.len()) {
        turned[*joint].turn_rad = to[*joint].turn_rad;
    }
    [slid, turned]
}

impl Move<'_> {
    /// Returns the least gap on the way; `None` if shells touch.
    fn least_gap(&self) -> Option<Gap> {
        let mut shown = Shown::of(self.telescope, self.from);
        let mut gaps = shown.gaps();
        let (mut least, mut done) = (gaps.least, 0.0);
        for _ in 0..MAX_STEPS {
            if gaps.least.gap_mm < TOUCHING_MM {
                return None;
            }
            if done >= 1.0 {
                return Some(least);
            }
            done += self.safe_share(&shown, &gaps);
            shown = Shown::of(self.telescope, &self.at(done.min(1.0)));
            gaps = shown.gaps();
            if gaps.least.gap_mm < least.gap_mm {
                least = gaps.least;
            }
        }
        None
    }

    /// Returns the share of the move in which no point goes farther than half of every gap, and no
    /// more than some mm come out.
    fn safe_share(&self, shown: &Shown, gaps: &Gaps) -> f64 {
        let slides = self.from.iter().zip(self.to);
        let slid_mm: f64 = slides.map(|(a, b)| (b.slide_mm - a.slide_mm).abs()).sum();
        let by_slide = MAX_SLIDE_MM / slid_mm.max(MAX_SLIDE_MM);
        let far_mm = STEP_SHARE * gaps.least.gap_mm.min(gaps.reserve_mm);
        if !far_mm.is_finite() {
            return by_slide;
        }
        let speeds = (0..self.from.len()).map(|joint| {
            // The reach grows by no more than the step itself.
            let reach = shown.reach_mm(joint) + far_mm;
            let helix = &self.telescope.shells[joint + 1].helix;
            let slide = (self.to[joint].slide_mm - self.from[joint].slide_mm).abs();
            let turn = (self.to[joint].turn_rad - self.from[joint].turn_rad).abs();
            slide * (1.0 + helix.curvature.hypot(helix.torsion) * reach) + turn * reach
        });
        by_slide.min(far_mm / speeds.sum::<f64>().max(f64::MIN_POSITIVE))
    }

    fn at(&self, share: f64) -> Key {
        between(self.from, self.to, share)
    }

    /// Returns the deepest overlap of the move.
    fn collision(&self, order: &Order) -> Collision {
        let states = (0..=DEPTH_STATES).map(|i| self.at(i as f64 / DEPTH_STATES as f64));
        let gaps = states.map(|state| (Shown::of(self.telescope, &state).gaps().least, state));
        let deepest = gaps.min_by(|a, b| a.0.gap_mm.total_cmp(&b.0.gap_mm));
        let (gap, state) = deepest.unwrap_or_else(|| {
            let state = self.from.to_vec();
            (Shown::of(self.telescope, &state).gaps().least, state)
        });
        Collision {
            order: order.clone(),
            shells: gap.shells,
            state,
            depth_mm: -gap.gap_mm,
        }
    }
}

/// Returns the state at a share of the straight way between two.
pub(super) fn between(from: &[JointState], to: &[JointState], share: f64) -> Key {
    let ends = from.iter().zip(to);
    let between = |(from, to): (&JointState, &JointState)| JointState {
        slide_mm: from.slide_mm + (to.slide_mm - from.slide_mm) * share,
        turn_rad: from.turn_rad + (to.turn_rad - from.turn_rad) * share,
    };
    ends.map(between).collect()
}
