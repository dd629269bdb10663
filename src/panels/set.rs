//! The panels of a polyhedron, with a joint along every edge.

use std::f64::consts::PI;

use super::Outline;
use super::beam::beam_path;
use super::edge::{EdgeJoint, JointStyle, PanelEdge, PanelError, PanelRequest};
use super::fingers::{FingerJoint, FingerSide};
use super::panel::{Hole, Panel, flat};
use super::rings::along;
use crate::geom::{Frame, Plane, Point, Vector};
use crate::polyhedra::{Edge, Polyhedron};

/// Length of a finger along the edge, in thicknesses of the sheet.
const FINGER_SHEETS: f64 = 8.0;
/// Length of the shortest edge that gets fingers, in thicknesses.
const EDGE_SHEETS: f64 = 12.0;
/// Length of the shortest stretch of an edge that holds as a single finger, in thicknesses.
const LEAST_SHEETS: f64 = 4.0;
/// The largest angle at which fingers hold, radians: 150°.
const FLATTEST_RAD: f64 = PI * 5.0 / 6.0;
/// Rounding of that angle, radians.
const ROUNDING_RAD: f64 = 1e-9;
/// Least distance of a flange from the bisector of a panel's corner along the edge, mm.
const FREE_MM: f64 = 0.5;

/// The panels of a polyhedron.
#[derive(Debug, Clone, PartialEq)]
pub struct PanelSet {
    /// The panels, in the order of their faces.
    pub panels: Vec<Panel>,
    /// The edges.
    pub edges: Vec<PanelEdge>,
}

impl PanelSet {
    /// Makes the panels of a polyhedron.
    ///
    /// Each panel is its face, moved inward on all sides by the thickness and laid back on the
    /// face's plane. Panels are then disjoint, and neighbours meet in one line, so that all cuts
    /// are at right angles to the sheet. Where fingers of two edges would meet, or leave a gap that
    /// is narrower than the cut, the shorter edge gets brackets.
    ///
    /// # Errors
    /// The sheet is too thick for a face, or an edge has no room for the fingers that were ordered.
    pub fn of(body: &Polyhedron, request: &PanelRequest) -> Result<Self, PanelError> {
        let inner = body.edges_inside(request.sheet_mm);
        let faces: Vec<usize> = (0..body.faces().len())
            .filter(|&face| body.faces()[face].area_mm2 > 0.0)
            .collect();
        let rings = faces.iter().map(|&face| {
            let ring = ring_of(face, &inner);
            ring.ok_or(PanelError::TooThick {
                sheet_mm: request.sheet_mm,
                face,
            })
        });
        let rings = rings.collect::<Result<Vec<Vec<usize>>, PanelError>>()?;
        let layout = Layout {
            body,
            request,
            inner,
            faces,
            rings,
        };
        layout.panels()
    }
}

impl PanelSet {
    /// Joins the panels of several polyhedra to one set, in their order. Each comes with the number
    /// by which the indices of its faces rise.
    pub fn joined(sets: impl IntoIterator<Item = (Self, usize)>) -> Self {
        let mut all = Self {
            panels: Vec::new(),
            edges: Vec::new(),
        };
        for (set, first_face) in sets {
            let first = all.panels.len();
            let panels = set.panels.into_iter();
            all.panels.extend(panels.map(|panel| Panel {
                face: panel.face + first_face,
                ..panel
            }));
            let edges = set.edges.into_iter();
            all.edges.extend(edges.map(|edge| PanelEdge {
                panels: edge.panels.map(|panel| panel + first),
                ..edge
            }));
        }
        all
    }
}

/// Returns the indices of a face's edges in their order, counterclockwise; `None` if they do not
/// close.
fn ring_of(face: usize, edges: &[Edge]) -> Option<Vec<usize>> {
    let own: Vec<usize> = (0..edges.len())
        .filter(|&edge| edges[edge].planes.contains(&face))
        .collect();
    let mut ring = vec![*own.first()?];
    while ring.len() < own.len() {
        let [_, end] = about(face, &edges[*ring.last()?]);
        let starts_here = |edge: &&usize| {
            let [start, _] = about(face, &edges[**edge]);
            !ring.contains(edge) && start == end
        };
        ring.push(*own.iter().find(starts_here)?);
    }
    (ring.len() > 2).then_some(ring)
}

/// Returns the ends of an edge, counterclockwise about a face.
pub(super) fn about(face: usize, edge: &Edge) -> [Point; 2] {
    let [from, to] = edge.ends;
    if edge.planes[0] == face {
        [from, to]
    } else {
        [to, from]
    }
}

/// The faces and edges from which panels are made.
pub(super) struct Layout<'a> {
    pub(super) body: &'a Polyhedron,
    pub(super) request: &'a PanelRequest,
    /// The edges of the body moved inward by the thickness.
    pub(super) inner: Vec<Edge>,
    /// The faces that get panels.
    pub(super) faces: Vec<usize>,
    /// The edges about each of them.
    pub(super) rings: Vec<Vec<usize>>,
}

