//! Small sound files of every format, to be damaged.

use std::io::{Cursor, Read, Write};
use std::path::Path;

use equipoise::base::dialect::Dialect;
use equipoise::base::units::Length;
use equipoise::base::walls::Walls;
use equipoise::geom::{Point, Vector};
use equipoise::goal::{GoalKind, Request};
use equipoise::io::layers::{
    STACK_FILE, StackPlate, StackRow, encode_grey, encode_sl1, image_name,
};
use equipoise::io::stl;
use equipoise::io::threemf::{
    Build, Object, Package, PrintSettings, SparseRegion, Transform, decode_plate,
};
use equipoise::io::{CutDrawing, CutLayer, DrawnLine, DrawnShape, encode_cut_svg, encode_dxf};
use equipoise::job::core_kit::{CoreJob, CutChoice};
use equipoise::job::telescope::TelescopeJob;
use equipoise::job::{Job, ModelChoice, PrinterChoice, Scaling};
use equipoise::mesh::TriMesh;

/// The corners of a tetrahedron, mm.
const CORNERS: [[f64; 3]; 4] = [[0., 0., 0.], [10., 0., 0.], [0., 10., 0.], [0., 0., 10.]];
/// Its faces, turned outwards.
const FACES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

/// The part of a package with the model.
const MODEL_PART: &str = "3D/3dmodel.model";

fn tetrahedron() -> TriMesh {
    TriMesh::new(CORNERS.map(Point::from).to_vec(), FACES.to_vec()).unwrap()
}

/// Returns a binary STL.
pub fn binary_stl() -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.stl");
    stl::write(&path, &tetrahedron(), "a").unwrap();
    std::fs::read(path).unwrap()
}

/// Returns an STL in text.
pub fn text_stl() -> Vec<u8> {
    let mut text = String::from("solid a\n");
    for face in FACES {
        text += " facet normal 0 0 0\n  outer loop\n";
        for corner in face {
            let [x, y, z] = CORNERS[corner as usize];
            text += &format!("   vertex {x:e} {y} {z}\n");
        }
        text += "  endloop\n endfacet\n";
    }
    (text + "endsolid a\n").into_bytes()
}

/// Returns an OBJ with texture and normal indices and a face of four corners.
pub fn obj() -> Vec<u8> {
    b"# a\nmtllib a.mtl\no box\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 1 1.0\nvt 0 0\nvn 0 0 1\n\
      f 4/1/1 3/1/1 2/1/1 1/1/1\nf 1//1 2//1 5//1\nf 2 3 5\nf -3 -2 -1\nf 4 1 5\n"
        .to_vec()
}

/// Returns an OBJ with lines.
pub fn obj_lines() -> Vec<u8> {
    b"v 0 0 0\nv 10 0 0\nv 20 5 0\nv 30 5 1\nl 1 2 3\nl 3 4\n".to_vec()
}

/// Returns a PLY in text.
pub fn text_ply() -> Vec<u8> {
    let mut text = String::from(
        "ply\nformat ascii 1.0\ncomment a\nelement vertex 4\nproperty float x\nproperty float y\n\
         property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n",
    );
    for [x, y, z] in CORNERS {
        text += &format!("{x} {y} {z}\n");
    }
    for [a, b, c] in FACES {
        text += &format!("3 {a} {b} {c}\n");
    }
    text.into_bytes()
}

/// Returns a binary PLY with a property that is skipped.
pub fn binary_ply() -> Vec<u8> {
    let mut bytes = b"ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty double x\n\
        property double y\nproperty double z\nproperty uchar red\nelement face 4\n\
        property list uchar uint vertex_indices\nend_header\n"
        .to_vec();
    for corner in CORNERS {
        bytes.extend(corner.iter().flat_map(|x| x.to_le_bytes()));
        bytes.push(200);
    }
    for face in FACES {
        bytes.push(3);
        bytes.extend(face.iter().flat_map(|at| at.to_le_bytes()));
    }
    bytes
}

/// Returns a PLY with edges.
pub fn ply_edges() -> Vec<u8> {
    b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
      element edge 2\nproperty int vertex1\nproperty int vertex2\nend_header\n\
      0 0 0\n10 0 0\n20 5 0\n0 1\n1 2\n"
        .to_vec()
}

