//! The ends of a limb in its junctures: the bore around its root, the wall around that, and the peg
//! in its last mouth.

use std::f64::consts::TAU;

use super::motion::{ShellMotion, frame_of};
use super::network::NetworkEvidence;
use crate::geom::{Frame, Point};
use crate::mesh::MeshDistance;
use crate::verify::cover::ON_SHEET_MM;

/// By how much a point may be beside a plane, a bore or a peg, mm: facets and rounding.
const BESIDE_MM: f64 = 0.01;
/// Depth below a root's tail that its bore may take, mm.
const BELOW_TAIL_MM: f64 = 1.0;
/// The deepest groove beside a bore, in radii of the bore.
const MOST_GROOVE: f64 = 0.5;
/// Length before a root's mouth in which its bore may widen to a rim, mm.
const RIM_MM: f64 = 0.5;
/// Stations along a bore, and angles around it, at which the wall is measured.
const STATIONS: usize = 24;
const ANGLES: usize = 24;
/// Steps in which the nearest place of an axis is looked for, and refined.
const STEPS: usize = 32;
const REFINED: usize = 20;
/// A step so small ends the refining, mm.
const SETTLED_MM: f64 = 1e-9;

/// The ends of a limb where they are when all is out.
pub(super) struct Ends<'a> {
    root: Frame,
    first: &'a ShellMotion,
    /// The frames at the root's tail and at its mouth.
    root_tail: Frame,
    root_mouth: Frame,
    last: Frame,
    last_shell: &'a ShellMotion,
    /// The frame at the last mouth.
    last_mouth: Frame,
    /// Radius of the last body, mm.
    last_mm: f64,
    /// Radius of the bore, mm.
    bore_mm: f64,
    /// Depth of the groove beside it, mm.
    groove_mm: f64,
}

impl<'a> Ends<'a> {
    /// Takes the ends of a limb, from 0.
    pub fn of(evidence: &'a NetworkEvidence, limb: usize) -> Self {
        let motion = &evidence.motion.limbs[limb];
        let sheet = &evidence.promise.limbs[limb].sheet;
        let open = motion.joints.iter();
        let open: Vec<[f64; 2]> = open.map(|joint| [joint.open_mm, joint.turn_rad]).collect();
        let root = frame_of(&motion.root);
        let last = motion.frames(&open).last().copied().unwrap_or(root);
        let (first, last_shell) = (&motion.shells[0], &motion.shells[motion.shells.len() - 1]);
        let body_mm = |shell: usize| {
            let mut tubes = sheet.parts.iter().filter(|part| part.is_tube);
            let own = tubes.find(|part| part.shell == shell);
            own.map_or(0.0, |part| part.body_mm)
        };
        let bore_mm = body_mm(1) + evidence.promise.glue_mm;
        let last_mm = body_mm(motion.shells.len());
        Self {
            root_tail: root.frame_to_model(&first.along(first.ends_mm[0])),
            root_mouth: root.frame_to_model(&first.along(first.ends_mm[1])),
            last_mouth: last.frame_to_model(&last_shell.along(last_shell.ends_mm[1])),
            root,
            first,
            last,
            last_shell,
            last_mm,
            bore_mm,
            groove_mm: evidence.promise.groove_mm.min(MOST_GROOVE * bore_mm),
        }
    }

    /// Returns true if a triangle lies in the cut at the root's mouth, or in its bore.
    pub fn is_in_root(&self, corners: &[Point; 3]) -> bool {
        is_on_plane(&self.root_mouth, corners) || self.is_in_bore(corners)
    }

