//! Sums of beads under way, before the diameter of the filament is known.

use std::collections::HashMap;

use super::error::Limit;
use super::feature::Feature;
use super::machine::{Machine, Stroke};
use super::supports::Supports;
use super::toolpath::Feed;
use crate::geom::Aabb;
use crate::mass::{Bead, BeadMoments};

/// Moves shorter than this, seen from above, lay no bead, mm.
const LEAST_MM: f64 = 1e-9;

/// The owner of a bead.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Owner {
    /// A labelled object, or all outside them.
    Object(Option<usize>),
    /// A place that was asked for.
    Place(usize),
}

/// A tally is kept for each of these.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Key {
    /// Whose it is.
    pub owner: Owner,
    /// The feature.
    pub feature: Feature,
    /// The tool.
    pub tool: u16,
    /// True if E is a volume.
    pub is_volumetric: bool,
}

/// The sums of one tally, in units of E.
#[derive(Debug, Clone, Copy)]
pub struct Sum {
    /// The moments.
    pub beads: BeadMoments,
    /// What E moved, with the flow of `M221`.
    pub flowed: f64,
    /// Length, mm.
    pub length_mm: f64,
    /// Height times length, mm².
    pub side_mm2: f64,
    /// Number of beads.
    pub count: u64,
    /// The box around them, mm.
    pub bounds: Aabb,
}

/// The counts of an owner.
#[derive(Debug, Clone, Copy, Default)]
pub struct Counts {
    /// The order in which owners were met.
    pub rank: usize,
    /// Number of layers.
    pub layers: u64,
    latest_layer: Option<u64>,
    /// Number of retractions.
    pub retractions: u64,
}

/// A rectangle of the plate.
#[derive(Debug, Clone, PartialEq)]
pub struct Place {
    /// Least x and y, mm.
    pub min_mm: [f64; 2],
    /// Greatest x and y, mm.
    pub max_mm: [f64; 2],
}

/// The circumstances of a bead.
#[derive(Debug, Clone, Copy)]
pub struct Context {
    /// Index of the label.
    pub object: Option<usize>,
    /// The feature.
    pub feature: Feature,
    /// Number of the layer.
    pub layer: u64,
}

/// All sums of a file.
#[derive(Debug)]
pub struct Sums {
    /// The places that are counted apart.
    pub places: Vec<Place>,
    index: HashMap<Key, usize>,
    /// The tallies.
    pub sums: Vec<(Key, Sum)>,
    /// The counts of each owner.
    pub owners: HashMap<Owner, Counts>,
    /// The tallies of the bead before: of its object, and of its place.
    latest: [Option<(Key, usize)>; 2],
    /// Support by cubes of this edge; empty without one.
    pub supports: Supports,
    /// Where the filament went.
    pub feed: Feed,
    is_retracted: bool,
}

impl Sums {
    /// Starts with nothing, for these places and cubes of support.
    pub fn new(places: &[Place], support_cell_mm: Option<f64>) -> Self {
        Self {
            places: places.to_vec(),
            supports: Supports::new(support_cell_mm),
            index: HashMap::new(),
            sums: Vec::new(),
            owners: HashMap::new(),
            latest: [None; 2],
            feed: Feed::default(),
            is_retracted: false,
        }
    }

    /// Returns true if a move lays a bead. Keeps the books of moves that do not.
    pub fn is_bead(&mut self, stroke: &Stroke, context: &Context) -> bool {
        let length_mm = bead(stroke, 1.0).length_mm();
        let is_moving = length_mm > LEAST_MM;
        let feed = stroke.feed;
        match (feed > 0.0, is_moving) {
            (true, true) => self.feed.laid += feed,
            (true, false) => self.feed.pushed += feed,
            (false, true) => self.feed.wiped -= feed,
            (false, false) => self.feed.retracted -= feed,
        }
        if feed < 0.0 && !self.is_retracted {
            self.retract(context);
        }
        self.is_retracted = feed < 0.0 || feed == 0.0 && self.is_retracted;
        feed > 0.0 && is_moving
    }

