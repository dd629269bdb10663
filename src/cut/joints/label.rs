//! Part ids engraved into cut faces, in strokes like those of a seven-segment display.

use crate::{
    base::watch::Cancelled,
    cut::{
        geometry::chart::{Chart, Point2},
        ids::{CutId, PartId},
        joints::{
            face::OccupiedSpace,
            placement::{PinScene, Placement},
        },
        pieces::split::{Cap, Joint},
        remark::Remark,
        request::LabelStyle,
    },
    geom::{Bvh, Plane, Point, Vector},
    mesh::{TriMesh, primitives::cuboid},
};
use serde::{Deserialize, Serialize};

/// A character's width, height and distance from the next one, in strokes.
const CELL: [f64; 3] = [4.0, 8.0, 1.5];
/// The seven strokes of a character, [left, right, bottom, top] in strokes from its lower left
/// corner. Bottom, middle and top come first, then left and right, each from below. Gaps of 0.4
/// strokes keep the bodies apart.
const STROKES: [[f64; 4]; 7] = [
    [0.0, 4.0, 0.0, 1.0],
    [0.0, 4.0, 3.5, 4.5],
    [0.0, 4.0, 7.0, 8.0],
    [0.0, 1.0, 1.4, 3.1],
    [0.0, 1.0, 4.9, 6.6],
    [3.0, 4.0, 1.4, 3.1],
    [3.0, 4.0, 4.9, 6.6],
];
/// Height of the cutting bodies above the face, in strokes, so that booleans meet no coinciding
/// faces.
const STUB: f64 = 0.5;
/// Rotations tried at every place.
const TURNS: usize = 8;
/// Approximate number of places examined per face: fewer miss room in a narrow one.
const PLACES: f64 = 300.0;
/// Lines along a label from which its distance to all surfaces is measured.
const LINES: usize = 5;
/// Extra distance from all surfaces, mm: voids that are solved again move by less.
const MARGIN_MM: f64 = 0.05;

/// An id engraved into a cut face.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Label {
    /// The part it is engraved into.
    pub part: PartId,
    /// The cut that made the face.
    pub cut: CutId,
    /// The part's id, or its number alone if there is no room for more.
    pub text: String,
    /// Its centre in the face, model frame, mm.
    pub center_mm: [f64; 3],
    /// Unit direction of the text.
    pub right: [f64; 3],
    /// Unit direction into the part.
    pub into: [f64; 3],
    /// Width of a stroke, mm.
    pub stroke_mm: f64,
    /// Depth, mm.
    pub depth_mm: f64,
}

impl Label {
    /// Returns the material it removes, as closed bodies that do not touch.
    pub fn taken_away(&self) -> TriMesh {
        self.bodies(0.0)
    }

    /// Returns the bodies to subtract from the part: the material removed, and a stub outside the
    /// face.
    pub(crate) fn cutter(&self) -> TriMesh {
        self.bodies(STUB * self.stroke_mm)
    }

    /// Returns the volume it removes, mm³.
    pub fn volume_mm3(&self) -> f64 {
        self.taken_away().signed_volume_mm3()
    }

    /// Returns the centre of every stroke in the face, model frame, mm.
    pub fn strokes(&self) -> Vec<Point> {
        let middle = |[left, right, bottom, top]: [f64; 4]| {
            self.place(&Point::new((left + right) / 2.0, (bottom + top) / 2.0, 0.0))
        };
        self.boxes().into_iter().map(middle).collect()
    }

    /// Returns the strokes, [left, right, bottom, top] in mm from the label's centre.
    fn boxes(&self) -> Vec<[f64; 4]> {
        let [width, height] = size_mm(&self.text, self.stroke_mm);
        let cell = (CELL[0] + CELL[2]) * self.stroke_mm;
        let boxes = self
            .text
            .chars()
            .enumerate()
            .flat_map(|(index, character)| {
                strokes_of(character)
                    .iter()
                    .map(move |&stroke| (index, STROKES[stroke]))
            });
        let place = |(index, stroke): (usize, [f64; 4])| {
            let [left, right, bottom, top] = stroke.map(|x| x * self.stroke_mm);
            let shift = cell * index as f64 - width / 2.0;
            [
                left + shift,
                right + shift,
                bottom - height / 2.0,
                top - height / 2.0,
            ]
        };
        boxes.map(place).collect()
    }

    /// Maps a point from text direction, up and depth to the model frame, mm.
    fn place(&self, p: &Point) -> Point {
        let (right, into) = (Vector::from(self.right), Vector::from(self.into));
        // The reader looks into the part.
        let up = right.cross(&into);
        Point::from(self.center_mm) + right * p.x + up * p.y + into * p.z
    }

