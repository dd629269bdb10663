//! The mass of the whole and its centre, from what is written.

use std::f64::consts::FRAC_PI_4;

use super::asked::Asked;
use super::hardware::{fasteners, glue};
use super::made::{Made, WrittenPart};
use super::rods::{about_rods, rods};
use crate::geom::{Point, Vector};
use crate::goal::{Goal, compute_figures};
use crate::mass::{Moments, moments_of_mesh};
use crate::mesh::{TriMesh, area_mm2};
use crate::panels::Panel;
use crate::verify::{BallastPromise, FastenerPromise, GluePromise, RodPromise};

/// The masses of an object, g, and its centre in the model frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Weighed {
    /// The parts of the shell.
    pub shell_g: f64,
    /// The panels.
    pub panels_g: f64,
    /// The brackets.
    pub brackets_g: f64,
    /// The screws and inserts.
    pub fasteners_g: f64,
    /// The rods between polyhedra.
    pub rods_g: f64,
    /// The glue.
    pub glue_g: f64,
    /// The ballast.
    pub ballast_g: f64,
    /// Everything: mass, g, and first moments.
    pub whole: Moments,
    pub fasteners: Vec<FastenerPromise>,
    pub rods: Vec<RodPromise>,
    pub glue: Vec<GluePromise>,
    pub ballast: Vec<BallastPromise>,
}

impl Weighed {
    /// Returns the mass, g.
    pub fn mass_g(&self) -> f64 {
        self.whole.volume()
    }

    /// Returns the centre of mass in the model frame.
    pub fn center(&self) -> Point {
        self.whole.centroid()
    }
}

/// Weighs an object: every written part, every panel as it comes out, and what holds them.
pub fn weigh(asked: &Asked, made: &Made) -> Weighed {
    let of_parts = |parts: &[WrittenPart]| {
        let moments = parts.iter().map(|part| moments_of_mesh(&part.in_model()));
        sum(moments) * asked.print_g_mm3()
    };
    let shell_parts = made.built.shell.parts.len();
    let shell = of_parts(&made.parts[..shell_parts]);
    let brackets = of_parts(made.brackets());
    let panels = made.built.shell.panels.panels.iter().map(panel_moments);
    let panels = sum(panels) * asked.sheet_g_mm3();
    let fasteners = fasteners(asked, made);
    let glue = [glue(asked, made), about_rods(asked, made)].concat();
    let rods = rods(made);
    let spanned = sum(rods.iter().map(|rod| point(rod.mass_g, rod.center_mm)));
    let held = sum(fasteners.iter().map(|one| point(one.mass_g, one.center_mm)));
    let glued = sum(glue.iter().map(|film| point(film.mass_g, film.center_mm)));
    Weighed {
        shell_g: shell.volume(),
        panels_g: panels.volume(),
        brackets_g: brackets.volume(),
        fasteners_g: held.volume(),
        rods_g: spanned.volume(),
        glue_g: glued.volume(),
        ballast_g: 0.0,
        whole: shell + brackets + panels + held + spanned + glued,
        fasteners,
        rods,
        glue,
        ballast: Vec::new(),
    }
}

/// Returns the lean at which an object topples, degrees; less than zero if it does not stand.
pub fn toppling_deg(goal: &Goal, weighed: &Weighed) -> f64 {
    lean_deg(goal, &weighed.whole)
}

/// Returns the lean at which a body with these moments topples, degrees; less than zero if it does
/// not stand.
pub fn lean_deg(goal: &Goal, moments: &Moments) -> f64 {
    let moments = moments.in_frame(&goal.frame);
    let figures = compute_figures(goal, &moments);
    let lean_rad = figures.toppling_angle_rad.unwrap_or(f64::NEG_INFINITY);
    lean_rad.to_degrees()
}

fn sum(moments: impl Iterator<Item = Moments>) -> Moments {
    moments.fold(Moments::default(), |all, one| all + one)
}

/// Returns the moments of a mass in a point.
pub fn point(mass_g: f64, center_mm: [f64; 3]) -> Moments {
    let at = Vector::from(center_mm);
    Moments::from_parts(mass_g, &(at * mass_g), &(at * at.transpose() * mass_g))
}

/// Returns the moments of a panel with its holes.
pub fn panel_moments(panel: &Panel) -> Moments {
    let holes = panel.holes.iter().map(|hole| {
        let volume_mm3 = FRAC_PI_4 * hole.diameter_mm.powi(2) * panel.sheet_mm;
        point(volume_mm3, panel.at(hole.at_mm, 0.5).into())
    });
    moments_of_mesh(&panel.body()) - sum(holes)
}

/// The estimate of the supplement to CofiFab (2016), section 1: a shell that is solid down to the
/// base, and panels without thickness.
///
/// Its equation 4 lacks a factor of 3 in the centre of a surface, which is there here.
pub fn paper_estimate(
    model: &TriMesh,
    base: &TriMesh,
    [print_g_mm3, sheet_g_mm2]: [f64; 2],
) -> (f64, Point) {
    let solid = (moments_of_mesh(model) - moments_of_mesh(base)) * print_g_mm3;
    let faces = surface(base) * sheet_g_mm2;
    let whole = solid + faces;
    (whole.volume(), whole.centroid())
}

/// Returns the area and the first moments of a surface.
fn surface(mesh: &TriMesh) -> Moments {
    let triangles = mesh.iter_corners().map(|corners| {
        let [a, b, c] = corners.map(|p| p.coords);
        point(area_mm2(&corners), ((a + b + c) / 3.0).into())
    });
    sum(triangles)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::primitives::{ball, cuboid};

    #[test]
    fn the_centre_of_a_surface_has_the_factor_that_the_paper_lacks() {
        let cube = cuboid(&Point::new(2.0, 1.0, 1.5), &Point::new(3.0, 2.0, 2.5));
        let faces = surface(&cube);
        assert!((faces.volume() - 6.0).abs() < 1e-12);
        assert!((faces.centroid() - Point::new(2.5, 1.5, 2.0)).norm() < 1e-12);
    }

    #[test]
    fn the_estimate_of_a_box_in_a_box_has_its_closed_form() {
        let outer = cuboid(&Point::origin(), &Point::new(100.0, 80.0, 60.0));
        let inner = cuboid(&Point::new(20.0, 10.0, 10.0), &Point::new(90.0, 70.0, 50.0));
        let [rho, sheet] = [1.24e-3, 5.0 * 0.68e-3];
        let (mass_g, center) = paper_estimate(&outer, &inner, [rho, sheet]);
        let solids = [480_000.0 * rho, -168_000.0 * rho, 18_800.0 * sheet];
        let middles = [50.0, 55.0, 55.0];
        let expected_g: f64 = solids.iter().sum();
        let first: f64 = solids.iter().zip(middles).map(|(g, x)| g * x).sum();
        assert!((mass_g - expected_g).abs() < 1e-9 * expected_g);
        assert!((center.x - first / expected_g).abs() < 1e-9);
    }

    #[test]
    fn a_mass_in_a_point_counts_like_a_small_ball_there() {
        let at = [30.0, -20.0, 10.0];
        let small = moments_of_mesh(&ball(&Point::from(at), 0.01, 3));
        let lump = point(small.volume(), at);
        assert!((small.first() - lump.first()).norm() < 1e-9 * lump.first().norm());
    }
}