    /// Counts a retraction.
    pub fn retract(&mut self, context: &Context) {
        self.is_retracted = true;
        let rank = self.owners.len();
        let counts = self.owners.entry(Owner::Object(context.object));
        counts
            .or_insert(Counts {
                rank,
                ..Counts::default()
            })
            .retractions += 1;
    }

    /// Adds a bead of this height to its object and its place.
    pub fn add(
        &mut self,
        stroke: &Stroke,
        height_mm: f64,
        context: &Context,
        machine: &Machine,
    ) -> Result<(), Limit> {
        let bead = bead(stroke, height_mm);
        let moments = bead.polynomial().scaled(stroke.feed);
        let one = Sum {
            beads: moments,
            flowed: stroke.feed * machine.flow_ratio,
            length_mm: bead.length_mm(),
            side_mm2: bead.length_mm() * height_mm,
            count: 1,
            bounds: bead.bounds(),
        };
        let middle = nalgebra::center(&stroke.from, &stroke.to);
        let place = self.places.iter().position(|place| {
            let is_within =
                |axis: usize| (place.min_mm[axis]..=place.max_mm[axis]).contains(&middle[axis]);
            is_within(0) && is_within(1)
        });
        let owners = [Some(Owner::Object(context.object)), place.map(Owner::Place)];
        self.supports
            .add(stroke, context.feature, machine.is_volumetric)?;
        for (slot, owner) in owners.into_iter().enumerate() {
            if let Some(owner) = owner {
                let key = Key {
                    owner,
                    feature: context.feature,
                    tool: machine.tool,
                    is_volumetric: machine.is_volumetric,
                };
                let at = self.tally(slot, key)?;
                self.sums[at].1.add(&one);
                self.count_layer(owner, context.layer);
            }
        }
        Ok(())
    }

    /// Returns the index of a tally, and makes it if it is new.
    fn tally(&mut self, slot: usize, key: Key) -> Result<usize, Limit> {
        if let Some((latest, at)) = self.latest[slot]
            && latest == key
        {
            return Ok(at);
        }
        let next = self.sums.len();
        let at = *self.index.entry(key).or_insert(next);
        if at == next {
            if next as u64 >= Limit::Tallies.most() {
                return Err(Limit::Tallies);
            }
            self.sums.push((key, Sum::EMPTY));
        }
        self.latest[slot] = Some((key, at));
        Ok(at)
    }

    fn count_layer(&mut self, owner: Owner, layer: u64) {
        let rank = self.owners.len();
        let counts = self.owners.entry(owner).or_insert(Counts {
            rank,
            ..Counts::default()
        });
        if counts.latest_layer != Some(layer) {
            counts.latest_layer = Some(layer);
            counts.layers += 1;
        }
    }

    /// Counts all material without a name of a feature as one feature: the file names none.
    pub fn forget_features(&mut self) {
        for (key, _) in &mut self.sums {
            key.feature = Feature::Other;
        }
    }
}

impl Sum {
    const EMPTY: Self = Self {
        beads: BeadMoments {
            linear: crate::mass::Moments([0.0; 10]),
            cubic: crate::mass::Moments([0.0; 10]),
        },
        flowed: 0.0,
        length_mm: 0.0,
        side_mm2: 0.0,
        count: 0,
        bounds: Aabb::EMPTY,
    };

    fn add(&mut self, other: &Self) {
        self.beads += other.beads;
        self.flowed += other.flowed;
        self.length_mm += other.length_mm;
        self.side_mm2 += other.side_mm2;
        self.count += other.count;
        self.bounds = self.bounds.union(&other.bounds);
    }
}

fn bead(stroke: &Stroke, height_mm: f64) -> Bead {
    Bead {
        from: stroke.from,
        to: stroke.to,
        turn: stroke.turn,
        height_mm,
    }
}
