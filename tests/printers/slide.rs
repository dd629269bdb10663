//! The slide coupon: a shop tries it, types what slides, and telescopes use what was measured.

use std::fs;
use std::path::Path;

use super::common::{assert_exit, checklist, equipoise_in, json, list, number, words};

fn text(path: &Path) -> String {
    fs::read_to_string(path).unwrap()
}

#[test]
fn a_sliding_clearance_that_was_tried_is_used_and_counts_as_measured_from_then_on() {
    let folder = tempfile::tempdir().unwrap();
    let run = |line: &str| equipoise_in(folder.path(), &words(line));
    let coupon = run("--json coupon --slide --printer prusa-mk4 --material pla --out coupon");
    assert_exit(&coupon, 0);
    let set = json(&coupon);
    let steps: Vec<f64> = list(&set, "sleeves")
        .iter()
        .map(|sleeve| number(sleeve, "/clearance_mm"))
        .collect();
    assert_eq!(steps, [0.2, 0.25, 0.3, 0.35, 0.4]);
    for part in ["sleeves", "plunger", "arc-sleeves", "arc-plunger"] {
        let file = folder.path().join(format!("coupon/{part}.stl"));
        assert!(fs::metadata(&file).unwrap().len() > 10_000, "{part}");
    }
    let page = text(&folder.path().join("coupon/coupon.html"));
    assert!(
        page.contains("--slide MM") && page.contains("four ticks"),
        "{page}"
    );

    let new = "printers new --from prusa-mk4 --id shop-prusa-mk4 --out shop-prusa-mk4.toml";
    assert_exit(&run(new), 0);
    let order = "telescope arc:80,90 --shells 3 --printer shop-prusa-mk4.toml --material pla --out";
    assert_exit(&run(&format!("{order} before")), 0);
    let before = checklist(&folder.path().join("before"));
    assert_eq!(before["is_clearance_proved"], false);
    assert!(text(&folder.path().join("before/job.html")).contains("unproved"));
    let is_warned = |sheet: &serde_json::Value| {
        let warnings = list(sheet, "warnings");
        warnings
            .iter()
            .any(|it| it.as_str().unwrap().contains("slide coupon"))
    };
    assert!(is_warned(&before));

    let calibrate = "printers calibrate shop-prusa-mk4.toml --material pla --lot A7 \
                     --date 2026-11-28 --slide";
    let output = run(&format!("{calibrate} 0.35"));
    assert_exit(&output, 0);
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(said.contains("0.35 (was 0.3)"), "{said}");
    assert_exit(&run(&format!("{order} after")), 0);
    let after = checklist(&folder.path().join("after"));
    assert_eq!(number(&after, "/clearance_mm"), 0.35);
    assert_eq!(after["is_clearance_proved"], true);
    let source = after["clearance_source"].as_str().unwrap();
    assert_eq!(source, "measured: sleeves tried, lot A7, 2026-11-28");
    assert!(!is_warned(&after));
    assert!(!text(&folder.path().join("after/job.html")).contains("unproved"));

    // What cannot be is refused, and leaves the profile as it was.
    let profile = folder.path().join("shop-prusa-mk4.toml");
    let kept = text(&profile);
    for bad in ["nan", "-0.1", "40"] {
        assert_exit(&run(&format!("{calibrate} {bad}")), 2);
        assert_eq!(text(&profile), kept, "{bad}");
    }
}
