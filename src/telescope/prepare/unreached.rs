//! Poses that cannot be: how near a tip comes, and the nearest place that it reaches.

use super::error::TelescopeRunError;
use super::posing::{Poser, Sequence, TIP};
use super::unposed::Unposed;
use crate::base::setting::{Key as SettingKey, Setting};
use crate::job::telescope::Reach;
use crate::telescope::motion::Key;
use crate::telescope::pose::{Reached, Target};
use crate::verify::REACH_LIMIT_MM;
use crate::wing::Remedy;

/// Digits of a place in a remedy: a tenth of a millimetre is typed.
const TYPED: f64 = 10.0;
/// The turn below which a joint does not turn, degrees: it is not seen.
const SEEN_DEG: f64 = 0.05;

impl Poser<'_> {
    /// Returns the answer that no state that was found is near enough.
    pub(super) fn unreached(
        &self,
        targets: &[Target],
        found: &[Reached],
        sequence: &Sequence,
    ) -> Result<Unposed, TelescopeRunError> {
        let Some(nearest) = found.first() else {
            return Ok(Unposed::barred("reach", "there is no joint"));
        };
        let ends = self.network.ends(&nearest.state);
        let off = |target: &Target| (ends[target.limb] - target.place).norm();
        let worst = targets.iter().max_by(|a, b| off(a).total_cmp(&off(b)));
        let words = worst.map_or_else(String::new, |target| {
            let [x, y, z] = target.place.into();
            format!(
                "{} comes no nearer than {:.1} mm to {x},{y},{z}, and {REACH_LIMIT_MM} mm would do",
                self.tip_words(target.limb),
                off(target)
            )
        });
        let far = targets
            .iter()
            .find_map(|target| self.network.too_far(target));
        let proof = far.map(|far| {
            format!(
                "that is proved, for the place of {} is {:.1} mm from the mouth of the first root, \
                 and all shells on the way reach {:.1} mm",
                self.tip_words(far.limb),
                far.distance_mm,
                far.reach_mm
            )
        });
        let proof = proof.unwrap_or_else(|| "that is the best that a search found".to_owned());
        let state = self.state_words(&nearest.state);
        Ok(Unposed {
            reason: format!("{words}; {proof}; there its joints are {state}"),
            is_proved: far.is_some(),
            remedies: self
                .remedy(targets, nearest, sequence)?
                .into_iter()
                .collect(),
            hints: Vec::new(),
        })
    }

    fn tip_words(&self, limb: usize) -> String {
        match self.tips[limb].first().map_or(TIP, String::as_str) {
            TIP => "the tip".to_owned(),
            name => format!("the tip of limb {name}"),
        }
    }

    /// Returns the nearest places that are reached, found and gone to anew; `None` if something is
    /// in the way.
    fn remedy(
        &self,
        targets: &[Target],
        nearest: &Reached,
        sequence: &Sequence,
    ) -> Result<Option<Remedy>, TelescopeRunError> {
        let ends = self.network.ends(&nearest.state);
        let typed: Vec<Reach> = self
            .job
            .reach
            .iter()
            .zip(targets)
            .map(|(reach, target)| Reach {
                tip: reach.tip.clone(),
                place: <[f64; 3]>::from(ends[target.limb])
                    .map(|mm| (mm * TYPED).round() / TYPED + 0.0),
            })
            .collect();
        let anew: Vec<Target> = typed
            .iter()
            .zip(targets)
            .map(|(reach, target)| Target {
                place: reach.place.into(),
                ..*target
            })
            .collect();
        let found = self.network.reach(&anew);
        let Some(reached) = found.first().filter(|own| own.off_mm <= REACH_LIMIT_MM) else {
            return Ok(None);
        };
        if self.way("reach", &reached.state, sequence)?.is_err() {
            return Ok(None);
        }
        let settings = typed
            .iter()
            .map(|reach| Setting::new(SettingKey::Reach, reach));
        Ok(Some(Remedy {
            settings: settings.collect(),
            words: format!(
                "is reached to {:.2} mm, {:.1} mm from the place asked for",
                reached.off_mm, nearest.off_mm
            ),
        }))
    }

    /// Words a state, joint by joint.
    fn state_words(&self, state: &[Key]) -> String {
        let limbs = self.network.limbs.iter().zip(state).zip(&self.joints);
        let words = limbs.flat_map(|((limb, state), ids)| {
            let closed_mm = limb.telescope.sizes.closed_mm();
            ids.iter().zip(state).map(move |(id, own)| {
                let turn_deg = own.turn_rad.to_degrees();
                let turn = match turn_deg.abs() < SEEN_DEG {
                    true => String::new(),
                    false => format!(" turned by {turn_deg:.1}°"),
                };
                format!("{id} {:.1} mm out{turn}", own.slide_mm - closed_mm)
            })
        });
        words.collect::<Vec<_>>().join(", ")
    }
}
