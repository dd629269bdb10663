//! Integrates a density over a solid, and says the error.

use super::cells::{Fading, Limits, over_cells};
use super::density::{Density, Form, OfDepth};
use crate::geom::{Point, Vector};
use crate::mass::{Accuracy, Cones, Estimate, Moments, moments_of_mesh};
use crate::mesh::TriMesh;

/// Accuracy of densities whose integrals along rays are known.
const ALONG_RAYS: Accuracy = Accuracy {
    ratio: 1e-9,
    most_pieces: 1_000_000,
};
/// Accuracy of other densities. Each evaluation may ask for a distance, so pieces are few.
const BY_PIECES: Accuracy = Accuracy {
    ratio: 1e-6,
    most_pieces: 40_000,
};
/// Accuracy of functions of the depth, whose points each ask for a distance.
const BY_CELLS: Limits = Limits {
    ratio: 1e-5,
    most_points: 600_000,
};

/// The moments of a solid with a density, and their error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// The moments in the model's coordinates, mm³ to mm⁵ of solid material.
    pub moments: Moments,
    /// The error of each moment, by the difference of two rules; zero if only rounding is left.
    pub error: Moments,
}

/// Integrates a density over the region that a closed, oriented mesh bounds.
///
/// Polynomials between planes are exact up to rounding, about 1e-14. Others are refined until two
/// quadrature rules agree, or as far as about a second of work goes; `error` says how far that was.
/// Bitwise the same for any number of threads.
pub fn measure(mesh: &TriMesh, density: &dyn Density) -> Measured {
    let found = estimate(mesh, density);
    Measured {
        moments: found.moments,
        error: found.error,
    }
}

fn estimate(mesh: &TriMesh, density: &dyn Density) -> Estimate {
    let cones = Cones::from_middle(mesh);
    match density.form() {
        Form::Piecewise { kinks, degree } if kinks.is_empty() && degree <= 1 => {
            Estimate::exact(cones.linear(|at| density.at(at)))
        }
        Form::Piecewise { kinks, degree } => {
            Estimate::exact(cones.piecewise(&kinks, degree, |at| density.at(at)))
        }
        Form::Rays { apex, rays } => {
            let cones = Cones::new(mesh, apex.unwrap_or(cones.apex()));
            cones.along_rays(ALONG_RAYS, |ray| rays.integrals(&cones.apex(), ray))
        }
        Form::Sum(parts) => {
            let parts = parts.iter().map(|part| estimate(mesh, part.as_ref()));
            parts.fold(Estimate::default(), |sum, part| sum.plus(&part))
        }
        Form::Depth(skin) => of_depth(mesh, skin),
        Form::Any { kinks } => cones.estimate(&kinks, BY_PIECES, |at| density.at(at)),
    }
}

/// Integrates a function of the depth: the whole at its value on the surface, less what fades in
/// below.
fn of_depth(mesh: &TriMesh, skin: &dyn OfDepth) -> Estimate {
    let on_surface = skin.of_depth(0.0);
    let fading = Fading {
        depth_mm: &|at| skin.depth_mm(at),
        value: &|depth_mm| on_surface - skin.of_depth(depth_mm.max(0.0)),
        constant_from_mm: skin.constant_from_mm(),
    };
    let whole = Estimate::exact(moments_of_mesh(mesh) * on_surface);
    whole.plus(&over_cells(&mesh.aabb(), &fading, &BY_CELLS).times(-1.0))
}

impl Measured {
    /// Returns the error of the mass, as a share of it; infinite for a body without mass.
    pub fn mass_error_ratio(&self) -> f64 {
        if self.error.volume() == 0.0 {
            return 0.0;
        }
        self.error.volume() / self.moments.volume().abs()
    }

    /// Returns the centre of mass, mm; `None` for a body without mass.
    pub fn center(&self) -> Option<Point> {
        let center = self.moments.centroid();
        (self.moments.volume() > 0.0 && center.coords.iter().all(|c| c.is_finite()))
            .then_some(center)
    }

