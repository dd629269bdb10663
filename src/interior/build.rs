//! Builds the columns of a shell: exact in z, one row of columns at a time, blocks of rows in
//! parallel.

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::columns::Columns;
use super::row::{Reaching, Row};
use crate::base::setting::{Key, Setting};
use crate::base::units::show_mm;
use crate::base::watch::{Cancelled, Watch};
use crate::shell::{Bins, Ruler, Shell};

/// Rows that a thread sweeps at a time. With more, the last blocks wait for one thread; with fewer,
/// every piece is listed in more blocks. The result does not depend on it.
const ROWS_PER_BLOCK: usize = 8;
/// Largest number of columns of the whole grid, occupied or not. An occupied column takes some 60
/// bytes while it is built, so ten times more would not fit the memory of a desktop computer. Ten
/// times fewer would exclude a printer's own pitch on its whole plate.
const MAX_GRID_COLUMNS: f64 = 1e8;

/// An error in building columns.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BuildError {
    /// The pitch is not positive and finite, or so fine that the columns could not be counted.
    #[error(
        "columns {} × {} apart are not possible here, where at most \
         {MAX_GRID_COLUMNS:.0e} may stand; \
         remedy: give a larger pitch (`{}`) or a smaller model",
        show_pitch(pitch_mm[0]),
        show_pitch(pitch_mm[1]),
        Setting::open(Key::Pitch)
    )]
    Pitch {
        /// The pitch asked for, mm.
        pitch_mm: [f64; 2],
    },
    /// The caller stopped the run.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Returns a pitch in words, however small.
fn show_pitch(mm: f64) -> String {
    if mm < 1e-3 {
        format!("{mm:.1e} mm")
    } else {
        show_mm(mm)
    }
}

impl Columns {
    /// Builds the columns of the region that `shell` lets be emptied, at the pitch `pitch_mm` in x
    /// and y.
    ///
    /// A point may be emptied if it lies inside the solid, no nearer to a triangle than the wall
    /// and outside every keep-solid region. On the vertical line through a column's centre, the
    /// ends of every interval are exact up to rounding (about 1e-12 mm). Columns with nothing to
    /// empty are left out. The result has the same bits for any number of threads.
    ///
    /// # Errors [`BuildError`] if the pitch is impossible or the caller stopped the run.
    pub fn of_shell(shell: &Shell, pitch_mm: [f64; 2], watch: &Watch) -> Result<Self, BuildError> {
        let grid = Grid::over(shell, pitch_mm)?;
        let triangles = shell.bin_triangles(&grid.ys, ROWS_PER_BLOCK);
        let pieces = shell.bin_pieces(&grid.ys, ROWS_PER_BLOCK);
        let sweep = Sweep {
            shell,
            grid,
            triangles,
            pieces,
        };
        let blocks = sweep.run(watch)?;
        Ok(sweep.grid.assemble(blocks))
    }
}

/// The centres of the columns and their pitch.
struct Grid {
    pitch_mm: [f64; 2],
    xs: Ruler,
    ys: Ruler,
}

impl Grid {
    /// Returns the grid over the shell's interior.
    fn over(shell: &Shell, pitch_mm: [f64; 2]) -> Result<Self, BuildError> {
        let bounds = shell.interior_bounds();
        let is_sound = |pitch: f64| pitch > 0.0 && pitch.is_finite();
        let columns =
            (bounds.size().x / pitch_mm[0]).max(1.0) * (bounds.size().y / pitch_mm[1]).max(1.0);
        if !(is_sound(pitch_mm[0]) && is_sound(pitch_mm[1]) && columns < MAX_GRID_COLUMNS) {
            return Err(BuildError::Pitch { pitch_mm });
        }
        let xs = Ruler::covering([bounds.min.x, bounds.max.x], pitch_mm[0], Ruler::PHASE_X);
        let ys = Ruler::covering([bounds.min.y, bounds.max.y], pitch_mm[1], Ruler::PHASE_Y);
        Ok(Self { pitch_mm, xs, ys })
    }

    /// Joins the blocks in order.
    fn assemble(&self, blocks: Vec<Block>) -> Columns {
        let total = |size: fn(&Block) -> usize| blocks.iter().map(size).sum::<usize>();
        let (occupied, intervals) = (total(|b| b.columns.len()), total(|b| b.intervals.len()));
        let mut columns = Columns {
            pitch_mm: self.pitch_mm,
            ..Columns::default()
        };
        columns.centers.reserve_exact(occupied);
        columns.starts.reserve_exact(occupied + 1);
        columns.intervals.reserve_exact(intervals);
        columns.starts.push(0);
        let mut start = 0;
        for block in blocks {
            for column in &block.columns {
                columns
                    .centers
                    .push([self.xs.at(column.x as usize), self.ys.at(column.y as usize)]);
                start += column.intervals;
                columns.starts.push(start);
            }
            columns.intervals.extend_from_slice(&block.intervals);
        }
        columns
    }
}

