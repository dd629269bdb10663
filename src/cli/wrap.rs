//! Lines for a terminal, broken between their words where they are longer than it is wide.

use super::show::width;

/// The words before a command to paste, which stays whole on a line of its own.
const COMMAND: &str = ": equipoise ";
/// The least room for words beside their label, columns. With less room they stand below it.
const LEAST_ROOM: usize = 30;
/// The indent of what goes on below a line without a label, columns.
const INDENT: usize = 2;

/// Returns a text with its long lines broken for a terminal of this width. Without a width, as in
/// a pipe, the text stays as it is.
pub fn wrapped(text: &str, columns: Option<usize>) -> String {
    match columns {
        Some(columns) => text.lines().map(|line| wrap(line, columns)).collect(),
        None => text.to_owned(),
    }
}

/// Returns a line as one or several, the others under the first word that is no label.
fn wrap(line: &str, columns: usize) -> String {
    if width(line) <= columns {
        return format!("{line}\n");
    }
    let (label, words) = line.split_at(label_bytes(line));
    let beside = width(label);
    let indent = if label.trim().is_empty() {
        beside + INDENT
    } else if columns >= beside + LEAST_ROOM {
        beside
    } else {
        INDENT
    };
    let (words, command) = match words.find(COMMAND) {
        Some(at) => words.split_at(at + 1),
        None => (words, ""),
    };
    let mut lines = vec![label.to_owned()];
    for word in words.split(' ') {
        let last = lines.len() - 1;
        let is_start = lines[last].trim().is_empty() || lines[last] == label;
        let gap = usize::from(!is_start);
        if is_start || width(&lines[last]) + gap + width(word) <= columns {
            lines[last].push_str(if is_start { "" } else { " " });
            lines[last].push_str(word);
        } else {
            lines.push(" ".repeat(indent) + word);
        }
    }
    if !command.is_empty() {
        lines.push(" ".repeat(INDENT) + command.trim_start());
    }
    let ends = lines.iter().map(|line| format!("{}\n", line.trim_end()));
    ends.collect()
}

/// Returns the length of a label with the blanks that end its column, bytes. Without a label, that
/// of the blanks at the start.
fn label_bytes(line: &str) -> usize {
    let at = if line.starts_with(' ') {
        0
    } else {
        line.find("  ").unwrap_or_default()
    };
    line.len() - line[at..].trim_start().len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_go_on_below_the_words_and_not_below_the_label() {
        let line = "what it does  Stands until tilted by 25.1 degrees on a board.\n";
        let broken =
            "what it does  Stands until tilted by 25.1\n              degrees on a board.\n";
        assert_eq!(wrapped(line, Some(44)), broken);
        assert_eq!(wrapped(line, Some(100)), line);
        assert_eq!(wrapped(line, None), line);
    }

    #[test]
    fn a_line_without_a_label_goes_on_with_an_indent() {
        let line = "  remedy: make it larger, then it stands\n";
        let broken = "  remedy: make it\n    larger, then it\n    stands\n";
        assert_eq!(wrapped(line, Some(20)), broken);
        // Beside a label on a narrow terminal there would be a word a line.
        let narrow = wrapped("what it does  Stands until tilted\n", Some(30));
        assert_eq!(narrow, "what it does  Stands until\n  tilted\n");
    }

    #[test]
    fn a_command_to_paste_is_never_broken() {
        let command = "equipoise cuts humpty.obj --goal=stand --printer=prusa-mk4";
        let line = format!("other plan  with fewer parts: {command}\n");
        let text = wrapped(&line, Some(50));
        assert!(text.lines().any(|line| line.trim() == command), "{text}");
    }
}
