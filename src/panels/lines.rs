//! The lines of a sheet: the laser's paths about panels and through holes, and the names that it
//! engraves.

use std::f64::consts::TAU;

use super::beam::{BeamError, beam_path};
use super::edge::PanelEdge;
use super::engraving::{engraved, width_mm};
use super::nest::{NestedSheet, Placement};
use super::outline::Outline;
use super::panel::{Hole, Panel, flat, seen_inside};
use super::rings::along;
use super::set::PanelSet;

/// Height of a neighbour's number over that of the panel's own.
const NEIGHBOUR_RATIO: f64 = 0.6;
/// Free width between a joint and the number beside it, over the number's height.
const FREE_RATIO: f64 = 0.5;
/// Distance from a joint to the panel's middle, over the height of its own number. It is room for
/// half of that, and for the neighbour's number with what is free on both sides.
const ROOM_RATIO: f64 = 0.5 + NEIGHBOUR_RATIO * (1.0 + 2.0 * FREE_RATIO);
/// Least height of a panel's number, mm: smaller ones are not legible. The panel has none then, and
/// the picture of its sheet names it.
const LEAST_TEXT_MM: f64 = 3.0;

/// The cut and the engraving that are ordered.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineOrder {
    /// The width of the cut, mm; 0 if the shop's software offsets the paths.
    pub kerf_mm: f64,
    /// Height of a panel's number, mm.
    pub text_mm: f64,
}

/// The lines of a sheet, mm from its lower left corner.
#[derive(Debug, Clone, PartialEq)]
pub struct SheetLines {
    /// Length and width of the sheet, mm.
    pub size_mm: [f64; 2],
    /// The paths about the panels, in the order of their placements.
    pub outlines: Vec<Outline>,
    /// The paths in round holes.
    pub holes: Vec<Hole>,
    /// The numbers of the panels and of their neighbours, in strokes.
    pub strokes: Vec<Vec<[f64; 2]>>,
}

impl SheetLines {
    /// Returns the lines of a sheet. Panels are numbered from 1. Each has its number in its middle,
    /// and beside each edge the number of the panel that meets it there.
    ///
    /// The inner face is up, and is engraved: parts cover the outer one before panels are joined.
    ///
    /// # Errors
    /// A gap or a hole is too narrow for the cut.
    pub fn of(set: &PanelSet, sheet: &NestedSheet, order: &LineOrder) -> Result<Self, BeamError> {
        let mut lines = Self {
            size_mm: sheet.size_mm,
            outlines: Vec::new(),
            holes: Vec::new(),
            strokes: Vec::new(),
        };
        for placement in &sheet.placements {
            let panel = &set.panels[placement.panel];
            let path = beam_path(&panel.inner_outline(), order.kerf_mm)?;
            lines.outlines.push(placed(&path, placement));
            for hole in &panel.holes {
                lines.holes.push(drilled(hole, placement, order.kerf_mm)?);
            }
            let names = names(set, placement.panel, order.text_mm).into_iter();
            let on_sheet = |stroke: Vec<[f64; 2]>| {
                let points = stroke.into_iter().map(|at| placement.place(at));
                points.collect::<Vec<[f64; 2]>>()
            };
            lines.strokes.extend(names.map(on_sheet));
        }
        Ok(lines)
    }

    /// Returns the length of all cuts, mm.
    pub fn cut_mm(&self) -> f64 {
        let around: f64 = self.outlines.iter().map(Outline::length_mm).sum();
        let holes = self.holes.iter().map(|hole| 0.5 * TAU * hole.diameter_mm);
        around + holes.sum::<f64>()
    }

    /// Returns the length of all engraved strokes, mm.
    pub fn engraved_mm(&self) -> f64 {
        let pieces = self.strokes.iter().flat_map(|stroke| stroke.windows(2));
        let lengths = pieces.map(|pair| (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]));
        lengths.sum()
    }
}

/// Returns an outline in its place on the sheet.
fn placed(outline: &Outline, placement: &Placement) -> Outline {
    let corners = outline.corners().iter().map(|at| placement.place(*at));
    Outline::new(corners).unwrap_or_else(|| outline.clone())
}

/// Returns the path in a hole, in its place on the sheet.
fn drilled(hole: &Hole, placement: &Placement, kerf_mm: f64) -> Result<Hole, BeamError> {
    let at_mm = placement.place(seen_inside(hole.at_mm));
    let diameter_mm = hole.diameter_mm - kerf_mm;
    let path = Hole { at_mm, diameter_mm };
    (diameter_mm > 0.0)
        .then_some(path)
        .ok_or(BeamError::TooNarrow { at_mm, kerf_mm })
}

/// Returns the strokes of a panel's number and of those of its neighbours, seen from inside. There
/// are none if they would be too small.
fn names(set: &PanelSet, panel: usize, most_mm: f64) -> Vec<Vec<[f64; 2]>> {
    let edges = set.edges.iter().filter(|edge| edge.panels.contains(&panel));
    let rooms = edges.map(|edge| room_mm(&set.panels[panel], edge, edge.panels[0] == panel));
    let text_mm = rooms.fold(most_mm, |least, room| least.min(room / ROOM_RATIO));
    if text_mm < LEAST_TEXT_MM {
        return Vec::new();
    }
    let own = number(panel);
    let middle = [-0.5 * width_mm(&own, text_mm), -0.5 * text_mm];
    let mut strokes = engraved(&own, middle, text_mm);
    let edges = set.edges.iter().filter(|edge| edge.panels.contains(&panel));
    strokes.extend(edges.flat_map(|edge| neighbour(set, panel, edge, text_mm)));
    strokes
}

/// Returns the strokes of the number of the panel beyond an edge. They read along the edge, with
/// their feet toward it.
fn neighbour(set: &PanelSet, panel: usize, edge: &PanelEdge, text_mm: f64) -> Vec<Vec<[f64; 2]>> {
    let is_first = edge.panels[0] == panel;
    let text = number(edge.panels[usize::from(is_first)]);
    let height_mm = NEIGHBOUR_RATIO * text_mm;
    let [from, to] = ends(&set.panels[panel], edge, is_first);
    let length = (to[0] - from[0]).hypot(to[1] - from[1]);
    let low = [
        0.5 * (length - width_mm(&text, height_mm)),
        edge.depth_mm + FREE_RATIO * height_mm,
    ];
    let place = |stroke: Vec<[f64; 2]>| {
        let points = stroke.into_iter().map(|at| along([from, to], at));
        points.collect()
    };
    let strokes = engraved(&text, low, height_mm).into_iter();
    strokes.map(place).collect()
}

/// Returns the ends of an edge as they are seen from inside, counterclockwise about the panel.
fn ends(panel: &Panel, edge: &PanelEdge, is_first: bool) -> [[f64; 2]; 2] {
    let [start, end] = edge.ends.map(|end| seen_inside(flat(&panel.frame, &end)));
    if is_first { [end, start] } else { [start, end] }
}

/// Returns the distance from the joint of an edge to the panel's middle, mm.
fn room_mm(panel: &Panel, edge: &PanelEdge, is_first: bool) -> f64 {
    let [from, to] = ends(panel, edge, is_first);
    let way = [to[0] - from[0], to[1] - from[1]];
    let from_line = (from[0] * way[1] - from[1] * way[0]).abs() / way[0].hypot(way[1]);
    from_line - edge.depth_mm
}

/// Returns the number that is engraved on a panel.
fn number(panel: usize) -> String {
    (panel + 1).to_string()
}