    /// Returns the largest error of the centre along an axis, mm; `None` for a body without mass.
    pub fn center_error_mm(&self) -> Option<f64> {
        let center = self.center()?;
        let volume = self.moments.volume();
        // |δ(s/m)| ≤ (|δs| + |c| |δm|)/m, about the centre of mass.
        let about = self.error.first() + center.coords.abs() * self.error.volume();
        let error: Vector = about / volume;
        Some(error.max())
    }

    /// Returns the largest error of a principal moment about the centre of mass, as a share of the
    /// largest moment; `None` for a body without mass.
    pub fn inertia_error_ratio(&self) -> Option<f64> {
        let center = self.center()?.coords;
        let error = self.error.translated(&center.abs()).second().trace();
        let central = self.moments.translated(&-center).second();
        // I = tr(S)·1 − S, whose largest eigenvalue is at least two thirds of tr(S).
        let largest = central.trace() - central.symmetric_eigenvalues().min();
        (largest > 0.0).then(|| 2.0 * error / largest)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Clamped, DensityRange, Levels, Product, Ramp, Sine, Skin, Sum, Uniform};
    use super::super::{Linear, Profile};
    use super::*;
    use crate::geom::Quadric;
    use crate::mass::moments_of_mesh;
    use crate::mesh::Solid;
    use crate::mesh::primitives::{ball, cuboid};

    fn assert_close(got: f64, want: f64, tolerance: f64) {
        assert!(
            (got - want).abs() <= tolerance * want.abs().max(1.0),
            "{got} {want}"
        );
    }

    #[test]
    fn a_sine_about_the_middle_of_a_ball_has_its_textbook_mass() {
        // ∫ 4πr² (1 + sin kr)/2 dr; the ball is an inscribed polyhedron, so it is compared with
        // one whose facets are a hundredth as high.
        let (radius, wave) = (10.0, 40.0);
        let mesh = ball(&Point::origin(), radius, 6);
        let field = Sine::new(Point::origin(), wave, [0.0, 1.0]).unwrap();
        let k = std::f64::consts::TAU / wave;
        let kr = k * radius;
        let wave_part = (2.0 * kr * kr.sin() + (2.0 - kr * kr) * kr.cos() - 2.0) / k.powi(3);
        let want = 2.0 * std::f64::consts::PI * (radius.powi(3) / 3.0 + wave_part);
        assert_close(measure(&mesh, &field).moments.volume(), want, 1e-3);
    }

    #[test]
    fn a_sine_centred_on_the_surface_has_an_answer() {
        let mesh = ball(&Point::new(5.0, 0.0, 0.0), 10.0, 4);
        let corner = mesh.vertices()[7];
        let [a, b, c] = mesh.iter_corners().next().unwrap();
        let on_face = Point::from((a.coords + b.coords + c.coords) / 3.0);
        for center in [corner, on_face] {
            let field = Sine::new(center, 8.0, [0.1, 1.0]).unwrap();
            let got = measure(&mesh, &field);
            let beside = Sine::new(center + Vector::new(1e-7, 1e-7, 0.0), 8.0, [0.1, 1.0]).unwrap();
            let want = measure(&mesh, &beside);
            assert!(got.moments.0.iter().all(|m| m.is_finite()));
            assert_close(got.moments.volume(), want.moments.volume(), 1e-6);
            assert!(got.mass_error_ratio() < 1e-8, "{}", got.mass_error_ratio());
        }
    }

    #[test]
    fn a_field_without_mass_has_no_centre_and_nothing_that_is_not_a_number() {
        let mesh = cuboid(&Point::origin(), &Point::new(1.0, 2.0, 3.0));
        let got = measure(&mesh, &Uniform(0.0));
        assert_eq!((got.center(), got.center_error_mm()), (None, None));
        assert_eq!(
            (got.moments, got.mass_error_ratio()),
            (Moments::default(), 0.0)
        );
    }

