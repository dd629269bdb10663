//! Integrals over a cell in closed form: volume, centre, and the energies of both norms.
//!
//! A cell is the sum of the cones from its site to the triangles of its boundary. Six fragments
//! part it: in the one of axis k and sign s, s·xₖ is the L∞ norm of x (seen from the site). They
//! are cones of the same apex, so a fragment of a cone is the cone of the triangle's part in it.
//!
//! Source: Bukenberger and Lensch, "Tetrahedra of varying density" (2021), who integrate over the
//! fragments. That the energy is convex is ours, as its derivatives are. A fragment's side moves
//! with the site, but the norm has the same value on both of its sides. So ∂E/∂pₖ is the volume of
//! fragment −k less that of +k. The second derivative lives on the twelve sides: Σ √2 · area · ννᵀ.

use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

use super::chain::Chain;
use crate::geom::{Matrix, Point, Vector};

/// The Chebyshev energy of a cell about its site, ∫ ‖x − p‖∞.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chebyshev {
    /// The energy, mm⁴.
    pub energy: f64,
    /// Its derivative by the site, mm³.
    pub gradient: Vector,
    /// Its second derivative by the site, mm².
    pub hessian: Matrix,
}

/// The volume of a cell and its first two moments.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bulk {
    /// The volume, mm³.
    pub volume_mm3: f64,
    /// The centre of the volume, mm.
    pub center: Point,
    /// ∫ |x − p|² about the site, mm⁵.
    pub spread: f64,
}

/// A weight at a place, such as the inverse fourth power of the wished size.
pub type Weight<'a> = dyn Fn(&Point) -> f64 + Sync + 'a;

/// The corners of a fragment of a triangle are at most these many: every one of four cuts adds one.
const MOST_CORNERS: usize = 7;

/// A convex polygon, seen from the site.
#[derive(Clone, Copy)]
struct Polygon {
    corners: [Vector; MOST_CORNERS],
    /// The cut along which the edge after each corner lies; `None` for an edge of the triangle.
    edges: [Option<usize>; MOST_CORNERS],
    count: usize,
}

impl Chebyshev {
    /// Integrates the energy of a cell about `site` in the axes of `frame` (its columns).
    ///
    /// With a weight every cone has its linear interpolation: the error falls with the square of
    /// the cell's size. Without one the result is exact to rounding.
    pub fn of(cell: &Chain, site: &Point, frame: &Matrix, weight: Option<&Weight<'_>>) -> Self {
        let mut sum = Sums::default();
        let turn = frame.transpose();
        for corners in cell.triangles() {
            let seen = corners.map(|corner| turn * (corner - site));
            sum.add(&seen, &|at: &Vector| {
                weight.map_or(1.0, |weight| weight(&(site + frame * at)))
            });
        }
        Self {
            energy: sum.energy,
            gradient: frame * sum.gradient,
            hessian: frame * sum.hessian * turn,
        }
    }
}

impl Bulk {
    /// Integrates the volume of a cell and its moments about `site`.
    pub fn of(cell: &Chain, site: &Point, weight: Option<&Weight<'_>>) -> Self {
        let mut mass = 0.0;
        let mut moment = Vector::zeros();
        let mut spread = 0.0;
        let mut volume_mm3 = 0.0;
        for corners in cell.triangles() {
            let [a, b, c] = corners.map(|corner| corner - site);
            let volume = a.cross(&b).dot(&c) / 6.0;
            volume_mm3 += volume;
            let weights = |at: &Vector| weight.map_or(1.0, |weight| weight(&(site + at)));
            let at = [
                weights(&Vector::zeros()),
                weights(&a),
                weights(&b),
                weights(&c),
            ];
            let total: f64 = at.iter().sum();
            mass += 0.25 * volume * total;
            // ∫ f g of two linear functions over a tetrahedron: V/20 (Σf Σg + Σ fᵢgᵢ).
            let weighted = a * at[1] + b * at[2] + c * at[3];
            moment += 0.05 * volume * ((a + b + c) * total + weighted);
            let squares = a.norm_squared() + b.norm_squared() + c.norm_squared();
            let middle = 0.25 * total;
            spread += 0.05 * volume * middle * ((a + b + c).norm_squared() + squares);
        }
        let center = if mass == 0.0 {
            *site
        } else {
            site + moment / mass
        };
        Self {
            volume_mm3,
            center,
            spread,
        }
    }
}

/// The sums over the triangles of a cell, in the axes of its frame.
#[derive(Default)]
struct Sums {
    energy: f64,
    gradient: Vector,
    hessian: Matrix,
}

