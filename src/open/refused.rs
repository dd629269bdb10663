//! Plans that the planner refuses.

use crate::cut::CutError;
use crate::error::Error;

/// Returns `None` if the planner finds no plan: the rungs before it stand.
pub fn unless_refused<T>(way: Result<T, Error>) -> Result<Option<T>, Error> {
    match way {
        Ok(way) => Ok(Some(way)),
        Err(Error::Cut(CutError::Obstacle(_))) => Ok(None),
        Err(error) => Err(error),
    }
}
