//! The parts as they are printed, their support, and the size of the finished object.

use serde::{Deserialize, Serialize};

use crate::geom::{Aabb, Point, Vector};
use crate::verify::{Fingerprint, Hardware, Mark, PartEvidence, Peg, Pose};

/// One part.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PartRow {
    /// Its name on the sheet, such as `P01`.
    pub id: String,
    /// Its file, relative to the kit.
    pub file: String,
    /// The SHA-256 of that file.
    pub sha256: String,
    /// What its shape is known by when the file comes back.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fingerprint: Option<Fingerprint>,
    /// How many triangles it has.
    pub triangles: usize,
    /// mm³.
    pub volume_mm3: f64,
    /// What it should weigh, g.
    pub mass_g: f64,
    /// Its extent in print pose, mm.
    pub size_mm: [f64; 3],
    /// How it lies on the plate, in words, such as `cut C1 down`.
    pub lies: String,
    /// Model coordinates to print coordinates, rows.
    pub print_from_model: Pose,
    /// The pins that stand out of it.
    pub pins: Vec<Peg>,
    /// The sockets sunk into it.
    pub sockets: Vec<Peg>,
    /// The ids sunk into its cut faces.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub marks: Vec<Mark>,
    /// Which half of a yo-yo it belongs to: `A` above the spin point, `B` below it; none where
    /// there are no halves.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub half: Option<String>,
    /// The volume of its open hollows whose only mouth lies flat on the plate, mm³: closed cups
    /// while it is printed.
    #[serde(default)]
    pub cup_mm3: f64,
    /// What of it hangs in the air as it lies; none where the printer does not say which surfaces
    /// print without support.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub support: Option<SupportRow>,
    /// Its picture, relative to the kit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub picture: Option<String>,
}

/// What of a part hangs in the air as it lies on the plate, where the printer says which surfaces
/// it prints without support.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct SupportRow {
    /// The places that need support.
    pub places: usize,
    /// Their area seen from below on the outside of the model, mm².
    pub outside_mm2: f64,
    /// The same in hollows that a cut has opened, mm².
    pub hollow_mm2: f64,
    /// The same on cut faces and pins, mm².
    pub cut_face_mm2: f64,
    /// From which height over the plate on, mm.
    pub from_mm: f64,
    /// Up to which height, mm.
    pub to_mm: f64,
}

/// The extent of the parts put together, with their hardware, along the model's own axes, mm; exact
/// for the files.
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

/// The box about a rod: a flat end reaches r·√(1 − d²) along an axis that the rod has the share d
/// of, a round one r.
fn bounds(piece: &Hardware) -> Aabb {
    let [from, to] = [piece.from_mm, piece.to_mm].map(Point::from);
    let (radius_mm, along) = (0.5 * piece.diameter_mm, (to - from).normalize());
    let flat = along.map(|share| radius_mm * (1.0 - share * share).max(0.0).sqrt());
    let about = |center: Point, reach: Vector| Aabb::of_points(&[center - reach, center + reach]);
    let end = if piece.round_end {
        about(to - along * radius_mm, Vector::from_element(radius_mm))
    } else {
        about(to, flat)
    };
    about(from, flat).union(&end)
}

/// The file of the picture of one part.
pub fn part_picture_file(id: &str) -> String {
    format!("pictures/{id}.svg")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::sample;

    fn rod(from_mm: [f64; 3], to_mm: [f64; 3], round_end: bool) -> Hardware {
        Hardware {
            id: "H1".into(),
            what: "stem".into(),
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
    fn the_finished_size_is_that_of_the_parts_in_place_with_what_stands_out_of_them() {
        let (_, evidence) = sample();
        let bare = finished_size_mm(&evidence.parts, &[]);
        // The box of the judge's tests: 60 by 40 by 12 from z = 10.
        assert!(
            (Vector::from(bare) - Vector::new(60.0, 40.0, 12.0)).norm() < 1e-4,
            "{bare:?}"
        );
        let stem = rod([0.0, 0.0, 20.0], [0.0, 0.0, 32.0], false);
        assert!((finished_size_mm(&evidence.parts, &[stem])[2] - 22.0).abs() < 1e-4);
    }

    #[test]
    fn a_rod_aslant_reaches_as_far_as_the_corners_of_its_ends() {
        let size = bounds(&rod([0.0; 3], [30.0, 40.0, 0.0], false)).size();
        // Ends are discs across (0.6, 0.8): they reach 2·0.8 along x, 2·0.6 along y, 2 along z.
        assert!(
            (size - Vector::new(30.0 + 3.2, 40.0 + 2.4, 4.0)).norm() < 1e-12,
            "{size}"
        );
        let round = bounds(&rod([0.0; 3], [0.0, 0.0, 10.0], true)).size();
        assert!((round - Vector::new(4.0, 4.0, 10.0)).norm() < 1e-12);
    }
}
