//! Words as a shell takes them.

/// Returns a word as it is typed in a shell, in quotes if it needs them.
pub fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "-_./,:=+@%".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_words_that_a_shell_would_split_are_quoted() {
        for (word, typed) in [
            ("models/a.stl", "models/a.stl"),
            ("--up=-0.1,0,1", "--up=-0.1,0,1"),
            ("my model.stl", "'my model.stl'"),
            ("it's.stl", r"'it'\''s.stl'"),
            ("", "''"),
        ] {
            assert_eq!(quoted(word), typed);
        }
    }
}
