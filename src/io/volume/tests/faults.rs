//! Files with faults: each is told with its place.

use super::*;

/// A text of a sound file, its replacement, and the words of the error.
const GMSH_FAULTS: &[(&str, &str, &str)] = &[
    (
        "2.2 0",
        "4.0 0",
        "line 2: it is Gmsh's format of version 4.0",
    ),
    (
        "2.2 0 8",
        "2.2 0 4",
        "line 2: it is a file with numbers of 4 bytes",
    ),
    (
        "2 1 0 0",
        "2 1 x 0",
        "line 11: expected three finite coordinates, found \"x 0\"",
    ),
    ("2 1 0 0", "2 1 inf 0", "line 11: "),
    ("2 1 0 0", "1 1 0 0", "two with the name node 1"),
    (
        "6\n1 0",
        "99999999999\n1 0",
        "99999999999 nodes are claimed",
    ),
    (
        "6\n1 0",
        "7\n1 0",
        "line 16: expected the number of a node, found \"$EndNodes\"",
    ),
    (
        "7 4 2 1 1 2",
        "7 5 2 1 1 1 2 3 10 2",
        "line 21: it is one of 1 hexahedra",
    ),
    (
        "7 4 2 1 1 2",
        "7 11 2 1 1 1 2 3 1 2 3 2",
        "line 21: it is one of 1 curved tetrahedra",
    ),
    (
        "7 4 2",
        "7 99 2",
        "line 21: expected a known kind of element",
    ),
    ("3 10 11\n", "3 10 13\n", "line 21: there is no node 13"),
    (
        "3 10 11\n",
        "3 10 10\n",
        "line 21: tetrahedron 2 names corner 4 twice",
    ),
    (
        "$EndElements",
        "$EndElement",
        "line 22: expected $EndElements",
    ),
    (
        "11 0.5",
        "11 1240",
        "line 36: the density of corner 5 is 1240",
    ),
    ("11 0.5", "12 0.5", "has no value for node 11"),
    ("11 0.5", "99 0.5", "line 36: there is no node 99"),
    (
        "11 0.5\n$EndNodeData\n",
        "11",
        "ends where it should hold a value",
    ),
    (
        "$Nodes",
        "$Knots",
        "ends where it should hold the end of a section",
    ),
];

