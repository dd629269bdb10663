//! Alterations of the checklist: each number, word and truth of it alone.

use serde_json::{Value, json};

/// The share by which a number is moved, of itself or of the largest number beside it.
const STEP_RATIO: f64 = 0.01;
/// The least step of a number.
const LEAST_STEP: f64 = 0.01;
/// Shares that are estimated from sample points are moved by more than their tolerance.
const SAMPLED: (&str, f64) = ("sight_ratio", 0.1);

/// Returns the pointers of all values that can be altered, in their order.
pub fn pointers(sheet: &Value) -> Vec<String> {
    let mut found = Vec::new();
    collect("", sheet, &mut found);
    found
}

fn collect(at: &str, value: &Value, found: &mut Vec<String>) {
    match value {
        Value::Object(rows) => {
            for (key, value) in rows {
                let key = key.replace('~', "~0").replace('/', "~1");
                collect(&format!("{at}/{key}"), value, found);
            }
        }
        Value::Array(rows) => {
            for (index, value) in rows.iter().enumerate() {
                collect(&format!("{at}/{index}"), value, found);
            }
        }
        Value::Null => {}
        _ => found.push(at.to_owned()),
    }
}

/// Alters the value at a pointer: a number by a step, a count by one, a truth to its opposite, a
/// word by a letter.
pub fn alter(sheet: &mut Value, pointer: &str, sign: f64) {
    let beside = pointer
        .rsplit_once('/')
        .and_then(|(row, _)| sheet.pointer(row));
    let beside = beside.map_or(0.0, largest);
    let value = sheet.pointer_mut(pointer).unwrap();
    *value = match &*value {
        Value::Number(number) if number.is_f64() => {
            let x = number.as_f64().unwrap_or_default();
            let step = STEP_RATIO * x.abs().max(beside);
            let least = if pointer.ends_with(SAMPLED.0) {
                SAMPLED.1
            } else {
                LEAST_STEP
            };
            json!(x + sign * step.max(least))
        }
        Value::Number(number) => json!(number.as_u64().unwrap_or_default() + 1),
        Value::Bool(truth) => json!(!truth),
        Value::String(word) => json!(alter_word(word)),
        other => other.clone(),
    };
}

/// Returns the largest number of a row of numbers; 0 for other rows.
fn largest(row: &Value) -> f64 {
    let numbers = row.as_array().into_iter().flatten();
    let numbers = numbers.map(|x| x.as_f64().unwrap_or_default().abs());
    numbers.fold(0.0, f64::max)
}

/// Returns a word with another last letter.
fn alter_word(word: &str) -> String {
    let mut letters: Vec<char> = word.chars().collect();
    match letters.pop() {
        Some('0') => letters.push('1'),
        Some(_) => letters.push('0'),
        None => letters.push('x'),
    }
    letters.into_iter().collect()
}