/// The occupied columns of a block of rows, and their intervals one after the other.
#[derive(Default)]
struct Block {
    columns: Vec<BlockColumn>,
    intervals: Vec<[f64; 2]>,
}

/// A column by its place on the grid, with the number of its intervals.
struct BlockColumn {
    x: u32,
    y: u32,
    intervals: u32,
}

/// The input of a sweep over the rows.
struct Sweep<'a> {
    shell: &'a Shell,
    grid: Grid,
    triangles: Bins,
    pieces: Bins,
}

impl Sweep<'_> {
    /// Sweeps every block of rows and returns them in order.
    fn run(&self, watch: &Watch) -> Result<Vec<Block>, BuildError> {
        watch.advance(0.0);
        let blocks = self.grid.ys.len().div_ceil(ROWS_PER_BLOCK);
        let done = AtomicUsize::new(0);
        let sweep = |row: &mut Row, block| {
            watch.check()?;
            let swept = self.sweep_block(row, block);
            watch.advance((done.fetch_add(1, Ordering::Relaxed) + 1) as f64 / blocks as f64);
            Ok(swept)
        };
        (0..blocks)
            .into_par_iter()
            .map_init(Row::default, sweep)
            .collect()
    }

    /// Sweeps one block of rows.
    fn sweep_block(&self, row: &mut Row, block: usize) -> Block {
        let reaching = Reaching {
            triangles: self.triangles.of(block),
            pieces: self.pieces.of(block),
        };
        let first = block * ROWS_PER_BLOCK;
        let mut swept = Block::default();
        for y in first..(first + ROWS_PER_BLOCK).min(self.grid.ys.len()) {
            row.carve(self.shell, reaching, self.grid.ys.at(y), &self.grid.xs);
            for (x, intervals) in row.occupied() {
                swept.columns.push(BlockColumn {
                    x: x as u32,
                    y: y as u32,
                    intervals: intervals.len() as u32,
                });
                swept.intervals.extend_from_slice(intervals);
            }
        }
        swept
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::geom::{Frame, Point, Vector};
    use crate::mesh::{Solid, TriMesh};
    use crate::shell::fixtures::{self, Random};
    use crate::shell::{Keep, Shell};

    /// Returns a frame turned so that no axis of the model is an axis of the goal.
    fn turned() -> Frame {
        Frame::with_axis(Point::new(1.0, 2.0, 3.0), &Vector::new(0.3, -0.5, 0.8))
    }

    fn shell_of(solid: &Solid, frame: &Frame, wall_mm: f64) -> Shell {
        Shell::new(solid, frame, wall_mm, &[]).unwrap()
    }

    fn columns_of(shell: &Shell, pitch_mm: f64) -> Columns {
        Columns::of_shell(shell, [pitch_mm; 2], &Watch::silent()).unwrap()
    }

    fn volume(solid: &Solid, frame: &Frame, wall_mm: f64, pitch_mm: f64) -> f64 {
        columns_of(&shell_of(solid, frame, wall_mm), pitch_mm)
            .moments()
            .volume()
    }

    /// Returns the distance from a point to a triangle by the definition: to the plane if the foot
    /// is inside, else to the nearest edge.
    fn distance_to_triangle(point: &Point, [a, b, c]: &[Point; 3]) -> f64 {
        let normal = (b - a).cross(&(c - a)).normalize();
        let is_inside =
            |from: &Point, to: &Point| (to - from).cross(&(point - from)).dot(&normal) >= 0.0;
        if is_inside(a, b) && is_inside(b, c) && is_inside(c, a) {
            return (point - a).dot(&normal).abs();
        }
        let to_edge = |from: &Point, to: &Point| {
            let along = to - from;
            let ratio = ((point - from).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
            (point - (from + along * ratio)).norm()
        };
        to_edge(a, b).min(to_edge(b, c)).min(to_edge(c, a))
    }

    /// Returns the winding number of the surface about a point: the sum of the triangles' solid
    /// angles over 4π.
    ///
    /// (Van Oosterom & Strackee, "The solid angle of a plane triangle", IEEE Trans. Biomed. Eng.
    /// 30, 1983.)
    fn winding(point: &Point, mesh: &TriMesh) -> f64 {
        let angle = |corners: [Point; 3]| {
            let [a, b, c] = corners.map(|corner| corner - point);
            let (la, lb, lc) = (a.norm(), b.norm(), c.norm());
            let denominator = la * lb * lc + a.dot(&b) * lc + b.dot(&c) * la + c.dot(&a) * lb;
            2.0 * a.dot(&b.cross(&c)).atan2(denominator)
        };
        mesh.iter_corners().map(angle).sum::<f64>() / (4.0 * PI)
    }

    /// Checks `samples` points on the columns against the definition, by the solid angle and the
    /// distances to all triangles. Every other point lies at the height of an interval's end.
    /// Returns the number of points in the region.
    fn check_by_definition(solid: &Solid, wall_mm: f64, samples: usize) -> usize {
        let frame = turned();
        let shell = shell_of(solid, &frame, wall_mm);
        let bounds = shell.surface().aabb();
        let pitch = bounds.size().max() / 40.0;
        let columns = columns_of(&shell, pitch);
        let mut random = Random::new(11);
        let mut in_region = 0;
        for sample in 0..samples {
            let column = ((random.unit() * columns.len() as f64) as usize).min(columns.len() - 1);
            let intervals = columns.intervals_of(column);
            let end = intervals[sample / 4 % intervals.len()][sample / 2 % 2];
            // Far above the 1e-9 mm within which the point is skipped, far below the intervals'
            // lengths.
            let beside = end + (random.unit() - 0.5) * 1e-3 * wall_mm;
            let anywhere = bounds.min.z + random.unit() * bounds.size().z;
            let z = if sample % 2 == 0 { beside } else { anywhere };
            // Every fourth point lies on the next column in x, which may have been left out.
            let x = columns.centers[column][0] + if sample % 4 == 2 { pitch } else { 0.0 };
            let y = columns.centers[column][1];
            let is_here = |center: &[f64; 2]| (center[0] - x).hypot(center[1] - y) < 1e-9;
            let here = columns.centers.iter().position(is_here);
            let intervals = here.map_or(&[][..], |column| columns.intervals_of(column));
            let point = Point::new(x, y, z);
            let distances = shell
                .surface()
                .iter_corners()
                .map(|corners| distance_to_triangle(&point, &corners));
            let distance = distances.fold(f64::INFINITY, f64::min);
            let may_be_emptied = distance >= wall_mm && winding(&point, shell.surface()) > 0.5;
            let found = intervals
                .iter()
                .any(|[bottom, top]| (*bottom..=*top).contains(&z));
            // Within 1e-9 mm of the wall's surface rounding decides.
            if (distance - wall_mm).abs() > 1e-9 {
                assert_eq!(
                    found, may_be_emptied,
                    "sample {sample} at {point}, {distance} mm from the surface"
                );
                in_region += usize::from(found);
            }
        }
        in_region
    }

    #[test]
    fn a_box_is_emptied_except_for_its_wall() {
        let solid = fixtures::cells(&[[0, 0, 0]], 10.0);
        // A length of a whole number of pitches holds that many lattice points, so the columns add
        // no error either.
        assert!((volume(&solid, &Frame::identity(), 1.0, 0.5) - 512.0).abs() < 1e-9);
        let columns = columns_of(&shell_of(&solid, &Frame::identity(), 1.0), 0.5);
        assert!(
            columns
                .intervals
                .iter()
                .all(|interval| *interval == [1.0, 9.0])
        );
    }

    #[test]
    fn in_a_turned_frame_a_box_is_the_same_box() {
        let solid = fixtures::cells(&[[0, 0, 0]], 10.0);
        // The rim of the shadow is about 4 · 8 · 1.3 mm long. A column at the rim is wrong by a
        // random part of pitch² · 8 mm.
        let (pitch, rim) = (0.1, 42.0);
        let deviation = f64::sqrt(rim / pitch) * pitch * pitch * 8.0;
        assert!((volume(&solid, &turned(), 1.0, pitch) - 512.0).abs() < deviation);
    }

    #[test]
    fn a_plate_no_thicker_than_two_walls_has_nothing_to_empty() {
        let plate = fixtures::cells(
            &[
                [0, 0, 0],
                [1, 0, 0],
                [2, 0, 0],
                [0, 1, 0],
                [1, 1, 0],
                [2, 1, 0],
            ],
            2.0,
        );
        assert!(columns_of(&shell_of(&plate, &Frame::identity(), 1.0), 0.1).is_empty());
        assert!(columns_of(&shell_of(&plate, &turned(), 1.0 + 1e-6), 0.1).is_empty());
        assert!(columns_of(&shell_of(&plate, &turned(), 50.0), 0.1).is_empty());
    }

    #[test]
    fn the_interior_of_a_ball_is_a_ball_smaller_by_the_wall() {
        let (radius, wall) = (10.0, 2.0);
        let solid = fixtures::bumpy_ball(radius, 5, |_| 0.0);
        let exact = 4.0 / 3.0 * PI * (radius - wall) * (radius - wall) * (radius - wall);
        let found = volume(&solid, &turned(), wall, 0.1);
        // The facets' planes lie inside the ball by at most edge²/(6 r), with edge ≈ 1.2 r / 2⁵:
        // 0.0024 mm of 8 mm.
        let (facets, columns) = (3.0 * 0.0024 / (radius - wall), 1e-4);
        assert!(
            found < exact * (1.0 + columns) && found > exact * (1.0 - facets - columns),
            "{found}, {exact}"
        );
    }

    #[test]
    fn along_a_reflex_edge_the_wall_is_a_quarter_of_a_cylinder() {
        let (side, wall) = (10.0, 1.5);
        let solid = fixtures::cells(&[[0, 0, 0], [1, 0, 0], [0, 1, 0]], side);
        let arms = (2.0 * side - 2.0 * wall) * (side - 2.0 * wall) + (side - 2.0 * wall) * side;
        let section = arms + wall * wall * (1.0 - PI / 4.0);
        let exact = section * (side - 2.0 * wall);
        let axes = [
            Vector::x(),
            Vector::y(),
            Vector::z(),
            Vector::new(0.3, -0.5, 0.8),
        ];
        for axis in axes {
            let frame = Frame::with_axis(Point::new(0.1, 0.2, 0.3), &axis);
            let found = volume(&solid, &frame, wall, 0.05);
            // The rim of the shadow (≤ 80 mm) is off by less than half a pitch if it is straight
            // along the lattice.
            assert!(
                (found - exact).abs() < 80.0 * 0.025 * 7.0,
                "{found} instead of {exact} along {axis}"
            );
        }
        // Across the edge the section is a smooth function of one coordinate except at three
        // corners: O(pitch²).
        let across = volume(
            &solid,
            &Frame::with_axis(Point::origin(), &Vector::y()),
            wall,
            0.01,
        );
        assert!((across - exact).abs() < 2.0, "{across} instead of {exact}");
    }

    #[test]
    fn a_slot_keeps_a_wall_on_both_sides() {
        let slotted = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 0, 1], [2, 0, 1]];
        let solid = fixtures::cells(&slotted, 5.0);
        let columns = columns_of(&shell_of(&solid, &Frame::identity(), 1.0), 0.25);
        let under_slot = columns
            .centers
            .iter()
            .position(|c| c[0] > 6.0 && c[0] < 9.0)
            .unwrap();
        assert_eq!(columns.intervals_of(under_slot), [[1.0, 4.0]]);
        let under_post = columns.centers.iter().position(|c| c[0] < 4.0).unwrap();
        assert_eq!(columns.intervals_of(under_post), [[1.0, 9.0]]);
        // Between them, over the reflex edge at (5, 5), the column ends at the circle about the
        // edge.
        let beside = columns
            .centers
            .iter()
            .position(|c| c[0] > 4.0 && c[0] < 5.0)
            .unwrap();
        let top = 5.0 - (1.0 - (5.0 - columns.centers[beside][0]).powi(2)).sqrt();
        let [[bottom, found]] = columns.intervals_of(beside) else {
            panic!("one interval")
        };
        assert!(*bottom == 1.0 && (found - top).abs() < 1e-12);
    }

    #[test]
    fn rough_solids_agree_with_the_distance_to_every_triangle() {
        let mut random = Random::new(5);
        let rough = fixtures::bumpy_ball(10.0, 3, |_| 1.5 * random.unit());
        assert!(check_by_definition(&rough, 1.0, 3000) > 600);
        assert!(check_by_definition(&rough, 4.0, 3000) > 600);
        let wavy = fixtures::bumpy_ball(10.0, 3, |d| {
            2.0 * (4.0 * d.x).sin() * (5.0 * d.y + d.z).cos()
        });
        assert!(check_by_definition(&wavy, 1.0, 3000) > 600);
        let spiky = fixtures::bumpy_ball(10.0, 2, |_| if random.unit() < 0.3 { 8.0 } else { -3.0 });
        assert!(check_by_definition(&spiky, 0.8, 3000) > 600);
    }

    #[test]
    fn solids_of_cubes_agree_with_the_distance_to_every_triangle() {
        let corner = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]];
        assert!(check_by_definition(&fixtures::cells(&corner, 5.0), 1.0, 3000) > 600);
        let ring: Vec<[i32; 3]> = (0..9)
            .filter(|i| *i != 4)
            .map(|i| [i % 3, i / 3, 0])
            .collect();
        assert!(check_by_definition(&fixtures::cells(&ring, 5.0), 1.2, 3000) > 600);
    }

    #[test]
    fn overlapping_solids_keep_a_wall_on_both_sides_of_buried_triangles() {
        let mut random = Random::new(9);
        let one = fixtures::bumpy_ball(10.0, 2, |_| random.unit());
        let other = one.mesh().map_vertices(|p| p + Vector::new(9.0, 2.0, 1.0));
        let both = Solid::new(one.mesh().clone().joined(&other)).unwrap();
        assert!(check_by_definition(&both, 1.0, 3000) > 600);
    }

    #[test]
    fn a_triangle_without_area_does_not_open_the_wall() {
        let cube = fixtures::cells(&[[0, 0, 0]], 10.0);
        let (mut vertices, mut triangles) = (
            cube.mesh().vertices().to_vec(),
            cube.mesh().triangles().to_vec(),
        );
        let [a, b, c] = triangles[0];
        let middle = vertices.len() as u32;
        vertices.push(nalgebra::center(
            &vertices[b as usize],
            &vertices[c as usize],
        ));
        triangles[0] = [a, b, middle];
        triangles.extend([[a, middle, c], [b, c, middle]]);
        let solid = Solid::new(TriMesh::new(vertices, triangles).unwrap()).unwrap();
        for frame in [Frame::identity(), turned()] {
            let (with, without) = (shell_of(&solid, &frame, 1.0), shell_of(&cube, &frame, 1.0));
            let (with, without) = (columns_of(&with, 0.3), columns_of(&without, 0.3));
            assert_eq!(with.centers, without.centers);
            let ends = with
                .intervals
                .iter()
                .flatten()
                .zip(without.intervals.iter().flatten());
            assert!(ends.into_iter().all(|(a, b)| (a - b).abs() < 1e-9));
        }
    }

    #[test]
    fn keep_solid_regions_stay_solid_in_every_frame() {
        let solid = fixtures::cells(&[[0, 0, 0]], 20.0);
        let (ball, from, to) = (
            Point::new(6.0, 6.0, 6.0),
            Point::new(13.0, 8.0, 5.0),
            Point::new(14.0, 15.0, 14.0),
        );
        let keeps = [
            Keep::ball(ball, 2.0),
            Keep {
                from,
                to,
                radius_mm: 1.5,
            },
        ];
        for frame in [Frame::identity(), turned()] {
            let shell = Shell::new(&solid, &frame, 1.0, &keeps).unwrap();
            let kept = 18.0f64.powi(3) - columns_of(&shell, 0.1).moments().volume();
            let length = (to - from).norm();
            let exact = 4.0 / 3.0 * PI * (8.0 + 1.5f64.powi(3)) + PI * 2.25 * length;
            // The rim of the box's shadow errs as in the test of the box alone (not in the identity
            // frame). The regions' own error goes with pitch^1.5.
            let deviation = if frame == Frame::identity() {
                0.3
            } else {
                1.0 * (100.0f64 / 0.1).sqrt() * 0.01 * 18.0
            };
            assert!(
                (kept - exact).abs() < deviation,
                "{kept} instead of {exact}"
            );
        }
    }

    #[test]
    fn one_thread_and_two_give_the_same_bits() {
        let mut random = Random::new(2);
        let solid = fixtures::bumpy_ball(10.0, 3, |_| random.unit());
        let on_threads = |threads| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap();
            pool.install(|| {
                let columns = columns_of(&shell_of(&solid, &turned(), 1.0), 0.1);
                let moments = columns.moments();
                (columns, moments)
            })
        };
        assert_eq!(on_threads(1), on_threads(2));
    }

    #[test]
    fn an_impossible_pitch_and_a_stopped_run_are_errors() {
        let shell = shell_of(
            &fixtures::cells(&[[0, 0, 0]], 10.0),
            &Frame::identity(),
            1.0,
        );
        for pitch in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-9] {
            let found = Columns::of_shell(&shell, [0.5, pitch], &Watch::silent());
            assert!(matches!(found, Err(BuildError::Pitch { .. })), "{pitch}");
        }
        let stopped = Watch::silent();
        stopped.cancel();
        assert_eq!(
            Columns::of_shell(&shell, [0.5; 2], &stopped),
            Err(BuildError::Cancelled(Cancelled))
        );
    }
}
