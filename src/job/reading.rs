//! Reads values of a job that must be sound before anything else is done.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

use crate::goal::Request;

/// Reads a factor that is finite and above zero.
pub(super) fn read_positive<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    match f64::deserialize(deserializer)? {
        factor if factor.is_finite() && factor > 0.0 => Ok(factor),
        factor => Err(D::Error::custom(format!(
            "{factor} is not a positive, finite factor"
        ))),
    }
}

/// Reads a goal that makes sense by itself.
pub(super) fn read_goal<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Request, D::Error> {
    Request::deserialize(deserializer)?
        .validate()
        .map_err(D::Error::custom)
}
