//! The model's own surface: how deep a root may lie in it, and where it can be cut across a branch.

use std::f64::consts::TAU;

use super::along::at;
use super::ends::{mouths, on_root};
use crate::geom::{Frame, Plane, Point, Vector};
use crate::mesh::{MeshDistance, SectionRing, Solid, TriMesh};
use crate::skeleton::{Chain, Skeleton};
use crate::telescope::mount::ROOTED_RADII;
use crate::telescope::nest::Telescope;

/// Stations along a socket, and points around it, whose depth is measured.
const STATIONS: usize = 16;
const AROUND: usize = 16;
/// Depth below a root's tail that its socket takes, mm.
const BELOW_TAIL_MM: f64 = 1.0;
/// Length before a mouth in which the rim of its socket widens, mm.
const RIM_MM: f64 = 0.5;
/// By how much more than the least wall is left, mm: it is measured at points.
const SPARE_MM: f64 = 0.05;
/// The most that a section may reach from the axis of its branch, in radii of the largest ball
/// there. One that reaches farther belongs to more than the branch.
const MOST_REACH_RADII: f64 = 3.0;
/// Places at which a branch is tried to be cut, from its end backwards, and the share of its free
/// length that they cover.
const ENDS: usize = 36;
const END_SHARE: f64 = 0.9;
/// By how much thicker a branch must become beyond a neck that counts as one.
const NECK_RATIO: f64 = 1.12;
/// Length that an end piece has at least, in radii of the branch where it is cut.
const PIECE_RADII: f64 = 1.5;

/// The surface of a model.
pub struct Skin<'a> {
    pub solid: &'a Solid,
    distance: MeshDistance,
}

impl<'a> Skin<'a> {
    pub fn new(solid: &'a Solid) -> Self {
        Self {
            distance: MeshDistance::new(solid.mesh()),
            solid,
        }
    }

    /// Returns the model's triangles.
    pub fn mesh(&self) -> &TriMesh {
        self.solid.mesh()
    }

    /// Returns how deep a point lies below the surface, mm; negative outside.
    pub fn depth_mm(&self, p: &Point) -> f64 {
        self.distance.signed(p)
    }

    /// Returns the ring around a branch in the plane across it, unless it belongs to more than the
    /// branch.
    pub fn ring_across(&self, at: &Point, along: &Vector) -> Option<SectionRing> {
        self.ring_in(self.mesh(), &Plane::through(at, along), at)
    }

    /// Returns the same ring in a model that was cut elsewhere.
    pub fn ring_in(&self, mesh: &TriMesh, plane: &Plane, at: &Point) -> Option<SectionRing> {
        let ball_mm = self.depth_mm(at);
        let ring = mesh.ring_around(plane, at)?;
        (ring.reach_mm(at) <= MOST_REACH_RADII * ball_mm).then_some(ring)
    }

    /// Returns the arc length at which a limb ends, so that what is beyond stays the model's own
    /// piece, mm.
    ///
    /// It is the last neck before something thicker, as a wrist before a hand. Shells are thinner
    /// than that neck, so they never stand for something thicker. Without a neck an end piece of
    /// its least length is kept. `None` if the branch can be cut nowhere.
    pub fn end_mm(&self, chain: &Chain, skeleton: &Skeleton) -> Option<f64> {
        let span_mm = END_SHARE * chain.free_mm();
        let at_mm = |i: usize| chain.end_mm - span_mm * i as f64 / ENDS as f64;
        let point = |arc_mm: f64| at(chain, arc_mm);
        let balls: Vec<f64> = (0..=ENDS)
            .map(|i| self.depth_mm(&point(at_mm(i))))
            .collect();
        let beyond = self.beyond(chain, skeleton);
        let neck = neck(&balls, &beyond);
        let first = match (chain.to, neck) {
            (None, Some(neck)) => neck,
            (None, None) => self.shortest_end(chain, &balls),
            (Some(_), _) => 0,
        };
        (first..=ENDS).map(at_mm).find(|arc_mm| {
            let step_mm = 0.25 * self.depth_mm(&point(*arc_mm)).max(RIM_MM);
            let along = point(arc_mm + step_mm) - point(arc_mm - step_mm);
            along.norm() > 0.0 && self.ring_across(&point(*arc_mm), &along).is_some()
        })
    }

    /// Returns the radii of the balls beyond a chain's end, from there to its last node, mm.
    fn beyond(&self, chain: &Chain, skeleton: &Skeleton) -> Vec<f64> {
        let nodes = chain.nodes.iter().zip(chain.arcs_mm());
        let beyond = nodes.filter(|(_, arc_mm)| *arc_mm > chain.end_mm);
        beyond
            .map(|(node, _)| skeleton.nodes[*node].radius_mm)
            .collect()
    }

