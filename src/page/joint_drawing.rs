//! A joint as a picture: the faces of both parts side by side, opened like a book, with the pins
//! in red.

use super::cut_drawing::CutFace;
use super::figure::{Picture, Role};
use super::names::Names;
use super::plane_map::{PlaneMap, Window, bounds, doubled_area_mm2, flat, is_inside};
use crate::base::numbers::{measured, quantity};
use crate::draw::{Anchor, Color, Drawing, Drawn, PAPER, PIN, Paint, Spot, Stroke, part_color};
use crate::geom::Vector;
use crate::sheet::{Checklist, JointRow};
use crate::verify::Peg;

/// Width of the drawing, pixels.
const WIDTH_PX: f64 = 1000.0;

/// Height of words, pixels: 10 points on a picture 90 mm wide.
const TEXT_PX: f64 = 40.0;

/// The windows of the left and the right face: left, top, right, bottom, pixels.
const FRAMES_PX: [[f64; 4]; 2] = [[50.0, 80.0, 450.0, 480.0], [550.0, 80.0, 950.0, 480.0]];

/// Room below the faces for the width of the joint, pixels.
const BELOW_PX: f64 = 100.0;

/// Distance of the width from the face, pixels.
const ASIDE_PX: f64 = 30.0;

/// Share of paper in the colour of a face, so that pins and words stand out.
const PALE: f64 = 0.5;

/// Distance of a name from its pin, heights of the words.
const NAME_AWAY_TEXTS: f64 = 0.75;

/// Draws every joint on a cut that goes through material.
pub(super) fn drawings(sheet: &Checklist, faces: &[CutFace]) -> Vec<Picture> {
    let joint = |joint: &JointRow| {
        let face = faces.iter().find(|face| face.cut == joint.cut)?;
        (!face.rings.is_empty()).then(|| Book::of(sheet, joint, face).picture())
    };
    sheet.joints.iter().filter_map(joint).collect()
}

/// Both faces of a joint.
struct Book<'a> {
    sheet: &'a Checklist,
    joint: &'a JointRow,
    face: &'a CutFace,
    /// Outlines of the joint, mm of the plane.
    rings: Vec<&'a Vec<[f64; 2]>>,
    /// Ids of the parts below and above the cut.
    parts: [&'a str; 2],
}

impl<'a> Book<'a> {
    fn of(sheet: &'a Checklist, joint: &'a JointRow, face: &'a CutFace) -> Self {
        let is_here = |parts: &[String; 2]| joint.parts.iter().all(|part| parts.contains(part));
        let regions = face.regions.iter().filter(|region| is_here(&region.parts));
        let places: Vec<[f64; 2]> = regions.clone().map(|region| region.at).collect();
        let parts = regions
            .clone()
            .next()
            .map_or(&joint.parts, |region| &region.parts);
        let is_outer = |ring: &&Vec<[f64; 2]>| doubled_area_mm2(ring) > 0.0;
        let holds_place = |ring: &Vec<[f64; 2]>| places.iter().any(|at| is_inside(ring, *at));
        let outer: Vec<&Vec<[f64; 2]>> = face.rings.iter().filter(is_outer).collect();
        let mut outer: Vec<&Vec<[f64; 2]>> = match outer.iter().any(|ring| holds_place(ring)) {
            true => outer.into_iter().filter(|ring| holds_place(ring)).collect(),
            false => outer,
        };
        let is_hole = |ring: &&Vec<[f64; 2]>| {
            doubled_area_mm2(ring) <= 0.0 && outer.iter().any(|outer| is_inside(outer, ring[0]))
        };
        let holes: Vec<&Vec<[f64; 2]>> = face.rings.iter().filter(is_hole).collect();
        outer.extend(holes);
        Self {
            sheet,
            joint,
            face,
            rings: outer,
            parts: parts.each_ref().map(String::as_str),
        }
    }

