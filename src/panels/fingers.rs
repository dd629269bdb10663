//! Finger joints of two panels at any angle, from square cuts.
//!
//! A laser cuts square to the sheet. So a finger is as long as the neighbour is wide where it meets
//! it: `s / sin φ` for sheets of thickness s that meet at the inner angle φ. All distances are from
//! the line in which the outer faces meet.

use std::f64::consts::{FRAC_PI_2, PI};

use super::Outline;

/// Room beyond a finger's tip, mm: it need not touch the ground of its gap.
const GROUND_MM: f64 = 0.1;
/// A ground no deeper than a plain edge is level with it, mm: a step would be finer than the cut.
const LEVEL_MM: f64 = 1e-6;

/// The two panels of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FingerSide {
    /// The one whose finger is in the middle.
    First,
    /// The other one.
    Second,
}

/// A joint along an edge, with fingers of one length on both panels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FingerJoint {
    /// Thickness of the sheets, mm.
    pub sheet_mm: f64,
    /// The inner angle between the panels, radians.
    pub angle_rad: f64,
    /// Length of the edge that both panels share, mm.
    pub edge_mm: f64,
    /// Length at both ends without fingers, mm.
    pub end_mm: f64,
    /// Number of fingers and gaps; odd.
    pub stretches: usize,
    /// By how much each finger is wider than its gap, mm; less than zero for a loose fit.
    pub press_mm: f64,
}

impl FingerJoint {
    /// Returns how far a plain edge stays back, mm: there the panels meet in one line.
    pub fn setback_mm(&self) -> f64 {
        self.sheet_mm / (0.5 * self.angle_rad).tan()
    }

    /// Returns where fingers end, mm.
    pub fn tip_mm(&self) -> f64 {
        // At 90° the cotangent is zero but for rounding.
        let cotangent = (FRAC_PI_2 - self.angle_rad).tan();
        (self.sheet_mm * cotangent).max(0.0)
    }

    /// Returns where gaps end, mm.
    pub fn gap_mm(&self) -> f64 {
        let (sine, cosine) = self.angle_rad.sin_cos();
        self.sheet_mm * (1.0 + cosine.max(0.0)) / sine
    }

    /// Returns where the ground of a gap lies, mm: level with the plain edge up to 90°, and with
    /// room for the finger's tip beyond.
    fn ground_mm(&self) -> f64 {
        if self.gap_mm() - self.setback_mm() < LEVEL_MM {
            self.setback_mm()
        } else {
            self.gap_mm() + GROUND_MM
        }
    }

    /// Returns how far fingers reach beyond a plain edge, mm.
    pub fn reach_mm(&self) -> f64 {
        self.setback_mm() - self.tip_mm()
    }

    /// Returns how deep gaps are below a plain edge, mm.
    pub fn depth_mm(&self) -> f64 {
        self.ground_mm() - self.setback_mm()
    }

    /// Returns whether the angle is one at which fingers hold: from 30 to 150 degrees.
    pub fn holds(&self) -> bool {
        let limit = PI / 6.0;
        (limit..=PI - limit).contains(&self.angle_rad) && !self.stretches.is_multiple_of(2)
    }

    /// Returns the outline of one panel, with the joint's edge along x and the panel above it.
    /// `depth_mm` is from the line in which the outer faces meet. `None` if there is no room.
    pub fn panel(&self, side: FingerSide, depth_mm: f64) -> Option<Outline> {
        let room_mm = self.edge_mm - 2.0 * self.end_mm;
        let is_possible = self.holds() && room_mm > 0.0 && depth_mm > self.ground_mm();
        if !is_possible {
            return None;
        }
        let mut corners = vec![[0.0, depth_mm]];
        corners.extend(self.edge(side));
        corners.push([self.edge_mm, depth_mm]);
        Outline::new(corners)
    }

    /// Returns the line of one panel's edge along x, mm, from one plain end to the other. Heights
    /// are from the line in which the outer faces meet. The other panel's line is the same from
    /// either end.
    pub fn edge(&self, side: FingerSide) -> Vec<[f64; 2]> {
        let mut corners = vec![[0.0, self.setback_mm()]];
        let first_mm = self.border_mm(0, side);
        corners.push([first_mm, self.setback_mm()]);
        for index in 0..self.stretches {
            let y_mm = if Self::is_finger(index, side) {
                self.tip_mm()
            } else {
                self.ground_mm()
            };
            let ends = [index, index + 1].map(|border| self.border_mm(border, side));
            corners.extend(ends.map(|x_mm| [x_mm, y_mm]));
        }
        let last_mm = self.border_mm(self.stretches, side);
        corners.push([last_mm, self.setback_mm()]);
        corners.push([self.edge_mm, self.setback_mm()]);
        corners
    }

    fn is_finger(stretch: usize, side: FingerSide) -> bool {
        stretch.is_multiple_of(2) == (side == FingerSide::First)
    }