    /// Returns true if a triangle lies in the root's bore.
    pub fn is_in_bore(&self, corners: &[Point; 3]) -> bool {
        let [tail_mm, mouth_mm] = self.first.ends_mm;
        let bore = |radius_mm: f64, from_mm: f64| Within {
            arcs_mm: [from_mm, mouth_mm],
            radius_mm,
            aside_mm: f64::INFINITY,
        };
        let wide_mm = self.bore_mm + self.groove_mm;
        let below_mm = tail_mm - BELOW_TAIL_MM;
        let [round, rim, groove] = [
            bore(self.bore_mm, below_mm),
            bore(wide_mm, mouth_mm - RIM_MM),
            Within {
                // Its sides are radial: it is wider at its bottom.
                aside_mm: self.groove_mm * wide_mm / self.bore_mm,
                ..bore(wide_mm, below_mm)
            },
        ];
        let is_bored = |local: &Point| {
            let all = [&round, &rim, &groove];
            all.iter().any(|within| is_about(self.first, local, within))
        };
        corners.iter().all(|p| {
            let local = self.root.to_local(p);
            self.is_below_tail(p) || is_bored(&local)
        })
    }

    /// Returns true if a point lies in the room at a root's tail, which is straight.
    fn is_below_tail(&self, p: &Point) -> bool {
        let local = self.root_tail.to_local(p);
        let is_there = local.x.abs() <= BELOW_TAIL_MM + BESIDE_MM;
        is_there && local.y.hypot(local.z) <= self.bore_mm + self.groove_mm + BESIDE_MM
    }

    /// Returns true if a triangle lies in the cut at the last mouth, or on the peg in it.
    pub fn is_on_last(&self, corners: &[Point; 3]) -> bool {
        is_on_plane(&self.last_mouth, corners) || self.is_on_peg(corners)
    }

    /// Returns true if a triangle lies on the peg in the last mouth.
    pub fn is_on_peg(&self, corners: &[Point; 3]) -> bool {
        let peg = Within {
            arcs_mm: self.last_shell.ends_mm,
            radius_mm: self.last_mm,
            aside_mm: f64::INFINITY,
        };
        corners.iter().all(|p| {
            let local = self.last.to_local(p);
            is_about(self.last_shell, &local, &peg)
        })
    }

    /// Returns true if points reach from behind the root's mouth to ahead of the last one.
    pub fn reaches_both(&self, points: &[Point]) -> bool {
        let behind = |p: &Point| self.root_mouth.to_local(p).x <= ON_SHEET_MM;
        let ahead = |p: &Point| self.last_mouth.to_local(p).x >= -ON_SHEET_MM;
        points.iter().any(behind) && points.iter().any(ahead)
    }

    /// Returns the least distance of points from the middle of the root's mouth, mm.
    pub fn mouth_gap_mm(&self, points: &[Point]) -> f64 {
        let mouth = self.root_mouth.origin;
        let distances = points.iter().map(|p| (p - mouth).norm());
        distances.fold(f64::INFINITY, f64::min)
    }

    /// Returns the least depth of the bore below the model's surface, mm.
    pub fn wall_mm(&self, model: &MeshDistance) -> f64 {
        let [tail_mm, mouth_mm] = self.first.ends_mm;
        let from_mm = tail_mm - BELOW_TAIL_MM;
        let span_mm = mouth_mm - RIM_MM - from_mm;
        let depths = (0..=STATIONS).flat_map(|i| {
            let arc_mm = from_mm + span_mm * i as f64 / STATIONS as f64;
            let frame = self.root.frame_to_model(&self.first.along(arc_mm));
            let at = move |turn_rad: f64, radius_mm: f64| {
                let (sin, cos) = turn_rad.sin_cos();
                frame.to_model(&Point::new(0.0, radius_mm * cos, radius_mm * sin))
            };
            let bore_mm = self.bore_mm;
            let around = (0..ANGLES).map(move |i| at(TAU * i as f64 / ANGLES as f64, bore_mm));
            around.chain([at(0.0, bore_mm + self.groove_mm)])
        });
        depths
            .map(|p| model.signed(&p))
            .fold(f64::INFINITY, f64::min)
    }
}

