//! The base of an object: one that is given, grown by planes, or made by the method of the paper.

use super::asked::Asked;
use super::error::CoreRunError;
use super::method::fewer_than_start;
use crate::base::verdict::Verdict;
use crate::base::watch::{Cancelled, Watch};
use crate::job::base_choice::Polyhedra;
use crate::polyhedra::vertices::{StartSolid, VertexRequest, grow_by_vertices, prove_vertices};
use crate::polyhedra::{
    BasePlan, Count, NoPlan, NoRoom, Several, Unjoined, grow_polyhedra, grow_polyhedron,
};

/// Samples inside each edge while vertices move. More change the volume by less than 1 %.
const SAMPLES_PER_EDGE: usize = 8;

/// A base that is proved.
pub struct Base {
    pub plan: BasePlan,
    /// What the method of the paper yielded before its proof, if it made the base.
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
    /// Nothing is left of what the method of the paper yields when it is proved.
    Unproved(ByVertices),
}

/// Returns the base that is given, or the one that is found.
pub fn base(asked: &Asked, watch: &Watch) -> Result<Verdict<Base, NoBase>, CoreRunError> {
    let plan = match &asked.job.base {
        Some(given) => {
            let text = [given.file.as_str(), given.toml.as_str()];
            BasePlan::from_toml(text, asked.ground, &asked.base, &asked.connector)?
        }
        None if !asked.job.method.is_planes() => return by_vertices(asked, watch),
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
/// no more faces than asked for.
fn by_vertices(asked: &Asked, watch: &Watch) -> Result<Verdict<Base, NoBase>, CoreRunError> {
    let starts = asked.job.method.starts().into_iter();
    let mut best: Option<Verdict<Base, NoBase>> = None;
    for start in starts.filter(|start| start.face_count() <= asked.job.faces) {
        let found = from_start(asked, start, watch)?;
        let volume_mm3 = |verdict: &Verdict<Base, NoBase>| match verdict {
            Verdict::Found(base) => base.plan.volume_mm3(),
            Verdict::No(_) => 0.0,
        };
        let is_better = best
            .as_ref()
            .is_none_or(|best| volume_mm3(&found) > volume_mm3(best));
        if is_better {
            best = Some(found);
        }
    }
    best.map_or_else(|| Err(fewer_than_start(asked.job)), Ok)
}

/// Moves the vertices of one start, and proves what they yield.
fn from_start(
    asked: &Asked,
    start: StartSolid,
    watch: &Watch,
) -> Result<Verdict<Base, NoBase>, Cancelled> {
    let request = VertexRequest {
        distance_mm: asked.base.distance_mm,
        start,
        samples_per_edge: SAMPLES_PER_EDGE,
    };
    let grown = match grow_by_vertices(asked.ground, &request, watch)? {
        Verdict::Found(grown) => grown,
        Verdict::No(why) => return Ok(Verdict::No(NoBase::NoRoom(why))),
    };
    let before = ByVertices {
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
                ..before
            }),
        }),
        Err(_) => Verdict::No(NoBase::Unproved(before)),
    })
}
