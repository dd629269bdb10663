//! The section at a cut as a drawing with dimensions: outlines, walls, pins and sockets.

use super::figure::{Picture, Role};
use super::inserts::{Insert, inserts};
use super::plane_map::{PlaneMap, Window, bounds, doubled_area_mm2, flat};
use crate::base::numbers::quantity;
use crate::draw::{
    Drawing, Drawn, Hatch, Key, Mark, Paint, Spot, Stroke, VOID, draw_legend, draw_peg,
};
use crate::geom::{Plane, Vector};
use crate::sheet::{Checklist, JointRow};
use crate::verify::Peg;

/// Width of the drawing, pixels.
const WIDTH_PX: usize = 1000;

/// Room below the section for its width and the legend, pixels.
const BELOW_PX: f64 = 120.0;

/// Distances of the legend's middle from the lower edge and of its begin from the left edge,
/// pixels.
const LEGEND_PX: [f64; 2] = [20.0, 14.0];

/// Height of words, pixels: 10 points on a picture 150 mm wide.
const TEXT_PX: f64 = 24.0;

/// Frame of the section inside the drawing: left, top, right, bottom, pixels. Names and dimensions
/// stand outside of it.
const FRAME_PX: [f64; 4] = [230.0, 40.0, 770.0, 540.0];

/// Distance of the overall dimensions from the section, pixels.
const ASIDE_PX: f64 = 34.0;

/// The section of the uncut body at a cut.
#[derive(Debug, Clone, PartialEq)]
pub struct CutFace {
    /// Id of the cut.
    pub cut: String,
    /// Plane of the cut, model frame.
    pub plane: Plane,
    /// Outlines of material in the coordinates of [`Plane::basis`], mm: outer ones
    /// counter-clockwise, holes clockwise.
    pub rings: Vec<Vec<[f64; 2]>>,
    /// Ends of the thinnest wall between the outside and a void, same coordinates.
    pub wall: Option<[[f64; 2]; 2]>,
    /// Regions of material, each with the parts below and above it.
    pub regions: Vec<Region>,
    /// A point of each face that the cut leaves whole, same coordinates.
    pub whole: Vec<[f64; 2]>,
    /// Mouths of the voids it opens.
    pub mouths: Vec<Mouth>,
}

/// A region of material in a cut.
#[derive(Debug, Clone, PartialEq)]
pub struct Region {
    /// Point well inside, in the plane's coordinates, mm.
    pub at: [f64; 2],
    /// Ids of the parts below and above the cut there.
    pub parts: [String; 2],
}

/// The mouth of a void in a cut.
#[derive(Debug, Clone, PartialEq)]
pub struct Mouth {
    /// Id of the void.
    pub void: String,
    /// Middle of the widest disc that passes, in the plane's coordinates, mm.
    pub at: [f64; 2],
    /// Diameter of that disc, mm.
    pub diameter_mm: f64,
}

/// Draws every cut that goes through material.
pub(super) fn drawings(sheet: &Checklist, faces: &[CutFace]) -> Vec<Picture> {
    faces
        .iter()
        .filter(|face| !face.rings.is_empty())
        .map(|face| picture(sheet, face))
        .collect()
}

fn picture(sheet: &Checklist, face: &CutFace) -> Picture {
    let pins_here = pins_of_cut(sheet, &face.cut);
    let names: Vec<&str> = pins_here.iter().map(|pin| pin.pin.id.as_str()).collect();
    let pins = if names.is_empty() {
        "no pins".to_owned()
    } else {
        format!("pins {}", names.join(", "))
    };
    Picture {
        file: format!("pictures/cut-{}.svg", face.cut),
        role: Role::Cut,
        caption: format!(
            "Cut {}{}. P | P: the first part is seen here, the second sits on top of it; N: pins; V: voids. Diameters in mm.",
            face.cut,
            limits(sheet, &face.cut)
        ),
        alt: format!("Section at cut {} with its sizes, {pins}.", face.cut),
        drawn: Drawn::Svg(draw_section(sheet, face, &pins_here)),
    }
}

/// Words the sides to which a cut is limited: `, made only above C1 and below C2`; empty for a cut
/// through everything.
fn limits(sheet: &Checklist, cut: &str) -> String {
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

/// A pin that stands on the cut, with the socket it goes into.
struct PinInSocket<'a> {
    pin: &'a Peg,
    socket: Option<&'a Peg>,
}

impl PinInSocket<'_> {
    /// Draws both circles and returns their name.
    fn draw(&self, drawing: &mut Drawing, at: Spot, scale: f64) -> Mark {
        let pin_mm = self.pin.diameter_mm;
        let socket_mm = self.socket.map(|socket| socket.diameter_mm);
        let socket_px = socket_mm.map_or(0.0, |mm| scale * mm);
        draw_peg(drawing, at, [scale * pin_mm, socket_px]);
        Mark {
            radius_px: 0.5 * scale * socket_mm.unwrap_or(pin_mm),
            ..Mark::new(at, self.name())
        }
    }

    fn name(&self) -> String {
        let socket = self.socket.map_or(String::new(), |socket| {
            format!(" in ⌀{:.1}", socket.diameter_mm)
        });
        format!("{} ⌀{:.1}{socket}", self.pin.id, self.pin.diameter_mm)
    }
}

