//! Inside every room the files form no circle.

use std::collections::{BTreeMap, BTreeSet};

use crate::holds;
use crate::names::{definitions, imports, paths, take_uses, tokens};
use crate::scanner::{self, Source};

/// Rooms in which some files still form a circle. A room that has none any more must leave.
const KNOWN: &[&str] = &[];

/// Most `pub use` lines that a name may pass through.
const MAX_DEPTH: usize = 8;

/// The path of a module or an item below the crate's root.
type ItemPath = Vec<String>;

/// The names that the files of the program define and use.
struct Crate {
    modules: BTreeMap<ItemPath, Module>,
}

/// A file, seen by the names in it.
struct Module {
    file: String,
    /// The items it defines at its top level.
    defines: BTreeSet<String>,
    /// The names its `use` lines bring in, and the paths they stand for.
    imports: BTreeMap<String, ItemPath>,
    /// The paths it uses: `use` lines without `pub`, and paths in the code.
    uses: Vec<ItemPath>,
}

/// A file, the files that define what it uses, and the names it uses of each.
type Arrows<'a> = BTreeMap<&'a str, BTreeMap<&'a str, BTreeSet<String>>>;

#[test]
fn no_files_form_a_circle() {
    let program: Vec<&Source> = scanner::program().collect();
    let home = Crate::read(&program);
    let arrows = home.arrows();
    let room = |circle: &[&str]| circle[0].split('/').nth(1).unwrap().to_owned();
    let circles = circles(&arrows);
    let describe = |circle: &Vec<&str>| (room(circle), describe(circle, &arrows));
    let found: Vec<(String, String)> = circles.iter().map(describe).collect();
    found.iter().for_each(|(_, text)| println!("{text}"));
    println!("{} files, {} circles", program.len(), circles.len());

    let is_known = |room: &str| KNOWN.contains(&room);
    let new = found.iter().filter(|(room, _)| !is_known(room));
    let new = new.map(|(_, text)| text.clone());
    holds(new, "move what both need into a file below them");
    let is_left = |known: &str| found.iter().any(|(room, _)| room == known);
    let solved = KNOWN.iter().filter(|known| !is_left(known));
    let solved = solved.map(|room| (*room).to_owned());
    holds(solved, "take the room out of KNOWN");
}

impl Crate {
    fn read(sources: &[&Source]) -> Self {
        let named: BTreeSet<ItemPath> =
            sources.iter().map(|source| source.module.clone()).collect();
        let read = |source: &&Source| (source.module.clone(), Module::read(source, &named));
        Self {
            modules: sources.iter().map(read).collect(),
        }
    }

    fn arrows(&self) -> Arrows<'_> {
        let mut arrows = Arrows::new();
        for module in self.modules.values() {
            for path in &module.uses {
                if let Some((file, name)) = self.definition(path, MAX_DEPTH)
                    && file != module.file
                {
                    let seen = arrows.entry(&module.file).or_default();
                    seen.entry(file).or_default().insert(name);
                }
            }
        }
        arrows
    }

    /// The file that defines what a path names, and its name; `None` if it names a module.
    fn definition(&self, path: &[String], depth: usize) -> Option<(&str, String)> {
        let mut prefixes = (0..path.len()).rev().map(|length| path.split_at(length));
        let (module, rest) =
            prefixes.find_map(|(module, rest)| Some((self.modules.get(module)?, rest)))?;
        let (name, after) = rest.split_first()?;
        match module.imports.get(name) {
            Some(import) if depth > 0 && !module.defines.contains(name) => {
                self.definition(&[import, after].concat(), depth - 1)
            }
            _ if self.modules.contains_key(path) => None,
            _ => Some((&module.file, name.clone())),
        }
    }
}

impl Module {
    /// Reads a file of a crate that has the named modules.
    fn read(source: &Source, named: &BTreeSet<ItemPath>) -> Self {
        let here = &source.module;
        let scope = Scope { here, named };
        let mut code = tokens(&source.code);
        let defines = definitions(&code);
        let (mut imported, mut uses) = (BTreeMap::new(), Vec::new());
        for (is_public, tree) in take_uses(&mut code) {
            let names = imports(&tree).into_iter();
            for (name, path) in
                names.filter_map(|(name, path)| Some((name, scope.absolute(&path)?)))
            {
                uses.extend((!is_public).then(|| path.clone()));
                imported.insert(name, path);
            }
        }
        uses.extend(paths(&code).iter().filter_map(|path| {
            let import = imported.get(path[0]).map(|import| join(import, &path[1..]));
            import.or_else(|| scope.absolute(path))
        }));
        let file = source.path.display().to_string();
        Self {
            file,
            defines,
            imports: imported,
            uses,
        }
    }
}

/// The surroundings in which the paths of a file are read.
struct Scope<'a> {
    here: &'a [String],
    named: &'a BTreeSet<ItemPath>,
}

impl Scope<'_> {
    /// The path below the crate's root; `None` if it leads into another crate.
    fn absolute(&self, path: &[&str]) -> Option<ItemPath> {
        let ups = path.iter().take_while(|word| **word == "super").count();
        match path[0] {
            "crate" => Some(join(&[], &path[1..])),
            "self" => Some(join(self.here, &path[1..])),
            "super" => {
                let above = self.here.len().checked_sub(ups)?;
                Some(join(&self.here[..above], &path[ups..]))
            }
            child => {
                let is_child = self.named.contains(&join(self.here, &[child]));
                is_child.then(|| join(self.here, path))
            }
        }
    }
}