fn is_on_plane(mouth: &Frame, corners: &[Point; 3]) -> bool {
    corners
        .iter()
        .all(|p| mouth.to_local(p).x.abs() <= ON_SHEET_MM)
}

/// A stretch about the axis of a shell.
struct Within {
    arcs_mm: [f64; 2],
    radius_mm: f64,
    /// The most aside of the side on which the air's groove lies; infinite all around.
    aside_mm: f64,
}

/// Returns true if a point in a shell's frame lies within a radius of its axis, between two arcs.
fn is_about(shell: &ShellMotion, p: &Point, within: &Within) -> bool {
    let [from_mm, to_mm] = within.arcs_mm;
    let off = |arc_mm: f64| (shell.along(arc_mm).origin - p).norm();
    // A point within the radius is no farther from the middle than along the axis.
    let reach_mm = 0.5 * (to_mm - from_mm) + within.radius_mm + 2.0 * BESIDE_MM;
    if off(0.5 * (from_mm + to_mm)) > reach_mm {
        return false;
    }
    let at = |i: usize| from_mm + (to_mm - from_mm) * i as f64 / STEPS as f64;
    let nearest = (0..=STEPS).min_by(|a, b| off(at(*a)).total_cmp(&off(at(*b))));
    let mut arc_mm = at(nearest.unwrap_or_default());
    for _ in 0..REFINED {
        let step_mm = shell.along(arc_mm).to_local(p).x;
        arc_mm += step_mm;
        if step_mm.abs() < SETTLED_MM {
            break;
        }
    }
    let local = shell.along(arc_mm).to_local(p);
    // Far from a bent axis the steps do not end at its nearest place.
    let is_across = local.x.abs() <= BESIDE_MM;
    let is_between = arc_mm >= from_mm - BESIDE_MM && arc_mm <= to_mm + BESIDE_MM;
    let is_aside = within.aside_mm.is_infinite()
        || local.y > 0.0 && local.z.abs() <= within.aside_mm + BESIDE_MM;
    is_across && is_between && is_aside && local.y.hypot(local.z) <= within.radius_mm + BESIDE_MM
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    fn shell(curvature: f64) -> ShellMotion {
        ShellMotion {
            id: "S1".to_owned(),
            curvature,
            torsion: 0.0,
            length_mm: 10.0,
            ends_mm: [0.0, 10.0],
        }
    }

    /// Tries something on straight ends: a bore of 5 mm from 0 to 10 along x, a peg of 3 mm from
    /// 100 to 110.
    pub(in super::super) fn with_straight(try_out: impl FnOnce(&Ends)) {
        let own = shell(0.0);
        let at = |x: f64| Frame {
            origin: Point::new(x, 0.0, 0.0),
            ..Frame::identity()
        };
        try_out(&Ends {
            root: at(0.0),
            first: &own,
            root_tail: at(0.0),
            root_mouth: at(10.0),
            last: at(100.0),
            last_shell: &own,
            last_mouth: at(110.0),
            last_mm: 3.0,
            bore_mm: 5.0,
            groove_mm: 0.0,
        });
    }

    #[test]
    fn points_of_a_bore_on_a_strongly_bent_axis_are_in_it() {
        // The axis turns about a centre 7 mm away, and the bore reaches 5 mm towards it.
        let shell = shell(1.0 / 7.0);
        let within = Within {
            arcs_mm: shell.ends_mm,
            radius_mm: 5.0,
            aside_mm: f64::INFINITY,
        };
        for i in 0..=100 {
            let frame = shell.along(0.1 * f64::from(i));
            for turn in 0..24 {
                let (sin, cos) = (TAU * f64::from(turn) / 24.0).sin_cos();
                let on = |radius_mm: f64| {
                    frame.to_model(&Point::new(0.0, radius_mm * cos, radius_mm * sin))
                };
                assert!(is_about(&shell, &on(5.0), &within), "{i} {turn}");
                assert!(!is_about(&shell, &on(5.1), &within), "{i} {turn}");
            }
        }
    }
}
