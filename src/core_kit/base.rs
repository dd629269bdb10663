//! The base of an object: one that is given, grown by planes, or made by the method of the paper.

use super::asked::Asked;
use super::error::CoreRunError;
use super::method::starts_tried;
use crate::base::verdict::Verdict;
use crate::base::watch::{Cancelled, Watch};
use crate::job::base_choice::Polyhedra;
use crate::panels::PanelSet;
use crate::polyhedra::vertices::{StartSolid, VertexRequest, grow_by_vertices, prove_vertices};
use crate::polyhedra::{
    BasePlan, Count, NoPlan, NoRoom, NotInside, Several, Unjoined, grow_polyhedra, grow_polyhedron,
};

/// Samples inside each edge while vertices move.
const SAMPLES_PER_EDGE: usize = 8;

/// A base that is proved.
pub struct Base {
    pub plan: BasePlan,
    /// The yield of the paper's method before its proof, if it made the base.
    pub vertices: Option<ByVertices>,
}

/// A polyhedron of moved vertices, and what its proof cost.
#[derive(Debug, Clone, Copy)]
pub struct ByVertices {
    pub start: StartSolid,
    /// Its volume before the proof, mm³.
    pub volume_mm3: f64,
    /// The least distance of its samples from the surface, mm.
    pub sampled_mm: f64,
    /// The distance that its faces proved, mm.
    pub certified_mm: f64,
    /// The greatest way by which a face moved inward for the proof, mm.
    pub moved_mm: f64,
}

/// A reason why there is no base.
#[derive(Debug)]
pub enum NoBase {
    /// The model is too thin.
    NoRoom(NoRoom),
    /// Polyhedra for which there is room stay apart. Of those that were looked for, so many are
    /// joined; `None` if the base was given.
    Apart {
        apart: Unjoined,
        joined: Option<usize>,
    },
    /// No start of the method of the paper yields a base: why each does not.
    NoStart(Vec<FailedStart>),
}

/// A start from which moved vertices yield no base.
#[derive(Debug)]
pub struct FailedStart {
    pub start: StartSolid,
    pub why: NotFromStart,
}

/// A reason why a start yields no base.
#[derive(Debug)]
pub enum NotFromStart {
    /// Its samples keep the distance at no size.
    NoRoom(NoRoom),
    /// Nothing is left of what it yields when that is proved.
    Unproved { found: ByVertices, why: NotInside },
}

/// Returns the base that is given, or the one that is found.
pub fn base(asked: &Asked, watch: &Watch) -> Result<Verdict<Base, NoBase>, CoreRunError> {
    let plan = match &asked.job.base {
        Some(given) => {
            let text = [given.file.as_str(), given.toml.as_str()];
            BasePlan::from_toml(text, asked.ground, &asked.base, &asked.connector)?
        }
        None if !asked.job.method.is_planes() => return Ok(by_vertices(asked, watch)?),
        None => match by_planes(asked, watch)? {
            Verdict::Found(plan) => plan,
            Verdict::No(why) => return Ok(Verdict::No(why)),
        },
    };
    Ok(match plan.unjoined(asked.ground, &asked.connector) {
        Some(apart) => Verdict::No(NoBase::Apart {
            apart,
            joined: None,
        }),
        None => Verdict::Found(Base {
            plan,
            vertices: None,
        }),
    })
}

/// Returns the base that planes enclose when they have grown.
fn by_planes(asked: &Asked, watch: &Watch) -> Result<Verdict<BasePlan, NoBase>, Cancelled> {
    let count = match asked.job.polyhedra {
        Polyhedra::Exactly(1) => {
            let base = grow_polyhedron(asked.ground, &asked.base, watch)?;
            return Ok(match base {
                Verdict::Found(base) => Verdict::Found(BasePlan::one(base)),
                Verdict::No(why) => Verdict::No(NoBase::NoRoom(why)),
            });
        }
        Polyhedra::Exactly(count) => Count::Exactly(count),
        Polyhedra::Auto => Count::Auto(Polyhedra::Auto.most()),
    };
    let several = Several {
        count,
        connector: asked.connector,
    };
    let grown = grow_polyhedra(asked.ground, &asked.base, &several, watch)?;
    Ok(match grown {
        Verdict::Found(plan) => Verdict::Found(plan),
        Verdict::No(NoPlan::NoRoom(why)) => Verdict::No(NoBase::NoRoom(why)),
        Verdict::No(NoPlan::Unjoined { apart, joined }) => Verdict::No(NoBase::Apart {
            apart,
            joined: Some(joined),
        }),
    })
}

/// Returns the largest base that moved vertices yield and that is proved, of all starts that have
/// no more faces than asked for. A base that gets panels comes before a larger one that gets none.
fn by_vertices(asked: &Asked, watch: &Watch) -> Result<Verdict<Base, NoBase>, Cancelled> {
    let mut best: Option<(bool, Base)> = None;
    let mut failed = Vec::new();
    for start in starts_tried(asked.job) {
        let base = match from_start(asked, start, watch)? {
            Verdict::Found(base) => base,
            Verdict::No(why) => {
                failed.push(FailedStart { start, why });
                continue;
            }
        };
        let mut bodies = base.plan.polyhedra.iter();
        let has_panels = bodies.all(|body| PanelSet::of(body, &asked.panels).is_ok());
        let rank = (has_panels, base.plan.volume_mm3());
        let is_better = best
            .as_ref()
            .is_none_or(|(panels, best)| rank > (*panels, best.plan.volume_mm3()));
        if is_better {
            best = Some((has_panels, base));
        }
    }
    Ok(match best {
        Some((_, base)) => Verdict::Found(base),
        None => Verdict::No(NoBase::NoStart(failed)),
    })
}

/// Moves the vertices of one start, and proves what they yield.
fn from_start(
    asked: &Asked,
    start: StartSolid,
    watch: &Watch,
) -> Result<Verdict<Base, NotFromStart>, Cancelled> {
    let request = VertexRequest {
        distance_mm: asked.base.distance_mm,
        start,
        samples_per_edge: SAMPLES_PER_EDGE,
        room_mm: asked.base.limits.room_mm,
    };
    let grown = match grow_by_vertices(asked.ground, &request, watch)? {
        Verdict::Found(grown) => grown,
        Verdict::No(why) => return Ok(Verdict::No(NotFromStart::NoRoom(why))),
    };
    let found = ByVertices {
        start,
        volume_mm3: grown.volume_mm3,
        sampled_mm: grown.sampled_mm,
        certified_mm: grown.certified_mm,
        moved_mm: 0.0,
    };
    Ok(match prove_vertices(asked.ground, &grown, &asked.base) {
        Ok(proved) => Verdict::Found(Base {
            plan: BasePlan::one(proved.polyhedron),
            vertices: Some(ByVertices {
                moved_mm: proved.moved_mm,
                ..found
            }),
        }),
        Err(why) => Verdict::No(NotFromStart::Unproved { found, why }),
    })
}
