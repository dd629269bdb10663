//! The moments of a solid whose density varies, from its surface alone.
//!
//! For any apex o, take the signed tetrahedra (o, a, b, c) over the triangles of a closed surface.
//! They add up to the indicator of the solid. So ∫ f m over the solid is the signed sum over these
//! cones, for any density f that is defined in space. No tetrahedral mesh is needed.

use rayon::prelude::*;

use super::moments::Moments;
use super::of_mesh::MomentSum;
use super::rule::ConeRule;
use super::split::Split;
use super::tetrahedron::Tetrahedron;
use crate::geom::{Plane, Point, Vector};
use crate::mesh::TriMesh;

/// Triangles summed as one unit of work, so that the bits do not depend on the number of threads.
const BLOCK: usize = 512;
/// Points a side of the coarse and the fine rule whose difference is the error of a piece.
const COARSE_AND_FINE: [usize; 2] = [2, 4];
/// Halvings of a cone after which its error is accepted.
const MOST_HALVINGS: usize = 40;

/// The signed cones from an apex over the triangles of a closed, oriented mesh.
///
/// With the apex near the centre, moments are right to some 1e-14 of their scale. With one three
/// lengths away it is 1e-12.
#[derive(Debug, Clone, Copy)]
pub struct Cones<'a> {
    mesh: &'a TriMesh,
    apex: Point,
}

/// The accuracy at which a sum over cones ends, and the work after which it ends in any case.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Accuracy {
    /// Largest error of each moment, as a share of the solid's own of that degree.
    pub ratio: f64,
    /// Most pieces of cones that are integrated.
    pub most_pieces: usize,
}

/// Moments that were found by quadrature, and their error.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Estimate {
    /// The moments, mm³ to mm⁵.
    pub moments: Moments,
    /// The error of each moment: the sum over all pieces of the difference of two rules. The finer
    /// one is used, so the true error is usually far smaller.
    pub error: Moments,
}

impl Estimate {
    /// Returns exact moments.
    pub fn exact(moments: Moments) -> Self {
        Self {
            moments,
            error: Moments::default(),
        }
    }

    /// Returns the sum of two estimates.
    #[must_use]
    pub fn plus(self, other: &Self) -> Self {
        Self {
            moments: self.moments + other.moments,
            error: self.error + other.error,
        }
    }

    /// Returns the estimate times a factor.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        Self {
            moments: self.moments * factor,
            error: self.error * factor.abs(),
        }
    }

    /// Returns the estimate of the region moved by `shift`; errors can only grow.
    #[must_use]
    pub fn translated(&self, shift: &Vector) -> Self {
        let error = absolute(&self.error).translated(&shift.abs());
        Self {
            moments: self.moments.translated(shift),
            error,
        }
    }
}

impl<'a> Cones<'a> {
    /// Returns the cones from an apex, which may lie anywhere.
    pub fn new(mesh: &'a TriMesh, apex: Point) -> Self {
        Self { mesh, apex }
    }

    /// Returns the cones from the middle of the mesh's box.
    pub fn from_middle(mesh: &'a TriMesh) -> Self {
        let apex = if mesh.triangles().is_empty() {
            Point::origin()
        } else {
            mesh.aabb().center()
        };
        Self::new(mesh, apex)
    }

    /// Returns the apex.
    pub fn apex(&self) -> Point {
        self.apex
    }

