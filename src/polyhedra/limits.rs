//! The limits of fabrication: turns between neighbours, edges, widths and the sheet.

use super::convex::Convex;
use crate::geom::{Plane, Point, hull};

/// The limits that cutting and joining set to a polyhedron; angles in radians, lengths in mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Least and largest angle between the outward normals of neighbours. The inner dihedral angle
    /// is π less this turn.
    pub turn_rad: [f64; 2],
    /// The least length of an edge.
    pub least_edge_mm: f64,
    /// The least width of a face, over all directions.
    pub least_width_mm: f64,
    /// The usable rectangle of the sheet that every face fits into; `None` for any size.
    pub room_mm: Option<[f64; 2]>,
}

/// The turn between neighbours for inner dihedral angles from 160° to 80°.
const TURN_DEG: [f64; 2] = [20.0, 100.0];
/// The least edge over the thickness of the sheet: two fingers and the setbacks at both ends.
const EDGE_PER_SHEET: f64 = 4.0;
/// The least width over the thickness of the sheet, beside the fasteners: joints on both sides.
const WIDTH_PER_SHEET: f64 = 6.0;

/// A limit by its kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum LimitKind {
    /// The turn between neighbours is too small: the joint is too flat.
    Flat,
    /// The turn between neighbours is too large: the joint is too sharp.
    Sharp,
    /// An edge is too short.
    Edge,
    /// A face is too narrow.
    Width,
    /// A face does not fit into the sheet.
    Room,
}

impl std::fmt::Display for LimitKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Flat => "flattest joint",
            Self::Sharp => "sharpest joint",
            Self::Edge => "shortest edge",
            Self::Width => "narrowest face",
            Self::Room => "room on the sheet",
        })
    }
}

/// A limit that a polyhedron breaks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Breach {
    /// The kind of limit.
    pub kind: LimitKind,
    /// The indices of the planes of the faces; the same twice if one face breaks it.
    pub planes: [usize; 2],
    /// The value found: an angle in radians or a length in mm.
    pub found: f64,
    /// The value that the limit asks for, in the same unit.
    pub asked: f64,
}

impl Breach {
    /// Returns by how much the limit is broken, from 0 to 1.
    pub fn severity(&self) -> f64 {
        let [least, most] = [self.found.min(self.asked), self.found.max(self.asked)];
        (1.0 - least / most).clamp(0.0, 1.0)
    }
}

impl Limits {
    /// Sets no limit.
    pub const NONE: Self = Self {
        turn_rad: [0.0, std::f64::consts::PI],
        least_edge_mm: 0.0,
        least_width_mm: 0.0,
        room_mm: None,
    };

    /// Returns the usual limits of a sheet of this thickness, joined by fasteners of this largest
    /// diameter. `room_mm` is the usable rectangle of sheet and bed. All in mm.
    pub fn for_sheet(thickness_mm: f64, fastener_mm: f64, room_mm: [f64; 2]) -> Self {
        Self {
            turn_rad: TURN_DEG.map(f64::to_radians),
            least_edge_mm: EDGE_PER_SHEET * thickness_mm,
            least_width_mm: WIDTH_PER_SHEET * thickness_mm + 2.0 * fastener_mm,
            room_mm: Some(room_mm),
        }
    }

    /// Returns true if nothing is limited.
    pub fn is_none(&self) -> bool {
        *self == Self::NONE
    }

    /// Returns every limit that the body on these planes breaks.
    pub fn breaches(&self, body: &Convex, planes: &[Plane]) -> Vec<Breach> {
        let mut breaches = Vec::new();
        for edge in body.edges() {
            let length = edge.length_mm();
            let [f, g] = edge.planes;
            let turn = planes[f].normal.angle(&planes[g].normal);
            let mut note = |kind, found, asked| {
                breaches.push(Breach {
                    kind,
                    planes: [f, g],
                    found,
                    asked,
                });
            };
            if turn < self.turn_rad[0] {
                note(LimitKind::Flat, turn, self.turn_rad[0]);
            }
            if turn > self.turn_rad[1] {
                note(LimitKind::Sharp, turn, self.turn_rad[1]);
            }
            if length < self.least_edge_mm {
                note(LimitKind::Edge, length, self.least_edge_mm);
            }
        }
        let outlines = body.outlines(planes.len());
        for (face, outline) in outlines.iter().enumerate().filter(|(_, o)| !o.is_empty()) {
            let flat = flattened(body, outline, &planes[face]);
            self.note_sizes(&flat, face, &mut breaches);
        }
        breaches
    }

