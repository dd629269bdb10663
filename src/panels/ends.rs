//! Ends of edges that stay plain: fingers and gaps keep clear of the neighbours at the corners.

use super::fingers::FingerJoint;
use super::set::{Layout, about};
use crate::geom::{Point, Vector};

/// Length without fingers at both ends of every edge, in thicknesses of the sheet.
const END_SHEETS: f64 = 2.0;
/// Width of the strip of material between the gaps of two edges, in thicknesses.
const STRIP_SHEETS: f64 = 1.0;

impl Layout<'_> {
    /// Returns the length that stays plain at both ends of an edge with fingers, mm.
    ///
    /// A finger that began nearer to a corner could reach through the plane of the next face. Two
    /// gaps nearer to it could leave no material between them. `joint` tells how far fingers reach
    /// and how deep gaps are.
    pub(super) fn plain_end_mm(&self, edge: usize, joint: &FingerJoint) -> f64 {
        let least_mm = END_SHEETS * joint.sheet_mm;
        let planes = self.inner[edge].planes;
        let ends = planes.map(|face| {
            let inside_mm = self.inside_from_mm(edge, face, joint.reach_mm());
            inside_mm.max(self.apart_from_mm(edge, face, joint.depth_mm()))
        });
        ends.into_iter().fold(least_mm, f64::max) + 0.25 * joint.press_mm.abs()
    }

    /// Returns the distance from both ends of an edge from which a finger of one of its panels is
    /// inside of all other planes, mm. Along them its inner side is as deep as a plain edge.
    fn inside_from_mm(&self, edge: usize, face: usize, reach_mm: f64) -> f64 {
        let [from, to] = about(face, &self.inner[edge]);
        let length_mm = (to - from).norm();
        let along = (to - from) / length_mm;
        let out = along.cross(&self.plane(face).normal) * reach_mm;
        let others = (0..self.body.faces().len()).filter(|other| {
            !self.inner[edge].planes.contains(other) && self.body.faces()[*other].area_mm2 > 0.0
        });
        let from_mm = others.map(|other| {
            let plane = self.plane(other);
            let over_mm = |end: &Point| plane.distance(&(end + out)) + self.request.sheet_mm;
            let [start, end] = [over_mm(&from), over_mm(&to)];
            let slope = ((end - start) / length_mm).abs();
            let most = start.max(end);
            if most > 0.0 { most / slope } else { 0.0 }
        });
        from_mm.fold(0.0, f64::max).min(length_mm)
    }

    /// Returns the distance from both ends of an edge at which gaps of a panel may begin, mm. Half
    /// a strip is left up to the bisector of the panel's corner.
    fn apart_from_mm(&self, edge: usize, face: usize, depth_mm: f64) -> f64 {
        let panel = self.faces.iter().position(|&known| known == face);
        let ring = panel.map_or(&[][..], |panel| &self.rings[panel]);
        let Some(at) = ring.iter().position(|&known| known == edge) else {
            return 0.0;
        };
        if depth_mm <= 0.0 {
            return 0.0;
        }
        let ends = |edge: usize| about(face, &self.inner[edge]);
        let [from, to] = ends(edge);
        let [before, _] = ends(ring[(at + ring.len() - 1) % ring.len()]);
        let [_, after] = ends(ring[(at + 1) % ring.len()]);
        let strip_mm = STRIP_SHEETS * self.request.sheet_mm;
        let free_mm = |corner: Point, a: Point, b: Point| {
            let ways: [Vector; 2] = [a - corner, b - corner];
            let half_rad = 0.5 * ways[0].angle(&ways[1]);
            (0.5 * strip_mm + depth_mm * half_rad.cos()) / half_rad.sin()
        };
        free_mm(from, to, before).max(free_mm(to, from, after))
    }
}

#[cfg(test)]
mod tests {
    use crate::geom::{Plane, Point, Vector};
    use crate::mesh::{Solid, primitives};
    use crate::panels::{BracketKind, EdgeJoint, JointStyle, PanelRequest, PanelSet};
    use crate::polyhedra::{Ground, Limits, Polyhedron, Side};

    /// Returns the panels of a tall box of 200 mm, on which a side is bent outward at mid height.
    fn bent(deg: f64) -> PanelSet {
        let ball = primitives::ball(&Point::origin(), 1000.0, 3);
        let ground = Ground::new(&Solid::new(ball).unwrap()).unwrap();
        let (sine, cosine) = deg.to_radians().sin_cos();
        let normals = [
            Vector::new(0.0, 0.0, 1.0),
            Vector::new(0.0, 0.0, -1.0),
            Vector::new(-1.0, 0.0, 0.0),
            Vector::new(0.0, 1.0, 0.0),
            Vector::new(0.0, -1.0, 0.0),
            Vector::new(cosine, sine, 0.0),
            Vector::new(cosine, -sine, 0.0),
        ];
        let sides: Vec<Side> = normals
            .iter()
            .map(|&normal| Side {
                plane: Plane {
                    normal,
                    offset_mm: 100.0,
                },
                is_locked: false,
            })
            .collect();
        let body = Polyhedron::new(&ground, 5.0, &sides, &Limits::NONE).unwrap();
        let request = PanelRequest {
            sheet_mm: 5.0,
            joints: JointStyle::Auto,
            press_mm: 0.0,
            cut_mm: 0.2,
            brackets: BracketKind {
                hole_mm: 3.4,
                head_mm: 5.7,
                thread_mm: 2.5,
                flange_mm: 4.0,
            },
        };
        PanelSet::of(&body, &request).unwrap()
    }

    #[test]
    fn fingers_beside_a_flat_corner_do_not_reach_through_the_next_plane() {
        // At 10° the top has a corner of 160° between the two bent sides. Fingers near it would
        // reach through the plane of the next side.
        for deg in [10.0, 20.0, 30.0] {
            let set = bent(deg);
            let planes: Vec<Plane> = set
                .panels
                .iter()
                .map(|panel| Plane {
                    normal: panel.frame.axis(),
                    offset_mm: 100.0,
                })
                .collect();
            for panel in &set.panels {
                let body = panel.body();
                let corners = body.vertices().iter();
                let out = corners.flat_map(|p| planes.iter().map(|plane| plane.distance(p)));
                let out_mm = out.fold(f64::NEG_INFINITY, f64::max);
                assert!(out_mm < 1e-9, "{deg}: {out_mm}");
            }
            let fingered = set.edges.iter();
            let fingered = fingered.filter(|edge| matches!(edge.joint, EdgeJoint::Fingers(_)));
            assert!(fingered.count() >= 13, "{deg}");
        }
    }
}
