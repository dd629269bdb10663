//! Screws, inserts and glue in their places, with their masses.

use super::asked::Asked;
use super::home::home_panel;
use super::made::Made;
use super::names::bracket_id;
use crate::cladding::Holding;
use crate::cutter::{Fastener, FastenerShape};
use crate::geom::{Plane, Point, Vector};
use crate::mesh::area_mm2;
use crate::panels::EdgeJoint;
use crate::printer::Quantity;
use crate::verify::{FastenerKind, FastenerPromise, GluePromise, PegPromise};

/// The thickness of a film of wood glue between panels, mm, and its density once dry, g/mm³. Both
/// are own choices for white glue that is wiped off.
const WOOD_FILM_MM: f64 = 0.1;
const WOOD_GLUE_G_MM3: f64 = 1.1e-3;
/// The thickness of a film of epoxy glue below ballast, mm, and its density once hard, g/mm³. Both
/// are own choices: sawn steel on plywood leaves wider gaps than wood on wood.
pub const EPOXY_FILM_MM: f64 = 0.2;
const EPOXY_G_MM3: f64 = 1.15e-3;
/// The thickness of a film between printed parts if the printer's profile says nothing, mm.
const USUAL_FILM_MM: f64 = 0.1;
/// The density of glue for printed parts if the profile says nothing, g/mm³.
const USUAL_GLUE_G_MM3: f64 = 1.1e-3;
/// Distance of a corner from a plane up to which it lies on it, mm.
const ON_PLANE_MM: f64 = 1e-6;
/// The least number of screws that hold a part without glue.
pub const LEAST_SCREWS: usize = 2;
/// The share of the cylinder around it that a round head fills.
const HEAD_RATIO: f64 = 0.55;

/// Returns all screws and inserts.
pub fn fasteners(asked: &Asked, made: &Made) -> Vec<FastenerPromise> {
    let shell = &made.built.shell;
    let kit = &asked.screws;
    let mut all = Vec::new();
    for screws in &shell.screws {
        let panel = &shell.panels.panels[screws.panel];
        let up = panel.frame.axis();
        let place = |seat: Point| Place {
            part: &made.names.parts[screws.part],
            panel: screws.panel + 1,
            seat,
            axis: up,
        };
        for screw in &screws.screws {
            all.push(place(panel.at(screw.at_mm, 1.0)).fastener(&kit.screw));
            all.push(place(screw.foot).fastener(&kit.insert));
        }
    }
    for (index, bracket) in made.built.brackets.iter().enumerate() {
        let home = home_panel(&made.built.plan, shell, bracket);
        let out = shell.panels.panels[home.panel].frame.axis();
        let screws = bracket.screws[home.flange].iter();
        all.extend(screws.filter(|_| home.is_screwed).map(|inner| {
            let place = Place {
                part: &bracket_id(index),
                panel: home.panel + 1,
                seat: inner + out * asked.panels.sheet_mm,
                axis: -out,
            };
            place.fastener(&asked.bracket_screw)
        }));
    }
    all.extend(bolts(asked, made));
    all
}

/// Returns all bolts between polyhedra, each with its washers and its nut.
fn bolts(asked: &Asked, made: &Made) -> Vec<FastenerPromise> {
    let Some(kit) = &asked.bolt else {
        return Vec::new();
    };
    let all = made.built.bolts.iter().flat_map(|bolt| {
        let joint = &made.built.plan.connections[bolt.connection];
        let [a, b] = joint.polyhedra.map(|polyhedron| polyhedron + 1);
        let name = format!("polyhedra {a} and {b}");
        let [head, nut] = [0, 1].map(|side| {
            let panel = &made.built.shell.panels.panels[bolt.panels[side]];
            // The end of the bolt is inside of the polyhedron, on its washer.
            Place {
                part: &name,
                panel: bolt.panels[side] + 1,
                seat: panel.at(bolt.at_mm[side], 1.0),
                axis: panel.frame.axis(),
            }
        });
        let screw = head.behind(kit.washer_mm()).fastener(&kit.screw);
        let bolt = FastenerPromise {
            kind: FastenerKind::Bolt,
            through: Some(nut.panel),
            shaft_mm: shaft_mm(&kit.screw),
            ..screw
        };
        let washers = [&head, &nut].map(|place| place.fastener(&kit.washer));
        let nut = nut.behind(kit.washer_mm()).fastener(&kit.nut);
        [bolt, nut].into_iter().chain(washers).collect::<Vec<_>>()
    });
    all.collect()
}

