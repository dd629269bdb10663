//! The checks of the parts' surfaces: nothing missing, nothing too much, one body a file.

use super::cover::ON_SHEET_MM;
use super::{Check, CheckKind, Limit, PartFacts, ShapeFacts, Stray};

/// Checks that every part is one body, and that every triangle is where it should be. `printed` are
/// the parts and jigs.
pub(super) fn shape_checks(found: &ShapeFacts, printed: &[PartFacts]) -> [Check; 2] {
    let torn: Vec<&PartFacts> = printed.iter().filter(|part| part.bodies != 1).collect();
    let words = torn
        .iter()
        .map(|part| format!("{}: {}", part.id, part.bodies));
    let one_body = Check::new(
        CheckKind::OneBody,
        "every printed file holds one body",
        Some(torn.len() as f64),
        Limit::at_most(0.0, ""),
    );
    let promise = format!(
        "nothing is missing from the parts and nothing is added, within {ON_SHEET_MM} mm, but for triangles"
    );
    let count: usize = found.strays.iter().map(|stray| stray.triangles).sum();
    let surfaces = Check::new(
        CheckKind::PartSurfaces,
        &promise,
        Some(count as f64),
        Limit::at_most(0.0, ""),
    );
    [
        one_body.at(join(words)),
        surfaces.at(join(found.strays.iter().map(name_stray))),
    ]
}

/// Returns a stray in words, with its place in the model's frame.
fn name_stray(stray: &Stray) -> String {
    let what = if stray.is_missing {
        "missing"
    } else {
        "too much"
    };
    let [x, y, z] = [stray.at.x, stray.at.y, stray.at.z];
    format!(
        "{}: {} {what}, {:.3} mm off at {x:.1},{y:.1},{z:.1} mm",
        stray.of, stray.triangles, stray.off_mm
    )
}

/// Returns all words separated by semicolons, or `None` if there are none.
fn join(words: impl Iterator<Item = String>) -> Option<String> {
    let words: Vec<String> = words.collect();
    (!words.is_empty()).then(|| words.join("; "))
}
