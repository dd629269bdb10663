//! The section at a cut as a drawing with its lengths: outlines, walls, pins and sockets.

use super::figure::{Picture, Role};
use super::inserts::{Insert, inserts};
use crate::base::numbers::{number, quantity};
use crate::draw::{Drawing, Drawn, Hatch, Key, Mark, Spot, Stroke, VOID, draw_peg, hex, legend};
use crate::geom::{Plane, Point, Vector};
use crate::sheet::Checklist;
use crate::verify::Peg;

/// Width, pixels.
const WIDTH_PX: usize = 1000;

/// What is left below the section for its width and the legend, pixels.
const BELOW_PX: f64 = 120.0;

/// How far above the lower edge the middle of the legend is, and how far from the left one it
/// begins, pixels.
const LEGEND_PX: [f64; 2] = [20.0, 14.0];

/// Height of words, pixels: 8 points at the width of an A4 page.
const TEXT_PX: f64 = 19.0;

/// The room of the section inside the drawing: left, top, right, bottom, pixels; beside it stand
/// names and lengths.
const FRAME_PX: [f64; 4] = [230.0, 40.0, 770.0, 540.0];

/// How far the lengths over all lie from the section, pixels.
const ASIDE_PX: f64 = 34.0;

/// Where up is less than this share of the plane's directions, the plane is level and nothing in it
/// is up.
const LEVEL_RATIO: f64 = 0.2;

/// The section of the uncut body at a cut.
#[derive(Debug, Clone, PartialEq)]
pub struct CutFace {
    /// The cut's id.
    pub cut: String,
    /// Its plane, model frame.
    pub plane: Plane,
    /// The outlines of material in it, in the coordinates of [`Plane::basis`], mm: outer ones
    /// counter-clockwise, holes clockwise.
    pub rings: Vec<Vec<[f64; 2]>>,
    /// Where the wall between the outside and a void is thinnest in it: its two ends, same
    /// coordinates.
    pub wall: Option<[[f64; 2]; 2]>,
    /// Every region of material with the parts below and above it.
    pub regions: Vec<Region>,
    /// A point of every face that the cut leaves whole, same coordinates.
    pub whole: Vec<[f64; 2]>,
    /// The voids it opens.
    pub mouths: Vec<Mouth>,
}

/// A region of material in a cut.
#[derive(Debug, Clone, PartialEq)]
pub struct Region {
    /// A point well inside, in the plane's coordinates, mm.
    pub at: [f64; 2],
    /// The ids of the parts below and above the cut there.
    pub parts: [String; 2],
}

/// Where a cut opens a void.
#[derive(Debug, Clone, PartialEq)]
pub struct Mouth {
    /// The void's id.
    pub void: String,
    /// The middle of the largest disc that passes, in the plane's coordinates, mm.
    pub at: [f64; 2],
    /// The diameter of that disc, mm.
    pub diameter_mm: f64,
}

/// From the plane to the drawing.
struct Sheet {
    turn: [f64; 2],
    scale: f64,
    offset: Spot,
}

impl Sheet {
    /// Turned so that `up` (in the plane) is up, as large as the frame.
    fn of(face: &CutFace, up: [f64; 2]) -> Self {
        // Where up is all but across the plane, any direction will do.
        let length = up[0].hypot(up[1]);
        let turn = if length > LEVEL_RATIO {
            up.map(|x| x / length)
        } else {
            [0.0, 1.0]
        };
        let unscaled = Self {
            turn,
            scale: 1.0,
            offset: [0.0; 2],
        };
        let [low, high] = bounds(face.rings.iter().flatten().map(|point| unscaled.at(*point)));
        let [left, top, right, bottom] = FRAME_PX;
        let fit = |from: f64, to: f64, pixels: f64| pixels / (to - from).max(f64::MIN_POSITIVE);
        let scale = fit(low[0], high[0], right - left).min(fit(low[1], high[1], bottom - top));
        let offset = [
            0.5 * (left + right - scale * (low[0] + high[0])),
            top - scale * low[1],
        ];
        Self {
            turn,
            scale,
            offset,
        }
    }

    /// Where a point of the plane falls.
    fn at(&self, [u, v]: [f64; 2]) -> Spot {
        let [x, y] = self.turn;
        [
            self.offset[0] + self.scale * (u * y - v * x),
            self.offset[1] - self.scale * (u * x + v * y),
        ]
    }
}

/// The least and the greatest of spots.
fn bounds(spots: impl Iterator<Item = Spot>) -> [Spot; 2] {
    spots.fold(
        [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]],
        |[low, high], spot| {
            [
                [low[0].min(spot[0]), low[1].min(spot[1])],
                [high[0].max(spot[0]), high[1].max(spot[1])],
            ]
        },
    )
}

/// The drawing of every cut.
pub(super) fn drawings(sheet: &Checklist, faces: &[CutFace]) -> Vec<Picture> {
    faces
        .iter()
        .filter(|face| !face.rings.is_empty())
        .map(|face| picture(sheet, face))
        .collect()
}

