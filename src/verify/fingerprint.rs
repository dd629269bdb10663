//! What a part's shape is known by when its file comes back: its triangles, and numbers that tell
//! how it was changed.

use serde::{Deserialize, Serialize};

use crate::base::digest::sha256_hex;
use crate::geom::{Point, Vector};
use crate::mesh::TriMesh;

/// The mark of a surface: the hash of its triangles, and the moments of its area.
///
/// The moments are sums over the triangles' middles, each weighed by its area: exact for the
/// triangles as they are, and they follow every turn, mirror and scaling. The third ones tell a
/// shape from its mirror image, which the second cannot.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Fingerprint {
    /// SHA-256 of the triangles in single precision, whatever their order and the file's form.
    pub triangles_sha256: String,
    /// mm².
    pub area_mm2: f64,
    /// The centre of the area, mm.
    pub center_mm: [f64; 3],
    /// The second moments about it, mm⁴: xx, yy, zz, xy, xz, yz.
    pub second_mm4: [f64; 6],
    /// The third moments about it, mm⁵: xxx, xxy, xxz, xyy, xyz, xzz, yyy, yyz, yzz, zzz.
    pub third_mm5: [f64; 10],
}

/// How the shape of one mark becomes that of another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Likeness {
    /// The same triangles.
    Same,
    /// The same shape but for the last digits of a file, in the same place.
    Near,
    /// The same shape elsewhere, by so many mm.
    Moved(f64),
    /// Turned by right angles.
    Turned,
    /// The same shape times that.
    Scaled(f64),
    /// The mirror image.
    Mirrored,
    /// None of these.
    Other,
}

/// Moments agree within this share of the shape's own size. Files of six digits round to 1e-6 of
/// it, and tell a mirror image from its original by far more; above 1e-3 a symmetrical part's image
/// passes for the part.
const TOLERANCE_RATIO: f64 = 1e-5;
/// A shape has moved when its centre is farther away than this, mm: rounding moves it by less than
/// a micrometre.
const STILL_MM: f64 = 1e-3;

/// The axes of the second moments, in the order in which they are kept.
const SECOND: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [0, 1], [0, 2], [1, 2]];
/// The axes of the third moments.
const THIRD: [[usize; 3]; 10] = [
    [0, 0, 0],
    [0, 0, 1],
    [0, 0, 2],
    [0, 1, 1],
    [0, 1, 2],
    [0, 2, 2],
    [1, 1, 1],
    [1, 1, 2],
    [1, 2, 2],
    [2, 2, 2],
];
/// The orders that three axes can come in, the turns first.
const ORDERS: [[usize; 3]; 6] = [
    [0, 1, 2],
    [1, 2, 0],
    [2, 0, 1],
    [0, 2, 1],
    [1, 0, 2],
    [2, 1, 0],
];

impl Fingerprint {
    /// The mark of a surface; one pass over its triangles and a sort of them.
    pub fn of(mesh: &TriMesh) -> Self {
        let patches: Vec<(f64, Point)> = mesh.iter_corners().map(patch).collect();
        let area_mm2: f64 = patches.iter().map(|(area, _)| area).sum();
        let weighed: Vector = patches
            .iter()
            .map(|(area, middle)| middle.coords * *area)
            .sum();
        let center = if area_mm2 > 0.0 {
            weighed / area_mm2
        } else {
            Vector::zeros()
        };
        let sum = |axes: &[usize]| -> f64 {
            let term = |(area, middle): &(f64, Point)| {
                let arm = middle.coords - center;
                area * axes.iter().map(|&axis| arm[axis]).product::<f64>()
            };
            patches.iter().map(term).sum()
        };
        Self {
            triangles_sha256: triangles_sha256(mesh),
            area_mm2,
            center_mm: center.into(),
            second_mm4: SECOND.map(|axes| sum(&axes)),
            third_mm5: THIRD.map(|axes| sum(&axes)),
        }
    }

