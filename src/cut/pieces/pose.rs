//! The pose of a part in the printer.

use std::fmt;

use crate::{
    base::watch::Cancelled,
    cut::{
        ids::CutId,
        joints::pin_shape::PinSite,
        pieces::split::Piece,
        request::{PlanRequest, PosePreference},
    },
    geom::{Aabb, Matrix, Plane, Point, Vector, orthonormal_basis},
    mesh::TriMesh,
    poses::{Peg, PoseRules, Shape, Side, SupportRule, Want, rank_poses},
};

/// The pose of a part in the printer.
#[derive(Debug, Clone, PartialEq)]
pub struct Pose {
    /// The rigid motion from the model frame to the print frame, as rows of a 4×4 matrix.
    pub print_from_model: [[f64; 4]; 4],
    /// The part's extents in the printer: x, y, z, mm.
    pub size_mm: [f64; 3],
    /// `true` if that fits the build volume.
    pub fits: bool,
    /// The side on which the part lies.
    pub lies: Lie,
}

/// The side on which a part lies on the build plate.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Lie {
    /// On the face of this cut.
    CutFaceDown(CutId),
    /// With the face of this cut up.
    CutFaceUp(CutId),
    /// Upright as the model stands.
    Upright,
    /// Upside down.
    UpsideDown,
    /// On a side of the model.
    OnItsSide,
    /// In any other direction.
    Leaning,
    /// A plug, on its inner end.
    InnerEndDown,
}

impl fmt::Display for Lie {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::CutFaceDown(cut) => write!(f, "cut face {cut} down"),
            Self::CutFaceUp(cut) => write!(f, "cut face {cut} up"),
            Self::Upright => f.write_str("upright"),
            Self::UpsideDown => f.write_str("upside down"),
            Self::OnItsSide => f.write_str("on its side"),
            Self::Leaning => f.write_str("leaning"),
            Self::InnerEndDown => f.write_str("inner end down"),
        }
    }
}

/// Turns about the vertical, in the order tried until the part fits, degrees.
const TURNS_DEG: [f64; 12] = [
    0.0, 90.0, 15.0, 30.0, 45.0, 60.0, 75.0, 105.0, 120.0, 135.0, 150.0, 165.0,
];

/// Angles to the horizontal from which surfaces print without support, degrees: the usual ones for
/// filament and for resin in a vat. The request may say another.
const FILAMENT_DEG: f64 = 45.0;
const RESIN_DEG: f64 = 30.0;

/// Distance from a cut within which a vertex lies on its face, mm.
const ON_CUT_MM: f64 = 1e-4;

/// A side of a part that may face down in the printer.
#[derive(Debug, Clone)]
pub(crate) struct Underside {
    /// The direction in the model frame that then points down.
    down: Vector,
    /// The name of that pose.
    lies: Lie,
}

/// A cut face of a part, as far as it decides the pose.
struct CutFace {
    area_mm2: f64,
    /// The normal of the face, out of the part.
    outward: Vector,
    has_pins: bool,
    cut: usize,
}

impl CutFace {
    /// Returns the pose with the face down (sign 1) or up (sign −1).
    fn underside(&self, sign: f64, lies: fn(CutId) -> Lie) -> Underside {
        Underside {
            down: self.outward * sign,
            lies: lies(CutId::of(self.cut)),
        }
    }
}

/// Returns the sides of the piece that may face down in the printer, the preferred first. The cut
/// faces come first, by area and as the request prefers, then the sides of the axis. `pin_cuts` are
/// the cuts on whose faces pins stand out.
pub(crate) fn sides_down(
    piece: &Piece,
    planes: &[Plane],
    pin_cuts: &[usize],
    request: &PlanRequest,
) -> Vec<Underside> {
    let mut cut_faces = cut_faces(piece, planes, pin_cuts);
    cut_faces.sort_by(|a, b| b.area_mm2.total_cmp(&a.area_mm2));
    let face_down = cut_faces
        .iter()
        .filter(|face| !face.has_pins)
        .map(|face| face.underside(1.0, Lie::CutFaceDown));
    let face_up = cut_faces
        .iter()
        .map(|face| face.underside(-1.0, Lie::CutFaceUp));
    let mut sides: Vec<Underside> = match request.pose {
        PosePreference::OpenHollowUp => face_up.chain(face_down).collect(),
        _ => face_down.chain(face_up).collect(),
    };
    let axis = request.axis.direction.normalize();
    let (u, v) = orthonormal_basis(&axis);
    let lies = [
        Lie::Upright,
        Lie::UpsideDown,
        Lie::OnItsSide,
        Lie::OnItsSide,
        Lie::OnItsSide,
        Lie::OnItsSide,
    ];
    let turned = [-axis, axis, -u, u, -v, v].into_iter().zip(lies);
    sides.extend(turned.map(|(down, lies)| Underside { down, lies }));
    sides
}

