//! The map of the code in `src/guide/map.rs` names files and items that exist.

use std::fs;
use std::path::Path;

use super::holds;

/// The least number of questions on the map.
const QUESTIONS: usize = 10;

/// A row of the map: the question, the files and the names of its answer.
struct Row<'a> {
    question: &'a str,
    files: Vec<&'a str>,
    names: Vec<&'a str>,
}

/// The rows of the map's table.
fn rows(map: &str) -> Vec<Row<'_>> {
    let lines = map.lines().filter_map(|line| line.strip_prefix("//! | "));
    let rows = lines.filter_map(|line| line.split_once(" | "));
    rows.filter(|(question, _)| question.ends_with('?'))
        .map(|(question, answer)| {
            let words = answer.split('`').skip(1).step_by(2);
            let (files, names) = words.partition(|word| word.contains('/'));
            Row {
                question,
                files,
                names,
            }
        })
        .collect()
}

#[test]
fn the_map_of_the_code_names_files_and_items_that_exist() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let map = fs::read_to_string(root.join("src/guide/map.rs")).unwrap();
    let rows = rows(&map);
    assert!(rows.len() >= QUESTIONS, "{} questions", rows.len());
    let faults = rows.iter().flat_map(|row| {
        let texts: Vec<Result<String, _>> = row
            .files
            .iter()
            .map(|file| fs::read_to_string(root.join("src").join(file)))
            .collect();
        let missing = row.files.iter().zip(&texts);
        let missing = missing.filter_map(|(file, text)| text.is_err().then_some(*file));
        let unknown = row.names.iter().copied().filter(|name| {
            let last = name.rsplit("::").next().unwrap_or(name);
            let is_folder = root.join(last).is_dir();
            let mut read = texts.iter().flatten();
            !is_folder && !read.any(|text| text.contains(last))
        });
        let faults: Vec<&str> = missing.chain(unknown).collect();
        let question = row.question;
        faults
            .into_iter()
            .map(move |fault| format!("{question} {fault}"))
    });
    holds(faults, "correct src/guide/map.rs");
}

#[test]
fn rows_are_read_with_their_files_and_names() {
    let map = "//! | question | answer |\n//! | Where? | `a` in `b/c.rs`, `d::e` |";
    let rows = rows(map);
    assert_eq!(rows.len(), 1);
    assert_eq!(rows[0].files, ["b/c.rs"]);
    assert_eq!(rows[0].names, ["a", "d::e"]);
}
