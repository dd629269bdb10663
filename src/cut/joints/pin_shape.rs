//! Bodies of pins and sockets.

use crate::{
    cut::{
        ids::{CutId, PinId},
        joints::rod::Dowel,
    },
    geom::{Point, Vector, orthonormal_basis},
    mass::RoundBar,
    mesh::TriMesh,
};
use serde::{Deserialize, Serialize};

/// Sides of the polygon that approximates a circle. At a diameter of 3 mm its flats lie 3 µm inside
/// the circle, below any printer's pixel; more sides only add triangles.
pub(crate) const SIDES: usize = 48;

/// Depth of a pin's root inside its part, and height of a socket's stub above its mouth, as a share
/// of the pin's diameter. It spares booleans coinciding faces. The material check keeps more than
/// that free of surfaces.
const OVERLAP_RATIO: f64 = 0.2;

/// A pin and its socket: plain data, written into the plan and editable there.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PinSite {
    /// The pin's name, the same on both parts.
    pub id: PinId,
    /// The id of the cut it bridges.
    pub cut: CutId,
    /// Point where its axis passes through the cut, mm.
    pub center_mm: [f64; 3],
    /// Unit direction in which it protrudes: from the part that carries it into the part with the
    /// socket.
    pub direction: [f64; 3],
    /// Diameter of the pin, mm.
    pub diameter_mm: f64,
    /// Length by which the pin protrudes, mm.
    pub length_mm: f64,
    /// Height and width of the chamfer at its tip, mm.
    pub chamfer_mm: f64,
    /// Diameter of the socket, mm.
    pub socket_diameter_mm: f64,
    /// Depth of the socket, mm.
    pub socket_depth_mm: f64,
    /// Height and width of the chamfer at the socket's mouth, mm.
    pub socket_chamfer_mm: f64,
    /// The loose dowel that replaces a printed pin, with a socket on either side. `length_mm` is
    /// then half the dowel's length.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dowel: Option<Dowel>,
}

impl PinSite {
    /// Returns the pin to unite with its part: the protruding body, and a root inside the part.
    pub(crate) fn pin_body(&self) -> TriMesh {
        let radius = self.diameter_mm / 2.0;
        self.revolve(
            &[
                vec![(radius, -self.overlap_mm())],
                self.pin_profile()[1..].to_vec(),
            ]
            .concat(),
        )
    }

    /// Returns the body to subtract for the socket: the material removed, and a stub outside the
    /// mouth.
    pub(crate) fn socket_body(&self) -> TriMesh {
        let profile = self.socket_profile();
        let slope = if self.socket_chamfer_mm > 0.0 {
            1.0
        } else {
            0.0
        };
        let mouth = (profile[0].0 + slope * self.overlap_mm(), -self.overlap_mm());
        self.revolve(&[vec![mouth], profile[1..].to_vec()].concat())
    }

    /// Returns the printed body that protrudes from the cut face, as a closed mesh; empty for a
    /// dowel.
    pub fn protruding_body(&self) -> TriMesh {
        if self.dowel.is_some() {
            TriMesh::default()
        } else {
            self.revolve(&self.pin_profile())
        }
    }

    /// Returns the material that the socket removes, as a closed mesh.
    pub fn removed_body(&self) -> TriMesh {
        self.revolve(&self.socket_profile())
    }

    /// Returns the volume that protrudes from the cut face, mm³; 0 for a dowel.
    pub fn pin_volume_mm3(&self) -> f64 {
        self.protruding_body().signed_volume_mm3()
    }

    /// Returns the volume that the socket removes, mm³.
    pub fn socket_volume_mm3(&self) -> f64 {
        self.removed_body().signed_volume_mm3()
    }

    /// Returns the triangles of the socket's mouth in the cut.
    pub(crate) fn mouth(&self) -> Vec<[Point; 3]> {
        let (axis, center) = (Vector::from(self.direction), Point::from(self.center_mm));
        let (u, v) = orthonormal_basis(&axis);
        let radius = self.socket_profile()[0].0;
        let corner = |side: usize| {
            let (sin, cos) = (2.0 * std::f64::consts::PI * side as f64 / SIDES as f64).sin_cos();
            center + (u * cos + v * sin) * radius
        };
        (0..SIDES)
            .map(|side| [center, corner(side), corner(side + 1)])
            .collect()
    }

    /// Returns the radius of the socket polygon's corners, mm. Its sides touch the circle of the
    /// socket's diameter, so the gap to the pin is nowhere less than the clearance.
    pub(crate) fn socket_corner_mm(socket_diameter_mm: f64) -> f64 {
        socket_diameter_mm / 2.0 / (std::f64::consts::PI / SIDES as f64).cos()
    }

