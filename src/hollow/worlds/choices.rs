//! All choices of what to empty in a small world.

use super::{World, whole};
use crate::interior::Columns;
use crate::mass::Moments;

/// Returns one group per interval.
pub(crate) fn single_blocks(count: usize) -> Vec<Vec<usize>> {
    (0..count).map(|i| vec![i]).collect()
}

/// Groups the blocks of `mirrored_blocks` with their mirror images.
pub(crate) fn mirrored_groups() -> Vec<Vec<usize>> {
    let mut groups = vec![Vec::new(); 12];
    for (column, layer) in (0..16).flat_map(|column| (0..6).map(move |layer| (column, layer))) {
        let fold = |i: usize, count: usize| i.min(count - 1 - i);
        groups[(fold(column % 4, 4) * 2 + fold(column / 4, 4)) * 3 + fold(layer, 6)]
            .push(column * 6 + layer);
    }
    groups
}

/// Groups the cells of `rings` into four rings by three layers.
pub(crate) fn ring_groups(world: &World) -> Vec<Vec<usize>> {
    let mut groups = vec![Vec::new(); 12];
    for (column, &[x, y]) in world.columns.centers.iter().enumerate() {
        let ring = (x.hypot(y) / 1.5) as usize;
        (0..3).for_each(|layer| groups[ring * 3 + layer].push(column * 3 + layer));
    }
    groups
}

/// Visits the moments of every choice of groups to empty.
pub(crate) fn each_choice(world: &World, groups: &[Vec<usize>], mut visit: impl FnMut(&Moments)) {
    let emptied: Vec<Moments> = groups
        .iter()
        .map(|group| moments_of_intervals(&world.columns, group))
        .collect();
    for choice in 0..1usize << groups.len() {
        let chosen = (0..groups.len()).filter(|group| choice >> group & 1 == 1);
        visit(&chosen.fold(world.fixed, |moments, group| moments - emptied[group]));
    }
}

/// Visits the moments of every way to empty, keep or fill each interval with a denser material, and
/// the number filled.
pub(crate) fn each_mixture(
    world: &World,
    density_ratio: f64,
    mut visit: impl FnMut(&Moments, u32),
) {
    let count = world.columns.intervals.len();
    let single: Vec<Moments> = (0..count)
        .map(|i| moments_of_intervals(&world.columns, &[i]))
        .collect();
    for choice in 0..3u32.pow(count as u32) {
        let (mut moments, mut filled, mut rest) = (world.fixed, 0, choice);
        for part in &single {
            match rest % 3 {
                0 => moments -= *part,
                1 => (moments, filled) = (moments + *part * (density_ratio - 1.0), filled + 1),
                _ => {}
            }
            rest /= 3;
        }
        visit(&moments, filled);
    }
}

/// Returns the moments of some intervals, from columns that hold only these.
fn moments_of_intervals(columns: &Columns, chosen: &[usize]) -> Moments {
    let mut part = Columns {
        pitch_mm: columns.pitch_mm,
        starts: vec![0],
        ..Columns::default()
    };
    for index in 0..columns.len() {
        let range = columns.starts[index] as usize..columns.starts[index + 1] as usize;
        for interval in range.filter(|interval| chosen.contains(interval)) {
            part.centers.push(columns.centers[index]);
            part.intervals.push(columns.intervals[interval]);
            part.starts.push(part.intervals.len() as u32);
        }
    }
    whole(&part)
}
