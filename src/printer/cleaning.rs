//! When a void counts as clean: one rule for each way in which what fills it while printing comes
//! out again.

use serde::{Deserialize, Serialize};

use super::{Grid, Printer, Quantity, Support};

/// The share of a void's wall that must be in sight of its openings where support is broken or
/// flushed out. The rest is a corner that the jet's spray and a bent pick reach; much less, and
/// support stays that nobody knows of.
const SIGHT_RATIO: f64 = 0.95;

/// What must hold of a void for it to be clean (the processes' own rules; see
/// `profiles/processes`).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CleaningRule {
    /// Support that dissolves or melts: any opening of the least size, and no second closed pocket.
    MeltOut,
    /// Support that is broken out or flushed: the wall in sight of the openings and within the
    /// tool's reach.
    InSight,
    /// Filament: the wall in sight and within reach, or printed without support because it leans
    /// little enough.
    InSightOrSelfSupporting,
    /// Powder: an escape opening of the stated size, or two smaller ones where the process allows
    /// that.
    PowderEscape,
}

impl CleaningRule {
    /// The rule in words, for the job sheet.
    pub fn words(self) -> &'static str {
        match self {
            Self::MeltOut => "support melts or dissolves out through any opening",
            Self::InSight => "support is broken or flushed out in sight of the opening",
            Self::InSightOrSelfSupporting => {
                "support is broken out in sight of the opening, and where none is needed nothing has to come out"
            }
            Self::PowderEscape => "powder falls out through an escape opening",
        }
    }

    /// Whether the wall must be seen.
    pub fn needs_sight(self) -> bool {
        matches!(self, Self::InSight | Self::InSightOrSelfSupporting)
    }
}

/// A printer's rule with its numbers. The least opening stands beside it, as the printer's
/// `min_opening_mm`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Cleaning {
    /// The rule.
    pub rule: CleaningRule,
    /// The least share of a void's wall in sight and within reach; 0 where nothing has to be seen.
    pub sight_ratio: f64,
    /// How far into an opening the tool or the jet reaches, mm; none where nothing has to be
    /// reached, or where it is not known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reach_mm: Option<f64>,
    /// The least opening of each where a piece of a void has two or more, mm; none where two are no
    /// better than one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pair_opening_mm: Option<f64>,
    /// Surfaces that look down and lean at least this much from the level need no support, degrees;
    /// none where that does not count.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub overhang_deg: Option<f64>,
}

impl Cleaning {
    /// The rule that asks for an opening and nothing else.
    pub const MELT_OUT: Self = Self {
        rule: CleaningRule::MeltOut,
        sight_ratio: 0.0,
        reach_mm: None,
        pair_opening_mm: None,
        overhang_deg: None,
    };

    /// Whether the openings of a piece of a void (diameters, mm) let out what is in it, where one
    /// alone must be `least_mm` wide.
    pub fn lets_out(&self, openings_mm: &[f64], least_mm: f64) -> bool {
        let wide = |least: f64| openings_mm.iter().filter(|&&mm| mm >= least).count();
        wide(least_mm) > 0
            || self
                .pair_opening_mm
                .is_some_and(|pair_mm| wide(pair_mm) > 1)
    }
}

impl Printer {
    /// The rule by which voids of this printer's parts count as clean, from its support and its
    /// process's numbers.
    pub fn cleaning_rule(&self) -> Cleaning {
        let number = |quantity| self.number(quantity).map(|number| number.value);
        let rule = match (self.support, self.grid) {
            (Support::Soluble, _) => CleaningRule::MeltOut,
            (Support::None, Grid::Pixel) => CleaningRule::PowderEscape,
            (Support::None | Support::Breakaway, Grid::Line) => {
                CleaningRule::InSightOrSelfSupporting
            }
            (Support::Breakaway | Support::WaterJet, _) => CleaningRule::InSight,
        };
        let seen = rule.needs_sight();
        let leans = rule == CleaningRule::InSightOrSelfSupporting;
        let escapes = rule == CleaningRule::PowderEscape;
        Cleaning {
            rule,
            sight_ratio: if seen { SIGHT_RATIO } else { 0.0 },
            reach_mm: number(Quantity::CleaningReachMm).filter(|_| seen),
            pair_opening_mm: number(Quantity::PairOpeningMm).filter(|_| escapes),
            overhang_deg: number(Quantity::OverhangDeg).filter(|_| leans),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rule(id: &str) -> Cleaning {
        Printer::find(id).unwrap().cleaning_rule()
    }

    #[test]
    fn every_process_has_the_rule_of_what_fills_its_voids() {
        for (id, expected) in [
            ("objet-connex350", CleaningRule::InSight),
            ("formlabs-form3", CleaningRule::InSight),
            ("prusa-mk4", CleaningRule::InSightOrSelfSupporting),
            ("ultimaker-s5", CleaningRule::MeltOut),
            ("projet-mjp-2500", CleaningRule::MeltOut),
            ("formlabs-fuse1", CleaningRule::PowderEscape),
            ("hp-mjf-5200", CleaningRule::PowderEscape),
        ] {
            let found = rule(id);
            assert_eq!(found.rule, expected, "{id}");
            assert_eq!(
                found.rule.needs_sight(),
                found.sight_ratio > 0.0 && found.reach_mm.is_some(),
                "{id}"
            );
        }
    }

    #[test]
    fn two_small_openings_let_powder_out_where_the_process_says_so() {
        let (mjf, sls) = (rule("hp-mjf-5200"), rule("formlabs-fuse1"));
        assert!(
            mjf.lets_out(&[2.1, 2.0], 4.0)
                && !mjf.lets_out(&[3.9], 4.0)
                && mjf.lets_out(&[4.0], 4.0)
        );
        assert!(!mjf.lets_out(&[3.9, 1.9], 4.0) && !mjf.lets_out(&[], 4.0));
        assert!(!sls.lets_out(&[4.9, 4.9], 5.0) && sls.lets_out(&[5.0], 5.0));
    }

    #[test]
    fn only_filament_counts_walls_that_need_no_support() {
        assert_eq!(rule("prusa-mk4").overhang_deg, Some(45.0));
        assert_eq!(rule("formlabs-form3").overhang_deg, None);
    }
}