/// Returns the pose of the mesh on the first of `sides` (at least one) with which it fits the build
/// volume. If none fits, returns the pose on the first of all.
pub(crate) fn choose_pose(mesh: &TriMesh, sides: &[Underside], request: &PlanRequest) -> Pose {
    let mut choices = sides
        .iter()
        .flat_map(|side| TURNS_DEG.map(|turn| (side, turn)));
    let fitting = choices
        .find_map(|(side, turn)| Some(lay(mesh, side, turn, request)).filter(|pose| pose.fits));
    fitting.unwrap_or_else(|| lay(mesh, &sides[0], 0.0, request))
}

/// A part or a piece to be posed.
pub(crate) struct Posed<'a> {
    /// Its surface with its pins and sockets, if they are known already.
    pub(crate) mesh: &'a TriMesh,
    /// The piece that it is made of.
    pub(crate) piece: &'a Piece,
    /// The planes of all cuts.
    pub(crate) planes: &'a [Plane],
    /// The printed pins that stand out of it.
    pub(crate) pins: &'a [PinSite],
    /// The cuts on whose faces they stand.
    pub(crate) pin_cuts: &'a [usize],
}

impl Posed<'_> {
    /// Returns the pose that the request prefers, among those that fit the build volume.
    /// `is_of_void` returns whether a vertex belongs to a void's wall.
    ///
    /// # Errors
    /// The request's watch was stopped.
    pub(crate) fn pose(
        &self,
        request: &PlanRequest,
        is_of_void: impl Fn(&Point) -> bool,
    ) -> Result<Pose, Cancelled> {
        let sides = sides_down(self.piece, self.planes, self.pin_cuts, request);
        let Some(want) = want(request) else {
            return Ok(choose_pose(self.mesh, &sides, request));
        };
        let faces = cut_faces(self.piece, self.planes, self.pin_cuts);
        let outward: Vec<Vector> = faces.iter().map(|face| face.outward).collect();
        let shape = self.shape(is_of_void);
        let wall_mm = request.wall_mm;
        let rules = PoseRules { want, wall_mm };
        let ups = rank_poses(&shape, &outward, &rules, &request.watch)?;
        let known = |down: &Vector| sides.iter().find(|side| is_same(&side.down, down));
        let free = |down| Underside {
            down,
            lies: Lie::Leaning,
        };
        let ranked = ups
            .iter()
            .map(|up| known(&-up).cloned().unwrap_or_else(|| free(-up)));
        let mut poses =
            ranked.flat_map(|side| TURNS_DEG.map(|turn| lay(self.mesh, &side, turn, request)));
        Ok(poses
            .find(|pose| pose.fits)
            .unwrap_or_else(|| choose_pose(self.mesh, &sides, request)))
    }

    /// Returns the surface with the kinds of its triangles.
    fn shape(&self, is_of_void: impl Fn(&Point) -> bool) -> Shape<'_> {
        let peg = |pin: &PinSite| Peg {
            center: Point::from(pin.center_mm),
            axis: Vector::from(pin.direction),
            length_mm: pin.length_mm,
            diameter_mm: pin.diameter_mm,
        };
        let is_on_cut = |p: &Point| {
            self.planes
                .iter()
                .any(|plane| plane.distance(p).abs() < ON_CUT_MM)
        };
        let side = |index: usize| {
            let corners = self.mesh.corners(index);
            if corners.iter().any(&is_of_void) {
                Side::Hollow
            } else if corners.iter().all(is_on_cut) {
                Side::CutFace
            } else {
                Side::Outside
            }
        };
        Shape::new(self.mesh, self.pins.iter().map(peg).collect(), side)
    }
}

/// Returns what the request wants of a pose that is chosen among all directions; `None` if it
/// prefers a cut face.
fn want(request: &PlanRequest) -> Option<Want> {
    let overhang_deg = request.cleaning.overhang_deg;
    let rule = |usual_deg: f64| SupportRule {
        overhang_deg: overhang_deg.unwrap_or(usual_deg),
        layer_mm: request.layer_mm,
    };
    match request.pose {
        PosePreference::LittleSupport => Some(Want::LittleSupport(rule(FILAMENT_DEG))),
        PosePreference::Tilted => Some(Want::NoCup(rule(RESIN_DEG))),
        PosePreference::CutFaceDown | PosePreference::OpenHollowUp => None,
    }
}

