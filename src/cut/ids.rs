//! The names of cuts, pins and parts.

/// The name of the cut with this index.
pub(crate) fn cut_id(index: usize) -> String {
    format!("C{}", index + 1)
}

/// The name of the pin with this index.
pub(crate) fn pin_id(index: usize) -> String {
    format!("N{}", index + 1)
}

/// The name of the part with this index.
pub(crate) fn part_id(index: usize) -> String {
    format!("P{:02}", index + 1)
}
