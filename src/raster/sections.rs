//! The sections of a mesh at heights that are asked for in any order.

use crate::geom::Point;
use crate::mesh::TriMesh;

/// Number of slabs for each thousand triangles. With more, tall triangles stand in many slabs.
const SLABS_PER_THOUSAND: usize = 40;
/// The fewest and the most slabs.
const SLABS: [usize; 2] = [16, 4096];

/// A piece of a section's outline, x and y in mm. The body lies to its left, seen from above.
pub(super) type Segment = [[f64; 2]; 2];

/// The triangles of a mesh, found by their height.
#[derive(Debug)]
pub(super) struct Sections {
    corners: Vec<[Point; 3]>,
    low_mm: f64,
    slab_mm: f64,
    /// For each slab, where its triangles begin in `members`; one more at the end.
    starts: Vec<u32>,
    members: Vec<u32>,
}

impl Sections {
    /// Sorts the triangles into slabs.
    pub(super) fn of(mesh: &TriMesh) -> Self {
        let corners: Vec<[Point; 3]> = mesh.iter_corners().collect();
        let aabb = mesh.aabb();
        let count = (corners.len() / 1000 * SLABS_PER_THOUSAND).clamp(SLABS[0], SLABS[1]);
        let slab_mm = (aabb.size().z / count as f64).max(f64::MIN_POSITIVE);
        let mut sections = Self {
            corners,
            low_mm: aabb.min.z,
            slab_mm,
            starts: vec![0; count + 1],
            members: Vec::new(),
        };
        let spans: Vec<[usize; 2]> = sections.corners.iter().map(|c| sections.span(c)).collect();
        for [first, last] in &spans {
            for slab in *first..=*last {
                sections.starts[slab + 1] += 1;
            }
        }
        for slab in 0..count {
            sections.starts[slab + 1] += sections.starts[slab];
        }
        let mut next = sections.starts.clone();
        sections.members = vec![0; sections.starts[count] as usize];
        for (triangle, [first, last]) in (0u32..).zip(&spans) {
            for at in &mut next[*first..=*last] {
                sections.members[*at as usize] = triangle;
                *at += 1;
            }
        }
        sections
    }

    /// Returns the first and the last slab that a triangle reaches.
    fn span(&self, corners: &[Point; 3]) -> [usize; 2] {
        let heights = || corners.iter().map(|corner| corner.z);
        let low_mm = heights().fold(f64::INFINITY, f64::min);
        let high_mm = heights().fold(f64::NEG_INFINITY, f64::max);
        [self.slab(low_mm), self.slab(high_mm)]
    }

    fn slab(&self, height_mm: f64) -> usize {
        let slab = ((height_mm - self.low_mm) / self.slab_mm).max(0.0) as usize;
        slab.min(self.starts.len() - 2)
    }

    /// Calls `take` with every piece of the outline at a height.
    ///
    /// A corner in the level counts as below it. So the outline is closed to the last bit, as both
    /// triangles at an edge work its crossing out alike.
    pub(super) fn outline(&self, height_mm: f64, mut take: impl FnMut(Segment)) {
        let slab = self.slab(height_mm);
        let members = self.starts[slab] as usize..self.starts[slab + 1] as usize;
        for &triangle in &self.members[members] {
            let corners = &self.corners[triangle as usize];
            let is_above = corners.map(|corner| corner.z > height_mm);
            let (mut from, mut to) = (None, None);
            for (index, next) in [(0, 1), (1, 2), (2, 0)] {
                match (is_above[index], is_above[next]) {
                    (true, false) => {
                        from = Some(crossing(&corners[next], &corners[index], height_mm));
                    }
                    (false, true) => {
                        to = Some(crossing(&corners[index], &corners[next], height_mm));
                    }
                    _ => {}
                }
            }
            if let (Some(from), Some(to)) = (from, to) {
                take([from, to]);
            }
        }
    }
}

/// Returns where an edge crosses a level, from its lower end.
fn crossing(below: &Point, above: &Point, height_mm: f64) -> [f64; 2] {
    let share = (height_mm - below.z) / (above.z - below.z);
    [
        below.x + (above.x - below.x) * share,
        below.y + (above.y - below.y) * share,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::primitives::{ball, cuboid};

    /// Returns the area that the outline at a height encloses.
    fn area_mm2(sections: &Sections, height_mm: f64) -> f64 {
        let mut area_mm2 = 0.0;
        sections.outline(height_mm, |[from, to]| {
            area_mm2 += 0.5 * (from[0] * to[1] - from[1] * to[0]);
        });
        area_mm2
    }

    #[test]
    fn a_box_has_the_same_section_at_every_height_inside_and_none_outside() {
        let sections = Sections::of(&cuboid(&Point::origin(), &Point::new(3.0, 2.0, 5.0)));
        for height_mm in [0.0, 0.001, 2.5, 4.999] {
            assert!((area_mm2(&sections, height_mm) - 6.0).abs() < 1e-12);
        }
        assert!(area_mm2(&sections, 5.0).abs() < 1e-12);
        assert!(area_mm2(&sections, -0.1).abs() < 1e-12);
    }

    #[test]
    fn an_outline_through_corners_is_closed_to_the_last_bit() {
        let sections = Sections::of(&ball(&Point::origin(), 10.0, 5));
        for height_mm in [0.0, 5.0, -7.25] {
            let mut ends: Vec<[u64; 2]> = Vec::new();
            let mut starts = ends.clone();
            sections.outline(height_mm, |[from, to]| {
                starts.push(from.map(f64::to_bits));
                ends.push(to.map(f64::to_bits));
            });
            starts.sort_unstable();
            ends.sort_unstable();
            assert!(starts.len() > 20 && starts == ends);
        }
    }
}
