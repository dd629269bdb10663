//! Alterations of files as such: bytes, ends, names, strangers.

use super::dice::Dice;
use super::kits::Kit;

/// Alters a file of a kit at random, whatever it holds; returns what was done.
pub fn alter(kit: &mut Kit, dice: &mut Dice) -> String {
    let names: Vec<String> = kit.files.keys().cloned().collect();
    let file = names[dice.pick(names.len())].clone();
    let mut bytes = kit.files[&file].clone();
    let at = dice.pick(bytes.len());
    let what = match dice.pick(8) {
        0..3 => {
            bytes[at] ^= 1 << dice.pick(8);
            "a bit of"
        }
        3 => {
            bytes.truncate(at);
            "the end of"
        }
        4 => {
            bytes.insert(at, b' ');
            "a blank in"
        }
        5 => {
            kit.files.remove(&file);
            return format!("without {file}");
        }
        6 => {
            let other = &names[dice.pick(names.len())];
            bytes = if *other == file {
                Vec::new()
            } else {
                kit.files[other].clone()
            };
            "another file as"
        }
        _ => {
            let ending = ["stl", "3mf", "obj", "gcode"][dice.pick(4)];
            let stranger = format!("parts/stranger{at}.{ending}");
            kit.files.insert(stranger.clone(), bytes);
            return format!("with {stranger}");
        }
    };
    kit.files.insert(file.clone(), bytes);
    format!("{what} {file} at {at}")
}