    /// Returns the distance by which the parts move against each other to each side of the pin, mm.
    pub fn room_to_move_mm(&self) -> f64 {
        Self::gap_mm(
            self.diameter_mm,
            self.socket_diameter_mm,
            self.dowel.is_some(),
        )
    }

    /// Returns the gap around a pin in its socket, mm; of a dowel, the gaps in both.
    pub(crate) fn gap_mm(diameter_mm: f64, socket_diameter_mm: f64, is_dowel: bool) -> f64 {
        let sockets = if is_dowel { 2.0 } else { 1.0 };
        sockets * (socket_diameter_mm - diameter_mm) / 2.0
    }

    /// Returns the depth of a pin's root inside its own part, mm.
    pub(crate) fn root_mm(diameter_mm: f64) -> f64 {
        OVERLAP_RATIO * diameter_mm
    }

    fn overlap_mm(&self) -> f64 {
        Self::root_mm(self.diameter_mm)
    }

    /// Returns (radius, height) of the pin's outline from the cut face to the tip, mm.
    fn pin_profile(&self) -> Vec<(f64, f64)> {
        let (radius, chamfer) = (self.diameter_mm / 2.0, self.chamfer_mm);
        let tip = (radius - chamfer, self.length_mm);
        if chamfer > 0.0 {
            vec![(radius, 0.0), (radius, self.length_mm - chamfer), tip]
        } else {
            vec![(radius, 0.0), tip]
        }
    }

    /// Returns (radius, height) of the socket's outline from its mouth to its bottom, mm.
    fn socket_profile(&self) -> Vec<(f64, f64)> {
        let radius = Self::socket_corner_mm(self.socket_diameter_mm);
        let (chamfer, bottom) = (self.socket_chamfer_mm, (radius, self.socket_depth_mm));
        if chamfer > 0.0 {
            vec![(radius + chamfer, 0.0), (radius, chamfer), bottom]
        } else {
            vec![(radius, 0.0), bottom]
        }
    }

    /// Revolves a profile of rising (radius, height) about the pin's axis, with [`SIDES`] sides.
    fn revolve(&self, profile: &[(f64, f64)]) -> TriMesh {
        let axis = Vector::from(self.direction);
        let (u, v) = orthonormal_basis(&axis);
        let center = Point::from(self.center_mm);
        let corner = |radius: f64, height: f64, side: usize| {
            let (sin, cos) = (2.0 * std::f64::consts::PI * side as f64 / SIDES as f64).sin_cos();
            center + (u * cos + v * sin) * radius + axis * height
        };
        let rings = profile
            .iter()
            .flat_map(|&(r, h)| (0..SIDES).map(move |side| corner(r, h, side)));
        let mut vertices: Vec<Point> = rings.collect();
        let ends = [profile.first(), profile.last()].map(|end| end.map_or(0.0, |end| end.1));
        vertices.extend(ends.map(|height| center + axis * height));
        TriMesh::new(vertices, lathe_triangles(profile.len())).unwrap_or_default()
    }
}

impl PinSite {
    /// Returns the dowel as a round bar in its place; `None` for a printed pin.
    pub fn dowel_bar(&self) -> Option<RoundBar> {
        let half = self.dowel.as_ref()?.length_mm / 2.0;
        let (middle, along) = (
            Point::from(self.center_mm),
            Vector::from(self.direction).normalize(),
        );
        Some(RoundBar::plain(
            middle - along * half,
            middle + along * half,
            self.diameter_mm / 2.0,
        ))
    }

    /// Returns the pin as seen from the other side of the cut: the place of a dowel's second
    /// socket.
    pub(crate) fn mirrored(&self) -> Self {
        Self {
            direction: self.direction.map(|x| -x),
            ..self.clone()
        }
    }

    /// Returns the depth inside the part that carries it, mm: of a printed pin's root, or of a
    /// dowel's second socket.
    pub(crate) fn back_mm(&self) -> f64 {
        if self.dowel.is_some() {
            self.socket_depth_mm
        } else {
            Self::root_mm(self.diameter_mm)
        }
    }
}

/// Returns the triangles of a body of revolution of so many rings. Fans about the two vertices
/// after the rings close its ends.
fn lathe_triangles(rings: usize) -> Vec<[u32; 3]> {
    let sides = SIDES as u32;
    let top = (rings as u32 - 1) * sides;
    let (first_hub, last_hub) = (top + sides, top + sides + 1);
    let mut triangles = Vec::with_capacity(2 * rings * SIDES);
    for side in 0..sides {
        let next = (side + 1) % sides;
        triangles.push([first_hub, next, side]);
        for below in (0..top).step_by(SIDES) {
            let above = below + sides;
            triangles.push([below + side, below + next, above + next]);
            triangles.push([below + side, above + next, above + side]);
        }
        triangles.push([last_hub, top + side, top + next]);
    }
    triangles
}
