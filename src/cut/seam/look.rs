//! The look of a surface: how visible, how detailed and how hollow it is at points spread over it.

use rayon::prelude::*;

use crate::{
    base::watch::{Cancelled, Watch},
    geom::{Bvh, Point, Vector},
    mesh::{SurfacePoint, TriMesh, spread_points},
};

/// Number of points that stand for the outside. On a figure they lie 2 % of its diagonal apart.
const SAMPLES: usize = 5000;
/// Number of directions from which each point is looked at. With half as many, the visible share of
/// a flank varies by a tenth.
const DIRECTIONS: usize = 64;
/// Start of a line of sight above the surface, in diagonals. It clears the facets of a coarse mesh.
const LIFT_RATIO: f64 = 1e-3;
/// Sine of the lowest elevation from which an object on a table is looked at: 12° below level.
const LOWEST_SINE: f64 = -0.2;
/// Radii about a point in which detail is measured, in diagonals. Eyes and fingers are as large as
/// the first, brows, ears and hands as the second.
const DETAIL_RATIOS: [f64; 2] = [0.03, 0.06];
/// Spread of the normals in a detailed place. On a ball as large as the radius it is about a
/// quarter, on a smooth flank less than 0.05.
const FULL_DETAIL: f64 = 0.15;
/// Weight of a place without any detail.
const PLAIN_WEIGHT: f64 = 0.25;
/// Depth of a hollow that hides a seam, over the radius: a groove with flanks of about 20°.
const FULL_HOLLOW: f64 = 0.12;
/// Share of the price that a full hollow takes away. A step in a crease looks like a fold.
const HOLLOW_DISCOUNT: f64 = 0.6;
/// Weights at the lowest and at the highest point. Who looks at an object on a table looks at its
/// upper half, and so does a face look out from there.
const HEIGHT_WEIGHTS: [f64; 2] = [0.3, 1.7];
/// Radius over which weights are averaged, in diagonals: half a face. A seam beside the eyes mars a
/// face, too.
const SMOOTHING_RATIO: f64 = 0.1;
/// Cosine below which a neighbour belongs to the other side of a thin wall, such as an ear.
const OTHER_SIDE_COSINE: f64 = -0.5;

/// A point of the outside with its look.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sample {
    pub(crate) at: Point,
    /// The outward unit normal.
    pub(crate) normal: Vector,
    /// The price of a seam there; 1 on average over the outside.
    pub(crate) weight: f64,
    /// The depth of the hollow in which it lies, 0 to 1.
    pub(crate) hollow_ratio: f64,
}

/// Looks at the outside of a model that stands with this direction up.
///
/// A seam costs by how visible, how detailed and how high the surface is, and less in a hollow.
/// Visibility is the share of open directions, each weighted by how high it is. The source is
/// Zhukov, Iones and Kronin, "An ambient light illumination model", Rendering Techniques 1998.
/// Detail is the spread of the normals nearby, at two scales. Takes about 0.3 s on 100 000
/// triangles.
///
/// # Errors
/// The watch was stopped.
pub(crate) fn look(outer: &TriMesh, up: &Vector, watch: &Watch) -> Result<Vec<Sample>, Cancelled> {
    let corners: Vec<[Point; 3]> = outer.iter_corners().collect();
    let points = spread_points(&corners, SAMPLES);
    let normal = |point: &SurfacePoint| {
        let [a, b, c] = corners[point.triangle];
        let unit = (b - a).cross(&(c - a)).try_normalize(f64::MIN_POSITIVE);
        unit.unwrap_or_else(Vector::zeros)
    };
    let bare = |point: &SurfacePoint| Sample {
        at: point.at,
        normal: normal(point),
        weight: 1.0,
        hollow_ratio: 0.0,
    };
    let bare: Vec<Sample> = points.iter().map(bare).collect();
    let eyes = Eyes::new(outer, up);
    let smoothing_mm = SMOOTHING_RATIO * eyes.size_mm;
    let neighbours = neighbours(&bare, smoothing_mm, watch)?;
    let raw = bare.par_iter().zip(&neighbours).map(|(sample, near)| {
        watch.check()?;
        let near: Vec<&Sample> = near.iter().map(|&index| &bare[index as usize]).collect();
        Ok(eyes.judge(sample, &near))
    });
    let raw = raw.collect::<Result<Vec<Sample>, Cancelled>>()?;
    Ok(smoothed(&raw, &neighbours))
}