/// Returns whether two directions are the same up to rounding.
fn is_same(a: &Vector, b: &Vector) -> bool {
    (a.normalize() - b.normalize()).norm() < 1e-12
}

/// Returns whether the piece fits the build volume in some pose.
pub(crate) fn fits(piece: &Piece, planes: &[Plane], request: &PlanRequest) -> bool {
    choose_pose(
        &piece.mesh,
        &sides_down(piece, planes, &[], request),
        request,
    )
    .fits
}

/// Returns the cut faces of the piece, one for each cut and side.
fn cut_faces(piece: &Piece, planes: &[Plane], pin_cuts: &[usize]) -> Vec<CutFace> {
    let mut cut_faces = Vec::new();
    for (cut, plane) in planes.iter().enumerate() {
        for is_above in [false, true] {
            let caps = piece
                .caps
                .iter()
                .filter(|cap| cap.cut == cut && cap.is_above == is_above);
            let area_mm2: f64 = caps.map(|cap| cap.area_mm2).sum();
            if area_mm2 > 0.0 {
                let outward = if is_above {
                    -plane.normal
                } else {
                    plane.normal
                };
                cut_faces.push(CutFace {
                    area_mm2,
                    outward,
                    has_pins: pin_cuts.contains(&cut),
                    cut,
                });
            }
        }
    }
    cut_faces
}

/// Returns the pose of a part that is no piece of the body, with a direction of the model down.
pub(crate) fn lay_on(mesh: &TriMesh, down: Vector, request: &PlanRequest) -> Pose {
    let side = Underside {
        down,
        lies: Lie::InnerEndDown,
    };
    lay(mesh, &side, 0.0, request)
}

/// Returns the pose with the side down, turned about the vertical. The mesh rests on z = 0, in the
/// middle of the build plate.
fn lay(mesh: &TriMesh, side: &Underside, turn_deg: f64, request: &PlanRequest) -> Pose {
    let rotation = rotation_to_print(&side.down, turn_deg);
    let turned = mesh
        .vertices()
        .iter()
        .map(|p| Point::from(rotate(&rotation, p)));
    let aabb = turned.fold(Aabb::EMPTY, |aabb, p| aabb.grown_over(&p));
    let middle = request
        .build_volume_mm
        .map_or([0.0; 2], |[x, y, _]| [x / 2.0, y / 2.0]);
    let center = aabb.center();
    let shift = [middle[0] - center.x, middle[1] - center.y, -aabb.min.z];
    let size_mm: [f64; 3] = aabb.size().into();
    let fits = request
        .build_volume_mm
        .is_none_or(|room| (0..3).all(|i| size_mm[i] <= room[i]));
    let row = |i: usize| {
        [
            rotation[(i, 0)],
            rotation[(i, 1)],
            rotation[(i, 2)],
            shift[i],
        ]
    };
    let print_from_model = [row(0), row(1), row(2), [0.0, 0.0, 0.0, 1.0]];
    Pose {
        print_from_model,
        size_mm,
        fits,
        lies: side.lies.clone(),
    }
}

/// Returns the rotation that takes `down` to −z, then turns by `turn_deg` about z.
fn rotation_to_print(down: &Vector, turn_deg: f64) -> Matrix {
    let up = -down.normalize();
    let (u, v) = if up.z.abs() > 1.0 - f64::EPSILON {
        // The model's own up or down: keep its x axis, so that an upright model is not turned
        // needlessly.
        (Vector::x(), up.cross(&Vector::x()))
    } else {
        orthonormal_basis(&up)
    };
    let (sin, cos) = turn_deg.to_radians().sin_cos();
    Matrix::from_rows(&[
        (u * cos - v * sin).transpose(),
        (u * sin + v * cos).transpose(),
        up.transpose(),
    ])
}

/// Returns the rotated position, each coordinate summed in the order of [`apply`].
fn rotate(rotation: &Matrix, p: &Point) -> Vector {
    Vector::from([0, 1, 2].map(|i| dot([rotation[(i, 0)], rotation[(i, 1)], rotation[(i, 2)]], p)))
}

fn dot(row: [f64; 3], p: &Point) -> f64 {
    row[0] * p.x + row[1] * p.y + row[2] * p.z
}

/// Returns a point moved by a rigid motion, given as rows of a 4×4 matrix. With the motion of a
/// [`Pose`], the lowest point of its part comes to z = 0 exactly.
pub fn apply(motion: &[[f64; 4]; 4], p: &Point) -> Point {
    Point::from([0, 1, 2].map(|i| {
        let [x, y, z, shift] = motion[i];
        dot([x, y, z], p) + shift
    }))
}