    /// Returns the place of a border between two stretches, or of the first or last. A finger takes
    /// a quarter of the fit on each side, and a gap gives as much.
    fn border_mm(&self, border: usize, side: FingerSide) -> f64 {
        let room_mm = self.edge_mm - 2.0 * self.end_mm;
        let even_mm = self.end_mm + room_mm * border as f64 / self.stretches as f64;
        let ends_finger = if border == 0 {
            !Self::is_finger(0, side)
        } else {
            Self::is_finger(border - 1, side)
        };
        let by_mm = 0.25 * self.press_mm;
        even_mm + if ends_finger { by_mm } else { -by_mm }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn joint(deg: f64) -> FingerJoint {
        FingerJoint {
            sheet_mm: 5.0,
            angle_rad: deg.to_radians(),
            edge_mm: 65.0,
            end_mm: 10.0,
            stretches: 3,
            press_mm: 0.0,
        }
    }

    #[test]
    fn fingers_reach_and_stay_back_as_square_cuts_ask() {
        // In thicknesses: where fingers end, where gaps end, and where a plain edge stays.
        let cases = [
            (60.0, [0.577_350, 1.732_051, 1.732_051]),
            (90.0, [0.0, 1.0, 1.0]),
            (120.0, [0.0, 1.154_701, 0.577_350]),
        ];
        for (deg, wanted) in cases {
            let joint = joint(deg);
            let found = [joint.tip_mm(), joint.gap_mm(), joint.setback_mm()];
            for (found, wanted) in found.into_iter().zip(wanted) {
                assert!((found / 5.0 - wanted).abs() < 1e-5, "{deg}: {found}");
            }
            let length = joint.gap_mm() - joint.tip_mm();
            assert!((length - 5.0 / joint.angle_rad.sin()).abs() < 1e-9, "{deg}");
        }
    }

    /// Returns corners of a panel in space, each with its mirror on the inner face. The outer face
    /// lies in a plane through the x axis that leans by half the angle to its side.
    fn in_space(outline: &Outline, joint: &FingerJoint, side: FingerSide) -> Vec<[f64; 3]> {
        let half = 0.5 * joint.angle_rad;
        let sign = if side == FingerSide::First { 1.0 } else { -1.0 };
        let corners = outline.corners().iter();
        corners
            .flat_map(|&[x, y]| {
                [0.0, joint.sheet_mm].map(|depth| {
                    let across = y * half.sin() - depth * half.cos();
                    [x, sign * across, y * half.cos() + depth * half.sin()]
                })
            })
            .collect()
    }

    #[test]
    fn plain_edges_of_both_panels_meet_in_one_line_inside() {
        for deg in [60.0, 75.0, 90.0, 120.0, 150.0] {
            let joint = joint(deg);
            for side in [FingerSide::First, FingerSide::Second] {
                let outline = joint.panel(side, 40.0).unwrap();
                let corners = in_space(&outline, &joint, side);
                // The plain ends never pass the plane between both panels, and their inner edge
                // lies in it.
                let sign = if side == FingerSide::First { 1.0 } else { -1.0 };
                let ends = corners.iter().filter(|at| at[0] == 0.0);
                let nearest = ends.map(|at| sign * at[1]).fold(f64::INFINITY, f64::min);
                assert!(nearest.abs() < 1e-9, "{deg}: {nearest}");
            }
        }
    }

    #[test]
    fn where_one_panel_has_a_finger_the_other_has_a_gap_that_is_as_wide_but_for_the_fit() {
        for press_mm in [0.0, 0.1, -0.1] {
            let joint = FingerJoint {
                press_mm,
                ..joint(90.0)
            };
            let width = |side, at_mm: f64| {
                let outline = joint.panel(side, 40.0).unwrap();
                let level = outline
                    .edges()
                    .filter(move |[a, b]| a[1] == b[1] && (a[1] - at_mm).abs() < 1e-9);
                let widths: Vec<f64> = level.map(|[a, b]| (b[0] - a[0]).abs()).collect();
                widths
            };
            let gaps = width(FingerSide::First, 5.0);
            let fingers = width(FingerSide::Second, 0.0);
            // The plain ends are level with the gap.
            let gaps: Vec<f64> = gaps.into_iter().filter(|mm| *mm > 12.0).collect();
            assert_eq!((gaps.len(), fingers.len()), (1, 1));
            assert!((fingers[0] - gaps[0] - press_mm).abs() < 1e-9);
        }
    }

    #[test]
    fn without_room_there_is_no_panel() {
        let side = FingerSide::First;
        assert_eq!(joint(155.0).panel(side, 40.0), None);
        assert_eq!(joint(90.0).panel(side, 5.0), None);
        let short = FingerJoint {
            edge_mm: 20.0,
            ..joint(90.0)
        };
        assert_eq!(short.panel(side, 40.0), None);
        let even = FingerJoint {
            stretches: 4,
            ..joint(90.0)
        };
        assert_eq!(even.panel(side, 40.0), None);
    }
}
