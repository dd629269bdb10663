//! A field of a family: four numbers, and the quadric whose level sets are its own.

use nalgebra::SVector;

use crate::field::{DensityRange, Ramp, Sine};
use crate::geom::{Frame, Point, Quadric, Vector};

/// The four numbers of a field, lengths over that of the body.
pub(super) type Numbers = SVector<f64, 4>;

/// Least slope of a ramp, 1/mm: one with less is the same everywhere.
const LEAST_SLOPE: f64 = 1e-12;

/// A family of fields with four numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Family {
    /// Linear between two planes, and constant beyond.
    Ramp,
    /// A wave of the distance to a point.
    Sine,
}

/// A field of a family between two densities that it leaves open, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// at_origin + gradient·x, clamped to the densities.
    Ramp {
        /// The density at the origin before it is clamped.
        at_origin: f64,
        /// Its slope, 1/mm.
        gradient: Vector,
    },
    /// low + (high − low)(1 + sin(2π|x − center|/wave))/2.
    Sine {
        /// The centre, mm.
        center: Point,
        /// The length of the wave, mm.
        wave_mm: f64,
    },
}

impl Shape {
    /// Returns the shape of a ramp that has its densities at its ends.
    pub fn of_ramp(ramp: &Ramp) -> Self {
        let [low, high] = ramp.densities();
        let [from, to] = ramp.ends_mm();
        let slope = (high - low) / (to - from);
        Self::Ramp {
            at_origin: low - slope * from,
            gradient: ramp.direction() * slope,
        }
    }

    /// Returns the shape of a wave.
    pub fn of_sine(sine: &Sine) -> Self {
        Self::Sine {
            center: sine.center(),
            wave_mm: sine.wave_mm(),
        }
    }

    /// Returns the shape of a density that is the same everywhere.
    pub fn uniform(density: f64) -> Self {
        Self::Ramp {
            at_origin: density,
            gradient: Vector::zeros(),
        }
    }

    /// Returns the family.
    pub fn family(&self) -> Family {
        match self {
            Self::Ramp { .. } => Family::Ramp,
            Self::Sine { .. } => Family::Sine,
        }
    }

    /// Returns the same field over the coordinates of `frame`; this one is over the model's.
    #[must_use]
    pub fn in_frame(&self, frame: &Frame) -> Self {
        match *self {
            Self::Ramp {
                at_origin,
                gradient,
            } => Self::Ramp {
                at_origin: at_origin + gradient.dot(&frame.origin.coords),
                gradient: frame.axes.tr_mul(&gradient),
            },
            Self::Sine { center, wave_mm } => Self::Sine {
                center: frame.to_local(&center),
                wave_mm,
            },
        }
    }

    /// Returns the words for the field between two densities, as they can be typed.
    pub fn words(&self, range: DensityRange) -> String {
        let densities = [range.low(), range.high()];
        match *self {
            Self::Ramp {
                at_origin,
                gradient,
            } => {
                let slope = gradient.norm();
                let ends = densities.map(|density| (density - at_origin) / slope);
                let ramp = (slope > LEAST_SLOPE)
                    .then(|| Ramp::new(&gradient, ends, densities))
                    .flatten();
                let uniform = at_origin.clamp(range.low(), range.high());
                ramp.map_or_else(|| format!("uniform:{uniform:.6}"), |ramp| ramp.to_string())
            }
            Self::Sine { center, wave_mm } => Sine::new(center, wave_mm, densities)
                .map_or_else(String::new, |sine| sine.to_string()),
        }
    }

    /// Returns the quadric that rises as a ramp's density falls, or toward the centre of a wave.
    ///
    /// It is minus the density before it is clamped, or minus the square of the phase.
    pub fn quadric(&self) -> Quadric {
        match *self {
            Self::Ramp {
                at_origin,
                gradient,
            } => linear(-at_origin, &-gradient),
            Self::Sine { center, wave_mm } => {
                let number = std::f64::consts::TAU / wave_mm;
                ball(&center, -number * number)
            }
        }
    }

    /// Returns the field of a family with this quadric.
    pub fn of_quadric(family: Family, quadric: &Quadric) -> Self {
        let [one, x, y, z, .., zz] = quadric.0;
        match family {
            Family::Ramp => Self::Ramp {
                at_origin: -one,
                gradient: -Vector::new(x, y, z),
            },
            Family::Sine => {
                let square = (-zz).max(f64::MIN_POSITIVE);
                Self::Sine {
                    center: Point::new(x, y, z) * (0.5 / square),
                    wave_mm: std::f64::consts::TAU / square.sqrt(),
                }
            }
        }
    }

