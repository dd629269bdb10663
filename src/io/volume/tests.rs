//! Claims of volume meshes in files: every dialect is read, and every fault is told with its place.

mod faults;

use super::{DataChoice, On, Volume, VolumeError, decode_tetgen, decode_volume};

/// Two tetrahedra on one face, with a triangle beside them, in Gmsh's version 2.2.
const MSH_2: &str = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"part\"\n\
    $EndPhysicalNames\n$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 0 1 0\n10 0 0 1\n11 1 1 1\n12 9 9 9\n\
    $EndNodes\n$Elements\n3\n1 2 2 0 1 1 2 3\n2 4 2 1 1 1 2 3 10\n7 4 2 1 1 2 3 10 11\n\
    $EndElements\n";
/// The same in version 4.1.
const MSH_4: &str = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n2 6 1 12\n2 1 1 1\n1\n\
    0 0 0 0.5 0.5\n3 1 0 5\n2\n3\n10\n11\n12\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n9 9 9\n$EndNodes\n\
    $Elements\n2 3 1 7\n2 1 2 1\n1 1 2 3\n3 -1 4 2\n2 1 2 3 10\n7 2 3 10 11\n$EndElements\n";
/// Densities of their nodes: 0.1, 0.2, 0.3, 0.4, 0.5.
const NODE_DATA: &str = "$NodeData\n1\n\"density\"\n1\n0.0\n3\n0\n1\n5\n1 0.1\n2 0.2\n3 0.3\n10 0.4\n\
    11 0.5\n$EndNodeData\n";
/// Densities of their cells, and of the triangle.
const ELEMENT_DATA: &str = "$ElementData\n1\n\"rho\"\n1\n0.0\n3\n0\n1\n3\n1 9.0\n7 0.5\n2 0.25\n\
    $EndElementData\n";
/// The volumes of the two tetrahedra, mm³.
const VOLUMES: [f64; 2] = [1.0 / 6.0, 2.0 / 6.0];
/// The mass with densities of nodes, and with those of cells.
const OF_NODES: f64 = VOLUMES[0] * 0.25 + VOLUMES[1] * 0.35;
const OF_CELLS: f64 = VOLUMES[0] * 0.25 + VOLUMES[1] * 0.5;

/// The same in VTK's legacy format.
const VTK: &str = "# vtk DataFile Version 3.0\nby hand\nASCII\nDATASET UNSTRUCTURED_GRID\n\
    POINTS 6 double\n0 0 0 1 0 0\n0 1 0 0 0 1\n1 1 1 9 9 9\nCELLS 3 14\n3 0 1 2\n4 0 1 2 3\n\
    4 1 2 3 4\nCELL_TYPES 3\n5\n10\n10\n";
const VTK_POINTS: &str = "POINT_DATA 6\nSCALARS density float 1\nLOOKUP_TABLE default\n\
    0.1 0.2 0.3\n0.4 0.5 0\nVECTORS way double\n1 2 3 1 2 3 1 2 3 1 2 3 1 2 3 1 2 3\n";
const VTK_CELLS: &str = "CELL_DATA 3\nSCALARS region int\nLOOKUP_TABLE default\n7 1 1\n\
    FIELD FieldData 2\nrho 1 3 double\n9 0.25 0.5\nMETADATA\nINFORMATION 0\n\nflow 2 3 float\n\
    1 2 3 4 5 6\n";

/// The same as TetGen writes it.
const NODE: &str = "# corners\n5 3 1 1\n1 0 0 0 0.1 0\n2 1 0 0 0.2 0 # a corner\n\n3 0 1 0 0.3 1\n\
    4 0 0 1 0.4 1\n5 1 1 1 0.5 1\n# Generated\n";
const ELE: &str = "2 4 0\n1 1 2 3 4\n2 2 3 4 5\n";

fn read(bytes: &[u8]) -> Result<Volume, VolumeError> {
    decode_volume(bytes, &DataChoice::Auto)
}

fn mass(volume: &Volume) -> f64 {
    volume.tets.moments().volume()
}

fn assert_mass(text: &str, expected: f64) {
    let volume = read(text.as_bytes()).unwrap();
    assert!(
        (mass(&volume) - expected).abs() < 1e-7,
        "{} {text}",
        mass(&volume)
    );
}

/// Returns the message of a file that is refused; it has a remedy.
fn says(bytes: &[u8]) -> String {
    let said = read(bytes).expect_err("a fault").to_string();
    let has_remedy = said.contains("remedy: ") || said.contains("export it again");
    assert!(has_remedy, "{said}");
    said
}

