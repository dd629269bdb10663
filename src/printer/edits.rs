//! Changes of a text that leave the rest of it as it is.

use std::ops::Range;

/// Replacements of pieces of a text.
pub(super) struct Edits<'a> {
    text: &'a str,
    edits: Vec<(Range<usize>, String)>,
}

impl<'a> Edits<'a> {
    /// Begins with nothing replaced.
    pub fn new(text: &'a str) -> Self {
        Self {
            text,
            edits: Vec::new(),
        }
    }

    /// Replaces a piece of the text.
    pub fn replace(&mut self, range: Range<usize>, new: String) {
        self.edits.push((range, new));
    }

    /// Adds lines after the line in which a place lies.
    pub fn add_after_line(&mut self, place: usize, lines: &str) {
        match self.text[place..].find('\n') {
            Some(end) => {
                let at = place + end + 1;
                self.replace(at..at, lines.to_owned());
            }
            None => {
                let at = self.text.len();
                self.replace(at..at, format!("\n{lines}"));
            }
        }
    }

    /// Adds lines at the head of `[numbers]`, which is added if missing.
    pub fn add_numbers(&mut self, lines: &str) {
        const HEADER: &str = "[numbers]";
        let mut start = 0;
        let mut header = None;
        let mut first_material = self.text.len();
        for line in self.text.split_inclusive('\n') {
            if line.trim_end().starts_with(HEADER) {
                header = Some(start + line.len());
            } else if line.starts_with("[[material]]") {
                first_material = first_material.min(start);
            }
            start += line.len();
        }
        match header {
            Some(at) => {
                let newline = if self.text[..at].ends_with('\n') {
                    ""
                } else {
                    "\n"
                };
                self.replace(at..at, format!("{newline}{lines}"));
            }
            None => self.replace(
                first_material..first_material,
                format!("\n{HEADER}\n{lines}\n"),
            ),
        }
    }

    /// Adds lines at the end.
    pub fn add_at_end(&mut self, lines: &str) {
        let end = self.text.len();
        let newline = if self.text.ends_with('\n') { "" } else { "\n" };
        self.replace(end..end, format!("{newline}{lines}"));
    }

    /// Returns the text with all pieces replaced.
    pub fn apply(mut self) -> String {
        // The sort is stable: insertions at one place keep their order.
        self.edits
            .sort_by_key(|(range, _)| (range.start, range.end));
        let mut text = String::new();
        let mut done = 0;
        for (range, new) in &self.edits {
            text += &self.text[done..range.start];
            text += new;
            done = range.end;
        }
        text + &self.text[done..]
    }
}
