//! The judgement of toolpaths.

use serde::Serialize;

use super::cause::Cause;
use super::part::PrintedPart;
use crate::mass::Moments;
use crate::verify::{Check, CheckKind, Figures, PromisedFigure};

/// The judgement of a kit's toolpaths: how they will balance, beside the promise.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PrintedJudgement {
    /// The files, one for each plate.
    pub files: Vec<PrintedFile>,
    /// The parts that are printed, in the order of the checklist.
    pub parts: Vec<PrintedPart>,
    /// The parts that are in no file.
    pub missing: Vec<String>,
    /// The figure promised to the buyer, if the goal has one.
    pub promise: Option<PromisedFigure>,
    /// The figures of the model: the uncut result with its ballast.
    pub model: Figures,
    /// The figures of the parts as written, put together.
    pub written: Figures,
    /// The figures of the toolpaths put together, with all that the kit adds to the parts; `None`
    /// if parts are missing.
    pub toolpaths: Option<Figures>,
    /// The moments of what the toolpaths lay beyond the written parts, in volumes of the kit's
    /// material and the model frame; `None` if parts are missing.
    #[serde(skip)]
    pub beyond: Option<Moments>,
    /// The moments of what the slicer of a hollow kit is said to lay beyond its parts, model frame,
    /// g to g·mm². Those of one piece count in its part.
    #[serde(skip)]
    pub stated_g: Moments,
    /// The causes of a wrong print.
    pub causes: Vec<Cause>,
    /// Assumptions, and what was left out.
    pub notes: Vec<String>,
    /// Every promise with its verdict.
    pub checks: Vec<Check>,
}

/// A plate of toolpaths as its slicer describes it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PrintedFile {
    /// The file, with the number of its plate if it has several.
    pub name: String,
    /// The slicer with its version; `None` if it is not named.
    pub slicer: Option<String>,
    /// The parts and jigs in it.
    pub holds: Vec<String>,
    /// The densities with which its tools are weighed, g/cm³, and whether the file states them.
    pub density_g_cm3: Vec<f64>,
    /// Whether the file states these densities. Otherwise the kit's is taken.
    pub is_density_stated: bool,
    /// The estimated time of the print, s.
    pub print_time_s: Option<f64>,
}

impl PrintedJudgement {
    /// Returns true if every promise is kept.
    pub fn passes(&self) -> bool {
        self.checks.iter().all(|check| check.pass)
    }

    /// Returns the demands of the goal that the toolpaths do not meet, whatever they weigh.
    pub fn broken_goals(&self) -> impl Iterator<Item = &Check> {
        let of_print = [
            CheckKind::PrintedParts,
            CheckKind::PrintedShapes,
            CheckKind::PrintedSettings,
            CheckKind::PrintedMass,
            CheckKind::PrintedCenters,
        ];
        let is_figure = |kind: &CheckKind| matches!(kind, CheckKind::PromisedFigure { .. });
        let broken = self.checks.iter().filter(|check| !check.pass);
        broken.filter(move |check| !of_print.contains(&check.kind) && !is_figure(&check.kind))
    }
}