    /// Returns the place, counted from the end, beyond which an end piece is long enough.
    fn shortest_end(&self, chain: &Chain, balls: &[f64]) -> usize {
        let step_mm = END_SHARE * chain.free_mm() / ENDS as f64;
        let length_mm = chain.arcs_mm().last().copied().unwrap_or_default();
        let tip_mm = chain.points.last().map_or(0.0, |p| self.depth_mm(p));
        let left_mm = length_mm + tip_mm - chain.end_mm;
        let is_long = |i: &usize| left_mm + step_mm * *i as f64 >= PIECE_RADII * balls[*i];
        (0..balls.len()).find(is_long).unwrap_or(balls.len() - 1)
    }

    /// Returns the depth of a root's axis below the surface over its length, mm.
    pub fn room_mm(&self, axis: &[Point]) -> f64 {
        let depths = axis.iter().map(|p| self.depth_mm(p));
        depths.fold(f64::INFINITY, f64::min)
    }

    /// Returns the reason why a limb as designed does not fit into the model, if there is one.
    pub fn fault(&self, telescope: &Telescope) -> Option<String> {
        let (wall_mm, least_mm) = (self.wall_mm(telescope), telescope.sizes.wall_mm);
        if wall_mm < least_mm + SPARE_MM {
            return Some(format!(
                "its root leaves a wall of {wall_mm:.2} mm in the model, less than {least_mm:.2} mm"
            ));
        }
        if self.peg_depth_mm(telescope) < 0.0 {
            return Some("its peg sticks out of the model's end piece".to_owned());
        }
        let is_cut = |mouth: &Frame| {
            let along: Vector = mouth.axes.column(0).into();
            self.ring_across(&mouth.origin, &along).is_some()
        };
        let mouths = mouths(telescope);
        (!mouths.iter().all(is_cut))
            .then(|| "the model cannot be cut there across this branch alone".to_owned())
    }

    /// Returns how deep the peg in the last mouth lies in the model, mm; negative if it sticks out.
    fn peg_depth_mm(&self, telescope: &Telescope) -> f64 {
        let [_, mouth] = mouths(telescope);
        let radius_mm =
            telescope.shells[telescope.shells.len() - 1].body_mm - telescope.sizes.wall_mm;
        let ahead_mm = ROOTED_RADII * radius_mm;
        let points = [0.5 * ahead_mm, ahead_mm].into_iter().flat_map(|x| {
            (0..AROUND).map(move |i| {
                let (sin, cos) = (TAU * i as f64 / AROUND as f64).sin_cos();
                Point::new(x, radius_mm * cos, radius_mm * sin)
            })
        });
        let depths = points.map(|p| self.depth_mm(&mouth.to_model(&p)));
        depths.fold(f64::INFINITY, f64::min)
    }

    /// Returns the least wall around the socket of a root, mm.
    fn wall_mm(&self, telescope: &Telescope) -> f64 {
        let sizes = &telescope.sizes;
        let radius_mm = telescope.shells[0].body_mm + sizes.glue_mm;
        let [tail_mm, mouth_mm] = telescope.ends_mm();
        let from_mm = tail_mm - BELOW_TAIL_MM;
        let span_mm = mouth_mm - RIM_MM - from_mm;
        let stations = (0..=STATIONS).map(|i| from_mm + span_mm * i as f64 / STATIONS as f64);
        let depths = stations.flat_map(|arc_mm| {
            let frame = on_root(telescope, arc_mm);
            let at = move |turn_rad: f64, radius_mm: f64| {
                let (sin, cos) = turn_rad.sin_cos();
                frame.to_model(&Point::new(0.0, radius_mm * cos, radius_mm * sin))
            };
            let around = (0..AROUND).map(move |i| at(TAU * i as f64 / AROUND as f64, radius_mm));
            // The groove lies on the side of the normal.
            around.chain([at(0.0, radius_mm + sizes.groove_mm())])
        });
        depths
            .map(|p| self.depth_mm(&p))
            .fold(f64::INFINITY, f64::min)
    }
}

/// Returns the place of the last neck among radii from the end backwards; `beyond` are those after
/// the end.
fn neck(balls: &[f64], beyond: &[f64]) -> Option<usize> {
    let mut widest_mm = beyond.iter().copied().fold(0.0, f64::max);
    for (i, ball_mm) in balls.iter().enumerate() {
        let is_least = balls.get(i + 1).is_none_or(|next| ball_mm <= next);
        if is_least && widest_mm > NECK_RATIO * ball_mm {
            return Some(i);
        }
        widest_mm = widest_mm.max(*ball_mm);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wrist_is_the_neck_before_a_hand_and_a_taper_has_none() {
        // From the end backwards: a finger, the palm, the wrist, the arm.
        let arm = [2.0, 4.0, 7.0, 6.0, 5.0, 6.0, 8.0];
        assert_eq!(neck(&arm, &[]), Some(4));
        assert_eq!(neck(&[2.0, 3.0, 4.0, 5.0], &[]), None);
        assert_eq!(neck(&[5.0, 5.5, 6.0], &[8.0, 3.0]), Some(0));
    }
}