fn picture(sheet: &Checklist, face: &CutFace) -> Picture {
    let pegs = pegs(sheet, &face.cut);
    let names: Vec<&str> = pegs.iter().map(|(pin, _)| pin.id.as_str()).collect();
    let pins = if names.is_empty() {
        "no pins".to_owned()
    } else {
        format!("pins {}", names.join(", "))
    };
    Picture {
        file: format!("pictures/cut-{}.svg", face.cut),
        role: Role::Cut,
        caption: format!(
            "Cut {}{}. P: the part behind the drawing | the part taken off it; N: pins; V: voids. Diameters in mm.",
            face.cut,
            sides(sheet, &face.cut)
        ),
        alt: format!("Section at cut {} with its sizes, {pins}.", face.cut),
        drawn: Drawn::Svg(drawn(sheet, face, &pegs)),
    }
}

/// `, made only above C1 and below C2`; nothing of a cut through everything.
fn sides(sheet: &Checklist, cut: &str) -> String {
    let within = sheet
        .cuts
        .iter()
        .filter(|row| row.id == cut)
        .flat_map(|row| &row.within);
    let sides: Vec<String> = within
        .map(|side| format!("{} {}", side.side, side.cut))
        .collect();
    if sides.is_empty() {
        String::new()
    } else {
        format!(", made only {}", sides.join(" and "))
    }
}

/// The pins of a cut with their sockets.
fn pegs<'a>(sheet: &'a Checklist, cut: &str) -> Vec<(&'a Peg, Option<&'a Peg>)> {
    let is_here = |pin: &&Peg| {
        sheet
            .joints
            .iter()
            .any(|joint| joint.id == pin.joint && joint.cut == cut)
    };
    let socket_of = |pin: &Peg| {
        sheet
            .parts
            .iter()
            .flat_map(|part| &part.sockets)
            .find(|socket| socket.id == pin.id)
    };
    let pins = sheet
        .parts
        .iter()
        .flat_map(|part| &part.pins)
        .filter(is_here);
    pins.map(|pin| (pin, socket_of(pin))).collect()
}

fn drawn(sheet: &Checklist, face: &CutFace, pegs: &[(&Peg, Option<&Peg>)]) -> Drawing {
    let (u, v) = face.plane.basis();
    let axis = Vector::from(sheet.goal.aim.axis).normalize();
    let paper = Sheet::of(face, [u.dot(&axis), v.dot(&axis)]);
    let rings: Vec<Vec<Spot>> = face
        .rings
        .iter()
        .map(|ring| ring.iter().map(|p| paper.at(*p)).collect())
        .collect();
    let [_, [_, bottom]] = bounds(rings.iter().flatten().copied());
    let mut drawing = Drawing::new([WIDTH_PX, (bottom + BELOW_PX) as usize], TEXT_PX);
    let outer: Vec<Vec<Spot>> = rings
        .iter()
        .zip(&face.rings)
        .filter(|(_, ring)| area_mm2(ring) > 0.0)
        .map(|(spots, _)| spots.clone())
        .collect();
    drawing.path(&outer, true, (Some(&hex(VOID)), Stroke::NONE));
    Hatch::PRINTED.fill(
        &mut drawing,
        &rings,
        Stroke {
            width: 2.0,
            ..Stroke::THIN
        },
    );
    let inserts = inserts(sheet, &face.plane);
    draw_legend(&mut drawing, face, (!pegs.is_empty(), &inserts));
    draw_size(&mut drawing, &rings, paper.scale);
    let mut marks = Vec::new();
    for mouth in &face.mouths {
        let at = paper.at(mouth.at);
        drawing.circle(
            at,
            0.5 * paper.scale * mouth.diameter_mm,
            (None, Stroke::DASHED),
        );
        marks.push(Mark::new(
            at,
            format!("{} open ⌀{}", mouth.void, number(mouth.diameter_mm)),
        ));
    }
    for (pin, socket) in pegs {
        let at = paper.at(flat(&face.plane, &pin.center_mm));
        draw_peg(
            &mut drawing,
            at,
            [
                paper.scale * pin.diameter_mm,
                socket.map_or(0.0, |s| paper.scale * s.diameter_mm),
            ],
        );
        let radius_px = 0.5 * paper.scale * socket.map_or(pin.diameter_mm, |s| s.diameter_mm);
        marks.push(Mark {
            radius_px,
            ..Mark::new(at, peg_words(pin, *socket))
        });
    }
    marks.extend(face.wall.map(|ends| draw_wall(&mut drawing, ends, &paper)));
    marks.extend(
        face.whole
            .iter()
            .map(|at| Mark::new(paper.at(*at), "stays whole".to_owned())),
    );
    let region = |region: &Region| Mark::new(paper.at(region.at), region.parts.join(" | "));
    marks.extend(face.regions.iter().map(region));
    marks.extend(
        inserts
            .iter()
            .map(|insert| draw_insert(&mut drawing, insert, &paper)),
    );
    drawing.callouts(&marks);
    drawing
}

/// Twice the area inside a ring, negative where it runs clockwise.
fn area_mm2(ring: &[[f64; 2]]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    ring.iter()
        .zip(next)
        .map(|(a, b)| a[0] * b[1] - a[1] * b[0])
        .sum()
}

