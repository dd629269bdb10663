//! One polyhedron in a model, or in a part of it.

use super::ground::Ground;
use super::growth::Terms;
use super::limits::Limits;
use super::polyhedron::Polyhedron;
use super::search::{Wish, search, widest_start_mm};
use super::side::Side;
use super::starts::{Deep, deep_points, flat_normals};
use crate::base::verdict::Verdict;
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Plane, Point, Vector};

/// The usual number of faces.
pub const FACES: usize = 12;
/// The least number of faces of any body.
pub const LEAST_FACES: usize = 4;
/// The greatest number of faces.
pub const MOST_FACES: usize = 32;
/// The number of starts in a model of few pieces.
const STARTS: usize = 12;
/// The least number of starts.
const LEAST_STARTS: usize = 4;
/// Models of more pieces get fewer starts, so that a search takes about as long.
const PIECES_FOR_ALL_STARTS: usize = 40_000;
/// Added to the factor that gives a thin model room, so that there is some.
const ROOM_RATIO: f64 = 0.01;

/// The order for a polyhedron.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// The distance from the surface, mm: the wall, a gap and what the fasteners need.
    pub distance_mm: f64,
    /// The greatest number of faces.
    pub faces: usize,
    /// The limits of fabrication.
    pub limits: Limits,
}

/// A request that cannot be met in any model.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RequestError {
    /// Too few faces for a body, or more than are sensible.
    #[error("a polyhedron cannot have {0} faces; remedy: ask for {LEAST_FACES} to {MOST_FACES}")]
    Faces(usize),
    /// A distance that is not positive and finite.
    #[error("the distance from the surface is {0} mm, but must be positive and finite")]
    Distance(f64),
}

/// The reason that a model has room for no polyhedron.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "the model is too thin: its deepest point is {deepest_mm:.1} mm below the surface, and the \
     polyhedron must stay {distance_mm:.1} mm away; remedy: {}", remedy(*.least_factor)
)]
pub struct NoRoom {
    /// The depth of the deepest point, mm.
    pub deepest_mm: f64,
    /// The distance asked for, mm.
    pub distance_mm: f64,
    /// The factor by which the model must grow to have room; `None` if none is known.
    pub least_factor: Option<f64>,
}

fn remedy(least_factor: Option<f64>) -> String {
    match least_factor {
        Some(factor) => format!("make the model {factor:.2} times as large, or ask for less wall"),
        None => "make the model larger, ask for less wall or for more faces".to_owned(),
    }
}

impl Request {
    /// Asks for the usual number of faces.
    pub fn new(distance_mm: f64, limits: Limits) -> Self {
        Self {
            distance_mm,
            faces: FACES,
            limits,
        }
    }

    /// Checks the request.
    pub fn check(&self) -> Result<(), RequestError> {
        if !(LEAST_FACES..=MOST_FACES).contains(&self.faces) {
            Err(RequestError::Faces(self.faces))
        } else if !(self.distance_mm.is_finite() && self.distance_mm > 0.0) {
            Err(RequestError::Distance(self.distance_mm))
        } else {
            Ok(())
        }
    }
}

/// Returns a large convex polyhedron that keeps the distance from the model's surface, or why there
/// is no room.
///
/// A local optimum of the volume, the best of several starts. If a limit cannot be kept, the
/// polyhedron says so by [`Polyhedron::breaches`]. The same bytes on any number of threads.
/// `cargo bench -- core/growth` measures its time.
pub fn grow_polyhedron(
    ground: &Ground,
    request: &Request,
    watch: &Watch,
) -> Result<Verdict<Polyhedron, NoRoom>, Cancelled> {
    let region = Region::new(ground, request, Vec::new());
    let grown = region.grow(region.starts(), watch)?;
    Ok(grown.map_or_else(|| Verdict::No(region.no_room()), Verdict::Found))
}

/// A model, or the part of it below some planes.
#[derive(Debug, Clone)]
pub(super) struct Region<'a> {
    pub ground: &'a Ground,
    pub request: &'a Request,
    /// The planes that bound the part.
    pub locked: Vec<Plane>,
    deep: Vec<Deep>,
    flats: Vec<Vector>,
}

impl<'a> Region<'a> {
    /// Looks for the deep points of the part below the planes.
    pub fn new(ground: &'a Ground, request: &'a Request, locked: Vec<Plane>) -> Self {
        // The polyhedron may touch a locked plane, but keeps the distance from the surface.
        let depth = |p: &Point| {
            let below = |plane: &Plane| request.distance_mm - plane.distance(p);
            let from_surface = ground.distance().signed(p);
            locked.iter().map(below).fold(from_surface, f64::min)
        };
        Self {
            deep: deep_points(&ground.obstacles().aabb(), depth),
            flats: flat_normals(ground.solid().mesh()),
            ground,
            request,
            locked,
        }
    }

    /// Returns the number of starts of a thorough search.
    pub fn starts(&self) -> usize {
        let pieces = self.ground.obstacles().len().max(1);
        (STARTS * PIECES_FOR_ALL_STARTS / pieces).clamp(LEAST_STARTS, STARTS)
    }

    /// Returns the best polyhedron of some starts; `None` if there is no room.
    pub fn grow(&self, starts: usize, watch: &Watch) -> Result<Option<Polyhedron>, Cancelled> {
        let wish = Wish {
            faces: Some(self.request.faces),
            ..self.wish(starts)
        };
        let Some(growth) = search(&wish, &self.deep, watch)? else {
            return Ok(None);
        };
        let sides = growth.planes.iter().zip(&growth.is_locked);
        let sides: Vec<Side> = sides
            .map(|(&plane, &is_locked)| Side { plane, is_locked })
            .collect();
        let Request {
            distance_mm,
            limits,
            ..
        } = self.request;
        Ok(Polyhedron::new(self.ground, *distance_mm, &sides, limits).ok())
    }

    /// Returns the volume that some starts reach with many faces and no limits, mm³; 0 if there is
    /// no room.
    pub fn sounded_mm3(&self, starts: usize, watch: &Watch) -> Result<f64, Cancelled> {
        let grown = search(&self.wish(starts), &self.deep, watch)?;
        Ok(grown.map_or(0.0, |growth| growth.volume_mm3))
    }

    fn wish(&self, starts: usize) -> Wish<'_> {
        let terms = Terms {
            obstacles: self.ground.obstacles(),
            distance_mm: self.request.distance_mm,
            limits: &self.request.limits,
            price: 0.0,
        };
        Wish {
            terms,
            locked: &self.locked,
            faces: None,
            starts,
            flats: &self.flats,
        }
    }

    /// Returns why there is no room.
    pub fn no_room(&self) -> NoRoom {
        let distance_mm = self.request.distance_mm;
        // Everything scales with the model but the distance.
        let widest_mm = widest_start_mm(&self.wish(self.starts()), &self.deep);
        let factor = distance_mm / widest_mm * (1.0 + ROOM_RATIO);
        NoRoom {
            deepest_mm: self.deep.first().map_or(0.0, |deep| deep.depth_mm),
            distance_mm,
            least_factor: (factor.is_finite() && factor > 1.0).then_some(factor),
        }
    }
}
