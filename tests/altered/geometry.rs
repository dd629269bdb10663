//! Alterations of shapes: dents, shifts, scales, loose bodies, holes, exchanges, poses.

use equipoise::geom::{Point, Vector};
use equipoise::mesh::TriMesh;
use equipoise::mesh::primitives::ball;
use serde_json::{Value, json};

use super::dice::Dice;
use super::kits::Kit;

/// The uncut result.
const HOLLOWED: &str = "hollowed.stl";
/// The folder of the model in a kit.
const MODEL: &str = "model/";
/// The least dent, mm, just above what the judge lets pass, and the factor to the greatest.
const DENT_MM: [f64; 2] = [0.002_5, 100.0];
/// The distance of a shift, mm.
const SHIFT_MM: f64 = 0.02;
/// The share by which a shape is scaled.
const SCALE_RATIO: f64 = 1e-4;
/// Triangles lower than this share of their longest side have no normal to move along.
const SLIVER_RATIO: f64 = 0.02;
/// Corners within this distance are the same in two files, mm.
const SAME_MM: f64 = 1e-4;

/// Alters a shape of a kit at random; returns what was done.
pub fn alter(kit: &mut Kit, dice: &mut Dice) -> String {
    let count = kit.sheet()["parts"].as_array().unwrap().len();
    let part = dice.pick(count);
    let file = match dice.pick(4) {
        0 => HOLLOWED.to_owned(),
        _ => kit.part_file(part),
    };
    let mesh = kit.mesh(&file);
    let amount_mm = dice.sign() * DENT_MM[0] * DENT_MM[1].powf(dice.share());
    let (what, altered) = match dice.pick(10) {
        0..4 => ("dent", dent(&mesh, dice, amount_mm)),
        4 => ("loose body", add_body(&mesh, dice, amount_mm)),
        5 => ("shift", shift(&mesh, dice)),
        6 => ("scale", scale(&mesh, dice)),
        7 => ("hole", drop_triangle(&mesh, dice)),
        8 if count > 1 => return exchange(kit),
        8 => ("turned triangle", turn_triangle(&mesh, dice)),
        _ => return shift_pose(kit, part, dice),
    };
    kit.set_mesh(&file, &altered);
    format!("{what} of {file} by {amount_mm:.4} mm")
}

/// Moves a corner of the outside in the uncut result and in the parts alike, so that they agree.
pub fn dent_outside(kit: &mut Kit, dice: &mut Dice) -> String {
    let whole = kit.mesh(HOLLOWED);
    let outside = model_corners(kit);
    let is_outside = |at: &Point| outside.iter().any(|p| (p - at).norm() < SAME_MM);
    let (at, way) = pick_corner(&whole, dice, is_outside);
    let amount_mm = dice.sign() * DENT_MM[0] * DENT_MM[1].powf(dice.share());
    let moved = pull(&whole, at, way * amount_mm);
    kit.set_mesh(HOLLOWED, &moved);
    let sheet = kit.sheet();
    for part in sheet["parts"].as_array().unwrap() {
        let (turn, shift) = pose(part);
        let to_print = |p: &Point| Point::from(turn.map(|row| row.dot(&p.coords))) + shift;
        let file = part["file"].as_str().unwrap();
        let mesh = kit.mesh(file);
        let way = to_print(&(at + way * amount_mm)) - to_print(&at);
        let place = to_print(&at);
        let near = mesh.map_vertices(|p| {
            if (p - place).norm() < SAME_MM {
                p + way
            } else {
                *p
            }
        });
        kit.set_mesh(file, &near);
    }
    format!("dent of the outside by {amount_mm:.4} mm")
}

/// Returns the corners of the kit's model in the size of the kit.
fn model_corners(kit: &Kit) -> Vec<Point> {
    let scale_ratio = kit.sheet()["model"]["scale_ratio"].as_f64().unwrap();
    let file = kit
        .files
        .keys()
        .find(|file| file.starts_with(MODEL))
        .unwrap();
    let model = kit.mesh(file);
    model.vertices().iter().map(|p| p * scale_ratio).collect()
}

/// Returns the rows of a part's turn, and its shift.
fn pose(part: &Value) -> ([Vector; 3], Vector) {
    let cell = |row: usize, column: usize| part["print_from_model"][row][column].as_f64().unwrap();
    let turn = [0, 1, 2].map(|row| Vector::from([0, 1, 2].map(|column| cell(row, column))));
    (turn, Vector::from([0, 1, 2].map(|row| cell(row, 3))))
}