/// Returns the pins of a cut with their sockets.
fn pins_of_cut<'a>(sheet: &'a Checklist, cut: &str) -> Vec<PinInSocket<'a>> {
    let joints = &sheet.joints;
    let is_here = |pin: &&Peg| {
        let is_joint = |joint: &JointRow| joint.id == pin.joint && joint.cut == cut;
        joints.iter().any(is_joint)
    };
    let sockets = || sheet.parts.iter().flat_map(|part| &part.sockets);
    let pins = sheet.parts.iter().flat_map(|part| &part.pins);
    pins.filter(is_here)
        .map(|pin| PinInSocket {
            pin,
            socket: sockets().find(|socket| socket.id == pin.id),
        })
        .collect()
}

fn draw_section(sheet: &Checklist, face: &CutFace, pins: &[PinInSocket]) -> Drawing {
    let (u, v) = face.plane.basis();
    let axis = Vector::from(sheet.goal.aim.axis).normalize();
    let up = [u.dot(&axis), v.dot(&axis)];
    let map = PlaneMap::of(&face.rings, up, &Window::open(FRAME_PX));
    let spots = |ring: &Vec<[f64; 2]>| ring.iter().map(|p| map.at(*p)).collect();
    let rings: Vec<Vec<Spot>> = face.rings.iter().map(spots).collect();
    let [_, [_, bottom]] = bounds(rings.iter().flatten().copied());
    let mut drawing = Drawing::new([WIDTH_PX, (bottom + BELOW_PX) as usize], TEXT_PX);
    draw_material(&mut drawing, face, &rings);
    let inserts = inserts(sheet, &face.plane);
    draw_section_legend(&mut drawing, face, !pins.is_empty(), &inserts);
    draw_size(&mut drawing, &rings, map.scale());

    let mut marks = Vec::new();
    for mouth in &face.mouths {
        marks.push(draw_mouth(&mut drawing, mouth, &map));
    }
    for pin in pins {
        let at = map.at(flat(&face.plane, &pin.pin.center_mm));
        marks.push(pin.draw(&mut drawing, at, map.scale()));
    }
    marks.extend(face.wall.map(|ends| draw_wall(&mut drawing, ends, &map)));
    let whole = |at: &[f64; 2]| Mark::new(map.at(*at), "stays whole".to_owned());
    marks.extend(face.whole.iter().map(whole));
    let region = |region: &Region| Mark::new(map.at(region.at), region.parts.join(" | "));
    marks.extend(face.regions.iter().map(region));
    for insert in &inserts {
        marks.push(draw_insert(&mut drawing, insert, &map));
    }
    drawing.callouts(&marks);
    drawing
}

/// Draws the voids and, hatched, the material.
fn draw_material(drawing: &mut Drawing, face: &CutFace, rings: &[Vec<Spot>]) {
    let pairs = rings.iter().zip(&face.rings);
    let outer = pairs.filter(|(_, ring)| doubled_area_mm2(ring) > 0.0);
    let outer: Vec<Vec<Spot>> = outer.map(|(spots, _)| spots.clone()).collect();
    drawing.path(&outer, true, Paint::filled(VOID, Stroke::NONE));
    let outline = Stroke {
        width: 2.0,
        ..Stroke::THIN
    };
    Hatch::PRINTED.fill(drawing, rings, outline);
}

/// Draws the widest disc that passes through a mouth, and returns its name.
fn draw_mouth(drawing: &mut Drawing, mouth: &Mouth, map: &PlaneMap) -> Mark {
    let at = map.at(mouth.at);
    let radius_px = 0.5 * map.scale() * mouth.diameter_mm;
    drawing.circle(at, radius_px, Paint::line(Stroke::DASHED));
    let diameter_mm = mouth.diameter_mm;
    Mark::new(at, format!("{} open ⌀{diameter_mm:.1}", mouth.void))
}

/// Draws the thinnest wall as a thick line, and returns its name.
fn draw_wall(drawing: &mut Drawing, ends: [[f64; 2]; 2], map: &PlaneMap) -> Mark {
    let [a, b] = ends.map(|end| map.at(end));
    let stroke = Stroke {
        width: 4.0,
        ..Stroke::THICK
    };
    drawing.line([a, b], stroke);
    let mm = (ends[0][0] - ends[1][0]).hypot(ends[0][1] - ends[1][1]);
    Mark::new(
        [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])],
        format!("wall {}", quantity(mm, "mm")),
    )
}

/// Draws the section of hardware or ballast, and returns its name.
fn draw_insert(drawing: &mut Drawing, insert: &Insert, map: &PlaneMap) -> Mark {
    let ring = insert.ring.iter().map(|at| map.at(*at)).collect();
    insert.hatch.fill(drawing, &[ring], Stroke::THIN);
    Mark::new(map.at(insert.middle()), insert.id.clone())
}

/// Draws the legend of what the section shows.
fn draw_section_legend(drawing: &mut Drawing, face: &CutFace, has_pins: bool, inserts: &[Insert]) {
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
    draw_legend(drawing, [left, height - up], &keys);
}

/// Draws the overall dimensions.
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
