//! What corners or cells tell of a density that varies between them.

use super::parts::Densities;
use super::volume::Tets;
use crate::geom::Vector;
use crate::mass::{Body, ConeRule, Moments, Tetrahedron};

/// The greatest step of density between places that neighbour each other.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Jump {
    /// The step.
    pub density: f64,
    /// A tetrahedron with it, from 0.
    pub cell: usize,
}

/// The sampling of a mesh's densities.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sampling {
    /// The greatest difference between corners of a tetrahedron, or between tetrahedra that share a
    /// face.
    pub jump: Jump,
    /// The estimated error: how far mass, centre and moments would be off if the density were
    /// smooth between the samples. `None` for a uniform density, or one without mass.
    pub estimate: Option<Difference>,
}

/// The difference between the mass properties of two bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Difference {
    /// Difference of the masses, as a share of the second body's.
    pub mass_ratio: f64,
    /// Distance between the centres of mass, mm.
    pub center_mm: f64,
    /// Greatest difference of a principal moment, as a share of the second body's largest.
    pub inertia_ratio: f64,
}

impl Difference {
    /// Compares two bodies by their moments; `None` if one has no mass.
    pub fn between(one: &Moments, other: &Moments) -> Option<Self> {
        if !(one.volume() > 0.0 && other.volume() > 0.0) {
            return None;
        }
        let bodies = [one, other].map(|moments| Body::new(moments, 1.0));
        let [mine, theirs] = bodies.map(|body| body.principal().moments_g_mm2);
        let off = mine.iter().zip(theirs).map(|(a, b)| (a - b).abs());
        Some(Self {
            mass_ratio: (one.volume() / other.volume() - 1.0).abs(),
            center_mm: (bodies[0].center - bodies[1].center).norm(),
            inertia_ratio: off.fold(0.0, f64::max) / theirs[2],
        })
    }
}

impl Sampling {
    /// Measures the jumps, and estimates what lies between the samples.
    ///
    /// Densities at corners: gradients are averaged there (Zienkiewicz and Zhu, "A simple error
    /// estimator", IJNME 24, 1987). Their change is the curvature of the density, and what it would
    /// add is integrated. Densities of cells: they are compared with the linear density that has
    /// their averages at the corners.
    pub fn of(tets: &Tets) -> Self {
        let moments = tets.moments();
        match tets.densities() {
            Densities::Solid => Self {
                jump: Jump::default(),
                estimate: None,
            },
            Densities::Corners(_) => Self {
                jump: jump_in_cells(tets),
                estimate: Difference::between(&(moments + curvature_moments(tets)), &moments),
            },
            Densities::Cells(values) => {
                let smooth = at_corners(tets, |cell| values[cell]);
                let smooth = tets
                    .moments_with(|cell| tets.cells()[cell].map(|corner| smooth[corner as usize]));
                Self {
                    jump: jump_between_cells(tets, values),
                    estimate: Difference::between(&smooth, &moments),
                }
            }
        }
    }
}

fn greatest(jumps: impl Iterator<Item = Jump>) -> Jump {
    jumps.fold(Jump::default(), |most, jump| {
        if jump.density > most.density {
            jump
        } else {
            most
        }
    })
}

fn jump_in_cells(tets: &Tets) -> Jump {
    greatest((0..tets.cells().len()).map(|cell| {
        let values = tets.densities_of(cell);
        let least = values.into_iter().fold(f64::INFINITY, f64::min);
        let most = values.into_iter().fold(f64::NEG_INFINITY, f64::max);
        let density = most - least;
        Jump { density, cell }
    }))
}

fn jump_between_cells(tets: &Tets, values: &[f64]) -> Jump {
    let pairs = tets.neighbours().iter();
    greatest(pairs.map(|pair| {
        let [cell, other] = pair.map(|cell| cell as usize);
        let density = (values[cell] - values[other]).abs();
        Jump { density, cell }
    }))
}

/// Averages a value of each tetrahedron at the vertices, weighted by volume.
fn at_corners<T>(tets: &Tets, value: impl Fn(usize) -> T) -> Vec<T>
where
    T: Copy + Default + std::ops::AddAssign + std::ops::Mul<f64, Output = T>,
{
    let mut sums = vec![(T::default(), 0.0); tets.vertices().len()];
    for (cell, corners) in tets.cells().iter().enumerate() {
        let volume = tets.tetrahedron(cell).volume_mm3();
        let value = value(cell);
        for &corner in corners {
            let (sum, weight) = &mut sums[corner as usize];
            *sum += value * volume;
            *weight += volume;
        }
    }
    let mean = |(sum, weight): (T, f64)| sum * if weight > 0.0 { weight.recip() } else { 0.0 };
    sums.into_iter().map(mean).collect()
}

/// Returns the moments that a density with the curvature of the samples has more than the linear
/// one.
///
/// A quadratic f differs from its linear interpolation by −½ Σ λᵢλⱼ eᵀHe over the edges e. There He
/// is the change of the gradient along the edge.
fn curvature_moments(tets: &Tets) -> Moments {
    let gradients = at_corners(tets, |cell| {
        gradient(&tets.tetrahedron(cell), tets.densities_of(cell))
    });
    // λᵢλⱼ times second moments: degree 4.
    let rule = ConeRule::of_degree(4);
    let middle = tets.middle().coords;
    let mut sum = Moments::default();
    for (cell, corners) in tets.cells().iter().enumerate() {
        let tetrahedron = Tetrahedron(tets.tetrahedron(cell).0.map(|corner| corner - middle));
        let slopes = corners.map(|corner| gradients[corner as usize]);
        sum += bubble_moments(&tetrahedron, &slopes, &rule);
    }
    sum.translated(&middle)
}

fn bubble_moments(tetrahedron: &Tetrahedron, slopes: &[Vector; 4], rule: &ConeRule) -> Moments {
    let corners = &tetrahedron.0;
    let volume = tetrahedron.volume_mm3();
    let mut sum = Moments::default();
    for node in rule.nodes() {
        let [l, m, n] = node.shares;
        let shares = [1.0 - l - m - n, l, m, n];
        let (mut density, mut at) = (0.0, Vector::zeros());
        for i in 0..4 {
            at += corners[i] * shares[i];
            for j in 0..i {
                let bend = (slopes[i] - slopes[j]).dot(&(corners[i] - corners[j]));
                density -= 0.5 * shares[i] * shares[j] * bend;
            }
        }
        sum += Moments(Moments::monomials(at.x, at.y, at.z)) * (density * node.weight * volume);
    }
    sum
}

/// Returns the gradient of the density that is linear between four corners, 1/mm.
fn gradient(Tetrahedron([o, a, b, c]): &Tetrahedron, values: [f64; 4]) -> Vector {
    let (a, b, c) = (a - o, b - o, c - o);
    let six_volumes = a.dot(&b.cross(&c));
    let [at_o, at_a, at_b, at_c] = values;
    let sum =
        b.cross(&c) * (at_a - at_o) + c.cross(&a) * (at_b - at_o) + a.cross(&b) * (at_c - at_o);
    sum / six_volumes
}
