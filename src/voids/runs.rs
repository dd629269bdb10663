//! Long lists made in parallel, run by run: the watch is asked between the runs.

use std::ops::Range;

use rayon::prelude::*;

use crate::base::watch::{Cancelled, Watch};

/// Items of a run. One takes some hundredths of a second; shorter runs would leave threads idle at
/// their ends.
const RUN: usize = 1 << 16;

/// Returns the results for the first `count` numbers, in their order.
pub(super) fn map_in_runs<T: Send>(
    count: usize,
    watch: &Watch,
    map: impl Fn(usize) -> T + Sync,
) -> Result<Vec<T>, Cancelled> {
    let mut all = Vec::with_capacity(count);
    for run in runs(count) {
        watch.check()?;
        all.par_extend(run.into_par_iter().map(&map));
    }
    Ok(all)
}

/// Returns all results for the first `count` numbers, in their order.
pub(super) fn flat_map_in_runs<I>(
    count: usize,
    watch: &Watch,
    map: impl Fn(usize) -> I + Sync,
) -> Result<Vec<I::Item>, Cancelled>
where
    I: IntoIterator,
    I::Item: Send,
{
    let mut all = Vec::new();
    for run in runs(count) {
        watch.check()?;
        all.par_extend(run.into_par_iter().flat_map_iter(&map));
    }
    Ok(all)
}

/// Returns the runs of the first `count` numbers.
pub(super) fn runs(count: usize) -> impl Iterator<Item = Range<usize>> {
    (0..count)
        .step_by(RUN)
        .map(move |start| start..count.min(start + RUN))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_of_several_runs_are_in_their_order() {
        for count in [0, 1, RUN, 2 * RUN + 5] {
            let watch = Watch::silent();
            let all: Vec<usize> = (0..count).collect();
            assert_eq!(map_in_runs(count, &watch, |i| i), Ok(all.clone()));
            assert_eq!(flat_map_in_runs(count, &watch, |i| [i]), Ok(all));
        }
    }

    #[test]
    fn a_stopped_watch_ends_the_list() {
        let watch = Watch::silent();
        watch.cancel();
        assert_eq!(map_in_runs(1, &watch, |i| i), Err(Cancelled));
    }
}
