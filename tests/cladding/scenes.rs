//! Bodies and bases by hand, and what is measured of a shell with nothing of its maker.

use equipoise::cladding::{CladShell, Cup, Part, Scene};
use equipoise::geom::{Bvh, Plane, Point, Vector};
use equipoise::mesh::{Csg, Solid, TriMesh, primitives, shells, spread_points};
use equipoise::panels::{BracketKind, JointStyle, PanelRequest, PanelSet};
use equipoise::polyhedra::{Ground, Limits, Polyhedron, Side};

/// Bodies that overlap by less on their way touch, mm³.
pub const MOST_ON_THE_WAY_MM3: f64 = 1e-2;
/// By how much a wall may be thinner than asked, mm.
pub const LACK_MM: f64 = 0.01;
pub const SHEET_MM: f64 = 5.0;
/// The steps of a unit on its way out, mm.
const STEPS_MM: [f64; 6] = [0.2, 2.0, 8.0, 30.0, 100.0, 350.0];
/// The points at which the walls of a cup are measured.
const SAMPLES: usize = 20_000;

pub fn block(low: [f64; 3], high: [f64; 3]) -> TriMesh {
    primitives::cuboid(&low.into(), &high.into())
}

pub fn csg(mesh: &TriMesh) -> Csg {
    Csg::of_mesh(mesh).unwrap()
}

pub fn united(meshes: &[TriMesh]) -> TriMesh {
    let bodies = meshes.iter().map(csg);
    let whole = bodies.reduce(|a, b| a.union(&b).unwrap());
    whole.unwrap().to_mesh().unwrap()
}

pub fn ground(mesh: TriMesh) -> Ground {
    Ground::new(&Solid::new(mesh).unwrap()).unwrap()
}

/// Returns the base with these faces, each a normal and an offset.
pub fn base(ground: &Ground, distance_mm: f64, faces: &[(Vector, f64)]) -> Polyhedron {
    let sides: Vec<Side> = faces
        .iter()
        .map(|(normal, offset_mm)| Side {
            plane: Plane {
                normal: normal.normalize(),
                offset_mm: *offset_mm,
            },
            is_locked: false,
        })
        .collect();
    Polyhedron::new(ground, distance_mm, &sides, &Limits::NONE).unwrap()
}

pub fn cube(half_mm: [f64; 3]) -> Vec<(Vector, f64)> {
    (0..6)
        .map(|i| {
            let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
            (Vector::ith(i / 2, sign), half_mm[i / 2])
        })
        .collect()
}

pub fn octahedron(offset_mm: f64) -> Vec<(Vector, f64)> {
    let sign = |i: usize, bit: usize| if i >> bit & 1 == 0 { 1.0 } else { -1.0 };
    (0..8)
        .map(|i| (Vector::new(sign(i, 0), sign(i, 1), sign(i, 2)), offset_mm))
        .collect()
}

pub fn dodecahedron(offset_mm: f64) -> Vec<(Vector, f64)> {
    let golden = f64::midpoint(1.0, 5f64.sqrt());
    let mut faces = Vec::new();
    for a in [-1.0, 1.0] {
        for b in [-golden, golden] {
            faces.push((Vector::new(0.0, a, b), offset_mm));
            faces.push((Vector::new(a, b, 0.0), offset_mm));
            faces.push((Vector::new(b, 0.0, a), offset_mm));
        }
    }
    faces
}

pub fn panels(base: &Polyhedron) -> PanelSet {
    PanelSet::of(base, &panel_request()).unwrap()
}

pub fn panel_request() -> PanelRequest {
    PanelRequest {
        sheet_mm: SHEET_MM,
        joints: JointStyle::Auto,
        press_mm: 0.0,
        cut_mm: 0.2,
        brackets: BracketKind {
            hole_mm: 3.4,
            head_mm: 5.7,
            thread_mm: 2.5,
            flange_mm: 4.0,
        },
    }
}

/// Returns by how much the parts and the base grown by the gap miss the model's volume, relative.
pub fn volume_error(ground: &Ground, scene: &Scene, parts: &[Part]) -> f64 {
    let grown = csg(&grown(scene));
    let inside = grown.intersect(&csg(ground.solid().mesh())).unwrap();
    let base_mm3 = inside.to_mesh().unwrap().signed_volume_mm3();
    let parts_mm3: f64 = parts.iter().map(Part::volume_mm3).sum();
    (base_mm3 + parts_mm3 - ground.volume_mm3()) / ground.volume_mm3()
}