/// The eyes of those who look at the object.
struct Eyes {
    outside: Bvh,
    size_mm: f64,
    up: Vector,
    lowest_mm: f64,
    highest_mm: f64,
    /// Directions to the eyes, with their weights in the length.
    directions: Vec<Vector>,
}

impl Eyes {
    fn new(outer: &TriMesh, up: &Vector) -> Self {
        let heights = || outer.vertices().iter().map(|point| up.dot(&point.coords));
        let directions = (0..DIRECTIONS).map(on_sphere).filter_map(|direction| {
            let weight = direction.dot(up) - LOWEST_SINE;
            (weight > 0.0).then_some(direction * weight)
        });
        Self {
            outside: Bvh::new(outer.iter_corners()),
            size_mm: outer.aabb().size().norm(),
            up: *up,
            lowest_mm: heights().fold(f64::INFINITY, f64::min),
            highest_mm: heights().fold(f64::NEG_INFINITY, f64::max),
            directions: directions.collect(),
        }
    }

    /// Returns the sample with its price before smoothing, and the hollow in which it lies.
    fn judge(&self, sample: &Sample, near: &[&Sample]) -> Sample {
        let distance = |other: &Sample| (other.at - sample.at).norm();
        let spread = |radius_ratio: f64| {
            let radius_mm = radius_ratio * self.size_mm;
            let within = near.iter().filter(|other| distance(other) <= radius_mm);
            let (count, sum) = within.fold((0.0, Vector::zeros()), |(count, sum), other| {
                (count + 1.0, sum + other.normal)
            });
            if count > 0.0 {
                1.0 - sum.norm() / count
            } else {
                0.0
            }
        };
        let detail = DETAIL_RATIOS.map(spread).iter().sum::<f64>() / DETAIL_RATIOS.len() as f64;
        let radius_mm = DETAIL_RATIOS[1] * self.size_mm;
        let within = near.iter().filter(|other| distance(other) <= radius_mm);
        let (count, rise_mm) = within.fold((0.0, 0.0), |(count, sum), other| {
            (
                count + 1.0,
                sum + (other.at - sample.at).dot(&sample.normal),
            )
        });
        let hollow_ratio = rise_mm / (f64::max(count, 1.0) * radius_mm * FULL_HOLLOW);
        let hollow_ratio = hollow_ratio.clamp(0.0, 1.0);
        let height = (self.up.dot(&sample.at.coords) - self.lowest_mm)
            / (self.highest_mm - self.lowest_mm).max(f64::MIN_POSITIVE);
        let [low, high] = HEIGHT_WEIGHTS;
        let weight = self.visible_ratio(sample)
            * (PLAIN_WEIGHT + detail / FULL_DETAIL)
            * (low + (high - low) * height);
        Sample {
            weight,
            hollow_ratio,
            ..*sample
        }
    }

    /// Returns the weighted share of the directions from which a point is seen.
    fn visible_ratio(&self, sample: &Sample) -> f64 {
        let start = sample.at + sample.normal * (LIFT_RATIO * self.size_mm);
        let is_open = |toward: &Vector| {
            let far = start + toward.normalize() * (2.0 * self.size_mm);
            sample.normal.dot(toward) > 0.0 && !self.outside.crosses_segment(&start, &far)
        };
        let open = self.directions.iter().filter(|toward| is_open(toward));
        let all: f64 = self.directions.iter().map(Vector::norm).sum();
        open.map(Vector::norm).sum::<f64>() / all.max(f64::MIN_POSITIVE)
    }
}

/// Returns the indices of the samples around each sample, itself included, on its side of a wall.
fn neighbours(
    samples: &[Sample],
    radius_mm: f64,
    watch: &Watch,
) -> Result<Vec<Vec<u32>>, Cancelled> {
    let around = samples.par_iter().map(|sample| {
        watch.check()?;
        let is_near = |other: &Sample| {
            (other.at - sample.at).norm_squared() <= radius_mm * radius_mm
                && other.normal.dot(&sample.normal) > OTHER_SIDE_COSINE
        };
        let near = (0u32..).zip(samples).filter(|(_, other)| is_near(other));
        Ok(near.map(|(index, _)| index).collect())
    });
    around.collect()
}

