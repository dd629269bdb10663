//! Drain holes: how many, and how wide, let out what a closed void of one piece is full of.

use super::{CleaningRule, Printer, Quantity, Support};

/// Holes of a void whose resin drains: one lets it out, the other lets air in.
const DRAIN_AND_VENT: usize = 2;
/// Holes of a void that powder leaves through small ones.
const PAIR: usize = 2;
/// Slope of the flanks of a hole for a plug to its axis, at the least: 14°. It stops the plug, and
/// does not jam it.
const LEAST_SLOPE: f64 = 0.25;
/// Length by which a plug is wider than the narrowest place of its hole, on each side, mm.
const HOLD_MM: f64 = 0.1;
/// Share by which a gap is wider across the axis than normal to a flank of up to 20°.
const LEAN_RATIO: f64 = 1.07;

/// The holes that each void of an uncut piece needs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DrainNeed {
    /// The free diameter of each hole, mm.
    pub diameter_mm: f64,
    /// The number of holes.
    pub count: usize,
    /// True if a liquid drains: one hole is low, and another one high.
    pub is_liquid: bool,
    /// The gap on each side of the plug that closes each hole afterwards, mm; `None` without plugs.
    pub plug_gap_mm: Option<f64>,
    /// The unit direction that points up in the printer, where the lowest place of a void must
    /// drain; `None` if up is that of the object.
    pub printed_up: Option<[f64; 3]>,
}

impl DrainNeed {
    /// Returns the diameter at the outer end of a hole of this length through a wall, mm. For a
    /// plug it is wider there than inside, so that the plug cannot fall in.
    pub fn mouth_mm(&self, length_mm: f64, wall_mm: f64) -> f64 {
        let slope = self.plug_gap_mm.map_or(0.0, |gap_mm| {
            LEAST_SLOPE.max((LEAN_RATIO * gap_mm + HOLD_MM) / wall_mm)
        });
        self.diameter_mm + 2.0 * slope * length_mm
    }
}

/// The reason why drain holes do not empty a void.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Undrainable {
    /// Filament is laid in the open, and its support and loose strands are broken out.
    Filament,
    /// Support fills the void and is dug out.
    Gel,
    /// The holes that were asked for are narrower than the process needs.
    Narrow {
        /// The least diameter, mm.
        least_mm: f64,
    },
}

impl Printer {
    /// Returns the holes that each closed void needs, of the width that is asked for or of the
    /// least that does.
    ///
    /// # Errors
    /// No hole empties a void of this process, or the width does not suffice.
    pub fn drain_need(&self, asked_mm: Option<f64>) -> Result<DrainNeed, Undrainable> {
        let single_mm = self.min_opening_mm.value;
        let is_liquid = self.prints_in_vat();
        let pair_mm = match self.cleaning_rule().rule {
            CleaningRule::MeltOut => None,
            CleaningRule::PowderEscape => {
                let pair = self.number(Quantity::PairOpeningMm);
                pair.map(|pair| pair.value)
            }
            CleaningRule::InSight if is_liquid => None,
            CleaningRule::InSight if self.support == Support::WaterJet => {
                return Err(Undrainable::Gel);
            }
            CleaningRule::InSight | CleaningRule::InSightOrSelfSupporting => {
                return Err(Undrainable::Filament);
            }
        };
        let least_mm = pair_mm.unwrap_or(single_mm);
        let diameter_mm = asked_mm.unwrap_or(least_mm);
        if diameter_mm < least_mm {
            return Err(Undrainable::Narrow { least_mm });
        }
        let count = match pair_mm {
            Some(_) if diameter_mm < single_mm => PAIR,
            _ if is_liquid => DRAIN_AND_VENT,
            _ => 1,
        };
        Ok(DrainNeed {
            diameter_mm,
            count,
            is_liquid,
            plug_gap_mm: None,
            printed_up: None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn need(id: &str, asked_mm: Option<f64>) -> Result<DrainNeed, Undrainable> {
        Printer::find(id).unwrap().drain_need(asked_mm)
    }

    fn holes(id: &str, asked_mm: Option<f64>) -> (f64, usize) {
        let found = need(id, asked_mm).unwrap();
        (found.diameter_mm, found.count)
    }

    #[test]
    fn powder_leaves_through_one_wide_hole_or_two_small_ones_where_the_process_says_so() {
        assert_eq!(holes("formlabs-fuse1", None), (5.0, 1));
        assert_eq!(holes("hp-mjf-5200", None), (2.0, 2));
        assert_eq!(holes("hp-mjf-5200", Some(3.0)), (3.0, 2));
        assert_eq!(holes("hp-mjf-5200", Some(4.0)), (4.0, 1));
    }

    #[test]
    fn resin_needs_a_drain_and_a_vent_and_wax_a_way_out() {
        assert_eq!(holes("formlabs-form4", None), (3.5, 2));
        assert!(need("formlabs-form4", None).unwrap().is_liquid);
        assert_eq!(holes("projet-mjp-2500", None), (2.0, 1));
    }

    #[test]
    fn no_hole_lets_out_what_is_broken_or_dug_out() {
        assert_eq!(need("prusa-mk4", None), Err(Undrainable::Filament));
        assert_eq!(need("objet-connex350", None), Err(Undrainable::Gel));
    }

    #[test]
    fn a_narrower_hole_than_the_process_needs_is_refused() {
        let least_mm = 5.0;
        let narrow = need("formlabs-fuse1", Some(4.9));
        assert_eq!(narrow, Err(Undrainable::Narrow { least_mm }));
    }
}