/// Joins two pieces of a path.
fn join(start: &[String], rest: &[&str]) -> ItemPath {
    let rest = rest.iter().map(|word| (*word).to_owned());
    start.iter().cloned().chain(rest).collect()
}

/// The sets of more than one file in which every file leads to every other.
fn circles<'a>(arrows: &Arrows<'a>) -> Vec<Vec<&'a str>> {
    let mut reach: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for start in arrows.keys().copied() {
        let mut seen = BTreeSet::new();
        let mut open = vec![start];
        while let Some(file) = open.pop() {
            let next = arrows.get(file).into_iter().flat_map(BTreeMap::keys);
            open.extend(next.filter(|file| seen.insert(**file)));
        }
        reach.insert(start, seen);
    }
    let in_circle =
        |a: &str, b: &str| reach[a].contains(b) && reach.get(b).is_some_and(|r| r.contains(a));
    let circle = |start: &&'a str| {
        let files = reach[start]
            .iter()
            .copied()
            .filter(|file| in_circle(start, file));
        files.collect::<Vec<&'a str>>()
    };
    let circles: BTreeSet<_> = arrows
        .keys()
        .map(circle)
        .filter(|files| !files.is_empty())
        .collect();
    circles.into_iter().collect()
}

/// Describes a circle by the names that close it, one arrow a line.
fn describe(circle: &[&str], arrows: &Arrows) -> String {
    let mut text = format!("a circle of {} files", circle.len());
    for from in circle {
        for (to, names) in arrows[from].iter().filter(|(to, _)| circle.contains(to)) {
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            text += &format!("\n    {from} → {to}: {}", names.join(", "));
        }
    }
    text
}

mod tests {
    use super::*;

    /// The arrows among files of the given texts, without the names.
    fn arrows(files: &[(&str, &str)]) -> Vec<String> {
        let source = |(path, text): &(&str, &str)| {
            Source::new(format!("src/{path}").into(), (*text).to_owned())
        };
        let sources: Vec<Source> = files.iter().map(source).collect();
        let home = Crate::read(&sources.iter().collect::<Vec<_>>());
        let arrows = home.arrows();
        let texts = arrows.iter().flat_map(|(from, tos)| {
            let to = |(to, names): (&&str, &BTreeSet<String>)| {
                let names: Vec<&str> = names.iter().map(String::as_str).collect();
                format!("{} {} {}", from, to, names.join(" "))
            };
            tos.iter().map(to).collect::<Vec<_>>()
        });
        texts.map(|arrow| arrow.replace("src/", "")).collect()
    }

    #[test]
    fn an_arrow_leads_to_the_file_that_defines_the_name() {
        let files = [
            ("lib.rs", "pub mod a; pub use a::Deep as Top;"),
            (
                "a/mod.rs",
                "mod b; mod c; pub use b::{B, inner::Deep}; pub(crate) use self::c::c;",
            ),
            (
                "a/b/mod.rs",
                "pub mod inner; pub struct B; type D = super::B;",
            ),
            (
                "a/b/inner.rs",
                "pub struct Deep; use super::super::{c as other, B};",
            ),
            (
                "a/c.rs",
                "pub fn c() { crate::Top::new(); std::mem::take(x) }",
            ),
            (
                "d.rs",
                "use crate::a::{self, B}; fn e() { a::c::<u8>(); a::B::x(); }",
            ),
        ];
        let expected = [
            "a/b/inner.rs a/b/mod.rs B",
            "a/b/inner.rs a/c.rs c",
            "a/c.rs a/b/inner.rs Deep",
            "d.rs a/b/mod.rs B",
            "d.rs a/c.rs c",
        ];
        assert_eq!(arrows(&files), expected);
    }

    #[test]
    fn declarations_re_exports_and_tests_make_no_arrow() {
        let files = [
            (
                "a/mod.rs",
                "mod b; pub use b::B; /// [`b::C`]\n fn f() { \"b::C\"; }",
            ),
            (
                "a/b.rs",
                "pub struct B; #[cfg(test)] mod tests { use super::super::f; }",
            ),
        ];
        assert_eq!(arrows(&files), [""; 0]);
    }

    #[test]
    fn a_circle_is_found_with_all_its_files_and_no_more() {
        let uses = |names: &[&str]| {
            names
                .iter()
                .map(|name| format!("use super::{name}::x;"))
                .collect::<String>()
        };
        let texts = [
            ("a", uses(&["b"])),
            ("b", uses(&["c", "d"])),
            ("c", uses(&["a"])),
            ("d", uses(&[])),
        ];
        let source = |(name, text): &(&str, String)| {
            Source::new(
                format!("src/{name}.rs").into(),
                format!("{text} fn x() {{}}"),
            )
        };
        let sources = texts.each_ref().map(source);
        let home = Crate::read(&sources.each_ref());
        let arrows = home.arrows();
        let circles = circles(&arrows);
        assert_eq!(circles, [["src/a.rs", "src/b.rs", "src/c.rs"]]);
        assert!(describe(&circles[0], &arrows).contains("src/c.rs → src/a.rs: x"));
    }
}
