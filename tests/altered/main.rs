//! Kits altered at random, with the hashes left as they were and made anew: `verify` names every
//! alteration.
//!
//! A share runs by default. The rest takes minutes:
//!
//! ```text
//! cargo test --test judges altered -- --ignored --nocapture
//! ```

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a long run reports its figures")]

mod bytes;
mod dice;
mod geometry;
mod keys;
mod kits;
mod papers;
mod seal;

use equipoise::verify::CheckKind;
use rayon::prelude::*;

use dice::Dice;
use kits::{Kit, Room, Said, kits};

/// Number of alterations of each kind that are made by default, and in a long run.
const FEW: usize = 6;
const MANY: usize = 500;
/// Of the keys of all kits but the first, one in so many is altered.
const SHARE_OF_KEYS: usize = 3;
/// Checks that only compare files with files: a shape must be named by another one.
const OF_FILES: [CheckKind; 4] = [
    CheckKind::ChangedFiles,
    CheckKind::Checklist,
    CheckKind::Packages,
    CheckKind::Papers,
];

/// The checklist of a kit.
const CHECKLIST: &str = "checklist.json";
/// A key that no look at the kit can name: the papers of another version are not printed again.
/// Making the kit again names it.
const VERSION_KEY: &str = "/tool/version";

/// What was done to a kit, and what the judge says.
struct Trial {
    what: String,
    said: Said,
}

/// Alters kits by throws of the dice, in turn, and judges them.
fn try_all(throws: usize, alter: impl Fn(&mut Kit, &mut Dice) -> String + Sync) -> Vec<Trial> {
    let trial = |room: &mut Room, throw: usize| {
        let mut kit = kits()[throw % kits().len()].clone();
        let what = alter(&mut kit, &mut Dice::of(throw));
        let said = room.judge(&kit);
        let what = format!("{}, throw {throw}: {what}", kit.name);
        Trial { what, said }
    };
    (0..throws)
        .into_par_iter()
        .map_init(Room::new, trial)
        .collect()
}

/// Fails with the alterations that are not named, and tells the counts.
fn assert_all(title: &str, trials: &[Trial], is_named: impl Fn(&Said) -> bool) {
    let passed = trials.iter().filter(|trial| !is_named(&trial.said));
    let passed: Vec<String> = passed
        .map(|trial| format!("{}: {:?}", trial.what, trial.said))
        .collect();
    let refused = trials
        .iter()
        .filter(|trial| matches!(trial.said, Said::Refused))
        .count();
    eprintln!(
        "{title}: {} tried, {refused} refused, {} not named",
        trials.len(),
        passed.len()
    );
    assert!(
        passed.is_empty(),
        "{title}, not named:\n{}",
        passed.join("\n")
    );
}

/// Returns whether an alteration was named at all.
fn is_named(said: &Said) -> bool {
    matches!(said, Said::Broken(_) | Said::Refused)
}

/// Returns whether an alteration was named by a look at the shapes.
fn is_named_by_shape(said: &Said) -> bool {
    match said {
        Said::Broken(kinds) => kinds.iter().any(|kind| !OF_FILES.contains(kind)),
        said => is_named(said),
    }
}

fn alter_shape_and_seal(kit: &mut Kit, dice: &mut Dice) -> String {
    let what = geometry::alter(kit, dice);
    seal::renew_checklist(kit);
    what
}

/// Alters every key of the first kit and a share of the others', seals each anew and judges it.
fn try_keys() -> Vec<Trial> {
    let all = kits().iter().enumerate().flat_map(|(index, kit)| {
        let step = if index == 0 { 1 } else { SHARE_OF_KEYS };
        let pointers = keys::pointers(&kit.sheet()).into_iter().step_by(step);
        pointers.map(move |pointer| (kit, pointer))
    });
    let all = all.filter(|(_, pointer)| pointer != VERSION_KEY);
    let all: Vec<(&Kit, String)> = all.collect();
    let trial = |room: &mut Room, (throw, (kit, pointer)): (usize, &(&Kit, String))| {
        let (mut kit, mut sheet) = ((*kit).clone(), kit.sheet());
        keys::alter(&mut sheet, pointer, Dice::of(throw).sign());
        let before = kit.files[CHECKLIST].clone();
        kit.set_sheet(&sheet);
        if kit.files[CHECKLIST] == before {
            // The program does not read that key, and writes it by another.
            kit.files
                .insert(CHECKLIST.to_owned(), sheet.to_string().into_bytes());
        }
        seal::renew_list(&mut kit);
        let said = room.judge(&kit);
        let what = format!("{} {pointer}", kit.name);
        if !is_named(&said) {
            eprintln!("not named: {what}: {said:?}");
        }
        Trial { what, said }
    };
    all.par_iter()
        .enumerate()
        .map_init(Room::new, trial)
        .collect()
}

#[test]
fn kits_are_kept_as_they_were_made_and_sealed_anew() {
    let try_one = |kit: &Kit| {
        let mut room = Room::new();
        assert!(matches!(room.judge(kit), Said::Kept), "{}", kit.name);
        let mut again = kit.clone();
        seal::renew_checklist(&mut again);
        assert!(
            matches!(room.judge(&again), Said::Kept),
            "{} sealed",
            kit.name
        );
        assert!(seal::print_anew(&mut again, &mut room).is_some());
        let is_same = |(file, bytes): (&String, &Vec<u8>)| {
            // A forger lists the files in another order.
            file == "SHA256SUMS" || kit.files.get(file) == Some(bytes)
        };
        assert!(again.files.iter().all(is_same), "{} printed", kit.name);
    };
    kits().par_iter().for_each(try_one);
}

#[test]
fn a_few_alterations_are_named() {
    assert_all("files", &try_all(FEW, bytes::alter), is_named);
    assert_all("shapes", &try_all(FEW, geometry::alter), is_named);
    assert_all(
        "shapes, sealed",
        &try_all(FEW, alter_shape_and_seal),
        is_named_by_shape,
    );
}

#[test]
#[ignore = "takes minutes"]
fn every_alteration_that_is_not_sealed_is_named() {
    assert_all("files", &try_all(MANY, bytes::alter), is_named);
    assert_all("shapes", &try_all(MANY, geometry::alter), is_named);
}

#[test]
#[ignore = "takes minutes"]
fn every_alteration_of_a_shape_is_named_by_its_shape_when_sealed_anew() {
    assert_all(
        "shapes, sealed",
        &try_all(MANY, alter_shape_and_seal),
        is_named_by_shape,
    );
}

#[test]
#[ignore = "takes minutes"]
fn every_key_of_the_checklist_is_named_when_it_is_altered_alone_and_sealed_anew() {
    assert_all("keys", &try_keys(), is_named);
}

#[test]
#[ignore = "takes minutes"]
fn every_dent_of_the_outside_is_named_by_the_model_when_sealed_anew() {
    let alter = |kit: &mut Kit, dice: &mut Dice| {
        let what = geometry::dent_outside(kit, dice);
        seal::renew_checklist(kit);
        what
    };
    let is_named = |said: &Said| match said {
        Said::Broken(kinds) => kinds.contains(&CheckKind::Model),
        said => is_named(said),
    };
    assert_all(
        "dents of the outside, sealed",
        &try_all(MANY / 4, alter),
        is_named,
    );
}
