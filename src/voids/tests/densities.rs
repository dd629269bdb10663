//! Tests of the bodies in which a density is below a value.

use super::*;
use crate::field::{Density, Polynomial, Product, Profile, Ramp, Skin, Term};
use crate::voids::{DensityLevel, Drawn, draw_below};

/// Tolerance of the drawings, mm.
const DRAWN_MM: f64 = 0.08;

fn cube() -> Solid {
    Solid::new(block([0.0; 3], [12.0; 3])).unwrap()
}

fn drawn(density: &dyn Density, below: f64) -> Drawn {
    let level = DensityLevel { density, below };
    draw_below(&cube(), &level, DRAWN_MM, &Watch::silent()).unwrap()
}

/// Returns what of the cube lies in a drawn body.
fn within_cube(drawn: Drawn) -> TriMesh {
    let Drawn::Body(mesh) = drawn else {
        unreachable!("{drawn:?}")
    };
    let cube = Csg::of_solid(&cube()).unwrap();
    let part = cube.intersect(&Csg::of_mesh(&mesh).unwrap()).unwrap();
    part.to_mesh().unwrap()
}

/// Returns r² about (4, 5, 6), over a hundred.
fn bowl() -> Polynomial {
    let term = |coefficient: f64, [x, y, z]: [u8; 3]| Term {
        coefficient: 0.01 * coefficient,
        x,
        y,
        z,
    };
    Polynomial::new(vec![
        term(1.0, [2, 0, 0]),
        term(1.0, [0, 2, 0]),
        term(1.0, [0, 0, 2]),
        term(-8.0, [1, 0, 0]),
        term(-10.0, [0, 1, 0]),
        term(-12.0, [0, 0, 1]),
        term(77.0, [0, 0, 0]),
    ])
    .unwrap()
}

#[test]
fn a_level_set_is_drawn_within_half_the_tolerance() {
    let center = Point::new(4.0, 5.0, 6.0);
    let ball = within_cube(drawn(&bowl(), 0.09));
    assert_sound(&ball);
    for p in samples(&ball) {
        let off_mm = (p - center).norm() - 3.0;
        assert!(off_mm.abs() <= 0.5 * DRAWN_MM, "{p}: {off_mm}");
    }
    let ratio = signed_volume(&ball) / (4.0 / 3.0 * std::f64::consts::PI * 27.0);
    assert!((ratio - 1.0).abs() < 0.01, "{ratio}");
}

#[test]
fn what_all_or_none_of_a_body_has_is_told_and_not_drawn() {
    assert_eq!(drawn(&bowl(), 9.0), Drawn::Everything);
    assert_eq!(drawn(&bowl(), -1.0), Drawn::Nothing);
}

#[test]
fn a_density_with_flat_places_and_creases_is_below_the_value_on_one_side_of_its_surface() {
    let ramp = Ramp::new(&Vector::z(), [2.0, 7.0], [0.2, 1.0]).unwrap();
    let skin = Skin::new(&cube(), 3.0, Profile::Linear, [0.3, 1.0]).unwrap();
    let field = Product(vec![Box::new(ramp), Box::new(skin)]);
    for below in [0.1, 0.25, 0.5] {
        let body = within_cube(drawn(&field, below));
        assert_sound(&body);
        let surface = MeshDistance::new(&body);
        let mut random = crate::base::random::Random::new(7);
        for _ in 0..4000 {
            let p = Point::from(Vector::from_fn(|_, _| random.between(0.0, 12.0)));
            let depth_mm = surface.signed(&p);
            // The slopes are at most 0.4 a mm; creases are drawn in cells of half a millimetre.
            if depth_mm.abs() > 0.3 {
                let value = field.at(&p);
                assert_eq!(depth_mm > 0.0, value < below, "{p}: {value} {depth_mm}");
            }
        }
    }
}