#[test]
fn gmsh_is_read_with_and_without_densities() {
    for mesh in [MSH_2, MSH_4] {
        assert_mass(mesh, 0.5);
        assert_mass(&format!("{mesh}{NODE_DATA}"), OF_NODES);
        assert_mass(&format!("{mesh}{ELEMENT_DATA}"), OF_CELLS);
        assert_mass(&mesh.replace('\n', "\r\n"), 0.5);
        let volume = read(mesh.as_bytes()).unwrap();
        assert_eq!(volume.density, None);
        assert_eq!(
            (volume.ignored[0].count, volume.ignored[0].kind.as_str()),
            (1, "triangles")
        );
    }
    // Data named density goes before other data.
    assert_mass(&format!("{MSH_2}{NODE_DATA}{ELEMENT_DATA}"), OF_NODES);
}

#[test]
fn binary_gmsh_is_read_in_either_order_of_bytes() {
    for is_big in [false, true] {
        for bytes in [binary_two(is_big), binary_four(is_big)] {
            let volume = read(&bytes).unwrap();
            assert!((mass(&volume) - OF_NODES).abs() < 1e-15);
        }
    }
}

/// Appends a number of 4 or 8 bytes.
fn put<const N: usize>(bytes: &mut Vec<u8>, mut number: [u8; N], is_big: bool) {
    if is_big {
        number.reverse();
    }
    bytes.extend(number);
}

const NODES: [(i32, [f64; 3]); 5] = [
    (1, [0., 0., 0.]),
    (2, [1., 0., 0.]),
    (3, [0., 1., 0.]),
    (10, [0., 0., 1.]),
    (11, [1., 1., 1.]),
];

fn binary_head(version: &str, is_big: bool) -> Vec<u8> {
    let mut bytes = format!("$MeshFormat\n{version} 1 8\n").into_bytes();
    put(&mut bytes, 1_i32.to_le_bytes(), is_big);
    bytes.extend(b"\n$EndMeshFormat\n$Nodes\n");
    bytes
}

fn binary_data(bytes: &mut Vec<u8>, is_big: bool) {
    bytes.extend(b"$NodeData\n1\n\"density\"\n1\n0\n3\n0\n1\n5\n");
    for (index, (node, _)) in NODES.iter().enumerate() {
        put(bytes, node.to_le_bytes(), is_big);
        put(bytes, (0.1 * (index + 1) as f64).to_le_bytes(), is_big);
    }
    bytes.extend(b"\n$EndNodeData\n");
}

fn binary_two(is_big: bool) -> Vec<u8> {
    let mut bytes = binary_head("2.2", is_big);
    bytes.extend(b"5\n");
    for (node, at) in NODES {
        put(&mut bytes, node.to_le_bytes(), is_big);
        at.iter()
            .for_each(|x| put(&mut bytes, x.to_le_bytes(), is_big));
    }
    bytes.extend(b"\n$EndNodes\n$Elements\n3\n");
    // A block of one triangle, and one of two tetrahedra with a tag.
    let triangle = [2, 1, 0, 1, 1, 2, 3];
    let tetrahedra = [4, 2, 1, 2, 5, 1, 2, 3, 10, 7, 5, 2, 3, 10, 11];
    for number in triangle.into_iter().chain(tetrahedra) {
        put(&mut bytes, i32::to_le_bytes(number), is_big);
    }
    bytes.extend(b"\n$EndElements\n");
    binary_data(&mut bytes, is_big);
    bytes
}

fn binary_four(is_big: bool) -> Vec<u8> {
    let mut bytes = binary_head("4.1", is_big);
    let sizes = |bytes: &mut Vec<u8>, numbers: &[u64]| {
        numbers
            .iter()
            .for_each(|it| put(bytes, it.to_le_bytes(), is_big));
    };
    let ints = |bytes: &mut Vec<u8>, numbers: &[i32]| {
        numbers
            .iter()
            .for_each(|it| put(bytes, it.to_le_bytes(), is_big));
    };
    sizes(&mut bytes, &[1, 5, 1, 11]);
    ints(&mut bytes, &[3, 1, 0]);
    sizes(&mut bytes, &[5, 1, 2, 3, 10, 11]);
    for (_, at) in NODES {
        at.iter()
            .for_each(|x| put(&mut bytes, x.to_le_bytes(), is_big));
    }
    bytes.extend(b"\n$EndNodes\n$Elements\n");
    sizes(&mut bytes, &[1, 2, 2, 7]);
    ints(&mut bytes, &[3, -1, 4]);
    sizes(&mut bytes, &[2, 2, 1, 2, 3, 10, 7, 2, 3, 10, 11]);
    bytes.extend(b"\n$EndElements\n");
    binary_data(&mut bytes, is_big);
    bytes
}