    /// Returns the four numbers, for a body of this length.
    pub(super) fn numbers(&self, length_mm: f64) -> Numbers {
        match *self {
            Self::Ramp {
                at_origin,
                gradient,
            } => {
                let [x, y, z] = (gradient * length_mm).into();
                Numbers::new(at_origin, x, y, z)
            }
            Self::Sine { center, wave_mm } => {
                let [x, y, z] = (center.coords / length_mm).into();
                Numbers::new(x, y, z, std::f64::consts::TAU / wave_mm * length_mm)
            }
        }
    }

    /// Returns the field of a family with these numbers.
    pub(super) fn of_numbers(family: Family, numbers: &Numbers, length_mm: f64) -> Self {
        let [a, b, c, d] = (*numbers).into();
        match family {
            Family::Ramp => Self::Ramp {
                at_origin: a,
                gradient: Vector::new(b, c, d) / length_mm,
            },
            Family::Sine => Self::Sine {
                center: Point::new(a, b, c) * length_mm,
                wave_mm: std::f64::consts::TAU / d * length_mm,
            },
        }
    }

    /// Returns the derivatives of the quadric by the four numbers.
    pub(super) fn quadric_slopes(&self, length_mm: f64) -> [Quadric; 4] {
        match *self {
            Self::Ramp { .. } => std::array::from_fn(|i| match i {
                0 => linear(-1.0, &Vector::zeros()),
                _ => linear(0.0, &Vector::ith(i - 1, -1.0 / length_mm)),
            }),
            Self::Sine { center, wave_mm } => {
                let number = std::f64::consts::TAU / wave_mm;
                let square = number * number * length_mm;
                std::array::from_fn(|i| match i {
                    3 => ball(&center, -2.0 * number / length_mm),
                    _ => linear(-2.0 * square * center[i], &Vector::ith(i, 2.0 * square)),
                })
            }
        }
    }
}

fn linear(one: f64, slope: &Vector) -> Quadric {
    Quadric([one, slope.x, slope.y, slope.z, 0., 0., 0., 0., 0., 0.])
}

/// Returns factor · |x − center|².
fn ball(center: &Point, factor: f64) -> Quadric {
    let [x, y, z]: [f64; 3] = (center.coords * (-2.0 * factor)).into();
    let one = factor * center.coords.norm_squared();
    Quadric([one, x, y, z, 0., 0., 0., factor, factor, factor])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shapes() -> [Shape; 2] {
        [
            Shape::Ramp {
                at_origin: 0.4,
                gradient: Vector::new(0.01, -0.02, 0.005),
            },
            Shape::Sine {
                center: Point::new(3.0, -4.0, 7.0),
                wave_mm: 21.0,
            },
        ]
    }

    #[test]
    fn a_field_is_known_again_by_its_numbers_and_by_its_quadric() {
        for shape in shapes() {
            let numbers = shape.numbers(12.0);
            let again = Shape::of_numbers(shape.family(), &numbers, 12.0).numbers(12.0);
            assert!((again - numbers).amax() < 1e-12);
            let by_quadric = Shape::of_quadric(shape.family(), &shape.quadric());
            assert!((by_quadric.numbers(12.0) - numbers).amax() < 1e-12);
        }
    }

    #[test]
    fn the_slopes_of_the_quadric_are_its_differences() {
        const STEP: f64 = 1e-6;
        for shape in shapes() {
            let numbers = shape.numbers(12.0);
            let slopes = shape.quadric_slopes(12.0);
            for (index, slope) in slopes.iter().enumerate() {
                let moved = |sign: f64| {
                    let mut moved = numbers;
                    moved[index] += sign * STEP;
                    Shape::of_numbers(shape.family(), &moved, 12.0).quadric().0
                };
                let (above, below) = (moved(1.0), moved(-1.0));
                for i in 0..10 {
                    let difference = (above[i] - below[i]) / (2.0 * STEP);
                    let scale = slope.0[i].abs().max(1.0);
                    assert!(
                        (slope.0[i] - difference).abs() < 1e-6 * scale,
                        "{index} {i}"
                    );
                }
            }
        }
    }

    #[test]
    fn the_words_of_a_field_can_be_typed_and_give_it_again_in_any_frame() {
        let range = DensityRange::new(0.15, 0.9).unwrap();
        let frame = Frame::with_axis(Point::new(1.0, 2.0, -3.0), &Vector::new(0.3, -1.0, 0.5));
        for shape in shapes() {
            let local = shape.in_frame(&frame);
            let model = local.in_frame(&frame.inverse());
            assert!((model.numbers(10.0) - shape.numbers(10.0)).amax() < 1e-12);
            let typed: crate::field::Order = shape.words(range).parse().unwrap();
            let read = match typed {
                crate::field::Order::Ramp(ramp) => Shape::of_ramp(&ramp),
                crate::field::Order::Sine(sine) => Shape::of_sine(&sine),
                other => unreachable!("{other:?}"),
            };
            let off = (read.numbers(10.0) - shape.numbers(10.0)).amax();
            assert!(off < 1e-5, "{} {off}", shape.words(range));
        }
    }
}
