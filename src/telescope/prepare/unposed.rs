//! The answer that a pose cannot be.

use crate::wing::{Impossible, Remedy};

/// A pose that cannot be.
#[derive(Debug, Clone, PartialEq)]
pub struct Unposed {
    pub reason: String,
    pub is_proved: bool,
    pub remedies: Vec<Remedy>,
    pub hints: Vec<String>,
}

impl Unposed {
    /// Returns the answer that something is in the way of a pose.
    pub fn barred(name: &str, why: &str) -> Self {
        Self {
            reason: format!("no order that was tried is free on the way to pose {name}: {why}"),
            is_proved: false,
            remedies: Vec::new(),
            hints: vec!["ask for another pose, or for a place to the side of it".to_owned()],
        }
    }

    /// Returns the answer of a line.
    pub fn impossible<M: Default>(self) -> Impossible<M> {
        Impossible {
            is_proved: self.is_proved,
            remedies: self.remedies,
            hints: self.hints,
            ..Impossible::new(self.reason)
        }
    }
}
