//! Words that readers of an early version could not follow do not come back.

use crate::holds;
use crate::scanner;

/// Parts of sentences that strangers stumbled over, as they were printed.
const OLD_WORDS: [&str; 41] = [
    "Spins stably",
    "its moment of inertia across the axis is at most",
    "filled solid  ",
    "no hollowing with what is kept solid",
    "no hollowing with this wall can",
    "that could not be cleaned stay solid",
    "no remedy: no size",
    "lowest vertices of the model support it",
    "it leans over by",
    "moments count the overlap twice",
    "the contact point is in the air",
    "will touch a flat floor first",
    "Say nothing but errors",
    "Use so many threads",
    "columns so far apart",
    "Lay stock parts into pockets",
    "Replace the folder if it is there",
    "either with :G_PER_CM3",
    "Mind:",
    "Sound ☐",
    "is allowed for facets",
    "where told at each below",
    "both are counted on",
    "Support is broken out in sight",
    "support is broken or flushed out in sight",
    "so there is no window to weigh in",
    "Joints in one row close in one movement",
    "a gram of it off the axis",
    "as weighed before",
    "the part behind the drawing",
    "A degree off",
    "glue on a tip of that length",
    "its shaft on two level knife edges",
    "Walls are counted wherever they lie",
    "What the machine makes of it",
    "Turn it and take it apart",
    "Cut open: not",
    "Start again",
    "is the ordered one, short by",
    "does not spin stably",
    "Does not spin stably",
];

#[test]
fn no_sentence_that_strangers_stumbled_over_comes_back() {
    let old = scanner::program().flat_map(|source| {
        let strings = source
            .strings
            .iter()
            .filter(|string| !source.is_test_at(string.start));
        strings.flat_map(|string| {
            // A string may go on in the next line of code.
            let text = source.text[string.clone()].replace("\\\n", "");
            let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
            let found = OLD_WORDS
                .iter()
                .filter(move |words| text.contains(words.trim_end()));
            found.map(|words| format!("{}: {words}", source.place(string.start)))
        })
    });
    holds(old, "say it in plain words");
}