impl Sums {
    /// Adds the cone of a triangle, seen from the site.
    fn add(&mut self, corners: &[Vector; 3], weight: &dyn Fn(&Vector) -> f64) {
        for axis in 0..3 {
            for sign in [1.0, -1.0] {
                self.add_fragment(corners, axis, sign, weight);
            }
        }
    }

    /// Adds the part of a cone in one fragment, and its sides toward later axes.
    fn add_fragment(
        &mut self,
        corners: &[Vector; 3],
        axis: usize,
        sign: f64,
        weight: &dyn Fn(&Vector) -> f64,
    ) {
        let [one, other] = [(axis + 1) % 3, (axis + 2) % 3];
        let sides = [(one, 1.0), (one, -1.0), (other, 1.0), (other, -1.0)];
        let over =
            |at: &Vector, (across, toward): (usize, f64)| sign * at[axis] - toward * at[across];
        // Most triangles lie in one fragment or in two.
        let is_beyond = |side| corners.iter().all(|at| over(at, side) < 0.0);
        if sides.into_iter().any(is_beyond) {
            return;
        }
        let mut part = Polygon::of(corners);
        for (cut, side) in sides.into_iter().enumerate() {
            if part.corners[..part.count]
                .iter()
                .all(|at| over(at, side) > 0.0)
            {
                continue;
            }
            part.keep(cut, |at| over(at, side));
            if part.count < 3 {
                return;
            }
        }
        let apex = weight(&Vector::zeros());
        let height = |at: &Vector| sign * at[axis];
        let first = part.corners[0];
        for k in 1..part.count - 1 {
            let fan = [first, part.corners[k], part.corners[k + 1]];
            let volume = fan[0].cross(&fan[1]).dot(&fan[2]) / 6.0;
            let weights = fan.map(|at| weight(&at));
            let total = apex + weights.iter().sum::<f64>();
            let heights = fan.map(|at| height(&at));
            let products: f64 = heights.iter().zip(weights).map(|(h, w)| h * w).sum();
            self.energy += 0.05 * volume * (heights.iter().sum::<f64>() * total + products);
            self.gradient[axis] -= 0.25 * sign * volume * total;
        }
        for k in 0..part.count {
            // Each side is that of two fragments: it counts with the one of the earlier axis.
            let Some((across, toward)) = part.edges[k].map(|cut| sides[cut]) else {
                continue;
            };
            if across < axis {
                continue;
            }
            let mut normal = Vector::zeros();
            normal[axis] = sign;
            normal[across] = -toward;
            normal *= FRAC_1_SQRT_2;
            let [from, to] = [part.corners[k], part.corners[(k + 1) % part.count]];
            let area = 0.5 * from.cross(&to).dot(&normal);
            let mean = (apex + weight(&from) + weight(&to)) / 3.0;
            self.hessian += SQRT_2 * area * mean * normal * normal.transpose();
        }
    }
}

impl Polygon {
    fn of(corners: &[Vector; 3]) -> Self {
        let mut polygon = Self {
            corners: [Vector::zeros(); MOST_CORNERS],
            edges: [None; MOST_CORNERS],
            count: 3,
        };
        polygon.corners[..3].copy_from_slice(corners);
        polygon
    }

    /// Keeps the part in which a linear function is not negative, and marks its new edge.
    fn keep(&mut self, cut: usize, value: impl Fn(&Vector) -> f64) {
        let before = *self;
        self.count = 0;
        for k in 0..before.count {
            let [from, to] = [before.corners[k], before.corners[(k + 1) % before.count]];
            let [here, there] = [value(&from), value(&to)];
            let is_along = here == 0.0 && there <= 0.0;
            if here >= 0.0 {
                self.push(from, if is_along { Some(cut) } else { before.edges[k] });
            }
            if (here > 0.0 && there < 0.0) || (here < 0.0 && there > 0.0) {
                let crossing = from + (to - from) * (here / (here - there));
                let leaves = here > 0.0;
                self.push(crossing, if leaves { Some(cut) } else { before.edges[k] });
            }
        }
    }

