//! Hostile packages: each gives a precise error or the right mesh, none a panic.

use super::*;

/// Objects 1 to `levels`, each made of two copies of the one before it.
fn doubling_objects(levels: u32, content: &str) -> String {
    let twice = |id: u32| {
        let inner = format!(
            "<component objectid=\"{0}\"/><component objectid=\"{0}\"/>",
            id - 1
        );
        object(id, &components(&inner))
    };
    object(1, content) + &(2..=levels).map(twice).collect::<String>()
}

/// Packages whose parts are missing or not XML, with words of the error for each.
fn bad_texts() -> Vec<(Vec<u8>, &'static str)> {
    let item = "<item objectid=\"1\"/>";
    let text = model_xml("", &block(1), item);
    vec![
        (
            zip(&[("word/document.xml", "<x/>")]),
            "no model in it (looked for 3D/3dmodel.model)",
        ),
        (zip(&[(MODEL_PART, "")]), "there is no <model> in it"),
        (
            zip(&[(MODEL_PART, "<html></html>")]),
            "there is no <model> in it",
        ),
        (
            zip(&[(MODEL_PART, &text[..text.len() - 20])]),
            "3D/3dmodel.model, line",
        ),
        (
            zip(&[(
                MODEL_PART,
                &text.replace("<resources>", "<resources><a></b>"),
            )]),
            "line 3: ",
        ),
        (
            zip(&[(
                MODEL_PART,
                &text.replacen("<model", "<!DOCTYPE x [<!ENTITY a \"aaaa\">]><model", 1),
            )]),
            "line 2: it declares a document type",
        ),
    ]
}

/// Packages with a bad attribute, with words of the error for each.
fn bad_attributes() -> Vec<(Vec<u8>, &'static str)> {
    let item = "<item objectid=\"1\"/>";
    let with = |from: &str, to: &str| package("", &block(1).replacen(from, to, 1), item);
    vec![
        (
            package("unit=\"furlong\"", &block(1), item),
            "<model> needs unit to be micron, millimeter",
        ),
        (
            with("x=\"1\"", "x=\"nan\""),
            "<vertex> needs x to be a finite number, found \"NaN\"",
        ),
        (
            with("x=\"1\"", "x=\"1e999\""),
            "<vertex> needs x to be a finite number",
        ),
        (with("x=\"1\"", "x=\"&a;\""), "line 3: "),
        (
            with("y=\"2\"", "w=\"2\""),
            "<vertex> needs y to be a finite number, found \"\"",
        ),
        (
            with("v1=\"3\"", "v1=\"8\""),
            "object 1: triangle 10 names vertex 8, but there are 8 vertices",
        ),
        (
            with("v1=\"3\"", "v1=\"-1\""),
            "<triangle> needs v1 to be the number of a vertex, found \"-1\"",
        ),
        (
            with("v1=\"3\"", "v1=\"4294967296\""),
            "<triangle> needs v1 to be the number of a vertex",
        ),
        (
            package("", &block(1), "<item objectid=\"1\" transform=\"1 0 0\"/>"),
            "twelve finite numbers",
        ),
        (
            package(
                "",
                &block(1),
                "<item objectid=\"1\" transform=\"0 0 0 0 0 0 0 0 0 0 0 0\"/>",
            ),
            "twelve finite",
        ),
        (
            package(
                "unit=\"meter\"",
                &block(1),
                "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 1e308 0 0\"/>",
            ),
            "object 1: a coordinate is not a finite number where it is placed",
        ),
    ]
}

