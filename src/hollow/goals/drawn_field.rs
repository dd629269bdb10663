//! A given field whose regions are drawn as bodies: no quadric bounds them.

use std::sync::Arc;

use super::asked::{Asked, Case, End};
use super::near::NearWished;
use crate::base::verdict::Verdict;
use crate::base::watch::Watch;
use crate::geom::{Frame, Quadric};
use crate::hollow::Problem;
use crate::hollow::solution::Solution;
use crate::interior::Columns;
use crate::mass::Moments;
use crate::mesh::TriMesh;

/// A field that is printed in nested regions, each a body inside of the one before.
///
/// It is given and stays as it is, so its bodies are drawn once, before anything is solved for.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnField {
    words: String,
    regions: Vec<DrawnRegion>,
}

/// A region of one density, less the regions in it.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnRegion {
    /// The density.
    pub density: f64,
    /// The body that bounds it; `None` for all of the interior.
    pub body: Option<Arc<DrawnBody>>,
}

/// A closed body, of which the interior takes its part.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnBody {
    model: TriMesh,
    local: TriMesh,
}

impl DrawnBody {
    /// Returns a body given in model coordinates. `frame` is the goal's.
    pub fn new(model: TriMesh, frame: &Frame) -> Self {
        Self {
            local: model.map_vertices(|p| frame.to_local(p)),
            model,
        }
    }

    /// Returns the surface in model coordinates.
    pub fn mesh(&self) -> &TriMesh {
        &self.model
    }

    /// Returns the moments of what of some columns lies in the body, goal frame.
    pub fn moments(&self, columns: &Columns) -> Moments {
        columns.moments() - columns.without(&self.local).moments()
    }
}

impl DrawnField {
    /// Returns the field with these words and regions, the outermost first.
    pub fn new(words: String, regions: Vec<DrawnRegion>) -> Self {
        Self { words, regions }
    }

    /// Returns the words for the field: as they were typed, or the name of a file in the kit.
    pub fn words(&self) -> &str {
        &self.words
    }

    /// Returns the regions, the outermost first.
    pub fn regions(&self) -> &[DrawnRegion] {
        &self.regions
    }

    /// Returns the body of the region with this index; `None` if the interior bounds it.
    pub fn body(&self, index: usize) -> Option<&DrawnBody> {
        self.regions.get(index)?.body.as_deref()
    }

    /// Holds the field against a goal. The certificate bounds the change from the wished density by
    /// the least of all densities.
    ///
    /// If it does not meet the goal, the status says by how much.
    #[must_use]
    pub fn solve(
        &self,
        near: &NearWished,
        problem: &Problem,
        known: Option<&Solution>,
        watch: &Watch,
    ) -> Solution {
        match Asked::of(near, problem, known, watch) {
            Verdict::Found(asked) => {
                asked.judge(problem, near, |case, _| self.end(case, near.wished))
            }
            Verdict::No(impossible) => *impossible,
        }
    }

    fn end(&self, case: &Case, wished: f64) -> End {
        let change = |density: f64| 0.5 * (density - wished).powi(2);
        let columns = case.graded.columns;
        let interior = columns.moments();
        let (mut moments, mut cost_mm3) = (case.graded.shell, 0.0);
        let (mut around, mut around_cost) = (0.0, 0.0);
        for region in &self.regions {
            let body = region.body.as_ref();
            let within = body.map_or(interior, |body| body.moments(columns));
            let cost = change(region.density);
            moments += within * (region.density - around);
            cost_mm3 += within.volume() * (cost - around_cost);
            (around, around_cost) = (region.density, cost);
        }
        End {
            quadric: Quadric(std::array::from_fn(|i| f64::from(u8::from(i == 0)))),
            miss: case
                .rows()
                .greatest_miss(case.units, &case.units.to_units(&moments)),
            moments,
            cost: cost_mm3 / interior.volume().max(f64::MIN_POSITIVE),
            fitted: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::hollow::testing::leaning_block;
    use crate::mesh::primitives::cuboid;

    #[test]
    fn a_body_weighs_what_of_the_columns_lies_in_it_in_any_frame() {
        let columns = leaning_block(0.5);
        let all = columns.moments();
        let frame = Frame {
            origin: Point::new(3.0, -2.0, 5.0),
            ..Frame::identity()
        };
        let body = |low: f64, high: f64| {
            let cube = cuboid(
                &Point::new(-99.0, -99.0, low),
                &Point::new(99.0, 99.0, high),
            );
            DrawnBody::new(cube.map_vertices(|p| frame.to_model(p)), &frame).moments(&columns)
        };
        let center = all.centroid();
        let parts = body(-99.0, center.z) + body(center.z, 99.0);
        for (part, all) in parts.0.iter().zip(all.0) {
            assert!(
                (part - all).abs() < 1e-9 * all.abs().max(1.0),
                "{part} {all}"
            );
        }
        assert_eq!(body(200.0, 201.0).volume(), 0.0);
    }
}
