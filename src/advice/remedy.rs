//! A remedy as a value: what to change, to what, what to type, and the solve that shows that it
//! helps.

use serde::Serialize;

use super::ground::{CONFIRMING_COLUMNS, Trial};
use super::reached::Reached;

/// What is to be changed.
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
    /// Whether the contact or the axis gets another place, with warnings of its own.
    fn moves(self) -> bool {
        matches!(
            self,
            Self::NearestContact | Self::NearestAxis | Self::NearestFace
        )
    }

    /// The unit of the amount.
    fn unit(self) -> &'static str {
        match self {
            Self::NearestAxis | Self::NearestFace => "°",
            Self::LeastBallast => "g",
            _ => "mm",
        }
    }
}

/// The solve that confirmed a remedy: from nothing, on exact columns, with the numbers that are
/// printed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Confirmation {
    /// Columns along the longer side of the model, seen along the axis.
    pub columns_a_side: usize,
    /// Columns in all.
    pub columns: usize,
    /// What the goal reaches.
    pub reached: Reached,
    /// The gap of the certificate, as a part of the value.
    pub gap_ratio: f64,
    /// How far the constraints are from met, in the solver's normalised units.
    pub residual: f64,
}

impl Confirmation {
    fn of(trial: &Trial) -> Self {
        let certificate = &trial.solution.certificate;
        Self {
            columns_a_side: CONFIRMING_COLUMNS,
            columns: trial.columns,
            reached: Reached::of(trial),
            gap_ratio: certificate.gap_ratio,
            residual: certificate.residual,
        }
    }
}

/// One way to make an impossible goal possible, or the finding that this way leads nowhere.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Remedy {
    /// What is to be changed.
    pub kind: Kind,
    /// To what, or by how much; none where this way leads nowhere.
    pub amount: Option<f64>,
    /// The unit of the amount: mm, ° or g.
    pub unit: &'static str,
    /// What to type in place of what was typed; empty where nothing helps, and for ballast.
    pub flags: String,
    /// The sentence for a maker.
    pub words: String,
    /// The solve that shows that it helps.
    pub confirmed: Option<Confirmation>,
}

impl Remedy {
    /// Whether it helps.
    pub fn helps(&self) -> bool {
        self.confirmed.is_some()
    }

    /// A way that helps; `trial` shows it. The words tell what to do, and get what is then reached
    /// and what a new place warns of.
    pub(super) fn found(
        kind: Kind,
        amount: f64,
        [flags, words]: [String; 2],
        trial: &Trial,
    ) -> Self {
        let confirmed = Confirmation::of(trial);
        let warnings = if kind.moves() {
            &trial.placement.warnings[..]
        } else {
            &[]
        };
        let warned = warnings.iter().map(|warning| format!("; {warning}"));
        let words = format!(
            "{words}; it then {}{}",
            confirmed.reached,
            warned.collect::<String>()
        );
        Self {
            kind,
            amount: Some(amount),
            unit: kind.unit(),
            flags,
            words,
            confirmed: Some(confirmed),
        }
    }

    /// A way that leads nowhere.
    pub(super) fn nothing(kind: Kind, words: String) -> Self {
        Self {
            kind,
            amount: None,
            unit: kind.unit(),
            flags: String::new(),
            words,
            confirmed: None,
        }
    }
}
