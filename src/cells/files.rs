//! Sites, cells and steps as files: tables, OBJ for modelling, legacy VTK for simulation.

use std::fmt::{Display, Write};

use super::body::Body;
use crate::geom::Point;

/// VTK's number for a polyhedron of any faces.
const VTK_POLYHEDRON: usize = 42;

/// The figures of a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CellFigures {
    /// The volume, mm³.
    pub volume_mm3: f64,
    /// ∫ ‖x − p‖∞ about the site in the cell's own axes, mm⁴.
    pub energy_mm4: f64,
}

/// A step of a relaxation as it is written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepFigures {
    /// The energy before the step, over that of as many cubes of the wished sizes.
    pub energy_ratio: f64,
    /// The mean movement of the sites, mm.
    pub mean_mm: f64,
    /// The greatest movement of a site, mm.
    pub most_mm: f64,
}

/// Returns sites as a table, mm. It can be read again.
pub fn encode_sites(sites: &[Point]) -> String {
    let mut text = String::from("x_mm,y_mm,z_mm\n");
    for site in sites {
        line(&mut text, ",", &coordinates(site));
    }
    text
}

/// Returns the steps of a relaxation as a table. The last row has the energy at its end.
pub fn encode_steps(steps: &[StepFigures]) -> String {
    let mut text = String::from("step,energy_ratio,mean_movement_mm,greatest_movement_mm\n");
    for (number, step) in steps.iter().enumerate() {
        let StepFigures {
            energy_ratio,
            mean_mm,
            most_mm,
        } = step;
        let _ = writeln!(text, "{number},{energy_ratio},{mean_mm},{most_mm}");
    }
    text
}

/// Returns cells as an OBJ file with a group for each. Corners are not shared by two cells.
pub fn encode_obj(bodies: &[Body]) -> String {
    let mut text = String::from("# cells, mm\n");
    let mut first = 1;
    for (number, body) in (1..).zip(bodies) {
        let _ = writeln!(text, "g cell{number}");
        for at in &body.corners {
            text.push_str("v ");
            line(&mut text, " ", &coordinates(at));
        }
        for face in &body.faces {
            text.push_str("f ");
            let corners: Vec<usize> = face.iter().map(|&at| at as usize + first).collect();
            line(&mut text, " ", &corners);
        }
        first += body.corners.len();
    }
    text
}

/// Returns cells as polyhedra in a legacy VTK file, with their figures as data.
pub fn encode_vtk(bodies: &[Body], figures: &[CellFigures]) -> String {
    let mut text =
        String::from("# vtk DataFile Version 3.0\ncells, mm\nASCII\nDATASET UNSTRUCTURED_GRID\n");
    let count: usize = bodies.iter().map(|body| body.corners.len()).sum();
    let _ = writeln!(text, "POINTS {count} double");
    for at in bodies.iter().flat_map(|body| &body.corners) {
        line(&mut text, " ", &coordinates(at));
    }
    // Each cell: how many numbers follow, how many faces, and each face with its count.
    let numbers = |body: &Body| 1 + body.faces.iter().map(|face| face.len() + 1).sum::<usize>();
    let all: usize = bodies.iter().map(|body| 1 + numbers(body)).sum();
    let _ = writeln!(text, "CELLS {} {all}", bodies.len());
    let mut first = 0;
    for body in bodies {
        let mut row = vec![numbers(body), body.faces.len()];
        for face in &body.faces {
            row.push(face.len());
            row.extend(face.iter().map(|&at| at as usize + first));
        }
        line(&mut text, " ", &row);
        first += body.corners.len();
    }
    let _ = writeln!(text, "CELL_TYPES {}", bodies.len());
    for _ in bodies {
        let _ = writeln!(text, "{VTK_POLYHEDRON}");
    }
    let _ = writeln!(text, "CELL_DATA {}", bodies.len());
    let volumes: Vec<f64> = figures.iter().map(|figures| figures.volume_mm3).collect();
    let energies: Vec<f64> = figures.iter().map(|figures| figures.energy_mm4).collect();
    for (name, values) in [("volume_mm3", volumes), ("energy_mm4", energies)] {
        let _ = writeln!(text, "SCALARS {name} double 1\nLOOKUP_TABLE default");
        for value in values {
            let _ = writeln!(text, "{value}");
        }
    }
    text
}

/// Returns coordinates without the sign of −0.0, so that equal places have equal bytes.
fn coordinates(at: &Point) -> [f64; 3] {
    [at.x, at.y, at.z].map(|x| x + 0.0)
}

/// Adds numbers as a line. Writing into a string cannot fail.
fn line<T: Display>(text: &mut String, between: &str, numbers: &[T]) {
    for (index, number) in numbers.iter().enumerate() {
        let before = if index == 0 { "" } else { between };
        let _ = write!(text, "{before}{number}");
    }
    text.push('\n');
}