    fn note_sizes(&self, flat: &[[f64; 2]], face: usize, breaches: &mut Vec<Breach>) {
        let mut width = f64::INFINITY;
        // The excess over the sheet in the pose that exceeds it least: found over asked.
        let mut fit = [f64::INFINITY, 1.0];
        for (k, &from) in flat.iter().enumerate() {
            let to = flat[(k + 1) % flat.len()];
            let Some(sizes) = extent_along(flat, from, to) else {
                continue;
            };
            width = width.min(sizes[1]);
            for [x, y] in [sizes, [sizes[1], sizes[0]]] {
                let room = self.room_mm.unwrap_or([f64::INFINITY; 2]);
                let sides = [[x, room[0]], [y, room[1]]];
                let worst = if x * room[1] > y * room[0] {
                    sides[0]
                } else {
                    sides[1]
                };
                if worst[0] * fit[1] < fit[0] * worst[1] {
                    fit = worst;
                }
            }
        }
        let planes = [face; 2];
        if width < self.least_width_mm {
            let (kind, asked) = (LimitKind::Width, self.least_width_mm);
            breaches.push(Breach {
                kind,
                planes,
                found: width,
                asked,
            });
        }
        if self.room_mm.is_some() && fit[0] > fit[1] {
            let kind = LimitKind::Room;
            breaches.push(Breach {
                kind,
                planes,
                found: fit[0],
                asked: fit[1],
            });
        }
    }
}

/// Returns the corners of an outline in the plane's own two coordinates.
pub(super) fn flattened(body: &Convex, outline: &[u32], plane: &Plane) -> Vec<[f64; 2]> {
    let (u, w) = plane.basis();
    let flat = |p: Point| [u.dot(&p.coords), w.dot(&p.coords)];
    outline
        .iter()
        .map(|&corner| flat(body.at(corner)))
        .collect()
}

/// Returns a convex polygon's extent along an edge and across it; `None` for an edge of no length.
fn extent_along(flat: &[[f64; 2]], from: [f64; 2], to: [f64; 2]) -> Option<[f64; 2]> {
    let length = (to[0] - from[0]).hypot(to[1] - from[1]);
    if length <= 0.0 {
        return None;
    }
    let [x, y] = [(to[0] - from[0]) / length, (to[1] - from[1]) / length];
    let (mut along, mut across) = ([f64::INFINITY, f64::NEG_INFINITY], 0.0_f64);
    for p in flat {
        let at = (p[0] - from[0]) * x + (p[1] - from[1]) * y;
        along = [along[0].min(at), along[1].max(at)];
        across = across.max(hull::turn(from, to, *p) / length);
    }
    Some([along[1] - along[0], across])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Aabb, Vector};

    fn block(size: [f64; 3]) -> (Convex, Vec<Plane>) {
        let sides = (0..3).flat_map(|k| {
            let normal = Vector::ith(k, 1.0);
            [normal, -normal].map(|normal| Plane {
                normal,
                offset_mm: size[k] / 2.0,
            })
        });
        let planes: Vec<Plane> = sides.collect();
        let corner = Point::new(1e3, 1e3, 1e3);
        let body = Convex::of_planes(&planes, &Aabb::of_points(&[-corner, corner])).unwrap();
        (body, planes)
    }

    fn kinds(limits: &Limits, size: [f64; 3]) -> Vec<LimitKind> {
        let (body, planes) = block(size);
        let breaches = limits.breaches(&body, &planes);
        let mut kinds: Vec<LimitKind> = breaches.iter().map(|breach| breach.kind).collect();
        kinds.sort_unstable();
        kinds.dedup();
        kinds
    }

    #[test]
    fn a_block_keeps_the_limits_until_it_is_narrow_or_large() {
        let limits = Limits::for_sheet(5.0, 5.0, [300.0, 200.0]);
        assert_eq!(kinds(&limits, [60.0, 80.0, 100.0]), []);
        assert_eq!(kinds(&limits, [39.0, 80.0, 100.0]), [LimitKind::Width]);
        let narrow = [LimitKind::Edge, LimitKind::Width];
        assert_eq!(kinds(&limits, [19.0, 80.0, 100.0]), narrow);
        assert_eq!(kinds(&limits, [60.0, 199.0, 299.0]), []);
        assert_eq!(kinds(&limits, [60.0, 299.0, 199.0]), []);
        assert_eq!(kinds(&limits, [60.0, 201.0, 299.0]), [LimitKind::Room]);
        assert_eq!(kinds(&limits, [60.0, 80.0, 301.0]), [LimitKind::Room]);
        assert_eq!(kinds(&Limits::NONE, [0.1, 1e3, 1e3]), []);
    }

    #[test]
    fn right_angles_are_too_sharp_or_too_flat_for_other_joints() {
        let turning = |degrees: [f64; 2]| Limits {
            turn_rad: degrees.map(f64::to_radians),
            ..Limits::NONE
        };
        assert_eq!(kinds(&turning([20.0, 89.0]), [60.0; 3]), [LimitKind::Sharp]);
        assert_eq!(kinds(&turning([91.0, 170.0]), [60.0; 3]), [LimitKind::Flat]);
        assert_eq!(kinds(&turning([89.0, 91.0]), [60.0; 3]), []);
    }

    #[test]
    fn a_breach_tells_what_there_is_and_how_bad_it_is() {
        let limits = Limits::for_sheet(5.0, 5.0, [300.0, 200.0]);
        let (body, planes) = block([20.0, 80.0, 100.0]);
        let breaches = limits.breaches(&body, &planes);
        assert_eq!(breaches.len(), 4);
        for breach in breaches {
            assert!((breach.found - 20.0).abs() < 1e-12 && breach.asked == 40.0);
            assert!((breach.severity() - 0.5).abs() < 1e-12);
        }
    }
}
