//! Reads the Rust files of the package and tells code from comments, strings and tests.

use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

/// The attribute of items that are compiled for tests only.
const TEST_MARK: &str = "#[cfg(test)]";

/// The folders of the package that hold Rust files.
const FOLDERS: [&str; 4] = ["src", "tests", "examples", "benches"];

/// A Rust file of the package.
pub struct Source {
    /// The path below the package's folder.
    pub path: PathBuf,
    /// The path of the module below the crate's root: `["cut", "pins"]`, or nothing for `lib.rs`.
    pub module: Vec<String>,
    /// The whole text.
    pub text: String,
    /// The text with tests, comments, strings and characters blanked out, byte for byte.
    pub code: String,
    /// The comments, each up to the end of its line.
    pub comments: Vec<Range<usize>>,
    /// The strings, with their quotes.
    pub strings: Vec<Range<usize>>,
    /// The items compiled for tests only.
    pub tests: Vec<Range<usize>>,
    /// True if the whole file is compiled for tests only, or is no part of the program.
    pub is_test: bool,
}

/// The kinds of pieces of a text.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Code,
    Comment,
    Text,
}

static SOURCES: LazyLock<Vec<Source>> = LazyLock::new(read_all);

/// Every Rust file of the package, in the order of their paths.
pub fn all() -> impl Iterator<Item = &'static Source> {
    SOURCES.iter()
}

/// Every file of the program that is not a test.
pub fn program() -> impl Iterator<Item = &'static Source> {
    all().filter(|source| !source.is_test)
}

impl Source {
    /// Scans a text as if it stood in the file of that path.
    pub fn new(path: PathBuf, text: String) -> Self {
        let mut code = text.clone().into_bytes();
        let (mut comments, mut strings) = (Vec::new(), Vec::new());
        for (kind, piece) in pieces(&text) {
            if kind == Kind::Code {
                continue;
            }
            blank(&mut code, &piece);
            if kind == Kind::Comment {
                comments.push(piece);
            } else {
                strings.push(piece);
            }
        }
        let tests = test_items(&String::from_utf8(code.clone()).unwrap());
        for item in &tests {
            blank(&mut code, item);
        }
        Self {
            module: module_path(&path),
            is_test: !path.starts_with("src"),
            code: String::from_utf8(code).unwrap(),
            path,
            text,
            comments,
            strings,
            tests,
        }
    }

    /// The first word of the path below `src`: a folder, or a file at the top.
    pub fn room(&self) -> &str {
        let below = self.path.iter().nth(1).unwrap().to_str().unwrap();
        below.trim_end_matches(".rs")
    }

    /// `path:line` of a byte of the text.
    pub fn place(&self, at: usize) -> String {
        let line = self.text[..at].matches('\n').count() + 1;
        format!("{}:{line}", self.path.display())
    }

    /// Tells if a byte of the text belongs to a test.
    pub fn is_test_at(&self, at: usize) -> bool {
        self.is_test || self.tests.iter().any(|item| item.contains(&at))
    }
}

/// The first word of a text; empty if it begins with none.
pub fn first_word(text: &str) -> &str {
    let text = text.trim_start();
    let end = text.find(|c: char| !is_word(c));
    &text[..end.unwrap_or(text.len())]
}

/// Tells if a character may stand in a name.
pub fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

fn read_all() -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut paths = Vec::new();
    for folder in FOLDERS {
        collect(&root.join(folder), &mut paths);
    }
    paths.sort();
    let read = |path: &PathBuf| {
        let text = fs::read_to_string(path).unwrap();
        Source::new(path.strip_prefix(root).unwrap().to_owned(), text)
    };
    let mut sources: Vec<Source> = paths.iter().map(read).collect();
    mark_test_modules(&mut sources);
    sources
}

/// Finds the Rust files below a folder.
fn collect(folder: &Path, paths: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            collect(&path, paths);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            paths.push(path);
        }
    }
}

/// Marks the files, and the folders of files, that some file declares under `#[cfg(test)]`.
fn mark_test_modules(sources: &mut [Source]) {
    let declared = |source: &Source| {
        let items = source.tests.iter().map(|item| &source.text[item.clone()]);
        let names = items.filter_map(|item| {
            let (_, name) = item.strip_suffix(';')?.rsplit_once("mod ")?;
            Some(name.to_owned())
        });
        let below = |name| [source.module.clone(), vec![name]].concat();
        names.map(below).collect::<Vec<_>>()
    };
    let modules: Vec<Vec<String>> = sources.iter().flat_map(declared).collect();
    for source in sources {
        source.is_test |= modules
            .iter()
            .any(|module| source.module.starts_with(module));
    }
}

fn module_path(path: &Path) -> Vec<String> {
    let below = path.with_extension("");
    let words = below.iter().skip(1).map(|word| word.to_str().unwrap());
    let mut module: Vec<String> = words.map(str::to_owned).collect();
    if module.last().is_some_and(|last| last == "mod") || module == ["lib"] {
        module.pop();
    }
    module
}

/// Overwrites a piece with spaces and keeps its line breaks.
fn blank(code: &mut [u8], piece: &Range<usize>) {
    for byte in &mut code[piece.clone()] {
        if *byte != b'\n' {
            *byte = b' ';
        }
    }
}

