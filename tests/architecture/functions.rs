//! Functions and files stay short, and functions ask for little.

use std::fmt::Display;

use crate::scanner::{self, Source, first_word, is_word};
use crate::{at_most, holds};

/// Lines of a file without its tests.
const MAX_FILE_LINES: usize = 400;
/// Lines of a file of the room that prepares a kit, which is read from top to bottom.
const MAX_LINE_FILE_LINES: usize = 200;
/// Lines of a function between its braces.
const MAX_FUNCTION_LINES: usize = 60;
/// Half of all functions have no more lines than this.
const MAX_MEDIAN_LINES: usize = 8;
/// Arguments of a function besides `self`.
const MAX_ARGUMENTS: usize = 4;

/// Files that are still too long. Final value: 0.
const LONG_FILES: usize = 0;
/// Functions that are still too long. Final value: 0.
const LONG_FUNCTIONS: usize = 0;
/// Functions that still ask for too many arguments. Final value: 0.
const GREEDY_FUNCTIONS: usize = 0;
/// Arguments that are still tuples of unlike types. Final value: 0.
const BUNDLES: usize = 0;

/// A function with a body.
struct Function<'a> {
    name: &'a str,
    /// Its first byte in the file.
    at: usize,
    /// Lines between its braces.
    lines: usize,
    /// Its arguments without `self`.
    arguments: Vec<&'a str>,
}

impl<'a> Function<'a> {
    /// Reads the function that begins at a `fn`; `None` if it has no name or no body.
    fn read(code: &'a str, at: usize) -> Option<Self> {
        let name = first_word(&code[at + "fn".len()..]);
        let open = at + find_outside(&code[at..], |c| c == '(')?;
        let close = open + closing(&code[open..])?;
        let body = close + find_outside(&code[close + 1..], |c| c == '{' || c == ';')? + 1;
        if name.is_empty() || code[body..].starts_with(';') {
            return None;
        }
        let end = body + closing(&code[body..])?;
        let arguments = split_outside(&code[open + 1..close], ',').into_iter();
        Some(Self {
            name,
            at,
            lines: code[body..end].matches('\n').count().saturating_sub(1),
            arguments: arguments.filter(|argument| !is_self(argument)).collect(),
        })
    }

    /// Counts the values it asks for: a tuple of unlike types counts as its members.
    fn asks(&self) -> usize {
        let members = self.arguments.iter().map(|argument| bundle(argument));
        members.map(|members| members.len().max(1)).sum()
    }
}

#[test]
fn no_file_is_too_long() {
    let long = scanner::program().filter_map(|source| {
        let lines = source.code.trim_end().lines().count();
        let is_line = source.room() == "prepare";
        let most = if is_line {
            MAX_LINE_FILE_LINES
        } else {
            MAX_FILE_LINES
        };
        (lines > most).then(|| format!("{}: {lines} lines", source.path.display()))
    });
    at_most(LONG_FILES, long, "split the file");
}

#[test]
fn no_function_is_too_long() {
    let long = faults(|function| {
        let lines = function.lines;
        (lines > MAX_FUNCTION_LINES).then(|| vec![format!("{lines} lines")])
    });
    at_most(LONG_FUNCTIONS, long, "split the function");
}

#[test]
fn no_function_asks_for_too_much() {
    let greedy = faults(|function| {
        let asks = function.asks();
        (asks > MAX_ARGUMENTS).then(|| vec![format!("{asks} arguments")])
    });
    at_most(GREEDY_FUNCTIONS, greedy, "gather the arguments in a struct");
}

#[test]
fn no_argument_is_a_tuple_of_unlike_types() {
    let bundles = faults(|function| {
        let bundles = function.arguments.iter().map(|argument| bundle(argument));
        let bundles = bundles.filter(|members| !members.is_empty());
        Some(bundles.map(|members| members.join(", ")).collect())
    });
    at_most(
        BUNDLES,
        bundles,
        "name a struct, or pass the values one by one",
    );
}

#[test]
fn half_of_the_functions_are_a_few_lines() {
    let functions = scanner::program().flat_map(functions);
    let mut lengths: Vec<usize> = functions.map(|function| function.lines).collect();
    lengths.sort_unstable();
    let median = lengths[lengths.len() / 2];
    println!("{} functions, median {median} lines", lengths.len());
    let long = (median > MAX_MEDIAN_LINES).then(|| format!("the median is {median} lines"));
    holds(long.into_iter(), "split the longer half");
}

/// The faults of every function of the program, with their places.
fn faults<D: Display>(find: impl Fn(&Function) -> Option<Vec<D>>) -> impl Iterator<Item = String> {
    scanner::program().flat_map(move |source| {
        let say = |function: Function| {
            let place = format!("{}: {}", source.place(function.at), function.name);
            let found = find(&function).into_iter().flatten();
            found
                .map(|fault| format!("{place}: {fault}"))
                .collect::<Vec<_>>()
        };
        functions(source).flat_map(say).collect::<Vec<_>>()
    })
}

/// The functions of a file that are not tests.
fn functions(source: &Source) -> impl Iterator<Item = Function<'_>> {
    let code = source.code.as_str();
    let starts = code.match_indices("fn ").map(|(at, _)| at);
    let starts = starts.filter(|at| !code[..*at].ends_with(is_word));
    starts.filter_map(|at| Function::read(code, at))
}

