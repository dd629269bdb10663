//! The gap between shells of a telescope in a state of its joints.

use std::f64::consts::FRAC_PI_2;

use super::nest::{JointState, Telescope};
use crate::geom::triangle::segment_segment_distance_squared;
use crate::geom::{Frame, Point};

/// The length of the chords that stand for a centre line, mm.
const CHORD_MM: f64 = 4.0;

/// The least gap between shells that do not slide in each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gap {
    /// The gap, mm: negative if they overlap, infinite if no two can meet.
    pub gap_mm: f64,
    /// The two shells, counted from 0; the outer one first.
    pub shells: [usize; 2],
}

/// A chord of the centre line of what a shell shows.
struct Chord {
    shell: usize,
    ends: [Point; 2],
    /// Arc along all that shows, from the root's tail to its middle, mm.
    arc_mm: f64,
    radius_mm: f64,
    /// The greatest distance between the chord and its arc, mm.
    sagitta_mm: f64,
}

/// What shows of a telescope in a state, with the places about which its joints move it.
pub(super) struct Shown {
    chords: Vec<Chord>,
    pivots: Vec<Point>,
}

impl Shown {
    /// Takes what of every shell is out of the mouth of the one before it.
    pub fn of(telescope: &Telescope, states: &[JointState]) -> Self {
        let frames = telescope.frames(states);
        let mut arc_mm = 0.0;
        let mut chords = Vec::new();
        for (shell, frame) in frames.iter().enumerate() {
            let slide = shell.checked_sub(1).and_then(|joint| states.get(joint));
            let [tail, mouth] = telescope.ends_mm();
            let from = slide.map_or(tail, |state| mouth - state.slide_mm);
            let count = ((mouth - from) / CHORD_MM).ceil().max(1.0) as usize;
            let step = (mouth - from) / count as f64;
            let own = &telescope.shells[shell];
            let at = |i: usize| along(frame, telescope, shell, from + step * i as f64);
            chords.extend((0..count).map(|i| Chord {
                shell,
                ends: [at(i), at(i + 1)],
                arc_mm: arc_mm + step * (i as f64 + 0.5),
                radius_mm: own.body_mm,
                sagitta_mm: own.helix.curvature * step * step / 8.0,
            }));
            arc_mm += mouth - from;
        }
        let visible = telescope.visible_mm;
        let joints = 0..telescope.joints.len();
        let pivots = joints.map(|joint| along(&frames[joint], telescope, joint, visible));
        Self {
            chords,
            pivots: pivots.collect(),
        }
    }

    /// Returns a lower bound of the gap between shells that are no neighbours, mm. It is exact to
    /// the sagittas of chords of 4 mm.
    ///
    /// Neighbours slide in each other. So do parts less than π/2 of both radii apart along the
    /// curve: they belong to one bend, which a tube can make.
    pub fn gap(&self) -> Gap {
        let mut least = Gap {
            gap_mm: f64::INFINITY,
            shells: [0, 0],
        };
        for (i, late) in self.chords.iter().enumerate() {
            for early in &self.chords[..i] {
                let radii = late.radius_mm + early.radius_mm;
                let is_one_bend = late.arc_mm - early.arc_mm <= FRAC_PI_2 * radii;
                if late.shell < early.shell + 2 || is_one_bend {
                    continue;
                }
                let gap_mm = early.distance_mm(late) - radii;
                if gap_mm < least.gap_mm {
                    let shells = [early.shell, late.shell];
                    least = Gap { gap_mm, shells };
                }
            }
        }
        least
    }

    /// Returns the greatest distance from a joint's pivot to a surface that it moves, mm.
    pub fn reach_mm(&self, joint: usize) -> f64 {
        let pivot = &self.pivots[joint];
        let beyond = self.chords.iter().filter(|chord| chord.shell > joint);
        let distances = beyond.flat_map(|chord| {
            let to_surface = |end: &Point| (end - pivot).norm() + chord.radius_mm;
            chord.ends.each_ref().map(to_surface)
        });
        distances.fold(0.0, f64::max)
    }
}

impl Chord {
    fn distance_mm(&self, other: &Self) -> f64 {
        let ends = |chord: &Self| chord.ends;
        let ([a, b], [c, d]) = (ends(self), ends(other));
        let chords = segment_segment_distance_squared([&a, &b], [&c, &d]).sqrt();
        chords - self.sagitta_mm - other.sagitta_mm
    }
}

/// Returns the point of a shell's centre line at an arc.
fn along(frame: &Frame, telescope: &Telescope, shell: usize, arc_mm: f64) -> Point {
    frame.to_model(&telescope.shells[shell].helix.frame_at(arc_mm).origin)
}
