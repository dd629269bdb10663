//! Mirror planes, exact or nearly so, and the likeness of a model to its mirror image.
//!
//! The normal of a mirror plane is a principal axis of the surface. Where two spreads are nearly
//! equal the axes between them are tried, too. Each plane is then fitted to the pairs of points
//! that it makes. It takes a reflection where Besl and McKay take a rotation. The source is their
//! "A method for registration of 3-D shapes", IEEE TPAMI 14, 1992.

use rayon::prelude::*;

use super::shape::Shape;
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Bvh, Matrix, Point, Vector};

/// One of so many samples is mirrored. 300 of them give the mean distance to about 5 %.
const STRIDE: usize = 8;
/// The mean distance, in lengths of the model, at which a mirror image has nothing in common with
/// the model. A figure that is posed or scanned keeps within half of it.
const UNLIKE_RATIO: f64 = 0.02;
/// The mean distance up to which a plane may still be fitted; fitting gains less than a third.
const HOPELESS_RATIO: f64 = 3.0 * UNLIKE_RATIO;
/// The rounds of fitting. Each leaves about a third of the error of a nearly symmetric model.
const ROUNDS: usize = 6;
/// Spreads that differ by less than this part leave their axes undecided.
const EQUAL_RATIO: f64 = 0.15;
/// The number of normals tried between two undecided axes, every 22.5°. Fitting finds a plane from
/// 10° away.
const BETWEEN: usize = 8;
/// Planes nearer than 11° to each other are one.
const SAME_COSINE: f64 = 0.98;

/// A mirror plane of the model.
#[derive(Debug, Clone, Copy)]
pub(super) struct Mirror {
    /// Its unit normal.
    pub normal: Vector,
    /// Its strength: 1 for an exact mirror plane, 0 for none.
    pub strength_ratio: f64,
}

/// The surface, ready to be compared with its mirror images.
pub(super) struct Looking<'a> {
    shape: &'a Shape,
    surface: Bvh,
}

/// A plane by a point of it.
#[derive(Clone, Copy)]
struct Glass {
    normal: Vector,
    through: Point,
}

impl<'a> Looking<'a> {
    /// Prepares the surface: O(n log n).
    pub fn at(shape: &'a Shape) -> Self {
        let surface = Bvh::new(shape.mesh.iter_corners());
        Self { shape, surface }
    }

    /// Returns the shape looked at.
    pub fn shape(&self) -> &'a Shape {
        self.shape
    }

    /// Returns the mean distance of the mirrored surface from the surface, in lengths of the
    /// model. The plane passes through the centroid of the surface.
    pub fn unlikeness(&self, normal: &Vector) -> f64 {
        let glass = Glass {
            normal: *normal,
            through: Point::origin(),
        };
        self.mismatch(&glass, &self.pairs(&glass))
    }

    /// Returns the mirror planes of the model, the strongest first.
    pub fn mirrors(&self, watch: &Watch) -> Result<Vec<Mirror>, Cancelled> {
        let fitted = self.normals().into_par_iter().map(|normal| {
            watch.check()?;
            Ok(self.fit(normal))
        });
        let mut all = fitted.collect::<Result<Vec<Mirror>, Cancelled>>()?;
        all.retain(|mirror| mirror.strength_ratio > 0.0);
        all.sort_by(|a, b| b.strength_ratio.total_cmp(&a.strength_ratio));
        let mut mirrors: Vec<Mirror> = Vec::new();
        for mirror in all {
            let is_same = |known: &Mirror| known.normal.dot(&mirror.normal).abs() > SAME_COSINE;
            if !mirrors.iter().any(is_same) {
                mirrors.push(mirror);
            }
        }
        Ok(mirrors)
    }

    /// Returns the normals to start from: the principal axes, and more where these are undecided.
    fn normals(&self) -> Vec<Vector> {
        let axes = [Vector::x(), Vector::y(), Vector::z()];
        let [thin, middle, long] = self.shape.spreads_mm2;
        let mut normals = axes.to_vec();
        for (i, [less, more]) in [[thin, middle], [middle, long]].into_iter().enumerate() {
            let turns = if more - less < EQUAL_RATIO * more {
                1..BETWEEN
            } else {
                1..1
            };
            normals.extend(turns.map(|turn| {
                let (sin, cos) = (std::f64::consts::PI * turn as f64 / BETWEEN as f64).sin_cos();
                axes[i] * cos + axes[i + 1] * sin
            }));
        }
        normals
    }

    /// Fits a mirror plane near a normal.
    fn fit(&self, normal: Vector) -> Mirror {
        let through = Point::origin();
        let mut glass = Glass { normal, through };
        let mut pairs = self.pairs(&glass);
        for _ in 0..ROUNDS {
            if self.mismatch(&glass, &pairs) > HOPELESS_RATIO {
                break;
            }
            glass = fitted(&pairs);
            pairs = self.pairs(&glass);
        }
        Mirror {
            normal: glass.normal,
            strength_ratio: (1.0 - self.mismatch(&glass, &pairs) / UNLIKE_RATIO).max(0.0),
        }
    }

    /// Returns each sample with the point of the surface nearest to its mirror image.
    fn pairs(&self, glass: &Glass) -> Vec<[Point; 2]> {
        let samples = self.shape.samples.iter().step_by(STRIDE);
        let pair = |sample: &Point| {
            let image = glass.image(sample);
            let nearest = self.surface.closest(&image, f64::INFINITY, &[]);
            [*sample, nearest.map_or(image, |nearest| nearest.point)]
        };
        samples.map(pair).collect()
    }

    /// Returns the mean distance of the images from their nearest points, in lengths of the model.
    fn mismatch(&self, glass: &Glass, pairs: &[[Point; 2]]) -> f64 {
        let distance = |[sample, near]: &[Point; 2]| (glass.image(sample) - near).norm();
        let distances = pairs.iter().map(distance);
        distances.sum::<f64>() / (pairs.len() as f64 * self.shape.length_mm)
    }
}

impl Glass {
    fn image(&self, point: &Point) -> Point {
        point - self.normal * (2.0 * self.normal.dot(&(point - self.through)))
    }
}

/// Returns the plane that mirrors the first points x of all pairs nearest to the second points y.
///
/// The sum of squared distances is least if the normal n minimises nᵀKn. K is the symmetric part of
/// the sum of x yᵀ about the means.
fn fitted(pairs: &[[Point; 2]]) -> Glass {
    let count = pairs.len() as f64;
    let means = [0, 1].map(|i| pairs.iter().map(|pair| pair[i].coords).sum::<Vector>() / count);
    let product = |[x, y]: &[Point; 2]| (x.coords - means[0]) * (y.coords - means[1]).transpose();
    let products = pairs.iter().map(product);
    let sum: Matrix = products.sum();
    let eigen = ((sum + sum.transpose()) * 0.5).symmetric_eigen();
    let normal: Vector = eigen.eigenvectors.column(eigen.eigenvalues.imin()).into();
    let through = Point::from((means[0] + means[1]) * 0.5);
    Glass { normal, through }
}
