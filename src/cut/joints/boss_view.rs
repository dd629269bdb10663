//! Checks the walls that bosses hide in voids, and that the voids stay open.

use std::f64::consts::PI;

use rayon::prelude::*;

use crate::{
    base::watch::Cancelled,
    cut::{
        access::{chamber::Chamber, sight::Sightlines, void_access::required_sight_ratio},
        error::CutError,
        geometry::{
            opening::measure_opening,
            tree::{CutTree, clip_to_limits},
        },
        hollowed::Hollowed,
        request::PlanRequest,
    },
    geom::{Aabb, Plane, Point, Vector},
    mesh::{TriMesh, bodies},
};

/// Share of the wall that bosses leave visible beyond the requirement, because solving again moves
/// the voids around them. Falling short means more solid material afterwards, which costs far more
/// than a dearer place.
const SPARE_RATIO: f64 = 0.01;

/// The plain voids of a body as its cuts open them, without bosses.
pub(crate) struct BossView<'a> {
    views: Vec<View<'a>>,
    tree: &'a CutTree,
    /// Distance from a boss within which no tool fits, mm.
    tool_radius_mm: f64,
}

/// One void.
struct View<'a> {
    chamber: Chamber<'a>,
    /// Diameter of the smallest opening allowed, mm.
    min_opening_mm: f64,
    /// Points of its wall with the points that see them; empty if no sight is required.
    lines: Vec<Sightlines>,
    /// The box of all these points.
    aabb: Aabb,
    /// Share of the wall that may be hidden before too little is visible.
    spare_ratio: f64,
}

impl<'a> BossView<'a> {
    pub(crate) fn new(
        hollowed: &'a Hollowed,
        tree: &'a CutTree,
        request: &'a PlanRequest,
    ) -> Result<Self, CutError> {
        let chambers = Chamber::all(hollowed, &request.watch)?.into_iter();
        let empty = chambers.filter(|chamber| chamber.void.holds.is_none());
        let views = empty.map(|chamber| View::new(chamber, tree, request));
        Ok(Self {
            views: views.collect::<Result<_, _>>()?,
            tree,
            tool_radius_mm: request.min_opening_mm / 2.0,
        })
    }

    /// Returns the share of each void's wall that was visible and that the boss hides.
    pub(crate) fn hidden_by(&self, boss: &TriMesh) -> Vec<f64> {
        let block = Convex::of(boss);
        self.views
            .iter()
            .map(|view| view.hidden_by(&block, self.tool_radius_mm))
            .collect()
    }

    /// Returns the visible area that is missing, mm² over all walls, when the given bosses hide
    /// their shares together.
    pub(crate) fn shortfall_mm2(&self, hidden: &[&[f64]]) -> f64 {
        let shortfall = |(void, view): (usize, &View)| {
            let hidden: f64 = hidden.iter().map(|shares| shares[void]).sum();
            // Walls hidden before are not counted against the bosses.
            let caused = (hidden - view.spare_ratio).min(hidden).max(0.0);
            caused * view.chamber.walls.area_mm2()
        };
        self.views.iter().enumerate().map(shortfall).sum()
    }

    /// Returns true if every void stays open with these bosses in it.
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
    fn new(chamber: Chamber<'a>, tree: &CutTree, request: &PlanRequest) -> Result<Self, Cancelled> {
        let required = required_sight_ratio(request);
        let lines = if required > 0.0 {
            chamber.sightlines(tree, request)?
        } else {
            Vec::new()
        };
        let seen = lines.iter().filter(|lines| lines.is_seen()).count();
        let spare_ratio = seen as f64 / lines.len().max(1) as f64 - required - SPARE_RATIO;
        let points = lines
            .iter()
            .flat_map(|line| line.eyes.iter().chain([&line.at]));
        Ok(Self {
            aabb: Aabb::of_points(points),
            min_opening_mm: chamber.void.least_opening_mm(request),
            chamber,
            lines,
            spare_ratio,
        })
    }

    fn hidden_by(&self, block: &Convex, tool_radius_mm: f64) -> f64 {
        // Most bosses reach one void or two.
        let reach_mm = block.radius_mm + tool_radius_mm;
        if self.lines.is_empty() || self.aabb.distance_squared(&block.center) > reach_mm.powi(2) {
            return 0.0;
        }
        let is_blocked =
            |eye: &Point, at: &Point| block.contains(eye, tool_radius_mm) || block.blocks(eye, at);
        let is_hidden = |line: &&Sightlines| {
            let at = &line.at;
            line.is_seen()
                && !block.contains(at, 0.0)
                && line.eyes.iter().all(|eye| is_blocked(eye, at))
        };
        self.lines.par_iter().filter(is_hidden).count() as f64 / self.lines.len().max(1) as f64
    }