/// The items under `#[cfg(test)]`, with the attribute, in code without comments and strings.
fn test_items(code: &str) -> Vec<Range<usize>> {
    let mut items: Vec<Range<usize>> = Vec::new();
    for (at, mark) in code.match_indices(TEST_MARK) {
        if items.last().is_none_or(|last| last.end <= at) {
            let after = at + mark.len();
            items.push(at..after + item_length(&code[after..]));
        }
    }
    items
}

/// The length of the item at the start of the code: up to its `;` or its closing brace.
fn item_length(code: &str) -> usize {
    let mut depth = 0;
    for (at, c) in code.char_indices() {
        match c {
            '{' | '(' | '[' => depth += 1,
            '}' | ')' | ']' => depth -= 1,
            _ => {}
        }
        if depth < 0 {
            return at;
        }
        if depth == 0 && (c == ';' || c == '}') {
            return at + 1;
        }
    }
    code.len()
}

/// The text cut into pieces of one kind each.
fn pieces(text: &str) -> Vec<(Kind, Range<usize>)> {
    let (mut pieces, mut start, mut at) = (Vec::new(), 0, 0);
    while let Some(first) = text[at..].chars().next() {
        let (kind, length) = hidden(&text[at..]);
        if kind == Kind::Code {
            at += first.len_utf8();
        } else {
            pieces.push((Kind::Code, start..at));
            pieces.push((kind, at..at + length));
            at += length;
            start = at;
        }
    }
    pieces.push((Kind::Code, start..at));
    pieces
}

/// The comment, string or character that a text begins with, and its length.
fn hidden(text: &str) -> (Kind, usize) {
    let until = |end: &str, from: usize| {
        let found = text[from..].find(end);
        found.map_or(text.len(), |at| from + at + end.len())
    };
    match text.as_bytes() {
        [b'/', b'/', ..] => (Kind::Comment, text.find('\n').unwrap_or(text.len())),
        [b'/', b'*', ..] => (Kind::Comment, until("*/", 2)),
        [b'r', b'#', b'"', ..] => (Kind::Text, until("\"#", 3)),
        [b'r', b'"', ..] => (Kind::Text, until("\"", 2)),
        [b'"', ..] => (Kind::Text, string_length(text)),
        [b'\'', b'\\', ..] => (Kind::Text, until("'", 3)),
        [b'\'', ..] => {
            let end = 1 + text[1..].chars().next().map_or(0, char::len_utf8);
            let is_character = end > 1 && text[end..].starts_with('\'');
            let kind = if is_character { Kind::Text } else { Kind::Code };
            (kind, end + 1)
        }
        _ => (Kind::Code, 0),
    }
}

/// The length of the string at the start of the text, with its quotes.
fn string_length(text: &str) -> usize {
    let mut escaped = false;
    for (at, c) in text.char_indices().skip(1) {
        match c {
            '"' if !escaped => return at + 1,
            '\\' => escaped = !escaped,
            _ => escaped = false,
        }
    }
    text.len()
}

mod tests {
    use super::*;

    /// Scans a text as a file of the program.
    fn scan(text: &str) -> Source {
        Source::new("src/room/file.rs".into(), text.to_owned())
    }

    #[test]
    fn comments_strings_and_characters_are_no_code() {
        let text = "a(\"{ b \\\" }\", '{', '\\'', r#\"c\"#, 'é'); // d\n/* e */ f::<'g>();\n";
        let source = scan(text);
        let words: Vec<&str> = source.code.split_whitespace().collect();
        assert_eq!(words.concat(), "a(,,,,);f::<'g>();");
        assert_eq!(source.code.len(), text.len());
        assert_eq!((source.comments.len(), source.strings.len()), (2, 5));
        assert_eq!(source.place(source.comments[1].start), "src/room/file.rs:2");
    }

    #[test]
    fn items_for_tests_are_no_code() {
        let source = scan(
            "use a;\n#[cfg(test)]\nuse b::{c, d};\n#[cfg(test)]\nmod e;\nfn f() {}\n\
             #[cfg(test)]\nmod tests {\n fn g() { h([0; 3]) }\n}\nfn i() {}\n",
        );
        let kept = source.code.replace([' ', '\n'], "");
        assert_eq!(kept, "usea;;fnf(){}fni(){}");
        assert!(source.is_test_at(source.text.find("g()").unwrap()));
    }

    #[test]
    fn a_file_declared_for_tests_is_a_test_with_all_below_it() {
        let mut sources = [
            ("src/a/mod.rs", "#[cfg(test)]\npub(crate) mod b;\nmod c;\n"),
            ("src/a/b/d.rs", ""),
            ("src/a/c.rs", ""),
        ]
        .map(|(path, text)| Source::new(path.into(), text.to_owned()));
        mark_test_modules(&mut sources);
        assert_eq!(sources.map(|source| source.is_test), [false, true, false]);
    }

    #[test]
    fn a_module_is_named_by_its_path() {
        let named = ["src/lib.rs", "src/cut/mod.rs", "src/cut/pins.rs"];
        let paths = named.map(|path| module_path(Path::new(path)).join("::"));
        assert_eq!(paths, ["", "cut", "cut::pins"]);
    }
}
