//! The bodies of a slide coupon: bodies of revolution about a straight line or a circle.

use super::set::{Sleeve, SlideSet};
use crate::coupon::Coupon;
use crate::curve::Helix;
use crate::geom::{Frame, Matrix, Point, Vector};
use crate::mesh::{ClipError, Csg, primitives};
use crate::telescope::{Profile, sweep_profile};

/// Air between neighbouring sleeves, mm.
const GAP_MM: f64 = 4.0;
/// Excess of cutting bodies, mm, so that no faces coincide.
const BEYOND_MM: f64 = 1.0;
/// Height and least thickness of the bar that joins the sleeves, mm.
const BAR_MM: [f64; 2] = [6.0, 2.0];
/// The bar stands out by this at the tightest sleeve, mm: a mark.
const MARK_MM: f64 = 6.0;

/// A kind of sleeve: straight or bent.
struct Form<'a> {
    set: &'a SlideSet,
    helix: Helix,
}

/// Makes every part of a coupon.
pub(super) fn make_slides(set: &SlideSet) -> Result<Vec<Coupon>, ClipError> {
    let form = |curvature: f64| Form {
        set,
        helix: Helix {
            curvature,
            torsion: 0.0,
        },
    };
    let (straight, bent) = (form(0.0), form(1.0 / set.arc_mm));
    let coupon = |file, purpose, body: Csg| {
        Ok(Coupon {
            file,
            purpose,
            count: 1,
            solid: body.to_solid()?,
        })
    };
    [
        coupon(
            "sleeves.stl",
            "straight sleeves, to try the plunger in",
            straight.sleeves()?,
        ),
        coupon("plunger.stl", "the plunger, straight", straight.plunger()?),
        coupon("arc-sleeves.stl", "bent sleeves", bent.sleeves()?),
        coupon(
            "arc-plunger.stl",
            "the plunger of the bent sleeves",
            bent.plunger()?,
        ),
    ]
    .into_iter()
    .collect()
}

