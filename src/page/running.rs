//! The margins of every printed page: the job, its QR code, the units and the page number.

use maud::{Markup, html};

use super::job_id::JobId;
use crate::draw::{base64, code_path};

/// The units on the sheet.
pub(super) const UNITS: &str = "Lengths in mm, masses in g, angles in degrees.";

/// Side of the QR code in the running header, CSS pixels (96 per inch): 15 mm, 0.4 mm a module.
const HEADER_PX: usize = 57;

/// Returns the style of the printed margins. Browsers without margin boxes leave them empty.
pub(super) fn style(job: &JobId) -> String {
    let name = css_string(&format!("Job {}", job.short()));
    let units = css_string(UNITS);
    let code = code_path(&job.header_text()).map_or(String::new(), |(side, dark)| {
        let svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{HEADER_PX}\" height=\"{HEADER_PX}\" viewBox=\"0 0 {side} {side}\"><path d=\"{dark}\"/></svg>"
        );
        format!("@top-right {{ content: url(\"data:image/svg+xml;base64,{}\"); vertical-align: middle; }}", base64(svg.as_bytes()))
    });
    format!(
        "@page {{ @top-left {{ content: {name}; font: 700 10pt system-ui, sans-serif; white-space: nowrap; }} \
         @top-center {{ content: {units}; font: 10pt system-ui, sans-serif; }} {code} \
         @bottom-left {{ content: {name}; font: 10pt system-ui, sans-serif; white-space: nowrap; }} \
         @bottom-right {{ content: \"Page \" counter(page) \" of \" counter(pages); font: 10pt system-ui, sans-serif; }} }}"
    )
}

/// Returns the QR code of a job for the cover.
pub(super) fn code(job: &JobId) -> Markup {
    html! {
        @if let Some((side, dark)) = code_path(&job.text()) {
            svg class="qr" viewBox=(format!("0 0 {side} {side}")) role="img" aria-label=(format!("QR code: {}", job.text())) {
                rect width=(side) height=(side) fill="#ffffff" {}
                path d=(dark) fill="#000000" {}
            }
        }
    }
}

/// Returns the line that a screen shows above the sheet, in place of the margins.
pub(super) fn on_screen(job: &JobId) -> Markup {
    html! {
        p class="screen-only on-screen small" {
            "Job " strong { (job.short()) } ". " (UNITS) " Print this page on A4 or Letter, or work from the screen."
        }
    }
}

/// Returns a CSS string with all but letters, digits and harmless signs escaped.
fn css_string(text: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || " .,-_:".contains(c);
    let coded: String = text
        .chars()
        .map(|c| {
            if plain(c) {
                c.to_string()
            } else {
                format!("\\{:06x}", u32::from(c))
            }
        })
        .collect();
    format!("\"{coded}\"")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_cannot_end_its_css_string() {
        assert_eq!(
            css_string("a\"}</style>"),
            "\"a\\000022\\00007d\\00003c\\00002fstyle\\00003e\""
        );
    }

    #[test]
    fn every_page_has_the_job_the_units_the_code_and_its_number() {
        let style = style(&JobId {
            name: "box",
            sha256: "0123456789abcdef",
        });
        for part in [
            "Job box-01234567",
            "Lengths in mm",
            "data:image/svg+xml;base64",
            "counter(page)",
            "counter(pages)",
        ] {
            assert!(style.contains(part), "{part}");
        }
    }
}
