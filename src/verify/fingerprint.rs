//! Fingerprints of parts: the hash of a part's triangles, and moments that show how its shape was
//! changed.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::base::digest::sha256_hex;
use crate::geom::{Point, Vector};
use crate::mesh::TriMesh;

/// The fingerprint of a surface: the hash of its triangles, and the moments of its area.
///
/// The moments are sums over the centroids of the triangles, weighted by area. They are exact for
/// the triangles as written, and follow every rotation, mirror and scaling. The third moments
/// distinguish a shape from its mirror image, which the second cannot.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Fingerprint {
    /// SHA-256 of the triangles in single precision, independent of their order and the file
    /// format.
    pub triangles_sha256: String,
    /// The area, mm².
    pub area_mm2: f64,
    /// The centre of the area, mm.
    pub center_mm: [f64; 3],
    /// The second moments about it, mm⁴: xx, yy, zz, xy, xz, yz.
    pub second_mm4: [f64; 6],
    /// The third moments about it, mm⁵: xxx, xxy, xxz, xyy, xyz, xzz, yyy, yyz, yzz, zzz.
    pub third_mm5: [f64; 10],
}

/// The relation of one shape to another, from their fingerprints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Likeness {
    /// The same triangles.
    Same,
    /// The same shape in the same place, up to the last digits of a file.
    Near,
    /// The same shape, moved by this distance, mm.
    Moved(f64),
    /// The same shape, rotated by right angles.
    Turned,
    /// The same shape, scaled by this factor.
    Scaled(f64),
    /// The mirror image.
    Mirrored,
    /// None of these.
    Other,
}

/// Moments agree within this share of the shape's own size. Files of six digits round to 1e-6 of
/// it, and mirror images differ by far more. Above 1e-3 the image of a nearly symmetrical part
/// passes for the part.
const TOLERANCE_RATIO: f64 = 1e-5;
/// A shape has moved if its centre is farther away than this, mm; rounding moves it by less than a
/// micrometre.
const STILL_MM: f64 = 1e-3;

/// The axes of the second moments, in their order.
const SECOND: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [0, 1], [0, 2], [1, 2]];
/// The axes of the third moments, in their order.
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
/// The permutations of three axes, the even ones first.
const ORDERS: [[usize; 3]; 6] = [
    [0, 1, 2],
    [1, 2, 0],
    [2, 0, 1],
    [0, 2, 1],
    [1, 0, 2],
    [2, 1, 0],
];

