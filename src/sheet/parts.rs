//! The rows of parts, and the size of the finished object.

use serde::{Deserialize, Serialize};

use crate::geom::{Aabb, Point, Vector};
use crate::verify::{Fingerprint, Hardware, Mark, PartEvidence, Peg, Pose};

/// A part.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PartRow {
    /// Name on the sheet, such as `P01`.
    pub id: String,
    /// Path of its file, relative to the kit.
    pub file: String,
    /// SHA-256 of that file.
    pub sha256: String,
    /// Fingerprint of its shape, by which a changed file is recognised.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fingerprint: Option<Fingerprint>,
    /// Number of triangles.
    pub triangles: usize,
    /// Volume, mm³.
    pub volume_mm3: f64,
    /// Expected mass, g.
    pub mass_g: f64,
    /// Extent in print pose, mm.
    pub size_mm: [f64; 3],
    /// Pose on the plate in words, such as `cut C1 down`.
    pub lies: String,
    /// Map from model to print coordinates, by rows.
    pub print_from_model: Pose,
    /// Pins that stand out of it.
    pub pins: Vec<Peg>,
    /// Sockets in it.
    pub sockets: Vec<Peg>,
    /// Ids engraved in its cut faces.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub marks: Vec<Mark>,
    /// Half of a yo-yo to which it belongs; `None` for a single body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub half: Option<Half>,
    /// Volume of resin that the part encloses against a film while it is printed, mm³. 0 for other
    /// processes than resin in a vat.
    #[serde(default)]
    pub cup_mm3: f64,
    /// Cut faces that point down to drain its open hollow after printing in a vat.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub drains_over: Vec<String>,
    /// Overhangs in print pose; `None` if the printer does not say which surfaces print without
    /// support.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub support: Option<SupportRow>,
    /// Path of its picture, relative to the kit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub picture: Option<String>,
}

/// A half of a yo-yo.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Half {
    /// The half above the spin point.
    A,
    /// The half below it.
    B,
}

/// The overhangs of a part in print pose, which need support.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct SupportRow {
    /// Number of places that need support.
    pub places: usize,
    /// Their area on the outside of the model, seen from below, mm².
    pub outside_mm2: f64,
    /// Their area in hollows that a cut has opened, mm².
    pub hollow_mm2: f64,
    /// Their area on cut faces and pins, mm².
    pub cut_face_mm2: f64,
    /// Least height over the plate, mm.
    pub from_mm: f64,
    /// Greatest height over the plate, mm.
    pub to_mm: f64,
    /// Area on which the part stands on the plate, mm².
    #[serde(default)]
    pub foot_mm2: f64,
    /// Estimate of the support's own material, mm³.
    #[serde(default)]
    pub material_mm3: f64,
}

/// Returns the extent of the parts put together with their hardware, along the model's own axes,
/// mm; exact for the files.
pub fn finished_size_mm(parts: &[PartEvidence], hardware: &[Hardware]) -> [f64; 3] {
    let corners = parts
        .iter()
        .flat_map(|part| part.mesh.vertices().iter().map(|p| part.pose.to_model(p)));
    let parts = corners.fold(Aabb::EMPTY, |all, p| all.grown_over(&p));
    hardware
        .iter()
        .map(bounds)
        .fold(parts, |all, piece| all.union(&piece))
        .size()
        .into()
}

/// Returns the box around a rod. Along an axis where the rod's direction has component d, a flat
/// end reaches r·√(1 − d²), a round one r.
fn bounds(piece: &Hardware) -> Aabb {
    let [from, to] = [piece.from_mm, piece.to_mm].map(Point::from);
    let (radius_mm, along) = (0.5 * piece.diameter_mm, (to - from).normalize());
    let flat = along.map(|d| radius_mm * (1.0 - d * d).max(0.0).sqrt());
    let about = |center: Point, reach: Vector| Aabb::of_points(&[center - reach, center + reach]);
    let end = if piece.round_end {
        about(to - along * radius_mm, Vector::from_element(radius_mm))
    } else {
        about(to, flat)
    };
    about(from, flat).union(&end)
}

/// Returns the path of the picture of a part in the kit.
pub fn part_picture_file(id: &str) -> String {
    format!("pictures/{id}.svg")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::sample;
    use crate::verify::HardwareKind;

    fn rod(from_mm: [f64; 3], to_mm: [f64; 3], round_end: bool) -> Hardware {
        Hardware {
            id: "H1".into(),
            kind: HardwareKind::Stem,
            from_mm,
            to_mm,
            diameter_mm: 4.0,
            hole_mm: 0.0,
            round_end,
            density_g_cm3: 7.85,
            mass_g: 1.0,
            depth_mm: 0.0,
            socket_mm: 4.0,
        }
    }

    #[test]
    fn the_finished_size_counts_hardware_that_stands_out() {
        let (_, evidence) = sample();
        let bare = finished_size_mm(&evidence.parts, &[]);
        // The box of the sample kit: 60 by 40 by 12 mm, from z = 10.
        assert!(
            (Vector::from(bare) - Vector::new(60.0, 40.0, 12.0)).norm() < 1e-4,
            "{bare:?}"
        );
        let stem = rod([0.0, 0.0, 20.0], [0.0, 0.0, 32.0], false);
        assert!((finished_size_mm(&evidence.parts, &[stem])[2] - 22.0).abs() < 1e-4);
    }

    #[test]
    fn a_slanted_rod_reaches_as_far_as_the_rims_of_its_ends() {
        let size = bounds(&rod([0.0; 3], [30.0, 40.0, 0.0], false)).size();
        // The ends are discs across (0.6, 0.8): they reach 2·0.8 along x, 2·0.6 along y, 2 along z.
        assert!(
            (size - Vector::new(30.0 + 3.2, 40.0 + 2.4, 4.0)).norm() < 1e-12,
            "{size}"
        );
        let round = bounds(&rod([0.0; 3], [0.0, 0.0, 10.0], true)).size();
        assert!((round - Vector::new(4.0, 4.0, 10.0)).norm() < 1e-12);
    }
}
