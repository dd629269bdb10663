//! Tests of the page of a sound kit: what it says, and that equal runs give equal pages.

use super::*;
use crate::sheet::{Checklist, Verdict};
use crate::testing::{sample, sample_pictures};

/// Returns the page of a sheet with every picture and the view.
fn whole_page(sheet: &Checklist, evidence: &crate::verify::Evidence) -> String {
    let (pictures, view) = sample_pictures(sheet, evidence);
    page(&PageInputs {
        sheet,
        sha256: &"0123456789abcdef".repeat(4),
        pictures: &pictures,
        view: Some(&view),
    })
}

#[test]
fn the_page_stands_alone_and_escapes_what_it_is_given() {
    let (sheet, evidence) = sample();
    let page = whole_page(&sheet, &evidence);
    // The QR code of the running header is an image in the style, and SVG names its namespace.
    let own = page.replace("url(\"data:", "").replace("http-equiv", "");
    for outside in [
        "http:",
        "https:",
        "<script src",
        "<link",
        "url(",
        "@import",
        "fetch(",
        "XMLHttpRequest",
        "import(",
    ] {
        assert!(!own.contains(outside), "{outside}");
    }
    assert!(page.contains("default-src 'none'"));
    assert!(page.contains("box &lt;&amp;&gt; lid.stl") && !page.contains("box <&>"));
    // Model, cut-away, apart, two parts, before and after.
    assert_eq!(page.matches("data:image/png;base64,iVBOR").count(), 7);
}

#[test]
fn every_picture_and_code_has_a_description() {
    let (sheet, evidence) = sample();
    let page = whole_page(&sheet, &evidence);
    let count = |mark: &str| page.matches(mark).count();
    assert_eq!(
        count("<img "),
        count("<img src=\"data:image/png;base64,iVBOR")
    );
    assert_eq!(count("<svg"), count("role=\"img\" aria-label=\""));
    for picture in sample_pictures(&sheet, &evidence).0 {
        assert!(
            picture.alt.len() > 20 && picture.alt != picture.caption,
            "{}",
            picture.file
        );
    }
}

#[test]
fn the_page_says_what_to_do_in_order() {
    let (sheet, evidence) = sample();
    let page = whole_page(&sheet, &evidence);
    let places: Vec<usize> = [
        "1. Print",
        "Solid, 100 % infill",
        "2. Clean",
        "3. Weigh the parts",
        "4. Dry fit",
        "5. Glue",
        "6. Weigh the whole",
        "7. Test",
        ">Sign-off",
    ]
    .map(|step| page.find(step).unwrap())
    .into();
    assert!(places.is_sorted());
    for said in [
        "Job id <strong>box-01234567",
        "Spins upright from",
        "opened by C1",
        "no pins",
        "all promises kept",
        "Flush with the water",
        "96 % of the wall within 150\u{a0}mm (reach the other 4 % with a bent tool): ✓ open ✓ clean",
        "glue on a tip of that length",
        "hang it by a thread",
        "turns a second",
        "Material lot",
        &sheet.printer.profile_sha256,
    ] {
        assert!(page.contains(said), "{said}");
    }
}

#[test]
fn a_failed_check_is_the_first_thing_on_the_page() {
    let (mut sheet, _) = sample();
    sheet.checks[0].pass = false;
    sheet.verdict = Verdict::of(&sheet.checks);
    let page = page(&PageInputs {
        sheet: &sheet,
        sha256: "",
        pictures: &[],
        view: None,
    });
    assert!(
        !page.contains("<script"),
        "without a view there is nothing to run"
    );
    assert!(page.find("do not print").unwrap() < page.find("1. Print").unwrap());
    assert!(page.contains("✗ broken"));
}

#[test]
fn the_pictures_and_the_view_are_the_same_on_one_thread_and_on_four() {
    let (sheet, evidence) = sample();
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| sample_pictures(&sheet, &evidence))
    };
    let one = on(1);
    let expected = [
        "model.png",
        "cut-away.svg",
        "parts.svg",
        "P01.svg",
        "P02.svg",
        "cut-C1.svg",
        "inertia-before.svg",
        "inertia-after.svg",
        "certificate.svg",
        "speed-by-height.svg",
    ];
    let files: Vec<&str> = one.0.iter().map(|picture| picture.file.as_str()).collect();
    assert_eq!(files, expected.map(|name| format!("pictures/{name}")));
    assert_eq!(one, on(4));
}