impl Layout<'_> {
    pub(super) fn plane(&self, face: usize) -> &Plane {
        &self.body.faces()[face].plane
    }

    /// Makes the panels, with brackets in place of fingers that would meet.
    fn panels(&self) -> Result<PanelSet, PanelError> {
        let mut fingers: Vec<Option<FingerJoint>> = (0..self.inner.len())
            .map(|edge| self.fingers(edge))
            .collect();
        loop {
            let panels: Vec<Panel> = (0..self.faces.len())
                .map(|panel| self.panel(panel, &fingers))
                .collect();
            let crossed = panels
                .iter()
                .enumerate()
                .find(|(_, panel)| !is_sound(panel, self.request.cut_mm));
            let Some((panel, _)) = crossed else {
                return self.set(panels, &fingers);
            };
            let has_fingers = |edge: &&usize| fingers[**edge].is_some();
            let length_mm =
                |edge: usize| (self.inner[edge].ends[1] - self.inner[edge].ends[0]).norm();
            let shortest = self.rings[panel]
                .iter()
                .filter(has_fingers)
                .min_by(|&&a, &&b| length_mm(a).total_cmp(&length_mm(b)));
            match shortest {
                Some(&edge) => fingers[edge] = None,
                None => {
                    return Err(PanelError::TooThick {
                        sheet_mm: self.request.sheet_mm,
                        face: self.faces[panel],
                    });
                }
            }
        }
    }

    /// Returns the inner angle at an edge, radians.
    fn angle_rad(&self, edge: usize) -> f64 {
        let [a, b] = self.inner[edge].planes.map(|face| self.plane(face).normal);
        PI - a.dot(&b).clamp(-1.0, 1.0).acos()
    }

    /// Returns the fingers of an edge; `None` if they do not fit, or if brackets were ordered.
    fn fingers(&self, edge: usize) -> Option<FingerJoint> {
        let sheet_mm = self.request.sheet_mm;
        let edge_mm = (self.inner[edge].ends[1] - self.inner[edge].ends[0]).norm();
        let angle_rad = self.angle_rad(edge);
        let fits = edge_mm >= EDGE_SHEETS * sheet_mm && angle_rad <= FLATTEST_RAD + ROUNDING_RAD;
        if !fits || self.request.joints == JointStyle::Brackets {
            return None;
        }
        let joint = FingerJoint {
            sheet_mm,
            angle_rad: angle_rad.min(FLATTEST_RAD),
            edge_mm,
            end_mm: 0.0,
            stretches: 1,
            press_mm: self.request.press_mm,
        };
        let end_mm = self.plain_end_mm(edge, &joint);
        let room_mm = edge_mm - 2.0 * end_mm;
        let pairs = (room_mm / (FINGER_SHEETS * sheet_mm) - 1.0) / 2.0;
        let joint = FingerJoint {
            end_mm,
            stretches: 2 * pairs.round().max(0.0) as usize + 1,
            ..joint
        };
        (room_mm >= LEAST_SHEETS * sheet_mm && joint.holds()).then_some(joint)
    }

    /// Returns a panel with the fingers of its edges.
    fn panel(&self, panel: usize, fingers: &[Option<FingerJoint>]) -> Panel {
        let face = self.faces[panel];
        let frame = self.frame(face);
        let mut corners = Vec::new();
        for &edge in &self.rings[panel] {
            let [from, to] = about(face, &self.inner[edge]).map(|end| flat(&frame, &end));
            match &fingers[edge] {
                Some(joint) => {
                    let is_first = self.inner[edge].planes.iter().all(|&other| face <= other);
                    let side = if is_first {
                        FingerSide::First
                    } else {
                        FingerSide::Second
                    };
                    let line = joint.edge(side).into_iter();
                    corners
                        .extend(line.map(|[x, y]| along([from, to], [x, y - joint.setback_mm()])));
                }
                None => corners.push(from),
            }
        }
        Panel {
            face,
            frame,
            sheet_mm: self.request.sheet_mm,
            outline: Outline::new(corners).unwrap_or(Outline::rectangle([0.0; 2], [0.0; 2])),
            holes: Vec::new(),
        }
    }

    /// Returns the frame of a face, with its origin at the centroid.
    fn frame(&self, face: usize) -> Frame {
        Frame::with_axis(self.body.faces()[face].centroid, &self.plane(face).normal)
    }

    /// Adds the edges and the holes of their brackets.
    fn set(
        &self,
        mut panels: Vec<Panel>,
        fingers: &[Option<FingerJoint>],
    ) -> Result<PanelSet, PanelError> {
        let mut edges = Vec::new();
        for (index, inner) in self.inner.iter().enumerate() {
            let mut sides = inner.planes;
            sides.sort_unstable();
            let ends = about(sides[0], inner);
            let length_mm = (ends[1] - ends[0]).norm();
            let angle_rad = self.angle_rad(index);
            if fingers[index].is_none() && self.request.joints == JointStyle::Fingers {
                return Err(PanelError::NoFingers {
                    faces: sides,
                    length_mm,
                    angle_deg: angle_rad.to_degrees(),
                });
            }
            let joint = match fingers[index] {
                Some(joint) => EdgeJoint::Fingers(joint),
                None => EdgeJoint::Brackets(self.brackets(index, sides)),
            };
            let panel_of = |face: usize| self.faces.iter().position(|&known| known == face);
            let [Some(a), Some(b)] = sides.map(panel_of) else {
                continue;
            };
            if let EdgeJoint::Brackets(places) = &joint {
                for (panel, face) in [(a, sides[0]), (b, sides[1])] {
                    let ends = about(face, inner).map(|end| flat(&panels[panel].frame, &end));
                    let holes = self.screws(places, length_mm, face == sides[0]);
                    let holes = holes.map(|at| along(ends, at));
                    panels[panel].holes.extend(holes.map(|at_mm| Hole {
                        at_mm,
                        diameter_mm: self.request.brackets.hole_mm,
                    }));
                }
            }
            edges.push(PanelEdge {
                panels: [a, b],
                ends: ends.map(|end| self.to_outer_line(sides, &end)),
                angle_rad,
                depth_mm: self.depth_mm(&joint, angle_rad),
                joint,
            });
        }
        Ok(PanelSet { panels, edges })
    }

    /// Returns the middles of the brackets of an edge, from its start about the first face: two, or
    /// one where there is room for one. They keep clear of those of neighbouring edges.
    fn brackets(&self, edge: usize, faces: [usize; 2]) -> Vec<f64> {
        let [start, end] = about(faces[0], &self.inner[edge]);
        let length_mm = (end - start).norm();
        let [first, second] = faces.map(|face| self.corners_mm(edge, face));
        let width_mm = self.request.brackets.width_mm();
        let least_mm = first[0].max(second[1]) + 0.5 * width_mm;
        let most_mm = length_mm - first[1].max(second[0]) - 0.5 * width_mm;
        let [low, high] = [
            least_mm.max(0.25 * length_mm),
            most_mm.min(0.75 * length_mm),
        ];
        if high - low >= width_mm {
            vec![low, high]
        } else if least_mm <= most_mm {
            vec![f64::midpoint(least_mm, most_mm)]
        } else {
            Vec::new()
        }
    }

    /// Returns the lengths at both ends of an edge, counterclockwise about a face, that its
    /// brackets leave free, mm. The flanges of the next edge's brackets are beyond the corner's
    /// bisector.
    fn corners_mm(&self, edge: usize, face: usize) -> [f64; 2] {
        let panel = self.faces.iter().position(|&known| known == face);
        let ring = panel.map_or(&[][..], |panel| &self.rings[panel]);
        let Some(at) = ring.iter().position(|&known| known == edge) else {
            return [0.0; 2];
        };
        let ends = |edge: usize| about(face, &self.inner[edge]);
        let [from, to] = ends(edge);
        let [before, _] = ends(ring[(at + ring.len() - 1) % ring.len()]);
        let [_, after] = ends(ring[(at + 1) % ring.len()]);
        let free_mm = |corner: Point, a: Point, b: Point| {
            let half_rad = 0.5 * (a - corner).angle(&(b - corner));
            self.request.flange_mm() / half_rad.tan() + FREE_MM
        };
        [free_mm(from, to, before), free_mm(to, from, after)]
    }

    /// Returns how far a joint reaches into either panel from the line in which the outer sides
    /// meet, mm.
    fn depth_mm(&self, joint: &EdgeJoint, angle_rad: f64) -> f64 {
        let setback_mm = self.request.sheet_mm / (0.5 * angle_rad).tan();
        match joint {
            EdgeJoint::Fingers(joint) => joint.gap_mm().max(setback_mm),
            EdgeJoint::Brackets(places) if places.is_empty() => setback_mm,
            EdgeJoint::Brackets(_) => {
                setback_mm + self.request.away_mm() + 0.5 * self.request.brackets.head_mm
            }
        }
    }

    /// Returns the screws of some brackets: along the edge and away from it, mm. `is_first` tells
    /// whether the panel goes the same way along the edge as the brackets are counted.
    fn screws<'b>(
        &self,
        places: &'b [f64],
        length_mm: f64,
        is_first: bool,
    ) -> impl Iterator<Item = [f64; 2]> + 'b {
        let apart_mm = self.request.brackets.aside_mm();
        let away_mm = self.request.away_mm();
        places.iter().flat_map(move |&place| {
            [-apart_mm, apart_mm].map(|by| {
                let x = place + by;
                [if is_first { x } else { length_mm - x }, away_mm]
            })
        })
    }

    /// Returns the point of the line in which the outer sides meet beside a point of the inner
    /// edge.
    fn to_outer_line(&self, faces: [usize; 2], inner: &Point) -> Point {
        let [a, b] = faces.map(|face| self.plane(face).normal);
        let out: Vector = (a + b) / (1.0 + a.dot(&b));
        inner + out * self.request.sheet_mm
    }
}

/// Returns whether an outline goes counterclockwise, does not cross itself, and has no gap narrower
/// than the cut, mm.
fn is_sound(panel: &Panel, cut_mm: f64) -> bool {
    let outline = &panel.outline;
    let is_simple = outline.area_mm2() > 0.0 && outline.crossing().is_none();
    is_simple && beam_path(outline, cut_mm).is_ok()
}