/// Averages the weights over the neighbours, lowers them in hollows, and scales them to 1 on
/// average.
fn smoothed(samples: &[Sample], neighbours: &[Vec<u32>]) -> Vec<Sample> {
    let mean = |(sample, near): (&Sample, &Vec<u32>)| {
        let near = near.iter().map(|&index| samples[index as usize].weight);
        let (count, sum) = near.fold((0.0, 0.0), |(count, sum), weight| {
            (count + 1.0, sum + weight)
        });
        let mean = sum / f64::max(count, 1.0);
        mean * (1.0 - HOLLOW_DISCOUNT * sample.hollow_ratio)
    };
    let means: Vec<f64> = samples.par_iter().zip(neighbours).map(mean).collect();
    let average = means.iter().sum::<f64>() / means.len().max(1) as f64;
    let scaled = |(sample, weight): (&Sample, f64)| Sample {
        weight: weight / average.max(f64::MIN_POSITIVE),
        ..*sample
    };
    samples.iter().zip(means).map(scaled).collect()
}

/// Returns direction `index` of a Fibonacci spiral over the sphere.
fn on_sphere(index: usize) -> Vector {
    let z = 1.0 - 2.0 * (index as f64 + 0.5) / DIRECTIONS as f64;
    let turn = std::f64::consts::PI * (1.0 + 5.0_f64.sqrt()) * (index as f64 + 0.5);
    let radius = (1.0 - z * z).sqrt();
    Vector::new(radius * turn.cos(), radius * turn.sin(), z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::primitives::{ball, cuboid};

    fn mean(samples: &[Sample], is_meant: impl Fn(&Sample) -> bool) -> f64 {
        let meant = samples.iter().filter(|sample| is_meant(sample));
        let (count, sum) = meant.fold((0.0, 0.0), |(count, sum), sample| {
            (count + 1.0, sum + sample.weight)
        });
        assert!(count > 9.0);
        sum / count
    }

    fn look_at(outer: &TriMesh) -> Vec<Sample> {
        look(outer, &Vector::z(), &Watch::silent()).unwrap()
    }

    #[test]
    fn the_upper_half_of_a_ball_is_seen_more_than_the_lower() {
        let samples = look_at(&ball(&Point::origin(), 10.0, 6));
        let upper = mean(&samples, |sample| sample.at.z > 5.0);
        let lower = mean(&samples, |sample| sample.at.z < -5.0);
        assert!(upper > 4.0 * lower, "{upper} {lower}");
        let all = mean(&samples, |_| true);
        assert!((all - 1.0).abs() < 1e-9, "{all}");
    }

    #[test]
    fn an_edge_is_more_detailed_than_the_middle_of_a_face() {
        let outer = cuboid(&Point::origin(), &Point::new(40.0, 40.0, 40.0));
        let samples = look_at(&outer);
        let is_inside = |sample: &Sample| {
            let middle = |x: f64| (x - 20.0).abs() < 10.0;
            sample.at.z > 39.9 && middle(sample.at.x) && middle(sample.at.y)
        };
        let edge = mean(&samples, |sample| sample.at.z > 39.9 && sample.at.x > 39.0);
        assert!(edge > 1.5 * mean(&samples, is_inside), "{edge}");
    }

    #[test]
    fn a_groove_is_hollow_and_a_flank_is_not() {
        let low = ball(&Point::origin(), 10.0, 5);
        let high = ball(&Point::new(0.0, 0.0, 17.0), 10.0, 5);
        let bodies = [&low, &high].map(|body| crate::mesh::Csg::of_mesh(body).unwrap());
        let [low, high] = bodies;
        let outer = low.union(&high).unwrap().to_mesh().unwrap();
        let samples = look_at(&outer);
        let in_groove = |sample: &&Sample| (sample.at.z - 8.5).abs() < 0.4;
        let groove = samples.iter().filter(in_groove);
        assert!(groove.clone().count() > 9);
        assert!(groove.clone().all(|sample| sample.hollow_ratio > 0.5));
        let flank = samples.iter().filter(|sample| sample.at.z.abs() < 3.0);
        assert!(flank.clone().all(|sample| sample.hollow_ratio < 0.1));
    }
}
