//! Small sound volume meshes of every format, to be damaged.

/// Two tetrahedra with densities of nodes and of elements, in versions 2.2 and 4.1.
pub fn text_msh() -> [Vec<u8>; 2] {
    let two = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"part\"\n\
        $EndPhysicalNames\n$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n10 0 0 1\n11 1 1 1\n$EndNodes\n\
        $Elements\n3\n1 2 2 0 1 1 2 3\n2 4 2 1 1 1 2 3 10\n7 4 2 1 1 2 3 10 11\n$EndElements\n\
        $NodeData\n1\n\"density\"\n1\n0.0\n3\n0\n1\n5\n1 0.1\n2 0.2\n3 0.3\n10 0.4\n11 0.5\n\
        $EndNodeData\n";
    let four = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n2 5 1 11\n2 1 1 1\n1\n\
        0 0 0 0.5 0.5\n3 1 0 4\n2\n3\n10\n11\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n$EndNodes\n$Elements\n\
        2 3 1 7\n2 1 2 1\n1 1 2 3\n3 -1 4 2\n2 1 2 3 10\n7 2 3 10 11\n$EndElements\n$ElementData\n\
        1\n\"rho\"\n1\n0.0\n3\n0\n1\n2\n7 0.5\n2 0.25\n$EndElementData\n";
    [two, four].map(|text| text.as_bytes().to_vec())
}

/// The nodes of both tetrahedra.
const NODES: [[f64; 3]; 5] = [
    [0., 0., 0.],
    [1., 0., 0.],
    [0., 1., 0.],
    [0., 0., 1.],
    [1., 1., 1.],
];

/// The same in binary.
pub fn binary_msh() -> [Vec<u8>; 2] {
    let head = |version: &str| {
        let mut bytes = format!("$MeshFormat\n{version} 1 8\n").into_bytes();
        bytes.extend(1_i32.to_le_bytes());
        bytes.extend(b"\n$EndMeshFormat\n$Nodes\n");
        bytes
    };
    let ints = |bytes: &mut Vec<u8>, numbers: &[i32]| {
        bytes.extend(numbers.iter().flat_map(|it| it.to_le_bytes()));
    };
    let sizes = |bytes: &mut Vec<u8>, numbers: &[u64]| {
        bytes.extend(numbers.iter().flat_map(|it| it.to_le_bytes()));
    };
    let mut two = head("2.2");
    two.extend(b"5\n");
    for (node, at) in (1..).zip(NODES) {
        ints(&mut two, &[node]);
        two.extend(at.iter().flat_map(|x| x.to_le_bytes()));
    }
    two.extend(b"\n$EndNodes\n$Elements\n3\n");
    ints(&mut two, &[2, 1, 0, 1, 1, 2, 3]);
    ints(&mut two, &[4, 2, 1, 2, 5, 1, 2, 3, 4, 7, 5, 2, 3, 4, 5]);
    two.extend(b"\n$EndElements\n");
    let mut four = head("4.1");
    sizes(&mut four, &[1, 5, 1, 5]);
    ints(&mut four, &[3, 1, 0]);
    sizes(&mut four, &[5, 1, 2, 3, 4, 5]);
    four.extend(NODES.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
    four.extend(b"\n$EndNodes\n$Elements\n");
    sizes(&mut four, &[1, 2, 2, 7]);
    ints(&mut four, &[3, -1, 4]);
    sizes(&mut four, &[2, 2, 1, 2, 3, 4, 7, 2, 3, 4, 5]);
    four.extend(b"\n$EndElements\n");
    [two, four].map(|mut bytes| {
        bytes.extend(b"$NodeData\n1\n\"density\"\n1\n0\n3\n0\n1\n5\n");
        for node in 1..=5_i32 {
            bytes.extend(node.to_le_bytes());
            bytes.extend((0.1 * f64::from(node)).to_le_bytes());
        }
        bytes.extend(b"\n$EndNodeData\n");
        bytes
    })
}

/// The same as VTK writes it, with old and new lists of cells.
pub fn text_vtk() -> [Vec<u8>; 2] {
    let head = "# vtk DataFile Version 3.0\nby hand\nASCII\nDATASET UNSTRUCTURED_GRID\n\
        POINTS 5 double\n0 0 0 1 0 0\n0 1 0 0 0 1\n1 1 1\n";
    let old = "CELLS 3 14\n3 0 1 2\n4 0 1 2 3\n4 1 2 3 4\n";
    let new = "METADATA\nINFORMATION 0\n\nCELLS 4 11\nOFFSETS vtktypeint64\n0 3 7 11\n\
        CONNECTIVITY vtktypeint64\n0 1 2 0 1 2 3 1 2 3 4\n";
    let tail = "CELL_TYPES 3\n5\n10\n10\nPOINT_DATA 5\nSCALARS density float 1\n\
        LOOKUP_TABLE default\n0.1 0.2 0.3\n0.4 0.5\nVECTORS way double\n\
        1 2 3 1 2 3 1 2 3 1 2 3 1 2 3\nCELL_DATA 3\nFIELD FieldData 2\nrho 1 3 double\n\
        9 0.25 0.5\nflow 2 3 float\n1 2 3 4 5 6\n";
    [old, new].map(|cells| format!("{head}{cells}{tail}").into_bytes())
}

/// The same in binary.
pub fn binary_vtk() -> [Vec<u8>; 2] {
    [false, true].map(|is_new| {
        let mut bytes =
            b"# vtk DataFile Version 5.1\nx\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 double\n"
                .to_vec();
        bytes.extend(NODES.as_flattened().iter().flat_map(|x| x.to_be_bytes()));
        let cells = [0, 1, 2, 3, 1, 2, 3, 4];
        if is_new {
            bytes.extend(b"\nCELLS 3 8\nOFFSETS vtktypeint64\n");
            bytes.extend([0, 4, 8].iter().flat_map(|it: &i64| it.to_be_bytes()));
            bytes.extend(b"\nCONNECTIVITY vtktypeint64\n");
            bytes.extend(cells.iter().flat_map(|it: &i64| it.to_be_bytes()));
        } else {
            bytes.extend(b"\nCELLS 2 10\n");
            for cell in cells.chunks(4) {
                let corners = cell.iter().map(|it| *it as i32);
                let all = std::iter::once(4).chain(corners);
                bytes.extend(all.flat_map(i32::to_be_bytes));
            }
        }
        bytes.extend(b"\nCELL_TYPES 2\n");
        bytes.extend([10, 10].iter().flat_map(|it: &i32| it.to_be_bytes()));
        bytes.extend(b"\nPOINT_DATA 5\nSCALARS density double\nLOOKUP_TABLE default\n");
        bytes.extend((1..=5).flat_map(|it| (0.1 * f64::from(it)).to_be_bytes()));
        bytes.extend(b"\n");
        bytes
    })
}

/// The same as TetGen's two files.
pub fn tetgen() -> [&'static [u8]; 2] {
    [
        b"# corners\n5 3 1 1\n1 0 0 0 0.1 0\n2 1 0 0 0.2 0\n3 0 1 0 0.3 1\n4 0 0 1 0.4 1\n\
          5 1 1 1 0.5 1\n",
        b"2 4 1\n1 1 2 3 4 7\n2 2 3 4 5 8\n",
    ]
}