/// Packages whose objects, components or extensions cannot be used, with words of the error.
fn bad_objects() -> Vec<(Vec<u8>, &'static str)> {
    let item = "<item objectid=\"1\"/>";
    vec![
        (package("", &(block(1) + &block(1)), item), "two objects 1"),
        (
            package("", &block(1), "<item objectid=\"2\"/>"),
            "no object 2",
        ),
        (package("", &block(1), ""), "no triangles"),
        (package("", &object(1, ""), item), "no triangles"),
        (
            package(
                "",
                &object(1, &components(item).replace("item", "component")),
                item,
            ),
            "a component of itself",
        ),
        (
            package(
                "",
                &(object(1, &components("<component objectid=\"2\"/>"))
                    + &object(2, &components("<component objectid=\"1\"/>"))),
                item,
            ),
            "a component of itself",
        ),
        (
            package("", &doubling_objects(40, BLOCK), "<item objectid=\"40\"/>"),
            "more than 100000 places",
        ),
        (
            package("", &doubling_objects(40, ""), "<item objectid=\"40\"/>"),
            "more than 100000 places",
        ),
        (
            package("", &doubling_objects(80, ""), "<item objectid=\"80\"/>"),
            "nested more than 64 deep",
        ),
        (
            package(
                "xmlns:b=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02\" requiredextensions=\"b\"",
                &block(1),
                item,
            ),
            "needs the extension http://schemas.microsoft.com/3dmanufacturing/beamlattice",
        ),
        (
            package("requiredextensions=\"zz\"", &block(1), item),
            "needs the extension zz",
        ),
    ]
}

#[test]
fn every_bad_package_is_refused_in_words_that_name_the_place_and_the_remedy() {
    let cases = [bad_texts(), bad_attributes(), bad_objects()];
    for (bytes, expected) in cases.concat() {
        let message = message(&bytes);
        assert!(
            message.contains(expected),
            "{message:?} does not say {expected:?}"
        );
        assert!(message.contains("export"), "{message:?} names no remedy");
    }
}

#[test]
fn a_bomb_of_blanks_is_refused_before_it_is_unpacked() {
    // It compresses to a thousandth: more than the free bytes and two hundred times its size.
    let text = model_xml("", &block(1), "<item objectid=\"1\"/>")
        .replace("<build>", &format!("{}<build>", " ".repeat(40 << 20)));
    let bytes = zip(&[(MODEL_PART, &text)]);
    assert!(bytes.len() < 100_000, "{}", bytes.len());
    assert!(message(&bytes).contains("more than 200 times their size"));
}

#[test]
fn a_package_cut_off_anywhere_is_refused() {
    let whole = package("", &block(1), "<item objectid=\"1\"/>");
    for end in 4..whole.len() {
        assert!(decode_model(&whole[..end]).is_err(), "cut at {end}");
    }
}

#[test]
fn a_model_cut_off_anywhere_is_refused() {
    let whole = model_xml("", &block(1), "<item objectid=\"1\"/>");
    for end in (0..whole.len()).filter(|&end| whole.is_char_boundary(end)) {
        let read = decode_model(&zip(&[(MODEL_PART, &whole[..end])]));
        assert!(read.is_err(), "cut at {end}");
    }
}

/// Returns the next number of a fixed sequence (Marsaglia, "Xorshift RNGs", J. Stat. Softw. 8,
/// 2003).
fn xorshift(state: &mut u64) -> usize {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    *state as usize
}

#[test]
fn changed_packages_and_models_never_panic_or_give_infinite_places() {
    let mut state = 0x9e37_79b9_7f4a_7c15;
    let inner = components(
        "<component objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 5 0 0\"/><component objectid=\"1\"/>",
    );
    let text = model_xml(
        "unit=\"inch\"",
        &(block(1) + &object(2, &inner)),
        "<item objectid=\"2\"/>",
    );
    let archive = zip(&[(MODEL_PART, &text)]);
    for round in 0..4000 {
        let mut bytes = if round % 2 == 0 {
            archive.clone()
        } else {
            text.clone().into_bytes()
        };
        for _ in 0..1 + round % 5 {
            let at = xorshift(&mut state) % bytes.len();
            match xorshift(&mut state) % 3 {
                0 => bytes[at] = xorshift(&mut state) as u8,
                1 => drop(bytes.remove(at)),
                _ => bytes.insert(at, b" /-\"0<>9&;="[xorshift(&mut state) % 11]),
            }
        }
        if round % 2 == 1 {
            bytes = zip(&[(MODEL_PART, &String::from_utf8_lossy(&bytes))]);
        }
        if let Ok(mesh) = decode_model(&bytes) {
            assert!(
                mesh.vertices()
                    .iter()
                    .all(|p| p.coords.iter().all(|x| x.is_finite()))
            );
            assert!(!mesh.triangles().is_empty());
        }
    }
}
