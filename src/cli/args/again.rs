//! The command that was typed, as another command with the same options.

use super::quote::quoted;
use super::typed::has_model_ending;

/// The commands that share their options.
const ALIKE: [&str; 2] = ["prepare", "cuts"];
/// Options of one run only, which take a value.
const OWN_WITH_VALUE: [&str; 5] = ["--out", "--plans", "--cut", "--threads", "--drain"];
/// Options of one run only, which take none.
const OWN: [&str; 9] = [
    "--plugs",
    "--force",
    "--json",
    "--quiet",
    "-q",
    "--verbose",
    "-v",
    "--no-questions",
    "-vv",
];

/// Returns the typed command line as `command` with `more` at its end. `None` if it names neither a
/// command that shares its options nor a model.
pub fn again(typed: &[String], command: &str, more: &str) -> Option<String> {
    let mut words = typed.iter().skip(1).map(String::as_str).peekable();
    let mut kept = Vec::new();
    let mut has_command = false;
    while let Some(word) = words.next() {
        if !has_command && ALIKE.contains(&word) {
            has_command = true;
        } else if OWN_WITH_VALUE.contains(&word) {
            words.next();
        } else if !is_own(word) {
            kept.push(quoted(word));
        }
    }
    let is_known = has_command || typed.iter().any(|word| has_model_ending(word.as_ref()));
    (is_known && !kept.is_empty()).then(|| {
        let rest = kept.join(" ");
        format!("equipoise {command} {rest} {more}")
            .trim_end()
            .to_owned()
    })
}

/// Returns whether a word is an option of one run only, with its value or without one.
fn is_own(word: &str) -> bool {
    let name = word.split_once('=').map_or(word, |(name, _)| name);
    OWN.contains(&word) || OWN_WITH_VALUE.contains(&name)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(line: &str) -> Vec<String> {
        line.split(' ').map(str::to_owned).collect()
    }

    #[test]
    fn a_plan_is_chosen_with_all_options_that_were_typed() {
        let typed =
            words("equipoise cuts a.stl --goal stand --size=90mm --out x --force --plans=3");
        assert_eq!(
            again(&typed, "prepare", "--cut x/plan1.toml").as_deref(),
            Some("equipoise prepare a.stl --goal stand --size=90mm --cut x/plan1.toml")
        );
    }

    #[test]
    fn other_plans_are_asked_for_as_the_kit_was() {
        let typed = words("./equipoise -q prepare a.stl --threads 2 --up=-y --json");
        assert_eq!(
            again(&typed, "cuts", "").as_deref(),
            Some("equipoise cuts a.stl --up=-y")
        );
        assert_eq!(
            again(&words("equipoise a.stl --goal top"), "cuts", "").as_deref(),
            Some("equipoise cuts a.stl --goal top")
        );
        assert_eq!(again(&words("equipoise"), "cuts", ""), None);
        assert_eq!(again(&words("equipoise prepare"), "cuts", ""), None);
    }
}