fn packed(build: fn(Vec<(usize, Transform)>) -> Build) -> Vec<u8> {
    let objects = [Object::new("P01", [200, 100, 50], &tetrahedron())];
    let shifted = Transform::shift(Vector::new(30.0, 20.0, 0.0));
    let package = Package {
        title: "a".to_owned(),
        description: "A tetrahedron.".to_owned(),
        job: "a".to_owned(),
        objects: &objects,
        build: build(vec![(0, Transform::default()), (0, shifted)]),
        settings: None,
    };
    package.encode().unwrap()
}

/// Returns the part of a package with its model.
pub fn model_part() -> Vec<u8> {
    let mut zip = zip::ZipArchive::new(Cursor::new(package())).unwrap();
    let mut part = Vec::new();
    zip.by_name(MODEL_PART)
        .unwrap()
        .read_to_end(&mut part)
        .unwrap();
    part
}

/// Returns a plate that orders sparse infill in the words of a dialect.
pub fn plate(dialect: Dialect) -> Vec<u8> {
    let region = SparseRegion {
        mesh: tetrahedron(),
        pattern: "gyroid".to_owned(),
        percent: 15.0,
    };
    let objects = [Object::with_regions(
        "P01",
        [200, 100, 50],
        &tetrahedron(),
        &[region],
    )];
    let package = Package {
        title: "a".to_owned(),
        description: "A tetrahedron.".to_owned(),
        job: "a".to_owned(),
        objects: &objects,
        build: Build::Items(vec![(0, Transform::default())]),
        settings: Some(PrintSettings {
            dialect,
            layer_mm: 0.2,
            line_mm: 0.45,
            walls: Walls::default(),
            overhang_deg: Some(45.0),
        }),
    };
    let bytes = package.encode().unwrap();
    assert_eq!(decode_plate(&bytes).unwrap()[0].regions.len(), 1);
    bytes
}

/// Returns the parts of a package that hold text, by name.
pub fn text_parts(package: &[u8]) -> Vec<(String, Vec<u8>)> {
    let mut zip = zip::ZipArchive::new(Cursor::new(package)).unwrap();
    let parts = (0..zip.len()).map(|index| {
        let mut file = zip.by_index(index).unwrap();
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).unwrap();
        (file.name().unwrap().into_owned(), bytes)
    });
    parts.collect()
}

/// Returns a program in Prusa's binary container, in one plain block without a sum.
pub fn binary_gcode() -> Vec<u8> {
    let block = |kind: u16, data: &[u8]| {
        let mut bytes = [kind.to_le_bytes(), 0_u16.to_le_bytes()].concat();
        bytes.extend((data.len() as u32).to_le_bytes());
        bytes.extend(0_u16.to_le_bytes());
        bytes.extend(data);
        bytes
    };
    let mut file = [b"GCDE".as_slice(), &[1, 0, 0, 0, 0, 0]].concat();
    file.extend(block(0, b"Producer=PrusaSlicer 2.6.0\n"));
    file.extend(block(2, b"filament_diameter=1.75\n"));
    file.extend(block(1, &gcode()));
    file
}

/// Returns a sound package around this part.
pub fn package_of(part: &[u8]) -> Vec<u8> {
    repacked(&package(), MODEL_PART, part)
}

/// Returns a package with one of its parts replaced.
pub fn repacked(package: &[u8], changed: &str, part: &[u8]) -> Vec<u8> {
    let mut sound = zip::ZipArchive::new(Cursor::new(package)).unwrap();
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for index in 0..sound.len() {
        let mut file = sound.by_index(index).unwrap();
        let name = file.name().unwrap().into_owned();
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).unwrap();
        zip.start_file(&name, zip::write::SimpleFileOptions::default())
            .unwrap();
        zip.write_all(if name == changed { part } else { &bytes })
            .unwrap();
    }
    zip.finish().unwrap().into_inner()
}

/// Returns a 3MF of two items.
pub fn package() -> Vec<u8> {
    packed(Build::Items)
}

/// Returns a 3MF of one object with two components.
pub fn package_of_components() -> Vec<u8> {
    packed(|places| Build::Assembly("whole".to_owned(), places))
}

/// Returns a program of a filament printer.
pub fn gcode() -> Vec<u8> {
    b"; generated by PrusaSlicer 2.5.0 on 2026-01-01\nM82\nG92 E0\n;TYPE:Perimeter\n;HEIGHT:0.2\n\
      G1 Z0.2 F7200\nG1 X10 Y10\n; printing object P01 id:0 copy 0\nG1 X20 Y10 E1\nG2 X30 Y20 I10 J0 E2.5\n\
      M83\nG1 E-0.8\nG1 X10 Y10 E.5\n; stop printing object P01 id:0 copy 0\n; filament_diameter = 1.75\n\
      ; filament_density = 1.24\n"
        .to_vec()
}

