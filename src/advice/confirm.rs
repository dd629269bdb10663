//! The excess over an answer from samples that the exact columns ask for.

/// The first excess: one per cent, because drawing and cutting the voids costs some of it.
const FIRST_EXCESS: f64 = 0.01;
/// The last excess: about a third. If an answer needs more, the samples were too coarse for it.
const LAST_EXCESS: f64 = 0.32;

/// Returns the result of the least excess, to a per cent and a half, that `accepts` accepts. `None`
/// if a third is not enough.
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
    fn the_needed_excess_is_found_to_a_per_cent_and_a_half() {
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
