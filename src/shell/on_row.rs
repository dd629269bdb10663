//! The interface of a convex piece that is cut by one row of columns.

/// A piece cut by a row: for each x one stretch of z.
pub trait OnRow {
    /// Returns the bottom and top of the stretch in the column at `x_mm`, mm; exact up to rounding.
    ///
    /// If the column misses the piece, bottom < top does not hold; both may even be NaN.
    fn stretch(&self, x_mm: f64) -> [f64; 2];
}
