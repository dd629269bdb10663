//! The outside as points with prices, and the price of a seam.

use crate::{
    base::watch::{Cancelled, Watch},
    cut::seam::look::{Sample, look},
    geom::{Plane, Point, Vector},
    mesh::TriMesh,
};

/// Half the thickness of the slice whose points stand for a seam, in diagonals: a point for each
/// 2 % of its length.
const SLICE_RATIO: f64 = 0.012;
/// Distance over which the points about a place are averaged, in diagonals.
const REACH_RATIO: f64 = 0.015;
/// Length of a step along a seam, in diagonals.
const STEP_RATIO: f64 = 0.01;
/// Angle from level or upright that nobody sees, degrees.
const UNSEEN_SLANT_DEG: f64 = 2.0;
/// Angle from level or upright at which a cut is plainly slanted, degrees.
const PLAIN_SLANT_DEG: f64 = 15.0;
/// Price of a plainly slanted cut, in circles of average weight: that of a seam at a waist.
const SLANT_PRICE: f64 = 0.2;
/// Distance to both sides of a neck at which the body is compared with it, in diagonals.
const NECK_REACH_RATIO: f64 = 0.05;
/// Share by which the outline is longer on both sides of a neck. Necks of the shared figures have a
/// half and more; a slant across shoulder and armpit has a quarter.
const NECK_GROWTH_RATIO: f64 = 0.4;
/// Greatest length of a seam about a neck, in circles about the model. Necks of the shared figures
/// have less than a quarter, a cut across a head more.
const NECK_LENGTH_RATIO: f64 = 0.25;
/// Share of a seam in hollows with which it runs along a crease.
const CREASE_SHARE: f64 = 0.4;
/// Height up to which what looks down is the sole of a foot, in heights of the body. It is a
/// millimetre of a figure of 100 mm.
const SOLE_RATIO: f64 = 0.01;
/// Cosine to up below which a surface looks down: 45°.
const SOLE_COSINE: f64 = -std::f64::consts::FRAC_1_SQRT_2;
/// Weight of a seam across a sole. A step of the joint there rocks the object, so such a cut is
/// dearer than one through a face. A seam of 2 % of the diagonal costs a third of a circle about
/// the model.
const SOLE_WEIGHT: f64 = 50.0;
/// Height up to which a cut follows the base, in heights of the body.
const BASE_RATIO: f64 = 0.2;

/// The outside of a model, looked at.
#[derive(Debug)]
pub struct Skin {
    samples: Vec<Sample>,
    /// The area for which each sample stands, mm².
    share_mm2: f64,
    /// The diagonal of the box, mm.
    size_mm: f64,
    up: Vector,
    lowest_mm: f64,
    highest_mm: f64,
}

/// The lie of a cut in the object's own frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SeamLie {
    /// Level.
    Level,
    /// Upright.
    Upright,
    /// Slanted along a neck, where the body is thinner than on both sides.
    AlongNeck,
    /// Slanted along a crease.
    AlongCrease,
    /// Slanted along the base.
    AlongBase,
    /// Slanted, with nothing that explains it.
    Slanted,
}

impl Skin {
    /// Looks at the outside of a model that stands with this unit direction up.
    ///
    /// # Errors
    /// The watch was stopped.
    pub(crate) fn of(outer: &TriMesh, up: &Vector, watch: &Watch) -> Result<Self, Cancelled> {
        let samples = look(outer, up, watch)?;
        let heights = || outer.vertices().iter().map(|point| up.dot(&point.coords));
        let area_mm2: f64 = outer
            .iter_corners()
            .map(|[a, b, c]| (b - a).cross(&(c - a)).norm() / 2.0)
            .sum();
        Ok(Self {
            share_mm2: area_mm2 / samples.len().max(1) as f64,
            samples,
            size_mm: outer.aabb().size().norm(),
            up: *up,
            lowest_mm: heights().fold(f64::INFINITY, f64::min),
            highest_mm: heights().fold(f64::NEG_INFINITY, f64::max),
        })
    }

