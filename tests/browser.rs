//! The job sheets work in a real browser with the network off: they break no rule of accessibility,
//! and their views obey their controls.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a skipped test says so")]

use crate::common;

use std::ffi::OsString;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use common::{assert_exit, equipoise, make_kit, path, printed, words};
use equipoise::geom::Point;
use equipoise::io::stl;
use equipoise::mesh::primitives;

/// The scripts that drive the browser.
const SCRIPTS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/browser");
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
    /// Finds Node, a Chromium and the folder `EQUIPOISE_BROWSER_TOOLS`; `None` if one is missing,
    /// which is said.
    fn find() -> Option<Self> {
        let found = Self::located();
        if found.is_none() {
            eprintln!("SKIPPED: no Chromium, Node or EQUIPOISE_BROWSER_TOOLS here; {INSTALL}");
        }
        found
    }

    fn located() -> Option<Self> {
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

    /// Lets a script check a sheet, or the kit that it belongs to, and that it takes no more pages
    /// on paper.
    fn check(&self, script: &str, subject: &Path, most_pages: usize) -> Output {
        let mut command = Command::new("node");
        let command = command.arg(format!("{SCRIPTS}/{script}")).arg(subject);
        let command = command.arg(most_pages.to_string());
        let command = command.env("TOOLS", &self.tools);
        command.env("CHROMIUM", &self.chromium).output().unwrap()
    }

    /// Holds that a script finds all right with the sheet of a kit, which it is given.
    fn assert_works(&self, script: &str, kit: &Path, most_pages: usize) {
        let page = kit.join("job.html");
        assert!(fs::metadata(&page).unwrap().len() < MAX_PAGE_BYTES);
        let is_whole = script != HOLLOWED;
        let subject = if is_whole { kit } else { &page };
        let checked = self.check(script, subject, most_pages);
        let said = printed(&checked);
        assert!(checked.status.success(), "{said}");
        assert!(said.contains("axe finds nothing"), "{said}");
    }
}

/// The script of hollowed models.
const HOLLOWED: &str = "check.js";

#[test]
fn the_sheet_of_a_top_works_in_a_browser_without_a_network() {
    assert_works("top", 4);
}

#[test]
#[ignore = "half a minute; the sheet of a top is opened in every run"]
fn the_sheet_of_a_yoyo_works_in_a_browser_without_a_network() {
    assert_works("yoyo", 6);
}

#[test]
#[ignore = "long: 40 s, and two other sheets are looked at; run with -- --ignored"]
fn the_sheet_of_a_stand_works_in_a_browser_without_a_network() {
    assert_works("stand", 4);
}

/// Makes a kit of a hollowed model and checks its sheet, which takes no more pages on paper.
fn assert_works(goal: &str, most_pages: usize) {
    let Some(browser) = Browser::find() else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join(goal);
    // On its end the ellipsoid topples early.
    let options = format!("--wall 1.5mm --up y --least-angle 0 --goal {goal}");
    make_kit(&kit, &options);
    browser.assert_works(HOLLOWED, &kit, most_pages);
}

/// Makes a telescope's kit with these arguments and checks its sheet.
fn assert_moves(line: &str, most_pages: usize) {
    let Some(browser) = Browser::find() else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("kit");
    let output = equipoise(&[&words(line)[..], &["--out", path(&kit)]].concat());
    assert_exit(&output, 0);
    browser.assert_works("motion.js", &kit, most_pages);
}

#[test]
#[ignore = "long: that of a figure is looked at; run with -- --ignored"]
fn the_sheet_of_a_telescope_plays_its_motion_in_a_browser() {
    assert_moves(
        "telescope helix:50,60,0.4 --printer prusa-mk4 --shells 3",
        5,
    );
}

#[test]
#[ignore = "a minute; the sheet of a curve is played in every run"]
fn the_sheet_of_a_figure_plays_the_motion_of_all_its_limbs_in_a_browser() {
    let figure = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/examples/models/figure-skeleton.toml"
    );
    let line = format!("telescope {figure} --printer formlabs-form4 --shells 3");
    assert_moves(&line, 8);
}

#[test]
fn the_sheet_of_a_box_on_a_base_takes_its_units_off_along_their_normals_in_a_browser() {
    let Some(browser) = Browser::find() else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("box.stl");
    // It fits the printer in no pose.
    let mesh = primitives::cuboid(&Point::origin(), &Point::new(290.0, 260.0, 240.0));
    fs::write(&model, stl::encode(&mesh, "box")).unwrap();
    let kit = folder.path().join("kit");
    let line = "--printer prusa-mk4 --cutter makerspace-900x600 --sheet birch-3 --faces 6 --up z";
    let start = ["core", path(&model), "--out", path(&kit)];
    let output = equipoise(&[&start[..], &words(line)].concat());
    assert_exit(&output, 0);
    browser.assert_works("units.js", &kit, 10);
}

#[test]
#[ignore = "a whole kit of two polyhedra: a minute on 2 cores"]
fn the_sheet_of_a_long_box_parts_its_polyhedra_between_what_closes_them_and_the_rest() {
    let Some(browser) = Browser::find() else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("beam.stl");
    let mesh = primitives::cuboid(&Point::origin(), &Point::new(340.0, 150.0, 150.0));
    fs::write(&model, stl::encode(&mesh, "beam")).unwrap();
    let kit = folder.path().join("kit");
    let line = "--printer prusa-mk4 --cutter makerspace-900x600 --sheet birch-3 --faces 6 --up z \
                --polyhedra 2";
    let start = ["core", path(&model), "--out", path(&kit)];
    let output = equipoise(&[&start[..], &words(line)].concat());
    assert_exit(&output, 0);
    browser.assert_works("units.js", &kit, 12);
}
