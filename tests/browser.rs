//! The job sheet works in a real browser with the network off: it breaks no rule of accessibility,
//! and its view obeys its controls.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a skipped test says so")]

mod common;

use std::ffi::OsString;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use common::{make_kit, printed};

/// The script that drives the browser.
const CHECK: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/browser/check.js");
/// The largest page that is still quick to mail and to open, bytes.
const MAX_PAGE_BYTES: u64 = 5_000_000;
/// The way to get the tools.
const INSTALL: &str = "apt-get install chromium nodejs npm, \
    npm install --prefix DIR puppeteer-core axe-core, EQUIPOISE_BROWSER_TOOLS=DIR";

/// The programs and packages that open a page.
struct Browser {
    /// The folder with puppeteer-core and axe-core.
    tools: OsString,
    chromium: OsString,
}

impl Browser {
    /// Finds Node, a Chromium and the folder `EQUIPOISE_BROWSER_TOOLS`; `None` if one is missing.
    fn find() -> Option<Self> {
        let runs = |program: &str| {
            let output = Command::new(program).arg("--version").output();
            output.is_ok_and(|output| output.status.success())
        };
        let tools = std::env::var_os("EQUIPOISE_BROWSER_TOOLS")?;
        let has_tools = Path::new(&tools).join("node_modules/axe-core").is_dir();
        let names = ["chromium", "chromium-browser", "google-chrome"];
        let name = names.into_iter().find(|name| runs(name))?;
        let locate = format!("command -v {name}");
        let located = Command::new("sh").args(["-c", &locate]).output().ok()?;
        let chromium = common::text(&located.stdout).trim().into();
        (runs("node") && has_tools).then_some(Self { tools, chromium })
    }

    /// Checks a sheet, and that it takes no more pages on paper.
    fn check(&self, page: &Path, most_pages: usize) -> Output {
        let mut command = Command::new("node");
        let command = command.arg(CHECK).arg(page).arg(most_pages.to_string());
        let command = command.env("TOOLS", &self.tools);
        command.env("CHROMIUM", &self.chromium).output().unwrap()
    }
}

#[test]
fn the_sheet_of_a_top_works_in_a_browser_without_a_network() {
    assert_works("top", 4);
}

#[test]
fn the_sheet_of_a_yoyo_works_in_a_browser_without_a_network() {
    assert_works("yoyo", 6);
}

#[test]
#[ignore = "long: 40 s, and two other sheets are looked at; run with -- --ignored"]
fn the_sheet_of_a_stand_works_in_a_browser_without_a_network() {
    assert_works("stand", 4);
}

/// Makes a kit and checks its sheet, which takes no more pages on paper.
fn assert_works(goal: &str, most_pages: usize) {
    let Some(browser) = Browser::find() else {
        eprintln!("SKIPPED: no Chromium, Node or EQUIPOISE_BROWSER_TOOLS here; {INSTALL}");
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join(goal);
    // On its end the ellipsoid topples early.
    let options = format!("--wall 1.5mm --up y --least-angle 0 --goal {goal}");
    make_kit(&kit, &options);
    let page = kit.join("job.html");
    assert!(fs::metadata(&page).unwrap().len() < MAX_PAGE_BYTES);
    let checked = browser.check(&page, most_pages);
    let said = printed(&checked);
    assert!(checked.status.success(), "{said}");
    assert!(said.contains("axe finds nothing"), "{said}");
}
