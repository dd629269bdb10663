//! Meshes and sections of hardware and ballast.

use crate::draw::{Hatch, convex_section};
use crate::geom::{Frame, Plane, Point, Vector};
use crate::mass::Lump;
use crate::mesh::{TriMesh, primitives};
use crate::sheet::Checklist;
use crate::verify::Hardware;

/// Sides of a rod in a picture: a rod with fewer sides looks like a nut.
const SIDES: u32 = 32;

/// Subdivisions of a ball in a picture: 320 triangles.
const BALL_LEVEL: u32 = 2;

/// The section of a piece that a cut passes through.
pub(super) struct Insert {
    /// Id of the piece, such as `H1`.
    pub id: String,
    /// Filling.
    pub hatch: Hatch,
    /// Outline in the plane's coordinates, mm.
    pub ring: Vec<[f64; 2]>,
}

impl Insert {
    /// Returns the mean of its outline.
    pub fn middle(&self) -> [f64; 2] {
        let count = self.ring.len() as f64;
        [0, 1].map(|axis| self.ring.iter().map(|point| point[axis]).sum::<f64>() / count)
    }
}

/// Returns the sections of the hardware and the ballast that a cut passes through.
pub(super) fn inserts(sheet: &Checklist, plane: &Plane) -> Vec<Insert> {
    let rods = sheet
        .hardware
        .iter()
        .map(|rod| (&rod.id, Hatch::RODS, rod_mesh(rod)));
    let lumps = sheet
        .ballast
        .iter()
        .map(|row| (&row.order.id, Hatch::BALLAST, lump_mesh(&row.order.lump)));
    let insert = |(id, hatch, mesh): (&String, Hatch, TriMesh)| {
        let ring = convex_section(&mesh, plane);
        (ring.len() > 2).then(|| Insert {
            id: id.clone(),
            hatch,
            ring,
        })
    };
    rods.chain(lumps).filter_map(insert).collect()
}

/// Returns the mesh of a piece of ballast; nuts and coins are drawn as discs.
pub(super) fn lump_mesh(lump: &Lump) -> TriMesh {
    let (center, shape) = (Point::from(lump.center_mm), &lump.shape);
    if shape.is_ball() {
        return primitives::ball(&center, shape.radius_mm(), BALL_LEVEL);
    }
    let frame = Frame::with_axis(center, &Vector::from(lump.axis).normalize());
    let low = Point::new(0.0, 0.0, -shape.half_height_mm());
    let disc = primitives::cylinder(shape.radius_mm(), 2.0 * shape.half_height_mm(), SIDES);
    disc.map_vertices(|p| frame.to_model(&(low + p.coords)))
}

/// Returns the mesh of a piece of hardware; rings are drawn without their hole.
pub(super) fn rod_mesh(piece: &Hardware) -> TriMesh {
    let (from, to) = (Point::from(piece.from_mm), Point::from(piece.to_mm));
    let (radius_mm, length_mm) = (0.5 * piece.diameter_mm, (to - from).norm());
    let frame = Frame::with_axis(from, &(to - from));
    let straight_mm = if piece.round_end {
        length_mm - radius_mm
    } else {
        length_mm
    };
    let rod = primitives::cylinder(radius_mm, straight_mm, SIDES);
    let end = Point::new(0.0, 0.0, straight_mm);
    let ball = if piece.round_end {
        primitives::ball(&end, radius_mm, BALL_LEVEL)
    } else {
        TriMesh::default()
    };
    rod.joined(&ball).map_vertices(|p| frame.to_model(p))
}
