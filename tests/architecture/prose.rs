//! Comments are short and plain, lines are narrow, and the library knows no command line.

use std::ops::Range;

use crate::scanner::{self, Source};
use crate::{at_most, holds};

/// Columns of a line.
const MAX_COLUMNS: usize = 100;
/// Words of a sentence.
const MAX_WORDS: usize = 25;
/// The words with which no doc comment begins.
const QUESTIONS: [&str; 6] = ["What", "How", "Whether", "Where", "Which", "Why"];
/// Translated idioms for "`None` if".
const NONE_WHERE: [&str; 2] = ["none where", "none if there"];
/// The files that define or word the flags of the command line.
const FLAG_FILES: [&str; 3] = [
    "src/cli/args", // and all that begins so
    "src/cli/flags.rs",
    "src/slicer", // another program's flags
];

/// The share of the doc comments that still begin with a question. Final value: 0.01.
const QUESTION_SHARE: f64 = 0.01;

/// Comment lines that follow each other with one and the same mark.
struct Comment {
    /// Its first byte in the file.
    at: usize,
    is_doc: bool,
    lines: Vec<String>,
}

#[test]
fn doc_comments_say_what_comes_back() {
    let docs: Vec<_> = comments().filter(|(_, comment)| comment.is_doc).collect();
    let asks = |comment: &Comment| {
        let first = scanner::first_word(&comment.lines[0]);
        QUESTIONS.contains(&first)
    };
    let asking = docs.iter().filter(|(_, comment)| asks(comment));
    let asking: Vec<String> = asking
        .map(|(source, comment)| comment.first_line(source))
        .collect();
    let ceiling = (QUESTION_SHARE * docs.len() as f64).ceil() as usize;
    println!(
        "{} doc comments, {} begin with a question",
        docs.len(),
        asking.len()
    );
    at_most(
        ceiling,
        asking.into_iter(),
        "begin with a verb or a noun, not with a question",
    );
}

#[test]
fn doc_comments_say_none_if() {
    let says = |comment: &Comment| {
        let text = comment.lines.join(" ").to_lowercase();
        NONE_WHERE.iter().any(|idiom| text.contains(idiom))
    };
    let wrong = comments().filter(|(_, comment)| comment.is_doc && says(comment));
    let wrong = wrong.map(|(source, comment)| comment.first_line(source));
    holds(wrong, "write \"`None` if\"");
}

#[test]
fn lines_are_narrow() {
    let wide = scanner::all().flat_map(wide_lines);
    holds(wide, "break the line");
}

#[test]
fn sentences_are_short() {
    let long = comments().flat_map(|(source, comment)| {
        let place = source.place(comment.at);
        let sentences = sentences(&comment.lines).into_iter();
        let long = sentences.filter(|sentence| words(sentence) > MAX_WORDS);
        long.map(|sentence| format!("{place}: {sentence}"))
            .collect::<Vec<_>>()
    });
    holds(long, "make two sentences of it");
}

#[test]
fn only_the_command_line_names_its_flags() {
    let is_free = |source: &&Source| {
        let path = source.path.to_str().unwrap();
        FLAG_FILES.iter().any(|file| path.starts_with(file))
    };
    let library = scanner::program().filter(|source| !is_free(source));
    let named = library.flat_map(|source| {
        let strings = source
            .strings
            .iter()
            .filter(|string| !source.is_test_at(string.start));
        let flags = strings.flat_map(|string| {
            let place = source.place(string.start);
            let flags = flags(&source.text[string.clone()]).into_iter();
            flags.map(move |flag| format!("{place}: {flag}"))
        });
        flags.collect::<Vec<_>>()
    });
    holds(
        named,
        "return a remedy as a value, and let the command line word it",
    );
}

impl Comment {
    fn first_line(&self, source: &Source) -> String {
        format!("{}: {}", source.place(self.at), self.lines[0])
    }
}