    fn bodies(&self, out_mm: f64) -> TriMesh {
        let body = |[left, right, bottom, top]: [f64; 4]| {
            let body = cuboid(
                &Point::new(left, bottom, -out_mm),
                &Point::new(right, top, self.depth_mm),
            );
            // Text, up and depth form a left-handed frame.
            body.map_vertices(|p| self.place(p)).reversed()
        };
        self.boxes()
            .into_iter()
            .fold(TriMesh::default(), |all, stroke| all.joined(&body(stroke)))
    }
}

/// Returns the strokes of a character; empty if it is unknown.
fn strokes_of(character: char) -> &'static [usize] {
    match character {
        '0' => &[0, 2, 3, 4, 5, 6],
        '1' => &[5, 6],
        '2' => &[0, 1, 2, 3, 6],
        '3' => &[0, 1, 2, 5, 6],
        '4' => &[1, 4, 5, 6],
        '5' => &[0, 1, 2, 4, 5],
        '6' => &[0, 1, 2, 3, 4, 5],
        '7' => &[2, 5, 6],
        '8' => &[0, 1, 2, 3, 4, 5, 6],
        '9' => &[0, 1, 2, 4, 5, 6],
        'P' => &[1, 2, 3, 4, 6],
        _ => &[],
    }
}

/// Returns width and height of a text, mm.
fn size_mm(text: &str, stroke_mm: f64) -> [f64; 2] {
    let count = text.chars().count() as f64;
    [
        (count * CELL[0] + (count - 1.0) * CELL[2]) * stroke_mm,
        CELL[1] * stroke_mm,
    ]
}

/// Returns the possible texts for the part with this index, the fullest first. A lone 6 or 9 is
/// left out: it could be read upside down.
fn texts(part: usize) -> Vec<String> {
    let number = (part + 1).to_string();
    let is_unambiguous = !number.contains(['6', '9']);
    std::iter::once(PartId::of(part).to_string())
        .chain(is_unambiguous.then_some(number))
        .collect()
}

/// Returns a label for every joint face with room for one, and a remark for every face without.
pub(crate) fn labels(
    scene: &PinScene,
    joints: &[Joint],
    placements: &[Placement],
) -> Result<(Vec<Label>, Vec<Remark>), Cancelled> {
    let Some(style) = scene.request.labels else {
        return Ok((Vec::new(), Vec::new()));
    };
    let surface = Bvh::new(scene.material.iter_corners());
    let occupied = placements
        .iter()
        .flat_map(|placement| &placement.sites)
        .map(OccupiedSpace::of)
        .collect();
    let labeller = Labeller {
        scene,
        style,
        surface,
        occupied,
    };
    let (mut labels, mut notes) = (Vec::new(), Vec::new());
    for joint in joints {
        for part in [joint.below, joint.above] {
            scene.request.watch.check()?;
            match labeller.label(joint, part) {
                Some(label) => labels.push(label),
                None => notes.push(Remark::NoRoomForLabel {
                    part: PartId::of(part),
                    cut: CutId::of(joint.cut),
                }),
            }
        }
    }
    Ok((labels, notes))
}

struct Labeller<'a> {
    scene: &'a PinScene<'a>,
    style: LabelStyle,
    surface: Bvh,
    /// Space occupied by pins and sockets.
    occupied: Vec<OccupiedSpace>,
}