    /// Returns the pins or the sockets of a part in this joint.
    fn pegs(&self, part: &str, of: fn(&crate::sheet::PartRow) -> &[Peg]) -> Vec<&'a Peg> {
        let row = self.sheet.parts.iter().find(|row| row.id == part);
        let pegs = row.map(of).unwrap_or_default().iter();
        pegs.filter(|peg| peg.joint == self.joint.id).collect()
    }

    fn picture(&self) -> Picture {
        let [below, above] = self.parts;
        let sizes = [self.sizes(), self.play()].concat();
        Picture {
            file: format!("pictures/joint-{}.svg", self.joint.id),
            role: Role::Joint,
            caption: format!(
                "{}: {below} and {above}, opened like a book. {sizes}",
                self.joint.id
            ),
            alt: format!(
                "The faces of {below} and {above} in joint {}, side by side. {sizes}",
                self.joint.id
            ),
            drawn: Drawn::Svg(self.draw()),
        }
    }

    /// Words the play of the pins and the step that it leaves; empty without.
    fn play(&self) -> String {
        let Some(play) = self.joint.play else {
            return String::new();
        };
        let limit = self.sheet.printer.seam_step_mm;
        let limit = limit.map(|mm| format!(" (accepted: {})", quantity(mm, "mm")));
        format!(
            " Play: {} and {}; step at the rim at most {}{}.",
            measured(play.shift_mm, "mm"),
            measured(play.turn_deg, "°"),
            measured(play.step_mm, "mm"),
            limit.unwrap_or_default(),
        )
    }

    /// Words the sizes of the pins; without pins says so.
    fn sizes(&self) -> String {
        let pins = self
            .parts
            .iter()
            .flat_map(|part| self.pegs(part, |row| &row.pins));
        let words = |pin: &Peg| {
            format!(
                "{} ⌀{:.1} × {}",
                pin.id,
                pin.diameter_mm,
                measured(pin.length_mm, "mm")
            )
        };
        let pins: Vec<String> = pins.map(words).collect();
        let jig = self
            .sheet
            .jigs
            .iter()
            .find(|jig| jig.order.joint == self.joint.id);
        if let Some(jig) = jig.filter(|_| pins.is_empty()) {
            return format!("It has no printed pins; {} holds it.", jig.order.id);
        }
        if pins.is_empty() {
            return "It has no printed pins.".to_owned();
        }
        format!("Red: pins; red rings: their holes. {}.", pins.join(", "))
    }

    fn draw(&self) -> Drawing {
        let (u, v) = self.face.plane.basis();
        let axis = Vector::from(self.sheet.goal.aim.axis).normalize();
        let up = [u.dot(&axis), v.dot(&axis)];
        let rings: Vec<Vec<[f64; 2]>> = self.rings.iter().map(|ring| (*ring).clone()).collect();
        let windows = [false, true].map(|is_mirrored| Window {
            frame_px: FRAMES_PX[usize::from(is_mirrored)],
            is_mirrored,
        });
        let maps = windows.map(|window| PlaneMap::of(&rings, up, &window));
        let outlines = maps.each_ref().map(|map| outline(&rings, map));
        let [_, [_, bottom]] = bounds(outlines.iter().flatten().flatten().copied());
        let height_px = bottom + BELOW_PX;
        let mut drawing = Drawing::new([WIDTH_PX as usize, height_px as usize], TEXT_PX);
        let middle = 0.5 * WIDTH_PX;
        drawing.line([[middle, 0.0], [middle, height_px]], Stroke::DASHED);
        for (side, map) in maps.iter().enumerate() {
            self.draw_face(&mut drawing, self.parts[side], &outlines[side], map);
        }
        draw_width(&mut drawing, &outlines[0], maps[0].scale());
        drawing
    }

    fn draw_face(&self, drawing: &mut Drawing, part: &str, rings: &[Vec<Spot>], map: &PlaneMap) {
        let [[left, _], [right, _]] = bounds(rings.iter().flatten().copied());
        let title = [0.5 * (left + right), TEXT_PX];
        drawing.text(title, Anchor::Middle, part);
        let index = self.sheet.parts.iter().position(|row| row.id == part);
        let color = pale(part_color(index.unwrap_or_default()));
        drawing.path(rings, true, Paint::filled(color, Stroke::THICK));
        let (pins, sockets) = (
            self.pegs(part, |row| &row.pins),
            self.pegs(part, |row| &row.sockets),
        );
        let [pins, sockets] = [pins, sockets].map(|pegs| self.spots(&pegs, map));
        let mut names = Names::new(WIDTH_PX, TEXT_PX);
        names.place_at(title, part);
        for peg in pins.iter().chain(&sockets) {
            names.keep_clear(peg.at, peg.radius_px);
        }
        let solid = Paint::filled(PIN, Stroke::solid(PAPER, 2.0));
        let ring = Paint::filled(PAPER, Stroke::solid(PIN, 5.0));
        for (pegs, paint) in [(&sockets, ring), (&pins, solid)] {
            draw_pegs(drawing, pegs, paint, &mut names);
        }
        for mouth in &self.face.mouths {
            if self.opens_here(mouth.at) {
                let at = names.place_at(map.at(mouth.at), &mouth.void);
                drawing.text(at, Anchor::Middle, &mouth.void);
            }
        }
    }

    /// Returns whether a mouth lies inside the outline of the joint.
    fn opens_here(&self, at: [f64; 2]) -> bool {
        let outer = self
            .rings
            .iter()
            .filter(|ring| doubled_area_mm2(ring) > 0.0);
        outer.into_iter().any(|ring| is_inside(ring, at))
    }

    fn spots(&self, pegs: &[&'a Peg], map: &PlaneMap) -> Vec<PegSpot<'a>> {
        let spot = |peg: &&'a Peg| PegSpot {
            name: &peg.id,
            at: map.at(flat(&self.face.plane, &peg.center_mm)),
            radius_px: 0.5 * map.scale() * peg.diameter_mm,
        };
        pegs.iter().map(spot).collect()
    }
}

