//! The gap between shells of a telescope in a state of its joints.
//!
//! A body is the union of the discs across its centre line. Discs of one bend cannot meet. For a
//! curve of curvature at most K has a reach of 1/K over an arc of less than π/K. (Federer,
//! "Curvature measures", 1959, 4.8; the chords by Schur's theorem.) All other pairs are measured.

use std::f64::consts::{FRAC_PI_2, PI};

use super::nest::{JointState, Telescope};
use crate::geom::triangle::segment_segment_distance_squared;
use crate::geom::{Frame, Point, Vector};

/// The length of the chords that stand for a centre line, mm.
const CHORD_MM: f64 = 4.0;

/// The most that shells may slide, in sum, from one state that is looked at to the next, mm. Pairs
/// that are of one bend now and are not then lie within it of the limit.
pub(super) const MAX_SLIDE_MM: f64 = 8.0;

/// The least gap between shells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gap {
    /// The gap, mm: negative if they overlap, infinite if all belongs to one bend.
    pub gap_mm: f64,
    /// The two shells, counted from 0; the outer one first.
    pub shells: [usize; 2],
}

/// The gaps in a state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Gaps {
    /// The least gap that was measured.
    pub least: Gap,
    /// The least gap of a pair that is of one bend, at the state in which it is no more, mm.
    pub reserve_mm: f64,
}

/// A chord of the centre line of what a shell shows.
struct Chord {
    shell: usize,
    ends: [Point; 2],
    /// The tangents of its arc at the ends.
    tangents: [Vector; 2],
    /// Arcs of its ends along all that shows, from the root's tail, mm.
    arcs_mm: [f64; 2],
    radius_mm: f64,
    /// The greatest distance between the chord and its arc, mm.
    sagitta_mm: f64,
    /// The angle over which its arc bends, rad.
    bend_rad: f64,
}

/// The bend to which two chords belong.
struct Bend {
    /// The greatest curvature between them, 1/mm.
    curvature: f64,
    /// The arc from the first end to the last, mm.
    arc_mm: f64,
    /// How far bodies may be off the curve through the pivots, mm.
    aside_mm: f64,
}

/// What shows of a telescope in a state, with the places about which its joints move it.
pub(super) struct Shown<'a> {
    telescope: &'a Telescope,
    chords: Vec<Chord>,
    pivots: Vec<Point>,
}

impl<'a> Shown<'a> {
    /// Takes what of every shell is out of the mouth of the one before it.
    pub fn of(telescope: &'a Telescope, states: &[JointState]) -> Self {
        let frames = telescope.frames(states);
        let mut arc_mm = 0.0;
        let mut chords = Vec::new();
        for (shell, frame) in frames.iter().enumerate() {
            let slide = shell.checked_sub(1).and_then(|joint| states.get(joint));
            let [tail, mouth] = telescope.ends_mm();
            let from = slide.map_or(tail, |state| mouth - state.slide_mm);
            let piece = Piece {
                telescope,
                shell,
                frame,
                arcs_mm: [from, mouth],
            };
            chords.extend(piece.chords(arc_mm));
            arc_mm += mouth - from;
        }
        let visible = telescope.visible_mm;
        let joints = 0..telescope.joints.len();
        let pivots = joints.map(|joint| along(&frames[joint], telescope, joint, visible).origin);
        Self {
            telescope,
            pivots: pivots.collect(),
            chords,
        }
    }

    /// Returns lower bounds of the gaps between shells, exact to the sagittas of chords of 4 mm.
    ///
    /// A shell slides in the one before it, and what is out of it is of one bend with it, or is
    /// measured.
    pub fn gaps(&self) -> Gaps {
        let mut gaps = Gaps {
            least: Gap {
                gap_mm: f64::INFINITY,
                shells: [0, 0],
            },
            reserve_mm: f64::INFINITY,
        };
        for (i, late) in self.chords.iter().enumerate() {
            for early in self.chords[..i].iter().filter(|c| c.shell < late.shell) {
                self.add_pair(early, late, &mut gaps);
            }
        }
        gaps
    }

    fn add_pair(&self, early: &Chord, late: &Chord, gaps: &mut Gaps) {
        if early.far_mm(late) >= gaps.least.gap_mm.min(gaps.reserve_mm) {
            return;
        }
        let bend = self.bend(early, late);
        if let Some(reserve_mm) = bend.reserve_mm(early, late) {
            gaps.reserve_mm = gaps.reserve_mm.min(reserve_mm);
            return;
        }
        let gap_mm = early.gap_mm(late);
        if gap_mm < gaps.least.gap_mm {
            let shells = [early.shell, late.shell];
            gaps.least = Gap { gap_mm, shells };
        }
    }

