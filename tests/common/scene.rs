//! Real models with their interior as columns, for tests of densities.

#![allow(dead_code, reason = "every test uses a part of it")]

use equipoise::base::watch::Watch;
use equipoise::geom::{Frame, Matrix, Point, Quadric, Vector};
use equipoise::hollow::{Graded, Row};
use equipoise::interior::Columns;
use equipoise::io::read_model;
use equipoise::mass::{Moments, moments_of_mesh};
use equipoise::mesh::Solid;
use equipoise::repair::repair;
use equipoise::shell::Shell;

use super::common::shared_model;

/// A wall so thin that there is none, mm.
pub const NO_WALL_MM: f64 = 1e-4;

/// A model with its interior as columns in a tilted frame, in which no level set is upright.
pub struct Scene {
    /// The solid.
    pub solid: Solid,
    /// The columns' frame.
    pub frame: Frame,
    pub columns: Columns,
    /// Moments of the shell: the solid's own less those of the columns.
    pub shell: Moments,
}

impl Scene {
    pub fn new(solid: Solid, wall_mm: f64, pitch_mm: f64) -> Self {
        let center = moments_of_mesh(solid.mesh()).centroid();
        let frame = Frame::with_axis(center, &Vector::new(0.35, -0.42, 0.84));
        let shell = Shell::new(&solid, &frame, wall_mm, &[]).unwrap();
        let columns = Columns::of_shell(&shell, [pitch_mm; 2], &Watch::silent()).unwrap();
        let shell = moments_of_mesh(solid.mesh()).in_frame(&frame) - columns.moments();
        Self {
            solid,
            frame,
            columns,
            shell,
        }
    }

    /// Returns rows that the integrals of some moments in a frame be zero, in the columns' frame.
    pub fn rows(&self, frame: &Frame, moments: &[usize]) -> Vec<Row> {
        let one = |index: usize| Quadric(std::array::from_fn(|i| f64::from(u8::from(i == index))));
        let moved = |index: &usize| one(*index).in_frame(&frame.inverse()).in_frame(&self.frame);
        moments
            .iter()
            .map(|index| Row::zero(moved(index)))
            .collect()
    }

    pub fn graded<'a>(&'a self, rows: &'a [Row]) -> Graded<'a> {
        Graded {
            shell: self.shell,
            columns: &self.columns,
            rows,
        }
    }
}

/// Rows that put the centre on the axis.
pub const STATIC: [usize; 2] = [1, 2];
/// Rows that also make the axis principal.
pub const DYNAMIC: [usize; 4] = [1, 2, 6, 5];

/// Returns a model with its longest side this long; `None` if it is absent.
pub fn shared(name: &str, size_mm: f64) -> Option<Solid> {
    let model = read_model(&shared_model(name)?).unwrap();
    let mesh = repair(model, &Watch::silent()).unwrap().0;
    let longest_mm = mesh.longest_side_mm();
    Some(Solid::new(mesh.map_vertices(|p| p * (size_mm / longest_mm))).unwrap())
}

/// Returns the frame of the rocker arm's rotor: its axis is x, through a point in shares of the
/// longest side.
pub fn rotor_frame(size_mm: f64) -> Frame {
    Frame {
        origin: Point::new(0.0, 0.0669 * size_mm, 0.0850 * size_mm),
        // z of the goal is x of the model.
        axes: Matrix::new(0., 0., 1., 1., 0., 0., 0., 1., 0.),
    }
}