/// The types in an argument that is a tuple of unlike types; empty for other arguments.
fn bundle(argument: &str) -> Vec<&str> {
    let Some(colon) = find_outside(argument, |c| c == ':') else {
        return Vec::new();
    };
    let mut kind = argument[colon + 1..].trim();
    while let Some(referent) = kind.strip_prefix('&') {
        let referent = referent.trim_start();
        let lifetime = referent
            .strip_prefix('\'')
            .map(|name| name.trim_start_matches(is_word));
        kind = lifetime.unwrap_or(referent).trim_start();
        kind = kind.strip_prefix("mut ").unwrap_or(kind);
    }
    let inside = kind
        .strip_prefix('(')
        .and_then(|rest| rest.strip_suffix(')'));
    let members = inside.map_or(Vec::new(), |inside| split_outside(inside, ','));
    let are_alike = members.windows(2).all(|pair| pair[0] == pair[1]);
    if are_alike { Vec::new() } else { members }
}

fn is_self(argument: &str) -> bool {
    let name = argument.split(':').next().unwrap();
    let word = name
        .split(|c: char| !is_word(c))
        .rfind(|word| !word.is_empty());
    word == Some("self")
}

/// Finds the first character outside all brackets that fits. A single colon is no part of a path.
fn find_outside(code: &str, fits: impl Fn(char) -> bool) -> Option<usize> {
    let mut depth = 0;
    let mut before = ' ';
    for (at, c) in code.char_indices() {
        let is_path = c == ':' && (before == ':' || code[at + 1..].starts_with(':'));
        if depth == 0 && !is_path && fits(c) {
            return Some(at);
        }
        depth += nesting(before, c);
        before = c;
    }
    None
}

/// The place of the bracket that closes the one at the start of the code.
fn closing(code: &str) -> Option<usize> {
    let mut depth = 0;
    let mut before = ' ';
    for (at, c) in code.char_indices() {
        depth += if code.starts_with('{') {
            braces(c)
        } else {
            nesting(before, c)
        };
        if depth == 0 {
            return Some(at);
        }
        before = c;
    }
    None
}

/// Splits a list at the separators outside all brackets, without empty items.
fn split_outside(list: &str, separator: char) -> Vec<&str> {
    let (mut items, mut rest) = (Vec::new(), list);
    while let Some(at) = find_outside(rest, |c| c == separator) {
        items.push(rest[..at].trim());
        rest = &rest[at + 1..];
    }
    items.push(rest.trim());
    items.retain(|item| !item.is_empty());
    items
}

/// The change of depth at a character of a signature. The tip of an arrow changes nothing.
fn nesting(before: char, c: char) -> i32 {
    match c {
        '(' | '[' | '{' | '<' => 1,
        ')' | ']' | '}' => -1,
        '>' if before != '-' && before != '=' => -1,
        _ => 0,
    }
}

fn braces(c: char) -> i32 {
    i32::from(c == '{') - i32::from(c == '}')
}

mod tests {
    use super::*;

    /// The name, the lines and the number of arguments of every function of a text.
    fn measure(text: &str) -> Vec<(String, usize, usize)> {
        let source = Source::new("src/room/file.rs".into(), text.to_owned());
        let facts = |function: Function| {
            let asks = function.asks();
            (function.name.to_owned(), function.lines, asks)
        };
        functions(&source).map(facts).collect()
    }

    #[test]
    fn functions_are_measured_between_their_braces() {
        let text = "fn a() {}\nfn b() -> [u8; 3] {\n  c(\"}\");\n  // {\n}\npub fn d(\n  x: [u8; 3],\n) -> u8\n\
                    where\n  T: D<[u8; 2]>,\n{\n  0\n}\ntrait E { fn f(); fn g() { 1 < 2 } }\n";
        let mut found = measure(text);
        found.sort();
        let expected = [("a", 0, 0), ("b", 2, 0), ("d", 1, 1), ("g", 0, 0)];
        let expected = expected.map(|(name, lines, asks)| (name.to_owned(), lines, asks));
        assert_eq!(found, expected);
    }

    #[test]
    fn arguments_are_counted_without_self() {
        let asks = |signature: &str| measure(&format!("fn a{signature} {{}}"))[0].2;
        assert_eq!(
            asks("(&mut self, x: Vec<(u8, u8)>, f: &dyn Fn(u8, i8) -> u8)"),
            2
        );
        assert_eq!(asks("<'a, F: Fn(u8) -> u8>(self: &'a Self, mut f: F,)"), 1);
        assert_eq!(asks("(\n    self,\n    Point { x, y }: Point,\n)"), 1);
    }

    #[test]
    fn only_a_tuple_of_unlike_types_is_a_bundle() {
        assert_eq!(bundle("(a, b): (A, &[B; 3])"), ["A", "&[B; 3]"]);
        assert_eq!(bundle("x: &'a mut (A, Vec<(A, B)>)"), ["A", "Vec<(A, B)>"]);
        let alike = [
            "p: (A, A)",
            "r: Range<f64>",
            "p: [A; 2]",
            "l: &[(A, B)]",
            "f: impl Fn(A, B)",
        ];
        assert!(alike.iter().all(|argument| bundle(argument).is_empty()));
    }
}
