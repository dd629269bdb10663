//! The names of a kit's parts in the labels of slicers.

/// Returns the indices of the ids that a label names as whole words.
///
/// Slicers and files add to the names of objects: `P01.stl`, `P01_1`, `box_P01of02`. Klipper allows
/// no hyphens, so `jig-J1` becomes `jig_J1`.
pub(super) fn named_ids<'a>(label: &str, ids: impl Iterator<Item = &'a str>) -> Vec<usize> {
    let label = format!("_{}_", plain(label));
    let is_named = |id: &str| {
        let mark = format!("_{}", plain(id));
        let ends = label
            .match_indices(&mark)
            .map(|(at, _)| &label[at + mark.len()..]);
        !id.is_empty()
            && ends
                .clone()
                .any(|rest| !rest.starts_with(|c: char| c.is_ascii_digit()))
    };
    ids.enumerate()
        .filter(|(_, id)| is_named(id))
        .map(|(index, _)| index)
        .collect()
}

/// Returns the name in small letters, with `_` for all but letters and digits.
fn plain(name: &str) -> String {
    let letter = |c: char| {
        if c.is_alphanumeric() {
            c.to_ascii_lowercase()
        } else {
            '_'
        }
    };
    name.chars().map(letter).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const IDS: [&str; 5] = ["P01", "P02", "P10", "jig-J1", "jig-J10"];

    #[test]
    fn slicers_may_add_to_a_name() {
        let found = |label: &str| named_ids(label, IDS.into_iter());
        for label in [
            "P01",
            "P01.stl",
            "p01.STL_1",
            "P01_id_0_copy_0",
            "kit-P01 (2)",
            "box_P01of02.stl",
        ] {
            assert_eq!(found(label), [0], "{label}");
        }
        assert_eq!(found("jig_J1_id_2_copy_0"), [3]);
        assert_eq!(found("jig-J10.3mf"), [4]);
        assert_eq!(found("P01 and P02"), [0, 1]);
    }

    #[test]
    fn a_longer_word_is_another_name() {
        let found = |label: &str| named_ids(label, IDS.into_iter());
        for label in ["P011", "XP01", "cube", "", "P1"] {
            assert!(found(label).is_empty(), "{label}");
        }
    }
}
