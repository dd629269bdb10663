//! The rules by which a void counts as clean: one for each way in which support, resin or powder
//! comes out of it.

use serde::{Deserialize, Serialize};

use super::{Grid, Printer, Quantity, Support};

/// Least share of a void's wall that must be visible from its openings if support is broken or
/// flushed out.
///
/// A water jet's spray and a bent pick reach the rest around a corner. With a much smaller share,
/// support stays in the void unnoticed.
const SIGHT_RATIO: f64 = 0.95;

/// The condition for a clean void, by process (see `profiles/processes`).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CleaningRule {
    /// Support that dissolves or melts: an opening of the least size, and no other closed pocket.
    MeltOut,
    /// Support that is broken or flushed out: the wall must be visible from the openings and within
    /// the tool's reach.
    InSight,
    /// Filament: the wall must be visible and within reach, or steep enough to print without
    /// support.
    InSightOrSelfSupporting,
    /// Powder: an escape opening of the stated size, or two smaller ones if the process allows
    /// that.
    PowderEscape,
}

impl CleaningRule {
    /// Returns the rule in words, for the job sheet.
    pub fn description(self) -> &'static str {
        match self {
            Self::MeltOut => "support melts or dissolves out through any opening",
            Self::InSight => "support comes out through the opening, as far as it is seen",
            Self::InSightOrSelfSupporting => {
                "support comes out through the opening, as far as it is seen; steep walls hold none"
            }
            Self::PowderEscape => "powder falls out through an escape opening",
        }
    }

    /// True if the wall must be visible from the openings.
    pub fn needs_sight(self) -> bool {
        matches!(self, Self::InSight | Self::InSightOrSelfSupporting)
    }
}

/// The process that prints in a vat of resin.
const VAT: &str = "sla";

/// A printer's rule with its numbers, except for the least opening: that is the printer's
/// `min_opening_mm`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Cleaning {
    /// The rule.
    pub rule: CleaningRule,
    /// The least visible share of a void's wall within reach; 0 if the rule needs no sight.
    pub sight_ratio: f64,
    /// Depth below an opening that the tool or the jet reaches, mm; `None` if the rule needs no
    /// reach or it is not known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reach_mm: Option<f64>,
    /// The least diameter of each of two or more openings of a piece of a void, mm; `None` if two
    /// openings are no better than one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pair_opening_mm: Option<f64>,
    /// The least angle from the horizontal at which downward surfaces need no support, degrees;
    /// `None` if the rule ignores it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub overhang_deg: Option<f64>,
}

impl Cleaning {
    /// The rule that requires an opening and nothing else.
    pub const MELT_OUT: Self = Self {
        rule: CleaningRule::MeltOut,
        sight_ratio: 0.0,
        reach_mm: None,
        pair_opening_mm: None,
        overhang_deg: None,
    };

    /// True if openings of these diameters, mm, are wide enough to empty a piece of a void; a
    /// single one must be `least_mm` wide.
    pub fn lets_out(&self, openings_mm: &[f64], least_mm: f64) -> bool {
        let count_from = |least: f64| openings_mm.iter().filter(|&&mm| mm >= least).count();
        count_from(least_mm) > 0
            || self
                .pair_opening_mm
                .is_some_and(|pair_mm| count_from(pair_mm) > 1)
    }
}

impl Printer {
    /// Returns how voids are cleaned, in words. A vat leaves resin in them too.
    pub fn cleaning_method(&self) -> &'static str {
        if self.prints_in_vat() {
            "resin drains, and support comes out, through the opening"
        } else {
            self.cleaning_rule().rule.description()
        }
    }

    /// Returns whether it prints in a vat of resin.
    pub fn prints_in_vat(&self) -> bool {
        self.process.as_deref() == Some(VAT)
    }

    /// Returns the rule by which voids in this printer's parts count as clean.
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
        let needs_sight = rule.needs_sight();
        let may_support_itself = rule == CleaningRule::InSightOrSelfSupporting;
        let is_powder = rule == CleaningRule::PowderEscape;
        Cleaning {
            rule,
            sight_ratio: if needs_sight { SIGHT_RATIO } else { 0.0 },
            reach_mm: number(Quantity::CleaningReachMm).filter(|_| needs_sight),
            pair_opening_mm: number(Quantity::PairOpeningMm).filter(|_| is_powder),
            overhang_deg: number(Quantity::OverhangDeg).filter(|_| may_support_itself),
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
    fn a_printer_with_a_vat_says_that_resin_drains() {
        let method = |id: &str| Printer::find(id).unwrap().cleaning_method();
        assert!(method("formlabs-form3").starts_with("resin drains"));
        assert!(method("objet-connex350").starts_with("support comes out"));
    }

    #[test]
    fn every_process_has_the_rule_for_the_filling_of_its_voids() {
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
    fn two_small_openings_let_powder_out_if_the_process_says_so() {
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
