//! Holds the house in order: which room may see which, and the rules every file keeps.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Who may see whom: a room and everything it may import. A new arrow is a decision, written down
/// here.
///
/// base → geom → mesh → repair → io | shell → mass → goal | printer → interior → hollow → ballast →
/// job | voids → cut → draw | sheet → page | kit → pipeline → cli. `verify` sees nothing of shell, interior, hollow,
/// voids and cut: the judge does not know the accused.
const ARROWS: &[(&str, &[&str])] = &[
    ("base", &[]),
    ("geom", &["base"]),
    ("mesh", &["base", "geom"]),
    ("repair", &["geom", "mesh"]),
    ("io", &["repair", "geom", "mesh", "base"]),
    ("shell", &["geom", "mesh", "base"]),
    ("mass", &["geom", "mesh", "base"]),
    ("goal", &["geom", "mass", "mesh", "shell", "base"]),
    ("hardware", &["geom", "goal", "mass", "mesh", "base"]),
    ("printer", &["base"]),
    ("interior", &["geom", "mass", "mesh", "base", "shell"]),
    (
        "hollow",
        &["geom", "goal", "interior", "mass", "mesh", "base", "shell"],
    ),
    (
        "ballast",
        &[
            "geom", "goal", "hollow", "interior", "mass", "mesh", "printer", "base", "shell",
        ],
    ),
    (
        "advice",
        &[
            "geom", "goal", "hollow", "interior", "mass", "mesh", "base", "shell",
        ],
    ),
    (
        "voids",
        &["repair", "geom", "mass", "mesh", "base", "shell"],
    ),
    (
        "cut",
        &["repair", "geom", "mass", "mesh", "printer", "base", "voids"],
    ),
    (
        "verify",
        &[
            "repair", "base", "geom", "goal", "io", "mass", "mesh", "printer",
        ],
    ),
    ("draw", &["base", "geom", "mesh"]),
    ("sheet", &["base", "geom", "verify"]),
    (
        "page",
        &[
            "base", "draw", "geom", "goal", "mass", "mesh", "repair", "sheet", "verify",
        ],
    ),
    ("kit", &[]),
    (
        "coupon",
        &["geom", "io", "kit", "mesh", "page", "printer", "base"],
    ),
    ("job", &["ballast", "cut", "base", "goal"]),
    (
        "error",
        &[
            "repair", "ballast", "cut", "draw", "goal", "hardware", "hollow", "interior", "io",
            "job", "kit", "mesh", "printer", "sheet", "shell", "verify", "voids",
        ],
    ),
    (
        "pipeline",
        &[
            "repair", "advice", "ballast", "cut", "base", "draw", "error", "geom", "goal",
            "hardware", "hollow", "interior", "io", "job", "kit", "mass", "mesh", "page",
            "printer", "sheet", "shell", "verify", "voids",
        ],
    ),
    (
        "cli",
        &[
            "repair", "advice", "ballast", "coupon", "cut", "error", "geom", "goal", "io", "job",
            "kit", "mass", "mesh", "page", "pipeline", "printer", "base", "sheet", "verify",
        ],
    ),
    ("guide", &[]),
    ("lib", &[]),
    ("main", &["cli"]),
];

/// Lines of a file without its tests.
const MAX_FILE_LINES: usize = 400;
/// Lines of a function, from `fn` to its closing brace.
const MAX_FUNCTION_LINES: usize = 80;
/// Half of all functions have no more lines than this between their braces.
const MAX_MEDIAN_LINES: usize = 8;
/// Arguments of a function besides `self`.
const MAX_ARGUMENTS: usize = 4;
/// Traces of work that was not finished.
const SCAFFOLDING: [&str; 4] = ["TODO", "FIXME", "XXX", "HACK"];
/// What the compiler and clippy refuse for us.
const LINTS: [&str; 7] = [
    "unsafe_code = \"forbid\"",
    "missing_docs = \"warn\"",
    "unwrap_used = \"warn\"",
    "expect_used = \"warn\"",
    "panic = \"warn\"",
    "dbg_macro = \"warn\"",
    "todo = \"warn\"",
];
/// Calls that print, which only the command line may make.
const PRINTS: [&str; 4] = ["println!(", "eprintln!(", "print!(", "eprint!("];

