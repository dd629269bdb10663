//! Columns sampled with their depth below the surface: the region that may be emptied, for all
//! walls at once.

use rayon::prelude::*;

use super::columns::Columns;
use crate::geom::{Bvh, NO_HINT, Point};
use crate::mesh::{Solid, TriMesh};
use crate::shell::{Keep, RowCrossings, Ruler, inside_stretches};

/// Columns through the whole inside of a solid, in model coordinates, with the distance to the
/// surface along them.
///
/// A thinner wall lets more be emptied, so all walls are level sets of one function, the depth. It
/// is sampled once. [`Depths::columns`] cuts it at a wall in a millisecond, where a
/// [`Shell`](crate::shell::Shell) has to be built again for each wall.
///
/// The price is accuracy, as depth is linear between samples. Where the surface bends, an
/// interval's end is off by less than a spacing. A roof's ridge is cut off by up to half of one.
#[derive(Debug, Clone, PartialEq)]
pub struct Depths {
    pitch_mm: f64,
    centers: Vec<[f64; 2]>,
    /// Index of each column's first stretch, and one more.
    starts: Vec<u32>,
    /// Index of each stretch's first sample, and one more.
    stretches: Vec<u32>,
    samples: Vec<Sample>,
}

/// The depth at one height of a column.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Sample {
    z_mm: f64,
    depth_mm: f64,
}

/// A column with the samples of each of its stretches.
struct Column {
    center: [f64; 2],
    stretches: Vec<Vec<Sample>>,
}

impl Depths {
    /// Samples the depths of a solid at about `samples` points, evenly spaced in all three
    /// directions.
    ///
    /// Costs about 2 µs a sample, on all threads. The result has the same bits for any number of
    /// them.
    pub fn of_solid(solid: &Solid, samples: usize) -> Self {
        let mesh = solid.mesh();
        let (bounds, volume_mm3) = (mesh.aabb(), mesh.signed_volume_mm3());
        let pitch_mm = (volume_mm3 / samples.max(1) as f64).cbrt();
        let probe = Probe {
            mesh,
            triangles: (0..mesh.triangles().len() as u32).collect(),
            bvh: Bvh::new(mesh.iter_corners()),
            pitch_mm,
            xs: Ruler::covering([bounds.min.x, bounds.max.x], pitch_mm, Ruler::PHASE_X),
        };
        let ys = Ruler::covering([bounds.min.y, bounds.max.y], pitch_mm, Ruler::PHASE_Y);
        let rows = (0..ys.len()).into_par_iter();
        let rows: Vec<Vec<Column>> = rows
            .map_init(RowCrossings::default, |crossings, y| {
                probe.row(crossings, ys.at(y))
            })
            .collect();
        Self::assemble(pitch_mm, rows)
    }

    fn assemble(pitch_mm: f64, rows: Vec<Vec<Column>>) -> Self {
        let mut depths = Self {
            pitch_mm,
            centers: vec![],
            starts: vec![0],
            stretches: vec![0],
            samples: vec![],
        };
        for Column { center, stretches } in rows.into_iter().flatten() {
            depths.centers.push(center);
            for samples in stretches {
                depths.samples.extend(samples);
                depths.stretches.push(depths.samples.len() as u32);
            }
            depths.starts.push(depths.stretches.len() as u32 - 1);
        }
        depths
    }

    /// Returns the columns, in model coordinates, of the region that a wall of `wall_mm` and
    /// `keeps` let be emptied.
    pub fn columns(&self, wall_mm: f64, keeps: &[Keep]) -> Columns {
        let mut columns = Columns {
            pitch_mm: [self.pitch_mm; 2],
            starts: vec![0],
            ..Columns::default()
        };
        for (column, &center) in self.centers.iter().enumerate() {
            let before = columns.intervals.len();
            for stretch in self.starts[column]..self.starts[column + 1] {
                let slack = |sample: &Sample| slack_mm(center, sample, wall_mm, keeps);
                positive_intervals(self.samples_of(stretch), slack, &mut columns.intervals);
            }
            if columns.intervals.len() > before {
                columns.centers.push(center);
                columns.starts.push(columns.intervals.len() as u32);
            }
        }
        columns
    }

    fn samples_of(&self, stretch: u32) -> &[Sample] {
        let [first, end] = [0, 1].map(|i| self.stretches[stretch as usize + i] as usize);
        &self.samples[first..end]
    }
}

/// The input of the sampling of a row.
struct Probe<'a> {
    mesh: &'a TriMesh,
    triangles: Vec<u32>,
    bvh: Bvh,
    pitch_mm: f64,
    xs: Ruler,
}

