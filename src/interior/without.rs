//! The columns without a body that must stay solid although the wall would let it be emptied.

use std::convert::Infallible;

use super::columns::Columns;
use super::row::subtract;
use crate::base::watch::{Cancelled, Watch};
use crate::mesh::TriMesh;
use crate::shell::{RowCrossings, Ruler, inside_stretches};

/// Columns between two checks of the watch: a fraction of a millisecond.
const COLUMNS_PER_CHECK: usize = 1024;

/// Length below which an interval is dropped, mm: rounding at the body's surface that meets an
/// interval's end.
const SLIVER_MM: f64 = 1e-6;

impl Columns {
    /// Returns the columns less the inside of a closed mesh (goal frame, mm), exact along every
    /// column.
    ///
    /// Columns with nothing rest are rest out. Costs a pass over the columns, and one over the mesh
    /// for each row that it reaches.
    pub fn without(&self, body: &TriMesh) -> Self {
        let Ok(rest) = self.subtract(body, || Ok::<(), Infallible>(()));
        rest
    }

    /// Returns the columns less a body like [`Columns::without`], until the watch is stopped.
    pub fn without_watched(&self, body: &TriMesh, watch: &Watch) -> Result<Self, Cancelled> {
        self.subtract(body, || watch.check())
    }

    /// Returns the columns less a body, and checks now and then that it may go on.
    fn subtract<E>(&self, body: &TriMesh, check: impl Fn() -> Result<(), E>) -> Result<Self, E> {
        let mut carver = Carver::new(self, body);
        let mut rest = Self {
            pitch_mm: self.pitch_mm,
            starts: vec![0],
            ..Self::default()
        };
        let mut intervals = Vec::new();
        for column in 0..self.len() {
            if column % COLUMNS_PER_CHECK == 0 {
                check()?;
            }
            let center = self.centers[column];
            intervals.clear();
            intervals.extend_from_slice(self.intervals_of(column));
            carver.carve(center, &mut intervals);
            if !intervals.is_empty() {
                rest.centers.push(center);
                rest.intervals.extend_from_slice(&intervals);
                rest.starts.push(rest.intervals.len() as u32);
            }
        }
        Ok(rest)
    }
}

/// The body's crossings with the columns, one row at a time.
struct Carver<'a> {
    body: &'a TriMesh,
    triangles: Vec<u32>,
    xs: Ruler,
    half_pitch_mm: f64,
    /// y of the row to which the crossings belong, mm.
    row_mm: f64,
    crossings: RowCrossings,
}

impl<'a> Carver<'a> {
    fn new(columns: &Columns, body: &'a TriMesh) -> Self {
        let (aabb, pitch_mm) = (body.aabb(), columns.pitch_mm[0]);
        Self {
            body,
            triangles: (0..body.triangles().len() as u32).collect(),
            xs: Ruler::covering([aabb.min.x, aabb.max.x], pitch_mm, Ruler::PHASE_X),
            half_pitch_mm: pitch_mm / 2.0,
            row_mm: f64::NAN,
            crossings: RowCrossings::default(),
        }
    }

    /// Subtracts the body from the intervals of one column.
    fn carve(&mut self, [x, y]: [f64; 2], intervals: &mut Vec<[f64; 2]>) {
        // There is no other column within half a pitch, so rounding cannot mistake a neighbour for
        // it.
        let column = self.xs.index_at_or_after(x - self.half_pitch_mm);
        if column >= self.xs.len() || self.xs.at(column) > x + self.half_pitch_mm {
            return;
        }
        if y != self.row_mm {
            self.row_mm = y;
            self.crossings.find(self.body, &self.triangles, y, &self.xs);
        }
        inside_stretches(self.crossings.of(column), |stretch| {
            subtract(intervals, stretch)
        });
        intervals.retain(|[bottom, top]| top - bottom > SLIVER_MM);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Frame, Point};
    use crate::mesh::primitives::{ball, cuboid};
    use crate::shell::{Shell, fixtures};

    fn cube_columns() -> Columns {
        let solid = fixtures::cells(&[[0, 0, 0]], 10.0);
        let shell = Shell::new(&solid, &Frame::identity(), 1.0, &[]).unwrap();
        Columns::of_shell(&shell, [0.1, 0.2], &Watch::silent()).unwrap()
    }

    #[test]
    fn a_box_taken_out_of_a_box_leaves_the_difference() {
        let columns = cube_columns();
        let rest = columns.without(&cuboid(
            &Point::new(2.0, 3.0, 4.0),
            &Point::new(5.0, 7.0, 20.0),
        ));
        // Both boxes' sides are whole numbers of pitches, so the lattice counts them exactly.
        assert!((columns.moments().volume() - 512.0).abs() < 1e-9);
        assert!((rest.moments().volume() - (512.0 - 3.0 * 4.0 * 5.0)).abs() < 1e-9);
    }

    #[test]
    fn a_ball_inside_splits_columns_and_one_beside_changes_nothing() {
        let columns = cube_columns();
        let hollow = columns.without(&ball(&Point::new(5.0, 5.0, 5.0), 2.0, 4));
        assert_eq!(hollow.len(), columns.len());
        assert!(hollow.intervals.len() > columns.intervals.len());
        let lost = columns.moments().volume() - hollow.moments().volume();
        // 4/3 π 2³ within a percent: facets within the ball, and a lattice of 0.02 mm².
        assert!((lost / 33.51 - 1.0).abs() < 0.01, "{lost}");
        assert_eq!(
            columns.without(&ball(&Point::new(30.0, 5.0, 5.0), 2.0, 2)),
            columns
        );
    }

    #[test]
    fn columns_that_lose_everything_are_left_out() {
        let columns = cube_columns();
        let rest = columns.without(&cuboid(
            &Point::new(-1.0, -1.0, -1.0),
            &Point::new(5.0, 11.0, 11.0),
        ));
        assert!(rest.centers.iter().all(|center| center[0] > 5.0));
        assert_eq!(rest.starts.len(), rest.len() + 1);
        assert!(
            columns
                .without(&cuboid(
                    &Point::new(0.0, 0.0, 0.0),
                    &Point::new(10.0, 10.0, 10.0)
                ))
                .is_empty()
        );
    }
}
