//! Parts hollowed from their panel's side: a wall under the outside and along the seams.

use super::divide::{Scene, pieces_of};
use super::error::CladdingError;
use super::part::{Part, body_at};
use crate::base::watch::Watch;
use crate::geom::{Point, Vector};
use crate::mesh::{Csg, Solid, TriMesh, bodies};
use crate::shell::Keep;
use crate::voids::{Cavity, CavitySpec};

/// Depth below the floor to which a part is drawn for its cavity, in walls. The cavity ends one
/// wall above that, so it passes the floor by one.
const DEPTH_WALLS: f64 = 2.0;
/// The same depth besides walls, mm: the cavity's surface strays by much less.
const DEPTH_MM: f64 = 0.5;
/// Tolerance of the cavity's surface, mm, as for the voids of a printer: no part's wall is checked
/// by anything finer.
const TOLERANCE_MM: f64 = 0.04;
/// Distance from the floor beyond which a void reaches through it, in walls.
const MOUTH_WALLS: f64 = 0.5;

/// The style of a shell's parts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ShellStyle {
    /// Parts on panels are hollowed from the panel's side.
    Cups,
    /// All parts are solid.
    Solid,
}

/// The order for the cup of a part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CupRequest<'a> {
    /// The wall, mm.
    pub wall_mm: f64,
    /// Other places that stay solid.
    pub keeps: &'a [Keep],
}

/// A part with its hollow.
#[derive(Debug, Clone, PartialEq)]
pub struct Cup {
    /// The body.
    pub body: TriMesh,
    /// The volume of the hollow, mm³.
    pub void_mm3: f64,
    /// The volume behind the wall that stays solid, mm³: no way leads from it to the panel that the
    /// wall leaves open.
    pub unreached_mm3: f64,
    /// The volume of material that stood free in the hollow and went with it, mm³.
    pub loose_mm3: f64,
    /// The volumes that its pins add and that its sockets take away, mm³.
    pub pins_mm3: [f64; 2],
}

impl Cup {
    /// Returns a part as it is, solid.
    pub fn solid(part: &Part) -> Self {
        Self {
            body: part.body.clone(),
            void_mm3: 0.0,
            unreached_mm3: 0.0,
            loose_mm3: 0.0,
            pins_mm3: [0.0; 2],
        }
    }
}

impl Scene<'_> {
    /// Hollows a part that bears on its panel, and leaves it open there; other parts stay solid, as
    /// their pins need material.
    ///
    /// The wall stays under the outside, along the seams and along cuts. No void is closed: what
    /// the panel's side does not reach stays solid. Crumbs stay solid.
    ///
    /// # Errors
    /// No surface keeps the wall, the boolean engine fails, or the watch is stopped.
    pub fn cup(
        &self,
        part: &Part,
        request: &CupRequest,
        watch: &Watch,
    ) -> Result<Cup, CladdingError> {
        let Some(drawn) = self.drawn_below(part, request.wall_mm)? else {
            return Ok(Cup::solid(part));
        };
        let spec = CavitySpec {
            wall_mm: request.wall_mm,
            tolerance_mm: TOLERANCE_MM,
            quadric_tolerance_mm: TOLERANCE_MM,
            keeps: request.keeps,
            min_void_mm: 0.0,
        };
        let cavity = Cavity::extract(&Solid::new(drawn)?, &spec, watch)?;
        let floor = part.region.bounds()[0].plane;
        let reach_mm = MOUTH_WALLS * request.wall_mm;
        let is_open = |void: &TriMesh| void.vertices().iter().any(|p| floor.distance(p) > reach_mm);
        let (open, closed): (Vec<_>, Vec<_>) = bodies(cavity.mesh())
            .into_iter()
            .partition(|void| is_open(void));
        let void = open.iter().fold(TriMesh::default(), TriMesh::joined);
        if void.is_empty() {
            return Ok(Cup::solid(part));
        }
        let whole = Csg::of_mesh(&part.body)?;
        let mut pieces = pieces_of(&whole.subtract(&Csg::of_mesh(&void)?)?)?;
        pieces.sort_by(|a, b| b.signed_volume_mm3().total_cmp(&a.signed_volume_mm3()));
        let loose = pieces.split_off(pieces.len().min(1));
        let body = pieces.pop().unwrap_or_default();
        let loose_mm3: f64 = loose.iter().map(TriMesh::signed_volume_mm3).sum();
        Ok(Cup {
            void_mm3: part.volume_mm3() - body.signed_volume_mm3(),
            unreached_mm3: closed.iter().map(TriMesh::signed_volume_mm3).sum(),
            loose_mm3,
            pins_mm3: [0.0; 2],
            body,
        })
    }

    /// Returns the part without its crumbs, drawn on below its floor, so that a cavity in it passes
    /// the floor; `None` for a part that bears on no panel.
    fn drawn_below(&self, part: &Part, wall_mm: f64) -> Result<Option<TriMesh>, CladdingError> {
        let floor = part.region.outline(0, &self.within);
        if !part.is_on_panel() || floor.is_empty() {
            return Ok(None);
        }
        let sum: Vector = floor.iter().map(|p| p.coords).sum();
        // The model holds everything between the floor and this distance above it.
        let deep_mm = self.base.separation().distance_mm - self.gap_mm;
        let middle = Point::from(sum / floor.len() as f64);
        let at = middle + self.normal(part.face) * (0.5 * deep_mm);
        let below = part.region.widened(0, DEPTH_WALLS * wall_mm + DEPTH_MM);
        Ok(body_at(self.bodies_in(&below)?, &at))
    }
}
