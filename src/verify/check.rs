//! One promise held against what was measured.

use serde::{Deserialize, Serialize};

/// How a value is held against its limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Comparison {
    /// value ≤ limit.
    AtMost,
    /// value ≥ limit.
    AtLeast,
    /// value < limit.
    Below,
    /// value > limit.
    Above,
}

impl Comparison {
    /// Whether `value` keeps the limit; never if it is not a number.
    pub fn holds(self, value: f64, limit: f64) -> bool {
        match self {
            Self::AtMost => value <= limit,
            Self::AtLeast => value >= limit,
            Self::Below => value < limit,
            Self::Above => value > limit,
        }
    }

    /// The sign a person reads: ≤, ≥, < or >.
    pub fn sign(self) -> &'static str {
        match self {
            Self::AtMost => "≤",
            Self::AtLeast => "≥",
            Self::Below => "<",
            Self::Above => ">",
        }
    }
}

/// One line of the verdict: promise, measured value, limit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Check {
    /// A short name, unique in the list.
    pub name: String,
    /// What was promised, in words.
    pub promise: String,
    /// What was measured; none if there is no such number (the critical speed of a top that cannot
    /// spin).
    pub value: Option<f64>,
    /// What it is held against.
    pub limit: f64,
    /// The unit of value and limit; empty for counts and ratios.
    pub unit: String,
    /// How it is held against it.
    pub comparison: Comparison,
    /// Whether the promise is kept.
    pub pass: bool,
    /// Where the value was found, or what is wrong there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub detail: Option<String>,
}

/// A limit as it is written in a list of checks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit {
    /// How a value is held against it.
    pub comparison: Comparison,
    /// The limit itself.
    pub value: f64,
    /// Its unit.
    pub unit: &'static str,
}

impl Limit {
    /// value ≤ limit.
    pub const fn at_most(value: f64, unit: &'static str) -> Self {
        Self {
            comparison: Comparison::AtMost,
            value,
            unit,
        }
    }

    /// value ≥ limit.
    pub const fn at_least(value: f64, unit: &'static str) -> Self {
        Self {
            comparison: Comparison::AtLeast,
            value,
            unit,
        }
    }

    /// value < limit.
    pub const fn below(value: f64, unit: &'static str) -> Self {
        Self {
            comparison: Comparison::Below,
            value,
            unit,
        }
    }

    /// value > limit.
    pub const fn above(value: f64, unit: &'static str) -> Self {
        Self {
            comparison: Comparison::Above,
            value,
            unit,
        }
    }
}

impl Check {
    /// Holds `value` against `limit`. A value that is missing, infinite or not a number fails and
    /// is kept as none, so that no such number reaches a file.
    pub fn new(name: &str, promise: &str, value: Option<f64>, limit: Limit) -> Self {
        let value = value.filter(|value| value.is_finite());
        Self {
            name: name.to_owned(),
            promise: promise.to_owned(),
            value,
            limit: limit.value,
            unit: limit.unit.to_owned(),
            comparison: limit.comparison,
            pass: value.is_some_and(|value| limit.comparison.holds(value, limit.value)),
            detail: None,
        }
    }

    /// The same check with a word on where its value was found.
    #[must_use]
    pub fn at(mut self, detail: Option<String>) -> Self {
        self.detail = detail;
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_limit_met_exactly_is_kept_by_at_most_and_at_least_and_broken_by_below_and_above() {
        let pass = |limit| Check::new("n", "p", Some(1.0), limit).pass;
        assert!(pass(Limit::at_most(1.0, "mm")) && pass(Limit::at_least(1.0, "mm")));
        assert!(!pass(Limit::below(1.0, "")) && !pass(Limit::above(1.0, "")));
    }

    #[test]
    fn what_cannot_be_measured_fails_whatever_the_limit() {
        for value in [
            None,
            Some(f64::NAN),
            Some(f64::INFINITY),
            Some(f64::NEG_INFINITY),
        ] {
            for limit in [
                Limit::at_most(1.0, ""),
                Limit::at_least(1.0, ""),
                Limit::below(1.0, ""),
            ] {
                let check = Check::new("n", "p", value, limit);
                assert_eq!((check.pass, check.value), (false, None));
            }
        }
    }
}
