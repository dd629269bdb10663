//! An HTML document in the style of the shop's papers: one file that loads nothing.

use maud::{DOCTYPE, Markup, PreEscaped, html};

/// The style sheet; it is part of the page, so that the page is one file.
const STYLE: &str = include_str!("page.css");

/// The content policy: the page may use its own pictures, style and script, and load nothing.
const POLICY: &str =
    "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'";

/// Returns an HTML document in the style of the shop's papers, which loads nothing.
pub fn document(title: &str, body: &Markup) -> String {
    styled_document(title, body, "")
}

/// Returns an HTML document with additional style.
pub(super) fn styled_document(title: &str, body: &Markup, style: &str) -> String {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                title { (title) }
                style { (PreEscaped(STYLE)) (PreEscaped(style)) }
            }
            body { (body) }
        }
    }
    .into_string()
}
