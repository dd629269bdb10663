//! The job sheet in a real browser with the network off: no rule of accessibility is broken, and
//! its view does what its controls say.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a test that is skipped says so")]

mod common;

use std::ffi::OsString;
use std::path::Path;
use std::process::Command;

use common::prepared;

/// What drives the browser.
const CHECK: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/browser/check.js");
/// The largest page that is still quick to mail and to open, bytes.
const LARGEST: u64 = 5_000_000;

/// The folder with puppeteer-core and axe-core, `EQUIPOISE_BROWSER_TOOLS`, and a Chromium; none
/// where one of them or Node is missing.
fn browser() -> Option<[OsString; 2]> {
    let runs = |program: &str| {
        Command::new(program)
            .arg("--version")
            .output()
            .is_ok_and(|said| said.status.success())
    };
    let tools = std::env::var_os("EQUIPOISE_BROWSER_TOOLS")?;
    let chromium = ["chromium", "chromium-browser", "google-chrome"]
        .into_iter()
        .find(|name| runs(name))?;
    let found = Command::new("sh")
        .args(["-c", &format!("command -v {chromium}")])
        .output()
        .ok()?;
    let path = String::from_utf8(found.stdout).ok()?.trim().to_owned();
    (runs("node") && Path::new(&tools).join("node_modules/axe-core").is_dir())
        .then_some([tools, path.into()])
}

#[test]
fn the_sheets_of_a_top_a_yoyo_and_something_that_stands_work_in_a_browser_without_a_network() {
    let Some([tools, chromium]) = browser() else {
        eprintln!(
            "SKIPPED: no Chromium, Node or EQUIPOISE_BROWSER_TOOLS here; apt-get install chromium nodejs npm, \
             npm install --prefix DIR puppeteer-core axe-core, EQUIPOISE_BROWSER_TOOLS=DIR"
        );
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    for goal in ["top", "yoyo", "stand"] {
        let kit = folder.path().join(goal);
        let (code, sheet) = prepared(&kit, "1.5mm", &["--goal", goal, "--up", "y"]);
        assert_eq!(code, Some(0), "{goal}: {:#}", sheet["checks"]);
        let page = kit.join("checklist.html");
        assert!(std::fs::metadata(&page).unwrap().len() < LARGEST, "{goal}");
        let told = Command::new("node")
            .arg(CHECK)
            .arg(&page)
            .env("TOOLS", &tools)
            .env("CHROMIUM", &chromium)
            .output();
        let told = told.unwrap();
        let said = String::from_utf8_lossy(&[told.stdout, told.stderr].concat()).into_owned();
        assert!(told.status.success(), "{goal}:\n{said}");
        assert!(said.contains("axe finds nothing"), "{goal}:\n{said}");
    }
}
