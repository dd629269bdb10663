//! How far beyond what was found on samples the exact columns ask to go.

/// The first excess: a per cent to spare, as what is drawn and cut of a void takes some of it.
const FIRST_EXCESS: f64 = 0.01;
/// The last: a third more. What would need more was found on samples too coarse to mean anything.
const LAST_EXCESS: f64 = 0.32;

/// The least excess that `accepts`, to a per cent, with what it gave; none if a third is not
/// enough.
///
/// Excesses double until one is accepted, then the last two are bisected.
pub(super) fn least_excess<T>(accepts: impl Fn(f64) -> Option<T>) -> Option<T> {
    let (mut refused, mut excess) = (0.0, FIRST_EXCESS);
    let mut accepted = loop {
        match accepts(excess) {
            Some(found) => break found,
            None if excess >= LAST_EXCESS => return None,
            None => (refused, excess) = (excess, 2.0 * excess),
        }
    };
    while excess - refused > 1.5 * FIRST_EXCESS {
        let middle = 0.5 * (refused + excess);
        match accepts(middle) {
            Some(found) => (accepted, excess) = (found, middle),
            None => refused = middle,
        }
    }
    Some(accepted)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_needed_is_found_to_a_per_cent_and_a_half() {
        for needed in [0.0, 0.013, 0.05, 0.1, 0.31] {
            let found = least_excess(|excess| (excess >= needed).then_some(excess)).unwrap();
            assert!(
                found >= needed && found <= needed + 0.015 + 1e-12,
                "{needed}: {found}"
            );
        }
        assert_eq!(
            least_excess(|excess| (excess > 0.4).then_some(excess)),
            None
        );
    }
}
