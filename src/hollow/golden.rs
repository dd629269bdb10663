//! The golden-section search for the peak of a unimodal quantity.

/// (√5 − 1)/2, the share of a range that each round keeps.
const SHARE: f64 = 0.618_033_988_749_894_9;

/// Searches a range for a peak by golden section; returns the last two samples.
///
/// Costs `rounds` + 2 calls of `sample`, and each round leaves 0.618 of the range. `is_better`
/// compares two samples. If the quantity has a single peak, it stays in the range (Kiefer, Proc.
/// AMS 4, 1953).
pub fn golden_section<T>(
    [mut low, mut high]: [f64; 2],
    rounds: usize,
    sample: impl Fn(f64) -> T,
    is_better: impl Fn(&T, &T) -> bool,
) -> [T; 2] {
    let sample_at = |place: f64| (place, sample(place));
    let mut left = sample_at(high - SHARE * (high - low));
    let mut right = sample_at(low + SHARE * (high - low));
    for _ in 0..rounds {
        if is_better(&left.1, &right.1) {
            high = right.0;
            right = left;
            left = sample_at(high - SHARE * (high - low));
        } else {
            low = left.0;
            left = right;
            right = sample_at(low + SHARE * (high - low));
        }
    }
    [left.1, right.1]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_top_of_a_parabola_is_found_to_the_share_that_the_rounds_leave() {
        for peak in [-0.9, 0.0, 0.3, 0.99] {
            let sample = |x: f64| (x, -(x - peak) * (x - peak));
            let found = golden_section([-1.0, 1.0], 20, sample, |a, b| a.1 > b.1);
            let left = 2.0 * SHARE.powi(20);
            assert!(
                found.iter().all(|(x, _)| (x - peak).abs() <= left),
                "{peak}: {found:?}"
            );
        }
    }
}
