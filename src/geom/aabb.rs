//! The axis-aligned bounding box.

use super::{Point, Vector};

/// An axis-aligned box, mm. Empty until it grows over a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Aabb {
    /// The corner with the least coordinates.
    pub min: Point,
    /// The corner with the greatest coordinates.
    pub max: Point,
}

impl Aabb {
    /// The empty box: grown over a point, it becomes that point.
    pub const EMPTY: Self = Self {
        min: Point::new(f64::INFINITY, f64::INFINITY, f64::INFINITY),
        max: Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    /// Returns the smallest box that contains every point.
    #[inline]
    pub fn of_points<'a>(points: impl IntoIterator<Item = &'a Point>) -> Self {
        points
            .into_iter()
            .fold(Self::EMPTY, |aabb, point| aabb.grown_over(point))
    }

    /// Returns this box, grown just enough to contain `point`.
    #[inline]
    pub fn grown_over(&self, point: &Point) -> Self {
        Self {
            min: self.min.inf(point),
            max: self.max.sup(point),
        }
    }

    /// Returns the smallest box that contains both.
    #[inline]
    pub fn union(&self, other: &Self) -> Self {
        Self {
            min: self.min.inf(&other.min),
            max: self.max.sup(&other.max),
        }
    }

    /// Returns this box with every face moved outward by `margin_mm` (inward if negative).
    #[inline]
    pub fn inflated(&self, margin_mm: f64) -> Self {
        let margin = Vector::repeat(margin_mm);
        Self {
            min: self.min - margin,
            max: self.max + margin,
        }
    }

    /// Returns the edge lengths along x, y and z, mm.
    #[inline]
    pub fn size(&self) -> Vector {
        self.max - self.min
    }

    /// Returns the centre of the box.
    #[inline]
    pub fn center(&self) -> Point {
        nalgebra::center(&self.min, &self.max)
    }

    /// Returns the squared distance from `point` to the box, mm²; zero inside.
    #[inline]
    pub fn distance_squared(&self, point: &Point) -> f64 {
        let below = self.min - point;
        let above = point - self.max;
        below.sup(&above).sup(&Vector::zeros()).norm_squared()
    }

    /// Returns true if the box contains no point.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.min.x > self.max.x || self.min.y > self.max.y || self.min.z > self.max.z
    }
}
