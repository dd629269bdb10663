//! A printed part of the shell, and what holds it.

use super::region::{Bound, Region};
use crate::geom::{Bvh, Point};
use crate::mesh::{TriMesh, area_mm2};

/// The thing that holds a part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Holding {
    /// The panel of its face, on which it bears.
    Panel {
        /// The area on which it bears, mm².
        area_mm2: f64,
    },
    /// Another part, by glue, and by pins where they find room.
    Pinned {
        /// The index of the part that carries it.
        to: usize,
        /// The bound of its region in which the two touch.
        bound: usize,
        /// The area in which they touch, mm².
        area_mm2: f64,
    },
    /// Nothing: it touches neither its panel nor another part in a face.
    Nothing,
}

impl Holding {
    /// Returns true if it is this part, by its index.
    pub(super) fn is_by(&self, part: usize) -> bool {
        matches!(self, Self::Pinned { to, .. } if *to == part)
    }
}

/// A small piece that goes with a part of a neighbouring cell, as it touches no panel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crumb {
    /// The face in whose cell it lies.
    pub face: usize,
    /// A point inside it.
    pub at: Point,
    /// The volume, mm³.
    pub volume_mm3: f64,
    /// The area in which it grew on the part, mm².
    pub area_mm2: f64,
}

/// A part of the shell in its place in the model.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// The index of the face along whose normal it leaves.
    pub face: usize,
    /// The convex region from which it was cut; crumbs lie beside it.
    pub region: Region,
    /// The body, solid.
    pub body: TriMesh,
    /// The crumbs that grew on it.
    pub crumbs: Vec<Crumb>,
    /// The thing that holds it.
    pub holding: Holding,
}

impl Part {
    /// Returns the volume of the solid part, mm³.
    pub fn volume_mm3(&self) -> f64 {
        self.body.signed_volume_mm3()
    }

    /// Returns true if the part bears on its panel.
    pub fn is_on_panel(&self) -> bool {
        matches!(self.holding, Holding::Panel { .. })
    }

    /// Returns the part with the indices of its faces and of the part that carries it raised.
    pub(super) fn raised(self, face: usize, first: usize) -> Self {
        let crumbs = self.crumbs.into_iter().map(|crumb| Crumb {
            face: crumb.face + face,
            ..crumb
        });
        Self {
            face: self.face + face,
            region: self.region.renumbered(face),
            crumbs: crumbs.collect(),
            holding: match self.holding {
                Holding::Pinned {
                    to,
                    bound,
                    area_mm2,
                } => Holding::Pinned {
                    to: to + first,
                    bound,
                    area_mm2,
                },
                other => other,
            },
            ..self
        }
    }

    /// Returns the bound on which it bears, on the panel or on the part that carries it; `None` for
    /// a part that nothing holds.
    pub fn foot(&self) -> Option<&Bound> {
        match self.holding {
            Holding::Panel { .. } => self.region.bounds().first(),
            Holding::Pinned { bound, .. } => self.region.bounds().get(bound),
            Holding::Nothing => None,
        }
    }
}

/// Returns a point well inside a closed body: half way through it behind its largest triangle.
/// `None` for a mesh without triangles.
pub(super) fn inner_point(body: &TriMesh) -> Option<Point> {
    let largest = body
        .iter_corners()
        .max_by(|a, b| area_mm2(a).total_cmp(&area_mm2(b)))?;
    let [a, b, c] = largest;
    let inward = -(b - a).cross(&(c - a)).try_normalize(0.0)?;
    let reach_mm = 2.0 * body.aabb().size().norm();
    let from = Point::from((a.coords + b.coords + c.coords) / 3.0);
    // A step inside, so that the triangle itself is not met.
    let start = from + inward * (1e-9 * reach_mm);
    let bvh = Bvh::new(body.iter_corners());
    let share = bvh.first_crossing(&start, &(start + inward * reach_mm))?;
    Some(start + inward * (0.5 * share * reach_mm))
}

/// Returns the body that holds a point; `None` if none does.
pub(super) fn body_at(bodies: Vec<TriMesh>, at: &Point) -> Option<TriMesh> {
    let holds = |body: &TriMesh| Bvh::new(body.iter_corners()).winding(at) > 0;
    bodies.into_iter().find(holds)
}
