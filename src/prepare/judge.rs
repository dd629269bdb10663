//! Judge: what is to be written, held against its promise. The pictures are taken meanwhile.

use super::reason::follows_from_hollowing;
use crate::base::watch::{Phase, Watch};
use crate::error::Error;
use crate::geom::Parting;
use crate::io::stl;
use crate::make::{Packages, packages, repack};
use crate::press::{Drawings, Layout};
use crate::run::{Made, Placed, WrittenJig};
use crate::sheet::Verdict;
use crate::sheet::from_run::{promise, promised_figure};
use crate::verify::{
    Body, Evidence, JigFacts, Judgement, PromisedFigure, checks, is_loose, judge_measured,
    measure_jigs,
};

/// A kit in draft: its parts judged, its pictures taken.
pub struct Draft {
    /// The parts.
    pub made: Made,
    /// The bytes of the uncut result.
    pub hollowed: Vec<u8>,
    /// The 3MF files beside the judged ones.
    pub packages: Packages,
    /// The files as they read back, and their promise.
    pub evidence: Evidence,
    /// The uncut result, taken apart.
    pub body: Body,
    /// The cuts.
    pub cuts: Vec<Parting>,
    /// The findings of the judge.
    pub judgement: Judgement,
    /// The pictures of the parts, and the view that can be turned.
    pub drawings: Drawings,
}

impl Draft {
    /// Returns whether every promise is kept.
    pub fn passes(&self) -> bool {
        Verdict::of(&self.judgement.checks) == Verdict::Pass
    }

    /// Returns whether a promise is broken that depends on how much is hollow.
    pub fn lacks_hollow(&self) -> bool {
        let mut broken = self.judgement.checks.iter().filter(|check| !check.pass);
        broken.any(|check| follows_from_hollowing(&check.kind))
    }

    /// Returns what pictures are taken of: the files as they are written.
    pub fn layout(&self) -> Layout<'_> {
        Layout {
            evidence: &self.evidence,
            body: &self.body,
            cuts: &self.made.plan.cuts,
            partings: &self.cuts,
            uncut: &self.made.plan.uncut,
        }
    }
}

/// Encodes the files of a kit, reads them back and judges them.
pub fn draft(placed: &Placed, made: Made, watch: &Watch) -> Result<Draft, Error> {
    let mut made = repack(placed, made, watch)?;
    watch.enter(Phase::Verify);
    let title = format!("{} hollowed", placed.name());
    let hollowed = stl::encode(&made.hollowed.to_mesh(), &title);
    let mut evidence = Evidence {
        promise: promise(placed, &made),
        hollowed: stl::decode(&hollowed)?,
        parts: made.evidence(),
        jigs: made.jigs.iter().map(WrittenJig::evidence).collect(),
    };
    let body = Body::of(&evidence.hollowed);
    let jigs = measure_jigs(&evidence, &body, watch)?;
    let count = jigs.len();
    let (jigs, firm): (Vec<JigFacts>, Vec<WrittenJig>) = jigs
        .into_iter()
        .zip(std::mem::take(&mut made.jigs))
        .filter(|(jig, _)| !is_loose(jig, &evidence.promise))
        .unzip();
    made.jigs = firm;
    if jigs.len() < count {
        evidence.promise = promise(placed, &made);
        evidence.jigs = made.jigs.iter().map(WrittenJig::evidence).collect();
    }
    let cuts = made.plan.partings()?;
    let layout = Layout {
        evidence: &evidence,
        body: &body,
        cuts: &made.plan.cuts,
        partings: &cuts,
        uncut: &made.plan.uncut,
    };
    let (judgement, (drawings, packages)) = rayon::join(
        || judge_measured(&evidence, &body, jigs, watch),
        || {
            let drawings = || layout.draw_parts(watch);
            rayon::join(drawings, || packages(placed, &made, watch))
        },
    );
    let (mut judgement, drawings, packages) = (judgement?, drawings?, packages?);
    // A buyer may rely on the figure that the written parts reach.
    let figure = promised_figure(placed.goal().kind, placed.goal().objective);
    let reached = judgement.assembly.value_of(figure);
    evidence.promise.promise = reached.map(|value| PromisedFigure { figure, value });
    judgement.checks = checks(&evidence.promise, &judgement);
    Ok(Draft {
        made,
        hollowed,
        packages,
        evidence,
        body,
        cuts,
        judgement,
        drawings,
    })
}