    #[test]
    fn levels_of_a_ball_are_balls() {
        // q = x² + y² + z²: two shells within a cube.
        let mesh = cuboid(&Point::new(-5.0, -6.0, -7.0), &Point::new(5.0, 6.0, 7.0));
        let quadric = Quadric([0., 0., 0., 0., 0., 0., 0., 1., 1., 1.]);
        let field = Levels::new(quadric, vec![4.0, 16.0], vec![1.0, 0.5, 0.2]).unwrap();
        let got = measure(&mesh, &field);
        let ball = |r: f64| 4.0 / 3.0 * std::f64::consts::PI * r.powi(3);
        let want = 0.2 * 10.0 * 12.0 * 14.0 + 0.3 * ball(4.0) + 0.5 * ball(2.0);
        assert_close(got.moments.volume(), want, 1e-8);
        let second = |r: f64| 4.0 / 15.0 * std::f64::consts::PI * r.powi(5);
        let want = 0.2 * 1680.0 * 100.0 / 12.0 + 0.3 * second(4.0) + 0.5 * second(2.0);
        assert_close(got.moments.0[7], want, 1e-8);
    }

    #[test]
    fn a_clamped_plane_is_a_ramp() {
        let mesh = ball(&Point::new(1.0, 2.0, 3.0), 10.0, 3);
        // 0.5 − q with q = (z − 3)/20 between 0.3 and 0.7.
        let quadric = Quadric([-0.15, 0., 0., 0.05, 0., 0., 0., 0., 0., 0.]);
        let range = DensityRange::new(0.3, 0.7).unwrap();
        let got = measure(&mesh, &Clamped::new(quadric, 0.5, range)).moments;
        let ramp = Ramp::new(&Vector::z(), [-1.0, 7.0], [0.7, 0.3]).unwrap();
        let want = measure(&mesh, &ramp).moments;
        for (got, want) in got.0.iter().zip(want.0) {
            assert!((got - want).abs() < 1e-7 * 4e3 * 100.0, "{got} {want}");
        }
        assert_close(got.volume(), want.volume(), 1e-8);
    }

    #[test]
    fn sums_and_products_of_polynomials_between_planes_are_exact() {
        let mesh = cuboid(&Point::origin(), &Point::new(2.0, 2.0, 2.0));
        let ramp = || Box::new(Ramp::new(&Vector::x(), [0.5, 1.5], [0.0, 1.0]).unwrap());
        let line = Linear {
            at_origin: 1.0,
            gradient: Vector::new(0.0, 0.5, 0.0),
        };
        let product = Product(vec![ramp(), Box::new(line)]);
        // Means over the cube: ½ for the ramp, 1.5 for the line.
        let got = measure(&mesh, &product);
        assert_close(got.moments.volume(), 8.0 * 0.75, 1e-14);
        let sum = Sum(vec![Box::new(Uniform(0.25)), Box::new(product), ramp()]);
        let got = measure(&mesh, &sum);
        assert_close(got.moments.volume(), 8.0 * (0.25 + 0.75 + 0.5), 1e-14);
        assert_eq!(got.error, Moments::default());
    }

    #[test]
    fn the_skin_of_a_cube_has_its_closed_form() {
        // A cube of side 2a: the share of the volume deeper than t is (1 − t/a)³.
        let mesh = cuboid(&Point::new(-5.0, -5.0, -5.0), &Point::new(5.0, 5.0, 5.0));
        let solid = Solid::new(mesh).unwrap();
        let field = Skin::new(&solid, 5.0, Profile::Linear, [0.2, 1.0]).unwrap();
        let got = measure(solid.mesh(), &field);
        // Mean depth of the cube: a/4.
        let want = 1000.0 * (1.0 - 0.8 * 0.25);
        assert!((got.moments.volume() - want).abs() <= got.error.volume().max(1e-9));
        assert!(
            (got.moments.volume() / want - 1.0).abs() < 5e-5,
            "{}",
            got.moments.volume()
        );
        assert!(got.mass_error_ratio() < 3e-4, "{}", got.mass_error_ratio());
        let uniform = moments_of_mesh(solid.mesh()).volume();
        assert_close(uniform, 1000.0, 1e-14);
    }
}