/// Every comment of the package, tests included.
fn comments() -> impl Iterator<Item = (&'static Source, Comment)> {
    scanner::all().flat_map(|source| {
        comments_of(source)
            .into_iter()
            .map(move |comment| (source, comment))
    })
}

fn comments_of(source: &Source) -> Vec<Comment> {
    let mut comments: Vec<Comment> = Vec::new();
    let mut last: Option<(&str, usize)> = None;
    for piece in &source.comments {
        let text = &source.text[piece.clone()];
        let mark = mark(text);
        let body = text[mark.len()..].trim_end();
        let body = body.strip_prefix(' ').unwrap_or(body).to_owned();
        let follows = last.is_some_and(|(before, end)| {
            let between = &source.text[end..piece.start];
            let is_next_line = between.trim().is_empty() && between.matches('\n').count() == 1;
            before == mark && is_next_line
        });
        match comments.last_mut().filter(|_| follows) {
            Some(comment) => comment.lines.push(body),
            None => comments.push(Comment {
                at: piece.start,
                is_doc: ["///", "//!"].contains(&mark),
                lines: vec![body],
            }),
        }
        last = Some((mark, piece.end));
    }
    comments
}

/// The slashes, and perhaps a mark of exclamation, that a comment begins with.
fn mark(comment: &str) -> &str {
    let marks = ["////", "///", "//!", "//"];
    let mark = marks.into_iter().find(|mark| comment.starts_with(mark));
    mark.unwrap_or("/*")
}

/// The lines that are too wide, but for strings, which cannot be broken, tables and addresses.
fn wide_lines(source: &Source) -> Vec<String> {
    let mut wide = Vec::new();
    let mut start = 0;
    for line in source.text.split_inclusive('\n') {
        let range = start..start + line.len();
        start = range.end;
        let line = line.trim_end();
        let comment = line.trim_start().trim_start_matches(['/', '!', ' ']);
        let is_free = comment.starts_with('|') || comment.starts_with('[');
        if line.chars().count() > MAX_COLUMNS && !is_free && columns(source, &range) > MAX_COLUMNS {
            wide.push(format!("{}: {}", source.place(range.start), line.trim()));
        }
    }
    wide
}

/// The columns of a line without its strings.
fn columns(source: &Source, line: &Range<usize>) -> usize {
    let in_string = |at: &usize| source.strings.iter().any(|string| string.contains(at));
    let text = source.text[line.clone()].trim_end();
    let places = text.char_indices().map(|(at, _)| line.start + at);
    places.filter(|at| !in_string(at)).count()
}

/// The sentences of a comment; code, tables and headings are none.
fn sentences(lines: &[String]) -> Vec<String> {
    paragraphs(lines)
        .iter()
        .flat_map(|paragraph| split(&without_code(paragraph)))
        .collect()
}

fn paragraphs(lines: &[String]) -> Vec<String> {
    let mut paragraphs = vec![String::new()];
    let mut in_code = false;
    for line in lines.iter().map(|line| line.trim()) {
        in_code ^= line.starts_with("```");
        let is_prose = !in_code && !line.starts_with(['|', '#']) && !line.starts_with("```");
        if !is_prose || line.is_empty() || is_item(line) {
            paragraphs.push(String::new());
        }
        if is_prose {
            let paragraph = paragraphs.last_mut().unwrap();
            *paragraph += line;
            paragraph.push(' ');
        }
    }
    paragraphs
}

/// Tells if a line begins an item of a list.
fn is_item(line: &str) -> bool {
    let number = line.trim_start_matches(|c: char| c.is_ascii_digit());
    let is_numbered = number.len() < line.len() && number.starts_with([')', '.']);
    let after = if is_numbered {
        &number[1..]
    } else {
        line.trim_start_matches(['*', '-', '+'])
    };
    after.len() < line.len() && after.starts_with(' ')
}

