//! What bosses in a void hide of its wall, and whether they leave it open.

use std::f64::consts::PI;

use rayon::prelude::*;

use crate::{
    cut::{
        access::{chamber::Chamber, sight::Sightlines, void_access::asked_ratio},
        error::CutError,
        geometry::{
            opening::opening,
            tree::{CutTree, reached},
        },
        hollowed::Hollowed,
        request::PlanRequest,
    },
    geom::{Plane, Point, Vector},
    mesh::{TriMesh, bodies},
};

/// Bosses are to leave so much more of a wall in sight than is asked: solving again moves the voids
/// about them. Less, and more must be kept solid afterwards, which costs far more than a dearer
/// place.
const SPARE_RATIO: f64 = 0.01;

/// The plain voids of a body as its cuts open them, before bosses stand in them.
pub(crate) struct BossView<'a> {
    views: Vec<View<'a>>,
    tree: &'a CutTree,
    /// Nearer to a boss than this no tool enters, mm.
    tool_radius_mm: f64,
}

/// One void.
struct View<'a> {
    chamber: Chamber<'a>,
    /// The diameter of the least opening, mm.
    needed_mm: f64,
    /// The points of its wall with where they are seen from; none where no sight is asked.
    lines: Vec<Sightlines>,
    /// How much of the wall may be hidden, as a share of it, before less is in sight than asked.
    spare_ratio: f64,
}

impl<'a> BossView<'a> {
    pub(crate) fn new(
        hollowed: &'a Hollowed,
        tree: &'a CutTree,
        request: &PlanRequest,
    ) -> Result<Self, CutError> {
        let chambers = Chamber::all(hollowed)?.into_iter();
        let empty = chambers.filter(|chamber| chamber.void.holds.is_none());
        let views = empty.map(|chamber| View::new(chamber, tree, request));
        let views = views.collect();
        Ok(Self {
            views,
            tree,
            tool_radius_mm: request.min_opening_mm / 2.0,
        })
    }

    /// How much of each void's wall a boss hides that was in sight, as a share of it.
    pub(crate) fn hidden_by(&self, boss: &TriMesh) -> Vec<f64> {
        let block = Convex::of(boss);
        self.views
            .iter()
            .map(|view| view.hidden_by(&block, self.tool_radius_mm))
            .collect()
    }

    /// How much less than asked is in sight, mm² of all walls, where so much of each is hidden by
    /// some bosses together.
    pub(crate) fn lack_mm2(&self, hidden: &[&[f64]]) -> f64 {
        let lack = |(void, view): (usize, &View)| {
            let hidden: f64 = hidden.iter().map(|shares| shares[void]).sum();
            // What was hidden before is no boss's fault.
            let fault = (hidden - view.spare_ratio).min(hidden).max(0.0);
            fault * view.chamber.walls.area_mm2()
        };
        self.views.iter().enumerate().map(lack).sum()
    }

    /// Whether every void stays open where these bosses stand in it.
    pub(crate) fn stays_open(&self, bosses: &[TriMesh]) -> Result<bool, CutError> {
        let open = self
            .views
            .par_iter()
            .map(|view| view.stays_open(bosses, self.tree));
        Ok(open
            .collect::<Result<Vec<bool>, _>>()?
            .into_iter()
            .all(|is_open| is_open))
    }
}

impl<'a> View<'a> {
    fn new(chamber: Chamber<'a>, tree: &CutTree, request: &PlanRequest) -> Self {
        let asked = asked_ratio(request);
        let lines = if asked > 0.0 {
            chamber.sightlines(tree, request)
        } else {
            Vec::new()
        };
        let seen = lines.iter().filter(|lines| lines.is_seen()).count();
        let spare_ratio = seen as f64 / lines.len().max(1) as f64 - asked - SPARE_RATIO;
        Self {
            needed_mm: chamber.void.least_opening_mm(request),
            chamber,
            lines,
            spare_ratio,
        }
    }

