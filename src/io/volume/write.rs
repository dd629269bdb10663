//! Writes volume meshes as text: Gmsh's `.msh` of version 2.2, and legacy `.vtk` of version 3.0.
//!
//! These versions are old, and the most programs read them. Numbers are written so that they read
//! back to the last bit.

use std::fmt::Write;

use crate::tets::{Densities, Tets};

/// The name of the data with the densities.
const DENSITY: &str = "density";
/// The number of a tetrahedron in Gmsh and in VTK.
const GMSH_TETRAHEDRON: u32 = 4;
const VTK_TETRAHEDRON: u32 = 10;

/// Returns a mesh as a `.msh` file, with its densities as data of nodes or elements.
pub fn encode_msh(tets: &Tets) -> String {
    let mut text = String::from("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n");
    line(&mut text, [tets.vertices().len()]);
    for (number, at) in (1..).zip(tets.vertices()) {
        let [x, y, z] = [at.x, at.y, at.z].map(without_sign);
        text += &format!("{number} {x} {y} {z}\n");
    }
    text += "$EndNodes\n$Elements\n";
    line(&mut text, [tets.cells().len()]);
    for (number, cell) in (1..).zip(tets.cells()) {
        // Two tags: one physical group, one volume.
        let [a, b, c, d] = cell.map(|corner| corner + 1);
        line(&mut text, [number, GMSH_TETRAHEDRON, 2, 1, 1, a, b, c, d]);
    }
    text += "$EndElements\n";
    let (section, values) = match tets.densities() {
        Densities::Solid => return text,
        Densities::Corners(values) => ("NodeData", values),
        Densities::Cells(values) => ("ElementData", values),
    };
    // One name, one time, and the step 0 with one component for so many.
    text += &format!("${section}\n1\n\"{DENSITY}\"\n1\n0\n3\n0\n1\n");
    line(&mut text, [values.len()]);
    for (number, &value) in (1..).zip(values) {
        text += &format!("{number} {}\n", without_sign(value));
    }
    text += &format!("$End{section}\n");
    text
}

/// Returns a mesh as a legacy `.vtk` file, with its densities as data of points or cells.
pub fn encode_vtk(tets: &Tets) -> String {
    let mut text = String::from(
        "# vtk DataFile Version 3.0\nvolume mesh, mm\nASCII\nDATASET UNSTRUCTURED_GRID\n",
    );
    text += &format!("POINTS {} double\n", tets.vertices().len());
    for at in tets.vertices() {
        let [x, y, z] = [at.x, at.y, at.z].map(without_sign);
        text += &format!("{x} {y} {z}\n");
    }
    let count = tets.cells().len();
    text += &format!("CELLS {count} {}\n", 5 * count);
    for &[a, b, c, d] in tets.cells() {
        line(&mut text, [4, a, b, c, d]);
    }
    text += &format!("CELL_TYPES {count}\n");
    for _ in 0..count {
        line(&mut text, [VTK_TETRAHEDRON]);
    }
    let (section, values) = match tets.densities() {
        Densities::Solid => return text,
        Densities::Corners(values) => ("POINT_DATA", values),
        Densities::Cells(values) => ("CELL_DATA", values),
    };
    text += &format!("{section} {}\n", values.len());
    text += &format!("SCALARS {DENSITY} double 1\nLOOKUP_TABLE default\n");
    for &value in values {
        text += &format!("{}\n", without_sign(value));
    }
    text
}

/// Adds numbers as a line.
fn line<T: std::fmt::Display, const N: usize>(text: &mut String, numbers: [T; N]) {
    for (index, number) in numbers.iter().enumerate() {
        let before = if index == 0 { "" } else { " " };
        // Writing into a string cannot fail.
        let _ = write!(text, "{before}{number}");
    }
    text.push('\n');
}

/// Returns a number without the sign of −0.0, so that equal places have equal bytes.
fn without_sign(number: f64) -> f64 {
    number + 0.0
}

#[cfg(test)]
mod tests {
    use super::super::{DataChoice, decode_volume};
    use super::*;
    use crate::geom::Point;
    use crate::tets::TetsParts;

    #[test]
    fn what_is_written_reads_back_to_the_last_bit() {
        let corners = [
            [0.1, 0.0, -0.0],
            [1.0 / 3.0, 0.0, 0.0],
            [0.0, 1e-7, 0.0],
            [0.0, 0.0, 1e5],
        ];
        let all = [
            Densities::Solid,
            Densities::Corners(vec![0.1, 1.0 / 3.0, 0.0, 1.0]),
            Densities::Cells(vec![2.0 / 3.0]),
        ];
        for densities in all {
            let parts = TetsParts {
                vertices: corners.map(Point::from).to_vec(),
                cells: vec![[0, 1, 2, 3]],
                densities,
            };
            let tets = Tets::new(parts).unwrap();
            for text in [encode_msh(&tets), encode_vtk(&tets)] {
                let back = decode_volume(text.as_bytes(), &DataChoice::Auto)
                    .unwrap()
                    .tets;
                assert_eq!(back.vertices(), tets.vertices());
                assert_eq!(back.cells(), tets.cells());
                assert_eq!(back.densities(), tets.densities());
            }
        }
    }
}
