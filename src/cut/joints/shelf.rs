//! A shelf for the sketches of jigs: a plan is asked for its jigs when ways are compared, and again
//! when parts are made.

use std::collections::BTreeMap;
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use super::sketch::Held;
use crate::base::digest::sha256_hex;

/// The jigs that were found so far, by the digest of all that they depend on. Clones share it.
///
/// It saves work and changes no answer.
#[derive(Clone, Default)]
pub struct JigShelf(Arc<Mutex<BTreeMap<String, Option<Held>>>>);

impl JigShelf {
    /// Returns what was found before for the same numbers, or finds it.
    pub(super) fn keep<E>(
        &self,
        numbers: impl IntoIterator<Item = f64>,
        find: impl FnOnce() -> Result<Option<Held>, E>,
    ) -> Result<Option<Held>, E> {
        let bytes: Vec<u8> = numbers.into_iter().flat_map(f64::to_le_bytes).collect();
        let key = sha256_hex(&[&bytes]);
        let known = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(held) = known().get(&key) {
            return Ok(held.clone());
        }
        let held = find()?;
        known().insert(key, held.clone());
        Ok(held)
    }
}

impl fmt::Debug for JigShelf {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("JigShelf")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_numbers_are_found_once_and_others_anew() {
        let shelf = JigShelf::default();
        let shared = shelf.clone();
        let mut count = 0;
        let mut find = |shelf: &JigShelf, numbers: [f64; 2]| {
            let found = shelf.keep(numbers, || {
                count += 1;
                Ok::<_, ()>(None)
            });
            assert!(found.is_ok_and(|found| found.is_none()));
        };
        find(&shelf, [1.0, 2.0]);
        find(&shared, [1.0, 2.0]);
        find(&shelf, [2.0, 1.0]);
        assert_eq!(count, 2);
    }

    #[test]
    fn a_fault_is_not_kept() {
        let shelf = JigShelf::default();
        assert!(shelf.keep([1.0], || Err("stopped")).is_err());
        assert!(shelf.keep([1.0], || Ok::<_, ()>(None)).is_ok());
    }
}