    /// Returns true if a disc of the required width opens every piece that the bosses leave. Tiny
    /// pieces do not count: they will be filled.
    fn stays_open(&self, bosses: &[TriMesh], tree: &CutTree) -> Result<bool, CutError> {
        let rest = self.chamber.without(bosses)?;
        let crumb_mm3 = PI / 6.0 * self.min_opening_mm.powi(3);
        for piece in bodies(&rest) {
            let mut is_open = piece.signed_volume_mm3() < crumb_mm3;
            for parting in tree.partings() {
                let region = clip_to_limits(&parting, &piece)?;
                is_open |= measure_opening(&region, &parting.plane)
                    .is_some_and(|o| o.diameter_mm >= self.min_opening_mm);
            }
            if !is_open {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

/// A convex body as an intersection of half-spaces.
struct Convex {
    faces: Vec<Plane>,
    center: Point,
    radius_mm: f64,
}

impl Convex {
    /// Builds it from the outward-facing boundary of a convex body.
    fn of(mesh: &TriMesh) -> Self {
        let face = |[a, b, c]: [Point; 3]| {
            let normal = (b - a).cross(&(c - a)).try_normalize(f64::MIN_POSITIVE)?;
            Some(Plane::through(&a, &normal))
        };
        let center = mesh.aabb().center();
        let radius_mm = mesh
            .vertices()
            .iter()
            .map(|p| (p - center).norm())
            .fold(0.0, f64::max);
        Self {
            faces: mesh.iter_corners().filter_map(face).collect(),
            center,
            radius_mm,
        }
    }

    /// Returns true if a point is inside, or outside by about `near_mm` at most.
    fn contains(&self, p: &Point, near_mm: f64) -> bool {
        (p - self.center).norm() <= self.radius_mm + near_mm
            && self.faces.iter().all(|face| face.distance(p) <= near_mm)
    }

    /// Returns true if it meets the segment between two points. Clips the segment by all
    /// half-spaces (Cyrus and Beck, "Generalized two- and three-dimensional clipping", Computers &
    /// Graphics 3, 1978).
    fn blocks(&self, from: &Point, to: &Point) -> bool {
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

    /// Returns the distance of its centre from the segment `from` to `from + along`, mm.
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

    /// Returns a box with a shaft of 20 × 20 mm from z = −20 to 20, of which 95 % must be visible.
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
        // Below the lid lie walls 16 mm deep with a perimeter of 80 mm, and the floor. In all the
        // walls are 40 mm deep, with two floors.
        let expected = (16.0 * 80.0 + 400.0) / (40.0 * 80.0 + 800.0);
        let hidden = view.hidden_by(lid.mesh());
        assert!((hidden[0] - expected).abs() < 0.02, "{hidden:?} {expected}");
        let lack_mm2 = view.shortfall_mm2(&[&hidden]);
        // Everything was visible: bosses may hide 5 % less both margins.
        let spare = 1.0 - required_sight_ratio(&request) - SPARE_RATIO;
        assert!(
            (lack_mm2 - (hidden[0] - spare) * 4000.0).abs() < 1.0,
            "{lack_mm2}"
        );
        let post = cuboid([-11.0, -11.0, -6.0], [-8.0, -8.0, 6.0]);
        let hidden = view.hidden_by(post.mesh());
        assert!(
            hidden[0] < 0.02 && view.shortfall_mm2(&[&hidden]) == 0.0,
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
    fn a_convex_body_blocks_two_points_only_if_it_meets_their_segment() {
        let block = Convex::of(cuboid([-1.0; 3], [1.0; 3]).mesh());
        let at = |x: f64, y: f64| Point::new(x, y, 0.0);
        assert!(block.blocks(&at(-3.0, 0.0), &at(3.0, 0.0)));
        assert!(
            !block.blocks(&at(-3.0, 0.0), &at(-1.5, 0.0)),
            "it begins behind the end"
        );
        assert!(
            !block.blocks(&at(-3.0, 1.1), &at(3.0, 1.1)),
            "it passes beside"
        );
        // Passes the corner at (1, 1) at 0.07 mm, and cuts it by as much.
        assert!(
            !block.blocks(&at(0.0, 2.1), &at(2.1, 0.0))
                && block.blocks(&at(0.0, 1.9), &at(1.9, 0.0))
        );
        assert!(block.contains(&at(1.2, 0.0), 0.3) && !block.contains(&at(1.2, 0.0), 0.1));
    }

    #[test]
    fn nothing_counts_as_hidden_if_no_sight_is_required() {
        let (body, request) = shaft();
        let request = PlanRequest {
            cleaning: Cleaning::MELT_OUT,
            ..request
        };
        let tree = level();
        let view = BossView::new(&body, &tree, &request).unwrap();
        let hidden = view.hidden_by(cuboid([-11.0, -11.0, -4.0], [11.0, 11.0, -2.0]).mesh());
        assert_eq!((hidden[0], view.shortfall_mm2(&[&hidden])), (0.0, 0.0));
    }
}