/// Returns an image of a layer.
pub fn image() -> Vec<u8> {
    let mut grey = [0; 48];
    grey[10..14].fill(255);
    grey[18..22].fill(128);
    encode_grey([8, 6], &grey).unwrap()
}

/// The settings of a small display.
pub const SL1_SETTINGS: &str = "display_width = 8\ndisplay_height = 6\ndisplay_pixels_x = 8\n\
    display_pixels_y = 6\ndisplay_orientation = landscape\ndisplay_mirror_x = 1\n\
    initial_layer_height = 0.05\n";

/// Returns an SL1 of three layers.
pub fn sl1() -> Vec<u8> {
    sl1_of(SL1_SETTINGS.as_bytes(), &image())
}

/// Returns a sound archive of these settings and this image, three times.
pub fn sl1_of(settings: &[u8], image: &[u8]) -> Vec<u8> {
    let parts = [
        ("config.ini", "layerHeight = 0.05\nnumFast = 3\n".to_owned()),
        (
            "prusaslicer.ini",
            String::from_utf8_lossy(settings).into_owned(),
        ),
    ];
    encode_sl1("a", &parts, &[image, image, image].map(<[u8]>::to_vec)).unwrap()
}

/// Writes a stack of two images into a folder.
pub fn write_stack(folder: &Path) {
    let images = folder.join("plate");
    std::fs::create_dir(&images).unwrap();
    for layer in 0..2 {
        std::fs::write(images.join(image_name(layer)), image()).unwrap();
    }
    let list = StackRow {
        schema: StackRow::SCHEMA,
        job: "a".to_owned(),
        plates: vec![StackPlate {
            plate: "plate.3mf".to_owned(),
            folder: "plate".to_owned(),
            pixel_mm: [0.05, 0.05],
            corner_mm: [1.0, 2.0],
            pixels: [8, 6],
            layer_mm: 0.05,
            layers: 2,
            volume_mm3: 0.1,
        }],
    };
    let text = serde_json::to_string_pretty(&list).unwrap();
    std::fs::write(folder.join(STACK_FILE), text).unwrap();
}

/// Returns an order of cuts with all that one can say.
pub fn cuts() -> Vec<u8> {
    b"[[cuts]]\nid = \"C1\"\npoint_mm = [0.0, 0.0, 20.0]\nnormal = [0.0, 0.0, 1.0]\n\n[[cuts]]\nid = \"C2\"\n\
      point_mm = [5.0, 0.0, 0.0]\nnormal = [1.0, 0.0, 0.0]\nwithin = [{ cut = \"C1\", side = \"above\" }]\n\n\
      [[uncut]]\ncut = \"C1\"\npoint_mm = [1.0, 2.0, 20.0]\n\n[[solid]]\nat_mm = [1.0, 1.0, 1.0]\n\
      low_mm = [0.0, 0.0, 0.0]\nhigh_mm = [2.0, 2.0, 2.0]\n\n[[keep_clear]]\ncenter_mm = [0.0, 0.0, 30.0]\n\
      radius_mm = 4.0\n"
        .to_vec()
}

fn printer() -> PrinterChoice {
    PrinterChoice {
        id: "prusa-mk4".into(),
        material: None,
    }
}

fn size() -> Scaling {
    Scaling::Size("100mm".parse::<Length>().unwrap())
}

/// Returns a job.
pub fn job() -> Vec<u8> {
    let model = ModelChoice {
        path: "elephant.obj".into(),
        sha256: None,
        scaling: size(),
    };
    let job = Job::new(model, printer(), Request::new(GoalKind::Top));
    job.to_toml().unwrap().into_bytes()
}

/// Returns a job of a telescope.
pub fn telescope_job() -> Vec<u8> {
    let job = TelescopeJob::new("hook.csv", size(), printer());
    job.to_toml().unwrap().into_bytes()
}

/// Returns a pose of two joints.
pub fn pose() -> Vec<u8> {
    b"kind = \"pose\"\nschema = 1\nname = \"bow\"\n\n[[joint]]\nid = \"A-J01\"\nstroke_mm = 38.2\n\
      turn_deg = -12.5\n\n[[joint]]\nid = \"J02\"\nstroke_mm = 1e1 # of 30\n"
        .to_vec()
}

