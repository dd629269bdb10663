//! Printed brackets: angles inside a base that hold two panels along an edge.

use super::edge::{EdgeJoint, PanelEdge, PanelRequest};
use super::panel::prism;
use super::set::PanelSet;
use crate::geom::{Frame, Matrix, Point, Vector};
use crate::mesh::{ClipError, Csg, TriMesh, primitives};

/// Distance by which the outer corner of a bracket is cut off, mm. Glue and burrs on the panels'
/// edges do not lift it then.
const RELIEF_MM: f64 = 0.5;
/// Number of sides of a hole.
const HOLE_SIDES: u32 = 32;

/// A bracket in its place in the model.
#[derive(Debug, Clone, PartialEq)]
pub struct Bracket {
    /// The index of its edge.
    pub edge: usize,
    /// The middles of the holes in its flanges, on the side of the panel. The flange on the edge's
    /// first panel comes first.
    pub screws: [[Point; 2]; 2],
    /// The body.
    pub body: TriMesh,
}

impl PanelSet {
    /// Returns the brackets of all edges that have some, in the order of the edges. `request` is
    /// that of the panels.
    ///
    /// # Errors
    /// A body cannot be made.
    pub fn brackets(&self, request: &PanelRequest) -> Result<Vec<Bracket>, ClipError> {
        let mut all = Vec::new();
        for (index, edge) in self.edges.iter().enumerate() {
            let EdgeJoint::Brackets(places) = &edge.joint else {
                continue;
            };
            let normals = edge.panels.map(|panel| self.panels[panel].frame.axis());
            for &place in places {
                let angle = Angle::new(edge, normals, place, request);
                all.push(Bracket {
                    edge: index,
                    screws: [0, 1].map(|flange| angle.screws(flange)),
                    body: angle.body()?,
                });
            }
        }
        Ok(all)
    }
}

/// A bracket in the frame of its place. x runs in the first panel away from the edge, y points out
/// of that panel, and z runs along the edge.
struct Angle<'a> {
    request: &'a PanelRequest,
    frame: Frame,
    /// The inner angle, radians.
    angle_rad: f64,
}

impl<'a> Angle<'a> {
    fn new(
        edge: &PanelEdge,
        [first, second]: [Vector; 2],
        place_mm: f64,
        request: &'a PanelRequest,
    ) -> Self {
        let along = (edge.ends[1] - edge.ends[0]).normalize();
        let out = (first + second) / (1.0 + first.dot(&second));
        Self {
            request,
            frame: Frame {
                origin: edge.ends[0] + along * place_mm - out * request.sheet_mm,
                axes: Matrix::from_columns(&[first.cross(&along), first, along]),
            },
            angle_rad: edge.angle_rad,
        }
    }

    /// Returns the direction along a flange, and the one into the base across it.
    fn flange(&self, flange: usize) -> [[f64; 2]; 2] {
        let (sine, cosine) = self.angle_rad.sin_cos();
        if flange == 0 {
            [[1.0, 0.0], [0.0, -1.0]]
        } else {
            [[cosine, -sine], [sine, cosine]]
        }
    }

    /// Returns the middles of a flange's holes, on the side of the panel.
    fn screws(&self, flange: usize) -> [Point; 2] {
        let [[x, y], _] = self.flange(flange);
        let away_mm = self.request.away_mm();
        let aside_mm = self.request.brackets.aside_mm();
        [-aside_mm, aside_mm].map(|z| {
            self.frame
                .to_model(&Point::new(away_mm * x, away_mm * y, z))
        })
    }

    /// Returns the section across the edge: two flanges with their outer corner cut off.
    fn section(&self) -> Vec<[f64; 2]> {
        let kind = &self.request.brackets;
        let length_mm = self.request.flange_mm();
        let half_rad = 0.5 * self.angle_rad;
        let corner_mm = kind.flange_mm / half_rad.sin();
        let at = |flange: usize, along_mm: f64, in_mm: f64| {
            let [along, inward] = self.flange(flange);
            [0, 1].map(|i| along_mm * along[i] + in_mm * inward[i])
        };
        vec![
            at(0, RELIEF_MM, 0.0),
            at(1, RELIEF_MM, 0.0),
            at(1, length_mm, 0.0),
            at(1, length_mm, kind.flange_mm),
            [corner_mm * half_rad.cos(), -corner_mm * half_rad.sin()],
            at(0, length_mm, kind.flange_mm),
            at(0, length_mm, 0.0),
        ]
    }

    fn body(&self) -> Result<TriMesh, ClipError> {
        let kind = &self.request.brackets;
        let width_mm = kind.width_mm();
        let place = |[x, y]: [f64; 2], depth: f64| {
            let z = width_mm * (0.5 - depth);
            self.frame.to_model(&Point::new(x, y, z))
        };
        let mut body = Csg::of_mesh(&prism(&self.section(), place))?;
        for flange in [0, 1] {
            let [_, [x, y]] = self.flange(flange);
            let inward = self.frame.direction_to_model(&Vector::new(x, y, 0.0));
            for at in self.screws(flange) {
                let drill = Frame::with_axis(at - inward * kind.flange_mm, &inward);
                let hole =
                    primitives::cylinder(0.5 * kind.thread_mm, 3.0 * kind.flange_mm, HOLE_SIDES);
                let hole = hole.map_vertices(|p| drill.to_model(p));
                body = body.subtract(&Csg::of_mesh(&hole)?)?;
            }
        }
        body.to_mesh()
    }
}
