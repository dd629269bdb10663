//! The bodies of the coupons: blocks, pins and sockets, joined by Boolean operations.

use super::CouponSet;
use crate::geom::{Point, Vector};
use crate::mesh::{ClipError, Csg, Solid, TriMesh, primitives};

/// Sides of the polygons that approximate circles, as on the pins of kits.
const SIDES: u32 = 48;
/// Thickness of plates, mm, and so the height at which samples begin.
const PLATE_MM: f64 = 3.0;
/// Height of thin walls, mm: as high as a free rim after a cut.
const FIN_HEIGHT_MM: f64 = 10.0;
/// Length of thin walls, mm.
const FIN_LENGTH_MM: f64 = 15.0;
/// Material and air between neighbours, mm.
const GAP_MM: f64 = 4.0;
/// Overlap of joined bodies, and excess of cutting ones, mm, so that no faces coincide.
const OVERLAP_MM: f64 = 0.5;
/// Legs of the cut-off corner that marks the end with the smallest samples, mm.
const MARK_MM: f64 = 3.0;

/// One coupon: its file and its body, resting on z = 0, mm.
#[derive(Debug, Clone)]
pub struct Coupon {
    /// Name of its file.
    pub file: &'static str,
    /// Its purpose, in a few words.
    pub purpose: &'static str,
    /// Number of copies to print.
    pub count: usize,
    /// Its body.
    pub solid: Solid,
}

/// Makes every coupon of a set.
pub(super) fn make_coupons(set: &CouponSet) -> Result<Vec<Coupon>, ClipError> {
    let coupon = |file, purpose, count, body: Csg| {
        Ok(Coupon {
            file,
            purpose,
            count,
            solid: body.to_solid()?,
        })
    };
    [
        coupon(
            "density.stl",
            "to be weighed",
            3,
            block([0.0; 3], set.density_size_mm)?,
        ),
        coupon("comb.stl", "sockets for the trial pin", 1, comb(set)?),
        coupon(
            "trial-pin.stl",
            "to be tried in the comb",
            1,
            trial_pin(set)?,
        ),
        coupon("pins.stl", "a ladder of pins", 1, ladder(set)?),
        coupon(
            "walls-x.stl",
            "thin walls, thick along x",
            1,
            fan(&set.walls_x_mm, false)?,
        ),
        coupon(
            "walls-y.stl",
            "thin walls, thick along y",
            1,
            fan(&set.walls_y_mm, true)?,
        ),
    ]
    .into_iter()
    .collect()
}

/// Makes the block between two corners.
fn block(low: [f64; 3], high: [f64; 3]) -> Result<Csg, ClipError> {
    Csg::of_mesh(&primitives::cuboid(&Point::from(low), &Point::from(high)))
}

/// Makes an upright cylinder around (x, y) between two heights.
///
/// For a hole, the polygon is circumscribed about the circle, so that its flats take nothing from
/// the clearance; else it is inscribed.
fn cylinder(
    diameter_mm: f64,
    [x, y]: [f64; 2],
    [low, high]: [f64; 2],
    is_hole: bool,
) -> Result<Csg, ClipError> {
    let flats = (std::f64::consts::PI / f64::from(SIDES)).cos();
    let radius_mm = diameter_mm / 2.0 / if is_hole { flats } else { 1.0 };
    let upright = primitives::cylinder(radius_mm, high - low, SIDES);
    Csg::of_mesh(&translated(&upright, Vector::new(x, y, low)))
}

fn translated(mesh: &TriMesh, by: Vector) -> TriMesh {
    mesh.map_vertices(|p| p + by)
}

/// Cuts the corner at the origin off a body, to mark the end with the smallest samples.
fn mark_start(body: &Csg, height_mm: f64) -> Result<Csg, ClipError> {
    let knife = primitives::cylinder(MARK_MM, height_mm + 2.0 * OVERLAP_MM, 4);
    body.subtract(&Csg::of_mesh(&translated(
        &knife,
        Vector::new(0.0, 0.0, -OVERLAP_MM),
    ))?)
}

/// Makes a plate with a through hole for every clearance.
fn comb(set: &CouponSet) -> Result<Csg, ClipError> {
    let widest = set
        .holes
        .iter()
        .fold(0.0, |widest: f64, hole| widest.max(hole.diameter_mm));
    let pitch = widest + GAP_MM;
    let size = [
        pitch * set.holes.len() as f64 + GAP_MM,
        widest + 2.0 * GAP_MM,
        set.trial_length_mm,
    ];
    let mut plate = mark_start(&block([0.0; 3], size)?, size[2])?;
    for (index, hole) in set.holes.iter().enumerate() {
        let x = GAP_MM / 2.0 + pitch * (index as f64 + 0.5);
        let through = [-OVERLAP_MM, size[2] + OVERLAP_MM];
        plate = plate.subtract(&cylinder(
            hole.diameter_mm,
            [x, size[1] / 2.0],
            through,
            true,
        )?)?;
    }
    Ok(plate)
}