/// The place of a fastener.
#[derive(Clone, Copy)]
struct Place<'a> {
    part: &'a str,
    panel: usize,
    /// The point under a screw's head, or at the mouth of an insert.
    seat: Point,
    /// The direction from there along its shaft.
    axis: Vector,
}

impl Place<'_> {
    /// Returns the place behind this one, mm.
    fn behind(self, by_mm: f64) -> Self {
        Self {
            seat: self.seat - self.axis * by_mm,
            ..self
        }
    }

    fn fastener(&self, of: &Fastener) -> FastenerPromise {
        let (kind, along_mm, head_mm) = match of.shape {
            FastenerShape::Screw {
                head_diameter_mm,
                head_height_mm,
                ..
            } => (
                FastenerKind::Screw,
                center_mm(of),
                [head_diameter_mm, head_height_mm],
            ),
            // Rods have a list of their own.
            FastenerShape::Insert { length_mm, .. } | FastenerShape::Dowel { length_mm, .. } => {
                (FastenerKind::Insert, 0.5 * length_mm, [0.0; 2])
            }
            FastenerShape::Washer {
                diameter_mm,
                thickness_mm,
                ..
            } => (
                FastenerKind::Washer,
                -0.5 * thickness_mm,
                [diameter_mm, thickness_mm],
            ),
            FastenerShape::Nut {
                diameter_mm,
                thickness_mm,
                ..
            } => (
                FastenerKind::Nut,
                -0.5 * thickness_mm,
                [diameter_mm, thickness_mm],
            ),
        };
        FastenerPromise {
            id: of.id.clone(),
            kind,
            part: self.part.to_owned(),
            panel: self.panel,
            mass_g: of.mass_g,
            center_mm: (self.seat + self.axis * along_mm).into(),
            seat_mm: self.seat.into(),
            axis: self.axis.into(),
            head_mm,
            through: None,
            shaft_mm: None,
        }
    }
}

/// Returns thread and length of a screw, mm.
fn shaft_mm(screw: &Fastener) -> Option<[f64; 2]> {
    match screw.shape {
        FastenerShape::Screw {
            thread_mm,
            length_mm,
            ..
        } => Some([thread_mm, length_mm]),
        _ => None,
    }
}

/// Returns the distance of a screw's centre from the underside of its head, along its shaft, mm.
fn center_mm(screw: &Fastener) -> f64 {
    let FastenerShape::Screw {
        thread_mm,
        length_mm,
        head_diameter_mm,
        head_height_mm,
        ..
    } = screw.shape
    else {
        return 0.0;
    };
    let shaft = thread_mm * thread_mm * length_mm;
    let head = HEAD_RATIO * head_diameter_mm * head_diameter_mm * head_height_mm;
    0.5 * (shaft * length_mm - head * head_height_mm) / (shaft + head)
}

/// Returns all pins between parts.
pub fn pins(made: &Made) -> Vec<PegPromise> {
    let joints = made.built.shell.pins.iter();
    let pegs = joints.flat_map(|joint| {
        let [on, into] = joint.parts.map(|part| &made.names.parts[part]);
        joint.sites.iter().map(|site| PegPromise {
            on: on.clone(),
            into: into.clone(),
            center_mm: site.center_mm,
            direction: site.direction,
            diameter_mm: site.diameter_mm,
            length_mm: site.length_mm,
            socket_diameter_mm: site.socket_diameter_mm,
            socket_depth_mm: site.socket_depth_mm,
            chamfers_mm: [site.chamfer_mm, site.socket_chamfer_mm],
        })
    });
    pegs.collect()
}

/// Returns all films of glue but those of rods: along the fingers, and under the loose flanges of
/// brackets. Parts that bear on no panel, or have no room for two screws, are glued too.
pub fn glue(asked: &Asked, made: &Made) -> Vec<GluePromise> {
    let mut films = along_edges(asked, made);
    films.extend(under_flanges(asked, made));
    films.extend(between_parts(asked, made));
    films.extend(on_panels(made));
    films
}

fn along_edges(asked: &Asked, made: &Made) -> Vec<GluePromise> {
    let edges = made.built.shell.panels.edges.iter();
    let glued = edges.filter(|edge| match &edge.joint {
        EdgeJoint::Fingers(_) => true,
        EdgeJoint::Brackets(places) => places.is_empty(),
    });
    glued
        .map(|edge| {
            let area_mm2 = edge.length_mm() * asked.panels.sheet_mm;
            let middle = nalgebra::center(&edge.ends[0], &edge.ends[1]);
            let [a, b] = edge.panels;
            wood_film(format!("panels {} and {}", a + 1, b + 1), area_mm2, middle)
        })
        .collect()
}