    /// What was done to this shape to get the other: the plainest that explains it.
    pub fn likeness(&self, other: &Self) -> Likeness {
        if self.triangles_sha256 == other.triangles_sha256 {
            return Likeness::Same;
        }
        let ratio = (other.area_mm2 / self.area_mm2).sqrt();
        let Some(map) = maps().find(|map| self.becomes(other, map, ratio)) else {
            return Likeness::Other;
        };
        let moved_mm = (Vector::from(other.center_mm) - Vector::from(self.center_mm)).norm();
        match map {
            map if map.is_mirror() => Likeness::Mirrored,
            _ if (ratio - 1.0).abs() > TOLERANCE_RATIO => Likeness::Scaled(ratio),
            map if map != AxisMap::IDENTITY => Likeness::Turned,
            _ if moved_mm > STILL_MM => Likeness::Moved(moved_mm),
            _ => Likeness::Near,
        }
    }

    /// Whether the other's moments are this one's through the map and times the ratio.
    fn becomes(&self, other: &Self, map: &AxisMap, ratio: f64) -> bool {
        let radius_mm = (self.second_mm4[..3].iter().sum::<f64>() / self.area_mm2).sqrt();
        let near = |own: f64, found: f64, power: i32| {
            let size = self.area_mm2 * radius_mm.powi(power - 2);
            (own - found / ratio.powi(power)).abs() <= TOLERANCE_RATIO * size
        };
        let second = SECOND.iter().zip(other.second_mm4).all(|(axes, found)| {
            let (sign, from) = map.of(*axes);
            near(sign * self.second_mm4[place(&SECOND, from)], found, 4)
        });
        second
            && THIRD.iter().zip(other.third_mm5).all(|(axes, found)| {
                let (sign, from) = map.of(*axes);
                near(sign * self.third_mm5[place(&THIRD, from)], found, 5)
            })
    }
}

/// A map of the axes onto each other or their opposites: one of the 48 symmetries of a cube.
#[derive(Debug, Clone, Copy, PartialEq)]
struct AxisMap {
    /// From which axis each comes.
    from: [usize; 3],
    signs: [f64; 3],
}

impl AxisMap {
    const IDENTITY: Self = Self {
        from: ORDERS[0],
        signs: [1.0; 3],
    };

    /// The sign and the axes that these come from, ascending.
    fn of<const N: usize>(&self, axes: [usize; N]) -> (f64, [usize; N]) {
        let mut from = axes.map(|axis| self.from[axis]);
        from.sort_unstable();
        (axes.iter().map(|&axis| self.signs[axis]).product(), from)
    }

    fn is_mirror(&self) -> bool {
        let is_odd = ORDERS[3..].contains(&self.from);
        (self.signs.iter().product::<f64>() < 0.0) != is_odd
    }
}

/// All maps of the axes, the identity first, then the turns, then the mirrors.
fn maps() -> impl Iterator<Item = AxisMap> {
    let sign = |i: usize, axis: usize| if i >> axis & 1 == 1 { -1.0 } else { 1.0 };
    let all = ORDERS
        .into_iter()
        .flat_map(move |from| (0..8).map(move |i| (from, i)));
    let all = all.map(move |(from, i)| AxisMap {
        from,
        signs: [0, 1, 2].map(|axis| sign(i, axis)),
    });
    let (mirrors, turns): (Vec<AxisMap>, Vec<AxisMap>) = all.partition(AxisMap::is_mirror);
    turns.into_iter().chain(mirrors)
}

/// Where the axes stand in a list that has them.
fn place<const N: usize>(list: &[[usize; N]], axes: [usize; N]) -> usize {
    list.iter()
        .position(|known| *known == axes)
        .unwrap_or_default()
}

/// The area of a triangle, mm², and its middle.
fn patch([a, b, c]: [Point; 3]) -> (f64, Point) {
    let middle = Point::from((a.coords + b.coords + c.coords) / 3.0);
    ((b - a).cross(&(c - a)).norm() / 2.0, middle)
}

/// SHA-256 of the triangles in single precision, each begun at its least corner, in ascending
/// order.
fn triangles_sha256(mesh: &TriMesh) -> String {
    let mut triangles: Vec<[[u32; 3]; 3]> = mesh
        .iter_corners()
        .map(|corners| corners.map(bits))
        .collect();
    for triangle in &mut triangles {
        let least = (0..3)
            .min_by_key(|&corner| triangle[corner])
            .unwrap_or_default();
        triangle.rotate_left(least);
    }
    triangles.sort_unstable();
    let bytes: Vec<u8> = triangles
        .as_flattened()
        .as_flattened()
        .iter()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    sha256_hex(&[&bytes])
}

