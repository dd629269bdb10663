//! From sums in units of E to volumes, once the diameter of the filament is known.

use std::collections::HashMap;
use std::f64::consts::PI;

use super::facts::Facts;
use super::label::Label;
use super::sums::{Counts, Key, Owner, Sum, Sums};
use super::supports::SupportCell;
use super::toolpath::{Deposits, DiameterSource, PrintedObject, Tally};

/// Diameter of filament if nothing tells it, mm.
const USUAL_DIAMETER_MM: f64 = 1.75;

/// The volume of a unit of E.
pub struct Gauge {
    /// Diameters used, mm, for each tool.
    pub diameters_mm: Vec<f64>,
    /// Their origin.
    pub source: DiameterSource,
    /// True if E is a volume throughout the file.
    are_volumes: bool,
}

impl Gauge {
    /// Chooses the diameters: those given, those that the file states, or the usual one.
    pub fn choose(sums: &Sums, facts: &Facts, given_mm: Option<f64>) -> Self {
        let are_volumes = facts.is_volumetric == Some(true)
            || facts.flavor.as_deref().is_some_and(is_volumetric_flavor);
        let stated = &facts.filament_diameter_mm;
        let source = match (given_mm, stated.first()) {
            _ if are_volumes || sums.sums.iter().all(|(key, _)| key.is_volumetric) => {
                DiameterSource::Unneeded
            }
            (Some(_), _) => DiameterSource::Given,
            (None, Some(_)) => DiameterSource::Stated,
            (None, None) => DiameterSource::Assumed,
        };
        let tools = sums.sums.iter().map(|(key, _)| usize::from(key.tool) + 1);
        let diameter_mm = |tool: usize| {
            let stated = stated.get(tool).or(stated.first()).copied();
            given_mm.or(stated).unwrap_or(USUAL_DIAMETER_MM)
        };
        Self {
            diameters_mm: (0..tools.max().unwrap_or(0)).map(diameter_mm).collect(),
            source,
            are_volumes,
        }
    }

    /// Returns the volume of a unit of E, mm³.
    fn factor(&self, key: &Key) -> f64 {
        self.volume_mm3(key.tool, key.is_volumetric)
    }

    /// Returns the volume of a unit of E from a tool, mm³.
    fn volume_mm3(&self, tool: u16, is_volumetric: bool) -> f64 {
        if self.are_volumes || is_volumetric {
            1.0
        } else {
            0.25 * PI * self.diameters_mm[usize::from(tool)].powi(2)
        }
    }
}

/// The material of all objects and places.
pub struct Totals {
    /// The objects, in the order in which they were met.
    pub objects: Vec<PrintedObject>,
    /// The places, in the order in which they were asked for.
    pub places: Vec<Deposits>,
    /// The support by cubes.
    pub supports: Vec<SupportCell>,
}

impl Totals {
    /// Gathers the sums by their owners.
    pub fn gather(sums: &Sums, gauge: &Gauge, labels: &[Label]) -> Self {
        let mut tallies: Vec<&(Key, Sum)> = sums.sums.iter().collect();
        tallies.sort_by_key(|(key, _)| *key);
        let mut deposits: HashMap<Owner, Deposits> = HashMap::new();
        for (key, sum) in tallies {
            let factor = gauge.factor(key);
            deposits
                .entry(key.owner)
                .or_default()
                .take(key, sum, factor);
        }
        let mut owners: Vec<(&Owner, &Counts)> = sums.owners.iter().collect();
        owners.sort_by_key(|(_, counts)| counts.rank);
        let mut places = vec![Deposits::default(); sums.places.len()];
        let mut objects = Vec::new();
        for (owner, counts) in owners {
            let mut deposits = deposits.remove(owner).unwrap_or_default();
            (deposits.layers, deposits.retractions) = (counts.layers, counts.retractions);
            match *owner {
                Owner::Place(place) => places[place] = deposits,
                Owner::Object(object) => objects.push(PrintedObject {
                    label: object.map(|object| labels[object].clone()),
                    deposits,
                }),
            }
        }
        let supports = sums
            .supports
            .cells(|is_volumetric| gauge.volume_mm3(0, is_volumetric));
        Self {
            objects,
            places,
            supports,
        }
    }
}

impl Deposits {
    /// Takes a sum, at `factor` mm³ for each unit of E. Tools and features come in their order.
    fn take(&mut self, key: &Key, sum: &Sum, factor: f64) {
        let moments = sum.beads.at(factor);
        if let Some(tally) = self.tallies.last_mut()
            && (tally.feature, tally.tool) == (key.feature, key.tool)
        {
            tally.moments += moments;
            tally.flowed_mm3 += sum.flowed * factor;
            tally.length_mm += sum.length_mm;
            tally.side_mm2 += sum.side_mm2;
            tally.beads += sum.count;
            tally.bounds = tally.bounds.union(&sum.bounds);
            return;
        }
        self.tallies.push(Tally {
            feature: key.feature,
            tool: key.tool,
            moments,
            bounds: sum.bounds,
            flowed_mm3: sum.flowed * factor,
            length_mm: sum.length_mm,
            side_mm2: sum.side_mm2,
            beads: sum.count,
        });
    }
}

/// Returns true for the dialects of Cura in which E is a volume.
fn is_volumetric_flavor(flavor: &str) -> bool {
    flavor.eq_ignore_ascii_case("UltiGCode") || flavor.contains("Volumetric")
}
