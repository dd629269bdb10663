//! Random damage to small bodies: what comes down the ladder is a solid of the right volume or is
//! refused, and nothing panics.

use nalgebra::{Rotation3, Unit};

use super::*;
use crate::geom::Vector;
use crate::mesh::primitives::{ball, cuboid, torus};
use crate::mesh::{Csg, Solid};
use crate::repair::one_body;

/// Number of damaged bodies in every run of the tests, and in the long run.
const BODIES: u64 = 150;
const MANY_BODIES: u64 = 5000;

/// Largest error of the volume if holes were torn: flat lids over the ten triangles of a ball of
/// 320 take at most 2 %.
const HOLED_RATIO: f64 = 0.04;

/// The same if no hole was torn: what is left is rounding, and cracks of 1e-6.
const WHOLE_RATIO: f64 = 1e-4;

/// Numbers without visible order, the same in each run.
struct Dice(u64);

impl Dice {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = self.0.wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as f64 / f64::from(1u32 << 31)
    }

    fn below(&mut self, count: usize) -> usize {
        (self.unit() * count as f64) as usize
    }

    fn vector(&mut self) -> Vector {
        Vector::from_fn(|_, _| 2.0 * self.unit() - 1.0)
    }
}

/// A damaged body, and what it should become.
struct Broken {
    mesh: TriMesh,
    volume: f64,
    is_holed: bool,
}

fn body(dice: &mut Dice) -> TriMesh {
    let axis = Unit::new_normalize(dice.vector() + Vector::new(0.0, 0.0, 1.5));
    let turn = Rotation3::from_axis_angle(&axis, 6.0 * dice.unit());
    let shape = match dice.below(3) {
        0 => cuboid(&Point::new(-1.0, -0.8, -0.7), &Point::new(1.0, 0.8, 0.7)),
        1 => ball(&Point::origin(), 1.0, 2),
        _ => torus(0.9, 0.4, 16, 9),
    };
    shape.map_vertices(|p| turn * p)
}

/// Returns one body, or two that overlap, with their common volume by a boolean.
fn sound(dice: &mut Dice) -> (TriMesh, f64) {
    let one = body(dice);
    if dice.below(2) == 0 {
        let volume = one.signed_volume_mm3();
        return (one, volume);
    }
    let by = dice.vector() * 0.4;
    let other = body(dice).map_vertices(|p| p + by);
    let [a, b] = [&one, &other].map(|mesh| Csg::of_mesh(mesh).unwrap());
    let union = a.union(&b).unwrap().to_mesh().unwrap();
    (one.joined(&other), union.signed_volume_mm3())
}

fn with_triangles(mesh: &TriMesh, triangles: Vec<[u32; 3]>) -> TriMesh {
    TriMesh::new(mesh.vertices().to_vec(), triangles).unwrap()
}

/// Damages a body in one to three ways.
fn break_one(dice: &mut Dice) -> Broken {
    let (mut mesh, volume) = sound(dice);
    let mut is_holed = false;
    for _ in 0..1 + dice.below(3) {
        let count = mesh.triangles().len();
        let mut triangles = mesh.triangles().to_vec();
        match dice.below(5) {
            0 => {
                is_holed = true;
                for _ in 0..1 + dice.below(5) {
                    triangles.swap_remove(dice.below(triangles.len()));
                }
            }
            1 => {
                for t in &mut triangles {
                    if dice.below(4) == 0 {
                        t.swap(1, 2);
                    }
                }
            }
            2 => {
                for _ in 0..1 + dice.below(9) {
                    triangles.push(triangles[dice.below(count)]);
                }
            }
            3 => {
                // A crack of a millionth along the rims of some triangles.
                let mut vertices = mesh.vertices().to_vec();
                for t in triangles.iter_mut().take(count / 3) {
                    *t = t.map(|v| {
                        vertices.push(vertices[v as usize] + dice.vector() * 5e-7);
                        vertices.len() as u32 - 1
                    });
                }
                mesh = TriMesh::new(vertices, triangles.clone()).unwrap();
            }
            _ => {
                let v = triangles[dice.below(count)];
                triangles.extend([[v[0], v[0], v[1]], [v[2], v[2], v[2]]]);
            }
        }
        mesh = with_triangles(&mesh, triangles);
    }
    Broken {
        mesh,
        volume,
        is_holed,
    }
}

#[test]
fn damaged_bodies_become_solids_of_the_right_volume_or_are_refused() {
    mend_bodies(0..BODIES);
}

#[test]
#[ignore = "takes minutes"]
fn many_damaged_bodies_become_solids_of_the_right_volume_or_are_refused() {
    mend_bodies(BODIES..MANY_BODIES);
}

/// Damages the bodies of some seeds, repairs them, and checks what comes.
fn mend_bodies(seeds: std::ops::Range<u64>) {
    let count = seeds.end - seeds.start;
    let watch = Watch::silent();
    let mut mended = 0;
    for seed in seeds {
        let broken = break_one(&mut Dice(seed));
        let (mesh, repairs) = repair(broken.mesh, &watch).unwrap();
        let Ok(solid) = Solid::new(mesh) else {
            continue;
        };
        if one_body(&solid, &watch).unwrap().is_err() {
            continue;
        }
        mended += 1;
        let error = solid.mesh().signed_volume_mm3() / broken.volume - 1.0;
        let limit = if broken.is_holed {
            HOLED_RATIO
        } else {
            WHOLE_RATIO
        };
        assert!(error.abs() <= limit, "seed {seed}: {error} ({repairs})");
    }
    // Holes in crossing bodies and torn boxes may be refused; most are not.
    assert!(4 * mended > 3 * count, "{mended} of {count}");
}

#[test]
fn spikes_pulled_through_a_body_are_resolved_or_refused() {
    let watch = Watch::silent();
    let mut mended = 0;
    for seed in 0..BODIES / 3 {
        let mut dice = Dice(seed);
        let ball = ball(&Point::origin(), 1.0, 2);
        let pulled = dice.below(ball.vertices().len());
        let to = Point::from(dice.vector() * 1.5);
        let mut vertices = ball.vertices().to_vec();
        vertices[pulled] = to;
        let spiked = TriMesh::new(vertices, ball.triangles().to_vec()).unwrap();
        let expected = winding_volume(&spiked);
        let (mesh, repairs) = repair(spiked, &watch).unwrap();
        let Ok(solid) = Solid::new(mesh) else {
            continue;
        };
        if one_body(&solid, &watch).unwrap().is_err() {
            continue;
        }
        mended += 1;
        let error = solid.mesh().signed_volume_mm3() / expected - 1.0;
        // 65 536 evenly spread points see a volume of this share of their box within half a
        // percent.
        assert!(error.abs() < 0.005, "seed {seed}: {error} ({repairs})");
    }
    // The other spikes come out inside out, which the winding number does not count.
    assert!(mended > 7, "{mended}");
}

/// Returns the volume around which a mesh winds, by evenly spread points.
fn winding_volume(mesh: &TriMesh) -> f64 {
    let bvh = Bvh::new(mesh.iter_corners());
    let (low, size) = (mesh.aabb().min, mesh.aabb().size());
    let steps = [
        0.819_172_513_396_164_4,
        0.671_043_606_703_789_2,
        0.549_700_477_901_970_3,
    ];
    let count = 1 << 16;
    let is_inside = |i: &i32| {
        let unit = steps.map(|step| (step * f64::from(*i)).fract());
        bvh.winding(&(low + size.component_mul(&Vector::from(unit)))) > 0
    };
    let inside = (0..count).filter(is_inside).count() as f64 / f64::from(count);
    inside * size.product()
}
