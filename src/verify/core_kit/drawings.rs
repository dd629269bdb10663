//! The drawings of the sheets against the panels: what the beam leaves, and how panels lie.

use super::base_files::PanelPromise;
use super::evidence::CoreEvidence;
use super::flat::{apart, area_mm2, between, edges, is_inside, length_mm, placed, to_ring};
use super::promise::{CutSheetPromise, PlacedPanel};
use crate::io::{CutLayer, DrawnLine, DrawnShape};

/// By how much lines may be off, mm: their digits in the files.
const NEAR_MM: f64 = 1e-3;
/// By how much the chords of a round corner may be off, mm.
const CHORD_MM: f64 = 1.1e-3;

/// The facts about the drawings.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawingFacts {
    /// What is wrong with lines, in words.
    pub faults: Vec<String>,
    /// The greatest distance by which a path of the beam is off, mm.
    pub off_mm: f64,
    /// The least distance of two panels on a sheet, mm.
    pub spacing_mm: f64,
    /// The least distance of a panel from the edge of its sheet, mm.
    pub margin_mm: f64,
}

/// Measures all drawings.
pub fn measure_drawings(evidence: &CoreEvidence) -> DrawingFacts {
    let mut facts = DrawingFacts {
        faults: Vec::new(),
        off_mm: 0.0,
        spacing_mm: f64::INFINITY,
        margin_mm: f64::INFINITY,
    };
    let mut counts = vec![0; evidence.panels.panels.len()];
    for (sheet, drawing) in evidence.promise.cut_sheets.iter().zip(&evidence.drawings) {
        let judge = SheetJudge {
            evidence,
            sheet,
            lines: &drawing[0],
        };
        facts.faults.extend(differences(sheet, drawing));
        judge.judge(&mut facts);
        for place in &sheet.panels {
            match counts.get_mut(place.panel.wrapping_sub(1)) {
                Some(count) => *count += 1,
                None => facts
                    .faults
                    .push(format!("there is no panel {}", place.panel)),
            }
        }
    }
    let uncut = counts.iter().enumerate().filter(|(_, count)| **count != 1);
    let words = uncut.map(|(index, count)| format!("panel {} is cut {count} times", index + 1));
    facts.faults.extend(words);
    facts
}

/// Returns the differences of both files of a sheet, in words.
fn differences(sheet: &CutSheetPromise, [dxf, svg]: &[Vec<DrawnLine>; 2]) -> Vec<String> {
    let mut faults = Vec::new();
    if dxf.len() != svg.len() {
        faults.push(format!("{} has other lines than {}", sheet.dxf, sheet.svg));
    }
    let differs = |(a, b): &(&DrawnLine, &DrawnLine)| {
        let [(kind, one), (other, two)] = [a, b].map(|line| points(&line.shape));
        let far = one.iter().zip(&two).any(|(p, q)| apart(*p, *q) > NEAR_MM);
        a.layer != b.layer || kind != other || one.len() != two.len() || far
    };
    let count = dxf.iter().zip(svg).filter(differs).count();
    if count > 0 {
        faults.push(format!(
            "{count} lines of {} differ from its SVG",
            sheet.dxf
        ));
    }
    let twice = (0..dxf.len()).any(|at| dxf[..at].contains(&dxf[at]));
    if twice {
        faults.push(format!("{} has a line twice", sheet.dxf));
    }
    faults
}

/// Returns the kind of a shape and its points; those of a circle are its middle and its radius.
fn points(shape: &DrawnShape) -> (u8, Vec<[f64; 2]>) {
    match shape {
        DrawnShape::Closed(points) => (0, points.clone()),
        DrawnShape::Open(points) => (1, points.clone()),
        DrawnShape::Circle {
            center_mm,
            radius_mm,
        } => (2, vec![*center_mm, [*radius_mm, 0.0]]),
    }
}

/// The judge of one sheet.
struct SheetJudge<'a> {
    evidence: &'a CoreEvidence,
    sheet: &'a CutSheetPromise,
    lines: &'a [DrawnLine],
}