    fn push(&mut self, corner: Vector, edge: Option<usize>) {
        if self.count < MOST_CORNERS {
            self.corners[self.count] = corner;
            self.edges[self.count] = edge;
            self.count += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::random::Random;
    use crate::geom::{Aabb, Plane};

    fn cube(half_mm: f64) -> Chain {
        Chain::of_box(&Aabb {
            min: Point::new(-half_mm, -half_mm, -half_mm),
            max: Point::new(half_mm, half_mm, half_mm),
        })
    }

    /// Returns a cell of random planes around the origin, and a site in it.
    fn random_cell(random: &mut Random) -> (Chain, Point) {
        let mut cell = cube(1.0);
        for _ in 0..9 {
            let mut one = || random.between(-1.0, 1.0);
            let normal = Vector::new(one(), one(), one()).normalize();
            let offset_mm = random.between(0.4, 1.2);
            cell = cell.below(&Plane { normal, offset_mm });
        }
        let mut at = || random.between(-0.15, 0.15);
        (cell, Point::new(at(), at(), at()))
    }

    fn turn(random: &mut Random) -> Matrix {
        let mut one = || random.between(-1.0, 1.0);
        let axis = Vector::new(one(), one(), one());
        nalgebra::Rotation3::new(axis).into_inner()
    }

    #[test]
    fn a_cube_has_the_energy_of_its_closed_form() {
        let side: f64 = 3.0;
        let found = Chebyshev::of(
            &cube(0.5 * side),
            &Point::origin(),
            &Matrix::identity(),
            None,
        );
        assert!((found.energy - 3.0 * side.powi(4) / 8.0).abs() < 1e-12);
        assert!(found.gradient.norm() < 1e-12);
        let expected = Matrix::identity() * 2.0 * side * side;
        assert!(
            (found.hessian - expected).norm() < 1e-12,
            "{}",
            found.hessian
        );
        let bulk = Bulk::of(&cube(0.5 * side), &Point::new(0.2, 0.1, 0.0), None);
        assert!((bulk.volume_mm3 - 27.0).abs() < 1e-12);
        assert!(bulk.center.coords.norm() < 1e-14);
        // About its middle a cube has a⁵/4, and a site beside it adds V·d².
        assert!((bulk.spread - (243.0 / 4.0 + 27.0 * 0.05)).abs() < 1e-11);
    }

    #[test]
    fn the_energy_is_that_of_shells_of_cubes() {
        // ∫ ‖x‖∞ is the integral of the volume outside of cubes of all sizes.
        let mut random = Random::new(5);
        for _ in 0..6 {
            let (cell, site) = random_cell(&mut random);
            let whole = cell.volume_mm3();
            let steps = 2000;
            let far = 2.5;
            let outside = |k: usize| {
                let reach = far * (k as f64 + 0.5) / steps as f64;
                let axes = [Vector::x(), Vector::y(), Vector::z()];
                let within = axes.iter().fold(cell.clone(), |part, axis| {
                    let [up, down] = [reach, -reach].map(|by| site + axis * by);
                    let part = part.below(&Plane::through(&up, axis));
                    part.below(&Plane::through(&down, &-axis))
                });
                whole - within.volume_mm3()
            };
            let expected = (0..steps).map(outside).sum::<f64>() * far / steps as f64;
            let found = Chebyshev::of(&cell, &site, &Matrix::identity(), None).energy;
            assert!((found / expected - 1.0).abs() < 1e-6, "{found} {expected}");
        }
    }

    #[test]
    fn derivatives_agree_with_differences_in_any_frame() {
        let mut random = Random::new(8);
        for _ in 0..20 {
            let (cell, site) = random_cell(&mut random);
            let frame = turn(&mut random);
            let at = |site: &Point| Chebyshev::of(&cell, site, &frame, None);
            let here = at(&site);
            let step = 1e-4;
            for axis in [Vector::x(), Vector::y(), Vector::z()] {
                let [up, down] = [step, -step].map(|by| at(&(site + axis * by)));
                let slope = (up.energy - down.energy) / (2.0 * step);
                assert!((slope - here.gradient.dot(&axis)).abs() < 1e-7);
                let bend = (up.gradient - down.gradient) / (2.0 * step);
                assert!((bend - here.hessian * axis).norm() < 1e-6);
            }
        }
    }

    #[test]
    fn a_linear_weight_is_integrated_exactly_for_the_volume() {
        let mut random = Random::new(2);
        let (cell, site) = random_cell(&mut random);
        let weight = |at: &Point| 2.0 + 0.3 * at.x - 0.1 * at.z;
        let plain = Bulk::of(&cell, &site, None);
        let heavy = Bulk::of(&cell, &site, Some(&weight));
        assert!((plain.volume_mm3 - heavy.volume_mm3).abs() < 1e-14);
        // ∫ w = w(centre) · V, and the weighted centre is (∫ x w) / ∫ w: cross-checked by thirds.
        let even = Bulk::of(&cell, &Point::origin(), Some(&weight));
        assert!((even.center - heavy.center).norm() < 1e-12);
    }
}