/// Returns the height of a triangle over its longest side, as a share of that side.
fn share_of_height([a, b, c]: &[Point; 3]) -> f64 {
    let longest = [b - a, c - b, a - c].map(|side| side.norm());
    let longest = longest.into_iter().fold(f64::MIN_POSITIVE, f64::max);
    (b - a).cross(&(c - a)).norm() / (longest * longest)
}

fn broad(mesh: &TriMesh) -> Vec<usize> {
    let corners: Vec<[Point; 3]> = mesh.iter_corners().collect();
    let is_broad = |index: &usize| {
        let corners = &corners[*index];
        let [a, b, c] = corners;
        let longest = [b - a, c - b, a - c].map(|side| side.norm());
        let longest = longest.into_iter().fold(0.0, f64::max);
        share_of_height(corners) > SLIVER_RATIO && share_of_height(corners) * longest > 0.1
    };
    (0..corners.len()).filter(is_broad).collect()
}

/// Returns a corner of a triangle that is no sliver, and the mean normal about it.
fn pick_corner(
    mesh: &TriMesh,
    dice: &mut Dice,
    is_wanted: impl Fn(&Point) -> bool,
) -> (Point, Vector) {
    let corners: Vec<[Point; 3]> = mesh.iter_corners().collect();
    let broad = broad(mesh);
    loop {
        let at = corners[broad[dice.pick(broad.len())]][dice.pick(3)];
        if is_wanted(&at) {
            let about = broad.iter().map(|&index| corners[index]);
            let about = about.filter(|corners| corners.contains(&at));
            let way: Vector = about
                .map(|[a, b, c]| (b - a).cross(&(c - a)).normalize())
                .sum();
            return (at, way.normalize());
        }
    }
}

fn pull(mesh: &TriMesh, at: Point, way: Vector) -> TriMesh {
    mesh.map_vertices(|p| if *p == at { p + way } else { *p })
}

fn dent(mesh: &TriMesh, dice: &mut Dice, amount_mm: f64) -> TriMesh {
    let (at, way) = pick_corner(mesh, dice, |_| true);
    pull(mesh, at, way * amount_mm)
}

fn add_body(mesh: &TriMesh, dice: &mut Dice, amount_mm: f64) -> TriMesh {
    let aabb = mesh.aabb();
    let shares = Vector::from([(); 3].map(|()| 1.2 * dice.share() - 0.1));
    let at = aabb.min + aabb.size().component_mul(&shares);
    let body = ball(&at, 0.01 + amount_mm.abs(), 1);
    mesh.clone().joined(&if amount_mm < 0.0 {
        body.reversed()
    } else {
        body
    })
}

fn shift(mesh: &TriMesh, dice: &mut Dice) -> TriMesh {
    let way = dice.direction() * SHIFT_MM;
    mesh.map_vertices(|p| p + way)
}

fn scale(mesh: &TriMesh, dice: &mut Dice) -> TriMesh {
    let ratio = 1.0 + dice.sign() * SCALE_RATIO;
    mesh.map_vertices(|p| p * ratio)
}

fn drop_triangle(mesh: &TriMesh, dice: &mut Dice) -> TriMesh {
    let (mut faces, broad) = (mesh.triangles().to_vec(), broad(mesh));
    faces.remove(broad[dice.pick(broad.len())]);
    TriMesh::new(mesh.vertices().to_vec(), faces).unwrap()
}

fn turn_triangle(mesh: &TriMesh, dice: &mut Dice) -> TriMesh {
    let (mut faces, broad) = (mesh.triangles().to_vec(), broad(mesh));
    faces[broad[dice.pick(broad.len())]].swap(0, 1);
    TriMesh::new(mesh.vertices().to_vec(), faces).unwrap()
}

fn exchange(kit: &mut Kit) -> String {
    let [first, second] = [0, 1].map(|part| kit.part_file(part));
    let (a, b) = (kit.files[&first].clone(), kit.files[&second].clone());
    kit.files.insert(first, b);
    kit.files.insert(second, a);
    "exchange of P01 and P02".to_owned()
}

fn shift_pose(kit: &mut Kit, part: usize, dice: &mut Dice) -> String {
    let (mut sheet, way) = (kit.sheet(), dice.direction() * SHIFT_MM);
    for row in 0..3 {
        let cell = &mut sheet["parts"][part]["print_from_model"][row][3];
        *cell = json!(cell.as_f64().unwrap() + way[row]);
    }
    kit.set_sheet(&sheet);
    format!("pose of part {part}")
}
