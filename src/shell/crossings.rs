//! The crossings of one row of columns with the surface, and the stretches of a column inside the
//! solid.

use super::ruler::Ruler;
use crate::geom::Point;
use crate::mesh::TriMesh;

/// A column's crossing of the surface.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Crossing {
    /// Height of the crossing, mm.
    pub z_mm: f64,
    /// Change of the winding number on the way up: +1 into the solid, −1 out of it.
    pub winding_step: i32,
}

/// The crossings of all columns of one row, each column's in ascending z. Reused from row to row.
#[derive(Debug, Clone, Default)]
pub struct RowCrossings {
    found: Vec<(u32, Crossing)>,
    starts: Vec<u32>,
    sorted: Vec<Crossing>,
}

impl RowCrossings {
    /// Finds the crossings of the columns over `xs` in the row at `y_mm` with `triangles` of a
    /// closed mesh. They must include every triangle that reaches the row.
    ///
    /// In every column the winding steps add up to zero, whatever the rounding. An edge's place on
    /// the row is computed from its ends in the order of their indices. So both triangles beside it
    /// get the same bits. Triangles share out the columns between their edges as half-open
    /// stretches.
    pub fn find(&mut self, mesh: &TriMesh, triangles: &[u32], y_mm: f64, xs: &Ruler) {
        self.found.clear();
        for &triangle in triangles {
            self.cross(mesh, triangle, y_mm, xs);
        }
        self.sort(xs.len());
    }

    /// Adds the crossings of one triangle with the columns of a row.
    ///
    /// Of the two edges of a triangle that meet a row, one goes up in y and one down. A triangle
    /// seen from its outside from above has the downward edge to the left. A column that rises
    /// through it leaves the solid.
    fn cross(&mut self, mesh: &TriMesh, triangle: u32, y: f64, xs: &Ruler) {
        let triangle = mesh.triangles()[triangle as usize];
        let (mut up, mut down) = (None, None);
        for (from, to) in [(0, 1), (1, 2), (2, 0)] {
            let (from, to) = (triangle[from], triangle[to]);
            let is_above = |vertex: u32| mesh.vertices()[vertex as usize].y > y;
            match (is_above(from), is_above(to)) {
                (false, true) => up = Some(edge_on_row(mesh, from, to, y)),
                (true, false) => down = Some(edge_on_row(mesh, to, from, y)),
                _ => {}
            }
        }
        let (Some(up), Some(down)) = (up, down) else {
            return;
        };
        let (first, last) = (xs.index_at_or_after(down.x), xs.index_at_or_after(up.x));
        let winding_step = if first < last { -1 } else { 1 };
        for column in first.min(last)..first.max(last) {
            let z_mm = between(down, up, xs.at(column));
            self.found
                .push((column as u32, Crossing { z_mm, winding_step }));
        }
    }

    /// Returns the crossings of column `index`, in ascending z.
    pub fn of(&self, index: usize) -> &[Crossing] {
        &self.sorted[self.starts[index] as usize..self.starts[index + 1] as usize]
    }

    /// Sorts by column (counting sort), then by height.
    fn sort(&mut self, columns: usize) {
        self.starts.clear();
        self.starts.resize(columns + 1, 0);
        self.found
            .iter()
            .for_each(|&(column, _)| self.starts[column as usize] += 1);
        let mut total = 0;
        for start in &mut self.starts {
            total += *start;
            *start = total;
        }
        self.sorted.clear();
        self.sorted.resize(self.found.len(), Crossing::default());
        for &(column, crossing) in &self.found {
            let end = &mut self.starts[column as usize];
            *end -= 1;
            self.sorted[*end as usize] = crossing;
        }
        for column in 0..columns {
            let range = self.starts[column] as usize..self.starts[column + 1] as usize;
            self.sorted[range].sort_unstable_by(|a, b| a.z_mm.total_cmp(&b.z_mm));
        }
    }
}