/// A point of the plane in its coordinates.
fn flat(plane: &Plane, point_mm: &[f64; 3]) -> [f64; 2] {
    let (u, v) = plane.basis();
    let from_origin = Point::from(*point_mm).coords;
    [u.dot(&from_origin), v.dot(&from_origin)]
}

fn peg_words(pin: &Peg, socket: Option<&Peg>) -> String {
    let socket = socket.map_or(String::new(), |socket| {
        format!(" in ⌀{}", number(socket.diameter_mm))
    });
    format!("{} ⌀{}{socket}", pin.id, number(pin.diameter_mm))
}

/// The thinnest wall as a thick line, and its words.
fn draw_wall(drawing: &mut Drawing, ends: [[f64; 2]; 2], paper: &Sheet) -> Mark {
    let [a, b] = ends.map(|end| paper.at(end));
    drawing.line(
        [a, b],
        Stroke {
            width: 4.0,
            ..Stroke::THICK
        },
    );
    let mm = (ends[0][0] - ends[1][0]).hypot(ends[0][1] - ends[1][1]);
    Mark::new(
        [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])],
        format!("wall {}", quantity(mm, "mm")),
    )
}

/// The section of something that is not printed, and its name.
fn draw_insert(drawing: &mut Drawing, insert: &Insert, paper: &Sheet) -> Mark {
    let ring = insert.ring.iter().map(|at| paper.at(*at)).collect();
    insert.hatch.fill(drawing, &[ring], Stroke::THIN);
    Mark::new(paper.at(insert.middle()), insert.id.clone())
}

/// What is drawn how, of what there is.
fn draw_legend(drawing: &mut Drawing, face: &CutFace, (has_pins, inserts): (bool, &[Insert])) {
    let has = |hatch: Hatch| inserts.iter().any(|insert| insert.hatch == hatch);
    let keys = [
        (true, Key::Cut(Hatch::PRINTED), "material"),
        (!face.mouths.is_empty(), Key::Void, "open void"),
        (
            !face.mouths.is_empty(),
            Key::Disc,
            "widest disc that passes",
        ),
        (has_pins, Key::Pin, "pin in its socket"),
        (has(Hatch::RODS), Key::Cut(Hatch::RODS), "hardware"),
        (has(Hatch::BALLAST), Key::Cut(Hatch::BALLAST), "ballast"),
    ];
    let keys: Vec<(Key, &str)> = keys
        .into_iter()
        .filter(|key| key.0)
        .map(|(_, key, words)| (key, words))
        .collect();
    let [up, left] = LEGEND_PX;
    let [_, height] = drawing.size_px();
    legend(drawing, [left, height - up], &keys);
}

/// The lengths over all.
fn draw_size(drawing: &mut Drawing, rings: &[Vec<Spot>], scale: f64) {
    let [[left, top], [right, bottom]] = bounds(rings.iter().flatten().copied());
    let words = |pixels: f64| quantity(pixels / scale, "mm");
    drawing.dimension(
        [[left, bottom], [right, bottom]],
        [0.0, ASIDE_PX],
        &words(right - left),
    );
    drawing.dimension(
        [[right, top], [right, bottom]],
        [ASIDE_PX, 0.0],
        &words(bottom - top),
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(low: f64, high: f64) -> Vec<[f64; 2]> {
        vec![[low, low], [high, low], [high, high], [low, high]]
    }

    #[test]
    fn rings_have_the_sign_of_their_turn() {
        let ring = square(1.0, 3.0);
        let back: Vec<[f64; 2]> = ring.iter().rev().copied().collect();
        assert_eq!([area_mm2(&ring), area_mm2(&back)], [8.0, -8.0]);
    }

    #[test]
    fn a_section_fills_the_frame_with_up_up_and_right_right() {
        let plane = Plane::through(&Point::origin(), &Vector::z());
        let face = CutFace {
            cut: "C1".into(),
            plane,
            rings: vec![square(0.0, 10.0)],
            wall: None,
            whole: vec![],
            regions: vec![],
            mouths: vec![],
        };
        for up in [[0.0, 1.0], [1.0, 0.0], [-0.6, 0.8]] {
            let paper = Sheet::of(&face, up);
            let [origin, above] = [[0.0, 0.0], up].map(|point| paper.at(point));
            assert!(
                (above[0] - origin[0]).abs() < 1e-9 && above[1] < origin[1],
                "{up:?}"
            );
            // Right of up is up turned clockwise: the drawing is no mirror image.
            let right = paper.at([up[1], -up[0]]);
            assert!(
                right[0] > origin[0] && (right[1] - origin[1]).abs() < 1e-9,
                "{up:?}"
            );
        }
        let [low, high] = bounds(
            face.rings[0]
                .iter()
                .map(|point| Sheet::of(&face, [0.0, 1.0]).at(*point)),
        );
        assert!((low[1] - FRAME_PX[1]).abs() < 1e-9 && (high[1] - FRAME_PX[3]).abs() < 1e-9);
    }
}