/// What stands before a module of tests.
const TEST_MARK: &str = "\n#[cfg(test)]\n";

/// A source file that is not a test.
struct Source {
    path: PathBuf,
    room: String,
    text: String,
    /// The text without its tests, comments, strings and characters, line for line.
    code: String,
}

/// A function of the code.
struct Function {
    name: String,
    lines: usize,
    body_lines: usize,
    arguments: usize,
}

#[test]
fn every_room_sees_only_the_rooms_it_may() {
    let allowed: BTreeMap<&str, &[&str]> = ARROWS.iter().copied().collect();
    let wrong = sources().into_iter().flat_map(|source| {
        let may = allowed.get(source.room.as_str()).copied();
        let seen = rooms_seen(&source.code);
        let here = source.room.clone();
        seen.into_iter()
            .filter(move |seen| {
                *seen != here && !may.is_some_and(|may| may.contains(&seen.as_str()))
            })
            .map(move |seen| format!("{} sees {seen}", source.path.display()))
            .collect::<Vec<_>>()
    });
    holds(
        wrong,
        "an arrow points the wrong way, or a room is missing in ARROWS",
    );
}

#[test]
fn the_arrows_have_no_circle() {
    let mut placed = BTreeSet::new();
    while placed.len() < ARROWS.len() {
        let next = ARROWS
            .iter()
            .find(|(room, sees)| !placed.contains(room) && sees.iter().all(|s| placed.contains(s)));
        let Some((room, _)) = next else {
            panic!("a circle among the rooms besides {placed:?}")
        };
        placed.insert(room);
    }
}

#[test]
fn every_file_says_first_what_lives_in_it() {
    let wrong = sources()
        .into_iter()
        .filter(|source| !source.text.starts_with("//! "));
    holds(
        wrong.map(|source| source.path.display().to_string()),
        "the first line must be `//! …`",
    );
}

#[test]
fn no_file_is_too_long() {
    let long = sources()
        .into_iter()
        .map(|source| (source.code.trim_end().lines().count(), source.path));
    let long = long.filter(|(lines, _)| *lines > MAX_FILE_LINES);
    holds(
        long.map(|(lines, path)| format!("{}: {lines} lines", path.display())),
        "split the file",
    );
}

#[test]
fn no_function_is_too_long_or_asks_too_much() {
    let wrong = sources().into_iter().flat_map(|source| {
        let faulty = |f: &Function| f.lines > MAX_FUNCTION_LINES || f.arguments > MAX_ARGUMENTS;
        let path = source.path.display().to_string();
        let say = move |f: Function| {
            format!(
                "{path}: {} has {} lines, {} arguments",
                f.name, f.lines, f.arguments
            )
        };
        functions(&source.code)
            .into_iter()
            .filter(faulty)
            .map(say)
            .collect::<Vec<_>>()
    });
    holds(
        wrong,
        "split the function, or gather its arguments in a struct",
    );
}

#[test]
fn half_of_the_functions_are_a_few_lines() {
    let mut lengths: Vec<usize> = sources()
        .iter()
        .flat_map(|source| functions(&source.code))
        .map(|function| function.body_lines)
        .collect();
    lengths.sort_unstable();
    let median = lengths[lengths.len() / 2];
    assert!(
        median <= MAX_MEDIAN_LINES,
        "the median of {} functions is {median} lines",
        lengths.len()
    );
}

#[test]
fn nothing_is_left_unfinished() {
    let wrong = sources().into_iter().flat_map(|source| {
        let left = SCAFFOLDING
            .into_iter()
            .filter(|word| source.text.contains(word));
        left.map(|word| format!("{}: {word}", source.path.display()))
            .collect::<Vec<_>>()
    });
    holds(wrong, "finish it, or open an issue");
}

#[test]
fn only_the_command_line_prints() {
    let quiet = sources()
        .into_iter()
        .filter(|source| !matches!(source.room.as_str(), "cli" | "main"));
    holds(
        quiet.flat_map(|source| calls(&source, &PRINTS)),
        "return a value, or report progress",
    );
}

#[test]
fn the_compiler_keeps_out_unsafe_code_panics_and_undocumented_items() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    assert!(
        fs::read_to_string(root.join("src/lib.rs"))
            .unwrap()
            .contains("#![forbid(unsafe_code)]")
    );
    let manifest = fs::read_to_string(root.join("Cargo.toml")).unwrap();
    for lint in LINTS {
        assert!(manifest.contains(lint), "{lint} is missing in Cargo.toml");
    }
}