/// The point in which an edge meets a row.
#[derive(Clone, Copy)]
struct OnRow {
    x: f64,
    z: f64,
}

/// Returns the point in which the edge between two vertices on either side of a row meets it; the
/// same bits for either order.
fn edge_on_row(mesh: &TriMesh, a: u32, b: u32, y: f64) -> OnRow {
    let corner = |vertex: u32| mesh.vertices()[vertex as usize];
    let (p, q): (Point, Point) = (corner(a.min(b)), corner(a.max(b)));
    let ratio = ((y - p.y) / (q.y - p.y)).clamp(0.0, 1.0);
    OnRow {
        x: p.x + (q.x - p.x) * ratio,
        z: p.z + (q.z - p.z) * ratio,
    }
}

/// Returns the height at `x` on the segment from `a` to `b`, never outside the heights of its ends.
fn between(a: OnRow, b: OnRow, x: f64) -> f64 {
    let ratio = ((x - a.x) / (b.x - a.x)).clamp(0.0, 1.0);
    a.z + (b.z - a.z) * ratio
}

/// Calls `visit` with the bottom and top, mm, of each stretch of positive length with a winding
/// number of at least one, in ascending order.
pub fn inside_stretches(crossings: &[Crossing], mut visit: impl FnMut([f64; 2])) {
    let (mut winding, mut bottom) = (0, 0.0);
    for crossing in crossings {
        let before = winding;
        winding += crossing.winding_step;
        if before < 1 && winding >= 1 {
            bottom = crossing.z_mm;
        } else if before >= 1 && winding < 1 && crossing.z_mm > bottom {
            visit([bottom, crossing.z_mm]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shell::fixtures;

    fn all_crossings(mesh: &TriMesh, y: f64, xs: &Ruler) -> RowCrossings {
        let triangles: Vec<u32> = (0..mesh.triangles().len() as u32).collect();
        let mut crossings = RowCrossings::default();
        crossings.find(mesh, &triangles, y, xs);
        crossings
    }

    fn stretches(crossings: &[Crossing]) -> Vec<[f64; 2]> {
        let mut found = Vec::new();
        inside_stretches(crossings, |stretch| found.push(stretch));
        found
    }

    #[test]
    fn a_column_through_a_box_is_inside_from_bottom_to_top() {
        let solid = fixtures::cells(&[[0, 0, 0]], 10.0);
        let xs = Ruler::covering([-5.0, 15.0], 1.0, 0.3);
        let crossings = all_crossings(solid.mesh(), 4.2, &xs);
        for i in 0..xs.len() {
            let inside = (0.0..10.0).contains(&xs.at(i));
            assert_eq!(
                stretches(crossings.of(i)),
                if inside { vec![[0.0, 10.0]] } else { vec![] }
            );
        }
    }

    #[test]
    fn crossings_balance_on_columns_and_rows_through_vertices_and_along_edges() {
        let solid = fixtures::cells(&[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], 2.0);
        let xs = Ruler::covering([-1.0, 5.0], 0.5, 0.0);
        for row in -2..10 {
            let crossings = all_crossings(solid.mesh(), f64::from(row) * 0.5, &xs);
            for i in 0..xs.len() {
                let total: i32 = crossings.of(i).iter().map(|c| c.winding_step).sum();
                assert_eq!(total, 0, "row {row}, column {i}");
            }
        }
    }

    #[test]
    fn overlapping_solids_are_one_and_inverted_stretches_are_outside() {
        let step = |z_mm, winding_step| Crossing { z_mm, winding_step };
        let overlap = [step(0.0, 1), step(1.0, 1), step(2.0, -1), step(3.0, -1)];
        assert_eq!(stretches(&overlap), [[0.0, 3.0]]);
        let inside_out = [step(0.0, -1), step(1.0, 1), step(2.0, 1), step(3.0, -1)];
        assert_eq!(stretches(&inside_out), [[2.0, 3.0]]);
    }
}
