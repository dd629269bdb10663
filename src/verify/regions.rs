//! The regions of infill inside of other regions, as found in their files.

use rayon::prelude::*;

use super::{Evidence, PartEvidence, Shells};
use crate::geom::{Bvh, Point};
use crate::mesh::{MeshDistance, TriMesh};
use crate::repair::weld;

/// Distance outside, mm, above which it is asked whether a point is.
const DOUBTFUL_MM: f64 = 1e-3;

/// Facts about the regions of one density inside of regions of another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RegionFacts {
    /// Their number.
    pub count: usize,
    /// The farthest that one of their corners or triangles is outside of the regions around, mm; 0
    /// if none is.
    pub outside_mm: f64,
}

/// Measures the regions inside of the outermost ones, in the order of the promise.
pub(super) fn measure_inner_regions(evidence: &Evidence) -> Vec<RegionFacts> {
    evidence.parts.iter().flat_map(of_part).collect()
}

fn of_part(part: &PartEvidence) -> Vec<RegionFacts> {
    if part.inner.is_empty() {
        return Vec::new();
    }
    let outermost = Shells::of_mesh(&weld(&part.mesh)).inner_mesh().reversed();
    let around = std::iter::once(&outermost).chain(&part.inner);
    let pairs: Vec<(&TriMesh, &TriMesh)> = around.zip(&part.inner).collect();
    let facts = pairs.into_par_iter().map(|(around, region)| RegionFacts {
        count: Shells::of_mesh(&weld(region)).outward.len(),
        outside_mm: outside_mm(around, region),
    });
    facts.collect()
}

/// Returns how far the corners and the middles of a region's triangles are outside of another, mm.
fn outside_mm(around: &TriMesh, region: &TriMesh) -> f64 {
    let distance = MeshDistance::new(around);
    let tree = Bvh::new(around.iter_corners());
    // Beside a sliver the sign of a distance is rounding, and the winding number is not.
    let is_inside = |p: &Point| tree.winding(p) > 0;
    let outside = |p: &Point| match -distance.signed(p) {
        outside_mm if outside_mm > DOUBTFUL_MM && is_inside(p) => 0.0,
        outside_mm => outside_mm,
    };
    let corners = region.vertices().par_iter().map(outside);
    let middles: Vec<Point> = region
        .iter_corners()
        .map(|[a, b, c]| ((a.coords + b.coords + c.coords) / 3.0).into())
        .collect();
    let middles = middles.par_iter().map(outside);
    corners.chain(middles).reduce(|| 0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::primitives::cuboid;
    use crate::verify::Pose;

    fn part(inner: TriMesh) -> PartEvidence {
        let outside = cuboid(&Point::new(0.0, 0.0, 0.0), &Point::new(30.0, 30.0, 30.0));
        let region = cuboid(&Point::new(5.0, 5.0, 5.0), &Point::new(25.0, 25.0, 25.0));
        PartEvidence {
            id: "P01".into(),
            mesh: outside.joined(&region.reversed()),
            inner: vec![inner],
            pose: Pose::identity(),
        }
    }

    #[test]
    fn a_region_may_touch_the_one_around_it_but_not_stick_out() {
        let inner = |low_mm: f64| {
            let low = Point::new(low_mm, 5.0, 5.0);
            part(cuboid(&low, &Point::new(15.0, 25.0, 25.0)))
        };
        let [touching, outside] = [5.0, 4.5].map(|low_mm| of_part(&inner(low_mm))[0]);
        assert!(touching.outside_mm <= 1e-9 && touching.count == 1);
        assert!((outside.outside_mm - 0.5).abs() < 1e-9);
    }

    #[test]
    fn regions_are_counted() {
        let low = |x_mm: f64| {
            cuboid(
                &Point::new(x_mm, 6.0, 6.0),
                &Point::new(x_mm + 2.0, 9.0, 9.0),
            )
        };
        let facts = of_part(&part(low(6.0).joined(&low(10.0))));
        assert_eq!(
            facts,
            [RegionFacts {
                count: 2,
                outside_mm: 0.0
            }]
        );
    }
}
