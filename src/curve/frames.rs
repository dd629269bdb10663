//! Bends and twists of a polyline, and the polyline that they give back.

use crate::geom::{Frame, Matrix, Point, Vector, orthonormal_basis};

/// The sine of a bend below which edges count as parallel: rounding alone makes 1e-16.
const PARALLEL: f64 = 1e-14;

/// A polyline as lengths, bends and twists, which do not change as it moves.
///
/// The frames are those of Bergou et al., "Discrete elastic rods", ACM TOG 27(3), 2008, §4.
#[derive(Debug, Clone, PartialEq)]
pub struct DiscreteFrames {
    /// The first point, and the first edge's direction, normal and binormal as columns.
    pub start: Frame,
    /// Length of each edge, mm.
    pub edge_mm: Vec<f64>,
    /// Angle between the edges at each inner point, rad: 0 to π.
    pub bend_rad: Vec<f64>,
    /// Angle on each inner edge from the binormal at its start to that at its end, rad: −π to π.
    pub twist_rad: Vec<f64>,
}

impl DiscreteFrames {
    /// Measures three points or more, of which none is the same as the one before it.
    ///
    /// Parallel edges keep the binormal before them. The first ones take that of the first bend.
    pub fn of(points: &[Point]) -> Self {
        let edges: Vec<Vector> = points.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let edge_mm: Vec<f64> = edges.iter().map(Vector::norm).collect();
        let along: Vec<Vector> = edges.iter().map(Vector::normalize).collect();
        let binormals = binormals(&along);
        let bend = |pair: &[Vector]| angle(&pair[0], &pair[1], &pair[0].cross(&pair[1]));
        let twist = |(pair, edge): (&[Vector], &Vector)| {
            pair[0]
                .cross(&pair[1])
                .dot(edge)
                .atan2(pair[0].dot(&pair[1]))
        };
        let tangent = along.first().copied().unwrap_or_else(Vector::x);
        let binormal = binormals.first().copied();
        let binormal = binormal.unwrap_or_else(|| orthonormal_basis(&tangent).0);
        Self {
            start: Frame {
                origin: points.first().copied().unwrap_or_else(Point::origin),
                axes: Matrix::from_columns(&[tangent, binormal.cross(&tangent), binormal]),
            },
            edge_mm,
            bend_rad: along.windows(2).map(bend).collect(),
            twist_rad: binormals.windows(2).zip(&along[1..]).map(twist).collect(),
        }
    }

    /// Returns the points again. Rounding leaves about 1e-11 mm over a curve of some 100 mm.
    pub fn rebuild(&self) -> Vec<Point> {
        let mut at = self.start.origin;
        let mut axes = self.start.axes;
        let mut points = vec![at];
        for (edge, length) in self.edge_mm.iter().enumerate() {
            if edge > 0 {
                axes *= about_binormal(self.bend_rad[edge - 1]);
            }
            at += axes.column(0) * *length;
            points.push(at);
            if let Some(twist) = edge.checked_sub(1).and_then(|e| self.twist_rad.get(e)) {
                axes *= super::roll(*twist).axes;
            }
        }
        points
    }

    /// Returns the curvature at each inner point, 1/mm: its bend over half of both edges.
    pub fn curvature(&self) -> Vec<f64> {
        let half = |i: usize| 0.5 * (self.edge_mm[i] + self.edge_mm[i + 1]);
        let bends = self.bend_rad.iter().enumerate();
        bends.map(|(i, bend)| bend / half(i)).collect()
    }

    /// Returns the twist from the first inner point to each inner point, rad.
    pub fn cumulative_twist(&self) -> Vec<f64> {
        let sums = self.twist_rad.iter().scan(0.0, |sum, twist| {
            *sum += twist;
            Some(*sum)
        });
        [0.0].into_iter().chain(sums).collect()
    }
}

/// Returns the unit binormal at each inner point.
fn binormals(along: &[Vector]) -> Vec<Vector> {
    let cross = |pair: &[Vector]| pair[0].cross(&pair[1]).try_normalize(PARALLEL);
    let bends: Vec<Option<Vector>> = along.windows(2).map(cross).collect();
    let first = bends.iter().flatten().next().copied();
    let tangent = along.first().copied().unwrap_or_else(Vector::x);
    let mut last = first.unwrap_or_else(|| orthonormal_basis(&tangent).0);
    let keep = |(bend, edge): (&Option<Vector>, &Vector)| {
        let binormal = bend.unwrap_or(last);
        last = (binormal - edge * edge.dot(&binormal)).normalize();
        last
    };
    bends.iter().zip(&along[1..]).map(keep).collect()
}

/// Returns the angle between two directions, given their cross product, rad.
fn angle(a: &Vector, b: &Vector, cross: &Vector) -> f64 {
    cross.norm().atan2(a.dot(b))
}

/// Returns the turn about the third axis.
fn about_binormal(angle_rad: f64) -> Matrix {
    let (sin, cos) = angle_rad.sin_cos();
    Matrix::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::Helix;
    use proptest::prelude::*;

    fn worst(a: &[Point], b: &[Point]) -> f64 {
        let apart = a.iter().zip(b).map(|(a, b)| (a - b).norm());
        apart.fold(0.0, f64::max)
    }

    #[test]
    fn straight_stretches_and_a_reversal_are_rebuilt() {
        let points = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [3.0, 0.0, 0.0],
            [3.0, 2.0, 0.0],
            [3.0, 5.0, 0.0],
            [3.0, 5.0, -1.0],
            [3.0, 5.0, 4.0],
            [2.0, 2.0, 2.0],
        ];
        let points = points.map(Point::from);
        let rebuilt = DiscreteFrames::of(&points).rebuild();
        assert!(worst(&points, &rebuilt) < 1e-12);
    }

    #[test]
    fn a_line_has_neither_bends_nor_twists() {
        let points: Vec<Point> = (0..9).map(|i| Point::new(0.0, 0.0, f64::from(i))).collect();
        let frames = DiscreteFrames::of(&points);
        assert!(
            frames
                .bend_rad
                .iter()
                .chain(&frames.twist_rad)
                .all(|a| *a == 0.0)
        );
        assert!(worst(&points, &frames.rebuild()) < 1e-14);
    }

    #[test]
    fn a_helix_has_its_own_curvature_and_torsion() {
        let helix = Helix {
            curvature: 0.02,
            torsion: -0.015,
        };
        let points: Vec<Point> = (0..=600)
            .map(|i| helix.frame_at(0.5 * f64::from(i)).origin)
            .collect();
        let frames = DiscreteFrames::of(&points);
        assert!(frames.curvature().iter().all(|k| (k - 0.02).abs() < 1e-6));
        let twist = frames.cumulative_twist();
        let slope = twist.last().unwrap() / (0.5 * (twist.len() - 1) as f64);
        assert!((slope + 0.015).abs() < 1e-6, "{slope}");
    }

    proptest! {
        #[test]
        fn any_polyline_is_rebuilt_from_its_frames(
            steps in prop::collection::vec(prop::array::uniform3(-5.0..5.0f64), 3..120),
        ) {
            let mut at = Point::new(10.0, -20.0, 30.0);
            let mut points = vec![at];
            for step in steps {
                at += Vector::from(step) + Vector::new(0.0, 0.0, 0.01);
                if (at - points[points.len() - 1]).norm() > 1e-3 {
                    points.push(at);
                }
            }
            prop_assume!(points.len() > 2);
            prop_assert!(worst(&points, &DiscreteFrames::of(&points).rebuild()) < 1e-10);
        }
    }
}
