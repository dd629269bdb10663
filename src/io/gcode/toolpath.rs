//! What a print lays down: moments, boxes and volumes by object, place, feature and tool.

use std::collections::BTreeMap;

use super::facts::Facts;
use super::feature::Feature;
use super::label::Label;
use super::supports::SupportCell;
use crate::geom::Aabb;
use crate::mass::Moments;

/// The material that a file lays down, and the facts that it states.
///
/// Places are in the coordinates of the machine, mm. A file that names no features counts as a
/// whole: all of its material is [`Feature::Other`].
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Toolpath {
    /// The slicer's own statements.
    pub facts: Facts,
    /// The objects, in the order of their first beads or retractions.
    pub objects: Vec<PrintedObject>,
    /// The material within each place that was asked for, in that order.
    pub places: Vec<Deposits>,
    /// The support by cubes of the edge that was asked for; empty if none was.
    pub supports: Vec<SupportCell>,
    /// Where every mm of filament went.
    pub feed: Feed,
    /// Diameter of the filament used for volumes, mm, for each tool from 0.
    pub diameters_mm: Vec<f64>,
    /// The origin of these diameters.
    pub diameter_source: DiameterSource,
    /// Number of layers.
    pub layers: u64,
    /// Number of lines read.
    pub lines: u64,
}

/// A plate of a file.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Plate {
    /// The number of the plate in a package of several, from 1; `None` for a file of one.
    pub number: Option<u32>,
    /// What is printed on it.
    pub toolpath: Toolpath,
}

/// The origin of the filament's diameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DiameterSource {
    /// The caller gave it.
    Given,
    /// The file states it.
    Stated,
    /// Neither: 1.75 mm is assumed.
    Assumed,
    /// E is a volume, so no diameter is needed.
    Unneeded,
}

/// An object on the plate.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct PrintedObject {
    /// Its label; `None` for all material outside labelled objects.
    pub label: Option<Label>,
    /// Its material.
    pub deposits: Deposits,
}

/// Material, counted by feature and tool.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct Deposits {
    /// One tally for each feature and tool, in the order of features.
    pub tallies: Vec<Tally>,
    /// Number of layers in which material was laid.
    pub layers: u64,
    /// Number of retractions.
    pub retractions: u64,
}

/// The material of one feature from one tool.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Tally {
    /// The feature.
    pub feature: Feature,
    /// The number of the tool, from 0.
    pub tool: u16,
    /// The ten moments of its beads, mm³ to mm⁵, without `M221`.
    pub moments: Moments,
    /// The box around the nozzle's paths, mm, down to the undersides of the beads. Beads reach
    /// half their width beyond it.
    pub bounds: Aabb,
    /// The volume with the flow that `M221` sets, mm³.
    pub flowed_mm3: f64,
    /// Length of the beads seen from above, mm.
    pub length_mm: f64,
    /// Height times length of the beads, mm².
    pub side_mm2: f64,
    /// Number of beads.
    pub beads: u64,
}

/// Where the filament went, as E counts it: mm of filament, or mm³ if E is a volume.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Feed {
    /// Laid in beads.
    pub laid: f64,
    /// Pushed out while the nozzle stood still or only rose, mostly after retractions.
    pub pushed: f64,
    /// Pulled back while the nozzle stood still; above zero.
    pub retracted: f64,
    /// Pulled back while the nozzle moved; above zero.
    pub wiped: f64,
}

impl Feed {
    /// Returns what left the spool on balance.
    pub fn net(&self) -> f64 {
        self.laid + self.pushed - self.retracted - self.wiped
    }
}

impl Toolpath {
    /// Returns the moments of all objects without supports and the like, mm³ to mm⁵.
    pub fn part_moments(&self) -> Moments {
        let all = self
            .objects
            .iter()
            .map(|object| object.deposits.part_moments());
        all.fold(Moments::default(), |sum, moments| sum + moments)
    }

    /// Returns the object of this name, with or without its number; `None` if there is none.
    pub fn object(&self, name: &str) -> Option<&PrintedObject> {
        let is_it = |label: &Label| label.name == name || label.to_string() == name;
        let mut objects = self.objects.iter();
        objects.find(|object| object.label.as_ref().is_some_and(is_it))
    }

    /// Returns the flow of `M221` as a factor of the objects' volume; 1 if the file sets none.
    pub fn flow_ratio(&self) -> f64 {
        let parts = || {
            self.objects
                .iter()
                .flat_map(|object| object.deposits.part())
        };
        let volume_mm3: f64 = parts().map(|tally| tally.moments.volume()).sum();
        let flowed_mm3: f64 = parts().map(|tally| tally.flowed_mm3).sum();
        if volume_mm3 > 0.0 {
            flowed_mm3 / volume_mm3
        } else {
            1.0
        }
    }
}

impl Tally {
    /// Returns the mean height of the beads, mm; not finite if there is none.
    pub fn height_mm(&self) -> f64 {
        self.side_mm2 / self.length_mm
    }

    /// Returns the mean section of the beads, mm²; not finite if there is none.
    pub fn section_mm2(&self) -> f64 {
        self.moments.volume() / self.length_mm
    }
}

impl Deposits {
    /// Returns the tallies of what stays in the finished object: see [`Feature::is_part`].
    pub fn part(&self) -> impl Iterator<Item = &Tally> {
        self.tallies.iter().filter(|tally| tally.feature.is_part())
    }

    /// Returns the moments of what stays in the finished object, mm³ to mm⁵.
    pub fn part_moments(&self) -> Moments {
        self.weighed(|_| 1.0)
    }

    /// Returns the moments of mass of what stays, g to g·mm², with a density for each tool,
    /// g/mm³. [`crate::mass::Body::new`] takes them with a density of 1.
    pub fn weighed(&self, density_g_mm3: impl Fn(u16) -> f64) -> Moments {
        let weighed = self
            .part()
            .map(|tally| tally.moments * density_g_mm3(tally.tool));
        weighed.fold(Moments::default(), |sum, moments| sum + moments)
    }

    /// Returns the box around the paths of what stays, mm; empty if there is nothing.
    pub fn part_bounds(&self) -> Aabb {
        self.part()
            .fold(Aabb::EMPTY, |all, tally| all.union(&tally.bounds))
    }

    /// Returns the volume of every feature, mm³, parts or not.
    pub fn volumes_mm3(&self) -> BTreeMap<Feature, f64> {
        let mut volumes = BTreeMap::new();
        for tally in &self.tallies {
            *volumes.entry(tally.feature).or_default() += tally.moments.volume();
        }
        volumes
    }
}