/// Returns the base grown by the gap, cut out of a large block.
pub fn grown(scene: &Scene) -> TriMesh {
    let faces = scene.base.faces().iter().filter(|face| face.area_mm2 > 0.0);
    let block = csg(&block([-5e3; 3], [5e3; 3]));
    let body = faces.fold(block, |body, face| {
        let plane = Plane {
            offset_mm: face.plane.offset_mm + scene.gap_mm,
            ..face.plane
        };
        body.split_by_plane(&plane).unwrap().1
    });
    body.to_mesh().unwrap()
}

/// Holds the claims about a cup: closed, one shell, open at the floor, and no wall thinner than
/// asked. Returns the thinnest wall that is found, mm.
pub fn hold_cup(part: &Part, cup: &Cup, wall_mm: f64, name: &str) -> f64 {
    let solid = Solid::new(cup.body.clone());
    assert!(solid.is_ok(), "{name}: {:?}", solid.err());
    assert_eq!(shells(&cup.body).len(), 1, "{name}: a closed void");
    let all = Bvh::new(part.body.iter_corners());
    let floor = part.region.bounds()[0].plane;
    let is_floor = |corners: &[Point; 3]| corners.iter().all(|p| floor.distance(p).abs() < 1e-6);
    let walls = Bvh::new(
        part.body
            .iter_corners()
            .filter(|corners| !is_floor(corners)),
    );
    let distance = |bvh: &Bvh, p: &Point| {
        let nearest = bvh.closest(p, f64::INFINITY, &[]).unwrap();
        nearest.distance_squared.sqrt()
    };
    let triangles: Vec<[Point; 3]> = cup.body.iter_corners().collect();
    let samples = spread_points(&triangles, SAMPLES).into_iter();
    let inner = samples.filter(|sample| distance(&all, &sample.at) > 1e-4);
    let thinnest = inner.map(|sample| distance(&walls, &sample.at));
    let thinnest = thinnest.fold(f64::INFINITY, f64::min);
    assert!(
        thinnest >= wall_mm - LACK_MM,
        "{name}: a wall of {thinnest} mm, not {wall_mm} mm"
    );
    thinnest
}

/// Returns the bodies of all units: their parts, solid, and their panels.
pub fn unit_bodies(shell: &CladShell) -> Vec<Vec<TriMesh>> {
    let units = shell.assembly.units.iter();
    units
        .map(|unit| {
            let parts = unit
                .parts
                .iter()
                .map(|&part| shell.parts[part].body.clone());
            let own = shell.panels.panels.iter();
            let own = own.filter(|panel| unit.has_panel && panel.face == unit.face);
            parts.chain(own.map(|panel| panel.body())).collect()
        })
        .collect()
}

/// Takes the units apart in their order, in steps. Returns the greatest overlap with what stays,
/// mm³.
pub fn take_apart(shell: &CladShell) -> f64 {
    let bodies = unit_bodies(shell);
    let mut staying: Vec<usize> = shell.assembly.order.clone();
    let mut worst_mm3 = 0.0_f64;
    while let Some(unit) = staying.pop() {
        let moving: Vec<&TriMesh> = bodies[unit].iter().collect();
        let others: Vec<&TriMesh> = staying.iter().flat_map(|&other| &bodies[other]).collect();
        let way = shell.assembly.units[unit].way;
        worst_mm3 = worst_mm3.max(on_the_way_mm3(&moving, &others, way));
    }
    worst_mm3
}

/// Returns the greatest overlap of a body that leaves in steps with all that stays, mm³.
pub fn on_the_way_mm3(moving: &[&TriMesh], staying: &[&TriMesh], way: Vector) -> f64 {
    let mut worst_mm3 = 0.0_f64;
    for step_mm in STEPS_MM {
        for body in moving {
            let moved = body.map_vertices(|p| p + way * step_mm);
            let others = staying.iter().map(|other| overlap_mm3(&moved, other));
            worst_mm3 = worst_mm3.max(others.sum());
        }
    }
    worst_mm3
}

pub fn overlap_mm3(a: &TriMesh, b: &TriMesh) -> f64 {
    let (a_box, b_box) = (a.aabb(), b.aabb());
    let is_apart = (0..3).any(|k| a_box.min[k] > b_box.max[k] || b_box.min[k] > a_box.max[k]);
    if is_apart {
        return 0.0;
    }
    let both = csg(a).intersect(&csg(b)).unwrap();
    both.to_mesh().unwrap().signed_volume_mm3()
}
