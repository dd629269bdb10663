//! The gaps and the material of a turned part along the vertical lines of a grid.

use super::shape::Shape;
use crate::geom::{Matrix, Point, Vector, orthonormal_basis};
use crate::mesh::TriMesh;
use crate::mesh::primitives::cuboid;

/// Share of the pitch by which the grid is shifted against the part's box, in x and y. It keeps
/// lines off edges that run along the axes.
const SHIFT_RATIO: [f64; 2] = [0.471, 0.533];

/// A stretch of a vertical line without material. A gap that begins on the plate has no triangle
/// below, one that ends in the open has none above.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gap {
    /// Height of its lower end, mm; the plate is at 0.
    pub from_mm: f64,
    /// Height of its upper end, mm; infinite in the open.
    pub to_mm: f64,
    /// The triangle at its lower end.
    pub below: Option<u32>,
    /// The triangle at its upper end.
    pub above: Option<u32>,
}

/// The gaps along the lines of a square grid through a part, with the part on the plate.
///
/// A line through an edge of a part finds one of its two triangles: both agree on which side of
/// their edge the line passes.
#[derive(Debug, Clone)]
pub struct Columns {
    /// Number of lines along x and y; the outermost ones pass the part.
    pub(super) shape: [usize; 2],
    /// Distance between the lines, mm.
    pub(super) pitch_mm: f64,
    /// Height of the part, mm.
    pub(super) height_mm: f64,
    /// The rotation from the part's frame to the printer's.
    turn: Matrix,
    /// The point of the first line on the plate, printer's frame, mm.
    origin: Point,
    lines: Lines,
}

/// The gaps of all lines.
#[derive(Debug, Clone)]
struct Lines {
    /// Index of the first gap of every line, and the number of all gaps.
    starts: Vec<u32>,
    /// The gaps, by line and from below.
    gaps: Vec<Gap>,
}

/// A crossing of a line with the surface.
#[derive(Clone, Copy)]
struct Hit {
    line: u32,
    triangle: u32,
    z_mm: f64,
    is_entry: bool,
}

impl Columns {
    /// Draws the lines through a part with `up` (of unit length) pointing up, `pitch_mm` apart.
    pub fn of(shape: &Shape, up: &Vector, pitch_mm: f64) -> Self {
        let (u, v) = orthonormal_basis(up);
        let turn = Matrix::from_rows(&[u.transpose(), v.transpose(), up.transpose()]);
        let turned: Vec<Point> = shape.mesh.vertices().iter().map(|p| turn * p).collect();
        let low = turned
            .iter()
            .fold(Point::from([f64::INFINITY; 3]), |a, p| a.inf(p));
        let high = turned
            .iter()
            .fold(Point::from([f64::NEG_INFINITY; 3]), |a, p| a.sup(p));
        let size = if turned.is_empty() {
            Vector::zeros()
        } else {
            high - low
        };
        // One line beside the part on every side.
        let count = |axis: usize| (size[axis] / pitch_mm).ceil() as usize + 2;
        let grid = Grid {
            shape: [count(0), count(1)],
            low: [0, 1].map(|axis| low[axis] - (1.0 - SHIFT_RATIO[axis]) * pitch_mm),
            pitch_mm,
        };
        let mut hits: Vec<Hit> = Vec::new();
        for (index, &[a, b, c]) in shape.mesh.triangles().iter().enumerate() {
            let corners = [a, b, c].map(|corner| turned[corner as usize]);
            grid.cross(&corners, |line, z| {
                let is_entry = shape.normals[index].dot(up) < 0.0;
                let z_mm = z - low.z;
                hits.push(Hit {
                    line,
                    triangle: index as u32,
                    z_mm,
                    is_entry,
                });
            });
        }
        let [width, depth] = grid.shape;
        Self {
            shape: grid.shape,
            pitch_mm,
            height_mm: size.z,
            turn,
            origin: Point::new(grid.low[0], grid.low[1], low.z),
            lines: Lines::between(hits, width * depth),
        }
    }

    /// Returns the gaps of a line, from below. The last one ends in the open.
    pub(super) fn gaps(&self, line: usize) -> &[Gap] {
        &self.lines.gaps[self.range(line)]
    }

    /// Returns the indices of the gaps of a line.
    pub(super) fn range(&self, line: usize) -> std::ops::Range<usize> {
        self.lines.starts[line] as usize..self.lines.starts[line + 1] as usize
    }

    /// Returns the number of all gaps.
    pub(super) fn count(&self) -> usize {
        self.lines.gaps.len()
    }

    /// Returns the lines beside a line toward greater x and y.
    pub(super) fn next_lines(&self, line: usize) -> impl Iterator<Item = usize> {
        let [width, depth] = self.shape;
        let right = (line % width + 1 < width).then_some(line + 1);
        let behind = (line / width + 1 < depth).then_some(line + width);
        right.into_iter().chain(behind)
    }

    /// Returns whether a line is on the rim of the grid.
    pub(super) fn is_on_rim(&self, line: usize) -> bool {
        let [width, depth] = self.shape;
        let (x, y) = (line % width, line / width);
        x == 0 || y == 0 || x + 1 == width || y + 1 == depth
    }