#[test]
fn vtk_is_read_with_and_without_densities() {
    assert_mass(VTK, 0.5);
    assert_mass(&format!("{VTK}{VTK_POINTS}"), OF_NODES);
    // Whole numbers label regions; vectors are no density.
    assert_mass(&format!("{VTK}{VTK_CELLS}"), OF_CELLS);
    assert_mass(&format!("{VTK}{VTK_POINTS}{VTK_CELLS}"), OF_NODES);
    let volume = read(format!("{VTK}{VTK_CELLS}").as_bytes()).unwrap();
    let density = volume.density.unwrap();
    assert_eq!((density.name.as_str(), density.on), ("rho", On::Cells));
    let new = VTK.replace(
        "CELLS 3 14\n3 0 1 2\n4 0 1 2 3\n4 1 2 3 4\n",
        "METADATA\nINFORMATION 0\n\nCELLS 4 11\nOFFSETS vtktypeint64\n0 3 7 11\n\
         CONNECTIVITY vtktypeint64\n0 1 2 0 1 2 3 1 2 3 4\n",
    );
    assert_mass(&format!("{new}{VTK_POINTS}"), OF_NODES);
}

#[test]
fn binary_vtk_is_read_with_old_and_new_lists_of_cells() {
    for is_new in [false, true] {
        let volume = read(&binary_vtk(is_new)).unwrap();
        assert!((mass(&volume) - OF_NODES).abs() < 1e-8);
    }
}

fn binary_vtk(is_new: bool) -> Vec<u8> {
    let mut bytes =
        b"# vtk DataFile Version 5.1\nx\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 float\n"
            .to_vec();
    let ints = |bytes: &mut Vec<u8>, numbers: &[i32]| {
        numbers.iter().for_each(|it| bytes.extend(it.to_be_bytes()));
    };
    let longs = |bytes: &mut Vec<u8>, numbers: &[i64]| {
        numbers.iter().for_each(|it| bytes.extend(it.to_be_bytes()));
    };
    for (_, at) in NODES {
        at.iter()
            .for_each(|x| bytes.extend((*x as f32).to_be_bytes()));
    }
    if is_new {
        bytes.extend(b"\nCELLS 3 8\nOFFSETS vtktypeint64\n");
        longs(&mut bytes, &[0, 4, 8]);
        bytes.extend(b"\nCONNECTIVITY vtktypeint64\n");
        longs(&mut bytes, &[0, 1, 2, 3, 1, 2, 3, 4]);
    } else {
        bytes.extend(b"\nCELLS 2 10\n");
        ints(&mut bytes, &[4, 0, 1, 2, 3, 4, 1, 2, 3, 4]);
    }
    bytes.extend(b"\nCELL_TYPES 2\n");
    ints(&mut bytes, &[10, 10]);
    bytes.extend(b"\nPOINT_DATA 5\nFIELD FieldData 1\ndensity 1 5 double\n");
    (1..=5).for_each(|it| bytes.extend((0.1 * f64::from(it)).to_be_bytes()));
    bytes.extend(b"\n");
    bytes
}

#[test]
fn tetgen_is_read_numbered_from_0_or_1() {
    let read = |node: &str, ele: &str| {
        let files = [node.as_bytes(), ele.as_bytes()];
        decode_tetgen(files, &DataChoice::Auto).unwrap()
    };
    assert!((mass(&read(NODE, ELE)) - OF_NODES).abs() < 1e-15);
    let node = "5 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 1 1 1\n";
    let ele = "2 4 1\n0 0 1 2 3 0.25\n1 1 2 3 4 0.5\n";
    let volume = read(node, ele);
    assert!((mass(&volume) - OF_CELLS).abs() < 1e-15);
    assert_eq!(volume.density.unwrap().name, "ele1");
    // Numbers of regions are labels.
    let labelled = ele.replace("0.25", "1").replace("0.5", "2");
    assert!((mass(&read(node, &labelled)) - 0.5).abs() < 1e-15);
}

#[test]
fn data_is_chosen_by_name_and_never_guessed() {
    let named = |name: &str| DataChoice::Named(name.to_owned());
    let two = NODE_DATA.replace("density", "rho") + &NODE_DATA.replace("density", "sigma");
    let text = format!("{MSH_2}{two}");
    let said = says(text.as_bytes());
    assert!(
        said.contains("rho, sigma") && said.contains("`data = \"rho\"`"),
        "{said}"
    );
    let volume = decode_volume(text.as_bytes(), &named("sigma")).unwrap();
    assert!((mass(&volume) - OF_NODES).abs() < 1e-15);
    let solid = decode_volume(text.as_bytes(), &DataChoice::Solid).unwrap();
    assert!((mass(&solid) - 0.5).abs() < 1e-15);
    let unknown = decode_volume(text.as_bytes(), &named("tau")).unwrap_err();
    assert!(
        unknown.to_string().contains("no data named tau"),
        "{unknown}"
    );
    let unknown = decode_volume(MSH_2.as_bytes(), &named("tau")).unwrap_err();
    assert!(unknown.to_string().contains("no data at all"), "{unknown}");
    let both = ELEMENT_DATA.replace("rho", "density");
    assert!(says(format!("{MSH_2}{NODE_DATA}{both}").as_bytes()).contains("both"));
    assert!(says(format!("{MSH_2}{NODE_DATA}{NODE_DATA}").as_bytes()).contains("density"));
}