#[test]
fn the_scanner_sees_what_it_should() {
    let text = "fn a(\n &self, x: Vec<(u8, u8)>, f: &dyn Fn(u8) -> u8) { // crate::no\n let s = \"crate::no {\"; '{'; }\n\
                #[cfg(test)]\npub mod tests {\n fn b() { crate::no } }\n";
    let code = stripped(without_tests(text));
    assert!(!code.contains("no") && !code.contains('b'));
    let found = functions(&code);
    assert_eq!((found.len(), found[0].arguments, found[0].lines), (1, 2, 3));
    let imports = stripped(
        "use crate::{geom::{Point, Vector}, mesh};\nlet x: &'static str = crate::io::name();",
    );
    assert_eq!(
        rooms_seen(&imports),
        ["geom", "io", "mesh"].map(String::from).into()
    );
}

/// Fails with every fault on its own line.
fn holds(faults: impl Iterator<Item = String>, remedy: &str) {
    let faults: Vec<String> = faults.collect();
    assert!(faults.is_empty(), "{remedy}:\n{}", faults.join("\n"));
}

/// The calls from a list that a source makes, with their lines.
fn calls(source: &Source, list: &[&str]) -> Vec<String> {
    let at = |(line, code): (usize, &str)| {
        let found = list.iter().find(|call| {
            code.split(**call)
                .next()
                .is_some_and(|before| before.len() < code.len())
        });
        found.map(|call| format!("{}:{}: {call}", source.path.display(), line + 1))
    };
    source.code.lines().enumerate().filter_map(at).collect()
}

/// Every source file of the program that is not a test, in the order of their paths.
fn sources() -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut paths = Vec::new();
    collect(&root, &mut paths);
    paths.sort();
    let source = |path: PathBuf| {
        let text = fs::read_to_string(root.join(&path)).unwrap();
        let room = path
            .iter()
            .next()
            .unwrap()
            .to_string_lossy()
            .trim_end_matches(".rs")
            .to_owned();
        Source {
            code: stripped(without_tests(&text)),
            text,
            room,
            path,
        }
    };
    paths
        .iter()
        .map(|path| source(path.strip_prefix(&root).unwrap().to_owned()))
        .collect()
}

/// The Rust files below a folder, but for modules that are only compiled for tests.
fn collect(folder: &Path, paths: &mut Vec<PathBuf>) {
    let entries: Vec<PathBuf> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    let parents = [
        folder.join("mod.rs"),
        folder.join("lib.rs"),
        folder.with_extension("rs"),
    ];
    let declared: String = parents
        .iter()
        .filter_map(|parent| fs::read_to_string(parent).ok())
        .collect();
    for path in entries
        .into_iter()
        .filter(|path| !is_test_module(&declared, path))
    {
        if path.is_dir() {
            collect(&path, paths);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            paths.push(path);
        }
    }
}

/// Whether a file's parent declares it under `#[cfg(test)]`.
fn is_test_module(declared: &str, path: &Path) -> bool {
    let declaration = format!("mod {};", path.file_stem().unwrap().to_string_lossy());
    let lines: Vec<&str> = declared.lines().map(str::trim).collect();
    lines
        .windows(2)
        .any(|pair| pair[0] == "#[cfg(test)]" && pair[1].ends_with(&declaration))
}

/// The text before its first test module.
fn without_tests(text: &str) -> &str {
    let is_module = |after: &str| {
        after
            .lines()
            .next()
            .is_some_and(|line| line.contains("mod ") && line.ends_with('{'))
    };
    let marks = text.match_indices(TEST_MARK);
    let module = marks
        .map(|(at, mark)| (at, &text[at + mark.len()..]))
        .find(|(_, after)| is_module(after));
    module.map_or(text, |(at, _)| &text[..=at])
}

/// The text with comments, strings and characters blanked out, line for line.
fn stripped(text: &str) -> String {
    let mut code = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let hidden = hidden_length(rest);
        let length = if hidden == 0 {
            first.len_utf8()
        } else {
            hidden
        };
        let (piece, after) = rest.split_at(length);
        if hidden == 0 {
            code.push(first);
        } else {
            code.extend(piece.chars().map(|c| if c == '\n' { '\n' } else { ' ' }));
        }
        rest = after;
    }
    code
}

