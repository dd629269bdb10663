//! A remedy as a value: the change, the options to set, and the solve that shows that it helps.

use serde::Serialize;

use super::reached::Reached;
use super::sampled_model::{CONFIRMING_COLUMNS, Trial};
use crate::base::setting::Setting;
use crate::goal::Footing;

/// The kind of change.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// Make the model larger, with the same wall; mm of its longest side.
    LeastSize,
    /// Make the wall thinner, at the same size; mm.
    GreatestWall,
    /// Move the contact point of a top; by mm.
    NearestContact,
    /// Move the spin point of a yo-yo; by mm.
    NearestSpinPoint,
    /// Tilt the axis; by degrees.
    NearestAxis,
    /// Turn the model until it stands on another face; by degrees.
    NearestFace,
    /// Put steel inside; g.
    LeastBallast,
}

impl Kind {
    /// Returns true if the change moves the contact or the axis, which brings warnings of its own.
    fn moves(self) -> bool {
        matches!(
            self,
            Self::NearestContact | Self::NearestAxis | Self::NearestFace
        )
    }

    /// Returns the unit of the amount.
    fn unit(self) -> &'static str {
        match self {
            Self::NearestAxis | Self::NearestFace => "°",
            Self::LeastBallast => "g",
            _ => "mm",
        }
    }
}

/// The solve that confirmed a remedy: a fresh one, on exact columns, with the numbers that are
/// printed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Confirmation {
    /// Columns along the longer side of the model, seen along the axis.
    pub columns_a_side: usize,
    /// Columns in all.
    pub columns: usize,
    /// The value that the goal reaches.
    pub reached: Reached,
    /// The gap of the certificate, as a part of the value.
    pub gap_ratio: f64,
    /// The residual of the constraints, in the solver's normalised units.
    pub residual: f64,
}

impl Confirmation {
    fn of(trial: &Trial) -> Self {
        let certificate = &trial.solution.certificate;
        Self {
            columns_a_side: CONFIRMING_COLUMNS,
            columns: trial.columns,
            reached: Reached::of(&trial.solution.certificate),
            gap_ratio: certificate.gap_ratio,
            residual: certificate.residual,
        }
    }
}

/// A change that helps.
pub(super) struct Change {
    /// The new value, or the amount of the change.
    pub amount: f64,
    /// The options to set in place of those given.
    pub settings: Vec<Setting>,
    /// The sentence for the user.
    pub words: String,
}

/// One change that makes an impossible goal possible, or the finding that this kind of change does
/// not.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Remedy {
    /// The kind of change.
    pub kind: Kind,
    /// The new value, or the amount of the change; `None` if it does not help.
    pub amount: Option<f64>,
    /// The unit of the amount: mm, ° or g.
    pub unit: &'static str,
    /// The options to set in place of those given; empty if nothing helps.
    pub settings: Vec<Setting>,
    /// The sentence for the user; the words for what was tried if nothing helps.
    pub words: String,
    /// The solve that shows that it helps.
    pub confirmed: Option<Confirmation>,
}

impl Remedy {
    /// Returns true if it helps.
    pub fn helps(&self) -> bool {
        self.confirmed.is_some()
    }

    /// Returns a remedy that helps, as `trial` shows. The value then reached, and the warnings of a
    /// new place, are appended to the words.
    pub(super) fn helping(kind: Kind, change: Change, trial: &Trial) -> Self {
        let confirmed = Confirmation::of(trial);
        let warnings = if kind.moves() {
            &trial.placement.warnings[..]
        } else {
            &[]
        };
        let appended = warnings.iter().map(|warning| format!("; {warning}"));
        let footing = trial.placement.footing.as_ref();
        let tip = footing.and_then(Footing::tip);
        let words = format!(
            "{}; it then {}{}{}",
            change.words,
            confirmed.reached,
            tip.map_or(String::new(), |tip| format!(" on a tip of {tip}")),
            appended.collect::<String>()
        );
        Self {
            kind,
            amount: Some(change.amount),
            unit: kind.unit(),
            settings: change.settings,
            words,
            confirmed: Some(confirmed),
        }
    }

    /// Returns the remedy of a kind of change that does not help; `words` name what was tried.
    pub fn dead_end(kind: Kind, words: String) -> Self {
        Self {
            kind,
            amount: None,
            unit: kind.unit(),
            settings: Vec::new(),
            words,
            confirmed: None,
        }
    }
}