impl SheetJudge<'_> {
    fn judge(&self, facts: &mut DrawingFacts) {
        let panels: Vec<(&PlacedPanel, &PanelPromise)> = self
            .sheet
            .panels
            .iter()
            .filter_map(|place| {
                let panel = self
                    .evidence
                    .panels
                    .panels
                    .get(place.panel.wrapping_sub(1))?;
                Some((place, panel))
            })
            .collect();
        let rings: Vec<Vec<[f64; 2]>> = panels
            .iter()
            .map(|(place, panel)| {
                // Seen from inside, the ring goes the other way round.
                let corners = panel.outline_mm.iter().rev();
                corners
                    .map(|at| placed(*at, place.turn_rad, place.at_mm))
                    .collect()
            })
            .collect();
        self.judge_nest(&rings, facts);
        let paths = self.closed_on(CutLayer::Outer);
        if paths.len() != panels.len() {
            let words = format!("{} has {} outlines", self.sheet.dxf, paths.len());
            facts.faults.push(words);
        }
        for ((place, panel), ring) in panels.iter().zip(&rings) {
            let own = paths.iter().find(|path| {
                let middle = ring
                    .iter()
                    .all(|at| is_inside(*at, path) || to_ring(*at, path) < 1.0);
                middle && (area_mm2(path) - area_mm2(ring)).abs() < 0.05 * area_mm2(ring)
            });
            match own {
                Some(path) => self.judge_path(path, ring, facts),
                None => facts
                    .faults
                    .push(format!("panel {} has no path", place.panel)),
            }
            self.judge_holes(place, panel, facts);
        }
        let holes: usize = panels.iter().map(|(_, panel)| panel.holes.len()).sum();
        if holes != self.circles().len() {
            let words = format!(
                "{} has {} holes, not {holes}",
                self.sheet.dxf,
                self.circles().len()
            );
            facts.faults.push(words);
        }
        self.judge_edge(facts);
    }

    /// Holds that the sheet's own edge is drawn, and that all lines are within it.
    fn judge_edge(&self, facts: &mut DrawingFacts) {
        let edge = self.closed_on(CutLayer::Sheet);
        let [width, depth] = self.sheet.size_mm;
        let is_out = |[x, y]: [f64; 2]| {
            let free = [x, y, width - x, depth - y];
            free.iter().any(|free| *free < -NEAR_MM)
        };
        let out = self.lines.iter().filter(|line| match &line.shape {
            DrawnShape::Closed(points) | DrawnShape::Open(points) => {
                points.iter().any(|at| is_out(*at))
            }
            DrawnShape::Circle { center_mm, .. } => is_out(*center_mm),
        });
        let count = out.count();
        if count > 0 {
            let words = format!("{count} lines of {} are outside of it", self.sheet.dxf);
            facts.faults.push(words);
        }
        let is_whole =
            |ring: &&[[f64; 2]]| (area_mm2(ring) - width * depth).abs() < NEAR_MM * width;
        if edge.iter().filter(|ring| is_whole(ring)).count() != 1 {
            facts.faults.push(format!("{} has no edge", self.sheet.dxf));
        }
    }

    fn closed_on(&self, layer: CutLayer) -> Vec<&[[f64; 2]]> {
        let lines = self.lines.iter().filter(|line| line.layer == layer);
        let closed = lines.filter_map(|line| match &line.shape {
            DrawnShape::Closed(points) => Some(points.as_slice()),
            _ => None,
        });
        closed.collect()
    }

    fn circles(&self) -> Vec<([f64; 2], f64)> {
        let lines = self
            .lines
            .iter()
            .filter(|line| line.layer == CutLayer::Inner);
        let circles = lines.filter_map(|line| match line.shape {
            DrawnShape::Circle {
                center_mm,
                radius_mm,
            } => Some((center_mm, radius_mm)),
            _ => None,
        });
        circles.collect()
    }

    /// Measures the distances of panels from each other and from the edge of the sheet.
    fn judge_nest(&self, rings: &[Vec<[f64; 2]>], facts: &mut DrawingFacts) {
        let [width, depth] = self.sheet.size_mm;
        for (index, ring) in rings.iter().enumerate() {
            for other in &rings[..index] {
                facts.spacing_mm = facts.spacing_mm.min(between(ring, other));
            }
            for [x, y] in ring {
                let inside = [*x, *y, width - x, depth - y];
                facts.margin_mm = inside.into_iter().fold(facts.margin_mm, f64::min);
            }
        }
    }

    /// Holds the path of the beam against an outline. It runs half of the cut beside it, and in an
    /// inner corner as near to the corner itself.
    fn judge_path(&self, path: &[[f64; 2]], ring: &[[f64; 2]], facts: &mut DrawingFacts) {
        let half_mm = 0.5 * self.evidence.promise.sheet.offset_kerf_mm;
        let mut off_mm = 0.0_f64;
        for [a, b] in edges(ring) {
            let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
            off_mm = off_mm.max((to_ring(middle, path) - half_mm).abs());
        }
        // No point of the path is farther from the outline, or on its inner side.
        for &at in path {
            let far_mm = to_ring(at, ring) - half_mm;
            off_mm = off_mm.max(far_mm);
            if is_inside(at, ring) && to_ring(at, ring) > NEAR_MM {
                off_mm = off_mm.max(half_mm + to_ring(at, ring));
            }
        }
        // Every corner of the outline is touched by the beam, but none by more than half of it.
        for &corner in ring {
            off_mm = off_mm.max((to_ring(corner, path) - half_mm).abs());
        }
        let grown = area_mm2(ring) + half_mm * length_mm(ring);
        let corners = ring.len() as f64 * 4.0 * (half_mm * half_mm + NEAR_MM * half_mm);
        if (area_mm2(path) - grown).abs() > corners + NEAR_MM * length_mm(ring) {
            facts.faults.push(format!(
                "a path of {} encloses another area",
                self.sheet.dxf
            ));
        }
        facts.off_mm = facts.off_mm.max((off_mm - CHORD_MM + NEAR_MM).max(0.0));
    }

    /// Holds the holes of a panel against the circles of the drawing.
    fn judge_holes(&self, place: &PlacedPanel, panel: &PanelPromise, facts: &mut DrawingFacts) {
        let kerf_mm = self.evidence.promise.sheet.offset_kerf_mm;
        let circles = self.circles();
        for hole in &panel.holes {
            let at = placed(hole.at_mm, place.turn_rad, place.at_mm);
            let radius_mm = 0.5 * (hole.diameter_mm - kerf_mm);
            let is_there = circles.iter().any(|(middle, radius)| {
                apart(*middle, at) < NEAR_MM && (radius - radius_mm).abs() < NEAR_MM
            });
            let room_mm = to_ring(hole.at_mm, &panel.outline_mm) - 0.5 * hole.diameter_mm;
            if !is_there || !is_inside(hole.at_mm, &panel.outline_mm) || room_mm <= 0.0 {
                facts
                    .faults
                    .push(format!("a hole of panel {} is wrong", place.panel));
            }
        }
    }
}
