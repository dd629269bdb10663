//! One promise held against what was measured.

use serde::{Deserialize, Serialize, Serializer};

use super::CheckKind;

/// The comparison that a value must satisfy with its limit.
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
    /// Returns true if `value` keeps the limit; NaN never does.
    pub fn holds(self, value: f64, limit: f64) -> bool {
        match self {
            Self::AtMost => value <= limit,
            Self::AtLeast => value >= limit,
            Self::Below => value < limit,
            Self::Above => value > limit,
        }
    }

    /// Returns the sign for people: ≤, ≥, < or >.
    pub fn sign(self) -> &'static str {
        match self {
            Self::AtMost => "≤",
            Self::AtLeast => "≥",
            Self::Below => "<",
            Self::Above => ">",
        }
    }
}

/// One line of the verdict: a promise, the measured value and its limit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Check {
    /// The kind of promise. JSON has its English name beside it, as `name`.
    #[serde(flatten, serialize_with = "with_name")]
    pub kind: CheckKind,
    /// The promise in words.
    pub promise: String,
    /// The measured value, or `None` if there is no such number, such as the critical speed of a
    /// top that cannot spin.
    pub value: Option<f64>,
    /// The limit it is compared with.
    pub limit: f64,
    /// The unit of value and limit; empty for counts and ratios.
    pub unit: String,
    /// The comparison with the limit.
    pub comparison: Comparison,
    /// True if the promise is kept.
    pub pass: bool,
    /// The place where the value was found, or the faults found there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub detail: Option<String>,
}

/// A limit of a check.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit {
    /// The comparison of a value with it.
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
    /// Compares `value` with `limit`. A missing, infinite or NaN value fails and becomes `None`, so
    /// that no such number reaches a file.
    pub fn new(kind: CheckKind, promise: &str, value: Option<f64>, limit: Limit) -> Self {
        let value = value.filter(|value| value.is_finite());
        Self {
            kind,
            promise: promise.to_owned(),
            value,
            limit: limit.value,
            unit: limit.unit.to_owned(),
            comparison: limit.comparison,
            pass: value.is_some_and(|value| limit.comparison.holds(value, limit.value)),
            detail: None,
        }
    }

    /// Returns the same check with a detail: the place of its value, or the faults.
    #[must_use]
    pub fn at(mut self, detail: Option<String>) -> Self {
        self.detail = detail;
        self
    }
}

/// Writes a kind together with its English name.
fn with_name<S: Serializer>(kind: &CheckKind, serializer: S) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct Named<'a> {
        name: String,
        #[serde(flatten)]
        kind: &'a CheckKind,
    }
    let name = kind.to_string();
    Named { name, kind }.serialize(serializer)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_limit_met_exactly_is_kept_if_inclusive_and_broken_if_strict() {
        let pass = |limit| Check::new(CheckKind::Wall, "p", Some(1.0), limit).pass;
        assert!(pass(Limit::at_most(1.0, "mm")) && pass(Limit::at_least(1.0, "mm")));
        assert!(!pass(Limit::below(1.0, "")) && !pass(Limit::above(1.0, "")));
    }

    #[test]
    fn a_value_that_cannot_be_measured_fails_whatever_the_limit() {
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
                let check = Check::new(CheckKind::Wall, "p", value, limit);
                assert_eq!((check.pass, check.value), (false, None));
            }
        }
    }

    #[test]
    fn a_check_is_written_with_its_name_and_kind_and_read_back_from_the_kind() {
        let kind = CheckKind::VoidOpen { void: "V1".into() };
        let check = Check::new(kind, "p", Some(1.5), Limit::at_least(1.0, "mm"));
        let text = serde_json::to_string(&check).unwrap();
        assert_eq!(
            text,
            r#"{"name":"void V1 open","kind":"void-open","void":"V1","promise":"p","value":1.5,"#
                .to_owned()
                + r#""limit":1.0,"unit":"mm","comparison":"at_least","pass":true}"#
        );
        assert_eq!(serde_json::from_str::<Check>(&text).unwrap(), check);
    }
}