impl Probe<'_> {
    /// Returns the columns of one row that meet the solid.
    fn row(&self, crossings: &mut RowCrossings, y_mm: f64) -> Vec<Column> {
        crossings.find(self.mesh, &self.triangles, y_mm, &self.xs);
        let column = |index: usize| {
            let center = [self.xs.at(index), y_mm];
            let mut stretches = Vec::new();
            inside_stretches(crossings.of(index), |stretch| {
                stretches.push(self.stretch(center, stretch))
            });
            Column { center, stretches }
        };
        (0..self.xs.len())
            .map(column)
            .filter(|column| !column.stretches.is_empty())
            .collect()
    }

    /// Returns evenly spaced samples of a stretch, no farther apart than the pitch. Its ends lie on
    /// the surface.
    fn stretch(&self, [x, y]: [f64; 2], [bottom, top]: [f64; 2]) -> Vec<Sample> {
        let steps = ((top - bottom) / self.pitch_mm).ceil().max(1.0) as usize;
        let mut hint = NO_HINT;
        let sample = |step: usize| {
            let z_mm = bottom + (top - bottom) * step as f64 / steps as f64;
            let is_end = step == 0 || step == steps;
            let nearest = if is_end {
                None
            } else {
                self.bvh
                    .closest(&Point::new(x, y, z_mm), f64::INFINITY, &[hint])
            };
            hint = nearest.map_or(NO_HINT, |nearest| nearest.hint);
            Sample {
                z_mm,
                depth_mm: nearest.map_or(0.0, |nearest| nearest.distance_squared.sqrt()),
            }
        };
        (0..=steps).map(sample).collect()
    }
}

/// Returns how much deeper a sample lies than it must, mm; positive if it may be emptied.
fn slack_mm([x, y]: [f64; 2], sample: &Sample, wall_mm: f64, keeps: &[Keep]) -> f64 {
    let point = Point::new(x, y, sample.z_mm);
    let beyond = keeps.iter().map(|keep| keep.distance_mm(&point));
    beyond.fold(sample.depth_mm - wall_mm, f64::min)
}

/// Adds the intervals in which a function that is linear between the samples is positive. At both
/// ends it must not be positive.
fn positive_intervals(
    samples: &[Sample],
    value: impl Fn(&Sample) -> f64,
    intervals: &mut Vec<[f64; 2]>,
) {
    let Some(first) = samples.first() else { return };
    let (mut below, mut before, mut bottom) = (first, value(first), first.z_mm);
    for sample in &samples[1..] {
        let here = value(sample);
        let crossing = below.z_mm + (sample.z_mm - below.z_mm) * before / (before - here);
        match (before > 0.0, here > 0.0) {
            (false, true) => bottom = crossing,
            (true, false) if crossing > bottom => intervals.push([bottom, crossing]),
            _ => {}
        }
        (below, before) = (sample, here);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::watch::Watch;
    use crate::geom::Frame;
    use crate::mesh::primitives::ball;
    use crate::shell::{Shell, fixtures};

    #[test]
    fn a_box_cut_at_any_wall_is_the_smaller_box() {
        let solid = fixtures::cells(&[[0, 0, 0]], 10.0);
        let depths = Depths::of_solid(&solid, 40_000);
        for wall_mm in [0.5, 1.0, 2.5, 4.0] {
            let volume = depths.columns(wall_mm, &[]).moments().volume();
            let exact = (10.0 - 2.0 * wall_mm).powi(3);
            // The samples are 0.29 mm apart. Along z nothing is interpolated over a bend. In x and
            // y each face is off by at most half a pitch, which the lattice's phase spreads over
            // both.
            let tolerance = 6.0 * 0.15 / (10.0 - 2.0 * wall_mm);
            assert!(
                (volume / exact - 1.0).abs() < tolerance,
                "{wall_mm}: {volume} {exact}"
            );
        }
    }

    #[test]
    fn depths_cut_at_a_wall_have_the_moments_of_a_shells_columns() {
        let solid = fixtures::bumpy_ball(10.0, 3, |d| 1.5 * (3.0 * d.x).sin() * d.y);
        let keep = Keep::ball(Point::new(0.0, 0.0, -8.0), 3.0);
        let depths = Depths::of_solid(&solid, 60_000);
        for wall_mm in [0.3, 1.0, 3.0] {
            let shell = Shell::new(&solid, &Frame::identity(), wall_mm, &[keep]).unwrap();
            let exact = Columns::of_shell(&shell, [0.1, 0.1], &Watch::silent())
                .unwrap()
                .moments();
            let found = depths.columns(wall_mm, &[keep]).moments();
            assert!(
                (found.volume() / exact.volume() - 1.0).abs() < 5e-3,
                "{wall_mm}"
            );
            assert!(
                (found.centroid() - exact.centroid()).norm() < 0.03,
                "{wall_mm}"
            );
        }
    }

    #[test]
    fn a_thinner_wall_never_lets_less_be_emptied() {
        let solid = Solid::new(ball(&Point::origin(), 10.0, 3)).unwrap();
        let depths = Depths::of_solid(&solid, 5_000);
        let volumes: Vec<f64> = (1..40)
            .map(|step| {
                depths
                    .columns(0.25 * f64::from(step), &[])
                    .moments()
                    .volume()
            })
            .collect();
        assert!(volumes.windows(2).all(|pair| pair[1] <= pair[0]));
        assert_eq!(
            depths.columns(10.0, &[]),
            Columns {
                pitch_mm: [depths.pitch_mm; 2],
                starts: vec![0],
                ..Default::default()
            }
        );
    }
}
