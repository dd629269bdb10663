//! Facts about plugs: each fits its drain hole with its gap.

use serde::Serialize;

use super::part_probe::PartProbe;
use super::{Body, PartEvidence, Promise, PromisedHole};
use crate::base::watch::{Cancelled, Watch};
use crate::geom::Vector;
use crate::mesh::{Csg, TriMesh, least_distance_mm};

/// A plug as it was found, beside the part with its hole.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlugFacts {
    /// The name of its part, such as `P02`.
    pub part: String,
    /// The hole that it closes, such as `D1`.
    pub hole: String,
    /// The least distance from the other parts, mm; `None` if there is no such part.
    pub gap_mm: Option<f64>,
    /// The stated gap, mm.
    pub ordered_gap_mm: f64,
    /// Length by which it is wider than the narrowest place of the hole, on each side, mm.
    pub hold_mm: f64,
    /// The volume that it should have by the stated numbers, mm³.
    pub volume_mm3: f64,
}

impl Promise {
    /// Returns whether a part is stated to be a plug.
    pub(super) fn is_plug(&self, part: &str) -> bool {
        self.hole_of_plug(part).is_some()
    }

    /// Returns the unit way in which a plug goes in, model frame; `None` for other parts.
    pub(super) fn way_of_plug(&self, part: &str) -> Option<Vector> {
        let hole = self.hole_of_plug(part)?;
        let along = Vector::from(hole.to_mm) - Vector::from(hole.from_mm);
        along.try_normalize(f64::EPSILON)
    }

    fn hole_of_plug(&self, part: &str) -> Option<&PromisedHole> {
        let is_own =
            |hole: &&PromisedHole| hole.plug.as_ref().is_some_and(|plug| plug.part == part);
        self.drains.iter().find(is_own)
    }
}

/// Returns probes of the parts that are no plugs; `None` if no part is one.
pub(super) fn unplugged<'a>(
    promise: &Promise,
    parts: &'a [PartEvidence],
) -> Option<Vec<PartProbe<'a>>> {
    let is_plug = |part: &&PartEvidence| promise.is_plug(&part.id);
    parts.iter().any(|part| is_plug(&part)).then(|| {
        let bodies = parts.iter().filter(|part| !is_plug(part));
        bodies.map(PartProbe::new).collect()
    })
}

/// A plug as the stated numbers make it.
#[derive(Debug, Clone)]
pub(super) struct MeantPlug {
    /// The name of its part.
    pub(super) part: String,
    /// The hole that it closes.
    pub(super) hole: String,
    /// Its surface, model frame.
    pub(super) mesh: TriMesh,
    /// Length by which it is wider than the narrowest place of the hole, on each side, mm.
    pub(super) hold_mm: f64,
}

/// Returns the stated plugs of a body, whose solid is `whole`, as they should be. Those whose
/// numbers bound none are left out.
pub(super) fn meant_plugs(promise: &Promise, body: &Body, whole: &Csg) -> Vec<MeantPlug> {
    let Some(outer) = Csg::of_mesh(&body.outer).ok() else {
        return Vec::new();
    };
    let meant = promise.drains.iter().filter_map(|hole| {
        let part = hole.plug.as_ref()?.part.clone();
        let mesh = hole.plug_in(&outer)?;
        Some(MeantPlug {
            part,
            hole: hole.id.clone(),
            hold_mm: hole.hold_mm(&mesh, whole)?,
            mesh,
        })
    });
    meant.collect()
}

/// Measures the stated plugs beside what they should be, in the order of their holes.
pub(super) fn measure_plugs(
    promise: &Promise,
    meant: &[MeantPlug],
    probes: &[PartProbe],
    watch: &Watch,
) -> Result<Vec<PlugFacts>, Cancelled> {
    let measure = |hole: &PromisedHole| {
        watch.check()?;
        let Some(plug) = &hole.plug else {
            return Ok(None);
        };
        // A part that is said to close two holes closes neither.
        let named = promise.drains.iter().filter_map(|hole| hole.plug.as_ref());
        let is_single = named.filter(|other| other.part == plug.part).count() == 1;
        let own = probes.iter().find(|probe| probe.part.id == plug.part);
        let own = own.filter(|_| is_single);
        let meant = meant.iter().find(|meant| meant.hole == hole.id);
        Ok(Some(PlugFacts {
            part: plug.part.clone(),
            hole: hole.id.clone(),
            gap_mm: own.map(|own| gap_mm(own, probes)),
            ordered_gap_mm: plug.gap_mm,
            hold_mm: meant.map_or(0.0, |meant| meant.hold_mm),
            volume_mm3: meant.map_or(0.0, |meant| meant.mesh.signed_volume_mm3()),
        }))
    };
    let facts = promise.drains.iter().map(measure);
    let facts = facts.collect::<Result<Vec<_>, Cancelled>>()?;
    Ok(facts.into_iter().flatten().collect())
}

/// Returns the least distance of a part from all others, mm.
fn gap_mm(own: &PartProbe, probes: &[PartProbe]) -> f64 {
    let others = probes.iter().filter(|other| other.part.id != own.part.id);
    let distances = others.map(|other| {
        let into_other = |p: &_| other.part.pose.to_print(&own.part.pose.to_model(p));
        let moved = own.part.mesh.map_vertices(into_other);
        least_distance_mm(&other.surface, &moved)
    });
    distances.fold(f64::INFINITY, f64::min)
}
