//! Beads of a printer's nozzle in closed form: straight ones and arcs, level or rising.

use super::moments::Moments;
use crate::geom::{Aabb, Matrix, Point, Vector};

/// A bead: what a nozzle lays down between two points. Its cross-section is a rectangle.
///
/// The nozzle's tip moves along the middle of the top. The bead hangs below it by its height, and
/// its width follows from its volume: `width = volume / (length × height)`. So the volume is kept,
/// whatever width a file states.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bead {
    /// The nozzle's place at the start, mm.
    pub from: Point,
    /// The nozzle's place at the end, mm.
    pub to: Point,
    /// The turn of an arc about a vertical axis; `None` for a straight bead.
    pub turn: Option<Turn>,
    /// Height, mm.
    pub height_mm: f64,
}

/// The turn of an arc about a vertical axis. The radius is that of the bead's start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turn {
    /// The axis, x and y, mm.
    pub axis_mm: [f64; 2],
    /// The angle from start to end, radians; positive counter-clockwise seen from above.
    pub angle_rad: f64,
}

/// The moments of a bead as a polynomial of its volume V: `linear·V + cubic·V³`.
///
/// Both parts add over beads whose volumes have one common factor. So beads may be summed before
/// the diameter of the filament is known. The cubic part stems from the width.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct BeadMoments {
    /// The factor of V; its own volume is 1 for a bead.
    pub linear: Moments,
    /// The factor of V³; its own volume is 0.
    pub cubic: Moments,
}

impl BeadMoments {
    /// Returns the polynomial for a volume `factor` times as large.
    pub fn scaled(&self, factor: f64) -> Self {
        Self {
            linear: self.linear * factor,
            cubic: self.cubic * factor.powi(3),
        }
    }

    /// Returns the moments, mm³ to mm⁵, at a volume of `factor`.
    pub fn at(&self, factor: f64) -> Moments {
        self.linear * factor + self.cubic * factor.powi(3)
    }
}

impl std::ops::AddAssign for BeadMoments {
    fn add_assign(&mut self, other: Self) {
        self.linear += other.linear;
        self.cubic += other.cubic;
    }
}

impl Bead {
    /// Returns the length of the path seen from above, mm.
    pub fn length_mm(&self) -> f64 {
        match self.turn {
            None => plan(&(self.to - self.from)).norm(),
            Some(turn) => self.radius_mm(&turn) * turn.angle_rad.abs(),
        }
    }

    /// Returns the moments of the bead with this volume (mm³), exact to rounding.
    ///
    /// An arc whose bead is wider than twice its radius keeps its volume and its polynomial.
    pub fn moments(&self, volume_mm3: f64) -> Moments {
        self.polynomial().at(volume_mm3)
    }

    /// Returns the moments as a polynomial of the volume in mm³.
    ///
    /// They are not finite if the length seen from above or the height is zero.
    pub fn polynomial(&self) -> BeadMoments {
        match self.turn {
            None => self.straight(),
            Some(turn) => self.arc(&turn),
        }
    }

    /// Returns the box around the path of the nozzle, mm, and down to the bead's underside. The
    /// width is left out.
    pub fn bounds(&self) -> Aabb {
        let below = Vector::z() * self.height_mm;
        let ends = [self.from, self.to, self.from - below, self.to - below];
        let around = Aabb::of_points(&ends);
        match self.turn {
            None => around,
            Some(turn) => self
                .outermost(&turn)
                .fold(around, |all, p| all.grown_over(&p)),
        }
    }

    /// A straight bead is a box, sheared upwards if it rises: its cross-section stays upright.
    fn straight(&self) -> BeadMoments {
        let along = self.to - self.from;
        let across = plan(&Vector::new(-along.y, along.x, 0.0));
        let length2 = across.norm_squared();
        let center = self.middle().coords;
        let second = along * along.transpose() / 12.0 + self.upright();
        let linear = Moments::from_parts(1.0, &Vector::zeros(), &second).translated(&center);
        // The width squared over 12 along the unit normal; V/(length·height) is the width.
        let width = across * across.transpose() / (12.0 * (length2 * self.height_mm).powi(2));
        BeadMoments {
            linear,
            cubic: Moments::from_parts(0.0, &Vector::zeros(), &width),
        }
    }

