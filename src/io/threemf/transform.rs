//! The affine map that places an object of a package, as the format writes it.

use crate::geom::{Matrix, Point, Vector};

/// An affine map of points, mm: p ↦ `linear`·p + `shift`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Transform {
    /// The linear part.
    pub linear: Matrix,
    /// The translation, mm.
    pub shift: Vector,
}

impl Default for Transform {
    fn default() -> Self {
        Self {
            linear: Matrix::identity(),
            shift: Vector::zeros(),
        }
    }
}

/// Count of numbers that the format writes for a map: the columns of `linear`, then `shift`. The
/// format multiplies row vectors by the matrix from the left (3MF core 1.3, §3.3).
const NUMBERS: usize = 12;

impl Transform {
    /// Returns a pure translation, mm.
    pub fn shift(shift: Vector) -> Self {
        Self {
            shift,
            ..Self::default()
        }
    }

    /// Returns the image of the point.
    pub fn apply(&self, point: &Point) -> Point {
        Point::from(self.linear * point.coords + self.shift)
    }

    /// Returns the composition: this map first, then `outer`.
    pub fn then(&self, outer: &Self) -> Self {
        Self {
            linear: outer.linear * self.linear,
            shift: outer.linear * self.shift + outer.shift,
        }
    }

    /// Returns true if the map reverses orientation.
    pub fn mirrors(&self) -> bool {
        self.linear.determinant() < 0.0
    }

    /// Returns the twelve numbers of the format.
    pub(super) fn numbers(&self) -> [f64; NUMBERS] {
        std::array::from_fn(|i| {
            if i < 9 {
                self.linear[(i % 3, i / 3)]
            } else {
                self.shift[i - 9]
            }
        })
    }

    /// Parses the twelve numbers of the format. `None` unless there are exactly twelve finite
    /// numbers and an invertible linear part.
    pub(super) fn parse(text: &str) -> Option<Self> {
        let numbers: Vec<f64> = text
            .split_ascii_whitespace()
            .map(str::parse)
            .collect::<Result<_, _>>()
            .ok()?;
        if numbers.len() != NUMBERS || !numbers.iter().all(|x| x.is_finite()) {
            return None;
        }
        let linear = Matrix::from_column_slice(&numbers[..9]);
        let determinant = linear.determinant();
        let is_sound = determinant.is_finite() && determinant != 0.0;
        is_sound.then(|| Self {
            linear,
            shift: Vector::new(numbers[9], numbers[10], numbers[11]),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(numbers: [f64; NUMBERS]) -> String {
        numbers.map(|x| x.to_string()).join(" ")
    }

    #[test]
    fn the_numbers_of_the_format_multiply_rows_from_the_left() {
        // (x, y, z, 1)·M with M's rows as they are written: x' = 1x + 4y + 7z + 10.
        let map = Transform::parse("1 2 3 4 5 6 7 8 10 10 11 12").unwrap();
        assert_eq!(
            map.apply(&Point::new(1.0, 1.0, 1.0)),
            Point::new(22.0, 26.0, 31.0)
        );
        assert_eq!(
            map.numbers(),
            [
                1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 10.0, 10.0, 11.0, 12.0
            ]
        );
    }

    #[test]
    fn one_map_after_another_is_their_product() {
        let turn = Transform::parse("0 1 0 -1 0 0 0 0 1 5 0 0").unwrap();
        let stretch = Transform::parse("2 0 0 0 3 0 0 0 4 0 0 1").unwrap();
        let point = Point::new(1.0, 2.0, 3.0);
        assert_eq!(
            stretch.then(&turn).apply(&point),
            turn.apply(&stretch.apply(&point))
        );
        assert_ne!(stretch.then(&turn), turn.then(&stretch));
        assert_eq!(Transform::default().then(&turn), turn);
    }

    #[test]
    fn what_is_no_map_of_space_is_refused() {
        let flat = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0];
        let words = [
            "",
            "1 2 3",
            "1 0 0 0 1 0 0 0 1 0 0 nan",
            "1 0 0 0 1 0 0 0 1 0 0 0 0",
            "1 0 0 0 1 0 0 0 one 0 0 0",
        ];
        for words in words
            .into_iter()
            .map(str::to_owned)
            .chain([text(flat), text([1e300; NUMBERS])])
        {
            assert_eq!(Transform::parse(&words), None, "{words}");
        }
        assert!(
            Transform::parse("-1 0 0 0 1 0 0 0 1 0 0 0")
                .unwrap()
                .mirrors()
        );
    }
}
