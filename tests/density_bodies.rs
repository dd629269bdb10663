//! Claims on the bodies in which a density is below a value, drawn by the library.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]

use equipoise::base::watch::Watch;
use equipoise::field::{Density, Linear, Product, Profile, Ramp, Skin};
use equipoise::geom::{Point, Vector};
use equipoise::mesh::{Csg, MeshDistance, Solid, TriMesh, primitives::cuboid};
use equipoise::voids::{DensityLevel, Drawn, draw_below};

/// Tolerance of the drawings, mm.
const TOLERANCE_MM: f64 = 0.08;

fn cube() -> Solid {
    Solid::new(cuboid(&Point::origin(), &Point::new(12.0, 12.0, 12.0))).unwrap()
}

fn drawn(density: &dyn Density, below: f64) -> Drawn {
    let level = DensityLevel { density, below };
    draw_below(&cube(), &level, TOLERANCE_MM, &Watch::silent()).unwrap()
}

/// Returns what of the cube lies in a drawn body.
fn within_cube(drawn: Drawn) -> TriMesh {
    let Drawn::Body(mesh) = drawn else {
        panic!("{drawn:?}")
    };
    let cube = Csg::of_solid(&cube()).unwrap();
    let part = cube.intersect(&Csg::of_mesh(&mesh).unwrap()).unwrap();
    part.to_mesh().unwrap()
}

/// Returns a linear density that is 0.5 in the middle of the cube.
fn slanted() -> Linear {
    let gradient = Vector::new(0.01, 0.02, -0.02);
    Linear {
        at_origin: 0.5 - gradient.dot(&Vector::repeat(6.0)),
        gradient,
    }
}

#[test]
fn what_all_or_none_of_a_body_has_is_told_and_not_drawn() {
    assert_eq!(drawn(&slanted(), 2.0), Drawn::Everything);
    assert_eq!(drawn(&slanted(), -2.0), Drawn::Nothing);
}

#[test]
fn a_linear_density_is_cut_at_its_plane() {
    let half = within_cube(drawn(&slanted(), 0.5));
    Solid::new(half.clone()).unwrap();
    let ratio = half.signed_volume_mm3() / 864.0;
    assert!((ratio - 1.0).abs() < 1e-5, "{ratio}");
}

#[test]
fn a_density_with_flat_places_and_creases_is_below_the_value_on_one_side_of_its_surface() {
    let ramp = Ramp::new(&Vector::z(), [2.0, 7.0], [0.2, 1.0]).unwrap();
    let skin = Skin::new(&cube(), 3.0, Profile::Linear, [0.3, 1.0]).unwrap();
    let field = Product(vec![Box::new(ramp), Box::new(skin)]);
    for below in [0.15, 0.25, 0.5] {
        let body = within_cube(drawn(&field, below));
        Solid::new(body.clone()).unwrap();
        let surface = MeshDistance::new(&body);
        for index in 0..4000_u32 {
            // Points that fill the cube evenly (R. Roberts' sequence).
            let step = Vector::new(0.819_172_513_4, 0.671_043_606_7, 0.549_700_477_9);
            let p = Point::from((step * f64::from(index)).map(|x| 12.0 * x.fract()));
            let depth_mm = surface.signed(&p);
            if depth_mm.abs() > 0.5 * TOLERANCE_MM {
                let value = field.at(&p);
                assert_eq!(depth_mm > 0.0, value < below, "{p}: {value} {depth_mm}");
            }
        }
    }
}