    /// An arc is a sector of a ring, sheared upwards if it rises.
    ///
    /// Integrates r·dr from R−w/2 to R+w/2 and the angle ψ from the middle of the arc. There x
    /// points from the axis to the middle, and z = z₀ + slope·ψ.
    fn arc(&self, turn: &Turn) -> BeadMoments {
        let (radius, angle) = (self.radius_mm(turn), turn.angle_rad.abs());
        let axis = Vector::new(turn.axis_mm[0], turn.axis_mm[1], 0.0);
        let middle = rotated(&plan(&(self.from.coords - axis)), 0.5 * turn.angle_rad) / radius;
        let aside = Vector::new(-middle.y, middle.x, 0.0);
        let slope = (self.to.z - self.from.z) / turn.angle_rad;
        let (sin_half, cos_half) = (0.5 * angle).sin_cos();
        // Means over the angle: of cos ψ, cos² ψ, sin² ψ and ψ·sin ψ.
        let mean_cos = 2.0 * sin_half / angle;
        let mean_cos2 = 0.5 + sin_half * cos_half / angle;
        let mean_sin2 = 0.5 - sin_half * cos_half / angle;
        let mean_lag = mean_cos - cos_half;
        let plane = middle * middle.transpose() * mean_cos2 + aside * aside.transpose() * mean_sin2;
        let lift = Vector::z() * (slope * mean_lag);
        let rise = aside * lift.transpose() + lift * aside.transpose();
        let climb = Vector::z() * (slope * angle);
        // Over the radius, r has the mean R + w²/12R, and r² has R² + w²/4.
        let upright = climb * climb.transpose() / 12.0 + self.upright();
        let second = plane * (radius * radius) + rise * radius + upright;
        let linear = Moments::from_parts(1.0, &(middle * (mean_cos * radius)), &second);
        let width2 = (radius * angle * self.height_mm).powi(-2);
        let first = middle * (mean_cos * width2 / (12.0 * radius));
        let second = plane * (0.25 * width2) + rise * (width2 / (12.0 * radius));
        let cubic = Moments::from_parts(0.0, &first, &second);
        let shift = axis + Vector::z() * self.middle().z;
        BeadMoments {
            linear: linear.translated(&shift),
            cubic: cubic.translated(&shift),
        }
    }

    /// Returns the middle between the ends, half the height below the nozzle.
    fn middle(&self) -> Point {
        nalgebra::center(&self.from, &self.to) - Vector::z() * (0.5 * self.height_mm)
    }

    /// Returns the mean square along z within an upright cross-section.
    fn upright(&self) -> Matrix {
        Matrix::from_diagonal(&Vector::new(0.0, 0.0, self.height_mm.powi(2) / 12.0))
    }

    fn radius_mm(&self, turn: &Turn) -> f64 {
        (self.from.x - turn.axis_mm[0]).hypot(self.from.y - turn.axis_mm[1])
    }

    /// Returns the places where an arc is farthest in x or y.
    fn outermost(&self, turn: &Turn) -> impl Iterator<Item = Point> {
        let [x, y] = turn.axis_mm;
        let radius = self.radius_mm(turn);
        let start = (self.from.y - y).atan2(self.from.x - x);
        let (z, angle_rad) = (self.from.z, turn.angle_rad);
        let sides = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
        let is_passed = move |side: &[f64; 2]| {
            let ahead = (side[1].atan2(side[0]) - start) * angle_rad.signum();
            ahead.rem_euclid(std::f64::consts::TAU) <= angle_rad.abs()
        };
        let place = move |side: [f64; 2]| Point::new(x + radius * side[0], y + radius * side[1], z);
        sides.into_iter().filter(is_passed).map(place)
    }
}

/// Returns the vector without its part along z.
fn plan(vector: &Vector) -> Vector {
    Vector::new(vector.x, vector.y, 0.0)
}