    fn hidden_by(&self, block: &Convex, tool_radius_mm: f64) -> f64 {
        let is_blind =
            |eye: &Point, at: &Point| block.holds(eye, tool_radius_mm) || block.parts(eye, at);
        let is_hidden = |line: &&Sightlines| {
            let at = &line.at;
            line.is_seen() && !block.holds(at, 0.0) && line.eyes.iter().all(|eye| is_blind(eye, at))
        };
        self.lines.par_iter().filter(is_hidden).count() as f64 / self.lines.len().max(1) as f64
    }

    /// Whether what bosses leave is opened by a disc as wide as needed in all its pieces but
    /// crumbs, which will be filled.
    fn stays_open(&self, bosses: &[TriMesh], tree: &CutTree) -> Result<bool, CutError> {
        let rest = self.chamber.without(bosses)?;
        let crumb_mm3 = PI / 6.0 * self.needed_mm.powi(3);
        for piece in bodies(&rest) {
            let mut is_open = piece.signed_volume_mm3() < crumb_mm3;
            for parting in tree.partings() {
                let there = reached(&parting, &piece)?;
                is_open |= opening(&there, &parting.plane)
                    .is_some_and(|o| o.diameter_mm >= self.needed_mm);
            }
            if !is_open {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

/// A convex body as the half-spaces that it is common to.
struct Convex {
    faces: Vec<Plane>,
    center: Point,
    radius_mm: f64,
}

impl Convex {
    /// Of the boundary of a convex body, facing outward.
    fn of(mesh: &TriMesh) -> Self {
        let face = |[a, b, c]: [Point; 3]| {
            let normal = (b - a).cross(&(c - a)).try_normalize(f64::MIN_POSITIVE)?;
            Some(Plane::through(&a, &normal))
        };
        let center = mesh.aabb().center();
        let far = mesh
            .vertices()
            .iter()
            .map(|p| (p - center).norm())
            .fold(0.0, f64::max);
        Self {
            faces: mesh.iter_corners().filter_map(face).collect(),
            center,
            radius_mm: far,
        }
    }

    /// Whether a point is in it, or about so near.
    fn holds(&self, p: &Point, near_mm: f64) -> bool {
        (p - self.center).norm() <= self.radius_mm + near_mm
            && self.faces.iter().all(|face| face.distance(p) <= near_mm)
    }

    /// Whether it stands between two points: the part of the line in all half-spaces (Cyrus and
    /// Beck, "Generalized two- and three-dimensional clipping", Computers & Graphics 3, 1978).
    fn parts(&self, from: &Point, to: &Point) -> bool {
        let along = to - from;
        if self.distance_mm(from, &along) > self.radius_mm {
            return false;
        }
        let (mut enter, mut leave): (f64, f64) = (0.0, 1.0);
        for face in &self.faces {
            let (start, slope) = (face.distance(from), face.normal.dot(&along));
            if slope < 0.0 {
                enter = enter.max(-start / slope);
            } else if slope > 0.0 {
                leave = leave.min(-start / slope);
            } else if start > 0.0 {
                return false;
            }
        }
        enter < leave
    }

    /// The distance of its centre from a line between two points, mm.
    fn distance_mm(&self, from: &Point, along: &Vector) -> f64 {
        let to_center = self.center - from;
        let place =
            (to_center.dot(along) / along.norm_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        (to_center - along * place).norm()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        cut::scenes::{cuboid, request},
        printer::{Cleaning, CleaningRule},
    };

    /// A box with a shaft of 20 × 20 mm from z = −20 to 20 in it, to be seen by 95 %.
    fn shaft() -> (Hollowed, PlanRequest) {
        let void = cuboid([-10.0, -10.0, -20.0], [10.0, 10.0, 20.0]);
        let cleaning = Cleaning {
            rule: CleaningRule::InSight,
            sight_ratio: 0.95,
            ..Cleaning::MELT_OUT
        };
        let body = Hollowed::new(cuboid([-15.0; 3], [15.0, 15.0, 25.0]), vec![void]);
        (
            body,
            PlanRequest {
                cleaning,
                ..request()
            },
        )
    }

    fn level() -> CutTree {
        CutTree::everywhere(&[Plane {
            normal: Vector::z(),
            offset_mm: 0.01,
        }])
    }

    #[test]
    fn a_lid_hides_what_lies_beneath_it_and_a_post_next_to_nothing() {
        let (body, request) = shaft();
        let tree = level();
        let view = BossView::new(&body, &tree, &request).unwrap();
        let lid = cuboid([-11.0, -11.0, -4.0], [11.0, 11.0, -2.0]);
        // Beneath the lid: walls 16 mm deep about 80 mm, and the floor; of all 40 mm about 80 mm,
        // and two floors.
        let expected = (16.0 * 80.0 + 400.0) / (40.0 * 80.0 + 800.0);
        let hidden = view.hidden_by(lid.mesh());
        assert!((hidden[0] - expected).abs() < 0.02, "{hidden:?} {expected}");
        let lack_mm2 = view.lack_mm2(&[&hidden]);
        // All was in sight: what may be hidden are 5 % less both margins.
        let spare = 1.0 - asked_ratio(&request) - SPARE_RATIO;
        assert!(
            (lack_mm2 - (hidden[0] - spare) * 4000.0).abs() < 1.0,
            "{lack_mm2}"
        );
        let post = cuboid([-11.0, -11.0, -6.0], [-8.0, -8.0, 6.0]);
        let hidden = view.hidden_by(post.mesh());
        assert!(
            hidden[0] < 0.02 && view.lack_mm2(&[&hidden]) == 0.0,
            "{hidden:?}"
        );
    }

    #[test]
    fn a_lid_closes_and_a_post_leaves_open() {
        let (body, request) = shaft();
        let tree = level();
        let view = BossView::new(&body, &tree, &request).unwrap();
        let of = |low: [f64; 3], high: [f64; 3]| {
            view.stays_open(&[cuboid(low, high).into_mesh()]).unwrap()
        };
        assert!(!of([-11.0, -11.0, -4.0], [11.0, 11.0, -2.0]));
        assert!(of([-11.0, -11.0, -6.0], [-8.0, -8.0, 6.0]));
    }

    #[test]
    fn a_convex_body_stands_between_points_only_where_it_meets_the_line() {
        let block = Convex::of(cuboid([-1.0; 3], [1.0; 3]).mesh());
        let at = |x: f64, y: f64| Point::new(x, y, 0.0);
        assert!(block.parts(&at(-3.0, 0.0), &at(3.0, 0.0)));
        assert!(
            !block.parts(&at(-3.0, 0.0), &at(-1.5, 0.0)),
            "it begins behind the end"
        );
        assert!(
            !block.parts(&at(-3.0, 1.1), &at(3.0, 1.1)),
            "it passes beside"
        );
        // Past the corner at (1, 1) by 0.07 mm, and through it by as much.
        assert!(
            !block.parts(&at(0.0, 2.1), &at(2.1, 0.0)) && block.parts(&at(0.0, 1.9), &at(1.9, 0.0))
        );
        assert!(block.holds(&at(1.2, 0.0), 0.3) && !block.holds(&at(1.2, 0.0), 0.1));
    }

    #[test]
    fn where_no_sight_is_asked_nothing_counts_as_hidden() {
        let (body, request) = shaft();
        let request = PlanRequest {
            cleaning: Cleaning::MELT_OUT,
            ..request
        };
        let tree = level();
        let view = BossView::new(&body, &tree, &request).unwrap();
        let hidden = view.hidden_by(cuboid([-11.0, -11.0, -4.0], [11.0, 11.0, -2.0]).mesh());
        assert_eq!((hidden[0], view.lack_mm2(&[&hidden])), (0.0, 0.0));
    }
}