impl Form<'_> {
    /// Returns the sleeves in a row along x, the tightest at the mark.
    fn sleeves(&self) -> Result<Csg, ClipError> {
        let set = self.set;
        let outer = self.outer_mm();
        let pitch = 2.0 * outer + GAP_MM;
        let places = (0..set.sleeves.len()).map(|i| pitch * i as f64);
        let places: Vec<f64> = places.collect();
        let last = places.last().copied().unwrap_or(0.0);
        let thick = 0.5 * BAR_MM[1].max(2.0 * set.wall_mm);
        let bar = primitives::cuboid(
            &Point::new(-outer - MARK_MM, -thick, 0.0),
            &Point::new(last, thick, BAR_MM[0]),
        );
        let mut block = Csg::of_mesh(&bar)?;
        for x in &places {
            block = block.union(&self.swept(*x, self.outside())?)?;
        }
        for (sleeve, x) in set.sleeves.iter().zip(&places) {
            block = block.subtract(&self.swept(*x, self.cavity(sleeve))?)?;
        }
        Ok(block)
    }

    /// Returns the plunger, flange down.
    fn plunger(&self) -> Result<Csg, ClipError> {
        let set = self.set;
        let bore = 0.5 * set.body_mm - set.wall_mm;
        let through = Profile::new([[-BEYOND_MM, bore], [set.length_mm + BEYOND_MM, bore]]);
        self.swept(0.0, self.body())?
            .subtract(&self.swept(0.0, through)?)
    }

    /// Returns the radius of a sleeve outside: that of the loosest, so that all look alike.
    fn outer_mm(&self) -> f64 {
        let bores = self.set.sleeves.iter().map(|own| 0.5 * own.bore_mm);
        bores.fold(0.0, f64::max) + self.set.wall_mm
    }

    fn outside(&self) -> Profile {
        let outer = self.outer_mm();
        Profile::new([[0.0, outer], [self.set.length_mm, outer]])
    }

    /// Returns the inside of a sleeve: its bore with a chamfer where the plunger goes in, a cone of
    /// 45° and the lip.
    fn cavity(&self, sleeve: &Sleeve) -> Profile {
        let set = self.set;
        let [bore, lip] = [sleeve.bore_mm, sleeve.lip_mm].map(|mm| 0.5 * mm);
        let (length, chamfer) = (set.length_mm, set.chamfer_mm);
        let lip_from = length - set.flange_length_mm;
        Profile::new([
            [-BEYOND_MM, bore + chamfer],
            [0.0, bore + chamfer],
            [chamfer, bore],
            [lip_from - (bore - lip), bore],
            [lip_from, lip],
            [length + BEYOND_MM, lip],
        ])
    }

    /// Returns the outside of the plunger: its flange with the first layer's chamfer, a cone of 45°
    /// and the body with a rim.
    fn body(&self) -> Profile {
        let set = self.set;
        let [flange, body] = [set.flange_mm, set.body_mm].map(|mm| 0.5 * mm);
        let (length, chamfer) = (set.length_mm, set.chamfer_mm);
        Profile::new([
            [0.0, flange - chamfer],
            [chamfer, flange],
            [set.flange_length_mm, flange],
            [set.flange_length_mm + flange - body, body],
            [length - chamfer, body],
            [length, body - chamfer],
        ])
    }

    /// Sweeps a profile from the plate upwards; arcs bend along y.
    fn swept(&self, x_mm: f64, profile: Profile) -> Result<Csg, ClipError> {
        let start = Frame {
            origin: Point::new(x_mm, 0.0, 0.0),
            axes: Matrix::from_columns(&[Vector::z(), Vector::y(), -Vector::x()]),
        };
        Csg::of_mesh(&sweep_profile(&start, &self.helix, &profile)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{MeshDistance, TriMesh, bodies};
    use crate::printer::Printer;

    /// Error of facets and of single steps, mm.
    const FACETS_MM: f64 = 0.01;

    fn set(id: &str) -> SlideSet {
        let printer = Printer::find(id).unwrap();
        SlideSet::of(&printer, printer.material(None).unwrap())
    }

    #[test]
    fn every_part_rests_on_the_plate_and_is_one_solid_that_fits_the_machine() {
        for id in [
            "formlabs-form4",
            "prusa-mk4",
            "hp-mjf-5200",
            "objet-connex350",
        ] {
            let printer = Printer::find(id).unwrap();
            for coupon in make_slides(&set(id)).unwrap() {
                let aabb = coupon.solid.mesh().aabb();
                let name = coupon.file;
                assert!(aabb.min.z.abs() < 1e-9, "{id} {name}: {}", aabb.min.z);
                assert_ne!(printer.fits(aabb.size().into()), Some(false), "{id} {name}");
                assert_eq!(bodies(coupon.solid.mesh()).len(), 1, "{id} {name}");
            }
        }
    }

    /// Returns the plunger, slid into a sleeve of the row.
    fn slid(form: &Form, plunger: &TriMesh, sleeve: usize, by_mm: f64) -> TriMesh {
        let start = Frame {
            origin: Point::origin(),
            axes: Matrix::from_columns(&[Vector::z(), Vector::y(), -Vector::x()]),
        };
        let moved = start.frame_to_model(&form.helix.frame_at(by_mm));
        let back = start.inverse();
        let x = (2.0 * form.outer_mm() + GAP_MM) * sleeve as f64;
        plunger.map_vertices(|p| moved.to_model(&back.to_model(p)) + Vector::new(x, 0.0, 0.0))
    }

    #[test]
    fn the_plunger_slides_in_every_sleeve_with_its_clearance_and_is_stopped_by_its_lip() {
        let set = set("prusa-mk4");
        for curvature in [0.0, 1.0 / set.arc_mm] {
            let helix = Helix {
                curvature,
                torsion: 0.0,
            };
            let form = Form { set: &set, helix };
            let block = form.sleeves().unwrap().to_mesh().unwrap();
            let distance = MeshDistance::new(&block);
            let plunger = form.plunger().unwrap().to_mesh().unwrap();
            for (i, sleeve) in set.sleeves.iter().enumerate() {
                let gap = |by_mm: f64| distance.min_distance_to(&slid(&form, &plunger, i, by_mm));
                // Flange and lip meet by their cones: the straight parts of both are left.
                let rise = |mm: f64| 0.5 * (mm - set.body_mm);
                let stop = set.length_mm - 2.0 * set.flange_length_mm - rise(set.flange_mm)
                    + rise(sleeve.lip_mm);
                for share in [0.1, 0.4, 0.7] {
                    let found = gap(share * stop);
                    let off = found - sleeve.clearance_mm;
                    assert!(off.abs() < FACETS_MM, "{sleeve:?}: {found} at {share}");
                }
                assert!(gap(stop - 0.1) > 0.02, "{sleeve:?}: held early");
                assert!(gap(stop + 0.1) < 1e-6, "{sleeve:?}: goes on");
            }
        }
    }
}