/// The length of the comment, string or character at the start of the text; zero if there is none.
fn hidden_length(text: &str) -> usize {
    let until = |end: &str, from: usize| {
        text[from..]
            .find(end)
            .map_or(text.len(), |at| from + at + end.len())
    };
    match text.as_bytes() {
        [b'/', b'/', ..] => text.find('\n').unwrap_or(text.len()),
        [b'/', b'*', ..] => until("*/", 2),
        [b'r', b'#', b'"', ..] => until("\"#", 3),
        [b'r', b'"', ..] => until("\"", 2),
        [b'"', ..] => string_length(text),
        [b'\'', b'\\', ..] => until("'", 3),
        [b'\'', ..] => text[1..].chars().next().map_or(0, |c| {
            let end = 1 + c.len_utf8();
            if text[end..].starts_with('\'') {
                end + 1
            } else {
                0
            }
        }),
        _ => 0,
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

/// The rooms named in `crate::…` paths.
fn rooms_seen(code: &str) -> BTreeSet<String> {
    let after_crate = code
        .match_indices("crate::")
        .map(|(at, path)| &code[at + path.len()..]);
    after_crate
        .flat_map(|rest| match rest.strip_prefix('{') {
            Some(group) => top_level(group),
            None => vec![first_word(rest)],
        })
        .filter(|word| word.chars().next().is_some_and(char::is_lowercase))
        .collect()
}

fn first_word(text: &str) -> String {
    text.trim_start()
        .chars()
        .take_while(|c| c.is_alphanumeric() || *c == '_')
        .collect()
}

/// The first words of the items of a list that ends with the brace it was opened with.
fn top_level(group: &str) -> Vec<String> {
    let mut depth = 0;
    let mut words = vec![first_word(group)];
    for (at, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => break,
            '}' => depth -= 1,
            ',' if depth == 0 => words.push(first_word(&group[at + 1..])),
            _ => {}
        }
    }
    words
}

/// The functions with a body.
fn functions(code: &str) -> Vec<Function> {
    let starts = code
        .match_indices("fn ")
        .filter(|(at, _)| !code[..*at].ends_with(|c: char| c.is_alphanumeric() || c == '_'));
    starts.filter_map(|(at, _)| function(&code[at..])).collect()
}

/// The function at the start of the code; none if it has no name or no body.
fn function(code: &str) -> Option<Function> {
    let name = first_word(&code[3..]);
    let body = code
        .find(['{', ';'])
        .filter(|at| code[*at..].starts_with('{') && !name.is_empty())?;
    let mut depth = 0;
    let end = code[body..].char_indices().find(|(_, c)| {
        depth += i32::from(*c == '{') - i32::from(*c == '}');
        depth == 0
    });
    let end = body + end?.0;
    Some(Function {
        arguments: arguments(&code[..body]),
        lines: code[..end].matches('\n').count() + 1,
        body_lines: code[body..end].matches('\n').count().saturating_sub(1),
        name,
    })
}

/// How many arguments a signature has besides `self`.
fn arguments(signature: &str) -> usize {
    let signature = signature.replace("->", "  ");
    let mut angle = 0;
    let open = signature.char_indices().find(|(_, c)| {
        angle += i32::from(*c == '<') - i32::from(*c == '>');
        *c == '(' && angle == 0
    });
    let Some((open, _)) = open else { return 0 };
    let (mut depth, mut items) = (0, vec![String::new()]);
    for c in signature[open..].chars() {
        depth += i32::from("(<[".contains(c)) - i32::from(")>]".contains(c));
        match c {
            ',' if depth == 1 => items.push(String::new()),
            _ if depth == 0 => break,
            _ => items.last_mut().unwrap().push(c),
        }
    }
    let is_self = |item: &str| {
        item.trim_start_matches(['(', '&', ' ', '\n'])
            .trim_start_matches("mut ")
            .trim()
            == "self"
    };
    let item = |item: &&String| !item.trim_matches(['(', ' ', '\n']).is_empty() && !is_self(item);
    items.iter().filter(item).count()
}