/// Returns a skeleton that branches.
pub fn skeleton() -> Vec<u8> {
    b"kind = \"skeleton\"\nschema = 1\nroot = 0\nopen = []\n\n[nodes]\n0 = [0.0, 0.0, 0.0, 5.0]\n\
      1 = [0.0, 0.0, 20.0, 6.0]\n2 = [15.0, 0.0, 40.0, 4.0]\n3 = [-15.0, 0.0, 40.0, 4.0]\n\n[[branch]]\n\
      nodes = [0, 1]\nsolid = false\n\n[[branch]]\nnodes = [1, 2]\nsolid = true\n\n[[branch]]\n\
      nodes = [1, 3]\nsolid = false\n"
        .to_vec()
}

/// Returns a drawing of a sheet as DXF and as SVG.
pub fn drawings() -> [Vec<u8>; 2] {
    let square = [[10.0, 10.0], [60.0, 10.0], [60.0, 40.0], [10.0, 40.0]];
    let line = |layer, shape| DrawnLine { layer, shape };
    let circle = DrawnShape::Circle {
        center_mm: [30.0, 25.0],
        radius_mm: 1.7,
    };
    let drawing = CutDrawing {
        size_mm: [600.0, 400.0],
        lines: vec![
            line(CutLayer::Engrave, DrawnShape::Open(square[..2].to_vec())),
            line(CutLayer::Inner, circle),
            line(CutLayer::Outer, DrawnShape::Closed(square.to_vec())),
        ],
        colors: [[0, 128, 0], [0, 0, 255], [0, 0, 0], [255, 0, 0]],
    };
    [encode_dxf(&drawing), encode_cut_svg(&drawing)].map(String::into_bytes)
}

/// Returns the job of an object on a base.
pub fn core_job() -> Vec<u8> {
    let model = ModelChoice {
        path: "a.stl".into(),
        sha256: None,
        scaling: Scaling::Size(Length::from_mm(600.0).unwrap()),
    };
    let printer = PrinterChoice {
        id: "prusa-mk4".to_owned(),
        material: None,
    };
    let machines = CutChoice::new("makerspace-900x600", "birch-5");
    let job = CoreJob::new(model, printer, machines);
    job.to_toml().unwrap().into_bytes()
}

/// Returns a field with every kind of part.
pub fn field() -> Vec<u8> {
    b"[field]\nsum = [\n  \"uniform:20%\",\n  { product = [\"ramp:0,0,1@0mm..1mm:0..1\", \
      \"sine:1,2,3@4mm:0..0.5\"] },\n  { polynomial = [{ coefficient = 0.01, x = 2, z = 1 }] },\n\
      { linear = { at_origin = 0.1, gradient = [0.0, 0.01, 0.0] } },\n  \"skin:1mm:gauss:0..0.1\",\n\
      { levels = { quadric = [0, 1, 0, 0, 0, 0, 0, 0.5, 0, 0], cuts = [1.0], \
      densities = [0.1, 0.2] } },\n]\n"
        .to_vec()
}

/// Returns a base of two boxes on both sides of a plane.
pub fn base() -> Vec<u8> {
    let face = |normal: [f64; 3], offset_mm: f64, locked: bool| {
        format!(
            "[[polyhedron.face]]\nnormal = {normal:?}\noffset_mm = {offset_mm}\nlocked = {locked}\n"
        )
    };
    let sides = [
        face([0.0, 1.0, 0.0], 80.0, false),
        face([0.0, -1.0, 0.0], -10.0, false),
        face([0.0, 0.0, 1.0], 70.0, false),
        face([0.0, 0.0, -1.0], -10.0, false),
    ]
    .concat();
    let low = face([1.0, 0.0, 0.0], 149.95, true) + &face([-1.0, 0.0, 0.0], -10.0, false);
    let high = face([-1.0, 0.0, 0.0], -150.05, true) + &face([1.0, 0.0, 0.0], 290.0, false);
    let split =
        "[[split]]\nnormal = [1.0, 0.0, 0.0]\noffset_mm = 150.0\nbelow = \"Q1\"\nabove = \"Q2\"\n";
    format!("{split}[[polyhedron]]\n{sides}{low}[[polyhedron]]\n{sides}{high}").into_bytes()
}
