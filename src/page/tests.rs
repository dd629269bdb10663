//! Tests of the page of a sound kit: what it says, and that equal runs give equal pages.

use super::*;
use crate::sheet::{Checklist, Verdict};
use crate::testing::{sample, sample_pictures};

/// Returns the page of a sheet with every picture and the view.
fn whole_page(sheet: &Checklist, evidence: &crate::verify::Evidence) -> String {
    let (pictures, view) = sample_pictures(sheet, evidence);
    job(&PageInputs {
        sheet,
        sha256: &"0123456789abcdef".repeat(4),
        pictures: &pictures,
        view: Some(&view),
    })
}

/// Returns the certificate of a sheet with every picture.
fn whole_certificate(sheet: &Checklist, evidence: &crate::verify::Evidence) -> String {
    let (pictures, _) = sample_pictures(sheet, evidence);
    certificate(&PageInputs {
        sheet,
        sha256: &"0123456789abcdef".repeat(4),
        pictures: &pictures,
        view: None,
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
    // Model, cut-away, apart, two parts, as made.
    assert_eq!(page.matches("data:image/png;base64,iVBOR").count(), 6);
    let page = whole_certificate(&sheet, &evidence);
    assert!(page.contains("default-src 'none'") && !page.contains("<script"));
    assert!(page.contains("box &lt;&amp;&gt; lid.stl") && !page.contains("box <&>"));
    // Before and as made.
    assert_eq!(page.matches("data:image/png;base64,iVBOR").count(), 2);
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

/// Returns the value of an attribute of an SVG element.
fn attribute<'a>(element: &'a str, name: &str) -> &'a str {
    let start = element.find(&format!("{name}=\"")).unwrap() + name.len() + 2;
    element[start..].split('"').next().unwrap()
}

#[test]
fn no_text_of_a_drawing_ends_outside_of_it() {
    let (sheet, evidence) = sample();
    for picture in sample_pictures(&sheet, &evidence).0 {
        let svg = String::from_utf8_lossy(&picture.bytes()).into_owned();
        let Some(first) = svg.find("viewBox") else {
            continue;
        };
        let sides: Vec<&str> = attribute(&svg[first..], "viewBox").split(' ').collect();
        let width: f64 = sides[2].parse().unwrap();
        for element in svg.split("<text ").skip(1) {
            let number = |name| attribute(element, name).parse::<f64>().unwrap();
            let words = element.split(['>', '<']).nth(1).unwrap();
            // A letter of a common font is half as wide as high, or a little more.
            let long = 0.55 * number("font-size") * words.chars().count() as f64;
            let before = match attribute(element, "text-anchor") {
                "start" => 0.0,
                "middle" => 0.5 * long,
                _ => long,
            };
            let left = number("x") - before;
            assert!(left >= 0.0, "{}: {words} begins at {left}", picture.file);
            let right = left + long;
            assert!(right <= width, "{}: {words} ends at {right}", picture.file);
        }
    }
}

#[test]
fn the_page_says_what_to_do_in_order() {
    let (sheet, evidence) = sample();
    let page = whole_page(&sheet, &evidence);
    let places: Vec<usize> = [
        "1. Print",
        "Solid, 100 % infill",
        "2. Clean and weigh",
        "Reject outside",
        "3. Join",
        "opened like a book",
        "Glue: ",
        "4. Test",
        "Weigh the whole",
        ">Sign-off",
        "not a toy for children",
    ]
    .map(|step| page.find(step).unwrap())
    .into();
    assert!(places.is_sorted());
    for said in [
        "Job id <strong>box-01234567",
        "Spins upright from",
        "No pins: match the outlines",
        "all promises kept",
        "Flush with the water",
        "The last 4\u{a0}% cannot be seen: use a bent tool",
        "Hang it by a thread",
        "turns a second",
        "Material lot",
        "super glue",
    ] {
        assert!(page.contains(said), "{said}");
    }
    let proof = whole_certificate(&sheet, &evidence);
    for said in [
        "Job id <strong>box-01234567",
        "It is proved that no hollowing",
        "Sections at the cuts",
        "Sizes on this printer",
        &sheet.printer.profile_sha256,
    ] {
        assert!(proof.contains(said), "{said}");
        assert!(
            !page.contains(said) || said.contains("Job id"),
            "{said} is on the job sheet"
        );
    }
}

#[test]
fn an_axis_off_the_natural_up_is_told_on_the_job_sheet() {
    let (mut sheet, evidence) = sample();
    let said = "76° off the model's natural up";
    assert!(!whole_page(&sheet, &evidence).contains(said));
    sheet.goal.off_natural_deg = Some(76.2);
    assert!(whole_page(&sheet, &evidence).contains(said));
}

#[test]
fn a_failed_check_is_the_first_thing_on_the_page() {
    let (mut sheet, _) = sample();
    sheet.checks[0].pass = false;
    sheet.verdict = Verdict::of(&sheet.checks);
    let inputs = PageInputs {
        sheet: &sheet,
        sha256: "",
        pictures: &[],
        view: None,
    };
    let page = job(&inputs);
    assert!(
        !page.contains("<script"),
        "without a view there is nothing to run"
    );
    assert!(page.find("do not print").unwrap() < page.find("1. Print").unwrap());
    assert!(page.contains("Broken: ") && certificate(&inputs).contains("✗ broken"));
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
        "joint-J1.svg",
        "cut-C1.svg",
        "inertia-before.svg",
        "inertia-after.svg",
        "test.svg",
        "certificate.svg",
        "speed-by-height.svg",
    ];
    let files: Vec<&str> = one.0.iter().map(|picture| picture.file.as_str()).collect();
    assert_eq!(files, expected.map(|name| format!("pictures/{name}")));
    assert_eq!(one, on(4));
}