impl Labeller<'_> {
    /// Returns the label of a part's face in a joint, with the fullest text that fits. `None` if no
    /// text fits.
    fn label(&self, joint: &Joint, part: usize) -> Option<Label> {
        let plane = &self.scene.tree.planes[joint.cut];
        let into = if part == joint.above {
            plane.normal
        } else {
            -plane.normal
        };
        let at = |text: &str, (p, turn): (Point2, usize)| {
            let center = Chart::of_plane(plane).lift(plane, &p);
            let (u, v) = plane.basis();
            let (sin, cos) = (std::f64::consts::PI * turn as f64 / TURNS as f64).sin_cos();
            Label {
                part: PartId::of(part),
                cut: CutId::of(joint.cut),
                text: text.to_owned(),
                center_mm: center.into(),
                right: (u * cos + v * sin).into(),
                into: into.into(),
                stroke_mm: self.style.stroke_mm,
                depth_mm: self.style.depth_mm,
            }
        };
        texts(self.style.numbered + part).iter().find_map(|text| {
            let places = joint
                .faces
                .iter()
                .flat_map(|cap| places(cap, size_mm(text, self.style.stroke_mm)[1] / 2.0));
            let mut poses = places.flat_map(|p| (0..TURNS).map(move |turn| (p, turn)));
            poses.find_map(|place| {
                Some(at(text, place)).filter(|label| self.has_room(label, joint.cut))
            })
        })
    }

    /// Returns true if the wall remains around all strokes: to the outside, voids, pins, sockets
    /// and other cuts.
    fn has_room(&self, label: &Label, cut: usize) -> bool {
        let [width, height] = size_mm(&label.text, label.stroke_mm);
        let wall_mm = self.scene.request.wall_mm + MARGIN_MM;
        let radius = height / (2 * LINES) as f64;
        let line = |index: usize| {
            let y = height * ((index as f64 + 0.5) / LINES as f64 - 0.5);
            [-width / 2.0, width / 2.0].map(|x| label.place(&Point::new(x, y, label.depth_mm)))
        };
        let keeps_wall = |plane: &Plane, ends: &[Point; 2]| {
            let [near, far] = ends.map(|end| plane.distance(&end));
            near.abs().min(far.abs()) >= radius + wall_mm && near * far > 0.0
        };
        let tree = self.scene.tree;
        let others = |at: &Point| {
            let cuts =
                (0..tree.planes.len()).filter(|&other| other != cut && tree.acts_at(other, at));
            cuts.map(|other| &tree.planes[other]).collect::<Vec<_>>()
        };
        (0..LINES).map(line).all(|ends| {
            let reach = radius + wall_mm;
            others(&ends[0])
                .into_iter()
                .all(|plane| keeps_wall(plane, &ends))
                && self
                    .occupied
                    .iter()
                    .all(|space| space.is_clear_of(ends.each_ref(), reach))
                && self.surface.segment_distance(&ends[0], &ends[1], reach) >= reach
        })
    }
}

/// Returns points spread over a face, at least `least_mm` from its edge, the farthest from it
/// first.
fn places(cap: &Cap, least_mm: f64) -> Vec<Point2> {
    let Some((min, max)) = cap.outline.bounds() else {
        return Vec::new();
    };
    let pitch = (cap.area_mm2 / PLACES).sqrt();
    let size = max - min;
    let [columns, rows] = [size.x, size.y].map(|extent| (extent / pitch).ceil() as usize);
    let at =
        |i: usize, j: usize| min + nalgebra::Vector2::new(i as f64 + 0.5, j as f64 + 0.5) * pitch;
    let points = (0..columns).flat_map(|i| (0..rows).map(move |j| at(i, j)));
    let mut by_depth: Vec<(f64, Point2)> = points
        .map(|p| (cap.outline.signed_distance(&p), p))
        .collect();
    by_depth.retain(|(distance, _)| *distance >= least_mm);
    by_depth.sort_by(|a, b| b.0.total_cmp(&a.0));
    by_depth.into_iter().map(|(_, p)| p).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::bodies;

    fn label(text: &str) -> Label {
        Label {
            part: PartId::of(1),
            cut: "C1".into(),
            text: text.into(),
            center_mm: [1.0, 2.0, 3.0],
            right: [1.0, 0.0, 0.0],
            into: [0.0, 0.0, -1.0],
            stroke_mm: 0.5,
            depth_mm: 0.4,
        }
    }

    #[test]
    fn the_strokes_of_a_label_are_bodies_that_do_not_touch_and_add_up() {
        let label = label("P028");
        let strokes = label.strokes().len();
        assert_eq!(strokes, 5 + 6 + 5 + 7);
        let found = bodies(&label.taken_away());
        assert_eq!(found.len(), strokes);
        assert!(found.iter().all(|body| body.signed_volume_mm3() > 0.0));
        // Horizontal strokes are 4 × 1, upright ones 1.7 × 1, in strokes. Horizontal and upright
        // counts: P has 2 and 3, 0 has 2 and 4, 2 has 3 and 2, 8 has 3 and 4.
        let area = (10.0 * 4.0 + 13.0 * 1.7) * 0.25;
        assert!((label.volume_mm3() - area * 0.4).abs() < 1e-12);
    }

    #[test]
    fn a_label_reads_from_left_to_right_for_whoever_looks_at_the_face() {
        // Seen from above, along −z, x runs to the right and y up. The 1 after P lies at larger x,
        // the bow of P in the upper half.
        let strokes = label("P1").strokes();
        assert!(
            strokes.iter().take(5).all(|p| p.x < 1.0) && strokes.iter().skip(5).all(|p| p.x > 1.0)
        );
        let upper = strokes.iter().take(5).filter(|p| p.y > 2.1).count();
        assert_eq!(upper, 3);
    }

    #[test]
    fn a_six_is_never_written_alone() {
        assert_eq!(
            (texts(0), texts(5)),
            (
                vec!["P01".to_owned(), "1".to_owned()],
                vec!["P06".to_owned()]
            )
        );
    }
}
