//! A page with the look of the shop's papers: one file, nothing from outside.

use maud::{DOCTYPE, Markup, PreEscaped, html};

/// How the page looks; part of the page, so that it is one file.
const STYLE: &str = include_str!("page.css");

/// What the page may load: its own pictures and style, and nothing from outside.
const POLICY: &str =
    "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'";

/// A page of the shop's papers, with their look and nothing from outside.
pub fn document(title: &str, body: &Markup) -> String {
    written(title, body, "")
}

pub(super) fn written(title: &str, body: &Markup, style: &str) -> String {
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