/// Returns a level vector turned about z.
fn rotated(vector: &Vector, angle_rad: f64) -> Vector {
    let (sin, cos) = angle_rad.sin_cos();
    Vector::new(
        cos * vector.x - sin * vector.y,
        sin * vector.x + cos * vector.y,
        0.0,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    fn close(got: &Moments, want: &Moments, ratio: f64) {
        for (got, want) in got.0.iter().zip(want.0) {
            let scale = want.abs().max(1.0);
            assert!((got - want).abs() < ratio * scale, "{got} {want}");
        }
    }

    /// Returns the moments of a sector of a ring by summing small boxes that rise in steps.
    fn summed(bead: &Bead, turn: &Turn, volume_mm3: f64) -> Moments {
        const STEPS: usize = 400;
        let radius = bead.radius_mm(turn);
        let width = volume_mm3 / (bead.length_mm() * bead.height_mm);
        let start = (bead.from.y - turn.axis_mm[1]).atan2(bead.from.x - turn.axis_mm[0]);
        let mut sum = Moments::default();
        for i in 0..STEPS {
            for j in 0..STEPS {
                let [s, t] = [i, j].map(|k| (k as f64 + 0.5) / STEPS as f64);
                let r = radius + (s - 0.5) * width;
                let angle = start + t * turn.angle_rad;
                let volume = r * (width / STEPS as f64) * bead.height_mm * turn.angle_rad.abs()
                    / STEPS as f64;
                let (x, y) = (
                    turn.axis_mm[0] + r * angle.cos(),
                    turn.axis_mm[1] + r * angle.sin(),
                );
                let z = bead.from.z + t * (bead.to.z - bead.from.z) - 0.5 * bead.height_mm;
                let mut cell = Moments(Moments::monomials(x, y, z).map(|m| m * volume));
                cell.0[9] += volume * bead.height_mm.powi(2) / 12.0;
                sum += cell;
            }
        }
        sum
    }

    #[test]
    fn a_level_bead_is_a_box() {
        let bead = Bead {
            from: Point::new(1.0, 2.0, 0.5),
            to: Point::new(5.0, 2.0, 0.5),
            turn: None,
            height_mm: 0.2,
        };
        // 4 long, 0.2 high, so 0.5 wide; centre (3, 2, 0.4).
        let got = bead.moments(0.4);
        let second = Matrix::from_diagonal(&Vector::new(
            0.4 * 16.0 / 12.0,
            0.4 * 0.25 / 12.0,
            0.4 * 0.04 / 12.0,
        ));
        let want = Moments::from_parts(0.4, &Vector::zeros(), &second);
        close(&got, &want.translated(&Vector::new(3.0, 2.0, 0.4)), 1e-14);
    }

    #[test]
    fn a_turned_bead_has_the_turned_moments() {
        let at = |angle: f64| Bead {
            from: Point::origin(),
            to: Point::from(rotated(&Vector::new(3.0, 0.0, 0.0), angle)),
            turn: None,
            height_mm: 0.3,
        };
        let turned = at(0.7).moments(2.0);
        let matrix = *nalgebra::Rotation3::from_axis_angle(&Vector::z_axis(), 0.7).matrix();
        close(&turned, &at(0.0).moments(2.0).rotated(&matrix), 1e-13);
    }

    #[test]
    fn an_arc_has_the_moments_of_its_small_pieces_whatever_way_it_turns_and_rises() {
        for angle_rad in [0.3, 2.0, PI, 5.5, TAU, -0.3, -2.5, -TAU, 3.0 * TAU] {
            for rise in [0.0, 0.6] {
                let turn = Turn {
                    axis_mm: [4.0, -3.0],
                    angle_rad,
                };
                let from = Point::new(6.0, -2.0, 1.0);
                let arm = rotated(&Vector::new(2.0, 1.0, 0.0), angle_rad);
                let bead = Bead {
                    from,
                    to: Point::new(4.0 + arm.x, -3.0 + arm.y, 1.0 + rise),
                    turn: Some(turn),
                    height_mm: 0.25,
                };
                let volume = bead.length_mm() * 0.25 * 0.8;
                close(&bead.moments(volume), &summed(&bead, &turn, volume), 1e-4);
            }
        }
    }

    #[test]
    fn a_flat_arc_becomes_a_straight_bead() {
        let (from, to) = (Point::new(0.0, 0.0, 1.0), Point::new(2.0, 0.0, 1.0));
        let radius = 5000.0_f64;
        let turn = Turn {
            axis_mm: [1.0, -(radius * radius - 1.0).sqrt()],
            angle_rad: -2.0 * (1.0 / radius).asin(),
        };
        let straight = Bead {
            from,
            to,
            turn: None,
            height_mm: 0.2,
        };
        let arc = Bead {
            turn: Some(turn),
            ..straight
        };
        // The arc bulges by a sagitta of 1e-4 mm.
        close(&arc.moments(0.2), &straight.moments(0.2), 1e-4);
    }

    #[test]
    fn the_box_of_an_arc_reaches_its_outermost_places() {
        let bead = |angle_rad: f64| Bead {
            from: Point::new(3.0, 0.0, 1.0),
            to: Point::new(0.0, 3.0 * angle_rad.signum(), 1.0),
            turn: Some(Turn {
                axis_mm: [0.0, 0.0],
                angle_rad,
            }),
            height_mm: 0.5,
        };
        let quarter = bead(0.5 * PI).bounds();
        assert!((quarter.min - Point::new(0.0, 0.0, 0.5)).norm() < 1e-12);
        assert!((quarter.max - Point::new(3.0, 3.0, 1.0)).norm() < 1e-12);
        let rest = bead(-1.5 * PI).bounds();
        assert!((rest.min - Point::new(-3.0, -3.0, 0.5)).norm() < 1e-12);
        assert!((rest.max - Point::new(3.0, 3.0, 1.0)).norm() < 1e-12);
    }

    #[test]
    fn beads_may_be_summed_before_the_diameter_is_known() {
        let bead = |x: f64| Bead {
            from: Point::new(x, 1.0, 0.4),
            to: Point::new(x + 1.0, 3.0, 0.4),
            turn: None,
            height_mm: 0.2,
        };
        let mut sum = BeadMoments::default();
        sum += bead(0.0).polynomial().scaled(0.3);
        sum += bead(5.0).polynomial().scaled(0.1);
        let want = bead(0.0).moments(0.6) + bead(5.0).moments(0.2);
        close(&sum.at(2.0), &want, 1e-14);
    }
}