    /// Returns the outside with dear seams across the soles of its feet, for this direction up.
    pub(crate) fn sparing_feet(&self, up: &Vector) -> Self {
        let height = |sample: &Sample| up.dot(&sample.at.coords);
        let ends = self.samples.iter().map(height);
        let [low, high] = ends.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| {
            [low.min(at), high.max(at)]
        });
        let ground_mm = low + SOLE_RATIO * (high - low);
        let samples = self.samples.iter().map(|sample| {
            let is_sole = height(sample) <= ground_mm && sample.normal.dot(up) < SOLE_COSINE;
            Sample {
                weight: if is_sole { SOLE_WEIGHT } else { sample.weight },
                ..*sample
            }
        });
        Self {
            samples: samples.collect(),
            ..*self
        }
    }

    /// Returns up, as it was looked at.
    pub(crate) fn up(&self) -> Vector {
        self.up
    }

    /// Returns the weight of what is seen about a place; 1 on average over the outside.
    pub(crate) fn weight_at(&self, at: &Point) -> f64 {
        let samples: Vec<&Sample> = self.samples.iter().collect();
        Held::default().weight(&samples, at, REACH_RATIO * self.size_mm)
    }

    /// Estimates the price of a plane's seam, in circles about the model of average weight.
    ///
    /// The length of a section is the integral over the surface of the sine between the two
    /// normals, in a thin slice (the coarea formula; Federer, "Curvature measures", Trans. AMS 93,
    /// 1959). Takes some microseconds.
    pub(crate) fn estimate_ratio(&self, plane: &Plane) -> f64 {
        self.sum_over_slice(plane, |sample| sample.weight)
    }

    /// Returns an integral over a plane's seam, in circles about the model.
    fn sum_over_slice(&self, plane: &Plane, value: impl Fn(&Sample) -> f64) -> f64 {
        let half_mm = SLICE_RATIO * self.size_mm;
        let inside = self.samples.iter();
        let inside = inside.filter(|sample| plane.distance(&sample.at).abs() < half_mm);
        let sine = |sample: &Sample| {
            let cosine = plane.normal.dot(&sample.normal);
            (1.0 - cosine * cosine).max(0.0).sqrt()
        };
        let sum: f64 = inside.map(|sample| value(sample) * sine(sample)).sum();
        sum * self.share_mm2 / (2.0 * half_mm) / self.circle_mm()
    }

    /// Returns the length of the circle about the model, mm.
    fn circle_mm(&self) -> f64 {
        std::f64::consts::PI * self.size_mm
    }

    /// Measures the price of the seam along the segments of a plane's section, in circles about the
    /// model of average weight.
    pub(crate) fn price_ratio(
        &self,
        plane: &Plane,
        segments: impl Iterator<Item = [Point; 2]>,
    ) -> f64 {
        let stretches = self.stretches(plane, segments);
        let sum_mm: f64 = stretches.iter().map(|stretch| stretch.price_mm).sum();
        sum_mm / self.circle_mm()
    }

    /// Returns the stretches of a plane's seam along segments of its section, with their prices.
    pub(crate) fn stretches(
        &self,
        plane: &Plane,
        segments: impl Iterator<Item = [Point; 2]>,
    ) -> Vec<Stretch> {
        let reach_mm = REACH_RATIO * self.size_mm;
        let is_near = |sample: &&Sample| plane.distance(&sample.at).abs() < 3.0 * reach_mm;
        let near: Vec<&Sample> = self.samples.iter().filter(is_near).collect();
        let step_mm = STEP_RATIO * self.size_mm;
        let (mut stretches, mut held) = (Vec::new(), Held::default());
        for [a, b] in segments {
            let length_mm = (b - a).norm();
            let steps = (length_mm / step_mm).ceil().max(1.0);
            for step in 0..steps as usize {
                let at = a + (b - a) * ((step as f64 + 0.5) / steps);
                let price_mm = length_mm / steps * held.weight(&near, &at, reach_mm);
                stretches.push(Stretch { at, price_mm });
            }
        }
        stretches
    }

    /// Returns the lie of a cut: a slanted one may follow a neck, a crease or the base.
    pub(crate) fn lie(&self, plane: &Plane) -> SeamLie {
        let rise_deg = self.rise_deg(plane);
        if rise_deg > 90.0 - UNSEEN_SLANT_DEG {
            SeamLie::Level
        } else if rise_deg < UNSEEN_SLANT_DEG {
            SeamLie::Upright
        } else if self.is_neck(plane) {
            SeamLie::AlongNeck
        } else if self.is_crease(plane) {
            SeamLie::AlongCrease
        } else if self.is_base(plane) {
            SeamLie::AlongBase
        } else {
            SeamLie::Slanted
        }
    }

    /// Returns the slant of a cut, from 0 for level or upright to 1 for plainly slanted. It is 0
    /// for one that follows the body.
    fn slant_ratio(&self, plane: &Plane) -> f64 {
        let rise_deg = self.rise_deg(plane);
        let slant_deg = rise_deg.min(90.0 - rise_deg);
        let range_deg = PLAIN_SLANT_DEG - UNSEEN_SLANT_DEG;
        let slant = ((slant_deg - UNSEEN_SLANT_DEG) / range_deg).clamp(0.0, 1.0);
        if slant > 0.0 && self.lie(plane) == SeamLie::Slanted {
            slant
        } else {
            0.0
        }
    }

    /// Returns the price of a slanted cut's look, in circles about the model of average weight.
    pub(crate) fn slant_price(&self, plane: &Plane) -> f64 {
        SLANT_PRICE * self.slant_ratio(plane)
    }

    /// Returns true if the plane is level in the object's frame, to what nobody sees.
    pub(crate) fn is_level(&self, plane: &Plane) -> bool {
        self.lie(plane) == SeamLie::Level
    }

    /// Returns the height of a point, 0 at the lowest point of the object and 1 at the highest.
    pub(crate) fn height_ratio(&self, at: &Point) -> f64 {
        let range_mm = (self.highest_mm - self.lowest_mm).max(f64::MIN_POSITIVE);
        (self.up.dot(&at.coords) - self.lowest_mm) / range_mm
    }

    /// Returns the angle of a plane's normal from the horizontal, degrees.
    fn rise_deg(&self, plane: &Plane) -> f64 {
        plane
            .normal
            .dot(&self.up)
            .abs()
            .clamp(0.0, 1.0)
            .asin()
            .to_degrees()
    }

    /// Returns true if the outline is short and grows on both sides of the plane.
    fn is_neck(&self, plane: &Plane) -> bool {
        let length = |away_mm: f64| {
            let offset_mm = plane.offset_mm + away_mm;
            let beside = Plane {
                offset_mm,
                ..*plane
            };
            self.sum_over_slice(&beside, |_| 1.0)
        };
        let reach_mm = NECK_REACH_RATIO * self.size_mm;
        let beside = length(reach_mm).min(length(-reach_mm));
        let here = length(0.0);
        here < NECK_LENGTH_RATIO && beside > (1.0 + NECK_GROWTH_RATIO) * here
    }

    /// Returns true if much of the seam lies in hollows.
    fn is_crease(&self, plane: &Plane) -> bool {
        let hollow = self.sum_over_slice(plane, |sample| sample.hollow_ratio);
        hollow > CREASE_SHARE * self.sum_over_slice(plane, |_| 1.0)
    }

    /// Returns true if the seam stays near the lowest point.
    fn is_base(&self, plane: &Plane) -> bool {
        let top_mm = self.lowest_mm + BASE_RATIO * (self.highest_mm - self.lowest_mm);
        let half_mm = SLICE_RATIO * self.size_mm;
        let seam = self.samples.iter();
        let mut seam = seam.filter(|sample| plane.distance(&sample.at).abs() < half_mm);
        seam.all(|sample| self.up.dot(&sample.at.coords) < top_mm)
    }
}

