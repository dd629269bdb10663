//! Damaged G-code in the judge: it is judged or refused with clear words, and never more.

use super::super::judge::judge_toolpaths;
use super::super::source::read_sources;
use super::*;
use crate::base::watch::Watch;
use crate::verify::{Body, Evidence};

/// Files that are damaged by chance.
const COUNT: u64 = 800;

/// Returns a small print of both trays: few lines, so that damage hits what matters.
fn seed(labels: [Option<&str>; 2]) -> Vec<u8> {
    let mut text = Print {
        layer_mm: 3.0,
        ..RIGHT
    }
    .trays(labels);
    text += ";TYPE:Support material\nG1 X20 Y30 Z4.5\nG1 X50 Y30 E1\n";
    text.into_bytes()
}

/// Damages a text in one of several ways, as the number says.
fn damage(seed: &[u8], number: u64) -> Vec<u8> {
    let mut state = number.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut next = |below: usize| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state % below.max(1) as u64) as usize
    };
    let words = [
        "E1e308",
        "X-1e9",
        "Znan",
        "G91\n",
        "M82\n",
        "G92 E0\n",
        "T7\n",
        "M221 S0\n",
        "G20\n",
        "; printing object P02\n",
        ";TYPE:Skirt\n",
        "; filament_density = -1\n",
        "; filament_diameter = 0\n",
        ";HEIGHT:1e300\n",
        "M486 S5\n",
        "G1 X1e-320 E5\n",
    ];
    let mut text = seed.to_vec();
    for _ in 0..=next(6) {
        let at = next(text.len());
        match next(6) {
            0 => text[at] = next(256) as u8,
            1 => text.truncate(at.max(text.len() / 2)),
            2 => drop(text.remove(at)),
            3 => {
                let end = (at + next(4000)).min(text.len());
                drop(text.drain(at..end));
            }
            4 => {
                let end = (at + next(4000)).min(text.len());
                let piece = text[at..end].to_vec();
                text.splice(at..at, piece);
            }
            _ => {
                let from = text[..at].iter().rposition(|byte| *byte == b'\n');
                let at = from.map_or(0, |before| before + usize::from(next(2) == 0));
                text.splice(at..at, words[next(words.len())].bytes());
            }
        }
        if text.is_empty() {
            break;
        }
    }
    text
}

/// Judges bytes; returns whether they are judged, and panics if the findings are no plain numbers.
fn is_judged(evidence: &Evidence, folder: &std::path::Path, bytes: &[u8]) -> bool {
    let path = folder.join("print.gcode");
    std::fs::write(&path, bytes).unwrap();
    let watch = Watch::silent();
    let body = Body::of(&evidence.hollowed);
    let found = read_sources(&[path], &watch)
        .and_then(|sources| judge_toolpaths(evidence, &body, &sources, &watch));
    match found {
        Ok(found) => {
            let json = serde_json::to_value(&found).unwrap();
            let is_number = |part: &serde_json::Value| part["mass_g"].is_number();
            let parts = json["parts"].as_array().unwrap();
            assert!(!parts.is_empty() && parts.iter().all(is_number), "{json}");
            true
        }
        Err(error) => {
            let said = error.to_string();
            assert!(said.len() > 20 && !said.contains("NaN"), "{said}");
            false
        }
    }
}

#[test]
fn hundreds_of_damaged_files_are_judged_or_refused() {
    let folder = tempfile::tempdir().unwrap();
    let mut evidence = kit();
    evidence.promise.printer.layer_mm = Some(3.0);
    let seeds = [LABELS, [None, None]].map(seed);
    for seed in &seeds {
        assert!(is_judged(&evidence, folder.path(), seed));
    }
    let judged = (0..COUNT).filter(|number| {
        let bytes = damage(&seeds[(number % 2) as usize], *number);
        is_judged(&evidence, folder.path(), &bytes)
    });
    let judged = judged.count();
    assert!((100..790).contains(&judged), "{judged} of {COUNT}");
}

#[test]
fn numbers_without_bounds_are_refused_or_named() {
    let folder = tempfile::tempdir().unwrap();
    let right = String::from_utf8(seed(LABELS)).unwrap();
    for more in [
        "G1 X1e308 E1e308\n",
        "G1 X9 Y9 E1e300\n",
        "M83\nG1 X-1e9 E1\n",
        "; filament_diameter = 1e-300\n",
        "; filament_density = 1e300\n",
        "; printing object P01\n;TYPE:Support material\nG1 X1e7 Y1e7 Z1e7\nG1 X0 Y0 Z0 E5\n",
    ] {
        is_judged(&kit(), folder.path(), (right.clone() + more).as_bytes());
        is_judged(&kit(), folder.path(), (more.to_owned() + &right).as_bytes());
    }
}
