//! The foot of a print: what it stands on.

use super::TriMesh;

/// Height of the section that counts as the foot of an object, mm: within the first layer.
const FOOT_MM: f64 = 0.1;
/// Area of a foot that holds a print on its plate, mm². A smaller one comes off without a brim.
pub const GOOD_FOOT_MM2: f64 = 50.0;

/// Width of the brim about a smaller foot, mm.
pub const BRIM_MM: f64 = 5.0;

/// Returns the area of a solid's section a tenth of a millimetre above its lowest point, mm².
pub fn foot_area_mm2(mesh: &TriMesh) -> f64 {
    let at = mesh.aabb().min.z + FOOT_MM;
    let area = mesh.iter_corners().map(|corners| {
        let [a, b, c] = &corners;
        let (mut up, mut down) = (None, None);
        for [from, to] in [[a, b], [b, c], [c, a]] {
            if (from.z < at) == (to.z < at) {
                continue;
            }
            let crossing = from + (to - from) * ((at - from.z) / (to.z - from.z));
            let end = if from.z < at { &mut up } else { &mut down };
            *end = Some(crossing);
        }
        let (Some(up), Some(down)) = (up, down) else {
            return 0.0;
        };
        0.5 * (up.x * down.y - up.y * down.x)
    });
    area.sum::<f64>().abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::mesh::primitives::{ball, cylinder};

    #[test]
    fn the_foot_of_a_cylinder_is_its_base_and_that_of_a_ball_a_spot() {
        let base_mm2 = foot_area_mm2(&cylinder(10.0, 30.0, 256));
        let polygon_mm2 = 128.0 * 100.0 * (std::f64::consts::TAU / 256.0).sin();
        assert!((base_mm2 - polygon_mm2).abs() < 1e-6, "{base_mm2}");
        // A cap of 0.1 mm on a ball of 10 mm has a circle of π·(2·10·0.1 − 0.1²) mm².
        let spot_mm2 = foot_area_mm2(&ball(&Point::origin(), 10.0, 6));
        assert!((spot_mm2 / 6.25 - 1.0).abs() < 0.03, "{spot_mm2}");
    }
}
