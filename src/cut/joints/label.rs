//! Part ids sunk into cut faces, in strokes like those of a seven-segment display.

use crate::{
    cut::{
        geometry::chart::{Chart, Point2},
        ids::{CutId, PartId},
        joints::{
            face::Taken,
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
/// corner: bottom, middle, top, then the left and the right ones from below. Between two of them
/// 0.4 strokes stay, so that no two bodies touch.
const STROKES: [[f64; 4]; 7] = [
    [0.0, 4.0, 0.0, 1.0],
    [0.0, 4.0, 3.5, 4.5],
    [0.0, 4.0, 7.0, 8.0],
    [0.0, 1.0, 1.4, 3.1],
    [0.0, 1.0, 4.9, 6.6],
    [3.0, 4.0, 1.4, 3.1],
    [3.0, 4.0, 4.9, 6.6],
];
/// How far the cutting bodies stand out of the face, in strokes, so that booleans meet no
/// coinciding faces.
const STANDS_OUT: f64 = 0.5;
/// Turns that are tried at every place.
const TURNS: usize = 8;
/// Places that are looked at in a face: fewer miss room in a narrow one.
const PLACES: f64 = 300.0;
/// Lines along a label on which its distance from all surfaces is measured.
const LINES: usize = 5;
/// Voids that are solved for again move by less than this, mm.
const MARGIN_MM: f64 = 0.05;

/// An id sunk into a cut face.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Label {
    /// The part it is sunk into.
    pub part: PartId,
    /// The cut that made the face.
    pub cut: CutId,
    /// What it says: the part's id, or its number where there is room for no more.
    pub text: String,
    /// Its middle in the face, model frame, mm.
    pub center_mm: [f64; 3],
    /// The unit direction of the text.
    pub right: [f64; 3],
    /// The unit direction into the part.
    pub into: [f64; 3],
    /// The width of a stroke, mm.
    pub stroke_mm: f64,
    /// How deep it is, mm.
    pub depth_mm: f64,
}

impl Label {
    /// What it takes away, as closed bodies that do not touch.
    pub fn taken_away(&self) -> TriMesh {
        self.bodies(0.0)
    }

    /// The bodies that are subtracted from the part: what is taken away, and a stub outside the
    /// face.
    pub(crate) fn cutter(&self) -> TriMesh {
        self.bodies(STANDS_OUT * self.stroke_mm)
    }

    /// The volume it takes away, mm³.
    pub fn volume_mm3(&self) -> f64 {
        self.taken_away().signed_volume_mm3()
    }

    /// The middle of every stroke in the face, model frame.
    pub fn strokes(&self) -> Vec<Point> {
        let middle = |[left, right, bottom, top]: [f64; 4]| {
            self.place(&Point::new((left + right) / 2.0, (bottom + top) / 2.0, 0.0))
        };
        self.boxes().into_iter().map(middle).collect()
    }

    /// The strokes, [left, right, bottom, top] in mm from the label's middle.
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

    /// A point given by text direction, up and depth, mm.
    fn place(&self, p: &Point) -> Point {
        let (right, into) = (Vector::from(self.right), Vector::from(self.into));
        // Whoever looks at the face looks into the part.
        let up = right.cross(&into);
        Point::from(self.center_mm) + right * p.x + up * p.y + into * p.z
    }

    fn bodies(&self, out_mm: f64) -> TriMesh {
        let body = |[left, right, bottom, top]: [f64; 4]| {
            let body = cuboid(
                &Point::new(left, bottom, -out_mm),
                &Point::new(right, top, self.depth_mm),
            );
            // Text, up and depth are left-handed.
            body.map_vertices(|p| self.place(p)).reversed()
        };
        self.boxes()
            .into_iter()
            .fold(TriMesh::default(), |all, stroke| all.joined(&body(stroke)))
    }
}

/// Which strokes a character has; none for one that is not known.
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

/// Width and height of a text, mm.
fn size_mm(text: &str, stroke_mm: f64) -> [f64; 2] {
    let count = text.chars().count() as f64;
    [
        (count * CELL[0] + (count - 1.0) * CELL[2]) * stroke_mm,
        CELL[1] * stroke_mm,
    ]
}

/// What may be written for the part with this index, the fullest first. A lone 6 or 9 could be read
/// the other way up.
fn texts(part: usize) -> Vec<String> {
    let number = (part + 1).to_string();
    let is_clear = !number.contains(['6', '9']);
    std::iter::once(PartId::of(part).to_string())
        .chain(is_clear.then_some(number))
        .collect()
}

/// The labels of all joints' faces with room for one, and a word on those without.
pub(crate) fn labels(
    scene: &PinScene,
    joints: &[Joint],
    placements: &[Placement],
) -> (Vec<Label>, Vec<Remark>) {
    let Some(style) = scene.request.labels else {
        return (Vec::new(), Vec::new());
    };
    let surface = Bvh::new(scene.material.iter_corners());
    let taken = placements
        .iter()
        .flat_map(|placement| &placement.sites)
        .map(Taken::of)
        .collect();
    let marker = Marker {
        scene,
        style,
        surface,
        taken,
    };
    let (mut labels, mut notes) = (Vec::new(), Vec::new());
    for joint in joints {
        for part in [joint.below, joint.above] {
            match marker.label(joint, part) {
                Some(label) => labels.push(label),
                None => notes.push(Remark::NoRoomForLabel {
                    part: PartId::of(part),
                    cut: CutId::of(joint.cut),
                }),
            }
        }
    }
    (labels, notes)
}

struct Marker<'a> {
    scene: &'a PinScene<'a>,
    style: LabelStyle,
    surface: Bvh,
    /// What pins and sockets take up.
    taken: Vec<Taken>,
}

impl Marker<'_> {
    /// The label of a part's face in a joint: the fullest text for which there is room.
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
        texts(part).iter().find_map(|text| {
            let places = joint
                .faces
                .iter()
                .flat_map(|cap| places(cap, size_mm(text, self.style.stroke_mm)[1] / 2.0));
            let mut turned = places.flat_map(|p| (0..TURNS).map(move |turn| (p, turn)));
            turned.find_map(|place| {
                Some(at(text, place)).filter(|label| self.has_room(label, joint.cut))
            })
        })
    }

    /// Whether the wall stays around all strokes, to the outside, voids, pins, sockets and other
    /// cuts.
    fn has_room(&self, label: &Label, cut: usize) -> bool {
        let [width, height] = size_mm(&label.text, label.stroke_mm);
        let wall_mm = self.scene.request.wall_mm + MARGIN_MM;
        let radius = height / (2 * LINES) as f64;
        let line = |index: usize| {
            let y = height * ((index as f64 + 0.5) / LINES as f64 - 0.5);
            [-width / 2.0, width / 2.0].map(|x| label.place(&Point::new(x, y, label.depth_mm)))
        };
        let is_clear = |plane: &Plane, ends: &[Point; 2]| {
            let [near, far] = ends.map(|end| plane.distance(&end));
            near.abs().min(far.abs()) >= radius + wall_mm && near * far > 0.0
        };
        let tree = self.scene.tree;
        let others = |at: &Point| {
            let made =
                (0..tree.planes.len()).filter(|&other| other != cut && tree.acts_at(other, at));
            made.map(|other| &tree.planes[other]).collect::<Vec<_>>()
        };
        (0..LINES).map(line).all(|ends| {
            let reach = radius + wall_mm;
            others(&ends[0])
                .into_iter()
                .all(|plane| is_clear(plane, &ends))
                && self
                    .taken
                    .iter()
                    .all(|taken| taken.is_clear_of(ends.each_ref(), reach))
                && self.surface.segment_distance(&ends[0], &ends[1], reach) >= reach
        })
    }
}

/// Points spread over a face, at least so far from its edge, mm, the farthest from it first.
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
    let mut deep: Vec<(f64, Point2)> = points
        .map(|p| (cap.outline.signed_distance(&p), p))
        .collect();
    deep.retain(|(distance, _)| *distance >= least_mm);
    deep.sort_by(|a, b| b.0.total_cmp(&a.0));
    deep.into_iter().map(|(_, p)| p).collect()
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
        // Horizontal strokes are 4 × 1, upright ones 1.7 × 1, in strokes: P has 2 and 3, 0 has 2
        // and 4, 2 has 3 and 2, 8 has 3 and 4.
        let area = (10.0 * 4.0 + 13.0 * 1.7) * 0.25;
        assert!((label.volume_mm3() - area * 0.4).abs() < 1e-12);
    }

    #[test]
    fn a_label_reads_from_left_to_right_for_whoever_looks_at_the_face() {
        // Seen from above, along −z, x runs to the right and y up: the 1 after P lies at larger x,
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