    /// Returns the mesh.
    pub fn mesh(&self) -> &'a TriMesh {
        self.mesh
    }

    /// Returns the moments for a density that is linear in place. Exact up to rounding.
    pub fn linear(&self, density: impl Fn(&Point) -> f64 + Sync) -> Moments {
        let at_apex = density(&self.apex);
        let sum = |sum: &mut MomentSum, cone: &Tetrahedron| {
            let [_, a, b, c] = cone.0.map(|corner| density(&(self.apex + corner)));
            sum.add(&cone.linear([at_apex, a, b, c]));
        };
        self.sum(sum)
    }

    /// Returns the moments for a density that is a polynomial of this degree between the `kinks`.
    /// Exact up to rounding: cones are split by the planes.
    ///
    /// The density may jump at the planes: it is asked for inside the pieces only.
    pub fn piecewise(
        &self,
        kinks: &[Plane],
        degree: usize,
        density: impl Fn(&Point) -> f64 + Sync,
    ) -> Moments {
        let rule = ConeRule::of_degree(degree + 2);
        let sum = |sum: &mut MomentSum, cone: &Tetrahedron| {
            self.split(cone, kinks, &mut |piece| {
                sum.add(&piece.by_rule(&rule, |at| density(&(self.apex + at))));
            });
        };
        self.sum(sum)
    }

    /// Returns the moments for any density, smooth but for `kinks` and places that are not named.
    ///
    /// Pieces of cones are halved until two rules agree, or until there are as many pieces as
    /// allowed; the error says which.
    pub fn estimate(
        &self,
        kinks: &[Plane],
        accuracy: Accuracy,
        density: impl Fn(&Point) -> f64 + Sync,
    ) -> Estimate {
        let mut pieces = Vec::new();
        for cone in self.cones(self.mesh.triangles()) {
            self.split(&cone, kinks, &mut |piece| pieces.push(*piece));
        }
        let limits = self.limits(accuracy.ratio, pieces.len());
        let rules = COARSE_AND_FINE.map(ConeRule::new);
        let density = |at: &Vector| density(&(self.apex + at));
        let measure = |piece: &Tetrahedron| {
            let [coarse, fine] = [0, 1].map(|which| piece.by_rule(&rules[which], density));
            Estimate {
                moments: fine,
                error: absolute(&(fine - coarse)),
            }
        };
        let mut total = EstimateSum::default();
        let mut left = accuracy.most_pieces.max(pieces.len());
        for _ in 0..MOST_HALVINGS {
            left = left.saturating_sub(pieces.len());
            let measured: Vec<Estimate> = pieces.par_iter().map(measure).collect();
            let mut open = Vec::new();
            for (piece, estimate) in pieces.iter().zip(&measured) {
                if left >= 2 * (open.len() + 1) && limits.are_passed_by(piece, estimate) {
                    open.push(*piece);
                } else {
                    total.add(estimate);
                }
            }
            pieces = open.iter().flat_map(Tetrahedron::halves).collect();
            if pieces.is_empty() {
                break;
            }
        }
        pieces.iter().for_each(|piece| total.add(&measure(piece)));
        total.total().translated(&self.apex.coords)
    }

    /// Returns the cones over triangles, relative to the apex.
    pub(super) fn cones(&self, triangles: &'a [[u32; 3]]) -> impl Iterator<Item = Tetrahedron> {
        let vertices = self.mesh.vertices();
        triangles.iter().map(|triangle| {
            let [a, b, c] = triangle.map(|vertex| vertices[vertex as usize] - self.apex);
            Tetrahedron([Vector::zeros(), a, b, c])
        })
    }

    /// Adds up all cones in blocks, and moves the sum to the model's origin.
    fn sum(&self, add: impl Fn(&mut MomentSum, &Tetrahedron) + Sync) -> Moments {
        let block = |triangles: &'a [[u32; 3]]| {
            let mut sum = MomentSum::default();
            self.cones(triangles).for_each(|cone| add(&mut sum, &cone));
            sum.total()
        };
        let triangles = self.mesh.triangles();
        let blocks: Vec<Moments> = triangles.par_chunks(BLOCK).map(block).collect();
        let mut total = MomentSum::default();
        blocks.iter().for_each(|block| total.add(block));
        total.total().translated(&self.apex.coords)
    }

    /// Calls `visit` with every piece between the planes.
    fn split(&self, cone: &Tetrahedron, kinks: &[Plane], visit: &mut impl FnMut(&Tetrahedron)) {
        let Some((kink, rest)) = kinks.split_first() else {
            visit(cone);
            return;
        };
        let at_apex = kink.distance(&self.apex);
        let heights = cone.0.map(|corner| kink.normal.dot(&corner) + at_apex);
        for piece in Split::new(cone, heights).pieces() {
            self.split(piece, rest, visit);
        }
    }

    /// Returns the errors that are allowed.
    pub(super) fn limits(&self, ratio: f64, pieces: usize) -> Limits {
        let cones = self.cones(self.mesh.triangles());
        let volume_mm3: f64 = cones.map(|cone| cone.volume_mm3().abs()).sum();
        let reach = self.cones(self.mesh.triangles()).flat_map(|cone| cone.0);
        let length_mm = reach.map(|corner| corner.norm()).fold(0.0, f64::max);
        Limits {
            volume_mm3,
            length_mm,
            ratio,
            least_share: 1.0 / pieces.max(1) as f64,
        }
    }
}

/// The largest errors of pieces.
pub(super) struct Limits {
    volume_mm3: f64,
    length_mm: f64,
    ratio: f64,
    /// Share of the whole error that each piece may have, however small it is.
    least_share: f64,
}

impl Limits {
    /// Returns true if a piece has more error than its share.
    fn are_passed_by(&self, piece: &Tetrahedron, estimate: &Estimate) -> bool {
        self.are_passed(piece.volume_mm3().abs(), &estimate.error)
    }

    /// Returns true if a piece of this volume, mm³, has more error than its share.
    pub fn are_passed(&self, volume_mm3: f64, error: &Moments) -> bool {
        let share = (volume_mm3 / self.volume_mm3).max(0.1 * self.least_share);
        let allowed = self.ratio * share * self.volume_mm3;
        let errors = error.0.iter().zip(DEGREES);
        let passes = |(error, degree): (&f64, i32)| *error > allowed * self.length_mm.powi(degree);
        volume_mm3 > 0.0 && errors.into_iter().any(passes)
    }
}

/// Degrees of the ten monomials.
const DEGREES: [i32; 10] = [0, 1, 1, 1, 2, 2, 2, 2, 2, 2];

/// A compensated sum of estimates.
#[derive(Default)]
pub(super) struct EstimateSum {
    moments: MomentSum,
    error: MomentSum,
}