/// The paragraph with one letter in the place of every `code`.
fn without_code(paragraph: &str) -> String {
    let mut pieces = paragraph.split('`');
    let mut prose = pieces.next().unwrap().to_owned();
    while let (Some(_), Some(after)) = (pieces.next(), pieces.next()) {
        prose.push('x');
        prose += after;
    }
    prose
}

/// Splits a paragraph where a sentence ends and the next begins.
fn split(paragraph: &str) -> Vec<String> {
    let mut sentences: Vec<String> = Vec::new();
    let mut ends = true;
    for word in paragraph.split_whitespace() {
        let begins =
            word == "x" || word.starts_with(|c: char| c.is_uppercase() || "[(*".contains(c));
        if ends && begins || sentences.is_empty() {
            sentences.push(String::new());
        }
        let sentence = sentences.last_mut().unwrap();
        *sentence += word;
        sentence.push(' ');
        ends = word.ends_with(['.', '!', '?', ':', ';']);
    }
    sentences
}

fn words(sentence: &str) -> usize {
    let is_part = |c: char| c.is_alphanumeric() || "°%²³-'".contains(c);
    sentence
        .split(|c| !is_part(c))
        .filter(|word| !word.is_empty())
        .count()
}

/// The flags a string names, such as `--out`.
fn flags(string: &str) -> Vec<&str> {
    let is_letter = |c: char| c.is_ascii_lowercase() || c == '-';
    let flag = |(at, dashes): (usize, &str)| {
        let begins = !string[..at].ends_with(|c: char| c.is_alphanumeric() || "-!(".contains(c));
        let name = &string[at + dashes.len()..];
        let length = name.find(|c| !is_letter(c)).unwrap_or(name.len());
        let is_name = length > 1 && !name.starts_with('-');
        (begins && is_name).then(|| &string[at..at + dashes.len() + length])
    };
    string.match_indices("--").filter_map(flag).collect()
}

mod tests {
    use super::*;

    fn scan(text: &str) -> Source {
        Source::new("src/room/file.rs".into(), text.to_owned())
    }

    #[test]
    fn comments_are_gathered_by_their_mark() {
        let source =
            scan("//! A.\n\n/// B\n/// c.\nfn f() {\n    // D\n    // e.\n    g(); // F\n}\n");
        let found: Vec<_> = comments_of(&source)
            .into_iter()
            .map(|c| (c.is_doc, c.lines.join("|")))
            .collect();
        let expected = [(true, "A."), (true, "B|c."), (false, "D|e."), (false, "F")];
        assert_eq!(
            found,
            expected.map(|(is_doc, text)| (is_doc, text.to_owned()))
        );
    }

    #[test]
    fn sentences_end_where_the_next_begins() {
        let lines = "# Title\nOne, e.g. two\nlines. `Three` is: `a. B` code.\n| a | b |\n```\nlet x;\n```\n* Four\n2. Five; six";
        let lines: Vec<String> = lines.lines().map(str::to_owned).collect();
        let found: Vec<String> = sentences(&lines)
            .iter()
            .map(|s| s.trim().to_owned())
            .collect();
        assert_eq!(
            found,
            [
                "One, e.g. two lines.",
                "x is:",
                "x code.",
                "* Four",
                "2.",
                "Five; six"
            ]
        );
        assert_eq!(words("* It's 2-fold, 5 °C."), 4);
    }

    #[test]
    fn strings_and_tables_may_be_wide() {
        let long = "x".repeat(MAX_COLUMNS);
        let wide = |line: &str| wide_lines(&scan(line)).len();
        assert_eq!(wide(&format!("f(\"{long}\");")), 0);
        assert_eq!(wide(&format!("/// | {long} |")), 0);
        assert_eq!(wide(&format!("// {long}")), 1);
        assert_eq!(wide(&format!("ab{long};")), 1);
    }

    #[test]
    fn rules_and_variables_are_no_flags() {
        let found =
            flags("give `--out`, --no-color=1 or --x; <!-- note -->, var(--ink), ---, a--b");
        assert_eq!(found, ["--out", "--no-color"]);
    }
}
