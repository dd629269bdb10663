//! The checklist's rows of how parts are joined.

use super::bosses::{BossRound, KeptBoss};
use super::rows::{Sheet, shown};
use crate::report::{BossRow, RoundRow};

/// The boss rounds of a run.
pub fn round_rows(sheet: &Sheet) -> Vec<RoundRow> {
    let row = |(index, round): (usize, &BossRound)| RoundRow {
        round: index + 1,
        bosses: round.bosses.iter().map(boss_row).collect(),
        kept_solid_mm3: round.kept_mm3,
        before: shown(sheet.setup, round.before.figure, round.before.value),
        after: shown(sheet.setup, round.after.figure, round.after.value),
        gap_ratio: round.after.gap_ratio,
    };
    sheet.assembly.bosses.iter().enumerate().map(row).collect()
}

fn boss_row(boss: &KeptBoss) -> BossRow {
    BossRow {
        pin: boss.pin.id.clone(),
        parts: boss.parts.clone(),
        center_mm: boss.pin.center_mm,
        volume_mm3: boss.volume_mm3,
    }
}

/// What could have been emptied in all bosses, mm³.
pub fn bosses_mm3(sheet: &Sheet) -> f64 {
    sheet.assembly.bosses.last().map_or(0.0, |round| round.kept_mm3)
}