/// A pin or its hole on the drawing.
struct PegSpot<'a> {
    name: &'a str,
    at: Spot,
    radius_px: f64,
}

/// Draws pins or holes with their names, each name away from the others.
fn draw_pegs(drawing: &mut Drawing, pegs: &[PegSpot], paint: Paint, names: &mut Names) {
    let count = pegs.len().max(1) as f64;
    let sum = pegs
        .iter()
        .fold([0.0; 2], |[x, y], peg| [x + peg.at[0], y + peg.at[1]]);
    let middle = sum.map(|side| side / count);
    for peg in pegs {
        drawing.circle(peg.at, peg.radius_px, paint);
        let way = [peg.at[0] - middle[0], peg.at[1] - middle[1]];
        let length = way[0].hypot(way[1]);
        let way = if length > 1.0 {
            way.map(|side| side / length)
        } else {
            [0.0, -1.0]
        };
        let away = peg.radius_px + NAME_AWAY_TEXTS * TEXT_PX;
        let at = names.place_beside(peg.at, away, way, peg.name);
        drawing.text(at, Anchor::Middle, peg.name);
    }
}

/// Draws the width of the left face.
fn draw_width(drawing: &mut Drawing, rings: &[Vec<Spot>], scale: f64) {
    let [[left, _], [right, bottom]] = bounds(rings.iter().flatten().copied());
    let words = measured((right - left) / scale, "mm");
    drawing.dimension([[left, bottom], [right, bottom]], [0.0, ASIDE_PX], &words);
}

/// Returns outlines on the drawing.
fn outline(rings: &[Vec<[f64; 2]>], map: &PlaneMap) -> Vec<Vec<Spot>> {
    let spots = |ring: &Vec<[f64; 2]>| ring.iter().map(|at| map.at(*at)).collect();
    rings.iter().map(spots).collect()
}

/// Returns a colour mixed with paper.
fn pale(color: Color) -> Color {
    let mix = |part: u8, paper: u8| {
        (f64::from(part) * (1.0 - PALE) + f64::from(paper) * PALE).round() as u8
    };
    [0, 1, 2].map(|channel| mix(color[channel], PAPER[channel]))
}
