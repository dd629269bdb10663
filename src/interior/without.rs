//! The columns without a body that must stay solid although the wall would let it be emptied.

use std::convert::Infallible;
use std::ops::Range;

use rayon::prelude::*;

use super::columns::Columns;
use super::row::subtract;
use crate::base::watch::{Cancelled, Watch};
use crate::mesh::TriMesh;
use crate::shell::{RowCrossings, Ruler, inside_stretches};

/// Length below which an interval is dropped, mm: rounding at the body's surface that meets an
/// interval's end.
const SLIVER_MM: f64 = 1e-6;

impl Columns {
    /// Returns the columns less the inside of a closed mesh (goal frame, mm), exact along every
    /// column.
    ///
    /// Columns with nothing left are left out. Costs a pass over the columns and one over the mesh.
    pub fn without(&self, body: &TriMesh) -> Self {
        let Ok(rest) = self.subtract(body, || Ok::<(), Infallible>(()));
        rest
    }

    /// Returns the columns less a body like [`Columns::without`], until the watch is stopped.
    pub fn without_watched(&self, body: &TriMesh, watch: &Watch) -> Result<Self, Cancelled> {
        self.subtract(body, || watch.check())
    }

    /// Returns the columns less a body, and checks now and then that it may go on.
    fn subtract<E: Send>(
        &self,
        body: &TriMesh,
        check: impl Fn() -> Result<(), E> + Sync,
    ) -> Result<Self, E> {
        let rows = self.rows();
        let carver = Carver::new(self, body, &rows);
        let carve = |crossings: &mut RowCrossings, row: &Range<usize>| {
            check()?;
            Ok(carver.carve(row.clone(), crossings))
        };
        let carved = rows.par_iter().map_init(RowCrossings::default, carve);
        let carved: Vec<Self> = carved.collect::<Result<_, E>>()?;
        let mut rest = self.without_columns();
        for row in carved {
            let shift = rest.intervals.len() as u32;
            rest.centers.extend(row.centers);
            rest.intervals.extend(row.intervals);
            rest.starts
                .extend(row.starts[1..].iter().map(|start| start + shift));
        }
        Ok(rest)
    }

    /// Returns columns of the same pitch, but none of them.
    fn without_columns(&self) -> Self {
        Self {
            pitch_mm: self.pitch_mm,
            starts: vec![0],
            ..Self::default()
        }
    }

    /// Returns the rows, as ranges of columns with the same y.
    fn rows(&self) -> Vec<Range<usize>> {
        let rows = self.centers.chunk_by(|a, b| a[1] == b[1]);
        let ends = rows.scan(0, |end, row| {
            let start = *end;
            *end += row.len();
            Some(start..*end)
        });
        ends.collect()
    }
}

/// A body to subtract from columns, its triangles sorted by the rows that they reach.
struct Carver<'a> {
    columns: &'a Columns,
    body: &'a TriMesh,
    xs: Ruler,
    /// The distinct y of the rows, ascending, mm.
    rows_mm: Vec<f64>,
    /// The triangles that reach each of these rows, in their own order.
    triangles: Vec<Vec<u32>>,
}

impl<'a> Carver<'a> {
    fn new(columns: &'a Columns, body: &'a TriMesh, rows: &[Range<usize>]) -> Self {
        let aabb = body.aabb();
        let mut rows_mm: Vec<f64> = rows
            .iter()
            .map(|row| columns.centers[row.start][1])
            .collect();
        rows_mm.sort_by(f64::total_cmp);
        rows_mm.dedup();
        let mut triangles = vec![Vec::new(); rows_mm.len()];
        for (index, corners) in (0u32..).zip(body.iter_corners()) {
            let [a, b, c] = corners.map(|p| p.y);
            let (low, high) = (a.min(b).min(c), a.max(b).max(c));
            let first = rows_mm.partition_point(|&y| y < low);
            let reached = rows_mm[first..].iter().take_while(|&&y| y <= high).count();
            for row in &mut triangles[first..first + reached] {
                row.push(index);
            }
        }
        Self {
            columns,
            body,
            xs: Ruler::covering(
                [aabb.min.x, aabb.max.x],
                columns.pitch_mm[0],
                Ruler::PHASE_X,
            ),
            rows_mm,
            triangles,
        }
    }

    /// Returns what is left of the columns of one row.
    fn carve(&self, row: Range<usize>, crossings: &mut RowCrossings) -> Columns {
        let y = self.columns.centers[row.start][1];
        let place = self.rows_mm.partition_point(|&other| other < y);
        crossings.find(self.body, &self.triangles[place], y, &self.xs);
        let mut rest = self.columns.without_columns();
        let mut intervals = Vec::new();
        for column in row {
            let center = self.columns.centers[column];
            intervals.clear();
            intervals.extend_from_slice(self.columns.intervals_of(column));
            if let Some(crossed) = self.find_column(center[0]) {
                inside_stretches(crossings.of(crossed), |stretch| {
                    subtract(&mut intervals, stretch)
                });
                intervals.retain(|[bottom, top]| top - bottom > SLIVER_MM);
            }
            if !intervals.is_empty() {
                rest.centers.push(center);
                rest.intervals.extend_from_slice(&intervals);
                rest.starts.push(rest.intervals.len() as u32);
            }
        }
        rest
    }

    /// Returns the index of the body's column at `x`; `None` if it does not reach there.
    fn find_column(&self, x: f64) -> Option<usize> {
        // There is no other column within half a pitch, so rounding cannot mistake a neighbour for
        // it.
        let half_pitch_mm = self.columns.pitch_mm[0] / 2.0;
        let column = self.xs.index_at_or_after(x - half_pitch_mm);
        let is_there = column < self.xs.len() && self.xs.at(column) <= x + half_pitch_mm;
        is_there.then_some(column)
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

    #[test]
    fn every_row_meets_the_triangles_that_reach_it_on_any_number_of_threads() {
        let columns = cube_columns();
        let body = ball(&Point::new(4.0, 5.5, 5.0), 3.0, 3)
            .joined(&cuboid(
                &Point::new(6.5, -2.0, 1.0),
                &Point::new(8.0, 12.0, 2.0),
            ))
            .joined(&ball(&Point::new(8.0, 8.0, 8.0), 1.0, 2));
        let rows = columns.rows();
        let carver = Carver::new(&columns, &body, &rows);
        let all: Vec<u32> = (0..body.triangles().len() as u32).collect();
        let mut crossings = [RowCrossings::default(), RowCrossings::default()];
        for (&y, triangles) in carver.rows_mm.iter().zip(&carver.triangles) {
            assert!(triangles.len() < all.len());
            crossings[0].find(&body, triangles, y, &carver.xs);
            crossings[1].find(&body, &all, y, &carver.xs);
            for column in 0..carver.xs.len() {
                assert_eq!(crossings[0].of(column), crossings[1].of(column));
            }
        }
        let on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            pool.unwrap().install(|| columns.without(&body))
        };
        assert_eq!(on(1), on(3));
        assert!(on(1).intervals.len() > columns.intervals.len());
    }
}