/// Makes the trial pin on a handle.
fn trial_pin(set: &CouponSet) -> Result<Csg, ClipError> {
    let side = set.trial_pin_mm + 2.0 * GAP_MM;
    let handle = block([0.0; 3], [side, side, PLATE_MM])?;
    let top = PLATE_MM + set.trial_length_mm;
    handle.union(&cylinder(
        set.trial_pin_mm,
        [side / 2.0; 2],
        [PLATE_MM - OVERLAP_MM, top],
        false,
    )?)
}

/// Makes pins of increasing diameters on a plate, each twice as high as wide.
fn ladder(set: &CouponSet) -> Result<Csg, ClipError> {
    let widest = set
        .pins_mm
        .iter()
        .fold(0.0, |widest: f64, pin| widest.max(*pin));
    let pitch = widest + GAP_MM;
    let size = [
        pitch * set.pins_mm.len() as f64 + GAP_MM,
        widest + 2.0 * GAP_MM,
        PLATE_MM,
    ];
    let mut plate = mark_start(&block([0.0; 3], size)?, PLATE_MM)?;
    for (index, &pin_mm) in set.pins_mm.iter().enumerate() {
        let x = GAP_MM / 2.0 + pitch * (index as f64 + 0.5);
        let heights = [PLATE_MM - OVERLAP_MM, PLATE_MM + 2.0 * pin_mm];
        plate = plate.union(&cylinder(pin_mm, [x, size[1] / 2.0], heights, false)?)?;
    }
    Ok(plate)
}

/// Makes free walls of increasing thickness on a plate, one behind the other along x, or along y.
fn fan(walls_mm: &[f64], along_y: bool) -> Result<Csg, ClipError> {
    let sum: f64 = walls_mm.iter().sum();
    let length = sum + GAP_MM * (walls_mm.len() + 1) as f64;
    let width = FIN_LENGTH_MM + 2.0 * GAP_MM;
    let oriented = |[x, y, z]: [f64; 3]| if along_y { [y, x, z] } else { [x, y, z] };
    let mut plate = mark_start(
        &block([0.0; 3], oriented([length, width, PLATE_MM]))?,
        PLATE_MM,
    )?;
    let mut x = GAP_MM;
    for wall_mm in walls_mm {
        let low = oriented([x, GAP_MM, PLATE_MM - OVERLAP_MM]);
        let high = oriented([
            x + wall_mm,
            GAP_MM + FIN_LENGTH_MM,
            PLATE_MM + FIN_HEIGHT_MM,
        ]);
        plate = plate.union(&block(low, high)?)?;
        x += wall_mm + GAP_MM;
    }
    Ok(plate)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::printer::Printer;
    use std::f64::consts::PI;

    fn set(id: &str) -> CouponSet {
        let printer = Printer::find(id).unwrap();
        CouponSet::of(&printer, printer.material(None).unwrap())
    }

    #[test]
    fn every_coupon_rests_on_the_plate_and_is_one_solid_that_fits_the_machine() {
        for id in [
            "elegoo-saturn-4-ultra",
            "objet-connex350",
            "prusa-mk4",
            "hp-mjf-5200",
        ] {
            let printer = Printer::find(id).unwrap();
            for coupon in make_coupons(&set(id)).unwrap() {
                let aabb = coupon.solid.mesh().aabb();
                assert!(aabb.min.z.abs() < 1e-12, "{id} {}", coupon.file);
                assert_ne!(
                    printer.fits(aabb.size().into()),
                    Some(false),
                    "{id} {}",
                    coupon.file
                );
                assert_eq!(
                    crate::mesh::bodies(coupon.solid.mesh()).len(),
                    1,
                    "{id} {}",
                    coupon.file
                );
            }
        }
    }

    #[test]
    fn the_density_coupon_has_the_stated_volume_and_the_comb_lacks_its_sockets() {
        let set = set("prusa-mk4");
        let coupons = make_coupons(&set).unwrap();
        let volume = |file: &str| {
            let coupon = coupons.iter().find(|coupon| coupon.file == file).unwrap();
            coupon.solid.mesh().signed_volume_mm3()
        };
        assert!((volume("density.stl") / set.density_volume_mm3 - 1.0).abs() < 1e-12);
        let size = coupons
            .iter()
            .find(|c| c.file == "comb.stl")
            .unwrap()
            .solid
            .mesh()
            .aabb()
            .size();
        // A circumscribed polygon of n sides holds n·tan(π/n) of r².
        let n = f64::from(SIDES);
        let share = n * (PI / n).tan();
        let holes: f64 = set
            .holes
            .iter()
            .map(|hole| share * (hole.diameter_mm / 2.0).powi(2) * size.z)
            .sum();
        let corner = MARK_MM * MARK_MM / 2.0 * size.z;
        let left = size.x * size.y * size.z - holes - corner;
        assert!(
            (volume("comb.stl") / left - 1.0).abs() < 1e-9,
            "{} {left}",
            volume("comb.stl")
        );
    }
}
