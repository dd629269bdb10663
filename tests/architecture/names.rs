//! The names that a file defines, imports and uses.

use std::collections::BTreeSet;

use crate::scanner::is_word;

/// The words that are followed by the name they define.
const DEFINING: [&str; 10] = [
    "fn",
    "struct",
    "enum",
    "union",
    "trait",
    "const",
    "static",
    "type",
    "macro_rules",
    "mod",
];

/// The words and signs of code; `::` is one sign.
pub fn tokens(code: &str) -> Vec<&str> {
    let (mut tokens, mut rest) = (Vec::new(), code.trim_start());
    while let Some(first) = rest.chars().next() {
        let length = match first {
            ':' if rest.starts_with("::") => 2,
            c if is_word(c) => rest.find(|c| !is_word(c)).unwrap_or(rest.len()),
            c => c.len_utf8(),
        };
        tokens.push(&rest[..length]);
        rest = rest[length..].trim_start();
    }
    tokens
}

/// The names defined outside all braces.
pub fn definitions(tokens: &[&str]) -> BTreeSet<String> {
    let mut depth = 0;
    let mut names = BTreeSet::new();
    for (at, token) in tokens.iter().enumerate() {
        match *token {
            "{" => depth += 1,
            "}" => depth -= 1,
            word if depth == 0 && DEFINING.contains(&word) => {
                let mut after = tokens[at + 1..].iter().filter(|token| **token != "!");
                // A file that is declared here is no item of this one.
                let name = after
                    .next()
                    .filter(|_| word != "mod" || after.next() == Some(&"{"));
                names.extend(name.map(|name| (*name).to_owned()));
            }
            _ => {}
        }
    }
    names
}

/// Tells if the tokens before a `use` make it public, if only to a part of the crate.
fn is_public(before: &[&str]) -> bool {
    let mut before = before.iter().rev();
    match before.next() {
        Some(&"pub") => true,
        Some(&")") => before.find(|token| **token == "(").and(before.next()) == Some(&"pub"),
        _ => false,
    }
}

/// The names that a `use` line brings in, each with its path.
pub fn imports<'a>(tree: &[&'a str]) -> Vec<(String, Vec<&'a str>)> {
    let path: Vec<&str> = tree
        .iter()
        .copied()
        .take_while(|token| !["{", "as"].contains(token))
        .collect();
    let path_words: Vec<&str> = path
        .iter()
        .copied()
        .filter(|token| *token != "::")
        .collect();
    let after = &tree[path.len()..];
    match after.first() {
        Some(&"{") => {
            let below = |item: &[&'a str]| imports(item).into_iter();
            let items = items(&after[1..]).into_iter().flat_map(below);
            let joined = items.map(|(name, rest)| {
                let path: Vec<&str> = path_words.iter().copied().chain(rest).collect();
                without_self(name, path)
            });
            joined.collect()
        }
        Some(_) => vec![(after[1].to_owned(), path_words)],
        None => match path_words.last() {
            Some(last) => vec![((*last).to_owned(), path_words)],
            None => Vec::new(),
        },
    }
}

/// Gives `{self}` at the end of a path the name of its module.
fn without_self(name: String, mut path: Vec<&str>) -> (String, Vec<&str>) {
    if path.len() > 1 && path.last() == Some(&"self") {
        path.pop();
        let is_renamed = name != "self";
        let name = if is_renamed {
            name
        } else {
            path[path.len() - 1].to_owned()
        };
        return (name, path);
    }
    (name, path)
}

/// The items of a list up to the brace that closes it.
fn items<'a, 'b>(list: &'b [&'a str]) -> Vec<&'b [&'a str]> {
    let (mut items, mut start, mut depth) = (Vec::new(), 0, 0);
    for (at, token) in list.iter().enumerate() {
        match *token {
            "{" => depth += 1,
            "}" if depth > 0 => depth -= 1,
            "," | "}" if depth == 0 => {
                items.push(&list[start..at]);
                start = at + 1;
                if *token == "}" {
                    break;
                }
            }
            _ => {}
        }
    }
    items
}

/// The paths of two words and more.
pub fn paths<'a>(tokens: &[&'a str]) -> Vec<Vec<&'a str>> {
    let path = |at: usize| {
        let steps = tokens[at + 1..].chunks_exact(2);
        let steps = steps.take_while(|step| step[0] == "::" && step[1].starts_with(is_word));
        let words = steps.map(|step| step[1]);
        [tokens[at]].into_iter().chain(words).collect::<Vec<_>>()
    };
    let is_start =
        |at: &usize| tokens[*at].starts_with(is_word) && (*at == 0 || tokens[*at - 1] != "::");
    let starts = (0..tokens.len()).filter(is_start);
    starts.map(path).filter(|path| path.len() > 1).collect()
}

/// Takes the `use` lines out of the tokens; returns if each is public, and its tree of names.
pub fn take_uses<'a>(tokens: &mut Vec<&'a str>) -> Vec<(bool, Vec<&'a str>)> {
    let mut uses = Vec::new();
    let mut from = 0;
    while let Some(at) = tokens[from..].iter().position(|token| *token == "use") {
        let at = from + at;
        from = at + 1;
        let end = tokens[at..].iter().position(|token| *token == ";");
        // `impl Trait + use<'a>` is no such line.
        if let Some(length) = end.filter(|_| tokens[at + 1] != "<") {
            let is_public = is_public(&tokens[..at]);
            uses.push((is_public, tokens.drain(at..at + length).skip(1).collect()));
        }
    }
    uses
}

mod tests {
    use super::*;

    #[test]
    fn only_items_at_the_top_of_a_file_are_its_definitions() {
        let code = "pub const fn a() { fn b() {} } mod c; mod d { type E = u8; } macro_rules! f {}";
        let names = definitions(&tokens(code)).into_iter().collect::<Vec<_>>();
        assert_eq!(names, ["a", "d", "f", "fn"]);
    }

    #[test]
    fn a_use_line_brings_in_the_last_words_of_its_paths() {
        let tree = tokens("a::{self, b::{C, D as E}, f::{self as g},}");
        let names = imports(&tree)
            .into_iter()
            .map(|(name, path)| format!("{name} = {}", path.join("::")));
        let expected = ["a = a", "C = a::b::C", "E = a::b::D", "g = a::f"];
        assert_eq!(names.collect::<Vec<_>>(), expected);
    }

    #[test]
    fn use_lines_are_separated_from_the_code() {
        let mut code = tokens("pub use a::b; fn c() -> impl D + use<'_> { use e; f() }");
        let uses = take_uses(&mut code);
        assert_eq!(uses, [(true, vec!["a", "::", "b"]), (false, vec!["e"])]);
        assert_eq!(code.concat(), "pub;fnc()->implD+use<'_>{;f()}");
    }

    #[test]
    fn a_use_line_may_be_public_to_a_part_of_the_crate() {
        let public = |before: &str| is_public(&tokens(before));
        assert!(public("} pub") && public("; pub(in crate::a)"));
        assert!(!public("pub fn f() {") && !public("#[allow(pub)]") && !public(""));
    }

    #[test]
    fn paths_have_two_words_and_more() {
        let code = "let a: b::C = d::<E>::f(g::h::I { j }); Self::k::<l::M>()";
        let found = paths(&tokens(code)).into_iter().map(|path| path.join("::"));
        assert_eq!(
            found.collect::<Vec<_>>(),
            ["b::C", "g::h::I", "Self::k", "l::M"]
        );
    }
}