#[test]
fn a_fault_in_a_gmsh_file_is_told_with_its_line() {
    let with = |from: &str, to: &str| {
        let text = format!("{MSH_2}{NODE_DATA}");
        assert!(text.contains(from), "{from}");
        says(text.replacen(from, to, 1).as_bytes())
    };
    for &(from, to, expected) in GMSH_FAULTS {
        let said = with(from, to);
        assert!(said.contains(expected), "{said}, not {expected}");
    }
    let surface = MSH_2.replace("2 4 2", "2 3 2").replace("7 4 2", "7 3 2");
    assert!(says(surface.as_bytes()).contains("only 1 triangles, 2 quadrangles"));
    assert!(says(b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n").contains("no tetrahedra"));
    assert!(says(b"a letter").contains("neither"));
}

#[test]
fn a_fault_in_a_vtk_file_is_told_with_its_line() {
    let with = |from: &str, to: &str| {
        let text = format!("{VTK}{VTK_POINTS}{VTK_CELLS}");
        assert!(text.contains(from), "{from}");
        says(text.replacen(from, to, 1).as_bytes())
    };
    for (from, to, expected) in [
        ("ASCII", "MORSE", "line 3: expected ASCII or BINARY"),
        (
            "UNSTRUCTURED_GRID",
            "POLYDATA",
            "line 4: it is a data set of kind POLYDATA",
        ),
        (
            "POINTS 6 double",
            "POINTS 6 quad",
            "line 5: expected a type of numbers",
        ),
        (
            "POINTS 6 double",
            "POINTS 987654321 double",
            "987654321 points are claimed",
        ),
        (
            "0 1 0 0 0 1",
            "0 1 0 0 nan 1",
            "line 7: expected three finite coordinates",
        ),
        (
            "4 1 2 3 4\n",
            "4 1 2 3 8\n",
            "line 12: tetrahedron 2 names corner 9",
        ),
        (
            "4 1 2 3 4\n",
            "4 1 2 3 -1\n",
            "line 12: expected the number of a point",
        ),
        (
            "CELL_TYPES 3\n5",
            "CELL_TYPES 2\n5",
            "line 13: expected as many types as cells",
        ),
        ("10\n10\n", "10\n12\n", "line 12: it is one of 1 hexahedra"),
        ("10\n10\n", "10\n10\n10\n", "expected a word such as POINTS"),
        (
            "5\n10\n10\n",
            "10\n10\n10\n",
            "line 10: expected as many corners as its type has",
        ),
        (
            "POINT_DATA 6",
            "POINT_DATA 5",
            "line 17: expected as many values as points",
        ),
        (
            "0.4 0.5 0\n",
            "0.4 x 0\n",
            "line 21: the density of corner 5 is NaN",
        ),
        (
            "SCALARS density",
            "SCALES density",
            "line 18: expected a word such as SCALARS",
        ),
        (
            "rho 1 3 double",
            "rho 1 3 string",
            "an array of type string",
        ),
    ] {
        let said = with(from, to);
        assert!(said.contains(expected), "{said}, not {expected}");
    }
}

#[test]
fn densities_of_tetrahedra_that_are_no_numbers_are_not_taken_for_labels() {
    let nodes = b"4 3 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
    for word in ["nan", "inf", "-inf"] {
        let cells = format!("1 4 1\n1 1 2 3 4 {word}\n");
        let read = decode_tetgen([nodes, cells.as_bytes()], &DataChoice::Auto);
        let (file, error) = read.expect_err(word);
        assert_eq!(file, 1, "{error}");
        assert!(
            error.to_string().contains("line 2: the density of"),
            "{error}"
        );
    }
}

#[test]
fn a_fault_in_tetgen_s_files_is_told_with_its_line() {
    let says = |from: &str, to: &str| {
        assert!(NODE.contains(from) || ELE.contains(from), "{from}");
        let files = [NODE.replacen(from, to, 1), ELE.replacen(from, to, 1)];
        let files = [files[0].as_bytes(), files[1].as_bytes()];
        let (file, error) = decode_tetgen(files, &DataChoice::Auto).expect_err(to);
        format!("{file} {error}")
    };
    for (from, to, expected) in [
        (
            "5 3 1",
            "9 3 1",
            "0 line 10: the file ends where it should hold as many nodes",
        ),
        ("5 3 1", "5 2 1", "0 line 2: it is a mesh of dimension 2"),
        (
            "2 1 0 0 0.2",
            "3 1 0 0 0.2",
            "0 line 4: expected nodes numbered one by one",
        ),
        (
            "2 1 0 0 0.2",
            "2 1 0 y 0.2",
            "0 line 4: expected three coordinates",
        ),
        (
            "2 1 0 0 0.2",
            "2 1 0 inf 0.2",
            "0 line 4: expected three finite coordinates",
        ),
        ("0.2", "7.2", "0 line 4: the density of corner 2 is 7.2"),
        ("2 4 0", "2 10 0", "1 line 1: it is a mesh with 10 nodes"),
        ("2 2 3 4 5", "2 2 3 4 6", "1 line 3: there is no node 6"),
        ("2 2 3 4 5", "2 2 3 4 0", "1 line 3: there is no node 0"),
        (
            "2 2 3 4 5",
            "2 2 3 4",
            "1 line 3: expected four numbers of nodes",
        ),
        ("2 4 0", "3 4 0", "1 line 4: the file ends"),
    ] {
        let said = says(from, to);
        assert!(said.starts_with(expected), "{said}, not {expected}");
    }
}

#[test]
fn a_file_cut_off_anywhere_is_refused_or_says_no_less_than_it_did() {
    let texts = [format!("{MSH_2}{NODE_DATA}"), format!("{VTK}{VTK_CELLS}")];
    let binary = [
        binary_two(false),
        binary_four(true),
        binary_vtk(false),
        binary_vtk(true),
    ];
    for whole in texts.map(String::into_bytes).into_iter().chain(binary) {
        for end in 0..whole.len() {
            if let Ok(volume) = read(&whole[..end]) {
                assert_eq!(volume.tets.cells().len(), 2, "cut at {end}");
            }
        }
    }
}

#[test]
fn more_kinds_of_data_than_anybody_writes_are_refused() {
    let data = |name: usize| NODE_DATA.replace("density", &format!("d{name}"));
    let all = |count: usize| MSH_2.to_owned() + &(0..count).map(data).collect::<String>();
    assert!(!says(all(64).as_bytes()).contains("kinds of data"));
    assert!(says(all(65).as_bytes()).contains("more than 64 kinds of data"));
}

#[test]
fn a_long_table_is_read_in_the_time_that_its_length_takes() {
    const COUNT: usize = 100_000;
    // The helix of Boerdijk and Coxeter: regular tetrahedra, each on a face of the one before.
    let radius = 0.3 * 3.0_f64.sqrt();
    let corner = |k: usize| {
        let turn = k as f64 * (-2.0_f64 / 3.0).acos();
        let along = k as f64 / 10.0_f64.sqrt();
        format!(
            "{k} {:.17} {:.17} {along:.17}\n",
            radius * turn.cos(),
            radius * turn.sin()
        )
    };
    let nodes = format!("{} 3 0 0\n", COUNT + 3) + &(0..COUNT + 3).map(corner).collect::<String>();
    let cell = |k: usize| format!("{k} {} {} {} {}\n", k, k + 1, k + 2, k + 3);
    let cells = format!("{COUNT} 4 0\n") + &(0..COUNT).map(cell).collect::<String>();
    let begun = std::time::Instant::now();
    let files = [nodes.as_bytes(), cells.as_bytes()];
    let read = decode_tetgen(files, &DataChoice::Auto).unwrap();
    // Read again for each row, such tables took minutes.
    assert!(begun.elapsed().as_secs() < 30, "{:?}", begun.elapsed());
    let each_mm3 = 1.0 / (6.0 * 2.0_f64.sqrt());
    assert!((mass(&read) / (COUNT as f64 * each_mm3) - 1.0).abs() < 1e-9);
}