    fn bend(&self, early: &Chord, late: &Chord) -> Bend {
        let shells = &self.telescope.shells[early.shell..=late.shell];
        let curvatures = shells.iter().map(|shell| shell.helix.curvature);
        let curvature = curvatures.fold(0.0, f64::max);
        let half = 0.5 * self.telescope.sizes.overlap_mm();
        Bend {
            curvature,
            arc_mm: late.arcs_mm[1] - early.arcs_mm[0],
            // Beyond a pivot the lip goes on along its own helix, the shell along the other.
            aside_mm: curvature * half * half,
        }
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

/// What a shell shows.
struct Piece<'a> {
    telescope: &'a Telescope,
    shell: usize,
    frame: &'a Frame,
    arcs_mm: [f64; 2],
}

impl Piece<'_> {
    /// Returns its chords; `before_mm` of arc show before it.
    fn chords(&self, before_mm: f64) -> Vec<Chord> {
        let [from, to] = self.arcs_mm;
        let count = ((to - from) / CHORD_MM).ceil().max(1.0) as usize;
        let step = (to - from) / count as f64;
        let own = &self.telescope.shells[self.shell];
        let at = |i: usize| {
            let arc_mm = from + step * i as f64;
            along(self.frame, self.telescope, self.shell, arc_mm)
        };
        let frames: Vec<Frame> = (0..=count).map(at).collect();
        let chord = |(i, pair): (usize, &[Frame])| Chord {
            shell: self.shell,
            ends: [pair[0].origin, pair[1].origin],
            tangents: [&pair[0], &pair[1]].map(|frame| frame.axes.column(0).into()),
            arcs_mm: [i, i + 1].map(|i| before_mm + step * i as f64),
            radius_mm: own.body_mm,
            sagitta_mm: own.helix.curvature * step * step / 8.0,
            bend_rad: own.helix.curvature * step,
        };
        frames.windows(2).enumerate().map(chord).collect()
    }
}

impl Bend {
    /// Returns the least gap of two chords of one bend in the state in which they are that no more.
    ///
    /// It is infinite if that is far off, `None` if they are of one bend no more.
    fn reserve_mm(&self, early: &Chord, late: &Chord) -> Option<f64> {
        let radii_mm = early.radius_mm + late.radius_mm;
        let thick_mm = early.radius_mm.max(late.radius_mm) + self.aside_mm;
        let radius_mm = 1.0 / self.curvature;
        let (arc_mm, reserve_mm) = if thick_mm < radius_mm {
            let chord_mm = 2.0 * radius_mm;
            (PI * radius_mm, chord_mm - radii_mm - 2.0 * self.aside_mm)
        } else if late.shell == early.shell + 1 {
            // Each is on its side of the mouth's plane, for neither bends as much as it is thick.
            (FRAC_PI_2 * radius_mm, radius_mm - late.radius_mm)
        } else {
            return None;
        };
        let is_one = self.arc_mm <= arc_mm && reserve_mm > 0.0;
        let is_far = self.arc_mm + MAX_SLIDE_MM <= arc_mm;
        is_one.then_some(if is_far { f64::INFINITY } else { reserve_mm })
    }
}

impl Chord {
    /// Returns a distance that the bodies are at least apart, found with little work.
    fn far_mm(&self, other: &Self) -> f64 {
        let middle = |chord: &Self| nalgebra::center(&chord.ends[0], &chord.ends[1]);
        let half = |chord: &Self| 0.5 * (chord.arcs_mm[1] - chord.arcs_mm[0]) + chord.radius_mm;
        (middle(self) - middle(other)).norm() - half(self) - half(other)
    }

    /// Returns a lower bound of the distance of the bodies, mm: that of balls along the chords, or
    /// of a plane across an end.
    fn gap_mm(&self, later: &Self) -> f64 {
        let ([a, b], [c, d]) = (self.ends, later.ends);
        let chords = segment_segment_distance_squared([&a, &b], [&c, &d]).sqrt();
        let sagittas = self.sagitta_mm + later.sagitta_mm;
        let balls = chords - sagittas - self.radius_mm - later.radius_mm;
        // The two ends that follow each other along the curve, and the two that may meet round it.
        let planes = [
            later.beyond_mm(&b, &self.tangents[1]),
            self.beyond_mm(&c, &-later.tangents[0]),
            later.beyond_mm(&a, &-self.tangents[0]),
            self.beyond_mm(&d, &later.tangents[1]),
        ];
        planes.into_iter().fold(balls, f64::max)
    }

    /// Returns how far all discs of the chord are beyond a plane, mm.
    fn beyond_mm(&self, point: &Point, normal: &Vector) -> f64 {
        let off = self.ends.map(|end| normal.dot(&(end - point)));
        let lean = self.tangents.map(|tangent| normal.cross(&tangent).norm());
        let lean = lean[0].max(lean[1]) + self.bend_rad * self.bend_rad / 8.0;
        off[0].min(off[1]) - self.sagitta_mm - self.radius_mm * lean.min(1.0)
    }
}

/// Returns the frame of a shell's centre line at an arc.
fn along(frame: &Frame, telescope: &Telescope, shell: usize, arc_mm: f64) -> Frame {
    frame.frame_to_model(&telescope.shells[shell].helix.frame_at(arc_mm))
}
