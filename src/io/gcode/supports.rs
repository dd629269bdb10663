//! The places of support: its material counted by cubes, so that supports inside voids are found.

use std::collections::BTreeMap;

use super::error::Limit;
use super::feature::Feature;
use super::machine::Stroke;
use crate::geom::Point;

/// The material of support in a cube.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SupportCell {
    /// The middle of the cube, mm.
    pub middle_mm: [f64; 3],
    /// Its material, mm³.
    pub volume_mm3: f64,
}

/// The sums of support under way, in units of E.
#[derive(Debug, Default)]
pub struct Supports {
    edge_mm: Option<f64>,
    /// The sums by cube, and whether E is a volume.
    sums: BTreeMap<([i32; 3], bool), f64>,
}

impl Supports {
    /// Starts with nothing; without an edge nothing is counted.
    pub fn new(edge_mm: Option<f64>) -> Self {
        Self {
            edge_mm: edge_mm.filter(|edge_mm| *edge_mm > 0.0),
            sums: BTreeMap::new(),
        }
    }

    /// Adds a bead of support at even steps along it; passes over other features.
    pub fn add(
        &mut self,
        stroke: &Stroke,
        feature: Feature,
        is_volumetric: bool,
    ) -> Result<(), Limit> {
        let is_support = matches!(feature, Feature::Support | Feature::SupportInterface);
        let Some(edge_mm) = self.edge_mm.filter(|_| is_support) else {
            return Ok(());
        };
        let way = stroke.to - stroke.from;
        let steps = (way.norm() / edge_mm).ceil().clamp(1.0, MOST_STEPS);
        let mut at = 0.5;
        while at < steps {
            let middle: Point = stroke.from + way * (at / steps);
            let cube = [0, 1, 2].map(|axis| (middle[axis] / edge_mm).floor() as i32);
            *self.sums.entry((cube, is_volumetric)).or_default() += stroke.feed / steps;
            at += 1.0;
        }
        if self.sums.len() as u64 > Limit::Cells.most() {
            return Err(Limit::Cells);
        }
        Ok(())
    }

    /// Returns the cubes that hold support, with the volume of a unit of E, mm³.
    pub fn cells(&self, volume_mm3: impl Fn(bool) -> f64) -> Vec<SupportCell> {
        let edge_mm = self.edge_mm.unwrap_or(0.0);
        let cell = |((cube, is_volumetric), sum): (&([i32; 3], bool), &f64)| SupportCell {
            middle_mm: cube.map(|index| (f64::from(index) + 0.5) * edge_mm),
            volume_mm3: sum * volume_mm3(*is_volumetric),
        };
        self.sums.iter().map(cell).collect()
    }
}

/// Most steps along a bead.
const MOST_STEPS: f64 = 1000.0;

#[cfg(test)]
mod tests {
    use crate::base::watch::Watch;
    use crate::io::gcode::{Options, read_text};

    #[test]
    fn support_is_counted_where_it_lies() {
        let text = "G90\nM83\n;TYPE:Support material\nG1 X0 Y1 Z0.2\nG1 X4 Y1 E4\n\
            ;TYPE:Perimeter\nG1 X9 Y1 E9\n";
        let options = Options {
            support_cell_mm: Some(2.0),
            filament_diameter_mm: Some(2.0),
            ..Options::default()
        };
        let found = read_text(text.as_bytes(), &options, &Watch::silent()).unwrap();
        let places: Vec<[f64; 3]> = found.supports.iter().map(|cell| cell.middle_mm).collect();
        assert_eq!(places, [[1.0, 1.0, 1.0], [3.0, 1.0, 1.0]]);
        let volume_mm3: f64 = found.supports.iter().map(|cell| cell.volume_mm3).sum();
        assert!((volume_mm3 - 4.0 * std::f64::consts::PI).abs() < 1e-12);
        let unasked = read_text(text.as_bytes(), &Options::default(), &Watch::silent()).unwrap();
        assert!(unasked.supports.is_empty());
    }
}