    /// Returns the greatest area of a layer, mm², of layers a pitch apart.
    pub(super) fn greatest_layer_mm2(&self) -> f64 {
        let layers = (self.height_mm / self.pitch_mm).ceil() as usize + 1;
        let mut counts = vec![0u32; layers];
        let layer = |z_mm: f64| ((z_mm / self.pitch_mm).ceil() as usize).min(layers);
        for line in 0..self.lines() {
            for pair in self.gaps(line).windows(2) {
                for count in &mut counts[layer(pair[0].to_mm)..layer(pair[1].from_mm)] {
                    *count += 1;
                }
            }
        }
        let most = counts.into_iter().max().unwrap_or(0);
        f64::from(most) * self.pitch_mm * self.pitch_mm
    }

    /// Returns a closed box around a stretch of a line, as wide as the grid's cells, part's frame.
    pub(super) fn cell(&self, line: usize, [from_mm, to_mm]: [f64; 2]) -> TriMesh {
        let [x, y] = [line % self.shape[0], line / self.shape[0]].map(|index| index as f64);
        let aside = Vector::new(0.5, 0.5, 0.0) * self.pitch_mm;
        let at = |z_mm: f64| self.origin + Vector::new(x * self.pitch_mm, y * self.pitch_mm, z_mm);
        let cell = cuboid(&(at(from_mm) - aside), &(at(to_mm) + aside));
        cell.map_vertices(|p| self.turn.transpose() * p)
    }

    /// Returns the number of lines.
    pub(super) fn lines(&self) -> usize {
        self.shape[0] * self.shape[1]
    }
}

/// The lines of a grid.
struct Grid {
    shape: [usize; 2],
    low: [f64; 2],
    pitch_mm: f64,
}

impl Grid {
    /// Calls `found` with the index of each line that crosses the triangle and the height there.
    fn cross(&self, corners: &[Point; 3], mut found: impl FnMut(u32, f64)) {
        let [a, b, c] = corners;
        let normal = (b - a).cross(&(c - a));
        if normal.z == 0.0 {
            return;
        }
        let of = |axis: usize, p: &Point| (p[axis] - self.low[axis]) / self.pitch_mm;
        let (bottom, top) = (a.y.min(b.y).min(c.y), a.y.max(b.y).max(c.y));
        let rows =
            [bottom, top].map(|y| ((y - self.low[1]) / self.pitch_mm).ceil().max(0.0) as usize);
        let [least_z, most_z] = [a.z.min(b.z).min(c.z), a.z.max(b.z).max(c.z)];
        for row in rows[0]..rows[1].min(self.shape[1]) {
            let y = self.low[1] + row as f64 * self.pitch_mm;
            let mut ends = [f64::INFINITY, f64::NEG_INFINITY];
            for (p, q) in [(a, b), (b, c), (c, a)] {
                // The lower end comes first, so that both triangles of an edge find the same point.
                let (p, q) = if (p.y, p.x, p.z) <= (q.y, q.x, q.z) {
                    (p, q)
                } else {
                    (q, p)
                };
                if p.y < y && y <= q.y {
                    let x = of(0, p) + (of(0, q) - of(0, p)) * ((y - p.y) / (q.y - p.y));
                    ends = [ends[0].min(x), ends[1].max(x)];
                }
            }
            let [first, last] = ends.map(|x| x.ceil().clamp(0.0, self.shape[0] as f64));
            for column in first as usize..last.max(first) as usize {
                let x = self.low[0] + column as f64 * self.pitch_mm;
                let z = a.z - (normal.x * (x - a.x) + normal.y * (y - a.y)) / normal.z;
                let line = row * self.shape[0] + column;
                found(line as u32, z.clamp(least_z, most_z));
            }
        }
    }
}

impl Lines {
    /// Returns the gaps between the crossings of each line.
    fn between(mut hits: Vec<Hit>, lines: usize) -> Self {
        // Where two pieces of the surface meet, the entry comes first: no gap is between them.
        hits.sort_unstable_by(|a, b| {
            let rank = |hit: &Hit| (hit.line, hit.z_mm);
            let heights = rank(a).0.cmp(&rank(b).0).then(a.z_mm.total_cmp(&b.z_mm));
            heights
                .then(b.is_entry.cmp(&a.is_entry))
                .then(a.triangle.cmp(&b.triangle))
        });
        let mut starts = Vec::with_capacity(lines + 1);
        let mut gaps: Vec<Gap> = Vec::with_capacity(hits.len() / 2 + lines);
        let mut next = hits.as_slice();
        for line in 0..lines {
            starts.push(gaps.len() as u32);
            let mut open = Gap {
                from_mm: 0.0,
                to_mm: f64::INFINITY,
                below: None,
                above: None,
            };
            let mut depth = 0i32;
            while let Some((hit, rest)) = next.split_first()
                && hit.line as usize == line
            {
                next = rest;
                let after = depth + if hit.is_entry { 1 } else { -1 };
                if depth == 0 && after == 1 {
                    gaps.push(Gap {
                        to_mm: hit.z_mm,
                        above: Some(hit.triangle),
                        ..open
                    });
                } else if depth == 1 && after == 0 {
                    open = Gap {
                        from_mm: hit.z_mm,
                        below: Some(hit.triangle),
                        ..open
                    };
                }
                depth = after;
            }
            gaps.push(open);
        }
        starts.push(gaps.len() as u32);
        Self { starts, gaps }
    }
}
