//! The distance of a kit from the best that its model could reach, and what took it.

use super::Checklist;

/// Share of the best figure from which a sheet says what took it.
const FAR_RATIO: f64 = 0.1;

/// Least share of the best figure that is reported on its own.
const LEAST_TOLD_RATIO: f64 = 0.01;

/// Something for which a part of the goal's figure was given up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Taker {
    /// Voids that could not be cleaned stay solid.
    Cleaning,
    /// The plan keeps something solid: by order, or beyond joints without room for pins.
    Plan,
    /// Bosses stay solid around pins.
    Bosses,
    /// Cuts, pins, ids and rounding change the parts.
    Making,
}

/// A part of the goal's figure, and what took it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Taken {
    /// What took it.
    pub by: Taker,
    /// Its share of the best figure.
    pub ratio: f64,
}

/// The distance of a kit from the best figure with its wall.
#[derive(Debug, Clone, PartialEq)]
pub struct Shortfall {
    /// The best figure: the optimum before anything but the wall was kept solid.
    pub best: f64,
    /// The figure of the kit as written.
    pub reached: f64,
    /// What took the rest, from a hundredth of the best on.
    pub taken: Vec<Taken>,
}

impl Checklist {
    /// Returns what took a tenth or more of the best figure; `None` if the kit is nearer to it, or
    /// an older version wrote it.
    pub fn shortfall(&self) -> Option<Shortfall> {
        let proof = &self.certificate;
        let (best, reached) = (proof.value_before_cleaning?, proof.written_value?);
        let sign = if proof.figure.more_is_better() {
            1.0
        } else {
            -1.0
        };
        let loss_ratio = |before: f64, after: f64| sign * (before - after) / best.abs();
        let kept = |by_plan: bool| {
            let rounds = proof.cleaning_rounds.iter();
            let rounds = rounds.filter(|round| round.by_plan == by_plan);
            let losses =
                rounds.filter_map(|round| Some(loss_ratio(round.value_before, round.value_after?)));
            losses.sum::<f64>()
        };
        let rounds = self.rounds.iter();
        let bosses: f64 = rounds
            .map(|round| loss_ratio(round.before, round.after))
            .sum();
        let [cleaning, plan] = [false, true].map(kept);
        let all = loss_ratio(best, reached);
        let shares = [
            (Taker::Cleaning, cleaning),
            (Taker::Plan, plan),
            (Taker::Bosses, bosses),
            (Taker::Making, all - cleaning - plan - bosses),
        ];
        let taken = shares.into_iter().map(|(by, ratio)| Taken { by, ratio });
        (all >= FAR_RATIO).then(|| Shortfall {
            best,
            reached,
            taken: taken
                .filter(|taken| taken.ratio >= LEAST_TOLD_RATIO)
                .collect(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sheet::{CleaningRow, RoundRow};
    use crate::testing::sample;
    use crate::verify::FigureName;

    /// A stand whose best angle is 10°, of which a kit reaches this much.
    fn stand(reached: f64) -> Checklist {
        let (mut sheet, _) = sample();
        let proof = &mut sheet.certificate;
        proof.figure = FigureName::TopplesDeg;
        (proof.value_before_cleaning, proof.written_value) = (Some(10.0), Some(reached));
        proof.cleaning_rounds.clear();
        sheet.rounds.clear();
        sheet
    }

    fn round(by_plan: bool, before: f64, after: Option<f64>) -> CleaningRow {
        CleaningRow {
            voids: Vec::new(),
            volume_mm3: 1.0,
            value_before: before,
            value_after: after,
            by_plan,
        }
    }

    #[test]
    fn a_kit_near_its_best_says_nothing() {
        assert_eq!(stand(9.1).shortfall(), None);
        let mut old = stand(5.0);
        old.certificate.value_before_cleaning = None;
        assert_eq!(old.shortfall(), None);
    }

    #[test]
    fn what_took_the_rest_is_told_by_its_share() {
        let mut sheet = stand(7.0);
        let undone = round(false, 8.5, None);
        let rounds = [
            round(false, 10.0, Some(8.5)),
            undone,
            round(true, 8.5, Some(8.0)),
        ];
        sheet.certificate.cleaning_rounds.extend(rounds);
        sheet.rounds.push(RoundRow {
            round: 1,
            bosses: Vec::new(),
            kept_solid_mm3: 1.0,
            before: 8.0,
            after: 7.05,
            gap_ratio: 0.0,
        });
        let shortfall = sheet.shortfall().unwrap();
        assert_eq!((shortfall.best, shortfall.reached), (10.0, 7.0));
        let takers: Vec<Taker> = shortfall.taken.iter().map(|taken| taken.by).collect();
        // Half a percent for making is too little to tell.
        assert_eq!(takers, [Taker::Cleaning, Taker::Plan, Taker::Bosses]);
        let ratios: Vec<f64> = shortfall.taken.iter().map(|taken| taken.ratio).collect();
        for (ratio, expected) in ratios.iter().zip([0.15, 0.05, 0.095]) {
            assert!((ratio - expected).abs() < 1e-12, "{ratios:?}");
        }
    }

    #[test]
    fn a_speed_above_the_best_is_a_loss() {
        let mut sheet = stand(12.0);
        sheet.certificate.figure = FigureName::CriticalSpeedRpm;
        let shortfall = sheet.shortfall().unwrap();
        assert_eq!(shortfall.taken.len(), 1);
        assert_eq!(shortfall.taken[0].by, Taker::Making);
        sheet.certificate.written_value = Some(8.0);
        assert_eq!(sheet.shortfall(), None);
    }
}