fn under_flanges(asked: &Asked, made: &Made) -> Vec<GluePromise> {
    let kind = &asked.panels.brackets;
    let area_mm2 = kind.width_mm() * asked.panels.flange_mm();
    let shell = &made.built.shell;
    let mut films = Vec::new();
    for (index, bracket) in made.built.brackets.iter().enumerate() {
        let home = home_panel(&made.built.plan, shell, bracket);
        let glued = [1 - home.flange].into_iter();
        for flange in glued.chain((!home.is_screwed).then_some(home.flange)) {
            let [a, b] = bracket.screws[flange];
            let panel = shell.panels.edges[bracket.edge].panels[flange] + 1;
            let joint = format!("bracket {} and panel {panel}", bracket_id(index));
            films.push(wood_film(joint, area_mm2, nalgebra::center(&a, &b)));
        }
    }
    films
}

/// Returns a film of wood glue with its mass.
pub fn wood_film(joint: String, area_mm2: f64, middle: Point) -> GluePromise {
    GluePromise {
        joint,
        parts: Vec::new(),
        area_mm2,
        mass_g: area_mm2 * WOOD_FILM_MM * WOOD_GLUE_G_MM3,
        center_mm: middle.into(),
    }
}

/// Returns a film of the glue of ballast with its mass.
pub fn epoxy_film(joint: String, area_mm2: f64, middle: Point) -> GluePromise {
    GluePromise {
        mass_g: area_mm2 * EPOXY_FILM_MM * EPOXY_G_MM3,
        ..wood_film(joint, area_mm2, middle)
    }
}

fn between_parts(asked: &Asked, made: &Made) -> Vec<GluePromise> {
    let printer = &asked.shop.printer;
    let number = |quantity| printer.number(quantity).map(|number| number.value);
    let film_mm = number(Quantity::GlueFilmMm).unwrap_or(USUAL_FILM_MM);
    let density = number(Quantity::GlueDensityGCm3).map(|density| density * 1e-3);
    let density_g_mm3 = density.unwrap_or(USUAL_GLUE_G_MM3);
    let parts = made.built.shell.parts.iter().enumerate();
    parts
        .filter_map(|(index, part)| {
            let Holding::Pinned {
                to,
                bound,
                area_mm2,
            } = part.holding
            else {
                return None;
            };
            let names = [index, to].map(|part| &made.names.parts[part]);
            let plane = part.region.bounds()[bound].plane;
            Some(GluePromise {
                joint: format!("parts {} and {}", names[0], names[1]),
                parts: names.map(String::clone).to_vec(),
                area_mm2,
                mass_g: area_mm2 * film_mm * density_g_mm3,
                center_mm: face(part.body.iter_corners(), &plane).1.into(),
            })
        })
        .collect()
}

/// Returns the films below parts that a single screw, or none, holds to their panel.
fn on_panels(made: &Made) -> Vec<GluePromise> {
    let shell = &made.built.shell;
    let parts = shell.parts.iter().zip(&shell.cups).enumerate();
    let glued = parts.filter(|(index, (part, _))| {
        let screws = shell.screws.iter().find(|screws| screws.part == *index);
        part.is_on_panel() && screws.is_none_or(|screws| screws.screws.len() < LEAST_SCREWS)
    });
    glued
        .map(|(index, (part, cup))| {
            let floor = part.region.bounds()[0].plane;
            let (area_mm2, middle) = face(cup.body.iter_corners(), &floor);
            let panel = made.names.panels[index];
            let part = &made.names.parts[index];
            GluePromise {
                parts: vec![part.clone()],
                ..wood_film(format!("part {part} and panel {panel}"), area_mm2, middle)
            }
        })
        .collect()
}

/// Returns the area of the triangles in a plane, mm², and their middle. Without any it is the
/// plane's point nearest to the origin.
fn face(triangles: impl Iterator<Item = [Point; 3]>, plane: &Plane) -> (f64, Point) {
    let on_plane = triangles.filter(|corners| {
        let mut heights = corners.iter().map(|p| plane.distance(p).abs());
        heights.all(|height| height <= ON_PLANE_MM)
    });
    let (area, first) = on_plane.fold((0.0, Vector::zeros()), |(area, first), corners| {
        let own = area_mm2(&corners);
        let [a, b, c] = corners.map(|p| p.coords);
        (area + own, first + (a + b + c) * (own / 3.0))
    });
    if area > 0.0 {
        (area, Point::from(first / area))
    } else {
        (area, plane.foot())
    }
}
