//! Support in the voids of parts: it adds weight where the kit wants none, unless it is taken out.

use super::matching::{Catalogue, Match};
use super::source::Source;
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Bvh, Point, Vector};
use crate::mass::Moments;
use crate::verify::{Body, Evidence};

/// Cubes of support between two looks at the watch.
const WATCHED: usize = 1 << 12;

/// The voids of a kit and the parts around them.
pub(super) struct Voids<'a> {
    evidence: &'a Evidence,
    body: &'a Body,
    /// The trees over the triangles of the parts, print frame.
    parts: Vec<Bvh>,
}

/// Support in a void.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct VoidSupport {
    /// The index of the part.
    pub(super) part: usize,
    /// Its moments as points, model frame, mm³ to mm⁵.
    pub(super) moments: Moments,
}

impl<'a> Voids<'a> {
    /// Takes the voids of a body.
    pub(super) fn new(evidence: &'a Evidence, body: &'a Body) -> Self {
        let tree = |part: &crate::verify::PartEvidence| Bvh::new(part.mesh.iter_corners());
        Self {
            evidence,
            body,
            parts: evidence.parts.iter().map(tree).collect(),
        }
    }

    /// Returns the support in the voids of these parts. A cube of support belongs to the part of
    /// its plate that is nearest to it.
    pub(super) fn find_support(
        &self,
        catalogue: &Catalogue,
        found: &[Match],
        sources: &[Source],
        watch: &Watch,
    ) -> Result<Vec<VoidSupport>, Cancelled> {
        let is_part = |this: &&Match| !catalogue.things[this.thing].is_jig;
        let mut all: Vec<VoidSupport> = Vec::new();
        for (index, source) in sources.iter().enumerate() {
            let here = found.iter().filter(is_part);
            let here: Vec<&Match> = here.filter(|this| this.source == index).collect();
            for (count, cell) in source.toolpath.supports.iter().enumerate() {
                if count % WATCHED == 0 {
                    watch.check()?;
                }
                let plate = Point::from(cell.middle_mm);
                let places = here.iter().map(|this| {
                    let thing = &catalogue.things[this.thing];
                    (this.thing, thing.point_to_model(&this.fit, &plate))
                });
                let Some((part, at)) = self.nearest(places) else {
                    continue;
                };
                if self.is_in_void(&at) {
                    let point = Moments(Moments::monomials(at.x, at.y, at.z)) * cell.volume_mm3;
                    all.push(VoidSupport {
                        part,
                        moments: point,
                    });
                }
            }
        }
        Ok(all)
    }

    /// Returns the part whose surface is nearest to its own point.
    fn nearest(&self, places: impl Iterator<Item = (usize, Point)>) -> Option<(usize, Point)> {
        let distance = |(part, at): &(usize, Point)| {
            let print = self.evidence.parts[*part].pose.to_print(at);
            let nearest = self.parts[*part].closest(&print, f64::INFINITY, &[]);
            nearest.map_or(f64::INFINITY, |nearest| nearest.distance_squared)
        };
        let distances = places.map(|place| (distance(&place), place));
        let least = distances.min_by(|a, b| a.0.total_cmp(&b.0));
        least.map(|(_, place)| place)
    }

    /// Returns true if a point of the model lies inside the outside, but not in material.
    fn is_in_void(&self, at: &Point) -> bool {
        // A step aside keeps the rays of winding numbers off the corners of round coordinates.
        let at = at + Vector::new(1.3e-7, 2.9e-7, 1.7e-7);
        self.body.outside.winding(&at) != 0 && self.body.whole.winding(&at) == 0
    }
}