impl Fingerprint {
    /// Returns the fingerprint of a surface; one pass over its triangles and a sort of them.
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
        let sums = || {
            (
                sums_about(&center, &patches, SECOND),
                sums_about(&center, &patches, THIRD),
            )
        };
        let (triangles_sha256, (second_mm4, third_mm5)) =
            rayon::join(|| triangles_sha256(mesh), sums);
        Self {
            triangles_sha256,
            area_mm2,
            center_mm: center.into(),
            second_mm4,
            third_mm5,
        }
    }

    /// Returns the simplest change that turns this shape into the other.
    pub fn likeness(&self, other: &Self) -> Likeness {
        if self.triangles_sha256 == other.triangles_sha256 {
            return Likeness::Same;
        }
        let ratio = (other.area_mm2 / self.area_mm2).sqrt();
        let Some(map) = maps().find(|map| self.maps_to(other, map, ratio)) else {
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

    /// Returns true if the map and the scale turn the moments of this shape into those of the
    /// other.
    fn maps_to(&self, other: &Self, map: &AxisMap, ratio: f64) -> bool {
        let radius_mm = (self.second_mm4[..3].iter().sum::<f64>() / self.area_mm2).sqrt();
        let near = |own: f64, found: f64, power: i32| {
            let size = self.area_mm2 * radius_mm.powi(power - 2);
            (own - found / ratio.powi(power)).abs() <= TOLERANCE_RATIO * size
        };
        let second = SECOND.iter().zip(other.second_mm4).all(|(axes, found)| {
            let (sign, from) = map.source(*axes);
            near(sign * self.second_mm4[index_in(&SECOND, from)], found, 4)
        });
        second
            && THIRD.iter().zip(other.third_mm5).all(|(axes, found)| {
                let (sign, from) = map.source(*axes);
                near(sign * self.third_mm5[index_in(&THIRD, from)], found, 5)
            })
    }
}

/// A map of the axes onto each other or their opposites: one of the 48 symmetries of a cube.
#[derive(Debug, Clone, Copy, PartialEq)]
struct AxisMap {
    /// The source axis of each axis.
    from: [usize; 3],
    signs: [f64; 3],
}

impl AxisMap {
    const IDENTITY: Self = Self {
        from: ORDERS[0],
        signs: [1.0; 3],
    };

    /// Returns the sign and the source axes of these axes, ascending.
    fn source<const N: usize>(&self, axes: [usize; N]) -> (f64, [usize; N]) {
        let mut from = axes.map(|axis| self.from[axis]);
        from.sort_unstable();
        (axes.iter().map(|&axis| self.signs[axis]).product(), from)
    }

    fn is_mirror(&self) -> bool {
        let is_odd = ORDERS[3..].contains(&self.from);
        (self.signs.iter().product::<f64>() < 0.0) != is_odd
    }
}

/// Returns all maps of the axes: the identity first, then the rotations, then the mirrors.
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

/// Returns the index of the axes in a list that has them.
fn index_in<const N: usize>(list: &[[usize; N]], axes: [usize; N]) -> usize {
    list.iter()
        .position(|known| *known == axes)
        .unwrap_or_default()
}

/// Returns the area of a triangle, mm², and its centroid.
fn patch([a, b, c]: [Point; 3]) -> (f64, Point) {
    let middle = Point::from((a.coords + b.coords + c.coords) / 3.0);
    ((b - a).cross(&(c - a)).norm() / 2.0, middle)
}

/// Returns the sums, over patches with their areas, of the products of some coordinates about a
/// centre.
fn sums_about<const FACTORS: usize, const N: usize>(
    center: &Vector,
    patches: &[(f64, Point)],
    axes: [[usize; FACTORS]; N],
) -> [f64; N] {
    let mut sums = [0.0; N];
    for (area, middle) in patches {
        let arm = middle.coords - center;
        for (sum, axes) in sums.iter_mut().zip(&axes) {
            *sum += area * axes.iter().map(|&axis| arm[axis]).product::<f64>();
        }
    }
    sums
}

/// Returns the SHA-256 of the triangles in single precision, in ascending order, each rotated to
/// start at its least corner.
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
    triangles.par_sort_unstable_by_key(sort_key);
    let bytes: Vec<u8> = triangles
        .as_flattened()
        .as_flattened()
        .iter()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    sha256_hex(&[&bytes])
}

/// Returns numbers that are in the order of the triangles' corners.
#[inline]
fn sort_key(triangle: &[[u32; 3]; 3]) -> (u128, u128, u32) {
    let x = triangle.as_flattened();
    let join = |from: usize| (from..from + 4).fold(0, |all, i| all << u32::BITS | u128::from(x[i]));
    (join(0), join(4), x[8])
}

/// Returns the bits of a point in single precision; −0.0 counts as 0.0.
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

    fn likeness_after(linear: Matrix, shift: Vector) -> Likeness {
        let moved = lopsided().map_vertices(|p| Point::from(linear * p.coords + shift));
        let mesh = if linear.determinant() < 0.0 {
            moved.reversed()
        } else {
            moved
        };
        Fingerprint::of(&lopsided()).likeness(&Fingerprint::of(&mesh))
    }

    #[test]
    fn the_same_triangles_are_recognised_in_any_order_and_from_any_corner() {
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
    fn the_change_of_a_shape_is_recognised() {
        let id = Matrix::identity();
        let turn = Matrix::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
        let Likeness::Moved(mm) = likeness_after(id, Vector::new(3.0, 0.0, 4.0)) else {
            panic!()
        };
        assert!((mm - 5.0).abs() < 1e-9);
        assert_eq!(
            likeness_after(turn, Vector::new(1.0, 2.0, 3.0)),
            Likeness::Turned
        );
        let Likeness::Scaled(ratio) = likeness_after(id * 1.02, Vector::zeros()) else {
            panic!()
        };
        assert!((ratio - 1.02).abs() < 1e-9);
        for axis in 0..3 {
            let mut mirror = id;
            mirror[(axis, axis)] = -1.0;
            assert_eq!(
                likeness_after(mirror, Vector::new(10.0, 0.0, 0.0)),
                Likeness::Mirrored
            );
            assert_eq!(
                likeness_after(turn * mirror, Vector::zeros()),
                Likeness::Mirrored
            );
        }
        assert_eq!(
            likeness_after(
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
    fn half_of_the_maps_are_rotations() {
        let all: Vec<AxisMap> = maps().collect();
        assert_eq!((all.len(), all[0]), (48, AxisMap::IDENTITY));
        assert!(
            all[..24].iter().all(|map| !map.is_mirror())
                && all[24..].iter().all(AxisMap::is_mirror)
        );
    }
}
