//! Spread: densities at even steps about a wished one.

use crate::job::{DensityOrder, InfillDensity};

/// Steps of per cent to which the densities between the least and the greatest are rounded: slicers
/// show them as typed.
const STEPS_PER_PERCENT: f64 = 10.0;

/// Returns densities from the least to the greatest, one of which is the wished one. Steps on
/// either side of it are even, and as long as can be on both. Those between are rounded.
pub fn around(order: DensityOrder, wished: InfillDensity, count: usize) -> Vec<f64> {
    let ends = [order.low(), wished, order.high()].map(InfillDensity::ratio);
    let [low, wished, high] = ends;
    let steps = count.saturating_sub(1).max(1);
    let share = (wished - low) / (high - low) * steps as f64;
    let below = match (low < wished, wished < high) {
        (false, _) => 0,
        (_, false) => steps,
        _ => (share.round() as usize).clamp(1, steps.saturating_sub(1).max(1)),
    };
    let steps_per_unit = 100.0 * STEPS_PER_PERCENT;
    let density = |index: usize| match index {
        0 => low,
        _ if index == steps => high,
        _ if index == below => wished,
        _ => {
            let even = if index < below {
                low + (wished - low) * index as f64 / below as f64
            } else {
                wished + (high - wished) * (index - below) as f64 / (steps - below) as f64
            };
            (even * steps_per_unit).round() / steps_per_unit
        }
    };
    (0..=steps).map(density).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_wished_infill_is_always_one_of_the_levels() {
        for wished in ["15%", "16%", "40%", "57.5%", "99%", "100%"] {
            for count in 3..=12 {
                let order = "15%..100%".parse().unwrap();
                let wished: InfillDensity = wished.parse().unwrap();
                let found = around(order, wished, count);
                assert_eq!(found.len(), count);
                assert!(
                    found.contains(&wished.ratio()),
                    "{wished} {count}: {found:?}"
                );
                assert!(
                    found.windows(2).all(|pair| pair[0] < pair[1]),
                    "{wished} {count}: {found:?}"
                );
            }
        }
    }
}
