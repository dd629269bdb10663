//! The frame of the pages of wings: their cover, their steps, and the hashes of their files.

use std::collections::BTreeMap;

use maud::{Markup, html};

use super::fields::{blank, sentence};
use super::job_id::JobId;
use super::running::{code, on_screen};
use super::words;
use crate::sheet::{KindSheet, Verdict};

/// The cover of a job sheet.
pub(super) struct Cover<'a> {
    pub job: &'a JobId<'a>,
    /// The promise in one sentence.
    pub promise: String,
    /// The word of a broken verdict.
    pub broken: &'static str,
    /// The names of the lines that the shop fills in.
    pub fields: &'a [&'static str],
}

impl Cover<'_> {
    /// Returns the cover with its warnings; `content` is what the overview shows below them.
    pub fn draw(&self, sheet: &impl KindSheet, content: &Markup) -> Markup {
        html! {
            header class="cover" {
                (on_screen(self.job))
                (title("Job sheet", self.job, &self.promise, &self.verdict(sheet)))
                div class="code" { (code(self.job)) }
            }
            section aria-label="Overview" {
                p class="fields" {
                    @for field in self.fields {
                        span class="field" { (field) " " (blank()) } " "
                    }
                }
                @for warning in sheet.warnings() { p class="warn" { strong { "Warning: " } (sentence(warning)) } }
                (content)
            }
        }
    }

    fn verdict(&self, sheet: &impl KindSheet) -> Markup {
        let (class, word) = match sheet.verdict() {
            Verdict::Pass => ("verdict pass", "✓ all promises kept"),
            Verdict::Fail => ("verdict fail", self.broken),
        };
        let broken = sheet.checks().iter().filter(|check| !check.pass);
        html! {
            p class=(class) { (word) }
            @for check in broken { p class="fail" { (words::broken(check)) } }
        }
    }
}

fn title(kind: &str, job: &JobId, promise: &str, verdict: &Markup) -> Markup {
    html! {
        div class="title" {
            p class="small" { (kind) }
            h1 { (job.name) }
            p { "Job id " strong { (job.short()) } }
            p class="promise" { (promise) }
            (verdict)
        }
    }
}

/// Returns the head of a certificate.
pub(super) fn certificate_head(job: &JobId, promise: &str) -> Markup {
    html! {
        header class="cover" {
            (title("Certificate", job, promise, &Markup::default()))
            div class="code" { (code(job)) }
        }
    }
}

/// Returns the steps of a job sheet, numbered.
pub(super) fn steps<'a>(all: impl IntoIterator<Item = (&'a str, Markup)>) -> Markup {
    html! {
        @for (index, (name, step)) in all.into_iter().enumerate() {
            section class="step" {
                h2 id=(format!("step-{}", index + 1)) { (index + 1) ". " (name) }
                (step)
            }
        }
    }
}

/// Returns the hashes of the files of a kit.
pub(super) fn files(sha256: &str, files: &BTreeMap<String, String>) -> Markup {
    html! {
        section {
            h2 { "Files" }
            p { "SHA-256 of checklist.json: " code { (sha256) } }
            table class="hashes" {
                @for (file, sha256) in files {
                    tr { th scope="row" { (file) } td { code { (sha256) } } }
                }
            }
        }
    }
}
