//! Tests of the bodies in which a density is below a value.

use super::*;
use crate::field::{Density, Polynomial, Term};
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