/// A short stretch of a seam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stretch {
    /// Its middle.
    pub(crate) at: Point,
    /// Its length, weighted by what is seen there, mm.
    pub(crate) price_mm: f64,
}

/// The weight at the last place that was asked for: neighbours on a fine outline share it.
#[derive(Default)]
struct Held {
    at: Option<Point>,
    weight: f64,
}

impl Held {
    /// Returns the average weight of the samples about a place, or that of the nearest.
    fn weight(&mut self, near: &[&Sample], at: &Point, reach_mm: f64) -> f64 {
        let is_same = |last: Point| (last - at).norm() < 0.3 * reach_mm;
        if self.at.is_some_and(is_same) {
            return self.weight;
        }
        let (mut sum, mut total) = (0.0, 0.0);
        for sample in near {
            let closeness = (-(sample.at - at).norm_squared() / (reach_mm * reach_mm)).exp();
            sum += closeness * sample.weight;
            total += closeness;
        }
        self.at = Some(*at);
        self.weight = if total > f64::MIN_POSITIVE.sqrt() {
            sum / total
        } else {
            1.0
        };
        self.weight
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Csg;
    use crate::mesh::primitives::{ball, cuboid};

    fn skin(outer: &TriMesh) -> Skin {
        Skin::of(outer, &Vector::z(), &Watch::silent()).unwrap()
    }

    fn plane(normal: [f64; 3], at: [f64; 3]) -> Plane {
        Plane::through(&Point::from(at), &Vector::from(normal))
    }

    #[test]
    fn a_seam_across_the_sole_of_a_foot_is_dearer_than_one_over_the_top() {
        let outer = cuboid(&Point::origin(), &Point::new(20.0, 20.0, 60.0));
        let upright = plane([1.0, 0.0, 0.0], [1.0, 0.0, 0.0]);
        let level = plane([0.0, 0.0, 1.0], [0.0, 0.0, 10.0]);
        let bare = skin(&outer);
        let spared = bare.sparing_feet(&Vector::z());
        // The sole is a seventh of the whole seam, and nobody sees it.
        let ratio = spared.estimate_ratio(&upright) / bare.estimate_ratio(&upright);
        assert!(ratio > 4.0, "{ratio}");
        // What does not come near the sole costs what it did.
        assert_eq!(spared.estimate_ratio(&level), bare.estimate_ratio(&level));
    }

    /// Returns two balls of radius 10 mm, one 21 mm over the other, with a neck between them.
    fn snowman() -> TriMesh {
        let balls = [0.0, 21.0].map(|z| {
            let body = ball(&Point::new(0.0, 0.0, z), 10.0, 5);
            Csg::of_mesh(&body).unwrap()
        });
        let [low, high] = balls;
        let neck = cuboid(&Point::new(-3.0, -3.0, 5.0), &Point::new(3.0, 3.0, 16.0));
        let necked = low.union(&Csg::of_mesh(&neck).unwrap()).unwrap();
        necked.union(&high).unwrap().to_mesh().unwrap()
    }

    #[test]
    fn a_slice_estimates_the_length_of_a_seam() {
        let skin = skin(&ball(&Point::origin(), 10.0, 5));
        let length = |z: f64| skin.sum_over_slice(&plane([0.0, 0.0, 1.0], [0.0, 0.0, z]), |_| 1.0);
        for z in [-6.0_f64, 0.0, 4.0] {
            let circle = std::f64::consts::TAU * (100.0 - z * z).sqrt() / skin.circle_mm();
            assert!(
                (length(z) / circle - 1.0).abs() < 0.12,
                "{z}: {}",
                length(z)
            );
        }
    }

    #[test]
    fn a_measured_price_is_near_its_estimate() {
        let outer = ball(&Point::origin(), 10.0, 5);
        let skin = skin(&outer);
        let level = plane([0.0, 0.0, 1.0], [0.0, 0.0, 3.0]);
        let radius = 91.0_f64.sqrt();
        let at = |i: usize| {
            let (sin, cos) = (std::f64::consts::TAU * i as f64 / 90.0).sin_cos();
            Point::new(radius * cos, radius * sin, 3.0)
        };
        let price = skin.price_ratio(&level, (0..90).map(|i| [at(i), at(i + 1)]));
        let estimate = skin.estimate_ratio(&level);
        assert!((price / estimate - 1.0).abs() < 0.15, "{price} {estimate}");
    }

    #[test]
    fn a_seam_in_the_groove_costs_less_than_one_across_the_head() {
        let skin = skin(&snowman());
        let groove = skin.estimate_ratio(&plane([0.0, 0.0, 1.0], [0.0, 0.0, 10.5]));
        let head = skin.estimate_ratio(&plane([0.0, 0.0, 1.0], [0.0, 0.0, 21.0]));
        assert!(groove < 0.6 * head, "{groove} {head}");
    }

    #[test]
    fn a_slant_is_bad_unless_it_follows_a_neck_or_the_base() {
        let skin = skin(&snowman());
        let (slant, across_neck) = ([0.35, 0.0, 1.0], [0.2, 0.0, 1.0]);
        assert_eq!(skin.lie(&plane([0.0, 0.0, 1.0], [0.0; 3])), SeamLie::Level);
        assert_eq!(
            skin.lie(&plane([1.0, 1.0, 0.0], [0.0; 3])),
            SeamLie::Upright
        );
        assert_eq!(skin.lie(&plane(slant, [0.0, 0.0, 21.0])), SeamLie::Slanted);
        assert_eq!(
            skin.lie(&plane(across_neck, [0.0, 0.0, 10.5])),
            SeamLie::AlongNeck
        );
        assert!(skin.slant_ratio(&plane(slant, [0.0, 0.0, 21.0])) > 0.9);
        assert_eq!(skin.slant_ratio(&plane(across_neck, [0.0, 0.0, 10.5])), 0.0);
        let slab = cuboid(&Point::origin(), &Point::new(20.0, 20.0, 60.0));
        let base = plane([0.2, 0.0, 1.0], [10.0, 10.0, 6.0]);
        let slab = self::skin(&slab);
        assert_eq!(slab.lie(&base), SeamLie::AlongBase);
    }
}