/// The bits of a point in single precision; −0.0 counts as 0.0.
fn bits(p: Point) -> [u32; 3] {
    [p.x, p.y, p.z].map(|x| (x as f32 + 0.0).to_bits())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Matrix;
    use crate::mesh::primitives::ball;
    use crate::verify::test_meshes::block;

    /// A block with a ball beside one of its corners: no turn or mirror leaves it as it is.
    fn lopsided() -> TriMesh {
        let knob = ball(&Point::new(9.0, 1.0, 2.5), 1.0, 2);
        block(Point::origin(), [10.0, 6.0, 3.0]).joined(&knob)
    }

    fn mapped(linear: Matrix, shift: Vector) -> Likeness {
        let moved = lopsided().map_vertices(|p| Point::from(linear * p.coords + shift));
        let mesh = if linear.determinant() < 0.0 {
            moved.reversed()
        } else {
            moved
        };
        Fingerprint::of(&lopsided()).likeness(&Fingerprint::of(&mesh))
    }

    #[test]
    fn the_same_triangles_are_known_in_any_order_and_from_any_corner() {
        let mesh = lopsided();
        let turned = mesh
            .triangles()
            .iter()
            .rev()
            .map(|&[a, b, c]| [b, c, a])
            .collect();
        let other = TriMesh::new(mesh.vertices().to_vec(), turned).unwrap();
        assert_eq!(
            Fingerprint::of(&mesh).likeness(&Fingerprint::of(&other)),
            Likeness::Same
        );
        assert_ne!(
            Fingerprint::of(&mesh).triangles_sha256,
            Fingerprint::of(&mesh.reversed()).triangles_sha256
        );
    }

    #[test]
    fn what_was_done_to_a_shape_is_told() {
        let id = Matrix::identity();
        let turn = Matrix::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
        let Likeness::Moved(mm) = mapped(id, Vector::new(3.0, 0.0, 4.0)) else {
            panic!()
        };
        assert!((mm - 5.0).abs() < 1e-9);
        assert_eq!(mapped(turn, Vector::new(1.0, 2.0, 3.0)), Likeness::Turned);
        let Likeness::Scaled(ratio) = mapped(id * 1.02, Vector::zeros()) else {
            panic!()
        };
        assert!((ratio - 1.02).abs() < 1e-9);
        for axis in 0..3 {
            let mut mirror = id;
            mirror[(axis, axis)] = -1.0;
            assert_eq!(
                mapped(mirror, Vector::new(10.0, 0.0, 0.0)),
                Likeness::Mirrored
            );
            assert_eq!(mapped(turn * mirror, Vector::zeros()), Likeness::Mirrored);
        }
        assert_eq!(
            mapped(
                Matrix::from_diagonal(&Vector::new(1.0, 1.0, 1.1)),
                Vector::zeros()
            ),
            Likeness::Other
        );
    }

    #[test]
    fn rounded_coordinates_are_near_and_another_body_is_other() {
        let mesh = lopsided();
        let rounded = mesh.map_vertices(|p| p.map(|x| (x * 1e5).round() / 1e5));
        assert_eq!(
            Fingerprint::of(&mesh).likeness(&Fingerprint::of(&rounded)),
            Likeness::Near
        );
        let without = block(Point::origin(), [10.0, 6.0, 3.0]);
        assert_eq!(
            Fingerprint::of(&mesh).likeness(&Fingerprint::of(&without)),
            Likeness::Other
        );
        assert_eq!(
            Fingerprint::of(&mesh).likeness(&Fingerprint::of(&TriMesh::default())),
            Likeness::Other
        );
    }

    #[test]
    fn half_of_the_maps_are_turns() {
        let all: Vec<AxisMap> = maps().collect();
        assert_eq!((all.len(), all[0]), (48, AxisMap::IDENTITY));
        assert!(
            all[..24].iter().all(|map| !map.is_mirror())
                && all[24..].iter().all(AxisMap::is_mirror)
        );
    }
}
