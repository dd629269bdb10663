//! The names of a kit's parts in the labels of slicers, and labels in the words of the judge.

/// Most names in one sentence.
const MOST_NAMED: usize = 5;
/// Most characters of a label that are shown.
const MOST_SHOWN: usize = 80;

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
    // `P02_P01of02` is the kit's own name for P01 of a model called P02.
    let is_numbered = |id: &str| {
        let mark = format!("_{}of", plain(id));
        let mut ends = label
            .match_indices(&mark)
            .map(|(at, _)| &label[at + mark.len()..]);
        !id.is_empty() && ends.any(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
    };
    let ids: Vec<&str> = ids.collect();
    let those = |is_it: &dyn Fn(&str) -> bool| -> Vec<usize> {
        (0..ids.len()).filter(|&index| is_it(ids[index])).collect()
    };
    let numbered = those(&is_numbered);
    if numbered.len() == 1 {
        numbered
    } else {
        those(&is_named)
    }
}

/// Returns a label as it may be shown: without control characters, and not too long.
pub(super) fn showable(label: &str) -> String {
    let shown = label.chars().take(MOST_SHOWN);
    shown
        .map(|c| if c.is_control() { '\u{fffd}' } else { c })
        .collect()
}

/// Returns the first names with commas, and the count of the others; `nothing` without any.
pub(super) fn name_some(names: &[String]) -> String {
    let named = names[..names.len().min(MOST_NAMED)].join(", ");
    match names.len() {
        0 => "nothing".to_owned(),
        count if count > MOST_NAMED => format!("{named} and {} more", count - MOST_NAMED),
        _ => named,
    }
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
        // A model that is called as a part is.
        assert_eq!(found("P02_P01of02.stl"), [0]);
        assert_eq!(found("P02_P02of02.stl"), [1]);
    }

    #[test]
    fn a_longer_word_is_another_name() {
        let found = |label: &str| named_ids(label, IDS.into_iter());
        for label in ["P011", "XP01", "cube", "", "P1"] {
            assert!(found(label).is_empty(), "{label}");
        }
    }

    #[test]
    fn labels_are_shown_without_orders_to_the_terminal() {
        assert_eq!(showable("a\u{1b}[31mb"), "a\u{fffd}[31mb");
        assert_eq!(showable(&"x".repeat(1000)).len(), MOST_SHOWN);
    }

    #[test]
    fn only_a_few_names_are_listed() {
        let names: Vec<String> = (1..=7).map(|name| name.to_string()).collect();
        assert_eq!(name_some(&names), "1, 2, 3, 4, 5 and 2 more");
        assert_eq!(name_some(&names[..2]), "1, 2");
        assert_eq!(name_some(&[]), "nothing");
    }
}
