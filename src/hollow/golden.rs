//! The golden section: the best of a quantity with one peak, in as few looks as its order allows.

/// (√5 − 1)/2, the share of a range that each round keeps.
const SHARE: f64 = 0.618_033_988_749_894_9;

/// The two inner places of the range that `rounds` of golden section leave, as `look` sees them;
/// `is_better` tells of two which side the best lies on.
///
/// Each round costs one look and leaves 0.618 of the range; with one best place in it, that stays
/// inside (Kiefer, Proc. AMS 4, 1953). The place of a look is `at(&look)`.
pub fn golden_section<T>(
    [mut low, mut high]: [f64; 2],
    rounds: usize,
    look: impl Fn(f64) -> T,
    (at, is_better): (impl Fn(&T) -> f64, impl Fn(&T, &T) -> bool),
) -> [T; 2] {
    let (mut left, mut right) = (
        look(high - SHARE * (high - low)),
        look(low + SHARE * (high - low)),
    );
    for _ in 0..rounds {
        if is_better(&left, &right) {
            high = at(&right);
            right = left;
            left = look(high - SHARE * (high - low));
        } else {
            low = at(&left);
            left = right;
            right = look(low + SHARE * (high - low));
        }
    }
    [left, right]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_top_of_a_parabola_is_found_to_the_share_that_the_rounds_leave() {
        for peak in [-0.9, 0.0, 0.3, 0.99] {
            let look = |x: f64| (x, -(x - peak) * (x - peak));
            let found = golden_section(
                [-1.0, 1.0],
                20,
                look,
                (|l: &(f64, f64)| l.0, |a, b| a.1 > b.1),
            );
            let left = 2.0 * SHARE.powi(20);
            assert!(
                found.iter().all(|(x, _)| (x - peak).abs() <= left),
                "{peak}: {found:?}"
            );
        }
    }
}