impl EstimateSum {
    pub fn add(&mut self, estimate: &Estimate) {
        self.moments.add(&estimate.moments);
        self.error.add(&estimate.error);
    }

    pub fn total(&self) -> Estimate {
        Estimate {
            moments: self.moments.total(),
            error: self.error.total(),
        }
    }
}

/// Returns the absolute values of moments.
pub(super) fn absolute(moments: &Moments) -> Moments {
    Moments(moments.0.map(f64::abs))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mass::moments_of_mesh;
    use crate::mesh::primitives::{ball, cuboid};

    fn assert_same(got: &Moments, want: &Moments, ratio: f64) {
        let size = want.second().trace() / want.volume();
        for ((got, want_each), degree) in got.0.iter().zip(want.0).zip(DEGREES) {
            let scale = want.volume() * size.sqrt().powi(degree);
            assert!(
                (got - want_each).abs() <= ratio * scale,
                "{got} {want_each}"
            );
        }
    }

    #[test]
    fn a_uniform_density_gives_the_moments_of_the_mesh_times_the_density() {
        let mesh = ball(&Point::new(3.0, -2.0, 7.0), 5.0, 3);
        let got = Cones::from_middle(&mesh).linear(|_| 0.4);
        assert_same(&got, &(moments_of_mesh(&mesh) * 0.4), 1e-14);
    }

    #[test]
    fn any_apex_gives_the_same_ten_moments() {
        let mesh = ball(&Point::new(3.0, -2.0, 7.0), 50.0, 3);
        let density = |at: &Point| 1.0 + 0.004 * at.x - 0.002 * at.y + 0.003 * at.z;
        let near = Cones::from_middle(&mesh).linear(density);
        let kinks = [Plane::through(
            &Point::new(1.0, 2.0, 3.0),
            &Vector::new(1.0, 2.0, 2.0),
        )];
        let bent = |at: &Point| {
            if kinks[0].distance(at) > 0.0 {
                0.9
            } else {
                density(at)
            }
        };
        let near_bent = Cones::from_middle(&mesh).piecewise(&kinks, 1, bent);
        for apex in [[0.0, 0.0, 0.0], [53.0, -2.0, 7.0], [300.0, -50.0, 20.0]] {
            let cones = Cones::new(&mesh, Point::from(apex));
            assert_same(&cones.linear(density), &near, 1e-11);
            assert_same(&cones.piecewise(&kinks, 1, bent), &near_bent, 1e-11);
        }
    }

    #[test]
    fn a_density_that_jumps_at_a_plane_is_two_boxes() {
        let box_between =
            |low: f64, high: f64| cuboid(&Point::new(0.0, 0.0, low), &Point::new(4.0, 3.0, high));
        let kink = Plane {
            normal: Vector::z(),
            offset_mm: 2.5,
        };
        let step = |at: &Point| if at.z < 2.5 { 0.25 } else { 1.0 };
        let mesh = box_between(0.0, 6.0);
        let got = Cones::from_middle(&mesh).piecewise(&[kink], 0, step);
        let want = moments_of_mesh(&box_between(0.0, 2.5)) * 0.25
            + moments_of_mesh(&box_between(2.5, 6.0));
        assert_same(&got, &want, 1e-14);
    }

    #[test]
    fn an_estimate_keeps_its_accuracy_and_admits_its_error() {
        let mesh = ball(&Point::new(1.0, 2.0, 3.0), 10.0, 2);
        let density = |at: &Point| (0.1 * at.x + 0.05 * at.y).exp();
        let cones = Cones::from_middle(&mesh);
        let fine = cones.piecewise(&[], 16, density);
        let accuracy = Accuracy {
            ratio: 1e-9,
            most_pieces: 1_000_000,
        };
        let got = cones.estimate(&[], accuracy, density);
        assert_same(&got.moments, &fine, 1e-9);
        assert!(got.error.volume() < 1e-7 * fine.volume());
        // A jump that is not named as a kink: too few pieces, so the error is large, and admitted.
        let jump = |at: &Point| if at.x + 0.3 * at.y > 1.9 { 1.0 } else { 0.0 };
        let few = Accuracy {
            ratio: 1e-9,
            most_pieces: 3000,
        };
        let got = cones.estimate(&[], few, jump);
        let kink = Plane::through(&Point::new(1.9, 0.0, 0.0), &Vector::new(1.0, 0.3, 0.0));
        let exact = cones.piecewise(&[kink], 0, jump);
        let error = (got.moments - exact).volume().abs();
        assert!(error < got.error.volume() && got.error.volume() > 1e-4 * fine.volume());
    }

    #[test]
    fn one_thread_and_three_give_the_same_bits() {
        let mesh = ball(&Point::new(1.0, 2.0, 3.0), 10.0, 4);
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap();
            pool.install(|| Cones::from_middle(&mesh).linear(|at| 1.0 + 0.01 * at.x))
        };
        assert_eq!(with(1), with(3));
    }

    #[test]
    fn no_triangles_have_no_moments() {
        let empty = TriMesh::default();
        assert_eq!(
            Cones::from_middle(&empty).linear(|_| 1.0),
            Moments::default()
        );
    }
}
